// A measured trace: how its file is read, its fit, and what is doubtful about either.

import { $, button, element, watch, write } from './dom.js';
import { rms } from './graph.js';
import { change, model, tell } from './model.js';
import { parse } from './numbers.js';
import { UNITS } from './presets.js';
import { told } from './save.js';
import { GIVEN, LAMP, fromScene, inUnit, isCount, isSameShape, perSecond, short, tidy } from './scene.js';
import { remember } from './speeds.js';
import * as studio from './studio.js';

/** Longer files are not read. */
const LONGEST_TRACE = 256 << 20, LONGEST_SCENE = 1 << 20;
/** What the button beside a message says, which leads to the control that mends it. */
const MEND = { rate: 'Give the rate', unit: 'Choose the unit', signal: 'Choose the columns', rises: 'Say which way', full: 'Give full light', frame: 'Choose the pulse' };

const empty = $('trace').firstElementChild;

/** Opens files: a scene; a trace, which is fitted; several traces, of which a table is made. */
export function bring(files) {
  const hasScene = files.some(({ name }) => /\.toml$/i.test(name));
  if (files.length > 1) return hasScene ? tell({ note: { words: 'A scene in TOML is opened alone: no file beside it was read.', isWrong: true } }) : measure(files);
  return hasScene ? open(files[0]) : read(files[0], {});
}

const refuse = (words) => tell({ busy: null, note: { words, isWrong: true } });

async function open(file) {
  const name = file.name.replace(/\.toml$/i, '');
  if (file.size > LONGEST_SCENE) return refuse(`${file.name}: this is too long for a scene`);
  const busy = begin(`Opening ${file.name}`);
  const answer = await studio.parse(file.name, await file.text());
  if (model.busy !== busy || !answer) return;
  if (answer.Err) return refuse(answer.Err.reason);
  tell({ busy: null });
  change({ scene: { ...fromScene(name, answer.Ok), given: GIVEN }, trace: null });
  told(`Opened ${file.name}.`);
}

// What is computed from now on; whatever came before is ended.
function begin(words) {
  model.busy?.cancel();
  const busy = {
    words,
    cancel() {
      model.busy = null;
      studio.cancel();
    },
  };
  tell({ busy, note: null });
  return busy;
}

// The fit to a file that is read as is asked for; nothing if something newer came first.
async function fitted(busy, file, asked) {
  if (file.size > LONGEST_TRACE) return { Err: { reason: `${file.size >> 20} MB: cut the trace to the pulse` } };
  const answer = await studio.fit(file.name, asked, file, (share) => {
    busy.share = share;
    if (model.busy === busy) tell({ busy });
  });
  return model.busy === busy ? answer : undefined;
}

/** Reads the trace in a file as is asked for, and fits it for so many triggers, or for as many as the scene has. */
export async function read(file, asked, wanted) {
  const there = () => (isCount(model.now.scene.triggers) ? model.now.scene.triggers : 12);
  const triggers = wanted ?? there();
  const isSame = model.now.trace?.file === file;
  const before = model.now.scene;
  const busy = Object.assign(begin(`Reading ${file.name}`), { file });
  const answer = await fitted(busy, file, { ...asked, triggers });
  if (!answer) return;
  // Another number was chosen meanwhile.
  if (!wanted && there() !== triggers) return read(file, asked);
  if (answer.Err) return refuse(`${file.name}: ${answer.Err.reason}`);
  const { fit: { Ok: fit, Err }, ...measured } = answer.Ok;
  // What cannot be fitted as it is read can be read otherwise.
  if (!fit) return tell({ busy: null, note: { words: `${file.name}: ${Err.text}`, isWrong: true }, pending: { file, name: file.name, asked, measured, words: Err.text, mend: Err.mend } });
  tell({ busy: null });
  const give = () => {
    const scene = withFit({ ...model.now.scene, triggers }, file.name.replace(/\.\w+$/, ''), fit, isSame);
    change({ scene, trace: { file, name: file.name, asked, measured, fit, scene } });
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
  const kept = ['triggers', 'timer_hz', 'timer_bits', 'min_gap', ...(isSame ? ['nominal', 'delay', 'delay_spread', 'name'] : [])].filter((key) => given.includes(key));
  for (const key of given.includes('lamp') ? [...kept, ...LAMP] : kept) fresh[key] = old[key];
  Object.assign(fresh, { triggers: scene.triggers, given: [...given, 'name'], doubts: doubtsOf(fit) });
  if (!fit.own) return fit.explained ? fresh : { ...fresh, untold: 'no curve explains this trace, and its own triggers could not be told' };
  const { times, timer_hz, until_curve } = fit.own, per = perSecond(unit);
  if (!given.includes('timer_hz')) fresh.timer_hz = timer_hz;
  return { ...fresh, times: fresh.times.map((t) => tidy(t + until_curve * per, 9)), measured: times.map((t) => tidy(t * per)), pulse: null, duty: null, min_pulse: null };
}

/** What is doubtful about a fit and all that is made of it. */
const doubtsOf = (fit) => [...(fit.tested ? [] : ['untested: there is too little dark to know the noise by']), ...fit.warnings.map(({ text }) => text)];

// Measures the speeds of several traces, one after the other.
async function measure(files) {
  const speeds = [];
  for (const [i, file] of files.entries()) {
    const busy = begin(`Measuring ${i + 1} of ${files.length}: ${file.name}`);
    const answer = await fitted(busy, file, { triggers: 12 });
    if (!answer) return;
    const fit = answer.Ok?.fit.Ok;
    const why = answer.Err?.reason ?? answer.Ok.fit.Err?.text;
    const told = fit ? [...fit.exposure, fit.scatter, fit.pulses].map((x) => tidy(x, 6)) : [0, 0, 0, 0];
    const [exposure, error, scatter, pulses] = told;
    const kind = fit ? (fit.own ? 'the trace itself' : fit.kind) : `not measured: ${why.split('\n')[0]}`;
    speeds.push({ name: file.name, kind, exposure, error, scatter, pulses, doubts: fit ? doubtsOf(fit) : [] });
  }
  tell({ busy: null });
  remember(speeds, files);
  change({ speeds });
}

const isNew = watch();

/** Draws the panel of the model's trace, of which the graph shows `samples`. */
export function draw({ now: { scene, trace }, pending }, samples) {
  const isHand = trace && !isSameShape(trace.scene, scene);
  if (isNew(trace, pending, scene.unit, isHand)) $('trace').replaceChildren(...panel(pending ?? trace, trace, pending, isHand, scene));
  if (isHand && samples && $('by-hand')) {
    write($('by-hand'), `Changed by hand since the fit: the curve now misses the trace by ${short(100 * rms(samples), 3)} % of the light, the fit by ${short(100 * trace.fit.rms, 3)} %. The flashes are those of the changed curve.`);
  }
}

function panel(shown, trace, pending, isHand, scene) {
  if (!shown) return [empty];
  const { file, name, measured, fit } = shown;
  let { asked } = shown;
  // What was chosen before may still be read.
  const again = (changes) => read(file, (asked = { ...asked, ...changes }));
  const parts = [element('h3', name)];
  const controls = form(shown, again);
  if (!fit) {
    parts.push(message({ text: pending.words, mend: pending.mend }, controls, 'p', { class: 'wrong' }));
    if (trace) parts.push(element('p', `The trace of ${trace.name} stays on the graph.`, { class: 'note' }));
  } else {
    if (isHand) {
      parts.push(element('p', '', { id: 'by-hand', class: 'wrong' }), button('Back to the fit', () => {
        const { times, inner, measured, untold } = inUnit(trace.scene, model.now.scene.unit);
        change({ scene: { ...model.now.scene, times, inner, measured, untold, ...(measured && { triggers: measured.length }) } });
      }));
    } else parts.push(results(fit));
    const warnings = element('ul', undefined, { class: 'warnings' });
    // Of a curve that is changed, only how the file is read is in doubt.
    warnings.append(...fit.warnings.filter(({ mend }) => mend || !isHand).map((warning) => message(warning, controls, 'li')));
    if (warnings.firstChild) parts.push(warnings);
  }
  parts.push(element('h4', 'How the file is read'), table(measured));
  parts.push(file ? controls : element('p', 'To read it otherwise, open the file again.', { class: 'note' }));
  if (fit && !isHand) parts.push(...details(fit, scene));
  const buttons = element('span', undefined, { class: 'buttons' });
  buttons.append(button('Replace it…', () => $('file').click()));
  if (trace) buttons.append(button('Remove the trace', () => change({ trace: null, scene: { ...model.now.scene } })));
  if (!fit) buttons.append(button('Close', () => tell({ note: null, pending: null })));
  parts.push(buttons);
  return parts;
}

// What is wrong or doubtful, with a button to what mends it.
function message({ text, mend }, controls, tag, attributes) {
  const p = element(tag, text, attributes);
  const control = mend && controls.querySelector(`[name=${mend}]`);
  const leads = button(control ? MEND[mend] : 'Open another file…', () => (control ?? $('file'))[control ? 'focus' : 'click']());
  if (control) control.classList.add('mend');
  if (control || tag === 'p') p.append(' ', leads);
  return p;
}

function results(fit) {
  const list = element('dl');
  const line = (what, fact) => {
    const row = element('div');
    row.append(element('dt', what), element('dd', fact));
    list.append(row);
  };
  line('fitted', fit.kind);
  line('exposure', `${fit.told} (standard error)`);
  line('residual', `${short(100 * fit.rms, 3)} % of the light (rms)`);
  line('test', !fit.explained ? 'the curve does not explain the trace'
    : fit.tested ? 'the curve explains the trace' : 'untested: there is too little dark to know the noise by');
  if (fit.own) line('flashes', 'at the trace’s own times, which are what is exported; the curve is drawn beside it');
  else if (fit.explained) line('flashes', 'by the curve');
  return list;
}

// The first rows of the file, with what each column is taken for.
function table({ names, rows, read }) {
  const made = element('table', undefined, { class: 'preview' });
  const [head, body] = [element('thead'), element('tbody')];
  const titles = element('tr');
  titles.append(element('th', 'line', { scope: 'col' }), ...names.map((name, i) => {
    const role = read && (i + 1 === read.time ? 'time' : i + 1 === read.signal ? 'light' : '');
    const title = element('th', name ?? `column ${i + 1}`, { scope: 'col', ...(role && { class: 'read' }) });
    if (role) title.append(element('small', ` ${role}`));
    return title;
  }));
  head.append(titles);
  body.append(...rows.map(([line, fields]) => {
    const row = element('tr');
    row.append(element('td', String(line)), ...names.map((_, i) => element('td', fields[i] ?? '')));
    return row;
  }));
  made.append(head, body);
  const scroll = element('div', undefined, { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'The first lines of the file' });
  scroll.append(made);
  return scroll;
}

function form({ asked, measured: { names, read }, fit }, again) {
  const made = element('fieldset', undefined, { class: 'reading' });
  made.append(element('legend', 'How the file is read', { class: 'sr' }));
  const add = (words, name, control) => {
    control.name = name;
    const label = element('label', words);
    label.append(control);
    made.append(label);
    return control;
  };
  const choice = (words, name, options, value, change) => {
    const select = element('select');
    select.append(...options.map(([value, words]) => element('option', words, { value })));
    select.value = String(value);
    add(words, name, select).onchange = () => again(change(select.value));
    return select;
  };
  const number = (words, name, value, placeholder) => {
    const input = add(words, name, element('input', undefined, { inputmode: 'decimal', placeholder }));
    input.value = value ?? '';
    input.onchange = () => {
      let x = null;
      try {
        x = parse(input.value, name === 'rate' ? 'rate' : 'part');
      } catch (error) {
        input.setCustomValidity(error.message);
        return input.reportValidity();
      }
      input.setCustomValidity('');
      again({ [name]: Number.isNaN(x) ? null : x });
    };
  };
  const count = Math.max(names.length, read?.columns ?? 0);
  const columns = Array.from({ length: count }, (_, i) => [i + 1, names[i] ? `${i + 1}: ${names[i]}` : `column ${i + 1}`]);
  const time = read ? (read.time ?? '') : count > 1 ? 1 : '';
  const signal = read?.signal ?? Math.min(2, count);
  const both = () => ({ columns: ['time', 'signal'].map((name) => made.elements[name].value).filter(Boolean).map(Number) });
  if (columns.length) {
    choice('time', 'time', [['', 'none: by the rate'], ...columns], time, both);
    choice('light', 'signal', columns, signal, both);
  }
  choice('unit of the time', 'unit', [['', 'as the file says'], ...UNITS.map((unit) => [unit, unit])], asked.unit ?? '', (unit) => ({ unit: unit || null, rate: null }));
  number('samples a second', 'rate', asked.rate ?? (read?.rate ? short(read.rate, 7) : ''), 'by the times');
  choice('in light the signal', 'rises', [['', fit ? `${fit.falls ? 'falls' : 'rises'}, by itself` : 'as it seems'], ['true', 'rises'], ['false', 'falls']],
    asked.rises ?? '', (value) => ({ rises: value ? value === 'true' : null }));
  number('signal of full light', 'full', asked.full, 'the peak');
  if (fit?.pulses > 1 || asked.frame) {
    choice('pulse', 'frame', Array.from({ length: Math.min(fit?.pulses ?? asked.frame, 200) }, (_, i) => [i + 1, `${i + 1} of ${fit?.pulses ?? '?'}`]), asked.frame ?? fit.pulse, (value) => ({ frame: Number(value) }));
  }
  return made;
}

function details(fit, { unit }) {
  const fold = (summary, ...parts) => {
    const made = element('details');
    made.append(element('summary', summary), ...parts);
    return made;
  };
  const per = perSecond(unit);
  const lines = fit.triggers.map(([t, error], i) => `${i}  ${short(t * per, 7)} ± ${short(error * per, 2)}`);
  const triggers = element('pre', `#  ${unit} after the start of opening, with standard error\n${lines.join('\n')}`, { tabindex: 0 });
  const made = fold(`The ${fit.triggers.length} times by the ${fit.own ? 'trace' : 'curve'}, with their errors`, triggers);
  return [made, fold('The whole report', element('pre', fit.report, { tabindex: 0 }))];
}
