// Where a handle may be: in its box, and there as far in time as is allowed.

import { INNER, TIMES, innerOf, tidy, withInner, withTimes } from './scene.js';

/** The handles: the four times, then the four inner control points. */
export const HANDLES = [...TIMES, 't1', 't2', 't5', 't6'];

/** Where a handle is: [time in the scene's unit, openness]. */
export function placeOf(scene, i) {
  if (i < 4) return [scene.times[i], [0, 1, 1, 0][i]];
  const inner = innerOf(scene), at = INNER.indexOf(HANDLES[i]);
  return [scene.times[0] + inner[at] * (scene.times[3] - scene.times[0]), inner[at + 1]];
}

/** The scene with a handle at such a place. */
export function moved(scene, i, t, y) {
  const [start, , , end] = scene.times;
  if (i < 4) return withTimes(scene, scene.times.with(i, t));
  const inner = [...innerOf(scene)], at = INNER.indexOf(HANDLES[i]);
  inner[at] = tidy((t - start) / (end - start), 9);
  inner[at + 1] = y;
  return withInner(scene, inner);
}

/** Between which times a handle can be moved at all. */
export function limits({ times }, i) {
  const length = times[3] - times[0];
  if (i > 3) return i < 6 ? [times[0], times[1]] : [times[2], times[3]];
  return [i ? times[i - 1] : times[0] - length, i < 3 ? times[i + 1] : times[3] + length];
}

// As far from `from` towards `to` as `isGood`, in steps that are round numbers.
function reach(from, to, step, isGood) {
  if (from === to || isGood(to)) return to;
  const towards = Math.sign(to - from);
  const at = (k) => tidy((Math.round(from / step) + towards * k) * step, 9);
  // Further than an integer counts nobody drags.
  let good = 0, bad = Math.min(Math.ceil(Math.abs(to - from) / step), 2 ** 30);
  while (bad - good > 1) {
    const middle = (good + bad) >> 1;
    if (isGood(at(middle))) good = middle;
    else bad = middle;
  }
  return good ? at(good) : from;
}

/**
 * The scene with handle `i` as near to [t, y] as is allowed, on the way from where it is in `scene`, which is good. `step` is
 * that of a time.
 */
export function slide(scene, i, [t, y], step, isGood) {
  const [least, most] = limits(scene, i);
  const within = (x, [low, high]) => Math.min(Math.max(x, low), high);
  t = within(t, [i ? least : -Infinity, i === 3 ? Infinity : most]);
  y = i < 4 ? y : within(y, [0, 1]);
  return moved(scene, i, reach(placeOf(scene, i)[0], t, step, (t) => isGood(moved(scene, i, t, y))), y);
}
