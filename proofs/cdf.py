"""That the cdf never steps back: the numbers and the cases of docs/internals/proofs.md, by exact fractions and z3."""

from solver import *

code("let t = match self.at(t) {", "At::Ramp(ramp) => self.ramp(ramp).on_grid(t), _ => t, }; match self.at(t) {")
code("const fn gridded(start: f32, end: f32, t: f32) -> f32 {", """
    let half = 0.5 * power_of_two(exponent(if end > -start { end } else { -start }));
    if t.abs() >= half || t == start || t == end { return t; } let t = (t + 1.5 * half) - 1.5 * half;
    if t < start { start } else if t > end { end } else { t } }""")
code("if start < 0.0 && end > 0.0 {", "gridded(start, end, t) } else { t }")
code("const fn place_from_start(&self) -> Pair {", """let Pair { hi, lo } = self.place; if self.side.is(Start) { return self.place; }
    let rest = Pair::sum(LAST_PLACE, -hi); Pair::sum(rest.hi, rest.lo - lo) }""")
code("pub(crate) const fn mass(&self) -> Pair {", """
    let mass = self.ramp.mass_since(Start).at_pair_unrolled(self.place_from_start());
    mass.scaled(fraction_per_mass(self.ramp.share.hi)) }""")
code("pub(crate) fn noise(&self, side: Side) -> f32 {", """let place_from_start = self.place_from_start().hi;
    let terms_from = |side: Side| { let x = if side.is(Start) { place_from_start } else { LAST_PLACE - place_from_start };
    let c = self.ramp.mass_in_single(side); c.iter().rev().fold(0.0, |terms, c| (terms + c.abs()) * x) };
    let terms = terms_from(Start) + terms_from(side);
    terms * fraction_per_mass(self.ramp.share.hi) / (1u64 << 39) as f32 }""")
code("if ramp.is(Start) { part } else {", """self.ramps[0].share.plus(self.plateau).plus(part) };
    self.nearest(t, mass, |side| point.noise(side)) }""")
code("let rest = (mass.hi - nearest) + mass.lo;", """
    let next = f32::from_bits(nearest.to_bits().wrapping_add_signed(if rest < 0.0 { -1 } else { 1 }));
    let (lesser, greater) = if next < nearest { (next, nearest) } else { (nearest, next) };
    let side = Side::end_if(lesser >= 0.5 * WHOLE); let half = 0.5 * (next - nearest);
    let is_told = (half - rest).abs() > noise(side) + 2.0 * CDF_ERROR * nearest;
    let cdf = if is_told { nearest } else if t >= self.time_of(side, Pair::sum(nearest, half)) { greater } else { lesser };""")
code("let a = if side.is(Start) { mass }", "else { Pair::new(WHOLE).minus(mass) }; self.at_fraction(side, a, CDF_ERROR).time() }")

# The grid, for a farther end from P to 2 P: sums from P / 4 to 5 P / 4, so multiples of P / 2^25, which they leave exactly.
TIME_ERROR = Fraction(1, 1 << int(source(r"const TIME_ERROR: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
spacing, near, length = Fraction(1, 4) / 2**23, Fraction(1, 2), 4
require(near / spacing <= 2**24 and near / 2**23 >= spacing, "what is on the grid is an f32")
require(TIME_ERROR * length / 2 == spacing / 4, "a quarter")
start, t, end, way = Reals("start t end way")
valid(
    "the time of a place is within a quarter of the distance to the next time: on the grid, where that is a quarter of the farther end's ulp or more, and else, as the way is at most the time",
    Implies(And(0 <= start, start <= t, t <= end, Or(way == t - start, way == end - t), way <= t - start, way <= end - t), Q(1, 2**28) * way <= Q(1, 4) * Q(1, 2**24) * t),
    Implies(And(0 <= start, start <= t, t <= end, Or(way == t - start, way == end - t)), Q(1, 2**28) * way <= Q(1, 4) * Q(1, 2**24) * t),
)

# The noise, in 2^-48 of the terms: the measured mass has those of `at_pair`, of a place from the start whose rest is rounded (only if
# that is beyond the middle: by 2^-48 of it, times the slope), and of a sum with a second number of (12 + 6) 2^-24.
at, at_pair = (int(documented(rf"`Series::{name}` is within (\d+) · 2⁻⁴⁸")) for name in ("at", "at_pair"))
measured = at_pair + 6 + 2 * (12 + 6)
# The inverse measures what is missing, with one rounding of its own, and its last step is less than an ulp: 2^-20 of D times 2^-23.
rounding = Fraction(1, 1 << int(source(r"const ROUNDING: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
inverse = at + 12 + 6 * 2 + 6 * rounding / 2**23 * 2**48
allowed = Fraction(2**48, 2 ** int(source(r"fraction_per_mass\(self\.ramp\.share\.hi\) / \(1u64 << (\d+)\) as f32"))) * (1 - U) ** 15
cdf_error = Fraction(2**48, 1 << int(source(r"const CDF_ERROR: f32 = 1\.0 / \(1u64 << (\d+)\) as f32;")))
require(allowed / 2 < measured < allowed and allowed / 2 < inverse < allowed, "noise: half of it would do")
require(Fraction(3, 4) * cdf_error <= 6 * rounding / 2**23 * 2**48, "a step that is not less than an ulp leaves no more")
# Sums of pairs, as multiples of the mass: two of the cdf, a rest and its difference, and on the plateau a quotient; four of the inverse.
sums = 2 * 3 + 2 + 36 + 4 * 6 + 16
require(sums < 2 * cdf_error, "2 CDF_ERROR")
proven(f"noise: {float(allowed):.1f} * 2^-48 of the terms from either end are more than the {measured} that the measured mass may be off by and the {float(inverse):.0f} of the inverse, searched from the end that faces the side; and 2 CDF_ERROR more than all sums")
markov = int(documented(r"without their signs are at most (\d+) times the mass"))
most = Fraction(2 * markov * allowed + 2 * cdf_error, 2**48)
require(most < Fraction(1, 2**25) < 8 * most, "half of the distance")
proven(f"noise: together at most 2^{log2(most):.1f} of the mass, less than the 2^-25 that are half of the distance of two middles")

# The cases, with the distance to the next time as unit. `middle` is the exact time of the place that the inverse found, `given` the f32.
g, h, tau_g, tau_h, middle, given, off = Reals("g h tau_g tau_h middle given off")
times = And(h >= g + 1, tau_g <= g + Q(1, 4), tau_h >= h - Q(1, 4))
rounded = And(Implies(given > h, middle > h - off), Implies(given <= g, middle <= g + Q(1, 2) + off))
above = {"told": tau_g > middle, "settled": g >= given}
below = {"told": tau_h < middle, "settled": h < given}
for first in above:
    for then in below:
        step_back = lambda most: Not(And(times, rounded, off >= 0, off <= most, above[first], below[then]))
        worse = [step_back(Q(26, 100))] if (first, then) == ("settled", "told") else []
        valid(f"{first} above a middle, no later time is {then} below it", step_back(Q(1, 4)), *worse)
