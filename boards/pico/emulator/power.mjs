// node power.mjs FIRMWARE: cuts the power while settings are saved, and looks at what the board starts with then.
//
// With TRIGGER_FAULT in the environment the firmware, which needs its feature `faults` then, is told to make that fault.
// Exits with 1 if a board starts with other settings than those before the save or those of it, or saves no more.

import { Board } from "./board.mjs";
import { PowerCut } from "./rom.mjs";

const PATIENCE = 12_500_000;
/** Saves that fill a sector; the next one erases the other. */
const SAVES_OF_SECTOR = 16;
const PAGE = 256, SECTOR = 4096;

const [elf] = process.argv.slice(2);
let boards = 0, cuts = 0;

function on(saved) {
  const board = new Board(elf, saved);
  if (process.env.TRIGGER_FAULT) board.plant(process.env.TRIGGER_FAULT);
  board.rom.isHasty = true;
  boards += 1;
  return board;
}

function answer(board) {
  if (!board.runUntil(() => board.lines.length > 0, PATIENCE)) throw new Error("no answer");
  return board.lines.shift();
}

/** What the board answers to a line. */
function told(board, line) {
  board.send(Buffer.from(`${line}\n`));
  return answer(board);
}

/** The settings that a board starts with, and the board. */
function started(saved) {
  const board = on(saved);
  const line = answer(board);
  const settings = /^ready(?:, as saved)?: (.*)$/.exec(line)?.[1];
  if (!settings) throw new Error(`the board starts with: ${line}`);
  return { board, settings };
}

/** Saves `n` pulses on a board that starts with `before`, the power cut after so many bytes, and gives what is left of it. */
function cut(before, n, left) {
  const { board } = started(before);
  if (!told(board, `n ${n}`).startsWith("ok ")) throw new Error(`n ${n} is refused`);
  board.rom.left = left;
  try {
    if (!told(board, "save").startsWith("saved ")) throw new Error("the save is refused");
    return board.saved();
  } catch (error) {
    if (!(error instanceof PowerCut)) throw error;
    cuts += 1;
    return board.saved();
  }
}

/** Cuts the power after each of so many bytes of a save of `n`, and judges what is left. */
function judge(before, n, places) {
  const { settings: old } = started(before);
  const fresh = old.replace(/^n \d+/, `n ${n}`);
  for (const left of places) {
    const after = cut(before, n, left);
    const { board, settings } = started(after);
    if (settings !== old && settings !== fresh) throw new Error(`Torn: after ${left} bytes the board starts with ${settings}`);
    // With the power back, it saves as ever. Some of the boards are asked.
    if (left % 3 === 0) {
      told(board, "n 3");
      if (!told(board, "save").startsWith("saved n 3,")) throw new Error(`after ${left} bytes nothing is saved any more`);
      if (!started(board.saved()).settings.startsWith("n 3,")) throw new Error(`after ${left} bytes a save does not last`);
    }
  }
}

const steps = (from, to, by) => Array.from({ length: Math.ceil((to - from) / by) }, (_, i) => from + i * by);
/** Each word of the record, and what comes behind it. */
const PAGE_PLACES = [...steps(0, 108, 5), 99, 100, 101, 255, PAGE];

try {
  // A blank flash, whose first save erases; then, as the sector fills, one page; then the change to the other sector.
  const blank = on().saved();
  judge(blank, 7, [0, 1, 2000, SECTOR - 1, ...PAGE_PLACES.map((place) => SECTOR + place)]);
  let saved = cut(blank, 7, Infinity);
  judge(saved, 9, PAGE_PLACES);
  const { board } = started(saved);
  for (let i = 1; i < SAVES_OF_SECTOR; i++) {
    told(board, `n ${1 + (i % 7)}`);
    told(board, "save");
  }
  saved = board.saved();
  judge(saved, 12, [0, 1, 1000, SECTOR - 1, ...PAGE_PLACES.map((place) => SECTOR + place)]);
  console.log(`${cuts} saves cut off, ${boards} boards started: each with the settings before or those of the save`);
} catch (error) {
  console.error(`failed: ${error.message}`);
  process.exitCode = 1;
}
