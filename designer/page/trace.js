// Files: a scene, a trace, several traces. How a trace is read, and what is made of it.

import { html, nothing, render } from './lit-html.js';
import { $, watch } from './dom.js';
import { change, model, tell } from './model.js';
import { taken } from './numbers.js';
import { UNITS } from './presets.js';
import { GIVEN, LAMP, fromScene, inUnit, isCount, isSameShape, perSecond, short, tidy } from './scene.js';
import { cancelFit, fitTrace, parseScene } from './studio.js';

/** Longer files are not read. */
const LONGEST_TRACE = 256 << 20, LONGEST_SCENE = 1 << 20;
/** What the button beside a message says, which leads to the control that mends it. */
const MEND = { rate: 'Give the rate', unit: 'Choose the unit', signal: 'Choose the columns', rises: 'Say which way', full: 'Give full light', frame: 'Choose the pulse', sync: 'Choose its channel' };

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
  let depth = 0;
  const shows = (by) => ($('drop').hidden = (depth = Math.max(0, depth + by)) === 0);
  addEventListener('dragenter', () => shows(1));
  addEventListener('dragleave', () => shows(-1));
  addEventListener('drop', (event) => {
    depth = 0;
    shows(0);
    bring(event.dataTransfer.files);
  });
}

/** Opens files: a scene; a trace, which is fitted; several traces, of which a table is made. */
export function openFiles(files) {
  const hasScene = files.some(({ name }) => /\.toml$/i.test(name));
  if (files.length > 1) return hasScene ? tell({ note: { words: 'A scene in TOML is opened alone: no file beside it was read.', isWrong: true } }) : measure(files);
  return hasScene ? openScene(files[0]) : readTrace(files[0], {});
}

const refuseFile = (words) => tell({ busy: null, note: { words, isWrong: true } });

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
  const there = () => (isCount(model.now.scene.triggers) ? model.now.scene.triggers : 12);
  const triggers = wanted ?? there();
  const isSame = model.now.trace?.file === file;
  const before = model.now.scene;
  const busy = Object.assign(computing(`Reading ${file.name}`), { file });
  const answer = await fitted(busy, file, { ...asked, triggers });
  if (!answer) return;
  // Another number was chosen meanwhile.
  if (!wanted && there() !== triggers) return readTrace(file, asked);
  if (answer.Err) return refuseFile(`${file.name}: ${answer.Err}`);
  const { fit: { Ok: fit, Err }, ...measured } = answer.Ok;
  // What cannot be fitted as it is read can be read otherwise.
  if (!fit) return tell({ busy: null, note: { words: `${file.name}: ${Err.text}`, isWrong: true }, pending: { file, name: file.name, asked, measured, words: Err.text, mend: Err.mend } });
  tell({ busy: null });
  const give = () => {
    const scene = withFit({ ...model.now.scene, triggers }, file.name.replace(/\.\w+$/, ''), fit, isSame);
    change({ scene, trace: { file, name: file.name, asked, measured, fit, scene }, speeds: null });
  };
  // What a person drew while it was computed is not taken away unasked.
  if (isSameShape(before, model.now.scene)) give();
  else tell({ note: { words: `${file.name} is fitted; the curve was changed meanwhile.`, act: ['Show the fit', give] } });
}

/**
 * The shutter of a fit to a trace. Of the scene before there stays what a person gave; its nominal speed and the delay of its
 * sync are another shutter's, unless the same trace was read otherwise.
 */
function withFit(scene, name, fit, isSame) {
  const found = fromScene(name, fit.scene);
  const { given } = scene;
  const unit = given.includes('unit') ? scene.unit : found.unit;
  const [old, fresh] = [inUnit(scene, unit), inUnit(found, unit)];
  const isSynced = fresh.delay !== null;
  const kept = ['triggers', 'timer_hz', 'timer_bits', 'min_gap', 'set_up', 'lamp_lag', ...(isSame ? ['nominal', 'name', ...(isSynced ? [] : ['delay', 'delay_spread', 'sync_falls'])] : [])].filter((key) => given.includes(key));
  for (const key of given.includes('lamp') ? [...kept, ...LAMP] : kept) fresh[key] = old[key];
  Object.assign(fresh, { triggers: scene.triggers, given: [...given, 'name'], doubts: doubtsOf(fit) });
  if (!fit.own) return fit.json.fit.explained ? fresh : { ...fresh, untold: 'no curve explains this trace, and its own triggers could not be told' };
  const { times, timer_hz, until_curve } = fit.own, per = perSecond(unit);
  if (!given.includes('timer_hz')) fresh.timer_hz = timer_hz;
  return { ...fresh, times: fresh.times.map((t) => tidy(t + until_curve * per, 9)), measured: times.map((t) => tidy(t * per)), pulse: null, duty: null, min_pulse: null, fully_open: null };
}

// Measures the speeds of several traces, one after the other.
async function measure(files) {
  const speeds = [];
  for (const [i, file] of files.entries()) {
    const busy = computing(`Measuring ${i + 1} of ${files.length}: ${file.name}`);
    const answer = await fitted(busy, file, { triggers: 12 });
    if (!answer) return;
    const fit = answer.Ok?.fit.Ok;
    const why = answer.Err ?? answer.Ok.fit.Err?.text;
    const [exposure, error, scatter, pulses] = fit ? [fit.json.exposure_s, fit.json.exposure_error_s, fit.scatter, fit.json.pulses].map((x) => tidy(x, 6)) : [0, 0, 0, 0];
    const kind = fit ? (fit.own ? 'the trace itself' : fit.kind) : `not measured: ${why.split('\n')[0]}`;
    speeds.push({ name: file.name, kind, exposure, error, scatter, pulses, dial: null, doubts: fit ? doubtsOf(fit).map(({ text }) => text) : [] });
  }
  tell({ busy: null });
  speeds.forEach((row, i) => rowFiles.set(row, files[i]));
  change({ speeds });
}

/** What is doubtful about a fit, and about which number. */
const doubtsOf = (fit) => [...(fit.json.fit.tested ? [] : [{ about: 'test', text: 'there is too little dark to know the noise by' }]), ...fit.warnings.map(({ text, about }) => ({ text, about }))];

const isNewTrace = watch();

/** Draws how the model's trace is read. */
export function drawTrace({ now: { scene, trace }, pending }) {
  const isHand = trace && !isSameShape(trace.scene, scene);
  if (isNewTrace(trace, pending, scene.unit, scene.triggers, isHand)) render(panel(pending ?? trace, trace, pending, isHand, scene), $('trace'));
}

function panel(shown, trace, pending, isHand, scene) {
  if (!shown) return html`<p class="note">Open or drop the CSV of an oscilloscope or a shutter tester: the simplest curve that serves is fitted to it. Several make a table of speeds. Nothing leaves this page.</p>`;
  const { file, measured, fit } = shown;
  const mends = pending ? [pending] : fit.warnings.filter(({ mend }) => mend);
  return html`
    ${pending ? html`<p class="wrong">${pending.name}: ${pending.words} ${leads(pending.mend) ?? html`<button type="button" @click=${() => $('file').click()}>Open another file …</button>`}</p>
      ${trace ? html`<p class="note">The trace of ${trace.name} stays on the graph.</p>` : nothing}` : html`<p class="buttons">${mends.map(({ mend }) => leads(mend))}</p>`}
    <details id="reading" ?open=${Boolean(pending)}><summary>How the file is read</summary>
      ${previewTable(measured)}
      ${file ? readingForm(shown) : html`<p class="note">To read it otherwise, open the file again.</p>`}
    </details>
    ${fit && !isHand ? details(fit, scene) : nothing}
    <span class="buttons">${trace ? html`<button type="button" @click=${() => change({ trace: null, scene: { ...model.now.scene } })}>Remove the trace</button>` : nothing}
      ${pending ? html`<button type="button" @click=${() => tell({ note: null, pending: null })}>Close</button>` : nothing}</span>`;
}

/** A button that leads to what mends a doubt. */
export const leads = (mend) => mend && html`<button type="button" @click=${() => {
  $('reading').open = true;
  $('reading').querySelector(`[name=${mend}]`)?.focus();
}}>${MEND[mend]}</button>`;

// The first rows of the file, with what each column is taken for.
function previewTable({ names, rows, read }) {
  const role = (i) => (!read ? '' : i + 1 === read.time ? 'time' : i + 1 === read.signal ? 'light' : i + 1 === read.sync ? 'sync' : '');
  return html`<div class="scroll" tabindex="0" role="region" aria-label="The first lines of the file"><table class="preview">
    <thead><tr><th scope="col">line</th>${names.map((name, i) => html`<th scope="col" class=${role(i) && 'read'}>${name ?? `column ${i + 1}`}${role(i) ? html`<small> ${role(i)}</small>` : nothing}</th>`)}</tr></thead>
    <tbody>${rows.map(([line, fields]) => html`<tr><td>${line}</td>${names.map((_, i) => html`<td>${fields[i] ?? ''}</td>`)}</tr>`)}</tbody></table></div>`;
}

function readingForm({ file, asked, measured: { names, read }, fit }) {
  // What was chosen before may still be read.
  let wanted = asked;
  const again = (changes) => readTrace(file, (wanted = { ...wanted, ...changes }));
  const choice = (words, name, options, value, change) => html`<label>${words}<select name=${name} .value=${String(value)} @change=${({ target }) => again(change(target.value, target.form ?? target.closest('fieldset')))}>
    ${options.map(([of, words]) => html`<option value=${of} ?selected=${String(of) === String(value)}>${words}</option>`)}</select></label>`;
  const number = (words, name, kind, value, placeholder, per = 1) => html`<label>${words}<input name=${name} inputmode="decimal" placeholder=${placeholder} .value=${value == null ? '' : tidy(value * per)}
    @change=${taken(kind, (x) => again({ [name]: x === null ? null : x / per }), unit)}></label>`;
  const count = Math.max(names.length, read?.columns ?? 0);
  const columns = Array.from({ length: count }, (_, i) => [i + 1, names[i] ? `${i + 1}: ${names[i]}` : `column ${i + 1}`]);
  // What counts of the trace is told in the unit of its times.
  const unit = asked.unit ?? read?.unit ?? 's';
  const time = read ? (read.time ?? '') : count > 1 ? 1 : '';
  const both = (_, fields) => ({ columns: ['time', 'signal'].map((name) => fields.querySelector(`[name=${name}]`).value).filter(Boolean).map(Number) });
  const way = fit ? `${fit.json.light_lowers ? 'falls' : 'rises'}, by itself` : 'as it seems';
  const pulses = fit?.json.pulses ?? asked.frame;
  return html`<fieldset class="reading"><legend class="sr">How the file is read</legend>
    ${count ? [choice('time', 'time', [['', 'none: by the rate'], ...columns], time, both), choice('light', 'signal', columns, read?.signal ?? Math.min(2, count), both),
      choice('sync', 'sync', [['', 'none'], ...columns], asked.sync ?? '', (value) => ({ sync: value ? Number(value) : null }))] : nothing}
    ${choice('unit of the time', 'unit', [['', 'as the file says'], ...UNITS.map((unit) => [unit, unit])], asked.unit ?? '', (unit) => ({ unit: unit || null, rate: null }))}
    ${number('samples a second', 'rate', 'rate', asked.rate ?? (read?.rate && tidy(read.rate, 7)), 'by the times')}
    ${choice('in light the signal', 'rises', [['', way], ['true', 'rises'], ['false', 'falls']], asked.rises ?? '', (value) => ({ rises: value ? value === 'true' : null }))}
    ${number(`from, ${unit}`, 'from', 'time', asked.from, 'the beginning', perSecond(unit))}${number(`to, ${unit}`, 'to', 'time', asked.to, 'the end', perSecond(unit))}
    ${number('signal of full light', 'full', 'part', asked.full, 'the peak')}
    ${fit?.json.pulses > 1 || asked.frame ? choice('pulse', 'frame', Array.from({ length: Math.min(pulses, 200) }, (_, i) => [i + 1, `${i + 1} of ${fit?.json.pulses ?? '?'}`]), asked.frame ?? fit.json.pulse, (value) => ({ frame: Number(value) })) : nothing}
  </fieldset>`;
}

function details(fit, { unit, triggers }) {
  const per = perSecond(unit);
  const lines = fit.triggers.map(([t, error], i) => `${i}  ${short(t * per, 7)} ± ${short(error * per, 2)}`);
  const times = fit.triggers.length !== triggers ? nothing : html`<details><summary>The ${fit.triggers.length} times by the ${fit.own ? 'trace' : 'curve'}, with their errors</summary>
      <pre tabindex="0">#  ${unit} after the start of opening, with standard error\n${lines.join('\n')}</pre></details>`;
  return html`${times}<details id="report"><summary>The whole report</summary><pre tabindex="0">${fit.report}</pre></details>`;
}
