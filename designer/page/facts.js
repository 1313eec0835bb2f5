// The answer: a trace's results or a curve's facts, and beside each number what is doubtful about it.

import { html, nothing, render } from 'lit-html';
import { $, watch, write } from './dom.js';
import { change, model } from './model.js';
import { rms } from './graph.js';
import { dial } from './numbers.js';
import { leads } from './trace.js';
import { asFitted, inUnit, isSamePlace, isSameShape, perSecond, short } from './scene.js';

const PARTS_OF_SECOND = [8000, 4000, 2000, 1000, 500, 250, 125, 60, 30, 15, 8, 4, 2];
const DIALS = [...PARTS_OF_SECOND.map((part) => 1 / part), 1, 2, 4, 8, 16, 32];

/** The nearest full stop of today's dials; nothing where none is near. */
export function nearest(exposure) {
  const far = (dial) => Math.abs(Math.log2(exposure / dial));
  const found = DIALS.reduce((a, b) => (far(b) < far(a) ? b : a));
  return far(found) < 0.75 ? found : null;
}

/** By how many stops one exposure is longer than another. */
export function stops(exposure, nominal) {
  const ev = Math.log2(exposure / nominal);
  return `${Math.abs(ev) < 0.005 ? '±' : ev < 0 ? '−' : '+'}${Math.abs(ev).toFixed(2)} EV`;
}

/** Doses in words: `50, 100 and 50 %`. */
export function percents(doses) {
  const all = doses.map((dose) => short(100 * dose, 3));
  return `${[all.slice(0, -1).join(', '), all.at(-1)].filter(Boolean).join(' and ')} %`;
}

/** What a coarse timer does to flashes. */
export const rounding = ({ coarse }) =>
  `a tick is so long that flashes move by up to ${short(coarse, 2)} % of a share; a faster timer moves them less`;

/** What is doubtful: a short heading, behind which all of it is told. */
export function doubt(words) {
  const [head] = /^(?:line \d+: )?.{6,}?(?=[;,:] |$)/s.exec(words) ?? [words];
  if (head === words) return html`<small class="doubt">${words}</small>`;
  const [, mark, rest] = /^([;,:] )(.*)$/s.exec(words.slice(head.length));
  return html`<details class="doubt"><summary>${head}</summary><span class="sr">${mark}</span>${rest}</details>`;
}

function rate(hz) {
  const [by, unit] = hz >= 1e6 ? [1e6, 'MHz'] : hz >= 1e3 ? [1e3, 'kHz'] : [1, 'Hz'];
  return `${by > 1 ? short(hz / by, 6) : hz} ${unit}${Number.isInteger(hz) ? '' : `, planned as ${Math.round(hz)} Hz`}`;
}

const SET_UPS = {
  emulated: 'emulated: the camera’s own shutter stays open', in_path: 'in the path: this shutter dims the lamp',
};

// Does a curve explain the trace?
function tested({ own, json: { fit } }) {
  if (own) return 'no curve explains the trace: the flashes are at the trace’s own times';
  if (!fit.explained) return 'no curve explains the trace';
  return fit.tested ? 'the curve explains the trace' : 'untested';
}

const isNewFact = watch();

/** Draws them; the graph shows `samples` of the trace. */
export function drawFacts({ now: { scene, trace }, view, last, isDraft }, samples) {
  if (!last || !isNewFact(scene, trace, view, samples, isDraft)) return;
  const { unit, doubts, measured, nominal, triggers, timer_hz, delay, set_up } = scene, per = perSecond(unit);
  const of = (seconds, digits = 5) => `${short(seconds * per, digits)} ${unit}`;
  const isFitted = trace && isSameShape(trace.scene, scene);
  const fit = isFitted ? trace.fit : null;
  // A curve that does not explain its trace tells no exposure; the trace does.
  const exposure = fit ? fit.json.exposure_s : measured ? null : last.exposure;
  const isKnown = exposure !== null;
  const plan = view?.plan.Ok;
  const lines = [];
  // What is doubtful about a number that is not there is told of the exposure.
  const isThere = { delay: true, times: fit || !measured, efficiency: isKnown, test: fit };
  const line = (what, fact, about) => {
    const told = doubts.filter((it) => about === (isThere[it.about] ? it.about : 'exposure'));
    lines.push(html`<div><dt>${what}</dt><dd>${fact}${told.map((it) => doubt(it.text))}</dd></div>`);
  };
  const light = html`<b>${fit ? fit.exposure : of(exposure)}</b>, as if fully open`;
  line('Exposure', isKnown ? light : 'that of the trace, which is not at hand', 'exposure');
  if (isKnown) {
    const near = fit && nearest(exposure), dialled = nominal / per;
    const called = nominal ? ` for ${dial(dialled)}: ${stops(exposure, dialled)}`
      : near ? `; nearest full stop: ${dial(near)}` : '';
    line('Speed', `${dial(exposure)} s${called}`);
  }
  const drawn = () => {
    const [t1, t2, t3] = last.times.slice(1).map((t, i) => short((t - last.times[i]) * per));
    const half = plan ? `; TE ${short(plan.half_open * per)}` : '';
    return `T1 ${t1}, T2 ${t2}, T3 ${t3}${half}; TOT ${of(last.times[3] - last.times[0])}`;
  };
  const times = fit ? fit.tester : measured ? '' : drawn();
  // A time is not parted from its name, nor from its error.
  if (times) line('Times', times.replace(/(?<=T\w+) | (?=±)|(?<=±) /g, '\u00a0'), 'times');
  if (isKnown) line('Efficiency', fit ? fit.efficiency : `${short(100 * last.efficiency, 4)} %`, 'efficiency');
  if (fit) line('Test', tested(fit), 'test');
  // A channel that may be the sync's is asked for.
  const ask = fit && trace.file && trace.measured.names.length > 2 && !trace.asked.sync ? leads('sync') : nothing;
  const ticks = plan && timer_hz !== null ? `: ${plan.delay} ticks` : '';
  const sync = delay === null ? html`no delay known ${ask}` : `${short(delay, 7)} ${unit} before it opens${ticks}`;
  const isOwn = fit?.delay && delay === inUnit(trace.scene, unit).delay;
  line('Sync', isOwn ? fit.delay : sync, 'delay');
  line('Set-up', SET_UPS[set_up] ?? 'not said yet');
  const timer = timer_hz === null ? 'not given: times alone' : rate(timer_hz);
  line('Timer', html`${timer}${plan?.coarse ? doubt(rounding(plan)) : nothing}`);
  line('Flashes', `${triggers}${!plan ? ', not planned' : plan.most ? `; up to ${plan.most} fit` : ', as measured'}`);
  if (plan?.doses.length) {
    const dimmed = `${percents(plan.doses)} from the first, the middle and the last flash: this shutter dims them`;
    line('Light', html`<span class="doubt">${dimmed}</span>`);
  }
  const changed = trace && !isSamePlace(trace.scene, scene) && samples ? byHand(trace, samples) : nothing;
  const name = trace ? html`<h3>${trace.name}</h3>` : nothing;
  render(html`${name}<dl>${lines}</dl>${changed}${plan ? notes(plan, of) : nothing}`, $('facts'));
  const isDoubted = doubts.some(({ about }) => about === 'exposure');
  write($('speed'), isKnown ? `${dial(exposure)} s${isDoubted ? ', doubtful' : ''}` : `${triggers} measured times`);
}

function notes({ min_gap, closest, drift }, of) {
  const note = (id, words) => html`<p class="note" id=${id}>${words}</p>`;
  const frames = drift > 10 ? Math.round(drift) : short(drift, 2);
  return [
    min_gap && closest !== null ? note('gap', `Closest ${of(closest, 4)} apart; ${of(min_gap, 4)} required.`) : nothing,
    drift ? note('drift', `A tick a second moves the delay by 1 % of a share in ${frames} frames.`) : nothing,
  ];
}

function byHand({ fit }, samples) {
  const [now, then] = [rms(samples), fit.json.fit.rms].map((left) => `${short(100 * left, 3)} %`);
  return html`<p id="by-hand">Changed by hand since the fit: the curve now misses the trace by ${now} of the light, the
    fit by ${then}. <button type="button" @click=${backToFit}>Back to the fit</button></p>`;
}

function backToFit() {
  const { trace, scene } = model.now;
  change({ scene: asFitted(scene, inUnit(trace.scene, scene.unit)) });
}
