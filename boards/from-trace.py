#!/usr/bin/env python3
"""From records with a known truth to the edges of a lamp's line, as a user goes the way: `shutter fit`, `shutter plan`,
and copies of boards/stm32f4 and boards/pico, linked and run where their emulators run.

    .ci/thumb.sh boards/from-trace.py            all records, on both boards; node and Python are needed
    .ci/thumb.sh boards/from-trace.py early      some of them

Exits with 0 only if each flash that fires is where the truth has it, and what would fire wrongly is refused with a way
on. The truth is here alone: nothing is taken from the program but its words, and from the firmware but its edges.
"""

import json
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
BOARDS = {"stm32f4": 100_000_000, "pico": 125_000_000}
TARGET = Path(os.environ.setdefault("CARGO_TARGET_DIR", str(HERE.parent / "target")))
FLASH = 2e-6
noise = random.Random(7)


def fail(text):
    sys.exit(f"from-trace: {text}")


class Shutter:
    """Straight ramps, in seconds from the start of opening, and from each edge of the sync to that."""

    def __init__(self, opening, plateau, closing, delays):
        self.opening, self.plateau, self.closing, self.delays = opening, plateau, closing, delays
        self.close = opening + plateau
        self.end, self.exposure = self.close + closing, plateau + (opening + closing) / 2
        self.delay = statistics.mean(delays)

    def openness(self, t):
        opened = t / self.opening if self.opening else float(t >= 0)
        return max(min(opened, (self.end - t) / self.closing, 1), 0)

    def light(self, t):
        """What has come by then, in seconds of a shutter that is fully open."""
        t = min(max(t, 0), self.end)
        left = self.end - max(t, self.close)
        return (min(t, self.opening) ** 2 / (2 * self.opening) + min(max(t - self.opening, 0), self.plateau)
                + (self.closing - left**2 / self.closing) / 2)

    def off(self, times, way):
        """By how many seconds the worst of these flashes is off; with a duty, by which part of its share or dose."""
        n = len(times)
        if way == "in_path --duty 0.3":
            share = self.exposure / n
            parts = [(self.light(on) / share - i, self.light(off) / share - i) for i, (on, off) in enumerate(times)]
            return max(max(abs(on - 0.35), abs((off - on) / 0.3 - 1)) for on, off in parts)
        if any(abs(off - on - FLASH) > 1e-12 for on, off in times):
            fail(f"a flash is no {FLASH} s long")
        if way == "in_path --fully-open":
            return max(abs(on - self.opening - self.plateau * (i + 0.5) / n) for i, (on, _) in enumerate(times))
        shares = [self.exposure * (i + 0.5) / n for i in range(n)]
        return max(abs(self.light(on) - share) / max(self.openness(on), 1e-9) for (on, _), share in zip(times, shares))


def record(name, sensors, every=0.02, rate=500_000):
    """A file of all shots: the time, a column for each sensor, and a noisy sync, which falls and which rises."""
    shots = len(sensors[0].delays)
    edges = [5e-3 + k * every + noise.random() / rate for k in range(shots)]
    names = ["CH1"] if len(sensors) == 1 else [f"S{k + 1}" for k in range(len(sensors))]
    with open(name, "w") as out:
        print("Time (s)", *names, "FALLS", "RISES", sep=",", file=out)
        for i in range(round(shots * every * rate)):
            shot = min(int(i / rate / every), shots - 1)
            since = i / rate - edges[shot]
            low, high = (x + 0.2 * noise.gauss(0, 1) for x in (0.1, 3.3))
            syncs = (low, high) if 0 <= since < 5e-3 else (high, low)
            seen = (0.1 + it.openness(since - it.delays[shot]) + 0.005 * noise.gauss(0, 1) for it in sensors)
            print(f"{i / rate:.6f}", *(f"{x:.4f}" for x in (*seen, *syncs)), sep=",", file=out)


def jitter(mean, by, shots=5):
    return [mean + by * noise.gauss(0, 1) for _ in range(shots)]


def said(command):
    """What a command says, that has to succeed; or None."""
    run = subprocess.run(command, shell=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return run.returncode == 0, run.stdout


def runs(command):
    is_well, text = said(command)
    return text if is_well else fail(f"{command}\n{text}")


def refused(words, command):
    """The command fails, and says that."""
    is_well, text = said(command)
    if is_well or words not in " ".join(text.split()):
        fail(f"{command}: not refused with '{words}', but: {text}")
    print(f"from-trace: refused: {words}")


def plan(scene, board, options):
    return f"shutter plan {scene} --timer-hz {BOARDS[board]}Hz {options} --emit rust --to {board}/src/leaf.rs --force"


def fires(truth, scene, way, options, falls=True, delay=None, within=3e-6):
    """Each flash of each frame of both boards, by the edges of the lamp's line."""
    for board, hertz in BOARDS.items():
        runs(plan(scene, board, f"--set-up {way} {options}"))
        runs(f"{board}/run.sh {'falling' if falls else 'rising'} $PWD/edges.json")
        frames = json.loads(Path("edges.json").read_text())
        count, worst = int(re.search(r"--triggers (\d+)", options)[1]), 0
        for edges in frames:
            times = [edge / hertz - (truth.delay if delay is None else delay) for edge in edges]
            pairs = list(zip(times[::2], times[1::2]))
            if len(pairs) != count:
                fail(f"{scene}: {len(pairs)} flashes of {count} on {board}")
            worst = max(worst, truth.off(pairs, way))
        if worst > (0.01 if "duty" in way else within):
            fail(f"{scene} on {board}: a flash is off by {worst}, {way}")
        by = f"{100 * worst:.2f} % of a share or dose" if "duty" in way else f"{1e6 * worst:.1f} µs"
        print(f"from-trace: {scene}, {way}, on {board}: {len(frames)} frames of {count} flashes, off by up to {by}")


def early():
    """The contact closes 3 ms before the shutter opens; its delay jitters."""
    truth = Shutter(1e-3, 4e-3, 1.5e-3, jitter(3e-3, 20e-6))
    record("early.csv", [truth])
    for sync in ("falls", "rises"):
        runs(f"shutter fit early.csv --columns 1,CH1 --sync {sync.upper()} --out {sync}.toml")
        spread = float(re.search(r"^delay_spread = ([\d.]+)", Path(f"{sync}.toml").read_text(), re.M)[1]) * 1e-3
        put_in = statistics.stdev(truth.delays)
        if abs(spread - put_in) > 0.1 * put_in:
            fail(f"a spread of {spread}, and {put_in} was put in")
    options = "--triggers 8 --min-gap 100us"
    refused("timer_hz = ...", f"shutter plan falls.toml --set-up emulated {options} --emit rust")
    refused("--set-up", plan("falls.toml", "pico", options))
    fires(truth, "rises.toml", "in_path --duty 0.3", options, falls=False)
    fires(truth, "falls.toml", "emulated", options)
    for board, other in zip(BOARDS, reversed(BOARDS)):
        runs(plan("falls.toml", other, f"--set-up emulated {options}"))
        shutil.copy(f"{other}/src/leaf.rs", f"{board}/src/leaf.rs")
        refused(f"plan it with timer_hz = {BOARDS[board]:_}", f"{board}/run.sh")
        runs(plan("falls.toml", board, "--set-up emulated --min-gap 0 --triggers 4000"))
        refused("a flash comes too soon", f"{board}/run.sh")
        # Firmware that takes the rising edge of every sync.
        runs(plan("falls.toml", board, f"--set-up emulated {options}"))
        main = Path(board, "src/main.rs")
        right = main.read_text()
        wrong = right.replace("bit(leaf::SYNC_FALLS)", "bit(false)").replace("if leaf::SYNC_FALLS {\n", "if false {\n")
        main.write_text(wrong)
        told = {"pico": "frame 0: the line changes at", "stm32f4": "captures the other edges"}
        refused(told[board], f"{board}/run.sh")
        main.write_text(right)


def x():
    """An X contact closes 0.1 ms after the shutter is open."""
    truth = Shutter(1e-3, 4e-3, 1.5e-3, jitter(-1.1e-3, 5e-6))
    record("x.csv", [truth])
    runs("shutter fit x.csv --columns 1,CH1 --sync FALLS --out x.toml")
    refused("fully_open", plan("x.toml", "pico", "--set-up in_path --triggers 8 --min-gap 0"))
    refused("flashes' own `delay` = 0", plan("x.toml", "pico", "--set-up emulated --triggers 8 --min-gap 0"))
    fires(truth, "x.toml", "in_path --fully-open", "--triggers 4 --min-gap 100us")
    # The way on that is named: an emulated curve that begins with the edge.
    fires(truth, "x.toml", "emulated --delay 0ms --sync-falls true", "--triggers 4 --min-gap 0", delay=0)


def sensors():
    """Three sensors behind curtains, at five speeds, some of them off."""
    speeds = {500: -0.2, 250: 0.1, 125: 0, 60: -0.05, 30: 0.3}
    truths, opens, sample = {}, [0, 1e-3, 2.1e-3], 10e-6
    for speed, ev in speeds.items():
        # The second curtain is a little faster than the first.
        plateaus = [2**ev / speed - 0.02 * at - 0.3e-3 for at in opens]
        truths[speed] = [Shutter(0.3e-3, it, 0.3e-3, [2e-3 + at]) for it, at in zip(plateaus, opens)]
        record(f"{speed}.csv", truths[speed], every=0.06, rate=1 / sample)
    files, nominal = " ".join(f"{speed}.csv" for speed in speeds), ",".join(f"1/{speed}" for speed in speeds)
    table = json.loads(runs(f"shutter fit {files} --columns 1,S1,S2,S3 --nominal {nominal} --report json 2>/dev/null"))
    rows = [(speed, k) for speed in speeds for k in range(3)]
    for found, (speed, k) in zip(table, rows, strict=True):
        first = table[rows.index((speed, 0))]
        later = [a - b for a, b in zip(found["half_light_s"], first["half_light_s"])]
        right = [truths[speed][k].exposure, 1 / speed, opens[k], 0.98 * opens[k]]
        is_ = [found["exposure_s"], found["nominal_s"], *later]
        if max(abs(a - b) for a, b in zip(is_, right)) > sample:
            fail(f"1/{speed}, sensor {k + 1}: {is_}, and {right} were put in")
    print(f"from-trace: {len(table)} exposures and their curtains' travel within a sample of {1e6 * sample:.0f} µs")
    refused("name one of them", f"shutter fit {files} --columns 1,S1,S2,S3 --nominal {nominal} --out speeds")
    runs(f"shutter fit {files} --columns 1,S2 --sync FALLS --nominal {nominal} --out speeds")
    for speed in speeds:
        fires(truths[speed][1], f"speeds/{speed}.toml", "emulated", "--triggers 6 --min-gap 0", within=sample)


def hand():
    """A hand's edits: what is below [flashes] stays and counts, what a fit wrote is not lost without a word."""
    first, second = Shutter(1e-3, 4e-3, 1.5e-3, jitter(3e-3, 5e-6)), Shutter(1.5e-3, 7e-3, 2e-3, jitter(1e-3, 5e-6))
    record("first.csv", [first])
    record("second.csv", [second])
    fit = "shutter fit {}.csv --columns 1,CH1 --sync FALLS --out hand.toml"
    scene = Path("hand.toml")
    runs(fit.format("first"))
    own = "# Warning: hot\ntriggers = 5 # mine\nmin_gap = 0.1\nset_up = 'emulated'\n"
    scene.write_text(re.sub(r"\ntriggers = .*\n", f"\n{own}", scene.read_text()))
    # A second fit takes nothing of the first one's, and leaves what is the hand's.
    runs(fit.format("second"))
    if own not in scene.read_text():
        fail(f"the hand's lines are gone: {scene.read_text()}")
    fires(second, "hand.toml", "emulated", "--triggers 5")
    text = scene.read_text()
    scene.write_text(re.sub(r"\nclose_end = (.*)", lambda it: f"\nclose_end = {1.01 * float(it[1])}", text))
    refused("you have changed what a fit wrote", fit.format("first"))
    if "one of them was changed by hand" not in runs("shutter plan hand.toml"):
        fail("a time that a hand changed is not told")
    # A delay of the hand's own wins, whatever a fit finds later.
    scene.write_text(text.replace("\ntriggers", "\ndelay = 4.5\nsync_falls = true\ntriggers", 1))
    runs(fit.format("first"))
    fires(first, "hand.toml", "emulated", "--triggers 5", delay=4.5e-3)


RECORDS = {record.__name__: record for record in (early, x, sensors, hand)}
asked = sys.argv[1:] or RECORDS
host = os.environ.get("HOST_RUSTC")
build = ["cargo", "build", "--quiet", "--locked", "--package", "shutter-curve-cli"]
subprocess.run(build, check=True, cwd=HERE, env={**os.environ, **({"RUSTC": host} if host else {})})
os.environ["PATH"] = f"{TARGET / 'debug'}:{os.environ['PATH']}"
with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    for board in BOARDS:
        shutil.copytree(HERE / board, board, ignore=shutil.ignore_patterns("target"))
    for name in asked:
        noise.seed(name)
        RECORDS[name]()
    os.chdir(HERE)
print(f"from-trace: {', '.join(asked)}: on both boards each flash is where the truth has it, or refused with a way on")
