"""The record that from-trace.sh begins with, and what is judged by its truth.

python3 from-trace.py record FOLDER             writes record.csv: five shots, the delay of each off by some
                                                20 µs, and a noisy sync, which falls on CH2 and rises on CH3
python3 from-trace.py judge WAY SCENE MODULE    judges what was made of it, by the sync that is falling or rising
"""

import random
import re
import statistics
import sys
from pathlib import Path

SHOTS, RATE, EVERY = 5, 500_000, 0.02
OPENING, PLATEAU, CLOSING = 1e-3, 4e-3, 1.5e-3
DUTY = 0.3
noise = random.Random(7)
delays = [3e-3 + 20e-6 * noise.gauss(0, 1) for _ in range(SHOTS)]
edges = [5e-3 + k * EVERY + noise.random() / RATE for k in range(SHOTS)]


def openness(t):
    return min(max(min(t / OPENING, (OPENING + PLATEAU + CLOSING - t) / CLOSING), 0), 1)


def light(t):
    """What has come by then, in seconds of a shutter that is fully open."""
    ramp = lambda t, length: min(max(t, 0), length) ** 2 / (2 * length)
    plateau = min(max(t - OPENING, 0), PLATEAU)
    left = OPENING + PLATEAU + CLOSING - max(t, OPENING + PLATEAU)
    return ramp(t, OPENING) + plateau + CLOSING / 2 - ramp(left, CLOSING)


def record(folder):
    with open(Path(folder) / "record.csv", "w") as out:
        out.write("Time (s),CH1,CH2,CH3\n")
        for i in range(int(SHOTS * EVERY * RATE)):
            shot = min(int(i / RATE / EVERY), SHOTS - 1)
            since = i / RATE - edges[shot]
            low, high = (x + 0.2 * noise.gauss(0, 1) for x in (0.1, 3.3))
            syncs = (low, high) if 0 <= since < 5e-3 else (high, low)
            seen = 0.1 + openness(since - delays[shot]) + 0.005 * noise.gauss(0, 1)
            out.write(f"{i / RATE:.6f},{seen:.4f},{syncs[0]:.3f},{syncs[1]:.3f}\n")


def judge(way, scene, module):
    scene, leaf = Path(scene).read_text(), Path(module).read_text()
    spread, put_in = float(re.search(r"^delay_spread = ([\d.]+)", scene, re.M)[1]) * 1e-3, statistics.stdev(delays)
    assert abs(spread - put_in) < 0.1 * put_in, f"a spread of {spread}, and {put_in} was put in"
    falls = "true" if way == "falling" else "false"
    assert f"SYNC_FALLS: bool = {falls};" in leaf, f"the module has the other edge, not the {way} one"
    number = lambda name: int(re.search(rf"{name}: u32 = (\w+);", leaf)[1].replace("_", ""))
    hertz, delay = number("TIMER_HZ"), number("DELAY_TICKS")
    name, ticks = re.search(r"(TICKS|PULSES): \[.*?\] = \[([^\]]*)\];", leaf).groups()
    times = [(delay + int(tick)) / hertz - statistics.mean(delays) for tick in re.findall(r"\d+", ticks)]
    whole = light(OPENING + PLATEAU + CLOSING)
    if name == "TICKS":
        shares = [whole * (i + 0.5) / len(times) for i in range(len(times))]
        off = max(abs(light(t) - share) / openness(t) for t, share in zip(times, shares))
        assert off < 2e-6, f"a trigger is off by {1e6 * off:.1f} µs"
        said = f"{len(times)} triggers, off by up to {1e6 * off:.1f} µs"
    else:
        doses = [light(end) - light(start) for start, end in zip(times[::2], times[1::2])]
        share = DUTY * whole / len(doses)
        off = max(abs(dose / share - 1) for dose in doses)
        assert off < 0.01, f"a pulse's dose is off by {100 * off:.2f} %"
        said = f"{len(doses)} pulses, their doses off by up to {100 * off:.2f} %"
    spreads = f"a spread of {1e6 * spread:.0f} µs, and {1e6 * put_in:.1f} µs were put in"
    print(f"from-trace: {said} at {hertz} Hz; {spreads}")


{"record": record, "judge": judge}[sys.argv[1]](*sys.argv[2:])
