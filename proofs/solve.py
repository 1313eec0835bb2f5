"""The bound of what a step leaves, term by term in exact rational arithmetic; and the search's end.

`c` are the coefficients' numbers in single precision; the true ones differ by one rounding. The slopes on the way are
bounded by D, the sum of j |c_j| Y^(j-1) with Y = |x| + |s|. E is the sum of j |c_j| Y^(j-3) from the third on.
"""

from math import comb

from majorant import *

code("const fn horner<const N: usize>(c: &mut [f32; N], x: f32, to: usize) {", "let mut k = N - 1; while k > to { k -= 1; c[k] += c[k + 1] * x; } }")
code("const fn new<const N: usize>(c: &[f32; N], x: f32) -> Self {", """let mut c = *c; horner(&mut c, x, 0); let value = c[0] * x;
    horner(&mut c, x, 0); horner(&mut c, x, 1); Self { x, value, d1: c[0], d2: c[1] } }""")
code("let c = core::hint::black_box(c);", """let size = s.abs(); let y = local.x.abs() + size; let (mut cubes, mut j) = (0.0, N);
    while j > 2 { cubes = cubes * y + j as f32 * c[j - 1].abs(); j -= 1; }
    let squares = cubes * y + 2.0 * c[1].abs(); let slopes = squares * y + c[0].abs();
    let first = (missing - s * (local.d1 + local.d2 * s)).abs();
    first + size * (rounding * slopes + 5.0 * moved.abs() * squares + 3.4 * cubes * (s * s)) }""")
code("const fn distance(&self, p: f32) -> f32 {", "flipped((p - self.place.hi) - self.place.lo, self.sign) }")
code("let c5 = c5 + 6.0 * c6 * from_end;", "")
code("const fn around([a, b, c]: [Pair; 3], x: f32) -> [f32; 3] {", """let x = Pair::new(x);
    let thrice = c.thrice().times(x); let slope = thrice.plus(b.scaled(2.0)).times(x).plus(a);
    [slope.rounded(), thrice.plus(b).rounded(), c.hi] }""")
code("let thrice = 3.0 * c3;", """if c2 < 0.0 && -c2 < thrice * LAST_PLACE && (c1 - SLOW) * thrice < c2 * c2 {
    let slowest = -c2 / thrice; let sought = target.difference(series.at(slowest)); if sought.abs() < target.hi {
    let [c1, c2, c3] = around([series.c[0], series.c[1], series.last], slowest); 
    let (sign, sought) = (sought.to_bits() & BACK, sought.abs());
    let (place, c) = (Pair::new(slowest), [c1, flipped(c2, sign), c3]);
    anchor = Anchor { place, sign, c, sought, rounding: ROUNDING }; } }""")
code("let error = TIME_ERROR * target.hi;", "solve(series, target, &anchor, &Tolerance { wanted: error, accepted: error }).place }")
code("let (mut local, mut evaluations) = anchor.approach(error.wanted);", """let mut p = place.hi + flipped(local.x, sign);
    let mut distance = anchor.distance(p); let mut moved = distance - local.x; let mut needs_slopes = moved.abs() > MOVED * local.x;""")
code("if needs_slopes {", """(local, moved) = (Taylor::new(&c, distance), 0.0); evaluations += 1; }
    let missing = target.difference(series.at(p));""")
code("let most = if step.abs() <= ULP * p { error.accepted } else { error.wanted };", """
    if is_inside && left(&c, &local, moved, missing, step, rounding) <= 0.75 * most {""")

ROUNDING = 1 / Fraction(2 ** int(source(r"const ROUNDING: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
MOVED = 1 / Fraction(2 ** int(source(r"const MOVED: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
CUBES = Fraction(source(r"moved\.abs\(\) \* squares \+ (\d\.\d) \* cubes"))
SQUARES = int(source(r"slopes \+ (\d)\.0 \* moved\.abs\(\)"))
# By how many ROUNDINGs each kind of anchor counts.
code("pub(crate) const fn end(c: [f32; N], sought: f32) -> Self {", "Self { place: Pair::ZERO, sign: 0, c, sought, rounding: ROUNDING } }")
code("let mut anchor =", "Anchor::end(c, target.hi);")
code("if target.hi <= sought.abs() {", "return Anchor::end(self.mass_in_single(side), target.hi); }")
code("if nearest == 2 {", """let (place, c) = (Pair::new(LAST_PLACE), self.mass_in_single(side.other()));
    return Anchor { place, sign: BACK, c, sought: -sought, rounding: FROM_OTHER }; }""")
code("Anchor { place, sign, c, sought: sought.abs(), rounding: FROM_FLAT }", "")
OTHER_END = Fraction(source(r"const FROM_OTHER: f32 = ([\d.]+) \* ROUNDING;"))
INSIDE = Fraction(source(r"const FROM_FLAT: f32 = ([\d.]+) \* ROUNDING;"))


class Degree:
    """The bounds of a search along a series of degree n: 6 for a mass, 3 for a time."""

    def __init__(self, n):
        self.n = n
        self.slopes = self.sums(lambda j: j, 1, 1)
        self.squares = self.sums(lambda j: j, 2, 2)
        self.cubes = self.sums(lambda j: j, 3, 3)
        # What the computed bound is at least, relative to the exact one: a few roundings more than its operations are deep.
        self.deep = (1 - U) ** (2 * n + 8)
        self.count = ratio(by(self.first_terms(1).error, s=-1), self.slopes) / U
        # A distance that is wrong by m changes the slopes, between the places, by m times the greatest second derivative.
        self.per_move = ratio(self.sums(lambda j: j * (j - 1), 2, 2), self.squares)
        # Where it leads beyond Y.
        self.more = SQUARES * ((1 + MOVED) ** (n - 2) - 1) * MOVED / U
        self.near = self.count + self.more

    def sums(self, number, first, less):
        """The sum of number(j) |c_j| Y^(j - less), with Y = |x| + |s|."""
        return {(j, a, j - less - a): Fraction(number(j) * comb(j - less, a))
                for j in range(first, self.n + 1) for a in range(j - less + 1)}

    def first_terms(self, of_coefficient):
        """The error of s (d1 + d2 s), as computed, per |s|, by Horner's passes over numbers that are each so many roundings wrong."""
        c = [Number({(j, 0, 0): Fraction(1)}, {(j, 0, 0): of_coefficient * U / (1 - U)}) for j in range(1, self.n + 1)]

        def horner(to):
            for k in range(self.n - 2, to - 1, -1):
                c[k] = c[k] + c[k + 1].times(x=1)

        horner(0)
        horner(0)
        d1 = c[0]
        horner(1)
        return (d1 + c[1].times(s=1)).times(s=1)

    def holds(self, needed, rounding):
        """Does a factor of so many ROUNDINGs cover so many roundings? D is computed, too: less by `deep`."""
        return needed <= rounding * ROUNDING * self.deep / U


mass, time = Degree(6), Degree(3)
N = mass.n

proven(f"the first two terms are wrong by at most {float(mass.count):.4f} * 2^-24 |s| D")
require(ratio(by(mass.first_terms(2).error, s=-1), mass.slopes) > mass.count * U, "a coefficient that is known less exactly counts")

beyond = {(j, j - k, k - 3): Fraction(comb(j, k)) for j in range(3, N + 1) for k in range(3, j + 1)}
cubes = ratio(beyond, mass.cubes)
require(cubes == Fraction(comb(N, 3), N), "10/3")
covers = lambda number: cubes * (1 + 4 * U) <= number * mass.deep
require(covers(CUBES) and not covers(CUBES - Fraction(1, 10)), "3.4 covers 10/3 and rounding")
proven(f"the terms from the third on are at most 10/3 E |s|^3: {float(CUBES)} covers that and its rounding")

require(mass.per_move == SQUARES and time.per_move == 2, "5 is j - 1 at most")
proven(f"a distance rounded by m costs at most {SQUARES} m (2 |c_2| + E Y), and where it leads beyond Y at most {float(mass.more):.3f} * 2^-24 D more")

# From the other end a place's distance is itself one rounding, from inside two, which `moved` does not know.
ONCE = Fraction(1001, 1000)
far = mass.near + SQUARES * ONCE
# From inside, c_5 + 6 c_6 P has three roundings of 6 |c_6| P, one of the end's c_5, which is at most |c_5| + 6 |c_6| P, and one of
# the sum, so |c_5| counts once more and 6 |c_6| P four times. That 6 |c_6| P x^4 <= D(x) follows from the density's sign,
# below.
inside = mass.near + 2 * SQUARES * ONCE + 1 + SQUARES * 4 * ONCE
slow = time.near + SQUARES * Fraction(2, SQUARES) * ONCE
for which, needed, factor in (
    ("mass | the end that faces the side", mass.near, 1),
    ("mass | the other end", far, OTHER_END),
    ("mass | a minimum inside", inside, INSIDE),
    ("time | an end", time.near, 1),
    ("time | where time is slowest", slow, 1),
):
    said, bound = documented(rf"\| {re.escape(which)}[^|]*\| ([\d.]+) \| (\d+) \|")
    require(0 <= Fraction(said) - needed < Fraction(1, 100), f"docs/internals/proofs.md has {said} roundings for {float(needed)}: {which}")
    require(Fraction(bound) == factor * ROUNDING / U, f"docs/internals/proofs.md has a bound of {bound} roundings: {which}")
for name, needed, rounding, less in (
    ("the end that faces the side", mass.near, Fraction(1), Fraction(3, 4)),
    ("the other end", far, OTHER_END, OTHER_END - Fraction(1, 8)),
    ("a minimum inside", inside, INSIDE, INSIDE - Fraction(1, 4)),
):
    claim = f"a mass's search from {name} takes {float(needed):.3f} roundings, and {float(rounding)} ROUNDING are {float(rounding * ROUNDING / U):g}"
    require(mass.holds(needed, rounding), claim)
    require(not mass.holds(needed, less), f"{claim}: {float(less)} would do")
    proven(f"{claim}: what is left is at most 0.75 of the error; {float(less)} would not do")

# With a_k = (k + 1) |c_(k+1)| P^k and their signs, the density is not negative up to P on either side of the minimum: at P and -P
# that says that |a_5| is at most the sum of the others. So a_5 (x/P)^4 <= D(x) for x <= P; beyond, a_5 (x/P)^5 is more.
import z3

a, x = z3.Reals("a0 a1 a2 a3 a4 a5"), z3.Real("x")


def size(v):
    return z3.If(v < 0, -v, v)


def is_bounded(most):
    solver = z3.Solver()
    solver.add(sum(a) >= 0, a[0] - a[1] + a[2] - a[3] + a[4] - a[5] >= 0, sum(size(v) for v in a[:5]) < most * size(a[5]))
    return solver.check() == z3.unsat


require(is_bounded(1) and not is_bounded(1 + Fraction(1, 100)), "the last coefficient")
for lower in (True, False):
    # D(x) >= (x/P)^4 (|a_0| + ... + |a_4|) for x <= P, since (x/P)^k >= (x/P)^4.
    solver = z3.Solver()
    solver.add(x > 0, x <= 1 if lower else x > 1, *(v >= 0 for v in a), sum(a[:5]) >= a[5])
    solver.add(sum(v * x**k for k, v in enumerate(a)) < a[5] * x**4)
    require(solver.check() == z3.unsat, "6 |c_6| P x^4 <= D")
proven("around a minimum 6 |c_6| P x^4 <= D(x), since the density is not negative within P of it")

# Times. From an end the place is its distance. From inside the distance is rounded once, for the place there is one number.
require(time.holds(slow, Fraction(1)) and not time.holds(slow, Fraction(1, 2)), "times")
proven(f"a time's search takes {float(time.near):.3f} roundings from an end and {float(slow):.3f} from where time is slowest: ROUNDING is {float(ROUNDING / U):g}; half of it would not do")
# There the slope and c_2 may cancel: their pairs err by what `thrice`, `times`, `plus`, `times`, `plus` lose (pairs.py), in 2^-48 of
# the sum T of the slope's terms without their signs. With the least slope m >= 0 and c = c_3 there, T = m + 12 c P^2 and the time to
# there is t = m P + c P^3, so T P <= 12 t; and the target is at least t / 2. For Y <= P the step's error, |s| (1 + 2) of it
# with |s| <= Y, is then a small part of the error asked for. For Y >= P it is one of D, since D >= m + 3 c Y^2 >= T / 4.
PAIRS = 6 + 11 + 16 + 11 + 16
TIME_ERROR = Fraction(1, 1 << int(source(r"const TIME_ERROR: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
part = 3 * PAIRS * U * U * 12 * 2 / TIME_ERROR
m, c, y = z3.Reals("m c y")
solver = z3.Solver()
solver.add(m >= 0, c >= 0, y >= 1, m + 12 * c > 4 * (m + 3 * c * y * y))
require(solver.check() == z3.unsat, "T <= 4 D")
require(part < Fraction(1, 200), "a part of the error")
require(time.holds(slow + 3 * 4 * PAIRS * U, Fraction(1)), "a part of D")
proven(f"where the slope cancels there, that costs at most {float(part):.4f} of the error that is asked for, or {float(12 * PAIRS * U):.5f} roundings")

# A quick place: the same two Taylor coefficients, at an exact distance from an end. Whatever the guess, the step and the
# reciprocals are, an accepted step leaves 0.75 of the error. A quarter is left for measuring.
code("pub(crate) const fn quick_place(&self, side: Side, target: Pair) -> Option<Pair> {", """
    let Series { c, last } = self.time_since(side);
    let (c, single) = ([c[0], c[1], last], [c[0].hi, c[1].hi, last.hi]); let [c1, c2, _] = single; let sought = target.hi;
    let x = sought * c1 / (c1 * c1 + c2 * sought); let local = Taylor::new(&single, x);
    let inverse = 1.0 / local.d1; let newton = (sought - local.value) * inverse; let bend = local.d2 * newton * inverse;
    let x = upper(x + newton * (1.0 - bend * (1.0 - bend))); let local = Taylor::new(&single, x);
    let missing = target.difference(value(c, x));
    let inverse = inverse * (2.0 - local.d1 * inverse); let newton = missing * inverse;
    let step = newton * (1.0 - local.d2 * newton * inverse); let place = Pair::sum(x, step);
    let is_inside = place.hi.to_bits() <= LAST_PLACE.to_bits();
    let rest = left(&single, &local, 0.0, missing, step, ROUNDING);
    if is_inside & (rest <= 0.75 * (TIME_ERROR * target.hi)) { Some(place) } else { None } }""")
# Time never runs back: t' is a sum of squares (p - s)^2 and p (1 - p), times numbers that are not negative. So its terms are at most
# TERMS times the time: for a square that is 13 s^2 - 15 s + 13/3 >= 0, for p (1 - p) it is 5.
TERMS = int(documented(r"the terms of a time are at most (\d+) times the time"))
half_gap = lambda terms: (terms + 1) ** 2 - 4 * (terms - 1) * Fraction(terms - 1, 3)
require(half_gap(TERMS) < 0 < half_gap(TERMS - Fraction(1, 8)), "the terms of a time")
# What is missing is at most this share of the target, or `size * rounding * slopes` alone would refuse: |s| D is at least what the
# first two terms come to. So target and value are within a factor of two, and `difference` rounds once more than their rests.
missing = Fraction(3, 4) * TIME_ERROR * (1 / ROUNDING + 1) / time.deep
measured = U * missing + TERMS * (Fraction(31) + 1 + 6) * U * U * 2 + 2 * U * U
require(missing < Fraction(1, 2) and measured < TIME_ERROR / 4 and TERMS * 2**9 * U * U * 2 < TIME_ERROR / 4, "measuring")
require(time.holds(time.near, Fraction(1)), "a quick place")
proven(f"a quick place: the terms of a time are at most {TERMS} times the time; at most 2^{log2(missing):.1f} of the target is missing, and measured to 2^{log2(measured):.1f}; what is left is at most 2^-28")

# The end of the search: neighbours are 2^-23 of a place p apart, and p D <= 6 * 1083 times what is collected up to p. From the other
# end D is at most that of all of the ramp, which has at most twice the target; from inside the factor is 2 by cases.
markov = int(documented(r"without their signs are at most (\d+) times the mass"))
for name, rounding, times, pattern in (
    ("the end that faces the side", Fraction(1), 1, r"2⁻(\S+) from the end that faces the side, where"),
    ("the other end", OTHER_END, 2, r"2⁻(\S+) from the other end and"),
    ("a minimum inside", INSIDE, 2, r"2⁻(\S+) from a minimum inside, where"),
):
    ends = times * rounding * ROUNDING * Fraction(1, 2**23) * N * markov * Fraction(1001, 1000)
    said = number(documented(pattern))
    require(abs(said + log2(ends)) <= 0.05, f"docs/internals/proofs.md has 2^-{said} for 2^{log2(ends)}: {name}")
    require(ends < Fraction(3, 4) * Fraction(1, 2**26), "the end")
    proven(f"between neighbours the bound's terms without r are at most 2^{log2(ends):.2f} of the target from {name}")
# The same for a time, of which the terms are a cubic's: on any part of a ramp t' is a sum of such squares and products.
ends = 2 * ROUNDING * Fraction(1, 2**23) * 3 * TERMS * Fraction(1001, 1000)
said = number(documented(r"the same is at most 2⁻(\S+) of the time"))
require(abs(said + log2(ends)) <= 0.05 and ends < Fraction(3, 4) * TIME_ERROR, f"the end for a time: 2^{log2(ends)}")
proven(f"and at most 2^{log2(ends):.2f} of a time")
open_point("that the last step stays in the bracket where the density nearly vanishes is measured, not proven")
# Measuring r: within a sixteenth of what is asked for.
require(-31 < log2(Fraction(markov, 2**41)) < -30.9, "measuring what is missing")
proven("what is missing is measured to 2^-30.9 of the target")
