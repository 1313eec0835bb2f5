"""What all scripts here share: the source's constants, the tools, and one printed line for each claim."""

import re
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
# All of src/: what a script reads there is found wherever it stands.
SOURCE = "".join(path.read_text() for path in sorted((HERE.parent / "src").rglob("*.rs")))
DOCS = " ".join((HERE.parent / "docs" / "internals" / "proofs.md").read_text().split())

# Half the distance between the f32 around 1, and the greatest relative error of one rounding.
U = Fraction(1, 2**24)


def source(pattern):
    """The groups of the only match of `pattern` in src/: a constant that changed its form is a failure."""
    found = re.findall(pattern, SOURCE)
    if len(found) != 1:
        sys.exit(f"src: {len(found)} matches of {pattern!r}, not 1: read the constant anew")
    return found[0]


def documented(pattern):
    """The same of docs/internals/proofs.md, with single spaces: a number that it states, which a script then holds it to."""
    found = re.findall(pattern, DOCS)
    if len(found) != 1:
        sys.exit(f"docs/internals/proofs.md: {len(found)} matches of {pattern!r}, not 1: see what it states now")
    return found[0]


def number(said):
    """A number in raised digits, as texts have exponents."""
    return float(said.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹·", "0123456789.")))


def promised(function):
    """The n of the last "2⁻ⁿ" in the comment of a function that begins so: it promises an error of so much."""
    comment = source(rf"((?: *//[^\n]*\n)+)(?: *#\[[^\n]*\n)*    pub\(crate\) const fn {re.escape(function)}")
    return int(number(re.findall(r"2⁻([⁰¹²³⁴-⁹]+)", comment)[-1]))


def plain(rust):
    """Without whitespace, comments, and the comma that a line break leaves behind a last item."""
    return re.sub(r",(?=[)}\]])", "", re.sub(r"\s+", "", re.sub(r"//[^\n]*", "", rust)))


PLAIN = plain(SOURCE)


def code(start, text):
    """Fails unless the only item of src/ that begins with `start` reads as the transcription was made from it."""
    if PLAIN.count(plain(start)) != 1 or plain(start + text) not in PLAIN:
        sys.exit(f"src: `{start.strip()}` has changed: compare the transcription with it, then the text here")


def exactly(number):
    """A number as Gappa reads it, rounded down to 60 bits where it has more."""
    number, places = Fraction(number), 0
    while number.denominator != 1 and number * 2**places < 2**60:
        places += 1
        if (number * 2**places).denominator == 1:
            break
    return f"{int(number * 2**places)}b-{places}"


def log2(x):
    import math

    x = Fraction(x)
    return math.log2(x.numerator) - math.log2(x.denominator)


count = 0
started = time.monotonic()


def proven(claim):
    """Prints a claim that has just been checked, with the time since the last one."""
    global count, started
    now = time.monotonic()
    print(f"proven {now - started:7.2f} s  {Path(sys.argv[0]).stem}: {claim}", flush=True)
    count, started = count + 1, now


def tested(claim):
    """The same for what was tried on many words, but not proven."""
    global started
    now = time.monotonic()
    print(f"tested {now - started:7.2f} s  {Path(sys.argv[0]).stem}: {claim}", flush=True)
    started = now


def open_point(claim):
    """What is not proven, so that no run hides it."""
    print(f"open              {Path(sys.argv[0]).stem}: {claim}", flush=True)


def require(condition, claim):
    if not condition:
        print(f"FAILED  {Path(sys.argv[0]).stem}: {claim}", flush=True)
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
