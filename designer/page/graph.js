// The curve with the equal shares and the triggers, a trace, another curve beside it; below it the share of the exposure.

import { Handles } from './handles.js';
import { perSecond, short, tidy } from './scene.js';
import { svg } from './svg.js';

const LEFT = 44, RIGHT = 16, TOP = 18, BETWEEN = 34, BOTTOM = 44, RESIDUAL = 64;
/** More triggers than this have no dots, and more than that no shares. */
const MOST_DOTS = 64, MOST_SHARES = 400;

/** Round numbers in a range, some `count` of them. */
export function rounds(from, to, count) {
  const raw = (to - from) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((by) => by * power >= raw * 0.999) * power;
  const numbers = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step && numbers.length < 50; i++) numbers.push(tidy(i * step));
  return numbers;
}

/** The openness of a view at a time in seconds, as the ramps have it: for pictures alone. */
export function openness({ times: [a, b, c, d], ramps }, t) {
  if (t <= a || t >= d) return 0;
  if (t >= b && t <= c) return 1;
  const ramp = ramps[t < b ? 0 : 1];
  const at = (p, k) => (1 - p) ** 3 * ramp[0][k] + 3 * p * (1 - p) ** 2 * ramp[1][k] + 3 * p * p * (1 - p) * ramp[2][k] + p ** 3 * ramp[3][k];
  let [low, high] = [0, 1];
  for (let i = 0; i < 20; i++) {
    const p = 0.5 * (low + high);
    if (at(p, 0) < t) low = p;
    else high = p;
  }
  return at(low, 1);
}

/** The graph in `box`, which tells of what is under the pointer in `readout`. */
export class Graph {
  constructor(box, readout, change) {
    Object.assign(this, { box, readout });
    const root = (this.root = svg('svg', { role: 'group', 'aria-label': 'Openness over time, with handles; below it the share of the exposure collected' }));
    const defs = svg('defs', {}, root);
    this.clip = svg('path', {}, svg('clipPath', { id: 'below' }, defs));
    this.framed = svg('rect', {}, svg('clipPath', { id: 'plot' }, defs));
    this.grid = svg('g', { class: 'grid', 'aria-hidden': true }, root);
    const inside = svg('g', { 'clip-path': 'url(#plot)', 'aria-hidden': true }, root);
    const layer = (name, clip) => svg('path', { class: name, ...(clip && { 'clip-path': 'url(#below)' }) }, inside);
    this.paths = {
      even: layer('share even', true), odd: layer('share odd', true), lamp: layer('lamp'), stems: layer('stems'), other: layer('other'),
      curve: layer('curve'), trace: layer('trace'), errors: layer('errors'), dots: layer('dots'),
      residual: layer('residual'), cdfStems: layer('stems cdf'), cdf: layer('curve'), cdfDots: layer('dots'), cross: layer('cross'), arms: layer('arms'),
    };
    this.handles = new Handles(this, change);
    box.append(root);
    this.room = box.clientWidth;
    new ResizeObserver(([{ contentRect }]) => {
      this.room = contentRect.width;
      this.draw();
    }).observe(box);
    root.addEventListener('pointermove', (event) => !this.dragged && this.readAt(this.t(this.pointer(event)[0])));
    root.addEventListener('pointerleave', () => this.dragged || this.readAt());
  }

  pointer(event) {
    const { left, top } = this.root.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  x = (t) => LEFT + ((t - this.range[0]) / (this.range[1] - this.range[0])) * this.width;
  t = (x) => this.range[0] + ((x - LEFT) / this.width) * (this.range[1] - this.range[0]);
  y = (o) => this.bottom - ((o - this.low) / (this.high - this.low)) * this.height;
  u = (u) => this.cdfBottom - u * this.cdfHeight;
  get perUnit() {
    return perSecond(this.scene.unit);
  }
  get perPixel() {
    return (this.range[1] - this.range[0]) / this.width;
  }

  /** Places as they are now, which a drag keeps to while the range follows it. */
  map() {
    const { range, width, low, high, height, bottom, perPixel } = this;
    const perPixelY = (high - low) / height;
    return {
      perPixel, perPixelY,
      x: (t) => LEFT + ((t - range[0]) / (range[1] - range[0])) * width, t: (x) => range[0] + (x - LEFT) * perPixel,
      y: (o) => bottom - (o - low) / perPixelY, o: (y) => low + (bottom - y) * perPixelY,
    };
  }

  /** Shows a scene and the view of the last one that is valid. */
  show(scene, view) {
    Object.assign(this, { scene, view });
    this.draw();
  }

  /** A trace as (seconds, openness, residual), and its triggers as (seconds, error). */
  trace(trace) {
    if (this.traced === trace) return;
    this.traced = trace;
    this.draw();
  }

  /** Another curve's view, beside this one. */
  compare(other) {
    this.other = other;
    this.draw();
  }

  /** Tells of a time, in the scene's unit; of none what the handles are for. */
  readAt(t) {
    const { view, scene } = this;
    const per = perSecond(scene.unit);
    const isRead = t !== undefined && view && Number.isFinite(t);
    this.paths.cross.setAttribute('d', isRead ? `M${this.x(t).toFixed(1)} ${TOP}V${this.cdfBottom}` : '');
    const words = isRead ? this.words(t / per, per) : '';
    if (this.readout.textContent !== words) this.readout.textContent = words;
  }

  words(s, per) {
    const { view, scene } = this;
    const { cdf } = view;
    const k = Math.min(Math.max(cdf.findIndex(([t]) => t >= s), 0) || (s > cdf[0][0] ? cdf.length - 1 : 0), cdf.length - 1);
    const [[t0, u0], [t1, u1]] = [cdf[Math.max(k - 1, 0)], cdf[k]];
    const u = t1 > t0 ? u0 + (u1 - u0) * Math.min(Math.max((s - t0) / (t1 - t0), 0), 1) : u1;
    const places = Math.max(0, Math.ceil(-Math.log10(this.perPixel)));
    const parts = [`${(s * per).toFixed(Math.min(places, 9))} ${scene.unit}`, `${short(100 * openness(view, s), 3)} % open`, `${short(100 * u, 3)} % collected`];
    const near = view.marks.reduce((best, [t], i) => (Math.abs(t - s) < Math.abs((view.marks[best]?.[0] ?? Infinity) - s) ? i : best), 0);
    if (view.plan.Ok) parts.push(`trigger ${near}: tick ${view.plan.Ok.ticks[near]}`);
    return parts.join(' · ');
  }

  fit() {
    const width = Math.max(280, Math.floor(this.room));
    const strip = this.traced ? RESIDUAL : 0;
    const height = Math.round(Math.min(520, Math.max(400, width * 0.56))) + strip;
    Object.assign(this, { width: width - LEFT - RIGHT, height: Math.round((height - strip - TOP - BETWEEN - BOTTOM) * 0.62) });
    this.bottom = TOP + this.height;
    this.cdfBottom = height - BOTTOM;
    this.cdfHeight = this.cdfBottom - this.bottom - BETWEEN - strip;
    const per = perSecond(this.scene.unit);
    const points = [this.view, ...(this.other ? [this.other] : [])].flatMap((view) => view.ramps.flat());
    const [times, heights] = [points.map(([t]) => t * per), points.map(([, y]) => y)];
    const room = 0.05 * (Math.max(...times) - Math.min(...times));
    const ends = [Math.min(...times) - room, Math.max(...times) + room];
    const [low, high] = [Math.min(-0.1, ...heights.map((y) => y - 0.08)), Math.max(1.12, ...heights.map((y) => y + 0.08))];
    // While a handle is dragged the range follows it, but does not shrink under it.
    if (this.dragged) {
      this.range = [Math.min(ends[0], this.range[0]), Math.max(ends[1], this.range[1])];
      [this.low, this.high] = [Math.min(low, this.low), Math.max(high, this.high)];
    } else Object.assign(this, { range: ends, low, high });
    const size = `${width} ${height} ${this.range} ${this.low} ${this.high} ${this.scene.unit}`;
    if (size === this.size) return;
    this.size = size;
    this.root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.root.setAttribute('width', width);
    this.root.setAttribute('height', height);
    this.frame(height);
  }

  // The axes.
  frame(height) {
    this.grid.replaceChildren();
    const line = (x1, y1, x2, y2, name) => svg('path', { d: `M${x1} ${y1}L${x2} ${y2}`, class: name ?? '' }, this.grid);
    const text = (x, y, words, anchor, name = '') => (svg('text', { x, y, 'text-anchor': anchor, class: name }, this.grid).textContent = words);
    const right = LEFT + this.width;
    for (const o of [0, 0.25, 0.5, 0.75, 1]) {
      line(LEFT, this.y(o), right, this.y(o), o === 0 || o === 1 ? 'bold' : '');
      if (o !== 0.25 && o !== 0.75) text(LEFT - 8, this.y(o) + 4, o, 'end');
    }
    for (const u of [0, 0.5, 1]) {
      line(LEFT, this.u(u), right, this.u(u), u === 0.5 ? '' : 'bold');
      text(LEFT - 8, this.u(u) + 4, u, 'end');
    }
    for (const t of rounds(this.range[0], this.range[1], Math.min(10, this.width / 62))) {
      line(this.x(t), TOP, this.x(t), this.bottom);
      line(this.x(t), this.u(1), this.x(t), this.u(0));
      text(this.x(t), this.cdfBottom + 17, short(t, 6), 'middle');
    }
    text(LEFT, this.u(1) - 8, 'share of the exposure collected', 'start', 'title');
    if (this.traced) text(LEFT, this.bottom + 14, `trace minus curve, ${short(this.zoom(), 2)} times as high`, 'start', 'title');
    text(right, height - 8, `time (${this.scene.unit})`, 'end', 'title');
    for (const [key, value] of Object.entries({ x: LEFT - 5, y: 0, width: this.width + 10, height })) this.framed.setAttribute(key, value);
  }

  // The residual is drawn so many times as high as the trace. Edges within one sample would hide all else.
  zoom() {
    const sizes = this.traced.samples.map(([, , r]) => Math.abs(r)).sort((a, b) => a - b);
    const most = 1.4 * Math.max(sizes[Math.floor(0.98 * (sizes.length - 1))], 1e-5);
    return Math.max(1, Number(((0.5 * (RESIDUAL - 20)) / most / (this.height / (this.high - this.low))).toPrecision(1)));
  }

  draw() {
    if (!this.view || !this.room) return;
    this.fit();
    const { view, paths, traced } = this;
    const per = perSecond(this.scene.unit);
    const f = (x) => x.toFixed(1);
    const X = (seconds) => this.x(seconds * per);
    const [zero, bottom] = [f(this.y(0)), f(this.u(0))];
    const set = (path, d) => path.getAttribute('d') !== d && path.setAttribute('d', d);
    const outline = ({ ramps }) => {
      const [opening, closing] = ramps.map((ramp) => ramp.map(([t, y]) => `${f(X(t))} ${f(this.y(y))}`));
      return `L${opening[0]}C${opening.slice(1)}L${closing[0]}C${closing.slice(1)}`;
    };
    const line = (view) => `M${LEFT} ${zero}H${f(X(view.times[0]))}${outline(view)}L${f(X(view.times[3]))} ${zero}H${LEFT + this.width}`;
    const [start, end] = [f(X(view.times[0])), f(X(view.times[3]))];
    set(paths.curve, line(view));
    set(paths.other, this.other ? line(this.other) : '');
    this.clip.setAttribute('d', `M${start} ${zero}${outline(view)}L${end} ${zero}Z`);

    const top = f(this.y(this.high));
    const shares = ['', ''];
    if (view.edges.length <= MOST_SHARES) {
      for (let i = 1; i < view.edges.length; i++) shares[i % 2] += `M${f(X(view.edges[i - 1]))} ${top}V${zero}H${f(X(view.edges[i]))}V${top}Z`;
    } else shares[0] = `M${start} ${top}V${zero}H${end}V${top}Z`;
    set(paths.even, shares[0]);
    set(paths.odd, shares[1]);

    const hasDots = view.marks.length <= MOST_DOTS;
    const few = view.marks.length > 2000 ? [] : view.marks;
    const dots = ['', ''], stems = ['', ''];
    for (const [t, o, u] of few) {
      const x = f(X(t));
      const [y, v] = [f(this.y(hasDots ? o : 0.04)), f(this.u(hasDots ? u : 0.06))];
      stems[0] += `M${x} ${zero}V${y}`;
      stems[1] += hasDots ? `M${LEFT} ${v}H${x}V${bottom}` : `M${x} ${v}V${bottom}`;
      if (hasDots) {
        dots[0] += `M${x} ${y}h0`;
        dots[1] += `M${x} ${v}h0`;
      }
    }
    set(paths.stems, stems[0]);
    set(paths.dots, dots[0]);
    set(paths.cdfStems, stems[1]);
    set(paths.cdfDots, dots[1]);
    set(paths.cdf, `M${LEFT} ${bottom}H${start}${view.cdf.map(([t, u]) => `L${f(X(t))} ${f(this.u(u))}`).join('')}H${LEFT + this.width}`);

    const tick = (ticks) => f(X(view.times[0] + ticks / this.scene.timer_hz));
    const pulses = view.plan.Ok?.pulses ?? [];
    const high = f(this.y(1));
    set(paths.lamp, pulses.map(([on, off]) => `M${tick(on)} ${zero}V${high}H${tick(off)}V${zero}Z`).join(''));
    if (this.scene.duty !== null) paths.lamp.setAttribute('clip-path', 'url(#below)');
    else paths.lamp.removeAttribute('clip-path');
    const keys = { lamp: pulses.length, trace: traced, other: this.other };
    for (const [name, isThere] of Object.entries(keys)) this.box.parentElement.querySelector(`.${name}-key`).hidden = !isThere;
    const samples = traced?.samples ?? [];
    const points = (y) => (samples.length ? 'M' + samples.map((sample) => `${f(X(sample[0]))} ${f(y(sample))}`).join('L') : '');
    set(paths.trace, points(([, o]) => this.y(o)));
    const scale = traced ? (this.zoom() * this.height) / (this.high - this.low) : 0;
    const half = 0.5 * (RESIDUAL - 20), middle = this.bottom + 20 + half;
    set(paths.residual, traced ? `${points(([, , r]) => middle - Math.min(Math.max(scale * r, -half), half))}M${LEFT} ${middle}H${LEFT + this.width}` : '');
    set(paths.errors, (traced?.triggers ?? []).map(([t, error]) => {
      const y = f(this.y(openness(view, t)));
      return `M${f(X(t - error))} ${y}H${f(X(t + error))}m0 -5v10M${f(X(t - error))} ${Number(y) - 5}v10`;
    }).join(''));
    this.handles.draw();
  }
}

