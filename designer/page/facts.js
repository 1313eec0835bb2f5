// The answer: a trace's results or a curve's facts as the program tells them, and beside each what is doubtful.

import { html, nothing, render } from 'lit-html';
import { $, watch } from './dom.js';
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

/** What is doubtful: a short heading, behind which all of it is told. */
export function doubt(words) {
  const [head] = /^(?:line \d+: )?.{6,}?(?=[;,:] |$)/s.exec(words) ?? [words];
  if (head === words) return html`<small class="doubt">${words}</small>`;
  const [, mark, rest] = /^([;,:] )(.*)$/s.exec(words.slice(head.length));
  return html`<details class="doubt"><summary>${head}</summary><span class="sr">${mark}</span>${rest}</details>`;
}

/** Which fact each of the program's doubts is about; all others are about the exposure. */
const ABOUT = {
  delay_differs: 'delay', sync_inverted: 'delay', times_rounded: 'times', rate_rounded: 'timer', dimmed: 'set-up',
  unequal: 'pulses', coarse: 'timer',
};
/** What stands elsewhere on the page, and what only firmware wants. */
const HIDDEN = ['shutter', 'opens', 'nominal', 'direct'];
/** What a fit tells otherwise. */
const OF_CURVE = ['trace', 'measured', 'half open'];
const TITLES = { triggers: 'flashes' };

/** A fit to its trace, as long as that is what is on the screen. */
const fitOf = ({ scene, trace }) => (trace?.fit && isSameShape(trace.scene, scene) ? trace.fit : null);

/** The doubts about what is on the screen: { about, text }. */
export function doubtsOf(model) {
  const fit = fitOf(model.now), told = toldNow(model)?.doubts ?? [];
  // A fit tells them of itself.
  const ofScene = told.filter(({ code }) => !(fit && code === 'trace'));
  const about = ({ code, text }) => ({ about: ABOUT[code] ?? 'exposure', text });
  return [...(fit?.warnings ?? []), ...ofScene.map(about)].map(({ about, text }) => ({ about, text: inWords(text) }));
}

// The facts under their titles, those of a fit in place of its curve's.
function factsOf({ now: { scene: { own, unit, shutter: { nominal } } }, view }, told, fit) {
  const per = perSecond(unit), near = fit?.nearest_s;
  // A curve that does not explain its trace tells no exposure; the trace does.
  const exposure = fit ? fit.exposure_s : own ? null : view.exposure;
  const called = nominal ? ` for ${dial(nominal / per)}: ${stops(exposure, nominal / per)}`
    : near ? `; nearest full stop: ${dial(near)}` : '';
  const facts = new Map([['exposure', ''], ['speed', exposure === null ? '' : `${dial(exposure)} s${called}`]]);
  const without = [...HIDDEN, ...(fit ? [...OF_CURVE, ...fit.facts.map(({ label }) => label)] : [])];
  const rest = told.facts.filter(({ label }) => !without.includes(label));
  // Of what cannot be planned, that much is known.
  const least = { label: 'exposure', text: `${short(exposure * per)} ${unit}` };
  const alone = fit || own || told.facts.length ? [] : [least];
  for (const { label, text } of [...(fit?.facts ?? []), ...alone, ...rest]) {
    if (text) facts.set(label, [facts.get(label), text].filter(Boolean).join(', '));
  }
  return new Map([...facts].filter(([, text]) => text));
}

const isNewFact = watch();

/** Draws them; the graph shows `samples` of the trace. */
export function drawFacts(model, samples) {
  const { now: { trace }, view, isDraft } = model, told = toldNow(model);
  if (!view || !told || !isNewFact(told, trace, view, samples, isDraft)) return;
  const fit = fitOf(model.now), facts = factsOf(model, told, fit), doubts = doubtsOf(model);
  const [first] = facts.keys();
  const line = ([title, text]) => {
    const about = doubts.filter((it) => title === (facts.has(it.about) ? it.about : first));
    // A file's name stays as it is; a time is not parted from its name, nor from its error.
    const words = (title === 'trace' ? text : inWords(text)).replace(/(?<=\bT\w+) | (?=[±%])|(?<=±) /g, '\u00a0');
    // A channel that may be the sync's is asked for.
    const isAsked = title === 'delay' && fit && trace.file && trace.measured.names.length > 2 && !trace.asked.sync;
    const shown = title === 'exposure' ? html`<b>${words}</b>` : words;
    return html`<div data-fact=${title}><dt>${TITLES[title] ?? title}</dt><dd>${shown}
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
