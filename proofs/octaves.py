"""That the look-up and the offset lead to the `x` at which a polynomial was judged; and what Horner's rule in integers
truncates.

Of `Inverse::look_up` and `section`, `Octave::offset` and `polynomial`, `product_high_by_halves`, `Span::new` and
`center`, `top_beyond`, `candidate`.
"""

from z3 import *

from common import *

SHIFT_MASK, STEP = constant("SHIFT_MASK"), constant("EIGHTH")
# The index, and the significand with its sign, which is the place in the octave. `bits` are those of a
# fraction above 0 and at most `top`.
top, bits = BitVecs("top bits", 32)
below = top - bits
index, significand = LShR(below, 23), (bits ^ ((top ^ below) & (1 << 23))) << 8
octave_top = top - (index << 23)
domain = And(UGT(bits, 0), ULE(bits, top), ULT(top, 1 << 31))
found = lambda is_below: Implies(domain, And(is_below(bits, octave_top), UGT(bits + (1 << 23), octave_top)))
valid("the look-up finds the octave below whose top, and above half of whose top, the fraction is",
      found(ULE), found(ULT))
binade = lambda lower: LShR(octave_top, 23) - If(significand < 0, BitVecVal(lower, 32), BitVecVal(0, 32))
is_told = lambda lower: And(LShR(bits, 23) == binade(lower), significand << 1 == bits << 9)
signed = lambda lower: Implies(And(domain, UGE(bits, 1 << 23)), is_told(lower))
valid("its sign says in which of the octave's two binades the fraction is, and the rest is its significand",
      signed(1), signed(0))
raised, k = (127 + int(log2(constant("NO_OCTAVES"))) << 23) + (BitVec("k", 32) << 23), BitVec("k", 32)
asked = Or(ULE(bits, 126 << 23), UGT(bits, 255 << 23))
is_none = lambda most: Implies(And(asked, ULE(k, 64)), UGE(LShR(raised - bits, 23), most))
valid("a ramp without octaves has none at any index, for each fraction up to 1/2, NaN and negative number",
      is_none(64), is_none(65))

# The offset. The fraction, in 2^-32 of the power of two at or below the octave's top, is an integer `exact` of 34 bits.
significand, center = BitVec("significand", 32), BitVec("center", 64)
exact = (1 << 32) + If(significand < 0, SignExt(32, significand), 2 * SignExt(32, significand))
shift, word = center & SHIFT_MASK, 1 << 31
position, center_word = significand + (significand & ~(significand >> 31)), Extract(31, 0, center)
offset = (position - center_word) << (center_word & SHIFT_MASK)

moved = lambda limit: BitVecVal(limit, 64) >> shift
# As shifts round down, these limits are those of least <= (exact - center) 2^shift <= most.
leads_to = lambda least, most: Implies(
    And(ULT(center, 1 << 34), exact - center >= moved(least), exact - center <= moved(most)),
    SignExt(32, offset) == (exact - center) << shift)
valid("offset is (exact - center) 2^shift, if that fits the word: for all positions, centers and shifts",
      leads_to(-word, word - 1), leads_to(-word, word), leads_to(-2 * word, word - 1))

# Does it fit? All of this in 2^-32 of the octave's power of two. A part has f32 for its ends, and `half` is half its
# length and 4 EPSILON, exact unless it is above a quarter. The loop halves while half <= FILLED width, so after the
# last halving it is at most 2 FILLED of the width; without one it is at most a quarter of a top that is less than twice
# the width, by a step, and 4 EPSILON. The middle is off by the rounding of the sum of the ends, the center by what its
# lowest bits come to.
FILLED, MOST_SHIFT = constant("FILLED"), constant("MOST_SHIFT")
# In `candidate` and in `Span::new`.
REACH, EPSILONS, WORD = Fraction(1, 100), 4, 2**32
EPSILON = WORD // 2**23
# Half of the rounding of a sum below 4. A served fraction is as near to the f32 between which the part is.
MIDDLE = SERVED = EPSILON // 2
# The greatest half, in the width's 2^-32: without a halving, and after one.
WHOLE = ((2 - Fraction(STEP, 1 << 23)) / 4 * WORD + EPSILONS * EPSILON) * (1 + 2 * U)
half = lambda filled: 2 * filled * WORD * (1 + 2 * U)
fits = lambda filled: max(half(filled), WHOLE) < WORD / 2
served_fits = lambda filled, more=EPSILONS: more * EPSILON >= SERVED + MIDDLE + SHIFT_MASK and fits(filled)
proven("the offset of each fraction that a part serves is within its half and fits the word, for FILLED = "
       f"{float(FILLED)} and any shift; with 0.25, or a half of one EPSILON more than the part, not so",
       served_fits(FILLED) and not served_fits(Fraction(1, 4)) and not served_fits(FILLED, 1))
# The same for fractions up to 4 EPSILON beyond the part, and what the reach allows.
off = lambda shift: (MIDDLE + SHIFT_MASK) * 2**shift
far = max(shift for shift in range(32) if half(FILLED) + off(shift) < WORD / 2)
within = max(shift for shift in range(32) if off(shift) <= REACH * WORD)
proven(f"so do those of fractions up to {EPSILONS} EPSILON beyond, with all shifts up to {MOST_SHIFT} (up to {far} "
       "would do)",
       WHOLE + off(0) < WORD / 2 and MOST_SHIFT <= min(far, within) and far < 31)
# Tops keep 16 ulp from where a range begins, and are at or above where it ends.
bits, top, end = BitVecs("bits top end", 32)
raised = If(ULT((top - bits + 16) & 0x7FFFFF, 32), top + STEP, top)
distances = [(raised - bits) & 0x7FFFFF, (bits - raised) & 0x7FFFFF]
normal = And(ULT(top, 128 << 23), ULT(bits, 128 << 23))
apart = lambda least: Implies(normal, And(*(UGE(distance, least) for distance in distances)))
valid("a range that begins above 0 begins 16 ulp or more below each octave's end, or above it", apart(16), apart(17))
top_of = lambda less: UDiv(end + STEP - less, BitVecVal(STEP, 32)) * STEP
is_above = lambda less: Implies(ULT(end, 127 << 23), And(UGE(top_of(less), end), ULT(top_of(less) - end, STEP)))
valid("a top is at or above the end of its ramp, so that no fraction of the ramp is looked up above its octaves",
      is_above(1), is_above(STEP))

# Horner's sums. With |x| within the reach, each is at most the bound of the exact one, half a unit for each
# coefficient's rounding and one for each product's, and the bound is computed with up to three roundings a step.
DEGREE, GUARD = constant("DEGREE"), Fraction(1, 2**16)

beside = sum(Fraction(3, 2) * (2 * FILLED + REACH) ** k for k in range(DEGREE))
sums_fit = lambda guard: 2**31 / ((1 + guard) * (1 - U) ** (3 * DEGREE + 3)) + beside < 2**31
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
# Horner's rule rounds each product down: by less than 1, times each power of x that follows.
reach, most_lost = Fraction("0.4999"), lambda x, first, step: sum(x**k for k in range(first, DEGREE, step))
mean, off = -constant("MEAN_TRUNCATION"), constant("HALF_TRUNCATION")
is_within = lambda x: most_lost(x, 0, 1) <= mean + off and most_lost(x, 1, 2) <= off - mean
proven(f"Horner's rule in integers truncates by {float(-mean - off)} to {float(off - mean)} units, which is "
       "MEAN_TRUNCATION and HALF_TRUNCATION about it, for |x| up to 0.4999, which no offset passes",
       is_within(reach) and max(half(FILLED), WHOLE) < reach * WORD and not is_within(Fraction(1, 2)))
# The four products of halves, each within what it may be.
high, first, second, low = Ints("high first second low")
most_low, least_high = 2**16 - 1, -(2**15)
mixed = [And(p <= (2**15 - 1) * most_low, p >= least_high * most_low) for p in (first, second)]
products = And(high <= 2**30, high >= least_high * (2**15 - 1), *mixed, low >= 0, low <= most_low**2)
middle = first + low / 2**16
other = second + middle % 2**16
word = lambda x: And(x >= -(2**31), x < 2**31)
upper = (high * 2**32 + (first + second) * 2**16 + low) / 2**32
valid("product_high_by_halves: the upper word of the product, with no sum beyond a word",
      Implies(products, And(high + middle / 2**16 + other / 2**16 == upper, word(middle), word(other))),
      Implies(products, other < 2**31 - 2**17))
