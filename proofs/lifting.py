#!/usr/bin/env python3
"""How far lifting moves a curve at most: proofs in exact rational arithmetic, for every curve that is accepted.

What is forgiven and what the traces are is read from the source. `python3 proofs/lifting.py` prints a line for each
claim, and fails if one does not hold, or if one holds that is tighter than it can be.

Times. Let the ramp be 1 long, `q` a third of t' with the Bernstein coefficients d0, d1, d2, which add up to 1, and let q
be raised by r to (q + r) / (1 + 3r), which has the time T. Then t = (1 + 3r) T - 3rp, so that a time moves by T - t = 3r
(p - T). Now T' is nowhere below 0, and such quadratics on [0, 1] are sums of squares a (p - s)² with s in [0, 1], and of
multiples of p (1 - p): if d1 is below 0, it is at least -sqrt(d0 d2), and what d0 or d2 is more than that square has, is
a multiple of (1-p)² or p². Since p - T is linear in T', and T(1) = 1, it is greatest on one of these alone. For the square
T = ((p-s)³ + s³) / ((1-s)³ + s³); t - p is the same seen from the other end.

Openness. Let the greatest openness be 1 (all is in proportion), and `stays` in [1/2, 1]. Pressed by r, f becomes f +
(stays - f) r / (stays + r), up by at most r (1 - f) and down by less than r, and its control values are rounded up, each by less than 2⁻²³ of itself. A cubic between 0
and 1 is fixed by its values at 0, 1/4, 3/4 and 1, all between 0 and 1, and the bound is convex in these, so it is
greatest where each of them is 0 or 1.
"""

import itertools
from fractions import Fraction as F

from common import proven, require
from common import source as read

GRAZE = F(1, 1 << int(read(r"const GRAZE: f64 = 1\.0 / \(1 << (\d+)\) as f64;")))
read(r"quadratic_min\(differences\(t\)\)\.0 < -GRAZE / 3\.0 \* \(t\[3\] - t\[0\]\)")
read(r"low < -GRAZE \* size")
# The traces by which more is raised than what is below 0.
SLOPE = F(1, 1 << int(read(r"\(outer\.abs\(\) \+ inner\) / divisor / \(1u64 << (\d+)\) as f64")))
DARK = F(1, 1 << int(read(r"-low \+ high / \(1u64 << (\d+)\) as f64")))
read(r"if 2\.0 \* end < high \{ high \} else \{ end \}")
# More than what rounding in f64 makes of any of this, relative to it.
ROUNDING = F(1, 1 << 45)



def claim(text, holds):
    require(holds, text)
    proven(text)


def halves(b):
    """De Casteljau's halves of a polynomial in the Bernstein basis; its coefficients may be polynomials themselves."""
    left, right = [b[0]], [b[-1]]
    while len(b) > 1:
        b = [mean(x, y) for x, y in zip(b, b[1:])]
        left.append(b[0])
        right.append(b[-1])
    return left, right[::-1]


def mean(x, y):
    return [mean(a, b) for a, b in zip(x, y)] if isinstance(x, list) else (x + y) / 2


def bernstein(c):
    """From the coefficients of 1, p, p², p³."""
    n = len(c) - 1
    choose = [[1], [1, 1], [1, 2, 1], [1, 3, 3, 1]]
    return [sum(F(choose[k][i], choose[n][i]) * c[i] for i in range(k + 1)) for k in range(n + 1)]


def is_nowhere_negative(b, depth=40):
    """Of a polynomial in one or two variables on [0, 1], by subdivision; False also where that does not tell."""
    two = isinstance(b[0], list)
    flat = [x for row in b for x in row] if two else b
    corners = [b[i][j] for i in (0, -1) for j in (0, -1)] if two else [b[0], b[-1]]
    if min(corners) < 0 or depth == 0:
        return False
    if min(flat) >= 0:
        return True
    # The variables take turns.
    return all(is_nowhere_negative([list(x) for x in zip(*h)] if two else h, depth - 1) for h in halves(b))


def value(b, p):
    while len(b) > 1:
        b = [x + (y - x) * p for x, y in zip(b, b[1:])]
    return b[0]


# --- Times.


def is_within(most):
    """p - T <= most for the squares and for p (1 - p)."""
    # most N - p N + (p-s)³ + s³ for N = 1 - 3s + 3s², in powers of p, and these in powers of s.
    powers = [
        [most, -3 * most, 3 * most, 0],  # p⁰: most N
        [-1, 3, -3 + 3, 0],  # p¹: -N + 3s²
        [0, -3, 0, 0],  # p²: -3s
        [1, 0, 0, 0],  # p³
    ]
    in_s = [bernstein([F(x) for x in row]) for row in powers]
    both = [list(x) for x in zip(*(bernstein(list(column)) for column in zip(*in_s)))]
    smooth = bernstein([most, F(-1), F(3), F(-2)])
    return is_nowhere_negative(both) and is_nowhere_negative(smooth)


TIMES = F(469, 1000)
exact = F(4689, 10000)
claim(f"p - T is at most {float(exact)}, for each T with T' >= 0", is_within(exact))
# What the trace is a share of, (|ac| + b²) / (a - 2b + c), is below 2: the least being between -GRAZE/3 and 0, b < 0, and
# b² is ac but for GRAZE/3 of the divisor. So it is ac times 2 over the divisor but for that, at most (a + c) / 2; and as
# a + c = 1 - b, where -b is at most (a + c) / 2 but for that, a + c is at most 2 but for that.
raised = 3 * (GRAZE / 3 + 2 * SLOPE) * (1 + ROUNDING) + ROUNDING * GRAZE
claim(f"times move by at most {float(TIMES)} * GRAZE of the ramp", raised * exact <= TIMES * GRAZE)
claim("... but p - T is not always within 0.4688", not is_within(F(4688, 10000)))


def moved(s, p):
    """How far the square with its root at s, so deep that it is just accepted, moves a time."""
    d = [s * s, -s * (1 - s), (1 - s) * (1 - s)]
    d = [x / sum(d) for x in d]
    # Of the length 1 again, and below 0 by GRAZE/3.
    deep = [x * (1 + GRAZE) - GRAZE / 3 for x in d]
    a, b, c = deep
    least = (a * c - b * b) / (a - 2 * b + c)
    assert sum(deep) == 1 and least == -GRAZE / 3
    t = [F(0), a, a + b, F(1)]
    assert is_nowhere_negative(t) and is_nowhere_negative([1 - x for x in t])
    up = [x - least for x in deep]
    up = [x / sum(up) for x in up]
    return abs(value([F(0), up[0], up[0] + up[1], F(1)], p) - value(t, p))


claim(
    "... and times of an accepted curve do move by more than 0.4688 * GRAZE",
    moved(F(256, 1000), F(634, 1000)) > F(4688, 10000) * GRAZE,
)

# --- Openness.

raise_ = (GRAZE + DARK) * (1 + ROUNDING)
# The move is linear in f, and greatest at the least f, -GRAZE, or at the greatest, 1; in `stays` it is monotone.
moves = [
    abs(stays - f) * raise_ / (stays + raise_) for stays in (F(1, 2), F(1)) for f in (-GRAZE, F(1))
]
PRESSED = 1 + F(1, 1 << 20)
claim("before it is rounded, openness moves by at most 1.000001 * GRAZE", max(moves) <= PRESSED * GRAZE)
claim("... but not always by at most 0.999999 * GRAZE", max(moves) > F(999999, 1000000) * GRAZE)


def through(y):
    """The control values of the cubic with the values y at 0, 1/4, 3/4 and 1."""
    b1 = -F(10, 9) * y[0] + F(8, 3) * y[1] - F(8, 9) * y[2] + F(1, 3) * y[3]
    b2 = F(1, 3) * y[0] - F(8, 9) * y[1] + F(8, 3) * y[2] - F(10, 9) * y[3]
    b = [y[0], b1, b2, y[3]]
    assert [value(b, p) for p in (0, F(1, 4), F(3, 4), 1)] == list(y)
    return b


def is_pressed_within(most):
    """1 - f, which is pressed, and half of the control values without their signs: 2⁻²³ of these are rounded up."""
    cubics = [through(y) for y in itertools.product((F(0), F(1)), repeat=4)]
    return all(is_nowhere_negative([most - 1 + x - abs(x) / 2 for x in b]) for b in cubics)


OPENNESS = F(187, 100)
assert GRAZE == F(1, 1 << 22), "an ulp is taken for half of GRAZE"
# The rest is for f down to -GRAZE, and for the traces.
claim(
    f"openness moves by at most {float(OPENNESS)} * GRAZE of the greatest, but for 2^-149",
    is_pressed_within(OPENNESS - F(1, 1000)),
)
claim("... which these two steps cannot show of 1.868", not is_pressed_within(F(1868, 1000)))
