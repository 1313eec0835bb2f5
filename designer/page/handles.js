// The handles of the graph: moved by mouse, finger and keys, each in its box.

import { nothing, svg } from 'lit-html';
import { $, atMost } from './dom.js';
import { change, model } from './model.js';
import { INNER, TIMES, innerOf, label, short, tidy, timesOf, withInner, withTimes } from './scene.js';
import { allowed } from './view.js';

/** The handles: the four times, then the four inner control points. */
const HANDLES = [...TIMES, 't1', 't2', 't5', 't6'];
/** As they are in the picture, which is Tab's order. */
const ORDER = [0, 4, 5, 1, 2, 6, 7, 3];
/** The page must not scroll with the finger. */
const STILL = { handleEvent: (event) => event.preventDefault(), passive: false };
/** The first control point may pass the second by so much of the ramp. */
const CROSS = 15 / 16;

/** Handles that are so many pixels apart are in one place. */
const SAME = 4;

const nameOf = (i) => i < 4 ? label(HANDLES[i])
  : `${i < 6 ? 'opening' : 'closing'} ramp, ${i % 2 ? 'second' : 'first'} control point`;

/** Where a handle is: [time in the scene's unit, openness]. */
function placeOf(scene, i) {
  const times = timesOf(scene);
  if (i < 4) return [times[i], [0, 1, 1, 0][i]];
  const inner = innerOf(scene), at = INNER.indexOf(HANDLES[i]);
  return [times[0] + inner[at] * (times[3] - times[0]), inner[at + 1]];
}

/** Between which times a handle can be moved. */
function limits(scene, i) {
  const times = timesOf(scene), length = times[3] - times[0];
  if (i < 4) return [i ? times[i - 1] : times[0] - length, i < 3 ? times[i + 1] : times[3] + length];
  const [from, to] = i < 6 ? times : times.slice(2);
  // Rounded, it still is within.
  const room = (CROSS - 1e-6) * (to - from);
  if (i % 2) return [Math.max(from, placeOf(scene, i - 1)[0] - room), to];
  return [from, Math.min(to, placeOf(scene, i + 1)[0] + room)];
}

/** The scene with a handle as near to a place as its box lets it. */
function moved(scene, i, [t, y]) {
  const times = timesOf(scene), [start, , , end] = times;
  const [least, most] = limits(scene, i);
  t = Math.min(Math.max(t, i ? least : -Infinity), i === 3 ? Infinity : most);
  if (i < 4) return kept(scene, withTimes(scene, times.with(i, t)));
  const inner = [...innerOf(scene)], at = INNER.indexOf(HANDLES[i]);
  inner[at] = tidy((t - start) / (end - start), 9);
  inner[at + 1] = Math.min(Math.max(y, 0), 1);
  return kept(scene, withInner(scene, inner));
}

// What the crate refuses all the same, as a ramp too short to be told from none, is not taken.
const kept = (scene, next) => (allowed(next) || !allowed(scene) ? next : scene);

export class Handles {
  constructor(graph) {
    this.graph = graph;
  }

  key(event, i) {
    const { graph: { scene } } = this;
    const by = {
      ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [10, 0], PageDown: [-10, 0],
    }[event.key];
    const end = { Home: 0, End: 1 }[event.key];
    if ((!by && end === undefined) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    let [t, y] = placeOf(scene, i);
    const times = timesOf(scene), length = times[3] - times[0];
    const step = event.shiftKey ? 0.001 : 0.01;
    // A step is a round number: of the unit, or of a control point's fraction.
    const stepped = (x, by, step) => tidy(Math.round(x / step + by) * step, 9);
    if (!by) t = limits(scene, i)[end];
    else if (i < 4) t = stepped(t, by[0] || by[1], 10 ** Math.floor(Math.log10(length * step) + 0.31));
    else if (by[1]) y = stepped(y, by[1], step);
    else t = times[0] + length * stepped(innerOf(scene)[INNER.indexOf(HANDLES[i])], by[0], step);
    const next = moved(scene, i, [t, y]);
    // A key that is held is one step.
    change({ scene: next }, { key: event.repeat ? `held ${i}` : undefined });
    this.graph.pointAt(placeOf(next, i)[0]);
  }

  grab = (event) => {
    if (event.button || this.graph.dragged) return;
    event.preventDefault();
    const { graph } = this;
    const start = graph.pointer(event);
    const first = graph.scene;
    const pixels = (i) => {
      const [t, y] = placeOf(first, i);
      return [graph.x(t), graph.y(y)];
    };
    const distance = (i, [x, y]) => Math.hypot(pixels(i)[0] - x, pixels(i)[1] - y);
    const indices = HANDLES.map((_, i) => i).filter((i) => pixels(i).every(Number.isFinite));
    const nearest = indices.reduce((a, b) => (distance(b, start) < distance(a, start) ? b : a));
    // Of those in one place it becomes the one that can go where the pointer goes.
    const together = indices.filter((i) => distance(i, pixels(nearest)) < SAME);
    const { map } = graph;
    const to = (i, event) => {
      const [x, y] = graph.pointer(event);
      const [x0, y0] = pixels(i);
      // Where the pointer has taken it, in round numbers.
      const step = 2 * 10 ** Math.floor(Math.log10(map.perPixel));
      const [t, o] = [map.t(x0 + x - start[0]), map.o(y0 + y - start[1])];
      return [tidy(Math.round(t / step) * step, 9), i < 4 ? placeOf(first, i)[1] : tidy(o, 2)];
    };
    let i = together.length > 1 ? undefined : nearest;
    let last = first;
    const group = (i) => $(`handle-${HANDLES[i]}`), holder = group(nearest);
    const take = (chosen) => {
      i = chosen;
      group(i).focus({ preventScroll: true, focusVisible: false });
    };
    holder.setPointerCapture(event.pointerId);
    graph.dragged = first;
    if (i !== undefined) take(i);
    const move = (event) => {
      if (i === undefined) {
        const [x, y] = graph.pointer(event);
        if (Math.hypot(x - start[0], y - start[1]) < SAME) return;
        const miss = (i) => {
          const [t, o] = placeOf(moved(first, i, to(i, event)), i);
          return Math.hypot(map.x(t) - pixels(i)[0] - x + start[0], map.y(o) - pixels(i)[1] - y + start[1]);
        };
        const misses = new Map(together.map((i) => [i, miss(i)]));
        take(together.reduce((a, b) => (misses.get(b) < misses.get(a) - 1 ? b : a)));
      }
      // Somebody undid meanwhile, or chose another curve: that one stays.
      if (model.now.scene !== last) return end();
      // A time is moved from where it was at first: on each way its ramp's shape is rounded.
      last = moved(i < 4 ? first : last, i, to(i, event));
      change({ scene: last }, { isDraft: true });
      graph.pointAt(placeOf(last, i)[0]);
    };
    const end = (event) => {
      for (const [name, listener] of listeners) holder.removeEventListener(name, listener);
      removeEventListener('keydown', escape, true);
      graph.dragged = null;
      if (model.now.scene === last && event) change({ scene: event.type === 'pointerup' ? last : first });
      if (i === undefined) take(nearest);
      graph.show(model);
    };
    const escape = (event) => event.key === 'Escape' && end(event);
    const listeners = [['pointermove', move], ['pointerup', end], ['lostpointercapture', end]];
    for (const [name, listener] of listeners) holder.addEventListener(name, listener);
    addEventListener('keydown', escape, true);
  }

  /** All of them, and what joins each to its ramp's end. */
  drawn() {
    const { graph, graph: { scene } } = this;
    const places = HANDLES.map((_, i) => placeOf(scene, i)), isThere = places.map((it) => it.every(Number.isFinite));
    const at = places.map(([t, o]) => `${atMost(graph.x(t))} ${atMost(graph.y(o))}`);
    const handle = (i) => {
      const [t, o] = places[i], [least, most] = limits(scene, i), isTime = i < 4;
      return svg`<g id="handle-${HANDLES[i]}" class="handle ${isTime ? 'time' : 'control'}" tabindex="0" role="slider"
        aria-label=${nameOf(i)} aria-valuetext="${short(t)} ${scene.unit}${isTime ? '' : `, openness ${short(o)}`}"
        aria-valuenow=${short(t)} aria-valuemin=${short(least)} aria-valuemax=${short(most)}
        ?hidden=${!isThere[i]} transform=${isThere[i] ? `translate(${at[i]})` : nothing}
        @touchstart=${STILL} @pointerdown=${this.grab} @keydown=${(event) => this.key(event, i)}
        @focus=${() => graph.pointAt(placeOf(graph.scene, i)[0])}>
        <circle class="reach" r="22" /><circle class="halo" r="11" />
        ${isTime ? svg`<rect x="-6" y="-6" width="12" height="12" rx="2.5" />` : svg`<circle r="6" />`}</g>`;
    };
    const arms = [[0, 4], [1, 5], [2, 6], [3, 7]].filter((pair) => pair.every((i) => isThere[i]));
    return svg`<path class="arms" d=${arms.map(([a, b]) => `M${at[a]}L${at[b]}`).join('')} />${ORDER.map(handle)}`;
  }
}
