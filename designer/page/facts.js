// The answer: a trace's results or a curve's facts, and beside each number what is doubtful about it.

import { html, nothing, render } from './lit-html.js';
import { $, watch, write } from './dom.js';
import { change, model } from './model.js';
import { rms } from './graph.js';
import { leads } from './trace.js';
import { inUnit, isSameShape, perSecond, short } from './scene.js';

// A speed as a dial has it: from a third of a second on, seconds are what it shows.
export const dial = (s) => (s < 0.3 ? `1/${1 / s < 100 ? short(1 / s, 3) : Math.round(1 / s)}` : short(s, 3));

const DIALS = [1 / 8000, 1 / 4000, 1 / 2000, 1 / 1000, 1 / 500, 1 / 250, 1 / 125, 1 / 60, 1 / 30, 1 / 15, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16, 32];

/** The nearest full stop of today's dials; nothing where none is near. */
export function nearest(exposure) {
  const far = (dial) => Math.abs(Math.log2(exposure / dial));
  const found = DIALS.reduce((a, b) => (far(b) < far(a) ? b : a));
  return far(found) < 0.75 ? found : null;
}

/** By how many stops one exposure is longer than another. */
export const stops = (exposure, nominal) => {
  const ev = Math.log2(exposure / nominal);
  return `${Math.abs(ev) < 0.005 ? '±' : ev < 0 ? '−' : '+'}${Math.abs(ev).toFixed(2)} EV`;
};

/** Doses in words: `50, 100 and 50 %`. */
export function percents(doses) {
  const all = doses.map((dose) => short(100 * dose, 3));
  return `${[all.slice(0, -1).join(', '), all.at(-1)].filter(Boolean).join(' and ')} %`;
}

/** What a coarse timer does to flashes. */
export const rounding = ({ coarse }) => `a tick is so long that flashes move by up to ${short(coarse, 2)} % of a share; a faster timer moves them less`;

export const doubt = (words) => html`<small class="doubt">${words}</small>`;

const rate = (hz) => `${hz >= 1e6 ? `${short(hz / 1e6, 6)} MHz` : hz >= 1e3 ? `${short(hz / 1e3, 6)} kHz` : `${hz} Hz`}${Number.isInteger(hz) ? '' : `, planned as ${Math.round(hz)} Hz`}`;

const isNewFact = watch();

/** Draws them; the graph shows `samples` of the trace. */
export function drawFacts({ now: { scene, trace }, view, last, isDraft }, samples) {
  if (!last || !isNewFact(scene, trace, view, samples, isDraft)) return;
  const per = perSecond(scene.unit);
  const of = (seconds, digits = 5) => `${short(seconds * per, digits)} ${scene.unit}`;
  const isFitted = trace && isSameShape(trace.scene, scene);
  const fit = isFitted ? trace.fit : null;
  // A curve that does not explain its trace tells no exposure; the trace does.
  const exposure = fit ? fit.json.exposure_s : scene.measured ? null : last.exposure;
  const plan = view?.plan.Ok;
  const [a, b, c, d] = last.times;
  const lines = [];
  // What is doubtful about a number that is not there is told of the exposure.
  const there = ['exposure', 'delay', ...(fit || !scene.measured ? ['times'] : []), ...(exposure !== null ? ['efficiency'] : []), ...(fit ? ['test'] : [])];
  const line = (what, fact, about) => {
    const doubts = scene.doubts.filter((it) => about === (there.includes(it.about) ? it.about : 'exposure'));
    lines.push(html`<div><dt>${what}</dt><dd>${fact}${doubts.map((it) => doubt(it.text))}</dd></div>`);
  };
  if (exposure !== null) line('Exposure', html`<b>${fit ? fit.exposure : of(exposure)}</b>, as if fully open`, 'exposure');
  else line('Exposure', 'that of the trace, which is not at hand', 'exposure');
  if (exposure !== null) {
    const near = fit && nearest(exposure);
    line('Speed', `${dial(exposure)} s${scene.nominal ? ` for ${dial(scene.nominal / per)}: ${stops(exposure, scene.nominal / per)}` : near ? `; nearest full stop: ${dial(near)}` : ''}`);
  }
  if (fit) line('Times', fit.tester, 'times');
  else if (!scene.measured) line('Times', `T1 ${short((b - a) * per)}, T2 ${short((c - b) * per)}, T3 ${short((d - c) * per)}${plan ? `; TE ${short(plan.half_open * per)}` : ''}; TOT ${of(d - a)}`, 'times');
  if (exposure !== null) line('Efficiency', fit ? fit.efficiency : `${short(100 * last.efficiency, 4)} %`, 'efficiency');
  if (fit) line('Test', fit.own ? 'no curve explains the trace: the flashes are at the trace’s own times' : !fit.json.fit.explained ? 'no curve explains the trace' : fit.json.fit.tested ? 'the curve explains the trace' : 'untested', 'test');
  // A channel that may be the sync's is asked for.
  const ask = fit && trace.file && trace.measured.names.length > 2 && !trace.asked.sync ? leads('sync') : nothing;
  line('Sync', fit?.delay ?? (scene.delay === null ? html`no delay known ${ask}` : `${short(scene.delay, 7)} ${scene.unit} before it opens${plan && scene.timer_hz !== null ? `: ${plan.delay} ticks` : ''}`), 'delay');
  line('Set-up', { emulated: 'emulated: the camera’s own shutter stays open', in_path: 'in the path: this shutter dims the lamp' }[scene.set_up] ?? 'not said yet');
  line('Timer', html`${scene.timer_hz === null ? 'not given: times alone' : rate(scene.timer_hz)}${plan?.coarse ? doubt(rounding(plan)) : nothing}`);
  line('Flashes', !plan ? `${scene.triggers}, not planned` : plan.most ? `${scene.triggers}; up to ${plan.most} fit` : `${scene.triggers}, as measured`);
  if (plan?.doses.length) line('Light', html`<span class="doubt">${percents(plan.doses)} from the first, the middle and the last flash: this shutter dims them</span>`);
  const isHand = trace && !isFitted;
  const changed = isHand && samples ? html`<p id="by-hand">Changed by hand since the fit: the curve now misses the trace by ${short(100 * rms(samples), 3)} % of the light, the fit by ${short(100 * trace.fit.json.fit.rms, 3)} %.
    <button type="button" @click=${backToFit}>Back to the fit</button></p>` : nothing;
  render(html`${trace ? html`<h3>${trace.name}</h3>` : nothing}<dl>${lines}</dl>${changed}${plan?.min_gap && plan.closest !== null ? html`<p class="note" id="gap">Closest ${of(plan.closest, 4)} apart; ${of(plan.min_gap, 4)} required.</p>` : nothing}
    ${plan?.drift ? html`<p class="note" id="drift">A tick a second moves the delay by 1 % of a share in ${plan.drift > 10 ? Math.round(plan.drift) : short(plan.drift, 2)} frames.</p>` : nothing}`, $('facts'));
  write($('speed'), exposure === null ? `${scene.triggers} measured times` : `${dial(exposure)} s${scene.doubts.some(({ about }) => about === 'exposure') ? ', doubtful' : ''}`);
}

function backToFit() {
  const { trace, scene } = model.now;
  const { times, inner, measured, untold } = inUnit(trace.scene, scene.unit);
  change({ scene: { ...scene, times, inner, measured, untold, ...(measured && { triggers: measured.length }) } });
}
