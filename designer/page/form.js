// The numbers: as people write them they become those of the scene, and stay as they are typed.

import { $, label, write } from './dom.js';
import { change, model, refuse, seal } from './model.js';
import { dial, parse } from './numbers.js';
import {
  CHOICES, FIELDS, INNER, KINDS, LAMP, TIMES,
  inUnit, innerOf, isCount, lampOf, perSecond, tidy, timesOf, valueOf, withInner, withTimes, withValues,
} from './scene.js';
import { readTrace } from './trace.js';

/** Begins. */
export function startForm() {
  const numbers = $('numbers');
  numbers.addEventListener('input', onInput);
  numbers.addEventListener('submit', (event) => event.preventDefault());
  numbers.addEventListener('focusout', () => {
    seal();
    // Once the focus is elsewhere.
    setTimeout(() => drawForm(model));
  });
}

// The number in a field of the form; an error says why there is none.
function readField(id, unit) {
  const value = parse($(id).value, KINDS[id], unit);
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

/** A scene with values that a person gives, which are theirs from now on. */
function given(scene, keys) {
  const told = keys.map((key) => (LAMP.includes(key) ? 'lamp' : key));
  return { ...scene, given: [...new Set([...scene.given, ...told])] };
}

/** Changes values of fields. */
export function give(values, key) {
  change({ scene: given(withValues(model.now.scene, values), Object.keys(values)) }, { key });
}

// So many flashes. Those of a trace are its own: it is asked again.
function setTriggers(n, key) {
  const { scene: { own }, trace } = model.now, measured = own?.trigger_times.length;
  // Another number of this trace's own may be under way.
  if (trace && n === measured && model.busy?.file === trace.file) model.busy?.cancel();
  if (!own || n === measured) return give({ triggers: n }, key);
  if (!trace?.file) {
    return refuse(`These are ${measured} measured times: for another number, drop the trace again.`, 'triggers');
  }
  if (!isCount(n)) return refuse(`${label('triggers')}: a whole number from 1 to 10000 is required`, 'triggers');
  readTrace(trace.file, trace.asked, n);
}

// The numbers of another lamp.
function lamp(kind, { shutter, flashes: { triggers } }) {
  const next = { pulse: null, duty: null, min_pulse: null, fully_open: kind === 'full' || null };
  if (kind === 'pulse') next.pulse = tidy((shutter.close_end - shutter.open_start) / triggers / 8, 2) || 1;
  if (kind === 'duty') next.duty = 0.3;
  return next;
}

function onInput({ target: { id, value: text, checked } }) {
  const { scene } = model.now;
  if (id === 'name') return change({ scene: given({ ...scene, name: text.trim() || 'shutter' }, [id]) }, { key: id });
  if (id === 'unit') return change({ scene: given(inUnit(scene, text), [id]) });
  if (id === 'straight') return change({ scene: withInner(scene, checked ? null : innerOf(scene)) });
  if (id === 'lamp') return give(lamp(text, scene));
  if (CHOICES[id]) return give({ [id]: CHOICES[id].find((it) => String(it) === text) ?? null });
  if (!FIELDS.includes(id)) return;
  let value;
  try {
    value = readField(id, scene.unit);
  } catch (error) {
    return refuse(error.message, id);
  }
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  const { good } = model;
  if (id === 'triggers') setTriggers(value, id);
  else if (i >= 0) {
    // A ramp keeps its shape when its time is typed, as when it is dragged.
    const { shutter, own } = good?.unit === scene.unit ? good : scene;
    const from = { ...scene, shutter: { ...shutter, nominal: scene.shutter.nominal }, own };
    change({ scene: withTimes(from, timesOf(scene).with(i, value)) }, { key: id });
  } else if (k >= 0) change({ scene: withInner(scene, innerOf(scene).with(k, value)) }, { key: id });
  else give({ [id]: value }, id);
}

// What a field shows of a scene.
function wordsOf(scene, id) {
  const value = valueOf(scene, id);
  if (value === null) return { value, words: '' };
  if (id === 'nominal') return { value, words: dialled(value, scene.unit) };
  return { value, words: String(INNER.includes(id) ? tidy(value, 7) : value) };
}

// What a dial has, in full: 1/125, or 2 s; what no dial has is a time.
function dialled(value, unit) {
  const seconds = value / perSecond(unit), words = dial(seconds), part = tidy(seconds < 1 ? 1 / seconds : seconds, 9);
  return Number.isInteger(part) ? `${words}${seconds < 0.3 ? '' : ' s'}` : `${value} ${unit}`;
}

// Writes the numbers; what is typed stays as it is.
export function drawForm({ now: { scene }, wrong }) {
  for (const id of FIELDS) {
    const { value, words } = wordsOf(scene, id);
    if (wrong?.id !== id && $(id).value !== words && !tells(id, value, scene.unit)) $(id).value = words;
  }
  const name = $('name');
  if (document.activeElement !== name || (name.value.trim() || 'shutter') !== scene.name) name.value = scene.name;
  $('unit').value = scene.unit;
  for (const id of ['set_up', 'sync_falls']) $(id).value = String(valueOf(scene, id) ?? '');
  $('straight').checked = !scene.shutter.shutteropening;
  const kind = lampOf(scene);
  $('lamp').value = kind;
  $('lamp').disabled = Boolean(scene.own);
  for (const label of document.querySelectorAll('[data-lamp]')) label.hidden = label.dataset.lamp !== kind;
  for (const small of document.querySelectorAll('small.unit')) write(small, scene.unit);
  // From where the times are counted.
  write($('times-from'), valueOf(scene, 'delay') === null ? 'Times' : 'Times from the edge of the sync');
}
