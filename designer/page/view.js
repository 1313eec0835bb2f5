// The crate as WebAssembly, for what follows the mouse.

import init, { Question } from 'engine';
import { originSeconds, toProgram } from './scene.js';

/** The address of a file beside this script. */
export const fileOf = (name) => new URL(name, import.meta.url);

export const loadEngine = () => init({ module_or_path: fileOf('engine.wasm') });

// What the engine answers of a scene, whose values are told key by key.
function ask(scene, answer, failed) {
  try {
    const question = new Question(), tables = { ...toProgram({ ...scene, own: null }), own: scene.own ?? {} };
    for (const [table, values] of Object.entries(tables)) {
      for (const [key, value] of Object.entries(values)) {
        if (typeof value === 'string') question.say(`${table}.${key}`, value);
        else if (value !== null && key !== 'measured') question.set(`${table}.${key}`, [value].flat().map(Number));
      }
    }
    const told = answer(question);
    question.free();
    return told;
  } catch (fault) {
    return failed(fault);
  }
}

/** Has a scene a curve? */
export const allowed = (scene) => ask(scene, (question) => Boolean(question.curve()), () => false);

/** All that is drawn of a scene, as `{ Ok }` or `{ Err }`; its times are in seconds, and counted as the scene's are. */
export const viewOf = (scene) => ask(scene, (question) => {
  const view = question.view(), shown = copied(view, originSeconds(scene), question.curve());
  view.free();
  return shown;
}, ({ message }) => ({ Err: { reason: `this could not be computed (${message})` } }));

function copied(view, origin, curve) {
  const tuples = (list, n) => Array.from({ length: list.length / n }, (_, i) => [...list.slice(n * i, n * (i + 1))]);
  const later = (list, n) => tuples(list, n).map(([t, ...rest]) => [t - origin, ...rest]);
  const wrong = view.wrong === undefined ? null : { Err: { key: view.wrong, inner: [...view.inner] } };
  const times = later(view.times, 1).flat(), points = later(view.ramps, 2);
  if (!times.length) return wrong ?? { Err: { key: '' } };
  // Counted from so far off, a shutter has no digits left.
  if (!(Math.abs(times[0]) < 1e5 * (times[3] - times[0]) || !origin)) {
    const reason = 'sync delay: it is too long to count this shutter’s times from its edge';
    return { Err: { key: 'flashes.delay', reason } };
  }
  const { early, hz, from_edge: delay = null } = view;
  const ticks = [...view.ticks], pulses = tuples(view.pulses, 2);
  return {
    Ok: {
      times, ramps: [points.slice(0, 4), points.slice(4)], cdf: later(view.cdf, 2),
      edges: later(view.edges, 1).flat(), marks: later(view.marks, 3),
      openness: (time) => curve.openness(time + origin), plan: wrong ?? { Ok: { ticks, pulses, early, delay, hz } },
    },
  };
}
