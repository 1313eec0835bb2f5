"""src/octave.rs, plan.rs: that the answer's path computes the `x` at which a polynomial was judged, by z3; and what
Horner's rule in integers truncates, by Gappa."""

from solver import *


code("octave.rs", "pub(crate) const fn offset(&self, position: i32) -> i32 {", """let ahead = position & !(position >> 31);
    let x = position.wrapping_add(ahead).wrapping_sub(self.center as i32); x << (self.center & FINER) }""")
code("plan.rs", "let below = top.wrapping_sub(bits);", """let octave = self.octaves[side & 1].get((below >> 23) as usize)?;
    Some((octave, ((bits ^ (top ^ below) & 1 << 23) << 8) as i32))""")
code("plan.rs", "let zeros = high.leading_zeros();", """let significand = high << (zeros & 31) | low >> 1 >> (31u32.wrapping_sub(zeros) & 31);
    let significand = significand & !(1 << 31);
    let top = octave::top(self.tops[side & 1][is_beyond as usize]);
    let below = (top << 9 >> 1) as i32 - significand as i32;
    let index = (top >> 23).wrapping_add(zeros).wrapping_add((below >> 31) as u32);
    let octave = self.octaves[side & 1].get(index.wrapping_sub(126) as usize)?;
    let position = significand as i32 | below & i32::MIN;""")
code("fit.rs", "const fn center(&self) -> u64 {", """let octave = self.width * (1 << self.finer) as f64;
    (self.middle / octave * WORD) as u64 & !(FINER as u64) | self.finer as u64 }""")

FINER = int(source("octave.rs", r"const FINER: u32 = (\d+);"))
STEP = 1 << int(source("octave.rs", r"const STEP: u32 = 1 << (\d+);"))
LEAST_EXPONENT = 127 - int(source("octave.rs", r"const LEAST: u32 = \(1\.0 / \(1 << (\d+)\) as f32\)\.to_bits\(\);"))
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

# Does it fit? A part has `half` of at most `share` of the width after the last halving, for the loop halves while
# half <= limit * width; without a halving it is at most a quarter of a top that is less than twice the width, by a step.
# The center is rounded down by less than one and has `finer` for its lowest five bits: it is wrong by at most FINER.
name, limit = source("fit.rs", r"while finer < (\w+) && half <= (0\.\d+) \* width \{")
greatest_shift = int(name) if name.isdigit() else int(re.search(
    rf"const {name}: u32 = (\d+);", "".join((SRC / file).read_text() for file in ("fit.rs", "octave.rs"))).group(1))


def margin(limit, finer, wrong=FINER + 1):
    """How many 2^-32 of an octave a part's fractions may be beyond its ends."""
    top = 2 - Fraction(STEP, 1 << 23)
    share = max(2 * limit, top / 4 if finer == 0 else Fraction(0))
    return (Fraction(1, 2) - share) * Fraction(2**32, 2**finer) - wrong


require(all(margin(Fraction("0.24"), finer) > 49 for finer in range(21)), "0.24 and 20 fit")
require(margin(Fraction("0.25"), 1) < 0 and margin(Fraction("0.24"), 22) < 0, "0.25, or a shift of 22, does not fit")
proven("with halves of at most 0.24 of the width and shifts up to 20 it fits, and so do 49 * 2^-32 of the octave beyond either end")
claim = f"src/fit.rs halves where half <= {limit} width and shifts by at most {greatest_shift}: the offset fits the word"
if all(margin(Fraction(limit), finer) > 0 for finer in range(greatest_shift + 1)):
    proven(claim)
    fits = True
else:
    print(f"FAILED  octaves: {claim}", flush=True)
    fits = False

# The look-up by u64 agrees with the one by f32, for fractions that are f32, from 2^-32 to 1/2.
byte = BitVec("byte", 8)
top = (ZeroExt(24, byte) + LEAST // STEP) * STEP
by_f32 = look_up(top, bits)
exponent = LShR(bits, 23)
CELLS = int(source("plan.rs", r"assert!\(CELLS <= (\d+),"))
a = ZeroExt(32, (bits & 0x7FFFFF) | (1 << 23)) << 40
a = LShR(a, ZeroExt(32, 126 - exponent))


def by_u64(zeros, borrow=True):
    high, low = Extract(63, 32, a), Extract(31, 0, a)
    significand = (high << zeros) | LShR(LShR(low, 1), 31 - zeros)
    significand = significand & ~(1 << 31)
    below = LShR(top << 9, 1) - significand
    index = LShR(top, 23) + zeros + (below >> 31) - 126
    return index, significand | (below & (1 << 31) if borrow else 0)


def agree(zeros, borrow=True):
    by = by_u64(zeros, borrow)
    here = And(LShR(a, 63 - zeros) == 1, exponent == 126 - zeros)
    none = And(UGE(by[0], CELLS), UGE(by_f32[0], CELLS))
    return Implies(here, Or(none, And(by[0] == by_f32[0], by[1] == by_f32[1])))


for zeros in range(32):
    solver = Solver()
    solver.add(Not(agree(zeros)))
    require(solver.check() == unsat, "the look-ups agree")
solver = Solver()
solver.add(Not(agree(3, borrow=False)))
require(solver.check() == sat, "the look-ups agree without a borrow")
proven("the look-ups by f32 and by u64 find the same octave and position, for each f32 from 2^-32 to 1 and each top")
# The index by u64 is then as for 2^-33: with 32 zeros, and one less where something is borrowed.
valid(
    "below 2^-32 both find an index beyond the octave of the least top",
    Implies(And(ULT(bits, 95 << 23), ULT(LEAST - 1, top)), And(
        UGT(by_f32[0], LShR(top, 23) - LEAST_EXPONENT),
        UGT(LShR(top, 23) + 32 - 1 - 126, LShR(top, 23) - LEAST_EXPONENT),
    )),
)

# Horner's rule: each product is rounded down. `e` is what has been lost so far.
DEGREE = int(source("octave.rs", r"pub\(crate\) const DEGREE: usize = (\d+);"))


def horner(least, most):
    steps = ["x = fixed<-32,ne>(X);", "e1 = -d1;"]
    for k in range(2, DEGREE + 1):
        steps.append(f"e{k} = e{k - 1} * x - d{k};")
    digits = " /\\ ".join(f"d{k} in [0,1]" for k in range(1, DEGREE + 1))
    return "\n".join(steps) + f"""
{{ |x| <= 0.5 /\\ {digits} -> e{DEGREE} in [{least},{most}] }}
$ x in (0);
"""


code("octave.rs", "const fn times_high(a: i32, x: i32) -> i32 {", "((a as i64 * x as i64) >> 32) as i32 }")
require(gappa(horner(-1.9922, 0.6641)), "Horner's truncation")
require(not gappa(horner(-1.992, 0.6641)) and not gappa(horner(-1.9922, 0.664)), "Horner's truncation is tight")
proven("Horner's rule in integers truncates by -1.9922 to 0.6641 units: below 1.5 about the middle, where half a unit is added")
code("fit.rs", "let middle = (c[0] / power_of_two_f64(unit)) as i64", "+ factor as i64 / 2;")
if not fits:
    sys.exit(1)
