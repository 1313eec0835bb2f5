//! The search: the place on a ramp where a series reaches a target, with a computed bound of its error.
//!
//! A series increases along the ramp. It is known twice: in pairs from one end of the ramp, to measure by, and in
//! single precision from an [`Anchor`], the end that is nearer to the target, to search by. A search
//!
//! 1. takes Halley's steps in single precision, each of limited length, until some 2⁻¹³ of `sought` is missing
//!    ([`Anchor::approach`]),
//! 2. measures in pairs what is missing,
//! 3. takes one more step, and accepts it if a bound of what it leaves ([`left`]) is small enough; else goes on with 2.
//!
//! Where a step leads out of the bracket, and after [`FREE_EVALUATIONS`], the next place is its middle. Between
//! neighbouring `f32` a step is less than an ulp, and [`left`] accepts it. That the step stays between them is not
//! proven, so [`MAX_EVALUATIONS`] end a search; then its place has no bound. No search in the tests comes to that.

pub(crate) mod guess;

use crate::number::pair::{Pair, flipped};
use crate::number::series::Series;
use crate::number::units::LAST_PLACE;
use guess::guess;

/// After so many evaluations each further place halves the bracket. Few searches take as many: on a density that is
/// dark at both ends, where its inner times cross, 55 in all were seen.
const FREE_EVALUATIONS: u32 = 10;
/// So many halvings of its bits bring any bracket in 0 to [`LAST_PLACE`] down to neighbours.
const BISECTION: u32 = 31;
/// The most steps of a search. Each step evaluates a ramp's integral once, in `f32` or as the sum of two `f32`.
// A bisection takes one of each, and before the first one `FREE_EVALUATIONS` may be exceeded by 2.
pub const MAX_EVALUATIONS: u32 = FREE_EVALUATIONS + 2 + 2 * BISECTION;

/// If no more than this share of what is sought is missing, it is measured in pairs. The next step leaves about the
/// share's cube, far less than any error.
const PAIRS_BELOW: f32 = 1.0 / 8192.0;

/// A step in single precision multiplies the distance from the anchor by 1/4 to about 2.5, since Newton overshoots
/// where the slope dips ahead. In bits of the distance, where 2²³ is a factor of two.
const LEAST_STEP: i32 = -2 << 23;
const GREATEST_STEP: i32 = (1 << 23) + (1 << 21);

/// The rounding error of `d1` and `d2` ([`Taylor`]), as a share of their terms: from the end from which the pairs
/// count, and from the other one, where the distance is rounded, too.
// proofs/solve.py
pub(crate) const ROUNDING_SAME: f32 = 1.0 / (1 << 20) as f32;
const ROUNDING_OTHER: f32 = 1.25 * ROUNDING_SAME;

/// If rounding the place to an `f32` moves the distance by less than this share, the slopes are kept. From the same end
/// nothing moves, and only masses are searched from the other end. For a last step of some 2⁻¹³ of what is sought
/// [`left`] then adds some 5 · 2⁻¹⁶ · 2⁻¹³ = 0.63 · 2⁻²⁶, which fits into 3/4 of a mass's error of 2⁻²⁶.
const MOVED: f32 = 1.0 / (1 << 16) as f32;

/// Where a search starts: an end of the ramp, and the series from there.
pub(crate) struct Anchor<const N: usize> {
    /// 0, or [`LAST_PLACE`] at the other end than that from which the pairs count: from there distances count back.
    pub(crate) place: f32,
    /// The series by powers of the distance from here.
    pub(crate) c: [f32; N],
    /// What it has to reach, at least 0.
    pub(crate) sought: f32,
}

impl<const N: usize> Anchor<N> {
    /// The distance of a place from here, and the place at a distance.
    #[inline(always)]
    const fn mirrored(&self, x: f32) -> f32 {
        (self.place - x).abs()
    }

    /// Steps from the guess until [`PAIRS_BELOW`] of what is sought is missing, or [`FREE_EVALUATIONS`] are used up.
    /// Returns the series around the last distance, and the evaluations.
    #[inline(always)]
    const fn approach(&self, error: f32) -> (Taylor, u32) {
        // With the error, which may be left anyway. In bits: comparing integers does not wait for the FPU, and a NaN
        // counts as too much.
        let stop_below_bits = (PAIRS_BELOW * self.sought + error).to_bits() as i32;
        const LAST_BITS: i32 = LAST_PLACE.to_bits() as i32;
        let guess = guess(&self.c, self.sought);
        // Not to the other end, where the slope may be 0. A later step may lead there, and the next one back.
        let mut x = if guess < 0.75 * LAST_PLACE { guess } else { 0.75 * LAST_PLACE };
        let mut evaluations = 0;
        loop {
            let local = Taylor::new(&self.c, x);
            evaluations += 1;
            let missing = self.sought - local.value;
            if missing.abs().to_bits() as i32 <= stop_below_bits || evaluations >= FREE_EVALUATIONS {
                return (local, evaluations);
            }
            // In bits, so that the limits stop a NaN, too. That may have either sign, by machine: as 0 it is the least
            // step.
            let next = (x + local.step(missing)).to_bits() as i32;
            let next = if next > f32::INFINITY.to_bits() as i32 { 0 } else { next };
            let bits = x.to_bits() as i32;
            let (least, most) = (bits + LEAST_STEP, bits + GREATEST_STEP);
            let least = least & !(least >> 31); // max(least, 0)
            let most = if most < LAST_BITS { most } else { LAST_BITS };
            let next = if next < least { least } else { next };
            x = f32::from_bits(if next < most { next } else { most } as u32);
        }
    }
}

/// What a search found.
pub(crate) struct Found {
    pub(crate) place: Pair,
    #[cfg_attr(not(feature = "_measure"), allow(dead_code))]
    pub(crate) evaluations: u32,
}

/// The first Taylor coefficients around `x`: `S`, `S'` and `S'' / 2`.
pub(crate) struct Taylor {
    x: f32,
    pub(crate) value: f32,
    pub(crate) d1: f32,
    pub(crate) d2: f32,
}

impl Taylor {
    /// Of `S = c[0] x + c[1] x² + ... = x Q`, by synthetic division.
    #[inline(always)]
    pub(crate) const fn new<const N: usize>(c: &[f32; N], x: f32) -> Self {
        let mut c = *c;
        horner(&mut c, x, 0); // c[0] = Q
        let value = c[0] * x;
        horner(&mut c, x, 0); // c[0] = Q + x Q' = S'
        horner(&mut c, x, 1); // c[1] = S'' / 2
        Self { x, value, d1: c[0], d2: c[1] }
    }

    /// Halley's step for `missing`: `n / (1 + b)`, with Newton's step `n` and `b = n d2 / d1`. Up to `b = 1/2` it is
    /// `n (1 - b + b²)`, since a division is slow. Beyond, that would grow again, and a search might swing.
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        // Towards the target, even if rounding makes the slope negative.
        let inverse = 1.0 / self.d1.abs();
        let newton = missing * inverse;
        let bend = self.d2 * newton * inverse;
        if bend > 0.5 { newton / (1.0 + bend) } else { newton * (1.0 - bend * (1.0 - bend)) }
    }

    /// Halley's step for a tiny `missing`: `n (1 - b)`.
    #[inline(always)]
    pub(crate) const fn short_step(&self, missing: f32) -> f32 {
        let inverse = 1.0 / self.d1;
        let newton = missing * inverse;
        newton * (1.0 - self.d2 * newton * inverse)
    }
}

/// One pass of Horner's rule at `x`, down to `c[to]`; each sum replaces its coefficient.
#[inline(always)]
const fn horner<const N: usize>(c: &mut [f32; N], x: f32, to: usize) {
    let mut k = N - 1;
    while k > to {
        k -= 1;
        c[k] += c[k + 1] * x;
    }
}

/// A bound of what is missing after the step `s` from `x + moved`, by the series around `x`:
///
/// ```text
///   |missing - s (d1 + d2 s)|    left by the first two Taylor terms, as they are computed
/// + |s| rounding slopes          their rounding
/// + |s| 5 |moved| squares        what `moved` changes of them
/// + |s| 3.4 cubes s²             all further terms
/// ```
///
/// where `y = x + |s|`, `cubes = Σ_{j>=3} j |c_j| y^(j-3)`, `squares = 2 |c_2| + cubes y`,
/// `slopes = |c_1| + squares y`, and `c_j` is `c[j - 1]`. On the way, within `y`, the slope is at most `slopes`; as
/// `j <= 6`, the second derivative is at most `5 squares` and the third `20 cubes`. So Taylor's rest is at most
/// `20/6 cubes |s|³`. (`moved` may lead beyond `y`, by 2⁻¹⁶ of `x` at most: `rounding` and 3.4 have room for that.)
// proofs/solve.py
#[inline(always)]
pub(crate) const fn left<const N: usize>(
    c: &[f32; N],
    local: &Taylor,
    moved: f32,
    missing: f32,
    s: f32,
    rounding: f32,
) -> f32 {
    // Loaded anew, or the compiler would keep all of `c` in registers.
    let c = core::hint::black_box(c);
    let size = s.abs();
    let y = local.x + size;
    let (mut cubes, mut j) = (0.0, N);
    while j > 2 {
        cubes = cubes * y + j as f32 * c[j - 1].abs();
        j -= 1;
    }
    let squares = cubes * y + 2.0 * c[1].abs();
    let slopes = squares * y + c[0].abs();
    let first = (missing - s * (local.d1 + local.d2 * s)).abs();
    first + size * (rounding * slopes + 5.0 * moved.abs() * squares + 3.4 * cubes * (s * s))
}

/// The place where `series` reaches `target`, within `error`. The last step leaves at most 3/4 of that; the last
/// quarter is for measuring. At the limit of evaluations there is no bound.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(series: Series, target: Pair, anchor: &Anchor<N>, error: f32) -> Found {
    let Anchor { place, ref c, sought } = *anchor;
    // The anchor itself.
    if sought <= 0.5 * error {
        return Found { place: Pair::new(place), evaluations: 0 };
    }
    let (rounding, sign) = if place > 0.0 { (ROUNDING_OTHER, 1 << 31) } else { (ROUNDING_SAME, 0) };
    let (mut local, mut evaluations) = anchor.approach(error);
    // Pairs measure at a place `p` that is an `f32`. `LAST_PLACE - x` may not be one, so `p` lies at `x + moved` from
    // the anchor. If that is far from `x`, the slopes differ.
    let mut p = anchor.mirrored(local.x);
    let mut distance = anchor.mirrored(p);
    let mut moved = distance - local.x;
    let mut needs_slopes = moved.abs() > MOVED * local.x;
    // The bracket, by the bits of its ends: so a half of it has half of its `f32`, and a NaN is outside.
    let (mut low, mut high) = (0, LAST_PLACE.to_bits() as i32);
    loop {
        if needs_slopes {
            (local, moved) = (Taylor::new(c, distance), 0.0);
            evaluations += 1;
        }
        let missing = target.difference(series.at(p));
        evaluations += 1;
        *(if missing > 0.0 { &mut low } else { &mut high }) = p.to_bits() as i32;
        // What is missing from one end is too much from the other.
        let missing = flipped(missing, sign);
        let step = local.short_step(missing);
        let way = flipped(step, sign);
        let next = p + way;
        let is_inside = next.to_bits() as i32 >= low && next.to_bits() as i32 <= high;
        // Measuring is off by at most 2⁻³² of the target (proofs/solve.py), less than a quarter of its least error,
        // 2⁻²⁸.
        if is_inside && left(c, &local, moved, missing, step, rounding) <= 0.75 * error {
            return Found { place: Pair::sum(p, way), evaluations };
        }
        // Another round would take two.
        if evaluations >= MAX_EVALUATIONS - 1 {
            return Found { place: Pair::new(p), evaluations };
        }
        let middle = f32::from_bits((low + (high - low) / 2) as u32);
        p = if is_inside && evaluations < FREE_EVALUATIONS { next } else { middle };
        (distance, needs_slopes) = (anchor.mirrored(p), true);
    }
}
