// The page: one scene, everything else follows it; and one history of all that is done.

import presets from './presets.js';
import { $, element } from './dom.js';
import { Graph } from './graph.js';
import * as steps from './history.js';
import { parse } from './numbers.js';
import * as panels from './panels.js';
import { told } from './save.js';
import { INNER, OPTIONAL, TIMES, fromAddress, fromScene, hash, inUnit, innerOf, lampOf, perSecond, straight, tidy, withLamp, withTimes } from './scene.js';
import { svg } from './svg.js';
import * as take from './take.js';
import { load, view } from './view.js';

const NUMBERS = [...TIMES, ...INNER, 'triggers', 'timer_hz', 'min_gap', ...OPTIONAL];
const WHOLE = ['triggers', 'timer_hz'];

// What was done last: { scene, other, trace }, the scene being valid, with a plan; and what is on the screen, which may not be.
let state, screen;
// The view of the last scene whose curve is valid.
let shown;
// A number that was typed is none; what is on the screen has a curve.
let refused = false, hasCurve = false;
let graph;
// What plays the exposure, once it was asked to.
let player;

/** What others ask the page. */
const page = {
  get screen() { return screen; },
  /** A change of the state that is one step; steps with the same `key` in a row are one, as of a field that is typed in. */
  change(changes, key) {
    const next = { ...screen, ...changes };
    const wrong = draw(next, !key);
    if (!wrong) commit(next, key);
    return wrong;
  },
};

function commit(next, key) {
  if (steps.canGo(0) && hash(next.scene, next.other) === hash(state.scene, state.other) && next.trace === state.trace) {
    state = next;
    return;
  }
  state = next;
  steps.step(state, key);
  buttons();
}

/**
 * Shows a state; what is wrong with it is told beside the numbers, and its curve is the last one that was valid. Is a field
 * that is being typed in written as well?
 */
function draw(next, writesAll) {
  const answer = view(next.scene, bar());
  const wrong = answer.Err ?? answer.Ok.plan.Err;
  const { scene } = (screen = next);
  refused = false;
  if (answer.Ok) shown = answer.Ok;
  hasCurve = Boolean(answer.Ok);
  if (hasCurve) document.body.classList.remove('void');
  if (next.other !== compared) {
    compared = next.other;
    graph.compare(compared && view(compared, 0.1).Ok);
  }
  graph.trace(next.trace?.fit);
  if (shown) graph.show(scene, shown);
  player?.stop();
  if (next.trace !== traced) {
    traced = next.trace;
    import('./trace.js').then((trace) => trace.show(page));
  }
  fields(writesAll);
  if (writesAll) echo();
  problem(wrong);
  document.body.classList.toggle('stale', Boolean(wrong));
  if (!wrong) panels.show(scene, shown, graph.range.map((t) => t / perSecond(scene.unit)), Boolean(next.trace));
  take.show(screen, wrong);
  buttons();
  return wrong;
}

let compared = null, traced = null;

const bar = () => Number($('bar').value);

const isDraft = () => screen !== state || refused || document.body.classList.contains('void');

function buttons() {
  $('undo').disabled = !steps.canGo(-1) && !isDraft();
  $('redo').disabled = !steps.canGo(1);
}

function show(next) {
  document.body.classList.remove('void');
  state = next;
  draw(next, true);
}

/** Undoes or redoes a step; what is half typed or wrong is undone first. */
function go(by) {
  if (by < 0 && isDraft()) show(state);
  else steps.go(by);
}

function problem(wrong, field) {
  const words = wrong ? [wrong.reason, ...(wrong.notes ?? [])].join('\n') : '';
  const box = $('problem');
  box.hidden = !words;
  if (box.textContent !== words) box.textContent = words;
  const ramp = wrong?.ramp === 'closing' ? INNER.slice(4) : INNER.slice(0, 4);
  const at = !wrong ? [] : field ? [field] : wrong.key === 'shutteropening' || wrong.ramp ? ramp : [wrong.key];
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

// Nothing is shown of a link that holds no curve: least of all the shutter before.
function blank(words) {
  document.body.classList.add('void', 'stale');
  problem({ reason: words });
  take.show(screen, true);
  buttons();
}

function valueOf(id) {
  const { scene } = screen;
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  return i >= 0 ? scene.times[i] : k >= 0 ? innerOf(scene)[k] : scene[id];
}

// Writes the numbers, into the field that is being typed in only if it has to be.
function fields(all) {
  const { scene } = screen;
  for (const id of NUMBERS) {
    const value = valueOf(id);
    const words = value === null ? '' : Number.isFinite(value) && INNER.includes(id) ? String(tidy(value, 7)) : String(value);
    if ($(id).value !== words && (all || document.activeElement !== $(id))) $(id).value = words;
  }
  if (all || document.activeElement !== $('name')) $('name').value = scene.name;
  $('unit').value = scene.unit;
  $('straight').checked = !scene.inner;
  const lamp = lampOf(scene);
  $('lamp').value = lamp;
  for (const label of document.querySelectorAll('[data-lamp]')) label.hidden = label.dataset.lamp !== lamp;
  for (const small of document.querySelectorAll('small.unit')) if (small.textContent !== scene.unit) small.textContent = scene.unit;
  const at = hash(scene);
  for (const button of $('presets').children) {
    const isPressed = String(button.dataset.hash === at);
    if (button.getAttribute('aria-pressed') !== isPressed) button.setAttribute('aria-pressed', isPressed);
  }
}

// What is read is told beside the field where it is written otherwise.
function echo(input, value) {
  const small = $('echo');
  const words = input && Number.isFinite(value) && String(value) !== input.value.trim() ? `= ${value}` : '';
  small.textContent = words;
  small.hidden = !words;
  if (words) input.parentElement.append(small);
}

function onInput({ target }) {
  const { id } = target;
  const { scene } = screen;
  if (id === 'name') return page.change({ scene: { ...scene, name: target.value.trim() || 'shutter' } }, id);
  if (id === 'unit') return page.change({ scene: inUnit(scene, target.value) });
  if (id === 'straight') return page.change({ scene: straight(scene, target.checked) });
  if (id === 'lamp') return page.change({ scene: withLamp(scene, target.value, tidy(((shown.plan.Ok?.exposure ?? 0) * perSecond(scene.unit)) / scene.triggers / 4, 2) || 1) });
  if (!NUMBERS.includes(id)) return;
  let value;
  try {
    value = parse(target.value, WHOLE.includes(id));
  } catch (error) {
    echo();
    document.body.classList.add('stale');
    refused = true;
    take.show(screen, true);
    buttons();
    return problem({ reason: error.message }, id);
  }
  echo(target, value);
  if (Number.isNaN(value) && target.hasAttribute('data-optional')) value = null;
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  let next;
  // A ramp keeps its shape when its time is typed, as when it is dragged.
  if (i >= 0) next = withTimes(scene.times.every(Number.isFinite) ? scene : state.scene, scene.times.with(i, value));
  else if (k >= 0) next = { ...scene, inner: innerOf(scene).with(k, value) };
  else next = { ...scene, [id]: value };
  page.change({ scene: next }, id);
}

// While a handle is dragged nothing else on the page moves.
let frozen = [];
function freeze() {
  frozen = [...document.querySelectorAll('.card, #facts > div, #gap > p, .direct, .note, figure')];
  const heights = frozen.map((it) => it.offsetHeight);
  frozen.forEach((it, i) => Object.assign(it.style, { height: `${heights[i]}px`, overflow: 'hidden' }));
}

function onDrag(next, isDone, key) {
  if (!isDone) {
    if (!frozen.length) freeze();
    return draw({ ...screen, scene: next }, true);
  }
  for (const it of frozen) Object.assign(it.style, { height: '', overflow: '' });
  frozen = [];
  page.change({ scene: next }, key);
}

function openPreset({ name, scene }) {
  told('');
  page.change({ scene: fromScene(name, scene), trace: null });
  // What was refused goes as well.
  if (document.querySelector('#trace .wrong')) import('./trace.js').then((trace) => trace.show(page));
}

/** Opens what the address says, as a new state. */
function openAddress(keep) {
  try {
    const opened = fromAddress(location.hash);
    const next = { ...opened, trace: null };
    told('');
    const wrong = draw(next, true);
    if (!hasCurve) document.body.classList.add('void');
    if (!wrong) {
      state = next;
      keep(next);
    }
  } catch (error) {
    blank(`The link holds no curve: ${error.message}.`);
  }
  buttons();
}

function receive() {
  const bring = async (file) => file && (await import('./trace.js')).bring(page, await file);
  $('file').onchange = ({ target }) => {
    bring(target.files[0]);
    target.value = '';
  };
  $('example').onclick = async () => bring(new File([await (await fetch(new URL('leaf.csv', import.meta.url))).blob()], 'leaf.csv'));
  let depth = 0;
  const shows = (by) => ($('drop').hidden = (depth = Math.max(0, depth + by)) === 0);
  addEventListener('dragenter', () => shows(1));
  addEventListener('dragleave', () => shows(-1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    shows(0);
    bring(event.dataTransfer.files[0]);
  });
}

// The picture of a preset: its ramps, 60 by 24.
function thumbnail(scene) {
  const [[a, b, c, d], at] = [scene.times, innerOf(scene)];
  const X = (part) => (4 + 52 * part).toFixed(1), Y = (y) => (21 - 18 * y).toFixed(1);
  const of = (t) => (t - a) / (d - a);
  const points = [0, 2, 4, 6].map((k) => `${X(at[k])} ${Y(at[k + 1])}`);
  return `M0 21H${X(0)}C${points[0]} ${points[1]} ${X(of(b))} ${Y(1)}H${X(of(c))}C${points[2]} ${points[3]} ${X(1)} ${Y(0)}H60`;
}

function offer() {
  for (const preset of presets) {
    const scene = fromScene(preset.name, preset.scene);
    const button = element('button', undefined, { type: 'button', title: preset.about, 'data-name': preset.name, 'data-hash': hash(scene) });
    svg('path', { d: thumbnail(scene) }, svg('svg', { viewBox: '0 0 60 24', 'aria-hidden': true }, button));
    button.append(element('b', preset.name), element('small', preset.caption));
    button.onclick = () => openPreset(preset);
    $('presets').append(button);
  }
}

// The order in which Tab goes is that of the picture, in one column and in two.
function arrange(isNarrow) {
  const [left, right] = [document.querySelector('.left'), document.querySelector('.right')];
  const takes = document.querySelector('.take');
  if (isNarrow) document.querySelector('.draw').after(takes);
  else right.prepend(takes);
  (isNarrow ? right : left).append(...document.querySelectorAll('.late'));
}

async function begin() {
  try {
    await load();
  } catch (error) {
    $('missing').textContent = `The page is not whole: ${error.message}. Load it again, in a browser with WebAssembly.`;
    $('missing').classList.add('now');
    return;
  }
  graph = new Graph($('graph'), $('readout'), onDrag);
  const narrow = matchMedia('(max-width: 980px)');
  narrow.onchange = () => arrange(narrow.matches);
  arrange(narrow.matches);
  offer();
  take.start(page);
  steps.start({ address: ({ scene, other }) => hash(scene, other), show, arrived: () => openAddress(steps.adopt) });
  const first = { scene: fromScene(presets[0].name, presets[0].scene), other: null, trace: null };
  if (location.hash.length > 1) {
    openAddress(steps.step);
    // What is wrong with it is undone to a shutter that is not.
    state ??= first;
    if (!screen) {
      shown = view(first.scene, 0.1).Ok;
      screen = { ...first };
      graph.show(first.scene, shown);
      fields();
    }
  } else page.change(first);
  buttons();
  panels.start();
  // Where motion is not wanted, nothing moves unless it is asked to.
  const play = async () => {
    player ??= await import('./play.js');
    if (shown) player.play(graph, shown);
  };
  $('play').onclick = play;
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) setTimeout(() => frozen.length || play(), 800);
  const numbers = $('numbers');
  numbers.addEventListener('input', onInput);
  numbers.addEventListener('submit', (event) => event.preventDefault());
  numbers.addEventListener('focusout', () => {
    steps.seal();
    echo();
    // What was refused is not what is on the screen.
    setTimeout(() => $('problem').hidden && fields());
  });
  $('bar').addEventListener('input', () => draw(screen));
  $('undo').onclick = () => go(-1);
  $('redo').onclick = () => go(1);
  addEventListener('keydown', (event) => {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || (key !== 'z' && key !== 'y')) return;
    event.preventDefault();
    go(key === 'y' || event.shiftKey ? 1 : -1);
  });
  receive();
  document.body.classList.toggle('embed', new URLSearchParams(location.search).has('embed'));
  document.body.dataset.ready = '';
  // Without it, which old browsers and private windows may refuse, the page needs its server.
  navigator.serviceWorker?.register('sw.js').catch(() => {});
}

begin();
