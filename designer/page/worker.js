// The crate as WebAssembly with all that is not needed at each move of the mouse.

import init, * as studio from 'studio';

globalThis.progress = (share) => postMessage({ progress: share });
const loaded = init({ module_or_path: new URL('studio.wasm', import.meta.url) });

async function answer({ kind, words, payload }) {
  await loaded;
  const bytes = payload ? [new Uint8Array(await payload.arrayBuffer())] : [];
  return JSON.parse(studio[kind](...words, ...bytes));
}

onmessage = ({ data }) =>
  answer(data).then((answer) => postMessage({ answer }), reportError);
