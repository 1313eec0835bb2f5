"""python second.py < JSON: runs the state machine of second.mjs in a second emulator, pioemu, and compares each edge.

pioemu (PyPI: rp2040-pio-emulator) shares no code with rp2040js. It has the state machine alone, so what feeds it and what its
input passes through are modelled here: a synchroniser of so many cycles, and a DMA that needs so many for a word.
"""

import json
import sys
from collections import deque
from dataclasses import replace
from functools import partial

from pioemu import State, emulate

FIFO = 8
LAMP_EDGES = 48
EDGE = 100


def level(is_high, _: State) -> int:
    return is_high


def edges(told, synchroniser, dma):
    """When the lamp's pin changes after the edge, in cycles; the first words are there when the edge comes."""
    words, program = deque(told["words"]), told["program"]
    irq = len(program) - 1
    waiting, found, due = deque(), [], 0
    state = State(transmit_fifo=waiting, pin_directions=1 << told["sidesetBase"])
    arguments = dict(side_set_base=told["sidesetBase"], side_set_count=told["sidesetCount"], wrap_top=len(program) - 1)
    last = 0
    for clock in range(100_000):
        if words and clock >= due and len(state.transmit_fifo) < FIFO:
            state = replace(state, transmit_fifo=state.transmit_fifo + deque([words.popleft()]))
            due = clock + dma
        is_high = int(clock >= EDGE + synchroniser)
        if state.program_counter == irq:
            break
        pins = partial(level, is_high)
        _, state = next(emulate(program, stop_when=lambda *_: False, initial_state=state, input_source=pins, **arguments))
        pin = state.pin_values >> told["sidesetBase"] & 1
        if pin != last:
            found.append(clock - EDGE)
            last = pin
        if len(found) == LAMP_EDGES:
            break
    return found


def main():
    told = json.load(sys.stdin)
    here = edges(told, 0, 1)
    first = told["edges"][0] - here[0]
    if [edge - first for edge in told["edges"]] != here:
        sys.exit(f"the emulators differ:\n{told['edges']}\n{here}")
    print(f"{len(here) // 2} pulses on the same cycles in both emulators; the first comes {told['edges'][0]} and {here[0]} after the edge")
    late = [b - a for a, b in zip(here, edges(told, 2, 1))]
    if set(late) != {2}:
        sys.exit(f"behind a synchroniser of 2 cycles the pulses come {late} cycles later")
    print("behind a synchroniser of 2 cycles each comes exactly 2 cycles later")
    most = next(dma for dma in range(1, 100) if edges(told, 0, dma + 1) != here)
    print(f"the densest pulses are on time if the DMA takes up to {most} cycles a word")
    if most < 4:
        sys.exit("it has to serve two words for a pulse every 8 cycles")


main()
