//! The search: where a series reaches a target, and the proof that it does.
//!
//! A series `S` here increases along the ramp and is known twice: in pairs from one end of the ramp, to measure by, and
//! in single precision from an [`Anchor`] near the target, to search by. One search is
//!
//! 1. Halley's steps in single precision, none too long, until hardly anything is missing;
//! 2. what is missing, measured in pairs;
//! 3. one more step for that, and a computed bound of what it leaves, which accepts the answer or not.
//!
//! If that is too great, 2 and 3 are repeated from the place that was reached. A search also ends at the anchor itself,
//! if the target is within half of the error of it, and at the cap on evaluations, which no search is known to reach.
//! At the cap the answer is the last place that was measured, without a proof.
//!
//! **The bound.** Let `c` be the anchor's coefficients, `x` the distance from it, `d_k` the Taylor coefficients there,
//! and `r` what is missing. After a step `s` there is missing `r - d_1 s - d_2 s² - ...`, the k-th term being `Σ_j
//! C(j,k) c_j x^(j-k) s^k`. Let `Y = |x| + |s|` and `E = Σ_{j>=3} j |c_j| Y^(j-3)`. From the third on the terms are
//! together at most `3.4 E |s|³`, because `Σ_{k>=3} C(j,k) |x|^(j-k) |s|^k <= C(j,3) |s|³ Y^(j-3)`, and `C(j,3) <= 10/3
//! j`. The first two are known in single precision: wrong by at most `ρ |s| D`, where `D = |c_1| + 2 |c_2| Y + E Y²`
//! bounds all slopes on the way. From the end that faces the side `ρ` is 2⁻²⁰, because at most 14 roundings of 2⁻²⁴
//! lead to them, 11 of Horner's rule. From the other end the place's distance is rounded, too, which makes 19, and `ρ` is
//! 1.25 · 2⁻²⁰. From a minimum inside it is rounded twice, and `c_5` may be a difference of greater numbers, which makes
//! 45, and `ρ` is 3 · 2⁻²⁰. A time, of degree 3, takes 10 at most. Where `x` is itself rounded, by `m`, the slopes are
//! wrong by `5 m (2 |c_2| + E Y)` more, since `j - 1 <= 5`. So what is left is at most
//!
//! `|r - s (d_1 + d_2 s)| + |s| (ρ D + 5 m (2 |c_2| + E Y) + 3.4 E s²)`
//!
//! and the error of `r` itself: 2⁻⁴¹ of the sum of the series' terms without their signs ([`Series::at`]). A
//! non-negative polynomial's increasing integral bounds that sum (Markov): for degree 6 it is at most 1083 times the
//! series, the greatest quotient of the integrals over [-1, 0] and [0, 1] of `x s²` or `(1 - x) s²` with a quadratic
//! `s`. So `r` is wrong by less than 2⁻³⁰ of the target, within the quarter of an error of 2⁻²⁶ that is left for it. A
//! search for a smaller error is as exact as pairs are; where a step is within an ulp of its place, there is no better
//! one, and the greater error is asked for.
//!
//! `proofs/solve.py` and `proofs/markov.py` check all of that, for each kind of anchor.
//!
//! **The end.** After `FREE` evaluations each measured place halves a bracket of certain signs. When that is as narrow
//! as neighbouring `f32`, `s` is at most 2⁻²³ of the place, and the place times `D` is at most 6 · 1083 times the target,
//! or twice that. So the bound's terms without `r` are below 2⁻³⁰ of the target from the end that faces the side, below
//! 2⁻²⁹ from the other end, and below 2⁻²⁷ from a minimum inside, and the step, which solves the first two terms, is
//! accepted. That it stays in the bracket where the density nearly vanishes is known by search only. Hence
//! [`MAX_EVALUATIONS`]; the searches of the tests take 5 at most.

use crate::pair::{Pair, flipped};
use crate::series::Series;

/// How far a ramp goes: places along it count from 0 at one end to this at the other.
///
/// The least `f32` u then still leads to a place that is a normal number, and the last coefficient's second half is
/// one.
pub(crate) const ONE: f32 = (1 << 30) as f32;

/// After so many evaluations all are measured in pairs, and each halves the bracket.
const FREE: u32 = 10;
/// Bisections that bring any bracket between 0 and [`ONE`] down to neighbours, taken by their bits; each takes two
/// evaluations.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes, in single precision and in pairs.
pub const MAX_EVALUATIONS: u32 = FREE + 2 * BISECTION;

/// If less than this share of what is sought is missing, it is measured in pairs. A step of Halley's leaves about a
/// tenth of the cube of that: 2⁻⁴².
const PAIRS_BELOW: f32 = 1.0 / 8192.0;

/// A step in single precision leads to between a quarter of the distance from the anchor and about 2.5 times that:
/// Newton overshoots if the density dips ahead. In the bits of the `f32`, where a binade is 2²³.
const LEAST_STEP: i32 = -2 << 23;
const GREATEST_STEP: i32 = (1 << 23) + (1 << 21);

/// What rounding makes of the first two Taylor coefficients, as a share of their terms: see the module's text.
// proofs/solve.py
pub(crate) const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// The distance from the anchor may be rounded by this share of it.
const MOVED: f32 = 1.0 / (1 << 16) as f32;

/// The distance between neighbours, relative to them, at most.
const ULP: f32 = f32::EPSILON;

/// Where a search starts: a place on the ramp, and the series around it in the direction of the target.
pub(crate) struct Anchor<const N: usize> {
    pub(crate) place: Pair,
    /// The direction: the sign bit if it is back, 0 if not.
    pub(crate) back: u32,
    /// What is collected from here, by powers of the distance.
    pub(crate) c: [f32; N],
    /// What is to be collected from here.
    pub(crate) sought: f32,
    /// How often rounding may count in slopes.
    pub(crate) rounding: f32,
}

impl<const N: usize> Anchor<N> {
    /// How far from the anchor a place is.
    #[inline(always)]
    const fn distance(&self, p: f32) -> f32 {
        flipped((p - self.place.hi) - self.place.lo, self.back)
    }

    /// How far the ramp goes on.
    #[inline(always)]
    const fn reach(&self) -> f32 {
        if self.back == 0 { ONE - self.place.hi } else { self.place.hi }
    }
}

/// Where a search ended: at the place `x + rest`.
#[derive(Clone, Copy)]
pub(crate) struct Offset {
    pub(crate) x: f32,
    pub(crate) rest: f32,
    pub(crate) evaluations: u32,
}

impl Offset {
    /// The series' value there. The second term is at most N · 2⁻²⁴ of the sum of the series' terms without their
    /// signs, so single precision is enough for it: the value is within 2⁻⁴⁰ of that sum (`proofs/series.py`).
    #[inline(always)]
    pub(crate) const fn value(&self, series: Series) -> Pair {
        let Pair { hi, lo } = series.at(self.x);
        Pair { hi, lo: lo + series.slope(self.x) * self.rest }
    }
}

/// The first Taylor coefficients around a place.
struct Taylor {
    value: f32,
    d1: f32,
    d2: f32,
}

impl Taylor {
    /// Of `c[0] x + c[1] x² + ...`, by synthetic division: each pass of Horner's rule leaves one more coefficient.
    #[inline(always)]
    const fn new<const N: usize>(c: &[f32; N], x: f32) -> Self {
        let mut c = *c;
        horner(&mut c, x, 0);
        let value = c[0] * x;
        horner(&mut c, x, 0);
        horner(&mut c, x, 1);
        Self { value, d1: c[0], d2: c[1] }
    }

    /// The step to make up for `missing`: Halley's `n / (1 + b)`, from Newton's step `n`. A division is slow, so it is
    /// the quotient's series up to `b²`; but not beyond `b = 1/2`, from where the series grows again and a search may
    /// swing.
    #[inline(always)]
    const fn step(&self, missing: f32) -> f32 {
        // If rounding makes the slope negative, the step still leads towards the target.
        let inverse = 1.0 / self.d1.abs();
        let newton = missing * inverse;
        let bend = self.d2 * newton * inverse;
        if bend > 0.5 { newton / (1.0 + bend) } else { newton * (1.0 - bend * (1.0 - bend)) }
    }

    /// The same for a step that is tiny.
    #[inline(always)]
    const fn short_step(&self, missing: f32) -> f32 {
        let inverse = 1.0 / self.d1;
        let newton = missing * inverse;
        newton * (1.0 - self.d2 * newton * inverse)
    }
}

/// Horner's rule at `x`, down to the coefficient `to`; each sum replaces its coefficient.
#[inline(always)]
const fn horner<const N: usize>(c: &mut [f32; N], x: f32, to: usize) {
    let mut k = N - 1;
    while k > to {
        k -= 1;
        c[k] += c[k + 1] * x;
    }
}

/// The bound of what is left after the step `s`, if `x` is rounded by `moved`: see the module's text.
#[inline(always)]
const fn left<const N: usize>(
    c: &[f32; N],
    [x, moved]: [f32; 2],
    local: &Taylor,
    missing: f32,
    s: f32,
    rounding: f32,
) -> f32 {
    let c = core::hint::black_box(c);
    let size = s.abs();
    let y = x.abs() + size;
    let (mut cubes, mut j) = (0.0, N);
    while j > 2 {
        cubes = cubes * y + j as f32 * c[j - 1].abs();
        j -= 1;
    }
    let bends = cubes * y + 2.0 * c[1].abs();
    let slopes = bends * y + c[0].abs();
    let first = (missing - s * (local.d1 + local.d2 * s)).abs();
    first + size * (rounding * slopes + 5.0 * moved.abs() * bends + 3.4 * cubes * (s * s))
}

/// The place where `series` reaches `target` within the error `wanted`, of which a quarter is for measuring; within
/// `accepted` if the last step is less than an ulp of its place, since there is no better answer then.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: Series,
    target: Pair,
    anchor: &Anchor<N>,
    guess: f32,
    [wanted, accepted]: [f32; 2],
) -> Offset {
    let Anchor { place, back, c, sought, rounding } = *anchor;
    // The anchor itself, whose mass is known as well as any is measured.
    if sought <= 0.5 * wanted {
        return Offset { x: place.hi, rest: place.lo, evaluations: 0 };
    }
    let in_pairs = (PAIRS_BELOW * sought + wanted).to_bits() as i32;
    let reach = anchor.reach();
    // At the end of the ramp the density may be 0.
    let mut x = if guess < 0.75 * reach { guess } else { 0.75 * reach };
    let reach = reach.to_bits() as i32;
    // The place, once it is measured in pairs.
    let mut p = f32::NAN;
    let mut moved = 0.0;
    // The bracket, by bits, since that is how it is halved.
    let (mut low, mut high) = (0, ONE.to_bits() as i32);
    let mut evaluations = 0;
    loop {
        let local = Taylor::new(&c, x);
        evaluations += 1;
        if p.is_nan() {
            let missing = sought - local.value;
            if missing.abs().to_bits() as i32 > in_pairs && evaluations < FREE {
                // By bits, so that the step of a NaN is one of the limits, too.
                let next = (x + local.step(missing)).to_bits() as i32;
                let bits = x.to_bits() as i32;
                let (least, most) = (bits + LEAST_STEP, bits + GREATEST_STEP);
                // Not below 0.
                let least = least & !(least >> 31);
                let most = if most < reach { most } else { reach };
                let next = if next < least { least } else { next };
                x = f32::from_bits(if next < most { next } else { most } as u32);
                continue;
            }
            // Only a place that is an `f32` can be measured.
            p = place.hi + flipped(x, back);
            let distance = anchor.distance(p);
            moved = distance - x;
            if moved.abs() > MOVED * x {
                (x, moved) = (distance, 0.0);
                continue;
            }
        }
        // In pairs the sign of what is missing is certain.
        let missing = target.difference(series.at(p));
        evaluations += 1;
        *(if missing > 0.0 { &mut low } else { &mut high }) = p.to_bits() as i32;
        let missing = flipped(missing, back);
        let step = local.short_step(missing);
        let way = flipped(step, back);
        let end = p + way;
        // A NaN is beyond.
        let bits = end.to_bits() as i32;
        let is_inside = bits >= low && bits <= high;
        let error = if step.abs() <= ULP * p { accepted } else { wanted };
        if is_inside && left(&c, [x, moved], &local, missing, step, rounding) <= 0.75 * error {
            let Pair { hi, lo } = Pair::sum(p, way);
            return Offset { x: hi, rest: lo, evaluations };
        }
        if evaluations >= MAX_EVALUATIONS - 1 {
            return Offset { x: p, rest: 0.0, evaluations };
        }
        // The middle by bits, so that half of the `f32` in the bracket lie on either side.
        let middle = f32::from_bits((low + (high - low) / 2) as u32);
        p = if is_inside && evaluations < FREE { end } else { middle };
        (x, moved) = (anchor.distance(p), 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `c[0] x + c[1] x² + ...` in doubles.
    fn value(c: &[f32; 6], x: f64) -> f64 {
        c.iter().rev().fold(0.0, |value, c| (value + f64::from(*c)) * x)
    }

    /// What is missing after a step never exceeds its bound.
    #[test]
    fn the_bound_holds() {
        let mut bits = 1u32;
        let mut next = || {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (bits >> 8) as f32 / (1 << 24) as f32
        };
        for _ in 0..100_000 {
            // Coefficients of either sign that differ by powers of ten, and some that are 0.
            let c: [f32; 6] = core::array::from_fn(|_| {
                let size = [0.0, 1e-6, 1e-3, 1.0, 1e3][(5.0 * next()) as usize];
                size * (next() - 0.5)
            });
            let x = 2.0 * next();
            let step = (next() - 0.5) * [1.0, 1e-2, 1e-4][(3.0 * next()) as usize];
            let local = Taylor::new(&c, x);
            let exact = value(&c, f64::from(x) + f64::from(step)) - value(&c, f64::from(x));
            // All but the third term and those beyond.
            let missing = step * (local.d1 + local.d2 * step);
            let after = (f64::from(missing) - exact).abs();
            let bound = f64::from(left(&c, [x, 0.0], &local, missing, step, ROUNDING));
            assert!(
                after <= bound,
                "{after:e} after a step of {step}, bound {bound:e}: {c:?} at {x}"
            );
        }
    }

    /// What `proofs/solve.py` takes for the slopes and the bound is what they are.
    #[test]
    fn the_bound_is_as_transcribed() {
        for row in crate::pair::tests::numbers(include_str!("../proofs/vectors/left.csv")) {
            let [c1, c2, c3, c4, c5, c6, x, moved, missing, s, d1, d2, bound] = row;
            let c = [c1, c2, c3, c4, c5, c6];
            let local = Taylor::new(&c, x);
            assert_eq!([local.d1, local.d2], [d1, d2]);
            assert_eq!(left(&c, [x, moved], &local, missing, s, ROUNDING), bound);
        }
    }
}
