// node jitter.mjs FOLDER EXPECTED: how far from its cycle each pulse comes, by the state machine and by the alarm.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Board } from "./board.mjs";

const START = 2;
const LAMP = 3;
const BUSY = 4;
const FRAMES = 5;

const [folder, expectedFile] = process.argv.slice(2);
const { steps, alarm } = JSON.parse(readFileSync(expectedFile, "utf8"));

/** The deviations of the pulses of some frames, in cycles from the edge that starts the frame. */
function deviations(firmware, ticks, keepBusy) {
  const board = new Board(join(folder, firmware));
  let edge, pulse;
  const found = [];
  board.watch(LAMP, (isHigh, cycle) => {
    if (isHigh) found.push(cycle - edge - ticks[pulse++]);
  });
  board.run(500_000);
  keepBusy(board);
  for (let frame = 0; frame < FRAMES; frame++) {
    // Between two microseconds, and somewhere in whatever the processor does.
    board.run(100_000 + 7_793 * frame);
    [edge, pulse] = [board.cycle, 0];
    board.drive(START, true);
    board.run(ticks.at(-1) + 10_000);
    board.drive(START, false);
    if (pulse !== ticks.length) throw new Error(`${firmware}: ${pulse} pulses, not ${ticks.length}`);
  }
  return found;
}

const twelve = steps[0].frame.ticks;
const rows = [
  ["state machine, processor asleep", "strobe", twelve, () => {}],
  ["state machine, processor busy", "strobe", twelve, (board) => board.send(Buffer.from("curve 0 1 2 4 .05 .1 .15 1 .6 1 .7 0\n"))],
  ["alarm, processor asleep", "alarm", alarm, () => {}],
  ["alarm, processor busy", "alarm", alarm, (board) => board.drive(BUSY, true)],
];
console.log("| | pulses | earliest | latest | jitter |\n|---|--:|--:|--:|--:|");
for (const [name, firmware, ticks, keepBusy] of rows) {
  const found = deviations(firmware, ticks, keepBusy);
  const [earliest, latest] = [Math.min(...found), Math.max(...found)];
  const nanoseconds = 8 * (latest - earliest);
  console.log(`| ${name} | ${found.length} | ${earliest} | ${latest} | ${latest - earliest} cycles, ${nanoseconds} ns |`);
}
