"""Numbers of a few bits, as integers: multiples of a unit that is small enough."""

import numpy as np


def shift_of(v, p):
    """By how many bits a number is longer than p: its exponent is in the bits of a double."""
    return np.maximum((v.astype(np.float64).view(np.int64) >> 52 & 0x7FF) - 1022 - p, 0)


def rounded(v, p):
    """To p bits, to even in the middle."""
    shift = shift_of(v, p)
    size, unit = np.abs(v), np.int64(1) << shift
    down = (size >> shift) << shift
    rest = 2 * (size - down)
    up = (rest > unit) | ((rest == unit) & (((size >> shift) & 1) == 1))
    return np.sign(v) * (down + np.where(up & (shift > 0), unit, 0))
