//! The certificate of an octave: bounds of its polynomial's errors (docs/internals/proofs.md, "An octave's
//! certificate").

use crate::fraction::Side::{End, Start};
use crate::number::units::{exponent, floor_bits, power_of_two};
use crate::octave::bound::{FIRST_STRIDE, KINDS, SAMPLE_OFF, Sampled, errors};
use crate::octave::candidate::Candidate;
use crate::octave::path::{Path, View, absolute, scale, singles, value};
use crate::octave::span::Span;

/// Below 0.19 ulp of a time; in an interval of 2²⁴ ticks below 0.19 tick (see [`View::size_of_time`]).
pub(crate) const FORWARD_ERROR: f32 = 1.5 / (1u32 << 27) as f32;
/// An error below 1/2 keeps the times of neighbouring `u` in order, also from one octave to the next: neighbours are at
/// least an ulp of the lesser one apart.
pub(crate) const ULP_ERROR: f32 = 0.49;

/// How far off a fraction may be in a look-up, since joins are rounded.
// proofs/certificate.py
pub(crate) const JOIN_OFF: f32 = 1.0 / (1u64 << 54) as f32;
/// How far off a fraction may be on a path, as a share of it: it is a sum of terms up to 1083 times as great, with 60
/// roundings of an `f64`.
// proofs/certificate.py
pub(crate) const FRACTION_OFF: f32 = 1.0 / (1u64 << 36) as f32;
/// The greatest offset, in widths; a word ends at 1/2.
// proofs/octaves.py
const MOST_OFFSET: f32 = 0.4999;
/// How far off a time may be on a path, as a share of it: it is a sum of terms up to 14 times as great
/// (`proofs/solve.py`), with 9 roundings of an `f64`, counted on paper.
const TIME_OFF: f32 = 1.0 / (1u64 << 46) as f32;

/// By how much rounding changes a weight ([`KINDS`]) at a sample, as a share of the openness's coefficients without
/// signs, or of `Limits::per_size`.
// proofs/certificate.py
const WEIGHT_OFF: f32 = 1.0 / (1 << 18) as f32;

/// 1, less what single precision rounds.
const CERTAIN: f32 = 1.0 - 1.0 / (1 << 16) as f32;

/// Bounds of an octave's errors, each as a share of what the error may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shares {
    /// Of the error in time. That may be [`FORWARD_ERROR`] of [`View::size_of_time`].
    pub(crate) forward: f32,
    /// Of the error in exposure. That may be [`ULP_ERROR`] ulp of where the span begins.
    pub(crate) backward: f32,
    /// The same where the error in time leads beyond the ramp's join.
    pub(crate) beyond: f32,
}

impl Shares {
    pub(crate) const REFUSED: Self =
        Self { forward: f32::INFINITY, backward: f32::INFINITY, beyond: f32::INFINITY };

    /// Are all below 1? Written so that a NaN fails.
    pub(crate) const fn are_certain(&self) -> bool {
        self.forward <= CERTAIN && self.backward <= CERTAIN && self.beyond <= CERTAIN
    }
}

impl View<'_> {
    /// The shares on the stretch `along` between two places of the ramp, after [`Span::counted`].
    #[inline(never)]
    pub(crate) const fn certificate(
        &self,
        candidate: &Candidate,
        span: &Span,
        mut along: Path,
        [first, last]: [f64; 2],
    ) -> Shares {
        let Candidate { ref octave, middle, step, steep, truncated } = *candidate;
        let exposure = self.exposure;
        let ends = [value(&along.time, -1.0), value(&along.time, 1.0)];
        let off = JOIN_OFF + FRACTION_OFF * span.to;
        let ulp = power_of_two(exponent(f32::from_bits(floor_bits(span.from))) - 23);
        let single_step = step as f32;
        // The share `backward` of an error of one step at openness 1, in `f64`, since an area may be 2⁻¹²⁶. As no span
        // begins below LEAST_TOP / 2, `ULP_ERROR * ulp` is above `off` (proofs/certificate.py).
        let per_exposure = step / exposure.area / (ULP_ERROR * ulp - off) as f64;
        // The share `forward` of an error of one step, at both ends.
        let per_size = [
            single_step / self.size_of_time(ends[0]) / FORWARD_ERROR,
            single_step / self.size_of_time(ends[1]) / FORWARD_ERROR,
        ];
        along.time[0] -= middle;
        scale(&mut along.time, 1.0 / step, 1.0);
        let [t0, t1, t2, t3, ..] = singles(&along.time, 0.0, 1.0);
        let [f0, f1, f2, f3, ..] = singles(&along.openness, 0.0, per_exposure);
        let (time, openness) = ([t0, t1, t2, t3], [f0, f1, f2, f3]);
        // 1 / size is convex in time, so at most the chord: `per_size <= mean + slope (t(s) - t0 - t2)`.
        let slope = 0.5 * (per_size[1] - per_size[0]) / (t1 + t3);
        let mean = 0.5 * (per_size[0] + per_size[1]);
        let per_size_along = [mean - slope * t2, slope * t1, slope * t2, slope * t3];
        let (center, per_position) = span.offsets();
        let offset = singles(&along.fraction, center, per_position);
        // An offset beyond its word would wrap. It is greatest at an end.
        let [x0, x1, x2, x3, x4, x5, x6] = offset;
        let fits = (x0 + x2 + x4 + x6).abs() + (x1 + x3 + x5).abs() < MOST_OFFSET;
        let is_joined = if self.ramp.is(self.side) { last >= 1.0 } else { first <= 0.0 };
        let limits = Limits {
            rounding: truncated
                + SAMPLE_OFF
                + steep * off / span.width
                + (ends[1] / step) as f32 * TIME_OFF,
            per_size: if per_size[0] > per_size[1] { per_size[0] } else { per_size[1] },
            beyond: if is_joined {
                let most = FORWARD_ERROR * (exposure.end(End) - exposure.end(Start));
                (self.greatest_beyond(most) * per_exposure) as f32
            } else {
                0.0
            },
            time,
            openness,
        };
        let weights = [[1.0, 0.0, 0.0, 0.0], openness, per_size_along];
        // A sample's position is rounded by 1/2 and a trace.
        let noise = limits.rounding + 0.5002 * steep * per_position as f32;
        let (mut stride, mut shares) = (FIRST_STRIDE, Shares::REFUSED);
        let (Some(sampled), true) = (Sampled::new(&along), fits) else { return shares };
        while stride > 0 {
            let (least, most) = errors(octave, &sampled, &weights, noise, stride);
            shares = limits.shares(most);
            // More samples cannot help where those seen are too wrong.
            let is_decided = shares.are_certain() || !limits.shares(least).are_certain();
            stride = if is_decided { 0 } else { stride / 2 };
        }
        shares
    }

    /// What an error in time is relative to, at a time since the side's end: the time itself, or the farther end's if
    /// the curve runs across time 0; but at most the interval, however far from time 0 that is.
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

    /// A bound of the openness for a `time` beyond the ramp's join: 1 on a plateau, or else the other ramp's.
    #[inline(never)]
    pub(crate) const fn greatest_beyond(&self, time: f32) -> f64 {
        if self.exposure.has_plateau() {
            return 1.0;
        }
        // Seen from the join, where its openness is f0.
        let other = self.shapes[self.ramp.other() as usize].from(self.ramp);
        let ([f0, f1, f2, f3], [d0, d1, d2]) = (other.f, other.differences());
        // From the join to the place `p` the other ramp takes at least `time`, or `p` is 1.
        let (mut p, mut doublings) = (1.0 / (1 << 30) as f32, 30);
        while doublings > 0
            && p * (3.0 * d0 + p * (3.0 * (d1 - d0) + p * (d0 - 2.0 * d1 + d2))) < time
        {
            p *= 2.0;
            doublings -= 1;
        }
        // |f'| <= 3 differences
        let differences = (f1 - f0).abs() + (f3 - f2).abs() + (f2 - f1).abs();
        f0 as f64 + 3.0 * p as f64 * differences as f64
    }
}

/// What turns errors along a stretch into shares. An error of one step is one of `Candidate::step`.
struct Limits {
    /// What rounding adds to an error in time, in steps.
    rounding: f32,
    /// The share `forward` of an error of one step, at the end of the stretch where it is greater.
    per_size: f32,
    /// The share `beyond` of an error of one step; 0 if the stretch does not reach the join.
    beyond: f32,
    /// The time along the stretch, in steps.
    time: [f32; 4],
    /// The share `backward` of an error of one step, along the stretch.
    openness: [f32; 4],
}

impl Limits {
    /// The shares that follow from the greatest errors, with what rounding adds (docs/internals/proofs.md,
    /// "From time to exposure").
    #[inline(never)]
    const fn shares(&self, [time, exposure, relative]: [f32; KINDS]) -> Shares {
        let error = time + self.rounding;
        let rounding = self.rounding + error * WEIGHT_OFF;
        // most >= t' >= slowest
        let [_, t1, t2, t3] = self.time;
        let (thrice, most) = (3.0 * t3, t1.abs() + 2.0 * t2.abs() + 3.0 * t3.abs());
        let slowest =
            if thrice > t2.abs() { t1 - t2 * t2 / thrice } else { t1 + thrice - 2.0 * t2.abs() };
        let slowest = slowest - most / (1 << 20) as f32;
        // Anywhere, a way `d` takes at least `d slowest` and `t3 d³ / 4`: so `way` takes `error`, or is all there is.
        let mut way = error / most;
        while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error {
            way *= 2.0;
        }
        // |f'| <= steepest, so on the way the openness grows by `way steepest` at most.
        let [_, f1, f2, f3] = self.openness;
        let steepest = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
        Shares {
            forward: relative + rounding * self.per_size,
            backward: exposure + rounding * absolute(&self.openness, 1.0) + error * way * steepest,
            beyond: error * self.beyond,
        }
    }
}
