// The page: draws the model, and changes it as a person asks.

import { presets } from 'presets';
import { html, nothing, render } from 'lit-html';
import { $ } from './dom.js';
import { drawExport, startExport } from './export.js';
import { drawFacts } from './facts.js';
import { drawForm, startForm } from './form.js';
import { Graph, outline } from './graph.js';
import { change, go, model, startModel, tell } from './model.js';
import { drawPhoto } from './photo.js';
import { FIELDS, KINDS, fromScene, hash, inUnit, isSameShape, originOf, syncOf, toProgram, valueOf } from './scene.js';
import { drawSpeeds } from './speeds.js';
import { drawTicks } from './ticks.js';
import { askProgram, drawBar, inWords, known } from './told.js';
import { drawTrace, openFiles, startTraces } from './trace.js';
import { fileOf, loadEngine, viewOf } from './view.js';

const TITLES = { leaf: 'Leaf', trapezoid: 'Focal plane', box: 'Electronic', 'liquid-crystal': 'Liquid crystal' };

let graph;
// What draws the model, each a part of the screen.
const PARTS = [
  drawState, askProgram, (model) => graph.show(model), drawPresets, (model) => drawFacts(model, graph.samples),
  drawForm, drawTrace, drawSpeeds, drawBar, drawTicks, drawPhoto,
];
const drawAll = (model) => PARTS.forEach((part) => part(model));

function missing(words) {
  $('missing').textContent = words;
  $('missing').classList.add('now');
}

function drawState({ now: { scene, trace }, pending, view, last, canUndo, canRedo }) {
  const states = { void: !last, stale: !view, unplanned: !view?.plan.Ok, answered: trace || pending, refused: pending };
  for (const [name, is] of Object.entries(states)) document.body.classList.toggle(name, Boolean(is));
  $('undo').disabled = !canUndo;
  $('redo').disabled = !canRedo;
  document.title = `${scene.name} · Curve designer`;
}

let offered;

// The presets, each with its ramps, 60 by 24.
function offer({ name, scene: it, told }) {
  const scene = fromScene(name, it), view = viewOf(scene).Ok, [start, , , end] = view.times;
  const place = ([t, y]) => `${(4 + (52 * (t - start)) / (end - start)).toFixed(1)} ${(21 - 18 * y).toFixed(1)}`;
  known.set(scene, told);
  return { name, scene, address: hash({ scene }), path: `M0 21${outline(view, place)}H60` };
}

async function openExample() {
  const file = await fetch(fileOf('leaf.csv'));
  openFiles([new File([await file.blob()], 'leaf.csv')]);
}

function drawPresets({ now, last }) {
  const at = hash({ scene: now.scene });
  const choose = ({ name, scene }) => (TITLES[name] ? change({ scene, trace: null, speeds: null }) : openExample());
  const isPressed = (it) => Boolean(last) && !now.speeds && it.address === at;
  const button = (it) => html`<button type="button" data-name=${it.name}
    aria-pressed=${TITLES[it.name] ? isPressed(it) : nothing} @click=${() => choose(it)}>
    <svg viewBox="0 0 60 24" aria-hidden="true"><path d=${it.path} /></svg>
    <b>${TITLES[it.name] ?? 'A measured example'}</b></button>`;
  render(offered.map(button), $('presets'));
}

function listen() {
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
  offered = presets.map(offer);
  graph = new Graph($('graph'));
  startForm();
  startTraces();
  startExport();
  listen();
  startModel({ scene: offered[0].scene, trace: null, speeds: null }, drawAll);
  document.body.dataset.ready = '';
  performance.mark('ready');
  // What the forms are written by is most of the page: it comes behind the first screen.
  PARTS.push(drawExport);
  drawExport(model);
}

/** For tests and the curious. */
globalThis.designer = {
  FIELDS, KINDS, model, hash, inUnit, inWords, isSameShape, originOf, syncOf, toProgram, valueOf,
};

addEventListener('error', ({ error }) => error && missing(`A part of the page could not be drawn: ${error.message}.`));
const fallen = ({ message }) => `The page is not whole: ${message}. Load it again, in a browser with WebAssembly.`;
begin().catch((error) => missing(fallen(error)));
