// A scene's numbers: as an object, as TOML, as the part of the address behind '#'.

export const UNITS = ['s', 'ms', 'µs', 'ns'];
export const TIMES = ['open_start', 'open_end', 'close_start', 'close_end'];
export const INNER = ['t1', 'y1', 't2', 'y2', 't5', 'y5', 't6', 'y6'];
export const OPTIONAL = ['nominal', 'pulse', 'duty', 'min_pulse', 'delay'];
const COUNTS = ['triggers', 'timer_hz', 'min_gap'];
const STRAIGHT = [1 / 3, 1 / 3, 2 / 3, 2 / 3, 1 / 3, 2 / 3, 2 / 3, 1 / 3];

export const perSecond = (unit) => 1000 ** UNITS.indexOf(unit);

/** A number without the digits that a division or a product of it left behind. */
export const tidy = (x, digits = 12) => Number(x.toPrecision(digits));

/** `x` to so many significant digits, as text. */
export function short(x, digits = 5) {
  if (!Number.isFinite(x)) return String(x);
  if (x !== 0 && (Math.abs(x) < 1e-6 || Math.abs(x) >= 1e12)) return x.toExponential(digits - 1);
  return String(Number(x.toPrecision(digits)));
}

/** A scene as `shutter` keeps it, as an object of this page. */
export function fromScene(name, it) {
  const unit = it.unit ?? 's';
  const scene = { name, unit, times: TIMES.map((key) => it[key]), inner: it.shutteropening ?? null, spare: {} };
  for (const key of COUNTS) scene[key] = it[key];
  for (const key of OPTIONAL) scene[key] = it[key] ?? null;
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
  const converted = { ...scene, unit, times: scene.times.map(convert) };
  const { spare } = scene;
  converted.spare = { ...spare, pulse: convert(spare.pulse), min_pulse: convert(spare.min_pulse) };
  for (const key of ['min_gap', 'nominal', 'pulse', 'min_pulse', 'delay']) converted[key] = convert(scene[key]);
  return converted;
}

/** The inner control points; those of straight ramps where the scene has none. */
export function innerOf(scene) {
  return scene.inner ?? placed(STRAIGHT, scene.times);
}

/** The scene with straight ramps, or again with those that it had before. */
export function straight(scene, isStraight) {
  const { inner, spare } = scene;
  return isStraight ? { ...scene, inner: null, spare: { ...spare, inner } } : { ...scene, inner: spare.inner ?? innerOf(scene) };
}

/** The scene with another lamp, whose numbers are those that it had before; `length` is that of its first pulses. */
export function withLamp(scene, kind, length) {
  const { pulse, duty, min_pulse } = scene;
  const spare = { ...scene.spare, ...(pulse !== null && { pulse }), ...(duty !== null && { duty, min_pulse }) };
  const next = { ...scene, spare, pulse: null, duty: null, min_pulse: null };
  if (kind === 'pulse') next.pulse = spare.pulse ?? length;
  if (kind === 'duty') [next.duty, next.min_pulse] = [spare.duty ?? 0.3, spare.min_pulse ?? null];
  return next;
}

export const lampOf = (scene) => (scene.pulse !== null ? 'pulse' : scene.duty !== null ? 'duty' : '');

/** The inner control points as parts of their own ramps. */
function relative(inner, times) {
  const length = times[3] - times[0];
  return inner.map((x, i) => {
    if (i % 2) return x;
    const [from, to] = i < 4 ? times : times.slice(2);
    return to > from ? (times[0] + x * length - from) / (to - from) : STRAIGHT[i];
  });
}

/** Parts of ramps as fractions of the interval; what lies on its ramp stays there in spite of the rounding. */
function placed(parts, times) {
  const length = times[3] - times[0];
  const fraction = (t) => (length > 0 ? (t - times[0]) / length : 0);
  return parts.map((x, i) => {
    if (i % 2) return x;
    const [from, to] = i < 4 ? times : times.slice(2);
    const exact = fraction(from + x * (to - from));
    const rounded = Math.round(exact * 1e6) / 1e6;
    if (x <= 1 && rounded > fraction(to)) return x < 1 ? Math.floor(exact * 1e6) / 1e6 : tidy(fraction(to), 9);
    if (x >= 0 && rounded < fraction(from)) return x > 0 ? Math.ceil(exact * 1e6) / 1e6 : tidy(fraction(from), 9);
    return rounded;
  });
}

/** The scene with other times, each ramp keeping its shape. */
export function withTimes(scene, times) {
  const isSound = times.every(Number.isFinite) && times[3] > times[0];
  const along = (inner) => (inner && isSound ? placed(relative(inner, scene.times), times) : inner);
  return { ...scene, times, inner: along(scene.inner), spare: { ...scene.spare, inner: along(scene.spare.inner) } };
}

const number = (x) => (Number.isNaN(x) ? 'nan' : x === Infinity ? 'inf' : x === -Infinity ? '-inf'
  : Math.abs(x) >= 1e15 ? x.toExponential() : String(x));

/** The scene as the text that `shutter plan` reads. */
export function toml(scene) {
  const lines = [`# ${scene.name.replace(/[^\x20-\x7e]/g, '_')}`, `unit = "${scene.unit}"`];
  TIMES.forEach((key, i) => lines.push(`${key} = ${number(scene.times[i])}`));
  if (scene.inner) lines.push(`shutteropening = [${scene.inner.map(number).join(', ')}]`);
  for (const key of [...COUNTS, ...OPTIONAL]) if (scene[key] !== null) lines.push(`${key} = ${number(scene[key])}`);
  return lines.join('\n') + '\n';
}

/** The scene as the part of an address behind '#', with another one beside it if there is one. */
export function hash(scene, other) {
  const part = (key, value) => `${key}=${encodeURIComponent(value)}`;
  const parts = [part('name', scene.name), part('unit', scene.unit === 'µs' ? 'us' : scene.unit), `times=${scene.times}`];
  if (scene.inner) parts.push(`inner=${scene.inner}`);
  for (const key of [...COUNTS, ...OPTIONAL]) if (scene[key] !== null) parts.push(`${key}=${scene[key]}`);
  if (other) parts.push(part('with', hash(other).slice(1)));
  return '#' + parts.join('&');
}

/** The scene in such a part of an address, and the one beside it; an error says what is wrong. */
export function fromAddress(text) {
  const other = new URLSearchParams(text.replace(/^#/, '')).get('with');
  return { scene: fromHash(text), other: other ? fromHash(other) : null };
}

function fromHash(text) {
  if (text.length > 8000) throw new Error(`it is ${text.length} characters long`);
  const parts = new URLSearchParams(text.replace(/^#/, ''));
  const numbers = (key, count) => {
    const list = (parts.get(key) ?? '').split(',').map((x) => (x.trim() ? Number(x) : NaN));
    if (list.length !== count) throw new Error(`${key}: ${count} numbers are required, not ${parts.has(key) ? list.length : 0}`);
    return list;
  };
  const unit = (parts.get('unit') ?? 's').replace('us', 'µs');
  if (!UNITS.includes(unit)) throw new Error('unit: s, ms, us or ns is required');
  const name = (parts.get('name') ?? '').slice(0, 60) || 'linked';
  const scene = { name, unit, times: numbers('times', 4), inner: parts.has('inner') ? numbers('inner', 8) : null, spare: {} };
  for (const key of COUNTS) [scene[key]] = numbers(key, 1);
  for (const key of OPTIONAL) scene[key] = parts.has(key) ? numbers(key, 1)[0] : null;
  return scene;
}
