// The table of ticks.

import { html, nothing, render } from 'lit-html';
import { $ } from './dom.js';
import { doubt, doubtsOf } from './facts.js';
import { perSecond } from './scene.js';

/** Longer tables lose their middle. */
const MOST_ROWS = 100;

/** As the CSV has it, in the scene's unit. */
export function drawTicks(model) {
  const { now: { scene: { unit, flashes: { timer_hz } } }, view } = model;
  const plan = view?.plan.Ok, coarse = doubtsOf(model).find(({ about }) => about === 'timer')?.text;
  if (!plan) return;
  const { pulses, delay, ticks } = plan, { marks } = view;
  const n = marks.length, hidden = Math.max(0, n - MOST_ROWS), per = perSecond(unit);
  const places = Math.min(12, Math.max(0, 5 - Math.floor(Math.log10(Math.abs(marks.at(-1)[0] * per)))));
  // Without a timer there are no ticks.
  const columns = [
    ['#', (i) => i], ['share', (i) => marks[i][2].toFixed(5)],
    [`time, ${unit}`, (i) => (marks[i][0] * per).toFixed(places)],
    ...(timer_hz === null ? [] : [
      ['ticks', (i) => ticks[i]], ['gap', (i) => (i ? ticks[i] - ticks[i - 1] : '–')],
      ...(delay === null ? [] : [['from sync', (i) => delay + ticks[i]]]),
      ...(pulses.length ? [['on', (i) => pulses[i][0]], ['off', (i) => pulses[i][1]]] : []),
    ]),
  ];
  const rows = Array.from({ length: n - hidden }, (_, k) => {
    const i = hidden && k >= MOST_ROWS / 2 ? k + hidden : k;
    return html`<tr>${columns.map(([, of]) => html`<td>${of(i)}</td>`)}</tr>`;
  });
  const heads = columns.map(([name]) => html`<th scope="col">${name}</th>`);
  const many = hidden ? `without ${hidden} in the middle; the CSV has all` : n;
  render([many, coarse ? doubt(coarse) : nothing], $('ticks-note'));
  render(html`<thead><tr>${heads}</tr></thead><tbody>${rows}</tbody>`, $('ticks'));
}
