"""That the cdf never steps back: times next to each other gain more mass than twice what measuring it is off by.

A mass is counted from the curve's start or end, whichever has less of it. `T` are the terms of a ramp's mass from that
end without their signs, `t` the ramp's time since then, of 1 in all, and `f` the openness. docs/internals/proofs.md has
the argument.
"""

from box import *
from short import *

pinned("""
cdf.rs section 1fab1d1e cdf_on_plateau df0503df cdf_on_ramp 1939d75a from_nearer_end ec452efd on_grid af670c35
    gridded 664f67ff
ramp/mod.rs at_time 08d4d20d place_of_time 3785d857 place_from 4b1484c7 fraction 885c8d04
number/pair.rs plus 557c4757 minus 18c7a5c1 over e34c0f49
number/units.rs mass_exponent 8d1444af
""")

# --- Times. Those from 0 on are 2^-24 of the time or more apart, and the way from the ramp's nearer end is at most the
# time. On a curve across 0, of which the farther end is from P to 2 P, times nearer to 0 than P / 2 are rounded by a
# sum from P / 4 to 5 P / 4, so to multiples of P / 2^25; a way is at most half of 4 P.
spacing, near, time_error = Fraction(1, 4) / 2**23, Fraction(1, 2), constant("TIME_ERROR")
proven("the time of a place is within a quarter of the distance to the next time; on a curve across time 0 that is "
       "2^-27 of the interval or more, else 2^-24 of the time",
       # What is on the grid is an f32, and times beyond lie no denser.
       near / spacing <= 2**24 and near / 2**23 >= spacing,
       time_error <= Fraction(1, 4) * U and time_error * 2 == spacing / 4 and spacing == Fraction(4) / 2**27)

# --- Masses, in 2^-48 of T: the value; a place from the ramp's other end, whose rest is rounded by 2^-48 of itself,
# with a slope of 6 T at most; the sum with what lies before, for a second number of (SECOND + 6) 2^-24; and 3 for
# coefficients and shares in pairs.
is_later = lambda corner, k: at(Extreme(corner, SINGLE[3]).t, Fraction(k + 1, 64)) > Fraction(1, 2)
middle = min(next(Fraction(k, 64) for k in range(64) if is_later(corner, k)) for corner in corners())
measured = (AT_PAIR[6] + 4 * 6 + 2 * (SECOND[6] + 6) + 3) * U * U
proven(f"a mass is measured to 2^{log2(measured):.2f} of T, so never below 0; a time nearer to a ramp's other end "
       "lies beyond 1/5 of the ramp",
       Fraction(1, 5) <= middle and measured < Fraction(1, 2**39) and measured * MASS_TERMS < 1)

T, rest = lambda r: sizes(r.m), lambda r: plus([ONE], by(r.t, -1))
# Next to the curve's end, so fully open where the ramp ends; or with at most half of a mass before the place, whatever
# is open at the ends.
BY_END, BY_HALF = (extremes(OPEN), None), (extremes(), before_half)
# What a mass may be of T: half of the distance, with a quarter lost on either side, is 2^-25 of the time, or 2^-28 of
# the interval.
by_time, across = U / 2 / (2 * measured), Fraction(1, 2**28) / (2 * measured)
for factor, right, (ramps, until), most, claim in (
    (128, lambda r: times(r.t, r.f), BY_END, by_time, "next to the counted end T is at most {} t f"),
    (128, lambda r: r.f, BY_END, min(by_time * Fraction(49, 50) / 40, across), "and at most {} f"),
    (256, lambda r: times(r.t, r.f), BY_HALF, by_time, "up to half of the mass T is at most {} t f"),
    (128, lambda r: r.f, BY_HALF, across, "and at most {} f"),
    (512, lambda r: times(rest(r), r.f), BY_HALF, by_time, "and at most {} (1 - t) f"),
):
    claim = f"{claim.format(factor)}; {float(most):.0f} would do"
    proven(claim, factor <= most and tight(factor, T, right, ramps, until))
# What lies before a far ramp, with its sums: 2 · 16 roundings of a pair, as a part of the time or 2^3 more of the
# interval. There f is at least 1 / DARK of the join's.
DARK = 64
before = 2 * 2 * 16 * U * U * 2**3 / (U / 2)
far = extremes([(1, *f[:3]) for f in OPEN])
proven(f"on a far ramp openness is at least 1/{DARK}, so what rounds the sums costs at most "
       f"2^{log2(before * DARK):.1f} of the distance",
       tight(DARK, lambda r: [ONE], lambda r: r.f, far, before_half, Fraction(1, 4)) and before * DARK < Fraction(1, 4))
plateau = 2 * (OVER + PLUS) * U * U / (Fraction(1, 2**28))
claim = f"on the plateau a mass is measured to 2^{log2(plateau):.1f} of the distance"
proven(claim, plateau < Fraction(1, 2**10))


# --- 1 less a mass from the end, by all values of p bits from 1/16 ulp of 1 to 1/2: in 2^-(4 p), with second numbers up
# to so many half ulps: one, as `Pair::sum` and `plus` leave them.
def keeps_order(p, halves):
    whole = np.int64(1) << (4 * p)
    found = []
    for e in range(2 * p - 3, 3 * p):
        hi = np.arange(2 ** (p - 1), 2**p, dtype=np.int64)[:, None] << e
        most = halves << e >> 1
        short = np.unique(np.arange(2**p, dtype=np.int64)[:, None] << np.arange(e + halves))
        lo = np.concatenate([-short[short <= most], short[short <= most]])[None, :]
        upper = rounded(whole - hi, p)
        answer = rounded(upper + rounded(whole - hi - upper - lo, p), p)
        found.append(np.stack([np.broadcast_to(hi + lo, answer.shape).ravel(), answer.ravel()]))
    masses, answers = np.concatenate(found, axis=1)
    order = np.lexsort((-answers, masses))
    return bool((np.diff(answers[order]) <= 0).all())


proven("1 less a mass keeps the order, as the mass's second number is at most half an ulp of the first: for all "
       "masses of 4 to 6 bits; with an ulp it would not",
       all(keeps_order(p, 1) for p in (4, 5, 6)) and not keeps_order(5, 2))
