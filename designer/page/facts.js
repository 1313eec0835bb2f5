// The answer: a trace's results or a curve's facts as the program tells them, and beside each what is doubtful.

import { html, nothing, render } from 'lit-html';
import { $ } from './dom.js';
import { change, model } from './model.js';
import { rms } from './graph.js';
import { dial } from './numbers.js';
import { inWords, toldNow } from './told.js';
import { leads } from './trace.js';
import { asFitted, inUnit, isSameShape, perSecond, short } from './scene.js';

/** By how many stops one exposure is longer than another. */
export function stops(exposure, nominal) {
  const ev = Math.log2(exposure / nominal);
  return `${Math.abs(ev) < 0.005 ? '±' : ev < 0 ? '−' : '+'}${Math.abs(ev).toFixed(2)} EV`;
}

/** What is doubtful: its beginning, which unfolds to all of it. */
export const doubt = (words) => html`<details class="doubt"><summary>${words}</summary></details>`;

/** Which fact the doubts of such codes are about; all others are about the exposure. */
const ABOUT = {
  delay: /^(sync_|delay_differs)/, times: /^(noise|sharp_edges|times_rounded)$/, timer: /^(coarse|rate_rounded)$/,
  'set-up': /^dimmed$/, pulses: /^unequal$/,
};
/** What stands elsewhere on the page, and what only firmware wants. */
const HIDDEN = ['shutter', 'opens', 'nominal', 'direct'];
/** What a fit tells otherwise. */
const OF_CURVE = ['trace', 'measured', 'half open'];

/** A fit to its trace, as long as that is what is on the screen. */
const fitOf = ({ scene, trace }) => (trace?.fit && isSameShape(trace.scene, scene) ? trace.fit : null);

/** The doubts about what is on the screen: { about, text }. */
export function doubtsOf(model) {
  const fit = fitOf(model.now), told = toldNow(model)?.doubts ?? [];
  // A fit tells them of itself.
  const ofScene = told.filter(({ code }) => !(fit && code === 'trace'));
  const about = (code) => Object.keys(ABOUT).find((fact) => ABOUT[fact].test(code)) ?? 'exposure';
  return [...(fit?.warnings ?? []), ...ofScene].map(({ code, text }) => ({ about: about(code), text: inWords(text) }));
}

// The facts under their titles, those of a fit in place of its curve's.
function factsOf({ now: { scene: { unit, shutter: { nominal } } } }, told, fit) {
  const without = [...HIDDEN, ...(fit ? [...OF_CURVE, ...fit.facts.map(({ label }) => label)] : [])];
  const all = [...(fit?.facts ?? []), ...told.facts.filter(({ label }) => !without.includes(label))];
  const dialled = nominal / perSecond(unit), near = fit?.nearest_s;
  // A curve that does not explain its trace tells no exposure; the trace does.
  const exposure = all.find(({ key }) => key === 'exposure_s')?.value;
  const called = nominal ? ` for ${dial(dialled)}: ${stops(exposure, dialled)}`
    : near ? `; nearest full stop: ${dial(near)}` : '';
  const facts = new Map([['exposure', ''], ['speed', exposure ? `${dial(exposure)} s${called}` : '']]);
  for (const { label, text } of all) {
    if (text) facts.set(label, [facts.get(label), text].filter(Boolean).join(', '));
  }
  return new Map([...facts].filter(([, text]) => text));
}

/** Draws them; the graph shows `samples` of the trace. */
export function drawFacts(model, samples) {
  const { now: { trace }, view } = model, told = toldNow(model), fit = fitOf(model.now);
  if (!view || !told) return;
  // Of what cannot be planned nothing is told.
  $('facts').inert = Boolean(told.wrong && !fit);
  if ($('facts').inert) return;
  const facts = factsOf(model, told, fit), doubts = doubtsOf(model);
  const [first] = facts.keys();
  const line = ([title, text]) => {
    const about = doubts.filter((it) => title === (facts.has(it.about) ? it.about : first));
    const words = inWords(text);
    // A channel that may be the sync's is asked for.
    const isAsked = title === 'delay' && fit && trace.measured.names.length > 2 && !trace.asked.sync;
    const shown = title === 'exposure' ? html`<b>${words}</b>` : words;
    return html`<div data-fact=${title}><dt>${title}</dt><dd>${shown}
      ${isAsked ? leads('sync') : nothing}${about.map((it) => doubt(it.text))}</dd></div>`;
  };
  const changed = trace && !fit && samples ? byHand(trace, samples) : nothing;
  const name = trace ? html`<h3>${trace.name}</h3>` : nothing;
  render(html`${name}<dl>${[...facts].map(line)}</dl>${changed}`, $('facts'));
}

function byHand({ fit }, samples) {
  const [now, then] = [rms(samples), fit.rms].map((left) => `${short(100 * left, 3)} %`);
  return html`<p id="by-hand">Changed by hand since the fit: the curve now misses the trace by ${now} of the light, the
    fit by ${then}. <button type="button" @click=${backToFit}>Back to the fit</button></p>`;
}

function backToFit() {
  const { trace, scene } = model.now;
  change({ scene: asFitted(scene, inUnit(trace.scene, scene.unit)) });
}
