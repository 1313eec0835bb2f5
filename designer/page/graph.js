// The curve with its handles, the equal shares, the triggers, and below it the cdf.

import { INNER, TIMES, innerOf, perSecond, short, tidy, withTimes } from './scene.js';

const NS = 'http://www.w3.org/2000/svg';
const LEFT = 44, RIGHT = 16, TOP = 18, BETWEEN = 34, BOTTOM = 44;
/** Within so many pixels of what is valid, a handle snaps to it. */
const MAGNET = 8;
/** More triggers than this have no dots, and more than that no shares. */
const MOST_DOTS = 64, MOST_SHARES = 400;
const HANDLES = [...TIMES, 't1', 't2', 't5', 't6'];

export function svg(tag, attributes = {}, parent) {
  const element = document.createElementNS(NS, tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent?.append(element);
  return element;
}

/** Round numbers in a range, some `count` of them. */
export function rounds(from, to, count) {
  const raw = (to - from) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((by) => by * power >= raw * 0.999) * power;
  const numbers = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step && numbers.length < 50; i++) numbers.push(tidy(i * step));
  return numbers;
}

/** The graph in `box`. `change(scene, isDone)` is told where a handle was moved to, and answers whether that is valid. */
export class Graph {
  constructor(box, change) {
    this.box = box;
    this.change = change;
    const root = (this.root = svg('svg', { role: 'group', 'aria-label': 'Openness over time, with handles; below it the share of the exposure collected' }));
    const defs = svg('defs', {}, root);
    this.clip = svg('path', {}, svg('clipPath', { id: 'below' }, defs));
    svg('rect', {}, svg('clipPath', { id: 'frame' }, defs));
    this.grid = svg('g', { class: 'grid', 'aria-hidden': true }, root);
    const layer = (name, attributes) => svg('path', { class: name, 'aria-hidden': true, ...attributes }, root);
    this.paths = {
      even: layer('share even', { 'clip-path': 'url(#below)' }),
      odd: layer('share odd', { 'clip-path': 'url(#below)' }),
      trace: layer('trace', { 'clip-path': 'url(#frame)' }),
      lamp: layer('lamp', { 'clip-path': 'url(#frame)' }),
      stems: layer('stems'),
      curve: layer('curve'),
      dots: layer('dots'),
      cdfStems: layer('stems cdf'),
      cdf: layer('curve'),
      cdfDots: layer('dots'),
      arms: layer('arms'),
    };
    this.handles = HANDLES.map((name, i) => this.handle(name, i));
    this.bubble = Object.assign(document.createElement('p'), { id: 'bubble', hidden: true });
    this.bubble.setAttribute('role', 'alert');
    box.append(root, this.bubble);
    this.room = box.clientWidth;
    new ResizeObserver(([{ contentRect }]) => {
      this.room = contentRect.width;
      this.draw();
    }).observe(box);
  }

  handle(name, i) {
    const isTime = i < 4;
    const group = svg('g', { class: `handle ${isTime ? 'time' : 'control'}`, tabindex: 0, role: 'slider', id: `handle-${name}` }, this.root);
    svg('circle', { r: 22, class: 'reach' }, group);
    svg('circle', { r: 11, class: 'halo' }, group);
    if (isTime) svg('rect', { x: -6, y: -6, width: 12, height: 12, rx: 2.5 }, group);
    else svg('circle', { r: 6 }, group);
    // The page must not scroll with the finger.
    group.addEventListener('touchstart', (event) => event.preventDefault(), { passive: false });
    group.addEventListener('pointerdown', (event) => this.grab(event));
    group.addEventListener('keydown', (event) => this.key(event, i));
    return group;
  }

  // Where a handle is: [time in the scene's unit, openness].
  place(scene, i) {
    const y = [0, 1, 1, 0];
    if (i < 4) return [scene.times[i], y[i]];
    const inner = innerOf(scene);
    const [t, o] = [inner[2 * (i - 4)], inner[2 * (i - 4) + 1]];
    return [scene.times[0] + t * (scene.times[3] - scene.times[0]), o];
  }

  // The scene with handle i at such a place.
  moved(scene, i, t, y) {
    const [start, , , end] = scene.times;
    if (i < 4) return withTimes(scene, scene.times.with(i, t));
    const inner = [...innerOf(scene)];
    inner[2 * (i - 4)] = tidy((t - start) / (end - start), 9);
    inner[2 * (i - 4) + 1] = y;
    return { ...scene, inner };
  }

  key(event, i) {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const { scene } = this;
    const step = event.shiftKey ? 0.001 : 0.01;
    const [dt, dy] = i < 4 ? [move[0] || move[1], 0] : move;
    if (i < 4) {
      const length = scene.times[3] - scene.times[0];
      // A step is a round number of the unit.
      const round = 10 ** Math.floor(Math.log10(length * step) + 0.31);
      const t = tidy(Math.round(scene.times[i] / round + dt) * round);
      this.change(this.moved(scene, i, t), true, i);
    } else {
      const inner = [...innerOf(scene)];
      const at = 2 * (i - 4) + (dy ? 1 : 0);
      inner[at] = tidy(Math.round((inner[at] + (dy || dt) * step) / step) * step, 9);
      this.change({ ...scene, inner }, true, i);
    }
  }

  grab(event) {
    if (event.button) return;
    event.preventDefault();
    const [x, y] = this.pointer(event);
    // Of those in reach, the nearest.
    const distance = (i) => {
      const [t, o] = this.place(this.scene, i);
      return Math.hypot(this.x(t) - x, this.y(o) - y);
    };
    const i = this.handles.map((_, i) => i).reduce((a, b) => (distance(b) < distance(a) ? b : a));
    const handle = this.handles[i];
    const [t, o] = this.place(this.scene, i);
    const [offsetX, offsetY] = [this.x(t) - x, this.y(o) - y];
    const first = (this.dragged = this.scene);
    handle.focus({ preventScroll: true, focusVisible: false });
    handle.setPointerCapture(event.pointerId);
    handle.classList.add('dragged');
    let last = first;
    const move = (event) => {
      const [x, y] = this.pointer(event);
      last = this.moved(first, i, ...this.snapped(first, i, x + offsetX, y + offsetY, event.altKey));
      this.change(last, false, i);
    };
    const end = (event) => {
      for (const [name, listener] of listeners) handle.removeEventListener(name, listener);
      handle.classList.remove('dragged');
      this.dragged = null;
      this.change(event.type === 'pointerup' ? last : first, true, i);
      this.draw();
    };
    const escape = (event) => event.key === 'Escape' && end(event);
    const listeners = [['pointermove', move], ['pointerup', end], ['pointercancel', end], ['keydown', escape]];
    for (const [name, listener] of listeners) handle.addEventListener(name, listener);
  }

  pointer(event) {
    const { left, top } = this.root.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  // A place on the page as round numbers, or those of what is near and valid.
  snapped(scene, i, x, y, isFree) {
    const { times } = scene;
    const perPixel = (this.range[1] - this.range[0]) / this.width;
    const near = (value, pixels, candidates, round) => {
      const found = isFree ? undefined : candidates.find((it) => Math.abs(it - value) < MAGNET * pixels);
      return found ?? tidy(Math.round(value / round) * round, 9);
    };
    const ends = i < 4 ? [times[i - 1], times[i + 1]].filter((t) => t !== undefined) : i < 6 ? times.slice(0, 2) : times.slice(2);
    const t = near(this.t(x), perPixel, ends, 10 ** Math.floor(Math.log10(perPixel)) * 2);
    const o = near((this.bottom - y) / this.height * (this.high - this.low) + this.low, (this.high - this.low) / this.height, [0, 1], 0.01);
    return [t, o];
  }

  x = (t) => LEFT + ((t - this.range[0]) / (this.range[1] - this.range[0])) * this.width;
  t = (x) => this.range[0] + ((x - LEFT) / this.width) * (this.range[1] - this.range[0]);
  y = (o) => this.bottom - ((o - this.low) / (this.high - this.low)) * this.height;
  u = (u) => this.cdfBottom - u * this.cdfHeight;

  /** Shows a scene and the view of the last one that is valid, and what is wrong, and the handle that it is about. */
  show(scene, view, wrong, at) {
    Object.assign(this, { scene, view, wrong, at });
    this.draw();
  }

  /** A trace beneath, as (seconds, openness, residual). */
  trace(samples) {
    this.samples = samples;
    this.draw();
  }

  fit() {
    const width = Math.max(280, Math.floor(this.room));
    const height = Math.round(Math.min(520, Math.max(400, width * 0.56)));
    Object.assign(this, { width: width - LEFT - RIGHT, height: Math.round((height - TOP - BETWEEN - BOTTOM) * 0.62) });
    this.bottom = TOP + this.height;
    this.cdfBottom = height - BOTTOM;
    this.cdfHeight = this.cdfBottom - this.bottom - BETWEEN;
    if (!this.dragged) {
      const per = perSecond(this.scene.unit);
      const [start, , , end] = this.view.times.map((t) => t * per);
      const heights = this.view.ramps.flat().map(([, y]) => y);
      this.low = Math.min(-0.1, ...heights.map((y) => y - 0.08));
      this.high = Math.max(1.12, ...heights.map((y) => y + 0.08));
      const times = this.view.ramps.flat().map(([t]) => t * per);
      const room = 0.05 * (end - start);
      this.range = [Math.min(start, ...times) - room, Math.max(end, ...times) + room];
    }
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
    text(LEFT, this.u(1) - 8, 'cdf: the share of the exposure collected', 'start', 'title');
    text(right, height - 8, `time (${this.scene.unit})`, 'end', 'title');
    const [rect] = this.root.querySelectorAll('#frame rect');
    for (const [key, value] of Object.entries({ x: LEFT, y: 0, width: this.width, height: this.bottom })) rect.setAttribute(key, value);
  }

  draw() {
    if (!this.view || !this.room) return;
    this.fit();
    const { view, paths } = this;
    const per = perSecond(this.scene.unit);
    const f = (x) => x.toFixed(1);
    const X = (seconds) => this.x(seconds * per);
    const [zero, bottom] = [f(this.y(0)), f(this.u(0))];
    const [opening, closing] = view.ramps.map((ramp) => ramp.map(([t, y]) => `${f(X(t))} ${f(this.y(y))}`));
    const curve = `L${opening[0]}C${opening.slice(1)}L${closing[0]}C${closing.slice(1)}`;
    const [start, end] = [f(X(view.times[0])), f(X(view.times[3]))];
    const area = `M${start} ${zero}${curve}L${end} ${zero}`;
    paths.curve.setAttribute('d', `M${LEFT} ${zero}H${start}${curve}L${end} ${zero}H${LEFT + this.width}`);
    this.clip.setAttribute('d', area + 'Z');

    const top = f(this.y(this.high));
    const shares = ['', ''];
    if (view.edges.length <= MOST_SHARES) {
      for (let i = 1; i < view.edges.length; i++) shares[i % 2] += `M${f(X(view.edges[i - 1]))} ${top}V${zero}H${f(X(view.edges[i]))}V${top}Z`;
    } else shares[0] = `M${start} ${top}V${zero}H${end}V${top}Z`;
    paths.even.setAttribute('d', shares[0]);
    paths.odd.setAttribute('d', shares[1]);

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
    paths.stems.setAttribute('d', stems[0]);
    paths.dots.setAttribute('d', dots[0]);
    paths.cdfStems.setAttribute('d', stems[1]);
    paths.cdfDots.setAttribute('d', dots[1]);
    paths.cdf.setAttribute('d', `M${LEFT} ${bottom}H${start}${view.cdf.map(([t, u]) => `L${f(X(t))} ${f(this.u(u))}`).join('')}H${LEFT + this.width}`);

    const plan = view.plan.Ok;
    const tick = (ticks) => f(X(view.times[0] + ticks / this.scene.timer_hz));
    const isDimmed = this.scene.duty !== null;
    const pulses = plan?.pulses ?? [];
    const high = f(this.y(1));
    paths.lamp.setAttribute('d', pulses.map(([on, off]) => `M${tick(on)} ${zero}V${high}H${tick(off)}V${zero}Z`).join(''));
    paths.lamp.setAttribute('clip-path', isDimmed ? 'url(#below)' : 'url(#frame)');
    document.querySelector('.lamp-key').hidden = pulses.length === 0;
    document.querySelector('.trace-key').hidden = !this.samples;
    paths.trace.setAttribute('d', this.samples ? 'M' + this.samples.map(([t, o]) => `${f(X(t))} ${f(this.y(o))}`).join('L') : '');
    this.drawHandles();
  }

  drawHandles() {
    const { scene } = this;
    const places = this.handles.map((_, i) => this.place(scene, i));
    const isDrawn = places.map((place) => place.every(Number.isFinite));
    const within = (x) => Math.min(Math.max(x, -1e5), 1e5);
    const at = places.map(([t, o]) => [within(this.x(t)), within(this.y(o))]);
    places.forEach(([t, o], i) => {
      const handle = this.handles[i];
      handle.style.display = isDrawn[i] ? '' : 'none';
      if (!isDrawn[i]) return;
      handle.setAttribute('transform', `translate(${at[i].map((x) => x.toFixed(1))})`);
      handle.classList.toggle('wrong', i === this.at);
      const fraction = innerOf(scene)[2 * (i - 4)];
      const said = i < 4 ? `${short(t)} ${scene.unit}` : `time ${short(fraction)}, openness ${short(o)}`;
      const label = i < 4 ? HANDLES[i] : `control point ${INNER[2 * (i - 4)]}, ${INNER[2 * (i - 4) + 1]}`;
      handle.setAttribute('aria-label', label);
      handle.setAttribute('aria-valuetext', said);
      handle.setAttribute('aria-valuenow', short(i < 4 ? t : fraction));
    });
    const point = (i) => at[i].map((x) => x.toFixed(1));
    const arms = [[0, 4], [1, 5], [2, 6], [3, 7]].filter((pair) => pair.every((i) => isDrawn[i]));
    this.paths.arms.setAttribute('d', arms.map(([a, b]) => `M${point(a)}L${point(b)}`).join(''));

    const { bubble } = this;
    const isShown = this.wrong && this.at !== undefined && isDrawn[this.at];
    bubble.hidden = !isShown;
    if (!isShown) return;
    if (bubble.textContent !== this.wrong.reason) bubble.textContent = this.wrong.reason;
    const [middle, height] = at[this.at];
    const { room } = this;
    const half = Math.min(150, room / 2 - 4);
    const x = Math.min(Math.max(middle, half + 4), room - half - 4);
    const y = Math.min(Math.max(height, 0), this.cdfBottom - 80);
    bubble.style.left = `${x}px`;
    bubble.style.top = `${y + 16}px`;
    bubble.style.width = `${2 * half}px`;
  }
}
