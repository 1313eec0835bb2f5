// What the program tells of a scene, in its words, with the page's names in place of its keys. And the bar, where it is
// seen wherever one is: what is wrong, computed or told, and which fields that is about.

import { html, render } from 'lit-html';
import { $, label, watch, write } from './dom.js';
import { helps } from './export.js';
import { go, model, tell } from './model.js';
import { FIELDS, INNER, KINDS } from './scene.js';
import { tellScene } from './studio.js';

/** What was told of scenes when the page was built. */
export const known = new WeakMap();
let asked;

/** Has the program tell of the model's scene, and draws it when that comes. */
export async function askProgram({ now: { scene } }) {
  if (asked === scene) return;
  asked = scene;
  const answer = known.has(scene) ? { Ok: known.get(scene) } : await tellScene(scene);
  // Something newer was asked.
  if (!answer || asked !== scene) return;
  const wrong = answer.Err && { key: '', text: answer.Err, remedies: [] };
  tell({ told: { scene, facts: [], doubts: [], wrong, ...answer.Ok } });
}

/** What is told of the scene that is on the screen, once it is. */
export const toldNow = ({ told, now }) => (told?.scene === now.scene ? told : null);

// The fields that a key is about, as `flashes.triggers`.
function fieldsOf({ key = '', inner }) {
  const name = key.split('.').pop();
  return name === 'shutteropening' ? INNER.slice(...(inner ?? [])) : name === 'trigger_times' ? ['triggers'] : [name];
}

const keys = Object.keys(KINDS).filter((key) => key.includes('_') || key === 'duty');
const NAMES = new RegExp(`\`(\\w+)\`|\\b(${keys.join('|')})\\b`, 'g');

// What a file says stands in quotes: `"trigger"`, a column's name.
const QUOTED = /("[^"\n]*"|(?<!\w)'[^'\n]*'(?!\w))/;

/** The program's words, with the page's names. */
export const inWords = (text) => text.split(QUOTED).map((part, i) => (i % 2 ? part : named(part))).join('');

const named = (text) => text.replace(/ \(--[^)]*\)| below \[flashes\]/g, '')
  .replace(NAMES, (_, marked, key) => `“${label(marked ?? key)}”`)
  .replace(/(?<=\w)'(?=\w)/g, '’').replace(/\btrigger(s?)\b/g, (_, many) => (many ? 'flashes' : 'flash'));

// What is wrong, once it is known in words.
function wordsOf(model) {
  const { wrong } = model;
  if (!wrong || wrong.reason) return wrong?.reason ?? '';
  const told = toldNow(model)?.wrong;
  if (!told) return '';
  const [field] = fieldsOf(told);
  return `${wrong.isLink ? 'The link holds no curve: ' : ''}${field ? `${label(field)}: ` : ''}${inWords(told.text)}`;
}

// What would help, as [words, the flashes that do].
const remedies = (model) => (model.wrong?.reason ? [] : toldNow(model)?.wrong?.remedies ?? []);

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
