// What is taken away: the plan in the forms that a firmware or a script takes, a link, a picture.

import { html, nothing, render } from 'lit-html';
import { $, watch } from './dom.js';
import { model } from './model.js';
import { hash, syncOf } from './scene.js';
import { emitForm } from './studio.js';
import { helps } from './told.js';

// { text, file } or { reason, remedies } of the form and the scene, as a promise.
let made;

export function startExport() {
  const whole = async (act) => {
    const { text, file } = await made;
    if (text) act(text, file);
  };
  $('copy').onclick = () => whole((text) => copy(text, `Copied: ${chosen().parentElement.textContent}`));
  $('save').onclick = () => whole((text, file) => save(new Blob([text], { type: 'text/plain' }), file));
  $('link').onclick = () => copyLink(model.now);
  $('forms').onchange = () => drawExport(model);
}

const chosen = () => $('forms').querySelector(':checked');

const isNewForm = watch();

export function drawExport({ now: { scene }, view, wrong }) {
  $('link').disabled = !view || Boolean(wrong?.id);
  const form = chosen().id.replace('form-', '');
  if (!isNewForm(scene, form, wrong)) return;
  say('');
  // A newer one may be under way, which then is what is shown and copied.
  const of = (made = wrong ? Promise.resolve({}) : written(scene, form));
  $('code').classList.add('waits');
  if (wrong) offerCopy(false);
  of.then((it) => of === made && showForm(it));
}

const offerCopy = (isOffered) => ['copy', 'save'].forEach((id) => ($(id).disabled = !isOffered));

async function written(scene, form) {
  const lacks = form === 'toml' ? [] : LACKS.filter(([, is]) => is(scene));
  if (lacks.length) {
    const reason = `hardware needs what only you know: ${lacks.map(([what]) => what).join('; ')}`;
    return { reason, remedies: lacks.flatMap(([, , ...remedies]) => remedies) };
  }
  const answer = await emitForm(scene, form);
  // Overtaken by a newer question: that one's text is it.
  return answer ? answer.Ok ?? { reason: answer.Err } : made;
}

// What somebody has to say, when that is so, and what says it.
const LACKS = [
  ['the set-up', ({ flashes }) => flashes.set_up === null,
    ['The camera’s own shutter stays open: emulated', { set_up: 'emulated' }],
    ['This shutter dims the lamp: in the path', { set_up: 'in_path' }]],
  ['the timer’s rate', ({ flashes }) => flashes.timer_hz === null, ['Give the timer’s rate', 'timer_hz']],
  ['the lamp’s least gap', ({ flashes }) => flashes.min_gap === null,
    ['Give the least gap', 'min_gap'], ['It needs none', { min_gap: 0 }]],
  ['which way the sync goes', (scene) => syncOf(scene).delay !== null && syncOf(scene).sync_falls === null,
    ['The sync falls', { sync_falls: true }], ['The sync rises', { sync_falls: false }]],
];

function showForm({ text, reason, remedies = [] }) {
  offerCopy(Boolean(text));
  $('code').classList.remove('waits');
  $('code').scrollTop = 0;
  // What is wrong is told in the bar.
  const why = reason ? `: ${reason}` : '';
  if (!text) return render(html`<p>There is nothing to copy yet${why}.</p>${helps(remedies)}`, $('code'));
  // What is told of a plan in comments comes after what a firmware reads.
  const [head] = /^(?:\/\/(?!\/).*\n|\/\*[^]*?\*\/\n|\n)*/.exec(text);
  const lines = head.trim().split('\n').length;
  const summary = html`<summary>${lines} lines of comments, copied as well</summary>`;
  const folded = html`<details>${summary}${head.trimEnd()}</details>`;
  render(lines < 3 ? text : [folded, text.slice(head.length)], $('code'));
}

const say = (words) => [$('told'), $('speeds-told')].forEach((it) => it && (it.textContent = words));

/** Copies words, and tells of it. */
async function copy(words, done) {
  try {
    await navigator.clipboard.writeText(words);
    say(done);
  } catch {
    // Without the permission: what is chosen can be copied by hand.
    getSelection().selectAllChildren($('code'));
    say('This browser does not let a page copy: press Ctrl+C.');
  }
}

export const copyLink = (now) =>
  copy(location.origin + location.pathname + hash(now), `Copied: a link to this ${now.speeds ? 'table' : 'curve'}`);

function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  say(`Saved: ${name}`);
}
