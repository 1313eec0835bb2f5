// node check.mjs FIRMWARE SOURCES [falling|rising EDGES]: runs the firmware in the emulator, and judges each edge of
// the lamp's line in some frames by leaf.rs. Exits with 1 if one is not on its cycle after the sync's edge. By another
// sync than that of leaf.rs, if asked for, and writes the lamp's edges of each frame to EDGES.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Board } from "./board.mjs";

const SYNC = 2;
const LAMP = 3;
const FRAMES = 3;

const [elf, sources, sync, file] = process.argv.slice(2);
const [leaf, main] = ["leaf.rs", "main.rs"].map((name) => readFileSync(join(sources, name), "utf8"));
const number = (name, text) => Number(text.match(`${name}: u32 = (\\w+);`)[1].replaceAll("_", ""));
const array = (name) => leaf.match(`${name}: \\[.*?\\] = \\[([^\\]]*)\\];`)?.[1].match(/\d+/g).map(Number);
const delay = number("DELAY_TICKS", leaf);
const holdOff = number("HOLD_OFF_TICKS", leaf);
const pulse = number("PULSE", main);
const changes = (array("PULSES") ?? array("TICKS").flatMap((tick) => [tick, tick + pulse])).map((tick) => delay + tick);
const falls = sync ? sync === "falling" : leaf.includes("SYNC_FALLS: bool = true;");

const board = new Board(elf);
const [edges, frames] = [[], []];
board.watch(LAMP, (_, cycle) => edges.push(cycle));
for (let frame = 0; frame < FRAMES; frame++) {
  board.arm();
  // Back to its level at rest, which starts nothing.
  board.drive(SYNC, falls);
  const { pullupEnabled, pulldownEnabled } = board.mcu.gpio[SYNC];
  if (pullupEnabled !== falls || pulldownEnabled === falls) {
    throw new Error("the sync's pin is pulled to the wrong level");
  }
  board.run(1000 + 777 * frame);
  const edge = board.cycle;
  board.drive(SYNC, !falls);
  // The second frame's sync comes again while the frame runs, and before lamp and sync are ready for another.
  for (const at of [changes[0], holdOff - 500].filter((at, i) => i === 0 || at > changes.at(-1))) {
    board.run(edge + at - board.cycle);
    if (frame === 1) for (const level of [falls, !falls]) board.drive(SYNC, level), board.run(100);
  }
  board.run(edge + Math.max(holdOff, changes.at(-1)) + 200 - board.cycle);
  const found = edges.splice(0).map((cycle) => cycle - edge);
  if (found.join() !== changes.join()) {
    throw new Error(`frame ${frame}: the line changes at ${found}, not at ${changes}`);
  }
  frames.push(found);
}
if (file) writeFileSync(file, JSON.stringify(frames));
const [n, way] = [changes.length / 2, falls ? "falling" : "rising"];
console.log(`boards/pico: ${FRAMES} frames of ${n} flashes, each edge on its cycle after a ${way} sync`);
