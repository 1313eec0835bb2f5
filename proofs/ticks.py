"""src/ticks.rs: from times to ticks in integers; pulse.rs: the order of pulses' ends. By z3."""

from solver import *

code("fn tick(&self, time: i64) -> u32 {", "self.tick_of_delay(time.wrapping_sub(self.start)) }")
code("fn tick_of_delay(&self, delay: i64) -> u32 {", """let (high, low) = ((delay as u64 >> 32) as u32, delay as u32 as u64);
    let low = ((low * self.power as u64) >> 32) as u32;
    let delay = (high.wrapping_mul(self.power).wrapping_add(low) as i32).max(0) as u64;
    let low = (delay * (self.factor as u32 as u64)) >> 32;
    ((delay * (self.factor >> 32) + low + (1 << 31)) >> 32) as u32 }""")
code("let up = length.leading_zeros().wrapping_sub(1) & 31;", """let shift = unit + 96 - up as i32; let rate = tick_hz as u64;
    let factor = if shift < 0 { rate.checked_shr(shift.unsigned_abs()) } else { rate.checked_shl(shift.unsigned_abs()) };
    Self { start, power: 1 << up, factor: factor.unwrap_or(0) }""")

# A delay moved up, and its upper word: for each shift.
delay = BitVec("delay", 64)
for up in range(27):
    high, low = Extract(63, 32, delay), Extract(31, 0, delay)
    word = high * BitVecVal(1 << up, 32) + Extract(31, 0, LShR(ZeroExt(32, low) << up, 32))
    limit = BitVecVal(1 << (63 - up), 64)

    def moved(within):
        return Implies(And(delay < within, delay >= -within), And(
            SignExt(32, word) == (delay << up) >> 32, (word < 0) == (delay < 0)))

    if up == 0:
        # Then every delay fits.
        claim, more = And(SignExt(32, word) == delay >> 32), None
    else:
        claim, more = moved(limit), moved(limit + 1)
    solver = Solver()
    solver.add(Not(claim))
    require(solver.check() == unsat, f"tick: a delay moved up by {up}")
    if more is not None:
        solver = Solver()
        solver.add(Not(more))
        require(solver.check() == sat, "tick: no further than 31 bits")
proven("tick: a delay is moved up and cut to its upper word exactly, for each shift, and one before the start stays negative")

# The products of 31 bits by 32 are exact in 64; here they are any numbers that such products may be.
p, q = Ints("p q")
products = And(p >= 0, p <= (2**31 - 1) * (2**32 - 1), q >= 0, q <= (2**31 - 1) * (2**32 - 1))
tick = (q + p / 2**32 + 2**31) / 2**32
valid(
    "tick: floor(delay factor / 2^64 + 1/2) exactly, nothing overflows, and it is below 2^32",
    Implies(products, And(tick == (q * 2**32 + p + 2**63) / 2**64, q + p / 2**32 + 2**31 < 2**64, tick < 2**32)),
    Implies(products, tick == (q * 2**32 + p + 2**63 - 2**31) / 2**64),
)

# The factor: rate 2^(unit + 96 - up), where the interval has at most 2^DIRECT_TICKS ticks: rate length 2^unit is at most that,
# and length at least 2^(62 - up).
direct = int(source(r"const DIRECT_TICKS: i32 = (\d+);"))
for up in range(27):
    factor = Fraction(2) ** (direct - (62 - up)) * Fraction(2) ** (96 - up)
    require(factor == 2 ** (direct + 34) and factor < 2**64, "the factor")
cut = Fraction(2 ** (direct + 34), 2**64) + Fraction(2**31, 2**64)
require(cut <= Fraction(1, 4) and Fraction(2 ** (direct + 5), 2**30) > Fraction(1, 4), "cut")
proven(f"TickScale: the factor is at most 2^{direct + 34}, and what is cut off a delay and the factor is at most 2^{log2(cut):.3f} tick")

# `fixed` and `plus` aside, an exponent of ticks.
code("let ticks = length as u128 * tick_hz as u128;", "u128::BITS as i32 - ticks.saturating_sub(1).leading_zeros() as i32 + unit }")
t = BitVec("ticks", 128)
for e in range(97):
    solver = Solver()
    bits = LShR(t - 1, e) == 0  # at most e bits
    solver.add(UGT(t, 0), ULT(t, 1 << 96), bits != ULE(t, BitVecVal(1 << e, 128)))
    require(solver.check() == unsat, "exponent_of_ticks")
proven("exponent_of_ticks: the least power of two that is not below, for every number of ticks below 2^96")

# Pulses. Ends that are half a share apart or more are in order: that is what triggers promise. All others in any order.
# The last off of full pulses is the curve's end, by a search, which no other end is behind.
code("let mut start = self.ticks.edge(i, on);", """if self.is_close && i > 0 { start = start.max(self.ticks.edge(i - 1, off)); }
    let end = if self.is_full && i + 1 == self.n() { self.ticks.searched(2 * i as u64 + 1, off) } else { self.ticks.edge(i, off) };
    (start, end.max(start)) }""")
code("let frame = Pulses { ticks, edges, is_close: duty >", "0.5, is_full: duty == 1.0 };")
duty = Real("duty")
ends = [(Int(f"on{i}"), i - duty / 2, Int(f"off{i}"), i + duty / 2) for i in range(4)]
flat = [(tick, place) for on, a, off, b in ends for tick, place in ((on, a), (off, b))]


def ordered(apart):
    return And([Implies(b - a >= apart, s <= t) for s, a in flat for t, b in flat if s is not t])


def greater(a, b):
    return If(a > b, a, b)


def pulses(limit):
    answers = []
    for i, (on, _, off, _) in enumerate(ends):
        start = on if i == 0 else If(duty > limit, greater(on, ends[i - 1][2]), on)
        answers.append((start, greater(off, start)))
    return And([on <= off for on, off in answers] + [a[1] <= b[0] for a, b in zip(answers, answers[1:])])


domain = And(duty > 0, duty <= 1)
half = RealVal("1/2")
valid(
    "pulses: on and off and the next on are in order, whatever ticks ends have that are less than half a share apart",
    Implies(And(domain, ordered(half)), pulses(half)),
    Implies(And(domain, ordered(half)), pulses(RealVal("51/100"))),
    Implies(And(domain, ordered(RealVal("51/100"))), pulses(half)),
)
