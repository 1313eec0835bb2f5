"""What all scripts here share: constants of the source, the tools, and one printed line for each claim."""

import re
import sys
import time
from fractions import Fraction
from math import log2
from pathlib import Path

SRC, PROMISE = (Path(__file__).resolve().parent.parent / path for path in ("src", "tests/support/promise.rs"))
SCRIPT = Path(sys.argv[0]).stem

# Half the distance between the f32 around 1, and the greatest relative error of one rounding; the same of f64.
U = Fraction(1, 2**24)
U64 = Fraction(1, 2**53)

# Lemmas of domain.py that other scripts use: it fails if a number is not this one. The first two are multiples of a
# mass and of a time.
MASS_TERMS, TIME_TERMS = 512, 14
LEAST_AREA = Fraction(1, 20)
STEEPEST = 9
# Of search.py: what a way is measured to, in fine units. Of certificate.py: what a bound is too small by, in itself.
WAY_OFF, BOUND_OFF = 72, Fraction(1, 2**16)

CONSTANTS = {}
for path in [*sorted(SRC.rglob("*.rs")), PROMISE]:
    for name, value in re.findall(r"const (\w+): [^=]+? =\s*([^;]*);", path.read_text()):
        CONSTANTS.setdefault(name, []).append((path.stem, value))


def text_of(name):
    """The text of a constant of src/ or of the promises; `file::name` where several files have one."""
    file, _, name = name.rpartition("::")
    values = [value for stem, value in CONSTANTS.get(name, []) if file in ("", stem)]
    if len(values) != 1:
        sys.exit(f"there are {len(values)} constants {name}, not 1")
    return values[0]


def constant(name):
    """The value of such a constant."""
    text = re.sub(r" as \w+|\.to_bits\(\)|(?<=\d)_(?=\d)|(?<=\d)[iu]\d\d\b", "", text_of(name))
    text = re.sub(r"\d+\.\d*", lambda n: f"Fraction('{n[0].rstrip('.')}')", text)
    text = re.sub(r"power_of_two(_f64)?\(", "power(", text)
    text = re.sub(r"\b[A-Z][A-Z_0-9]+\b", lambda n: f"({constant(n[0])})" if n[0] in CONSTANTS else n[0], text)
    value = eval(text, {"Fraction": Fraction, "power": lambda n: Fraction(2) ** n})
    return int(value) if value == int(value) else Fraction(value)


started = time.monotonic()


def proven(claim, *held):
    """Prints a claim, if all of this holds, with the time since the last one."""
    global started
    for i, holds in enumerate(held):
        require(holds, f"{claim} ({i + 1} of {len(held)} conditions)")
    now = time.monotonic()
    print(f"proven {now - started:7.2f} s  {SCRIPT}: {claim}\n", end="", flush=True)
    started = now


def require(condition, claim):
    if not condition:
        print(f"FAILED  {SCRIPT}: {claim}", flush=True)
        sys.exit(1)


def require_valid(claim, formula, *but_not):
    """z3 proves the formula; and finds an exception to each of those that say a little more."""
    from z3 import Not, Solver, sat, unsat

    for expected, stated in [(unsat, formula), *((sat, more) for more in but_not)]:
        solver = Solver()
        solver.add(Not(stated))
        require(solver.check() == expected, f"{claim}{': more than this holds' * (expected == sat)}")


def valid(claim, formula, *but_not):
    require_valid(claim, formula, *but_not)
    proven(claim)
