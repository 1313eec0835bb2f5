//! What both public curves are: a ramp, a plateau and a ramp, with one area over all three.
//!
//! Everything is seen from two sides. Side 0 looks from the earlier end and counts `a = u`; side 1
//! looks from the later end, back in time, and counts `a = 1 - u`, exact for `u >= 1/2`. So both tails
//! keep their relative accuracy, the ends are exact, and a mirrored curve gives mirrored times, unless one ramp has nearly
//! all of the mass.

use crate::bezier::CubicBezier;
use crate::error::{CurveError, Ramp};
use crate::octave::Octave;
use crate::ramp::{FOR_DELAY, FOR_FRACTION, OnRamp, Place, Segment, whole_mass};
use crate::wide::Wide;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Profile<const CELLS: usize> {
    ramps: [Segment; 2],
    /// `A`, the whole mass.
    pub(crate) area: f64,
    /// The plateau's length, which is its mass: the openness there is 1.
    plateau_mass: f64,
    /// The significand of `K = 1/A`, its top bit set.
    reciprocal: u32,
    /// The exponent of the unit in which the curve's times count at most 2⁶¹.
    unit: i32,
    /// The plateau's line in that unit: its time continued to `u = 0`, and its slope, which is the area.
    base: i64,
    slope: i64,
    /// The `f32` around the plateau, as bits: every `u` between these is on it.
    plateau: [u32; 2],
    /// For each side, the octaves of `a` below 1/2, the widest first.
    octaves: [[Octave; CELLS]; 2],
}

/// Does the processor have doubles? Those of 64 bits do.
const DOUBLES: bool = cfg!(target_pointer_width = "64");

/// The plateau's line in doubles, `t = base + A u`, for processors that have them.
///
/// In doubles the time is within four roundings of the exact one, and in 64-bit units within one, so the two lie
/// less than the slack apart; where all within the slack rounds to one `f32`, that is the answer of both.
struct Line {
    base: f64,
    slope: f64,
    slack: f64,
    /// The plateau in `u`, without its ends.
    from: f32,
    to: f32,
}

impl Line {
    #[inline(always)]
    fn new<const CELLS: usize>(profile: &Profile<CELLS>) -> Self {
        let unit = profile.unit_of_time() as f64;
        let [from, to] = profile.plateau;
        Self {
            base: profile.base as f64 * unit,
            slope: profile.area,
            // 2¹² units are 2⁻⁴⁸ of the greatest time.
            slack: 4096.0 * unit,
            from: f32::from_bits(from),
            to: f32::from_bits(to),
        }
    }

    /// The time, and whether it is the answer.
    #[inline(always)]
    fn at(&self, u: f32) -> (f32, bool) {
        let time = self.base + self.slope * u as f64;
        let (least, greatest) = ((time - self.slack) as f32, (time + self.slack) as f32);
        (least, (u > self.from) & (u < self.to) & (least == greatest))
    }
}

/// From here on a `u` loses no bit when counted in 2⁻³².
const FINE: u32 = (1.0f32 / 512.0).to_bits();

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
        let plateau_mass = s[0] - t[3];
        let area = (whole_mass(opening) + whole_mass(closing)) + plateau_mass;
        if area <= 0.0 {
            return Err(CurveError::ZeroArea);
        }
        let normalization = 1.0 / area;
        if !((area as f32).is_normal() && (normalization as f32).is_normal()) {
            return Err(CurveError::AreaOutOfRange);
        }
        // Beyond, less than 2⁻⁶⁴ of all `u` would be left to serve.
        const { assert!(CELLS <= 64, "at most 64 octaves a side") };
        let octaves = [[Octave::NONE; CELLS]; 2];
        let reciprocal = (normalization.to_bits() >> 21) as u32 | 1 << 31;
        // A ramp's mass is counted from its outer end, the tail that has to keep its relative accuracy. Where next to
        // nothing comes before the closing ramp, its start is such a tail, too, and the one to be counted from, since
        // `f32` are finer near 0 than near 1.
        let before = whole_mass(opening) + plateau_mass;
        let back = whole_mass(closing) <= before * (1 << 12) as f64;
        let ramps = [Segment::new(opening, false), Segment::new(closing, back)];
        let exponent = exponent(&[t[0], s[3]]) - 60;
        let (mut base, mut slope) = (0, 0);
        if plateau_mass > 0.0 {
            let (first, last) = (Wide::from_f64(ramps[0].mass), Wide::from_f64(ramps[1].mass));
            base = in_units(opening.points()[3].0, exponent) - first.in_units(exponent);
            slope = in_units(closing.points()[0].0, exponent) + last.in_units(exponent) - base;
        }
        let plateau = [0; 2];
        let mut profile = Self {
            ramps,
            area,
            plateau_mass,
            reciprocal,
            unit: exponent,
            base,
            slope,
            plateau,
            octaves,
        };
        let [from, to] = profile.bounds(0);
        let (from, to) = (floor_bits(from), floor_bits(to));
        // Where the curve lies too far from time 0 for its unit, the exact way serves.
        if slope >> 40 != 0 {
            profile.plateau = [if from < FINE { FINE } else { from }, to];
        }
        let mut index = 0;
        while index < CELLS {
            profile.octaves[0][index] = Octave::fit(&profile, 0, index);
            profile.octaves[1][index] = Octave::fit(&profile, 1, index);
            index += 1;
        }
        Ok(profile)
    }

    /// The fraction `a` at which the first ramp ends, and at which the plateau ends.
    pub(crate) const fn bounds(&self, side: usize) -> [f64; 2] {
        let first = self.ramp(side).mass;
        [first / self.area, (first + self.plateau_mass) / self.area]
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

    /// `K = 1/A`
    pub(crate) const fn normalization(&self) -> f64 {
        1.0 / self.area
    }

    /// The exponent of the unit of time.
    pub(crate) const fn unit(&self) -> i32 {
        self.unit
    }

    const fn unit_of_time(&self) -> f32 {
        f32::from_bits(((127 + self.unit()) as u32) << 23)
    }

    /// The time from which this side counts, in units.
    pub(crate) const fn start_in_units(&self, side: usize) -> i64 {
        in_units(self.start(side), self.unit())
    }

    /// A ramp by its index, which is 0 or 1: that the compiler sees it spares a check that could panic.
    const fn ramp(&self, index: usize) -> &Segment {
        &self.ramps[index & 1]
    }

    /// The time from which this side counts.
    const fn start(&self, side: usize) -> f32 {
        self.ramp(side).end(side).time
    }

    /// The mass in the fraction `a`, which is above 0.
    #[inline(always)]
    const fn share(&self, a: f32) -> Wide {
        Wide::from_f64(self.area).share(a)
    }

    /// The section in which a mass is reached, seen from a side.
    #[inline(always)]
    const fn section(&self, side: usize, mass: Wide) -> Section {
        let first = Wide::from_f64(self.ramp(side).mass);
        if first.exceeds(mass) {
            return Section::Ramp(side, mass);
        }
        let beyond = mass.minus(first);
        let behind = beyond.minus(Wide::from_f64(self.plateau_mass));
        if behind.is_zero() {
            return Section::Plateau(self.on_plateau(side, beyond));
        }
        Section::Ramp(1 - side, behind)
    }

    const fn on_plateau(&self, side: usize, elapsed: Wide) -> Place {
        let time = self.ramp(side).end(1 - side).time;
        Place::new(time, side == 1, elapsed)
    }

    /// The place where a mass has been collected, from a side, by the solver.
    #[inline(always)]
    fn exact(&self, side: usize, mass: Wide, error: f32) -> Place {
        match self.section(side, mass) {
            Section::Plateau(place) => place,
            Section::Ramp(ramp, rest) => self.ramp(ramp).at_mass(side == 1, rest, mass, error),
        }
    }

    /// The time that has elapsed from the side's start when the fraction `a` has been collected.
    pub(crate) const fn elapsed(&self, side: usize, a: Wide) -> f64 {
        let mass = a.times(Wide::from_f64(self.area));
        let place = match self.section(side, mass) {
            Section::Plateau(place) => place,
            Section::Ramp(ramp, rest) => self.ramp(ramp).at_mass_const(side == 1, rest, mass),
        };
        let elapsed = place.elapsed().to_f64();
        let way = if side == 0 {
            place.time as f64 - self.start(0) as f64
        } else {
            self.start(1) as f64 - place.time as f64
        };
        if place.back == (side == 1) { way + elapsed } else { way - elapsed }
    }

    /// What an error in time is relative to: the time itself, or, where the curve runs across time 0,
    /// the greater end.
    pub(crate) const fn size_of_time(&self, side: usize, elapsed: f64) -> f64 {
        let (start, end) = (self.open_start() as f64, self.close_end() as f64);
        let time = if side == 0 { start + elapsed } else { end - elapsed };
        if start < 0.0 && end > 0.0 {
            if end > -start { end } else { -start }
        } else if time < 0.0 {
            -time
        } else {
            time
        }
    }

    /// The side from which `u` is counted and how far: the lesser of `u` and `1 - u`, which takes no branch,
    /// for none could be predicted. Below 0 and above 1 it is negative.
    #[inline(always)]
    fn count(u: f32) -> (usize, f32) {
        let late = 1.0 - u;
        if late < u { (1, late) } else { (0, u) }
    }

    /// The time on the plateau, in units, at a `u` that counts 2⁻³².
    #[inline(always)]
    fn on_line(&self, u: u32) -> i64 {
        let (high, low) = ((self.slope as u64) >> 32, self.slope as u32 as u64);
        let way = high * u as u64 + ((low * u as u64) >> 32);
        self.base.wrapping_add(way as i64)
    }

    /// The time at the offset `x` of the octave that `a` lies in, by the bits of the `f32` at or below it, if
    /// there is a polynomial for it. For 1/2, and for what is no fraction above 0, there is none.
    #[inline(always)]
    fn in_octave(&self, side: usize, a: u32, x: i32) -> Option<i64> {
        let index = (0.25f32.to_bits() >> 23).wrapping_sub(a >> 23) as usize;
        if index < CELLS {
            let octave = &self.octaves[side & 1][index];
            if a.wrapping_sub(octave.from) < octave.length {
                return Some(octave.time(x));
            }
        }
        None
    }

    /// The time by which the fraction `u` of the exposure has been collected.
    #[inline]
    pub(crate) fn inverse_cdf(&self, u: f32) -> f32 {
        if DOUBLES {
            let (time, is_right) = Line::new(self).at(u);
            if is_right {
                return time;
            }
        }
        self.inverse_cdf_in_units(u)
    }

    /// The same in integers throughout.
    #[inline(always)]
    fn inverse_cdf_in_units(&self, u: f32) -> f32 {
        let bits = u.to_bits();
        if bits > self.plateau[0] && bits < self.plateau[1] {
            let u = (bits << 8 | 1 << 31) >> (0.5f32.to_bits() >> 23).wrapping_sub(bits >> 23);
            return self.rounded(self.on_line(u));
        }
        let (side, a) = Self::count(u);
        let bits = a.to_bits();
        match self.in_octave(side, bits, (bits << 9 ^ 1 << 31) as i32) {
            Some(time) => self.rounded(time),
            None => self.solved(side, a),
        }
    }

    /// A time in units, rounded once.
    #[inline(always)]
    fn rounded(&self, time: i64) -> f32 {
        if DOUBLES {
            return time as f32 * self.unit_of_time();
        }
        // The conversion of 64 bits by that of 32, which a small processor has: with 25 bits or more in the
        // upper word, the lower one only has to say whether it is 0.
        let high = (time >> 32) as i32;
        let up = if high.wrapping_add(1 << 25) as u32 >> 26 != 0 {
            0
        } else {
            (high ^ high >> 31).leading_zeros() - 1
        };
        let time = time << up;
        let high = (time >> 32) as i32 | (time as u32 != 0) as i32;
        high as f32 * f32::from_bits(((127 + 32 - up as i32 + self.unit()) as u32) << 23)
    }

    /// [`inverse_cdf`](Self::inverse_cdf) by the exact way: the start or the end for what is no fraction.
    ///
    /// Out of line, so that the direct way saves no registers for it.
    #[cold]
    #[inline(never)]
    fn solved(&self, side: usize, a: f32) -> f32 {
        if a > 0.0 {
            self.exact(side, self.share(a), FOR_FRACTION).time()
        } else {
            self.start(side)
        }
    }

    /// The evaluations of the mass that [`inverse_cdf`](Self::inverse_cdf) takes: 0 where a direct
    /// polynomial or the plateau serves.
    pub(crate) fn evaluations(&self, u: f32) -> u32 {
        let (side, a) = Self::count(u);
        if a > 0.0 && self.in_octave(side, a.to_bits(), 0).is_none() {
            self.exact(side, self.share(a), FOR_FRACTION).evaluations
        } else {
            0
        }
    }

    /// [`inverse_cdf`](Self::inverse_cdf) of each `u` into the `t` beside it.
    ///
    /// Which section a `u` falls into can't be predicted, and where a processor tries, a miss costs more than
    /// the answer. So a first pass gives every `u` the plateau's answer, several at a time, a second lists,
    /// without a branch, those for which it is none, and a third mends these.
    pub(crate) fn inverse_cdf_slice(&self, u: &[f32], t: &mut [f32]) {
        if !DOUBLES {
            for (u, t) in u.iter().zip(t) {
                *t = self.inverse_cdf(*u);
            }
            return;
        }
        const CHUNK: usize = 128;
        let line = Line::new(self);
        for (u, t) in u.chunks(CHUNK).zip(t.chunks_mut(CHUNK)) {
            let mut right = [0u32; CHUNK];
            for ((u, t), right) in u.iter().zip(&mut *t).zip(&mut right) {
                let (time, is_right) = line.at(*u);
                (*t, *right) = (time, is_right as u32);
            }
            let (mut list, mut listed) = ([0u8; CHUNK], 0);
            for (i, right) in right.iter().take(u.len()).enumerate() {
                list[listed % CHUNK] = i as u8;
                listed += 1 - *right as usize;
            }
            for i in &list[..listed] {
                t[*i as usize] = self.inverse_cdf_in_units(u[*i as usize]);
            }
        }
    }

    /// The plateau in `u` that counts 2⁻³²: its line serves from the first up to, not with, the second.
    pub(crate) fn plateau_in_words(&self) -> [u32; 2] {
        let [from, to] = self.plateau.map(f32::from_bits);
        // A cast saturates.
        [(from.next_up() * 4294967296.0) as u32, (to * 4294967296.0) as u32]
    }

    /// The time, in units, at a `u` that counts 2⁻⁶⁴, if the plateau's line or a polynomial gives it.
    #[inline(always)]
    pub(crate) fn direct(&self, u: u64, plateau: [u32; 2]) -> Option<i64> {
        let word = (u >> 32) as u32;
        if word >= plateau[0] && word < plateau[1] {
            return Some(self.on_line(word));
        }
        let side = (u >> 63) as usize;
        let a = if side == 0 { u } else { u.wrapping_neg() };
        let (high, low) = ((a >> 32) as u32, a as u32);
        let zeros = high.leading_zeros();
        if high == 0 {
            return None;
        }
        // The significand after its top bit.
        let offset = high << (zeros & 31) << 1 | low >> (31u32.wrapping_sub(zeros) & 31);
        self.in_octave(side, (126 - zeros) << 23 | offset >> 9, (offset ^ 1 << 31) as i32)
    }

    /// How long after the curve's start the fraction `a`, in (0, 1/2], has been collected from a side.
    pub(crate) fn delay(&self, side: usize, a: Wide) -> Wide {
        let place = self.exact(side, a.times(Wide::from_f64(self.area)), FOR_DELAY);
        let base = Wide::between(self.open_start(), place.time);
        if place.back { base.minus(place.elapsed()) } else { base.plus(place.elapsed()) }
    }

    /// Where `t` lies.
    #[inline]
    pub(crate) fn at(&self, t: f32) -> At<'_> {
        let (start, end) = (self.open_start(), self.open_end());
        // A plateau without length has no instant of its own: it is the ramps' that have length.
        let plateau = end < self.close_start();
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
    pub(crate) fn openness(&self, t: f32) -> Wide {
        match self.at(t) {
            At::Outside => Wide::ZERO,
            At::Plateau => Wide::ONE,
            At::Opening(on) | At::Closing(on) => on.openness(),
        }
    }

    /// The fraction of the mass collected by `t`.
    #[inline]
    pub(crate) fn cdf(&self, t: f32) -> f32 {
        let first = || Wide::from_f64(self.ramps[0].mass);
        let mass = match self.at(t) {
            At::Outside => return if t > self.close_end() { 1.0 } else { 0.0 },
            At::Opening(on) => on.mass(),
            At::Plateau => first().plus(Wide::between(self.open_end(), t)),
            At::Closing(on) if on.back() => Wide::from_f64(self.area).minus(on.mass()),
            At::Closing(on) => first().plus(Wide::from_f64(self.plateau_mass)).plus(on.mass()),
        };
        if t == self.close_end() { 1.0 } else { self.normalized(mass) }
    }

    /// `K x`, at most a rounding above 1 for a mass.
    pub(crate) fn normalized(&self, x: Wide) -> f32 {
        let a = Wide::from_f64(self.area);
        // With A = s 2^n, s in [1, 2), K is 2/s 2^(-n - 1), or 2^-n.
        let e = if a.m == 1 << 63 { -126 } else { -127 } - a.e;
        let k = Wide { m: (self.reciprocal as u64) << 32, e };
        x.times(k).to_f32()
    }
}

/// The exponent of the greatest magnitude, or, where all are 0, of the least there is in `f32`.
const fn exponent(x: &[f64]) -> i32 {
    let (mut i, mut most) = (0, f32::from_bits(1) as f64);
    while i < x.len() {
        most = if x[i].abs() > most { x[i].abs() } else { most };
        i += 1;
    }
    (most.to_bits() >> 52) as i32 - 1023
}

/// A time in units of `2^e`.
const fn in_units(time: f32, e: i32) -> i64 {
    let units = Wide::from_f32(time).in_units(e);
    if time < 0.0 { -units } else { units }
}

/// The bits of the greatest `f32` at or below a non-negative `x` that is at most about 1.
pub(crate) const fn floor_bits(x: f64) -> u32 {
    let rounded = x as f32;
    let bits = rounded.to_bits();
    if rounded as f64 > x { bits - 1 } else { bits }
}
