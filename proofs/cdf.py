"""src/by_octave.rs, cdf.rs: that the cdf never steps back where an octave's polynomial has a say; by z3, and exact fractions.

T(u) is the exact time of a fraction u, and P(m) the time, in units, that a polynomial has for the middle m of two f32. A `cdf` at a
time t, an f32, is at one of these:

- *by the octave*: P(m) <= t < P(m') for the middles m and m' below and above the answer;
- *settled*: t >= P(m), or t < P(m), where m is the middle next to what was measured;
- *told*: at a time within FOR_TIME of t the mass is on the answer's side of each middle, by more than what P's fraction may be off.
"""

from solver import *

code("pub(crate) fn cdf_by_octave(&self, ramp: usize, t: f32) -> Option<f32> {", """
    if OCTAVES == 0 || self.runs_across_0() { return None; }
    let time = self.in_units(t)?;
    let (side, index) = self.octave_about(ramp, time)?;
    let octave = self.octaves[side & 1].get(index)?;""")
code("let top = octave::top(self.tops[side & 1][ramp & 1]).wrapping_sub((index as u32) << 23);", """
    let power_bits = top & !(BINADE - 1); let eighths = (top / TOP_STEP) & 7; let end = (8 + eighths) << 28;
    let since_start = doubled.wrapping_add((8 - eighths) << 28);
    let a = (end >> 1) + (since_start >> 1);
    let apart = if side == 0 { 7 + (a >> 31) } else { (7 + 127) - power_bits / BINADE };
    if apart > 24 { return None; }
    let [distance, half] = [1 << apart; 2]; let n = (a + (distance >> 1)) >> apart;
    let bits = if side == 0 { (power_bits - 2 * BINADE + n).wrapping_add((a >> 31) * BINADE) } else { ONE - n };
    let leaves_ramp = if ramp == 0 { bits >= self.last.wrapping_sub(self.count) } else { bits <= self.last + 1 };
    if leaves_ramp { return None; }
    let leaves_octave = (n + 1) << apart > end || (n - 1) << apart <= end >> 1;
    let leaves_side = if side == 0 { bits >= HALF } else { bits <= HALF + 1 };
    let position = n << apart << 1;
    if leaves_octave || leaves_side || position == 0 { return None; }
    let octave = core::hint::black_box(octave);
    let low = octave.polynomial(octave.ahead_of_center(position.wrapping_sub(half) as i32));
    let high = octave.polynomial(octave.ahead_of_center(position.wrapping_add(half) as i32));
    ((low <= y) & (y < high)).then_some(f32::from_bits(bits))""")
code("let way = time.wrapping_sub(octave.middle) >> (octave.factor.trailing_zeros() & 31);", """
    if way != way as i32 as i64 || !octave.exists() { return None; } let y = way as i32 ^ -(side as i32);
    let doubled = octave.inverted(y);""")
code("self.middle.wrapping_add(self.factor as i64 * self.polynomial(x) as i64)", "")
code("fn in_units(&self, t: f32) -> Option<i64> {", """let (bits, sign) = (t.to_bits(), (t.to_bits() as i32 >> 31) as i64);
    let up = (bits >> 23 & 0xFF).wrapping_add(1).wrapping_sub(self.scale.to_bits() >> 23);
    if up > 31 { return None; } let word = bits << 8 | 1 << 31;
    let units = ((word >> 1 >> (31 - up)) as i64) << 32 | (word << up) as i64;
    Some((units ^ sign).wrapping_sub(sign))""")
code("pub(crate) fn time_between(&self, bits: u32) -> Option<i64> {", """
    let both = [bits, bits.wrapping_add(1)].map(f32::from_bits);
    let [before_last, next_before_last] = both.map(|u| self.before_last(u));
    let [(side, a), (other, b)] = both.map(Self::nearer);
    let is_one_ramp = side == other && before_last >> 31 == next_before_last >> 31;
    let on_line = before_last < self.count || next_before_last < self.count;
    if self.runs_across_0() || !is_one_ramp || on_line { return None; }
    let ramp = (before_last >> 31) as usize;
    let (octave, a) = self.look_up(side, ramp, a)?; let (same, b) = self.look_up(side, ramp, b)?;
    let [a, b] = [a, b].map(octave::doubled);
    let middle = a.wrapping_add(b.wrapping_sub(a) >> 1);
    let is_served = core::ptr::eq(octave, same) && octave.exists();
    is_served.then(|| octave.time(octave.ahead_of_center(middle)))""")
code("if OCTAVES > 0 && let Some(time) = self.time_between((lesser / WHOLE).to_bits())", "{ return if fixed(t, self.unit()) >= time { greater } else { lesser }; }")
code("let is_told = nearest > least_told", "&& distance >= nearest * NEAR_MIDDLE;")

# A time of so many units: `scale` is 2^32 of them, so an f32 with its exponent, less by one, has a significand of 2^31 units.
bits, up = BitVecs("bits up", 32)
significand = ZeroExt(32, bits & 0x7FFFFF | 1 << 23)
whole = (bits << 8) | (1 << 31)
units = ZeroExt(32, LShR(LShR(whole, 1), 31 - up)) << 32 | ZeroExt(32, whole << up)
valid(
    "by the octave: a time in units is exact, from 2^31 of them to 2^63",
    Implies(ULE(up, 31), units == significand << ZeroExt(32, up + 8)),
)

# The comparison with a polynomial's time, by words. The factor is a power of two below 2^31 or, on the later side, minus one.
# Times are at most 2^62 either way, and a factor's products 2^61, so nothing overflows.
since, p = BitVec("since", 64), BitVec("p", 32)


def compares(up, later, at=0):
    way = since >> up
    y = Extract(31, 0, way) ^ (-1 if later else 0)
    product = SignExt(32, p) << up
    is_reached = since >= (-product if later else product)
    fits = way == SignExt(32, Extract(31, 0, way))
    return Implies(fits, is_reached == (p + at > y if later else p + at <= y))


for up in range(31):
    for later in (False, True):
        solver = Solver()
        solver.add(Not(compares(up, later)))
        require(solver.check() == unsat, f"by the octave: the comparison, factor 2^{up}")
solver = Solver()
solver.add(Not(compares(3, False, 1)))
require(solver.check() == sat, "by the octave: the comparison, off by one")
proven("by the octave: a value is at most `y` just where the polynomial's time is not after `t`, and from the later side just where it is")

BINADE, STEP = 1 << 23, 1 << int(source(r"const TOP_STEP: u32 = 1 << (\d+);"))
LEAST = (127 - int(source(r"const LEAST_TOP: u32 = \(1\.0 / \(1 << (\d+)\) as f32\)\.to_bits\(\);"))) << 23
HALF, ONE = 126 << 23, 127 << 23


def word(n):
    return BitVecVal(n, 32)


def doubled(top, bits):
    """Is a fraction in the octave below `top`, and its position, doubled where it has to be? As `look_up` and `offset` have them."""
    below = top - bits
    position = (bits ^ ((top ^ below) & BINADE)) << 8
    return LShR(below, 23) == 0, position + (position & ~(position >> 31))


# The fraction that `n` stands for, its neighbours and the middles between them. `top` is the octave's own: index 0.
n, top = BitVecs("n top", 32)
power, eighths = top & ~word(BINADE - 1), LShR(top, 20) & 7
end = (8 + eighths) << 28
is_top = And(top & (STEP - 1) == 0, UGE(top, LEAST - BINADE), ULT(top, 128 << 23))


def leads(apart, bits_of, first, last, below=1, above=1):
    """For `n` whose neighbours are in the octave: all three are looked up there, at positions that are `n` and its neighbours."""
    position = (n << apart) << 1
    # `a` is at most half of `end` and half of a word.
    most = (((15 << 27) + (1 << 31)) >> apart) + 1
    served = And(ULE((n + above) << apart, end), UGT((n - below) << apart, LShR(end, 1)), UGE(n, first), ULE(n, last), position != 0, ULE(n, most))
    found = []
    for step in (-1, 0, 1):
        inside, at = doubled(top, bits_of(n + step))
        found += [inside, at == position + 2 * (step << apart)]
    return Implies(And(is_top, served), And(found))


for upper, less in ((0, {"below": 0}), (1, {"above": 0})):
    bits_of = lambda n: power - 2 * BINADE + n + upper * BINADE
    valid(
        f"by the octave, first side, {'upper' if upper else 'lower'} binade: an f32 and its neighbours are looked up there, at the positions between which the middles are taken",
        leads(7 + upper, bits_of, 1 << 23, 1 << 24),
        leads(7 + upper, bits_of, 1 << 23, 1 << 24, **less),
    )
# From the later side the f32 are 2^-24 apart: `u = 1 - n 2^-24`, and 1 - u is exact. Its bits, by where n has its leading one.
solver = Solver()
for lead in range(6, 24):
    def bits_of(m):
        # m is next to n, so its leading one is one place off at most.
        def at(lead):
            return word((lead - 24 + 127) << 23) | ((m << (23 - lead) if lead <= 23 else LShR(m, lead - 23)) & (BINADE - 1))
        return If(ULT(m, 1 << lead), at(lead - 1), If(ULT(m, 2 << lead), at(lead), at(lead + 1)))

    for exponent in range(lead - 24 - 1, lead - 24 + 3):
        apart = 7 - exponent
        if not 7 < apart <= 24:
            continue
        claim = Implies(LShR(top, 23) == exponent + 127, leads(apart, bits_of, 1 << lead, (2 << lead) - 1))
        solver = Solver()
        solver.add(Not(claim))
        require(solver.check() == unsat, f"by the octave, later side, n of {lead + 1} bits, {exponent}")
proven("by the octave, later side: the same")

# Two neighbours: their positions are multiples of 2^8, so half of their distance is exact, and fits.
a, b = BitVecs("a b", 32)
(_, at), (_, next_at) = doubled(top, a), doubled(top, b)
valid("settled: the position of a middle is exact", And(at & 0xFF == 0, (next_at - at) & 1 == 0))

# Each middle is between two fractions that one polynomial answers, so the certificate holds for it: P(m) is within E of the time of some
# fraction within OFF of m. So middles m < m' have times P(m) <= X (1 + E) and P(m') >= Y (1 - E) with X <= Y, where the X and
# Y are exact times, positive ones (negative ones are mirrored).
E = Fraction(source(r"const FORWARD_ERROR: f32 = ([\d.]+) / \(1u32 << 27\) as f32;")) / 2**27
FOR_TIME = Fraction(1, 1 << int(source(r"const FOR_TIME: f32 = 1\.0 / \(1 << (\d+)\) as f32;")))
x, y, t, later, other = Reals("x y t later other")
# f32 are at least this share of the lesser one apart.
apart = Fraction(1, 2**24)
pair = And(t > 0, later >= t * (1 + apart), x > 0, x <= y)


def real(number):
    return Q(number.numerator, number.denominator)


def never(claim, *steps_back):
    """`t` has the greater answer and `later` the lesser one."""
    for error, holds in ((E, unsat), (E * 6, sat)):
        solver = Solver()
        solver.add(t > 0, later >= t * (1 + real(apart)), x > 0, x <= y, *(step(real(error)) for step in steps_back))
        require(solver.check() == holds, f"{claim}: {float(error)}")
    proven(f"order: {claim}")


greater_by_polynomial = lambda e: t >= y * (1 - e)
lesser_by_polynomial = lambda e: later < x * (1 + e)
# A told answer: the time where the mass was measured, `other`, is within FOR_TIME of the way, which is no longer than the time.
greater_told = lambda e: And(other >= y, other - t <= real(FOR_TIME) * t)
lesser_told = lambda e: And(other <= x, later - other <= real(FOR_TIME) * later)
never("the answers of an octave, or settled by one, do not step back, whichever polynomials and middles", greater_by_polynomial, lesser_by_polynomial)
never("from a told answer to one of an octave", greater_told, lesser_by_polynomial)
never("from one of an octave to a told answer", greater_by_polynomial, lesser_told)

# What is told next to a middle is farther from it than measuring errs, and P's fraction is off.
markov, noise = int(documented(r"without their signs are at most (\d+) times the mass")), Fraction(229, 2**48)
near = Fraction(source(r"const NEAR_MIDDLE: f32 = ([\d.]+) / \(1 << 28\) as f32;")) / 2**28
little = Fraction(source(r"const LITTLE: f32 = ([\d.]+);"))
off = Fraction(1, 1 << int(source(r"const OFF: \[f32; 2\] = \[1\.0 / \(1u64 << 54\) as f32, 1\.0 / \(1u64 << (\d+)\) as f32\];")))
require(near - markov * noise / little > 64 * off, "NEAR_MIDDLE")
# The other way to tell, by the inverse of the middle, errs as well: `n` in docs/proofs.md, the worst of three places to search from.
searched = max(2 ** -float(said.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹·", "0123456789."))) for said in (
    documented(r"2⁻(\S+) from the end that faces the side, where"),
    documented(r"2⁻(\S+) from the other end and"),
    documented(r"2⁻(\S+) from a\s+minimum inside, where"),
))
together = markov * noise / little + Fraction(searched * 2**0.05) + Fraction(markov, 2**41)
require(together <= near < together * Fraction(9, 8), f"2^{log2(together):.2f} and NEAR_MIDDLE")
proven(f"what is measured and the inverse of a middle are off by 2^{log2(together):.2f} together, less than NEAR_MIDDLE")
proven(f"a told mass is 2^{log2(near - markov * noise / little):.1f} of it beyond the middle, and a polynomial's fraction off by 2^{log2(off):.0f}")

# Times are compared in units: exactly, as a polynomial's time is 2^26 units or more. A t below 2^24 units is cut, but is less.
truncation = Fraction(source(r"const HALF_TRUNCATION: f32 = (1\.\d+);"))
least = truncation / E
require(least > 2**26 and least * (1 - E) > 2**24, "the least time of a polynomial")
proven(f"a polynomial's time is at least 2^{log2(least):.1f} units, and an f32 from 2^24 on has whole ones")
