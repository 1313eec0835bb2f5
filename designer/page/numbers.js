// Numbers as people write them: 1.5 and 1,5, 1/125, 2.5 ms, 1 MHz, but no separator of thousands, which in one country is the
// other's decimal mark.

import { perSecond, tidy } from './scene.js';

const RATES = { hz: 1, khz: 1e3, mhz: 1e6, ghz: 1e9 };
const TIMES = { s: 1, ms: 1e-3, us: 1e-6, ns: 1e-9 };

/**
 * The number in `text`; NaN for no text. It is of a `kind`: a `time` in the scene's `unit`, a `rate` in Hz, a `count`, or a
 * `part` of one. An error says what to write instead.
 */
export function parse(text, kind = 'part', unit = 's') {
  const plain = text.trim().replace(/^[−–]/, '-');
  if (!plain) return NaN;
  const refuse = (words) => {
    throw new Error(`“${text.trim()}” ${words}`);
  };
  const [, digits, suffix] = /^(.*?\d[.,]?(?:e[+-]?\d+)?)\s*([a-zµμ%]*)$/i.exec(plain) ?? refuse('is no number');
  const parts = digits.split('/').map((part) => one(part.trim(), kind === 'count' || kind === 'rate', refuse));
  if (parts.length > 2) refuse('is no number');
  const number = parts.length === 2 ? parts[0] / parts[1] : parts[0];
  const name = suffix.toLowerCase().replace(/[µμ]/, 'u');
  // A fraction without a unit is a speed, as a dial has it: of a second.
  if (kind === 'time' && (name || parts.length === 2)) return tidy(number * (TIMES[name || 's'] ?? refuse('has an unknown unit: s, ms, µs or ns')) * perSecond(unit));
  if (kind === 'rate' && name) return tidy(number * (RATES[name] ?? refuse('has an unknown unit: Hz, kHz, MHz or GHz')));
  if (kind === 'part' && name === '%') return tidy(number / 100);
  if (name) refuse('is no number');
  return parts.length === 2 ? tidy(number, 7) : number;
}

function one(plain, isWhole, refuse) {
  const marks = plain.replace(/[^.,]/g, '');
  if (/\d[\s'’_]\d/.test(plain) || marks.length > 1) {
    // The last mark is that of the decimals if it stands alone; whatever else parts digits parts thousands.
    const last = marks.at(-1);
    const mark = marks.split(last).length === 2 ? plain.lastIndexOf(last) : plain.length;
    refuse(`has a separator of thousands: write ${plain.slice(0, mark).replace(/[.,\s'’_]/g, '')}${plain.slice(mark).replace(',', '.')}`);
  }
  if (/^[+-]?[1-9]\d{0,2},\d{3}$/.test(plain) || (isWhole && /^[+-]?[1-9]\d{0,2}\.\d{3}$/.test(plain))) {
    refuse(`may be ${Number(plain.replace(',', '.'))} or ${plain.replace(/[.,]/, '')}: write one of them`);
  }
  const number = plain.replace(',', '.');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(number)) refuse('is no number');
  return Number(number);
}
