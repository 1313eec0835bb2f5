"""How exact a series' value is, at an `f32` and at a pair, by exact rational arithmetic.

Bounds are shares of the sum of the series' terms without their signs, |c_k| |x|^k. Two-sum and Dekker's product are
exact.
"""

from majorant import *

pinned("""
number/series.rs at 7496bb80 at_pair 1b6cdf90 slope dffe1362
""")


def first(j, k):
    """The bound of a coefficient's first number, if the second is at most k half ulps of it: |hi| <= |c| / (1 - k "
    "u)."""
    return {(j, 0, 0): 1 / (1 - k * U)}


def at(n, k=1):
    """`Series::at` for degree n: the bounds of its second number, and of its error."""
    hi = first(n, k)
    lo, error = scale(hi, k * U), {}
    for j in range(n - 1, -1, -1):
        product = by(hi, 1)
        lost = scale(product, U)
        product = scale(product, 1 + U)
        carried = by(lo, 1)
        error = add(by(error, 1), scale(carried, U))
        carried = add(scale(carried, 1 + U), lost)
        error = add(error, scale(carried, U))
        lo = scale(carried, 1 + U)
        if j == 0:
            return lo, error
        total = add(first(j, k), product)
        rest = add(scale(first(j, k), k * U), scale(total, U))
        error = add(error, scale(rest, U))
        total_lo = add(lo, scale(rest, 1 + U))
        error = add(error, scale(total_lo, U))
        hi, lo = scale(total, 1 + U), scale(total_lo, 1 + U)


def sizes(n):
    return {(j, j, 0): Fraction(1) for j in range(1, n + 1)}


places = U * U
for n, said in AT.items():
    lo, error = at(n)
    worst, second = ratio(error, sizes(n)), ratio(lo, sizes(n))
    proven(f"Series::at of degree {n} errs by at most {float(worst / places):.3f} * 2^-48 of its terms, below 2^-41; "
           f"its second number is at most {float(second / U):.3f} * 2^-24",
           0 <= worst / places - int(said) < Fraction(1, 1000) and worst <= Fraction(1, 2**41),
           0 <= second / U - SECOND[n] < Fraction(1, 1000))
require(ratio(at(6)[1], sizes(6)) > Fraction(1, 2**42), "no more than that is proven")
require(ratio(at(6, 2)[1], sizes(6)) > ratio(at(6)[1], sizes(6)), "a coefficient with more half ulps counts")


# `value`: the place is x + rest, with |rest| <= u |x|. What is left out of Taylor's series begins with the second term.
def slope(n):
    number = Number(scale(first(n, 1), n), add({(n, 0, 0): n * U / (1 - U)})).rounded()
    for j in range(n - 1, 0, -1):
        term = Number(scale(first(j, 1), j), {(j, 0, 0): j * U / (1 - U)}).rounded()
        number = number.times(x=1) + term
    return number


def value(n):
    lo, error = at(n)
    along = slope(n)
    # times rest, which is at most u |x|
    along = Number(scale(by(along.size, 1), U), scale(by(along.error, 1), U)).rounded()
    total = add(error, along.error, scale(add(lo, along.size), U))
    beyond = {(j, j, 0): (1 + U) ** j - 1 - j * U for j in range(2, n + 1)}
    return along.size, add(total, beyond)


for n, said in AT_PAIR.items():
    along, total = value(n)
    worst, share = ratio(total, sizes(n)), ratio(along, sizes(n))
    proven(f"Series::at_pair of degree {n}: the second term is at most {n} * 2^-24 of the terms; the value errs by at "
           f"most {float(worst / places):.2f} * 2^-48 of them",
           0 <= worst / places - said < Fraction(1, 1000) and worst <= Fraction(1, 2**40),
           n * U < share <= n * U * (1 + 100 * U))
