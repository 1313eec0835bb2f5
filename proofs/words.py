"""The plateau's line, the rounding of a time, and bits of numbers: for all values of the words, by z3."""

from z3 import *

from common import *

pinned("""
inverse.rs on_line 11ca6ef0 in_line_units 6fe0fed4 last_before_line e915c97a upper_word a882ad8d rounded_near_0 979ba1b4
number/pair.rs upper 5180492f significand a3252cda
number/units.rs exponent eb440cf3 fixed_down 12e34aed fixed_towards_0 c6a6eaa3 floor_bits 60a73088
""")

# The plateau's line.
# The two products, of 32 bits by 32, are exact in 64; here they are any numbers that such products may be.
p, q = Ints("p q")
greatest = (2**32 - 1) ** 2
products = And(p >= 0, p <= greatest, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
way = lambda bits: Implies(products, And(q + p / 2**32 == (q * 2**32 + p) / 2**32, q + p / 2**32 < 2**bits))
valid("on_line: the way is floor(slope u / 2^32), and stays within 63 bits", way(63), way(62))
FINE = 127 + int(log2(constant("FINE")))
bits = BitVec("bits", 32)
shift = 126 - LShR(bits, 23)
whole = (bits << 8) | (1 << 31)


def line(first):
    back = LShR(whole, shift) << shift
    return Implies(And(UGE(bits, first << 23), ULT(bits, 127 << 23)), And(ULE(shift, 31), back == whole))


valid("in_line_units: a fraction from FINE to 1 is a whole number of 2^-32", line(FINE), line(FINE - 1))

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
    size = And(Or(word >= 1 << bits, word < -(1 << bits)))
    return Implies(Not(near_0), And(stands_for(word, time, 32), size))


require(LEAST_BITS - 23 - 1 >= 1, "middles between f32 are even numbers")
claim = "inverse_cdf: one conversion of 32 bits rounds a time of 64 as the exact time rounds"
valid(claim, one_word(LEAST_BITS), one_word(LEAST_BITS + 1))


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
        require_valid(f"rounded_near_0, moved up by {up}", carefully(is_word, up))
valid("rounded_near_0: the word is full, and rounds as the exact time rounds; for every time but 0",
      carefully(True, 3), carefully(True, 3, (1 << 30) + 1))

# Bits of f32.
x = BitVec("x", 32)
significand = (x & 0x7FFFFF) | (1 << 23)
high = significand & 0xFFFFF000
is_normal = And(LShR(x << 1, 24) != 0, LShR(x << 1, 24) != 255)
is_upper = And((x & 0xFFFFF000) & 0xFF800000 == x & 0xFF800000, high & 0xFFF == 0, ULT(LShR(high, 12), 1 << 12))
halves = lambda most: Implies(is_normal, And(is_upper, ULE(significand - high, most)))
claim = "upper: both halves of a normal number have at most 12 bits, so products of halves are exact"
valid(claim, halves(4095), halves(4094))

# `exponent`, `fixed_down` and `floor_bits` by exact rationals, for every exponent and the significands at the edges.
# What they do with the bits of a significand is the same for all: a shift.
up, sig = BitVec("up", 64), BitVec("sig", 64)
# A number below 2^63 units: |sig| 2^up < 2^63, so up is at most 62 where sig is not 0.
size = If(sig < 0, -sig, sig)
is_below = Implies(up >= 0, LShR(BitVecVal(2**63 - 1, 64), up) >= size)
fits = And(up <= 62, up >= -400, sig > -(1 << 24), sig < 1 << 24, is_below)


def whole(most_down):
    units = If(up >= 0, sig << (up & 63), sig >> If(up > -most_down, -up & 63, BitVecVal(most_down, 64)))
    down = If(-up > 60, BitVecVal(60, 64), -up)
    floor = And(units << down <= sig, sig - (units << down) < BitVecVal(1, 64) << down)
    return Implies(fits, If(up >= 0, units >> up == sig, floor))


valid("fixed_down: the whole units of a number below 2^63 of them, rounded down", whole(63), whole(23))
# A subnormal number, whose exponent counts as 0, has no unit: up is at most -64 where e is at least -1011.
fits = And(up <= 10, up >= -4000, ULT(sig, 1 << 53), UGE(sig, 1 << 52))
units = If(up >= 0, sig << (up & 63), If(up > -64, sig >> (-up & 63), BitVecVal(0, 64)))
down = If(-up > 63, BitVecVal(63, 64), -up)
floor = And(units << down <= sig, ULT(sig - (units << down), BitVecVal(1, 64) << down))
towards_0 = lambda floor: Implies(fits, If(up >= 0, And(LShR(units, up) == sig, units >= 0), floor))
claim = "fixed_towards_0: the whole units of a double below 2^63 of them, rounded towards 0"
valid(claim, towards_0(floor), towards_0(units << down == sig))
# `floor_bits`: the nearest f32 of a double, or the one below. The bits of the f32 from 0 up are in order, so the one
# below has one less, also across a power of two.
y = FP("y", Float64())
rounded = fpFPToFP(RNE(), y, Float32())
double = lambda single: fpFPToFP(RNE(), single, Float64())
below = fpBVToFP(fpToIEEEBV(rounded) - 1, Float32())
inside = And(fpIsPositive(y), fpLEQ(y, FPVal(2, Float64())))
is_above = fpGT(double(rounded), y)
answer = If(is_above, below, rounded)
next_one = fpBVToFP(fpToIEEEBV(answer) + 1, Float32())
is_last = lambda order: Implies(inside, And(order(double(answer), y), fpGT(double(next_one), y)))
valid("floor_bits: the greatest f32 at or below, for every double from 0 (not -0) to 2", is_last(fpLEQ), is_last(fpEQ))

# `significand` cuts a double's 53 bits: 24 and 24 more.
double = BitVec("double", 64)
exact = (double & (2**52 - 1)) | 2**52
hi = (LShR(double, 29) & 0x7FFFFF) | (1 << 23)
lo = LShR(double, 5) & 0xFFFFFF
lost = exact - ((hi << 29) + (lo << 5))
cut = lambda most: And(lost >= 0, lost <= most, ULT(lo, 1 << 24))
valid("significand: 48 bits of the double, cut, so that less than 2^-47 is lost; the second number is below an ulp of "
      "the first",
      cut(31), cut(30))
