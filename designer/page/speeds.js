// A shutter tester's table: the speeds of several traces.

import { $, button, element, watch } from './dom.js';
import { change, model } from './model.js';
import { dial, nearest } from './panels.js';
import { short } from './scene.js';

let loadTraces;
// The file of each row of this visit: two may have one name.
const files = new WeakMap();
export const remember = (rows, list) => rows.forEach((row, i) => files.set(row, list[i]));

const isNew = watch();

export function draw({ now: { speeds } }) {
  if (!isNew(speeds)) return;
  $('speeds').hidden = !speeds;
  if (!speeds) return;
  const head = element('tr');
  head.append(...['trace', 'measured', 'nearest full stop', 'spread', 'pulses', 'told by'].map((name) => element('th', name, { scope: 'col' })));
  const body = element('tbody');
  body.append(...speeds.toSorted((a, b) => (a.exposure || Infinity) - (b.exposure || Infinity)).map(row));
  const table = element('table');
  table.append(element('thead'), body);
  table.tHead.append(head);
  $('speeds-table').replaceChildren(table);
}

function row(told) {
  const { name, kind, exposure, error, scatter, pulses, doubts } = told;
  const made = element('tr');
  const title = element('th', undefined, { scope: 'row' });
  const file = files.get(told);
  title.append(file ? button(name, async () => (await loadTraces()).bring([file]), { class: 'plain', title: 'Show this trace' }) : name);
  const speed = nearest(exposure);
  const [by, unit] = exposure < 1 ? [1000, 'ms'] : [1, 's'];
  // The last digit of each is of the same size.
  const off = short(error * by, 1), places = Math.min(9, Math.max(0, -Math.floor(Math.log10(off))));
  const cells = exposure ? [`${(exposure * by).toFixed(places)} ± ${off} ${unit}`, speed ? dial(speed) : '–',
    pulses > 1 ? `${short(100 * scatter, 2)} %` : '–', pulses, kind] : ['–', '–', '–', '–', kind];
  made.append(title, ...cells.map((cell) => element('td', String(cell))));
  made.children[exposure ? 1 : 0].append(...doubts.map((words) => element('small', words, { class: 'doubt' })));
  return made;
}

/** Begins; what fits a trace is loaded when one is shown. */
export function start(loads) {
  loadTraces = loads;
  $('speeds-print').onclick = () => print();
  $('speeds-close').onclick = () => change({ speeds: null });
  // Of the table, whatever is typed beside it just now.
  $('speeds-link').onclick = async () => (await import('./share.js')).link({ ...model.now, scene: model.good });
}
