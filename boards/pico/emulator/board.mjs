// An emulated Pico: rp2040js, with its peripherals stepped in time with the processor, 8 ns a cycle.
//
// What of it differs from the chip: the DMA takes no time, neither does the entry into an interrupt; an input is seen at
// once, without the two flip-flops that synchronise it; there is one core. Added to it are the boot ROM's functions for the flash
// (rom.mjs), and the UART's mark on a byte before which others were lost.

import { readFileSync } from "node:fs";
import { ConsoleLogger, GPIOPinState, LogLevel, RP2040 } from "rp2040js";
import { Rom } from "./rom.mjs";

const FLASH = 0x10000000;
/** Where the vectors are, behind the second boot stage. */
const VECTORS = FLASH + 0x100;
/** The first of the watchdog's scratch registers. */
const SCRATCH = 0x4005800c;
/** The last two sectors of the Pico's flash, where settings are saved. */
const SAVED = 2 * 1024 * 1024 - 8192;
const NANOSECONDS = 8;
/** The UART's mark on a byte before which others were lost. */
const OVERRUN = 1 << 11;
/** One byte of 10 bits at 115 200 baud. */
const BYTE_CYCLES = Math.round(125e6 / 11520);
/** The emulator's name for it. */
const WAIT_FOR_PIN = 1;

export class Board {
  /** With what `saved` holds of an earlier board's flash. */
  constructor(elf, saved) {
    this.cycle = 0;
    this.asleep = 0;
    this.lines = [];
    this.heard = [];
    this.toSend = [];
    this.nextByte = 0;
    this.isOverrun = false;

    const mcu = (this.mcu = new RP2040());
    mcu.logger = new ConsoleLogger(LogLevel.Error);
    load(mcu, readFileSync(elf));
    if (saved) mcu.flash.set(saved, SAVED);
    this.rom = new Rom(mcu, (cycles) => {
      for (; cycles > 0; cycles--) this.#tick();
    });
    // Without a boot ROM, which nobody may copy: its job is done here.
    if (!isBootStage(mcu.flash.subarray(0, 256))) throw new Error("the chip would not start: no second boot stage");
    mcu.core.VTOR = VECTORS;
    mcu.core.reset();
    mcu.onBreak = () => {
      throw new Error(`the firmware panicked at cycle ${this.cycle}`);
    };
    mcu.uart[0].onByte = (byte) => this.#hear(byte);
    // By itself the emulator runs these in bursts, in no relation to the processor.
    for (const pio of mcu.pio) pio.run = () => {};
  }

  /** Writes a name of up to 8 bytes where a firmware with the feature `faults` looks for one. */
  plant(fault) {
    const name = Buffer.alloc(8);
    name.write(fault);
    for (const i of [0, 4]) this.mcu.writeUint32(SCRATCH + i, name.readUInt32LE(i));
  }

  /** Calls `listener(isHigh, cycle)` at each edge of a pin that the firmware drives. */
  watch(pin, listener) {
    this.mcu.gpio[pin].addListener((state, before) => {
      const isHigh = state === GPIOPinState.High;
      if (isHigh !== (before === GPIOPinState.High)) listener(isHigh, this.cycle);
    });
  }

  /** Drives a pin. */
  drive(pin, isHigh) {
    this.mcu.gpio[pin].setInputValue(isHigh);
  }

  /** What the flash holds of settings. */
  saved() {
    return this.mcu.flash.slice(SAVED, SAVED + 8192);
  }

  /** Sends bytes to the serial line, at its pace. */
  send(bytes) {
    this.toSend.push(...bytes);
  }

  /** Runs for so many cycles. */
  run(cycles) {
    for (const end = this.cycle + cycles; this.cycle < end; ) this.#instruction();
  }

  /** Runs until the condition holds, at most so many cycles: did it? */
  runUntil(condition, cycles) {
    for (const end = this.cycle + cycles; this.cycle < end; ) {
      if (condition()) return true;
      this.#instruction();
    }
    return condition();
  }

  /** Does the first state machine wait for the pin that starts a frame? */
  isWaitingForPin() {
    const { waiting, waitType } = this.mcu.pio[0].machines[0];
    return waiting && waitType === WAIT_FOR_PIN;
  }

  #instruction() {
    const { core } = this.mcu;
    if (core.waiting) {
      this.asleep += 1;
      this.#tick();
      return;
    }
    if (core.PC < 0x4000) {
      this.rom.call(core);
      return;
    }
    this.rom.check(core);
    const begun = core.cycles;
    core.executeInstruction();
    for (let spent = core.cycles - begun; spent > 0; spent--) this.#tick();
  }

  #tick() {
    const { mcu } = this;
    if (this.toSend.length > 0 && this.cycle >= this.nextByte) {
      this.#receive(this.toSend.shift());
      this.nextByte = this.cycle + BYTE_CYCLES;
    }
    mcu.clock.tick(NANOSECONDS);
    for (const pio of mcu.pio) {
      if (pio.stopped) continue;
      for (const machine of pio.machines) if (machine.enabled) step(pio, machine);
      pio.checkChangedPins();
    }
    this.cycle += 1;
  }

  /** The emulator's UART drops what it has no room for, and does not say so; the chip's marks the next byte. */
  #receive(byte) {
    const [uart] = this.mcu.uart;
    if (uart.rxFIFO.full) this.isOverrun = true;
    else {
      uart.feedByte(byte | (this.isOverrun ? OVERRUN : 0));
      this.isOverrun = false;
    }
  }

  #hear(byte) {
    if (byte !== 0x0a) this.heard.push(byte);
    else this.lines.push(Buffer.from(this.heard.splice(0)).toString().trimEnd());
  }
}

/** One cycle of a state machine. The emulator knows neither clock dividers nor delays, so there must be none. */
function step(pio, machine) {
  const delays = 0x1f >> machine.sidesetCount;
  if (machine.clockDivInt !== 1 || machine.clockDivFrac !== 0 || (pio.instructions[machine.pc] >> 8) & delays)
    throw new Error("the emulator's state machines take one cycle an instruction");
  machine.step();
}

/** The boot ROM's condition: the last of the 256 bytes are the CRC-32 of the others, in the MPEG-2 variant. */
function isBootStage(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes.subarray(0, 252)) {
    crc ^= byte << 24;
    for (let bit = 0; bit < 8; bit++) crc = (crc << 1) ^ (crc < 0 ? 0x04c11db7 : 0);
  }
  return Buffer.from(bytes).readUInt32LE(252) === crc >>> 0;
}

/** Copies what a 32-bit ELF file wants in flash. */
function load(mcu, file) {
  const view = new DataView(file.buffer, file.byteOffset, file.length);
  if (view.getUint32(0) !== 0x7f454c46) throw new Error("not an ELF file");
  const [headers, size, count] = [view.getUint32(28, true), view.getUint16(42, true), view.getUint16(44, true)];
  for (let i = 0; i < count; i++) {
    const field = (offset) => view.getUint32(headers + i * size + offset, true);
    const [type, from, address, length] = [field(0), field(4), field(12), field(16)];
    const PT_LOAD = 1;
    if (type === PT_LOAD && length > 0) mcu.flash.set(file.subarray(from, from + length), address - FLASH);
  }
}
