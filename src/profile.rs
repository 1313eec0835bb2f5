//! What both public curves are: a ramp, a plateau and a ramp, with one area over all three.
//!
//! Everything is seen from two sides. Side 0 looks from the earlier end and counts `a = u`; side 1
//! looks from the later end, back in time, and counts `a = 1 - u`, exact for `u >= 1/2`. So both tails
//! keep their relative accuracy, the ends are exact, and a mirrored curve gives mirrored times.

use crate::bezier::CubicBezier;
use crate::error::{CurveError, Ramp};
use crate::octave::Octave;
use crate::ramp::{OnRamp, Place, Segment};
use crate::wide::{Wide, sum};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Profile<const CELLS: usize> {
    ramps: [Segment; 2],
    /// The plateau's length, which is its mass: the openness there is 1.
    plateau: f64,
    /// `A`, the whole mass.
    pub(crate) area: f64,
    /// `K = 1/A`
    pub(crate) normalization: f64,
    /// For each side, [`direct_bounds`](Self::direct_bounds) as the bits of the `f32` at or below.
    bounds: [[u32; 2]; 2],
    /// For each side, the octaves of `a` below 1/2, the widest first.
    octaves: [[Octave; CELLS]; 2],
}

/// The bits of 1/2 and of 1.
const HALF: i32 = 0.5f32.to_bits() as i32;
const ONE: i32 = 1.0f32.to_bits() as i32;

/// Where a fraction of the exposure is collected.
enum Section {
    Plateau(Place),
    /// In a ramp, with the mass counted from the end that faces this side.
    Ramp(usize, Wide),
}

/// Where a time lies on the curve.
pub(crate) enum At<'a> {
    Outside,
    Opening(OnRamp<'a>),
    Plateau,
    Closing(OnRamp<'a>),
}

impl<const CELLS: usize> Profile<CELLS> {
    /// The profile of two ramps with an openness of at most `most`; errors name the first `ramp` so.
    pub(crate) const fn new(
        opening: &CubicBezier,
        closing: &CubicBezier,
        ramp: Ramp,
        most: f64,
    ) -> Result<Self, CurveError> {
        if let Err(error) = opening.check_finite(ramp) {
            return Err(error);
        }
        if let Err(error) = closing.check_finite(Ramp::Closing) {
            return Err(error);
        }
        let (t, s) = (opening.times(), closing.times());
        if !(t[0] <= t[3] && t[3] <= s[0] && s[0] <= s[3]) {
            return Err(CurveError::TimesOutOfOrder);
        }
        const LONGEST: f64 = 18446744073709551616.0; // 2⁶⁴
        if !(s[3] - t[0] >= 1.0 / LONGEST && s[3] - t[0] <= LONGEST) {
            return Err(CurveError::IntervalOutOfRange);
        }
        if let Err(error) = opening.check_ramp(ramp, most) {
            return Err(error);
        }
        if let Err(error) = closing.check_ramp(Ramp::Closing, most) {
            return Err(error);
        }
        let ramps = [Segment::new(opening), Segment::new(closing)];
        let plateau = s[0] - t[3];
        let area = (ramps[0].mass + ramps[1].mass) + plateau;
        if !(area > 0.0) {
            return Err(CurveError::ZeroArea);
        }
        let normalization = 1.0 / area;
        if !((area as f32).is_normal() && (normalization as f32).is_normal()) {
            return Err(CurveError::AreaOutOfRange);
        }
        // An octave beyond would hold subnormal numbers.
        const { assert!(CELLS <= 64, "at most 64 octaves a side") };
        let bounds = [[0; 2]; 2];
        let octaves = [[Octave::NONE; CELLS]; 2];
        let mut profile = Self {
            ramps,
            plateau,
            area,
            normalization,
            bounds,
            octaves,
        };
        let mut side = 0;
        while side < 2 {
            let [first, second] = profile.direct_bounds(side);
            profile.bounds[side] = [floor_bits(first), floor_bits(second)];
            side += 1;
        }
        let mut index = 0;
        while index < CELLS {
            profile.octaves[0][index] = Octave::fit(&profile, 0, index);
            profile.octaves[1][index] = Octave::fit(&profile, 1, index);
            index += 1;
        }
        Ok(profile)
    }

    /// The octaves' polynomials serve below the first of these fractions `a`, where the first ramp ends,
    /// and above the second, where the plateau ends. An octave with an end of both ramps in it
    /// has its polynomial for the longer part, and the shorter is left out.
    pub(crate) const fn direct_bounds(&self, side: usize) -> [f64; 2] {
        let first = self.ramps[side].mass;
        let [first, second] = [first / self.area, (first + self.plateau) / self.area];
        const EXPONENT: u64 = 0x7FF << 52;
        let low = f64::from_bits(first.to_bits() & EXPONENT);
        if second < 2.0 * low && first > low {
            if first - low > 2.0 * low - second {
                [first, 2.0 * low]
            } else {
                [low, second]
            }
        } else {
            [first, second]
        }
    }

    pub(crate) const fn open_start(&self) -> f32 {
        self.ramps[0].ends[0].time
    }
    pub(crate) const fn open_end(&self) -> f32 {
        self.ramps[0].ends[1].time
    }
    pub(crate) const fn close_start(&self) -> f32 {
        self.ramps[1].ends[0].time
    }
    pub(crate) const fn close_end(&self) -> f32 {
        self.ramps[1].ends[1].time
    }

    /// The time from which this side counts.
    const fn start(&self, side: usize) -> f32 {
        self.ramps[side].ends[side].time
    }

    /// The section in which the fraction `a` is reached, seen from a side.
    const fn section(&self, side: usize, a: Wide) -> Section {
        let mass = a.times(Wide::from_f64(self.area));
        let first = Wide::from_f64(self.ramps[side].mass);
        if first.exceeds(mass) {
            return Section::Ramp(side, mass);
        }
        let beyond = mass.minus(first);
        let plateau = Wide::from_f64(self.plateau);
        if !beyond.exceeds(plateau) && !plateau.is_zero() {
            return Section::Plateau(self.on_plateau(side, beyond));
        }
        Section::Ramp(1 - side, beyond.minus(plateau))
    }

    const fn on_plateau(&self, side: usize, elapsed: Wide) -> Place {
        let time = self.ramps[side].ends[1 - side].time;
        Place {
            time,
            back: side == 1,
            elapsed,
            evaluations: 0,
        }
    }

    /// The place where the fraction `a` of the exposure has been collected, from a side; exact.
    fn exact(&self, side: usize, a: Wide) -> Place {
        match self.section(side, a) {
            Section::Plateau(place) => place,
            Section::Ramp(ramp, mass) => self.ramps[ramp].at_mass(side, mass),
        }
    }

    /// The time that has elapsed from the side's start when the fraction `a` has been collected.
    pub(crate) const fn elapsed(&self, side: usize, a: Wide) -> f64 {
        let place = match self.section(side, a) {
            Section::Plateau(place) => place,
            Section::Ramp(ramp, mass) => self.ramps[ramp].at_mass_const(side, mass),
        };
        let elapsed = place.elapsed.to_f64();
        let way = if side == 0 {
            place.time as f64 - self.start(0) as f64
        } else {
            self.start(1) as f64 - place.time as f64
        };
        if place.back == (side == 1) {
            way + elapsed
        } else {
            way - elapsed
        }
    }

    /// What an error in time is relative to: the time itself, or, where the curve runs across time 0,
    /// the greater end.
    pub(crate) const fn size_of_time(&self, side: usize, elapsed: f64) -> f64 {
        let (start, end) = (self.open_start() as f64, self.close_end() as f64);
        let time = if side == 0 {
            start + elapsed
        } else {
            end - elapsed
        };
        if start < 0.0 && end > 0.0 {
            if end > -start { end } else { -start }
        } else if time < 0.0 {
            -time
        } else {
            time
        }
    }

    /// The side from which `u` is counted, and how far, as the bits of a `f32`.
    #[inline(always)]
    fn count(u: f32) -> (usize, u32) {
        // As integers, the bits of negative numbers, and of NaNs with that sign, are negative, and those
        // of the other NaNs above infinity's.
        let bits = u.to_bits() as i32;
        if bits < HALF {
            (0, if bits < 0 { 0 } else { bits as u32 })
        } else if bits < ONE {
            (1, (1.0 - u).to_bits())
        } else {
            (if u.is_nan() { 0 } else { 1 }, 0)
        }
    }

    /// The polynomial that serves the fraction whose `f32`, rounded down, has these bits.
    ///
    /// A bound itself is left to the exact way, which knows on which side of it the fraction lies.
    #[inline(always)]
    fn octave(&self, side: usize, a: u32) -> Option<&Octave> {
        let index = (0.25f32.to_bits() >> 23).wrapping_sub(a >> 23) as usize;
        let [first, second] = self.bounds[side];
        if index < CELLS && (a < first || a > second) {
            let octave = &self.octaves[side][index];
            if octave.scale != 0.0 {
                return Some(octave);
            }
        }
        None
    }

    /// The time by which the fraction `u` of the exposure has been collected.
    #[inline]
    pub(crate) fn inverse_cdf(&self, u: f32) -> f32 {
        let (side, a) = Self::count(u);
        if let Some(octave) = self.octave(side, a) {
            let m = octave.at((a << 9 ^ 1 << 31) as i32);
            let scale = if side == 0 {
                octave.scale
            } else {
                -octave.scale
            };
            // 24 bits and 7: both exact.
            let high = (m & !0x7F) as f32 * scale;
            let low = (m & 0x7F) as f32 * scale;
            return sum(self.start(side), high, low);
        }
        if a == 0 {
            return self.start(side);
        }
        self.exact(side, Wide::from_f32(f32::from_bits(a))).time()
    }

    /// The evaluations of the mass that [`inverse_cdf`](Self::inverse_cdf) takes: 0 where a direct
    /// polynomial or the plateau serves.
    pub(crate) fn evaluations(&self, u: f32) -> u32 {
        let (side, a) = Self::count(u);
        if a == 0 || self.octave(side, a).is_some() {
            return 0;
        }
        self.exact(side, Wide::from_f32(f32::from_bits(a)))
            .evaluations
    }

    /// The place where the fraction `a`, in (0, 1/2], has been collected from a side, by a direct
    /// polynomial where `direct` allows it.
    pub(crate) fn place(&self, side: usize, a: Wide, direct: bool) -> Place {
        if direct {
            let bits = ((a.e + 63 + 127) as u32) << 23 | (a.m >> 40) as u32 & 0x7F_FFFF;
            if let Some(octave) = self.octave(side, bits) {
                let x = ((a.m >> 31) as u32 ^ 1 << 31) as i32;
                let exponent = (octave.scale.to_bits() >> 23) as i32 - 127;
                let elapsed = Wide::new(octave.at(x) as u64, exponent);
                return Place {
                    time: self.start(side),
                    back: side == 1,
                    elapsed,
                    evaluations: 0,
                };
            }
        }
        self.exact(side, a)
    }

    /// Where `t` lies.
    #[inline]
    pub(crate) fn at(&self, t: f32) -> At<'_> {
        let (start, end) = (self.open_start(), self.open_end());
        // A plateau without length has no instant of its own: it is the ramps' that have length.
        let plateau = self.plateau > 0.0;
        if !(t >= start && t <= self.close_end()) {
            At::Outside
        } else if t < end || (t == end && !plateau && start < end) {
            At::Opening(self.ramps[0].at_time(t))
        } else if plateau && t <= self.close_start() {
            At::Plateau
        } else {
            At::Closing(self.ramps[1].at_time(t))
        }
    }

    /// The openness at `t`, at least 0.
    #[inline]
    pub(crate) fn openness(&self, t: f32) -> f32 {
        let f = match self.at(t) {
            At::Outside => 0.0,
            At::Plateau => 1.0,
            At::Opening(on) | At::Closing(on) => on.openness(),
        };
        if f > 0.0 { f } else { 0.0 }
    }

    /// `K · openness`
    #[inline]
    pub(crate) fn pdf(&self, openness: f32) -> f32 {
        self.normalized(Wide::from_f32(openness))
    }

    /// The fraction of the mass collected by `t`.
    #[inline]
    pub(crate) fn cdf(&self, t: f32) -> f32 {
        let first = || Wide::from_f64(self.ramps[0].mass);
        let mass = match self.at(t) {
            At::Outside => return if t > self.close_end() { 1.0 } else { 0.0 },
            At::Opening(on) if on.from == 0 => on.mass(),
            At::Opening(on) => first().minus(on.mass()),
            At::Plateau => first().plus(Wide::between(self.open_end(), t)),
            At::Closing(on) if on.from == 0 => {
                first().plus(Wide::from_f64(self.plateau)).plus(on.mass())
            }
            At::Closing(on) => Wide::from_f64(self.area).minus(on.mass()),
        };
        if t == self.close_end() {
            1.0
        } else {
            self.normalized(mass)
        }
    }

    /// `K x`, at most a rounding above 1 for a mass.
    #[inline]
    fn normalized(&self, x: Wide) -> f32 {
        x.times(Wide::from_f64(self.normalization))
            .offset(0.0, false)
    }
}

/// The bits of the greatest `f32` at or below a non-negative `x` that is at most about 1.
const fn floor_bits(x: f64) -> u32 {
    let rounded = x as f32;
    let bits = rounded.to_bits();
    if rounded as f64 > x { bits - 1 } else { bits }
}
