//! Power series from one end of a ramp, evaluated and solved in integers.
//!
//! Measured from an end of the ramp, the time passed, the openness gained and the mass collected are
//! all polynomials without a constant term: `S(p) = c₁ p + c₂ p² + ...`, `p` in [0, 1].
//!
//! **Why integers keep relative accuracy.** For `p` near `2^-shift` the coefficients are taken as
//! `c_k 2^(-k shift)` in units of a common power of two, so that the greatest fills 60 bits. A
//! non-negative polynomial's increasing integral bounds its own terms (Markov): `|c_k p^k|` exceeds
//! `S(p)` by a factor that depends on the degree alone, below 2¹³ for degree 6. So `S` keeps some 40
//! bits of its own, however small it is, and neighbouring `f32` targets, 2⁻²⁴ apart, stay apart.
//!
//! **Why two widths.** The upper 32 bits of all that keep 15 or more of `S`, at a third of the cycles:
//! the search runs on them until they have no more to say, and the 64 bits finish it.

use crate::wide::Wide;

/// A coefficient: in the upper 54 bits the significand of a `f64`, with its sign, and in the lower 10
/// the exponent, so that one shift aligns it. What these bits add to its value is rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coefficient(i64);

/// `c[0] p + c[1] p² + ...`
pub(crate) type Series<const N: usize> = [Coefficient; N];

impl Coefficient {
    const EXPONENT: i32 = 1023;
    /// `2^(exponent - BIAS)` is the unit of the 64 bits; the exponents of curves in range lie within.
    const BIAS: i32 = 512 + 62;

    pub(crate) const fn new(c: f64) -> Self {
        let bits = c.to_bits();
        let exponent = ((bits >> 52) as i32 & 0x7FF) - (1023 - 512);
        if exponent <= 0 || exponent > Self::EXPONENT {
            return Self(0);
        }
        let m = ((bits << 11 | 1 << 63) >> 1) as i64;
        Self(if c < 0.0 { -m } else { m } | exponent as i64)
    }

    const fn exponent(self) -> i32 {
        self.0 as i32 & Self::EXPONENT
    }

    pub(crate) const fn is_zero(self) -> bool {
        self.0 == 0
    }

    /// The base-2 logarithm, linear between powers of two, in units of 2⁻²⁰; of a positive coefficient.
    pub(crate) const fn rough_log(self) -> i32 {
        ((self.0 >> 42) as i32) + ((self.exponent() - (Self::BIAS - 62) - 1) << 20)
    }

    pub(crate) const fn is_positive(self) -> bool {
        self.0 > 0
    }

    /// In units of 2^(top + GUARD).
    #[inline(always)]
    const fn aligned(self, down: i32) -> i64 {
        self.0 >> (if down < 63 { down } else { 63 } & 63)
    }

    #[inline(always)]
    const fn rough(self, down: i32) -> i32 {
        ((self.0 >> 32) as i32) >> (if down < 31 { down } else { 31 } & 31)
    }
}

/// A place on a ramp, and how many evaluations it took to find it.
#[derive(Clone, Copy)]
pub(crate) struct Root {
    /// `p 2^shift` in units of 2⁻³², at most 1/2.
    x: i32,
    shift: i32,
    /// The rest of `p`, less than a unit of `x`.
    rest: f32,
    pub(crate) evaluations: u32,
}

/// Where a search starts: `p = x 2^-(32 + shift)`.
#[derive(Clone, Copy)]
pub(crate) struct Seed {
    pub(crate) x: i32,
    pub(crate) shift: i32,
}

/// The greatest `x`, just below 1/2; with the least shift, -1, it stands for `p = 1`.
const TOP: i32 = i32::MAX;
const LEAST_SHIFT: i32 = -1;

/// Newton steps before the bracket has to keep up with what bisection would make of it.
const NEWTON: u32 = 10;
/// Bisections that bring any bracket of 31-bit numbers down to neighbours.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes.
pub const MAX_EVALUATIONS: u32 = NEWTON + BISECTION;

/// Bits of room above the greatest coefficient: the sums of Horner's rule, and those of the
/// derivatives, exceed it.
const GUARD: i32 = 3;
/// What rounding leaves uncertain of the upper 32 bits.
const NOISE: u32 = 8;
/// After a step by less than 2⁻⁸ of `x` the upper 32 bits have little more to say ...
const CLOSE: u32 = 8;
/// ... and a step by less than 2⁻¹⁴ is the last, for it leaves less than 2⁻³⁰.
const LAST: u32 = 16;
const STRAIGHT: u32 = 12;

/// `a x`, where `x` counts 2⁻³².
#[inline(always)]
const fn times(a: i64, x: i32) -> i64 {
    let high = (a >> 32) as i32 as i64 * x as i64;
    let low = ((a as u32 as u64) * (x as u32 as u64)) >> 32;
    high.wrapping_add(low as i64)
}

/// The same in 32 bits.
#[inline(always)]
pub(crate) const fn times_high(a: i32, x: i32) -> i32 {
    ((a as i64 * x as i64) >> 32) as i32
}

/// The exponent of the greatest `c_k 2^(-k shift)`.
#[inline(always)]
const fn top(series: &[Coefficient], shift: i32) -> i32 {
    // Below any.
    let mut top = -100_000;
    let (mut k, mut by) = (0, 0);
    while k < series.len() {
        by += shift;
        let e = series[k].exponent() - by;
        if e > top && !series[k].is_zero() {
            top = e;
        }
        k += 1;
    }
    top
}

/// `S` at `x` by Horner's rule, in units of `2^(top + GUARD - BIAS)`, and `S'`, in units of 2³² of these.
#[inline(always)]
const fn value<const N: usize>(series: &Series<N>, x: i32, shift: i32, top: i32) -> (i64, i32) {
    let (mut value, mut slope) = (0i64, 0i32);
    let mut k = N;
    let mut down = top + GUARD + N as i32 * shift;
    while k > 0 {
        k -= 1;
        slope = times_high(slope, x).wrapping_add((value >> 32) as i32);
        value = times(value, x).wrapping_add(series[k].aligned(down - series[k].exponent()));
        down -= shift;
    }
    slope = times_high(slope, x).wrapping_add((value >> 32) as i32);
    (times(value, x), slope)
}

/// The upper 32 bits of a series near `2^-shift`.
struct Rough<const N: usize>([i32; N]);

/// A value with the derivatives the search uses: `S'`, `S''/2` and `S'''/6`.
struct Local {
    value: i32,
    slope: i32,
    bend: i32,
    twist: i32,
}

impl<const N: usize> Rough<N> {
    #[inline(always)]
    const fn new(series: &Series<N>, shift: i32, top: i32) -> Self {
        let mut c = [0; N];
        let mut down = top + GUARD;
        let mut k = 0;
        while k < N {
            down += shift;
            c[k] = series[k].rough(down - series[k].exponent());
            k += 1;
        }
        Self(c)
    }

    /// Horner's rule.
    #[inline(always)]
    const fn at(&self, x: i32) -> Local {
        let mut value = self.0[N - 1];
        let (mut slope, mut bend, mut twist) = (0i32, 0i32, 0i32);
        let mut k = N - 1;
        while k > 0 {
            k -= 1;
            twist = times_high(twist, x).wrapping_add(bend);
            bend = times_high(bend, x).wrapping_add(slope);
            slope = times_high(slope, x).wrapping_add(value);
            value = times_high(value, x).wrapping_add(self.0[k]);
        }
        twist = times_high(twist, x).wrapping_add(bend);
        bend = times_high(bend, x).wrapping_add(slope);
        slope = times_high(slope, x).wrapping_add(value);
        value = times_high(value, x);
        Local { value, slope, bend, twist }
    }
}

/// 2³², the unit of `x`.
const WORD: f32 = 4294967296.0;

impl Local {
    /// The step of `x` that makes up for `missing`, in the unit of the value, and whether it lands within 2⁻²⁸.
    ///
    /// Near a flat place, where the density touches 0 and `S` is as `c (x - q)³ + d`, `3 S' S'''/6` is
    /// `(S''/2)²`, Newton's method is slow, and a cube root right. Elsewhere it is Halley's step,
    /// `r / (S' + S''/2 · r/S')`, with one division and at most twice Newton's.
    #[inline(always)]
    const fn step(&self, missing: f32) -> (f32, bool) {
        let (slope, bend) = (self.slope as f32, self.bend as f32);
        let newton = slope * slope;
        let curve = bend * missing;
        let straight = curve.abs() < newton * (1.0 / (1 << STRAIGHT) as f32);
        if curve.abs() > 0.2 * newton {
            let (cubic, square) = (3.0 * slope * self.twist as f32, bend * bend);
            if cubic > 0.8 * square && cubic < 1.25 * square {
                return (self.flat_step(missing), false);
            }
        }
        let halley = newton + curve;
        (missing * WORD * slope / if halley > 0.5 * newton { halley } else { 0.5 * newton }, straight)
    }

    /// `q` is where `S''` is 0, and a cube root does the rest.
    #[inline(always)]
    const fn flat_step(&self, missing: f32) -> f32 {
        let (b, c) = (self.bend as f32, self.twist as f32);
        let from_flat = b / (3.0 * c);
        (cube_root(missing / c + from_flat * from_flat * from_flat) - from_flat) * WORD
    }
}

/// The cube root to 0.2 %: a third of the exponent and a step of Newton's method.
#[inline(never)]
const fn cube_root(x: f32) -> f32 {
    let size = x.abs();
    let y = f32::from_bits(size.to_bits() / 3 + 0x2A51_4067);
    let y = y - (y - size / (y * y)) / 3.0;
    if x < 0.0 { -y } else { y }
}

/// The `p` in [0, 1] with `S(p) = target`, for an `S` that increases from 0 to at least `target`:
/// Newton's method with Halley's correction inside a bracket, and bisection where a step leaves it or where,
/// after [`NEWTON`] steps, the bracket is wider than bisection alone would have left it.
///
/// It stops where a step is next to nothing, or in a flat
/// place where the residual is below `2^-enough` of the target, or with the bracket down to neighbours.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: &Series<N>,
    target: Wide,
    seed: Seed,
    enough: u32,
) -> Root {
    let Seed { mut x, mut shift } = seed;
    let (mut low, mut high) = (0, TOP);
    let mut evaluations = 0;
    let mut exact = false;
    let mut exponent = top(series, shift);
    let mut rough = Rough::new(series, shift, exponent);
    let mut goal = target.in_units(exponent + GUARD - Coefficient::BIAS);
    loop {
        let local = rough.at(x);
        evaluations += 1;
        let mut missing = (goal >> 32) as i32 - local.value;
        exact |= missing.unsigned_abs() <= NOISE;
        let mut rest = missing as f32;
        let mut last = high - low <= 1 || evaluations == MAX_EVALUATIONS;
        if exact {
            let all = goal - value(series, x, shift, exponent).0;
            missing = (all >> 32) as i32;
            rest = missing as f32 + all as u32 as f32 * (1.0 / WORD);
            last |= all.unsigned_abs() <= (goal as u64) >> enough;
        }
        let (step, straight) = local.step(rest);
        let size = step.abs();
        // With a slope whose noise does not count.
        let fine = (goal >> 31) as i32;
        let fine = if fine < x >> LAST { fine } else { x >> LAST };
        let small = exact && straight && size < fine as f32;
        if small || last {
            let step = if small { step } else { 0.0 };
            let whole = step as i32;
            return Root { x: x + whole, shift, rest: step - whole as f32, evaluations };
        }
        exact |= size < (x >> CLOSE) as f32;
        if missing >= 0 {
            low = x;
        } else {
            high = x;
        }
        // A cast saturates; a NaN gives 0 and so stays where it is, on the bracket's edge.
        let mut next = x.saturating_add(step as i32);
        if low == x && high == TOP && shift > LEAST_SHIFT && (x > TOP / 2 || next == TOP) {
            // The target may be more than this scale holds: two octaves up.
            let up = if shift - 2 < LEAST_SHIFT { shift - LEAST_SHIFT } else { 2 };
            shift -= up;
            exponent = top(series, shift);
            rough = Rough::new(series, shift, exponent);
            goal = target.in_units(exponent + GUARD - Coefficient::BIAS);
            low >>= up;
            next >>= up;
        }
        // The bracket must shrink, on average, as bisection would shrink it.
        let late = evaluations >= NEWTON && high - low > TOP >> (evaluations + 1 - NEWTON);
        if late || next <= low || next >= high {
            next = low + (high - low) / 2;
        }
        x = next;
    }
}

impl Root {
    /// `p = 0`.
    pub(crate) const START: Self = Self { x: 0, shift: 0, rest: 0.0, evaluations: 0 };

    /// The series' value here: its magnitude, and whether it is negative.
    pub(crate) const fn value<const N: usize>(&self, series: &Series<N>) -> (Wide, bool) {
        let top = top(series, self.shift);
        let (value, slope) = value(series, self.x, self.shift, top);
        let value = value + (slope as f32 * self.rest) as i32 as i64;
        (Wide::new(value.unsigned_abs(), top + GUARD - Coefficient::BIAS), value < 0)
    }
}
