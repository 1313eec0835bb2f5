"""The numbers and inequalities of an octave's certificate, by exact fractions and z3.

Taken as known: on [-1, 1] a polynomial of degree n < N is at most 1 / cos(n pi / 2N) times its greatest value at the
points cos(i pi / N) (Ehlich and Zeller 1964), and |p'| <= n^2 max |p| (Markov 1889).

Of all of octave/bound.rs and certificate.rs, `Path::stretch`, `Span::new` and `Curve::join_fractions`.
"""

import math
import struct

from z3 import *

from common import *

DEGREE, POINTS = constant("DEGREE"), constant("POINTS")
ONE, COSINE = int(constant("S_ONE")), constant("COSINE")
single = lambda text: Fraction(struct.unpack("f", struct.pack("f", float(text)))[0])
FACTOR = {1: single(text_of("FACTOR_OF_ALL")), 2: single(text_of("FACTOR_OF_HALF"))}
# --- Cosines, by `libm` to 2^-50, where 2^-40 would do.
cosine = lambda half_turns: Fraction(math.cos(math.pi * half_turns))


def off_table(first):
    """By how much the table is off, as the recurrence makes it in doubles."""
    off, s, last = Fraction(0), 1.0, first
    for i in range(POINTS // 2 + 1):
        off = max(off, abs(Fraction(int(s * ONE + 0.5), ONE) - cosine(i / POINTS)))
        s, last = 2.0 * first * s - last, s
    return off


off = off_table(float(COSINE))
proven(f"the table's {POINTS // 2 + 1} cosines are within 2^{log2(off):.2f}",
       off <= Fraction(1, 2 * ONE) * (1 + Fraction(1, 2**10)) and off_table(float(COSINE) * (1 - 2.0**-40)) > off * 2)

# --- The degree of R, an offset's times the octave's, and of R times the openness. So the factor.
n = 6 * DEGREE + 3
exact = {stride: 1 / cosine(n * stride / (2 * POINTS)) for stride in (1, 2)}
factor_off = max(abs(FACTOR[stride] / exact[stride] - 1) for stride in exact) / U
proven(f"R times the openness has degree {n}, and a FACTOR is 1 / cos({n} pi / 2N) for N = {POINTS // 2} and {POINTS}, "
       f"to {float(factor_off):.2f} roundings",
       n == 51 and n < POINTS // 2 and factor_off <= 1,
       # A degree of 50 would not do.
       abs(FACTOR[2] * cosine((n - 1) / POINTS) - 1) > 2**16 * U)
# Samples are off their points, and so is a sample by Markov: max |p| <= F (seen + off n^2 max |p|). Roundings of 2^-24:
# a sample's two words and their sum, its product with a weight, which has two of its own, the sum with the noise, that
# by FACTOR, and what FACTOR is off. The noise has at most 14 of its own; and at most 20 more lead to a bound's limit.
spoilt = (1 / (1 - exact[2] * off * n**2) - 1) / U
roundings = spoilt + max(2 + 1 + 2, 14) + 1 + 1 + factor_off + 20
room = lambda share: (1 + share) * (1 - U) ** (int(roundings) + 1) >= 1
proven(f"a bound over its limit is too small by less than 2^-16, {float(BOUND_OFF / U):g} roundings of 2^-24: by "
       f"{float(spoilt):.1f}, as samples are off their points, and by {float(roundings - spoilt):g} roundings",
       room(BOUND_OFF) and not room(BOUND_OFF / 8))

# --- What samples lose in integers: a coefficient less than a unit as it is cut, and so each product as it is rounded
# down; |s| is at most 1, so nothing that is lost grows.
a, b = Ints("a b")
require_valid("the product by words", (a * 2**32 + b) / 2**30 == 4 * a + b / 2**30)
lost = Fraction(4 + 3, 2 ** constant("TIME_BITS"))
position, allowed = Fraction(1, 2) + Fraction(7 + 6, 2 ** constant("POSITION_BITS")), Fraction("0.5002")
proven(f"samples in integers: a time is off by at most SAMPLE_OFF = 2^{log2(lost):.2f} lsb, a position by 1/2 and "
       f"2^{log2(position - Fraction(1, 2)):.1f}; none is beyond 63 bits",
       constant("SAMPLE_OFF") == lost and position <= allowed < Fraction(1001, 2000),
       7 * (2**60 + 1) < 2**63 and ONE == 2**30)
# A weight by Horner's rule, for each coefficient: products, sums, and the place, rounded, in each product; and its own.
# The constant is at most the weight and the others: so its two are two of the weight, and two of each other.
HORNER = [2 * k + min(k + 1, 3) + 1 for k in range(4)]
weight_off = max(Fraction(HORNER[k] + HORNER[0], k) for k in (1, 2, 3)) * Fraction(1001, 1000) * U

# --- What a fraction and a time may be off by, with 60 and 9 roundings of an f64, as many as were counted.
join_off, fraction_off, time_off = (constant(f"{name}_OFF") for name in ("JOIN", "FRACTION", "TIME"))
proven(f"60 roundings of an f64 in terms {MASS_TERMS} times as great are at most FRACTION_OFF, 9 in terms "
       f"{TIME_TERMS} times as great at most TIME_OFF",
       MASS_TERMS * 60 * U64 <= fraction_off < 8 * MASS_TERMS * 60 * U64,
       TIME_TERMS * 9 * U64 <= time_off < 2 * TIME_TERMS * 9 * U64)
least, ulp_error = constant("LEAST_TOP") / 2, constant("ULP_ERROR")
# Joins, given the ramps' masses. A near share is a quotient, cut to 2^-62, and a double again; the far ramp begins
# where its share is missing: the area has two roundings, and the quotient one of half of 2^-53.
near, cut = 2 * U64, Fraction(1, 2**62)
far = Fraction(5, 2) * U64 + cut
proven("what rounds joins is within JOIN_OFF and FRACTION_OFF of itself; half of JOIN_OFF would not do next to a ramp "
       "with nearly all",
       near + cut / least < fraction_off and U64 < fraction_off and join_off / 2 < far < join_off)

# --- How far a stretch goes in which so much time passes.
t1, t2, t3, s, start, d = Reals("t1 t2 t3 s start d")
parabola = lambda s: t1 + 2 * t2 * s + 3 * t3 * s * s
size, inside = If(t2 < 0, -t2, t2), And(s >= -1, s <= 1)
vertex, at_end = And(inside, 3 * t3 > size), t1 + 3 * t3 - 2 * size
# Written without a quotient: thrice (t1 - t2^2 / thrice) = thrice t1 - t2^2.
vertex_bound = lambda part: Implies(vertex, 3 * t3 * parabola(s) >= 3 * t3 * t1 - t2 * t2 * part)
valid("slowest is at most the least t' on [-1, 1], with its vertex there", vertex_bound(1), vertex_bound(Q(99, 100)))
end_bound = lambda most, more: Implies(And(inside, most * t3 <= size), parabola(s) >= at_end + more)
valid("and without it", end_bound(3, 0), end_bound(3, size / 100), end_bound(2, 0))
# From `start` to start + d the time is d t'(m) + t3 d^3 / 4 about the middle m, and t'(m) is not negative.
m, end = start + d / 2, start + d
passed = t1 * d + t2 * (end * end - start * start) + t3 * (end * end * end - start * start * start)
about = d * parabola(m) + t3 * d * d * d / 4
require(simplify(passed - about, som=True).eq(RealVal(0)), "the time about the middle")
takes = lambda q: Implies(And(d > 0, d <= 2, parabola(m) >= 0), q * about >= t3 * d * d * d)
valid("a way of d takes at least t3 d^3 / 4, as t' is not negative in its middle", takes(4), takes(Q(399, 100)))
# On a way of d light grows beyond its first weight by `steepest` times the mean of s over the time that passes, `took`.
# By parts that is d took - (integral of t ds), where t, since the start, is at least slowest s, and t3 s^3 / 4.
run, took, slowest, part = Reals("run took slowest part")
enough = And(took > 0, run > 0, d > 0, slowest * run >= took)
mean = lambda most: Implies(enough, d * took - slowest * d * d / 2 <= most * run * took)
valid("the mean of s on a way is at most half a run, where that is by slowest", mean(Q(1, 2)), mean(Q(49, 100)))
# With d = 1, took = 1, and t3 / 4 a part of that.
enough = And(part > 0, part <= 1, run > 0, part * run * run * run >= 1)
mean = lambda most: Implies(enough, 1 - part / 4 <= most * run)
valid("and at most 3/4, where it is by t3", mean(Q(3, 4)), mean(Q(74, 100)))
# Coefficients of a sample's time are below 2^60 of its units. More than rounding adds took place, and s is at most 2.
slow_off = 8 * U64 * (1 + 2 + 3) * 2 ** (60 - constant("TIME_BITS")) * 2 / constant("HALF_TRUNCATION")
rest = (Fraction(1, 4) - slow_off) * constant("LEAST_RUN")
proven(f"the rest of a run has room for 8 roundings of slowest, 2^{log2(slow_off):.1f} of what took place, and for the "
       f"{float(weight_off / U):.2f} roundings of an openness at a sample; half of LEAST_RUN would not; on a run of 2 "
       "they are four of it", rest / 2 < weight_off < rest and weight_off / 2 < 4 * U)

# --- A way that leaves the ramp by its join, where the stretch does not reach that, has to collect what the stretch has
# more than the part: 4 ulp, EPSILON of the power of two, of which the ends, the middle and its sum with the half lose a
# half each by rounding, the half next to nothing, and `off` as much as is below.
more = 4 - Fraction(3, 2) - 4 * U - (join_off / (2 * least) + 2 * fraction_off) * 2**23
proven(f"is_joined wherever a way may leave the ramp by its join: else it would collect {float(more):.2f} ulp until "
       f"the stretch ends, and {float(ulp_error)} are allowed",
       more > 4 * ulp_error)
