// The table of ticks, which is written when it is seen.

import { html, nothing, render } from './lit-html.js';
import { $, watch } from './dom.js';
import { doubt, rounding } from './facts.js';
import { perSecond, short } from './scene.js';

/** Longer tables lose their middle. */
const MOST_ROWS = 300;

const isNewTicks = watch();
// The rows as they are written.
let tickRows = [];

/** As the CSV has it, in the scene's unit. Of a draft, as while a handle is dragged, only the rows in sight are written. */
export function drawTicks({ now: { scene }, view, isDraft }) {
  const plan = view?.plan.Ok;
  if (!plan || !isNewTicks(view, scene.unit, isDraft)) return;
  const { pulses, delay, early, ticks } = plan, { marks } = view;
  // Without a timer there are no ticks.
  const isTimed = scene.timer_hz !== null;
  const names = ['#', 'share', `time, ${scene.unit}`, ...(isTimed ? ['ticks', 'gap', ...(delay === null ? [] : ['from sync']), ...(pulses.length ? ['on', 'off'] : [])] : [])];
  const n = marks.length, hidden = Math.max(0, n - MOST_ROWS), per = perSecond(scene.unit);
  const box = $('ticks').parentElement, row = box.scrollHeight / (n - hidden + 1);
  const isInSight = (k) => !isDraft || (k > box.scrollTop / row - 2 && k < (box.scrollTop + box.clientHeight) / row);
  const written = tickRows.length === n - hidden && tickRows;
  tickRows = Array.from({ length: n - hidden }, (_, k) => {
    if (written && !isInSight(k)) return written[k];
    const i = hidden && k >= MOST_ROWS / 2 ? k + hidden : k;
    const [t, , u] = marks[i], tick = ticks[i];
    const cells = [i, u.toFixed(5), short(t * per, 6), ...(isTimed ? [tick, i ? tick - ticks[i - 1] : '–', ...(delay === null ? [] : [delay + tick]), ...(pulses[i] ?? []).map((edge) => edge - early)] : [])];
    return html`<tr>${cells.map((cell) => html`<td>${cell}</td>`)}</tr>`;
  });
  render(html`${hidden ? `without ${hidden} in the middle; the CSV has all` : n}${plan.coarse ? doubt(rounding(plan)) : nothing}`, $('ticks-note'));
  render(html`<thead><tr>${names.map((name) => html`<th scope="col">${name}</th>`)}</tr></thead><tbody>${tickRows}</tbody>`, $('ticks'));
}
