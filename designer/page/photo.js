// What a camera sees: a ball that moves while the shutter is open, under the shutter itself, and under the flashes at
// its triggers.

import { $, watch, write } from './dom.js';
import { collected, shareAt } from './graph.js';

const WIDTH = 480, RADIUS = 35, HEIGHT = 2 * RADIUS, FINE = 2;
const BALL = [255, 238, 205], NIGHT = [13, 16, 24];
// The steps of the ball's way.
const STEPS = FINE * (WIDTH - HEIGHT);

// From linear light to the bytes of a picture.
const SHADES = new Uint32Array(new Uint8ClampedArray(Array.from({ length: 1025 }, (_, i) => {
  const x = i / 1024;
  const value = x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
  return [...BALL.map((c, k) => NIGHT[k] + (c - NIGHT[k]) * value), 255];
}).flat()).buffer);
const HALVES = Array.from({ length: RADIUS }, (_, y) => Math.round(FINE * Math.sqrt(RADIUS ** 2 - (y + 0.5) ** 2)));

// When each flash begins and ends.
function flashed({ times, marks, plan }) {
  if (!plan.Ok?.pulses.length) return marks.map(([t]) => [t, t]);
  const { pulses, early, hz } = plan.Ok;
  return pulses.map((pulse) => pulse.map((ticks) => times[0] + (early + ticks) / hz));
}

function expose(light, most) {
  const image = new ImageData(WIDTH, HEIGHT);
  const pixels = new Uint32Array(image.data.buffer);
  for (let y = 0; y < RADIUS; y++) {
    const half = HALVES[y];
    for (let x = 0; x < WIDTH; x++) {
      // From when the ball's front reaches this place until its back has left it.
      const to = FINE * (x - RADIUS) + half, from = to - 2 * half;
      const sum = to < 0 || from > STEPS ? 0 : light[to > STEPS ? STEPS : to] - (from < 0 ? 0 : light[from]);
      const shade = SHADES[Math.min(1024, Math.round((1024 * sum) / most))];
      pixels[(RADIUS + y) * WIDTH + x] = pixels[(RADIUS - 1 - y) * WIDTH + x] = shade;
    }
  }
  return image;
}

// Both pictures, of the light that has come where the ball's middle has got to.
function developed(scene, view) {
  const list = collected({ scene, view }), flashes = flashed(view);
  const [start, end] = [list[0][0], list.at(-1)[0]], n = flashes.length;
  const step = (end - start) / STEPS;
  const along = (share) => Float32Array.from({ length: STEPS + 1 }, (_, k) => share(start + k * step));
  const ideal = along((t) => shareAt(list, t));
  let next = 0;
  const triggered = along((t) => {
    while (next < n && flashes[next][1] <= t) next++;
    if (next === n || t <= flashes[next][0]) return n && next / n;
    // A pulse lasts, and a shutter in the light's path dims it.
    const times = [...flashes[next], t];
    const [from, to, now] = scene.flashes.duty === null ? times : times.map((t) => shareAt(list, t));
    return (next + (now - from) / (to - from || 1)) / n;
  });
  const half = FINE * RADIUS;
  const seen = (k) => ideal[Math.min(STEPS, k + half)] - (k < half ? 0 : ideal[k - half]);
  const most = ideal.reduce((most, _, k) => Math.max(most, seen(k)), 1e-6);
  return [ideal, triggered].map((light) => expose(light, most));
}

const isNewPhoto = watch();

export function drawPhoto({ now: { scene }, last: view }) {
  const { own, flashes: { pulse, duty, fully_open, set_up } } = scene;
  if (!view || !isNewPhoto(view, own)) return;
  const pictures = developed(scene, view);
  for (const [i, id] of ['ideal', 'flashed'].entries()) $(id).getContext('2d').putImageData(pictures[i], 0, 0);
  const n = view.marks.length;
  const what = `${n} ${pulse !== null || duty !== null ? 'pulses' : n === 1 ? 'flash' : 'flashes'}`;
  // How a shutter in the light's path dims them is told with the set-up.
  const isDimmed = set_up === 'in_path' && duty === null && !fully_open;
  write($('flash-caption'), what + (isDimmed ? ', as if of equal light' : n > 1 ? ' of equal light' : ''));
  const steady = 'this shutter, in steady light', told = 'this shutter, as its trace tells between the flashes';
  write($('ideal-caption'), own ? told : steady);
}
