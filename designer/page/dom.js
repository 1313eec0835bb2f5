// Elements of the page.

import { html, nothing } from 'lit-html';

export const $ = (id) => document.getElementById(id);

/** A choice of one of some, each [value, words], with an `id` or a `name`; a choice stays till the value moves. */
export function choice(words, { options, value, ...more }) {
  const option = ([of, words]) => html`<option value=${of} ?selected=${String(of) === String(value)}>${words}</option>`;
  return html`<label>${words} <select id=${more.id ?? nothing} name=${more.name ?? nothing} ?disabled=${more.disabled}
    .value=${String(value)} @change=${more.changed}>${options.map(option)}</select></label>`;
}

/** A place as a picture takes it, however far outside it is. */
export const atMost = (x) => Math.min(Math.max(x, -1e5), 1e5).toFixed(1);

export function write(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Tells whether any of the things it is called with is another one than the last time. */
export function watch() {
  let last;
  return (...things) => {
    const isSame = last?.every((thing, i) => Object.is(thing, things[i]));
    last = things;
    return !isSame;
  };
}
