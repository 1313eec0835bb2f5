//! The certificate of an octave: what its errors may be, and whether their bounds are within that.

use crate::fraction::Side::{self, End, Start};
use crate::number::units::{exponent, floor_bits, power_of_two};
use crate::octave::bound::{EFFORTS, KINDS, SAMPLE_OFF, Sampled, errors};
use crate::octave::candidate::Candidate;
use crate::octave::path::{Path, View, absolute, scale, singles, value};
use crate::octave::span::Span;

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp. The time
/// counts as no more than the interval ([`View::size_of_time`]), so in an interval of 2²⁴ ticks it is below 0.19 tick.
pub(crate) const FORWARD_ERROR: f32 = 1.5 / (1u32 << 27) as f32;
/// The error in `u` that it may have, in ulp of where its span begins. Neighbouring `u` are at least an ulp of the
/// lesser one apart, so below 1/2 their times cannot change places, also not where one octave follows another.
pub(crate) const ULP_ERROR: f32 = 0.49;

/// How far off a fraction may be: by the first where a look-up rounds a join, and by the second as a share of it on a
/// path, where it is a sum of terms up to 1083 times as great, with 60 roundings of an `f64`.
// proofs/certificate.py
pub(crate) const OFF: [f32; 2] = [1.0 / (1u64 << 54) as f32, 1.0 / (1u64 << 36) as f32];
/// The greatest `x`, in 2³² of its units; a word ends at 1/2.
// proofs/octaves.py
const MOST_OFFSET: f32 = 0.4999;
/// How far off a time may be on a path, as a share of it: it is a sum of terms up to 14 times as great
/// (`proofs/solve.py`), with 9 roundings of an `f64`, counted on paper.
// proofs/certificate.py has their product
const TIME_OFF: f32 = 1.0 / (1u64 << 46) as f32;

/// What rounds the value of a weight, as a share of its coefficients without signs; of the chord of reciprocals, as a
/// share of the greater one.
// proofs/certificate.py
const WEIGHT_OFF: f32 = 1.0 / (1 << 18) as f32;

/// 1, but for what single precision rounds.
const CERTAIN: f32 = 1.0 - 1.0 / (1 << 16) as f32;

impl View<'_> {
    /// Bounds of a polynomial's errors along a stretch of a ramp between two places, as shares of what each may be:
    /// relative to the time, in exposure, and in exposure beyond the ramp. What [`certain`] asks for is that
    /// all are below 1.
    #[inline(never)]
    pub(crate) const fn certificate(
        &self,
        candidate: &Candidate,
        span: &Span,
        mut along: Path,
        ramp: Side,
        [first, last]: [f64; 2],
    ) -> [f32; 3] {
        let Candidate { ref octave, middle, step, steep, truncated } = *candidate;
        let (exposure, side) = (self.exposure, self.side);
        // Factors that make an error, in the time of a coefficient's 1, a share of what it may be.
        let ends = [value(&along.time, -1.0), value(&along.time, 1.0)];
        let (off, ulp) = (
            OFF[0] + OFF[1] * span.to,
            power_of_two(exponent(f32::from_bits(floor_bits(span.from))) - 23),
        );
        let single_step = step as f32;
        // In `f64`, since a faint curve has an area of as little as 2⁻¹²⁶. What `off` leaves is above 0: no span begins
        // below LEAST_TOP / 2.
        // proofs/certificate.py
        let per_exposure = step / exposure.area / (ULP_ERROR * ulp - off) as f64;
        let per_size = [
            single_step / self.size_of_time(ends[0]) / FORWARD_ERROR,
            single_step / self.size_of_time(ends[1]) / FORWARD_ERROR,
        ];
        // In the unit of the coefficients.
        along.time[0] -= middle;
        scale(&mut along.time, 1.0 / step, 1.0);
        let [t0, t1, t2, t3, ..] = singles(&along.time, 0.0, 1.0);
        let [f0, f1, f2, f3, ..] = singles(&along.openness, 0.0, per_exposure);
        let (time, openness) = ([t0, t1, t2, t3], [f0, f1, f2, f3]);
        // The error is relative to a size that follows the time, or is constant. The size's reciprocal is convex in
        // time, so it lies below the chord between both ends, here by powers of `s`.
        let slope = 0.5 * (per_size[1] - per_size[0]) / (t1 + t3);
        let mean = 0.5 * (per_size[0] + per_size[1]);
        let per_size_along = [mean - slope * t2, slope * t1, slope * t2, slope * t3];
        let (center, per_position) = span.offsets();
        let offset = singles(&along.fraction, center, per_position);
        // Only while `x` fits its word are the samples those of a polynomial. It is greatest at an end.
        let [x0, x1, x2, x3, x4, x5, x6] = offset;
        let fits = (x0 + x2 + x4 + x6).abs() + (x1 + x3 + x5).abs() < MOST_OFFSET;
        let is_joined = if ramp.is(side) { last >= 1.0 } else { first <= 0.0 };
        let limits = Limits {
            rounding: truncated
                + SAMPLE_OFF
                + steep * off / span.width
                + (ends[1] / step) as f32 * TIME_OFF,
            per_size: if per_size[0] > per_size[1] { per_size[0] } else { per_size[1] },
            beyond: if is_joined {
                let most = FORWARD_ERROR * (exposure.end(End) - exposure.end(Start));
                (self.greatest_beyond(ramp, most) * per_exposure) as f32
            } else {
                0.0
            },
            time,
            openness,
        };
        let weights = [[1.0, 0.0, 0.0, 0.0], openness, per_size_along];
        // A sample's position is rounded to 1/2 and a trace.
        let noise = limits.rounding + 0.5002 * steep * per_position as f32;
        let (mut effort, mut bounds) = (0, [f32::INFINITY; 3]);
        let (Some(sampled), true) = (Sampled::new(&along), fits) else { return bounds };
        while effort < EFFORTS {
            let errors = errors(octave, &sampled, &offset, &weights, noise, effort);
            bounds = limits.share(&errors.most);
            // If the samples alone are too wrong, no closer bound helps. (As
            // `share` adds what rounding does once more, one might after all, if rarely: then a search answers.)
            effort = if certain(&bounds) || !certain(&limits.share(&errors.least)) {
                EFFORTS
            } else {
                effort + 1
            };
        }
        bounds
    }

    /// What an error in time is relative to: the time itself, or, if the curve runs across time 0, its farther end; but
    /// at most the interval. So wherever a curve lies, its error is small beside its length, as ticks ask for.
    #[inline(never)]
    pub(crate) const fn size_of_time(&self, since: f64) -> f32 {
        let [start, end] = [self.exposure.end(Start), self.exposure.end(End)];
        let time = if self.side.is_end() { end as f64 - since } else { start as f64 + since };
        let size = if !(start < 0.0 && end > 0.0) {
            (time as f32).abs()
        } else if end > -start {
            end
        } else {
            -start
        };
        if size < end - start { size } else { end - start }
    }

    /// A bound of the openness within some time of where a ramp meets the plateau or the other ramp, on the other side.
    #[inline(never)]
    pub(crate) const fn greatest_beyond(&self, ramp: Side, time: f32) -> f64 {
        if self.exposure.has_plateau() {
            return 1.0;
        }
        // Seen from there.
        let (other, is_back) = (&self.shapes[ramp.other() as usize], ramp.is_end());
        let ([f0, f1, f2, f3], [d0, d1, d2]) = (other.f, other.differences());
        let (at_join, d0, d2) = if is_back { (f3, d2, d0) } else { (f0, d0, d2) };
        let (mut p, mut doublings) = (1.0 / (1 << 30) as f32, 30);
        while doublings > 0
            && p * (3.0 * d0 + p * (3.0 * (d1 - d0) + p * (d0 - 2.0 * d1 + d2))) < time
        {
            p *= 2.0;
            doublings = doublings - 1;
        }
        // f' is three times a mean of the differences. Their sum is the same seen from either end.
        let bends = (f1 - f0).abs() + (f3 - f2).abs() + (f2 - f1).abs();
        at_join as f64 + 3.0 * p as f64 * bends as f64
    }
}

/// What an error is held against, in single precision. An error of 1 is the greatest that is allowed.
struct Limits {
    /// What rounding adds to the error in time.
    rounding: f32,
    /// The greater one of both ends'.
    per_size: f32,
    /// The exposure in a unit of time beyond the ramp's inner end.
    beyond: f32,
    time: [f32; 4],
    openness: [f32; 4],
}

impl Limits {
    /// Errors in time, in exposure, and relative to the time, with what rounding adds, as shares of what they may be:
    /// relative to the time, in exposure, and in exposure beyond the ramp.
    #[inline(never)]
    const fn share(&self, &[time, exposed, relative]: &[f32; KINDS]) -> [f32; 3] {
        let error = time + self.rounding;
        let rounding = self.rounding + error * WEIGHT_OFF;
        // How far along the ramp so much time leads at most: the `way` (docs/proofs.md, "From time to exposure"). A way
        // `d` takes at least `d` times the least slope and, where time bends upwards, at least t3 d³ / 4, as around a
        // point where it stands still. One of these has to be as much.
        let [_, t1, t2, t3] = self.time;
        let (thrice, most) = (3.0 * t3, t1.abs() + 2.0 * t2.abs() + 3.0 * t3.abs());
        let slowest =
            if thrice > t2.abs() { t1 - t2 * t2 / thrice } else { t1 + thrice - 2.0 * t2.abs() };
        let slowest = slowest - most / (1 << 20) as f32;
        let mut way = error / most;
        while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error {
            way *= 2.0;
        }
        let [_, f1, f2, f3] = self.openness;
        let bends = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
        [
            relative + rounding * self.per_size,
            // The last term: on the way the openness may become greater.
            exposed + rounding * absolute(&self.openness, 1.0) + error * way * bends,
            error * self.beyond,
        ]
    }
}

/// Is none more than it may be? Written so that a NaN fails.
pub(crate) const fn certain(&[relative, exposed, beyond]: &[f32; 3]) -> bool {
    relative <= CERTAIN && exposed <= CERTAIN && beyond <= CERTAIN
}
