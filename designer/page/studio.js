// Asks the workers: one each writes forms, opens scenes and fits. The newest question counts.

import { toml } from './scene.js';
import { fileOf } from './view.js';

class Asked {
  // The question that is asked, and the newest of those that wait.
  ask(question, payload, progress) {
    return new Promise((resolve) => {
      this.waiting?.resolve();
      this.waiting = { question, payload, progress, resolve };
      this.next();
    });
  }

  next() {
    if (this.asked || !this.waiting) return;
    [this.asked, this.waiting] = [this.waiting, null];
    this.worker ??= this.started();
    const { question, payload } = this.asked;
    this.worker.postMessage({ question: JSON.stringify(question), payload });
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

const [forms, scenes, fits] = [new Asked(), new Asked(), new Asked()];

/** The answers are `{ Ok }` or `{ Err }`; nothing if something newer came first. */
export const emitForm = (scene, form) => forms.ask({ ask: 'emit', name: scene.name, scene: toml(scene), form });
export const parseScene = (name, text) => scenes.ask({ ask: 'scene', name, scene: text });
export function fitTrace(name, asked, file, progress) {
  cancelFit();
  return fits.ask({ ask: 'fit', name, asked }, file, progress);
}

/** Ends the fit that is computed. */
export const cancelFit = () => fits.end();
