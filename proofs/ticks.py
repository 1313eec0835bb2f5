"""From fractions to ticks: the order of fractions, whole units of time, and the nearest tick; and that ticks never step
back."""

import box
from z3 import *

from common import *

pinned("""
fraction.rs of_parts 36f90104
trigger/ticks.rs fraction 2c774e95 around 8259bfdd Ticks::new 51d9ac88 exponent_of_ticks 1d19fb19
    TickScale::new 92811d40 TickScale::tick 5ab2dabf
trigger/pulse.rs at e0b4f7ee
number/moment.rs in_units 65d70f00
number/units.rs fixed_down 12e34aed time_exponent 96eb982d
exposure.rs moment b0a499d8 sought 05355bcf
ramp/mod.rs moment 3ad522c9
octave/candidate.rs candidate d3eb3555
inverse.rs time_units 0a5d4365 direct_units 0f0faea8 searched_units 8d6e0d1a
""")

# --- Fractions. R rounds to an f32, D divides by 2n and rounds. Both keep order, R keeps n, and D makes 1/2 of that.
MOST_TRIGGERS = constant("MOST_TRIGGERS")
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
part, whole, quotient, error = Reals("part whole quotient error")
scaled = And(part >= 1, part <= 2, whole >= 1, whole < 2, error * whole <= 1, error >= 0)
within = lambda most: Implies(scaled, If(part >= whole, error / 2, error) + half <= most)
claim = "a trigger's fraction is within half an ulp; a pulse's end within one and a half"
valid(claim, within(Q(3, 2)), within(Q(149, 100)))
# Two ends of pulses that are neighbours are at 1/4n or later, or the second is three times as far as the first: with v
# = 1 - d < 1/2 the next is 1 + d.
v, w = Reals("v w")
apart = lambda least: Implies(And(d > 0, d <= 1, i >= 1, v == i - d, w == i + d), Or(v >= least, w >= 3 * v))
claim = "neighbouring fractions of a frame are at least 1/4n, or one is three times the other"
valid(claim, apart(half), apart(Q(51, 100)))
LEAST = Fraction(1, 4 * MOST_TRIGGERS)

# --- Times in whole units: base and way are each rounded down, and no time is beyond the section.
whole, hi, lo, lost = Int("whole"), *Reals("hi lo lost")
rest = hi - whole + lo + lost
as_one = lambda so: Implies(so, whole + ToInt(rest) == ToInt(hi + lo + lost))
claim = "in_units: a way is rounded down as one number, but for what its rest is rounded by"
valid(claim, as_one(whole == ToInt(hi)), whole + ToInt(rest) == ToInt(hi + lo))
# From 2^24 on `hi` is whole, and the rest is `lo`. Below, `lo` is at most 9 * 2^-24 of terms that are TIME_TERMS times
# the way.
WAYS = 2 * (9 * TIME_TERMS + 1) * 2**24 * U * U
proven(f"in_units: so ways of at least 2^24 units keep their order, and shorter ones if they are 2^{log2(WAYS):.1f} "
       "of a unit apart",
       WAYS < Fraction(1, 2**16))
kept = Real("kept")
in_units = And(whole == ToInt(hi), Implies(hi + lo >= 0, kept >= -whole))
from_0 = lambda least: Implies(And(in_units, hi + lo >= least), whole + ToInt(kept) >= 0)
claim = "in_units: a way of 0 or more is 0 units or more, as rounding its rest keeps whole numbers"
valid(claim, from_0(0), from_0(-1))
base, until, way, back = Reals("base until way back")
smaller = lambda x, y: If(x < y, x, y)
section = And(base <= until, way >= 0, back >= 0, way <= until - base, back <= until - base)
forwards = smaller(ToInt(base) + ToInt(way), ToInt(until))
backwards = -smaller(ToInt(back) - ToInt(until), -ToInt(base))
early = lambda most: Implies(section, And(forwards > base + way - most, forwards <= base + way))
about = lambda most: Implies(section, And(backwards > until - back - most, backwards < until - back + most))
valid("in_units: a time from a section's start is early by less than two units", early(2), early(1))
valid("in_units: one from its end is off by less than one", about(1), about(Q(9, 10)))
within = And(*(And(time >= ToInt(base), time <= ToInt(until)) for time in (forwards, backwards)))
claim = "in_units: neither is beyond the section's ends, as those are rounded down: so times of sections are in order"
valid(claim, Implies(section, within))

# --- Never a step back. Let two fractions be neighbours: an ulp apart, at least 2^-24 of the lesser. A time's
# measuring, of its way:
TIME = AT_PAIR[3] * TIME_TERMS * U * U
INVERSE, ULP_ERROR = constant("INVERSE_ERROR"), constant("ULP_ERROR")
# The way takes at most FULL times the mass at the openness of its end: so measuring it costs FULL times as much of an
# exposure.
FULL = 1024
reach = lambda r: box.sizes(box.times(r.t, r.f))
claim = f"openness times the way since an end is at most {FULL} times the mass"
proven(claim, box.tight(FULL, reach, lambda r: r.m, box.extremes(), less=Fraction(9, 10)))
# The least interval in units, and the exposure of what is as open as the curve's most open control value.
SHORTEST = int(61 + log2(constant("LEAST_INTERVAL")))
UNITS = 2**SHORTEST * Fraction(1, 20)
ulp = U
searched, left = INVERSE + FULL * TIME, ulp - 2 * INVERSE
proven(f"two searches from one end: what the mass and the time are off by is {float(2 * searched / ulp):.2f} ulp; and "
       f"the ways are 2^{log2(left * LEAST * UNITS):.1f} of a unit or more apart",
       ulp - 2 * searched > 0 and left * LEAST * UNITS / 2 > WAYS and left > 4 * FULL * TIME)
# From either end, at 1/2. The first is not late, the second early by less than a unit.
proven(f"a search from either end: times are 2^{log2(left / 2 * UNITS):.1f} units apart or more, and a unit would do",
       left / 2 * UNITS > 1 + 2 * TIME * 2**SHORTEST and left / 2 / 20 > 2 * TIME)
# A polynomial's certificate counts three units: one by which its own end is cut, and two by which a search beside it
# may be early.
UNITS_IN_CERTIFICATE = 1 + 2
proven(f"a polynomial beside another takes {float(2 * ULP_ERROR):.2f} ulp of exposure, beside a search "
       f"{float(ULP_ERROR + searched / ulp):.2f}, with all units of time",
       2 * ULP_ERROR < 1 and ULP_ERROR + searched / ulp < 1)
# The plateau's line is off by 2^-6 ulp of its least u (domain.py).
line = Fraction(1, 2**6) + 2 / (constant("FINE") / 2**23 * UNITS) + max(ULP_ERROR, searched / ulp)
proven(f"the plateau's line, beside a polynomial or a search, takes {float(line):.2f} ulp", line < 1)

# --- No time is outside the interval: each tick counts from its start. A ramp's way is measured to less than itself. On
# the plateau it has three roundings of numbers of 2^-24 of the fraction, which is 1/2 at most; without a near ramp
# nothing cancels. The line begins behind the near ramp, and above FINE; its joins are off by JOIN_OFF and FRACTION_OFF.
# A polynomial collects its fraction but for ULP_ERROR.
MOST_UNITS, FINE = 2**62, constant("FINE")
trace = Fraction(1, 2) * 3 * U * U * MOST_UNITS
line_off = (FINE / 2**23 / 2**6 + constant("JOIN_OFF")) * MOST_UNITS
RAMP = 2**60 * constant("LEAST_SECTION")
is_inside = lambda ramp: trace + 2 < ramp and line_off + 2 < ramp * (1 - constant("FRACTION_OFF"))
by_line = FINE * (1 - Fraction(1, 2**29)) * UNITS
by_polynomial = constant("LEAST_TOP") / 2 * (1 - ULP_ERROR / 2**23) * UNITS - UNITS_IN_CERTIFICATE
proven(f"no time is outside the interval: a ramp's way is at least 0, the plateau's at least -2^{log2(trace):.1f} "
       f"units, and its line is off by at most 2^{log2(line_off):.1f}, where a near ramp has 2^{log2(RAMP):g} or "
       f"more; else the line begins 2^{log2(by_line):.1f} inside; a polynomial is 2^{log2(by_polynomial):.1f} inside",
       # A way as measured is above 0.
       TIME < 1 and by_line > 2 and by_polynomial > 0 and is_inside(RAMP) and not is_inside(RAMP / 2**13))

# --- Ticks. The scale, by the exponents of a length and a rate. An interval has at most 2^TICK_BITS ticks.
TICK_BITS, LONGEST = constant("TICK_BITS"), 62
ticks = BitVec("ticks", 128)
upper = LShR(ticks + (2**32 - 1), 32)
from_shortest = And(UGE(ticks, 1 << SHORTEST), ULT(ticks, 1 << 96))
for e in range(97):
    is_enough = LShR(upper - 1, e - 32) == 0 if e >= 32 else BoolVal(False)
    is_not_below = ULE(ticks, BitVecVal(1 << e, 128))
    require_valid("exponent_of_ticks", Implies(from_shortest, is_enough == is_not_below))
proven(f"exponent_of_ticks: the least power of two that is not below, for every number of ticks from 2^{SHORTEST} "
       "units to 2^96",
       # The upper 64 bits.
       2 ** (LONGEST - 32) * (2**32 - 1) + 2**32 < 2**64)
downs = set()
for exponent in range(SHORTEST, LONGEST + 1):
    up = 62 - exponent if exponent < 61 else 0
    require(up < 32 and 61 <= exponent + up <= 62, "a length is moved up to 62 or 63 bits")
    for of_rate in range(32):
        most_unit = TICK_BITS - exponent - of_rate
        downs.add(up + 31 - of_rate - most_unit - 33)
least = min(downs)
p, q = Ints("p q")
products = And(p >= 0, p <= (2**32 - 1) ** 2, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
product = q + p / 2**32
for down in range(least, 64):
    tick = (product / 2**down + 1) / 2
    rounded = lambda less: (q * 2**32 + p + 2 ** (32 + down) - less) / 2 ** (33 + down)
    exact = lambda less: Implies(products, And(tick == rounded(less), product < 2**63))
    # Moved by 63, and by more, which is not done, none is half a tick.
    require_valid(f"tick: moved down by {down}", exact(0), *[exact(2**31)] * (down < 63))
proven("TickScale: the tick is floor(delay rate + 1/2) exactly, for every delay in units, length and rate: moved "
       f"down by {least} or more, and nothing overflows",
       0 < least <= 63)
# What a tick may be off by: half a tick, the measuring of the way, two units and the start's.
unit = Fraction(2**TICK_BITS, 2**SHORTEST)
off = Fraction(1, 2) + TIME * 2**TICK_BITS + 3 * unit
proven(f"a tick is within {float(off):.4f} tick of the exact time of a fraction within {float(INVERSE / ulp):g} ulp "
       f"of its own, or where a polynomial answers within 1/2 and 2^{log2(2 * unit):g} of one within "
       f"{float(ULP_ERROR)} ulp",
       Fraction(506, 1000) < off < Fraction(508, 1000))
