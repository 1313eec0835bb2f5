// Numbers as people write them: 1.5 and 1,5, 1/125, 2.5 ms, 1 MHz, but no separator of thousands, which in one country
// is the other's decimal mark.

import { perSecond, tidy } from './scene.js';

// What a unit makes of a number, and the units that are told of.
const SUFFIXES = {
  time: [{ s: 1, ms: 1e-3, us: 1e-6, ns: 1e-9 }, 's, ms, µs or ns'],
  rate: [{ hz: 1, khz: 1e3, mhz: 1e6, ghz: 1e9 }, 'Hz, kHz, MHz or GHz'],
  part: [{ '%': 0.01 }, '%'],
};

/**
 * The number in `text`; NaN for no text. It is of a `kind`: a `time` in the scene's `unit`, a `rate` in Hz, a `count`,
 * or a `part` of one. An error says what to write instead, which is the same number with the same unit.
 */
export function parse(text, kind = 'part', unit = 's') {
  const plain = text.trim().replace(/^[−–]/, '-');
  if (!plain) return NaN;
  const refuse = (words) => {
    throw new Error(`“${text.trim()}” ${words}`);
  };
  const [, digits, suffix] = /^(.*?\d[.,]?(?:e[+-]?\d+)?)\s*([a-zµμ%]*)$/i.exec(plain) ?? refuse('is no number');
  const instead = (words) => `${words}${suffix && ` ${suffix}`}`;
  const [, sign, whole, over, under] = /^(-?)(\d+)\s+(\d+)\s*\/\s*([1-9]\d*)$/.exec(digits) ?? [];
  if (under) refuse(`is written otherwise here: write ${instead(sign + tidy(Number(whole) + over / under, 7))}`);
  const parts = digits.split('/').map((part) => part.trim());
  if (parts.length > 2) refuse('is no number');
  const told = parts.map((part) => withoutThousands(part, refuse));
  if (String(told) !== String(parts)) refuse(`has a separator of thousands: write ${instead(told.join('/'))}`);
  // Whoever names a larger unit than Hz writes parts of it.
  const isWhole = kind === 'count' || (kind === 'rate' && /^(hz)?$/i.test(suffix));
  const other = (i) => (part) => instead(parts.with(i, part).join('/'));
  const [first, second] = parts.map((part, i) => one(part, isWhole, other(i), refuse));
  const number = second === undefined ? first : first / second;
  if (kind === 'count' && !Number.isInteger(number)) refuse('is no whole number');
  const name = suffix.toLowerCase().replace(/[µμ]/, 'u');
  // A fraction without a unit is a speed, as a dial has it: of a second.
  const of = name || (kind === 'time' && parts.length === 2 ? 's' : '');
  if (!of) return parts.length === 2 ? tidy(number, 7) : number;
  const [factors, known] = SUFFIXES[kind] ?? refuse('is no number');
  const factor = factors[of] ?? refuse(`has an unknown unit: ${known}`);
  return tidy(number * factor * (kind === 'time' ? perSecond(unit) : 1));
}

// The same digits without what parts thousands.
function withoutThousands(plain, refuse) {
  const marks = plain.replace(/[^.,]/g, '');
  if (!/\d[\s'’_]\d/.test(plain) && marks.length < 2) return plain;
  // Groups of three but for the first: any other is no number that could be told.
  const groups = /^[+-]?\d{1,3}(?:([\s'’_.,])\d{3})(?:\1\d{3})*(?:[.,]\d*)?$/.exec(plain);
  if (!groups) refuse('is no number');
  // The last mark is that of the decimals if it stands alone and parts no thousands.
  const last = marks.at(-1);
  const mark = last && last !== groups[1] ? plain.lastIndexOf(last) : plain.length;
  return plain.slice(0, mark).replace(/[.,\s'’_]/g, '') + plain.slice(mark).replace(',', '.');
}

function one(plain, isWhole, instead, refuse) {
  if (/^[+-]?[1-9]\d{0,2},\d{3}$/.test(plain) || (isWhole && /^[+-]?[1-9]\d{0,2}\.\d{3}$/.test(plain))) {
    const [small, large] = [Number(plain.replace(',', '.')), plain.replace(/[.,]/, '')];
    refuse(`may be ${instead(small)} or ${instead(large)}: write one of them`);
  }
  const number = plain.replace(',', '.');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(number)) refuse('is no number');
  return Number(number);
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
