// The exposure, played: a bar of light sweeps over the graph, and the triggers flash.

import { $, element } from './dom.js';

/** How long an exposure takes here, in milliseconds. */
const LENGTH = 4000;
const FLASH = 160;

let running = [];

export function stop() {
  for (const animation of running) animation.cancel();
  running = [];
  $('sweep')?.remove();
}

/** Plays the exposure on a graph once. */
export function play(graph, view) {
  stop();
  const box = element('div', undefined, { id: 'sweep', 'aria-hidden': true });
  const [bar, spark] = [element('i'), element('b')];
  box.append(bar, spark);
  graph.box.append(box);
  const X = (seconds) => graph.x(seconds * graph.perUnit);
  const [start, end] = [view.times[0], view.times[3]].map(X);
  const at = (x) => `translateX(${x.toFixed(1)}px)`;
  running.push(bar.animate([{ transform: at(start), opacity: 0 }, { opacity: 0.9, offset: 0.04 }, { opacity: 0.9, offset: 0.96 }, { transform: at(end), opacity: 0 }], { duration: LENGTH }));
  // More flashes than a screen can show in that time would be one.
  const most = LENGTH / 2 / FLASH, n = view.marks.length;
  const shown = view.marks.filter((_, i) => n <= most || Math.floor((i * most) / n) !== Math.floor(((i - 1) * most) / n));
  for (const [t, o] of shown) {
    const flash = spark.cloneNode();
    flash.style.translate = `${X(t).toFixed(1)}px ${graph.y(o).toFixed(1)}px`;
    box.append(flash);
    running.push(flash.animate([{ opacity: 1, scale: 1.4 }, { opacity: 0, scale: 0.6 }], { duration: 2.5 * FLASH, delay: (LENGTH * (X(t) - start)) / (end - start || 1) }));
  }
  running[0].onfinish = stop;
}
