//! The search: the place on a ramp where a series reaches a target, and the proof that it does.
//!
//! A series here increases along the ramp and is known twice: in pairs from one end of the ramp, to measure by, and
//! in single precision from an [`Anchor`] near the target, to search by. One search is
//!
//! 1. Halley's steps in single precision, none too long, until hardly anything is missing;
//! 2. what is missing, measured in pairs;
//! 3. one more step for that, and a computed bound of what it leaves ([`left`]), which accepts the answer or not.
//!
//! If that is too great, 2 and 3 are repeated from the place that was reached. A search also ends at the anchor itself,
//! if the target is within half of the wanted error of what the anchor has, and at the cap on evaluations.
//!
//! After `FREE_EVALUATIONS` evaluations each measured place halves a bracket. The sign of what is missing at its ends is known, but
//! for the noise of measuring. Once these are neighbouring `f32`, a step between them is accepted: its bound is at most
//! 2⁻²⁷·⁷ of a mass that is sought, and 2⁻³⁶·⁶ of a time (docs/proofs.md, "The end of a search"). That the step stays
//! between them is not proven: where next to no light falls, what is missing may be noise alone. No search for an
//! `f32` is known to reach the cap. A few for ticks do: they ask for less than the noise there, so they go on until
//! the bracket is so narrow that a step of noise leaves it. Then the answer is the last place that was measured,
//! without a proof.

pub(crate) mod guess;

use crate::number::pair::{Pair, flipped};
use crate::number::series::Series;
use crate::number::units::LAST_PLACE;

/// After so many evaluations, twice what any search for an `f32` in the tests takes, every place is measured in pairs,
/// and each halves the bracket.
const FREE_EVALUATIONS: u32 = 10;
/// Bisections that bring any bracket between 0 and [`LAST_PLACE`] down to neighbours, taken by their bits; each takes
/// two evaluations, of the slopes and in pairs. What was measured before the first may have brought `FREE_EVALUATIONS` up to 2 more.
const BISECTION: u32 = 31;
/// The most evaluations of the polynomial that one search takes, in single precision and in pairs.
pub const MAX_EVALUATIONS: u32 = FREE_EVALUATIONS + 2 + 2 * BISECTION;

/// If less than this share of what is sought is missing, it is measured in pairs. A step of Halley's leaves about a
/// tenth of the cube of that: 2⁻⁴².
const PAIRS_BELOW: f32 = 1.0 / 8192.0;

/// A step in single precision leads to between a quarter of the distance from the anchor and about 2.5 times that:
/// Newton overshoots if the density dips ahead. In the bits of the `f32`, where a binade is 2²³.
const LEAST_STEP: i32 = -2 << 23;
const GREATEST_STEP: i32 = (1 << 23) + (1 << 21);

/// What rounding makes of the first two Taylor coefficients, as a share of their terms, around the end of the ramp from
/// which the pairs count; around a mass's other anchors it is more ([`Anchor::rounding`]).
// proofs/solve.py
pub(crate) const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// The distance from the anchor may be rounded by this share of it. Five times that (see [`left`]) of a step of
/// [`PAIRS_BELOW`] is still less than 0.75 · 2⁻²⁶, which a search for an `f32` may leave.
const MOVED: f32 = 1.0 / (1 << 16) as f32;

/// The distance between neighbours, relative to them, at most.
const ULP: f32 = f32::EPSILON;

/// Where a search starts: a place on the ramp, and the series around it in the direction of the target.
pub(crate) struct Anchor<const N: usize> {
    pub(crate) place: Pair,
    /// The direction: the sign bit if it is back, 0 if not.
    pub(crate) back: u32,
    /// The series from here, by powers of the distance.
    pub(crate) c: [f32; N],
    /// What it has to reach.
    pub(crate) sought: f32,
    /// See [`ROUNDING`].
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
        if self.back == 0 { LAST_PLACE - self.place.hi } else { self.place.hi }
    }
}

/// The first Taylor coefficients around a place.
pub(crate) struct Taylor {
    pub(crate) value: f32,
    /// The slope, and half of the second derivative.
    pub(crate) d1: f32,
    pub(crate) d2: f32,
}

impl Taylor {
    /// Of `S = c[0] x + c[1] x² + ...`, by synthetic division. With `S = x Q`, the first pass of Horner's rule leaves
    /// `Q`, the second `Q + x Q' = S'`, and the third, one place up, `S'' / 2`.
    #[inline(always)]
    pub(crate) const fn new<const N: usize>(c: &[f32; N], x: f32) -> Self {
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
    pub(crate) const fn short_step(&self, missing: f32) -> f32 {
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

/// A bound of what is missing after the step `s`, from `x`, which may be rounded by `moved`. With `Y = |x| + |s|`,
/// `E = Σ_{j>=3} j |c_j| Y^(j-3)`, and `D = |c_1| + 2 |c_2| Y + E Y²`, which bounds all slopes on the way, it is
///
/// `|missing - s (d_1 + d_2 s)| + |s| (rounding D + 5 |moved| (2 |c_2| + E Y) + 3.4 E s²)`.
///
/// The first term is what the step leaves of the first two Taylor terms as they are known, the second what is not known
/// of these, the third what `moved` does to them, and the fourth bounds all further ones. (`c_j` is `c[j - 1]`; 5 is
/// the greatest `j - 1`, and 3.4 a little more than the greatest `C(j,3) / j`.) Below, `cubes` is `E`, `bends` is `2
/// |c_2| + E Y`, and `slopes` is `D`.
// proofs/solve.py, for each kind of anchor
#[inline(always)]
pub(crate) const fn left<const N: usize>(
    c: &[f32; N],
    [x, moved]: [f32; 2],
    local: &Taylor,
    missing: f32,
    s: f32,
    rounding: f32,
) -> f32 {
    // Loaded anew, or the compiler would keep all of them in registers for this.
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

/// The place where `series` reaches `target`, and the evaluations that took: within the error `wanted`, and what
/// measuring adds; within `accepted` if the last step is less than an ulp of its place, since another round would measure
/// at the same `f32`, and its bound would be the same.
#[inline(always)]
pub(crate) const fn solve<const N: usize>(
    series: Series,
    target: Pair,
    anchor: &Anchor<N>,
    guess: f32,
    [wanted, accepted]: [f32; 2],
) -> (Pair, u32) {
    let Anchor { place, back, c, sought, rounding } = *anchor;
    // Exit: the anchor itself, whose mass is known as well as any is measured.
    if sought <= 0.5 * wanted {
        return (place, 0);
    }
    // Compared by bits, since an integer comparison does not wait for the FPU, and a NaN is then too much.
    let hardly_any = (PAIRS_BELOW * sought + wanted).to_bits() as i32;
    let reach = anchor.reach();
    let mut evaluations = 0;
    // The distance from the anchor. At the end of the ramp the density may be 0.
    let mut x = if guess < 0.75 * reach { guess } else { 0.75 * reach };
    let most_reach = reach.to_bits() as i32;
    let mut local;
    loop {
        local = Taylor::new(&c, x);
        evaluations += 1;
        let missing = sought - local.value;
        if missing.abs().to_bits() as i32 <= hardly_any || evaluations >= FREE_EVALUATIONS {
            break;
        }
        // By bits, so that the step of a NaN is one of the limits, too.
        let next = (x + local.step(missing)).to_bits() as i32;
        let bits = x.to_bits() as i32;
        let (least, most) = (bits + LEAST_STEP, bits + GREATEST_STEP);
        // Not below 0.
        let least = least & !(least >> 31);
        let most = if most < most_reach { most } else { most_reach };
        let next = if next < least { least } else { next };
        x = f32::from_bits(if next < most { next } else { most } as u32);
    }
    // Only a place that is an `f32` can be measured. If that is far from `x`, the slopes are those of another place.
    let mut p = place.hi + flipped(x, back);
    let distance = anchor.distance(p);
    let mut moved = distance - x;
    let mut needs_slopes = moved.abs() > MOVED * x;
    if needs_slopes {
        (x, moved) = (distance, 0.0);
    }
    // The bracket, by bits, since that is how it is halved.
    let (mut low, mut high) = (0, LAST_PLACE.to_bits() as i32);
    loop {
        if needs_slopes {
            local = Taylor::new(&c, x);
            evaluations += 1;
        }
        // In pairs the sign of what is missing is certain, but for the noise of measuring.
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
        // Exit: the bound accepts the step. A quarter of the error is left for measuring, which is proven to take
        // 2⁻³⁰·⁹ at most (proofs/solve.py, at its end, by the constant of proofs/markov.py): enough for errors of 2⁻²⁸
        // and more, while a tick's is finer.
        if is_inside && left(&c, [x, moved], &local, missing, step, rounding) <= 0.75 * error {
            return (Pair::sum(p, way), evaluations);
        }
        // Exit: the cap. Nothing is proven of this answer.
        if evaluations >= MAX_EVALUATIONS - 1 {
            return (Pair::new(p), evaluations);
        }
        // The middle by bits, so that half of the `f32` in the bracket lie on either side.
        let middle = f32::from_bits((low + (high - low) / 2) as u32);
        p = if is_inside && evaluations < FREE_EVALUATIONS { end } else { middle };
        (x, moved, needs_slopes) = (anchor.distance(p), 0.0, true);
    }
}
