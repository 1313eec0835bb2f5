"""A fraction, a mass, a place and a time in fixed point: what products and series lose, that a search ends, and that
what it finds is in order and near enough.

Of `fixed::product` and `product_up`, `Series::at` and `solve`, `guess`, `Ramp::time_of_mass`, `place_of_time` and
`way_powers`, `Curve::time_units` and `cdf::cdf`.
"""

from itertools import product

import box
from z3 import *

from common import *

# --- Products. `a` is high 2^32 + low, `x` likewise; the four products of words are any numbers that such may be.
WORD = 2**32
hh, hl, lh, ll, low, x_high, x_low, high_x = Ints("hh hl lh ll low x_high x_low high_x")
most = WORD - 1
signed = lambda p: And(p >= -(2**31) * most, p <= (2**31 - 1) * most)
words = And(signed(hh), signed(hl), lh >= 0, lh <= most**2, ll >= 0, ll <= most**2)
exact = hh * WORD**2 + (hl + lh) * WORD + ll
in_words = hh + hl / WORD + lh / WORD
too_low = exact - in_words * WORD**2
is_low = lambda by: Implies(words, And(too_low >= 0, too_low < by * WORD**2 / 100))
valid("product: a x / 2^64, low by less than 3", is_low(300), is_low(299))
lower = hl + ll / WORD
middle = lh + lower % WORD
fraction = (hh + lower / WORD + middle / WORD) * WORD + middle % WORD
fits = And(middle < WORD**2, lower < 2**63, lower >= -(2**63))
valid("product_up: a x rounded down to 32 bits after the point, no sum beyond its word: so down to each bit before",
      Implies(words, And(fraction == exact / WORD, fits)), Implies(words, middle < WORD**2 - WORD))
# In `a`, across a change of its upper word: floor(high x / 2^32) gains x_high or more, floor(low x_high / 2^32) loses
# no more. Else, and in `x`, both only grow.
of_high, of_low = (high_x + x_high * WORD + x_low) / WORD - high_x / WORD, lh / WORD
grows = lambda most: Implies(And(x_low >= 0, x_high >= 0, lh >= 0, lh <= most * x_high), of_high >= of_low)
valid("product: for an `a` from 0 on it never falls as `a` grows", grows(WORD - 1), grows(2 * WORD))

# --- A series of n coefficients by Horner's rule: n - 1 products by `product`, each less than 3 units of 2^shift low,
# then multiplied by the place, which is below 1, once for each product that follows; the last is rounded down.
loses = lambda n, shift, p: 2**shift * 3 * sum(p**k for k in range(1, n)) + 1
MASS_SHIFT, WAY_SHIFT = constant("MASS_SHIFT"), constant("WAY_SHIFT")
WOBBLE, TIME_WOBBLE = loses(6, MASS_SHIFT, 1), loses(3, WAY_SHIFT, 1)
proven(f"Series::at is low by less than 3 (n - 1) 2^shift times the place, and 1: a mass by {WOBBLE}, 2^"
       f"{log2(WOBBLE):.2f}; a way by {TIME_WOBBLE}",
       all(loses(n, s, p) <= 3 * (n - 1) * 2**s * p + 1 for n in (3, 6) for s in (0, 9) for p in (U, 1)),
       WOBBLE == 15 * 2**MASS_SHIFT + 1 and TIME_WOBBLE == 49)
# Horner's sums. Those of a mass are at most its coefficients' sizes, below 2^62 (domain.py), and what is lost. A time's
# differences are 2^59 at most together, each cut. An openness' sums are polynomials, c_k + c_(k+1) p + ..., of any four
# control values from 0 to 1.
powers = lambda t0, t1, t2, t3: [3 * (t1 - t0), 3 * (t2 - 2 * t1 + t0), t3 - 3 * (t2 - t1) - t0]
tails = lambda c: [c[k:] for k in range(len(c))]
of_time = max(sum(map(abs, powers(0, a, b, 1))) for a, b in box.corners()) * 2**59 + 13 + 6
tops = [tail for f in product((Fraction(0), Fraction(1)), repeat=4) for tail in tails(powers(*f))]
sums = [max(-box.least(tail), box.greatest(tail)) for tail in tops]
proven(f"no sum of Horner's rule reaches 2^63: a time's are below 2^{log2(of_time):.2f}, an openness' at most "
       f"2^{log2(max(sums) * 2**60 + 6):.2f}",
       of_time < 2**63 and max(sums) * 2**60 + 6 < 2**63 < (1 + max(sums)) * 2**61)

# --- A search ends. The steepest a series is, in units for a place; and what is between two neighbouring places.
LEAST_ERROR, FREE_STEPS = constant("LEAST_ERROR"), constant("FREE_STEPS")
TIME_SHIFT, LEAST_WAY_ERROR = constant("TIME_SHIFT"), constant("LEAST_WAY_ERROR")
mass_step, time_step = Fraction(STEEPEST * 2**62 + 1, 2**64) + U, Fraction(3 * 2**62, 2**64) + U
steepest_time = max(box.greatest(box.slope(box.Extreme(corner, (0, 0, 0, 0)).t)) for corner in box.corners())
ends = lambda wobble, step, error: wobble + step < 2 * error + 1
proven(f"neighbouring places: a mass is measured with less than {float(WOBBLE + mass_step):.1f} between them, a way "
       f"with less than {float(TIME_WOBBLE + time_step):.2f}: less than twice the errors, {LEAST_ERROR} and "
       f"{LEAST_WAY_ERROR}; with one more bit of MASS_SHIFT it could be more",
       steepest_time == 3 and ends(WOBBLE, mass_step, LEAST_ERROR) and ends(TIME_WOBBLE, time_step, LEAST_WAY_ERROR),
       not ends(loses(6, MASS_SHIFT + 1, 1), mass_step, LEAST_ERROR))
bracket, halved = 2**64 - 1, 0
while bracket > 1:
    bracket, halved = -(-bracket // 2), halved + 1
proven(f"after {halved} halvings the bracket's ends are neighbours, and one of these was within the error: a search "
       f"takes at most {FREE_STEPS - 1 + halved} steps; MAX_STEPS would be {constant('MAX_STEPS')}",
       halved == 64 and FREE_STEPS - 1 + halved <= constant("MAX_STEPS"))

# --- The grid of fractions, in units of a mass, 2^-62, and the error of one; `cut` is that of time_units, for a = s
# 2^up in half steps of the grid.
GRID_BITS = 62 - constant("GRID")
ERROR_SHIFT, GRID = constant("ERROR_SHIFT"), 2**GRID_BITS
s, up = BitVec("s", 64), BitVec("up", 64)
cut = ((s << up) + 1) >> 1
is_multiple = lambda least: Implies(And(UGE(s, 1 << 23), ULT(s, 1 << 24), up >= least, up <= 24), cut << 1 == s << up)
require(-23 - 23 + constant("GRID") + 1 == 1, "a number from 2^-23 on has up >= 1")
valid(f"each f32 from 2^-23 to 1/2 is a multiple of the grid, 2^{GRID_BITS - 62}", is_multiple(1), is_multiple(0))

# What an answer is off by, in these units, for a fraction of 2^e to 2^(e+1). A coefficient is cut by less than
# 2^MASS_SHIFT. What joins are rounded by is within JOIN_OFF, all else within FRACTION_OFF of the fraction
# (certificate.py).
JOIN, SHARE = constant("JOIN_OFF") * 2**62, constant("FRACTION_OFF")
CUTS = 6 * 2**MASS_SHIFT
# A way's measuring, in fine units: the series; its three differences, each cut by 7 at most; and control times, each
# cut by less than a unit, which is two fine ones at most, or they are exact. A fine unit's mass: the openness is at
# most the ramp's greatest control value, of which the area is LEAST_AREA, and an interval has 2^61 fine units.
WAY = TIME_WOBBLE + 3 * (2**WAY_SHIFT - 1) + 2
require(WAY == WAY_OFF, "what a way is measured to")
PER_FINE = 2**62 / LEAST_AREA / 2**61


def answer(e, grid=GRID):
    """Of two neighbouring answers: how far the true masses of their places are apart; and what an answer is off by
    beside the rounding to the grid."""
    most = Fraction(2) ** (62 + e + 1)
    error = most / 2**ERROR_SHIFT + LEAST_ERROR
    # Of two series, from either end of a ramp, each is low, and cut in its own way.
    off = error + WOBBLE + CUTS + SHARE * most
    return max(grid, most / 2**24) - 2 * off, off + JOIN + WAY * PER_FINE


BINADES = range(-62, -1)
gap = lambda grid: min(answer(e, grid)[0] for e in BINADES) / PER_FINE
proven(f"two searches for neighbouring fractions: true masses of their places are 2^{log2(gap(GRID) * PER_FINE):.2f} "
       f"units apart or more, so their ways {float(gap(GRID)):.0f} fine units, measured to {WAY}; with a grid of "
       f"2^{GRID_BITS - 63} not so",
       gap(GRID) > WAY and not gap(GRID / 2) > WAY)
start, end = Ints("start end")
way, rest = Reals("way rest")
inside = lambda way: If(ToInt(way) < 0, 0, If(ToInt(way) < end - start, ToInt(way), end - start))
in_order = lambda gap: Implies(And(start <= end, way + rest <= end - start + gap),
                               start + inside(way) <= end - inside(rest))
valid("time_of_mass: a time from a ramp's start is not after one from its end, if the ways, measured low, are in "
      "order; neither is beyond an end",
      in_order(0), in_order(1))
polynomial, found, exact, x = *Ints("polynomial found"), *Reals("exact x")
above = lambda by: Implies(And(exact - x - 1 < found, found < polynomial, x >= 0), exact < polynomial + by)
valid("a searched time that is before a polynomial's, in whole units, was before it but for what measuring it is off "
      "by: whole units cost nothing",
      above(x), above(x - Q(1, 10)))

# --- What an answer collects. A unit may cross the middle of two f32. If units are more than 2 fine ones, the greatest
# time is more than twice the interval, so f32 inside are 2^37 units apart, and a way to a middle has 2^36: then a
# unit's mass is that share of OPEN_WAY times the mass. On the plateau it is that share, and a way is low by 3 units.
OPEN_WAY = 22
proven(f"openness times the way since an end is at most {OPEN_WAY} times the mass",
       box.tight(OPEN_WAY, lambda r: box.times(r.t, r.f), lambda r: r.m, box.extremes()))
crossed = lambda e: max(Fraction(OPEN_WAY, 2**36) * 2 ** (62 + e + 1), 2 * PER_FINE)
backward = lambda e: answer(e)[1] + crossed(e) + (GRID / 2 if e < -23 else 0)
ulp = lambda e: Fraction(2) ** (62 + e - 23)
above, below = max(backward(e) / ulp(e) for e in BINADES if e >= -23), max(backward(e) for e in BINADES if e < -23)
proven(f"inverse_cdf by a search: backward error at most {float(above):.3f} ulp of a fraction from 2^-23 on, and 2^"
       f"{log2(below / 2**62):.2f} of the exposure below: promised are {float(constant('BACKWARD'))} ulp, or 2^-46",
       above < constant("BACKWARD") and GRID / 2 < below < GRID)
# A polynomial's exposure is within ULP_ERROR, with the unit by which its own end is cut.
own, by_search = constant("ULP_ERROR") * (1 + BOUND_OFF), max(answer(e)[1] / ulp(e) for e in BINADES if e >= -23)
proven(f"with one unit in its certificate a polynomial beside another takes {float(2 * own)} ulp of exposure, beside a "
       f"search {float(own + by_search):.3f}; the plateau's line beside either at most {float(own + U * 2**18):.3f}",
       own < constant("BACKWARD") and 2 * own < 1 and own + by_search < 1 and by_search + U * 2**18 < own,
       constant("UNITS_OFF") == 1)

# --- The cdf. A place's way is within the error; neighbouring times are 2^-24 of themselves apart, or a unit.
TRACE = 2**15  # the ulp of 2^-24
back = 2 * LEAST_WAY_ERROR + WAY
fall = WOBBLE + CUTS + back * PER_FINE
is_back = lambda t: 2 * (t / 2**TIME_SHIFT + LEAST_WAY_ERROR) + WAY - t / 2**24 > back
proven(f"cdf: a later time's place is at most {back} fine units earlier, its mass at most 2^{log2(fall):.2f} units and "
       "2^-35 of itself less: so its f32 by one ulp of at least that of 2^-24",
       not any(is_back(Fraction(2) ** k) for k in range(63)) and 2 * SHARE <= Fraction(1, 2**35),
       fall + 2 * SHARE * TRACE * 2**24 < TRACE < 4 * fall)
moved, value = Fraction(LEAST_WAY_ERROR + WAY + 2, 2**61), (WOBBLE + CUTS + JOIN) / TRACE
proven(f"cdf on a ramp: within {float(value + Fraction(1, 2)):.3f} ulp, of at least that of 2^-24, of the exact one at "
       f"a time within 1/{2 ** (TIME_SHIFT - 24)} ulp and 2^{log2(moved):.2f} of the interval",
       value + SHARE * 2**24 + Fraction(1, 2) < 1 and moved < Fraction(1, 2**54))
# On the plateau the area has 2^k to 2^(k+1) units, and the way to a time moves up by 61 - k, or one more for 2^k. Its
# two ends are cut to units, one over the area has three roundings, and the product, low by less than 3, counts twice.
ks = range(int(log2(2**61 * constant("LEAST_INTERVAL") * LEAST_AREA)), 62)
shifts, value = [61 - k + more for k in ks for more in (0, 1)], (2 * 2 * PER_FINE + 2 * 3 + JOIN) / TRACE
beyond = max(value * TRACE + 4 * U64 * 2**62, CUTS)
proven(f"cdf on the plateau: within {float(value + Fraction(1, 2)):.3f} such ulp; a way moves up by {min(shifts)} to "
       f"{max(shifts)} bits, so that it has 62 at most; no part has 2^{log2(beyond):.2f} units more than its share",
       min(shifts) == 0 and max(shifts) < 32 and value + 4 * U64 * 2**24 + Fraction(1, 2) < 1 and beyond < TRACE / 2)

# --- The first guess: bits taken as logarithms, and their quotients. 4 x R / 2^32 is x R / 2^30, linear in x.
LOG_ONE, a, b = constant("LOG_ONE"), *BitVecs("a b", 32)
log_a, log_b = (a >> 3) - 127 * LOG_ONE, (b >> 3) - 127 * LOG_ONE
wide = SignExt(32, log_a) - SignExt(32, log_b)
fits = And(SignExt(32, log_a - log_b) == wide, SignExt(32, (log_a - log_b) << 2) == wide << 2)
valid("guess: four times a difference of two logarithms, of any f32 and NaN, fits its word", fits, wide < (1 << 29) - 1)
reciprocals = eval(re.sub(r"(\d+) << (\d+)", r"(\1 << \2)", text_of("RECIPROCALS")))
off = {k: (Fraction(reciprocals[k], 2**30) - Fraction(1, k)) * 2**29 for k in range(1, 7)}
proven("divided: x / k rounded down for k = 1, 2, 4, and within 4/3 for 3, 5, 6, for all logarithms",
       all(0 <= most <= Fraction(1, 3) for most in off.values()) and all(off[k] == 0 for k in (1, 2, 4)))
