"""src/series.rs: how exact a series' value is, at an `f32` and at a pair; by_time.rs: `noise`. By exact rational arithmetic.

Bounds are shares of the sum of the series' terms without their signs, |c_k| |x|^k. Two-sum and Dekker's product are exact.
"""

from majorant import *

code("pub(crate) const fn at(self, x: f32) -> Pair {", "self.value(x, unknown(self.c.len())) }")
code("const fn value(self, x: f32, mut k: usize) -> Pair {", """let Pair { mut hi, mut lo } = self.last;
    loop { let product = hi * x; lo = lo * x + lost_by_product(product, hi, x); k = k.wrapping_sub(1); if k >= self.c.len() { return Pair { hi: product, lo }; }
    let sum = Pair::sum(self.c[k].hi, product); hi = sum.hi; lo += self.c[k].lo + sum.lo; } }""")
code("pub(crate) const fn slope(self, x: f32) -> f32 {", """let mut c = self.c; let mut slope = (c.len() + 1) as f32 * self.last.hi;
    while let [lower @ .., highest] = c { slope = slope * x + c.len() as f32 * highest.hi; c = lower; } slope }""")
code("pub(crate) const fn at_pair(self, place: Pair) -> Pair {", "self.moved(self.at(place.hi), place) }")
code("pub(crate) const fn at_pair_unrolled(self, place: Pair) -> Pair {", "self.moved(self.value(place.hi, self.c.len()), place) }")
code("const fn moved(self, Pair { hi, lo }: Pair, place: Pair) -> Pair {", "Pair { hi, lo: lo + self.slope(place.hi) * place.lo } }")
# At a place of 12 bits, `x_low` is 0, and the products with it are left out.
code("const fn value([c1, c2, c3]: [Pair; 3], x: f32) -> Pair {", """let product = c3.hi * x;
    let lo = c3.lo * x + lost_by_short_product(product, c3.hi, x); let sum = Pair::sum(c2.hi, product); let lo = lo + (c2.lo + sum.lo);
    let product = sum.hi * x; let lo = lo * x + lost_by_short_product(product, sum.hi, x);
    let sum = Pair::sum(c1.hi, product); let lo = lo + (c1.lo + sum.lo);
    let product = sum.hi * x; Pair { hi: product, lo: lo * x + lost_by_short_product(product, sum.hi, x) } }""")
code("pub(crate) const fn lost_by_short_product(product: f32, a: f32, x: f32) -> f32 {", "if EMULATED { return product_by_integers(product, a, x); } let high = upper(a); (high * x - product) + (a - high) * x }")
code("pub(crate) fn noise(&self, side: usize) -> f32 {", """let terms = |side: usize| {
    let x = if side == self.side { self.place.hi } else { LAST_PLACE - self.place.hi };
    let c = self.ramp.mass_in_single(side); c.iter().rev().fold(0.0, |terms, c| (terms + c.abs()) * x) };
    let terms = terms(self.side) + terms(side);
    terms * fraction_per_mass(self.ramp.share.hi) / (1u64 << 40) as f32 }""")


def first(j, k):
    """The bound of a coefficient's first number, if the second is at most k half ulps of it: |hi| <= |c| / (1 - k u)."""
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
comment = source(r"It is within 2⁻(\S+) Σ")
stated = int("".join(str("⁰¹²³⁴⁵⁶⁷⁸⁹".index(digit)) for digit in comment))
for n in (3, 6):
    lo, error = at(n)
    worst, second = ratio(error, sizes(n)), ratio(lo, sizes(n))
    require(worst <= Fraction(1, 2**stated), f"Series::at of degree {n} is within 2^-{stated}")
    if n == 6:
        require(worst > Fraction(1, 2 ** (stated + 1)), "no more than that is proven")
    proven(f"Series::at of degree {n} errs by at most {float(worst / places):.3f} * 2^-48 of its terms, below 2^-{stated}; its second number is at most {float(second / U):.3f} * 2^-24")
require(ratio(at(6, 2)[1], sizes(6)) > ratio(at(6)[1], sizes(6)), "a coefficient with more half ulps counts")

# `value`: the place is x + rest, with |rest| <= u |x|. What is left out of Taylor's series begins with the second term.
n = 6


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


for n in (3, 6):
    along, total = value(n)
    worst = ratio(total, sizes(n))
    share = ratio(along, sizes(n))
    require(share <= n * U * (1 + 100 * U) and share > n * U, "the second term")
    require(worst < Fraction(1, 2**40), "Series::at_pair is within 2^-40")
    proven(f"Series::at_pair of degree {n}: the second term is at most {n} * 2^-24 of the terms; the value errs by at most {float(worst / places):.2f} * 2^-48 of them")

# `noise` sums the first numbers' terms at x, with 12 roundings, one more of the sum with the other end's, and one of the scaling,
# and takes 2^-40.
least = (1 - U) ** 14 / (1 + U)
down = int(source(r"fraction_per_mass\(self\.ramp\.share\.hi\) / \(1u64 << (\d+)\) as f32"))
require(worst <= least / 2**down, "noise")
require(worst > least / 2 ** (down + 1), "noise: half of it would not do")
proven(f"noise, 2^-{down} of the terms as computed, bounds the error of a mass")
