// Asks the workers: one tells of scenes and writes forms, the other fits. Of each kind the newest question counts.

import { toProgram } from './scene.js';
import { fileOf } from './view.js';

// A worker, and what is asked of it: one question at a time, and of each kind the newest.
function asked() {
  const waiting = new Map();
  let worker, now;
  const started = () => {
    const worker = new Worker(fileOf('worker.js'), { type: 'module' });
    worker.onmessage = ({ data: { progress, answer } }) => answer ? end(answer, true) : now?.progress?.(progress);
    worker.onerror = ({ message }) => end({ Err: `this could not be computed (${message})` });
    return worker;
  };
  const next = () => {
    const [[kind, question] = []] = waiting;
    if (now || !question) return;
    waiting.delete(kind);
    now = question;
    worker ??= started();
    worker.postMessage({ kind, words: question.words, payload: question.payload });
  };
  // Ends what is asked, with such an answer; nothing means that something newer came. What was not answered may have
  // left anything behind: the next question gets a new worker.
  const end = (answer, isAnswered) => {
    if (!now) return;
    if (!isAnswered) worker = worker.terminate();
    now.resolve(answer);
    now = null;
    next();
  };
  const ask = (kind, words, payload, progress) => new Promise((resolve) => {
    waiting.get(kind)?.resolve();
    waiting.set(kind, { words, payload, progress, resolve });
    next();
  });
  return { ask, end };
}

const [scenes, fits] = [asked(), asked()];
// As TOML, which has no null.
function toml(it) {
  if (Array.isArray(it)) return `[${it.map(toml)}]`;
  if (Object(it) === it) return `{${entries(it).map(([key, value]) => `${key}=${toml(value)}`)}}`;
  if (typeof it !== 'number') return JSON.stringify(it);
  // Its whole numbers end somewhere, and what is not finite has other names.
  return Math.abs(it) < 1e15 ? String(it) : it.toExponential().toLowerCase().replace('inity', '');
}
const entries = (table) => Object.entries(table).filter(([, value]) => value != null);
const text = (tables) => entries(tables).map(([key, value]) => `${key}=${toml(value)}`).join('\n');

/** The answers are `{ Ok }` or `{ Err }`; nothing if something newer came first. */
export const tellScene = (scene) => scenes.ask('tell', [text(toProgram(scene))]);
export const emitForm = (scene, form) => scenes.ask('emit', [scene.name, text(toProgram(scene)), form]);
export const openScene = (name, text) => scenes.ask('open', [name, text]);
export function fitTrace(name, asked, file, progress) {
  cancelFit();
  return fits.ask('fit', [name, text(asked)], file, progress);
}

/** Ends the fit that is computed. */
export const cancelFit = () => fits.end();
