"""The numbers and inequalities of an octave's certificate, in exact rational arithmetic.

Taken as known: a polynomial of degree n < N is on [-1, 1] at most 1 / cos(n pi / 2N) times its greatest value at the points cos(i
pi / N) (Ehlich and Zeller 1964); a function that is at most M on the ellipse with the half axes (rho +- 1/rho) / 2 is within
2 M rho^-n / (rho - 1) of its Chebyshev series up to degree n (Bernstein 1912); |p'| <= n^2 max |p| (Markov 1889).
"""

import random
from math import comb

import majorant
import z3

from common import *

code("const fn ellipse(rho: f32) -> Ellipse {", """let square = 1.0 / (rho * rho);
    let twelfth = square * square * square * square * square * square;
    Ellipse { axis: 0.5 * (rho + 1.0 / rho), tail: 2.0 * twelfth / (rho - 1.0), square } }""")
code("const COSINES: &[i32; POINTS / 2 + 1] = &{", """
    let (mut cosines, mut cosine, mut last, mut i) = ([0; POINTS / 2 + 1], 1.0, COSINE, 0);
    while i < cosines.len() { cosines[i] = (cosine * PLACE as f64 + 0.5) as i32;
    (cosine, last) = (2.0 * COSINE * cosine - last, cosine); i += 1; } cosines };""")
code("let (mut seen, mut i) = ([0.0; KINDS], 0);", """
    while i < COSINES.len() { let mut place = COSINES[i]; loop {
    let half = 1 << (FRACTION_BITS - 1);
    let position = ((at(&along.fraction, place) + half) >> FRACTION_BITS) as i32;
    let value = octave.polynomial(octave.offset(position));
    let error = (((value as i64) << TIME_BITS) - at(&along.time, place)).unsigned_abs();
    let error = (error >> 32) as u32 as f32 * WORD + error as u32 as f32;
    let error = error / (1 << TIME_BITS) as f32;""")
code("if place <= 0 { break; }", "place = -place; } i += stride; }")
code("counted[k] = fixed_f64(c[k], -bits);", "are_counted &= counted[k].unsigned_abs() >> 60 == 0;")
code("const fn at(c: &[i64], place: i32) -> i64 {", """let (mut value, mut c) = (0, c);
    while let [lower @ .., next] = c { let (high, low) = (value >> 32, value & 0xFFFF_FFFF);
    value = 4 * (high * place as i64) + ((low * place as i64) >> 30) + *next; c = lower; } value }""")
code("let noise = noise * absolute(&weights[kind], 1.0);", """least[kind] -= noise;
    most[kind] = bound(SLACK * (seen[kind] + noise), &tails, &weights[kind], stride);""")
code("let Ellipse { axis, tail, .. } = ELLIPSES[i];", "tails[i] = SLACK * tail * off_line(octave, x, axis);")
code("let Ellipse { axis, square, .. } = ELLIPSES[i];", """
    let mut tail = tails[i] * absolute(weight, axis);
    let (mut last, mut k, mut degrees) = (f32::INFINITY, HALF_DEGREE * stride, DEGREES);
    while degrees > 0 && k < COSINES.len() {
    let bound = (seen + tail) * PLACE / COSINES[k] as f32 + tail;
    degrees = if bound < last { degrees - 1 } else { 0 };
    least = if bound < least { bound } else { least }; (last, tail) = (bound, tail * square); k += stride; }""")
code("let linear = x0.abs() + x1.abs() * axis;", """let curve = absolute(curved, axis) * axis * axis;
    let (mut power, mut more, mut sum) = (linear, curve, 0.0);
    let [above @ .., _] = &octave.c; let mut c: &[i32] = above;
    while let [higher @ .., next] = c { more = (linear + curve) * more + curve * power; power *= linear;
    sum += next.unsigned_abs() as f32 * more; c = higher; } sum }""")
code("pub(crate) const fn absolute(c: &[f32], x: f32) -> f32 {", """let (mut value, mut c) = (0.0, c);
    while let [lower @ .., next] = c { value = value * x + next.abs(); c = lower; } value }""")

DEGREE = int(source(r"pub\(crate\) const DEGREE: usize = (\d+);"))
HALF_DEGREE = int(source(r"const HALF_DEGREE: usize = (\d+);"))
DEGREES = int(source(r"const DEGREES: usize = (\d+);"))
SLACK = 1 + 1 / Fraction(2 ** int(source(r"const SLACK: f32 = 1\.0 \+ 1\.0 / \(1 << (\d+)\) as f32;")))
MOST_POINTS = int(source(r"const POINTS: usize = (\d+);"))
COSINE = float(source(r"const COSINE: f64 = ([\d.]+);"))
code("stride = if is_decided { 0 }", "else { stride / 2 }; }")
# Every fourth point, every second, and all.
STEPS = [int(source(r"pub\(crate\) const FIRST_STRIDE: usize = (\d+);")) >> halvings for halvings in range(3)]
PLACES = 2 ** int(source(r"const PLACE: f32 = \(1 << (\d+)\) as f32;"))
RHOS = [float(rho) for rho in re.findall(r"ellipse\(([\d.]+)\)", source(r"const ELLIPSES: [^=]*=\s*\[([^;]*)\];"))]
require(STEPS == [4, 2, 1] and MOST_POINTS % 8 == 0 and len(RHOS) == 6, "points and ellipses")
COEFFICIENTS = int(source(r"    x: &\[f32; (\d+)\],\n    weights"))
WEIGHT = int(source(r"weights: &\[\[f32; (\d+)\]; KINDS\]"))
source(r"\[x0, x1, curved @ \.\.\]: &\[f32; 7\]")


# --- Cosines, to 2^-200.
def arctan_inverse(n):
    total, term, k = Fraction(0), Fraction(1, n), 0
    while term > Fraction(1, 2**220):
        total += term / (2 * k + 1) * (-1) ** k
        term, k = term / n**2, k + 1
    return total


PI = 16 * arctan_inverse(5) - 4 * arctan_inverse(239)


def cosine(x):
    total, term, k = Fraction(0), Fraction(1), 0
    x = Fraction(int(x * 2**230), 2**230)
    while abs(term) > Fraction(1, 2**220):
        total += term
        k += 2
        term = Fraction(int(-term * x * x / (k * (k - 1)) * 2**240), 2**240)
    return total


LAST_PLACE = Fraction(1, 2**53)
require(all(abs(Fraction(COSINE) - cosine(PI / MOST_POINTS)) <= abs(Fraction(COSINE) + one - cosine(PI / MOST_POINTS)) for one in (LAST_PLACE, -LAST_PLACE)), "its neighbours are no nearer")


# The table, as the recurrence makes it in doubles. For the degree n = 2 i and N points, a step apart, the share is the cosine
# of n pi / 2N, which is that of i step pi / MOST_POINTS.
def table(first):
    cosines, s, last = [], 1.0, first
    for _ in range(MOST_POINTS // 2 + 1):
        cosines.append(int(s * PLACES + 0.5))
        s, last = 2.0 * first * s - last, s
    return cosines


def off_table(cosines):
    return max(abs(Fraction(c, PLACES) - cosine(PI * i / MOST_POINTS)) for i, c in enumerate(cosines))


COSINES = table(COSINE)
off = off_table(COSINES)
require(off <= Fraction(1, 2 * PLACES) * (1 + Fraction(1, 2**10)) and COSINES[0] == PLACES and COSINES[-1] == 0, f"2^{log2(off)}")
require(off_table(table(COSINE * (1 - 2.0**-40))) > off * 2, "a cosine that is wrong by 2^-40 is seen")
proven(f"the table's {len(COSINES)} cosines are within 2^{log2(off):.2f}")
# By how many roundings of 2^-24 a bound is too small as samples are off their points, by Markov's inequality, and the share by its
# own error: max |p| <= (seen + tail + off n^2 max |p|) / (share - off).
spoilt = Fraction(0)
for step in STEPS:
    for half in range(HALF_DEGREE, HALF_DEGREE + DEGREES):
        if half * step < len(COSINES) - 1:
            share = Fraction(COSINES[half * step], PLACES)
            spoilt = max(spoilt, share / (share - off - off * (2 * half) ** 2) - 1)
        else:
            require(half * step == len(COSINES) - 1, "beyond the table")
spoilt /= U
stated, places_off = (int(said) for said in documented(r"too small by at most (\d+) roundings of 2⁻²⁴, and by (\d+) for samples off their points"))
require(places_off - 1 < spoilt <= places_off, f"{float(spoilt)} roundings for samples off their points")
proven(f"samples off their points, and cosines off theirs, make a bound too small by {float(spoilt):.1f} roundings of 2^-24 at most")

# What samples lose in integers: a coefficient less than a unit as it is cut, and so each product as it is rounded down; places are at
# most 1, so nothing that is lost grows.
A, B = z3.Ints("A B")
solver = z3.Solver()
solver.add((A * 2**32 + B) / 2**30 != 4 * A + B / 2**30)
require(solver.check() == z3.unsat, "the product by words")
FRACTION_BITS, TIME_BITS = (int(source(rf"const {name}_BITS: i32 = (\d+);")) for name in ("FRACTION", "TIME"))
sample_off = Fraction(int(source(r"const SAMPLE_OFF: f32 = ([\d]+)\.0 / \(1 << TIME_BITS\) as f32;")), 2**TIME_BITS)
require(sample_off == Fraction(4 + 3, 2**TIME_BITS), "SAMPLE_OFF")
position = Fraction(1, 2) + Fraction(7 + 6, 2**FRACTION_BITS)
allowed = Fraction(source(r"let noise = limits\.rounding \+ ([\d.]+) \* steep \* per_position as f32;"))
require(Fraction(1, 2) < position <= allowed < Fraction(1, 2) * Fraction(1001, 1000), "a sample's position")
# Up to 7 numbers below 2^60, and what is lost on the way: so a value fits, and four times a product of its upper word.
require(7 * (2**60 + 1) < 2**63 and PLACES == 2**30, "no value beyond its words")
proven(f"samples in integers: a time is off by at most SAMPLE_OFF = 2^{log2(sample_off):.2f} units, a position by 1/2 and 2^{log2(position - Fraction(1, 2)):.1f}; none is beyond 63 bits")

# --- Degrees.
offset, time, weight = COEFFICIENTS - 1, 3, WEIGHT - 1
left_out = max(DEGREE, time, offset) + weight
require(left_out <= 2 * HALF_DEGREE, "what is left out of M")
require(left_out > 2 * (HALF_DEGREE - 1), "a least degree less by two would not do")
require([int(said) for said in documented(r"`R` has degree (\d+) and `R` times a cubic (\d+)")] == [offset * DEGREE, offset * DEGREE + weight], "degrees")
proven(f"R has degree {offset * DEGREE}, and R times a cubic {offset * DEGREE + weight}; what M leaves out has degree {left_out}, at most the least that is tried, {2 * HALF_DEGREE}")


# --- Ellipses: in single precision, and exactly.
def single(x):
    import struct

    return struct.unpack("<f", struct.pack("<f", x))[0]


axes_low = {}
for rho in RHOS:
    r = Fraction(rho)
    # By single roundings; a double's product or quotient of two f32, rounded to one, is rounded once.
    inverse = single(1.0 / rho)
    axis = 0.5 * single(rho + inverse)
    square = single(1.0 / single(rho * rho))
    twelfth = square
    for _ in range(5):
        twelfth = single(twelfth * square)
    first = single(2.0 * twelfth / single(rho - 1.0))
    exact = (r + 1 / r) / 2, 1 / r**2, 2 / (r ** (2 * HALF_DEGREE) * (r - 1))
    low = [max(Fraction(0), 1 - Fraction(found) / true) / U for found, true in zip((axis, square, first), exact)]
    require(low[0] <= 1 and low[1] <= 1 and low[2] <= 12, f"ellipse {rho}: {[float(x) for x in low]}")
    # Another exponent than that of the least degree is seen.
    require(abs(Fraction(first) * r / exact[2] - 1) > Fraction(1, 2), "the exponent")
    axes_low[rho] = low
proven("ellipses: A, 1/rho^2 and 2 rho^-12 / (rho - 1) are too small by at most " + ", ".join(
    f"{float(max(low[i] for low in axes_low.values())):.1f}" for i in range(3)) + " roundings of 2^-24")

# --- `off_line`. On an ellipse |s| <= A, x is X + W with |X| <= Y1 and |W| <= Y - Y1, and (X + W)^k - X^k has no negative term.


def transcribed(c, y1, w, mul, add):
    power, more, total = y1, w, None
    for k in range(DEGREE - 2, -1, -1):
        more = add(mul(add(y1, w), more), mul(w, power))
        power = mul(power, y1)
        term = mul(c[k], more)
        total = term if total is None else add(total, term)
    return total


def poly_mul(p, q):
    out = {}
    for a, x in p.items():
        for b, y in q.items():
            key = tuple(i + j for i, j in zip(a, b))
            out[key] = out.get(key, 0) + x * y
    return out


def poly_add(p, q):
    out = dict(p)
    for b, y in q.items():
        out[b] = out.get(b, 0) + y
    return out


names = 2 + DEGREE


def unit(i):
    return {tuple(int(j == i) for j in range(names)): 1}


symbols = [unit(2 + k) for k in range(DEGREE)]  # c[k] is the coefficient of x^(DEGREE - k)
found = transcribed(symbols, unit(0), unit(1), poly_mul, poly_add)
expected = {}
for k in range(DEGREE - 1):
    for j in range(1, DEGREE - k + 1):
        # (Y1 + W)^n - Y1^n
        expected = poly_add(expected, {tuple([DEGREE - k - j, j] + [int(i == k) for i in range(DEGREE)]): comb(DEGREE - k, j)})
require(found == expected, "off_line")
require(all(number > 0 for number in expected.values()), "no negative term")
random.seed(3)
for _ in range(200):
    c = [Fraction(random.randint(0, 2**31)) for _ in range(DEGREE)]
    y1, w = Fraction(random.randint(0, 2**20), 2**19), Fraction(random.randint(0, 2**20), 2**21)
    exact = sum(c[k] * ((y1 + w) ** (DEGREE - k) - y1 ** (DEGREE - k)) for k in range(DEGREE - 1))
    require(transcribed(c, y1, w, lambda a, b: a * b, lambda a, b: a + b) == exact, "off_line, by numbers")
    without_x2 = sum(c[k] * ((y1 + w) ** (DEGREE - k) - y1 ** (DEGREE - k)) for k in range(DEGREE - 2))
    require(w == 0 or c[DEGREE - 2] == 0 or y1 + w == 0 or without_x2 < exact, "each power counts")
proven("off_line is the sum of |c_k| (Y^k - Y1^k) from k = 2 on, as an identity, and so bounds Q(x) - Q(x0 + x1 s) but for c_1 x")

# --- SLACK: by how many roundings a tail's bound may be too small. All terms are positive, so the longest way counts.
for rho, low in axes_low.items():
    axis, square, first = (Fraction(x) for x in low)
    x = 1  # a coefficient of x, in single precision
    linear = x + axis + 2  # x1 A, and the sum
    # Horner's rule over x2 .. x6, two roundings for each but the last, and A^2.
    curve = max(x + 2 * (k - 2) + axis * (k - 2) + 1 for k in range(2, offset + 1)) + 2 * (axis + 1)
    both = max(linear, curve) + 1
    power, more = linear, curve
    for _ in range(DEGREE - 1):
        more = max(both + more + 1, curve + power + 1) + 1
        power = power + linear + 1
    off_line = 1 + more + 1 + (DEGREE - 2)  # c_k itself, the product, and the sums
    weighed = 1 + 2 * weight + axis * weight
    tail = off_line + weighed + first + 3 + (DEGREES - 1) * (1 + square)
    # The share, the quotient and two sums.
    count = tail + 4
    axes_low[rho] = count
count = max(axes_low.values())
allowed = (SLACK - 1) / U
most = int(count + spoilt) + 1
require(stated - 1 < count <= stated, f"as many roundings as the comment says: {float(count)}")
require((1 - U) ** most * SLACK >= 1, f"{most} roundings")
require((1 - U) ** most * (1 + (SLACK - 1) / 2) < 1, "half of the slack would not do")
proven(f"SLACK, {float(allowed):g} roundings, is more than the {float(count):.1f} that make a tail's bound too small at most, and the {float(spoilt):.1f} of the samples' places")

# --- WEIGHT_OFF: what rounds the value of a weight, as a share of what `Limits::share` multiplies it with.
code("const fn single(&[c0, c1, c2, c3]: &[f32; 4], x: f32) -> f32 {", "c0 + x * (c1 + x * (c2 + x * c3)) }")
code("let error = error * single(&weights[kind], place as f32 / PLACE).abs();", "")
code("let per_size = [", """single_step / self.size_of_time(ends[0]) / FORWARD_ERROR,
    single_step / self.size_of_time(ends[1]) / FORWARD_ERROR, ];""")
code("let [f0, f1, f2, f3, ..] = singles(&along.openness, 0.0, per_exposure);", "")
code("let slope = 0.5 * (per_size[1] - per_size[0]) / (t1 + t3);", """
    let mean = 0.5 * (per_size[0] + per_size[1]);
    let per_size_along = [mean - slope * t2, slope * t1, slope * t2, slope * t3];""")
code("let weights = [[1.0, 0.0, 0.0, 0.0], openness, per_size_along];", "")
code("let error = time + self.rounding;", "let rounding = self.rounding + error * WEIGHT_OFF;")
code("forward: relative + rounding * self.per_size,", """
    backward: exposure + rounding * absolute(&self.openness, 1.0) + error * way * steepest, beyond: error * self.beyond, }""")
weight_off = 1 / Fraction(2 ** int(source(r"const WEIGHT_OFF: f32 = 1\.0 / \(1 << (\d+)\) as f32;"))) / U
# Makes up for roundings of roundings, and for those of doubles.
MORE = Fraction(1001, 1000)
# What rounds samples grows with the share by which a bound is divided; but so does the error, by the greatest of the shares at least.
grows = max(
    Fraction(COSINES[HALF_DEGREE * step], COSINES[half * step])
    for step in STEPS for half in range(HALF_DEGREE, HALF_DEGREE + DEGREES) if half * step < len(COSINES) - 1)
# By Horner's rule, for each coefficient: its products, its sums, and the place, rounded to an f32, in each product.
HORNER = [2 * k + min(k + 1, weight) for k in range(WEIGHT)]
openness_off = (grows * max(HORNER) + 1) * MORE
require(openness_off <= weight_off, f"openness: {float(openness_off)} roundings")
require(HORNER == [1, 4, 7, 9], "roundings of Horner's rule")


# The chord's coefficients without signs, where the time t1 s + t2 s^2 + t3 s^3 rises: seen at 17 places, and but for what rounds it.
t1, t2, t3 = z3.Reals("t1 t2 t3")


def without_sign(x):
    return z3.If(x < 0, -x, x)


def in_chord(claim, places=8):
    """Does it hold of all times that rise from -1 to 1? Half of what they take is their unit."""
    solver = z3.Solver()
    solver.add(t1 + t3 == 1, z3.Not(claim))
    for i in range(-places, places + 1):
        at = z3.Q(i, places)
        solver.add(t1 + 2 * t2 * at + 3 * t3 * at * at >= z3.Q(-1, 1024))
    return solver.check() == z3.unsat


def chord_off(lesser):
    """Roundings of the chord between 1 and a lesser reciprocal, in those of the greater one."""
    mean, slope = z3.Q(1 + lesser, 2), z3.Q(1 - lesser, 2)
    c = [mean + slope * without_sign(t2)] + [slope * without_sign(t) for t in (t1, t2, t3)]
    samples = z3.Sum([n * one for n, one in zip(HORNER, c)])
    # Its own: of a reciprocal 3, by the time's size and two quotients; of the mean and of c0 one each; of what is a slope times a time
    # 5, and ENDS for the sum of two times that the slope is divided by.
    own = 3 + mean + c[0] + (5 + ENDS) * slope * (without_sign(t1) + 2 * without_sign(t2) + without_sign(t3))
    return (samples * z3.Q(grows.numerator, grows.denominator) + own) * z3.Q(MORE.numerator, MORE.denominator)


ENDS = z3.Q(201, 100)
require(in_chord(without_sign(t1) + without_sign(t3) <= ENDS) and not in_chord(without_sign(t1) + without_sign(t3) <= z3.Q(199, 100)), "t1 and t3, beside their sum")
# It is linear in the lesser reciprocal, which is from 0 to 1 of the greater: both ends are enough.
most = z3.Q(weight_off.numerator, weight_off.denominator)
require(all(in_chord(chord_off(lesser) <= most) for lesser in (0, 1)), "what rounds the chord")
# What would not do: half as much, and a time of which nothing is seen but both ends and the middle.
require(not in_chord(chord_off(0) <= most / 2) and not in_chord(chord_off(0) <= most, places=1), "the chord, by less")
chord_most = next(n for n in range(int(weight_off) + 1) if in_chord(chord_off(0) <= n))
proven(f"what rounds a weight is at most {float(openness_off):.1f} roundings of 2^-24 of the openness's coefficients without signs, and {chord_most} of the greater reciprocal: within WEIGHT_OFF, {float(weight_off):g}")

# --- What a fraction may be off by: `JOIN_OFF` and `FRACTION_OFF` of itself.
join_off, fraction_off = (1 / Fraction(2 ** int(source(rf"const {name}_OFF: f32 = 1\.0 / \(1u64 << (\d+)\) as f32;"))) for name in ("JOIN", "FRACTION"))
roundings, time_roundings = (int(said) for said in documented(r"(\d+) roundings of a double in a fraction and (\d+) in a time"))
terms = int(documented(r"without their signs are at most (\d+) times the mass"))
on_path = terms * roundings * LAST_PLACE
require(on_path <= fraction_off and on_path > fraction_off / 4, "FRACTION_OFF")
proven(f"{roundings} roundings of an f64 in terms {terms} times as great are 2^{log2(on_path):.2f}, at most FRACTION_OFF = 2^{log2(fraction_off):g}")

time_off = 1 / Fraction(2 ** int(source(r"const TIME_OFF: f32 = 1\.0 / \(1u64 << (\d+)\) as f32;")))
terms, roundings = int(documented(r"the terms of a time are at most (\d+) times the time")), time_roundings
require(time_off / 2 < terms * roundings * LAST_PLACE <= time_off, "TIME_OFF")
proven(f"{roundings} roundings of an f64, as many as were counted, in terms {terms} times as great are at most TIME_OFF = 2^{log2(time_off):g}")

# What an exposure is held against, ULP_ERROR ulp less `off`, is above 0, also at the least octave: it begins at half of LEAST_TOP.
least = Fraction(1, 2 ** (int(source(r"const LEAST_TOP: u32 = \(1\.0 / \(1 << (\d+)\) as f32\)\.to_bits\(\);")) + 1))
ulp_error = Fraction(source(r"const ULP_ERROR: f32 = ([\d.]+);"))
for begin in (least * 2**i for i in range(30)):
    require(ulp_error * begin / 2**23 > Fraction(3, 2) * (join_off + fraction_off * 2 * begin), "ULP_ERROR less off")
proven("ULP_ERROR ulp of where a span begins are more than 1.5 times what a fraction may be off by, for each octave")

# Joins. Each is told by the lesser part: by the near share and the plateau, as pairs, which are within 2^-49 of themselves
# (pairs.py), and their sum; or by 1 less a share of at most 1/2, which is rounded by half of 2^-53 at most.
code("const fn is_next_to_half(a: f64) -> bool {", "floor_bits(a) == 0.5f32.to_bits() - 1 }")
code("!self.has_plateau() && is_next_to_half(self.ramps[0].share.to_f64() / WHOLE as f64)", "")
code("let near = self.ramp(side).share.to_f64() / WHOLE as f64;", """let plateau = self.plateau.to_f64() / WHOLE as f64;
    let far = self.ramp(side.other()).share.to_f64() / WHOLE as f64;
    if !self.has_plateau() && is_next_to_half(near) { return [0.5; 2]; }
    [ if near < 0.5 { near } else { 1.0 - (plateau + far) }, if near + plateau < 0.5 { near + plateau } else { 1.0 - far }, ] }""")
PAIR = Fraction(1, 2**49)


def joins_hold(join_off, fraction_off, least_part=True):
    """Is a join within both? A part has its pair's rounding, and three of a double; so has the sum."""
    part = PAIR + 6 * LAST_PLACE
    if not least_part:
        # By 1 less a share of nearly all, wherever the join is.
        return part <= join_off
    half = Fraction(1, 2)
    return part <= fraction_off and part * half + LAST_PLACE / 2 <= join_off + fraction_off * half


require(joins_hold(join_off, fraction_off) and not joins_hold(join_off, PAIR) and not joins_hold(join_off, fraction_off, least_part=False), "joins")
require(LAST_PLACE / 2 <= join_off and LAST_PLACE > join_off, "JOIN_OFF")
proven(f"what rounds joins, given the ramps' masses, is within JOIN_OFF and FRACTION_OFF of itself wherever they are, as each is told by the lesser part; by 1 less a share of nearly all it would not be. 1 less a share is rounded by at most 2^{log2(LAST_PLACE / 2):g} = JOIN_OFF")

# --- `Limits::shares`: how far a stretch goes in which so much time passes.
code("let [_, t1, t2, t3] = self.time;", """let (thrice, most) = (3.0 * t3, t1.abs() + 2.0 * t2.abs() + 3.0 * t3.abs());
    let slowest = if thrice > t2.abs() { t1 - t2 * t2 / thrice } else { t1 + thrice - 2.0 * t2.abs() };
    let slowest = slowest - most / (1 << 20) as f32; let mut way = error / most;
    while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error { way *= 2.0; }""")
t1, t2, t3, s, a, d = z3.Reals("t1 t2 t3 s a d")


def holds(claim, *but_not):
    for formula, expected in [(claim, z3.unsat)] + [(more, z3.sat) for more in but_not]:
        solver = z3.Solver()
        solver.set("timeout", 30000)
        solver.add(z3.Not(formula))
        require(solver.check() == expected, f"{formula}")


slope = t1 + 2 * t2 * s + 3 * t3 * s * s
inside = z3.And(s >= -1, s <= 1)
size = z3.If(t2 < 0, -t2, t2)
# Written without a quotient: thrice (t1 - t2^2 / thrice) = thrice t1 - t2^2.
holds(z3.Implies(z3.And(inside, 3 * t3 > size), 3 * t3 * slope >= 3 * t3 * t1 - t2 * t2),
      z3.Implies(z3.And(inside, 3 * t3 > size), 3 * t3 * slope >= 3 * t3 * t1 - t2 * t2 * z3.RealVal("99/100")))
at_end = t1 + 3 * t3 - 2 * size
holds(z3.Implies(z3.And(inside, 3 * t3 <= size), slope >= at_end),
      z3.Implies(z3.And(inside, 3 * t3 <= size), slope >= at_end + size / 100),
      z3.Implies(z3.And(inside, 2 * t3 <= size), slope >= at_end))
proven("slowest is at most the least t' on [-1, 1], by the vertex where that may be inside and else by an end")
# From a to a + d the time is d t'(m) + t3 d^3 / 4 about the middle m, and t'(m) is not negative.
m = a + d / 2
passed = t1 * d + t2 * ((a + d) * (a + d) - a * a) + t3 * ((a + d) * (a + d) * (a + d) - a * a * a)
middle = t1 + 2 * t2 * m + 3 * t3 * m * m
require(z3.simplify(passed - (d * middle + t3 * d * d * d / 4), som=True).eq(z3.RealVal(0)), "the time about the middle")
for quarter, expected in ((4, z3.unsat), (Fraction(399, 100), z3.sat)):
    solver = z3.Solver()
    solver.add(d > 0, d <= 2, middle >= 0, a >= -1, a + d <= 1, z3.RealVal(str(quarter)) * (d * middle + t3 * d * d * d / 4) < t3 * d * d * d)
    require(solver.check() == expected, "a quarter of t3 d^3")
proven("a stretch of length d takes at least d times the least t', and at least t3 d^3 / 4: t' is not negative in its middle")
# So where the loop ends, any stretch of that length takes at least `error`; what rounds `slowest` is less than 2^-20 of its terms.
require(8 * U * Fraction(1001, 1000) < Fraction(1, 2**20) < 32 * U, "slowest's rounding")
proven("slowest: its 8 roundings of 2^-24, each of at most all terms, are below the 2^-20 that are taken from it")

# --- The inner end of a ramp: is it part of the stretch, and what may be open beyond it?
code("pub(crate) const fn place(&self, u: f64, up: bool) -> f64 {", """let single = singles(&self.fraction, u, 1.0);
    let (p, slope) = root(&single, [0.0, 1.0], 0.5); let (mut p, slope) = (p as f64, slope as f64);
    p += (u - value(&self.fraction, p)) / slope; let mut step = if up { p * OUTWARDS } else { -p * OUTWARDS };
    loop { p += step; if !(p > 0.0 && p < 1.0) { return if up { 1.0 } else { 0.0 }; } let missing = u - value(&self.fraction, p);
    if if up { missing <= 0.0 } else { missing >= 0.0 } { return p; } step *= 2.0; } }""")
code("let ends = [(span.middle - span.half) as f64, (span.middle + span.half) as f64];", "let places = [path.place(ends[0], false), path.place(ends[1], true)];")
code("let is_joined = if self.ramp.is(self.side)", "{ last >= 1.0 } else { first <= 0.0 };")
# Places count from the end that faces the side: of the near ramp the inner end is 1, which the last place may be, of the far ramp 0.
place, fraction, u = z3.Reals("place fraction u")
inside = z3.And(place > 0, place < 1)
last, first = z3.Or(place == 1, z3.And(inside, fraction >= u)), z3.Or(place == 0, z3.And(inside, fraction <= u))
holds(z3.Implies(z3.And(last, z3.Not(place >= 1)), fraction >= u), z3.Implies(z3.And(last, z3.Not(place > 1)), fraction >= u))
holds(z3.Implies(z3.And(first, z3.Not(place <= 0)), fraction <= u), z3.Implies(z3.And(first, z3.Not(place < 0)), fraction <= u))
# Where it is not, a way has to collect what the stretch has more than the part: in ulp, EPSILON of the power of two, of which the ends,
# the middle and its sum with the half lose a half each by rounding, the half next to nothing, and `off` as much as is below.
power = least * 2
more = int(source(r"let half = .* \+ (\d)\.0 \* f32::EPSILON \* power;")) - Fraction(3, 2) - 4 * U - (join_off / power + 2 * fraction_off) * 2**23
require(more > 4 * ulp_error, f"{float(more)} ulp")
proven(f"is_joined wherever a way may leave the ramp by its inner end: else it would collect {float(more):.2f} ulp until the stretch ends, and {float(ulp_error)} are allowed")

code("let ([f0, f1, f2, f3], [d0, d1, d2]) = (other.f, other.differences());", """
    let (mut p, mut doublings) = (1.0 / (1 << 30) as f32, 30);
    while doublings > 0 && p * (3.0 * d0 + p * (3.0 * (d1 - d0) + p * (d0 - 2.0 * d1 + d2))) < time { p *= 2.0; doublings -= 1; }
    let differences = (f1 - f0).abs() + (f3 - f2).abs() + (f2 - f1).abs(); f0 as f64 + 3.0 * p as f64 * differences as f64 }""")
code("let most = FORWARD_ERROR * (exposure.end(End) - exposure.end(Start));", "(self.greatest_beyond(most) * per_exposure) as f32 } else { 0.0 },")
# What a cubic gains until q, time or openness, as a sum of the differences of its control values, each times a weight.
f0, f1, f2, f3, q = z3.Reals("f0 f1 f2 f3 q")
weights = [1 - (1 - q) * (1 - q) * (1 - q), 3 * q * q - 2 * q * q * q, q * q * q]
gained = 3 * q * (1 - q) * (1 - q) * f1 + 3 * q * q * (1 - q) * f2 + q * q * q * f3 + (1 - q) * (1 - q) * (1 - q) * f0 - f0
by_differences = sum(w * d for w, d in zip(weights, (f1 - f0, f2 - f1, f3 - f2)))
time = q * (3 * f1 + q * (3 * (f2 - f1) + q * (f1 - 2 * f2 + f3)))
by_times = sum(w * d for w, d in zip(weights, (f1, f2, f3)))
require(all(z3.simplify(x - y, som=True).eq(z3.RealVal(0)) for x, y in ((gained, by_differences), (time, by_times))), "a cubic by differences")
limits = lambda most: z3.Implies(z3.And(q > 0, q <= 1), z3.And(*(z3.And(w >= 0, w <= most * q) for w in weights)))
holds(limits(3), limits(z3.Q(299, 100)))
proven("greatest_beyond: up to the place p, where the time has passed, the openness gains at most 3 p of the differences' sizes: each has a weight from 0 to 3 p")
# The time at p as computed, for a t' that is a square (x - s)^2 or x (1 - x), of which all are sums. Its powers of p are exact.
d0, d1, d2 = (majorant.Number({(j, 0, 0): Fraction(1)}, {(j, 0, 0): U}) for j in range(3))
cubes = (d0 + d1.times(k=2)) + d2
squares = (d1 + d0).times(k=3)
found = d0.times(k=3).times(x=1) + (squares.times(x=2) + cubes.times(x=3))
s = z3.Real("s")
rational = lambda x: z3.Q(x.numerator, x.denominator)
certain = 1 / Fraction(2 ** int(source(r"const CERTAIN: f32 = 1\.0 - 1\.0 / \(1 << (\d+)\) as f32;")))


def errs_by(most):
    """Is the time as computed within a share `most` of the time?"""
    for sizes, d in (((s * s, s * (1 - s), (1 - s) * (1 - s)), (s * s, -s * (1 - s), (1 - s) * (1 - s))), ((0, 1, 0), (0, 1, 0))):
        error = z3.Sum([rational(number) * sizes[j] * q ** (a - 1) for (j, a, _), number in found.error.items()])
        per_place = [3 - 3 * q + q * q, 3 * q - 2 * q * q, q * q]
        solver = z3.Solver()
        solver.add(q > 0, q <= 1, s >= 0, s <= 1, error > rational(most) * z3.Sum([w * one for w, one in zip(per_place, d)]))
        if solver.check() != z3.unsat:
            return False
    return True


require(errs_by(certain * Fraction(31, 32)) and not errs_by(certain / 4), "the time beyond a join")
proven(f"greatest_beyond: its time is rounded by less than 2^{log2(certain):g} of it, and an error in time is certain only if it is less than it may be by as much")
