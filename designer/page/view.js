// The crate as WebAssembly, for what follows the mouse.

import { UNITS } from './presets.js';
import { CHOICES, INNER, NUMBERS, TIMES } from './scene.js';

const decoder = new TextDecoder();
const folder = document.currentScript.src;
/** The address of a file beside this script. */
export const fileOf = (name) => new URL(name, folder);

let engine;
let exports;

export async function loadEngine() {
  engine = await WebAssembly.compileStreaming(fetch(fileOf('engine.wasm')));
  await instantiate();
}

async function instantiate() {
  exports = (await WebAssembly.instantiate(engine, {})).exports;
}

// A scene's number by its key; NaN for none.
function numberOf(scene, key) {
  const i = TIMES.indexOf(key), k = INNER.indexOf(key);
  if (CHOICES[key]) return scene[key] === null ? NaN : CHOICES[key].indexOf(scene[key]);
  return i >= 0 ? scene.times[i] : k >= 0 ? (scene.inner?.[k] ?? NaN) : (scene[key] ?? NaN);
}

function ask(scene) {
  const question = [UNITS.indexOf(scene.unit), ...NUMBERS.map((key) => numberOf(scene, key)), ...(scene.measured ?? [])];
  const to = exports.question(8 * question.length);
  const bytes = new DataView(exports.memory.buffer, to);
  question.forEach((x, i) => bytes.setFloat64(8 * i, x, true));
}

/** Has a scene a curve? */
export function allowed(scene) {
  try {
    ask(scene);
    return Boolean(exports.allowed());
  } catch {
    instantiate();
    return false;
  }
}

/** All that is shown of a scene, as `{ Ok }` or `{ Err }`. */
export function viewOf(scene) {
  try {
    ask(scene);
    const length = exports.view();
    const answer = JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
    if (answer.Ok) readNumbers(answer.Ok, exports.memory.buffer, exports.numbers());
    return answer;
  } catch (fault) {
    instantiate();
    return { Err: { reason: `this could not be computed (${fault.message})`, notes: [] } };
  }
}

// Puts the numbers into a view, which only tells where they are.
function readNumbers(view, memory, at) {
  const numbers = ([from, to]) => Array.from(new Float64Array(memory, at + 8 * from, to - from));
  const tuples = (part, size) => {
    const all = numbers(part);
    return Array.from({ length: all.length / size }, (_, i) => all.slice(size * i, size * (i + 1)));
  };
  view.times = numbers(view.times);
  const points = tuples(view.ramps, 2);
  view.ramps = [points.slice(0, 4), points.slice(4)];
  view.cdf = tuples(view.cdf, 2);
  view.edges = numbers(view.edges);
  view.marks = tuples(view.marks, 3);
  [view.exposure, view.efficiency] = numbers(view.exposure);
  const plan = view.plan.Ok;
  if (!plan) return;
  [plan.closest, plan.min_gap, plan.half_open] = numbers(plan.seconds);
}
