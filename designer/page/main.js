// The page: one scene, everything else follows it.

import presets from './presets.js';
import { Graph } from './graph.js';
import * as panels from './panels.js';
import { INNER, OPTIONAL, TIMES, fromHash, fromScene, hash, inUnit, innerOf, perSecond, tidy, withTimes } from './scene.js';
import * as studio from './studio.js';
import * as take from './take.js';
import { load, view } from './view.js';

const $ = (id) => document.getElementById(id);
const NUMBERS = [...TIMES, ...INNER, 'triggers', 'timer_hz', 'min_gap', ...OPTIONAL];
/** Longer files are not read. */
const LONGEST_TRACE = 256 << 20, LONGEST_SCENE = 1 << 20;

let scene;
// The last one whose curve is valid, and what is shown of it.
let valid, shown;
let graph;
// Who opened last: an answer that comes late must not overwrite what came after.
let opened = 0;

const bar = () => Number($('bar').value);

/** Makes `next` the scene. Wrong numbers that are typed stay; a handle (by its number `at`) goes back where it is let go. */
function set(next, { at, isDone = true, isTyped = false } = {}) {
  const answer = view(next, bar());
  const wrong = answer.Err ?? null;
  if (!wrong) [valid, shown] = [next, answer.Ok];
  const goesBack = wrong && isDone && !isTyped && valid;
  scene = goesBack ? valid : next;
  if (!shown) return wrong;
  const planWrong = shown.plan.Err ?? null;
  const place = wrong ? (at ?? handleOf(wrong)) : undefined;
  graph.show(scene, shown, wrong, place);
  fields();
  problem(wrong ?? planWrong, goesBack);
  const stale = (wrong && !goesBack) || planWrong;
  document.body.classList.toggle('stale', Boolean(stale));
  if (shown.plan.Ok && !wrong) {
    panels.show({ ...scene, range: graph.range.map((t) => t / perSecond(scene.unit)), view: { at: openness } }, shown.plan.Ok, shown.marks);
  }
  take.show(scene, stale);
  if (isDone && !wrong) remember();
  return wrong;
}

// The openness at a time in seconds, as the ramps have it, for the pictures alone.
function openness(t) {
  const [a, b, c, d] = shown.times;
  if (t <= a || t >= d) return 0;
  if (t >= b && t <= c) return 1;
  const ramp = shown.ramps[t < b ? 0 : 1];
  const at = (p, k) => (1 - p) ** 3 * ramp[0][k] + 3 * p * (1 - p) ** 2 * ramp[1][k] + 3 * p * p * (1 - p) * ramp[2][k] + p ** 3 * ramp[3][k];
  let [low, high] = [0, 1];
  for (let i = 0; i < 20; i++) {
    const p = 0.5 * (low + high);
    if (at(p, 0) < t) low = p;
    else high = p;
  }
  return at(low, 1);
}

/** The handle that a fault is about, by its number. */
function handleOf({ key, ramp }) {
  if (ramp) return ramp === 'opening' ? 4 : 6;
  const i = TIMES.indexOf(key);
  return i < 0 ? undefined : i;
}

let remembering;
function remember() {
  clearTimeout(remembering);
  remembering = setTimeout(() => history.replaceState(null, '', hash(scene)), 150);
}

function problem(wrong, goesBack) {
  const words = wrong ? [wrong.reason, ...wrong.notes, ...(goesBack ? ['It is back at the last valid curve.'] : [])].join('\n') : '';
  const box = $('problem');
  box.hidden = !words;
  if (box.textContent !== words) box.textContent = words;
  const at = wrong && !goesBack ? (wrong.key === 'shutteropening' || wrong.ramp ? (wrong.ramp === 'closing' ? INNER.slice(4) : INNER.slice(0, 4)) : [wrong.key]) : [];
  for (const id of NUMBERS) {
    const isWrong = at.includes(id);
    if ($(id).hasAttribute('aria-invalid') !== isWrong) {
      $(id).toggleAttribute('aria-invalid', isWrong);
      if (isWrong) {
        $(id).setAttribute('aria-invalid', 'true');
        $(id).setAttribute('aria-describedby', 'problem');
      } else $(id).removeAttribute('aria-describedby');
    }
  }
}

function valueOf(id) {
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  return i >= 0 ? scene.times[i] : k >= 0 ? innerOf(scene)[k] : scene[id];
}

// Writes the numbers, but not into the field that is being typed in.
function fields() {
  for (const id of NUMBERS) {
    const value = valueOf(id);
    const words = value === null ? '' : Number.isFinite(value) && INNER.includes(id) ? String(tidy(value, 7)) : String(value);
    if ($(id).value !== words && document.activeElement !== $(id)) $(id).value = words;
  }
  if (document.activeElement !== $('name')) $('name').value = scene.name;
  $('unit').value = scene.unit;
  $('straight').checked = !scene.inner;
  const lamp = scene.pulse !== null ? 'pulse' : scene.duty !== null ? 'duty' : '';
  $('lamp').value = lamp;
  for (const label of document.querySelectorAll('[data-lamp]')) label.hidden = label.dataset.lamp !== lamp;
  for (const small of document.querySelectorAll('small.unit')) small.textContent = scene.unit;
  for (const button of $('presets').children) button.setAttribute('aria-pressed', button.dataset.name === scene.name);
}

/** A number as people type it; nothing typed is `null` where that is allowed. */
function typed(input) {
  const text = input.value.trim().replaceAll('_', '').replace(',', '.');
  if (!text) return input.hasAttribute('data-optional') ? null : NaN;
  return Number(text);
}

function onInput({ target }) {
  const { id } = target;
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  if (id === 'name') return set({ ...scene, name: target.value.trim() || 'shutter' }, { isTyped: true });
  if (id === 'unit') return set(inUnit(scene, target.value));
  if (id === 'straight') return set({ ...scene, inner: target.checked ? null : innerOf(scene) });
  if (id === 'lamp') return lamp(target.value);
  if (!NUMBERS.includes(id)) return;
  const value = typed(target);
  let next;
  // A ramp keeps its shape when its time is typed, as when it is dragged.
  if (i >= 0) next = withTimes(scene.times.every(Number.isFinite) ? scene : valid, scene.times.with(i, value));
  else if (k >= 0) next = { ...scene, inner: innerOf(scene).with(k, value) };
  else next = { ...scene, [id]: value };
  set(next, { isTyped: true });
}

function lamp(kind) {
  const length = tidy((shown.plan.Ok?.exposure ?? 0) * perSecond(scene.unit) / scene.triggers / 4, 2);
  const next = { ...scene, pulse: null, duty: null, min_pulse: null };
  if (kind === 'pulse') next.pulse = scene.pulse ?? (length || 1);
  if (kind === 'duty') next.duty = 0.3;
  set(next, { isTyped: true });
}

/** Opens a scene that came from elsewhere. */
function open(next, trace = null) {
  opened++;
  graph.trace(trace);
  document.activeElement?.matches?.('#numbers input') && document.activeElement.blur();
  take.told('');
  return set(next, { isTyped: true });
}

async function bring(file) {
  const mine = ++opened;
  const say = (words, isWrong) => {
    const p = panels.element('p', words, { class: isWrong ? 'wrong' : 'empty', role: isWrong ? 'alert' : 'status' });
    $('trace').replaceChildren(p);
    return p;
  };
  const refuse = (reason) => mine === opened && say(`${file.name}: ${reason}`, true);
  if (/\.toml$/i.test(file.name)) {
    if (file.size > LONGEST_SCENE) return refuse('this is too long for a scene');
    const name = file.name.replace(/\.toml$/i, '');
    const answer = await studio.parse(name, await file.text());
    if (mine !== opened || !answer) return;
    if (answer.Err) return refuse([answer.Err.reason, ...answer.Err.notes].join('\n'));
    say(`Opened ${file.name}.`);
    return open(fromScene(name, answer.Ok));
  }
  if (file.size > LONGEST_TRACE) return refuse(`${file.size >> 20} MB: cut the trace to the pulse`);
  const p = say(`Reading ${file.name} …`);
  const stop = panels.element('button', 'Stop', { type: 'button' });
  stop.onclick = () => studio.cancel();
  p.append(' ', stop);
  const answer = await studio.fit(file.name, file, (share) => (p.firstChild.data = `Fitting ${file.name}: ${Math.round(100 * share)} % …`));
  if (mine !== opened || !answer) return;
  if (answer.Err) return refuse([answer.Err.reason, ...answer.Err.notes].join('\n'));
  const name = file.name.replace(/\.\w+$/, '');
  const parsed = await studio.parse(name, answer.Ok.scene);
  if (mine !== opened || !parsed) return;
  if (parsed.Err) return refuse(parsed.Err.reason);
  open(fromScene(name, parsed.Ok), answer.Ok.samples);
  panels.fitted(file.name, answer.Ok, () => {
    graph.trace(null);
    $('trace').replaceChildren(empty.cloneNode(true));
  });
}

const empty = $('trace').firstElementChild.cloneNode(true);

function receive() {
  $('file').onchange = ({ target }) => {
    if (target.files[0]) bring(target.files[0]);
    target.value = '';
  };
  $('example').onclick = async () => bring(new File([await (await fetch('leaf.csv')).blob()], 'leaf.csv'));
  let depth = 0;
  const shows = (by) => ($('drop').hidden = (depth = Math.max(0, depth + by)) === 0);
  addEventListener('dragenter', () => shows(1));
  addEventListener('dragleave', () => shows(-1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    shows(0);
    const [file] = event.dataTransfer.files;
    if (file) bring(file);
  });
}

function openHash() {
  if (location.hash.length < 2) return false;
  try {
    const wrong = open(fromHash(location.hash));
    if (wrong) take.told('');
  } catch (error) {
    problem({ reason: `The link holds no curve: ${error.message}.`, notes: [] });
  }
  return true;
}

async function begin() {
  try {
    await load();
  } catch (error) {
    $('hint').textContent = `This page needs WebAssembly, and its own files beside it: ${error.message}`;
    $('hint').classList.add('wrong');
    return;
  }
  graph = new Graph($('graph'), (next, isDone, at) => set(next, { isDone, at }));
  for (const preset of presets) {
    const button = panels.element('button', preset.name, { type: 'button', title: preset.about, 'data-name': preset.name });
    button.onclick = () => open(fromScene(preset.name, preset.scene));
    $('presets').append(button);
  }
  take.start();
  open(fromScene(presets[0].name, presets[0].scene));
  openHash();
  addEventListener('hashchange', openHash);
  $('numbers').addEventListener('input', onInput);
  $('numbers').addEventListener('submit', (event) => event.preventDefault());
  $('numbers').addEventListener('focusout', () => setTimeout(fields));
  $('bar').addEventListener('input', () => set(scene, { isTyped: true }));
  receive();
  document.body.dataset.ready = '';
  // Without it, which old browsers and private windows may refuse, the page needs its server.
  navigator.serviceWorker?.register('sw.js').catch(() => {});
}

begin();
