// What the program tells of a scene, in its words, with the page's names in place of its keys. And the bar, where it is
// seen wherever one is: what is wrong, computed or told, and which fields that is about.

import { html, render } from 'lit-html';
import { $, write } from './dom.js';
import { give, go, model, tell } from './model.js';
import { INNER, label } from './scene.js';
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

/** The program's words, with the page's names in place of the keys, which it marks. */
export const inWords = (text) => text.replace(/`(\w+)`/g, (_, key) => `“${label(key)}”`);

// What is wrong: as the engine finds it, the program tells it in words; and what the program alone finds.
const wrongOf = (model) => model.wrong ?? toldNow(model)?.wrong;

/** Which fields that is about. */
export function fieldsAt(model) {
  const wrong = wrongOf(model);
  return wrong?.id ? [wrong.id] : wrong ? fieldsOf(wrong) : [];
}

function wordsOf(model) {
  const { isLink, reason } = wrongOf(model), told = toldNow(model)?.wrong;
  if (reason || !told) return reason ?? '';
  const [field] = fieldsOf(told);
  return `${isLink ? 'The link holds no curve: ' : ''}${field ? `${label(field)}: ` : ''}${inWords(told.text)}`;
}

/** Remedies as buttons: they change the scene, or lead to a field. */
export const helps = (remedies) => remedies.map(([words, to]) => {
  const help = () => (typeof to === 'string' ? $(to).focus() : give(changed(to)));
  return html`<button type="button" @click=${help}>${words}</button>`;
});

// Of the flashes that the program proposes, the values that are others.
function changed({ unit, ...flashes }) {
  const now = model.now.scene.flashes;
  return Object.fromEntries(Object.entries(flashes).filter(([key, value]) => value !== now[key]));
}

const button = (words, act) => html`<button type="button" @click=${act}>${words}</button>`;
const showRead = () => {
  const why = $('trace').querySelector('.wrong');
  why.focus();
  why.scrollIntoView({ block: 'center' });
};

// What a person can do about it.
function buttonsFor(model) {
  const { note, pending } = model, wrong = wrongOf(model);
  if (wrong?.isLink) return button('Go on without it', () => go(-1));
  if (wrong) return helps(wrong.reason ? [] : toldNow(model)?.wrong?.remedies ?? []);
  if (!note) return [];
  const close = button('Close', () => tell({ note: null }));
  return [note.act ? button(...note.act) : [], pending ? button('Show why', showRead) : [], close];
}

/** Draws it. */
export function drawBar(model) {
  const { busy, note } = model, wrong = wrongOf(model), words = wrong ? wordsOf(model) : note?.words ?? '';
  $('problem').hidden = !words;
  $('problem').classList.toggle('wrong', Boolean(wrong || note?.isWrong));
  render(html`<span>${words}</span><span class="buttons">${buttonsFor(model)}</span>`, $('problem'));
  $('busy').hidden = !busy;
  const share = busy?.share ? `: ${Math.round(100 * busy.share)} %` : '';
  if (busy) write($('busy').firstElementChild, `${busy.words}${share} …`);
}
