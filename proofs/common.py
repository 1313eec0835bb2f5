"""What all scripts here share: pins and constants of the source, the tools, and one printed line for each claim."""

import hashlib
import re
import subprocess
import sys
import time
from fractions import Fraction
from math import log2
from pathlib import Path

HERE = Path(__file__).resolve().parent
SRC = HERE.parent / "src"
SCRIPT = Path(sys.argv[0]).stem

# Half the distance between the f32 around 1, and the greatest relative error of one rounding; the same of f64.
U = Fraction(1, 2**24)
U64 = Fraction(1, 2**53)

# Lemmas that other scripts use. The script named proves each, and fails if the number is not this one.
AT = {6: 118, 3: 31}  # series.py: the error of `Series::at`, in 2^-48 of its terms
AT_PAIR = {6: 229, 3: 64}  # series.py: that of `Series::at_pair`
SECOND = {6: 12, 3: 6}  # series.py: the second number of `Series::at`, in 2^-24 of its terms
OVER, PLUS = Fraction(301, 10), 16  # pairs.py: the errors of `Pair::over`, and `plus` with four ulp, in 2^-48
MASS_TERMS = 512  # domain.py: a mass's terms without their signs, as a multiple of the mass
TIME_TERMS = 14  # domain.py: the same of a time


def bare(rust):
    """Without comments, attributes, whitespace, and the comma that a line break leaves behind a last item."""
    rust = re.sub(r"#\[[^\]]*\]", "", re.sub(r"//[^\n]*", "", rust))
    return re.sub(r",(?=[)}\]])", "", re.sub(r"\s+", "", rust))


def end_of(text, start):
    """Behind the item that begins at `start`: its body, or its semicolon."""
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] in "([{") - (text[i] in ")]}")
        if depth == 0 and text[i] in ";}":
            return i + 1
    sys.exit("an item without an end")


def item(file, kind_and_name):
    """The text of a function, constant or type: `Type::name` in the type's impls, `::name` outside of all impls."""
    text = re.sub(r"//[^\n]*", "", (SRC / file).read_text()) if (SRC / file).exists() else ""
    kind, _, name = kind_and_name.rpartition("::")
    is_in_impl = "::" in kind_and_name
    starts = re.finditer(rf"^impl\b[^{{\n]*\b{kind}\b[^{{\n]*{{", text, re.M)
    impls = [text[found.start() : end_of(text, found.start())] for found in starts]
    if not is_in_impl:
        impls = [text]
    elif not kind:
        for impl in impls:
            text = text.replace(impl, "")
        impls = [text]
    pattern = rf"\b(?:fn|const|struct|enum) {name}\b"
    found = [part[at.start() : end_of(part, at.start())] for part in impls for at in re.finditer(pattern, part)]
    return found[0] if len(found) == 1 else None


def hash_of(file, name):
    found = item(file, name)
    return found and hashlib.sha256(bare(found).encode()).hexdigest()[:8]


def pins(table):
    """Of a table of files, each before names with their hashes."""
    words = iter(table.split())
    for word in words:
        if word.endswith(".rs"):
            file = word
        else:
            yield file, word, next(words)


def pinned(table):
    """Stops unless each item reads as when its transcription was made."""
    for file, name, pin in pins(table):
        found = hash_of(file, name)
        if found is None:
            sys.exit(f"src/{file} has not one {name}: name it anew in proofs/{SCRIPT}.py")
        if found != pin:
            compare = f"compare the transcription in proofs/{SCRIPT}.py with it, then pin {found}"
            sys.exit(f"src/{file}: {name} has changed: {compare}")


CONSTANTS = {}
for path in sorted(SRC.rglob("*.rs")):
    for name, value in re.findall(r"const (\w+): \w+ =\s*([^;]*);", path.read_text()):
        CONSTANTS.setdefault(name, []).append(value)


def constant(name):
    """The value of a constant of src/."""
    values = CONSTANTS.get(name, [])
    if len(values) != 1:
        sys.exit(f"src/ has {len(values)} constants {name}, not 1")
    text = re.sub(r" as \w+|\.to_bits\(\)|(?<=\d)_(?=\d)|(?<=\d)[iu]\d\d\b", "", values[0])
    text = re.sub(r"\d+\.\d*", lambda n: f"Fraction('{n[0].rstrip('.')}')", text)
    text = re.sub(r"power_of_two(_f64)?\(", "power(", text)
    text = re.sub(r"\b[A-Z][A-Z_0-9]+\b", lambda n: f"({constant(n[0])})" if n[0] in CONSTANTS else n[0], text)
    value = eval(text, {"Fraction": Fraction, "power": lambda n: Fraction(2) ** n})
    return int(value) if value == int(value) else Fraction(value)


def exactly(number):
    """A number as Gappa reads it; below 2^-80 it is rounded down."""
    return f"{int(number * 2**80)}b-80"


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


def gappa(script):
    """Does Gappa prove it?"""
    run = subprocess.run(["gappa"], input=script, text=True, capture_output=True, timeout=30)
    said = run.stdout + run.stderr
    if run.returncode != 0 and not re.search("were not satisfied|contradiction", said):
        sys.exit(f"gappa does not say what it did not prove:\n{said}\n{script}")
    return run.returncode == 0


def gappa_claim(claim, script, bound, slack=Fraction(1, 50)):
    """Gappa proves `script(bound)`, and does not prove it for a bound that is less by the share `slack`."""
    require(gappa(script(Fraction(bound))), claim)
    require(not gappa(script(Fraction(bound) * (1 - slack))), f"{claim}: a tighter bound is proven, too: say that one")
    proven(claim)


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
