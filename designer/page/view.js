// The crate as WebAssembly, for what follows the mouse.

import { codes as CODES, keys as KEYS, units as UNITS } from 'presets';
import { CHOICES, INNER, NUMBERS, TIMES } from './scene.js';

/** The address of a file beside this script. */
export const fileOf = (name) => new URL(name, import.meta.url);

/** A plan's numbers in the engine's order; null is none. */
const PLAN = ['timer_hz', 'early', 'delay', 'most', 'closest', 'min_gap', 'half_open', 'drift', 'coarse'];

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

// What the engine answers about a scene; what fails may have left anything behind.
function ask(scene, answer, failed) {
  try {
    const numbers = NUMBERS.map((key) => numberOf(scene, key));
    const question = [UNITS.indexOf(scene.unit), ...numbers, ...(scene.measured ?? [])];
    const to = exports.question(8 * question.length);
    const bytes = new DataView(exports.memory.buffer, to);
    question.forEach((x, i) => bytes.setFloat64(8 * i, x, true));
    return answer();
  } catch (fault) {
    instantiate();
    return failed(fault);
  }
}

/** Has a scene a curve? */
export const allowed = (scene) => ask(scene, () => Boolean(exports.allowed()), () => false);

/** All that is shown of a scene, as `{ Ok }` or `{ Err }`. */
export const viewOf = (scene) => ask(scene, () => {
  const length = exports.view(), at = exports.answer();
  const numbers = new Float64Array(exports.memory.buffer.slice(at, at + length));
  const parts = [];
  for (let i = 0; i < numbers.length; i += 1 + numbers[i]) parts.push([...numbers.subarray(i + 1, i + 1 + numbers[i])]);
  return shown(parts);
}, ({ message }) => ({ Err: { reason: `this could not be computed (${message})` } }));

// The engine's answer, whose parts are told in view.rs.
function shown(parts) {
  const tuples = (list, n) => Array.from({ length: list.length / n }, (_, i) => list.slice(n * i, n * (i + 1)));
  const wrong = () => {
    const [[code, key, from, to, ...values], remedies] = parts.slice(-2);
    const inner = from >= 0 ? [from, to] : null;
    return { Err: { code: CODES[code], key: KEYS[key], inner, values, remedies: tuples(remedies, 2) } };
  };
  if (parts.length === 2) return wrong();
  const [times, ramps, cdf, [exposure, efficiency], edges, marks, numbers, ticks, pulses, doses] = parts;
  const points = tuples(ramps, 2);
  const both = [points.slice(0, 4), points.slice(4)];
  const view = { times, exposure, efficiency, edges, ramps: both, cdf: tuples(cdf, 2) };
  const named = () => PLAN.map((name, i) => [name, Number.isNaN(numbers[i]) ? null : numbers[i]]);
  const plan = doses ? { Ok: { ticks, pulses: tuples(pulses, 2), doses, ...Object.fromEntries(named()) } } : wrong();
  return { Ok: { ...view, marks: tuples(marks, 3), plan } };
}
