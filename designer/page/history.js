// One history of all that is done: steps to undo and to redo, by keys, by buttons, and by the browser's Back and Forward.
//
// The browser's entries are counted, no more: so many back is so many steps undone. What an entry was made for may be gone.

/** A browser takes so many changes of its entries in ten seconds: steps that come faster share an entry. */
const PAUSE = 120;

const steps = [];
let at = -1;
// The number of the browser's entry, and whether a step waits for one.
let entry = history.state?.entry ?? 0, waits = false;
let address, show, arrived;
let last = -Infinity, timer;

/**
 * Begins. `address(state)` is a state's part of the address behind '#', `show(state)` shows what is gone back to, and
 * `arrived()` is told of an address that is of no step.
 */
export function start(with_) {
  ({ address, show, arrived } = with_);
  addEventListener('popstate', popped);
}

/** A state that is new. One with the key of the step before goes on with that step. */
export function step(state, key) {
  const isNext = add(state, key);
  if (isNext && at > 0) waits = true;
  mirror();
}

function add(state, key) {
  const before = steps[at];
  if (key && before?.key === key && at === steps.length - 1) {
    before.state = state;
    return false;
  }
  steps.length = ++at;
  return steps.push({ state, key });
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
  const wait = last + PAUSE - performance.now();
  if (wait > 0) timer = setTimeout(write, wait);
  else write();
}

// The browser's entry becomes that of the step.
function write() {
  clearTimeout(timer);
  last = performance.now();
  const how = waits ? 'pushState' : 'replaceState';
  if (waits) entry++;
  waits = false;
  history[how]({ entry, load: performance.timeOrigin }, '', address(steps[at].state));
}

function popped({ state }) {
  waits = false;
  // Somebody typed an address, or it is from before the page was loaded again.
  if (state?.load !== performance.timeOrigin) {
    entry = state?.entry ?? entry + 1;
    return arrived();
  }
  const by = Math.min(Math.max(state.entry - entry, -at), steps.length - 1 - at);
  entry = state.entry;
  if (by) go(by);
  else mirror();
}

/** The entry of an address that came from outside is that of a new step. */
export function adopt(state) {
  add(state);
  write();
}
