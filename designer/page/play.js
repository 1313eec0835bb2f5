// The exposure, played: the cursor of the model goes through it once.

import { collected } from './graph.js';
import { model, tell } from './model.js';

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
