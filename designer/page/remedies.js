// What is in the way of a scene, and what would help: each remedy was tried, and is a button.

import { $ } from './dom.js';
import { lampOf, perSecond, short } from './scene.js';
import { allowed } from './view.js';

/** What the program says is wrong, in the unit and the words of the page. */
export function inWords(reason, { timer_hz, unit }) {
  const time = (ticks) => `${short((ticks / timer_hz) * perSecond(unit), 4)} ${unit}`;
  // A field is called as it is on the page.
  const label = (all, key) => ($(key)?.labels ? `${$(key).labels[0].firstChild.data.trim().replace(/,$/, '')}: ` : all);
  return reason.replace(/(?<= ticks?( apart)?, and )(\d+) (is|are) required/, (_, apart, least) => `${time(least)} is required`)
    .replace(/(?<![\^\d])(\d+) ticks?\b/g, (_, ticks) => time(ticks))
    .replace(/open_start <= open_end.*/, 'to open, to be open, to close, to be closed is the order')
    .replace('0 at open_start, 1 at close_end', '0 at the start, 1 at the end').replace(/ to open_start: `delay = 0`.*/, ' to the start of opening')
    .replace(/^trigger_times: /, '').replace(/^(\w+): /, label).replace(/\btriggers\b|(?<=\d )trigger\b|\btrigger(?= \d)/g, (it) => (it === 'trigger' ? 'flash' : 'flashes'));
}

/** What would make a scene whose curve is good one that can be played, as [words, changes of the scene]. */
export function remedies(scene) {
  if (allowed(scene, true) === 1) return tried(scene);
  return [];
}

function tried(scene) {
  const isGood = (changes) => allowed({ ...scene, ...changes }, true) > 1;
  const found = [];
  let [low, high] = [0, scene.measured ? 0 : Math.floor(Math.min(scene.triggers, 10_001))];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (isGood({ triggers: middle })) low = middle;
    else high = middle;
  }
  if (low) found.push([`Use ${low} flash${low > 1 ? 'es' : ''}`, { triggers: low }]);
  if (scene.min_gap !== 0 && isGood({ min_gap: 0 })) found.push(['Ask for no gap', { min_gap: 0 }]);
  if (scene.timer_bits !== null && isGood({ timer_bits: null })) found.push(['Take a timer of 32 bits', { timer_bits: null }]);
  const plain = { pulse: null, duty: null, min_pulse: null };
  if (lampOf(scene) && isGood(plain)) found.push(['Use flashes without a length', plain]);
  return found;
}
