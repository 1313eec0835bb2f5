// The panels further down: ticks, cost, the moving bar, the set-ups.

import { $, element, rows, write as put } from './dom.js';
import { openness } from './graph.js';
import { perSecond, short } from './scene.js';
import { svg } from './svg.js';

/** Longer tables lose their middle. */
const MOST_ROWS = 300;

/** Writes a panel. */
export function write(id, scene, view, range) {
  const plan = view.plan.Ok;
  if (id === 'ticks') ticks(scene, plan, view.marks);
  if (id === 'cost') cost(plan);
  if (id === 'exposed') bars(plan, view.marks.length);
  if (id === 'set-ups') setUps(scene, plan, view, range);
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
  put($('ticks-note'), hidden ? `without ${hidden} in the middle; the CSV has all` : `${n}`);
  const per = perSecond(scene.unit);
  for (let row = 0; row < lines.length; row++) {
    const i = hidden && row >= MOST_ROWS / 2 ? row + hidden : row;
    const { children } = lines[row];
    const [t, , u] = marks[i];
    put(children[0], String(i));
    put(children[1], u.toFixed(5));
    put(children[2], short(t * per, 6));
    put(children[3], String(plan.ticks[i]));
    put(children[4], i ? String(plan.ticks[i] - plan.ticks[i - 1]) : '–');
    if (pulses.length) {
      put(children[5], String(pulses[i][0]));
      put(children[6], String(pulses[i][1]));
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
    const note = `Cycles of a Cortex-M4F, modelled, and bytes of code: of the shutters measured in docs/internals/cost.md, not of this one. A curve built by the compiler takes ${plan.bytes} bytes of flash.`;
    box.append(element('p', undefined, { class: 'direct' }), table, element('p', note, { class: 'note' }));
  }
  const n = plan.ticks.length;
  const { direct } = plan;
  put(box.firstChild, direct >= n ? `All ${n} triggers are placed without a search (up to ${direct} would be).`
    : direct ? `A frame of ${n} needs a search; frames of up to ${direct} do not.` : 'Triggers of this curve may need a search.');
}

const UP = 54;

function setUps(scene, plan, view, range) {
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
  const X = (t) => ((t - range[0]) / (range[1] - range[0])) * 1000;
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
        filled += `L${f(X(t))} ${f(UP - (UP - 4) * (is_shuttered ? openness(view, t) : 1))}`;
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
    put(figure.lastChild, `doses ${between(least, most, '%')}; pulses of ${between(shortest, longest, scene.unit)}`);
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
    put(caption, names[i]);
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
  put(box.lastChild, `The pictures differ by ${short(100 * Math.sqrt(squares / 480), 2)} % of the brightest (rms). More triggers, or a wider bar, and the steps vanish.`);
}
