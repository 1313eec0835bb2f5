"""What the rules of src/domain.rs leave: how fast time passes on a ramp, its least area, and how great numbers are."""

from box import *

pinned("""
domain.rs check f6cb7d9f check_section b2af6dd3 check_points 843de3a2
exposure.rs Exposure::new 3f1397a4
inverse.rs Inverse::new 182aa4cc last_before_line e915c97a
number/units.rs mass_exponent 8d1444af time_exponent 96eb982d ramp_exponent bb4367a6 fixed_down 12e34aed fixed_towards_0 c6a6eaa3
ramp/mod.rs openness cf44a862
ramp/shape.rs powers 91a002ae exposure_powers 6be3a531 area 6e0daa9d
""")

# Rule 2. `t'` is at least 3 p^2 next to the start, as much next to the end, and SLOWEST between.
SLOWEST, NEXT_TO_END = Fraction(45, 976), Fraction(1, 8)


def passes(slowest, crossed=CROSSED):
    ramps = [Extreme(corner, (0, 0, 0, 0)) for corner in corners(crossed)]
    near = lambda ramp: least([a - b for a, b in zip(slope(ramp.t), [0, 0, 3])], Fraction(0), NEXT_TO_END) >= 0
    parts = [Fraction(k, 256) for k in range(32, 225)]
    between = lambda ramp: all(least(slope(ramp.t), x, y) >= slowest for x, y in zip(parts, parts[1:]))
    return all(near(ramp) and between(ramp) for ramp in ramps)


vertex = slope(Extreme((ONE, 1 - CROSSED), (0, 0, 0, 0)).t)
require(at(vertex, -vertex[1] / (2 * vertex[2])) == SLOWEST > Fraction(1, 22), "the least t'")
require(passes(SLOWEST * Fraction(99, 100)) and not passes(SLOWEST * Fraction(101, 100)), "t'")
require(not passes(Fraction(1, 22), CROSSED + Fraction(1, 200)), "a greater MOST_CROSSED would do")
proven(f"t' is at least 3 p^2 and 3 (1 - p)^2 within 1/8 of an end, and between them 45/976 of its mean, more than 1/22; at one place it is no more")
require(all(at(w, Fraction(1, 2)) > 0 for w in WEIGHTS) and plus(*WEIGHTS) == [1, 0, 0, 0], "weights")
proven("openness is a mean of its control values, so from 0 to 1")

# Rules 2 and 3. The area is least where all but the last control value are 0.
areas = [sum(Extreme(corner, (0, 0, 0, 1)).m) for corner in corners()]
LEAST_AREA = min(areas)
require(LEAST_AREA == Fraction(1, 20), "the least area")
require(all(sum(ramp.m) >= LEAST_AREA for ramp in extremes()), "the area by any control value")
proven("a ramp whose greatest control value is 1 has at least 1/20 of the exposure that its length would have fully open: one of f = p^3 with both inner times at its end has so much")

# Rules 4 to 6, for a greatest |time| of 1. A time counts at most 2^62 units and a greatest one at least 2^61.
interval, section, density = constant("LEAST_INTERVAL"), constant("LEAST_SECTION"), constant("LEAST_EXPOSURE")
share = LEAST_AREA * section / 2
require(Fraction(1, 2**30) < share < Fraction(1, 2**29), "shares")
proven(f"the share of a ramp or a plateau is 0 or at least 2^{log2(share):.2f}, so 2^-30: the exposure is at most twice the greatest |time|")
units = 2**61 * interval * LEAST_AREA
require(2**40 < units < 2**41, "the line's area")
# A base is off by less than a unit either way, as a time is rounded down and an area towards 0; the line's end by less than 2 down. Then
# the way is rounded down. An area has up to 60 roundings of an f64, of terms that are `terms` times as great at most.
terms = max(sum(sizes(ramp.m)) / sum(ramp.m) for ramp in extremes(OPEN))
line = 3 + units * 60 * terms * U64
ulp = constant("FINE") / 2**23
require(line < ulp * units / 2**6 and line > ulp * units / 2**8, "the line")
proven(f"the plateau's line has at least 2^{log2(units):.2f} units of area, and is off by at most {float(line):.2f} units: 2^{log2(line / ulp / units):.2f} ulp of the least u on it")
longest = constant("DOUBLE_WORD")
require(density / longest > Fraction(1, 2**126) and min(density, LEAST_AREA) == density, "areas")
# The greatest |time|, or the interval if that is more, has 2^61 to 2^62 units.
least_ramp, units = section / longest / 2, [log2(1 / longest) - 61, log2(longest / interval) - 61]
require(log2(least_ramp) - 64 >= -252 and units[0] >= -125 and units[1] + 32 < 127, "units")
proven(f"an area is from 2^{log2(density / longest):g} to 2^64, so it and its reciprocal are normal f32; a way on a ramp counts in 2^{log2(least_ramp) - 64:g} or more, a time in 2^{units[0]:g} to 2^{units[1]:g}")

# Terms without their signs, at each place of any ramp.
ramps, times_only = extremes(), [Extreme(corner, (0, 0, 0, 1)) for corner in corners()]
for what, number, left, right, on in (
    ("mass", MASS_TERMS, lambda r: sizes(r.m), lambda r: r.m, ramps),
    ("time", TIME_TERMS, lambda r: sizes(r.t), lambda r: r.t, times_only),
):
    require(holds(number, left, right, on) and not holds(number * Fraction(9, 10), left, right, on), f"terms of a {what}")
    proven(f"the terms of a {what} since an end, without their signs, are at most {number} times the {what}")
# The openness counts from the end that is nearer in time. Pairs round it by far less than 2^-10 of its terms.
half_time = lambda r: plus(r.t, [-SHARE])
number, left, right = 1024, lambda r: sizes(r.f), lambda r: r.f
require(holds(number, left, right, ramps, half_time) and not holds(Fraction(number, 2), left, right, ramps, half_time), "terms of an openness")
proven(f"the terms of an openness up to half of a ramp's time, without their signs, are at most {number} times the openness: so none is measured below 0")
