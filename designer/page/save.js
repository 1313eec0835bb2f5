// Copies words, saves files, and tells of it in a line.

import { $ } from './dom.js';

/** Tells in a line what was done. */
export function told(words) {
  $('told').textContent = words;
}

/** Copies words, and tells of it. */
export async function copy(words, done) {
  try {
    await navigator.clipboard.writeText(words);
    told(done);
  } catch {
    // Without the permission: what is chosen can be copied by hand.
    getSelection().selectAllChildren($('code'));
    told('This browser does not let a page copy: press Ctrl+C.');
  }
}

/** Saves a file. */
export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  told(`Saved: ${name}`);
}

/** A scene's name as that of a file. */
export const plain = (name) => name.replace(/[^\w-]+/g, '-') || 'shutter';
