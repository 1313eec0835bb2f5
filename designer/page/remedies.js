// What is in the way of a scene, and what would help: each remedy was tried, and is a button.

import { limits, placeOf } from './edge.js';
import { lampOf, perSecond, short } from './scene.js';
import { allowed, view } from './view.js';

/** What the program says is wrong, in the unit and the words of the page. */
export function inWords(reason, { timer_hz, unit }) {
  const time = (ticks) => `${short((ticks / timer_hz) * perSecond(unit), 4)} ${unit}`;
  return reason.replace(/(\d+) ticks? apart, and (\d+) (is|are) required/, (_, is, least) => `${time(is)} apart, and ${time(least)} is required`)
    .replace(/open_start <= open_end.*/, 'to open, to be open, to close, to be closed is the order');
}

/** What would make a scene whose curve is good one that can be played, as [words, changes of the scene]. */
export function remedies(scene) {
  if (allowed(scene, true) === 1) return tried(scene);
  return [];
}

function tried(scene) {
  const isGood = (changes) => allowed({ ...scene, ...changes }, true) > 1;
  const found = [];
  let [low, high] = [0, scene.measured ? 0 : Math.min(scene.triggers, 10_001)];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (isGood({ triggers: middle })) low = middle;
    else high = middle;
  }
  if (low) found.push([`Use ${low} flash${low > 1 ? 'es' : ''}`, { triggers: low }]);
  if (scene.min_gap !== 0 && isGood({ min_gap: 0 })) found.push(['Ask for no gap', { min_gap: 0 }]);
  const plain = { pulse: null, duty: null, min_pulse: null };
  if (lampOf(scene) && isGood(plain)) found.push(['Use flashes without a length', plain]);
  return found;
}

const NAMES = ['the start of opening', 'the end of opening', 'the start of closing', 'the end of closing'];

/** What keeps a handle from a place, where its scene would be `scene`: { words, remedies }. */
export function heldBy(scene, i) {
  const answer = view(scene);
  const wrong = answer.Err ?? answer.Ok.plan.Err;
  const [t, o] = placeOf(scene, i);
  if (i < 4) {
    const [least, most] = limits(scene, i);
    if (i && t < least) return { words: `It cannot come before ${NAMES[i - 1]}, at ${short(least)} ${scene.unit}.`, remedies: [] };
    if (i < 3 && t > most) return { words: `It cannot come after ${NAMES[i + 1]}, at ${short(most)} ${scene.unit}.`, remedies: [] };
  }
  if (answer.Ok && wrong && !lampOf(scene)) {
    const words = `Further, ${scene.triggers} flashes would come closer than ${short(scene.min_gap)} ${scene.unit}.`;
    return { words, remedies: remedies(scene).map(([words, changes]) => [words, { ...scene, ...changes }]) };
  }
  const reason = wrong?.reason ?? 'Further is not possible.';
  if (/back/.test(reason)) return { words: 'Further, the curve would run back in time.', remedies: [] };
  if (o > 1 || /above 1/.test(reason)) return { words: 'Fully open is 1: the curve cannot go above.', remedies: [] };
  if (o < 0 || /below 0/.test(reason)) return { words: 'Closed is 0: the curve cannot go below.', remedies: [] };
  return { words: reason, remedies: answer.Ok ? remedies(scene).map(([words, changes]) => [words, { ...scene, ...changes }]) : [] };
}
