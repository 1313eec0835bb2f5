"""How exact the sums, products and quotients of pairs are, by Gappa.

Numbers are scaled so that the greater first number is in [1, 2]: rounding commutes with powers of two as long as
nothing overflows or is subnormal, which the callers see to. A second number is given in half ulps of the first: `k` of
them are `k` times 2^-24 here. Two theorems are taken as known: what Knuth's two-sum and Dekker's product keep as the
rest is the rounding error exactly (Boldo and Melquiond 2017), and a difference of numbers within a factor of two is
exact (Sterbenz).
"""

from common import *

pinned("""
number/pair.rs Pair::sum 389a9307 lost_by_sum b536d712 plus 557c4757 minus 18c7a5c1 minus_loose 9dce256a
    difference c74b730c thrice 3ef92a37 times e0303f78 over e34c0f49 lost_by_product 3f1fb5c1 from_f64 a6c07973
""")


def script(body, given, hints="", goal="error"):
    """Of pairs `a` and `b` whose second numbers are so many half ulps, for a bound of the goal."""
    return lambda ka, kb: lambda bound: f"""@rnd = float<24,-1000,ne>;
ah = rnd(Ah); bh = rnd(Bh); al = rnd(Al); bl = rnd(Bl);
{body}
{{ {given} /\\ |al| <= {exactly(ka * U)} /\\ |bl| <= {exactly(kb * U)} -> |{goal}| <= {exactly(bound)} }}
{hints}
"""


plus = script(
    """s = rnd(ah + bh); e = (ah + bh) - s; v = rnd(al + bl); w = rnd(e + v);
error = (s + w) - ((ah + al) + (bh + bl));""",
    "ah in [1,2] /\\ |bh| <= 2", "error -> (w - (e + v)) + (v - (al + bl));",
)
times = script(
    """hi = rnd(ah * bh); lost = ah * bh - hi; t = rnd(rnd(ah * bl) + rnd(al * bh)); lo = rnd(lost + t);
error = (lo - (lost + t)) + (t - (rnd(ah * bl) + rnd(al * bh))) + (rnd(ah * bl) - ah * bl)
    + (rnd(al * bh) - al * bh) - al * bl;
share = error / (ah * bh);""",
    "ah in [1,2] /\\ bh in [1,2]", "$ ah in 8, bh in 8;", "share",
)
# The reciprocal errs by one rounding, `io`; the quotient's first number by two, `th`. What its product with the divisor
# lacks, -ah th, is exact before its own rounding, by Sterbenz and Dekker.
over = script(
    """rho = -ah * th; lacks = rnd(rho); hi = (ah / bh) * (1 + th); i = (1 + io) / bh;
m = rnd(hi * bl); n = rnd(al - m); q = rnd(lacks + n); lo = rnd(q * i);
error = (lo - q * i) * bh + ((q - (lacks + n)) + (lacks - rho) + (n - (al - m)) - (m - hi * bl)) * (1 + io)
    + (rho + (al - hi * bl)) * (io + bl / (bh + bl));
share = error / ah;""",
    f"ah in [1,2] /\\ bh in [1,2] /\\ |th| <= {exactly(2 * U + U * U)} /\\ |io| <= {exactly(U)}", "$ ah in 16, bh in "
    "16;", "share",
)
# Near numbers: the difference of the first ones is exact, so the error is one rounding of the answer, which is left
# out here, and this one.
difference_near = script("error = rnd(al - bl) - (al - bl);", "ah in [1,2]")
# `thrice`: the first numbers are added exactly, with a rest `e` of at most half an ulp of their sum, which is below 8.
thrice = script("e = rnd(E); t = rnd(3 * al); lo = rnd(e + t); error = (lo - (e + t)) + (t - 3 * al);", "|e| <= 1b-22")


# A double in [1, 2] as a pair.
def from_f64(bound):
    return f"""@rnd = float<24,-1000,ne>; @double = float<53,-2000,ne>;
x = double(X); hi = rnd(x); rest = double(x - hi); lo = rnd(rest); error = (hi + lo) - x;
{{ x in [1,2] -> |error| <= {exactly(bound)} /\\ |lo| <= 1b-24 }}
error -> (lo - rest) + (rest - (x - hi));
"""


LAST = U * U  # 2^-48
names = {1: "half an ulp", 2: "an ulp", 8: "four ulp"}

# As exactly as Gappa has it, in 2^-48, and what comments in src/ say of it.
for name, script, k, bound, said in (
    ("plus, minus and minus_loose", plus, (1, 1), 3, 46),
    ("plus and minus", plus, (1, 8), PLUS, 44),
    ("times", times, (1, 1), 7, 45),
    ("times", times, (1, 2), 11, 44),
    ("over", over, (1, 2), OVER, 43),
    ("difference of near numbers, before its last rounding,", difference_near, (2, 2), 2, 47),
):
    bound, numbers = bound * LAST, f"second numbers of {names[k[0]]} and {names[k[1]]}"
    claim = f"{name} errs by at most {float(bound / LAST):g} * 2^-48, so 2^-{said}; {numbers}"
    require(bound <= Fraction(1, 2**said), claim)
    gappa_claim(claim, script(*k), bound)

claim = "thrice errs by at most 6 * 2^-48 of the first number; second number of half an ulp"
gappa_claim(claim, thrice(1, 1), 6 * LAST)
claim = "from_f64 errs by at most 2^-49 of the number, and its second number is at most half an ulp"
gappa_claim(claim, from_f64, LAST / 2)
