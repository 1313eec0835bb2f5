// What is wrong with a scene, in the page's words by the engine's codes, and what would help, as buttons.

import { $ } from './dom.js';
import { INNER, perSecond, short } from './scene.js';

/** A field's name, as it stands on the page. */
export const label = (id) =>
  id === 'fully_open' ? 'flashes while fully open' : $(id).labels[0].firstChild.data.trim().replace(/,$/, '');

const many = (most) =>
  !most ? 'no number of flashes keeps that' : most > 1 ? `${most} flashes keep that` : '1 flash keeps that';
const pair = (things, of, [i, gap, least]) =>
  `${things} ${i} and ${i + 1} ${gap < 0 ? `overlap by ${of(-gap)}` : `come ${of(gap)} apart`}, `
  + `and ${of(least)} is required`;
const PATH = 'it is for a shutter in the light’s path, and the set-up is emulated; there, ';

// Behind the name of the field that it is about; `of` tells a time.
const OF_FIELD = {
  beyond: () => 'it is beyond f32 (3.4e38 s)',
  lost: ([percent]) => {
    const off = `f32 is off by ${short(percent, 2)} % of the interval here`;
    return `${off}; count the times from nearer to the start of opening`;
  },
  finite: () => 'a finite number is required',
  positive: () => 'more than 0 is required',
  not_negative: () => '0 or more is required',
  whole: ([most]) => `a whole number from 1 to ${most} is required`,
  rate: () => 'a rate from 1 to 4294967295 is required',
  rate_too_high: ([most]) => `the interval is longer than 2^31 ticks; up to ${most} Hz it is not`,
  schedule: () => 'no timer counts so long an interval',
  bits: () => '16 or 32 is required',
  wraps: ([bits, by, hz]) => {
    const fits = `a prescaler of ${by} fits: a timer of ${short(hz, 10)} Hz`;
    return `the frame lasts longer than ${bits} bits can count; ${fits}`;
  },
  fully_open_pulses: () => 'they have a length of their own, and this lamp makes pulses',
  fully_open_never: () => 'this shutter begins to close as soon as it is open',
  fully_open_emulated: () => `${PATH}flashes without a length serve`,
  duty_emulated: () => `${PATH}equal pulses serve`,
  duty_and_pulse: () => 'a lamp has this or a length, not both',
  duty: () => 'above 0 and at most 1 is required',
  pulse_of_no_tick: ([hz]) => `it is less than half a tick of ${hz} Hz`,
  min_pulse: () => 'it goes with pulses of equal doses',
  spread: () => '0 or more is required, and a delay',
  falls: () => 'it goes with a delay',
  delay_too_long: () => 'the frame ends more than 2^31 ticks after the edge',
  before_edge: ([most, by, few], of, { delay }) => {
    const from = delay === null ? 'the start of opening' : 'the edge of the sync';
    const come = few > 1 ? `flashes 0 to ${few - 1} come` : 'flash 0 comes';
    return `${come} before ${from}, the first by ${of(by)}${most ? `; all of up to ${most} come behind it` : ''}`;
  },
  missing: () => 'it is required',
  times_in_path: () =>
    'what a shutter in the light’s path leaves of a flash comes from its curve, and no curve explains this trace',
};

// Without a name before it.
const OF_ALL = {
  close: ([most, ...two], of) => `${pair('flashes', of, two)}; ${many(most)}`,
  doses_close: ([most, ...two], of) => `${pair('pulses', of, two)}; ${many(most)}; a smaller lit share leaves more`,
  dose_short: ([most, i, lasts, least], of) => {
    const lasting = `pulse ${i} lasts ${of(lasts)}, and ${of(least)} is required`;
    return `${lasting}; ${many(most)}; a greater lit share lasts longer`;
  },
  pulses: ([most, length, longest, ...two], of) => {
    const reach = two.length ? pair('pulses', of, two) : 'they reach beyond the time that the shutter is open';
    const fit = longest > 0 ? `those of up to ${of(longest)} fit` : 'none is short enough';
    return `pulses of ${of(length)}: ${reach}; ${fit}${most ? `, or ${many(most)}` : ''}`;
  },
  unfit: ([most]) => `the frame does not fit; ${many(most)}`,
  times_early: ([i]) => `flash ${i} comes before the shutter opens`,
  times_late: ([i]) => `flash ${i} comes more than 2^31 ticks after the start of opening: take a slower timer`,
  times_out_of_order: ([i]) => `flash ${i + 1} comes before flash ${i}`,
  times_close: (two, of) => pair('flashes', of, two),
};

// A curve's errors, by their numbers; `ramp` and `point` are where it is.
const OF_CURVE = [
  () => 'times out of order: to open, to be open, to close, to be closed is the order',
  (x, ramp, point) => `${ramp}: the time of its ${point} inner point has to lie on the ramp, as a fraction of the `
    + `whole interval: 0 at the start, 1 at the end; it is ${x}`,
  (x, ramp, point) => `${ramp}: the openness of its ${point} inner point has to be in [0, 1]; it is ${x}`,
  (_, ramp) => `${ramp}: its first inner point is later than its second by more than 15/16 of the ramp; move them `
    + 'closer',
  (_, ramp) => `${ramp}: it is shorter than 2^-24 of the greatest time; make it longer, or give it no length`,
  () => 'the interval is too short for its distance from time 0: count times from a nearer origin',
  () => 'the interval is shorter than 2^-64 s or longer than 2^64 s',
  (_, ramp) => `${ramp}: a control point is beyond f32 (3.4e38)`,
];
const PARTS_OF_CURVE = { open_end: 'opening ramp', close_start: 'plateau', close_end: 'closing ramp' };

/** What is wrong: as the engine tells it, or in words already. */
export function told({ reason, code, key, inner, values }, scene) {
  if (reason) return reason;
  const of = (seconds) => `${short(seconds * perSecond(scene.unit), 4)} ${scene.unit}`;
  if (OF_FIELD[code]) return `${label(inner ? INNER[inner[0]] : key)}: ${OF_FIELD[code](values, of, scene)}`;
  if (OF_ALL[code]) return OF_ALL[code](values, of);
  const ramp = inner ? `${inner[0] < 4 ? 'opening' : 'closing'} ramp` : PARTS_OF_CURVE[key];
  return OF_CURVE[values[0]](short(values[1], 9), ramp, inner?.[0] % 4 < 2 ? 'first' : 'second');
}

// In the engine's order.
const REMEDIES = [
  (n) => [`Use ${n} flash${n > 1 ? 'es' : ''}`, { triggers: n }],
  () => ['Ask for no gap', { min_gap: 0 }],
  () => ['Take a timer of 32 bits', { timer_bits: null }],
  () => ['Use flashes without a length', { pulse: null, duty: null, min_pulse: null, fully_open: null }],
];

/** What would help, as [words, changes of the scene]: the engine has tried each. */
export const remedies = ({ remedies = [] }) => remedies.map(([i, n]) => REMEDIES[i](n));
