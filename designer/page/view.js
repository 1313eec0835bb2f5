// The crate as WebAssembly, for what follows the mouse.

import { OPTIONAL, UNITS } from './scene.js';

const decoder = new TextDecoder();
let module;
let exports;

export async function load() {
  module = await WebAssembly.compileStreaming(fetch('engine.wasm'));
  await start();
}

async function start() {
  exports = (await WebAssembly.instantiate(module, {})).exports;
}

/** All that is shown of a scene, as `{ Ok }` or `{ Err }`. */
export function view(scene, bar) {
  const optional = OPTIONAL.map((key) => scene[key]);
  const has = [...optional, scene.inner].reduce((has, x, i) => has | ((x !== null) << i), 0);
  const question = [bar, UNITS.indexOf(scene.unit), has, ...scene.times, scene.triggers, scene.timer_hz, scene.min_gap,
    ...(scene.inner ?? Array(8).fill(0)), ...optional.map((x) => x ?? 0)];
  const to = exports.question(8 * question.length);
  const bytes = new DataView(exports.memory.buffer, to);
  question.forEach((x, i) => bytes.setFloat64(8 * i, x, true));
  try {
    const length = exports.view();
    return JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
  } catch (fault) {
    start();
    return { Err: { reason: `this could not be computed (${fault.message})`, notes: [] } };
  }
}
