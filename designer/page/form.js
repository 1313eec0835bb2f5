// The numbers: as people write them they become those of the scene, and stay as they are typed.

import { $, watch, write } from './dom.js';
import { change, model, refuse, seal } from './model.js';
import { parse } from './numbers.js';
import { CHOICES, FIELDS, INNER, LAMP, SPANS, STOPS, TIMES, inUnit, innerOf, isCount, lampOf, perSecond, tidy, withInner, withTimes } from './scene.js';
import { readTrace } from './trace.js';
import { label } from './words.js';

const KINDS = { triggers: 'count', timer_hz: 'rate', timer_bits: 'count' };

/** Begins. */
export function startForm() {
  const numbers = $('numbers');
  numbers.addEventListener('input', onInput);
  numbers.addEventListener('submit', (event) => event.preventDefault());
  numbers.addEventListener('focusout', () => {
    seal();
    echo();
    // Once the focus is elsewhere.
    setTimeout(() => drawForm(model));
  });
  $('flashes').addEventListener('input', ({ target }) => setTriggers(STOPS[target.value], 'flashes'));
  $('flashes').addEventListener('change', seal);
}

// The number in a field of the form; an error says why there is none.
function readField(id, unit) {
  const kind = TIMES.includes(id) || SPANS.includes(id) ? 'time' : KINDS[id];
  const value = parse($(id).value, kind, unit);
  if (!Number.isNaN(value)) return value;
  if ($(id).hasAttribute('data-optional')) return null;
  throw new Error(`${label(id)}: a number is required`);
}

// Is a field typed in just now, and tells this number in words of its own?
function tells(id, value, unit) {
  try {
    return document.activeElement === $(id) && readField(id, unit) === value;
  } catch {
    return false;
  }
}

// What is read is told beside the field where it is written otherwise.
function echo(input, value) {
  const small = $('echo');
  const words = input && Number.isFinite(value) && String(value) !== input.value.trim() ? `= ${value}` : '';
  small.textContent = words;
  small.hidden = !words;
  if (words) input.parentElement.append(small);
}

/** Changes the scene; of the numbers, `keys` are a person's from now on. */
export function give(changes, keys = Object.keys(changes).map((key) => (LAMP.includes(key) ? 'lamp' : key)), key, scene = model.now.scene) {
  change({ scene: { ...scene, ...changes, given: [...new Set([...scene.given, ...keys])] } }, { key });
}

// So many flashes. Those of a trace are its own: it is asked again.
function setTriggers(n, key) {
  const { scene, trace } = model.now;
  // Another number of this trace's own may be under way.
  if (trace && n === scene.measured?.length && model.busy?.file === trace.file) model.busy?.cancel();
  if (!scene.measured || n === scene.measured.length) return give({ triggers: n }, ['triggers'], key);
  if (!trace?.file) return refuse(`These are ${scene.measured.length} measured times: for another number, drop the trace again.`, 'triggers');
  if (!isCount(n)) return refuse(`${label('triggers')}: a whole number from 1 to 10000 is required`, 'triggers');
  readTrace(trace.file, trace.asked, n);
}

// The scene with straight ramps, or again with those that it had before.
function straight(scene, isStraight) {
  const { inner, spare } = scene;
  return isStraight ? { ...withInner(scene, null), spare: { ...spare, inner } } : withInner(scene, spare.inner ?? innerOf(scene));
}

// The scene with another lamp, whose numbers are those that it had before; `length` is that of its first pulses.
function withLamp(scene, kind, length) {
  const { pulse, duty, min_pulse } = scene;
  const spare = { ...scene.spare, ...(pulse !== null && { pulse }), ...(duty !== null && { duty, min_pulse }) };
  const next = { ...scene, spare, pulse: null, duty: null, min_pulse: null, fully_open: kind === 'full' || null };
  if (kind === 'pulse') next.pulse = spare.pulse ?? length;
  if (kind === 'duty') [next.duty, next.min_pulse] = [spare.duty ?? 0.3, spare.min_pulse ?? null];
  return next;
}

function onInput({ target }) {
  const { id } = target;
  const { scene } = model.now;
  if (id === 'name') return give({ name: target.value.trim() || 'shutter' }, [id], id);
  if (id === 'unit') return give(inUnit(scene, target.value), [id]);
  if (id === 'straight') return give(straight(scene, target.checked), []);
  if (id === 'lamp') return give(withLamp(scene, target.value, tidy(((model.view?.exposure ?? 0) * perSecond(scene.unit)) / scene.triggers / 4, 2) || 1), [id]);
  if (CHOICES[id]) return give({ [id]: CHOICES[id].find((it) => String(it) === target.value) ?? null });
  if (!FIELDS.includes(id)) return;
  let value;
  try {
    value = readField(id, scene.unit);
  } catch (error) {
    echo();
    return refuse(error.message, id);
  }
  echo(target, value);
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  if (id === 'triggers') setTriggers(value, id);
  // A ramp keeps its shape when its time is typed, as when it is dragged.
  else if (i >= 0) give(withTimes(model.good?.unit === scene.unit ? { ...scene, ...shapeOf(model.good) } : scene, scene.times.with(i, value)), [], id);
  else if (k >= 0) give(withInner(scene, innerOf(scene).with(k, value)), [], id);
  else give({ [id]: value }, undefined, id);
}

const shapeOf = ({ times, inner, spare }) => ({ times, inner, spare });

function valueOf(scene, id) {
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  return i >= 0 ? scene.times[i] : k >= 0 ? innerOf(scene)[k] : scene[id];
}

// Writes the numbers; what is typed stays as it is.
const isNewField = watch();
export function drawForm({ now: { scene }, wrong }) {
  if (!isNewField(scene, wrong, document.activeElement)) return;
  for (const id of FIELDS) {
    const value = valueOf(scene, id);
    const words = value === null ? '' : Number.isFinite(value) && INNER.includes(id) ? String(tidy(value, 7)) : String(value);
    if (wrong?.id !== id && $(id).value !== words && !tells(id, value, scene.unit)) $(id).value = words;
  }
  if (document.activeElement !== $('name') || ($('name').value.trim() || 'shutter') !== scene.name) $('name').value = scene.name;
  $('unit').value = scene.unit;
  for (const id of ['set_up', 'sync_falls']) $(id).value = String(scene[id] ?? '');
  $('straight').checked = !scene.inner;
  const lamp = lampOf(scene);
  $('lamp').value = lamp;
  $('lamp').disabled = Boolean(scene.measured);
  for (const label of document.querySelectorAll('[data-lamp]')) label.hidden = label.dataset.lamp !== lamp;
  for (const small of document.querySelectorAll('small.unit')) write(small, scene.unit);
}
