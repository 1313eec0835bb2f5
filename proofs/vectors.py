"""The transcriptions of these scripts on edges and on random words: `vectors/*.csv`, to which unit tests hold the Rust functions.

`vectors.py write` writes them; without it they are compared. Words are hexadecimal, floats by their bits.
"""

import random
import struct
import sys

import numpy as np

from common import *

f = np.float32
random.seed(7)


def bits(x):
    return f"{struct.unpack('<I', struct.pack('<f', float(x)))[0]:x}"


def word(x, size=64):
    return f"{x % 2**size:x}"


def number(exponent=0, spread=0):
    """An f32 of either sign; its significand is random, or next to a power of two."""
    m = random.choice([random.getrandbits(23) | 2**23, 2**23, 2**24 - 1, 2**23 + 1])
    return f(random.choice([-1, 1]) * m * 2.0 ** (exponent - 23 + random.randint(-spread, spread)))


def pair(exponent=0, spread=0, halves=1):
    hi = number(exponent, spread)
    half = 2.0 ** (int(np.floor(np.log2(abs(float(hi))))) - 24)
    lo = random.choice([f(0), f(half * halves), f(random.uniform(-halves, halves) * half)])
    return hi, lo


def two_sum(a, b):
    hi = a + b
    added = hi - a
    return hi, (a - (hi - added)) + (b - added)


def exactly(pair):
    return Fraction(float(pair[0])) + Fraction(float(pair[1]))


seen = {}


def within(name, error, bound):
    """An error is within its proven bound, in 2^-48, but for terms of second order."""
    share = abs(error) * 2**48 / bound
    require(share <= 1 + Fraction(1, 2**20), f"{name} errs by {float(share)} of its bound")
    seen[name] = max(seen.get(name, 0), share)


def lost(product, a, b):
    """Exactly, as is known of Dekker's product."""
    return f(Fraction(float(a)) * Fraction(float(b)) - Fraction(float(product)))


def plus(a, b):
    s, e = two_sum(a[0], b[0])
    return two_sum(s, e + (a[1] + b[1]))


def loose(a, b):
    s, e = two_sum(a[0], -b[0])
    return s, e + (a[1] - b[1])


def times(a, b):
    hi = a[0] * b[0]
    return hi, lost(hi, a[0], b[0]) + (a[0] * b[1] + a[1] * b[0])


def over(a, b):
    inverse = f(1) / b[0]
    hi = a[0] * inverse
    product = hi * b[0]
    lacks = (a[0] - product) - lost(product, hi, b[0])
    return hi, (lacks + (a[1] - hi * b[1])) * inverse


def difference(a, b):
    return (a[0] - b[0]) + (a[1] - b[1])


def pairs():
    for _ in range(80):
        a, b = pair(0, 3), pair(0, 3, 2)
        if random.random() < 0.3:
            near = f(a[0] * f(1 + random.choice([0, 1, -1, 3]) * 2.0**-22))
            b = (near, abs(near) * f(random.uniform(-0.9, 0.9) * 2.0**-24))
        x, y = exactly(a), exactly(b)
        # The bounds that pairs.py proves, for second numbers of half an ulp and an ulp.
        greater = max(abs(x), abs(y))
        within("plus", exactly(plus(a, b)) - (x + y), 6 * greater)
        within("minus_loose", exactly(loose(a, b)) - (x - y), 6 * greater)
        within("times", exactly(times(a, b)) - x * y, 11 * abs(x * y))
        within("over", exactly(over(a, b)) - x / y, Fraction(301, 10) * abs(x / y))
        yield [bits(x) for x in (*a, *b, *plus(a, b), *loose(a, b), *times(a, b), *over(a, b), difference(a, b))]


def at(c, x):
    hi, lo = c[-1]
    for k in range(len(c) - 1, -1, -1):
        product = hi * x
        lo = lo * x + lost(product, hi, x)
        if k == 0:
            return product, lo
        hi, rest = two_sum(c[k - 1][0], product)
        lo = lo + (c[k - 1][1] + rest)


def slope(c, x):
    value = f(len(c)) * c[-1][0]
    for k in range(len(c) - 1, 0, -1):
        value = value * x + f(k) * c[k - 1][0]
    return value


def series():
    for _ in range(40):
        c, x = [pair(-2 * k, 4) for k in range(6)], abs(number(2, 2))
        rest = x * f(random.uniform(-1, 1) * 2.0**-25)
        hi, lo = at(c, x)
        place, along = Fraction(float(x)), Fraction(float(x)) + Fraction(float(rest))
        terms = sum(abs(exactly(p)) * place**k for k, p in enumerate(c, 1))
        within("Series::at", exactly((hi, lo)) - sum(exactly(p) * place**k for k, p in enumerate(c, 1)), 118 * terms)
        within("value along a rest", exactly((hi, lo + slope(c, x) * rest)) - sum(exactly(p) * along**k for k, p in enumerate(c, 1)), 229 * terms)
        yield [bits(v) for v in (*(n for p in c for n in p), x, rest, hi, lo, slope(c, x), lo + slope(c, x) * rest)]


def left():
    for _ in range(60):
        c = [number(-2 * k, 4) for k in range(6)]
        x, s = abs(number(1, 2)), number(-6, 4)
        moved, missing = x * f(random.choice([0, 1e-6])), number(-6, 4)
        d = list(c)
        for last in (0, 0, 1):
            for k in range(4, last - 1, -1):
                d[k] = d[k] + d[k + 1] * x
        size = abs(s)
        y = x + size
        cubes = f(0)
        for j in range(6, 2, -1):
            cubes = cubes * y + f(j) * abs(c[j - 1])
        squares = cubes * y + f(2) * abs(c[1])
        slopes = squares * y + abs(c[0])
        first = abs(missing - s * (d[0] + d[1] * s))
        bound = first + size * (f(2.0**-20) * slopes + f(5) * abs(moved) * squares + f(3.4) * cubes * (s * s))
        yield [bits(v) for v in (*c, x, moved, missing, s, d[0], d[1], bound)]


def nearest(x):
    """The f32 nearest to a fraction, to even in the middle, subnormal or not."""
    if x == 0:
        return f(0)
    size = abs(x)
    e = max(size.numerator.bit_length() - size.denominator.bit_length() - 1, -127)
    while size >= Fraction(2) ** (e + 1):
        e += 1
    unit = Fraction(2) ** (max(e, -126) - 23)
    count = size / unit
    n = int(count)
    if count - n > Fraction(1, 2) or count - n == Fraction(1, 2) and n % 2 == 1:
        n += 1
    return f(float(n * unit) * (1 if x > 0 else -1))


def rounded():
    """What is expected here is the exact sum, rounded once."""
    for i in range(160):
        unit = random.choice([-252, -200, -150, -60, 0, 22])
        base_exponent = random.choice([-126, -120, -60, 0, 20])
        base = random.choice([f(0), number(base_exponent)])
        # Near the base, or next to half of its ulp, or subnormal.
        target = base_exponent - random.choice([0, 1, 5, 24, 25, 26])
        hi, lo = pair(max(min(target - unit, 104), -20))
        if random.random() < 0.3:
            hi = f(2.0 ** np.floor(np.log2(abs(float(hi)))))
        hi, lo = abs(hi), lo
        back = random.random() < 0.5
        way = (Fraction(float(hi)) + Fraction(float(lo))) * Fraction(2) ** unit
        exact = Fraction(float(base)) + (-way if back else way)
        if abs(exact) < 2**100 and exact != 0:
            yield [bits(base), bits(hi), bits(lo), word(unit), word(int(back)), bits(nearest(exact))]
    # The exception: next to a middle, across 0.
    yield [bits(f(-10445573 / 4)), bits(f(11000001)), bits(f(-(2**24 - 1) / 2**25)), "0", "0", bits(f(8388607))]


def fractions():
    for _ in range(60):
        n = random.choice([1, 2, 3, 1026, 2**22, random.randint(1, 2**22)])
        odd = 2 * random.choice([0, n // 2, n - 1, random.randrange(n)]) + 1
        more = f(random.choice([-1, 1]) * random.choice([0, 1, 1 - 2.0**-24, random.random()]))
        part, rest, whole = f(odd) + more, f(2 * n - odd) - more, f(2 * n)
        a = part / whole if part <= rest else rest / whole
        yield [word(odd), bits(more), word(n), word(int(part > rest)), bits(a)]


def units():
    """A way that is rounded down in units, from either end, and stops at the other one."""
    cut = lambda x: int(Fraction(float(x)) / Fraction(2) ** unit)
    for _ in range(60):
        unit, up = random.randint(-80, 0), random.choice([0, 3, 20, 23, 24, 40, 60])
        base, until = (number(unit + random.choice([0, 10, 22, 40, 61])) for _ in range(2))
        hi, lo = pair(up, 0, 60)
        hi, back = abs(hi), until < base
        whole = int(hi)
        rest = f(hi - f(whole)) + lo
        way = whole + int(np.floor(rest))
        time = cut(base) - way if back else cut(base) + way
        time = max(time, cut(until)) if back else min(time, cut(until))
        own = unit + random.randint(-30, 30)
        yield [bits(v) for v in (base, until, f(hi * 2.0 ** (unit - own)), f(lo * 2.0 ** (unit - own)))] + [word(own), word(unit), word(time)]


def ticks():
    for _ in range(80):
        length = random.getrandbits(random.randint(38, 62)) | 2**37
        start = random.randint(-(2**62), 2**62 - length)
        hz = random.choice([1, 1000, random.getrandbits(32) | 1])
        # So that the interval has at most 2^31 ticks.
        unit = min(random.randint(-60, 31) - (length * hz).bit_length(), 2)
        time = start + random.choice([0, -3, length, random.randint(0, length)])
        tick = max(time - start, 0) * hz * Fraction(2) ** unit + Fraction(1, 2)
        yield [word(start), word(length), word(hz), word(unit), word(time), word(int(tick))]


def guess():
    for k in range(1, 7):
        for x in [0, 1, -1, 2**29 - 1, -(2**29), *(random.randint(-(2**29), 2**29 - 1) for _ in range(6))]:
            reciprocal = -(-(2**30) // k)
            yield [word(x), word(k), word((4 * x * reciprocal) >> 32)]


if __name__ == "__main__":
    for name, rows in (("pairs", pairs), ("series", series), ("left", left), ("rounded", rounded), ("fractions", fractions), ("units", units), ("ticks", ticks), ("guess", guess)):
        path = HERE / "vectors" / f"{name}.csv"
        with np.errstate(all="raise", under="ignore"):
            text = "".join(",".join(row) + "\n" for row in rows())
        if "write" in sys.argv:
            path.write_text(text)
        require(path.read_text() == text, f"vectors/{name}.csv is not what the transcription gives: vectors.py write")
        tested(f"vectors/{name}.csv are the transcription's {text.count(chr(10))} answers; a unit test holds the Rust function to them")
    require(len(seen) == 6 and all(share > Fraction(1, 200) for share in seen.values()), f"errors are seen: {seen}")
    tested("on these words, the errors are up to " + ", ".join(f"{float(share):.2f} of the bound of {name}" for name, share in seen.items()))
