//! The exposure by time: where a time lies on the curve, the openness there, its density, and the fraction collected
//! until then.

use crate::by_time::RampPoint;
use crate::exposure::{Exposure, FOR_TICK};
use crate::moment::rounded;
use crate::pair::{Pair, significand};
use crate::plan::Plan;
use crate::units::{WHOLE, WHOLE_EXPONENT, fixed};

/// A mass may be what a measured part leaves of a ramp's share, or of the whole. While it is more than this fraction of
/// the part, the part's noise, relative to the mass, is at most four times what it is relative to the part. A mass that
/// is not more is always [`settled`](Plan::settled).
const LITTLE: f32 = 0.25;

/// Nearer than this to the middle of two `f32`, relative to them, pairs may not tell on which side of it a mass is. A
/// part is measured to 229 · 2⁻⁴⁸ of its terms (`proofs/series.py`), which may be 1083 times as great as the part
/// (`proofs/markov.py`): so to 2⁻³⁰ of the part, and to four times that of the mass ([`LITTLE`]). The inverse of the
/// middle adds at most 2⁻²⁷·⁷, which a step of an ulp leaves, and 2⁻³⁰·⁹ for measuring (docs/proofs.md, "The end of a
/// search"). Together that is less than this (`proofs/cdf.py`, with the exact numbers).
// docs/proofs.md: `cdf` never steps back
const NEAR_MIDDLE: f32 = 2.375 / (1 << 28) as f32;

/// Where a time lies on the curve.
enum At {
    Outside,
    Plateau,
    /// On a ramp, by its index.
    Ramp(usize),
}

impl Exposure {
    #[inline]
    fn at(&self, t: f32) -> At {
        let [start, end] = [self.outer(0), self.outer(1)];
        let [open, close] = [self.inner(0), self.inner(1)];
        if t < open {
            if t >= start { At::Ramp(0) } else { At::Outside }
        } else if t > close {
            if t <= end { At::Ramp(1) } else { At::Outside }
        } else if t.is_nan() {
            At::Outside
        } else if open < close {
            At::Plateau
        } else {
            // The instant of both inner ends is on the opening ramp if that has length, else on the closing one.
            At::Ramp((start == open) as usize)
        }
    }

    /// The openness at `t`, at least 0, in units of a power of two, and the exponent of that.
    #[inline]
    pub(crate) fn openness(&self, t: f32) -> (Pair, i32) {
        match self.at(t) {
            At::Outside => (Pair::ZERO, 0),
            At::Plateau => (Pair::new(1.0), 0),
            At::Ramp(ramp) => self.ramp(ramp).openness_at(t),
        }
    }

    /// `K f` for an openness `f` in units of `2^unit`.
    #[inline]
    pub(crate) fn density(&self, (f, unit): (Pair, i32)) -> f32 {
        let (area, exponent) = significand(self.area);
        rounded((f.over(area), unit - exponent))
    }
}

impl<const CELLS: usize> Plan<CELLS> {
    /// The fraction collected by `t`.
    #[inline]
    pub(crate) fn cdf(&self, t: f32) -> f32 {
        match self.exposure.at(t) {
            At::Outside if t > self.exposure.outer(1) => 1.0,
            At::Outside => 0.0,
            At::Plateau => self.cdf_on_plateau(t),
            At::Ramp(ramp) => self.cdf_on_ramp(ramp, t),
        }
    }

    /// The same on the plateau. Out of line, so that a ramp's way saves no registers for it.
    #[inline(never)]
    fn cdf_on_plateau(&self, t: f32) -> f32 {
        let (area, exponent) = significand(self.exposure.area);
        // Scaled first: the way may be subnormal, and a quotient of that has too few bits.
        let way = Pair::sum(t, -self.exposure.inner(0)).shifted(WHOLE_EXPONENT - exponent);
        self.nearest(t, self.exposure.ramps[0].share.plus(way.over(area)), 0.0, None)
    }

    /// The same on a ramp.
    #[inline(never)]
    fn cdf_on_ramp(&self, ramp: usize, t: f32) -> f32 {
        self.cdf_by_octave(ramp, t).unwrap_or_else(|| self.cdf_by_place(ramp, t))
    }

    /// The same by the mass that is collected until the place at which `t` is reached.
    #[inline(never)]
    fn cdf_by_place(&self, ramp: usize, t: f32) -> f32 {
        let on = self.exposure.ramp(ramp).at_time(t);
        let part = on.mass();
        // From the start of the ramp the mass is a sum. Back from its end it is a difference, and one of at most LITTLE
        // of the part has lost too much: it is always settled.
        let least = LITTLE * part.hi;
        let (mass, least_told) = match (ramp, on.side) {
            (0, 0) => (part, 0.0),
            (0, _) => (self.exposure.ramps[0].share.minus(part), least),
            (_, 0) => (self.exposure.ramps[0].share.plus(self.exposure.plateau).plus(part), 0.0),
            _ => (Pair::new(WHOLE).minus(part), least),
        };
        self.nearest(t, mass, least_told, Some(on))
    }

    /// The `f32` nearest to the fraction that is collected by `t`, here called its `mass`, in WHOLE; settled where
    /// pairs cannot tell which that is, and always where the mass is `least_told` or less. (A subnormal answer is
    /// rounded once more.)
    #[inline(always)]
    fn nearest(&self, t: f32, mass: Pair, least_told: f32, on: Option<RampPoint>) -> f32 {
        let nearest = mass.rounded();
        // How far the mass is from the middle between the nearest `f32` and the next one on the mass's side.
        let rest = (mass.hi - nearest) + mass.lo;
        // (For a negative mass this is the neighbour on its other side. It does not matter: `settled` answers 0.)
        let next =
            f32::from_bits(nearest.to_bits().wrapping_add_signed(if rest < 0.0 { -1 } else { 1 }));
        let distance = (0.5 * (next - nearest) - rest).abs();
        let is_told = nearest > least_told && distance >= nearest * NEAR_MIDDLE;
        let nearest =
            if is_told { nearest } else { self.settled(t, [nearest, next], distance, on) };
        if nearest < WHOLE { nearest / WHOLE } else { 1.0 }
    }

    /// Which of two neighbouring `f32` is the cdf, if the mass is so near to their middle that pairs cannot tell; 0 for
    /// no mass.
    ///
    /// The middle has exactly one time, which the inverse finds. Times before that get the lesser neighbour, all others
    /// the greater one. So the cdf does not step back, not even where next to no light falls and neighbouring times
    /// have the same mass except for its rounding. If the mass is farther from the middle than `noise`, both ways
    /// agree: that this bounds the inverse's error, too, is measured, not proven.
    // docs/proofs.md: `cdf` never steps back
    #[cold]
    #[inline(never)]
    fn settled(
        &self,
        t: f32,
        [nearest, next]: [f32; 2],
        distance: f32,
        on: Option<RampPoint>,
    ) -> f32 {
        if nearest <= 0.0 {
            return 0.0;
        }
        // The side by the lesser neighbour, so that the question is the same whichever was the nearest.
        let (lesser, greater) = if next < nearest { (next, nearest) } else { (nearest, next) };
        if CELLS > 0
            && let Some(time) = self.time_between((lesser / WHOLE).to_bits())
        {
            return if fixed(t, self.unit()) >= time { greater } else { lesser };
        }
        let middle = Pair::sum(nearest, 0.5 * (next - nearest));
        let (side, a) =
            if lesser < 0.5 * WHOLE { (0, middle) } else { (1, Pair::new(WHOLE).minus(middle)) };
        // Twice: room for the last step of the search. That it is enough is measured.
        let noise = on.map_or(0.0, |on| 2.0 * on.noise(side)) + 2.0 * FOR_TICK * nearest;
        if distance > noise {
            return nearest;
        }
        if t >= self.exposure.at_fraction(side, a, FOR_TICK).time() { greater } else { lesser }
    }
}
