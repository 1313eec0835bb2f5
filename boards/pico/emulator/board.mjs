// An emulated Pico: rp2040js, with its peripherals stepped in time with the processor, 8 ns a cycle.
//
// What of it differs from the chip: the DMA takes no time, neither does the entry into an interrupt; an input is seen
// at once, without the two flip-flops that synchronise it; there is one core.

import { readFileSync } from "node:fs";
import { ConsoleLogger, GPIOPinState, LogLevel, RP2040 } from "rp2040js";

const FLASH = 0x10000000;
/** Where the vectors are, behind the second boot stage. */
const VECTORS = FLASH + 0x100;
const NANOSECONDS = 8;
/** The emulator's name for it. */
const WAIT_FOR_PIN = 1;

export class Board {
  constructor(elf) {
    this.cycle = 0;
    const mcu = (this.mcu = new RP2040());
    mcu.logger = new ConsoleLogger(LogLevel.Error);
    load(mcu, readFileSync(elf));
    // Without a boot ROM, which nobody may copy: its job is done here.
    if (!isBootStage(mcu.flash.subarray(0, 256))) throw new Error("the chip would not start: no second boot stage");
    mcu.core.VTOR = VECTORS;
    mcu.core.reset();
    mcu.onBreak = () => {
      throw new Error(`the firmware panicked at cycle ${this.cycle}`);
    };
    // By itself the emulator runs these in bursts, in no relation to the processor.
    for (const pio of mcu.pio) pio.run = () => {};
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

  /** Runs for so many cycles. */
  run(cycles) {
    for (const end = this.cycle + cycles; this.cycle < end; ) this.#instruction();
  }

  /** Runs until the first state machine waits for the pin that starts a frame. */
  arm() {
    const machine = this.mcu.pio[0].machines[0];
    for (const end = this.cycle + 1e7; !(machine.waiting && machine.waitType === WAIT_FOR_PIN); this.#instruction())
      if (this.cycle > end) throw new Error("no frame is armed");
  }

  #instruction() {
    const { core } = this.mcu;
    const begun = core.cycles;
    if (core.waiting) core.cycles += 1;
    else core.executeInstruction();
    for (let spent = core.cycles - begun; spent > 0; spent--) this.#tick();
  }

  #tick() {
    const { mcu } = this;
    mcu.clock.tick(NANOSECONDS);
    for (const pio of mcu.pio) {
      if (pio.stopped) continue;
      for (const machine of pio.machines) if (machine.enabled) step(pio, machine);
      pio.checkChangedPins();
    }
    this.cycle += 1;
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
