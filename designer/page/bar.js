// What is wrong, computed or told, where it is seen wherever one is; and which fields it is about.

import { html, render } from './lit-html.js';
import { $, watch, write } from './dom.js';
import { helps } from './export.js';
import { go, tell } from './model.js';
import { remedies, told } from './words.js';
import { FIELDS, INNER } from './scene.js';

const MORE = [...INNER, 'timer_bits', 'delay_spread', 'min_pulse', 'lamp_lag'];
const isNewWrong = watch(), isNewBusy = watch();

/** Draws it. */
export function drawBar({ wrong, busy, note, pending, view, now: { scene } }) {
  // While something is computed, a button that is pressed stays.
  if (isNewWrong(wrong, note, pending, view)) {
    const words = wrong ? told(wrong, scene) : note?.words ?? '';
    const button = (words, act) => html`<button type="button" @click=${act}>${words}</button>`;
    const buttons = wrong?.isLink ? button('Go on without it', () => go(-1)) : wrong ? helps(remedies(wrong))
      : note ? [note.act ? button(...note.act) : [], pending ? button('Show how it is read', () => $('trace').scrollIntoView({ block: 'center' })) : [], button('Close', () => tell({ note: null }))] : [];
    $('problem').hidden = !words;
    $('problem').classList.toggle('wrong', Boolean(wrong || note?.isWrong));
    render(html`<span>${words}</span><span class="buttons">${buttons}</span>`, $('problem'));
  }
  if (isNewBusy(busy, busy?.words, busy?.share)) {
    $('busy').hidden = !busy;
    if (busy) write($('busy').firstElementChild, `${busy.words}${busy.share ? `: ${Math.round(100 * busy.share)} %` : ''} …`);
  }
  const at = !wrong ? [] : wrong.id ? [wrong.id] : wrong.inner ? INNER.slice(...wrong.inner) : [wrong.key];
  if (at.some((id) => MORE.includes(id))) $('inner').open = true;
  for (const id of FIELDS) for (const [name, value] of [['aria-invalid', 'true'], ['aria-describedby', 'problem']]) at.includes(id) ? $(id).setAttribute(name, value) : $(id).removeAttribute(name);
}
