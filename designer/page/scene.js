// A scene's numbers: as an object, as the part of the address behind '#', and as TOML.

import { KEYS, UNITS } from './presets.js';

export const TIMES = ['open_start', 'open_end', 'close_start', 'close_end'];
export const INNER = ['t1', 'y1', 't2', 'y2', 't5', 'y5', 't6', 'y6'];
/** The numbers that a person writes, in the order of the engine's question. */
export const NUMBERS = KEYS.flatMap((key) => (key === 'shutteropening' ? INNER : key));
export const OPTIONAL = ['timer_hz', 'timer_bits', 'nominal', 'pulse', 'duty', 'min_pulse', 'delay', 'delay_spread', 'lamp_lag'];
export const COUNTS = ['triggers', 'min_gap'];
/** What is one of a few, in the engine's order; null is not said. */
export const CHOICES = { set_up: ['emulated', 'in_path'], sync_falls: [false, true], fully_open: [false, true] };
/** The numbers that have a field. */
export const FIELDS = NUMBERS.filter((key) => !CHOICES[key]);
export const LAMP = ['pulse', 'duty', 'min_pulse', 'fully_open'];
/** Those that count something. */
export const WHOLE = ['triggers', 'timer_bits'];
/** The numbers that are times, beside those of the curve. */
export const SPANS = ['min_gap', 'nominal', 'pulse', 'min_pulse', 'delay', 'delay_spread', 'lamp_lag'];
/** What a person has given who gives a whole scene. */
export const GIVEN = ['name', 'unit', 'triggers', 'timer_hz', 'timer_bits', 'min_gap', 'lamp', 'set_up', 'lamp_lag'];
const STRAIGHT = [1 / 3, 1 / 3, 2 / 3, 2 / 3, 1 / 3, 2 / 3, 2 / 3, 1 / 3];
/** A longer part of an address is no link of this page's. */
const LONGEST = 60_000;

/** So many flashes the slider has: each of its steps is another number. */
export const STOPS = [...new Set(Array.from({ length: 81 }, (_, i) => Math.round(2 ** (i / 10))))];

/** Can so many flashes be asked for? */
export const isCount = (n) => Number.isInteger(n) && n > 0 && n <= 10_000;

export const perSecond = (unit) => 1000 ** UNITS.indexOf(unit);

/** A number without the digits that a division or a product of it left behind. */
export const tidy = (x, digits = 12) => Number(x.toPrecision(digits));

/** `x` to so many significant digits, as text. */
export function short(x, digits = 5) {
  if (!Number.isFinite(x)) return String(x);
  if (x !== 0 && (Math.abs(x) < 1e-6 || Math.abs(x) >= 1e12)) return x.toExponential(digits - 1);
  return String(Number(x.toPrecision(digits)));
}

/** A scene as `shutter` keeps it, as an object of this page. Nobody has given any of its numbers yet. */
export function fromScene(name, it) {
  const unit = it.unit ?? 's';
  const scene = { name, unit, times: TIMES.map((key) => it[key]), inner: it.shutteropening ?? null, measured: null, doubts: [], untold: null, spare: {}, given: [] };
  for (const key of COUNTS) scene[key] = it[key];
  for (const key of [...OPTIONAL, ...Object.keys(CHOICES)]) scene[key] = it[key] ?? null;
  if (it.unit) return scene;
  // Without a unit, the largest that the interval has at least one of.
  const length = scene.times[3] - scene.times[0];
  return inUnit(scene, UNITS.find((unit) => length * perSecond(unit) >= 1) ?? 'ns');
}

/** The same scene with its times in another unit. */
export function inUnit(scene, unit) {
  const by = UNITS.indexOf(unit) - UNITS.indexOf(scene.unit);
  const factor = 1000 ** Math.abs(by);
  const convert = (x) => (x == null ? x : tidy(by < 0 ? x / factor : x * factor));
  const { spare } = scene;
  const converted = { ...scene, unit, times: scene.times.map(convert), measured: scene.measured?.map(convert) ?? null };
  converted.spare = { ...spare, pulse: convert(spare.pulse), min_pulse: convert(spare.min_pulse) };
  for (const key of SPANS) converted[key] = convert(scene[key]);
  return converted;
}

/** Are two scenes of the same shutter? */
export function isSameShape(a, b) {
  const shape = (scene) => String([inUnit(scene, 'ns').times, scene.inner, scene.measured && inUnit(scene, 'ns').measured]);
  return shape(a) === shape(b);
}

/** The inner control points; those of straight ramps where the scene has none. */
export function innerOf(scene) {
  return scene.inner ?? placed(STRAIGHT, scene.times);
}

/** The scene with other inner control points. */
export const withInner = (scene, inner) => ({ ...scene, inner, measured: null, untold: null });

export const lampOf = (scene) => (scene.pulse !== null ? 'pulse' : scene.duty !== null ? 'duty' : scene.fully_open ? 'full' : '');

/** The inner control points as parts of their own ramps. */
function relative(inner, times) {
  const length = times[3] - times[0];
  return inner.map((x, i) => {
    if (i % 2) return x;
    const [from, to] = i < 4 ? times : times.slice(2);
    return to > from ? (times[0] + x * length - from) / (to - from) : STRAIGHT[i];
  });
}

/** Parts of ramps as fractions of the interval. */
function placed(parts, times) {
  const length = times[3] - times[0];
  return parts.map((x, i) => {
    if (i % 2) return x;
    const [from, to] = i < 4 ? times : times.slice(2);
    return length > 0 ? tidy((from + x * (to - from) - times[0]) / length, 7) : 0;
  });
}

/** The scene with other times, each ramp keeping its shape. */
export function withTimes(scene, times) {
  const isSound = times.every(Number.isFinite) && times[3] > times[0];
  const along = (inner) => (inner && isSound ? placed(relative(inner, scene.times), times) : inner);
  return { ...withInner(scene, along(scene.inner)), times, spare: { ...scene.spare, inner: along(scene.spare.inner) } };
}

/** The scene as the part of an address behind '#', with a table of speeds beside it if there is one. */
export function hash({ scene, speeds }) {
  const part = (key, value) => `${key}=${encodeURIComponent(value)}`;
  const parts = [part('name', scene.name), part('unit', scene.unit === 'µs' ? 'us' : scene.unit), `times=${scene.times}`];
  if (scene.inner) parts.push(`inner=${scene.inner}`);
  for (const key of [...COUNTS, ...OPTIONAL, ...Object.keys(CHOICES)]) if (scene[key] !== null) parts.push(`${key}=${scene[key]}`);
  if (scene.measured) parts.push(`measured=${scene.measured}`);
  for (const { about, text } of scene.doubts) parts.push(part('doubt', `${about}: ${text}`));
  if (scene.untold) parts.push(part('untold', scene.untold));
  if (speeds) parts.push(part('speeds', JSON.stringify(speeds)));
  return '#' + parts.join('&');
}

/** What such a part of an address holds; an error says what is wrong. */
export function fromAddress(text) {
  const parts = new URLSearchParams(text.replace(/^#/, ''));
  const speeds = parts.has('speeds') ? JSON.parse(parts.get('speeds')) : null;
  if (speeds && !(Array.isArray(speeds) && speeds.every(isSpeed))) throw new Error('speeds: a name, a kind, doubts and numbers are required in each row');
  return { scene: fromHash(text), speeds };
}

// `exposure: clipped`: what is doubtful, and about which number.
function fromDoubt(words) {
  const [, about, text] = /^(?:(\w+): )?(.*)$/s.exec(words);
  return { about: about ?? 'exposure', text };
}

const isSpeed = (it) => [it?.name, it?.kind, ...(it?.doubts ?? [null])].every((words) => typeof words === 'string')
  && [it.exposure, it.error, it.scatter, it.pulses, it.dial ?? 0].every(Number.isFinite);

function fromHash(text) {
  if (text.length > LONGEST) throw new Error(`it is ${text.length} characters long`);
  const parts = new URLSearchParams(text.replace(/^#/, ''));
  const numbers = (key, count) => {
    const list = (parts.get(key) ?? '').split(',').map((x) => (x.trim() ? Number(x) : NaN));
    if (count && list.length !== count) throw new Error(`${key}: ${count} numbers are required, not ${parts.has(key) ? list.length : 0}`);
    if (list.some(Number.isNaN)) throw new Error(`${key}: a number is required`);
    return list;
  };
  const unit = (parts.get('unit') ?? 's').replace('us', 'µs');
  if (!UNITS.includes(unit)) throw new Error('unit: s, ms, us or ns is required');
  const name = (parts.get('name') ?? '').slice(0, 60) || 'linked';
  const scene = { name, unit, times: numbers('times', 4), inner: parts.has('inner') ? numbers('inner', 8) : null, measured: null, doubts: parts.getAll('doubt').map(fromDoubt), untold: parts.get('untold'), spare: {}, given: GIVEN };
  for (const key of COUNTS) [scene[key]] = numbers(key, 1);
  for (const key of OPTIONAL) scene[key] = parts.has(key) ? numbers(key, 1)[0] : null;
  for (const [key, all] of Object.entries(CHOICES)) {
    scene[key] = parts.has(key) ? all.find((it) => String(it) === parts.get(key)) : null;
    if (scene[key] === undefined) throw new Error(`${key}: ${all.join(' or ')} is required`);
  }
  for (const key of WHOLE) if (scene[key] !== null && !Number.isInteger(scene[key])) throw new Error(`${key}: a whole number is required`);
  if (parts.has('measured')) scene.measured = numbers('measured');
  if (scene.measured && scene.measured.length !== scene.triggers) throw new Error(`measured: ${scene.triggers} times are required, one for each trigger`);
  return scene;
}

const inToml = (x) => (x === Infinity ? 'inf' : x === -Infinity ? '-inf' : Math.abs(x) >= 1e15 ? x.toExponential() : String(x));
const array = (numbers) => `[${numbers.map(inToml).join(', ')}]`;

/** The scene as the text that `shutter plan` reads: by its curve, or by the times that a trace tells. */
export function toml(scene) {
  const { measured } = scene;
  const lines = [`# ${scene.name.replace(/[^\x20-\x7e]/g, '_')}`, ...scene.doubts.map(({ text }) => `# Warning: ${text.replace(/\s+/g, ' ')}`), `unit = "${scene.unit}"`];
  if (measured) lines.push('open_start = 0', `trigger_times = ${array(measured)}`);
  else TIMES.forEach((key, i) => lines.push(`${key} = ${inToml(scene.times[i])}`));
  if (scene.inner && !measured) lines.push(`shutteropening = ${array(scene.inner)}`);
  for (const key of [...COUNTS, ...OPTIONAL]) if (scene[key] !== null && !(measured && key === 'triggers')) lines.push(`${key} = ${inToml(scene[key])}`);
  for (const key of Object.keys(CHOICES)) if (scene[key] !== null) lines.push(`${key} = ${JSON.stringify(scene[key])}`);
  return lines.join('\n') + '\n';
}
