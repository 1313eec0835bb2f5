//! Power series from one end of a ramp, evaluated and solved in integers.
//!
//! Measured from an end of the ramp, the time passed, the openness gained and the mass collected are
//! all polynomials without a constant term: `S(p) = c₁ p + c₂ p² + ...`, `p` in [0, 1].
//!
//! **Why integers keep relative accuracy.** For `p` near `2^-shift` the coefficients are taken as
//! `c_k 2^(-k shift)` in units of a common power of two, so that the greatest fills 60 bits. A
//! non-negative polynomial's increasing integral bounds its own terms (Markov): `|c_k p^k|` exceeds
//! `S(p)` by a factor that depends on the degree alone, below 2¹³ for degree 6. So `S` keeps some 40
//! bits of its own, and 30 where `p` is an eighth of `2^-shift`, however small it is, and neighbouring `f32`
//! targets, 2⁻²⁴ apart, stay apart.
//!
//! **Why two widths.** The upper 32 bits alone mostly keep 15 or more bits of `S`, at a sixth of the cycles. The
//! search runs on them, with the derivatives, until they have no more to say; the 64 bits then finish it, mostly
//! in one evaluation. Steps are taken in `f32`: a step needs no more bits than it adds.

use crate::wide::Wide;

/// A coefficient: in the upper 54 bits the significand of an `f64`, with its sign, and in the lower 10
/// the exponent, so that one shift aligns it.
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

    /// The base-2 logarithm of the magnitude, linear between powers of two, in units of 2⁻²⁰.
    #[inline(always)]
    pub(crate) const fn rough_log(self) -> i32 {
        let high = (self.0 >> 32) as i32;
        ((high ^ high >> 31) >> 10) + ((self.exponent() - (Self::BIAS - 62) - 1) << 20)
    }

    /// Shifted down by `down`.
    #[inline(always)]
    const fn aligned(self, down: i32) -> i64 {
        (self.0 & !(Self::EXPONENT as i64)) >> clamped(down, 63)
    }

    /// The upper 32 bits of that.
    #[inline(always)]
    const fn rough(self, down: i32) -> i32 {
        (self.0 >> 32) as i32 >> clamped(down, 31)
    }
}

/// `x` brought into [0, most], in one instruction of a microcontroller that has one.
#[inline(always)]
const fn clamped(x: i32, most: i32) -> i32 {
    if x < 0 {
        0
    } else if x > most {
        most
    } else {
        x
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
/// After a step by less than 2⁻⁸ of `x` the upper 32 bits have little more to say.
const CLOSE: u32 = 8;
/// A slope below this is too much of it for a last step.
const SLOPE: i32 = 16;

/// How exact a search has to be, relative to the target.
///
/// One step of Halley's leaves `(S''/2 · step/S')² + S'''/6 · step²/S'` of a residual, up to a factor of 2. Where
/// both are below 2⁻¹⁸, a residual below `near` is thus the last one. The rounding of the slope leaves
/// [`NOISE`] times the step, so `slope` bounds the step, in units of `x`, by the target's upper 32 bits.
#[derive(Clone, Copy)]
pub(crate) struct Enough {
    pub(crate) near: f32,
    pub(crate) slope: f32,
    /// In a flat place the residual itself has to be below this.
    pub(crate) flat: f32,
    /// Whether it is then the middle of that place that is asked for.
    pub(crate) middle: bool,
}

/// Below these shares of `S'` the terms of Halley's remainder are small enough.
const BENT: f32 = 1.0 / 512.0;
const TWISTED: f32 = BENT * BENT;
/// Below this share, in bits, the slope at the end of a step is known well enough from its start: to 2⁻¹⁴, for
/// which a residual has to be smaller by [`LESS`].
const KNOWN: u32 = 7;
const LESS: f32 = 1.0 / 16.0;

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
    // Zeros count as 2⁻⁵⁷⁴, which in the range of curves is below any other.
    let mut top = i32::MIN;
    let (mut k, mut by) = (0, 0);
    while k < series.len() {
        by += shift;
        let e = series[k].exponent() - by;
        if e > top {
            top = e;
        }
        k += 1;
    }
    top
}

/// `S` at `x` by Horner's rule, in units of `2^(top + GUARD - BIAS)`, where `down` is `top + GUARD`
/// and `shift` for each coefficient.
#[inline(never)]
const fn value(series: &[Coefficient], x: i32, down: i32, shift: i32) -> i64 {
    let (mut value, mut down) = (0, down);
    // Unknown to the compiler, which would unroll the loop to 400 bytes more for 40 cycles less.
    let mut k = core::hint::black_box(series.len());
    while k > 0 && k <= series.len() {
        k -= 1;
        value = times(value, x).wrapping_add(series[k].aligned(down - series[k].exponent()));
        down -= shift;
    }
    times(value, x)
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
    /// Takes the coefficients near `2^-shift` and tells the exponent of the greatest. Out of line, which spares the
    /// search its registers.
    #[inline(never)]
    const fn scale(&mut self, series: &Series<N>, shift: i32) -> i32 {
        let mut down = [0; N];
        let mut top = i32::MIN;
        let (mut k, mut by) = (0, 0);
        while k < N {
            by += shift;
            down[k] = by - series[k].exponent();
            if -down[k] > top {
                top = -down[k];
            }
            k += 1;
        }
        k = 0;
        while k < N {
            // One more makes up for what is rounded down here and in the product it is added to.
            self.0[k] = series[k].rough(top + GUARD + down[k]) + 1;
            k += 1;
        }
        top
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

/// In units of 2³², to 24 bits; the lower word is signed, or a small negative number would be lost in the sum.
#[inline(always)]
const fn in_words(x: i64) -> f32 {
    ((x + (1 << 31)) >> 32) as i32 as f32 + x as i32 as f32 * (1.0 / WORD)
}

impl Local {
    /// The step of `x` that makes up for `missing`, in the unit of the value: Halley's,
    /// `r / (S' + S''/2 · r/S')`, with one division, or, where that is long or lost, [`far`](Self::far).
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        let (slope, bend) = (self.slope as f32, self.bend as f32);
        let newton = slope * slope;
        let curve = bend * missing;
        if self.slope <= 0 || curve.abs() > 0.2 * newton {
            return Self::far(self.slope, self.bend, self.twist, missing);
        }
        missing * WORD * slope / (newton + curve)
    }

    /// The step to the flat place itself, if all between is rounding.
    const fn to_flat(&self) -> i32 {
        let twist = self.twist as f32;
        let from_flat = self.bend as f32 / (3.0 * twist);
        let size = twist * from_flat * from_flat * from_flat;
        if self.slope < SLOPE && size.abs() < 8.0 / WORD { -(from_flat * WORD) as i32 } else { 0 }
    }

    /// Near a flat place `S` is as `c (x - q)^k + d`, which three derivatives tell: a root then. Elsewhere
    /// Halley's step again, but at most twice Newton's.
    #[inline(never)]
    const fn far(slope: i32, bend: i32, twist: i32, missing: f32) -> f32 {
        let (slope, bend, twist) = (slope as f32, bend as f32, twist as f32);
        let ratio = 3.0 * slope * twist / (bend * bend);
        if ratio > 0.7 && ratio < 1.8 {
            let from_flat = slope / (bend * (2.0 - ratio));
            let order = (2.0 - ratio) / (4.0 - ratio);
            let share = 1.0 + missing / (slope * from_flat * order);
            let size = share.abs();
            let mut root = power(size, order);
            if ratio < 1.2 {
                root -= (root - size / (root * root)) * order;
            }
            let root = if share < 0.0 { -root } else { root };
            return from_flat * (root - 1.0) * WORD;
        }
        let newton = slope * slope;
        let halley = newton + bend * missing;
        missing * WORD * slope / if halley > 0.5 * newton { halley } else { 0.5 * newton }
    }
}

/// `x^y` for `x > 0` and `y` in [0, 1], to a few percent: floats are nearly logarithms.
const fn power(x: f32, y: f32) -> f32 {
    const ONE: i32 = 1.0f32.to_bits() as i32;
    const MEAN: f32 = 0.045 * (1 << 23) as f32;
    f32::from_bits((ONE + ((x.to_bits() as i32 - ONE) as f32 * y - MEAN * (1.0 - y)) as i32) as u32)
}

/// By how many octaves the scale grows where the target may be more than it holds; 0 where it can't.
const fn growth(shift: i32, x: i32, high: i32) -> i32 {
    if x > TOP - TOP / 8 && high == TOP { clamped(shift - LEAST_SHIFT, 2) } else { 0 }
}

/// The `p` in [0, 1] with `S(p) = target`, for an `S` that increases from 0 to at least `target`: Halley's
/// method inside a bracket, and bisection where a step leaves it or where, after [`NEWTON`] steps, the bracket is
/// wider than bisection alone would have left it.
///
/// It stops where one more step is [`Enough`], or with the bracket down to neighbours.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: &Series<N>,
    target: Wide,
    seed: Seed,
    enough: Enough,
) -> Root {
    let Seed { mut x, mut shift } = seed;
    let (mut low, mut high) = (0, TOP);
    let (mut evaluations, mut exact) = (0, false);
    let mut rough = Rough([0; N]);
    'scale: loop {
        let top = rough.scale(series, shift);
        let goal = target.in_units(top + GUARD - Coefficient::BIAS);
        'at: loop {
            let (mut local, mut near) = (rough.at(x), enough.near);
            evaluations += 1;
            if !exact {
                let missing = (goal >> 32) as i32 - local.value;
                exact = missing.unsigned_abs() <= NOISE || evaluations >= NEWTON;
                if !exact {
                    let step = local.step(missing as f32) as i32;
                    let next = x.saturating_add(step);
                    exact = (step ^ step >> 31) < x >> CLOSE;
                    let change = times_high(local.bend, step);
                    if !exact || change.abs() > local.slope >> KNOWN || next <= low || next >= high
                    {
                        if missing > 0 {
                            low = x;
                        } else {
                            high = x;
                        }
                        let up = growth(shift, next, high);
                        if up > 0 {
                            shift -= up;
                            low >>= up;
                            x = (x >> up) + (step >> up);
                            continue 'scale;
                        }
                        x = if next > low && next < high { next } else { low + (high - low) / 2 };
                        continue 'at;
                    }
                    // The slope there, where it changes little.
                    local.slope += 2 * change;
                    x = next;
                    near *= LESS;
                }
            }
            let missing = goal - value(series, x, top + GUARD + N as i32 * shift, shift);
            let (rest, all) = (in_words(missing), in_words(goal));
            let step = local.step(rest);
            // With a slope whose noise does not count, and in a straight place.
            let slope = local.slope as f32 * WORD;
            let (bend, twist) = (local.bend as f32 * step, local.twist as f32 * step * step);
            // A cast saturates; a NaN gives 0.
            let whole = step as i32;
            let next = x.saturating_add(whole);
            if rest.abs() <= near * all
                && step.abs() <= enough.slope * all
                && local.slope > SLOPE
                && bend.abs() <= BENT * slope
                && twist.abs() <= TWISTED * WORD * slope
                // What lies beyond the scale is looked for in a larger one.
                && next < TOP
            {
                return Root { x: next, shift, rest: step - whole as f32, evaluations };
            }
            if rest.abs() <= enough.flat * all {
                let step = if enough.middle { local.to_flat() } else { 0 };
                return Root { x: x.saturating_add(step), shift, rest: 0.0, evaluations };
            }
            if missing > 0 {
                low = x;
            } else {
                high = x;
            }
            if evaluations == MAX_EVALUATIONS {
                return Root { x, shift, rest: 0.0, evaluations };
            }
            // The bracket must shrink, on average, as bisection would shrink it.
            let late = evaluations >= NEWTON && high - low > TOP >> (evaluations + 1 - NEWTON);
            if late || next <= low || next >= high {
                if high - low <= 1 {
                    return Root { x, shift, rest: 0.0, evaluations };
                }
                x = low + (high - low) / 2;
            } else {
                x = next;
            }
            let up = growth(shift, x, high);
            if up > 0 {
                shift -= up;
                low >>= up;
                x >>= up;
                continue 'scale;
            }
        }
    }
}

impl Root {
    /// `p = 0`.
    pub(crate) const START: Self = Self { x: 0, shift: 0, rest: 0.0, evaluations: 0 };

    /// `p`
    pub(crate) const fn place(&self) -> f64 {
        let unit = f64::from_bits(((1023 - 32 - self.shift) as u64) << 52);
        (self.x as f64 + self.rest as f64) * unit
    }

    /// The series' value here, in units of a power of two, and its exponent.
    #[inline(always)]
    pub(crate) const fn value<const N: usize>(&self, series: &Series<N>) -> (i64, i32) {
        let Self { x, shift, .. } = *self;
        let top = top(series, shift);
        let mut down = top + GUARD + N as i32 * shift;
        let (mut value, mut slope) = (0i64, 0i32);
        let mut k = N;
        while k > 0 {
            k -= 1;
            slope = times_high(slope, x).wrapping_add((value >> 32) as i32);
            value = times(value, x).wrapping_add(series[k].aligned(down - series[k].exponent()));
            down -= shift;
        }
        slope = times_high(slope, x).wrapping_add((value >> 32) as i32);
        let rest = (slope as f32 * self.rest) as i32;
        (times(value, x).wrapping_add(rest as i64), top + GUARD - Coefficient::BIAS)
    }
}
