// The page: draws the model, and changes it as a person asks.

import presets from './presets.js';
import { $, button, element, svg, watch, write } from './dom.js';
import { Graph } from './graph.js';
import { change, go, model, start, tell } from './model.js';
import * as panels from './panels.js';
import * as photo from './photo.js';
import { INNER, NUMBERS, STOPS, TIMES, fromScene, hash, innerOf, lampOf, tidy } from './scene.js';
import { load } from './view.js';

const isFrame = new URLSearchParams(location.search).has('embed');

let graph;
// What is loaded after the picture; and what is loaded when it is needed first.
let late, exporter, typing, bar, hold;
let player, traces, tester;
const seen = new Set();

/** Draws all that is on the screen. A part that fails is told, and keeps neither the others nor the address from what is so. */
function render(model) {
  for (const part of [shown, picture, photo.draw, fields, panels.draw, exporter?.draw, bar?.draw, held, writeLate, later]) {
    try {
      part?.(model);
    } catch (error) {
      reportError(error);
      missing(`A part of the page could not be drawn: ${error.message}.`);
    }
  }
}

function missing(words) {
  $('missing').textContent = words;
  $('missing').classList.add('now');
}

function shown({ now, view, last, wrong }) {
  document.body.classList.toggle('void', !last);
  document.body.classList.toggle('stale', !view);
  document.body.classList.toggle('unplanned', !view?.plan.Ok);
  $('undo').disabled = !model.canUndo;
  $('redo').disabled = !model.canRedo;
  if (isFrame) $('home').href = location.pathname + (wrong?.isLink ? '' : hash(now));
}

const picture = (model) => graph.show(model);
const held = (model) => hold?.draw(model, graph);

function later({ now, pending }) {
  if (traces || now.trace || pending) traces ? traces.draw(model, graph.samples) : loadTraces();
  if (tester || now.speeds) tester ? tester.draw(model) : loadTester();
}

async function loadTraces() {
  traces ??= await import('./trace.js');
  render(model);
  return traces;
}

async function loadTester() {
  tester = await import('./speeds.js');
  tester.start(loadTraces);
  render(model);
}

const isLate = watch();
function writeLate() {
  if (late && isLate(late, model.view, model.isDraft, [...seen].join())) for (const id of seen) late.write(id, model);
}

function valueOf(scene, id) {
  const i = TIMES.indexOf(id), k = INNER.indexOf(id);
  return i >= 0 ? scene.times[i] : k >= 0 ? innerOf(scene)[k] : scene[id];
}

// Writes the numbers; what is typed stays as it is.
const isOther = watch();
function fields({ now: { scene }, wrong }) {
  if (!isOther(scene, wrong, document.activeElement)) return;
  for (const id of NUMBERS) {
    const value = valueOf(scene, id);
    const words = value === null ? '' : Number.isFinite(value) && INNER.includes(id) ? String(tidy(value, 7)) : String(value);
    if (wrong?.id !== id && $(id).value !== words && !typing?.tells(id, value, scene.unit)) $(id).value = words;
  }
  if (document.activeElement !== $('name')) $('name').value = scene.name;
  $('unit').value = scene.unit;
  $('straight').checked = !scene.inner;
  const lamp = lampOf(scene);
  $('lamp').value = lamp;
  $('lamp').disabled = Boolean(scene.measured);
  $('flashes').value = STOPS.findLastIndex((n) => n <= scene.triggers);
  $('flashes').setAttribute('aria-valuetext', `${scene.triggers} flashes`);
  write($('flash-count'), String(scene.triggers));
  write($('ideal-caption'), scene.measured ? 'this shutter, as its trace tells between the flashes' : 'this shutter, in steady light');
  for (const label of document.querySelectorAll('[data-lamp]')) label.hidden = label.dataset.lamp !== lamp;
  for (const small of document.querySelectorAll('small.unit')) write(small, scene.unit);
  const at = hash({ scene });
  const pressed = model.last && [...$('presets').children].find((it) => it.dataset.hash === at);
  for (const it of $('presets').children) {
    const isPressed = String(it === pressed);
    if (it.getAttribute('aria-pressed') !== isPressed) it.setAttribute('aria-pressed', isPressed);
    it.tabIndex = it === (pressed ?? $('presets').firstChild) ? 0 : -1;
  }
  // What is told of a preset does not hold of it once it is changed, but keeps its room.
  const kind = pressed ?? [...$('presets').children].find((it) => it.dataset.name === scene.name && !scene.given.includes('name'));
  write($('story'), kind?.dataset.story ?? '');
  $('story').style.visibility = pressed ? '' : 'hidden';
  document.querySelector('h1').dataset.name = scene.name;
  document.title = `${scene.name} · Curve designer`;
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
    const made = button(undefined, () => {
      change({ scene, trace: null });
    }, { 'data-name': preset.name, 'data-hash': hash({ scene }), 'data-story': preset.about });
    svg('path', { d: thumbnail(scene) }, svg('svg', { viewBox: '0 0 60 24', 'aria-hidden': true }, made));
    made.append(element('b', preset.name), element('small', preset.caption));
    $('presets').append(made);
  }
  // One stop of Tab, and arrows from there.
  $('presets').onkeydown = (event) => {
    const all = [...$('presets').children], at = all.indexOf(event.target);
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: all.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    all[(to + all.length) % all.length].focus();
  };
}

function listen() {
  const play = async (isUnasked) => {
    player ??= await import('./play.js');
    // Whoever does something meanwhile is not disturbed.
    if (isUnasked !== true || (!graph.dragged && model.cursor === null && !model.hold)) player.play();
  };
  $('play').onclick = play;
  // Where motion is not wanted, nothing moves unless it is asked to.
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) setTimeout(play, 800, true);
  // Behind '#' there is the curve: what is skipped to has no address.
  document.querySelector('.skip').onclick = (event) => {
    event.preventDefault();
    document.querySelector(event.target.hash)?.focus();
  };
  $('undo').onclick = () => go(-1);
  $('redo').onclick = () => go(1);
  addEventListener('keydown', (event) => {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || (key !== 'z' && key !== 'y')) return;
    event.preventDefault();
    go(key === 'y' || event.shiftKey ? 1 : -1);
  });
  // The panels further down are written when they are seen, and on paper.
  const observer = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) seen[isIntersecting ? 'add' : 'delete'](target.dataset.panel);
    writeLate();
  }, { rootMargin: '80px' });
  for (const card of document.querySelectorAll('[data-panel]')) observer.observe(card);
  addEventListener('beforeprint', () => {
    tell({ cursor: null, isPlaying: false });
    for (const card of document.querySelectorAll('[data-panel]')) late?.write(card.dataset.panel, model);
  });
}

async function begin() {
  await load();
  document.body.classList.toggle('embed', isFrame);
  graph = new Graph($('graph'));
  offer();
  const first = { scene: fromScene(presets[0].name, presets[0].scene), other: null, trace: null, speeds: null };
  start(first, render, { isFrame });
  listen();
  document.body.dataset.ready = '';
  performance.mark('ready');
  const modules = ['./late.js', './export.js', './typing.js', './bar.js', './hold.js', './receive.js'].map((module) => import(module));
  let receive;
  [late, exporter, typing, bar, hold, receive] = await Promise.all(modules);
  receive.start(loadTraces);
  exporter.start();
  typing.start(loadTraces, () => fields(model));
  render(model);
  // Without it, which old browsers and private windows may refuse, the page needs its server.
  navigator.serviceWorker?.register('sw.js').catch(() => {});
}

begin().catch((error) => missing(`The page is not whole: ${error.message}. Load it again, in a browser with WebAssembly.`));
