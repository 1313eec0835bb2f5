// Asks the workers: one each writes forms, opens scenes and fits. The newest question counts.

import { toml } from './toml.js';
import { fileOf } from './view.js';

const failed = (reason) => ({ Err: { reason, notes: [] } });

class Asked {
  // The question that is asked, and the newest of those that wait.
  ask(question, payload, progress) {
    return new Promise((resolve) => {
      this.waiting?.resolve(undefined);
      this.waiting = { question, payload, progress, resolve };
      this.next();
    });
  }

  next() {
    if (this.asked || !this.waiting) return;
    [this.asked, this.waiting] = [this.waiting, null];
    if (!this.worker) {
      this.worker = new Worker(fileOf('worker.js'), { type: 'module' });
      this.worker.onmessage = ({ data }) => {
        if ('progress' in data) return this.asked?.progress?.(data.progress);
        // What failed may have left anything behind: the next question gets a new worker.
        if ('failed' in data) return this.end(failed(`this could not be computed (${data.failed})`));
        const { resolve } = this.asked;
        this.asked = null;
        resolve(data.answer);
        this.next();
      };
      this.worker.onerror = () => this.end(failed('this could not be computed'));
    }
    const { question, payload } = this.asked;
    this.worker.postMessage({ question: JSON.stringify(question), payload });
  }

  /** Ends what is asked, with such an answer; nothing means that something newer came. */
  end(answer) {
    if (!this.asked) return;
    this.worker?.terminate();
    this.worker = null;
    const { resolve } = this.asked;
    this.asked = null;
    resolve(answer);
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
export const cancelFit = () => fits.end(undefined);
