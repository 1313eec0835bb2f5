// A measured trace: how its file is read, its fit, and what is doubtful about both.

import { $, element } from './dom.js';

const empty = $('trace').firstElementChild;

export function show() {
  $('trace').replaceChildren(empty);
}
