// The exposure, played: the cursor of the model goes through it once.

import { collected } from './graph.js';
import { model, tell } from './model.js';

/** How long an exposure takes here, in milliseconds. */
const LENGTH = 4000;

let frame;

function stop() {
  cancelAnimationFrame(frame);
  if (model.isPlaying) tell({ cursor: null, isPlaying: false });
}

export function play() {
  stop();
  const { view, now: { scene } } = model;
  if (!view) return;
  const list = collected({ scene, view });
  const [start, end] = [list[0][0], list.at(-1)[0]];
  let first;
  tell({ hold: null, cursor: start, isPlaying: true });
  const next = (time) => {
    first ??= time;
    const part = (time - first) / LENGTH;
    // Another curve, or a pointer, ends it.
    if (part > 1 || model.view !== view || !model.isPlaying) return stop();
    tell({ cursor: start + part * (end - start) });
    frame = requestAnimationFrame(next);
  };
  frame = requestAnimationFrame(next);
}
