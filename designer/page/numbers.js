// Numbers as people write them: 1.5 and 1,5, 1/125, 2.5 ms, 1 MHz, but no separator of thousands, which in one country
// is the other's decimal mark.

import { perSecond, short, tidy } from './scene.js';

const DIGITS = '([+-]?(?:\\d+[.,]?\\d*|[.,]\\d+)(?:e[+-]?\\d+)?)';
const NUMBER = new RegExp(`^${DIGITS}(?:\\s*/\\s*${DIGITS})?\\s*([a-zµμ%]*)$`, 'i');
// What a unit makes of a number, and the units that are told of.
const SUFFIXES = {
  time: [{ s: 1, ms: 1e-3, us: 1e-6, ns: 1e-9 }, 's, ms, µs or ns'],
  rate: [{ hz: 1, khz: 1e3, mhz: 1e6, ghz: 1e9 }, 'Hz, kHz, MHz or GHz'],
  part: [{ '%': 0.01 }, '%'],
};
SUFFIXES.dial = SUFFIXES.time;

/** A speed as a dial has it: from a third of a second on, seconds are what it shows. */
export const dial = (s) => (s < 0.3 ? `1/${1 / s < 100 ? short(1 / s, 3) : Math.round(1 / s)}` : short(s, 3));

/**
 * The number in `text`; NaN for no text. It is of a `kind`: a `time` in the scene's `unit`, a `dial`'s speed in the
 * same, of which 500 is 1/500, a `rate` in Hz, a `count`, or a `part` of one. An error says why there is none.
 */
export function parse(text, kind = 'part', unit = 's') {
  const plain = text.trim().replace(/^[−–]/, '-');
  if (!plain) return NaN;
  const refuse = (words) => {
    throw new Error(`“${text.trim()}” ${words}`);
  };
  const found = NUMBER.exec(plain) ?? refuse('is no number: write it as 1500, 1.5, 1/125 or 2.5 ms');
  const [, over, under, suffix] = found;
  // Whoever names a larger unit than Hz writes parts of it.
  const isWhole = kind === 'count' || (kind === 'rate' && /^(hz)?$/i.test(suffix));
  const [first, second] = [over, under].map((part) => {
    if (/^[+-]?[1-9]\d{0,2},\d{3}$/.test(part) || (isWhole && /^[+-]?[1-9]\d{0,2}\.\d{3}$/.test(part))) {
      const [small, large] = [Number(part.replace(',', '.')), part.replace(/[.,]/, '')];
      refuse(`may mean ${small} or ${large}: write one of them`);
    }
    return part && Number(part.replace(',', '.'));
  });
  const number = under ? first / second : first;
  if (!Number.isFinite(number)) refuse('is beyond all numbers');
  if (kind === 'count' && !Number.isInteger(number)) refuse('is no whole number');
  const isTime = kind === 'time' || kind === 'dial';
  // A fraction without a unit is of a second; so is what a dial has, and a whole number on it is the part below 1.
  const name = suffix.toLowerCase().replace(/[µμ]/, 'u') || (kind === 'dial' || (isTime && under) ? 's' : '');
  if (!name) return under ? tidy(number, 7) : number;
  const [factors, known] = SUFFIXES[kind] ?? refuse('is no number');
  const factor = factors[name] ?? refuse(`has an unknown unit: ${known}`);
  const isPart = kind === 'dial' && !suffix && !under && number > 1 && Number.isInteger(number);
  return tidy((isPart ? 1 / number : number) * factor * (isTime ? perSecond(unit) : 1));
}

/** What a field of its own takes when it is changed: a number, or null for none. Other texts are told at the field. */
export const taken = (kind, take, unit, isGood = () => true) => ({ target }) => {
  let told = '', x;
  try {
    x = parse(target.value, kind, unit);
    if (!Number.isNaN(x) && !isGood(x)) told = 'more than 0 is required';
  } catch (error) {
    told = error.message;
  }
  target.setCustomValidity(told);
  if (told) target.reportValidity();
  else take(Number.isNaN(x) ? null : x);
};
