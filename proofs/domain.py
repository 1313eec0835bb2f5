"""What the rules of src/domain.rs leave: how fast time passes on a ramp, its least area, and how great numbers are."""

from box import *

pinned("""
domain.rs check f6cb7d9f check_section b2af6dd3 check_points 843de3a2
exposure.rs Exposure::new 3f1397a4
inverse.rs Inverse::new 182aa4cc last_before_line e915c97a
number/units.rs mass_exponent 8d1444af time_exponent 96eb982d ramp_exponent bb4367a6 fixed_down 12e34aed
    fixed_towards_0 c6a6eaa3
ramp/mod.rs openness cf44a862
ramp/shape.rs powers 91a002ae exposure_powers 6be3a531 area 6e0daa9d
""")

# Rule 2. `t'` is at least 3 p^2 next to the start, as much next to the end, and SLOWEST between.
SLOWEST, NEXT_TO_END = Fraction(45, 976), Fraction(1, 8)
DARK = (0, 0, 0, 0)


def passes(slowest, crossed=CROSSED):
    slopes = [slope(Extreme(corner, DARK).t) for corner in corners(crossed)]
    parts = [Fraction(k, 256) for k in range(32, 225)]
    return all(
        least([a - b for a, b in zip(t, [0, 0, 3])], Fraction(0), NEXT_TO_END) >= 0
        and all(least(t, x, y) >= slowest for x, y in zip(parts, parts[1:]))
        for t in slopes
    )


vertex = slope(Extreme((ONE, 1 - CROSSED), DARK).t)
proven("t' is at least 3 p^2 and 3 (1 - p)^2 within 1/8 of an end, and between them 45/976 of its mean, more than "
       "1/22; at one place it is no more",
       at(vertex, -vertex[1] / (2 * vertex[2])) == SLOWEST > Fraction(1, 22),
       passes(SLOWEST * Fraction(99, 100)) and not passes(SLOWEST * Fraction(101, 100)),
       not passes(Fraction(1, 22), CROSSED + Fraction(1, 200)))
proven("openness is a mean of its control values, so from 0 to 1",
       all(at(w, Fraction(1, 2)) > 0 for w in WEIGHTS) and plus(*WEIGHTS) == [1, 0, 0, 0])

# Rules 2 and 3. The area is least where all but the last control value are 0.
LEAST_AREA = min(sum(ramp.m) for ramp in times_only())
proven("a ramp whose greatest control value is 1 has at least 1/20 of the exposure that its length would have fully "
       "open: one of f = p^3 with both inner times at its end has so much",
       LEAST_AREA == Fraction(1, 20) and all(sum(ramp.m) >= LEAST_AREA for ramp in extremes()))

# Rules 4 to 6, for a greatest |time| of 1. A time counts at most 2^62 units and a greatest one at least 2^61.
interval, section, density = constant("LEAST_INTERVAL"), constant("LEAST_SECTION"), constant("LEAST_EXPOSURE")
share = LEAST_AREA * section / 2
proven(f"the share of a ramp or a plateau is 0 or at least 2^{log2(share):.2f}, so 2^-30: the exposure is at most "
       "twice the greatest |time|",
       Fraction(1, 2**30) < share < Fraction(1, 2**29))
units = 2**61 * interval * LEAST_AREA
# A base is off by less than a unit either way, the line's end by less than 2 down; then the way is rounded down. An
# area has up to 60 roundings of an f64, of terms that are `terms` times as great at most.
terms = max(sum(sizes(ramp.m)) / sum(ramp.m) for ramp in extremes(OPEN))
line = 3 + units * 60 * terms * U64
ulp = constant("FINE") / 2**23
proven(f"the plateau's line has at least 2^{log2(units):.2f} units of area, and is off by at most {float(line):.2f} "
       f"units: 2^{log2(line / ulp / units):.2f} ulp of the least u on it",
       2**40 < units < 2**41 and ulp * units / 2**8 < line < ulp * units / 2**6)
longest = constant("DOUBLE_WORD")
# The greatest |time|, or the interval if that is more, has 2^61 to 2^62 units.
way, units = log2(section / longest / 2) - 64, [log2(1 / longest) - 61, log2(longest / interval) - 61]
proven(f"an area is from 2^{log2(density / longest):g} to 2^64, so it and its reciprocal are normal f32; a way on a "
       f"ramp counts in 2^{way:g} or more, a time in 2^{units[0]:g} to 2^{units[1]:g}",
       density / longest > Fraction(1, 2**126) and min(density, LEAST_AREA) == density,
       way >= -252 and units[0] >= -125 and units[1] + 32 < 127)

# Terms without their signs, at each place of any ramp.
ramps = extremes()
for what, number, left, right, on in (
    ("mass", MASS_TERMS, lambda r: sizes(r.m), lambda r: r.m, ramps),
    ("time", TIME_TERMS, lambda r: sizes(r.t), lambda r: r.t, times_only()),
):
    claim = f"the terms of a {what} since an end, without their signs, are at most {number} times the {what}"
    proven(claim, tight(number, left, right, on, less=Fraction(9, 10)))
# The openness counts from the end that is nearer in time. Pairs round it by far less than 2^-10 of its terms.
proven("the terms of an openness up to half of a ramp's time, without their signs, are at most 1024 times the "
       "openness: so none is measured below 0",
       tight(1024, lambda r: sizes(r.f), lambda r: r.f, ramps, half_time))
