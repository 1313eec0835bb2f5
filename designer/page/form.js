// The numbers: as people write them they become those of the scene, and stay as they are typed.

import { html, nothing, render } from 'lit-html';
import { live } from 'lit-html/directives/live.js';
import { units as UNITS } from 'presets';
import { $, choice } from './dom.js';
import { change, give, model, refuse, seal } from './model.js';
import { dial, parse } from './numbers.js';
import {
  CHOICES, FIELDS, INNER, KINDS, TIMES,
  given, inUnit, innerOf, isCount, label, lampOf, perSecond, tidy, timesOf, valueOf, withInner, withTimes,
} from './scene.js';
import { fieldsAt } from './told.js';
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
  if (id in NONE) return null;
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

// So many flashes. Those of a trace are its own: it is asked again.
function setTriggers(n, key) {
  const { scene: { own }, trace } = model.now, measured = own?.trigger_times.length;
  // Another number of this trace's own may be under way.
  if (trace && n === measured && model.busy?.file === trace.file) model.busy?.cancel();
  if (!own || n === measured) return give({ triggers: n }, key);
  if (!trace) {
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

/** What stands in the empty field of a number that may be left out. */
const NONE = {
  timer_hz: 'not given', min_gap: 'not given', nominal: '1/125', delay: 'none', timer_bits: '32', delay_spread: 'none',
  sync_settles: 'at once', lamp_lag: 'none', min_pulse: 'none',
};
const SET_UPS = [
  ['', 'not said yet'], ['emulated', 'emulated: the camera stays open'], ['in_path', 'in the path: dims the lamp'],
];
const LAMPS = [
  ['', 'flashes'], ['pulse', 'equal pulses'], ['duty', 'pulses of equal doses'], ['full', 'flashes while fully open'],
];

/** Writes the numbers; what is typed stays as it is. */
export function drawForm(model) {
  const { now: { scene, scene: { name, unit } }, wrong } = model, at = fieldsAt(model), lamp = lampOf(scene);
  const number = (id, of) => {
    const { value, words } = wordsOf(scene, id), is = at.includes(id);
    const isTyped = wrong?.id === id || tells(id, value, unit);
    return html`<label ?hidden=${of && of !== lamp}>
      ${label(id)}${KINDS[id] === 'time' && !TIMES.includes(id) ? `, ${unit}` : ''}
      <input id=${id} placeholder=${NONE[id] ?? nothing} .value=${live(isTyped ? $(id).value : words)}
        aria-invalid=${is ? 'true' : nothing} aria-describedby=${is ? 'problem' : nothing}></label>`;
  };
  const chosen = (id, options) => choice(label(id), { id, options, value: valueOf(scene, id) ?? '' });
  const numbers = (...ids) => ids.map((id) => number(id));
  const typed = document.activeElement === $('name') ? $('name').value : name;
  render(html`<div class="head"><h2 id="numbers-title">Numbers</h2>
    <label class="inline">name <input id="name" maxlength="60" spellcheck="false"
      .value=${live((typed.trim() || 'shutter') === name ? typed : name)}></label></div>
  <div class="fields">
    <fieldset><legend>${valueOf(scene, 'delay') === null ? 'Times' : 'Times from the edge of the sync'}</legend>
      ${choice('unit', { id: 'unit', options: UNITS.map((unit) => [unit, unit]), value: unit })}
      ${numbers(...TIMES)}</fieldset>
    <fieldset><legend>Flashes</legend>${numbers('triggers', 'timer_hz', 'min_gap', 'nominal', 'delay')}
      ${chosen('sync_falls', [['', 'not said yet'], [true, 'falls'], [false, 'rises']])}</fieldset>
    <fieldset><legend>Lamp</legend>${chosen('set_up', SET_UPS)}
      ${choice('it gives', { id: 'lamp', options: LAMPS, value: lamp, disabled: Boolean(scene.own) })}
      ${number('pulse', 'pulse')}${number('duty', 'duty')}</fieldset>
  </div>
  <details id="inner"><summary>More</summary>
    <fieldset>${numbers('timer_bits', 'delay_spread', 'sync_settles', 'lamp_lag')}${number('min_pulse', 'duty')}
      <label class="check"><input type="checkbox" id="straight" .checked=${live(!scene.shutter.shutteropening)}>
        straight ramps</label></fieldset>
    <fieldset><legend>The ramps’ control points</legend>${numbers(...INNER)}</fieldset>
    <p class="note">t: time, from 0 at the start to 1 at the end; y: openness. 1 and 2 are of the opening ramp, 5 and 6
      of the closing one.</p>
  </details>`, $('numbers'));
  if (at.some((id) => $('inner').contains($(id)))) $('inner').open = true;
}
