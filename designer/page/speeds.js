// A shutter tester's table: the speeds of several traces.

import { $, button, element, watch } from './dom.js';
import { change } from './model.js';
import { dial, nearest, stops } from './panels.js';
import { short } from './scene.js';

let loadTraces;
// The files of this visit, by their names.
const files = new Map();
export const remember = (list) => list.forEach((file) => files.set(file.name, file));

const isNew = watch();

export function draw({ now: { speeds } }) {
  if (!isNew(speeds)) return;
  $('speeds').hidden = !speeds;
  if (!speeds) return;
  const head = element('tr');
  head.append(...['trace', 'speed', 'measured', 'off by', 'spread', 'pulses', 'told by'].map((name) => element('th', name, { scope: 'col' })));
  const body = element('tbody');
  body.append(...speeds.toSorted((a, b) => (a[2] || Infinity) - (b[2] || Infinity)).map(row));
  const table = element('table');
  table.append(element('thead'), body);
  table.tHead.append(head);
  $('speeds-table').replaceChildren(table);
}

function row([name, kind, exposure, error, scatter, pulses]) {
  const made = element('tr');
  const title = element('th', undefined, { scope: 'row' });
  const file = files.get(name);
  title.append(file ? button(name, async () => (await loadTraces()).bring([file]), { class: 'plain', title: 'Show this trace' }) : name);
  const speed = nearest(exposure);
  const [by, unit] = exposure < 1 ? [1000, 'ms'] : [1, 's'];
  // The last digit of each is of the same size.
  const off = short(error * by, 1), places = Math.min(9, Math.max(0, -Math.floor(Math.log10(off))));
  const cells = exposure ? [speed ? dial(speed) : '–', `${(exposure * by).toFixed(places)} ± ${off} ${unit}`, speed ? stops(exposure, speed) : '–',
    pulses > 1 ? `${short(100 * scatter, 2)} %` : '–', pulses, kind] : ['–', '–', '–', '–', '–', kind];
  made.append(title, ...cells.map((cell) => element('td', String(cell))));
  return made;
}

/** Begins; what fits a trace is loaded when one is shown. */
export function start(loads) {
  loadTraces = loads;
  $('speeds-print').onclick = () => print();
  $('speeds-close').onclick = () => change({ speeds: null });
  $('speeds-link').onclick = () => $('link').click();
}
