// What is wrong, computed or told, where it is seen wherever one is; and which fields it is about.

import { $, button, watch, write } from './dom.js';
import { mend } from './export.js';
import { go, tell } from './model.js';
import { inWords, remedies } from './remedies.js';
import { INNER, NUMBERS } from './scene.js';

const isNew = watch(), isOther = watch();
/** Draws it. */
export function draw({ wrong, busy, note, pending, view, now: { scene } }) {
  // While something is computed, a button that is pressed stays.
  if (isNew(wrong, note, view)) {
    const isWrong = Boolean(wrong || note?.isWrong);
    const words = wrong ? [inWords(wrong.reason, scene), ...(wrong.notes ?? [])].join('\n') : note?.words ?? '';
    const helps = wrong?.isLink ? [button('Go on without it', () => go(-1))] : wrong ? (view && !wrong.id ? remedies(scene).map(([words, changes]) => button(words, () => mend(changes))) : [])
      : note ? [...(note.act ? [button(...note.act)] : []), ...(pending ? [button('Show how it is read', () => $('trace').scrollIntoView({ block: 'center' }))] : []), button('Close', () => tell({ note: null }))] : [];
    $('problem').hidden = !words;
    $('problem').classList.toggle('wrong', isWrong);
    if ($('problem').firstElementChild.textContent !== words) $('problem').firstElementChild.textContent = words;
    $('problem').lastElementChild.replaceChildren(...helps);
  }
  if (isOther(busy, busy?.words, busy?.share)) {
    $('busy').hidden = !busy;
    if (busy) write($('busy').firstElementChild, `${busy.words}${busy.share ? `: ${Math.round(100 * busy.share)} %` : ''} …`);
  }
  const at = !wrong ? [] : wrong.id ? [wrong.id] : wrong.inner ? INNER.slice(...wrong.inner) : [wrong.key];
  if (at.some((id) => INNER.includes(id))) $('inner').open = true;
  for (const id of NUMBERS) {
    const isWrong = at.includes(id);
    if ($(id).hasAttribute('aria-invalid') === isWrong) continue;
    for (const [name, value] of [['aria-invalid', 'true'], ['aria-describedby', 'problem']]) {
      if (isWrong) $(id).setAttribute(name, value);
      else $(id).removeAttribute(name);
    }
  }
}
