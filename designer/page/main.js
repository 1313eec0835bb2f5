// The page: draws the model, and changes it as a person asks.

import presets from './presets.js';
import { REPOSITORY } from './presets.js';
import { html, nothing, render } from './lit-html.js';
import { $, arrowed } from './dom.js';
import { drawBar } from './bar.js';
import { drawExport, showExport, startExport } from './export.js';
import { drawFacts } from './facts.js';
import { drawForm, startForm } from './form.js';
import { Graph } from './graph.js';
import { change, go, model, startModel, tell } from './model.js';
import { drawPhoto, play } from './photo.js';
import { fromScene, hash, innerOf, toml } from './scene.js';
import { drawSpeeds } from './speeds.js';
import { drawTicks } from './ticks.js';
import { drawTrace, openFiles, startTraces } from './trace.js';
import { fileOf, loadEngine } from './view.js';

const TITLES = { leaf: 'Leaf', trapezoid: 'Focal plane', box: 'Electronic', 'liquid-crystal': 'Liquid crystal' };

let graph;
// The panels further down that are in sight: they are written when they are seen, and on paper.
const inSight = new Set();
// What draws the model, each a part of the screen.
const PARTS = [drawState, (model) => graph.show(model), drawPhoto, drawPresets, (model) => drawFacts(model, graph.samples), drawForm, drawTrace, drawSpeeds, drawExport, drawBar, (model) => inSight.has('ticks') && drawTicks(model)];

// Draws all that is on the screen. A part that fails is told, and keeps neither the others nor the address from what is so.
function drawAll(model) {
  for (const part of PARTS) {
    try {
      part(model);
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

function drawState({ now: { scene, trace }, pending, view, last, canUndo, canRedo }) {
  const states = { void: !last, stale: !view, unplanned: !view?.plan.Ok, answered: trace || pending, refused: pending };
  for (const [name, is] of Object.entries(states)) document.body.classList.toggle(name, Boolean(is));
  $('undo').disabled = !canUndo;
  $('redo').disabled = !canRedo;
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

const OFFERED = presets.map(({ name, scene: it }) => {
  const scene = fromScene(name, it);
  return { name, scene, address: hash({ scene }), path: thumbnail(scene) };
});

const openExample = async () => openFiles([new File([await (await fetch(fileOf('leaf.csv'))).blob()], 'leaf.csv')]);

function drawPresets({ now, last }) {
  const at = hash({ scene: now.scene });
  const choose = ({ name, scene }) => (TITLES[name] ? change({ scene, trace: null, speeds: null }) : openExample());
  const isPressed = (it) => Boolean(last) && !now.speeds && it.address === at;
  const stop = OFFERED.find(isPressed) ?? OFFERED[0];
  render(OFFERED.map((it) => html`<button type="button" data-name=${it.name} aria-pressed=${TITLES[it.name] ? isPressed(it) : nothing} tabindex=${it === stop ? 0 : -1} @click=${() => choose(it)}>
    <svg viewBox="0 0 60 24" aria-hidden="true"><path d=${it.path} /></svg><b>${TITLES[it.name] ?? 'A measured example'}</b></button>`), $('presets'));
}

function listen() {
  // One stop of Tab, and arrows from there.
  $('presets').onkeydown = (event) => {
    const all = [...$('presets').children];
    all[arrowed(event, all.indexOf(event.target.closest('button')), all.length)]?.focus();
  };
  const observer = new IntersectionObserver((entries) => {
    for (const { target: { dataset: { panel } }, isIntersecting } of entries) {
      inSight[isIntersecting ? 'add' : 'delete'](panel);
      if (isIntersecting) panel === 'ticks' ? drawTicks(model) : showExport();
    }
  }, { rootMargin: '80px' });
  for (const card of document.querySelectorAll('[data-panel]')) observer.observe(card);
  addEventListener('beforeprint', () => {
    tell({ cursor: null, isPlaying: false });
    drawTicks(model);
  });
  $('play').onclick = play;
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
}

async function begin() {
  await loadEngine();
  graph = new Graph($('graph'));
  startForm();
  startTraces();
  startExport();
  startModel({ scene: OFFERED[0].scene, trace: null, speeds: null }, drawAll);
  listen();
  if (REPOSITORY) render(html`<a href=${REPOSITORY}>The crate</a> <a href="${REPOSITORY}/blob/main/docs/measuring.md">How to record a trace</a>`, $('links'));
  document.body.dataset.ready = '';
  performance.mark('ready');
}

/** For tests and the curious. */
globalThis.designer = { model, hash, toml };

begin().catch((error) => missing(`The page is not whole: ${error.message}. Load it again, in a browser with WebAssembly.`));
