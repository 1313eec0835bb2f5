// The crate as WebAssembly with all that is not needed at each move of the mouse.

const [encoder, decoder] = [new TextEncoder(), new TextDecoder()];
const progress = (share) => postMessage({ progress: share });
const loaded = WebAssembly.instantiateStreaming(fetch(new URL('studio.wasm', import.meta.url)), { env: { progress } });

async function answer({ question, payload }) {
  const { exports } = (await loaded).instance;
  const write = (room, bytes) => {
    const to = room(bytes.length);
    if (!to && bytes.length) throw new Error(`no memory for ${bytes.length >> 20} MB`);
    new Uint8Array(exports.memory.buffer).set(bytes, to);
  };
  write(exports.question, encoder.encode(question));
  if (payload) write(exports.payload, new Uint8Array(await payload.arrayBuffer()));
  const length = exports.ask();
  return JSON.parse(decoder.decode(new Uint8Array(exports.memory.buffer, exports.answer(), length)));
}

onmessage = ({ data }) =>
  answer(data).then((answer) => postMessage({ answer }), (fault) => postMessage({ failed: fault.message }));
