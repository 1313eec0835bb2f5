// What is on the screen: one object, which changes here alone and is drawn by one function. And the steps that led
// there: undone and redone by keys, by buttons, and by the browser's Back and Forward, whose entries are counted.

import { fromAddress, hash } from './scene.js';
import { viewOf } from './view.js';

/** A browser takes so many changes of its entries in ten seconds: steps that come faster share an entry. */
const PAUSE = 120;
const KEPT = 'steps', MOST_KEPT = 300;

export const model = {
  /** { scene, trace, speeds }: a step, or the draft of one. */
  now: null,
  /** What the engine tells of the scene; null where it has no curve. And the last scene that had one, with its view. */
  view: null, last: null, good: null,
  /** What is wrong: as the engine tells it, or a `reason`, with `id` where a field's text, or `isLink`, is none. */
  wrong: null,
  /** What the program tells, in words, of a `scene`: its facts and doubts, or what is wrong. */
  told: null,
  /** A time in seconds that is pointed at. */
  cursor: null,
  /** What is being computed: { words, share, cancel }. What came of the last file: { words, isWrong, act }. */
  busy: null, note: null,
  /** A trace that was refused as it is read: { file, name, asked, measured, words, mend }. */
  pending: null,
  get isDraft() { return model.now !== steps[at]?.state || Boolean(model.wrong?.id || model.wrong?.isLink); },
  get canUndo() { return at > 0 || model.isDraft; },
  get canRedo() { return at < steps.length - 1; },
};

let steps = [], at = -1;
// The browser's entry and the tab's visit, and whether a step waits for an entry.
let entry = 0, visit = null, waits = false;
let draw;
let mirrored = -Infinity, timer;

/** Begins with what the address or the last visit says, else with `first`. `drawAll` draws the model. */
export function startModel(first, drawAll) {
  draw = drawAll;
  const kept = recall();
  visit = kept?.visit ?? String(Math.random());
  if (kept) ({ steps, at, entry } = kept);
  addEventListener('popstate', popped);
  addEventListener('pagehide', keep);
  if (kept) return show(steps[at].state);
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
 * yet. What is told beside it is no change of the scene, as a cursor.
 */
export function change(changes, { key, isDraft, told } = {}) {
  const stopped = 'trace' in changes ? overtake() : null;
  set({ ...model.now, ...changes });
  Object.assign(model, stopped && { note: stopped }, told);
  // What has no curve is shown, and undone first.
  if (!isDraft && model.view) step(key);
  draw(model);
}

// Another shutter ends what is computed of an older one; what is drawn or typed does not.
function overtake() {
  const { busy } = model;
  busy?.cancel();
  model.pending = null;
  return busy && { words: `${busy.words} was stopped: another curve was chosen meanwhile.` };
}

/** Tells of what is no change of the scene: a cursor, a computation, a note. */
export function tell(parts) {
  Object.assign(model, parts);
  draw(model);
}

/** A text that is no number, in the field `id`: it stays as it is, and nothing else changes. */
export const refuse = (reason, id) => tell({ wrong: { reason, id } });

function step(key) {
  const before = steps[at];
  const isSame = before && before.state.trace === model.now.trace && hash(before.state) === hash(model.now);
  if (isSame || (key && before?.key === key && at === steps.length - 1)) {
    before.state = model.now;
    if (isSame) return;
  } else {
    steps.length = ++at;
    steps.push({ state: model.now, key });
    waits ||= at > 0;
  }
  mirror();
}

/** What comes next is a step of its own. */
export function seal() {
  if (steps[at]) steps[at].key = undefined;
}

function show(state) {
  set(state);
  draw(model);
}

/** Undoes or redoes steps; what is half typed, dragged or wrong is undone first. */
export function go(by) {
  if (by < 0 && model.isDraft) return show(steps[at].state);
  if (!steps[at + by]) return;
  seal();
  at += by;
  show(steps[at].state);
  mirror();
}

function mirror() {
  clearTimeout(timer);
  const wait = mirrored + PAUSE - performance.now();
  if (wait > 0) timer = setTimeout(writeEntry, wait);
  else writeEntry();
}

// The browser's entry becomes that of the step.
function writeEntry() {
  clearTimeout(timer);
  mirrored = performance.now();
  const how = waits ? 'pushState' : 'replaceState';
  if (how === 'pushState') entry++;
  waits = false;
  history[how]({ entry, visit }, '', hash(steps[at].state));
}

function popped({ state }) {
  waits = false;
  // Somebody typed an address.
  if (state?.visit !== visit) {
    entry++;
    return arrived();
  }
  const by = Math.min(Math.max(state.entry - entry, -at), steps.length - 1 - at);
  entry = state.entry;
  if (by) {
    if (model.isDraft) show(steps[at].state);
    go(by);
  } else mirror();
}

// Opens what the address says, as a step whose entry is there.
function arrived(first) {
  try {
    change({ ...fromAddress(location.hash), trace: null });
    waits = false;
    if (model.view) return writeEntry();
    model.wrong = { ...model.wrong, isLink: true };
  } catch (error) {
    const reason = `The link holds no curve: ${error.message}`;
    model.now ??= first;
    Object.assign(model, { view: null, wrong: { reason, isLink: true } });
  }
  // What is wrong with the first of all addresses is undone to a shutter that is not.
  if (first && at < 0) [steps, at] = [[{ state: first }], 0];
  if (!model.view) model.last = null;
  draw(model);
}

// What a tab keeps when it is loaded again: all but the traces' files.
function keep() {
  const few = steps.slice(Math.max(0, at - MOST_KEPT), at + MOST_KEPT);
  const traces = [...new Set(few.map(({ state }) => state.trace))];
  const states = few.map(({ state }) => ({ ...state, trace: traces.indexOf(state.trace) }));
  const kept = { visit, entry, at: Math.min(at, MOST_KEPT), states };
  kept.traces = traces.map((trace) => trace && { ...trace, file: null });
  try {
    sessionStorage.setItem(KEPT, JSON.stringify(kept));
  } catch {
    // Too much, or not allowed: the address has the scene.
  }
}

function recall() {
  try {
    const { visit, entry, at, traces, states } = JSON.parse(sessionStorage.getItem(KEPT));
    if (history.state?.visit !== visit) return null;
    const steps = states.map((state) => ({ state: { ...state, trace: traces[state.trace] } }));
    const moved = Math.min(Math.max(at + history.state.entry - entry, 0), steps.length - 1);
    const isShown = hash(steps[moved].state) === location.hash;
    return isShown ? { visit, entry: history.state.entry, at: moved, steps } : null;
  } catch {
    return null;
  }
}
