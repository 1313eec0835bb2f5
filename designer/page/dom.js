// Elements of the page.

import { KINDS } from './scene.js';

export const $ = (id) => document.getElementById(id);

/** A key's name, as its field has it on the page; another word is its own. */
export const label = (id) => id === 'fully_open' ? 'flashes while fully open'
  : Object.hasOwn(KINDS, id) ? $(id).labels[0].firstChild.data.trim().replace(/,$/, '') : id;

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
