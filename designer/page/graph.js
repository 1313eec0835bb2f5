// The curve with the equal shares and the flashes, and a trace; below it the share of the exposure.

import { html, nothing, render, svg } from 'lit-html';
import { $, atMost, watch, write } from './dom.js';
import { Handles } from './handles.js';
import { model } from './model.js';
import { isSameShape, originSeconds, perSecond, short, syncOf, tidy } from './scene.js';
import { viewOf } from './view.js';

const LEFT = 44, RIGHT = 16, TOP = 18, BETWEEN = 34, BOTTOM = 44, RESIDUAL = 64;
/** More triggers than this have no dots. */
const MOST_DOTS = 64;

/** Round numbers in a range, some `count` of them. */
function rounds(from, to, count) {
  const raw = (to - from) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((by) => by * power >= raw * 0.999) * power;
  const first = Math.ceil(from / step - 1e-9), last = Math.floor(to / step + 1e-9);
  return Array.from({ length: Math.min(last - first + 1, 50) }, (_, i) => tidy((first + i) * step));
}

/** The ramps of a view as a part of a path; `place` is where a point of them is. */
export function outline({ ramps }, place) {
  const [opening, closing] = ramps.map((ramp) => ramp.map(place));
  return `L${opening[0]}C${opening.slice(1)}L${closing[0]}C${closing.slice(1)}`;
}

/** Times and the share of the light that has come by then: by the curve, or between the triggers that a trace tells. */
export function collected({ scene, view }) {
  if (!scene.own) return view.cdf;
  const start = scene.own.open_start / perSecond(scene.unit) - originSeconds(scene);
  const last = view.marks.at(-1)[0], end = Math.max(view.times[3], last + 0.02 * (last - start));
  return [[start, 0], ...view.marks.map(([t, , u]) => [t, u]), [end, 1]];
}

/** The share in such a list at a time. */
export function shareAt(list, t) {
  if (t <= list[0][0]) return 0;
  if (t >= list.at(-1)[0]) return 1;
  let [low, high] = [0, list.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle][0] <= t) low = middle;
    else high = middle;
  }
  const [[t0, u0], [t1, u1]] = [list[low], list[high]];
  return u0 + ((t - t0) / (t1 - t0 || 1)) * (u1 - u0);
}

/**
 * A trace's samples in times of the view, and what its curve leaves of them, where `fitted` is the view of the curve
 * that was fitted, if that is another one.
 */
function left({ samples }, origin, view, fitted) {
  if (!fitted) return samples.map(([t, o, r]) => [t - origin, o, r]);
  const moved = ([t, o, r]) => [t - origin, o, r + fitted.openness(t - fitted.origin) - view.openness(t - origin)];
  return samples.map(moved);
}

/** The root of the mean square of what is left. */
export const rms = (samples) => Math.sqrt(samples.reduce((sum, [, , r]) => sum + r * r, 0) / samples.length);

/** The graph in `box`. */
export class Graph {
  constructor(box) {
    this.box = box;
    this.isNew = { all: watch(), trace: watch() };
    this.handles = new Handles(this);
    this.room = box.clientWidth;
    this.cursor = null;
    new ResizeObserver(([{ contentRect }]) => {
      this.room = contentRect.width;
      this.draw();
    }).observe(box);
    // A finger reads as well: what it has touched last stays.
    const reads = (event) => this.dragged || this.pointAt(this.t(this.pointer(event)[0]));
    box.addEventListener('pointerdown', reads);
    box.addEventListener('pointermove', reads);
    box.addEventListener('pointerleave', ({ pointerType: by }) => this.dragged || by !== 'mouse' || this.pointAt());
  }

  pointer(event) {
    const { left, top } = this.box.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  u = (u) => this.cdfBottom - u * this.cdfHeight;
  get perUnit() {
    return perSecond(this.scene.unit);
  }

  /** Points at a time in the scene's unit; at none without one. */
  pointAt(t) {
    this.cursor = Number.isFinite(t) ? t / this.perUnit : null;
    this.point();
  }

  /** Draws the model; what has no curve of its own keeps the last one, which is marked. */
  show({ now: { scene, trace }, last }) {
    if (!last) return;
    Object.assign(this, { scene, view: last });
    if (this.isNew.trace(trace)) {
      this.fitted = trace?.fit && { ...viewOf(trace.scene).Ok, origin: originSeconds(trace.scene) };
    }
    if (this.isNew.all(scene, last, trace, this.dragged)) this.draw();
  }

  // The time that is pointed at, in words.
  point() {
    const { cursor } = this;
    const line = cursor === null ? '' : `M${atMost(this.x(cursor * this.perUnit))} ${TOP}V${this.cdfBottom}`;
    this.box.querySelector('.cross').setAttribute('d', line);
    write($('readout'), cursor === null ? '' : this.words(cursor));
  }

  words(s) {
    const { view: { marks, plan }, view, scene } = this;
    if (!marks.length) return '';
    // Before the first and after the last measured flash nothing is known.
    const [[[first]], [last]] = [marks, marks.at(-1)];
    const beyond = !scene.own ? '' : s < first ? 'under ' : s > last ? 'over ' : '';
    const u = shareAt(collected(this), Math.min(Math.max(s, beyond ? first : s), beyond ? last : s));
    const places = Math.min(9, Math.max(0, Math.ceil(-Math.log10(this.perPixel))));
    const open = Math.round(1e4 * view.openness(s)) / 100;
    const far = ([t]) => Math.abs(t - s);
    const near = marks.reduce((best, mark, i) => (far(mark) < far(marks[best]) ? i : best), 0);
    return [
      `${(s * this.perUnit).toFixed(places)} ${scene.unit}`, `${short(open, 3)} % open`,
      `${beyond}${short(100 * u, 3)} % collected`,
      ...(plan.Ok && scene.flashes.timer_hz !== null ? [`flash ${near}: tick ${plan.Ok.ticks[near]}`] : []),
    ].join(' · ');
  }

  // Where all is.
  fit() {
    const width = Math.max(220, Math.floor(this.room));
    const strip = this.samples ? RESIDUAL : 0;
    const height = Math.round(Math.min(440, Math.max(360, width * 0.5))) + strip;
    this.width = width - LEFT - RIGHT;
    this.height = Math.round((height - strip - TOP - BETWEEN - BOTTOM) * 0.62);
    this.bottom = TOP + this.height;
    this.cdfBottom = height - BOTTOM;
    this.cdfHeight = this.cdfBottom - this.bottom - BETWEEN - strip;
    const per = this.perUnit;
    const ends = [this.view.times[0], this.view.times[3]];
    // A trace is seen whole, as far as there is light.
    const light = this.samples?.filter(([, o]) => o > 0.05) ?? [];
    const lit = light.length ? [light[0], light.at(-1)] : [];
    const seen = [...lit, ...this.view.marks.slice(0, 1), ...this.view.marks.slice(-1)].map(([t]) => t);
    const times = [...ends, ...seen].map((t) => t * per);
    // So is the edge of the sync, from which the times are counted then, unless that is far off.
    if (this.isSynced && Math.abs(ends[0]) <= ends[1] - ends[0]) times.push(0);
    const room = 0.05 * (Math.max(...times) - Math.min(...times));
    const range = [Math.min(...times) - room, Math.max(...times) + room];
    const [low, high] = [-0.1, Math.max(1.12, ...light.map(([, o]) => o + 0.08))];
    // While a handle is dragged the range follows it, but does not shrink under it.
    if (this.dragged) this.range = [Math.min(range[0], this.range[0]), Math.max(range[1], this.range[1])];
    else this.range = range;
    // Places as they are now, which a drag keeps to while the range follows it.
    const { bottom, range: [start, end] } = this;
    const perPixel = (end - start) / this.width, perPixelY = (high - low) / this.height;
    this.map = {
      perPixel, perPixelY, x: (t) => LEFT + (t - start) / perPixel, t: (x) => start + (x - LEFT) * perPixel,
      y: (o) => bottom - (o - low) / perPixelY, o: (y) => low + (bottom - y) * perPixelY,
    };
    Object.assign(this, this.map, { low, high, size: { width, height } });
    if (!this.samples) return;
    // The residual is drawn so many times as high as the trace. Edges within one sample would hide all else.
    const sizes = this.samples.map(([, , r]) => Math.abs(r)).sort((a, b) => a - b);
    const most = 1.4 * Math.max(sizes[Math.floor(0.98 * (sizes.length - 1))], 1e-5);
    this.zoom = tidy((0.5 * (RESIDUAL - 20) * (high - low)) / (most * this.height), 1);
  }

  // The axes.
  get axes() {
    const line = (x, y, to, name = '') => svg`<path class=${name} d="M${x} ${y}${to}" />`;
    const text = (x, y, words, anchor) => svg`<text x=${x} y=${y} text-anchor=${anchor}>${words}</text>`;
    const { x, y, u, range: [start, end], size: { height } } = this, right = LEFT + this.width;
    const across = (at, value, isBold, isTold) =>
      [line(LEFT, at, `H${right}`, isBold ? 'bold' : ''), isTold ? text(LEFT - 8, at + 4, value, 'end') : nothing];
    const up = (t) => [
      line(x(t), TOP, `V${this.bottom}`), line(x(t), u(1), `V${u(0)}`),
      text(x(t), this.cdfBottom + 17, short(t, 6), 'middle'),
    ];
    const left = `trace minus curve, ${short(this.zoom, 2)} times as high`;
    return [
      [0, 0.25, 0.5, 0.75, 1].map((o) => across(y(o), o, o === 0 || o === 1, o !== 0.25 && o !== 0.75)),
      [0, 0.5, 1].map((share) => across(u(share), share, share !== 0.5, true)),
      rounds(start, end, Math.min(10, this.width / 62)).map(up),
      text(LEFT, u(1) - 8, 'share of the exposure collected', 'start'),
      this.samples ? text(LEFT, this.bottom + 14, left, 'start') : nothing,
      text(right, height - 8, `time (${this.scene.unit})`, 'end'),
    ];
  }

  draw() {
    if (!this.view || !this.room) return;
    const { view, scene, scene: { own, flashes } } = this, { trace } = model.now, fit = trace?.fit;
    const isFitted = fit && isSameShape(trace.scene, scene), origin = originSeconds(scene);
    this.isSynced = syncOf(scene).delay !== null;
    this.samples = fit && this.fitted ? left(fit, origin, view, !isFitted && this.fitted) : null;
    this.fit();
    const per = this.perUnit;
    const f = atMost;
    const X = (seconds) => this.x(seconds * per);
    const [zero, bottom] = [f(this.y(0)), f(this.u(0))];
    const ramps = outline(view, ([t, y]) => `${f(X(t))} ${f(this.y(y))}`);
    const [start, end] = [f(X(view.times[0])), f(X(view.times[3]))];
    const top = f(this.y(this.high));
    const isSeen = this.isSynced && this.range[0] <= 0 && this.range[1] >= 0;
    const shares = ['', ''], edges = view.edges.map((t) => f(X(t)));
    for (let i = 1; i < edges.length; i++) shares[i % 2] += `M${edges[i - 1]} ${top}V${zero}H${edges[i]}V${top}Z`;
    const hasDots = view.marks.length <= MOST_DOTS;
    const marks = view.marks.map(([t, o, u]) =>
      [f(X(t)), f(this.y(hasDots ? o : 0.04)), f(this.u(hasDots ? u : 0.06))]);
    const marked = (of) => marks.map(of).join('');
    const dots = (k) => (hasDots ? marked((mark) => `M${mark[0]} ${mark[k]}h0`) : '');
    const come = collected(this).map(([t, u]) => `${f(X(t))} ${f(this.u(u))}`);
    const all = `M${LEFT} ${bottom}L${come.join('L')}H${LEFT + this.width}`;

    const tick = (ticks) => f(X(view.times[0] + (view.plan.Ok.early + ticks) / view.plan.Ok.hz));
    const pulses = view.plan.Ok?.pulses ?? [];
    const high = f(this.y(1));
    const { samples } = this;
    const keys = { lamp: pulses.length, trace: samples, share: shares[1], edge: isSeen };
    for (const [name, isThere] of Object.entries(keys)) document.querySelector(`.${name}-key`).hidden = !isThere;
    const points = (y) => samples ? `M${samples.map((sample) => `${f(X(sample[0]))} ${f(y(sample))}`).join('L')}` : '';
    const scale = samples ? (this.zoom * this.height) / (this.high - this.low) : 0;
    const half = 0.5 * (RESIDUAL - 20), middle = this.bottom + 20 + half;
    const missed = points(([, , r]) => middle - Math.min(Math.max(scale * r, -half), half));
    // Of another number of flashes the fit has not told the errors.
    const told = isFitted && fit.triggers.length === flashes.triggers ? fit.triggers : [];
    const error = ([at, error]) => {
      const t = at - origin, y = f(this.y(view.openness(t)));
      return `M${f(X(t - error))} ${y}H${f(X(t + error))}m0 -5v10M${f(X(t - error))} ${Number(y) - 5}v10`;
    };
    // From the lowest on: each with the part of the picture that it keeps to.
    const layers = [
      ['share even', shares[0], 'below'], ['share odd', shares[1], 'below'],
      ['lamp', pulses.map(([on, off]) => `M${tick(on)} ${zero}V${high}H${tick(off)}V${zero}Z`).join(''),
        flashes.duty !== null && 'below'],
      ['stems', marked(([x, y]) => `M${x} ${zero}V${y}`)],
      ['edge', isSeen ? `M${f(this.x(0))} ${TOP}V${this.cdfBottom}` : ''],
      // Where a trace tells the triggers, no curve does.
      [own ? 'curve beside' : 'curve', `M${LEFT} ${zero}H${start}${ramps}L${end} ${zero}H${LEFT + this.width}`],
      // A trace that goes far below the dark, or above the light, goes through no other chart.
      ['trace', points(([, o]) => this.y(o)), 'upper'], ['errors', told.map(error).join('')], ['dots', dots(1)],
      ['residual', missed && `${missed}M${LEFT} ${middle}H${LEFT + this.width}`],
      ['stems cdf', marked(([x, , v]) => (hasDots ? `M${LEFT} ${v}H${x}V${bottom}` : `M${x} ${v}V${bottom}`))],
      ['curve', own ? `M${come.slice(1, -1).join('L')}` : all], ['dots', dots(2)],
    ];
    const { width, height } = this.size;
    const clip = (id, height) =>
      svg`<clipPath id=${id}><rect x=${LEFT - 5} y="0" width=${this.width + 10} height=${height} /></clipPath>`;
    const layer = ([name, d, clip]) =>
      svg`<path class=${name} clip-path=${clip ? `url(#${clip})` : nothing} d=${d} />`;
    render(html`<svg role="group" viewBox="0 0 ${width} ${height}" width=${width} height=${height}
      aria-label="Openness over time, with handles; below it the share of the exposure collected">
      <defs><clipPath id="below"><path d="M${start} ${zero}${ramps}L${end} ${zero}Z" /></clipPath>
        ${clip('plot', height)}${clip('upper', this.bottom + 4)}</defs>
      <g class="grid" aria-hidden="true">${this.axes}</g>
      <g clip-path="url(#plot)" aria-hidden="true">${layers.map(layer)}<path class="cross" /></g>
      ${this.handles.drawn()}</svg>`, this.box);
    this.point();
  }
}
