"""The bound of what a step of the search leaves, term by term in exact fractions; and that a search ends.

`c` are the coefficients' numbers in single precision; the true ones differ by one rounding. The slopes on the way are
bounded by D, the sum of j |c_j| Y^(j-1) with Y = x + |s|. E is the sum of j |c_j| Y^(j-3) from the third on.
"""

import box
from majorant import *

pinned("""
search/mod.rs mirrored b10620d6 Taylor::new 0c068108 short_step 6d172d31 horner 827cf319 left 099b0969 solve 61dc59b9
    approach d85e9680
ramp/mod.rs place_of_part 011c54be place_of_time 3785d857
number/pair.rs difference c74b730c
""")

NEAR, FAR, MOVED = constant("ROUNDING_SAME"), constant("ROUNDING_OTHER"), constant("MOVED")
INVERSE_ERROR, TIME_ERROR = constant("INVERSE_ERROR"), constant("TIME_ERROR")
# In `left`.
CUBES, SQUARES = Fraction("3.4"), 5


class Degree:
    """The bounds of a search along a series of degree n: 6 for a mass, 3 for a time."""

    def __init__(self, n):
        self.n = n
        self.slopes = self.sums(lambda j: j, 1, 1)
        self.squares = self.sums(lambda j: j, 2, 2)
        self.cubes = self.sums(lambda j: j, 3, 3)
        # What the computed bound is at least, relative to the exact one: a few roundings more than its operations are
        # deep.
        self.deep = (1 - U) ** (2 * n + 8)
        self.count = ratio(by(self.first_terms(1).error, s=-1), self.slopes) / U
        # A distance that is wrong by m changes the slopes, between the places, by m times the greatest second
        # derivative.
        self.per_move = ratio(self.sums(lambda j: j * (j - 1), 2, 2), self.squares)
        # Where it leads beyond Y.
        self.more = SQUARES * ((1 + MOVED) ** (n - 2) - 1) * MOVED / U
        self.near = self.count + self.more

    def sums(self, number, first, less):
        """The sum of number(j) |c_j| Y^(j - less), with Y = x + |s|."""
        return {(j, a, j - less - a): Fraction(number(j) * comb(j - less, a))
                for j in range(first, self.n + 1) for a in range(j - less + 1)}

    def first_terms(self, of_coefficient):
        """The error of s (d1 + d2 s) per |s|, by Horner's passes over numbers that are each so many roundings wrong."""
        off = of_coefficient * U / (1 - U)
        c = [Number({(j, 0, 0): Fraction(1)}, {(j, 0, 0): off}) for j in range(1, self.n + 1)]

        def horner(to):
            for k in range(self.n - 2, to - 1, -1):
                c[k] = c[k] + c[k + 1].times(x=1)

        horner(0)
        horner(0)
        d1 = c[0]
        horner(1)
        return (d1 + c[1].times(s=1)).times(s=1)

    def holds(self, needed, rounding):
        """Does this rounding cover so many of 2^-24? D is computed, too: less by `deep`."""
        return needed <= rounding * self.deep / U


mass, time = Degree(6), Degree(3)
more_wrong = ratio(by(mass.first_terms(2).error, s=-1), mass.slopes)
require(more_wrong > mass.count * U, "a coefficient that is known less exactly counts")

beyond = {(j, j - k, k - 3): Fraction(comb(j, k)) for j in range(3, mass.n + 1) for k in range(3, j + 1)}
cubes = ratio(beyond, mass.cubes)
covers = lambda number: cubes * (1 + 4 * U) <= number * mass.deep
proven(f"the terms from the third on are at most 10/3 E |s|^3: {float(CUBES)} covers that and its rounding",
       cubes == Fraction(10, 3) and covers(CUBES) and not covers(CUBES - Fraction(1, 10)))
proven(f"a distance rounded by m costs at most {SQUARES} m (2 |c_2| + E Y), and where it leads beyond Y at most "
       f"{float(mass.more):.3f} * 2^-24 D more",
       mass.per_move == SQUARES and time.per_move == 2)
# From the other end a place's distance is itself rounded, which `moved` does not know.
far = mass.near + SQUARES * Fraction(1001, 1000)
for what, degree, needed, rounding, less in (
    ("a mass's search from the same end", mass, mass.near, NEAR, Fraction(3, 4)),
    ("a mass's search from the other end", mass, far, FAR, Fraction(9, 10)),
    ("a time's search", time, time.near, NEAR, Fraction(7, 16)),
):
    proven(f"{what}: the first two terms are wrong by {float(needed):.2f} roundings of |s| D at most; the bound has "
           f"{float(rounding / U):g}, of which {float(less):g} would not do",
           degree.holds(needed, rounding) and not degree.holds(needed, rounding * less))

# What is measured: by `Series::at`, and `difference` rounds the second numbers and the answer.
eta = {6: MASS_TERMS * (AT[6] + SECOND[6] + 2) * U * U, 3: TIME_TERMS * (AT[3] + SECOND[3] + 2) * U * U}
proven(f"what is missing is measured to 2^{log2(eta[6]):.1f} of a mass sought and 2^{log2(eta[3]):.1f} of a time: an "
       "eighth of the quarter that is left for it, or less",
       8 * eta[6] < INVERSE_ERROR / 4 < 64 * eta[6] and 8 * eta[3] < TIME_ERROR / 4)

# --- The end of a search from the same end. Of the mass or the time, at most half is before the target. There D is at
# most `steep` times the slope, so the slope is computed to `off` of itself.
for degree, what, error, terms, steep, left, until, ramps in (
    (mass, "mass", INVERSE_ERROR, MASS_TERMS, 4096, lambda r: r.m, box.before_half, box.extremes()),
    (time, "time", TIME_ERROR, TIME_TERMS, 256, lambda r: r.t, box.half_time, box.times_only()),
):
    d, slope = (lambda r: box.slope(box.sizes(left(r)))), (lambda r: box.slope(left(r)))
    claim = f"up to the middle of a {what} D is at most {steep} times the slope"
    proven(claim, box.tight(steep, d, slope, ramps, until))
    off, n, step = steep * NEAR, degree.n, Fraction(1, 2**23)
    # Between neighbouring places, of the target: the slope times the way; the step's bend; then what the bound has.
    way = step * n * terms
    bend = Fraction(n - 1, 2) * steep * step
    missing = (way + 2 * eta[n]) * (1 + 2 * off)
    bound = missing * (2 * bend**2 + bend**3 + 8 * U) + way * (NEAR + CUBES * step**2) * Fraction(1001, 1000)
    # One whose step is refused though what it misses is no more than what is measured wrongly, and the slope's error of
    # a way.
    small = 2 * eta[n] * steep + off * step * n * terms
    refused = small * (NEAR + CUBES * step**2) * Fraction(1001, 1000) + (2 * eta[n] + off * way) * (2 * bend**2 + 8 * U)
    proven(f"a step between neighbouring places leaves 2^{log2(bound):.1f} of a {what} sought, of {log2(error):g} "
           f"allowed: it is accepted; and a search that reaches its limit misses 2^{log2(5 * eta[n]):.1f} at most",
           off <= Fraction(1, 256) and bound < error / 4,
           refused < error / 4 and 5 * eta[n] < error / 4)
# From the other end D is at most that of all of the ramp, which has at most twice the target.
ends = 2 * FAR * Fraction(1, 2**23) * 6 * MASS_TERMS * Fraction(1001, 1000)
claim = f"from the other end what the bound has without what is missing is 2^{log2(ends):.1f} of the target"
proven(claim, ends < INVERSE_ERROR / 4)
