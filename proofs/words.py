"""The plateau's line, the rounding of a time, and conversions: for all values of the words.

Of `on_line`, `in_line_units`, `upper_word` and `rounded_near_0`; `fixed_down`, `fixed_towards_0` and `floor_bits`.
"""

from z3 import *

from common import *

# The plateau's line. The two products, of 32 bits by 32, are any numbers that such products may be.
p, q = Ints("p q")
products = And(p >= 0, p <= (2**32 - 1) ** 2, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
way = lambda bits: Implies(products, And(q + p / 2**32 == (q * 2**32 + p) / 2**32, q + p / 2**32 < 2**bits))
valid("on_line: the way is floor(slope u / 2^32), and stays within 63 bits", way(63), way(62))
LINE_FROM = 127 + int(log2(constant("LINE_FROM")))
bits = BitVec("bits", 32)
shift = 126 - LShR(bits, 23)
whole = (bits << 8) | (1 << 31)
line = lambda first: Implies(And(UGE(bits, first << 23), ULT(bits, 127 << 23)),
                             And(ULE(shift, 31), LShR(whole, shift) << shift == whole))
valid("in_line_units: a fraction from LINE_FROM to 1 is a whole number of 2^-32", line(LINE_FROM), line(LINE_FROM - 1))

# The rounding of a time. All f32 near a number of 25 or more bits, and all middles between two of them, are even
# numbers. So an odd number may stand for all that lies between its even neighbours.
LEAST_BITS = 25
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
    size = Or(word >= 1 << bits, word < -(1 << bits))
    return Implies(Not(near_0), And(stands_for(word, time, 32), size))


require(LEAST_BITS - 23 - 1 >= 1, "middles between f32 are even numbers")
valid("upper_word: one conversion of 32 bits rounds a time of 64 as the exact time rounds",
      one_word(LEAST_BITS), one_word(LEAST_BITS + 1))


def carefully(is_word, up, least=1 << 30):
    """Case by case of `up`, since z3 is slow where shifts are unknown."""
    sign = Extract(31, 0, time >> 63)
    here = (Extract(63, 32, time) == sign) == BoolVal(is_word)
    moved, down = (time << 31, 31) if is_word else (time, 0)
    high, low = Extract(63, 32, moved), Extract(31, 0, moved)
    first = high ^ sign
    # What leading_zeros() - 1 is; 32 zeros give 31, too.
    leads = Or(first == 0, LShR(first, 31) == 1) if up == 31 else LShR(first, 30 - up) == 1
    filled = (high << up) | LShR(LShR(low, 1), 31 - up) | If(low << up != 0, BitVecVal(1, 32), BitVecVal(0, 32))
    size = Or(filled >= least, filled <= -least)
    return Implies(And(here, leads, time != 0), And(stands_for(filled, moved, 32 - up), size))


for is_word in (True, False):
    for up in range(32):
        require_valid(f"rounded_near_0, moved up by {up}", carefully(is_word, up))
valid("rounded_near_0: the word is full, and rounds as the exact time rounds; for every time but 0",
      carefully(True, 3), carefully(True, 3, (1 << 30) + 1))

# Conversions, for every significand `sig` and exponent: what they do with the bits is a shift. An f32's is moved up to
# 62 bits, and down by 62 at most, or more where it is less than a unit.
sig, down = BitVecs("sig down", 128)
fits = And(sig > -(1 << 24), sig < 1 << 24, down >= 0, down <= 400)
units = (sig << 39) >> If(down < 63, down, BitVecVal(63, 128))
floor = lambda units: Implies(And(fits, down < 100), And(units << down <= sig << 39, (units + 1) << down > sig << 39))
valid("fixed_down: the whole units of a number below 2^63 of them, rounded down", floor(units), floor(units + 1))
# A subnormal double, whose exponent counts as 0, has no unit: up is at most -64 where e is at least -1011.
up, sig = BitVecs("up sig", 64)
fits = And(up <= 10, up >= -4000, ULT(sig, 1 << 53), UGE(sig, 1 << 52))
units = If(up >= 0, sig << (up & 63), If(up > -64, sig >> (-up & 63), BitVecVal(0, 64)))
down = If(-up > 63, BitVecVal(63, 64), -up)
floor = And(units << down <= sig, ULT(sig - (units << down), BitVecVal(1, 64) << down))
towards_0 = lambda floor: Implies(fits, If(up >= 0, And(LShR(units, up) == sig, units >= 0), floor))
valid("fixed_towards_0: the whole units of a double below 2^63 of them, rounded towards 0",
      towards_0(floor), towards_0(units << down == sig))
# The nearest f32 of a double, or the one below. The bits of the f32 from 0 up are in order, so the one below has one
# less, also across a power of two.
y = FP("y", Float64())
rounded = fpFPToFP(RNE(), y, Float32())
double = lambda single: fpFPToFP(RNE(), single, Float64())
inside = And(fpIsPositive(y), fpLEQ(y, FPVal(2, Float64())))
answer = If(fpGT(double(rounded), y), fpBVToFP(fpToIEEEBV(rounded) - 1, Float32()), rounded)
next_one = fpBVToFP(fpToIEEEBV(answer) + 1, Float32())
is_last = lambda order: Implies(inside, And(order(double(answer), y), fpGT(double(next_one), y)))
valid("floor_bits: the greatest f32 at or below, for every double from 0 (not -0) to 2", is_last(fpLEQ), is_last(fpEQ))
