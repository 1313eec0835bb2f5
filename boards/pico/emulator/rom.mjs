// The part of the boot ROM that writes the flash, which the emulator lacks: its functions by their names, as calls to here.
//
// A page takes 0.4 ms and a sector 45 ms, the flash chip's typical times (W25Q16JV, tPP and tSE); meanwhile the board goes on.

const PAGE_CYCLES_A_BYTE = Math.round((0.4e-3 * 125e6) / 256);
const ERASE_CYCLES_A_BYTE = Math.round((45e-3 * 125e6) / 4096);
/** Where the ROM's pointers are: to its table, and to the function that looks a name up there. */
const TABLES = 0x14, LOOKUP = 0x18;
const TABLE = 0x100, FIRST = 0x200;
const SSI = 0x18000;

/** The power is gone; what was written stays. */
export class PowerCut extends Error {}

export class Rom {
  /**
   * `wait(cycles)` lets the rest of the board go on. `left` bytes are written until the power is cut; `isHasty` has each of them
   * take a cycle, where time does not matter.
   */
  constructor(mcu, wait) {
    Object.assign(this, { mcu, wait, isXip: true, written: 0, left: Infinity, isHasty: false, onWrite: () => {} });
    mcu.bootrom[TABLES / 4] = TABLE;
    mcu.bootrom[LOOKUP / 4] = FIRST | 1;
    this.functions = [
      ["", (table, name) => this.#address(String.fromCharCode(name & 0xff, name >> 8))],
      ["IF", () => {}],
      ["EX", () => this.#exit()],
      ["RE", (at, count) => this.#erase(at, count)],
      ["RP", (at, from, count) => this.#program(at, from, count)],
      ["FC", () => {}],
    ];
  }

  /** Is the processor in the ROM? Then the function that it calls is done. */
  call(core) {
    const [, run] = this.functions[(core.PC - FIRST) / 4] ?? [];
    if (!run) throw new Error(`there is no function of the boot ROM at ${core.PC.toString(16)}`);
    const answer = run(...core.registers.slice(0, 4));
    if (answer !== undefined) core.registers[0] = answer;
    core.PC = core.LR & ~1;
  }

  /** Throws if code comes from flash while flash cannot be read. */
  check(core) {
    if (this.isXip) return;
    // The second boot stage sets the interface up again, and enables it.
    if (this.mcu.peripherals[SSI].ssienr) this.isXip = true;
    else if (core.PC >>> 28 === 1) throw new Error(`code at ${core.PC.toString(16)} is read from flash while flash is written`);
  }

  #address(name) {
    const i = this.functions.findIndex(([known]) => known === name);
    if (i < 0) throw new Error(`the firmware asks for ${name} of the boot ROM`);
    return (FIRST + 4 * i) | 1;
  }

  #exit() {
    this.isXip = false;
    this.mcu.peripherals[SSI].ssienr = 0;
  }

  #program(at, from, count) {
    if (this.isXip) throw new Error("flash is written while code runs there");
    if (at % 256 || count % 256) throw new Error("a page is 256 bytes");
    for (let i = 0; i < count; i++) this.#change(at + i, this.mcu.flash[at + i] & this.mcu.readUint8(from + i), PAGE_CYCLES_A_BYTE);
  }

  #erase(at, count) {
    if (this.isXip) throw new Error("flash is erased while code runs there");
    if (at % 4096 || count % 4096) throw new Error("a sector is 4096 bytes");
    // A sector fades as a whole, not from its start.
    for (let i = 0; i < count; i++) this.#change(at + ((i * 1021) % count), 0xff, ERASE_CYCLES_A_BYTE);
  }

  /** One byte; of the last before the power is cut, only some bits. */
  #change(at, to, cycles) {
    const { flash } = this.mcu;
    if (this.left === 0) {
      flash[at] = (flash[at] & 0xf0) | (to & 0x0f);
      throw new PowerCut("the power is cut");
    }
    this.left -= 1;
    flash[at] = to;
    this.written += 1;
    this.onWrite(this.written);
    this.wait(this.isHasty ? 1 : cycles);
  }
}
