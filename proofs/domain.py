"""What the rules of src/domain.rs leave: how fast time passes on a ramp, its least area, and how great numbers are.

Of `domain::check`, `Curve::new`, `Ramp::new` and `Shape::mass`.
"""

from box import *

# Rule 2. `t'` is at least 3 p^2 next to the start, as much next to the end, and SLOWEST between.
SLOWEST, NEXT_TO_END = Fraction(45, 976), Fraction(1, 8)


def passes(slowest, crossed=CROSSED):
    slopes = [slope(ramp.t) for ramp in extremes([(0, 0, 0, 0)], crossed)]
    parts = [Fraction(k, 256) for k in range(32, 225)]
    outer = all(least([a - b for a, b in zip(t, [0, 0, 3])], Fraction(0), NEXT_TO_END) >= 0 for t in slopes)
    return outer and all(least(t, x, y) >= slowest for x, y in zip(parts, parts[1:]) for t in slopes)


vertex = slope(Extreme((ONE, 1 - CROSSED), (0, 0, 0, 0)).t)
proven("t' is at least 3 p^2 and 3 (1 - p)^2 within 1/8 of an end, and between them 45/976 of its mean, more than "
       "1/22; at one place it is no more",
       at(vertex, -vertex[1] / (2 * vertex[2])) == SLOWEST > Fraction(1, 22),
       passes(SLOWEST * Fraction(99, 100)) and not passes(SLOWEST * Fraction(101, 100)),
       not passes(Fraction(1, 22), CROSSED + Fraction(1, 200)))
proven("openness is a mean of its control values, so at most the greatest of them",
       all(at(w, Fraction(1, 2)) > 0 for w in WEIGHTS) and plus(*WEIGHTS) == [1, 0, 0, 0])

# Rules 2 and 3. The area is a sum, over the control values, of at least this of each.
ramps, times_only = extremes(), [Extreme(corner, (0, 0, 0, 1)) for corner in corners()]
proven("a ramp has at least 1/20 of the exposure that its length would have at its greatest control value: one of f = "
       "p^3 with both inner times at its end has so much",
       min(sum(ramp.m) for ramp in times_only) == LEAST_AREA and all(sum(ramp.m) >= LEAST_AREA for ramp in ramps))

# Rules 4 to 6, for a greatest |time| of 1. A time counts at most 2^62 units and a greatest one at least 2^61.
interval, section, density = constant("LEAST_INTERVAL"), constant("LEAST_PART"), constant("LEAST_EXPOSURE")
share = LEAST_AREA * section / 2
proven(f"the share of a ramp or a plateau is 0 or at least 2^{log2(share):.2f}, so 2^-30: the exposure is at most "
       "twice the greatest |time|",
       Fraction(1, 2**30) < share < Fraction(1, 2**29))
units = 2**61 * interval * LEAST_AREA
# A base is off by less than a unit either way, the line's end by less than 2 down; then the way is rounded down. An
# area has up to 60 roundings of an f64, of terms that are `terms` times as great at most.
terms = max(sum(sizes(ramp.m)) / sum(ramp.m) for ramp in extremes(OPEN))
line = 3 + units * 60 * terms * U64
ulp = constant("LINE_FROM") / 2**23
proven(f"the plateau's line has at least 2^{log2(units):.2f} units of area, and is off by at most {float(line):.2f} "
       f"units: 2^{log2(line / ulp / units):.2f} ulp of the least u on it",
       2**40 < units < 2**41 and ulp * units / 2**8 < line < ulp * units / 2**6)
longest = constant("DOUBLE_WORD")
# The greatest |time|, or the interval if that is more, has 2^61 to 2^62 units.
units = [log2(1 / longest) - 61, log2(longest / interval) - 61]
proven(f"an area is from 2^{log2(density / longest):g} to 2^64, so it and its reciprocal are normal f32; a time counts "
       f"in 2^{units[0]:g} to 2^{units[1]:g}",
       density / longest > Fraction(1, 2**126) and min(density, LEAST_AREA) == density,
       units[0] >= -125 and units[1] + 32 < 127)

# Terms without their signs, at each place of any ramp; and of a mass from both ends, at the other end.
for what, number, left, right, on in (
    ("mass", MASS_TERMS, lambda r: sizes(r.m), lambda r: r.m, ramps),
    ("time", TIME_TERMS, lambda r: sizes(r.t), lambda r: r.t, times_only),
):
    proven(f"the terms of a {what} since an end, without their signs, are at most {number} times the {what}",
           tight(number, left, right, on))
MASS_SHIFT = constant("MASS_SHIFT")
most = max(sum(sizes(c)) / sum(r.m) for r in ramps for c in (r.m, r.from_end()))
proven(f"those since either end are at most {float(most)} times the ramp's share: so a coefficient, and Horner's sums, "
       f"are below 2^62 units of 2^{MASS_SHIFT}",
       2**(MASS_SHIFT - 1) < most < 2**MASS_SHIFT - 1)
proven(f"a mass grows at most {STEEPEST} times as fast, along the place, as on average",
       tight(STEEPEST, lambda r: slope(r.m), lambda r: [sum(r.m)], ramps))
