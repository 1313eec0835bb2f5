"""From fractions to ticks: the order of fractions, whole units of time, and the nearest tick. By z3 and exact fractions."""

from solver import *

# --- Fractions. R rounds to an f32, D divides by 2n and rounds. Both keep order, R keeps n, and D makes 1/2 of that.
code("pub(crate) const fn new(odd: u32, more: f32, n: u32) -> Self {", """
    let (part, rest) = (odd as f32 + more, (2 * n - odd) as f32 - more);
    let all = (2 * n) as f32;
    if part <= rest { Self { side: Start, a: part / all } } else { Self { side: End, a: rest / all } }""")
code("Fraction::new(2 * i + 1, more, self.n)", "}")
code("Pulse { on: self.ticks.around(i, -self.duty),", "off: self.ticks.around(i, self.duty) }")
code("if n > MOST_TRIGGERS {", "return Err(ScheduleError::TooManyTriggers { most: MOST_TRIGGERS }); }")
MOST_TRIGGERS = 1 << int(source(r"const MOST_TRIGGERS: u32 = 1 << (\d+);"))
require(2 * MOST_TRIGGERS <= 2**24, "2i + 1, 2n and their difference are exact")
n, half = Real("n"), Q(1, 2)
exact, part, rest, a, b = ([Real(f"{name}{i}") for i in (0, 1)] for name in ("exact", "part", "rest", "a", "b"))
ordered = [exact[0] <= exact[1], part[0] <= part[1], rest[0] >= rest[1], a[0] <= a[1], b[0] >= b[1]]
for v, p, r, x, y in zip(exact, part, rest, a, b):
    ordered += [Implies(v <= n, And(p <= n, r >= n)), Implies(v >= n, And(p >= n, r <= n))]
    ordered += [Implies(p <= n, x <= half), Implies(r <= n, y <= half)]
from_start = [p <= r for p, r in zip(part, rest)]
place = [If(s, x, 1 - y) for s, x, y in zip(from_start, a, b)]
valid(
    "fractions keep the order of the numbers they stand for, those from the start come first, and none is above 1/2",
    Implies(And(ordered), And(place[0] <= place[1], Implies(from_start[1], from_start[0]), *(If(s, x, y) <= half for s, x, y in zip(from_start, a, b)))),
    Implies(And(ordered[:1] + ordered[2:]), place[0] <= place[1]),
)
i, d = Reals("i d")
ends = lambda most: Implies(And(d > 0, d <= most), And(i - d <= i + d, i + d <= i + 2 - d))
valid("so the ends of pulses are in order, for every duty up to 1", ends(1), ends(Q(101, 100)))
# Exactly half counts from the start only: if the rest is n, so is the part. Two or more from n no rounding comes to n.
in_float = lambda word: fpToFP(RNE(), word, Float32())
m, odd, more = BitVec("m", 32), BitVec("odd", 32), FP("more", Float32())
part, rest = fpAdd(RNE(), in_float(odd), more), fpSub(RNE(), in_float(2 * m - odd), more)
frame = And(m >= 1, m <= MOST_TRIGGERS, odd >= 1, odd <= 2 * m - 1, odd & 1 == 1, odd - m <= 1, m - odd <= 1, fpLEQ(fpAbs(more), FPVal(1, Float32())))
half_from_end = lambda least: Implies(And(frame, fpGT(part, rest)), fpLT(rest, least))
valid("a fraction from the end is below 1/2", half_from_end(in_float(m)), half_from_end(fpSub(RNE(), in_float(m), FPVal(2.0**-2, Float32()))))
# Errors. A trigger's part is exact, so there is one rounding. Of a pulse's end the part is rounded, too: with part and 2n from 1 to 2, by
# 2^-24 at most, and an ulp of the quotient is 2^-23 or, below 1, 2^-24.
part, whole, quotient, error = Reals("part whole quotient error")
scaled = And(part >= 1, part <= 2, whole >= 1, whole < 2, error * whole <= 1, error >= 0)
within = lambda most: Implies(scaled, If(part >= whole, error / 2, error) + half <= most)
valid("a trigger's fraction is within half an ulp; a pulse's end within one and a half", within(Q(3, 2)), within(Q(149, 100)))


def single(x):
    """The nearest f32, to even in the middle, and its ulp."""
    ulp = Fraction(2) ** (x.numerator.bit_length() - x.denominator.bit_length() - 24)
    ulp *= 1 if x < 2**24 * ulp else 2
    return round(x / ulp) * ulp, ulp


exact = 257 - Fraction(0.7388458251953125)
end, ulp = single(single(exact)[0] / 2052)
require(abs(end - exact / 2052) > Fraction(148, 100) * ulp, "an end that is farther off than 1.48 ulp")

# --- Times in whole units: rounded down as one number, and from either end of a section in order.
code("let Pair { hi, lo } = self.way.shifted(self.unit - unit);", """let whole = fixed(hi, 0);
    let rest = (hi - whole as f32) + lo; let down = fixed(rest, 0); let way = whole + down - ((down as f32) > rest) as i64;
    let [base, until] = [fixed(self.base, unit), fixed(self.until, unit)]; let time = if self.back { base - way } else { base + way };
    let is_beyond = if self.back { time < until } else { time > until }; if is_beyond { until } else { time }""")
hi, lo, lost = Reals("hi lo lost")
cut = lambda x: If(x >= 0, ToInt(x), -ToInt(-x))
whole = cut(hi)
rest = hi - whole + lo + lost
way = whole + cut(rest) - If(cut(rest) > rest, 1, 0)
valid(
    "in_units: a way is rounded down as one number, but for what its rest is rounded by",
    Implies(hi >= 0, way == ToInt(hi + lo + lost)),
    Implies(hi >= 0, whole + cut(rest) == ToInt(hi + lo + lost)),
)
# From 2^24 on `hi` is whole, and the rest is `lo`. Below, `lo` is at most (6 + 3) 2^-24 of terms that are 14 times the way at most.
terms = int(documented(r"the terms of a time are at most (\d+) times the time"))
order = documented(r"ways of at least 2²⁴ units keep their order, and shorter ones if they are 2⁻(\S+) of a unit apart")
require(9 * terms + 1 < 2**7 and 2 * Fraction(2**7, 2**25) <= Fraction(1, 2**int(number(order))), "what a rest is rounded by")
first, last, way, back = Reals("first last way back")
smaller = lambda x, y: If(x < y, x, y)
forwards, backwards = smaller(cut(first) + ToInt(way), cut(last)), -smaller(ToInt(back) - cut(last), -cut(first))
section = And(first <= last, way >= 0, back >= 0, first + way <= last - back)
is_whole = lambda x: x == ToInt(x)
one_side = Or(first >= 0, last <= 0, is_whole(first), is_whole(last))
valid(
    "in_units: a time found from a section's start is not after a later one found from its end, but on a section across time 0 with no end in whole units",
    Implies(And(section, one_side), forwards <= backwards),
    Implies(section, forwards <= backwards),
)
valid("in_units: even there by one unit at most", Implies(section, forwards <= backwards + 1))

# --- Ticks. The scale, by the exponents of a length, from 2^37 units, and a rate. An interval has at most 2^TICK_BITS ticks.
code("let up = length.leading_zeros().wrapping_sub(1) & 31;", """let up = if up > 1 { up } else { 0 };
    let zeros = ticks_per_unit.leading_zeros() & 31; let down = (up + zeros) as i32 - unit - 33;
    let down = if down < 63 { down as u32 } else { 63 }; Self { start, up, rate: ticks_per_unit << zeros, down }""")
code("let delay = time.wrapping_sub(self.start);", """let delay = if delay > 0 { delay as u64 } else { 0 };
    let delay = if self.up > 1 { delay << (self.up & 31) } else { delay };
    let (high, low) = (delay >> 32, delay & 0xFFFF_FFFF); let product = high * self.rate as u64 + ((low * self.rate as u64) >> 32);
    (((product >> (self.down & 63)) + 1) >> 1) as u32 }""")
code("let (high, low, rate) = (length >> 32, length & 0xFFFF_FFFF, ticks_per_unit as u64);", """
    let ticks = high * rate + (low * rate).div_ceil(1 << 32); 96 - ticks.saturating_sub(1).leading_zeros() as i32 + unit }""")
code("if exponent_of_ticks(length, ticks_per_unit, unit) > TICK_BITS {", "return Err(too_high(length, ticks_per_unit, unit)); }")
code("let most = if end - start > most { end - start } else { most };", "(most.to_bits() >> 52) as i32 - 1023 - 61 }")
TICK_BITS = int(source(r"const TICK_BITS: i32 = (\d+);"))
SHORTEST, LONGEST = 61 - 24, 62
ticks = BitVec("ticks", 128)
upper = LShR(ticks + (2**32 - 1), 32)
for e in range(97):
    solver = Solver()
    solver.add(UGE(ticks, 1 << SHORTEST), ULT(ticks, 1 << 96))
    solver.add((LShR(upper - 1, e - 32) == 0 if e >= 32 else BoolVal(False)) != ULE(ticks, BitVecVal(1 << e, 128)))
    require(solver.check() == unsat, "exponent_of_ticks")
require(2 ** (LONGEST - 32) * (2**32 - 1) + 2**32 < 2**64, "exponent_of_ticks: the upper 64 bits")
proven("exponent_of_ticks: the least power of two that is not below, for every number of ticks from 2^37 units to 2^96")
downs = set()
for exponent in range(SHORTEST, LONGEST + 1):
    up = 62 - exponent if exponent < 61 else 0
    require(up < 32 and 61 <= exponent + up <= 62, "a length is moved up to 62 or 63 bits")
    for of_rate in range(32):
        most_unit = TICK_BITS - exponent - of_rate
        downs.add(up + 31 - of_rate - most_unit - 33)
least = min(downs)
require(0 < least <= 63, "down")
p, q = Ints("p q")
products = And(p >= 0, p <= (2**32 - 1) ** 2, q >= 0, q <= (2**31 - 1) * (2**32 - 1))
product = q + p / 2**32
for down in range(least, 64):
    tick = (product / 2**down + 1) / 2
    claims = [Implies(products, And(tick == (q * 2**32 + p + 2 ** (32 + down)) / 2 ** (33 + down), product < 2**63)),
              Implies(products, tick == (q * 2**32 + p + 2 ** (32 + down) - 2**31) / 2 ** (33 + down))]
    # Moved by 63, and by more, which is not done, none is half a tick.
    for claim, expected in zip(claims, (unsat, sat if down < 63 else unsat)):
        solver = Solver()
        solver.add(Not(claim))
        require(solver.check() == expected, f"tick: moved down by {down}")
proven(f"TickScale: the tick is floor(delay rate + 1/2) exactly, for every delay in units, length and rate: moved down by {least} or more, and nothing overflows")
# What a tick may be off by: half a tick, and the time before. A direct time is the exact time of a fraction, in whole units; only a
# start that is no whole number is cut, and then there are 2^61 units or nearly so many. A time that is searched for is rounded down by
# less than a unit, and measured by `at_pair`; its base is cut as a start is.
errors = [Fraction(int(said), 2**48) for said in documented(r"and within (\d+), (\d+) and (\d+) · 2⁻⁴⁸ of the three terms for degree 3")]
most_ticks = 2**TICK_BITS
cut_off = Fraction(most_ticks, 2**61 - 2**24)


def shortest():
    """The ramps of one f32 unit, 2^37 units: by the differences of their control times, which are whole multiples, those that never run back."""
    for a in range(4):
        for b in range(4):
            middle = 1 - a - b
            if middle >= 0 or middle**2 <= a * b:
                yield abs(3 * a), abs(3 * (middle - a)), abs(a - 2 * middle + b)


found = max(sum(error * term for error, term in zip(errors, ramp)) for ramp in shortest())
require(sorted(shortest()) == [(0, 0, 1), (0, 3, 2), (3, 3, 1), (3, 6, 4)], "the shortest ramps")
half_tick = Fraction(1, 2)
off = {
    2**SHORTEST: half_tick + Fraction(most_ticks, 2**SHORTEST) + found * most_ticks,
    2 ** (SHORTEST + 1): half_tick + Fraction(most_ticks, 2 ** (SHORTEST + 1)) + max(errors) * terms * most_ticks + 2 * cut_off,
}
promise = Fraction(documented(r"Each tick is within (0\.\d+) tick of the exact time"))
require(max(off.values()) <= promise < max(off.values()) + Fraction(1, 1000), f"{[float(x) for x in off.values()]}")
proven("a tick is off by at most " + ", ".join(f"{float(x):.5f} in intervals of 2^{log2(length):g} units" for length, x in off.items()) + f" or more: the promise is {float(promise)}; direct ones by at most 1/2 and 2^{log2(cut_off):.1f}")
