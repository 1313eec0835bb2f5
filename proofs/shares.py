"""src/fraction.rs: shares of the exposure in 64 and 96 bits. By z3 on whole numbers, and a transcription by exact rationals."""

from solver import *
from transcribed import Fractions, cases

code("pub(crate) fn new(n: u32) -> Self {", """let divisor = n as u64 | (n == 0) as u64; let half_share = (1 << 63) / divisor;
    let remainder = (1 << 63) - half_share * divisor; Self { n, half_share, rest: ((remainder * half_share) >> 31) as u32 } }""")
code("let rest = (self.rest as u64 * odd as u64) >> 32;", """let middle = self.half_share.wrapping_mul(odd as u64).wrapping_add(rest);
    if edge.is_off { middle.wrapping_add(edge.half) } else { middle.wrapping_sub(edge.half) } }""")
code("pub(crate) fn words(&self, odd: u32) -> (u64, Words) {", """let u = self.in_u64(odd, &Edge::TRIGGER);
    let below = (u << 32) | self.rest.wrapping_mul(odd) as u64;
    let share = (self.half_share << 1) | (self.rest >> 31) as u64;
    let share = ((share >> 32) as u32, (share << 32) | (self.rest << 1) as u64);
    (u, Words { word: (u >> 32) as u32, below, share }) }""")
code("pub(crate) fn within(&self, reach: u32) -> u32 {", """let more_than_share = ((self.half_share >> 31) as u32).wrapping_add(1);
    reach.checked_div(more_than_share).unwrap_or(0).saturating_add(1) }""")
code("pub(crate) fn moved(self, bits: u32, less: u32, ahead: u32) -> Self {", """let up = |word: u32, below: u64| {
    let (middle, low) = ((below >> 32) as u32, below as u32); let word = word << 1 << bits | middle >> (31 - bits);
    let middle = middle << 1 << bits | low >> (31 - bits); (word, (middle as u64) << 32 | (low << 1 << bits) as u64) };
    let (below, borrow) = self.below.overflowing_sub((less as u64) << 32);
    let (word, below) = up(self.word.wrapping_sub(borrow as u32), below); let share = up(self.share.0, self.share.1);
    Self { word: word.wrapping_add(ahead), below, share } }""")
code("pub(crate) fn step(&mut self) {", """let (below, carry) = self.below.overflowing_add(self.share.1);
    self.below = below; self.word = self.word.wrapping_add(self.share.0).wrapping_add(carry as u32); }""")
code("let (side, near) =", """if odd < n || odd == n && !edge.is_off { (0, odd) } else { (1, 2 * n - odd) };
    let low = near * self.rest as u64; let middle = near * (self.half_share as u32 as u64) + (low >> 32);
    let words = (near * (self.half_share >> 32) + (middle >> 32)) << 32 | middle as u32 as u64;
    let (words, low) = if edge.is_off == (side == 0) {
    let (low, carry) = (low as u32).overflowing_add(edge.rest);
    (words.wrapping_add(edge.half).wrapping_add(carry as u64), low) } else {
    let (low, borrow) = (low as u32).overflowing_sub(edge.rest);
    (words.saturating_sub(edge.half).saturating_sub(borrow as u64), low) };
    let (words, low, down) = if words >> 32 == 0 { (words << 32 | low as u64, 0, 32) } else { (words, low, 0) };
    let zeros = words.leading_zeros() & 63; let bits = words << zeros | (low as u64) << zeros >> 32;
    let [hi, lo] = [bits >> 40, bits >> 16 & 0xFF_FFFF].map(|half| half as u32 as f32);
    let unit = power_of_two(WHOLE_EXPONENT - 24 - down - zeros as i32);""")
code("let (significand, down) = (bits & 0x7F_FFFF | 1 << 23, 150 - (bits >> 23));", """
    let half_share = (self.half_share as u128) << 32 | self.rest as u128;
    let half = (half_share * significand as u128).checked_shr(down).unwrap_or(0);""")

# `new`. n share = 2^63 - r with 0 <= r < n. The rest is r share / 2^31, cut; exactly it would be r 2^32 / n.
n, r = Reals("n r")
domain = And(r >= 0, r < n, n >= 1, n < 2**32)
share = (2**63 - r) / n
valid(
    "Fractions::new: the rest is at most 3 * 2^-96 too small, fits its word, and nothing overflows",
    Implies(domain, And(r * 2**32 / n - r * share / 2**31 < 2, r * share <= r * 2**32 / n * 2**31, r * share < 2**64, r * 2**32 / n < 2**32)),
    Implies(domain, r * 2**32 / n - r * share / 2**31 < 1),
)

# `in_u64`, in whole numbers: 2 n times the share with its rest is at most 2^64, and half of a pulse is at most the share.
k, half, odd, m = Ints("k half odd m")
whole = And(m >= 1, m < 2**32, k >= 0, odd >= 1, odd <= 2 * m - 1, half >= 0, half <= k)
product = Int("product")  # odd times the share with its rest, cut: it leaves (2 m - odd) times that until 2^64, which is k at least
valid(
    "in_u64: a fraction and half a pulse stay within 64 bits, but for the last off at 1, which becomes 0",
    Implies(And(whole, product >= k, product + k <= 2**64), And(product - half >= 0, product + half <= 2**64)),
    Implies(And(whole, product >= k, product + k <= 2**64), product + half < 2**64),
)

# `words`, in 96 bits: the fraction is the half share, with its rest, times `odd`; the next one is a share more. The upper word of
# `below` is the middle one of the three.
half_share, rest, odd_bits, factor = BitVec("half_share", 64), BitVec("rest", 32), BitVec("odd", 32), BitVec("factor", 96)
half96 = Concat(half_share, rest)
u = BitVec("u", 64)
below = u << 32 | ZeroExt(32, rest * odd_bits)
share = half_share << 1 | ZeroExt(32, LShR(rest, 31))
share_word, share_below = Extract(63, 32, share), share << 32 | ZeroExt(32, rest << 1)
valid(
    "words: word and below are the fraction in 96 bits, of which in_u64 has the upper 64, and the share is twice the half of it",
    And(
        Concat(Extract(63, 32, u), below) == Concat(u, rest * odd_bits),
        Concat(share_word, share_below) == half96 << 1,
        Extract(31, 0, half96 * ZeroExt(64, odd_bits)) == rest * odd_bits,
    ),
    Concat(share_word, share_below) == half96,
)
whole, carried = Ints("whole carried")  # half_share times odd, and rest times odd
valid(
    "words: the upper 64 bits of that product are those of in_u64",
    Implies(And(whole >= 0, carried >= 0), (whole * 2**32 + carried) / 2**32 == whole + carried / 2**32),
    Implies(And(whole >= 0, carried >= 0), (whole * 2**32 + carried) / 2**32 == whole),
)
word, below, step_word, step_below = BitVec("word", 32), BitVec("below", 64), BitVec("step_word", 32), BitVec("step_below", 64)
next_below = below + step_below
carry = If(ULT(next_below, below), BitVecVal(1, 32), BitVecVal(0, 32))
valid(
    "words: a step adds the share in 96 bits",
    Concat(word + step_word + carry, next_below) == Concat(word, below) + Concat(step_word, step_below),
    Concat(word + step_word, next_below) == Concat(word, below) + Concat(step_word, step_below),
)


def up(word, below, bits):
    middle, low = Extract(63, 32, below), Extract(31, 0, below)
    word = word << 1 << bits | LShR(middle, 31 - bits)
    middle = middle << 1 << bits | LShR(low, 31 - bits)
    return Concat(word, middle, low << 1 << bits)


less = BitVec("less", 1)
lessened = below - Concat(BitVecVal(0, 31), less, BitVecVal(0, 32))
borrow = If(ULT(below, Concat(BitVecVal(0, 31), less, BitVecVal(0, 32))), BitVecVal(1, 32), BitVecVal(0, 32))
valid(
    "moved: the words that begin so many bits and one lower, of what is less by as many units of 2^-64",
    And(*(up(word - borrow, lessened, bits) == (Concat(word, below) - Concat(BitVecVal(0, 63), less, BitVecVal(0, 32))) << (bits + 1) for bits in range(32))),
    And(*(up(word, lessened, bits) == (Concat(word, below) - Concat(BitVecVal(0, 63), less, BitVecVal(0, 32))) << (bits + 1) for bits in range(32))),
)
# `within`: so many shares, each less than `more` of 2^-32, are not beyond the reach. A share of all, 2^64, is counted as 1.
share, more, reach = Ints("share more reach")
valid(
    "within: as many shares as it counts, less the first, come no farther than the reach",
    Implies(And(share >= 0, share < more * 2**32, more >= 1, reach >= 0), (reach / more) * share <= reach * 2**32),
    Implies(And(share >= 0, share < more * 2**32, more >= 1, reach >= 0), (reach / more + 1) * share <= reach * 2**32),
)

# `exactly`: the three products by words are the product.
pa, pb, pc = Ints("pa pb pc")
parts = And(pa >= 0, pb >= 0, pc >= 0, pa <= 2**32 * 2**31, pb <= 2**32 * (2**32 - 1), pc <= 2**32 * (2**32 - 1))
middle = pb + pc / 2**32
words = (pa + middle / 2**32) * 2**32 + middle % 2**32
valid(
    "exactly: word by word the product is exact, and its words do not overflow",
    Implies(parts, And(words * 2**32 + pc % 2**32 == pa * 2**64 + pb * 2**32 + pc, middle < 2**64)),
    Implies(parts, words * 2**32 == pa * 2**64 + pb * 2**32 + pc),
)


# The whole of it, transcribed, against exact fractions, on edges and random numbers.
worst_64 = worst = least = Fraction(0)
relative = {}
for n, odd, duty, is_off in cases():
    f = Fractions(n)
    half = f.edges(duty) if duty else 0
    width = Fraction(duty[0]) * Fraction(2) ** (duty[1] - 150) if duty else Fraction(0)
    exact = Fraction(odd, 2 * n) + (width if is_off else -width) / (2 * n)
    short = exact - Fraction(f.in_u64(odd, half, is_off), 2**64)
    if exact < 1:
        # Its product is cut by less than a unit, after three of 2^-96 for each odd; half of a pulse is cut by less than two.
        most = 1 + Fraction(3 * odd, 2**32)
        require(-2 < short * 2**64 < most + 2, f"in_u64 {n} {odd} {duty}")
        if n <= 2**22:
            worst_64 = max(worst_64, abs(short * 2**64))
    side, hi, lo, unit = f.exactly(odd, half, is_off)
    near = exact if side == 0 else 1 - exact
    found = (hi + Fraction(lo, 2**24)) * Fraction(2) ** unit
    error = abs(found - near)
    require(error <= near / 2**45 or error < Fraction(near.denominator and 3 * min(odd, 2 * n - odd) + 4, 2**96), f"exactly {n} {odd} {duty} {is_off}")
    if near:
        key = n <= 2**26
        relative[key] = max(relative.get(key, 0), error / near)
        absolute = error * 2**96
require(relative[True] <= Fraction(1, 2**45), "exactly, 2^26 pulses")
require(1 < worst_64 < 4, "in_u64")
tested(f"in_u64: too low by at most two units of 2^-64 in frames that have direct triggers, and two for half of a pulse (seen: {float(worst_64):.3f})")
tested(f"exactly: to 2^{log2(relative[True]):.1f} up to 2^26 pulses, to 2^{log2(relative[False]):.1f} up to 2^32")


def exactness(n):
    """48 bits of the answer; three units for each odd; and one for half of a pulse, of which an end leaves at least 2^-24 / 2n."""
    return Fraction(1, 2**47) + Fraction(6 * n, 2**96) + 2 * n * Fraction(2**24, 2**96)


frame = source(r"to 2⁻⁴⁵; in frames of more than 2([²³⁵]+) pulses")
frame = int("".join(str("⁰¹²³⁴⁵⁶⁷⁸⁹".index(digit)) for digit in frame))
require(exactness(2**frame) <= Fraction(1, 2**45) < exactness(2 ** (frame + 1)), "exactly")
require(exactness(2**32) <= Fraction(101, 100) * Fraction(1, 2**39), "exactly, all frames")
proven(f"exactly: to 2^-45 in frames of up to 2^{frame} pulses, for every duty; to 2^{log2(exactness(2**32)):.2f} in all")
