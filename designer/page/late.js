// The panels further down, ticks and set-ups, which are written when they are seen.

import { $, element, rows, svg, write as put } from './dom.js';
import { openness } from './graph.js';
import { perSecond, short } from './scene.js';

/** Longer tables lose their middle. */
const MOST_ROWS = 300;

/** Writes a panel of the model. */
export function write(id, { now: { scene }, view, isDraft }) {
  const plan = view?.plan.Ok;
  if (!plan) return;
  if (id === 'ticks') ticks(scene, plan, view.marks, isDraft);
  if (id === 'set-ups') setUps(scene, plan, view);
}

// The rows that are in sight.
let sight = [0, 20];
const box = $('ticks').parentElement;
box.onscroll = () => {
  const row = box.scrollHeight / $('ticks').rows.length;
  sight = [box.scrollTop / row - 2, (box.scrollTop + box.clientHeight) / row];
};

// As the CSV has it, in the scene's unit. Of a draft, as while a handle is dragged, only what is in sight is written.
function ticks(scene, plan, marks, isDraft) {
  const { pulses, delay } = plan;
  const table = $('ticks');
  const names = ['#', 'share', `time, ${scene.unit}`, 'ticks', 'gap', ...(delay == null ? [] : ['from sync']), ...(pulses.length ? ['on', 'off'] : [])];
  if (table.dataset.names !== String(names)) {
    table.dataset.names = names;
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
    if (isDraft && (row < sight[0] || row > sight[1])) continue;
    const i = hidden && row >= MOST_ROWS / 2 ? row + hidden : row;
    const [t, , u] = marks[i], tick = plan.ticks[i];
    const cells = [i, u.toFixed(5), short(t * per, 6), tick, i ? tick - plan.ticks[i - 1] : '–', ...(delay == null ? [] : [delay + tick]), ...(pulses[i] ?? [])];
    cells.forEach((cell, k) => put(lines[row].children[k], String(cell)));
  }
}

const UP = 54;
const TITLES = ['The camera stays open, and equal pulses at the triggers stand in for the shutter',
  'The shutter is in the light’s path: it dims the same pulses', 'The shutter is in the light’s path: pulses that are made for it get equal light through it'];

function setUps(scene, plan, view) {
  const box = $('set-ups');
  if (!plan.set_ups.length) {
    box.replaceChildren(element('p', scene.measured ? 'Drawn where a curve tells the triggers.' : 'Drawn for up to 128 pulses.', { class: 'empty' }));
    return;
  }
  if (!box.querySelector('figure')) {
    box.replaceChildren(...TITLES.map((title) => {
      const figure = element('figure');
      const picture = svg('svg', { preserveAspectRatio: 'none', viewBox: `0 0 1000 ${2 * UP + 14}`, 'aria-hidden': true });
      for (const name of ['lamp-on', 'light', 'base', 'dose', 'full']) svg('path', { class: name }, picture);
      figure.append(element('figcaption', title), picture, element('p'));
      return figure;
    }), element('p', 'Outlined: the lamp is on. Filled: its light that arrives; below, each pulse’s dose against an equal pulse that nothing dims (dashed).', { class: 'note' }));
  }
  const [start, , , end] = view.times;
  const X = (t) => 50 + ((t - start) / (end - start)) * 900;
  plan.set_ups.forEach(({ is_shuttered, pulses }, i) => {
    const figure = box.children[i];
    const middles = pulses.map(([from, to]) => X(0.5 * (from + to)));
    const half = Math.min(14, ...middles.slice(1).map((x, k) => 0.45 * (x - middles[k])));
    const [on, light, base, dose, full] = figure.querySelectorAll('path');
    const f = (x) => x.toFixed(1);
    let [outline, filled, doses] = ['', '', ''];
    const bottom = 2 * UP + 12;
    for (const [k, [from, to, part]] of pulses.entries()) {
      const [a, b] = [f(X(from)), f(X(to))];
      outline += `M${a} ${UP}V4H${b}V${UP}`;
      filled += `M${a} ${UP}`;
      const steps = is_shuttered ? 6 : 1;
      for (let step = 0; step <= steps; step++) {
        const t = from + ((to - from) * step) / steps;
        filled += `L${f(X(t))} ${f(UP - (UP - 4) * (is_shuttered ? openness(view, t) : 1))}`;
      }
      filled += `L${b} ${UP}Z`;
      doses += `M${f(middles[k] - half)} ${bottom}V${f(bottom - part * (UP - 14))}H${f(middles[k] + half)}V${bottom}Z`;
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
