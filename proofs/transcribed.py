"""src/fraction.rs in whole numbers of any length, and the cases that it is tried on."""

from common import *

class Fractions:
    def __init__(self, n):
        self.n = n
        divisor = n or 1
        self.share = 2**63 // divisor
        self.rest = ((2**63 - self.share * divisor) * self.share) >> 31

    def edges(self, duty):
        """`duty` as a significand of 24 bits and an exponent: significand 2^(biased - 150)."""
        significand, biased = duty
        return ((self.share << 32 | self.rest) * significand) >> (150 - biased)

    def in_u64(self, odd, half, is_off):
        middle = self.share * odd + (self.rest * odd >> 32)
        return (middle + (half >> 32) if is_off else middle - (half >> 32)) % 2**64

    def exactly(self, odd, half, is_off):
        """The side, and the two numbers of 24 bits with the unit's exponent, 0 being the whole."""
        n = self.n
        side, near = (0, odd) if odd < n or odd == n and not is_off else (1, 2 * n - odd)
        total = near * (self.share << 32 | self.rest)
        total = total + half if is_off == (side == 0) else max(total - half, 0)
        require(total < 2**96, "96 bits")
        words, low, down = total >> 32, total % 2**32, 0
        if words >> 32 == 0:
            words, low, down = (words << 32 | low) % 2**64, 0, 32
        zeros = (64 - words.bit_length()) & 63
        bits = (words << zeros) % 2**64 | ((low << zeros) % 2**64) >> 32
        return side, bits >> 40, bits >> 16 & 0xFFFFFF, -24 - down - zeros


def cases():
    import random

    random.seed(1)
    counts = [1, 2, 3, 5, 7, 100, 4096, 65537, 2**22, 2**26 - 5, 2**31 - 1, 2**31, 2**32 - 2, 2**32 - 1]
    counts += [random.getrandbits(32) | 1 for _ in range(40)]
    duties = [(2**23, 127), (2**24 - 1, 126), (2**23, 126), (2**23 + 1, 126), (2**24 - 1, 100), (2**23, 40)]
    duties += [(random.getrandbits(23) | 2**23, random.choice([126, 125, 120])) for _ in range(6)]
    for n in counts:
        for odd in sorted({1, n - 1 | 1, n | 1, 2 * n - 1, 2 * random.randrange(n) + 1} & set(range(1, 2 * n + 1, 2)) if n < 2**16
                          else {1, n | 1, 2 * n - 1, (n - 1) | 1, 2 * random.randrange(n) + 1}):
            if odd > 2 * n - 1:
                continue
            for duty in [None, *duties]:
                for is_off in (False, True):
                    if duty is None and is_off:
                        continue
                    yield n, odd, duty, is_off


