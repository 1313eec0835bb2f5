// What is in the way of a scene, in the page's words, and what would help, as buttons.

import { $ } from './dom.js';
import { perSecond, short } from './scene.js';

/** What the program says is wrong, in the unit and the words of the page. */
export function inWords(reason, { timer_hz, unit }) {
  const time = (ticks) => `${short((ticks / timer_hz) * perSecond(unit), 4)} ${unit}`;
  // A field is called as it is on the page.
  const label = (all, key) => (key === 'fully_open' ? 'flashes while fully open: ' : $(key)?.labels ? `${$(key).labels[0].firstChild.data.trim().replace(/,$/, '')}: ` : all);
  return reason.replace(/(?<= ticks?( apart)?, and )(\d+) (is|are) required/, (_, apart, least) => `${time(least)} is required`)
    .replace(/(?<![\^\d])(\d+) ticks?\b/g, (_, ticks) => time(ticks))
    .replace(/open_start <= open_end.*/, 'to open, to be open, to close, to be closed is the order')
    .replace('0 at open_start, 1 at close_end', '0 at the start, 1 at the end').replace(/ to open_start: `delay = 0`.*/, ' to the start of opening')
    .replace(/set_up is "emulated"/, 'the set-up is emulated').replace(/^trigger_times: /, '').replace(/^(\w+): /, label).replace(/\btriggers\b|(?<=\d )trigger\b|\btrigger(?= \d)/g, (it) => (it === 'trigger' ? 'flash' : 'flashes'));
}

const REMEDIES = {
  triggers: (n) => [`Use ${n} flash${n > 1 ? 'es' : ''}`, { triggers: n }],
  min_gap: () => ['Ask for no gap', { min_gap: 0 }],
  timer_bits: () => ['Take a timer of 32 bits', { timer_bits: null }],
  lamp: () => ['Use flashes without a length', { pulse: null, duty: null, min_pulse: null, fully_open: null }],
};

/** What would help, as [words, changes of the scene]: the engine has tried each. Of what is half typed nothing is known. */
export const remedies = ({ id, remedies = [] }) => (id ? [] : remedies.map(([code, n]) => REMEDIES[code](n)));
