//! Power series from one end of a ramp, evaluated and solved in pairs of `f32`.
//!
//! Measured from an end of the ramp, the time passed, the openness gained and the mass collected are
//! all polynomials without a constant term: `S(p) = c₁ p + c₂ p² + ...`, `p` in [0, 1].
//!
//! **Why this keeps relative accuracy.** Near `p = 2^-shift` the coefficients are taken as `c_k 2^(-k shift)`, in units
//! of a power of two near the target, so that nothing overflows and what underflows does not count, however small
//! `p` is. A non-negative polynomial's increasing integral bounds its own terms (Markov): together they exceed `S(p)` by a
//! factor that depends on the degree alone, below 2¹³ for degree 6. Single precision thus keeps 9 bits of `S` at the
//! least and mostly 20, enough to search, and pairs keep 31 at the least, enough to tell what is missing from a target,
//! whose neighbour in `f32` is 2⁻²⁴ away.

use crate::wide::Wide;

/// An unevaluated sum of two `f32`, the second at most a few ulp of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    hi: f32,
    lo: f32,
}

/// `c[0] p + c[1] p² + ...`
pub(crate) type Series<const N: usize> = [Pair; N];

impl Pair {
    const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The base-2 logarithm of the magnitude, linear between powers of two, in units of 2⁻²⁰.
    #[inline(always)]
    pub(crate) const fn rough_log(self) -> i32 {
        (self.hi.to_bits() << 1 >> 4) as i32 - (127 << 20)
    }

    /// The significand of `x`, in [1, 2).
    #[inline(always)]
    const fn significand(x: Wide) -> Self {
        const UNIT: f32 = 1.0 / (1u64 << 47) as f32;
        let hi = f32::from_bits(127 << 23 | (x.m >> 40) as u32 & 0x7F_FFFF);
        Self { hi, lo: ((x.m >> 16) as u32 & 0xFF_FFFF) as f32 * UNIT }
    }

    /// The nearest 54-bit number, and the exponent of its unit.
    #[inline(always)]
    const fn fixed(self) -> (i64, i32) {
        // The second is the smaller, so three operations make the sum exact.
        let hi = self.hi + self.lo;
        let lo = self.lo - (hi - self.hi);
        if hi == 0.0 {
            return (0, 0);
        }
        let exponent = (hi.to_bits() >> 23 & 0xFF) as i32 - 127;
        let high = ((hi.to_bits() & 0x7F_FFFF | 1 << 23) as i64) << 30;
        let low = (lo * power_of_two(53 - exponent)) as i32 as i64;
        (if hi < 0.0 { low - high } else { low + high }, exponent - 53)
    }
}

/// The series with coefficients in units of `2^unit`.
pub(crate) const fn series<const N: usize>(c: [f64; N], unit: i32) -> Series<N> {
    let scale = f64::from_bits(((1023 - unit) as u64) << 52);
    let mut pairs = [Pair::ZERO; N];
    let mut k = 0;
    while k < N {
        let hi = (c[k] * scale) as f32;
        pairs[k] = Pair { hi, lo: (c[k] * scale - hi as f64) as f32 };
        k += 1;
    }
    pairs
}

/// `2^n`, a normal number.
#[inline(always)]
const fn power_of_two(n: i32) -> f32 {
    f32::from_bits(((n + 127) as u32) << 23)
}

/// `a + b` rounded, and what the rounding lost (Knuth).
#[inline(always)]
const fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let added = sum - a;
    (sum, (a - (sum - added)) + (b - added))
}

/// The upper 12 of 24 bits. The product of two such halves is exact.
#[inline(always)]
const fn upper(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xFFFF_F000)
}

/// A value with the derivatives the search uses: `S'`, `S''/2` and `S'''/6`.
struct Local {
    value: f32,
    slope: f32,
    bend: f32,
    twist: f32,
}

/// A value to the bits of a pair, and what its terms sum up to without their signs.
struct Exact {
    value: Pair,
    size: f32,
}

/// The coefficients near `2^-shift`, times `2^up`: `x` then stands for `p = x 2^-shift`.
#[inline(always)]
const fn scaled<const N: usize>(series: &Series<N>, shift: i32, up: i32) -> Series<N> {
    let mut c = [Pair::ZERO; N];
    let step = if shift < 127 { power_of_two(-shift) } else { 0.0 };
    let mut factor = power_of_two(up - shift);
    let mut k = 0;
    while k < N {
        c[k] = Pair { hi: series[k].hi * factor, lo: series[k].lo * factor };
        factor *= step;
        k += 1;
    }
    c
}

/// Horner's rule in single precision.
#[inline(always)]
const fn at<const N: usize>(c: &Series<N>, x: f32) -> Local {
    let (mut value, mut slope, mut bend, mut twist) = (c[N - 1].hi, 0.0, 0.0, 0.0);
    let mut k = N;
    while k > 0 {
        k -= 1;
        // A compiler must not leave out the products of 0, which may be no number.
        twist = if k + 3 < N { twist * x + bend } else { bend };
        bend = if k + 2 < N { bend * x + slope } else { slope };
        slope = if k + 1 < N { slope * x + value } else { value };
        value = if k > 0 { value * x + c[k - 1].hi } else { value * x };
    }
    Local { value, slope, bend, twist }
}

/// Horner's rule with what each sum and each product loses (Dekker) carried along.
#[inline(never)]
const fn exactly(c: &[Pair], x: f32) -> Exact {
    let x_high = upper(x);
    let x_low = x - x_high;
    let (mut hi, mut lo, mut size) = (0.0, 0.0, 0.0);
    // Unknown to the compiler, which would unroll the loop to several times its bytes.
    let mut k = core::hint::black_box(c.len());
    while k > 0 && k <= c.len() {
        k -= 1;
        let (sum, lost) = two_sum(c[k].hi, hi);
        lo += c[k].lo + lost;
        hi = sum * x;
        let high = upper(sum);
        let low = sum - high;
        let lost = ((high * x_high - hi) + high * x_low + low * x_high) + low * x_low;
        lo = lo * x + lost;
        size = (size + c[k].hi.abs()) * x;
    }
    Exact { value: Pair { hi, lo }, size }
}

/// Where a search starts: `p = x 2^-shift`, `x` in [1/8, 1/4).
#[derive(Clone, Copy)]
pub(crate) struct Seed {
    pub(crate) x: f32,
    pub(crate) shift: i32,
}

/// A place on a ramp, `p = (x + rest) 2^-shift`, and how many evaluations it took to find it.
#[derive(Clone, Copy)]
pub(crate) struct Root {
    x: f32,
    rest: f32,
    shift: i32,
    pub(crate) evaluations: u32,
}

/// Newton steps before the bracket has to keep up with what bisection would make of it.
const NEWTON: u32 = 10;
/// Bisections that bring any bracket between 0 and [`FARTHEST`] down to neighbours, taken by their bits.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes.
pub const MAX_EVALUATIONS: u32 = NEWTON + BISECTION;

/// A seed takes the greatest term for the whole, which by Markov's bound may be 2¹³ times as much: no root is farther
/// than `2^FARTHEST`.
const FARTHEST: i32 = 14;

/// It takes pairs to tell what less than this share of a target is missing.
const NEAR: f32 = 1.0 / 1024.0;
/// A slope below this share of its terms may be rounding.
const SLOPE: f32 = 1.0 / 262144.0;
/// Where `S''/2 · step` is below this share of `S'`, and `S'''/6 · step²` below its square, Halley's step may be the
/// last.
const BENT: f32 = 1.0 / 512.0;

/// How exact a search has to be, relative to the target.
#[derive(Clone, Copy)]
pub(crate) struct Enough {
    /// What a last step may make up for. It leaves `(S''/2 · step/S')² + S'''/6 · step²/S'` of that, up to a factor of
    /// 2: with [`BENT`], 2⁻¹⁷.
    pub(crate) near: f32,
    /// The slope's rounding, some 2⁻²¹ of its terms, may leave 2⁻²¹ over this.
    pub(crate) slope: f32,
    /// In a flat place this may be left.
    pub(crate) flat: f32,
    /// Whether it is then the middle of that place that is asked for.
    pub(crate) middle: bool,
}

impl Local {
    /// The step of `x` that makes up for `missing`: Halley's, `r / (S' + S''/2 · r/S')`, with one division, or, where
    /// that is long or lost, [`far`](Self::far).
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        let newton = self.slope * self.slope;
        let curve = self.bend * missing;
        if self.slope <= 0.0 || curve.abs() > 0.2 * newton {
            return Self::far(self.slope, self.bend, self.twist, missing);
        }
        missing * self.slope / (newton + curve)
    }

    /// Near a flat place `S` is as `c (x - q)^k + d`, which three derivatives tell: a root then. Elsewhere Halley's
    /// step again, but at most twice Newton's.
    #[inline(never)]
    const fn far(slope: f32, bend: f32, twist: f32, missing: f32) -> f32 {
        let ratio = 3.0 * slope * twist / (bend * bend);
        if ratio > 0.7 && ratio < 1.8 {
            let from_flat = slope / (bend * (2.0 - ratio));
            let order = (2.0 - ratio) / (4.0 - ratio);
            let share = 1.0 + missing / (slope * from_flat * order);
            let size = share.abs();
            let root = power(size, order);
            let root = if share < 0.0 { -root } else { root };
            return from_flat * (root - 1.0);
        }
        let newton = slope * slope;
        let halley = newton + bend * missing;
        missing * slope / if halley > 0.5 * newton { halley } else { 0.5 * newton }
    }

    /// The step to the flat place itself, if all between is rounding.
    const fn to_flat(&self, x: f32) -> f32 {
        let from_flat = self.bend / (3.0 * self.twist);
        let size = self.twist * from_flat * from_flat * from_flat;
        if size.abs() < SLOPE && from_flat.abs() < NEAR * x { -from_flat } else { 0.0 }
    }
}

/// `x^y` for `x > 0` and `y` in [0, 1], to a few percent: floats are nearly logarithms.
const fn power(x: f32, y: f32) -> f32 {
    const ONE: i32 = 1.0f32.to_bits() as i32;
    const MEAN: f32 = 0.045 * (1 << 23) as f32;
    f32::from_bits((ONE + ((x.to_bits() as i32 - ONE) as f32 * y - MEAN * (1.0 - y)) as i32) as u32)
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
    let Seed { mut x, shift } = seed;
    let c = scaled(series, shift, -(target.e + 63));
    let goal = Pair::significand(target);
    let (mut low, mut high) = (0.0, power_of_two(if shift < FARTHEST { shift } else { FARTHEST }));
    let mut evaluations = 0;
    let step = loop {
        let local = at(&c, x);
        evaluations += 1;
        let (mut missing, mut size) = (goal.hi - local.value, 0.0);
        let is_near = missing.abs() <= NEAR || evaluations >= NEWTON;
        if is_near {
            let exact = exactly(&c, x);
            missing = (goal.hi - exact.value.hi) + (goal.lo - exact.value.lo);
            size = exact.size;
        }
        let step = local.step(missing);
        if is_near
            && missing.abs() <= enough.near
            && size * (missing.abs() * enough.slope + SLOPE) < local.slope * x
            && (local.bend * step).abs() + (local.twist * step * step).abs() / BENT
                <= BENT * local.slope
        {
            break step;
        }
        if is_near && missing.abs() <= enough.flat {
            break if enough.middle { local.to_flat(x) } else { 0.0 };
        }
        if missing > 0.0 {
            low = x;
        } else {
            high = x;
        }
        // As many as there are `f32` in the bracket.
        let width = high.to_bits() - low.to_bits();
        if width <= 1 || evaluations == MAX_EVALUATIONS {
            break if step.abs() < high - low { step } else { 0.0 };
        }
        let next = x + step;
        x = if evaluations >= NEWTON && width > 1 << 30 >> (evaluations + 1 - NEWTON) {
            // The bracket must shrink, on average, as bisection would shrink it.
            f32::from_bits(low.to_bits() + width / 2)
        } else if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
    };
    let next = x + step;
    Root { x: next, rest: (x - next) + step, shift, evaluations }
}

impl Root {
    /// `p = 0`.
    pub(crate) const START: Self = Self { x: 0.0, rest: 0.0, shift: 0, evaluations: 0 };

    /// The series' value here, in units of a power of two, and its exponent.
    #[inline(always)]
    pub(crate) const fn value<const N: usize>(&self, series: &Series<N>) -> (i64, i32) {
        // Farther than this into the end every series is its first term.
        let shift = if self.shift < 100 { self.shift } else { 100 };
        let scale = power_of_two(-shift);
        let p = self.x * scale;
        let Pair { hi, lo } = exactly(series, p).value;
        let slope = at(series, p).slope;
        let (value, unit) = Pair { hi, lo: lo + slope * (self.rest * scale) }.fixed();
        (value, unit - (self.shift - shift))
    }
}
