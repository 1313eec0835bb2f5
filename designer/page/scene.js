// A scene as the program has it, with what the page knows beside; as a reader counts its times; as a link.

import { units as UNITS } from 'presets';

export const TIMES = ['open_start', 'open_end', 'close_start', 'close_end'];
export const INNER = ['t1', 'y1', 't2', 'y2', 't5', 'y5', 't6', 'y6'];
/** The program's keys, and of which kind their values are. */
const SYNC = { delay: 'time', delay_spread: 'time', sync_falls: 'yes' };
const SHUTTER = { ...SYNC, sync_settles: 'time', nominal: 'dial' };
const FLASHES = {
  triggers: 'count', min_gap: 'time', timer_hz: 'rate', timer_bits: 'count', set_up: ['emulated', 'in_path'],
  pulse: 'time', duty: 'part', min_pulse: 'time', fully_open: 'yes', lamp_lag: 'time', ...SYNC,
};
export const KINDS = { ...FLASHES, ...SHUTTER };
for (const key of TIMES) KINDS[key] = 'time';
for (const key of INNER) KINDS[key] = 'part';
/** What the page calls them. */
const WORDS = {
  open_start: 'starts to open at', open_end: 'fully open at', close_start: 'starts to close at', close_end: 'closed at',
  triggers: 'how many', timer_hz: 'timer, Hz', timer_bits: 'timer, bits', min_gap: 'least gap',
  nominal: 'speed on the dial', delay: 'sync delay', delay_spread: 'sync delay’s spread', sync_falls: 'the sync',
  sync_settles: 'sync settles after', set_up: 'set-up', lamp_lag: 'lamp’s lag', pulse: 'length', duty: 'duty',
  min_pulse: 'least length', fully_open: 'flashes while fully open',
};
export const label = (key) => WORDS[key] ?? key;
/** What is one of a few. */
export const CHOICES = { set_up: FLASHES.set_up, sync_falls: [false, true], fully_open: [false, true] };
/** The numbers that have a field. */
export const FIELDS = Object.keys(KINDS).filter((key) => !CHOICES[key]);
export const LAMP = ['pulse', 'duty', 'min_pulse', 'fully_open'];
/** What a person has given who gives a whole scene. */
export const GIVEN = ['name', 'unit', 'lamp', ...Object.keys({ ...SHUTTER, ...FLASHES })];
/** What is a time, of a scene, a fit and a trace's own triggers. */
const SPANS = new Set(['exposure', 'exposure_error', 'delay_error', 'trigger_error', 'delay_worst', 'trigger_times',
  ...Object.keys(KINDS).filter((key) => ['time', 'dial'].includes(KINDS[key]))]);
const STRAIGHT = [1 / 3, 1 / 3, 2 / 3, 2 / 3, 1 / 3, 2 / 3, 2 / 3, 1 / 3];
/** A longer part of an address is no link of this page's. */
const LONGEST = 60_000;

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

/** All of a table, in the order of the program. */
const whole = (table, keys) => Object.fromEntries(keys.map((key) => [key, table[key] ?? null]));

/**
 * The program's scene as one of this page: { name, unit, shutter, flashes }, all times in its unit; `own`, the triggers
 * of a trace that its curve does not explain; and which keys are `given`.
 */
export function fromScene(name, { shutter, flashes }) {
  const unit = shutter.unit ?? flashes.unit;
  const keys = [...TIMES, 'shutteropening', ...Object.keys(SHUTTER), 'measured'];
  const scene = { name, unit: unit ?? 's', shutter: whole(shutter, keys), flashes: whole(flashes, Object.keys(FLASHES)),
    own: null, given: [] };
  // Of two units, that of the shutter.
  if (flashes.unit && flashes.unit !== unit) scene.flashes = inUnit({ ...scene, unit: flashes.unit }, unit).flashes;
  if (unit) return scene;
  // Without one, the largest that the interval has at least one of.
  const length = shutter.close_end - shutter.open_start;
  return inUnit(scene, UNITS.find((unit) => length * perSecond(unit) >= 1) ?? 'ns');
}

/** The scene as the program takes it. */
export function toProgram({ unit, shutter, flashes, own }) {
  const { open_start, open_end, close_start, close_end, shutteropening, ...rest } = shutter;
  const of = own ? { ...own, ...rest } : shutter;
  return { shutter: { unit, ...of }, flashes: { unit, ...flashes } };
}

/** The same scene with its times in another unit. */
export function inUnit(scene, unit) {
  const by = UNITS.indexOf(unit) - UNITS.indexOf(scene.unit), factor = 1000 ** Math.abs(by);
  if (!by) return scene;
  const convert = (x) => (x == null ? x : tidy(by < 0 ? x / factor : x * factor));
  const told = (table) => table && Object.fromEntries(Object.entries(table).map(([key, x]) =>
    [key, !SPANS.has(key) ? x : Array.isArray(x) ? x.map(convert) : convert(x)]));
  const { shutter, flashes, own } = scene, { measured } = shutter;
  return {
    ...scene, unit, flashes: told(flashes), own: told(own),
    shutter: { ...told(shutter), measured: measured && { ...told(measured), unit } },
  };
}

/** Are two scenes of the same shutter, at the same times? */
export function isSameShape(a, b) {
  const shape = ({ shutter, own }) =>
    JSON.stringify([...TIMES.map((key) => shutter[key]), shutter.shutteropening, own]);
  return shape(inUnit(a, 'ns')) === shape(inUnit(b, 'ns'));
}

/** What the scene tells of its sync: what a person does, in place of what its trace does. */
export function syncOf({ shutter, flashes }) {
  const traced = flashes.delay === null ? shutter : {};
  return Object.fromEntries(Object.keys(SYNC).map((key) => [key, flashes[key] ?? traced[key] ?? null]));
}

/** From where times are counted: from the sync's edge where that is known, or as the scene does. */
export function originOf(scene) {
  const { delay } = syncOf(scene), opens = (scene.own ?? scene.shutter).open_start;
  return delay === null ? 0 : opens - delay;
}

/** The same in seconds. */
export const originSeconds = (scene) => originOf(scene) / perSecond(scene.unit);

/** The curve's times, counted from there. */
export function timesOf(scene) {
  const origin = originOf(scene);
  return TIMES.map((key) => tidy(scene.shutter[key] - origin));
}

/** The inner control points; those of straight ramps where the scene has none. */
export const innerOf = (scene) => scene.shutter.shutteropening ?? placed(STRAIGHT, timesOf(scene));

/**
 * The scene with a shutter that is drawn: what was measured, and what was doubtful about that, is another's. The edge
 * of the sync stands still, so the delay ends at the new opening.
 */
function withShape(scene, times, inner) {
  const origin = originOf(scene), { shutter, flashes } = scene;
  const told = TIMES.map((key, i) => [key, tidy(times[i] + origin)]);
  const drawn = { ...shutter, ...Object.fromEntries(told), shutteropening: inner, measured: null };
  const next = { ...scene, shutter: drawn, own: null };
  if (flashes.delay !== null) next.flashes = { ...flashes, delay: times[0] };
  else if (shutter.delay !== null) drawn.delay = times[0];
  return next;
}

/** The scene with other inner control points. */
export const withInner = (scene, inner) => withShape(scene, timesOf(scene), inner);

/** The scene with other times, each ramp keeping its shape. */
export function withTimes(scene, times) {
  const isSound = times.every(Number.isFinite) && times[3] > times[0], inner = scene.shutter.shutteropening;
  return withShape(scene, times, inner && isSound ? placed(relative(inner, timesOf(scene)), times) : inner);
}

/** The scene with the shutter of a fit; the edge of the sync stands still. */
export function asFitted(scene, { shutter, own }) {
  const next = { ...scene, shutter: { ...shutter, nominal: scene.shutter.nominal }, own };
  const delay = scene.flashes.delay === null ? null : tidy((own ?? shutter).open_start - originOf(scene));
  const triggers = own ? own.trigger_times.length : scene.flashes.triggers;
  return { ...next, flashes: { ...scene.flashes, delay, triggers } };
}

/** The value of a field. */
export function valueOf(scene, id) {
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  if (i >= 0) return timesOf(scene)[i];
  if (k >= 0) return innerOf(scene)[k];
  return id in SYNC ? syncOf(scene)[id] : (scene[id in FLASHES ? 'flashes' : 'shutter'][id] ?? null);
}

/**
 * The scene with other values of fields, but the curve's. A delay that is typed is a person's own: it goes in place of
 * the trace's, and the times, which count from the edge, follow it. Without one there is no edge to tell of.
 */
export function withValues(scene, values) {
  let { shutter, flashes } = scene;
  for (const [key, value] of Object.entries(values)) {
    if (key === 'delay') {
      const { sync_falls, delay_spread } = syncOf({ shutter, flashes });
      const none = { delay: null, delay_spread: null, sync_falls: null }, { measured } = shutter;
      // What a trace tells stays beside what counts.
      if (!measured || value === null) shutter = { ...shutter, ...none };
      if (value === null) shutter = { ...shutter, sync_settles: null };
      if (measured && value === null) {
        const { sync, delay_error, trigger_error, delay_worst, shots, ...rest } = measured;
        shutter.measured = rest;
      }
      const kept = { sync_falls, delay_spread: measured ? flashes.delay_spread : delay_spread };
      flashes = { ...flashes, ...(value === null ? none : kept), delay: value };
    } else if (key in FLASHES) flashes = { ...flashes, [key]: value };
    else shutter = { ...shutter, [key]: value };
  }
  return { ...scene, shutter, flashes };
}

/** A scene with values that a person gives, which are theirs from now on. */
export function given(scene, keys) {
  const told = keys.map((key) => (LAMP.includes(key) ? 'lamp' : key));
  return { ...scene, given: [...new Set([...scene.given, ...told])] };
}

export function lampOf({ flashes: { pulse, duty, fully_open } }) {
  return pulse !== null ? 'pulse' : duty !== null ? 'duty' : fully_open ? 'full' : '';
}

// Inner control points whose times are told otherwise: by what `of` makes of each, on a ramp from one time to another.
const retold = (inner, times, of) =>
  inner.map((x, i) => (i % 2 ? x : of(x, times[i < 4 ? 0 : 2], times[i < 4 ? 1 : 3], i)));

/** The inner control points as parts of their own ramps. */
function relative(inner, times) {
  const at = (x) => times[0] + x * (times[3] - times[0]);
  return retold(inner, times, (x, from, to, i) => (to > from ? (at(x) - from) / (to - from) : STRAIGHT[i]));
}

/** Parts of ramps as fractions of the interval. */
function placed(parts, times) {
  const length = times[3] - times[0];
  const part = (x, from, to) => (length > 0 ? tidy((from + x * (to - from) - times[0]) / length, 7) : 0);
  return retold(parts, times, part);
}

/** The scene as the part of an address behind '#', with a table of speeds beside it if there is one. */
export const hash = ({ scene: { given, ...scene }, speeds }) =>
  `#${encodeURI(JSON.stringify({ ...scene, speeds }, (_, it) => it ?? undefined))}`;

/** What such a part of an address holds; an error says what cannot be drawn. All else the program refuses. */
export function fromAddress(text) {
  const require = (key, is) => {
    if (!is) throw new Error(`${key}: no scene has this`);
  };
  require(`${text.length} characters`, text.length <= LONGEST);
  const { name, unit, shutter, flashes, own = null, speeds = null } = JSON.parse(decodeURI(text.slice(1)));
  require('unit', UNITS.includes(unit));
  const told = { shutter: { ...shutter, unit }, flashes: { ...flashes, unit } };
  const scene = { ...fromScene(String(name ?? 'linked').slice(0, 60), told), own, given: GIVEN };
  const isNumbers = (list, n) => Array.isArray(list) && list.length === n && list.every(Number.isFinite);
  const { shutter: { shutteropening: inner }, flashes: { triggers } } = scene;
  for (const key of FIELDS) {
    require(key, [scene.shutter, scene.flashes].every((it) => it[key] == null || Number.isFinite(it[key])));
  }
  require('times', isNumbers(TIMES.map((key) => scene.shutter[key]), 4));
  require('shutteropening', inner === null || isNumbers(inner, 8));
  require('own', own === null || (Number.isFinite(own.open_start) && isNumbers(own.trigger_times, triggers)));
  require('speeds', speeds === null || (Array.isArray(speeds) && speeds.every(isSpeed)));
  return { scene, speeds };
}

function isSpeed(it) {
  const words = [it?.name, it?.kind, ...(it?.doubts ?? [null])];
  const isDial = [it?.near, it?.dial].every((x) => x == null || (x > 0 && x < Infinity));
  const numbers = [it?.exposure, it?.error, it?.scatter, it?.pulses];
  return isDial && words.every((it) => typeof it === 'string') && numbers.every((x) => Number.isFinite(x) && x >= 0);
}
