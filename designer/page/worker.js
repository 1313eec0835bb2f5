// The crate as WebAssembly with all that is not needed at each move of the mouse.

const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];
const progress = (share) => postMessage({ progress: share });
const loaded = WebAssembly.instantiateStreaming(fetch(new URL('studio.wasm', import.meta.url)), { env: { progress } });

async function answer({ question, payload }) {
  const { exports } = (await loaded).instance;
  const data = payload ? new Uint8Array(await payload.arrayBuffer()) : [], words = encoder.encode(question);
  const to = exports.question(data.length + words.length);
  if (!to) throw new Error(`no memory for ${data.length >> 20} MB`);
  const memory = new Uint8Array(exports.memory.buffer, to);
  memory.set(data);
  memory.set(words, data.length);
  const length = exports.ask(data.length);
  return JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
}

onmessage = ({ data }) =>
  answer(data).then((answer) => postMessage({ answer }), (fault) => postMessage({ failed: fault.message }));
