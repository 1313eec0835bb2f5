// What is seen beside the curve: the facts; and the panels further down, which are loaded and written when they are seen.

import { $, element, rows, write } from './dom.js';
import { perSecond, short } from './scene.js';

const PANELS = ['ticks', 'cost', 'exposed', 'set-ups'];
let newest, late;
const seen = new Set();

/** Begins to look which of the panels further down are seen. */
export function start() {
  const observer = new IntersectionObserver(async (entries) => {
    for (const { target, isIntersecting } of entries) seen[isIntersecting ? 'add' : 'delete'](target);
    if (seen.size && !late) late = await import('./late.js');
    writeSeen();
  }, { rootMargin: '80px' });
  for (const id of PANELS) observer.observe($(id).closest('section'));
}

/** All panels, for a scene, the view of it, and the range of time that the graph shows; is the curve a measured one? */
export function show(scene, view, range, isMeasured) {
  newest = [scene, view, range];
  facts(scene, view.plan.Ok);
  speed(scene, view.plan.Ok, isMeasured);
  writeSeen();
}

function writeSeen() {
  if (!late || !newest) return;
  for (const id of PANELS) if (seen.has($(id).closest('section'))) late.write(id, ...newest);
}

// A speed as a dial has it: from a third of a second on, seconds are what it shows.
const dial = (s) => (s < 0.3 ? `1/${1 / s < 100 ? short(1 / s, 3) : Math.round(1 / s)}` : short(s, 3));

const DIALS = [1 / 8000, 1 / 4000, 1 / 2000, 1 / 1000, 1 / 500, 1 / 250, 1 / 125, 1 / 60, 1 / 30, 1 / 15, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8];

// The exposure as a speed, beside the nominal one, for which a measured shutter's is the nearest that a dial has.
function speed(scene, { exposure }, isMeasured) {
  const far = (dial) => Math.abs(Math.log2(exposure / dial));
  const nearest = DIALS.reduce((a, b) => (far(b) < far(a) ? b : a));
  const nominal = scene.nominal ? scene.nominal / perSecond(scene.unit) : isMeasured && far(nearest) < 0.75 && nearest;
  const ev = nominal && Math.log2(exposure / nominal);
  write($('speed'), `${dial(exposure)} s${nominal ? ` for ${dial(nominal)}, ${ev < 0 ? '−' : '+'}${Math.abs(ev).toFixed(2)} EV` : ''}`);
}

function facts(scene, plan) {
  const lines = rows($('facts'), plan.facts.length, () => {
    const line = element('div');
    line.append(element('dt'), element('dd'));
    return line;
  });
  plan.facts.forEach(([what, fact], i) => {
    write(lines[i].firstChild, what);
    write(lines[i].lastChild, fact);
  });
  // The closest gap beside what is required of it.
  const box = $('gap');
  box.hidden = Number.isNaN(plan.closest) || plan.min_gap === 0;
  if (box.hidden) return;
  if (!box.firstChild) {
    const bar = element('div', undefined, { class: 'meter', 'aria-hidden': true });
    bar.append(element('i'), element('b'));
    box.append(bar, element('p'));
  }
  const { closest, min_gap } = plan;
  const most = 1.25 * Math.max(closest, min_gap);
  const [bar, text] = box.children;
  bar.firstChild.style.width = `${(100 * closest) / most}%`;
  bar.lastChild.style.left = `${(100 * min_gap) / most}%`;
  const per = perSecond(scene.unit);
  write(text, `closest ${short(closest * per, 4)} ${scene.unit}; ${short(min_gap * per, 4)} ${scene.unit} required`);
}
