"""That `rounded_sum` and `rounded_small_sum` round once. By all values of short numbers.

What decides is where the rest of a sum lies relative to the middles next to the sum, and that depends on the number of
bits only through how far the words reach below those middles. So numbers of a few bits have every case that those of 24
have, as long as a rest of some ulp still has bits below a quarter of an ulp.
"""

from common import *
from short import *

pinned("""
number/moment.rs rounded_sum 2b2fef1d rounded_small_sum a4418eda odd_sum c4c2eafa
""")


def odd_sum(a, b, p):
    """As the code has it: to the nearest, and from there one towards what is left, if that is even."""
    exact = a + b
    near = rounded(exact, p)
    left = exact - near
    # The last place of the neighbour towards what is left: half as long below a power of two.
    shift = shift_of(near, p)
    # A number that has fewer bits than p is even unless it fills them.
    even = (np.abs(near) >> shift) % 2 == 0
    is_power = (np.abs(near) & (np.abs(near) - 1)) == 0
    inward = (left != 0) & (np.sign(left) != np.sign(near)) & is_power
    step = (np.int64(1) << shift) >> inward.astype(np.int64)
    return np.where((left != 0) & even, near + np.sign(left) * step, near)


def numbers(p, exponents):
    m = np.arange(2 ** (p - 1), 2**p, dtype=np.int64)
    return np.concatenate([sign * (m << e) for e in exponents for sign in (1, -1)])


def operands(p, halves):
    """The unit of a pair's first numbers, bases, and second numbers of at most so many half ulps, which are 2^(unit - "
    "1)."""
    unit = 2 * p + 1
    bases, los = numbers(p, range(unit - p - 1, unit + p + 2)), numbers(p, range(0, unit + 1))
    return unit, np.append(bases, 0), np.append(los[np.abs(los) <= halves << (unit - 1)], 0)


def wrong(p, halves):
    """How many sums of a base and a pair are not rounded once."""
    (unit, bases, los), found = operands(p, halves), 0
    bases = bases[:, None]
    for hi in np.arange(2 ** (p - 1), 2**p, dtype=np.int64) << unit:
        # In parts that fit the cache.
        for lo in np.array_split(los[None, :], len(los) // 6 + 1, axis=1):
            total = rounded(bases + hi, p)
            answer = rounded(total + odd_sum(bases + hi - total, lo, p), p)
            found += int((answer != rounded(bases + hi + lo, p)).sum())
    return found


# A rest of four ulp needs a bit more below a quarter of an ulp.
proven("rounded_sum rounds once, where nothing is subnormal: for all sums of 6 bits with second numbers up to two "
       "ulp, of 7 up to four",
       all(wrong(p, halves) == 0 for p, halves in ((5, 1), (6, 4), (7, 8))) and wrong(6, 8) > 0)


def to_place(v, place):
    """To a multiple of 2^place, to even in the middle."""
    down = v >> place
    rest, half = v - (down << place), np.int64(1) << (place - 1)
    return (down + ((rest > half) | ((rest == half) & (down % 2 == 1)))) << place


def wrong_below(p, halves, by_all=True):
    """How many sums are not rounded once by `rounded_small_sum` where they may be subnormal: below 2^(p-1) of a place.

    A base is a multiple of that place, as every number is; the pair, in a finer unit, need not be.
    """
    (unit, all_bases, lo), found = operands(p, halves), 0
    for place in range(unit - p, unit + 3):
        least = np.int64(1) << (place + p - 1)
        bases = all_bases[(all_bases % (1 << place) == 0) & (np.abs(all_bases) <= 4 * least)]
        for hi in np.arange(2 ** (p - 1), 2**p, dtype=np.int64) << unit:
            base, low = bases[:, None], lo[None, :]
            near = rounded(base + hi, p)
            left = base + hi - near
            rough = rounded(near + rounded(left + low, p), p) if by_all else near
            places = np.where(np.abs(rough) >= least, 0, np.where(rough < 0, -least, least))
            upper = rounded(places + near, p)
            answer = rounded(upper + odd_sum(places + near - upper, odd_sum(left, low, p), p), p) - places
            exact = base + hi + low
            # The unit is changed back: what then is subnormal is rounded to the place.
            answer = np.where(np.abs(answer) < least, to_place(answer, place), answer)
            once = np.where(np.abs(exact) < least, to_place(exact, place), rounded(exact, p))
            found += int((answer != once).sum())
    return found


proven("rounded_small_sum rounds once where a sum is subnormal, too: for all of 5 bits with second numbers up to half "
       "an ulp, of 6 up to an ulp",
       wrong_below(5, 1) == 0 and wrong_below(6, 2) == 0,
       # The sign by the first number alone would not do.
       wrong_below(5, 1, by_all=False) > 0)


# Is the rounding to odd needed, and seen to be?
odd_sum = lambda a, b, p: rounded(a + b, p)
require(wrong(5, 1) > 0, "rounding to nearest twice would do")
