// Asks the worker: one question at a time, and of what waits in a queue the newest.

import { toml } from './scene.js';

let worker;
let asked; // { resolve, progress }
const queues = new Map();

function ask(question, payload, progress) {
  return new Promise((resolve) => {
    if (!worker) {
      worker = new Worker(new URL('worker.js', import.meta.url), { type: 'module' });
      worker.onmessage = ({ data }) => {
        if ('progress' in data) return asked?.progress?.(data.progress);
        // What failed may have left anything behind: the next question gets a new worker.
        if ('failed' in data) return cancel(`this could not be computed (${data.failed})`);
        const { resolve } = asked;
        asked = null;
        resolve(data.answer);
        next();
      };
      worker.onerror = () => cancel('this could not be computed');
    }
    asked = { resolve, progress };
    worker.postMessage({ question: JSON.stringify(question), payload });
  });
}

function next() {
  const [first] = queues;
  if (asked || !first) return;
  queues.delete(first[0]);
  const { question, payload, progress, resolve } = first[1];
  ask(question, payload, progress).then(resolve);
}

/** The answer as `{ Ok }` or `{ Err }`; nothing if a newer question of the same queue came first. */
function queued(queue, question, payload, progress) {
  return new Promise((resolve) => {
    queues.get(queue)?.resolve(undefined);
    queues.set(queue, { question, payload, progress, resolve });
    next();
  });
}

/** Ends what is being computed. */
export function cancel(reason = 'stopped') {
  worker?.terminate();
  worker = null;
  const was = asked;
  asked = null;
  was?.resolve({ Err: { reason, notes: [] } });
  next();
}

export const emit = (scene, form) => queued('emit', { ask: 'emit', name: scene.name, scene: toml(scene), form });
export const parse = (name, text) => queued('scene', { ask: 'scene', name, scene: text });
export const fit = (name, asked, file, progress) => queued('fit', { ask: 'fit', name, asked }, file, progress);
