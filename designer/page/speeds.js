// A shutter tester's table: the speeds of several traces.

import { html, render } from 'lit-html';
import { $ } from './dom.js';
import { copyLink } from './export.js';
import { doubt, stops } from './facts.js';
import { change, model } from './model.js';
import { dial, taken } from './numbers.js';
import { short } from './scene.js';
import { readTrace, rowFiles } from './trace.js';

const COLUMNS = ['trace', 'measured', 'nearest full stop', 'on the dial', 'off by', 'spread', 'pulses', 'told by'];

/** Draws it; while it is there, it is all there is, but for a trace that is refused. */
export function drawSpeeds({ now: { speeds }, pending }) {
  const isShown = Boolean(speeds && !pending);
  $('speeds').hidden = !isShown;
  document.body.classList.toggle('alone', isShown);
  if (!isShown) return;
  const rows = speeds.toSorted((a, b) => (a.exposure || Infinity) - (b.exposure || Infinity));
  const button = (id, words, act) => html`<button type="button" id="speeds-${id}" @click=${act}>${words}</button>`;
  render(html`<div class="head"><h2 id="speeds-title">Speeds of this shutter</h2><span class="buttons">
      ${button('link', 'Copy link', () => copyLink({ ...model.now, scene: model.good }))}
      ${button('print', 'Print', () => print())}${button('close', 'Close', () => change({ speeds: null }))}</span></div>
    <div class="scroll" tabindex="0" role="region" aria-label="Table of speeds" id="speeds-table"><table role="table">
      <thead><tr>${COLUMNS.map((name) => html`<th scope="col">${name}</th>`)}</tr></thead>
      <tbody role="rowgroup">${rows.map((row) => line(row, speeds))}</tbody></table></div>
    <p id="speeds-told" role="status" class="note"></p>
    <p class="note">Measured: how long a shutter that is fully open would take for as much light, ± one standard error.
      Nearest full stop: of 1/125, 1/60, 1/30 and so on; what the dial says is yours to tell. Spread: by how much the
      pulses of a trace differ.</p>`, $('speeds'));
}

function line(row, speeds) {
  const { name, kind, exposure, error, near, scatter, pulses, doubts } = row;
  const file = rowFiles.get(row);
  const show = () => readTrace(file, {});
  const link = html`<button type="button" class="plain" title="Show this trace" @click=${show}>${name}</button>`;
  const of = (cells) => html`<tr role="row"><th scope="row" role="rowheader">${file ? link : name}</th>
    ${cells.map((it, i) => html`<td role="cell" data-label=${COLUMNS[i + 1]}><span>${it}</span></td>`)}</tr>`;
  if (!exposure) return of([...Array(6).fill('–'), kind]);
  const [by, unit] = exposure < 1 ? [1000, 'ms'] : [1, 's'];
  // The last digit of each is of the same size.
  const off = short(error * by, 1), places = Math.min(9, Math.max(0, -Math.floor(Math.log10(off))));
  const says = (dial) => {
    const told = { ...row, dial };
    if (file) rowFiles.set(told, file);
    change({ speeds: speeds.with(speeds.indexOf(row), told) });
  };
  const asked = html`<input aria-label="${name}: on the dial" placeholder="1/…" .value=${row.dial ? dial(row.dial) : ''}
    @change=${taken('dial', says, 's', (x) => x > 0 && x < Infinity)}>`;
  return of([
    html`${(exposure * by).toFixed(places)} ± ${off} ${unit}${doubts.map(doubt)}`, near ? dial(near) : '–', asked,
    row.dial ? stops(exposure, row.dial) : '–', pulses > 1 ? `${short(100 * scatter, 2)} %` : '–', pulses, kind,
  ]);
}
