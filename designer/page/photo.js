// What a camera sees: a ball that moves while the shutter is open, under the shutter itself, and under the flashes at its
// triggers. Below each, the light that has come.

import { $, watch, write } from './dom.js';
import { percents } from './facts.js';
import { collected, shareAt } from './graph.js';
import { model, tell } from './model.js';
import { STOPS } from './scene.js';

const WIDTH = 480, RADIUS = 35, HEIGHT = 2 * RADIUS, ROOM = 10, FINE = 2;
const TRAVEL = WIDTH - HEIGHT;
const BALL = [255, 238, 205], NIGHT = [13, 16, 24];

// From linear light to the bytes of a picture.
const SHADES = new Uint32Array(new Uint8ClampedArray(Array.from({ length: 1025 }, (_, i) => {
  const x = i / 1024;
  const value = x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
  return [...BALL.map((c, k) => NIGHT[k] + (c - NIGHT[k]) * value), 255];
}).flat()).buffer);
const HALVES = Array.from({ length: RADIUS }, (_, y) => Math.round(FINE * Math.sqrt(RADIUS ** 2 - (y + 0.5) ** 2)));

/** When each flash begins and ends. */
function flashed({ times, marks, plan }) {
  if (!plan.Ok?.pulses.length) return marks.map(([t]) => [t, t]);
  return plan.Ok.pulses.map((pulse) => pulse.map((ticks) => times[0] + ticks / plan.Ok.timer_hz));
}

// The light that has come where the ball's middle has got to, in so many steps of the way.
function along(start, end, share) {
  return Float32Array.from({ length: FINE * TRAVEL + 1 }, (_, k) => share(start + ((end - start) * k) / (FINE * TRAVEL)));
}

function expose(light, most) {
  const image = new ImageData(WIDTH, HEIGHT);
  const pixels = new Uint32Array(image.data.buffer);
  const last = light.length - 1;
  for (let y = 0; y < RADIUS; y++) {
    const half = HALVES[y];
    for (let x = 0; x < WIDTH; x++) {
      // From when the ball's front reaches this place until its back has left it.
      const to = FINE * (x - RADIUS) + half, from = to - 2 * half;
      const sum = to < 0 || from > last ? 0 : light[to > last ? last : to] - (from < 0 ? 0 : light[from]);
      const shade = SHADES[Math.min(1024, Math.round((1024 * sum) / most))];
      pixels[(RADIUS + y) * WIDTH + x] = pixels[(RADIUS - 1 - y) * WIDTH + x] = shade;
    }
  }
  return image;
}

const isDeveloped = watch(), isShown = watch();
let list, flashes, pictures;

// Both pictures, of the light until a time.
function develop(scene, view, until) {
  list = collected({ scene, view });
  flashes = flashed(view);
  const [start, end] = [list[0][0], list.at(-1)[0]];
  const n = flashes.length;
  const ideal = along(start, end, (t) => shareAt(list, Math.min(t, until)));
  let next = 0;
  const triggered = along(start, end, (t) => {
    const by = Math.min(t, until);
    while (next < n && flashes[next][1] <= by) next++;
    if (next === n || by <= flashes[next][0]) return n && next / n;
    // A pulse lasts, and a shutter in the light's path dims it.
    const [from, to, now] = scene.duty === null ? [...flashes[next], by] : [...flashes[next], by].map((t) => shareAt(list, t));
    return (next + (now - from) / (to - from || 1)) / n;
  });
  const whole = until < end ? along(start, end, (t) => shareAt(list, t)) : ideal;
  const [half, last] = [FINE * RADIUS, whole.length - 1];
  const most = whole.reduce((most, _, k) => Math.max(most, whole[Math.min(last, k + half)] - (k < half ? 0 : whole[k - half])), 1e-6);
  pictures = [ideal, triggered].map((light) => expose(light, most));
}

export function drawPhoto({ now: { scene }, last: view, cursor, isPlaying }) {
  $('flashes').value = STOPS.findLastIndex((n) => n <= scene.triggers);
  $('flashes').setAttribute('aria-valuetext', `${scene.triggers} flashes`);
  write($('flash-count'), String(scene.triggers));
  if (!view || !isShown(view, scene.measured, cursor, isPlaying)) return;
  const until = isPlaying ? cursor : Infinity;
  if (isDeveloped(view, scene.measured, until)) develop(scene, view, until);
  const [start, end] = [list[0][0], list.at(-1)[0]];
  const n = flashes.length, { plan } = view;
  pictures.forEach((image, i) => {
    const context = $(i ? 'flashed' : 'ideal').getContext('2d');
    context.fillStyle = `rgb(${NIGHT})`;
    context.fillRect(0, 0, WIDTH, HEIGHT + ROOM);
    context.putImageData(image, 0, 0);
    if (cursor !== null) {
      context.strokeStyle = '#ff9248';
      context.lineWidth = 2;
      context.beginPath();
      context.arc(RADIUS + (TRAVEL * Math.min(Math.max(cursor - start, 0), end - start)) / (end - start || 1), RADIUS, RADIUS - 1, 0, 7);
      context.stroke();
    }
    // The light that has come: one bar, or one for each flash.
    const come = cursor === null ? 1 : i ? flashes.filter(([, off]) => off <= cursor).length / n : shareAt(list, cursor);
    for (const [share, colour] of [[1, '#39414d'], [come, i ? '#ff9248' : '#4dabf7']]) {
      context.fillStyle = colour;
      context.fillRect(0, HEIGHT + 3, WIDTH * share, ROOM - 3);
    }
    context.fillStyle = `rgb(${NIGHT})`;
    if (i && n <= 120) for (let k = 1; k < n; k++) context.fillRect((WIDTH * k) / n - 1, HEIGHT + 3, 2, ROOM - 3);
  });
  if (isPlaying) return;
  const what = `${n} ${scene.pulse !== null || scene.duty !== null ? 'pulses' : n === 1 ? 'flash' : 'flashes'}${plan.Ok?.doses.length ? `, as if of equal light; through this shutter they give ${percents(plan.Ok.doses)}` : n > 1 ? ' of equal light' : ''}`;
  write($('flash-caption'), what);
  write($('ideal-caption'), scene.measured ? 'this shutter, as its trace tells between the flashes' : 'this shutter, in steady light');
}

/** How long an exposure takes here, in milliseconds. */
const PLAYED = 4000;

let playing;

function stopPlaying() {
  cancelAnimationFrame(playing);
  if (model.isPlaying) tell({ cursor: null, isPlaying: false });
}

export function play() {
  stopPlaying();
  const { view, now: { scene } } = model;
  if (!view) return;
  const list = collected({ scene, view });
  const [start, end] = [list[0][0], list.at(-1)[0]];
  let first;
  tell({ cursor: start, isPlaying: true });
  const next = (time) => {
    first ??= time;
    const part = (time - first) / PLAYED;
    // Another curve, or a pointer, ends it.
    if (part > 1 || model.view !== view || !model.isPlaying) return stopPlaying();
    tell({ cursor: start + part * (end - start) });
    playing = requestAnimationFrame(next);
  };
  playing = requestAnimationFrame(next);
}
