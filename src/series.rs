//! Power series from one end of a ramp, evaluated and solved in 64-bit integers.
//!
//! Measured from an end of the ramp, the time passed, the openness gained and the mass collected are
//! all polynomials without a constant term: `S(p) = c₁ p + c₂ p² + ...`, `p` in [0, 1].
//!
//! **Why integers keep relative accuracy.** For `p` near `2^-shift` the coefficients are taken as
//! `c_k 2^(-k shift)` in units of a common power of two, so that the greatest fills 60 bits. A
//! non-negative polynomial's increasing integral bounds its own terms (Markov): `|c_k p^k|` exceeds
//! `S(p)` by a factor that depends on the degree alone, below 2¹³ for degree 6. So `S` keeps some 40
//! bits of its own, however small it is, and neighbouring `f32` targets, 2⁻²⁴ apart, stay apart.

use crate::wide::Wide;

/// `c[0] p + c[1] p² + ...`
pub(crate) type Series<const N: usize> = [f64; N];

/// A place on a ramp, and how many evaluations it took to find it.
#[derive(Clone, Copy)]
pub(crate) struct Root {
    /// `p 2^shift` in units of 2⁻³², at most 1/2.
    x: i32,
    shift: i32,
    /// The rest of `p`, in the units of `x`: what a last Newton step would add.
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

/// A step longer than this share of `x`, 2⁻¹⁸, is one in a flat place.
const FLAT: u32 = 18;

/// A series made ready for evaluation near `2^-shift`.
struct Scaled<const N: usize> {
    /// `c_k 2^(-k shift)` in units of `2^unit`, below 2⁶⁰.
    c: [i64; N],
    unit: i32,
}

/// A value with the derivatives the search uses.
struct Local {
    value: i64,
    /// `S'` in units of 2³²: how much one step of `x` adds to the value.
    slope: i32,
    /// `S''/2` in units of 2³².
    bend: i32,
    /// `S'''/6` in units of 2³².
    twist: i32,
}

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

/// The 53 bits of a `f64`, moved up to fill 60 and down again by `down`, with its sign; out of line, for
/// the loop that calls it gets unrolled.
#[inline(never)]
const fn significand(bits: u64, down: u32) -> i64 {
    let m = (((bits << 11 | 1 << 63) >> 4) >> (down & 63)) as i64;
    if (bits as i64) < 0 { -m } else { m }
}

impl<const N: usize> Scaled<N> {
    #[inline(never)]
    const fn new(c: &Series<N>, shift: i32) -> Self {
        const EXPONENT: i32 = 0x7FF;
        // Below any exponent that a coefficient of a curve in range has.
        let mut unit = -10_000;
        let mut k = 0;
        while k < N {
            let exponent = (c[k].to_bits() >> 52) as i32 & EXPONENT;
            let e = exponent - (k as i32 + 1) * shift;
            if exponent != 0 && e > unit {
                unit = e;
            }
            k += 1;
        }
        let mut scaled = [0; N];
        k = 0;
        while k < N {
            let bits = c[k].to_bits();
            let exponent = (bits >> 52) as i32 & EXPONENT;
            let down = (unit - exponent + (k as i32 + 1) * shift) as u32;
            if exponent != 0 && down < 60 {
                scaled[k] = significand(bits, down);
            }
            k += 1;
        }
        Self { c: scaled, unit: unit - (1075 + 7) }
    }

    /// Horner's rule, and with it, in 32 bits, the derivatives.
    #[inline(always)]
    const fn at(&self, x: i32) -> Local {
        let mut value = self.c[N - 1];
        let (mut slope, mut bend, mut twist) = (0i32, 0i32, 0i32);
        let mut k = N - 1;
        while k > 0 {
            k -= 1;
            twist = times_high(twist, x).wrapping_add(bend);
            bend = times_high(bend, x).wrapping_add(slope);
            slope = times_high(slope, x).wrapping_add((value >> 32) as i32);
            value = times(value, x).wrapping_add(self.c[k]);
        }
        twist = times_high(twist, x).wrapping_add(bend);
        bend = times_high(bend, x).wrapping_add(slope);
        slope = times_high(slope, x).wrapping_add((value >> 32) as i32);
        value = times(value, x);
        Local { value, slope, bend, twist }
    }
}

/// 2³², the unit of `x` and of the derivatives.
const WORD: f32 = 4294967296.0;

impl Local {
    /// The step of `x` that Halley's method takes to make up for `missing`, at most twice Newton's:
    /// `r / (S' + S''/2 · r/S')`, with one division.
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        let slope = self.slope as f32;
        let newton = slope * slope;
        let halley = newton + self.bend as f32 * (missing * (1.0 / WORD));
        missing * slope / if halley > 0.5 * newton { halley } else { 0.5 * newton }
    }

    /// The step from or to a flat place, where the density touches 0 and `S` is as `c (x - q)³`, in which
    /// Newton's method is slow or lost: `q` is where `S''` is 0, and a cube root does the rest.
    const fn flat_step(&self, missing: f32) -> f32 {
        let (b, c) = (self.bend as f32 * WORD, self.twist as f32);
        let from_flat = b / (3.0 * c);
        let cube = missing * (WORD / c) * WORD + from_flat * from_flat * from_flat;
        cube_root(cube) - from_flat
    }
}

/// The cube root to 0.2 %: a third of the exponent and a step of Newton's method.
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
/// It stops where less is missing than one unit of `x` adds, which `rest` then makes up for, or in a flat
/// place where the residual is below `2^-enough` of the target, or with the bracket down to neighbours.
pub(crate) const fn solve<const N: usize>(
    c: &Series<N>,
    target: Wide,
    seed: Seed,
    enough: u32,
) -> Root {
    let Seed { mut x, mut shift } = seed;
    let mut scaled = Scaled::new(c, shift);
    let mut goal = target.in_units(scaled.unit);
    let (mut low, mut high) = (0, TOP);
    let (mut evaluations, mut last) = (0, 0.0);
    loop {
        let local = scaled.at(x);
        evaluations += 1;
        let missing = goal - local.value;
        let size = if missing < 0 { -missing } else { missing };
        let rough = (missing >> 32) as i32 as f32 * WORD + missing as u32 as f32;
        let step = local.step(rough);
        // Less is missing than one step of x adds.
        let small = size < local.slope as i64;
        // In a flat place a small residual is a long step, and good enough.
        let flat = step.abs() > (x >> FLAT) as f32 && size <= goal >> enough;
        if small || flat || high - low <= 1 || evaluations == MAX_EVALUATIONS {
            let rest = if small { step } else { 0.0 };
            return Root { x, shift, rest, evaluations };
        }
        if missing > 0 {
            low = x;
        } else {
            high = x;
        }
        // Steps that shrink evenly approach a flat place, where convergence is linear: go to their sum.
        let ratio = step / last;
        let even = ratio > 0.25 && ratio < 0.75;
        let step = if even { step / (1.0 - ratio) } else { step };
        last = if even { 0.0 } else { step };
        // A cast saturates; a NaN gives 0 and so stays where it is, on the bracket's edge.
        let mut next = x as i64 + step as i32 as i64;
        if next <= low as i64 || next >= high as i64 {
            // At a flat place Newton's method is lost.
            next = x as i64 + local.flat_step(rough) as i32 as i64;
            last = 0.0;
        }
        if low == x && high == TOP && shift > LEAST_SHIFT && (x > TOP / 2 || next >= TOP as i64) {
            // The target may be more than this scale holds: two octaves up.
            let up = if shift - 2 < LEAST_SHIFT { shift - LEAST_SHIFT } else { 2 };
            shift -= up;
            scaled = Scaled::new(c, shift);
            goal = target.in_units(scaled.unit);
            low >>= up;
            next >>= up;
            last = 0.0;
        }
        // The bracket must shrink, on average, as bisection would shrink it.
        let late = evaluations >= NEWTON && high - low > TOP >> (evaluations + 1 - NEWTON);
        if late || next <= low as i64 || next >= high as i64 {
            next = (low + (high - low) / 2) as i64;
        }
        x = next as i32;
    }
}

impl Root {
    /// `p = 0`.
    pub(crate) const START: Self = Self { x: 0, shift: 0, rest: 0.0, evaluations: 0 };

    /// The series' value here: its magnitude, and whether it is negative.
    pub(crate) const fn value<const N: usize>(&self, c: &Series<N>) -> (Wide, bool) {
        let scaled = Scaled::new(c, self.shift);
        let local = scaled.at(self.x);
        let value = local.value + (local.slope as f32 * self.rest) as i32 as i64;
        (Wide::new(value.unsigned_abs(), scaled.unit), value < 0)
    }
}
