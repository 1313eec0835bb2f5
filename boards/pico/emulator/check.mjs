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

/** Has the board wait for the edge that starts a frame. */
function arm(name, falls) {
  if (!board.runUntil(() => board.isWaitingForPin(), PATIENCE)) fail(`${name} is never armed`);
  board.drive(START, falls);
  // At another moment of whatever the processor does, each time.
  board.run(1000 + 777 * total.frames);
  if (edges.length > 0) fail(`${name}: TooMany: a pulse before the frame`);
}

/** Gives the edge, and says when. */
function start(falls) {
  board.drive(START, !falls);
  return board.cycle;
}

/** Sends a line that saves, and gives the edge, and perhaps more bytes than the UART holds, once the flash is being written. */
function startAtSave(name, falls, { send, meanwhile = [] }) {
  let edge;
  const { rom } = board;
  // In the middle of whatever is written first.
  const at = rom.written + 100;
  rom.onWrite = (written) => {
    if (written !== at) return;
    edge = start(falls);
    board.send(meanwhile);
  };
  board.send(send);
  if (!board.runUntil(() => edge !== undefined, PATIENCE)) fail(`${name}: nothing is saved`);
  return edge;
}

/** What is wrong with the pulses of a frame that started at `edge`: nothing, or the first reason. */
function judge({ ticks, lengths, gap, gapIsDark }, edge) {
  const rises = edges.filter(({ isHigh }) => isHigh).map(({ cycle }) => cycle);
  const falls = edges.filter(({ isHigh }) => !isHigh).map(({ cycle }) => cycle);
  if (rises.length < ticks.length) return `Missing: ${rises.length} of ${ticks.length} pulses`;
  if (rises.length > ticks.length) return `TooMany: ${rises.length} pulses for ${ticks.length}`;
  for (const [i, tick] of ticks.entries()) {
    const before = gapIsDark ? falls[i - 1] : rises[i - 1];
    if (i > 0 && rises[i] - before < gap) return `TooClose: pulse ${i} is ${rises[i] - before} cycles after the one before, not ${gap}`;
    const deviation = rises[i] - edge - overhead - tick;
    total.deviation = Math.max(total.deviation, Math.abs(deviation));
    if (deviation !== 0) return `${deviation < 0 ? "Early" : "Late"}: pulse ${i} by ${Math.abs(deviation)} cycles`;
    const length = falls[i] - rises[i];
    if (length !== lengths[i]) return `Length: pulse ${i} has ${length} cycles, not ${lengths[i]}`;
  }
}

/** One step of the script: perhaps a frame, lines, their answers. */
function take(step) {
  const { frame, send, answers } = step;
  if (frame) fire(step);
  else if (step.spend) spend();
  else if (step.oneByOne) {
    for (const line of Buffer.from(send).toString().trim().split("\n")) {
      board.send(Buffer.from(`${line}\n`));
      expect(answers[0]);
    }
    return;
  } else board.send(send);
  answers.forEach(expect);
}

/** The next answer is this one, but for what planning costs; of a single word, it begins so. */
function expect(expected) {
  const given = answer();
  // A refusal is shown once.
  if (!shown.has(given)) console.log(`  ${given}`);
  shown.add(given);
  const told = given.replace(/; planned in \d+ cycles(, the curve built in \d+ us)?$/, "");
  if (told !== expected && (expected.includes(" ") || !told.startsWith(`${expected} `))) fail(`the answer should be: ${expected}`);
}

/** Starts the frame that is armed, whatever it is. */
function spend() {
  arm("a frame", false);
  start(false);
  board.run(5_000_000);
  edges.length = 0;
}

/** Starts a frame, sends lines meanwhile, and judges the pulses. */
function fire(step) {
  const { frame, send, atSave } = step;
  const { ticks, lengths, falls } = frame;
  const next = steps.slice(steps.indexOf(step) + 1).find(({ frame }) => frame);
  const name = `frame ${total.frames + 1}`;
  arm(name, falls);
  const edge = atSave ? startAtSave(name, falls, step) : start(falls);
  if (!atSave) board.send(send);
  // A little longer than the frame, for a pulse too many.
  const end = edge + ticks.at(-1) + 3 * lengths.at(-1) + 1000;
  // The pin goes back soon, or comes again during the frame, or stays beyond its end: no matter. But where the next frame waits
  // for the other edge, to go back is one.
  let isHigh = !falls;
  const ways = next?.frame.falls === falls ? 3 : 2;
  for (const part of [[0.1], [0.1, 0.4, 0.6], [1]][total.frames % ways]) {
    board.run(edge + Math.round(part * (end - edge)) - board.cycle);
    board.drive(START, (isHigh = !isHigh));
  }
  board.run(end - board.cycle);
  if (step.rest) {
    board.runUntil(() => board.lines.length > 0, PATIENCE);
    board.send(step.rest);
  }
  const wrong = judge(frame, edge);
  if (wrong) fail(`${name}: ${wrong}`);
  edges.length = 0;
  total.frames += 1;
  total.pulses += frame.ticks.length;
  console.log(
    `${name}: ${ticks.length} pulses of ${lengthsOf(lengths)} cycles, the first at ${ticks[0]}, the last at ${ticks.at(-1)}` +
      `${atSave ? ", while settings are saved" : ""}, each on its cycle`,
  );
}

/** The least and the greatest. */
function lengthsOf(lengths) {
  const [least, most] = [Math.min(...lengths), Math.max(...lengths)];
  return least === most ? `${least}` : `${least} to ${most}`;
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
