// What is seen beside the curve: the exposure as a speed, the facts, and the gap.

import { $, element, rows, watch, write } from './dom.js';
import { isSameShape, perSecond, short } from './scene.js';

// A speed as a dial has it: from a third of a second on, seconds are what it shows.
export const dial = (s) => (s < 0.3 ? `1/${1 / s < 100 ? short(1 / s, 3) : Math.round(1 / s)}` : short(s, 3));

const DIALS = [1 / 8000, 1 / 4000, 1 / 2000, 1 / 1000, 1 / 500, 1 / 250, 1 / 125, 1 / 60, 1 / 30, 1 / 15, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16, 32];

/** The nearest full step of a dial; nothing where none is near. */
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

const isNew = watch();

export function draw({ now: { scene, trace }, view, last }) {
  if (!last || !isNew(scene, trace, view)) return;
  const per = perSecond(scene.unit);
  const of = (seconds, digits = 5) => `${short(seconds * per, digits)} ${scene.unit}`;
  // A curve that does not explain its trace tells no exposure; the trace does.
  const isFitted = trace?.fit && isSameShape(trace.scene, scene);
  const exposure = !scene.measured ? last.exposure : isFitted ? trace.fit.exposure[0] : null;
  const nominal = scene.nominal ? scene.nominal / per : null;
  write($('speed'), exposure === null ? `${scene.measured.length} measured times` : `${dial(exposure)} s${nominal ? ` for ${dial(nominal)}, ${stops(exposure, nominal)}` : ''}`);

  const plan = view?.plan.Ok;
  const [a, b, c, d] = last.times;
  const lines = [];
  if (exposure !== null) lines.push(['Exposure', `${isFitted ? trace.fit.told : of(exposure)}, as if fully open`]);
  if (!scene.measured) {
    lines.push(['Opens in', of(b - a)], ['Stays open', of(c - b)], ['Closes in', of(d - c)]);
    if (plan) lines.push(['Half open', `for ${of(plan.half_open)}`]);
    lines.push(['Efficiency', isFitted ? trace.fit.efficiency : `${short(100 * last.efficiency, 4)} %`]);
  }
  const hz = scene.timer_hz;
  lines.push(['Timer', `${hz >= 1e6 ? `${short(hz / 1e6, 6)} MHz` : hz >= 1e3 ? `${short(hz / 1e3, 6)} kHz` : `${hz} Hz`}${Number.isInteger(hz) ? '' : `, planned as ${Math.round(hz)} Hz`}${scene.timer_bits ? `, ${scene.timer_bits} bits` : ''}`]);
  lines.push(['Sync', scene.delay === null ? 'no delay known' : plan ? `${plan.delay} ticks before it opens` : `${short(scene.delay, 7)} ${scene.unit} before it opens`]);
  lines.push(['Flashes', !plan ? `${scene.triggers}, not planned` : plan.most ? `${scene.triggers}; up to ${plan.most} fit` : `${scene.triggers}, as measured`]);
  $('doubts').replaceChildren(...scene.doubts.map((words) => element('li', words)));
  const list = rows($('facts'), lines.length, () => {
    const line = element('div');
    line.append(element('dt'), element('dd'));
    return line;
  });
  lines.forEach(([what, fact], i) => {
    write(list[i].firstChild, what);
    write(list[i].lastChild, fact);
  });

  const drift = plan?.drift;
  $('drift').hidden = !drift;
  if (drift) write($('drift'), `${drift[0].toUpperCase()}${drift.slice(1)}.`);

  // The closest gap beside what is required of it.
  const box = $('gap');
  box.hidden = !plan || Number.isNaN(plan.closest) || plan.min_gap === 0;
  if (box.hidden) return;
  const { closest, min_gap } = plan;
  const most = 1.25 * Math.max(closest, min_gap);
  const [bar, text] = box.children;
  bar.firstChild.style.transform = `scaleX(${closest / most})`;
  bar.lastChild.style.transform = `translateX(${(100 * min_gap) / most}%)`;
  write(text, `closest ${of(closest, 4)} apart; ${of(min_gap, 4)} required`);
}
