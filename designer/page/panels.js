// What is seen beside the curve: facts, ticks, cost, the set-ups, the moving bar, a fit.

import { svg } from './graph.js';
import { perSecond, short } from './scene.js';

const $ = (id) => document.getElementById(id);
/** Longer tables lose their middle. */
const MOST_ROWS = 300;

export function element(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

/** All panels, for a scene and its plan. */
export function show(scene, plan, marks) {
  facts(scene, plan);
  ticks(scene, plan, marks);
  cost(plan);
  bars(plan, marks.length);
  setUps(scene, plan);
}

// The lines of `children`, made once and then only written.
function rows(parent, count, make) {
  while (parent.children.length > count) parent.lastChild.remove();
  while (parent.children.length < count) parent.append(make());
  return parent.children;
}

const write = (element, text) => {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(''));
  if (node.data !== text) node.data = text;
};

function facts(scene, plan) {
  const lines = rows($('facts'), plan.facts.length, () => {
    const line = element('div');
    line.append(element('dt'), element('dd'));
    return line;
  });
  plan.facts.forEach(([what, fact], i) => {
    write(lines[i].firstChild, what);
    write(lines[i].lastChild, fact);
  });
  // The closest gap beside what is required of it.
  const box = $('gap');
  box.hidden = Number.isNaN(plan.closest) || plan.min_gap === 0;
  if (box.hidden) return;
  if (!box.firstChild) {
    const bar = element('div', undefined, { class: 'meter', 'aria-hidden': true });
    bar.append(element('i'), element('b'));
    box.append(bar, element('p'));
  }
  const { closest, min_gap } = plan;
  const most = 1.25 * Math.max(closest, min_gap);
  const [bar, text] = box.children;
  bar.firstChild.style.width = `${(100 * closest) / most}%`;
  bar.lastChild.style.left = `${(100 * min_gap) / most}%`;
  const per = perSecond(scene.unit);
  write(text, `closest ${short(closest * per, 4)} ${scene.unit}; ${short(min_gap * per, 4)} ${scene.unit} required`);
}

function ticks(scene, plan, marks) {
  const { pulses } = plan;
  const table = $('ticks');
  const names = ['#', 'u', `time (${scene.unit})`, 'ticks', 'gap', ...(pulses.length ? ['on', 'off'] : [])];
  if (table.dataset.names !== String(names)) {
    table.dataset.names = names;
    table.style.setProperty('--columns', names.length);
    const head = element('tr');
    head.append(...names.map((name) => element('th', name, { scope: 'col' })));
    table.replaceChildren(element('thead'), element('tbody'));
    table.tHead.append(head);
  }
  const n = marks.length;
  const hidden = n > MOST_ROWS ? n - MOST_ROWS : 0;
  const lines = rows(table.tBodies[0], n - hidden, () => {
    const line = element('tr');
    line.append(...names.map(() => element('td')));
    return line;
  });
  write($('ticks-note'), hidden ? `without ${hidden} in the middle; the CSV has all` : `${n}`);
  const per = perSecond(scene.unit);
  for (let row = 0; row < lines.length; row++) {
    const i = hidden && row >= MOST_ROWS / 2 ? row + hidden : row;
    const { children } = lines[row];
    const [t, , u] = marks[i];
    write(children[0], String(i));
    write(children[1], u.toFixed(5));
    write(children[2], short(t * per, 6));
    write(children[3], String(plan.ticks[i]));
    write(children[4], i ? String(plan.ticks[i] - plan.ticks[i - 1]) : '–');
    if (pulses.length) {
      write(children[5], String(pulses[i][0]));
      write(children[6], String(pulses[i][1]));
    }
  }
}

function cost(plan) {
  const box = $('cost');
  if (!box.firstChild) {
    const table = element('table');
    const head = element('tr');
    head.append(...['call', 'typical', 'worst', 'code'].map((name) => element('th', name, { scope: 'col' })));
    table.append(element('thead'), element('tbody'));
    table.tHead.append(head);
    for (const { call, typical, worst, code } of plan.costs) {
      const row = element('tr');
      row.append(element('th', call.replaceAll('`', ''), { scope: 'row' }), element('td', String(typical)), element('td', String(worst)), element('td', String(code)));
      table.tBodies[0].append(row);
    }
    const note = `Cycles of a Cortex-M4F, modelled, and bytes of code: of the shutters measured in docs/cost.md, not of this one. A curve built by the compiler takes ${plan.bytes} bytes of flash.`;
    box.append(element('p', undefined, { class: 'direct' }), table, element('p', note, { class: 'note' }));
  }
  const n = plan.ticks.length;
  const { direct } = plan;
  write(box.firstChild, direct >= n ? `All ${n} triggers are placed without a search (up to ${direct} would be).`
    : direct ? `A frame of ${n} needs a search; frames of up to ${direct} do not.` : 'Triggers of this curve may need a search.');
}

const UP = 54;

function setUps(scene, plan) {
  const box = $('set-ups');
  if (!plan.set_ups.length) {
    box.replaceChildren(element('p', 'Drawn for up to 128 pulses.', { class: 'empty' }));
    return;
  }
  if (!box.querySelector('figure')) {
    box.replaceChildren(...plan.set_ups.map(({ title }) => {
      const figure = element('figure');
      const picture = svg('svg', { preserveAspectRatio: 'none', viewBox: `0 0 1000 ${2 * UP + 14}`, 'aria-hidden': true });
      for (const name of ['lamp-on', 'light', 'base', 'dose', 'full']) svg('path', { class: name }, picture);
      figure.append(element('figcaption', title), picture, element('p'));
      return figure;
    }), element('p', 'Outlined: the lamp is on. Filled: its light that arrives; below, each pulse’s dose against an equal pulse that nothing dims (dashed).', { class: 'note' }));
  }
  const { range, view } = scene;
  const X = (t) => ((t - range[0]) / (range[1] - range[0])) * 1000;
  const heights = (t) => view.at(t);
  plan.set_ups.forEach(({ is_shuttered, pulses }, i) => {
    const figure = box.children[i];
    const [on, light, base, dose, full] = figure.querySelectorAll('path');
    const f = (x) => x.toFixed(1);
    let [outline, filled, doses] = ['', '', ''];
    const bottom = 2 * UP + 12;
    for (const [from, to, part] of pulses) {
      const [a, b] = [f(X(from)), f(X(to))];
      outline += `M${a} ${UP}V4H${b}V${UP}`;
      filled += `M${a} ${UP}`;
      const steps = is_shuttered ? 6 : 1;
      for (let k = 0; k <= steps; k++) {
        const t = from + ((to - from) * k) / steps;
        filled += `L${f(X(t))} ${f(UP - (UP - 4) * (is_shuttered ? heights(t) : 1))}`;
      }
      filled += `L${b} ${UP}Z`;
      const middle = X(0.5 * (from + to));
      const half = Math.min(14, 380 / pulses.length);
      doses += `M${f(middle - half)} ${bottom}V${f(bottom - part * (UP - 14))}H${f(middle + half)}V${bottom}Z`;
    }
    on.setAttribute('d', outline);
    light.setAttribute('d', filled);
    base.setAttribute('d', `M0 ${UP}H1000M0 ${bottom}H1000`);
    dose.setAttribute('d', doses);
    full.setAttribute('d', `M0 ${bottom - (UP - 14)}H1000`);
    const parts = pulses.map(([, , part]) => 100 * part);
    const [least, most] = [Math.min(...parts), Math.max(...parts)].map((x) => short(x, 3));
    const lengths = pulses.map(([from, to]) => (to - from) * perSecond(scene.unit));
    const [shortest, longest] = [Math.min(...lengths), Math.max(...lengths)].map((x) => short(x, 3));
    const between = (a, b, unit) => (b - a <= 0.01 * b ? `${b} ${unit}` : `${a} to ${b} ${unit}`);
    write(figure.lastChild, `doses ${between(least, most, '%')}; pulses of ${between(shortest, longest, scene.unit)}`);
  });
}

// From linear light to the bytes of a picture: a warm white.
const WARM = [255, 244, 224];
const encode = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

function bars(plan, n) {
  const box = $('exposed');
  if (!box.firstChild) {
    for (let i = 0; i < 2; i++) {
      const figure = element('figure');
      figure.append(element('figcaption'), element('canvas', undefined, { width: 480, height: 1, role: 'img' }));
      box.append(figure);
    }
    box.append(element('p', undefined, { class: 'note' }));
  }
  const names = ['ideal: the curve itself', `${n} ${plan.pulses.length ? 'pulses' : 'flashes'}`];
  [plan.ideal, plan.triggered].forEach((light, i) => {
    const [caption, canvas] = box.children[i].children;
    write(caption, names[i]);
    canvas.setAttribute('aria-label', `The exposed bar, ${names[i]}`);
    const context = canvas.getContext('2d');
    const picture = context.createImageData(480, 1);
    light.forEach((x, column) => {
      const value = encode(0.012 + 0.988 * Math.min(1, Math.max(0, x)));
      for (let k = 0; k < 3; k++) picture.data[4 * column + k] = WARM[k] * value;
      picture.data[4 * column + 3] = 255;
    });
    context.putImageData(picture, 0, 0);
  });
  const squares = plan.ideal.reduce((sum, x, i) => sum + (x - plan.triggered[i]) ** 2, 0);
  write(box.lastChild, `The pictures differ by ${short(100 * Math.sqrt(squares / 480), 2)} % of the brightest (rms). More triggers, or a wider bar, and the steps vanish.`);
}

/** A fit, and a button that takes the trace away. */
export function fitted(name, fit, remove) {
  const box = $('trace');
  const list = element('dl');
  const line = (what, fact) => {
    const row = element('div');
    row.append(element('dt', what), element('dd', fact));
    list.append(row);
  };
  line('trace', name);
  line('fitted', `${fit.kind}: ${fit.because}`);
  line('exposure', `${fit.exposure} (standard error)`);
  line('residual', `${short(100 * fit.rms, 3)} % of the light (rms)`);
  const picture = svg('svg', { viewBox: '0 0 1000 80', preserveAspectRatio: 'none', role: 'img', 'aria-label': 'The residual over time' });
  const first = fit.samples[0][0], last = fit.samples.at(-1)[0];
  const sizes = fit.samples.map(([, , r]) => Math.abs(r)).sort((a, b) => a - b);
  // Edges within one sample would hide all else.
  const most = 1.4 * Math.max(sizes[Math.floor(0.99 * (sizes.length - 1))], 1e-5);
  const points = fit.samples.map(([t, , r]) => `${((1000 * (t - first)) / (last - first)).toFixed(1)} ${(40 - (38 * Math.max(-most, Math.min(most, r))) / most).toFixed(1)}`);
  svg('path', { class: 'trace', d: `M${points.join('L')}` }, picture);
  svg('path', { class: 'curve', d: 'M0 40H1000' }, picture);
  const figure = element('figure');
  figure.append(element('figcaption', `residual, ±${short(100 * most, 2)} % of the light`), picture);
  const warnings = element('ul', undefined, { class: 'warnings' });
  warnings.append(...fit.warnings.map((warning) => element('li', warning)));
  const details = element('details');
  details.append(element('summary', 'The whole report'), element('pre', fit.report, { tabindex: 0 }));
  const button = element('button', 'Remove the trace', { type: 'button' });
  button.onclick = remove;
  box.replaceChildren(list, figure, ...(fit.warnings.length ? [warnings] : []), details, button);
}
