"""The plateau's line, the rounding of a time, and bits of numbers: for all values of the words, by z3."""

from solver import *

# The plateau's line.
code("const fn on_line(&self, u: u32) -> i64 {", """let (high, low) = ((self.slope as u64) >> 32, self.slope as u32 as u64);
    let way = high * u as u64 + ((low * u as u64) >> 32); self.base.wrapping_add(way as i64) }""")
# The two products, of 32 bits by 32, are exact in 64; here they are any numbers that such products may be.
p, q = Ints("p q")
greatest = (2**32 - 1) ** 2
products = And(p >= 0, p <= greatest, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
valid(
    "on_line: the way is floor(slope u / 2^32), and stays within 63 bits",
    Implies(products, And(q + p / 2**32 == (q * 2**32 + p) / 2**32, q + p / 2**32 < 2**63)),
    Implies(products, q + p / 2**32 < 2**62),
)
code("const fn in_words(bits: u32) -> u32 {", """let shift = (0.5f32.to_bits() >> 23).wrapping_sub(bits >> 23);
    (bits << 8 | 1 << 31) >> (shift & 31) }""")
code("let last_before_line = if near < FINE.to_bits()", """{ FINE.to_bits() } else { near };
    plan.on_line_count[side] = plan.last_before_far[side].saturating_sub(last_before_line);""")
FINE = 127 - (int(source(r"const FINE: f32 = 1\.0 / (\d+)\.0;")).bit_length() - 1)
bits = BitVec("bits", 32)
shift = 126 - LShR(bits, 23)
whole = (bits << 8) | (1 << 31)


def line(first):
    back = LShR(whole, shift) << shift
    return Implies(And(UGE(bits, first << 23), ULT(bits, 127 << 23)), And(ULE(shift, 31), back == whole))


valid("in_words: a fraction from FINE to 1 is a whole number of 2^-32", line(FINE), line(FINE - 1))

# The rounding of a time. All f32 near a number of 25 or more bits, and all middles between two of them, are even numbers.
# So an odd number may stand for all that lies between its even neighbours.
code("fn upper_word(time: i64) -> Option<i32> {", """let high = (time >> 32) as i32;
    let has_enough = high.wrapping_add(1 << 25) as u32 >= 1 << 26; has_enough.then_some(high | (time as u32 != 0) as i32) }""")
code("let sign = (time >> 63) as i32;", """let is_word = (time >> 32) as i32 == sign; let (time, down) = if is_word { (time << 31, 31) } else { (time, 0) };
    let (high, low) = ((time >> 32) as i32, time as u32);
    let up = (high ^ sign).leading_zeros().wrapping_sub(1) & 31;
    let filled = high << up | (low >> 1 >> (31 - up)) as i32 | (low << up != 0) as i32;
    filled as f32 * f32::from_bits((127 - down - up) << 23) * self.scale }""")
LEAST_BITS = int(source(r"high\.wrapping_add\(1 << (\d+)\) as u32 >= 1 << 26"))

time, even = BitVec("time", 64), BitVec("even", 72)


def stands_for(word, exact, places):
    """Is `word` on the same side as the time of every even number, all in 2^-places?"""
    word, exact, even2 = SignExt(40, word) << places, SignExt(8, exact), (even << 1) << places
    limits = And(even <= 1 << 32, even >= -(1 << 32))
    return Implies(limits, And((word > even2) == (exact > even2), (word < even2) == (exact < even2)))


def one_word(bits):
    high, low = Extract(63, 32, time), Extract(31, 0, time)
    word = high | If(low != 0, BitVecVal(1, 32), BitVecVal(0, 32))
    near_0 = LShR(high + (1 << LEAST_BITS), LEAST_BITS + 1) == 0
    # The steps between f32 are at least 2^(bits - 23), and middles multiples of half of that.
    size = And(Or(word >= 1 << bits, word < -(1 << bits)))
    return Implies(Not(near_0), And(stands_for(word, time, 32), size))


require(LEAST_BITS - 23 - 1 >= 1, "middles between f32 are even numbers")
valid("inverse_cdf: one conversion of 32 bits rounds a time of 64 as the exact time rounds", one_word(LEAST_BITS), one_word(LEAST_BITS + 1))


def carefully(is_word, up, least=1 << 30):
    """Case by case of `up`, since z3 is slow where shifts are unknown."""
    sign = Extract(31, 0, time >> 63)
    here = (Extract(63, 32, time) == sign) == BoolVal(is_word)
    moved, down = (time << 31, 31) if is_word else (time, 0)
    high, low = Extract(63, 32, moved), Extract(31, 0, moved)
    first = high ^ sign
    # What leading_zeros() - 1 is; 32 zeros give 31, too.
    leads = first == 0 if up == 31 else LShR(first, 30 - up) == 1
    if up == 31:
        leads = Or(leads, LShR(first, 31) == 1)
    filled = (high << up) | LShR(LShR(low, 1), 31 - up) | If(low << up != 0, BitVecVal(1, 32), BitVecVal(0, 32))
    size = Or(filled >= least, filled <= -least)
    return Implies(And(here, leads, time != 0), And(stands_for(filled, moved, 32 - up), size))


for is_word in (True, False):
    for up in range(32):
        solver = Solver()
        solver.add(Not(carefully(is_word, up)))
        require(solver.check() == unsat, f"rounded_near_0, moved up by {up}: {solver.check()}")
solver = Solver()
solver.add(Not(carefully(True, 3, (1 << 30) + 1)))
require(solver.check() == sat, "a word is not fuller than full")
proven("rounded_near_0: the word is full, and rounds as the exact time rounds; for every time but 0")

# Bits of f32.
x = BitVec("x", 32)
code("const fn upper(x: f32) -> f32 {", "f32::from_bits(x.to_bits() & 0xFFFF_F000) }")
significand = (x & 0x7FFFFF) | (1 << 23)
high = significand & 0xFFFFF000
is_normal = And(LShR(x << 1, 24) != 0, LShR(x << 1, 24) != 255)
valid(
    "upper: both halves of a normal number have at most 12 bits, so products of halves are exact",
    Implies(is_normal, And((x & 0xFFFFF000) & 0xFF800000 == x & 0xFF800000, high & 0xFFF == 0, ULT(significand - high, 1 << 12), ULT(LShR(high, 12), 1 << 12))),
    Implies(is_normal, ULT(significand - high, (1 << 12) - 1)),
)
code("pub(crate) const fn flipped(x: f32, sign: u32) -> f32 {", "f32::from_bits(x.to_bits() ^ sign) }")
valid(
    "flipped: the sign bit alone changes, for every f32 and NaN",
    And((x ^ (1 << 31)) << 1 == x << 1, LShR(x ^ (1 << 31), 31) == 1 - LShR(x, 31), x ^ 0 == x),
    (x ^ (1 << 31)) == x + (1 << 30),
)

# `exponent`, `fixed` and `floor_bits` by exact rationals, for every exponent and the significands at the edges. What they do
# with the bits of a significand is the same for all: a shift.
code("pub(crate) const fn exponent(x: f32) -> i32 {", "(x.to_bits() >> 23 & 0xFF) as i32 - 127 }")
code("pub(crate) const fn fixed(x: f32, e: i32) -> i64 {", """let (bits, exponent) = (x.to_bits(), exponent(x));
    let significand = (bits & 0x7F_FFFF) as i64;
    let (significand, exponent) = if exponent > -127 { (significand | 1 << 23, exponent) } else { (significand, -126) };
    let up = exponent - 23 - e;
    let units = if up >= 0 { significand << (up & 63) } else if up > -24 { significand >> (-up & 63) } else { 0 };
    if x < 0.0 { -units } else { units } }""")
up, sig = BitVec("up", 64), BitVec("sig", 64)
# A number below 2^63 units: sig 2^up < 2^63, so up is at most 62 where sig is not 0.
fits = And(up <= 62, up >= -400, ULT(sig, 1 << 24), Implies(up >= 0, LShR(BitVecVal(2**63 - 1, 64), up) >= sig))
units = If(up >= 0, sig << (up & 63), If(up > -24, sig >> (-up & 63), BitVecVal(0, 64)))
down = If(-up > 60, BitVecVal(60, 64), -up)
floor = And(units << down <= sig, sig - (units << down) < BitVecVal(1, 64) << down)
valid(
    "fixed: the whole units of a number below 2^63 of them, rounded towards 0",
    Implies(fits, If(up >= 0, And(LShR(units, up) == sig, units >= 0), floor)),
    Implies(fits, If(up >= 0, And(LShR(units, up) == sig, units >= 0), units << down == sig)),
)
code("pub(crate) const fn fixed_f64(x: f64, e: i32) -> i64 {", """let bits = x.to_bits();
    let significand = (bits & ((1 << 52) - 1) | 1 << 52) as i64;
    let up = (bits >> 52 & 0x7FF) as i32 - 1075 - e;
    let units = if up > 10 { i64::MAX } else if up >= 0 { significand << (up & 63) } else if up > -64 { significand >> (-up & 63) } else { 0 };
    if (bits as i64) < 0 { -units } else { units } }""")
# A subnormal number, whose exponent counts as 0, has no unit: up is at most -64 where e is at least -1011.
fits = And(up <= 10, up >= -4000, ULT(sig, 1 << 53), UGE(sig, 1 << 52))
units = If(up >= 0, sig << (up & 63), If(up > -64, sig >> (-up & 63), BitVecVal(0, 64)))
down = If(-up > 63, BitVecVal(63, 64), -up)
floor = And(units << down <= sig, ULT(sig - (units << down), BitVecVal(1, 64) << down))
valid(
    "fixed_f64: the whole units of a double below 2^63 of them, rounded towards 0",
    Implies(fits, If(up >= 0, And(LShR(units, up) == sig, units >= 0), floor)),
    Implies(fits, If(up >= 0, And(LShR(units, up) == sig, units >= 0), units << down == sig)),
)
code("const fn rounded(x: f64, e: i32) -> i32 {", "let halves = fixed_f64(x, e - 1); ((halves + if halves < 0 { -1 } else { 1 }) / 2) as i32 }")
units = Real("units")
valid(
    "rounded: from whole halves of a unit to the nearest unit; the other sign mirrors it",
    Implies(units >= 0, (ToInt(2 * units) + 1) / 2 == ToInt(units + Q(1, 2))),
    Implies(units >= 0, ToInt(2 * units) / 2 == ToInt(units + Q(1, 2))),
)
# `floor_bits`: the nearest f32 of a double, or the one below. The bits of the f32 from 0 up are in order, so the one below
# has one less, also across a power of two.
code("pub(crate) const fn floor_bits(x: f64) -> u32 {", "let rounded = x as f32; let bits = rounded.to_bits(); if rounded as f64 > x { bits - 1 } else { bits } }")
y = FP("y", Float64())
rounded = fpFPToFP(RNE(), y, Float32())
below = fpBVToFP(fpToIEEEBV(rounded) - 1, Float32())
inside = And(fpIsPositive(y), fpLEQ(y, FPVal(2, Float64())))
is_above = fpGT(fpFPToFP(RNE(), rounded, Float64()), y)
answer = If(is_above, below, rounded)
next_one = fpBVToFP(fpToIEEEBV(answer) + 1, Float32())
valid(
    "floor_bits: the greatest f32 at or below, for every double from 0 (not -0) to 2",
    Implies(inside, And(fpLEQ(fpFPToFP(RNE(), answer, Float64()), y), fpGT(fpFPToFP(RNE(), next_one, Float64()), y))),
    Implies(inside, fpEQ(fpFPToFP(RNE(), answer, Float64()), y)),
)

# `significand` cuts a double's 53 bits: 24 and 24 more.
code("pub(crate) const fn significand(x: f64) -> (Pair, i32) {", """const UNIT: f32 = 1.0 / (1u64 << 47) as f32; let bits = x.to_bits();
    let hi = f32::from_bits(127 << 23 | (bits >> 29) as u32 & 0x7F_FFFF);
    let lo = (bits as u32 >> 5 & 0xFF_FFFF) as f32 * UNIT; (Pair { hi, lo }, (bits >> 52) as i32 - 1023) }""")
double = BitVec("double", 64)
exact = (double & (2**52 - 1)) | 2**52
hi = (LShR(double, 29) & 0x7FFFFF) | (1 << 23)
lo = LShR(double, 5) & 0xFFFFFF
valid(
    "significand: 48 bits of the double, cut, so that less than 2^-47 is lost; the second number is below an ulp of the first",
    And(exact - ((hi << 29) + (lo << 5)) >= 0, exact - ((hi << 29) + (lo << 5)) < 1 << 5, ULT(lo, 1 << 24)),
    exact - ((hi << 29) + (lo << 5)) < (1 << 5) - 1,
)
