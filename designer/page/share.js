// What others are given: a link, a picture, a frame for their page; and two curves side by side.

import { $ } from './dom.js';
import { change } from './model.js';
import { copy, plain, save, told } from './save.js';
import { hash } from './scene.js';

const base = () => location.origin + location.pathname;

export const link = (now) => copy(base() + hash(now), 'Copied: a link to this curve');

export const frame = ({ scene, other }) =>
  copy(`<iframe src="${base()}?embed${hash({ scene, other }).replaceAll('&', '&amp;')}" width="720" height="520" style="border:0;max-width:100%" title="The curve of a shutter"></iframe>`,
    'Copied: HTML that shows this curve in another page');

/** Keeps this curve beside those that are drawn from now on, or no longer. */
export function compare({ other, scene }) {
  change({ other: other ? null : scene });
  told(other ? '' : 'This curve stays, dashed: change it, or choose another one.');
}

// The graph as it is seen, but for the handles: as text, since this page itself takes no styles but from its sheet.
async function drawn({ scene }, style = '') {
  const sheet = await (await fetch(document.querySelector('link[rel=stylesheet]').href)).text();
  const graph = $('graph').querySelector('svg').cloneNode(true);
  for (const part of graph.querySelectorAll('.handle, .arms, .cross, .fired')) part.remove();
  for (const part of [graph, ...graph.querySelectorAll('*')]) part.removeAttribute('aria-hidden');
  graph.setAttribute('role', 'img');
  graph.setAttribute('aria-label', `Openness and exposure of the shutter ${scene.name} over time, with its triggers`);
  return new XMLSerializer().serializeToString(graph).replace('>', () => `><style>${sheet}:root { background: var(--card); ${style} }</style>`);
}

export const svg = async (now) => save(new Blob([await drawn(now)], { type: 'image/svg+xml' }), `${plain(now.scene.name)}.svg`);

export async function png(now) {
  const scheme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(await drawn(now, `color-scheme: ${scheme}`))}`;
  await image.decode();
  const canvas = Object.assign(document.createElement('canvas'), { width: 2 * image.width, height: 2 * image.height });
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => save(blob, `${plain(now.scene.name)}.png`));
}
