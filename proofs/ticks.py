"""From fractions to ticks: the order of fractions, the nearest tick, and how far off it is.

Of `Fraction::of_parts`, `Frame::fraction`, `Pulses::at`, `exponent_of_ticks`, `TickScale::new` and `tick`.
"""

from z3 import *

from common import *

# --- Fractions. R rounds to an f32, D divides by 2n and rounds. Both keep order, R keeps n, and D makes 1/2 of that.
MOST_TRIGGERS = constant("ticks::MOST_TRIGGERS")
require(2 * MOST_TRIGGERS <= 2**24, "2i + 1, 2n and their difference are exact")
n, half = Real("n"), Q(1, 2)
exact, part, rest, a, b = ([Real(f"{name}{i}") for i in (0, 1)] for name in ("exact", "part", "rest", "a", "b"))
ordered = [exact[0] <= exact[1], part[0] <= part[1], rest[0] >= rest[1], a[0] <= a[1], b[0] >= b[1]]
for v, p, r, x, y in zip(exact, part, rest, a, b):
    ordered += [Implies(v <= n, And(p <= n, r >= n)), Implies(v >= n, And(p >= n, r <= n))]
    ordered += [Implies(p <= n, x <= half), Implies(r <= n, y <= half)]
from_start = [p <= r for p, r in zip(part, rest)]
place = [If(s, x, 1 - y) for s, x, y in zip(from_start, a, b)]
is_lesser = [If(s, x, y) <= half for s, x, y in zip(from_start, a, b)]
valid("fractions keep the order of the numbers they stand for, those from the start come first, and none is above 1/2",
      Implies(And(ordered), And(place[0] <= place[1], Implies(from_start[1], from_start[0]), *is_lesser)),
      Implies(And(ordered[:1] + ordered[2:]), place[0] <= place[1]))
i, d = Reals("i d")
ends = lambda most: Implies(And(d > 0, d <= most), And(i - d <= i + d, i + d <= i + 2 - d))
valid("so the ends of pulses are in order, for every duty up to 1", ends(1), ends(Q(101, 100)))
# Exactly half counts from the start only: if the rest is n, so is the part. Two or more from n no rounding comes to n.
in_float = lambda word: fpToFP(RNE(), word, Float32())
m, odd, more = BitVec("m", 32), BitVec("odd", 32), FP("more", Float32())
part, rest = fpAdd(RNE(), in_float(odd), more), fpSub(RNE(), in_float(2 * m - odd), more)
odds = And(odd >= 1, odd <= 2 * m - 1, odd & 1 == 1, odd - m <= 1, m - odd <= 1)
frame = And(m >= 1, m <= MOST_TRIGGERS, odds, fpLEQ(fpAbs(more), FPVal(1, Float32())))
half_from_end = lambda less: fpLT(rest, fpSub(RNE(), in_float(m), FPVal(less, Float32())))
from_end = lambda less: Implies(And(frame, fpGT(part, rest)), half_from_end(less))
valid("a fraction from the end is below 1/2", from_end(0.0), from_end(2.0**-2))
# Errors. A trigger's part is exact, so there is one rounding. Of a pulse's end the part is rounded, too: with part and
# 2n from 1 to 2, by 2^-24 at most, and an ulp of the quotient is 2^-23 or, below 1, 2^-24.
part, whole, error = Reals("part whole error")
scaled = And(part >= 1, part <= 2, whole >= 1, whole < 2, error * whole <= 1, error >= 0)
within = lambda most: Implies(scaled, If(part >= whole, error / 2, error) + half <= most)
valid("a trigger's fraction is within half an ulp; a pulse's end within one and a half",
      within(Q(3, 2)), within(Q(149, 100)))

# --- No time is outside the interval: each tick counts from its start. A search stays on its ramp, or the plateau
# (search.py). A polynomial collects its fraction but for ULP_ERROR. The line begins behind the near ramp, and above
# LINE_FROM; its joins are off by JOIN_OFF and FRACTION_OFF, itself by 2^-6 ulp of LINE_FROM (domain.py).
SHORTEST, LONGEST = int(61 + log2(constant("LEAST_INTERVAL"))), 62
UNITS, RAMP = 2**SHORTEST * LEAST_AREA, 2**60 * constant("LEAST_PART")
by_polynomial = constant("LEAST_TOP") / 2 * (1 - constant("ULP_ERROR") / 2**23) * UNITS - 1
line_off = (constant("LINE_FROM") / 2**23 / 2**6 + constant("JOIN_OFF")) * 2**62
by_line = constant("LINE_FROM") * (1 - Fraction(1, 2**29)) * UNITS
is_inside = lambda ramp: line_off < ramp * (1 - constant("FRACTION_OFF"))
proven(f"no time is outside the interval: a polynomial's is 2^{log2(by_polynomial):.1f} units inside, the line's "
       f"2^{log2(by_line):.1f}, or it begins where a near ramp of 2^{log2(RAMP):g} ends, to 2^{log2(line_off):.1f}",
       by_polynomial > 0 and by_line > 5 and is_inside(RAMP) and not is_inside(RAMP / 2**13))

# --- Ticks. The scale, by the exponents of a length and a rate. An interval has at most 2^TICK_BITS ticks.
TICK_BITS, ticks = constant("TICK_BITS"), BitVec("ticks", 128)
upper = LShR(ticks + (2**32 - 1), 32)
from_shortest = And(UGE(ticks, 1 << SHORTEST), ULT(ticks, 1 << 96))
for e in range(97):
    is_enough = LShR(upper - 1, e - 32) == 0 if e >= 32 else BoolVal(False)
    require_valid("exponent_of_ticks", Implies(from_shortest, is_enough == ULE(ticks, BitVecVal(1 << e, 128))))
proven(f"exponent_of_ticks: the least power of two that is not below, for every number of ticks from 2^{SHORTEST} "
       "units to 2^96",
       2 ** (LONGEST - 32) * (2**32 - 1) + 2**32 < 2**64)
downs = set()
for exponent in range(SHORTEST, LONGEST + 1):
    up = 62 - exponent if exponent < 61 else 0
    require(up < 32 and 61 <= exponent + up <= 62, "a length is moved up to 62 or 63 bits")
    downs |= {up + 31 - of_rate - (TICK_BITS - exponent - of_rate) - 33 for of_rate in range(32)}
p, q = Ints("p q")
products = And(p >= 0, p <= (2**32 - 1) ** 2, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
product = q + p / 2**32
for down in range(min(downs), 64):
    tick = (product / 2**down + 1) / 2
    rounded = lambda less: (q * 2**32 + p + 2 ** (32 + down) - less) / 2 ** (33 + down)
    exact = lambda less: Implies(products, And(tick == rounded(less), product < 2**63))
    # Moved by 63, and by more, which is not done, none is half a tick.
    require_valid(f"tick: moved down by {down}", exact(0), *[exact(2**31)] * (down < 63))
proven("TickScale: the tick is floor(delay rate + 1/2) exactly, for every delay in units, length and rate: moved "
       f"down by {min(downs)} or more, and nothing overflows",
       0 < min(downs) <= 63)
# What a tick may be off by: half a tick, the measuring of a way, its unit, and that of the start; on the plateau a way
# is a product, low by 3 units.
unit, fine = Fraction(2**TICK_BITS, 2**SHORTEST), Fraction(2**TICK_BITS, 2**61)
off = Fraction(1, 2) + max(WAY_OFF * fine + 2 * unit, 4 * unit)
proven(f"a tick is within {float(off):.5f} tick of the exact time of a fraction near its own: by a search within "
       "0.425 ulp, or 2^-46 (search.py), by a polynomial within ULP_ERROR, on the line within 2^-6 ulp",
       Fraction(5002, 10000) < off < Fraction(5003, 10000))
