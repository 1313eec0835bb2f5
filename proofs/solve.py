"""src/solve.rs: the bound of what a step leaves, term by term in exact rational arithmetic; and the search's end.

`c` are the coefficients' numbers in single precision; the true ones differ by one rounding. The slopes on the way are
bounded by D, the sum of j |c_j| Y^(j-1) with Y = |x| + |s|.
"""

from math import comb

from majorant import *

code("solve.rs", "const fn horner<const N: usize>(c: &mut [f32; N], x: f32, to: usize) {", "let mut k = N - 1; while k > to { k -= 1; c[k] += c[k + 1] * x; } }")
code("solve.rs", "const fn new<const N: usize>(c: &[f32; N], x: f32) -> Self {", """let mut c = *c; horner(&mut c, x, 0); let value = c[0] * x;
    horner(&mut c, x, 0); horner(&mut c, x, 1); Self { value, d1: c[0], d2: c[1] } }""")
code("solve.rs", "let c = core::hint::black_box(c);", """let size = s.abs(); let y = x.abs() + size; let (mut cubes, mut j) = (0.0, N);
    while j > 2 { cubes = cubes * y + j as f32 * c[j - 1].abs(); j -= 1; }
    let bends = cubes * y + 2.0 * c[1].abs(); let slopes = bends * y + c[0].abs();
    let first = (missing - s * (local.d1 + local.d2 * s)).abs();
    first + size * (ROUNDING * slopes + 5.0 * moved.abs() * bends + 3.4 * cubes * (s * s)) }""")
code("solve.rs", "const fn distance(&self, p: f32) -> f32 {", "flipped((p - self.place.hi) - self.place.lo, self.back) }")
code("ramp.rs", "let c5 = c5 + 6.0 * c6 * from_end;", "")
code("solve.rs", "let error = if step.abs() <= ULP * p { accepted } else { wanted };", """
    if is_inside && left(&c, [x, moved], &local, missing, step) <= 0.75 * error {""")

ROUNDING = 1 / Fraction(2 ** int(source("solve.rs", r"const ROUNDING: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
MOVED = 1 / Fraction(2 ** int(source("solve.rs", r"const MOVED: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
CUBES = Fraction(source("solve.rs", r"moved\.abs\(\) \* bends \+ (\d\.\d) \* cubes"))
BENDS = int(source("solve.rs", r"slopes \+ (\d)\.0 \* moved\.abs\(\)"))
N = 6


def power(n, k=Fraction(1)):
    """(|x| + |s|)^n by its terms."""
    return {(a, n - a): k * comb(n, a) for a in range(n + 1)}


def sums(numbers, less):
    """The sum of numbers[j] |c_j| Y^(j - less)."""
    return {(j, a, b): k for j, number in numbers.items() for (a, b), k in power(j - less, number).items()}


D = sums({j: Fraction(j) for j in range(1, N + 1)}, 1)
BENDINGS = sums({j: Fraction(j) for j in range(2, N + 1)}, 2)
E = sums({j: Fraction(j) for j in range(3, N + 1)}, 3)


def horner(c, to):
    for k in range(N - 2, to - 1, -1):
        c[k] = c[k] + c[k + 1].times(x=1)


def slopes(of_coefficient=1):
    """Horner's passes over numbers that are each wrong by `of_coefficient` roundings."""
    c = [Number({(j, 0, 0): Fraction(1)}, {(j, 0, 0): of_coefficient * U / (1 - U)}) for j in range(1, N + 1)]
    horner(c, 0)
    horner(c, 0)
    d1 = c[0]
    horner(c, 1)
    return d1, c[1]


def first_terms(of_coefficient=1):
    """The error of s (d1 + d2 s), as computed, per |s|."""
    d1, d2 = slopes(of_coefficient)
    return (d1 + d2.times(s=1)).times(s=1)


count = ratio(by(first_terms().error, s=-1), D) / U
# What the computed bound is at least, relative to the exact one: a few roundings more than its operations are deep.
DEEP = (1 - U) ** (2 * N + 8)
stated = int(source("solve.rs", r"because (?:some|at most) (\d+)\s*(?://!)?\s*roundings of 2⁻²⁴ lead to them"))
require(stated - 1 < count <= stated, "as many roundings as the comment says")
require(ratio(by(first_terms(2).error, s=-1), D) / U > stated, "a coefficient that is known less exactly counts")
proven(f"the first two terms are wrong by at most {float(count):.4f} * 2^-24 |s| D: the {stated} roundings of the comment")

beyond = {(j, j - k, k - 3): Fraction(comb(j, k)) for j in range(3, N + 1) for k in range(3, j + 1)}
cubes = ratio(beyond, E)
require(cubes == Fraction(comb(N, 3), N), "10/3")
require(cubes * (1 + 4 * U) <= CUBES * DEEP and cubes * (1 + 4 * U) > (CUBES - Fraction(1, 10)) * DEEP, "3.4 covers 10/3 and rounding")
proven(f"the terms from the third on are at most 10/3 E |s|^3: {float(CUBES)} covers that and its rounding")

# A distance that is wrong by m changes the slopes, between the places, by m times the greatest second derivative.
second = sums({j: Fraction(j * (j - 1)) for j in range(2, N + 1)}, 2)
require(ratio(second, BENDINGS) == BENDS, "5 is j - 1 at most")
more = BENDS * ((1 + MOVED) ** (N - 2) - 1) * MOVED  # places up to Y (1 + MOVED)
proven(f"a distance rounded by m costs at most {BENDS} m (2 |c_2| + E Y), and where it leads beyond Y at most {float(more / U):.3f} * 2^-24 D more")

# What is in the budget. D and the rest are computed, too: less by DEEP.
budget = ROUNDING * DEEP / U
near = count + more / U
require(near <= budget, "the near end")
proven(f"a search from the end that faces the side: {float(near):.3f} of {float(budget):.3f} roundings are taken, so the bound holds")

# From the other end a place's distance is itself one rounding, from inside two, which `moved` does not know.
far = near + BENDS * Fraction(1001, 1000)
# c5 + 6 c6 P has three roundings of 6 |c6| P, two of the sum, and those of the ends' coefficients. The density is not negative
# up to P on either side, so at P its even terms are at least the odd ones: |a1| + |a3| + |a5| >= |a6| P^5 - |a2| P - |a4| P^3
# for a_j = j c_j P^(j-1) ..., hence x^4 |a6| P <= D(x) for x <= P; beyond P it is one of D's own terms.
inside = near + 2 * BENDS * Fraction(1001, 1000) + 1 + BENDS * 4 * Fraction(1001, 1000)
for name, needed in (("the other end", far), ("a minimum inside", inside)):
    share = Fraction(3, 4) * max(Fraction(1), needed / budget)
    open_point(f"a search from {name} may take {float(needed):.1f} roundings, not {float(budget):.1f}: "
               f"what is left is then at most {float(share):.2f} of the error that is asked for, not 0.75")
require(far > budget and inside > budget, "an open point has been closed: say so")
require(far / budget * Fraction(3, 4) < 1, "the other end keeps to the error that is asked for")
proven("a search from the other end leaves less than the error that is asked for, with a sixteenth for measuring")

# The end of the search from an end: neighbours are 2^-23 of a place apart, and x D <= 6 * 1083 times what is collected.
markov = int(source("solve.rs", r"for degree 6 it is at most (\d+) times"))
ends = ROUNDING * Fraction(1, 2**23) * N * markov
require(ends < Fraction(3, 4) * Fraction(1, 2**26), "the end")
stated = source("solve.rs", r"are below 2⁻(\S+) of it, so that the step")
stated = int("".join(str("⁰¹²³⁴⁵⁶⁷⁸⁹".index(digit)) for digit in stated))
require(ends * Fraction(1001, 1000) < Fraction(1, 2**stated), "below what is stated")
proven(f"between neighbours the bound's terms without r are at most 2^{log2(ends):.2f} of the target from an end: below 2^-{stated}")
# Inside: p D <= 2 * 6 * 1083 times the target, by cases.
inside_ends = 2 * ends
require(inside_ends * Fraction(1001, 1000) < Fraction(3, 4) * Fraction(1, 2**26), "inside")
proven(f"around a minimum inside at most 2^{log2(inside_ends):.2f} of the target; that the step stays in the bracket there is measured, not proven")
# Measuring r: within a sixteenth of what is asked for.
require(Fraction(markov, 2**41) < Fraction(1, 2**30) and Fraction(markov, 2**41) > Fraction(1, 2**31), "2^-30")
proven("what is missing is measured to 2^-30 of the target")
