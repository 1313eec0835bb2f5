// A measured trace: how its file is read, its fit, and what is doubtful about either.

import { $, element } from './dom.js';
import { parse } from './numbers.js';
import { told } from './save.js';
import { UNITS, fromScene, inUnit, perSecond, short } from './scene.js';
import * as studio from './studio.js';

/** Longer files are not read. */
const LONGEST_TRACE = 256 << 20, LONGEST_SCENE = 1 << 20;
/** What the button beside a message says, which leads to the control that mends it. */
const MEND = { rate: 'Give the rate', unit: 'Choose the unit', signal: 'Choose the columns', rises: 'Say which way', full: 'Give full light', frame: 'Choose the pulse' };

const empty = $('trace').firstElementChild;
// Who came last: an answer that is late must not overwrite what came after.
let newest = 0;

/** Opens a file: a scene, or a trace, which is fitted. */
export function bring(page, file) {
  return /\.toml$/i.test(file.name) ? open(page, file) : read(page, file, {});
}

async function open(page, file) {
  const mine = ++newest;
  const name = file.name.replace(/\.toml$/i, '');
  const refuse = (words) => say(page, `${file.name}: ${words}`, true);
  if (file.size > LONGEST_SCENE) return refuse('this is too long for a scene');
  const answer = await studio.parse(name, await file.text());
  if (mine !== newest || !answer) return;
  if (answer.Err) return refuse([answer.Err.reason, ...answer.Err.notes].join('\n'));
  page.change({ scene: fromScene(name, answer.Ok), trace: null });
  told(`Opened ${file.name}.`);
}

// Reads the trace in a file as is asked for, and fits it.
async function read(page, file, asked) {
  const mine = ++newest;
  if (file.size > LONGEST_TRACE) return say(page, `${file.name}: ${file.size >> 20} MB: cut the trace to the pulse`, true);
  const p = say(page, `Reading ${file.name} …`);
  const stop = element('button', 'Stop', { type: 'button' });
  stop.onclick = () => studio.cancel();
  p.append(' ', stop);
  const { triggers } = page.screen.scene;
  const answer = await studio.fit(file.name, { ...asked, triggers }, file, (share) => (p.firstChild.data = `Fitting ${file.name}: ${Math.round(100 * share)} % …`));
  if (mine !== newest || !answer) return;
  if (answer.Err) return say(page, `${file.name}: ${answer.Err.reason}`, true);
  const trace = { file, asked, measured: answer.Ok, fit: answer.Ok.fit.Ok };
  if (!trace.fit) return render(page, trace);
  // The fit is of the shutter: triggers, lamp and gap are whose they were.
  const { scene } = page.screen;
  const fitted = inUnit(fromScene(file.name.replace(/\.\w+$/, ''), trace.fit.scene), scene.unit);
  page.change({ scene: { ...scene, name: fitted.name, times: fitted.times, inner: fitted.inner, spare: { ...scene.spare, inner: null } }, trace });
}

function say(page, words, isWrong) {
  const p = element('p', words, { class: isWrong ? 'wrong' : 'empty', role: isWrong ? 'alert' : 'status' });
  $('trace').replaceChildren(p, ...stays(page), ...(page.screen.trace ? [remove(page)] : []));
  return p;
}

// What is still on the graph, and is not what was opened last.
function stays(page) {
  const { trace } = page.screen;
  return trace ? [element('p', `The trace of ${trace.file.name} stays on the graph.`, { class: 'note' })] : [];
}

function remove(page) {
  const button = element('button', page.screen.trace ? 'Remove the trace' : 'Close', { type: 'button' });
  button.onclick = () => {
    newest++;
    if (page.screen.trace) page.change({ trace: null });
    else show(page);
  };
  return button;
}

/** Shows what belongs to the screen: its trace, or none. */
export function show(page) {
  const { trace } = page.screen;
  if (trace) render(page, trace);
  else $('trace').replaceChildren(empty);
}

function render(page, trace) {
  const { file, asked, measured, fit } = trace;
  const again = (changes) => read(page, file, { ...asked, ...changes });
  const parts = [element('h3', file.name)];
  const controls = form(trace, again);
  if (!fit) parts.push(message(measured.fit.Err, controls, 'p', { class: 'wrong', role: 'alert' }), ...stays(page));
  else {
    parts.push(results(fit));
    const warnings = element('ul', undefined, { class: 'warnings' });
    warnings.append(...fit.warnings.map((warning) => message(warning, controls, 'li')));
    if (fit.warnings.length) parts.push(warnings);
  }
  parts.push(element('h4', 'How the file is read'), table(measured), controls);
  if (fit) parts.push(...details(fit, page.screen.scene));
  const buttons = element('span', undefined, { class: 'buttons' });
  const other = element('button', 'Replace it…', { type: 'button' });
  other.onclick = () => $('file').click();
  buttons.append(other, remove(page));
  parts.push(buttons);
  $('trace').replaceChildren(...parts);
}

// What is wrong or doubtful, with a button to what mends it.
function message({ text, mend }, controls, tag, attributes) {
  const p = element(tag, text, attributes);
  const control = mend && controls.querySelector(`[name=${mend}]`);
  const button = element('button', control ? MEND[mend] : 'Open another file…', { type: 'button' });
  button.onclick = () => (control ?? $('file'))[control ? 'focus' : 'click']();
  if (control) control.classList.add('mend');
  if (control || tag === 'p') p.append(' ', button);
  return p;
}

function results(fit) {
  const list = element('dl');
  const line = (what, fact) => {
    const row = element('div');
    row.append(element('dt', what), element('dd', fact));
    list.append(row);
  };
  line('fitted', `${fit.kind}: ${fit.because}`);
  line('exposure', `${fit.exposure} (standard error)`);
  line('residual', `${short(100 * fit.rms, 3)} % of the light (rms)`);
  line('test', !fit.explained ? `structure that the curve has not: ${short(100 * fit.structure, 2)} % of the light`
    : fit.tested ? 'the curve explains the trace' : 'untested: there is too little dark to know the noise by');
  line('triggers', fit.from_trace ? 'by the trace itself, which the curve does not explain: below' : 'by the curve');
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
        x = parse(input.value);
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
  const both = (time, signal) => ({ columns: (time ? [time, signal] : [signal]).map(Number) });
  if (columns.length) {
    choice('time', 'time', [['', 'none: by the rate'], ...columns], time, (value) => both(value, signal));
    choice('light', 'signal', columns, signal, (value) => both(time, value));
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
  const triggers = element('pre', `#  ${unit} after the opening, with standard error\n${lines.join('\n')}`, { tabindex: 0 });
  const made = fold(`The triggers by the ${fit.from_trace ? 'trace' : 'curve'}, with their errors`, triggers);
  made.open = fit.from_trace;
  return [made, fold('The whole report', element('pre', fit.report, { tabindex: 0 }))];
}
