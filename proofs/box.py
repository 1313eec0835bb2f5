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

    def from_end(self):
        """The coefficients of the mass since the other end."""
        of = lambda k: [0, *(ONE * comb(k, j) * (-1) ** (j + 1) for j in range(1, k + 1))]
        return plus(*(by(of(k), c) for k, c in enumerate(self.m)))


def extremes(of_f=SINGLE, crossed=CROSSED):
    return [Extreme(corner, f) for corner in corners(crossed) for f in of_f]


def least(p, start=Fraction(0), end=ONE):
    """A lower bound of a polynomial between two places: its least Bernstein coefficient there."""
    moved, n = list(p), len(p) - 1
    for k in range(n):
        for j in range(n - 1, k - 1, -1):
            moved[j] += start * moved[j + 1]
    moved = [c * (end - start) ** k for k, c in enumerate(moved)]
    return min(sum(Fraction(comb(i, k), comb(n, k)) * moved[k] for k in range(i + 1)) for i in range(n + 1))


greatest = lambda p, start=Fraction(0), end=ONE: -least(by(p, -1), start, end)


def holds(factor, left, right, ramps, parts=128):
    """Is left(ramp) <= factor * right(ramp) at all places?"""
    for ramp in ramps:
        l, r = left(ramp), right(ramp)
        low = order(r)
        require(low <= (order(l) if any(l) else low), "a right side that vanishes faster")
        for part in range(parts):
            x, y = Fraction(part, parts), Fraction(part + 1, parts)
            if greatest(l[low:], x, y) > factor * least(r[low:], x, y):
                return False
    return True


def tight(factor, left, right, ramps, less=Fraction(9, 10)):
    """Does it hold, and not for so much less of the factor?"""
    return holds(factor, left, right, ramps) and not holds(factor * less, left, right, ramps)
