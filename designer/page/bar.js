// What is wrong, computed or told, where it is seen wherever one is; and which fields it is about.

import { html, render } from 'lit-html';
import { $, watch, write } from './dom.js';
import { helps } from './export.js';
import { go, tell } from './model.js';
import { fieldsOf, remedies, wordsOf } from './told.js';
import { FIELDS } from './scene.js';

const isNewWrong = watch(), isNewBusy = watch();
const button = (words, act) => html`<button type="button" @click=${act}>${words}</button>`;
const showRead = () => {
  const why = $('trace').querySelector('.wrong');
  why.focus();
  why.scrollIntoView({ block: 'center' });
};

// What a person can do about it.
function buttonsFor(model) {
  const { wrong, note, pending } = model;
  if (wrong?.isLink) return button('Go on without it', () => go(-1));
  if (wrong) return helps(remedies(model));
  if (!note) return [];
  const close = button('Close', () => tell({ note: null }));
  return [note.act ? button(...note.act) : [], pending ? button('Show why', showRead) : [], close];
}

/** Draws it. */
export function drawBar(model) {
  const { wrong, busy, note, pending, view } = model, words = wrong ? wordsOf(model) : note?.words ?? '';
  // While something is computed, a button that is pressed stays.
  if (isNewWrong(wrong, words, note, pending, view)) {
    $('problem').hidden = !words;
    $('problem').classList.toggle('wrong', Boolean(wrong || note?.isWrong));
    render(html`<span>${words}</span><span class="buttons">${buttonsFor(model)}</span>`, $('problem'));
  }
  if (isNewBusy(busy, busy?.words, busy?.share)) {
    $('busy').hidden = !busy;
    const share = busy?.share ? `: ${Math.round(100 * busy.share)} %` : '';
    if (busy) write($('busy').firstElementChild, `${busy.words}${share} …`);
  }
  const at = !wrong ? [] : wrong.id ? [wrong.id] : fieldsOf(wrong);
  for (const id of FIELDS) {
    const field = $(id), is = at.includes(id);
    if (is && $('inner').contains(field)) $('inner').open = true;
    for (const [name, value] of [['aria-invalid', 'true'], ['aria-describedby', 'problem']]) {
      is ? field.setAttribute(name, value) : field.removeAttribute(name);
    }
  }
}
