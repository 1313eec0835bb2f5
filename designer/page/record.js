// The record as it was read, in the file's own time, on which a window is dragged.

import { html } from 'lit-html';
import { perSecond, short, tidy } from './scene.js';

const WIDTH = 400, HEIGHT = 96, BOTTOM = 18, DRAG = 4;

/** A reading's whole record: that of the reading before, where only the window differs. */
export function whole(raw, asked, before) {
  const rest = ({ from, to, frame, full, light, sync, ...rest }) => JSON.stringify(rest);
  return before?.record?.length && rest(asked) === rest(before.asked) ? before.record : raw;
}

/** It, with the window that counts; `take(from, to)` takes another, in seconds, or none. */
export function drawRecord(record, { from, to }, unit, take) {
  if (!record?.length) return '';
  const per = perSecond(unit), [[start], [end]] = [record[0], record.at(-1)], length = end - start || 1;
  const values = record.map(([, v]) => v), [low, high] = [Math.min(...values), Math.max(...values)];
  const x = (t) => ((t - start) / length) * WIDTH;
  const y = (v) => 4 + (HEIGHT - 8 - BOTTOM) * (1 - (v - low) / (high - low || 1));
  const path = `M${record.map(([t, v]) => `${x(t).toFixed(1)} ${y(v).toFixed(1)}`).join('L')}`;
  const bar = (a, b) => ({ x: Math.max(0, Math.min(x(a), x(b))), width: Math.min(WIDTH, Math.abs(x(b) - x(a))) });
  const shown = bar(from ?? start, to ?? end);
  const label = (part) => html`<span>${short(tidy((start + part * length) * per, 3), 4)}</span>`;
  const labels = [0, 0.25, 0.5, 0.75, 1].map(label);
  const grab = (event) => {
    const box = event.currentTarget, { left, width } = box.getBoundingClientRect(), mark = box.querySelector('rect');
    const at = ({ clientX }) => start + length * Math.min(1, Math.max(0, (clientX - left) / width));
    const first = event.clientX, t = at(event);
    box.setPointerCapture(event.pointerId);
    box.onpointermove = (event) => {
      for (const [name, value] of Object.entries(bar(t, at(event)))) mark.setAttribute(name, value);
    };
    box.onpointerup = box.onpointercancel = (event) => {
      box.onpointermove = box.onpointerup = box.onpointercancel = null;
      const ends = [t, at(event)].sort((a, b) => a - b).map((t) => tidy(t, 6));
      if (event.type === 'pointerup' && Math.abs(event.clientX - first) >= DRAG) take(...ends);
      else for (const [name, value] of Object.entries(shown)) mark.setAttribute(name, value);
    };
  };
  return html`<div class="record" aria-hidden="true" title="Drag over the part that counts"
    @pointerdown=${grab} @dblclick=${() => take(null, null)}>
    <svg viewBox="0 0 ${WIDTH} ${HEIGHT - BOTTOM}" preserveAspectRatio="none">
    <rect y="0" height=${HEIGHT} x=${shown.x} width=${shown.width} /><path d=${path} /></svg><div>${labels}</div></div>
    <p class="note">Drag over the part that counts (${unit} of the file)${from != null || to != null
      ? html`; <button type="button" class="plain" @click=${() => take(null, null)}>take the whole record</button>`
      : ''}.</p>`;
}
