// Asks the workers: one tells of scenes and writes forms, the other fits. Of each kind the newest question counts.

import { toProgram } from './scene.js';
import { fileOf } from './view.js';

class Asked {
  waiting = new Map();

  // The question that is asked, and the newest that waits of each kind.
  ask(kind, words, payload, progress) {
    return new Promise((resolve) => {
      this.waiting.get(kind)?.resolve();
      this.waiting.set(kind, { kind, words, payload, progress, resolve });
      this.next();
    });
  }

  next() {
    const [[first, question] = []] = this.waiting;
    if (this.asked || !question) return;
    this.waiting.delete(first);
    this.asked = question;
    this.worker ??= this.started();
    const { kind, words, payload } = question;
    this.worker.postMessage({ kind, words, payload });
  }

  started() {
    const worker = new Worker(fileOf('worker.js'), { type: 'module' });
    const failed = (words) => this.end({ Err: `this could not be computed${words}` });
    worker.onmessage = ({ data: { progress, failed: why, answer } }) => {
      if (progress !== undefined) this.asked?.progress?.(progress);
      else if (why === undefined) this.end(answer, true);
      else failed(` (${why})`);
    };
    worker.onerror = () => failed('');
    return worker;
  }

  // Ends what is asked, with such an answer; nothing means that something newer came. What was not answered may have
  // left anything behind: the next question gets a new worker.
  end(answer, isAnswered) {
    if (!this.asked) return;
    if (!isAnswered) {
      this.worker?.terminate();
      this.worker = null;
    }
    this.asked.resolve(answer);
    this.asked = null;
    this.next();
  }
}

const [scenes, fits] = [new Asked(), new Asked()];
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
