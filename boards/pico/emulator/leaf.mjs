// node leaf.mjs FIRMWARE EXPECTED [falling]: runs boards/pico-embassy in the emulator, and judges each pulse of some frames by the host's
// frame of the trace that its leaf.rs was made of. Exits with 1 if one is not on its cycle after the edge.

import { readFileSync } from "node:fs";
import { Board } from "./board.mjs";

const START = 2;
const LAMP = 3;
const FRAMES = 3;
const PATIENCE = 62_500_000;

const [elf, expectedFile, way] = process.argv.slice(2);
const active = way !== "falling";
const { ticks, lengths } = JSON.parse(readFileSync(expectedFile, "utf8")).steps.at(-1).frame;
const board = new Board(elf);
const edges = [];
board.watch(LAMP, (_, cycle) => edges.push(cycle));
for (let frame = 0; frame < FRAMES; frame++) {
  if (!board.runUntil(() => board.isWaitingForPin(), PATIENCE)) throw new Error(`frame ${frame} is never armed`);
  board.drive(START, !active);
  board.run(1000 + 777 * frame);
  const edge = board.cycle;
  board.drive(START, active);
  board.run(ticks.at(-1) + 10_000);
  const expected = ticks.flatMap((tick, i) => [edge + tick, edge + tick + lengths[i]]);
  const found = edges.splice(0);
  if (found.join() !== expected.join())
    throw new Error(`frame ${frame}: the line changes at ${found.map((cycle) => cycle - edge)}, not at ${expected.map((cycle) => cycle - edge)}`);
}
console.log(`boards/pico-embassy: ${FRAMES} frames of ${ticks.length} pulses, each on its cycle after the edge`);
