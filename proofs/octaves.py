"""That the look-up and the offset lead to the `x` at which a polynomial was judged, by z3; and what Horner's rule in
integers truncates, by Gappa."""

from z3 import *

from common import *

pinned("""
octave/mod.rs top ec60763a below b73f9ae7 Octave::offset f842a0c4 times_high 6572aa47 times_high_by_halves 411fa41c
    polynomial dd3fe418
octave/span.rs Span::new f245b7f1 center c648d563
octave/build.rs top_beyond 090e7081
octave/candidate.rs candidate d3eb3555
inverse.rs Inverse::new 182aa4cc section 44bee705 look_up 157f7e9c by_octave f9806312 direct_units 0f0faea8
    last_before 0877d156 last_before_line e915c97a in_line_units 6fe0fed4
fraction.rs Fraction::new a0cd572f
""")

SHIFT_MASK = constant("SHIFT_MASK")
STEP = constant("EIGHTH")

# `Inverse::look_up`: the index, and the significand with its sign, which is the place in the octave. `top` is below 2,
# `bits` those of a fraction above 0 and at most `top`.
top, bits = BitVecs("top bits", 32)
below = top - bits
index, significand = LShR(below, 23), (bits ^ ((top ^ below) & (1 << 23))) << 8
octave_top = top - (index << 23)
domain = And(UGT(bits, 0), ULE(bits, top), ULT(top, 128 << 23))
is_lower = significand < 0
found = lambda is_below: Implies(domain, And(is_below(bits, octave_top), UGT(bits + (1 << 23), octave_top)))
claim = "the look-up finds the octave below whose top, and above half of whose top, the fraction is"
valid(claim, found(ULE), found(ULT))
binade = lambda lower: LShR(octave_top, 23) - If(is_lower, BitVecVal(lower, 32), BitVecVal(0, 32))
is_told = lambda lower: And(LShR(bits, 23) == binade(lower), significand << 1 == bits << 9)
signed = lambda lower: Implies(And(domain, UGE(bits, 1 << 23)), is_told(lower))
claim = "its sign says in which of the octave's two binades the fraction is, and the rest is its significand"
valid(claim, signed(1), signed(0))

# The offset. The fraction, in 2^-32 of the power of two at or below the octave's top, is an integer `exact` of 34 bits.
significand, center = BitVec("significand", 32), BitVec("center", 64)
wide = SignExt(32, significand)
exact = (1 << 32) + If(significand < 0, wide, 2 * wide)
shift = center & SHIFT_MASK
word = 1 << 31
# The position that `Inverse::look_up` makes of the significand, and `Octave::offset` of that.
position, center_word = significand + (significand & ~(significand >> 31)), Extract(31, 0, center)
offset = (position - center_word) << (center_word & SHIFT_MASK)


def leads_to(least, most):
    # As shifts round down, these limits are those of least <= (exact - center) 2^shift <= most.
    fits = And(exact - center >= BitVecVal(least, 64) >> shift, exact - center <= BitVecVal(most, 64) >> shift)
    return Implies(And(ULT(center, 1 << 34), fits), SignExt(32, offset) == (exact - center) << shift)


valid("offset is (exact - center) 2^shift, if that fits the word: for all positions, centers and shifts",
      leads_to(-word, word - 1), leads_to(-word, word), leads_to(-2 * word, word - 1))

# Does it fit? All of this in 2^-32 of the octave's power of two. A part has f32 for its ends, and `half` is half its
# length and 4 EPSILON, exact unless it is above a quarter. The loop halves while half <= FILLED width, so after the
# last halving it is at most 2 FILLED of the width; without one it is at most a quarter of a top that is less than twice
# the width, by a step, and 4 EPSILON. The middle is off by the rounding of the sum of the ends, the center by what its
# lowest bits come to.
FILLED, MOST_SHIFT = constant("FILLED"), constant("MOST_SHIFT")
# In `candidate` and in `Span::new`.
REACH, EPSILONS = Fraction(1, 100), 4
WORD = 2**32
EPSILON = WORD // 2**23
MIDDLE = EPSILON // 2  # half of the rounding of a sum below 4
LOW_BITS = SHIFT_MASK
# A served fraction is within half of EPSILON of the f32 between which the part is.
SERVED = EPSILON // 2

# The greatest half, in the width's 2^-32: without a halving, and after one.
WHOLE = ((2 - Fraction(STEP, 1 << 23)) / 4 * WORD + EPSILONS * EPSILON) * (1 + 2 * U)
half = lambda filled: 2 * filled * WORD * (1 + 2 * U)
fits = lambda filled: max(half(filled), WHOLE) < WORD / 2
served_fits = lambda filled, more=EPSILONS: more * EPSILON >= SERVED + MIDDLE + LOW_BITS and fits(filled)
proven("the offset of each fraction that a part serves is within its half and fits the word, for FILLED = "
       f"{float(FILLED)} and any shift; with 0.25, or a half of one EPSILON more than the part, not so",
       served_fits(FILLED) and not served_fits(Fraction(1, 4)) and not served_fits(FILLED, 1))
# The same for fractions up to 4 EPSILON beyond the part, and what the reach allows.
off = lambda shift: (MIDDLE + LOW_BITS) * 2**shift
far = max(shift for shift in range(32) if half(FILLED) + off(shift) < WORD / 2)
within = max(shift for shift in range(32) if off(shift) <= REACH * WORD)
proven(f"so do those of fractions up to {EPSILONS} EPSILON beyond, with all shifts up to {MOST_SHIFT} (up to {far} "
       "would do)",
       WHOLE + off(0) < WORD / 2 and MOST_SHIFT <= min(far, within) and far < 31)
# Tops keep 16 ulp from where a range begins.
bits, top = BitVecs("bits top", 32)
raised = If(ULT((top - bits + 16) & 0x7FFFFF, 32), top + STEP, top)
distances = [(raised - bits) & 0x7FFFFF, (bits - raised) & 0x7FFFFF]
normal = And(ULT(top, 128 << 23), ULT(bits, 128 << 23))
apart = lambda least: Implies(normal, And(*(UGE(distance, least) for distance in distances)))
claim = "a range that begins above 0 begins 16 ulp or more below each octave's end, or above it"
valid(claim, apart(16), apart(17))

# Horner's sums. With |x| within the reach, each is at most the bound of the exact one, half a unit for each
# coefficient's rounding and one for each product's, and the bound is computed with up to three roundings a step.
DEGREE, GUARD = constant("DEGREE"), Fraction(1, 2**16)


def sums_fit(guard, per_step=Fraction(3, 2)):
    greatest = 2**31 / ((1 + guard) * (1 - U) ** (3 * DEGREE + 3))
    reach = 2 * FILLED + REACH
    return greatest + sum(per_step * reach**k for k in range(DEGREE)) < 2**31


proven(f"Horner's sums fit 32 bits where |x| is within the reach: on all that a part serves, and {EPSILONS} EPSILON "
       f"beyond with shifts up to {within}",
       sums_fit(GUARD) and not sums_fit(GUARD / 2**6))

# The plateau's line, by the bits of a fraction: those above `before` and up to `last`, which are below 2^31, as all
# are.
last, before = BitVecs("last before", 32)
until_far, count = last - bits, If(UGT(last, before), last - before, BitVecVal(0, 32))
numbers = And(ULT(bits, 1 << 31), ULT(last, 1 << 31), ULT(before, 1 << 31))
is_on_line = lambda more: ULT(until_far, count) == And(UGT(bits, before), ULE(bits, last + more))
on_line = lambda more: Implies(numbers, And(is_on_line(more), (LShR(until_far, 31) == 1) == UGT(bits, last)))
valid("the plateau's line serves the fractions above `before` and up to the last before the far ramp, and the sign "
      "tells those beyond",
      on_line(0), on_line(1))
# Seen from the later side the line wants 1 - a, in 2^-32: a word is a whole number of these (words.py).
word = LShR(bits << 8 | 1 << 31, 126 - LShR(bits, 23))
as_double = fpFPToFP(RNE(), fpBVToFP(bits, Float32()), Float64())
one_less = fpToIEEEBV(fpSub(RNE(), FPVal(1, Float64()), as_double))
one_less_word = Extract(31, 0, LShR((one_less & 2**52 - 1) | 2**52, 1043 - LShR(one_less, 52)))
served = And(UGE(bits, 118 << 23), ULE(bits, 126 << 23))
asked = lambda word: Implies(served, one_less_word == word)
valid("from the later side the line is asked for 1 - a, exactly", asked(-word), asked(~word))

# A top is at or above the end of its ramp.
end = BitVec("end", 32)
top_of = lambda less: UDiv(end + STEP - less, BitVecVal(STEP, 32)) * STEP
is_above = lambda less: Implies(ULT(end, 127 << 23), And(UGE(top_of(less), end), ULT(top_of(less) - end, STEP)))
claim = "a top is at or above the end of its ramp, so that no fraction of the ramp is looked up above its octaves"
valid(claim, is_above(1), is_above(STEP))


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


# The four products of halves, each within what it may be.
high, first, second, low = Ints("high first second low")
most_low, least_high = 2**16 - 1, -(2**15)
mixed = [And(p <= (2**15 - 1) * most_low, p >= least_high * most_low) for p in (first, second)]
products = And(high <= 2**30, high >= least_high * (2**15 - 1), *mixed, low >= 0, low <= most_low**2)
middle = first + low / 2**16
other = second + middle % 2**16
word = lambda x: And(x >= -(2**31), x < 2**31)
upper = (high * 2**32 + (first + second) * 2**16 + low) / 2**32
valid("times_high_by_halves: the upper word of the product, with no sum beyond a word",
      Implies(products, And(high + middle / 2**16 + other / 2**16 == upper, word(middle), word(other))),
      Implies(products, other < 2**31 - 2**17))
HALF_TRUNCATION, MEAN_TRUNCATION = constant("HALF_TRUNCATION"), constant("MEAN_TRUNCATION")
least, most, near = MEAN_TRUNCATION - HALF_TRUNCATION, MEAN_TRUNCATION + HALF_TRUNCATION, Fraction(1, 500)
truncates = lambda *limits: gappa(horner(*(x if isinstance(x, str) else float(x) for x in limits)))
proven(f"Horner's rule in integers truncates by {float(least)} to {float(most)} units, which is MEAN_TRUNCATION and "
       "HALF_TRUNCATION about it, for |x| up to 0.4999",
       truncates(least, most) and max(half(FILLED), WHOLE) < Fraction(4999, 10000) * WORD,
       not truncates(least + near, most) and not truncates(least, most - near) and not truncates(least, most, "0.5"))
