"""src/octave.rs, plan.rs, by_u64.rs: that the answer's path computes the `x` at which a polynomial was judged, by z3; and what
Horner's rule in integers truncates, by Gappa."""

from solver import *


code("pub(crate) const fn offset(&self, position: i32) -> i32 {", "self.ahead_of_center(doubled(position)) }")
code("pub(crate) const fn doubled(position: i32) -> i32 {", "position.wrapping_add(position & !(position >> 31)) }")
code("pub(crate) const fn ahead_of_center(&self, doubled: i32) -> i32 {", """
    doubled.wrapping_sub(self.center as i32) << (self.center & FINER) }""")
code("let below = top.wrapping_sub(bits);", """let octave = self.octaves[side & 1].get((below >> 23) as usize)?;
    let borrowed = bits ^ (top ^ below) & 1 << 23; Some((octave, (borrowed << 8) as i32))""")
code("let (before_last, is_beyond) = plateau.last.overflowing_sub(u);", """if before_last < plateau.count {
    return Some(Direct::Line); } let side = (u >> 63) as usize;
    let a = if side == 0 { u } else { u.wrapping_neg() }; let (high, low) = ((a >> 32) as u32, a as u32);
    let zeros = high.leading_zeros();
    let significand = high << (zeros & 31) | low >> 1 >> (31u32.wrapping_sub(zeros) & 31);
    let top = octave::top(self.tops[side & 1][is_beyond as usize]); let end = top << 8 | 1 << 31;
    let zeros = zeros.wrapping_sub((significand > end) as u32); const OF_HALF: u32 = 0.5f32.to_bits() >> 23;
    let index = (top >> 23).wrapping_add(zeros).wrapping_sub(OF_HALF);
    let octave = self.octaves[side & 1].get(index as usize)?; if !octave.exists() { return None; }
    let (less, zeros) = (side as u32, zeros & 31); let back = 0u32.wrapping_sub(less);
    let ahead = (octave.center ^ !back).wrapping_add(1);
    let factor = ((1 << (octave.center & FINER)) ^ back).wrapping_sub(back);
    Some(Direct::Octave(OctaveU64 { octave, less, zeros, end, ahead, factor })) }""")
code("fn word(&self, u: u64) -> u32 {", """let u = u.wrapping_sub(self.less as u64);
    let (high, low) = ((u >> 32) as u32, u as u32); high << 1 << self.zeros | low >> (31 - self.zeros) }""")
code("pub(crate) fn time(&self, u: u64) -> i64 {", "self.time_ahead(self.word(u).wrapping_add(self.ahead)) }")
code("pub(crate) fn time_ahead(&self, word: u32) -> i64 {", "self.octave.time(word.wrapping_mul(self.factor) as i32) }")
code("pub(crate) fn octave_reaches(", """&self, u: u64, octave: &OctaveU64, plateau: &PlateauU64) -> u32 {
    let last = if octave.less == 0 { octave.end << 1 | 1 } else { !(octave.end + 1) };
    let words = last.wrapping_sub(octave.word(u));
    let ramp = plateau.last.wrapping_sub(plateau.count).wrapping_sub(u);
    let side = !((u >> 32) as u32) & (u32::MAX >> 1);
    (words >> 1 >> octave.zeros).min((ramp >> 32) as u32).min(side) }""")
code("pub(crate) fn line_reaches(", """&self, u: u64, plateau: &PlateauU64) -> u32 {
    (plateau.last.wrapping_sub(u) >> 32) as u32 }""")
code("const fn center(&self) -> i64 {", """fixed(self.middle, exponent(self.power) - 32) & !(FINER as i64) | self.finer as i64 }""")
code("pub(crate) const fn new(range: [f64; 2], top: u32) -> Option<Self> {", """let high = f32::from_bits(top);
    let from = if range[0] > 0.5 * high as f64 { range[0] } else { 0.5 * high as f64 };
    let to = if range[1] < high as f64 { range[1] } else { high as f64 };
    if top < LEAST_TOP || from >= to { return None; }
    let to = to as f32; let power = power_of_two(exponent(high));
    let half = 0.5 * (to - from as f32) + 4.0 * f32::EPSILON * power; let middle = 0.5 * (from as f32 + to);
    let (mut width, mut finer) = (power, 0);
    while finer < MOST_FINER && half <= FILLED * width { width *= 0.5; finer += 1; }""")
code("const fn top_beyond([from, to]: [f64; 2], steps: u32) -> u32 {", """let end = floor_bits(to);
    let end = if (f32::from_bits(end) as f64) < to { end + 1 } else { end };
    let least = if end > LEAST_TOP { end.div_ceil(TOP_STEP) * TOP_STEP } else { LEAST_TOP };
    let top = least + steps * TOP_STEP;
    let beyond = top.wrapping_sub(floor_bits(from));
    if from > 0.0 && beyond.wrapping_add(16) & 0x7F_FFFF < 32 { top + TOP_STEP } else { top }""")
code("let reach = span.half / span.width + 0.01;", """let (mut bound, mut most, mut steep, mut k) = (0.0, 0.0, 0.0, DEGREE);
    while k > 0 && k <= DEGREE { steep = steep * reach + bound; bound = c[k].abs() as f32 + bound * reach;
    most = if bound <= most { most } else { bound }; k = unknown(k - 1); }
    steep = steep * reach + bound; most *= 1.0 + 1.0 / (1 << 16) as f32;
    if !(most > 0.0 && most < f32::MAX) { return None; }
    let exponent = exponent(most) - 30; let exponent = if exponent < self.unit { self.unit } else { exponent };""")
code("octave.c[DEGREE - k] = rounded(c[k], exponent);", "")
code("fn nearer(u: f32) -> (usize, u32) {", """let (bits, late) = (u.to_bits(), (1.0 - u).to_bits());
    let is_late = bits as i32 > 0.5f32.to_bits() as i32;
    (is_late as usize, core::hint::select_unpredictable(is_late, late, bits)) }""")
code("fn before_last(&self, u: f32) -> u32 {", "self.last.wrapping_sub(u.to_bits()) }")
code("fn by_octave(&self, u: f32, before_last: u32) -> i64 {", """let (side, bits) = Self::nearer(u); let ramp = (before_last >> 31) as usize;
    match self.look_up(side, ramp, bits) { Some((octave, position)) if octave.exists() => octave.time(octave.offset(position)), _ => NO_TIME, } }""")
code("pub(crate) fn plateau_u64(&self) -> PlateauU64 {", """let [near, far] = self.exposure.joins_u64();
    let last = far.saturating_sub(!self.exposure.has_plateau() as u64);
    let before = near.saturating_sub(1).max(FINE_DOUBLE_WORD);
    let serves = Self::is_fine(self.slope);
    PlateauU64 { last, count: if serves { last.saturating_sub(before) } else { 0 } } }""")

FINER = int(source(r"const FINER: u32 = (\d+);"))
STEP = 1 << int(source(r"const TOP_STEP: u32 = 1 << (\d+);"))
LEAST_EXPONENT = 127 - int(source(r"const LEAST_TOP: u32 = \(1\.0 / \(1 << (\d+)\) as f32\)\.to_bits\(\);"))
LEAST = LEAST_EXPONENT << 23


def look_up(top, bits):
    """`Plan::octave`: the index and the position."""
    below = top - bits
    return LShR(below, 23), (bits ^ ((top ^ below) & (1 << 23))) << 8


def offset(position, center):
    """`Octave::offset`."""
    ahead = position & ~(position >> 31)
    return (position + ahead - center) << (center & FINER)


# The position is the place in the octave. `top` is below 2, `bits` those of a fraction above 0 and at most `top`.
top, bits = BitVecs("top bits", 32)
index, position = look_up(top, bits)
octave_top = top - (index << 23)
domain = And(UGT(bits, 0), ULE(bits, top), ULT(top, 128 << 23))
is_lower = position < 0
valid(
    "the look-up by f32 finds the octave below whose top, and above half of whose top, the fraction is",
    Implies(domain, And(ULE(bits, octave_top), UGT(bits + (1 << 23), octave_top))),
    Implies(domain, And(ULT(bits, octave_top), UGT(bits + (1 << 23), octave_top))),
)
valid(
    "the sign of a position says in which of the octave's two binades the fraction is, and the rest is its significand",
    Implies(And(domain, UGE(bits, 1 << 23)), And(
        LShR(bits, 23) == LShR(octave_top, 23) - If(is_lower, BitVecVal(1, 32), BitVecVal(0, 32)),
        position << 1 == bits << 9,
    )),
    Implies(domain, LShR(bits, 23) == LShR(octave_top, 23)),
)

# The offset. The fraction, in 2^-32 of the power of two at or below the octave's top, is an integer `exact` of 34 bits.
position, center = BitVec("position", 32), BitVec("center", 64)
wide = SignExt(32, position)
exact = (1 << 32) + If(position < 0, wide, 2 * wide)
shift = center & FINER
word = 1 << 31


def leads_to(least, most):
    fits = And(exact - center >= least >> shift, exact - center <= most >> shift)
    right = SignExt(32, offset(position, Extract(31, 0, center))) == (exact - center) << shift
    return Implies(And(ULT(center, 1 << 34), fits), right)


# As shifts round down, these limits are those of -2^31 <= (exact - center) 2^shift < 2^31.
valid(
    "offset is (exact - center) 2^shift, if that fits the word: for all positions, centers and shifts",
    leads_to(BitVecVal(-word, 64), BitVecVal(word - 1, 64)),
    leads_to(BitVecVal(-word, 64), BitVecVal(word, 64)),
    leads_to(BitVecVal(-2 * word, 64), BitVecVal(word - 1, 64)),
)

# Does it fit? All of this in 2^-32 of the octave's power of two. A part has f32 for its ends, and `half` is half its length and
# 4 EPSILON. It is exact unless it is above a quarter. The loop halves while half <= FILLED width, so after the last halving it is
# at most 2 FILLED of the width; without one it is at most a quarter of a top that is less than twice the width, by a step, and 4 EPSILON.
# The middle is off by the rounding of the sum of the ends, the center by what its lowest bits come to.
FILLED = Fraction(source(r"const FILLED: f32 = (0\.\d+);"))
MOST_FINER = int(source(r"const MOST_FINER: u32 = (\d+);"))
REACH = Fraction(source(r"let reach = span\.half / span\.width \+ (0\.\d+);"))
EPSILONS = int(source(r"let half = .* \+ (\d)\.0 \* f32::EPSILON \* power;"))
WORD = 2**32
EPSILON = WORD // 2**23
MIDDLE = EPSILON // 2  # half of the rounding of a sum below 4
LOW_BITS = FINER
# A served fraction is within half of EPSILON of the f32 between which the part is.
SERVED = EPSILON // 2


def most_filled(filled, finer):
    """The greatest half, in the width's 2^-32."""
    whole = (2 - Fraction(STEP, 1 << 23)) / 4 * WORD + EPSILONS * EPSILON
    return max(2 * filled * WORD, whole if finer == 0 else 0) * (1 + 2 * U)


def served_fits(filled, extension=EPSILONS):
    """Is the offset of each served fraction at most the half, and does that fit the word?"""
    return extension * EPSILON >= SERVED + MIDDLE + LOW_BITS and most_filled(filled, 0) < WORD / 2


require(served_fits(FILLED) and not served_fits(Fraction(1, 4)) and not served_fits(FILLED, 1), "served")
proven(f"the offset of each fraction that a part serves is within its half and fits the word, for FILLED = {float(FILLED)} and any shift; with 0.25, or a half of one EPSILON more than the part, not so")


def beyond_fits(filled, finer):
    """The same for fractions up to 4 EPSILON beyond the part."""
    return most_filled(filled, finer) + (MIDDLE + LOW_BITS) * 2**finer < WORD / 2


def reach_holds(finer):
    return (MIDDLE + LOW_BITS) * 2**finer <= REACH * WORD


far = max(finer for finer in range(32) if beyond_fits(FILLED, finer))
within = max(finer for finer in range(32) if reach_holds(finer))


require(MOST_FINER <= far and not beyond_fits(FILLED, far + 1), "fractions beyond a part fit the word")
proven(f"so do those of fractions up to {EPSILONS} EPSILON beyond, with all shifts up to {MOST_FINER} (up to {far} would do)")
# Tops keep 16 ulp from where a range begins.
bits, top = BitVecs("bits top", 32)
raised = If(ULT((top - bits + 16) & 0x7FFFFF, 32), top + STEP, top)
valid(
    "stretched: a range that begins above 0 begins 16 ulp or more below each octave's end, or above it",
    Implies(And(ULT(top, 128 << 23), ULT(bits, 128 << 23)), And(UGE((raised - bits) & 0x7FFFFF, 16), UGE((bits - raised) & 0x7FFFFF, 16))),
    Implies(And(ULT(top, 128 << 23), ULT(bits, 128 << 23)), UGE((raised - bits) & 0x7FFFFF, 17)),
)

# Horner's sums. With |x| within the reach, each is at most the bound of the exact one, half a unit for each coefficient's rounding
# and one for each product's, and the bound is computed with up to three roundings a step.
DEGREE = int(source(r"pub\(crate\) const DEGREE: usize = (\d+);"))
GUARD = 1 / Fraction(2 ** int(source(r"most \*= 1\.0 \+ 1\.0 / \(1 << (\d+)\) as f32;")))


def sums_fit(guard, per_step=Fraction(3, 2)):
    greatest = 2**31 / ((1 + guard) * (1 - U) ** (3 * DEGREE + 3))
    reach = 2 * FILLED + REACH
    return greatest + sum(per_step * reach**k for k in range(DEGREE)) < 2**31


require(reach_holds(within) and sums_fit(GUARD) and not sums_fit(GUARD / 2**6), "Horner's sums")
proven(f"Horner's sums fit 32 bits where |x| is within the reach: on all that a part serves, and {EPSILONS} EPSILON beyond with shifts up to {within}")
require(MOST_FINER <= within, "the reach covers all shifts")

# The look-up by u64 agrees with the one by f32, for fractions that are f32, from 2^-32 to 1/2.
byte = BitVec("byte", 8)
top = (ZeroExt(24, byte) + LEAST // STEP) * STEP
by_f32 = look_up(top, bits)
exponent = LShR(bits, 23)
OCTAVES = int(source(r"assert!\(OCTAVES <= (\d+),"))
a = ZeroExt(32, (bits & 0x7FFFFF) | (1 << 23)) << 40
a = LShR(a, ZeroExt(32, 126 - exponent))


def by_u64(a, zeros, compared=True):
    """`Plan::direct_u64` of an `a` with so many zeros: the index, and the zeros before the octave's power of two."""
    high, low = Extract(63, 32, a), Extract(31, 0, a)
    significand = (high << (zeros & 31)) | LShR(LShR(low, 1), (31 - zeros) & 31)
    end = top << 8 | 1 << 31
    zeros = zeros - (If(UGT(significand, end), BitVecVal(1, 32), BitVecVal(0, 32)) if compared else 0)
    return LShR(top, 23) + zeros - 126, zeros


def word(u, zeros, less):
    """`OctaveU64::word`, where `zeros` is a number of z3."""
    u = u - less
    high, low = Extract(63, 32, u), Extract(31, 0, u)
    return (high << 1 << zeros) | LShR(low, 31 - zeros)


def ahead(word, less, center):
    """The same and `ahead`: as `ahead_of_center` has it before it moves it up, from the later side with the other sign."""
    back = 0xFFFFFFFF if less else 0
    sum = word + (center ^ (~back & 0xFFFFFFFF)) + 1
    return -sum if less else sum


center = BitVec("center", 32)
is_lower = by_f32[1] < 0


def agree(zeros, compared=True):
    index, power = by_u64(a, zeros, compared)
    here = And(LShR(a, 63 - zeros) == 1, ULE(a, 1 << 63), exponent == 126 - zeros)
    none = And(UGE(index, OCTAVES), UGE(by_f32[0], OCTAVES))
    return Implies(here, Or(none, And(index == by_f32[0], power == zeros - If(is_lower, BitVecVal(1, 32), BitVecVal(0, 32)))))


def agree_in_x(zeros, lower, less, turned=0):
    here = And(LShR(a, 63 - zeros) == 1, exponent == 126 - zeros)
    position = (bits & 0x7FFFFF) << 8 | lower << 31
    found = word(-a if less else a, zeros - lower, less ^ turned)
    return Implies(here, ahead(found, less, center) == position + (position & ~(position >> 31)) - center)


for zeros in range(32):
    solver = Solver()
    solver.add(Not(agree(zeros)))
    require(solver.check() == unsat, "the look-ups agree")
    for lower, less in ((lower, less) for lower in (0, 1) for less in (0, 1) if lower <= zeros):
        solver = Solver()
        solver.add(Not(agree_in_x(zeros, lower, less)))
        require(solver.check() == unsat, "the look-ups agree in x")
for wrong in (agree(3, compared=False), agree_in_x(3, 0, 0, turned=1), agree_in_x(3, 1, 1, turned=1)):
    solver = Solver()
    solver.add(Not(wrong))
    require(solver.check() == sat, "the look-ups agree: less than this would do")
proven("the look-ups by f32 and by u64 find the same octave and x, for each f32 from 2^-32 to 1/2, each top, center and side")
w, f = BitVecs("w f", 32)
valid(
    "a word times its factor is the word moved up, from the later side with the other sign",
    And(*(And(w * (1 << finer) == w << finer, w * (((1 << finer) ^ -1) + 1) == -(w << finer)) for finer in range(32))),
    And(*(w * ((1 << finer) ^ -1) == -(w << finer) for finer in range(32))),
)
# One octave answers as far as `octave_reaches` says. The octave that `direct_u64` finds holds what is above its `start` and up to its
# `stop`; one more unit of 2^-32 might leave that.
u, v, last, count = BitVecs("u v last count", 64)
eighths = BitVec("eighths", 3)
end = Concat(BitVecVal(1, 1), eighths, BitVecVal(0, 28))


def reach_of_octave(u, power, less, more):
    words = (~(end + 1) if less else (end << 1 | 1)) - word(u, power, less)
    return ZeroExt(32, LShR(LShR(words, 1), power) + more) << 32


def reaches(power, more):
    stop = LShR(Concat(end, BitVecVal(0xFFFFFFFF, 32)), power)
    start = LShR(stop, 1)
    holds = And(UGT(u, start), ULE(u, stop))
    found = Or(*(And(LShR(u, 63 - zeros) == 1, by_u64(u, zeros)[1] == power) for zeros in (power, power + 1) if zeros < 32))
    is_this = And(top << 8 | 1 << 31 == end, UGE(u, 1 << 32), ULE(u, 1 << 63))
    # From side 0 `u` is `a`; from side 1 it is `-a`, and `a` falls. Neither may wrap.
    early, late = (reach_of_octave(-u if less else u, power, less, more) for less in (0, 1))
    yield Implies(is_this, found == holds)
    yield Implies(holds, And(ULE(early, stop - u)))
    yield Implies(holds, And(ULT(late, u - start)))


for power in range(32):
    for claim in reaches(power, 0):
        solver = Solver()
        solver.add(Not(claim))
        require(solver.check() == unsat, f"octave_reaches: {power}")
for claim in list(reaches(5, 1))[1:]:
    solver = Solver()
    solver.add(Not(claim))
    require(solver.check() == sat, "octave_reaches: more than this holds")
proven("octave_reaches: the octave that direct_u64 finds answers all up to there, but perhaps not a unit of 2^-32 farther")
valid(
    "octave_reaches: until there all are on the same side",
    Implies(And(UGE(v, u), ULE(v - u, ~u & (2**63 - 1))), LShR(v, 63) == LShR(u, 63)),
    Implies(And(UGE(v, u), ULE(v - u, (~u & (2**63 - 1)) + 1)), LShR(v, 63) == LShR(u, 63)),
)
first = BitVec("first", 64)  # last - count
valid(
    "octave_reaches: until there none is on the line or beyond it, if the first is not",
    Implies(And(ULE(first, last), ULE(u, first), UGE(v, u), ULE(v - u, first - u)), And(ULE(v, last), UGE(last - v, last - first))),
    Implies(And(ULE(first, last), ULE(u, first), UGE(v, u), ULE(v - u, first - u + 1)), And(ULE(v, last), UGE(last - v, last - first))),
)
valid(
    "octave_reaches: if the first is beyond the line, so are all",
    Implies(And(ULE(first, last), UGT(u, last), UGE(v, u)), And(UGT(v, last), UGE(last - v, last - first))),
    Implies(And(ULE(first, last), UGE(u, last), UGE(v, u)), And(UGT(v, last), UGE(last - v, last - first))),
)
valid(
    "line_reaches: the line answers all up to there",
    Implies(And(ULT(last - u, count), ULE(count, last), UGE(v, u), ULE(v - u, last - u)), ULT(last - v, count)),
    Implies(And(ULT(last - u, count), ULE(count, last), UGE(v, u), ULE(v - u, last - u + 1)), ULT(last - v, count)),
)
# The index by u64 is then as for 2^-33: with 32 zeros, and one less where something is borrowed.
top = (ZeroExt(24, byte) + LEAST // STEP) * STEP
valid(
    "below 2^-32 both find an index beyond the octave of the least top, which has no polynomial",
    Implies(And(ULT(bits, 95 << 23), ULT(LEAST - 1, top)), And(
        UGT(by_f32[0], LShR(top, 23) - LEAST_EXPONENT),
        UGT(LShR(top, 23) + 32 - 1 - 126, LShR(top, 23) - LEAST_EXPONENT),
    )),
    Implies(And(ULT(bits, 95 << 23), ULT(LEAST - 1, top)), UGT(LShR(top, 23) + 32 - 1 - 126, LShR(top, 23) - LEAST_EXPONENT + 5)),
)
# u = 0 stands for 1: not on the line, and beyond all octaves.
near, last = BitVecs("near last", 64)


def on_line(u, least=1 << 55):
    before = If(near == 0, near, near - 1)
    before = If(UGT(before, least), before, BitVecVal(least, 64))
    return ULT(last - u, If(UGT(last, before), last - before, BitVecVal(0, 64)))


zero = BitVecVal(0, 64)
nothing = And(a == 0, ULT(LEAST - 1, top))
valid(
    "u = 0 in 64 bits, which stands for 1, is not on the plateau's line and finds no polynomial",
    And(Not(on_line(zero)), Implies(nothing, UGT(by_u64(a, BitVecVal(32, 32))[0], LShR(top, 23) - LEAST_EXPONENT))),
    Implies(nothing, UGT(by_u64(a, BitVecVal(32, 32))[0], LShR(top, 23) - LEAST_EXPONENT + 5)),
    Not(on_line(BitVecVal(1 << 60, 64))),
)

# Side and ramp. u is an f32 in [2^-32, 1), and in 2^-64 an integer. 1 - u is exact for u > 1/2.
u = BitVec("u", 32)
exponent, fits = LShR(u, 23), And(UGE(u, 95 << 23), ULT(u, 127 << 23))
word = LShR(ZeroExt(32, (u & 0x7FFFFF) | (1 << 23)) << 40, ZeroExt(32, 126 - exponent))
late = FPVal(1, Float32()) - fpBVToFP(u, Float32())
late = fpToIEEEBV(late)
late_word = LShR(ZeroExt(32, (late & 0x7FFFFF) | (1 << 23)) << 40, ZeroExt(32, 126 - LShR(late, 23)))
valid(
    "the look-ups agree in the side, and 1 - u by f32 is 2^64 - u by integers, for each f32 from 2^-32 to 1 but 1/2",
    Implies(And(fits, u != 126 << 23), And((u > 126 << 23) == UGE(word, 1 << 63), Implies(UGE(word, 1 << 63), late_word == -word))),
    Implies(fits, (u > 126 << 23) == UGE(word, 1 << 63)),
)
# By u64 1/2 counts from side 1, whose octaves hold it if it is on either ramp; a join at 1/2 is on the line. Without a plateau it
# is beyond the last u before the closing ramp (`far - 1`).
valid(
    "in 64 bits a plateau's line serves both of its joins, and nothing beyond them",
    Implies(And(UGE(near, 1 << 56), UGE(last, near)), And(on_line(near), on_line(last), Not(on_line(near - 1)), Not(on_line(last + 1)))),
    Implies(And(UGE(near, 1 << 56), UGE(last, near)), on_line(near - 1)),
)
# The ramp: beyond the last u before the far join. By f32 that is the greatest f32 at or below the join as a double; by u64 the
# join in words. Where these are within some distance, a u that is looked up on different ramps is within as much of the join.
v, join, floor, words, apart = Reals("v join floor words apart")
consistent = And(floor <= join, Or(v <= floor, v > join), words - join <= apart, join - words <= apart)
valid(
    "they agree in the ramp, but for u between the two joins",
    Implies(And(consistent, (v > floor) != (v > words)), And(v - join <= apart, join - v <= apart)),
    Implies(And(consistent, (v > floor) != (v > words)), v == join),
    Implies(And(floor <= join, words - join <= apart, join - words <= apart, (v > floor) != (v > words)), And(v - join <= apart, join - v <= apart)),
)

# The joins. A share is a pair hi + lo of at most 48 bits, here in 2^-32; its words are cut to 2^-55.
code("let x = x.scaled(power_of_two(32 - WHOLE_EXPONENT));", """let upper = x.hi as u32;
    let rest = (x.hi - upper as f32) + x.lo; let rest = ((rest * power_of_two(23)) as i32 as i64) << 9;
    let words = ((upper as u64) << 32).wrapping_add(rest as u64);
    if words.abs_diff(1 << 63) < trace { 1 << 63 } else { words }""")


def words_error(hi_bits):
    """In 2^-64, for 2^(n-1) <= hi < 2^n: one unit of the cut, and the rounding of what is behind the point."""
    rest = Fraction(0) if hi_bits > 24 else (1 + Fraction(1, 2)) * U
    # The sum of a fraction of hi, below 1, and lo, at most half an ulp of hi.
    return 2**9 + rest * 2**32


worst = max(words_error(n) for n in range(1, 33))
require(worst <= Fraction(2**9) + 2**9 and worst / 2**64 < Fraction(1, 2**54), "a share in words")
require(2**7 * 2**23 < 2**31, "what is behind the point fits 32 bits")
# Each join is told by the lesser part. In words that is a sum of pairs, to 2^-46 (pairs.py), and in doubles one to 2^-53; or 1 less
# a share, from 1/2 on, where the rounding of shares to pairs, 2^-49 each, and of 1 less it, 2^-54, may count, too.
code("let [near, far] = [self.ramps[0].share, self.ramps[1].share];", """let (until, rest) = (near.plus(self.plateau), far.plus(self.plateau));
    let is_less = [near.hi < 0.5 * WHOLE, until.hi < 0.5 * WHOLE];
    let joins = [ words(if is_less[0] { near } else { rest }, self.trace()), words(if is_less[1] { until } else { far }, self.trace()), ];
    [ if is_less[0] { joins[0] } else { (!joins[0]).saturating_add(1) }, if is_less[1] { joins[1] } else { (!joins[1]).saturating_add(1) }, ]""")
CUT = worst / 2**64
SHARE = Fraction(1, 2**46) + Fraction(1, 2**53)
BY_HALF = CUT + SHARE / 2 + 3 * Fraction(1, 2**49) + 2 * Fraction(1, 2**54)
off0, off1 = (1 / Fraction(2 ** int(x)) for x in source(r"const OFF: \[f32; 2\] = \[1\.0 / \(1u64 << (\d+)\) as f32, 1\.0 / \(1u64 << (\d+)\) as f32\];"))
covers = lambda off0, off1: CUT <= off0 and SHARE <= off1 and BY_HALF <= off0 + off1 / 2
require(covers(off0, off1) and not covers(off0 / 2, off1) and not covers(off0, SHARE / 2), "joins")
proven(f"the joins in words are within 2^{log2(CUT):.2f} and 2^{log2(SHARE):.2f} of the lesser part of those in doubles, which OFF covers")

# A top is at or above the end of its ramp, in words, too: those are cut to a multiple of 2^-55, and a top is one.
end, steps = BitVec("end", 32), BitVec("steps", 32)


def top_of(end):
    return UDiv(end + STEP - 1, BitVecVal(STEP, 32)) * STEP


valid(
    "stretched: a top is at or above the end of its ramp, so that no fraction of the ramp is looked up above its octaves",
    Implies(ULT(end, 127 << 23), And(UGE(top_of(end), end), ULT(top_of(end) - end, STEP))),
    Implies(ULT(end, 127 << 23), UGE(UDiv(end, BitVecVal(STEP, 32)) * STEP, end)),
)
# In 64 bits: for a fraction at or below the top, or above it by less than the last of 32 bits, the index is that of the ramp's
# first octave or beyond. Without the step up where the join is above the f32 at or below it, the top may be that f32, and a
# fraction between the two be found an octave above.
a = BitVec("a", 64)
for zeros in range(1, 28):
    here = And(LShR(a, 63 - zeros) == 1, ULT(top, 127 << 23))
    # The top in 2^-64: its significand, and the exponent that it has above 2^-64.
    wide = ZeroExt(32, (top & 0x7FFFFF) | (1 << 23)) << ZeroExt(32, LShR(top, 23) - 63 - 23)
    index = by_u64(a, zeros)[0]
    for slack, expected in (((1 << (32 - zeros)) - 1, unsat), (1 << (32 - zeros), sat)):
        solver = Solver()
        solver.add(here, ULE(a, wide + slack), index >> 31 == -1)
        require(solver.check() == expected, f"below the top: {zeros}, {slack}")
proven("by u64, a fraction at or below a ramp's top finds the ramp's first octave or one below it, never one of the far ramp's; one that is above it by a unit of 32 bits does not")
unit = min(Fraction(2) ** (LEAST_EXPONENT - 127 - 3), Fraction(1))
require((unit * 2**55).denominator == 1, "tops are multiples of 2^-55")
proven("a join in words is not above a top that it is not above as a double: both ways to cut it keep a multiple of 2^-55, as tops are")

# Horner's rule: each product is rounded down. `e` is what has been lost so far. The least x, -1/2, is never reached.


def horner(least, most, size="0.4999"):
    steps = ["x = fixed<-32,ne>(X);", "e1 = -d1;"]
    for k in range(2, DEGREE + 1):
        steps.append(f"e{k} = e{k - 1} * x - d{k};")
    digits = " /\\ ".join(f"d{k} in [0,1]" for k in range(1, DEGREE + 1))
    return "\n".join(steps) + f"""
{{ |x| <= {size} /\\ {digits} -> e{DEGREE} in [{least},{most}] }}
$ x in (0);
"""


code("pub(crate) const fn times_high(a: i32, x: i32) -> i32 {", "if HALVES { times_high_by_halves(a, x) } else { ((a as i64 * x as i64) >> 32) as i32 } }")
code("pub(crate) const fn times_high_by_halves(a: i32, x: i32) -> i32 {", """let [a_low, x_low] = [a & 0xFFFF, x & 0xFFFF];
    let [a_high, x_high] = [a >> 16, x >> 16]; let carried = (a_low as u32).wrapping_mul(x_low as u32) >> 16;
    let middle = a_high * x_low + carried as i32; let other = a_low * x_high + (middle & 0xFFFF);
    a_high * x_high + (middle >> 16) + (other >> 16) }""")
# The four products of halves, each within what it may be.
high, first, second, low = Ints("high first second low")
most_low, least_high = 2**16 - 1, -(2**15)
products = And(high <= 2**30, high >= least_high * (2**15 - 1), *(And(p <= (2**15 - 1) * most_low, p >= least_high * most_low) for p in (first, second)), low >= 0, low <= most_low**2)
middle = first + low / 2**16
other = second + middle % 2**16
word = lambda x: And(x >= -(2**31), x < 2**31)
valid(
    "times_high_by_halves: the upper word of the product, with no sum beyond a word",
    Implies(products, And(high + middle / 2**16 + other / 2**16 == (high * 2**32 + (first + second) * 2**16 + low) / 2**32, word(middle), word(other))),
    Implies(products, other < 2**31 - 2**17),
)
HALF_TRUNCATION = Fraction(source(r"const HALF_TRUNCATION: f32 = ([\d.]+);"))
MEAN_TRUNCATION = Fraction(source(r"const MEAN_TRUNCATION: f64 = (-[\d.]+);"))
least, most = MEAN_TRUNCATION - HALF_TRUNCATION, MEAN_TRUNCATION + HALF_TRUNCATION
stated = source(r"in the unit of the coefficients: from (-[\d.]+) to ([\d.]+)")
require([least, most] == [Fraction(x) for x in stated], "the comment's bounds are those of the constants")
require(gappa(horner(float(least), float(most))), "Horner's truncation")
near = Fraction(1, 500)
require(not gappa(horner(float(least + near), float(most))) and not gappa(horner(float(least), float(most - near))), "tighter")
require(not gappa(horner(float(least), float(most), "0.5")), "at x = 1/2 it is more")
proven(f"Horner's rule in integers truncates by {float(least)} to {float(most)} units, which is MEAN_TRUNCATION and HALF_TRUNCATION about it, for |x| up to 0.4999")
require(most_filled(FILLED, 1) / WORD < Fraction(4999, 10000) and most_filled(FILLED, 0) / WORD < Fraction(4999, 10000), "x is below 1/2")
code("let middle = fixed_f64(c[0] - MEAN_TRUNCATION * step, self.unit);", "")
