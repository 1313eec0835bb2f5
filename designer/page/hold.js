// What holds a handle, told beside it.

import { $, button, watch } from './dom.js';
import { limits, placeOf } from './edge.js';
import { mend } from './export.js';
import { inWords, remedies } from './remedies.js';
import { lampOf, short } from './scene.js';
import { view } from './view.js';

const NAMES = ['the start of opening', 'the end of opening', 'the start of closing', 'the end of closing'];

// What keeps a handle from a place, where its scene would be `scene`: { words, remedies }.
function heldBy(scene, i) {
  const answer = view(scene);
  const wrong = answer.Err ?? answer.Ok.plan.Err;
  const [t, o] = placeOf(scene, i);
  const [least, most] = limits(scene, i);
  if (i < 4) {
    if (i && t < least) return { words: `It cannot come before ${NAMES[i - 1]}, at ${short(least)} ${scene.unit}.`, remedies: [] };
    if (i < 3 && t > most) return { words: `It cannot come after ${NAMES[i + 1]}, at ${short(most)} ${scene.unit}.`, remedies: [] };
  }
  if (wrong?.key === 'triggers' && !lampOf(scene)) {
    const words = `Further, ${scene.triggers} flashes would come closer than ${scene.min_gap ? `${short(scene.min_gap)} ${scene.unit}` : 'a tick'}.`;
    return { words, remedies: remedies(scene) };
  }
  const reason = wrong?.reason ?? 'Further is not possible.';
  if (t < least || t > most) return { words: `It stays on its ramp, from ${short(least)} to ${short(most)} ${scene.unit}.`, remedies: [] };
  if (o > 1) return { words: 'Fully open is 1: it cannot go above.', remedies: [] };
  if (o < 0) return { words: 'Closed is 0: it cannot go below.', remedies: [] };
  return { words: inWords(reason, scene), remedies: answer.Ok ? remedies(scene) : [] };
}

const isNew = watch(), isOther = watch();

/** Draws it on the graph. */
export function draw({ hold }, graph) {
  if (!isNew(hold, graph.size)) return;
  const box = $('hold');
  box.hidden = !hold;
  if (!hold) return;
  const { words, remedies } = heldBy(hold.tried, hold.i);
  if (isOther(words, ...remedies.flat())) {
    box.replaceChildren(words, ...remedies.map(([words, changes]) => button(words, () => mend(changes, hold.tried))));
  }
  const x = graph.x(hold.t);
  const left = x > graph.x(0.5 * (graph.range[0] + graph.range[1])) ? `calc(${x - 18}px - 100%)` : `${x + 18}px`;
  // Moved so, it is no shift of the layout.
  box.style.transform = `translate(${left}, ${Math.min(Math.max(graph.y(hold.o) - 14, 4), graph.bottom - 40)}px)`;
}
