"""Markov's constant, for the noise of a mass (src/solve.rs, cdf.rs, certificate.rs), in exact rational arithmetic.

How much greater than a series of degree 6, whose slope g is at least 0 on [0, 1], can the sum of its terms without their
signs be at 1? By Lukacs, g = x a^2 + (1 - x) b^2 with quadratic a and b. For given signs of the six terms the sum is linear
in g, so its quotient with the series is greatest for one of the two squares alone, and there it is a quotient of two
quadratic forms of three numbers. It is at most q if q times one form minus the other is positive definite: if all leading
minors are positive. All 64 patterns of signs are tried, so nothing is assumed about which is the worst.
"""

from itertools import product

from common import *


def form(signs, is_late):
    """The sum with these signs, as a form in the coefficients of the square's root."""
    def term(power):
        return Fraction(signs[power], power + 1)

    if is_late:
        return [[term(i + j) - term(i + j + 1) for j in range(3)] for i in range(3)]
    return [[term(i + j + 1) for j in range(3)] for i in range(3)]


def is_positive(m):
    first = m[0][0]
    second = m[0][0] * m[1][1] - m[0][1] * m[1][0]
    third = sum(
        m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3)
    )
    return first > 0 and second > 0 and third > 0


def holds(quotient):
    for is_late in (False, True):
        series = form([1] * 6, is_late)
        for signs in product((1, -1), repeat=6):
            terms = form(signs, is_late)
            if not is_positive([[quotient * s - t for s, t in zip(*rows)] for rows in zip(series, terms)]):
                return False
    return True


stated = int(documented(r"without their signs are at most (\d+) times the mass"))
require(holds(Fraction(stated)), f"Markov's constant is below {stated}")
require(not holds(Fraction(stated - 1)), f"{stated - 1} would do")
least, most = Fraction(stated - 1), Fraction(stated)
for _ in range(20):
    middle = (least + most) / 2
    least, most = (least, middle) if holds(middle) else (middle, most)
proven(f"a mass's terms without their signs are at most {stated} times the mass: the greatest quotient is {float(most):.5f}")
