// node second.mjs FIRMWARE: fires a dense frame on the emulated board, and prints the state machine's program, the words that it
// was fed, and when the lamp went on and off after the edge, for second.py.

import { Board } from "./board.mjs";

const START = 2, LAMP = 3;
const PATIENCE = 62_500_000;
const PULSES = 24;

const board = new Board(process.argv[2]);
const answer = () => {
  if (!board.runUntil(() => board.lines.length > 0, PATIENCE)) throw new Error("no answer");
  return board.lines.shift();
};
answer();
// Pulses as short and as close as they come, in three frames of one edge: 24 pulses 8 cycles apart, or nearly.
for (const line of ["n 1", "gap 0ns", "pulse 16ns", "curve 0 0 5.12e-7 5.12e-7", "n 8", "delay 400ns", "frames 3 512ns"]) {
  board.send(Buffer.from(`${line}\n`));
  const told = answer();
  if (!told.startsWith("ok ")) throw new Error(`${line}: ${told}`);
}
const [machine] = board.mcu.pio[0].machines;
const { txFIFO, wrapBottom, wrapTop, sidesetBase, sidesetCount } = machine;
let words = [], edges = [], edge;
const push = txFIFO.push.bind(txFIFO);
txFIFO.push = (word) => (words.push(word), push(word));
board.watch(LAMP, (isHigh, cycle) => edges.push(cycle - edge));
/** Fires what is armed. */
function fire(cycles) {
  if (!board.runUntil(() => board.isWaitingForPin(), PATIENCE)) throw new Error("never armed");
  board.run(1000);
  edges = [];
  edge = board.cycle;
  board.drive(START, true);
  board.run(cycles);
  board.drive(START, false);
}
// The frame that was armed at first, and then that of these lines, whose words are read from when it is armed on.
fire(1_300_000);
words = words.slice(words.lastIndexOf(PULSES - 1));
fire(2_000);
// A jump's address counts from where the program was put.
const placed = (opcode) => (opcode >> 13 === 0 ? opcode - wrapBottom : opcode);
const program = Array.from(board.mcu.pio[0].instructions.slice(wrapBottom, wrapTop + 1)).map(placed);
console.log(JSON.stringify({ program, sidesetBase, sidesetCount, words: words.slice(0, 1 + 2 * PULSES), edges: edges.slice(0, 2 * PULSES) }));
