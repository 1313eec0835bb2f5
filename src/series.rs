//! Power series from one end of a ramp, searched in `f32` and measured in pairs of `f32`.
//!
//! Measured from an end of the ramp, the time passed, the openness gained and the mass collected are
//! all polynomials without a constant term: `S(p) = c₁ p + c₂ p² + ...`, `p` in [0, 1].
//!
//! **Why this keeps relative accuracy.** A non-negative polynomial's increasing integral bounds its own terms (Markov):
//! together they exceed `S(p)` by a factor that depends on the degree alone, below 2¹³ for degree 6. Single precision thus
//! keeps 9 bits of `S` at the least and mostly 20, enough to search, and pairs keep 31 at the least, enough to tell what is
//! missing from a target, whose neighbour in `f32` is 2⁻²⁴ away. What is missing is then searched for with the polynomial
//! around that place, where it is a small number known to all the bits of single precision.
//!
//! Nothing overflows, and what underflows does not count: near `p = 2^-shift` the search takes the coefficients as
//! `c_k 2^(-k shift)`, in units of a power of two near the target; pairs are taken at `p` itself, in units of which the
//! whole counts some 2¹⁰⁰, so that a share of 2⁻¹⁴⁹ still has both its halves.

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
    pub(crate) const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The base-2 logarithm of the magnitude, linear between powers of two, in units of 2⁻²⁰.
    #[inline(always)]
    pub(crate) const fn rough_log(self) -> i32 {
        (self.hi.to_bits() << 1 >> 4) as i32 - (127 << 20)
    }

    /// The significand of `x`, in [1, 2).
    #[inline(always)]
    pub(crate) const fn significand(x: Wide) -> Self {
        const UNIT: f32 = 1.0 / (1u64 << 47) as f32;
        let hi = f32::from_bits(127 << 23 | (x.m >> 40) as u32 & 0x7F_FFFF);
        Self { hi, lo: ((x.m >> 16) as u32 & 0xFF_FFFF) as f32 * UNIT }
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

/// A polynomial's value at a place, and its Taylor coefficients there: `S'`, `S''/2`, `S'''/6`, ...
struct Taylor<const N: usize> {
    value: f32,
    c: [f32; N],
}

/// A value to the bits of a pair, and what its terms sum up to without their signs.
struct Exact {
    value: Pair,
    size: f32,
}

/// The coefficients near `2^-shift`, times `2^up`, in single precision: `x` then stands for `p = x 2^-shift`.
#[inline(always)]
const fn near<const N: usize>(series: &Series<N>, shift: i32, up: i32) -> [f32; N] {
    let mut c = [0.0; N];
    let step = if shift < 127 { power_of_two(-shift) } else { 0.0 };
    let mut factor = power_of_two(up - shift);
    let mut k = 0;
    while k < N {
        c[k] = series[k].hi * factor;
        factor *= step;
        k += 1;
    }
    c
}

/// Horner's rule in single precision, again and again: the first time it gives the value, and each time a coefficient
/// of the polynomial around `x`.
#[inline(always)]
const fn at<const N: usize>(c: &[f32; N], x: f32) -> Taylor<N> {
    let (mut c, mut value) = (*c, 0.0);
    let mut done = 0;
    while done <= N {
        let mut k = N - 1;
        while k > 0 && k >= done {
            k -= 1;
            c[k] += c[k + 1] * x;
        }
        if done == 0 {
            value = c[0] * x;
        }
        done += 1;
    }
    Taylor { value, c }
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

/// Evaluations before the bracket has to keep up with what bisection would make of it.
const NEWTON: u32 = 10;
/// Bisections that bring any bracket between 0 and [`FARTHEST`] down to neighbours, taken by their bits; each may
/// take two evaluations.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes, in single precision and in pairs.
pub const MAX_EVALUATIONS: u32 = NEWTON + 2 * BISECTION;

/// A seed takes the greatest term for the whole, which by Markov's bound may be 2¹³ times as much: no root is farther
/// than `2^FARTHEST`.
const FARTHEST: i32 = 14;

/// Nearer to its end than 2 to minus this a series is its first term.
const FIRST_TERM: i32 = 120;

/// It takes pairs to tell what less than this share of a target is missing.
const NEAR: f32 = 1.0 / 1024.0;

/// What single precision's rounding makes of a slope, as a share of its terms.
const ROUNDING: f32 = 1.0 / (1 << 21) as f32;

/// How exact a search has to be.
#[derive(Clone, Copy)]
pub(crate) struct Enough {
    /// Relative to the target, or to the place.
    pub(crate) error: f32,
    /// Whether it is the place's error.
    pub(crate) of_place: bool,
    /// What of the target may be missing in a flat place. If the place's error counts, it is the middle of the flat
    /// place that is asked for.
    pub(crate) flat: f32,
}

impl<const N: usize> Taylor<N> {
    /// The step that makes up for `missing`, nearly.
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        step(self.c[0], self.c[1], self.c[2], missing)
    }

    /// What a step leaves of what is missing, by up to four derivatives.
    #[inline(always)]
    const fn left(&self, missing: f32, step: f32) -> f32 {
        let mut made = 0.0;
        let mut k = if N < 4 { N } else { 4 };
        while k > 0 {
            k -= 1;
            made = (made + self.c[k]) * step;
        }
        (missing - made).abs()
    }

    /// The step to the middle of a flat place, if all between is rounding.
    const fn to_middle(&self, x: f32) -> f32 {
        let from_middle = self.c[1] / (3.0 * self.c[2]);
        let size = self.c[2] * from_middle * from_middle * from_middle;
        if size.abs() < 8.0 * ROUNDING && from_middle.abs() < x * NEAR { -from_middle } else { 0.0 }
    }
}

/// Halley's step, `r / (S' + S''/2 · r/S')`, with one division, where it is short. Where it is long, and `S` is by three
/// derivatives as `c (x - q)^k + d` near a flat place `q`, a root. Elsewhere Halley's again, but at most twice Newton's.
#[inline(never)]
const fn step(slope: f32, bend: f32, twist: f32, missing: f32) -> f32 {
    let (newton, curve) = (slope * slope, bend * missing);
    let mut halley = newton + curve;
    // From outside a flat place of order k it is k - 1 over 2k.
    if slope <= 0.0 || curve.abs() > 0.3 * newton {
        let (square, other) = (bend * bend, 3.0 * slope * twist);
        if other > 0.5 * square && other < 1.8 * square {
            let (two, four) = (2.0 * square - other, 4.0 * square - other);
            let from_flat = slope * bend / two;
            let order = two / four;
            let share = 1.0 + missing * four / (bend * newton);
            let size = share.abs();
            let root = power(size, order);
            let root = if share < 0.0 { -root } else { root };
            return from_flat * (root - 1.0);
        }
        if halley < 0.5 * newton {
            halley = 0.5 * newton;
        }
    }
    missing * slope / halley
}

/// `x^y` for `x > 0` and `y` in [0, 1], to a few percent: floats are nearly logarithms.
const fn power(x: f32, y: f32) -> f32 {
    const ONE: i32 = 1.0f32.to_bits() as i32;
    const MEAN: f32 = 0.045 * (1 << 23) as f32;
    f32::from_bits((ONE + ((x.to_bits() as i32 - ONE) as f32 * y - MEAN * (1.0 - y)) as i32) as u32)
}

/// The `p` in [0, 1] with `S(p) = target`, for an `S` that increases from 0 to at least `target`.
///
/// Iterative refinement: a search in single precision; at its end what is missing, measured in pairs; then a search for
/// that with the polynomial around there, in which single precision is precise. What that polynomial may be mistaken by
/// grows with the way from where it was measured, by `drift`; once that is [`Enough`], the search is over, or else it is
/// measured again.
///
/// The search is one of steps inside a bracket, and of bisection where a step leaves it or where, after [`NEWTON`]
/// evaluations, the bracket is wider than bisection alone would have left it. It ends with neighbours at the latest.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: &Series<N>,
    target: Wide,
    seed: Seed,
    enough: Enough,
) -> Root {
    let Seed { mut x, shift } = seed;
    let beyond = if shift > FIRST_TERM { shift - FIRST_TERM } else { 0 };
    let up = -(target.e + 63);
    let goal = Pair::significand(target);
    // The polynomial around `origin`, what is sought with it, and by how much a step from there may be mistaken.
    let (mut c, mut origin, mut sought, mut drift) = (near(series, shift, up), 0.0, goal.hi, 1.0);
    let (mut low, mut high) = (0.0, power_of_two(if shift < FARTHEST { shift } else { FARTHEST }));
    let mut evaluations = 0;
    let step = 'found: loop {
        let mut way: f32 = x - origin;
        let mut local = at(&c, way);
        evaluations += 1;
        let mut missing = sought - local.value;
        let step = loop {
            let step = local.step(missing);
            let error = if enough.of_place { enough.error * x * local.c[0] } else { enough.error };
            // Terms of four times the target are usual.
            let is_last =
                4.0 * ROUNDING * step.abs() <= error * x && local.left(missing, step) <= error;
            if is_last && drift * (way + step).abs() <= error {
                break 'found step;
            }
            let mistaken = 2.0 * drift * way.abs();
            if missing.abs() + mistaken <= enough.flat {
                break 'found if enough.of_place { local.to_middle(x) } else { 0.0 };
            }
            let is_lost = missing.abs() <= if origin == 0.0 { NEAR } else { mistaken };
            if way == 0.0 || !(is_last || is_lost) {
                break step;
            }
            evaluations += 1;
            let exact = exactly(series, x * power_of_two(beyond - shift));
            let scale = power_of_two(up - beyond);
            let taken = sought - missing;
            missing = (goal.hi - exact.value.hi * scale) + (goal.lo - exact.value.lo * scale);
            drift = ROUNDING * (exact.size * scale) / x;
            if origin != 0.0 {
                // Two measurements tell the slope better, up to what it changes between them.
                local.c[0] += ((sought - missing) - taken) / way;
                drift *= 2.0 * way.abs() / x;
            }
            (c, origin, sought, way) = (local.c, x, missing, 0.0);
        };
        if missing > 0.0 {
            low = x;
        } else {
            high = x;
        }
        // As many as there are `f32` in the bracket.
        let width = high.to_bits() - low.to_bits();
        // One more time round may take two evaluations.
        if width <= 1 || evaluations >= MAX_EVALUATIONS - 1 {
            break if step.abs() < high - low { step } else { 0.0 };
        }
        let next = x + step;
        x = if evaluations >= NEWTON && width > 1 << 30 >> ((evaluations + 1 - NEWTON) / 2) {
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

impl Root {
    /// `p = 0`.
    pub(crate) const START: Self = Self { x: 0.0, rest: 0.0, shift: 0, evaluations: 0 };

    /// The series' value here, in units of a power of two, and its exponent.
    #[inline(always)]
    pub(crate) const fn value<const N: usize>(&self, series: &Series<N>) -> (Pair, i32) {
        let shift = if self.shift < FIRST_TERM { self.shift } else { FIRST_TERM };
        let scale = power_of_two(-shift);
        let p = self.x * scale;
        let Pair { hi, lo } = exactly(series, p).value;
        let slope = slope_at(series, p);
        (Pair { hi, lo: lo + slope * (self.rest * scale) }, shift - self.shift)
    }
}
