"""From fractions to ticks: the order of fractions, whole units of time, and the nearest tick; and that ticks never step back."""

import box
from z3 import *

from common import *

pinned("""
fraction.rs of_parts 36f90104
trigger/ticks.rs fraction 2c774e95 around 8259bfdd Ticks::new 51d9ac88 exponent_of_ticks 1d19fb19 TickScale::new 92811d40 TickScale::tick 5ab2dabf
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
valid(
    "fractions keep the order of the numbers they stand for, those from the start come first, and none is above 1/2",
    Implies(And(ordered), And(place[0] <= place[1], Implies(from_start[1], from_start[0]), *(If(s, x, y) <= half for s, x, y in zip(from_start, a, b)))),
    Implies(And(ordered[:1] + ordered[2:]), place[0] <= place[1]),
)
i, d = Reals("i d")
ends = lambda most: Implies(And(d > 0, d <= most), And(i - d <= i + d, i + d <= i + 2 - d))
valid("so the ends of pulses are in order, for every duty up to 1", ends(1), ends(Q(101, 100)))
# Exactly half counts from the start only: if the rest is n, so is the part. Two or more from n no rounding comes to n.
in_float = lambda word: fpToFP(RNE(), word, Float32())
m, odd, more = BitVec("m", 32), BitVec("odd", 32), FP("more", Float32())
part, rest = fpAdd(RNE(), in_float(odd), more), fpSub(RNE(), in_float(2 * m - odd), more)
frame = And(m >= 1, m <= MOST_TRIGGERS, odd >= 1, odd <= 2 * m - 1, odd & 1 == 1, odd - m <= 1, m - odd <= 1, fpLEQ(fpAbs(more), FPVal(1, Float32())))
half_from_end = lambda least: Implies(And(frame, fpGT(part, rest)), fpLT(rest, least))
valid("a fraction from the end is below 1/2", half_from_end(in_float(m)), half_from_end(fpSub(RNE(), in_float(m), FPVal(2.0**-2, Float32()))))
# Errors. A trigger's part is exact, so there is one rounding. Of a pulse's end the part is rounded, too: with part and 2n from 1 to 2, by
# 2^-24 at most, and an ulp of the quotient is 2^-23 or, below 1, 2^-24.
part, whole, quotient, error = Reals("part whole quotient error")
scaled = And(part >= 1, part <= 2, whole >= 1, whole < 2, error * whole <= 1, error >= 0)
within = lambda most: Implies(scaled, If(part >= whole, error / 2, error) + half <= most)
valid("a trigger's fraction is within half an ulp; a pulse's end within one and a half", within(Q(3, 2)), within(Q(149, 100)))
# Two ends of pulses that are neighbours are at 1/4n or later, or the second is three times as far as the first: with v = 1 - d < 1/2 the
# next is 1 + d.
v, w = Reals("v w")
apart = lambda least: Implies(And(d > 0, d <= 1, i >= 1, v == i - d, w == i + d), Or(v >= least, w >= 3 * v))
valid("neighbouring fractions of a frame are at least 1/4n, or one is three times the other", apart(half), apart(Q(51, 100)))
LEAST = Fraction(1, 4 * MOST_TRIGGERS)

# --- Times in whole units: base and way are each rounded down, and no time is beyond the section.
whole, hi, lo, lost = Int("whole"), *Reals("hi lo lost")
rest = hi - whole + lo + lost
as_one = lambda so: Implies(so, whole + ToInt(rest) == ToInt(hi + lo + lost))
valid("in_units: a way is rounded down as one number, but for what its rest is rounded by", as_one(whole == ToInt(hi)), whole + ToInt(rest) == ToInt(hi + lo))
# From 2^24 on `hi` is whole, and the rest is `lo`. Below, `lo` is at most 9 * 2^-24 of terms that are TIME_TERMS times the way.
WAYS = 2 * (9 * TIME_TERMS + 1) * 2**24 * U * U
require(WAYS < Fraction(1, 2**16), "what a rest is rounded by")
proven(f"in_units: so ways of at least 2^24 units keep their order, and shorter ones if they are 2^{log2(WAYS):.1f} of a unit apart")
kept = Real("kept")
in_units = And(whole == ToInt(hi), Implies(hi + lo >= 0, kept >= -whole))
valid("in_units: a way of 0 or more is 0 units or more, as rounding its rest keeps whole numbers", *(Implies(And(in_units, hi + lo >= least), whole + ToInt(kept) >= 0) for least in (0, -1)))
base, until, way, back = Reals("base until way back")
smaller = lambda x, y: If(x < y, x, y)
section = And(base <= until, way >= 0, back >= 0, way <= until - base, back <= until - base)
forwards = smaller(ToInt(base) + ToInt(way), ToInt(until))
backwards = -smaller(ToInt(back) - ToInt(until), -ToInt(base))
early = lambda most: And(forwards > base + way - most, forwards <= base + way)
about = lambda most: And(backwards > until - back - most, backwards < until - back + most)
valid("in_units: a time from a section's start is early by less than two units", Implies(section, early(2)), Implies(section, early(1)))
valid("in_units: one from its end is off by less than one", Implies(section, about(1)), Implies(section, about(Q(9, 10))))
within = And(forwards >= ToInt(base), forwards <= ToInt(until), backwards >= ToInt(base), backwards <= ToInt(until))
valid("in_units: neither is beyond the section's ends, as those are rounded down, so times of two sections are in order", Implies(section, within))

# --- Never a step back. Let two fractions be neighbours: an ulp apart, at least 2^-24 of the lesser. A time's measuring, of its way:
TIME = AT_PAIR[3] * TIME_TERMS * U * U
INVERSE, ULP_ERROR = constant("INVERSE_ERROR"), constant("ULP_ERROR")
# The way takes at most FULL times the mass at the openness of its end: so measuring it costs FULL times as much of an exposure.
FULL = 1024
reach = lambda r: box.sizes(box.times(r.t, r.f))
require(box.holds(FULL, reach, lambda r: r.m, box.extremes()) and not box.holds(FULL * Fraction(9, 10), reach, lambda r: r.m, box.extremes()), "a way at full openness")
proven(f"openness times the way since an end is at most {FULL} times the mass")
# The least interval in units, and the exposure of what is as open as the curve's most open control value.
SHORTEST = int(61 + log2(constant("LEAST_INTERVAL")))
UNITS = 2**SHORTEST * Fraction(1, 20)
ulp = U
searched = INVERSE + FULL * TIME
require(ulp - 2 * searched > 0 and (ulp - 2 * INVERSE) * LEAST * UNITS / 2 > WAYS and ulp - 2 * INVERSE > 4 * FULL * TIME, "searches from one end")
proven(f"two searches from one end: what the mass and the time are off by is {float(2 * searched / ulp):.2f} ulp; and the ways are 2^{log2((ulp - 2 * INVERSE) * LEAST * UNITS):.1f} of a unit or more apart")
# From either end, at 1/2. The first is not late, the second early by less than a unit.
require((ulp / 2 - INVERSE) * UNITS > 1 + 2 * TIME * 2**SHORTEST and (ulp / 2 - INVERSE) / 20 > 2 * TIME, "searches from either end")
proven(f"a search from either end: times are 2^{log2((ulp / 2 - INVERSE) * UNITS):.1f} units apart or more, and a unit would do")
# A polynomial's certificate counts three units: one by which its own end is cut, and two by which a search beside it may be early.
UNITS_IN_CERTIFICATE = 3
require(UNITS_IN_CERTIFICATE == 1 + 2 and 2 * ULP_ERROR < 1 and ULP_ERROR + searched / ulp < 1, "polynomials")
proven(f"a polynomial beside another takes {float(2 * ULP_ERROR):.2f} ulp of exposure, beside a search {float(ULP_ERROR + searched / ulp):.2f}, with all units of time")
# The plateau's line is off by 2^-6 ulp of its least u (domain.py).
line = Fraction(1, 2**6) + 2 / (constant("FINE") / 2**23 * UNITS)
require(line + max(ULP_ERROR, searched / ulp) < 1, "the line")
proven(f"the plateau's line, beside a polynomial or a search, takes {float(line + max(ULP_ERROR, searched / ulp)):.2f} ulp")

# --- No time is outside the interval: each tick counts from its start. A ramp's way is measured to less than itself. On the plateau it has
# three roundings of numbers of 2^-24 of the fraction, which is 1/2 at most; without a near ramp nothing cancels. The line begins behind
# the near ramp, and above FINE; its joins are off by JOIN_OFF and FRACTION_OFF. A polynomial collects its fraction but for ULP_ERROR.
require(TIME < 1, "a way as measured")
MOST_UNITS, FINE = 2**62, constant("FINE")
trace = Fraction(1, 2) * 3 * U * U * MOST_UNITS
line_off = (FINE / 2**23 / 2**6 + constant("JOIN_OFF")) * MOST_UNITS
RAMP = 2**60 * constant("LEAST_SECTION")
is_inside = lambda ramp: trace + 2 < ramp and line_off + 2 < ramp * (1 - constant("FRACTION_OFF"))
require(is_inside(RAMP) and not is_inside(RAMP / 2**13), "the plateau, beside a near ramp")
by_line = FINE * (1 - Fraction(1, 2**29)) * UNITS
by_polynomial = constant("LEAST_TOP") / 2 * (1 - ULP_ERROR / 2**23) * UNITS - UNITS_IN_CERTIFICATE
require(by_line > 2 and by_polynomial > 0, "the line and polynomials")
proven(f"no time is outside the interval: a ramp's way is at least 0, the plateau's at least -2^{log2(trace):.1f} units, and its line is off by at most 2^{log2(line_off):.1f}, where a near ramp has 2^{log2(RAMP):g} or more; else the line begins 2^{log2(by_line):.1f} inside; a polynomial is 2^{log2(by_polynomial):.1f} inside")

# --- Ticks. The scale, by the exponents of a length and a rate. An interval has at most 2^TICK_BITS ticks.
TICK_BITS, LONGEST = constant("TICK_BITS"), 62
ticks = BitVec("ticks", 128)
upper = LShR(ticks + (2**32 - 1), 32)
for e in range(97):
    is_enough = LShR(upper - 1, e - 32) == 0 if e >= 32 else BoolVal(False)
    require_valid("exponent_of_ticks", Implies(And(UGE(ticks, 1 << SHORTEST), ULT(ticks, 1 << 96)), is_enough == ULE(ticks, BitVecVal(1 << e, 128))))
require(2 ** (LONGEST - 32) * (2**32 - 1) + 2**32 < 2**64, "exponent_of_ticks: the upper 64 bits")
proven(f"exponent_of_ticks: the least power of two that is not below, for every number of ticks from 2^{SHORTEST} units to 2^96")
downs = set()
for exponent in range(SHORTEST, LONGEST + 1):
    up = 62 - exponent if exponent < 61 else 0
    require(up < 32 and 61 <= exponent + up <= 62, "a length is moved up to 62 or 63 bits")
    for of_rate in range(32):
        most_unit = TICK_BITS - exponent - of_rate
        downs.add(up + 31 - of_rate - most_unit - 33)
least = min(downs)
require(0 < least <= 63, "down")
p, q = Ints("p q")
products = And(p >= 0, p <= (2**32 - 1) ** 2, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
product = q + p / 2**32
for down in range(least, 64):
    tick = (product / 2**down + 1) / 2
    exact = lambda less: Implies(products, And(tick == (q * 2**32 + p + 2 ** (32 + down) - less) / 2 ** (33 + down), product < 2**63))
    # Moved by 63, and by more, which is not done, none is half a tick.
    require_valid(f"tick: moved down by {down}", exact(0), *[exact(2**31)] * (down < 63))
proven(f"TickScale: the tick is floor(delay rate + 1/2) exactly, for every delay in units, length and rate: moved down by {least} or more, and nothing overflows")
# What a tick may be off by: half a tick, the measuring of the way, two units and the start's.
unit = Fraction(2**TICK_BITS, 2**SHORTEST)
off = Fraction(1, 2) + TIME * 2**TICK_BITS + 3 * unit
require(Fraction(506, 1000) < off < Fraction(508, 1000), f"{float(off)}")
proven(f"a tick is within {float(off):.4f} tick of the exact time of a fraction within {float(INVERSE / ulp):g} ulp of its own, or where a polynomial answers within 1/2 and 2^{log2(2 * unit):g} of one within {float(ULP_ERROR)} ulp")
