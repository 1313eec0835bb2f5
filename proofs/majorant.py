"""Bounds of rounding errors by exact rational arithmetic, for polynomials whose numbers have any size and sign.

A bound is a sum of terms |c_j| |x|^a |s|^b, each with a rational number before it: a dictionary from (j, a, b). A
computed number is a `Number`: what bounds its size, and its error. Each operation rounds by at most 2^-24 of its
answer; nothing overflows or is subnormal.
"""

from math import comb

from common import *


def add(*bounds):
    total = {}
    for bound in bounds:
        for term, number in bound.items():
            total[term] = total.get(term, 0) + number
    return total


scale = lambda bound, factor: {term: number * factor for term, number in bound.items()}
by = lambda bound, x=0, s=0: {(j, a + x, b + s): number for (j, a, b), number in bound.items()}


def ratio(bound, by):
    """The greatest quotient, term by term: bound <= ratio * by."""
    assert all(term in by for term in bound), set(bound) - set(by)
    return max(number / by[term] for term, number in bound.items())


class Number:
    def __init__(self, size, error):
        self.size, self.error = size, error

    def rounded(self):
        """The same after one rounding."""
        return Number(scale(self.size, 1 + U), add(self.error, scale(self.size, U)))

    def __add__(self, other):
        return Number(add(self.size, other.size), add(self.error, other.error)).rounded()

    def times(self, x=0, s=0, k=1):
        """By exact numbers: powers of x and s, and an integer that itself costs no rounding."""
        return Number(scale(by(self.size, x, s), k), scale(by(self.error, x, s), k)).rounded()
