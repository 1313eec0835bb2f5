// node check.mjs FIRMWARE EXPECTED: runs the controller in the emulator and judges every pulse and every answer.
//
// With TRIGGER_FAULT in the environment the firmware, which needs its feature `faults` then, is told to make that fault.
// Exits with 1 if a pulse is not where the host's `trigger_ticks` has it, to the cycle, or an answer is not the right one.

import { readFileSync } from "node:fs";
import { Board } from "./board.mjs";

const START = 2;
const LAMP = 3;
/** The longest that an answer may take: half a second, for a curve that is built. */
const PATIENCE = 62_500_000;

const [elf, expectedFile] = process.argv.slice(2);
const { overhead, steps } = JSON.parse(readFileSync(expectedFile, "utf8"));
const board = new Board(elf);
if (process.env.TRIGGER_FAULT) board.plant(process.env.TRIGGER_FAULT);
const edges = [];
board.watch(LAMP, (isHigh, cycle) => edges.push({ isHigh, cycle }));

const total = { frames: 0, pulses: 0, answers: 0, deviation: 0 };
const shown = new Set();

function fail(reason) {
  throw new Error(reason);
}

/** The next line from the board. */
function answer() {
  if (!board.runUntil(() => board.lines.length > 0, PATIENCE)) fail("no answer");
  total.answers += 1;
  return board.lines.shift();
}

/** Raises the pin that starts a frame once the board waits for it, and gives when. */
function start(name) {
  if (!board.runUntil(() => board.isWaitingForPin(), PATIENCE)) fail(`${name} is never armed`);
  // At another moment of whatever the processor does, each time.
  board.run(1000 + 777 * total.frames);
  if (edges.length > 0) fail(`${name}: TooMany: a pulse before the frame`);
  board.drive(START, true);
  return board.cycle;
}

/** What is wrong with the pulses of a frame that started at `edge`: nothing, or the first reason. */
function judge({ ticks, gap, length }, edge) {
  const rises = edges.filter(({ isHigh }) => isHigh).map(({ cycle }) => cycle);
  const falls = edges.filter(({ isHigh }) => !isHigh).map(({ cycle }) => cycle);
  if (rises.length < ticks.length) return `Missing: ${rises.length} of ${ticks.length} pulses`;
  if (rises.length > ticks.length) return `TooMany: ${rises.length} pulses for ${ticks.length}`;
  for (const [i, tick] of ticks.entries()) {
    if (i > 0 && rises[i] - rises[i - 1] < gap)
      return `TooClose: pulse ${i} is ${rises[i] - rises[i - 1]} cycles after the one before, not ${gap}`;
    const deviation = rises[i] - edge - overhead - tick;
    total.deviation = Math.max(total.deviation, Math.abs(deviation));
    if (deviation !== 0) return `${deviation < 0 ? "Early" : "Late"}: pulse ${i} by ${Math.abs(deviation)} cycles`;
    if (falls[i] - rises[i] !== length) return `Length: pulse ${i} has ${falls[i] - rises[i]} cycles, not ${length}`;
  }
}

/** One step of the script: perhaps a frame, lines, their answers. */
function take({ frame, send, answers }) {
  if (frame) fire(frame, send);
  else board.send(send);
  for (const expected of answers) {
    const given = answer();
    // A refusal is shown once.
    if (!shown.has(given)) console.log(`  ${given}`);
    shown.add(given);
    if (given.replace(/; planned in \d+ cycles(, the curve built in \d+ us)?$/, "") !== expected)
      fail(`the answer should be: ${expected}`);
  }
}

/** Starts a frame, sends lines meanwhile, and judges the pulses. */
function fire(frame, send) {
  const name = `frame ${total.frames + 1}`;
  const edge = start(name);
  board.send(send);
  // A little longer than the frame, for a pulse too many.
  const end = edge + frame.ticks.at(-1) + 3 * frame.length + 1000;
  // The pin goes low soon, or goes high again during the frame, or stays high beyond its end: no matter.
  let isHigh = true;
  for (const part of [[0.1], [0.1, 0.4, 0.6], [1]][total.frames % 3]) {
    board.run(edge + Math.round(part * (end - edge)) - board.cycle);
    board.drive(START, (isHigh = !isHigh));
  }
  board.run(end - board.cycle);
  const wrong = judge(frame, edge);
  if (wrong) fail(`${name}: ${wrong}`);
  edges.length = 0;
  total.frames += 1;
  total.pulses += frame.ticks.length;
  console.log(
    `${name}: ${frame.ticks.length} pulses of ${frame.length} cycles, the first at ${frame.ticks[0]}, the last at ` +
      `${frame.ticks.at(-1)}, each on its cycle`,
  );
}

try {
  console.log(answer());
  for (const step of steps) take(step);
  if (board.lines.length > 0) fail(`an answer to nothing: ${board.lines[0]}`);
  const asleep = Math.round((100 * board.asleep) / board.cycle);
  console.log(
    `${total.frames} frames, ${total.pulses} pulses, ${total.answers} answers in ${board.cycle} cycles, ${asleep} % of them asleep\n` +
      `greatest deviation from trigger_ticks: ${total.deviation} cycles of 8 ns, beside the ${overhead} that every pulse is late`,
  );
} catch (error) {
  console.error(`failed: ${error.message}`);
  process.exitCode = 1;
}
