"""python3 model.py FIRMWARE [falling|rising EDGES]: runs it on an emulated processor (unicorn), with a model of its
registers; by another sync than that of leaf.rs, if asked for, and writes the lamp's edges of each frame to EDGES.

No emulator that we know of has this chip's capture, compare and DMA. The model is ours, by the chip's reference manual
(RM0383), and refuses what it does not know. It judges each edge of the lamp's line, to the tick, by leaf.rs. Exits with
1 if one is wrong.
"""

import json
import re
import sys
from pathlib import Path

from unicorn import UC_ARCH_ARM, UC_MODE_MCLASS, UC_MODE_THUMB, Uc
from unicorn.arm_const import UC_ARM_REG_SP, UC_CPU_ARM_CORTEX_M4

WRAP = 1 << 32
TIM2, GPIOA, RCC, FLASH, DMA1 = 0x4000_0000, 0x4002_0000, 0x4002_3800, 0x4002_3C00, 0x4002_6000
CR1, DIER, SR, EGR, CCMR1, CCMR2, CCER, CNT, PSC, ARR, CCR1, CCR3 = (
    TIM2 + offset for offset in (0x00, 0x0C, 0x10, 0x14, 0x18, 0x1C, 0x20, 0x24, 0x28, 0x2C, 0x34, 0x3C))
LISR, LIFCR, S1CR, S1NDTR, S1PAR, S1M0AR = (DMA1 + offset for offset in (0x00, 0x08, 0x28, 0x2C, 0x30, 0x34))
CC1, CC3, CC1OF = 1 << 1, 1 << 3, 1 << 9
"""What an access to a register takes, and a transfer by DMA: more than on the chip."""
ACCESS, TRANSFER = 7, 40


class Chip:
    def __init__(self, elf):
        self.uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        self.uc.ctl_set_cpu_model(UC_CPU_ARM_CORTEX_M4)
        for base, size in ((0x0800_0000, 512 << 10), (0x2000_0000, 128 << 10), (0xE000_0000, 1 << 20)):
            self.uc.mem_map(base, size)
        self.uc.mmio_map(0x4000_0000, 0x8_0000, self.read, None, self.write, None)
        self.uc.mmio_map(0x4200_0000, 0x8_0000 * 32, self.read_bit, None, self.write_bit, None)
        file = Path(elf).read_bytes()
        word = lambda at, size=4: int.from_bytes(file[at : at + size], "little")
        for i in range(word(44, 2)):
            header = word(28) + i * word(42, 2)
            kind, start, _, address, length = (word(header + 4 * j) for j in range(5))
            if kind == 1 and length:
                self.uc.mem_write(address, file[start : start + length])
        self.reg, self.time, self.level = {}, 0, 0
        """What happens when: the sync's edges, and transfers by DMA."""
        self.syncs, self.transfer, self.edges, self.looks = [], None, [], 0

    def get(self, address):
        return self.reg.get(address, 0)

    def clock(self):
        """The timer's, from the crystal of 25 MHz."""
        pll, cfgr = self.get(RCC + 4), self.get(RCC + 8)
        assert pll >> 22 & 1 and cfgr & 3 == 2, "the clock is the PLL's, of the crystal"
        rate = 25_000_000 // (pll & 63) * (pll >> 6 & 511) // (2 * (pll >> 16 & 3) + 2)
        divided = cfgr >> 10 & 4
        return rate if not divided else 2 * rate // (2 << (cfgr >> 10 & 3))

    def match(self):
        """When the count is what CCR3 holds, next."""
        return self.time + 1 + (self.get(CCR3) - self.time - 1) % WRAP

    def next(self):
        """What happens next, and when."""
        events = [(self.match(), self.compare)]
        if self.syncs:
            events.append((self.syncs[0], self.capture))
        if self.transfer is not None:
            events.append((self.transfer, self.load))
        return min(events, key=lambda event: event[0])

    def advance(self, to):
        """Lets time pass, and all happen that is due."""
        while self.get(CR1) & 1 and self.next()[0] <= to:
            self.time, happen = self.next()
            happen()
        self.time = max(self.time, to)

    def capture(self):
        count = self.syncs.pop(0) % WRAP
        is_edge = self.get(CCMR1) & 3 == 1 and self.get(CCER) & 0xB == (3 if FALLS else 1)
        assert is_edge, "channel 1 captures the other edges"
        self.reg[SR] = self.get(SR) | CC1 | (CC1OF if self.get(SR) & CC1 else 0)
        self.reg[CCR1] = count

    def compare(self):
        self.reg[SR] = self.get(SR) | CC3
        if self.get(CCMR2) >> 4 & 7 == 3:
            self.drive(not self.level)
        if self.get(DIER) & 1 << 11:
            assert self.transfer is None, "an edge is due while the DMA still works for the one before"
            self.transfer = self.time + TRANSFER

    def load(self):
        self.transfer = None
        assert self.get(S1CR) & 1, "the DMA is asked while it is off"
        # Channel 3, priority very high, words, from memory that is walked through, to a register.
        assert self.get(S1CR) & ~1 == 3 << 25 | 3 << 16 | 2 << 13 | 2 << 11 | 1 << 10 | 1 << 6, hex(self.get(S1CR))
        assert self.get(S1PAR) == CCR3
        self.reg[CCR3] = int.from_bytes(self.uc.mem_read(self.get(S1M0AR), 4), "little")
        self.reg[S1M0AR] += 4
        self.reg[S1NDTR] -= 1
        if self.reg[S1NDTR] == 0:
            self.reg[S1CR] &= ~1
            self.reg[LISR] = self.get(LISR) | 1 << 11

    def drive(self, level):
        if level != self.level:
            moder, afrl = self.get(GPIOA), self.get(GPIOA + 0x20)
            assert moder & 0x33 == 0x22 and afrl & 0xF0F == 0x101, "PA0 and PA2 are the timer's"
            assert self.get(GPIOA + 0x0C) & 3 == (1 if FALLS else 2), "PA0 is pulled to the sync's level at rest"
            assert self.get(CCER) >> 8 & 3 == 1, "channel 3 drives its pin"
            self.edges.append(self.time)
        self.level = level

    def check(self, address):
        """Is it a register of the model, and has it a clock?"""
        for base, enable, bit in ((TIM2, 0x40, 0), (GPIOA, 0x30, 0), (DMA1, 0x30, 21)):
            if base <= address < base + 0x400:
                assert self.get(RCC + enable) >> bit & 1, f"{address:#x} has no clock"
                return
        is_known = RCC <= address < FLASH + 0x400 or 0x4000_7000 <= address < 0x4000_7400
        assert is_known, f"the model knows no {address:#x}"

    def read(self, uc, offset, size, _):
        address = 0x4000_0000 + offset
        self.check(address)
        self.advance(self.time + ACCESS)
        # Who looks again and again at a flag that is not set waits for something to happen.
        if address == SR and not self.get(SR) & CC1 or address == LISR:
            self.looks += 1
            if self.looks > 4:
                self.advance(self.next()[0])
                if not self.syncs and self.get(DIER) == 0 and not self.get(SR) & CC1:
                    uc.emu_stop()
        if address == RCC:
            on = self.get(RCC)
            return on | (on & 0x0501_0001) << 1
        if address == RCC + 8:
            return self.get(address) & ~12 | (self.get(address) & 3) << 2
        if address == CNT:
            return self.time % WRAP
        if address == CCR1:
            self.reg[SR], self.looks = self.get(SR) & ~CC1, 0
        if address == 0x4000_7004:
            return 1 << 14
        return self.get(address)

    def read_bit(self, uc, offset, size, _):
        return self.read(uc, offset >> 7 << 2, 4, None) >> (offset >> 2 & 31) & 1

    def write_bit(self, uc, offset, size, value, _):
        register, bit = offset >> 7 << 2, offset >> 2 & 31
        self.write(uc, register, 4, self.get(0x4000_0000 + register) & ~(1 << bit) | (value & 1) << bit, None)

    def write(self, uc, offset, size, value, _):
        address = 0x4000_0000 + offset
        self.check(address)
        self.advance(self.time + ACCESS)
        if address == SR:
            value &= self.get(SR)
        if address == LIFCR:
            address, value = LISR, self.get(LISR) & ~value
        if address == CR1 and value & 1:
            assert self.clock() == TIMER_HZ and self.get(PSC) == 0 and self.get(ARR) == WRAP - 1, f"{self.clock()} Hz"
        if address == S1CR and value & 1:
            assert self.get(LISR) & 0xFC0 == 0, "a flag of the last transfer is still set"
        self.reg[address] = value
        if address == CCMR2:
            assert value & 0x8F == 0, "the compare register takes what is written at once"
            if value >> 4 & 7 == 4:
                self.drive(0)

    def run(self):
        word = lambda at: int.from_bytes(self.uc.mem_read(at, 4), "little")
        self.uc.reg_write(UC_ARM_REG_SP, word(0x0800_0000))
        self.uc.emu_start(word(0x0800_0004), 0)


source = Path(__file__).parent / "src"
leaf = (source / "leaf.rs").read_text()
number = lambda name, text: int(re.search(rf"{name}: u32 = (\w+);", text)[1].replace("_", ""))
array = lambda name: re.search(rf"{name}: \[.*?\] = \[([^\]]*)\];", leaf)
numbers = lambda found: [int(number) for number in re.findall(r"\d+", found[1])]
TIMER_HZ, delay, hold_off = (number(name, leaf) for name in ("TIMER_HZ", "DELAY_TICKS", "HOLD_OFF_TICKS"))
pulse = number("PULSE", (source / "main.rs").read_text())
elf, *asked = sys.argv[1:]
FALLS = asked[0] == "falling" if asked else "SYNC_FALLS: bool = true;" in leaf
pulses = array("PULSES")
changes = numbers(pulses) if pulses else [tick + end for tick in numbers(array("TICKS")) for end in (0, pulse)]
chip = Chip(elf)
second = TIMER_HZ
# Frames: one; one whose edge comes before the counter wraps and its flashes after; one after an edge that bounced, and
# during and after which others come before lamp and sync are ready; and one that comes then.
frames = [second, WRAP - delay // 2, WRAP + 3 * second, WRAP + 3 * second + hold_off + 500]
chip.syncs = [*frames[:2], WRAP + 2 * second, WRAP + 2 * second + 3, frames[2], frames[2] + delay + changes[3],
              frames[2] + hold_off - 500, frames[3]]
chip.run()
expected = [frame + delay + change for frame in frames for change in changes]
if chip.edges != expected:
    n, m = len(chip.edges), len(expected)
    wrong = next((i for i, (a, b) in enumerate(zip(chip.edges, expected)) if a != b), min(n, m))
    found, right = chip.edges[wrong:wrong + 1], expected[wrong:wrong + 1]
    sys.exit(f"{n} edges of {m}; number {wrong} at {found}, not {right}")
if asked:
    n = len(changes)
    of_frames = [[edge - frame for edge in chip.edges[i * n : (i + 1) * n]] for i, frame in enumerate(frames)]
    Path(asked[1]).write_text(json.dumps(of_frames))
way = "falling" if FALLS else "rising"
fired = f"{len(frames)} frames of {len(changes) // 2} flashes"
print(f"boards/stm32f4: {fired}, each edge on its tick after a {way} sync, one across the counter's wrap")
