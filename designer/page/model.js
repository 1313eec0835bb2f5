// What is on the screen: one object, which changes here alone and is drawn by one function. And the steps that led
// there: undone and redone by keys and buttons. The browser's Back shows the scene before, be it undone or not.

import { fromAddress, given, hash, withValues } from './scene.js';
import { viewOf } from './view.js';

/** A browser takes so many changes of its entries in ten seconds: steps that come faster share an entry. */
const PAUSE = 120;

export const model = {
  /** { scene, trace, speeds }: a step, or the draft of one. */
  now: null,
  /** What the engine tells of the scene; null where it has no curve. And the last scene that had one, with its view. */
  view: null, last: null, good: null,
  /** What is wrong: as the engine finds it, or a `reason`, with `id` where a field's text, or `isLink`, is none. */
  wrong: null,
  /** What the program tells, in words, of a `scene`: its facts and doubts, or what is wrong. */
  told: null,
  /** What is being computed: { words, share, cancel }. What came of the last file: { words, isWrong, act }. */
  busy: null, note: null,
  /** A trace that was refused as it is read: { file, name, asked, measured, words, mend }. */
  pending: null,
  get isDraft() { return model.now !== steps[at]?.state || Boolean(model.wrong?.id || model.wrong?.isLink); },
  get canUndo() { return at > 0 || model.isDraft; },
  get canRedo() { return at < steps.length - 1; },
};

let steps = [], at = -1, draw, timer;
// The step that the browser's entry shows; steps have numbers that no other visit has.
let entry, next = Date.now();

/** Begins with what the address says, else with `first`. `drawAll` draws the model. */
export function startModel(first, drawAll) {
  draw = drawAll;
  addEventListener('popstate', ({ state }) => {
    const found = steps.findIndex(({ number }) => number === state?.number);
    // Somebody typed an address, or it is of an earlier visit.
    if (found < 0) return arrived();
    [at, entry] = [found, state.number];
    show();
  });
  if (location.hash.length > 1) arrived(first);
  else change(first);
}

// Shows a state, whatever is computed of it.
function set(next) {
  const { Ok, Err } = next.scene === model.now?.scene && model.view ? { Ok: model.view } : viewOf(next.scene);
  // What was said of a file is said of what was there.
  if (next.scene !== model.now?.scene && !model.note?.act) model.note = null;
  model.now = next;
  model.view = Ok ?? null;
  if (Ok) [model.last, model.good] = [Ok, next.scene];
  model.wrong = Err ?? Ok.plan.Err ?? null;
}

/**
 * Goes on from what is on the screen. One with the `key` of the step before goes on with that step; a draft is none
 * yet.
 */
export function change(changes, { key, isDraft } = {}) {
  const stopped = 'trace' in changes ? overtake() : null;
  set({ ...model.now, ...changes });
  if (stopped) model.note = stopped;
  // What has no curve is shown, and undone first.
  if (!isDraft && model.view) step(key);
  draw(model);
}

/** Changes values of fields. */
export const give = (values, key) =>
  change({ scene: given(withValues(model.now.scene, values), Object.keys(values)) }, { key });

// Another shutter ends what is computed of an older one; what is drawn or typed does not.
function overtake() {
  const { busy } = model;
  busy?.cancel();
  model.pending = null;
  return busy && { words: `${busy.words} was stopped: another curve was chosen meanwhile.` };
}

/** Tells of what is no change of the scene: a computation, a note. */
export function tell(parts) {
  Object.assign(model, parts);
  draw(model);
}

/** A text that is no number, in the field `id`: it stays as it is, and nothing else changes. */
export const refuse = (reason, id) => tell({ wrong: { reason, id } });

function step(key) {
  const before = steps[at];
  const isSame = before && before.state.trace === model.now.trace && hash(before.state) === hash(model.now);
  if (isSame || (key && before?.key === key && at === steps.length - 1)) before.state = model.now;
  else {
    steps.length = ++at;
    steps.push({ state: model.now, key, number: next++ });
  }
  if (!isSame) mirror();
}

/** What comes next is a step of its own. */
export function seal() {
  if (steps[at]) steps[at].key = undefined;
}

function show() {
  set(steps[at].state);
  draw(model);
}

/** Undoes or redoes steps; what is half typed, dragged or wrong is undone first. */
export function go(by) {
  if (by > 0 || !model.isDraft) {
    if (!steps[at + by]) return;
    seal();
    at += by;
  }
  show();
  mirror();
}

// The browser's entry becomes that of the step, once no other follows at once.
function mirror() {
  clearTimeout(timer);
  timer = setTimeout(writeEntry, PAUSE, 'pushState');
}

function writeEntry(how) {
  clearTimeout(timer);
  const { state, number } = steps[at];
  history[entry === undefined || entry === number ? 'replaceState' : how]({ number }, '', hash(state));
  entry = number;
}

// Opens what the address says, as a step whose entry is there.
function arrived(first) {
  try {
    change({ ...fromAddress(location.hash), trace: null });
    if (model.view) return writeEntry('replaceState');
    model.wrong = { ...model.wrong, isLink: true };
  } catch (error) {
    const reason = `The link holds no curve: ${error.message}`;
    model.now ??= first;
    Object.assign(model, { view: null, wrong: { reason, isLink: true } });
  }
  // What is wrong with the first of all addresses is undone to a shutter that is not.
  if (first && at < 0) [steps, at] = [[{ state: first, number: next++ }], 0];
  if (!model.view) model.last = null;
  draw(model);
}
