// A scene's numbers: as an object, as the part of the address behind '#', and as TOML.

import { keys as KEYS, units as UNITS } from 'presets';

/** The program's keys: the times, the ramps' control points, and what is set. */
const RAMPS = KEYS.indexOf('shutteropening');
export const TIMES = KEYS.slice(0, RAMPS), SETTINGS = KEYS.slice(RAMPS + 1);
export const INNER = ['t1', 'y1', 't2', 'y2', 't5', 'y5', 't6', 'y6'];
/** The numbers in the order of the engine's question. */
export const NUMBERS = [...TIMES, ...INNER, ...SETTINGS];
/** What is one of a few, in the engine's order; null is not said. */
export const CHOICES = { set_up: ['emulated', 'in_path'], sync_falls: [false, true], fully_open: [false, true] };
/** The numbers that have a field; those that are no times are of another kind. */
export const FIELDS = NUMBERS.filter((key) => !CHOICES[key]);
export const KINDS = { nominal: 'dial', triggers: 'count', timer_bits: 'count', timer_hz: 'rate', duty: 'part' };
for (const key of INNER) KINDS[key] = 'part';
const SPANS = SETTINGS.filter((key) => !CHOICES[key] && (!KINDS[key] || key === 'nominal'));
const REQUIRED = ['triggers', 'min_gap'];
export const LAMP = ['pulse', 'duty', 'min_pulse', 'fully_open'];
/** What a person has given who gives a whole scene. */
export const GIVEN = ['name', 'unit', 'lamp', ...SETTINGS.filter((key) => !LAMP.includes(key))];
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
  const [unit, times, inner] = [it.unit ?? 's', TIMES.map((key) => it[key]), it.shutteropening ?? null];
  const scene = { name, unit, times, inner, measured: null, doubts: [], untold: null, given: [] };
  for (const key of SETTINGS) scene[key] = it[key] ?? null;
  if (it.unit) return scene;
  // Without a unit, the largest that the interval has at least one of.
  const length = times[3] - times[0];
  return inUnit(scene, UNITS.find((unit) => length * perSecond(unit) >= 1) ?? 'ns');
}

/** The same scene with its times in another unit. */
export function inUnit(scene, unit) {
  const by = UNITS.indexOf(unit) - UNITS.indexOf(scene.unit);
  const factor = 1000 ** Math.abs(by);
  const convert = (x) => (x == null ? x : tidy(by < 0 ? x / factor : x * factor));
  const { times, measured } = scene;
  const converted = { ...scene, unit, times: times.map(convert), measured: measured?.map(convert) ?? null };
  for (const key of SPANS) converted[key] = convert(scene[key]);
  return converted;
}

/** Are two scenes of the same shutter, at the same times? */
export function isSamePlace(a, b) {
  const shape = (scene) => {
    const { times, inner, measured } = inUnit(scene, 'ns');
    return String([times, inner, measured]);
  };
  return shape(a) === shape(b);
}

/** Are they of the same shutter, be one later than the other? */
export function isSameShape(a, b) {
  const { times, measured, inner } = inUnit(b, a.unit);
  const room = 1e-9 * (a.times[3] - a.times[0]);
  const isNear = (t, i) => Math.abs(t - a.times[i] - times[0] + a.times[0]) <= room;
  return times.every(isNear) && String([a.inner, a.measured]) === String([inner, measured]);
}

/** From where its triggers' delay counts, in the scene's unit. */
const opensAt = ({ measured, times }) => (measured ? 0 : times[0]);

/** The time of the sync's edge in a scene that knows it, else null. */
export const edgeOf = (scene) => (scene.delay === null ? null : tidy(opensAt(scene) - scene.delay));

/** The inner control points; those of straight ramps where the scene has none. */
export function innerOf(scene) {
  return scene.inner ?? placed(STRAIGHT, scene.times);
}

/**
 * The scene with a shutter that is drawn: what was measured, and what was doubtful about that, is another's. The edge
 * of the sync stands still.
 */
export function withShape(scene, times, inner) {
  const doubts = scene.doubts.filter(({ about }) => about === 'delay'), edge = edgeOf(scene);
  const delay = edge === null ? null : tidy(times[0] - edge);
  return { ...scene, times, inner, delay, measured: null, untold: null, doubts };
}

/** The scene with the shutter that was fitted. The edge of the sync stands still. */
export function asFitted(scene, { times, inner, measured, untold, doubts }) {
  const edge = edgeOf(scene), delay = edge === null ? null : tidy(opensAt({ times, measured }) - edge);
  return { ...scene, times, inner, delay, measured, untold, doubts, ...(measured && { triggers: measured.length }) };
}

/** The scene with other inner control points. */
export const withInner = (scene, inner) => withShape(scene, scene.times, inner);

/**
 * The scene with another delay. The edge of the sync stands still, and the curve moves; where none is known yet, this
 * says where it is. Without a delay there is no edge to tell of.
 */
export function withDelay(scene, delay) {
  const doubts = scene.doubts.filter(({ about }) => about !== 'delay');
  if (delay === null) return { ...scene, delay, delay_spread: null, sync_falls: null, doubts };
  const by = scene.delay === null || scene.measured ? 0 : delay - scene.delay;
  const times = by ? scene.times.map((t) => tidy(t + by)) : scene.times;
  return { ...scene, times, delay, doubts };
}

export function lampOf({ pulse, duty, fully_open }) {
  return pulse !== null ? 'pulse' : duty !== null ? 'duty' : fully_open ? 'full' : '';
}

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
  const { inner } = scene;
  return withShape(scene, times, inner && isSound ? placed(relative(inner, scene.times), times) : inner);
}

/** The scene as the part of an address behind '#', with a table of speeds beside it if there is one. */
export function hash({ scene, speeds }) {
  const { name, unit, times, inner, measured, doubts, untold } = scene;
  const part = (key, value) => `${key}=${encodeURIComponent(value)}`;
  const parts = [part('name', name), part('unit', unit === 'µs' ? 'us' : unit), `times=${times}`];
  if (inner) parts.push(`inner=${inner}`);
  for (const key of SETTINGS) if (scene[key] !== null) parts.push(`${key}=${scene[key]}`);
  if (measured) parts.push(`measured=${measured}`);
  for (const { about, text } of doubts) parts.push(part('doubt', `${about}: ${text}`));
  if (untold) parts.push(part('untold', untold));
  if (speeds) parts.push(part('speeds', JSON.stringify(speeds)));
  return '#' + parts.join('&');
}

/** What such a part of an address holds; an error says what is wrong. */
export function fromAddress(text) {
  if (text.length > LONGEST) throw new Error(`it is ${text.length} characters long`);
  const parts = new URLSearchParams(text.replace(/^#/, ''));
  const speeds = parts.has('speeds') ? JSON.parse(parts.get('speeds')) : null;
  if (speeds && !(Array.isArray(speeds) && speeds.every(isSpeed))) {
    throw new Error('speeds: a name, a kind, doubts and numbers are required in each row');
  }
  return { scene: fromParts(parts), speeds };
}

function isSpeed(it) {
  const words = [it?.name, it?.kind, ...(it?.doubts ?? [null])];
  const numbers = [it?.exposure, it?.error, it?.scatter, it?.pulses];
  const isDial = it?.dial == null || (it.dial > 0 && it.dial < Infinity);
  return isDial && words.every((it) => typeof it === 'string') && numbers.every((x) => Number.isFinite(x) && x >= 0);
}

// `exposure: clipped`: what is doubtful, and about which number.
function fromDoubt(words) {
  const [, about, text] = /^(?:(\w+): )?(.*)$/s.exec(words);
  return { about: about ?? 'exposure', text };
}

function fromParts(parts) {
  const require = (key, what, is) => {
    if (!is) throw new Error(`${key}: ${what} required`);
  };
  const numbers = (key, count) => {
    const list = (parts.get(key) ?? '').split(',').map((x) => (x.trim() ? Number(x) : NaN));
    require(key, `${count} numbers are`, !count || list.length === count);
    require(key, 'a number is', !list.some(Number.isNaN));
    return list;
  };
  const unit = (parts.get('unit') ?? 's').replace('us', 'µs');
  require('unit', 's, ms, us or ns is', UNITS.includes(unit));
  const scene = {
    name: (parts.get('name') ?? '').slice(0, 60) || 'linked', unit, times: numbers('times', 4),
    inner: parts.has('inner') ? numbers('inner', 8) : null,
    measured: parts.has('measured') ? numbers('measured') : null,
    doubts: parts.getAll('doubt').map(fromDoubt), untold: parts.get('untold'), given: GIVEN,
  };
  for (const key of SETTINGS) {
    const all = CHOICES[key], is = REQUIRED.includes(key) || parts.has(key);
    scene[key] = !is ? null : all ? all.find((it) => String(it) === parts.get(key)) : numbers(key, 1)[0];
    require(key, `${all?.join(' or ')} is`, scene[key] !== undefined);
    require(key, 'a whole number is', !is || KINDS[key] !== 'count' || Number.isInteger(scene[key]));
  }
  const { measured, triggers } = scene;
  require('measured', `${triggers} times, one for each trigger, are`, !measured || measured.length === triggers);
  return scene;
}

/** What is doubtful about a scene, as comments. */
export const warnings = ({ doubts }) => doubts.map(({ text }) => `# Warning: ${text.replace(/\s+/g, ' ')}\n`).join('');

const inToml = (x) => (Math.abs(x) >= 1e15 ? x.toExponential().replace('Infinity', 'inf') : JSON.stringify(x));
/** What is to be fired, in a table of its own. */
const FLASHES = SETTINGS.filter((key) => key !== 'nominal');
const array = (numbers) => `[${numbers.map(inToml).join(', ')}]`;

/** The scene as the text that `shutter plan` reads: by its curve, or by the times that a trace tells. */
export function toml(scene) {
  const { name, unit, times, inner, measured } = scene;
  const entries = [['unit', `"${unit}"`], ...TIMES.map((key, i) => [key, inToml(times[i])])];
  if (measured) entries.splice(1, 4, ['open_start', 0], ['trigger_times', array(measured)]);
  else if (inner) entries.push(['shutteropening', array(inner)]);
  const isTold = (key) => scene[key] !== null && !(measured && key === 'triggers');
  entries.push(...SETTINGS.filter(isTold).map((key) => [key, inToml(scene[key])]));
  const table = (is) => entries.filter(([key]) => is(key)).map(([key, value]) => `${key} = ${value}\n`).join('');
  const head = `# ${name.replace(/[^\x20-\x7e]/g, '_')}\n${warnings(scene)}`;
  return `${head}[shutter]\n${table((key) => !FLASHES.includes(key))}\n[flashes]\n${table((key) => FLASHES.includes(key))}`;
}
