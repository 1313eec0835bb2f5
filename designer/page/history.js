// One history of all that is done: steps to undo and to redo, by keys, by buttons, and by the browser's Back and Forward.

/** A browser keeps some 50 entries and takes so many changes of them in ten seconds: steps that come faster share an entry. */
const MOST_ENTRIES = 45, PAUSE = 120;

const steps = [];
let at = -1;
// Not those of the page as it was before it was loaded again.
let ids = Date.now();
let address, show, arrived;
let last = -Infinity, timer, expected;

/**
 * Begins. `address(state)` is a state's part of the address behind '#', `show(state)` shows what is gone back to, and
 * `arrived()` is told of an address that somebody typed.
 */
export function start(with_) {
  ({ address, show, arrived } = with_);
  addEventListener('popstate', popped);
}

/** A state that is new. One with the key of the step before goes on with that step. */
export function step(state, key) {
  const before = steps[at];
  if (key && before?.key === key && at === steps.length - 1) before.state = state;
  else {
    steps.length = at + 1;
    steps.push({ id: ids++, state, key });
    at++;
  }
  mirror();
}

/** What comes next is a step of its own. */
export function seal() {
  if (steps[at]) steps[at].key = undefined;
}

export const canGo = (by) => Boolean(steps[at + by]);

export function go(by) {
  if (!canGo(by)) return;
  seal();
  at += by;
  show(steps[at].state);
  mirror();
}

function mirror() {
  clearTimeout(timer);
  // The browser is on its way to an entry: what is written now would be lost.
  if (expected !== undefined) return;
  const wait = last + PAUSE - performance.now();
  if (wait > 0) timer = setTimeout(enter, wait);
  else enter();
}

// The browser's entry becomes that of the step.
function enter() {
  last = performance.now();
  const step = steps[at];
  const entries = steps.filter((step) => step.isEntered).slice(-MOST_ENTRIES);
  const [from, to] = [history.state?.id, step.id].map((id) => entries.findIndex((entry) => entry.id === id));
  const write = (how) => history[how]({ id: step.id }, '', address(step.state));
  if (from >= 0 && to >= 0 && from !== to) {
    history.go(to - from);
    const asked = (expected = { id: step.id });
    // A browser may leave out what it takes for a trick. To ask again could lead out of the page.
    setTimeout(() => {
      if (expected !== asked) return;
      for (const step of steps) step.isEntered = false;
      arrive();
    }, 5000);
  } else if (from === to && to >= 0) write('replaceState');
  else {
    // The first one has the entry that the page was opened with; one that is gone back to takes what entry there is.
    const isNew = at > 0 && at === steps.length - 1;
    if (!isNew) for (const other of steps) if (other.id === history.state?.id) other.isEntered = false;
    write(isNew ? 'pushState' : 'replaceState');
    step.isEntered = true;
  }
}

function arrive() {
  expected = undefined;
  mirror();
}

function popped({ state }) {
  if (expected !== undefined && state?.id !== undefined) return arrive();
  expected = undefined;
  const to = steps.findIndex((step) => step.id === state?.id);
  if (to < 0) return arrived();
  if (to === at) return;
  seal();
  at = to;
  show(steps[at].state);
}

/** The entry that somebody typed the address of is that of a new step. */
export function adopt(state) {
  steps.length = at + 1;
  steps.push({ id: ids++, state, isEntered: true });
  at++;
  history.replaceState({ id: steps[at].id }, '', address(state));
}
