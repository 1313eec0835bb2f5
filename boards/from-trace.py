"""The record that from-trace.sh begins with, and what is judged by its truth.

python3 from-trace.py record FOLDER     writes record.csv: five shots, the delay of each off by some 20 µs, and a noisy sync that falls
python3 from-trace.py judge FOLDER      judges leaf.toml and leaf.rs
"""

import random
import re
import statistics
import sys
from pathlib import Path

SHOTS, RATE, EVERY = 5, 500_000, 0.02
OPENING, PLATEAU, CLOSING = 1e-3, 4e-3, 1.5e-3


def openness(t):
    return min(max(min(t / OPENING, (OPENING + PLATEAU + CLOSING - t) / CLOSING), 0), 1)


noise = random.Random(7)
delays = [3e-3 + 20e-6 * noise.gauss(0, 1) for _ in range(SHOTS)]
edges = [5e-3 + k * EVERY + noise.random() / RATE for k in range(SHOTS)]
folder = Path(sys.argv[2])


def record():
    with open(folder / "record.csv", "w") as out:
        out.write("Time (s),CH1,CH2\n")
        for i in range(int(SHOTS * EVERY * RATE)):
            since = i / RATE - edges[min(int(i / RATE / EVERY), SHOTS - 1)]
            light = openness(since - delays[min(int(i / RATE / EVERY), SHOTS - 1)])
            sync = 0.1 if 0 <= since < 5e-3 else 3.3
            out.write(f"{i / RATE:.6f},{0.1 + light + 0.005 * noise.gauss(0, 1):.4f},{sync + 0.2 * noise.gauss(0, 1):.3f}\n")


def judge():
    scene, leaf = ((folder / name).read_text() for name in ("leaf.toml", "leaf.rs"))
    scene = {key: float(x) for key, x in re.findall(r"^(\w+) = ([\d.]+)", scene, re.M)}
    spread, put_in = scene["delay_spread"] * 1e-3, statistics.stdev(delays)
    assert abs(spread - put_in) < 0.1 * put_in, f"a spread of {spread}, and {put_in} was put in"
    number = lambda name: int(re.search(rf"{name}: u32 = (\w+);", leaf)[1].replace("_", ""))
    hertz, delay = number("TIMER_HZ"), number("DELAY_TICKS")
    ticks = [int(tick) for tick in re.search(r"TICKS: \[u32; \d+\] = \[(.*?)\];", leaf, re.S)[1].replace(",", " ").split()]
    # When so much of the light has come, summed apart.
    steps = [1e-7 * (i + 0.5) for i in range(int(1e7 * (OPENING + PLATEAU + CLOSING)))]
    whole, sum, times = 1e7 * (0.5 * OPENING + PLATEAU + 0.5 * CLOSING), 0, []
    for t in steps:
        sum += openness(t)
        if len(times) < len(ticks) and sum >= whole * (len(times) + 0.5) / len(ticks):
            times.append(t)
    off = max(abs((delay + tick) / hertz - statistics.mean(delays) - t) for tick, t in zip(ticks, times, strict=True))
    assert off < 2e-6, f"a trigger is off by {1e6 * off:.1f} µs"
    print(f"from-trace: at {hertz} Hz no trigger is off by more than {1e6 * off:.1f} µs; a spread of {1e6 * spread:.0f} µs, and {1e6 * put_in:.1f} µs were put in")


{"record": record, "judge": judge}[sys.argv[1]]()
