// The plan in the forms that a firmware or a script takes: shown, copied, saved; or why there is none, and what would help.

import { $, button, element, watch } from './dom.js';
import { model } from './model.js';
import { inWords, remedies } from './remedies.js';
import { copy, plain, save, told } from './save.js';
import * as studio from './studio.js';
import { toml } from './toml.js';
import { give } from './typing.js';

const FORMS = [['rust', 'Rust'], ['c', 'C'], ['toml', 'TOML'], ['csv', 'CSV'], ['json', 'JSON'], ['pico', 'Pico']];

let form = 'rust';
// { text, file } or { reason, scene } of the form and the scene; a promise while it is computed.
let made = null;

export function start() {
  const tabs = FORMS.map(([name, title]) => button(title, () => choose(name), { id: `form-${name}`, role: 'tab', 'aria-controls': 'code' }));
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
  const whole = async (act) => {
    const { text, file } = await made;
    if (text) act(text, file);
  };
  $('copy').onclick = () => whole((text) => copy(text, `Copied: ${FORMS.find(([name]) => name === form)[1]}`));
  $('save').onclick = () => whole((text, file) => save(new Blob([text], { type: 'text/plain' }), file));
  for (const id of ['link', 'svg', 'png', 'frame', 'compare']) {
    $(id).onclick = async () => {
      // What is on the screen now, though the module may still be under way.
      const { now } = model;
      (await import('./share.js'))[id](now);
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
  if (model.now) draw(model);
}

const isNew = watch();

export function draw({ now: { scene, other }, view, wrong }) {
  for (const id of ['link', 'svg', 'png', 'frame', 'compare']) $(id).disabled = !view || Boolean(wrong?.id || scene.untold);
  $('compare').textContent = other ? 'End the comparison' : 'Compare';
  if (!isNew(scene, form, wrong)) return;
  told('');
  // A newer one may be under way, which then is what is shown and copied.
  const of = (made = wrong ? Promise.resolve({ reason: inWords(wrong.reason, scene), remedies: view && !wrong.id ? remedies(scene) : [] }) : written(scene, form));
  $('code').classList.add('waits');
  if (wrong) offer(false);
  of.then((it) => of === made && show(it));
}

const offer = (isOffered) => ['copy', 'save'].forEach((id) => ($(id).disabled = !isOffered));

async function written(scene, form) {
  if (scene.untold) return { reason: scene.untold, remedies: [['Use the curve all the same', { untold: null }]] };
  if (form === 'toml') return { text: toml(scene), file: `${plain(scene.name)}.toml` };
  const answer = await studio.emit(scene, form);
  // Overtaken by a newer question: that one's text is it.
  if (!answer) return made;
  if (answer.Ok) return { ...answer.Ok, text: withDoubts(answer.Ok.text, form, scene.doubts) };
  const { reason } = answer.Err;
  const most = Number(/up to (\d+) pulses/.exec(reason)?.[1]);
  const helps = most && !scene.measured ? [[`Use ${most} flashes`, { triggers: most }]]
    : /no\s+delay/.test(reason) ? [['Give the sync’s delay', 'delay'], ['The sync is the opening: delay 0', { delay: 0 }]] : [];
  return { reason: inWords(reason, scene), remedies: helps };
}

// A plan with what is doubtful about it, in the form's own way.
function withDoubts(text, form, doubts) {
  if (!doubts.length) return text;
  if (form === 'json') return text.replace('{', () => `{\n  "doubts": ${JSON.stringify(doubts)},`);
  return doubts.map((words) => `${form === 'csv' ? '#' : '//'} Doubtful: ${words.replace(/\s+/g, ' ')}\n`).join('') + text;
}

function show({ text, reason, remedies = [] }) {
  offer(Boolean(text));
  $('code').classList.remove('waits');
  $('code').scrollTop = 0;
  if (!text) {
    const helps = remedies.map(([words, changes]) => button(words, () => mend(changes)));
    const p = element('p', `There is nothing to copy yet: ${reason}${/[.?]$/.test(reason) ? '' : '.'}`);
    return $('code').replaceChildren(p, ...helps);
  }
  // What is told of a plan in comments comes after what a firmware reads.
  const [head] = /^(?:(?:\/\/|#(?!\[)|\/?\*| \*).*\n|\n)*/.exec(text);
  const lines = head.trim().split('\n').length;
  if (lines < 3) return $('code').replaceChildren(text);
  const fold = element('details');
  fold.append(element('summary', `${lines} lines of comments, copied as well`), head.trimEnd());
  $('code').replaceChildren(fold, text.slice(head.length));
}

/** Changes a scene as a remedy says, or leads to the field that does. */
export function mend(changes, scene) {
  if (typeof changes === 'string') $(changes).focus();
  else give(changes, undefined, undefined, scene);
}
