// The plan in the forms that a firmware or a script takes: shown, copied, saved.

import { toml } from './scene.js';
import * as studio from './studio.js';

const $ = (id) => document.getElementById(id);
const FORMS = [['rust', 'Rust', 'rs'], ['c', 'C', 'h'], ['toml', 'TOML', 'toml'], ['csv', 'CSV', 'csv'], ['json', 'JSON', 'json'], ['pico', 'Pico', 'txt']];

let form = 'rust';
let scene = null;
// The text of the form, or what is wrong; a promise while it is computed.
let text = Promise.resolve('');

export function start() {
  const tabs = FORMS.map(([name, title]) => {
    const tab = Object.assign(document.createElement('button'), { type: 'button', textContent: title, id: `form-${name}` });
    tab.setAttribute('role', 'tab');
    tab.setAttribute('aria-controls', 'code');
    tab.onclick = () => choose(name);
    return tab;
  });
  $('forms').append(...tabs);
  $('forms').onkeydown = (event) => {
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!by) return;
    const i = (FORMS.findIndex(([name]) => name === form) + by + FORMS.length) % FORMS.length;
    choose(FORMS[i][0]);
    tabs[i].focus();
  };
  $('copy').onclick = async () => copy(await text, `Copied: ${title()}`);
  $('save').onclick = async () => save(await text, `${fileName()}.${FORMS.find(([name]) => name === form)[2]}`);
  $('link').onclick = () => copy(location.href, 'Copied: a link to this curve');
  $('svg').onclick = picture;
  choose(form);
}

const title = () => FORMS.find(([name]) => name === form)[1];
const fileName = () => scene.name.replace(/[^\w-]+/g, '-') || 'shutter';

/** Tells in a line what was done. */
export function told(words) {
  $('told').textContent = words;
}

function choose(name) {
  form = name;
  for (const [name] of FORMS) {
    const isChosen = name === form;
    $(`form-${name}`).setAttribute('aria-selected', isChosen);
    $(`form-${name}`).tabIndex = isChosen ? 0 : -1;
  }
  $('code').scrollTop = 0;
  if (scene) show(scene, null);
}

/** Shows the form of a scene; with `wrong`, that of the last one that is right, which cannot be copied. */
export function show(newest, wrong) {
  for (const id of ['copy', 'save', 'svg']) $(id).disabled = Boolean(wrong);
  $('code').classList.toggle('stale', Boolean(wrong));
  if (wrong) return;
  scene = newest;
  const of = (text = form === 'toml' ? Promise.resolve(toml(scene)) : emitted(scene, form));
  of.then((words) => {
    // A newer one may be under way, which then is what is shown and copied.
    if (of === text) $('code').textContent = words;
  });
}

async function emitted(scene, form) {
  const answer = await studio.emit(scene, form);
  // Overtaken by a newer question: that one's text is it.
  if (!answer) return text;
  return answer.Ok ?? answer.Err.reason;
}

async function copy(words, done) {
  try {
    await navigator.clipboard.writeText(words);
    told(done);
  } catch {
    // Without the permission: what is chosen can be copied by hand.
    getSelection().selectAllChildren($('code'));
    told('This browser does not let a page copy: press Ctrl+C.');
  }
}

function save(words, name) {
  const type = name.endsWith('.svg') ? 'image/svg+xml' : 'text/plain';
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([words], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  told(`Saved: ${name}`);
}

// The graph as it is seen, but for the handles, with the colours of light and dark.
async function picture() {
  const style = await (await fetch('style.css')).text();
  const graph = $('graph').querySelector('svg').cloneNode(true);
  for (const part of graph.querySelectorAll('.handle, .arms')) part.remove();
  for (const part of [graph, ...graph.querySelectorAll('*')]) part.removeAttribute('aria-hidden');
  graph.setAttribute('role', 'img');
  graph.setAttribute('aria-label', `Openness and exposure of the shutter ${scene.name} over time, with its triggers`);
  const text = new XMLSerializer().serializeToString(graph);
  // As text: this page itself takes no styles but from its sheet.
  save(text.replace('>', () => `><style>${style}:root { background: var(--card) }</style>`), `${fileName()}.svg`);
}
