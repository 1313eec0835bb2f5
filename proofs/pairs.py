"""How exact the sums, products and quotients of pairs are, by Gappa.

Numbers are scaled so that the greater first number is in [1, 2]: rounding commutes with powers of two as long as nothing
overflows or is subnormal, which the callers see to. A second number is given in half ulps of the first: `k` of them are
`k` times 2^-24 here. Two theorems are taken as known: what Knuth's two-sum and Dekker's product keep as the rest is the
rounding error exactly (Boldo and Melquiond 2017), and a difference of numbers within a factor of two is exact (Sterbenz).
"""

from common import *

pinned("""
number/pair.rs Pair::sum 389a9307 lost_by_sum b536d712 plus 557c4757 minus 18c7a5c1 minus_loose 9dce256a difference c74b730c thrice 3ef92a37 times e0303f78 over e34c0f49 lost_by_product 3f1fb5c1 from_f64 a6c07973
""")


ROUNDED = "@rnd = float<24,-1000,ne>;\n"
PAIRS = ROUNDED + "ah = rnd(Ah); bh = rnd(Bh); al = rnd(Al); bl = rnd(Bl);\n"


def halves(k):
    return exactly(k * U)


def plus(ka, kb):
    return lambda bound: PAIRS + f"""
s = rnd(ah + bh); e = (ah + bh) - s; v = rnd(al + bl); w = rnd(e + v);
error = (s + w) - ((ah + al) + (bh + bl));
{{ ah in [1,2] /\\ |bh| <= 2 /\\ |al| <= {halves(ka)} /\\ |bl| <= {halves(kb)} -> |error| <= {exactly(bound)} }}
error -> (w - (e + v)) + (v - (al + bl));
"""


def times(ka, kb):
    return lambda bound: PAIRS + f"""
hi = rnd(ah * bh); lost = ah * bh - hi; t = rnd(rnd(ah * bl) + rnd(al * bh)); lo = rnd(lost + t);
error = (lo - (lost + t)) + (t - (rnd(ah * bl) + rnd(al * bh))) + (rnd(ah * bl) - ah * bl) + (rnd(al * bh) - al * bh) - al * bl;
share = error / (ah * bh);
{{ ah in [1,2] /\\ bh in [1,2] /\\ |al| <= {halves(ka)} /\\ |bl| <= {halves(kb)} -> |share| <= {exactly(bound)} }}
$ ah in 8, bh in 8;
"""


# The reciprocal errs by one rounding, `io`; the quotient's first number by two, `th`. What its product with the divisor
# lacks, -ah th, is exact before its own rounding, by Sterbenz and Dekker.
def over(ka, kb):
    return lambda bound: ROUNDED + f"""
rho = -ah * th; lacks = rnd(rho); hi = (ah / bh) * (1 + th); i = (1 + io) / bh;
m = rnd(hi * bl); n = rnd(al - m); q = rnd(lacks + n); lo = rnd(q * i);
error = (lo - q * i) * bh + ((q - (lacks + n)) + (lacks - rho) + (n - (al - m)) - (m - hi * bl)) * (1 + io)
    + (rho + (al - hi * bl)) * (io + bl / (bh + bl));
share = error / ah;
{{ ah in [1,2] /\\ bh in [1,2] /\\ |al| <= {halves(ka)} /\\ |bl| <= {halves(kb)}
   /\\ |th| <= {exactly(2 * U + U * U)} /\\ |io| <= {exactly(U)} -> |share| <= {exactly(bound)} }}
$ ah in 16, bh in 16;
"""


def loose(ka, kb):
    return lambda bound: PAIRS + f"""
s = rnd(ah - bh); e = (ah - bh) - s; v = rnd(al - bl); lo = rnd(e + v);
error = (s + lo) - ((ah + al) - (bh + bl));
{{ ah in [1,2] /\\ |bh| <= 2 /\\ |al| <= {halves(ka)} /\\ |bl| <= {halves(kb)} -> |error| <= {exactly(bound)} }}
error -> (lo - (e + v)) + (v - (al - bl));
"""


# Near numbers: the difference of the first ones is exact, so the error is one rounding of the answer, which is left
# out here, and this one.
def difference_near(ka, kb):
    return lambda bound: PAIRS + f"""
error = rnd(al - bl) - (al - bl);
{{ |al| <= {halves(ka)} /\\ |bl| <= {halves(kb)} -> |error| <= {exactly(bound)} }}
"""


# A double in [1, 2] as a pair.
def from_f64(bound):
    return f"""@rnd = float<24,-1000,ne>; @double = float<53,-2000,ne>;
x = double(X); hi = rnd(x); rest = double(x - hi); lo = rnd(rest); error = (hi + lo) - x;
{{ x in [1,2] -> |error| <= {exactly(bound)} /\\ |lo| <= 1b-24 }}
error -> (lo - rest) + (rest - (x - hi));
"""


# `thrice`: the first numbers are added exactly, with a rest `e` of at most half an ulp of their sum, which is below 8.
def thrice(k):
    return lambda bound: PAIRS + f"""
e = rnd(E); t = rnd(3 * al); lo = rnd(e + t); error = (lo - (e + t)) + (t - 3 * al);
{{ |e| <= 1b-22 /\\ |al| <= {halves(k)} -> |error| <= {exactly(bound)} }}
"""


LAST = U * U  # 2^-48
names = {1: "half an ulp", 2: "an ulp", 8: "four ulp"}

# What the comments promise is proven, and half of it is not.
for name, script, k, stated in (("plus and minus", plus, (1, 1), 46), ("times", times, (1, 1), 45), ("over", over, (1, 2), 43)):
    gappa_claim(
        f"{name} errs by at most 2^-{stated}; second numbers of {names[k[0]]} and {names[k[1]]}",
        script(*k), Fraction(1, 2**stated), slack=Fraction(1, 2),
    )

# The same as exactly as Gappa has it, in 2^-48.
for name, script, k, bound in (
    ("plus and minus", plus, (1, 1), 3),
    ("plus and minus", plus, (1, 8), PLUS),
    ("minus_loose", loose, (1, 1), 3),
    ("times", times, (1, 2), 11),
    ("over", over, (1, 2), OVER),
    ("difference of near numbers, before its last rounding,", difference_near, (2, 2), 2),
):
    bound = Fraction(bound)
    gappa_claim(
        f"{name} errs by at most {float(bound):g} * 2^-48 = 2^{log2(bound * LAST):.2f}; second numbers of {names[k[0]]} and {names[k[1]]}",
        script(*k), bound * LAST,
    )

gappa_claim("thrice errs by at most 6 * 2^-48 of the first number; second number of half an ulp", thrice(1), 6 * LAST)
gappa_claim("from_f64 errs by at most 2^-49 of the number, and its second number is at most half an ulp", from_f64, LAST / 2)
