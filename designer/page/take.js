// The plan in the forms that a firmware or a script takes: shown, copied, saved.

import { $ } from './dom.js';
import { copy, plain, save } from './save.js';
import { toml } from './scene.js';
import * as studio from './studio.js';

const FORMS = [['rust', 'Rust'], ['c', 'C'], ['toml', 'TOML'], ['csv', 'CSV'], ['json', 'JSON'], ['pico', 'Pico']];

let form = 'rust';
let shown = null;
// The text of the form and the name of its file; a promise while it is computed.
let made = Promise.resolve({ text: '', file: '' });

export function start(page) {
  const tabs = FORMS.map(([name, title]) => {
    const tab = Object.assign(document.createElement('button'), { type: 'button', textContent: title, id: `form-${name}` });
    tab.setAttribute('role', 'tab');
    tab.setAttribute('aria-controls', 'code');
    tab.onclick = () => choose(name);
    return tab;
  });
  $('forms').append(...tabs);
  $('forms').onkeydown = (event) => {
    const i = FORMS.findIndex(([name]) => name === form);
    const to = { ArrowLeft: i - 1, ArrowRight: i + 1, Home: 0, End: FORMS.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const at = (to + FORMS.length) % FORMS.length;
    choose(FORMS[at][0]);
    tabs[at].focus();
  };
  $('copy').onclick = async () => copy((await made).text, `Copied: ${FORMS.find(([name]) => name === form)[1]}`);
  $('save').onclick = async () => {
    const { text, file } = await made;
    save(new Blob([text], { type: 'text/plain' }), file);
  };
  for (const id of ['link', 'svg', 'png', 'frame', 'compare']) {
    $(id).onclick = async () => {
      // What is on the screen now, though the module may still be under way.
      const { screen } = page;
      (await import('./share.js'))[id]({ ...page, screen });
    };
  }
  choose(form);
}

function choose(name) {
  form = name;
  for (const [name] of FORMS) {
    const isChosen = name === form;
    $(`form-${name}`).setAttribute('aria-selected', isChosen);
    $(`form-${name}`).tabIndex = isChosen ? 0 : -1;
  }
  $('code').scrollTop = 0;
  if (shown) show(shown);
}

/** Shows the form of what is on the screen; if that is wrong, of the last that was not, which cannot be taken away. */
export function show(screen, wrong) {
  for (const id of ['copy', 'save', 'link', 'svg', 'png', 'frame', 'compare']) $(id).disabled = Boolean(wrong);
  $('code').classList.toggle('stale', Boolean(wrong));
  if (wrong) return;
  shown = screen;
  $('compare').textContent = screen.other ? 'End the comparison' : 'Compare';
  const { scene } = screen;
  const of = (made = form === 'toml' ? Promise.resolve({ text: toml(scene), file: `${plain(scene.name)}.toml` }) : emitted(scene, form));
  of.then(({ text }) => {
    // A newer one may be under way, which then is what is shown and copied.
    if (of === made) $('code').textContent = text;
  });
}

async function emitted(scene, form) {
  const answer = await studio.emit(scene, form);
  // Overtaken by a newer question: that one's text is it.
  if (!answer) return made;
  return answer.Ok ?? { text: answer.Err.reason, file: 'wrong.txt' };
}
