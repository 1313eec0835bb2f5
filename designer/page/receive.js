// Files that are opened, dropped, or tried as an example.

import { $ } from './dom.js';
import { model, tell } from './model.js';

/** Begins; what fits a trace is loaded when a file is there. */
export function start(loadTraces) {
  const bring = async (files) => files.length && (await loadTraces()).bring([...files]);
  $('file').onchange = ({ target }) => {
    bring([...target.files]);
    target.value = '';
  };
  $('example').onclick = async () => bring([new File([await (await fetch(new URL('leaf.csv', import.meta.url))).blob()], 'leaf.csv')]);
  $('stop').onclick = () => {
    const { words } = model.busy;
    model.busy.cancel();
    tell({ note: { words: `${words}: stopped.` } });
  };
  let depth = 0;
  const shows = (by) => ($('drop').hidden = (depth = Math.max(0, depth + by)) === 0);
  addEventListener('dragenter', () => shows(1));
  addEventListener('dragleave', () => shows(-1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    depth = 0;
    shows(0);
    bring(event.dataTransfer.files);
  });
}
