// Files: a scene, a trace, several traces. How a trace is read, and what is made of it.

import { html, nothing, render } from 'lit-html';
import { $, choice } from './dom.js';
import { change, model, tell } from './model.js';
import { taken } from './numbers.js';
import { units as UNITS } from 'presets';
import {
  GIVEN, LAMP, fromScene, inUnit, isCount, isSameShape, perSecond, short, syncOf, tidy,
} from './scene.js';
import { cancelFit, fitTrace, openScene as parseScene } from './studio.js';

/** Longer files are not read: a trace would fill the page's memory. */
const LONGEST_TRACE = 256 << 20, LONGEST_SCENE = 1 << 20;
/** The record's picture, and from how many pixels on a move drags a window. */
const WIDTH = 400, HEIGHT = 96, BOTTOM = 18, DRAG = 4;
/** What the button beside a message says, which leads to the control that mends it. */
const MEND = {
  rate: 'Give the rate', unit: 'Choose the unit', columns: 'Choose the columns', light: 'Say which way',
  full: 'Give full light', frame: 'Choose the pulse', sync: 'Choose its channel', from: 'Choose a window',
};

/** The file of each row of the table, in this visit: two may have one name. */
export const rowFiles = new WeakMap();

/** Begins: files are chosen or dropped. */
export function startTraces() {
  const bring = (files) => files.length && openFiles([...files]);
  $('file').onchange = ({ target }) => {
    bring([...target.files]);
    target.value = '';
  };
  $('stop').onclick = () => {
    const { words } = model.busy;
    model.busy.cancel();
    tell({ note: { words: `${words}: stopped.` } });
  };
  for (const type of ['dragover', 'drop']) addEventListener(type, (event) => event.preventDefault());
  addEventListener('drop', (event) => bring(event.dataTransfer.files));
}

/** Opens files: a scene; a trace, which is fitted; several traces, of which a table is made. */
export function openFiles(files) {
  const hasScene = files.some(({ name }) => /\.toml$/i.test(name));
  if (files.length === 1) return hasScene ? openScene(files[0]) : readTrace(files[0], {});
  return hasScene ? refuseFile('A scene in TOML is opened alone: no file beside it was read.') : measure(files);
}

// What is wrong with a file: in the bar, or beside the form that tells how it is read.
const refuseFile = (words, pending = null) =>
  tell({
    busy: null, note: { words: pending ? `${pending.name} could not be fitted.` : words, isWrong: true }, pending,
  });

async function openScene(file) {
  const name = file.name.replace(/\.toml$/i, '');
  if (file.size > LONGEST_SCENE) return refuseFile(`${file.name}: this is too long for a scene`);
  const busy = computing(`Opening ${file.name}`);
  const answer = await parseScene(file.name, await file.text());
  if (model.busy !== busy || !answer) return;
  if (answer.Err) return refuseFile(answer.Err);
  tell({ busy: null });
  change({ scene: { ...fromScene(name, answer.Ok), given: GIVEN }, trace: null, speeds: null });
}

// What is computed from now on; whatever came before is ended.
function computing(words) {
  model.busy?.cancel();
  const busy = {
    words,
    cancel() {
      model.busy = null;
      cancelFit();
    },
  };
  tell({ busy, note: null, pending: null });
  return busy;
}

// The fit to a file that is read as is asked for; nothing if something newer came first.
async function fitted(busy, file, asked) {
  if (file.size > LONGEST_TRACE) return { Err: `${file.size >> 20} MB: cut the trace to the pulse` };
  const answer = await fitTrace(file.name, asked, file, (share) => {
    busy.share = share;
    if (model.busy === busy) tell({ busy });
  });
  return model.busy === busy ? answer : undefined;
}

/** Reads the trace in a file as is asked for, and fits it for so many triggers, or for as many as the scene has. */
export async function readTrace(file, asked, wanted) {
  const there = () => [model.now.scene.flashes.triggers].find(isCount) ?? 12;
  const triggers = wanted ?? there();
  const shown = model.now.trace, isSame = shown?.file === file, isSameReading = isSame && asked === shown.asked;
  const before = model.now.scene;
  const busy = Object.assign(computing(`Reading ${file.name}`), { file });
  const answer = await fitted(busy, file, { ...asked, triggers });
  if (!answer) return;
  // Another number was chosen meanwhile.
  if (!wanted && there() !== triggers) return readTrace(file, asked);
  if (answer.Err) return refuseFile(`${file.name}: ${answer.Err}`);
  const { raw, fit: { Ok: fit, Err }, ...measured } = answer.Ok;
  const read = { file, name: file.name, asked, measured, record: raw };
  // What cannot be fitted as it is read can be read otherwise.
  if (!fit) return refuseFile('', { ...read, words: Err.text, mend: Err.remedy });
  tell({ busy: null });
  const give = () => {
    const name = file.name.replace(/\.\w+$/, '');
    const scene = withFit(model.now.scene, triggers, name, fit, isSame, isSameReading);
    change({ scene, trace: { ...read, fit, scene }, speeds: null });
  };
  // What a hand has moved on this trace is not taken away unasked, nor what it moves meanwhile.
  const isNow = isSameShape(before, model.now.scene), delay = (scene) => syncOf(inUnit(scene, 'ns')).delay;
  const isHand = isSame && !isSameReading && (!isSameShape(shown.scene, before)
    || (fit.shutter.delay !== null && delay(shown.scene) !== delay(model.now.scene)));
  if (isNow && !isHand) give();
  else {
    const words = `${file.name} is fitted; the curve was changed ${isNow ? 'by hand before' : 'meanwhile'}.`;
    tell({ note: { words, act: ['Show the fit', give] } });
  }
}

/**
 * The scene with the shutter of a fit. Of what was there stays what a person gave for the flashes; a name, a nominal
 * speed and a delay are another shutter's, unless the same trace was read otherwise.
 */
function withFit(scene, triggers, name, fit, isSame, isSameReading) {
  const { given } = scene, found = fromScene(name, { shutter: fit.curve, flashes: {} });
  const unit = given.includes('unit') ? scene.unit : found.unit;
  const [old, fresh] = [inUnit(scene, unit), inUnit(found, unit)];
  const { open_start, trigger_times } = fit.shutter, is = (key) => given.includes(LAMP.includes(key) ? 'lamp' : key);
  const isOld = (key) => is(key) && (!(key in syncOf(old)) || isSameReading || (isSame && fit.shutter.delay === null));
  for (const key of Object.keys(fresh.flashes).filter(isOld)) fresh.flashes[key] = old.flashes[key];
  if (isSame && is('name')) fresh.name = old.name;
  if (isSame && is('nominal')) fresh.shutter.nominal = old.shutter.nominal;
  fresh.flashes.triggers = triggers;
  fresh.given = [...new Set([...given, 'name'])];
  if (trigger_times) {
    fresh.own = inUnit({ ...found, own: { open_start, trigger_times } }, unit).own;
    for (const key of LAMP) fresh.flashes[key] = null;
  }
  return fresh;
}

// Measures the speeds of several traces, one after the other.
async function measure(files) {
  const speeds = [], none = { exposure: 0, error: 0, scatter: 0, pulses: 0, near: null, dial: null, doubts: [] };
  for (const [i, file] of files.entries()) {
    const busy = computing(`Measuring ${i + 1} of ${files.length}: ${file.name}`);
    const answer = await fitted(busy, file, { triggers: 12 });
    if (!answer) return;
    const { Ok: fit, Err: why } = answer.Ok?.fit ?? { Err: { text: answer.Err } };
    const { scatter, pulses, nearest_s: near } = fit ?? {};
    const { value, error } = fit?.facts.find(({ key }) => key === 'exposure_s') ?? {};
    const found = fit ? {
      exposure: tidy(value, 6), error: tidy(error, 6), scatter: tidy(scatter, 6), pulses, near,
      doubts: fit.warnings.map(({ text }) => text), kind: fit.shutter.trigger_times ? 'the trace itself' : fit.kind,
    } : { kind: `not measured: ${why.text.split('\n')[0]}` };
    speeds.push({ name: file.name, ...none, ...found });
    rowFiles.set(speeds.at(-1), file);
  }
  tell({ busy: null });
  change({ speeds });
}

/** Draws how the model's trace is read. */
export function drawTrace({ now: { scene, trace }, pending }) {
  render(panel(pending ?? trace, trace, pending, trace && !isSameShape(trace.scene, scene)), $('trace'));
  if (pending) $('reading').open = true;
}

const press = (words, act) => html`<button type="button" @click=${act}>${words}</button>`;
const note = (words) => html`<p class="note">${words}</p>`;

function panel(shown, trace, pending, isHand) {
  if (!shown) {
    return note('Open or drop a trace: the CSV of an oscilloscope or a shutter tester, or the WAV of a sound card. The '
      + 'simplest curve that serves is fitted to it. Several make a table of speeds. Nothing leaves this page.');
  }
  const { fit } = shown;
  const another = () => press('Open another file …', () => $('file').click());
  const head = pending
    ? [html`<p class="wrong" tabindex="-1">${pending.name}: ${pending.words} ${leads(pending.mend) ?? another()}</p>`,
      trace ? note(`The trace of ${trace.name} stays on the graph.`) : nothing]
    : html`<p class="buttons">${fit.warnings.map(({ remedy }) => leads(remedy))}</p>`;
  return html`${head}
    <details id="reading"><summary>How the file is read</summary>${readingForm(shown)}</details>
    ${fit && !isHand ? html`<details id="report"><summary>The whole report</summary>
      <pre tabindex="0">${fit.report}</pre></details>` : nothing}
    <span class="buttons">
      ${trace ? press('Remove the trace', () => change({ trace: null, scene: { ...model.now.scene } })) : nothing}
      ${pending ? press('Close', () => tell({ note: null, pending: null })) : nothing}</span>`;
}

/** A button that leads to what mends a doubt. */
export const leads = (mend) => MEND[mend] && press(MEND[mend], () => {
  $('reading').open = true;
  $('reading').querySelector(`[name=${mend}]`)?.focus();
});

// The whole record, in the file's own time, with the window that counts; `take(from, to)` takes another, in seconds.
function drawRecord(record, { from, to }, unit, take) {
  if (!record?.length) return '';
  const per = perSecond(unit), [[start], [end]] = [record[0], record.at(-1)], length = end - start || 1;
  const values = record.map(([, v]) => v), [low, high] = [Math.min(...values), Math.max(...values)];
  const x = (t) => ((t - start) / length) * WIDTH;
  const y = (v) => 4 + (HEIGHT - 8 - BOTTOM) * (1 - (v - low) / (high - low || 1));
  const path = `M${record.map(([t, v]) => `${x(t).toFixed(1)} ${y(v).toFixed(1)}`).join('L')}`;
  const bar = (a, b) => ({ x: Math.max(0, Math.min(x(a), x(b))), width: Math.min(WIDTH, Math.abs(x(b) - x(a))) });
  const shown = bar(from ?? start, to ?? end);
  const label = (part) => html`<span>${short(tidy((start + part * length) * per, 3), 4)}</span>`;
  const labels = [0, 0.25, 0.5, 0.75, 1].map(label);
  const grab = (event) => {
    const box = event.currentTarget, { left, width } = box.getBoundingClientRect(), mark = box.querySelector('rect');
    const at = ({ clientX }) => start + length * Math.min(1, Math.max(0, (clientX - left) / width));
    const first = event.clientX, t = at(event);
    box.setPointerCapture(event.pointerId);
    box.onpointermove = (event) => {
      for (const [name, value] of Object.entries(bar(t, at(event)))) mark.setAttribute(name, value);
    };
    box.onpointerup = box.onlostpointercapture = (event) => {
      box.onpointermove = box.onpointerup = box.onlostpointercapture = null;
      const ends = [t, at(event)].sort((a, b) => a - b).map((t) => tidy(t, 6));
      if (event.type === 'pointerup' && Math.abs(event.clientX - first) >= DRAG) take(...ends);
      else for (const [name, value] of Object.entries(shown)) mark.setAttribute(name, value);
    };
  };
  return html`<div class="record" aria-hidden="true" title="Drag over the part that counts"
    @pointerdown=${grab} @dblclick=${() => take(null, null)}>
    <svg viewBox="0 0 ${WIDTH} ${HEIGHT - BOTTOM}" preserveAspectRatio="none">
    <rect y="0" height=${HEIGHT} x=${shown.x} width=${shown.width} /><path d=${path} /></svg><div>${labels}</div></div>
    <p class="note">Drag over the part that counts (${unit} of the file)${from != null || to != null
      ? html`; <button type="button" class="plain" @click=${() => take(null, null)}>take the whole record</button>`
      : ''}.</p>`;
}

function readingForm({ file, asked, record, measured: { names, read }, fit }) {
  // What was chosen before may still be read.
  let wanted = asked;
  const again = (changes) => readTrace(file, (wanted = { ...wanted, ...changes }));
  const chosen = (words, name, options, value, change) => choice(words, {
    name, options, value, changed: ({ target }) => again(change(target.value, target.closest('fieldset'))),
  });
  // What counts of the trace is told in the unit of its times.
  const unit = asked.unit ?? read?.clock.unit ?? 's';
  const number = (words, name, kind, value, placeholder, per = 1) => {
    const changed = taken(kind, (x) => again({ [name]: x === null ? null : x / per }), unit);
    return html`<label>${words}<input name=${name} inputmode="decimal" placeholder=${placeholder}
      .value=${value == null ? '' : tidy(value * per)} @change=${changed}></label>`;
  };
  const count = Math.max(names.length, read?.columns ?? 0);
  const named = (i) => (names[i] ? `${i + 1}: ${names[i]}` : `column ${i + 1}`);
  const columns = Array.from({ length: count }, (_, i) => [i + 1, named(i)]);
  const time = read ? (read.time?.[0] ?? '') : count > 1 ? 1 : '', signal = read?.signal[0] ?? Math.min(2, count);
  const both = (_, fields) => {
    const chosen = ['time', 'columns'].map((name) => fields.querySelector(`[name=${name}]`).value);
    return { columns: chosen.filter(Boolean).map(Number) };
  };
  const way = fit ? `${fit.light_lowers ? 'falls' : 'rises'}, by itself` : 'as it seems';
  const rate = asked.rate ?? (read?.clock.rate && tidy(read.clock.rate, 7));
  const all = fit?.pulses, pulses = Math.min(all ?? asked.frame ?? 1, 200);
  const frames = Array.from({ length: pulses }, (_, i) => [i + 1, `${i + 1} of ${all ?? '?'}`]);
  return html`${drawRecord(record, asked, unit, (from, to) => again({ from, to }))}
    <fieldset class="reading"><legend class="sr">How the file is read</legend>
    ${count ? [chosen('time', 'time', [['', 'none: by the rate'], ...columns], time, both),
      chosen('light', 'columns', columns, signal, both),
      chosen('sync', 'sync', [['', 'none'], ...columns], asked.sync ?? '', (it) => ({ sync: Number(it) || null }))]
      : nothing}
    ${chosen('unit of the time', 'unit', [['', 'as the file says'], ...UNITS.map((unit) => [unit, unit])],
      asked.unit ?? '', (unit) => ({ unit: unit || null, rate: null }))}
    ${number('samples a second', 'rate', 'rate', rate, 'by the times')}
    ${chosen('in light the signal', 'light', [['auto', way], ['up', 'rises'], ['down', 'falls']], asked.light ?? 'auto',
      (light) => ({ light }))}
    ${number(`from, ${unit}`, 'from', 'time', asked.from, 'the beginning', perSecond(unit))}
    ${number(`to, ${unit}`, 'to', 'time', asked.to, 'the end', perSecond(unit))}
    ${number('signal of full light', 'full', 'part', asked.full, 'the peak')}
    ${all > 1 || asked.frame
      ? chosen('pulse', 'frame', frames, asked.frame ?? fit.pulse, (it) => ({ frame: Number(it) })) : nothing}
  </fieldset>`;
}
