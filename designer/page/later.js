// What is loaded after the picture: files, the numbers, export, ticks.

import { drawBar } from './bar.js';
import { drawExport, showExport, startExport } from './export.js';
import { drawForm, startForm } from './form.js';
import { PARTS, drawAll } from './main.js';
import { model, tell } from './model.js';
import { drawSpeeds } from './speeds.js';
import { drawTicks } from './ticks.js';
import { drawTrace, openFiles, startTraces } from './trace.js';
import { fileOf } from './view.js';

// Which of the panels further down are in sight: they are written when they are seen, and on paper.
const inSight = new Set();
const observer = new IntersectionObserver((entries) => {
  for (const { target: { dataset: { panel } }, isIntersecting } of entries) {
    inSight[isIntersecting ? 'add' : 'delete'](panel);
    if (isIntersecting) panel === 'ticks' ? drawTicks(model) : showExport();
  }
}, { rootMargin: '80px' });
for (const card of document.querySelectorAll('[data-panel]')) observer.observe(card);
addEventListener('beforeprint', () => {
  tell({ cursor: null, isPlaying: false });
  drawTicks(model);
});
document.addEventListener('example', async () => openFiles([new File([await (await fetch(fileOf('leaf.csv'))).blob()], 'leaf.csv')]));

PARTS.push(drawForm, drawTrace, drawSpeeds, drawExport, drawBar, (model) => inSight.has('ticks') && drawTicks(model));
startTraces();
startForm();
startExport();
drawAll(model);
