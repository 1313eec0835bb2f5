"""Every ramp that rule 2 accepts, at once: an inequality that holds of a few extreme ramps holds of all.

A ramp counts from 0 to 1 in place and in time. Its inner times lie in a polygon with five corners (rule 2), its control
openness `f` in [0, 1]. An inequality's right here is linear in each of the times and `f`, its left, a sum of sizes,
convex in each. So it holds everywhere if it holds at each corner, for each of a few `f` of which all others are sums
with factors from 0 up. There both sides are polynomials of the place.
"""

from math import comb

from common import *

CROSSED = constant("MOST_CROSSED")
ONE = Fraction(1)


def corners(crossed=CROSSED):
    return [(0 * ONE, 0 * ONE), (0 * ONE, ONE), (ONE, ONE), (ONE, 1 - crossed), (crossed, 0 * ONE)]


def plus(*polynomials):
    return [sum(p[k] for p in polynomials if k < len(p)) for k in range(max(map(len, polynomials)))]


def times(p, q):
    out = [0 * ONE] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            out[i + j] += x * y
    return out


by = lambda p, factor: [factor * c for c in p]
slope = lambda p: [k * c for k, c in enumerate(p)][1:]
integral = lambda p: [0 * ONE] + [c / (k + 1) for k, c in enumerate(p)]
sizes = lambda p: [abs(c) for c in p]
at = lambda p, x: sum(c * x**k for k, c in enumerate(p))
order = lambda p: next(k for k, c in enumerate(p) if c != 0)
# Bernstein's polynomials of degree 3.
weight = lambda k: [0 * ONE] * k + [ONE * comb(3, k) * comb(3 - k, j) * (-1) ** j for j in range(4 - k)]
WEIGHTS = [weight(k) for k in range(4)]
SINGLE = [tuple(int(i == k) for i in range(4)) for k in range(4)]
# With openness 1 at the last place: what rule 3 says of the end that meets the plateau.
OPEN = [(i, j, k, 1) for i in (0, 1) for j in (0, 1) for k in (0, 1)]


class Extreme:
    """A ramp: its time `t`, openness `f` and mass `m` as polynomials of the place."""

    def __init__(self, corner, f):
        a, b = corner
        self.t = plus(by(WEIGHTS[1], a), by(WEIGHTS[2], b), WEIGHTS[3])
        self.f = plus(*(by(w, c * ONE) for w, c in zip(WEIGHTS, f)))
        self.m = integral(times(self.f, slope(self.t)))


def extremes(of_f=SINGLE, crossed=CROSSED):
    return [Extreme(corner, f) for corner in corners(crossed) for f in of_f]


def least(p, start, end):
    """A lower bound of a polynomial between two places: its least Bernstein coefficient there."""
    moved, n = list(p), len(p) - 1
    for k in range(n):
        for j in range(n - 1, k - 1, -1):
            moved[j] += start * moved[j + 1]
    moved = [c * (end - start) ** k for k, c in enumerate(moved)]
    return min(sum(Fraction(comb(i, k), comb(n, k)) * moved[k] for k in range(i + 1)) for i in range(n + 1))


def holds(factor, left, right, ramps, until=None, parts=128):
    """Is left(ramp) <= factor * right(ramp) at all places? `left` has no negative coefficient.

    If `until` is given, only where until(ramp) <= 0, which rises: some multiple of it, one for all ramps, may be added
    on the right.
    """
    sides = []
    for ramp in ramps:
        l, r = left(ramp), right(ramp)
        low = order(l) if any(l) else 0
        require(order(r) <= low, "a right side that vanishes faster")
        sides.append((l, r, order(r), until(ramp) if until else None))
    for part in range(parts):
        x, y = Fraction(part, parts), Fraction(part + 1, parts)
        lower, upper = Fraction(0), None
        for l, r, low, u in sides:
            lacks = at(l[low:], y) - factor * least(r[low:], x, y)
            if u is None:
                if lacks > 0:
                    return False
                continue
            lacks *= y**low if lacks > 0 else x**low
            value = at(u, x)
            if value > 0:
                lower = max(lower, lacks / value)
            elif lacks > 0:
                return False
            elif value < 0:
                upper = lacks / value if upper is None else min(upper, lacks / value)
        if upper is not None and lower > upper:
            return False
    return True


def tight(factor, left, right, ramps, until=None, less=Fraction(1, 2)):
    """Does it hold, and not for so much less of the factor?"""
    return holds(factor, left, right, ramps, until) and not holds(factor * less, left, right, ramps, until)


# Of a ramp counted from its start: not more than 51 of 100 parts of the mass are before the place.
SHARE = Fraction(51, 100)
before_half = lambda r: plus(r.m, [-SHARE * sum(r.m)])
# The same of its time; and the ramps that differ in that alone.
half_time = lambda r: plus(r.t, [-SHARE])
times_only = lambda: [Extreme(corner, (0, 0, 0, 1)) for corner in corners()]
