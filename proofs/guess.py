"""The first guess: the division by a constant, and that logarithms fit their words. By exact arithmetic and z3."""

from z3 import *

from common import *

pinned("""
search/guess.rs guess e18650f6 divided eed4515e rough_log 9e8a10e6 RECIPROCALS 9fa5011a
""")

LOG_ONE = constant("LOG_ONE")
reciprocals = [0, 1 << 30, 1 << 29, 357913942, 1 << 28, 214748365, 178956971, 0]

a, b = BitVecs("a b", 32)
log_a, log_b = (a >> 3) - 127 * LOG_ONE, (b >> 3) - 127 * LOG_ONE
wide = SignExt(32, log_a) - SignExt(32, log_b)
valid("guess: a difference of two logarithms, of any f32 and NaN, fits 30 bits, so neither it nor four times it "
      "overflows",
      And(SignExt(32, log_a - log_b) == wide, SignExt(32, (log_a - log_b) << 2) == wide << 2),
      wide < (1 << 29) - 1)
# 4 x R / 2^32 is x R / 2^30, linear in x: its error is greatest at the ends; then it is rounded down.
off = {k: (Fraction(reciprocals[k], 2**30) - Fraction(1, k)) * 2**29 for k in range(1, 7)}
proven("divided: x / k rounded down for k = 1, 2, 4, and less than 4/3 below x / k or 1/3 above it for 3, 5, 6, for "
       "all logarithms",
       all(abs(most) <= Fraction(1, 3) for most in off.values()) and all(off[k] == 0 for k in (1, 2, 4)),
       all(reciprocals[k] == -(-(2**30) // k) for k in off))
