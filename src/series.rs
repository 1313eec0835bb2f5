//! Power series along a ramp, searched in `f32` and measured in pairs of `f32`.
//!
//! Measured from a place on the ramp, the time passed and the mass collected are polynomials without a constant term:
//! `S(p) = c₁ p + c₂ p² + ...`
//!
//! **Why this keeps relative accuracy.** A non-negative polynomial's increasing integral bounds its own terms (Markov):
//! together they exceed `S(p)` by a factor that depends on the degree alone, below 2¹³ for degree 6. Single precision thus
//! keeps mostly 20 bits of `S`, enough to search, and 8 at the least, where the search ends in pairs. These keep 31 at the
//! least, enough to tell what is missing from a target, whose neighbour in `f32` is 2⁻²⁴ away. What is missing is then
//! searched for with the polynomial around that place, where it is a small number known to all the bits of single
//! precision.
//!
//! **Why nothing overflows**, and what underflows does not count: a ramp's length and mass count some 2¹⁰⁰, and places up
//! to 2²⁴, so a share of 2⁻¹⁴⁹ still has both its halves, and so has a step towards it.

use crate::wide::Wide;

/// An unevaluated sum of two `f32`, the second at most a few ulp of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pair {
    pub(crate) hi: f32,
    pub(crate) lo: f32,
}

/// The whole ramp: `p` counts from 0 at the one end to this at the other.
pub(crate) const ONE: f32 = (1 << 24) as f32;

/// `c[0] p + c[1] p² + ...`
pub(crate) type Series<const N: usize> = [Pair; N];

impl Pair {
    pub(crate) const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    /// Of which nothing is near.
    pub(crate) const INFINITE: Self = Self { hi: f32::INFINITY, lo: 0.0 };

    /// The significand of `x`, in [1, 2).
    #[inline(always)]
    pub(crate) const fn significand(x: Wide) -> Self {
        const UNIT: f32 = 1.0 / (1u64 << 47) as f32;
        let hi = f32::from_bits(127 << 23 | (x.m >> 40) as u32 & 0x7F_FFFF);
        Self { hi, lo: ((x.m >> 16) as u32 & 0xFF_FFFF) as f32 * UNIT }
    }

    /// `x` to 48 bits.
    #[inline(always)]
    pub(crate) const fn new(x: Wide) -> Self {
        let Self { hi, lo } = Self::significand(x);
        let scale = power_of_two(x.e + 63);
        Self { hi: hi * scale, lo: lo * scale }
    }

    /// `x 2^n`, a normal number or 0.
    pub(crate) const fn scaled(x: f32, n: i32) -> Self {
        // The power of two by halves, for it may not be a normal number itself.
        let half = n >> 1;
        Self { hi: x * power_of_two(half) * power_of_two(n - half), lo: 0.0 }
    }

    /// `self - other`
    #[inline(always)]
    pub(crate) const fn minus(self, other: Self) -> Self {
        let (sum, lost) = two_sum(self.hi, -other.hi);
        let (hi, lo) = two_sum(sum, lost + (self.lo - other.lo));
        Self { hi, lo }
    }

    /// `x self`, for a power of two `x`.
    #[inline(always)]
    pub(crate) const fn times(self, x: f32) -> Self {
        Self { hi: self.hi * x, lo: self.lo * x }
    }

    /// `3 self`
    pub(crate) const fn thrice(self) -> Self {
        let (sum, lost) = two_sum(self.hi, 2.0 * self.hi);
        let (hi, lo) = two_sum(sum, lost + 3.0 * self.lo);
        Self { hi, lo }
    }

    /// `self - other` in single precision, which keeps its relative accuracy where the two are near.
    #[inline(always)]
    pub(crate) const fn less(self, other: Self) -> f32 {
        (self.hi - other.hi) + (self.lo - other.lo)
    }

    #[inline(always)]
    pub(crate) const fn is_negative(self) -> bool {
        self.hi + self.lo < 0.0
    }

    /// The magnitude, in units of `2^unit`.
    #[inline(always)]
    pub(crate) const fn magnitude(self, unit: i32) -> Wide {
        let (x, e) = self.fixed();
        Wide::new(x.unsigned_abs(), e + unit)
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

/// The series with coefficients `c`, of powers of the share of the ramp, in units of `2^unit`.
pub(crate) const fn series<const N: usize>(c: [f64; N], unit: i32) -> Series<N> {
    let mut scale = f64::from_bits(((1023 - unit) as u64) << 52);
    let mut pairs = [Pair::ZERO; N];
    let mut k = 0;
    while k < N {
        scale /= ONE as f64;
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

/// The coefficients in single precision.
#[inline(always)]
pub(crate) const fn single<const N: usize>(series: &Series<N>) -> [f32; N] {
    let mut c = [0.0; N];
    let mut k = 0;
    while k < N {
        c[k] = series[k].hi;
        k += 1;
    }
    c
}

/// A polynomial around `x`, as far as it is told: Horner's rule gives its value there, and again and again its Taylor
/// coefficients `S'`, `S''/2`, ...
struct Taylor<const N: usize> {
    x: f32,
    value: f32,
    /// The first two are those around `x`, the others are on their way.
    c: [f32; N],
}

impl<const N: usize> Taylor<N> {
    /// `c[0] x + c[1] x² + ...` at `x`, with two derivatives.
    #[inline(always)]
    const fn new(c: &[f32; N], x: f32) -> Self {
        let mut local = Self { x, value: 0.0, c: *c };
        local.divide(0);
        local.value = local.c[0] * x;
        local.divide(0);
        local.divide(1);
        local
    }

    /// Horner's rule, down to the coefficient `last`.
    #[inline(always)]
    const fn divide(&mut self, last: usize) {
        let mut k = N - 1;
        while k > last {
            k -= 1;
            self.c[k] += self.c[k + 1] * self.x;
        }
    }

    /// All coefficients around `x`.
    #[inline(always)]
    const fn around(mut self) -> [f32; N] {
        let mut done = 2;
        while done < N {
            self.divide(done);
            done += 1;
        }
        self.c
    }

    /// Halley's step to make up for `missing`.
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        missing / (self.c[0] + self.c[1] * (missing / self.c[0]))
    }
}

/// Horner's rule with what each sum and each product loses (Dekker) carried along.
#[inline(always)]
pub(crate) const fn exactly(c: &[Pair], x: f32) -> Pair {
    let x_high = upper(x);
    let x_low = x - x_high;
    let (mut hi, mut lo) = (0.0, 0.0);
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
    }
    Pair { hi, lo }
}

/// The coefficients around `x` in single precision, taken in pairs, for they may be differences of nearly the same.
pub(crate) const fn around([a, b, c]: &Series<3>, x: f32) -> [f32; 3] {
    let (twice, thrice) = (Pair::ZERO.minus(*b).minus(*b), Pair::ZERO.minus(c.thrice()));
    [a.less(exactly(&[twice, thrice], x)), b.less(exactly(&[thrice], x)), c.hi]
}

/// `base + way 2^unit`, or `base - way 2^unit` where `back`, rounded once, for a `way` of at most 2⁶⁴ and a `unit`
/// in [-252, 126].
#[inline(never)]
pub(crate) const fn sum(base: f32, way: Pair, unit: i32, back: bool) -> f32 {
    // Near 0 it is taken in a greater unit, where both halves of a pair are normal numbers.
    let (up, down) = if base.abs() < power_of_two(-78) {
        (power_of_two(48), power_of_two(-48))
    } else {
        (1.0, 1.0)
    };
    // The power of two by halves, for it may not be a normal number itself.
    let half = unit >> 1;
    let first = power_of_two(unit - half);
    let second = if back { -up * power_of_two(half) } else { up * power_of_two(half) };
    let (base, hi, lo) = (base * up, way.hi * first * second, way.lo * first * second);
    // A number whose last place is that of the least `f32` has what will be subnormal rounded to that place.
    let (rough, least) = (base + hi, up * power_of_two(-126));
    let places = if rough.abs() >= least {
        0.0
    } else if rough < 0.0 {
        -least
    } else {
        least
    };
    let (sum, lost) = two_sum(places + base, hi);
    ((sum + odd_sum(lost, lo)) - places) * down
}

/// `a + b`, or of its two neighbours the one whose last bit is set: to round that once more is to round once.
#[inline(always)]
const fn odd_sum(a: f32, b: f32) -> f32 {
    let (sum, lost) = two_sum(a, b);
    let bits = sum.to_bits();
    if lost == 0.0 || bits & 1 == 1 {
        return sum;
    }
    f32::from_bits(if (lost < 0.0) == (sum < 0.0) { bits + 1 } else { bits - 1 })
}

/// A first guess of a way, `x 2^-lift`. What is very near to an end is sought `2^lift` times as far from it, where the
/// series is still its first term, for the sake of the range of `f32`.
#[derive(Clone, Copy)]
pub(crate) struct Seed {
    pub(crate) x: f32,
    pub(crate) lift: i32,
}

/// Nearer to an end than 2 to minus this, where the whole ramp is [`ONE`], a series is its first term.
pub(crate) const FIRST_TERM: i32 = 100;

/// A known place from which a search starts.
pub(crate) struct Start<const N: usize> {
    pub(crate) place: f32,
    /// Does the way lead back, to smaller `p`?
    pub(crate) back: bool,
    /// What is collected along the way, in single precision, each coefficient with its relative accuracy.
    pub(crate) c: [f32; N],
    /// What is to be collected.
    pub(crate) sought: f32,
}

/// Where a search ended: the way `(x + rest) 2^-lift` from its start, and how many evaluations it took.
#[derive(Clone, Copy)]
pub(crate) struct Way {
    x: f32,
    rest: f32,
    lift: i32,
    pub(crate) evaluations: u32,
}

/// Evaluations before all of them are in pairs and the bracket has to keep up with what bisection would make of it.
const NEWTON: u32 = 10;
/// Bisections that bring any bracket between 0 and [`ONE`] down to neighbours, taken by their bits; each may
/// take two evaluations.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes, in single precision and in pairs.
pub const MAX_EVALUATIONS: u32 = NEWTON + 2 * BISECTION;

/// Where less than this share of what is sought is missing, it is measured in pairs. Of what a step starts with Halley's
/// leaves less than a twelfth of the cube, as for `p^k`: 2⁻³⁹.
const NEAR: f32 = 1.0 / 4096.0;

/// A step leads at most this many times as far from the start, since before a dip in the density it overshoots, and the
/// way back is slow.
const FARTHER: f32 = 2.5;

/// What single precision's rounding makes of a slope, as a share of its terms.
const ROUNDING: f32 = 1.0 / (1 << 21) as f32;

/// What the terms of a polynomial at `x` sum up to without their signs.
#[inline(always)]
const fn size_at<const N: usize>(c: &[f32; N], x: f32) -> f32 {
    let mut size = 0.0;
    let mut k = N;
    while k > 0 {
        k -= 1;
        size = (size + c[k].abs()) * x;
    }
    size
}

/// The way from `start` to the `p` with `S(p) = target`, for an increasing `S`, within an `error` relative to `size`.
///
/// Iterative refinement: a search in single precision; at its end what is missing, measured in pairs; then the step that
/// makes up for it, by the polynomial around there. It is the last one if little enough was missing, and if it is so short
/// that the rounding of that polynomial does not matter. Otherwise it goes on from there, and every place is measured.
///
/// The search is one of Halley's steps inside a bracket, at first from the start to the end of the ramp, since beyond it
/// `S` need not increase, and of bisection where a step leaves it. After [`NEWTON`] evaluations all are in pairs, and there
/// is bisection where the bracket is wider than that alone would have left it. It ends with neighbours at the latest.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: &Series<N>,
    target: Pair,
    start: &Start<N>,
    seed: Seed,
    size: f32,
    error: f32,
) -> Way {
    if start.sought == 0.0 {
        return Way::NONE;
    }
    let Seed { mut x, lift } = seed;
    let up = power_of_two(lift);
    let (target, whole) = (target.times(up), start.sought * up);
    let error = error * (size * up);
    let near = NEAR * whole + error;
    let sign = if start.back { -1.0 } else { 1.0 };
    // The polynomial around `origin`, what is sought with it, and what rounding may make of its value.
    let (mut c, mut origin, mut sought, mut rounding) = (start.c, 0.0, whole, 0.0);
    let (mut low, mut high) = (0.0, if start.back { start.place } else { ONE - start.place });
    // At the end of the ramp the density may be 0.
    if x > 0.75 * high {
        x = 0.75 * high;
    }
    let mut evaluations = 0;
    let step = loop {
        let local = Taylor::new(&c, x - origin);
        evaluations += 1;
        let mut missing = sought - local.value;
        let is_near = origin != 0.0 || missing.abs() <= near || evaluations >= NEWTON;
        if is_near {
            if origin == 0.0 {
                rounding = ROUNDING * size_at(&c, x);
                // What the bracket was made of may have been rounding; from here on signs are certain.
                (low, high) = (0.0, ONE);
            }
            evaluations += 1;
            let (p, lost) = two_sum(start.place, sign * x);
            // To the place before rounding it is `lost` more, which the slope tells.
            missing = sign * (target.less(exactly(series, p)) - lost * local.c[0]);
        }
        let step = local.step(missing);
        if is_near {
            if missing.abs() <= 1.5 * near && rounding * step.abs() <= error * x {
                break step;
            }
            (c, origin, sought) = (local.around(), x, missing);
        }
        if missing > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let far = if high < FARTHER * x { high } else { FARTHER * x };
        let next = x + step;
        let next = if next > low && next < far { next } else { 0.5 * (low + far) };
        if evaluations < NEWTON {
            x = next;
            continue;
        }
        // As many as there are `f32` in the bracket.
        let width = high.to_bits() - low.to_bits();
        // One more time round may take two evaluations.
        if width <= 1 || evaluations >= MAX_EVALUATIONS - 1 {
            break if step.abs() < high - low { step } else { 0.0 };
        }
        // It must shrink, on average, as bisection would shrink it.
        x = if width > 1 << 30 >> ((evaluations + 1 - NEWTON) / 2) {
            f32::from_bits(low.to_bits() + width / 2)
        } else {
            next
        };
    };
    let next = x + step;
    Way { x: next, rest: (x - next) + step, lift, evaluations }
}

/// The slope, in single precision.
#[inline(always)]
const fn slope_at<const N: usize>(c: &Series<N>, x: f32) -> f32 {
    let (mut value, mut slope) = (c[N - 1].hi, 0.0);
    let mut k = N;
    while k > 0 {
        k -= 1;
        slope = if k + 1 < N { slope * x + value } else { value };
        value = if k > 0 { value * x + c[k - 1].hi } else { value * x };
    }
    slope
}

impl Way {
    pub(crate) const NONE: Self = Self { x: 0.0, rest: 0.0, lift: 0, evaluations: 0 };

    /// The place to which it leads from `start`, as the way there from the end where `p` is 0.
    pub(crate) const fn from<const N: usize>(self, start: &Start<N>) -> Self {
        let sign = if start.back { -1.0 } else { 1.0 };
        let (x, lost) = two_sum(start.place, sign * self.x);
        Self { x, rest: lost + sign * self.rest, ..self }
    }

    /// The value of an end's series at this way from it, in units of a power of two, and the exponent of that.
    #[inline(always)]
    pub(crate) const fn value<const N: usize>(&self, series: &Series<N>) -> (Pair, i32) {
        let Pair { hi, lo } = exactly(series, self.x);
        let slope = slope_at(series, self.x);
        (Pair { hi, lo: lo + slope * self.rest }, -self.lift)
    }
}
