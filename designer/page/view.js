// The crate as WebAssembly, for what follows the mouse.

import { OPTIONAL, UNITS } from './scene.js';

const decoder = new TextDecoder();
let module;
let exports;

export async function load() {
  module = await WebAssembly.compileStreaming(fetch(new URL('engine.wasm', import.meta.url)));
  await start();
}

async function start() {
  exports = (await WebAssembly.instantiate(module, {})).exports;
}

function ask(scene, bar) {
  const optional = OPTIONAL.map((key) => scene[key]);
  const has = [...optional, scene.inner].reduce((has, x, i) => has | ((x !== null) << i), 0);
  const question = [bar, UNITS.indexOf(scene.unit), has, ...scene.times, scene.triggers, scene.timer_hz, scene.min_gap,
    ...(scene.inner ?? Array(8).fill(0)), ...optional.map((x) => x ?? 0)];
  const to = exports.question(8 * question.length);
  const bytes = new DataView(exports.memory.buffer, to);
  question.forEach((x, i) => bytes.setFloat64(8 * i, x, true));
}

/** How good a scene is: 2 with a plan, 1 with a curve alone, 0 without; only what is `isDeep` is planned. */
export function allowed(scene, isDeep) {
  try {
    ask(scene, 0);
    return exports.allowed(isDeep);
  } catch {
    start();
    return 0;
  }
}

/** All that is shown of a scene, as `{ Ok }` or `{ Err }`. */
export function view(scene, bar) {
  try {
    ask(scene, bar);
    const length = exports.view();
    const answer = JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
    if (answer.Ok) read(answer.Ok, exports.memory.buffer, exports.numbers());
    return answer;
  } catch (fault) {
    start();
    return { Err: { reason: `this could not be computed (${fault.message})`, notes: [] } };
  }
}

// Puts the numbers into a view, which only tells where they are.
function read(view, memory, at) {
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
  const plan = view.plan.Ok;
  if (!plan) return;
  const [closest, min_gap, exposure] = numbers(plan.seconds);
  Object.assign(plan, { closest, min_gap, exposure, ideal: numbers(plan.ideal), triggered: numbers(plan.triggered) });
  for (const set_up of plan.set_ups) set_up.pulses = tuples(set_up.pulses, 3);
}
