//! From a fraction of the exposure to its time.
//!
//! The steps of [`Plan::inverse_cdf`], with the file of each:
//!
//! 1. On the plateau, above `u = 1/512`, the time is on a line: `t = base + A u`. Go to 10.
//! 2. Else `a = min(u, 1 - u)` is counted from the nearer end of the curve, its *side* ([`fraction`](crate::fraction)).
//! 3. If the octave of `a` has a polynomial ([`octave`]), that gives the time. Go to 10.
//! 4. Else a search begins: `a` becomes a pair of `f32` ([`pair`](crate::number::pair)).
//! 5. The section where `a` is collected ([`exposure`](crate::exposure)): the plateau gives the time at once. Go to 10.
//! 6. A ramp is seen from the end that faces the side ([`ramp`](crate::ramp)).
//! 7. The search starts from the nearest of four places on it, the *anchors*.
//! 8. The first guess: the least distance at which one term of the mass is enough ([`guess`](crate::search::guess)).
//! 9. Halley's steps; what they leave, measured in pairs; a last step with a bounded error ([`solve`](crate::search)).
//! 10. One rounding to `f32`.
//!
//! A greater `u` never has an earlier time. Errors are less than half of the distance between neighbours, or a quarter
//! for a search (docs/internals/proofs.md, "An octave's certificate", 7); on the line `A u` is rounded down, which
//! keeps the order.

use crate::error::{CurveError, tried};
use crate::exposure::Exposure;
use crate::fraction::Fraction;
use crate::fraction::Side::{self, End, Start};
use crate::number::moment::Moment;
use crate::number::pair::Pair;
use crate::number::units::{
    FINE, WHOLE, exponent, fixed, fixed_f64, floor_bits, power_of_two, time_unit,
};
use crate::octave::span::Span;
use crate::octave::{self, Octave, build};
use crate::ramp::bezier::CubicBezier;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plan<const OCTAVES: usize> {
    pub(crate) exposure: Exposure,
    /// The time of 2³² units. A unit is the power of two of which the curve's greatest time, or its length if that is
    /// more, has 2⁶¹ to 2⁶² ([`time_unit`]).
    scale: f32,
    /// By side: the bits of the last `f32` before the far ramp. A fraction with greater bits is on the far ramp.
    last_before_far: [u32; 2],
    /// By side: how many `f32` are on the line: the one with the bits `last_before_far`, and those next below it; 0
    /// without a line.
    on_line_count: [u32; 2],
    /// The line in units: its time continued to `u = 0`, and its slope. It is the plateau's, whose slope is the area;
    /// or, where a join below 1/2 counts as 1/2 ([`Exposure::joins`]), the time of 1/2 alone, with a slope of 0.
    base: i64,
    slope: i64,
    /// By side: the stored tops of the ramp at the start and of the one at the end, in the steps of [`octave::top`], so
    /// that `(bits(top) - bits(a)) >> 23` indexes `octaves` for either ramp ([`octave`] has a drawing).
    tops: [[u8; 2]; 2],
    /// By side: the octaves of the far ramp, then those of the near one, each from the widest on.
    octaves: [[Octave; OCTAVES]; 2],
}

impl<const OCTAVES: usize> Plan<OCTAVES> {
    pub(crate) const fn new(
        opening: &CubicBezier,
        closing: &CubicBezier,
    ) -> Result<Self, CurveError> {
        // So a fraction of 0 finds no octave: its index is at least 99, the exponent's bits of the least top, 2⁻²⁸.
        const { assert!(OCTAVES <= 64, "at most 64 octaves a side") };
        let (exposure, shapes) = tried!(Exposure::new(opening, closing));
        let unit = time_unit(exposure.end(Start), exposure.end(End));
        let [open, close] = [exposure.join(Start), exposure.join(End)];
        let mut plan = Self {
            exposure,
            scale: power_of_two(unit + 32),
            last_before_far: [
                last_before(exposure.joins(Start)[1]),
                last_before(exposure.joins(End)[1]),
            ],
            on_line_count: [0; 2],
            base: 0,
            slope: 0,
            tops: [[0; 2]; 2],
            octaves: [[Octave::NONE; OCTAVES]; 2],
        };
        if plan.exposure.has_plateau() {
            // The line at u = 0 and at u = 1: as if the shutter opened and closed at once, with the same exposure.
            plan.base = fixed(open, unit) - fixed_f64(shapes[0].area(), unit);
            plan.slope = fixed(close, unit) + fixed_f64(shapes[1].area(), unit) - plan.base;
            // The line is off by a few units, less than 2⁻⁶ ulp of the least `u` on it: by rules 2 to 4 it has 2⁴⁰
            // units of area (proofs/domain.py).
            let mut side = 0;
            while side < 2 {
                let near = floor_bits(plan.exposure.joins(Side::BOTH[side])[0]);
                let last_before_line = if near < FINE.to_bits() { FINE.to_bits() } else { near };
                plan.on_line_count[side] =
                    plan.last_before_far[side].saturating_sub(last_before_line);
                side += 1;
            }
        }
        let mut side = 0;
        // `OCTAVES > 0` leaves the code that builds octaves out where there are none.
        while OCTAVES > 0 && side < 2 {
            let octaves = &mut plan.octaves[side];
            plan.tops[side] =
                build::build(&plan.exposure, &shapes, unit, Side::BOTH[side], octaves);
            side += 1;
        }
        Ok(plan)
    }

    /// The exponent of the unit of time.
    pub(crate) const fn unit(&self) -> i32 {
        exponent(self.scale) - 32
    }

    /// The time of the curve's end at a side, in units.
    pub(crate) const fn end_in_units(&self, side: Side) -> i64 {
        fixed(self.exposure.end(side), self.unit())
    }

    /// The time by which the fraction `u` has been collected: the start for `u <= 0` and NaN, the end for `u >= 1`.
    ///
    /// The early return keeps register saves off the plateau, whose answers then take a third fewer cycles
    /// (docs/internals/tried.md).
    #[inline(always)]
    pub(crate) fn inverse_cdf(&self, u: f32) -> f32 {
        // On the line, until_far < on_line_count. On the ramp at the end it has wrapped, and its bit 31 is set: that
        // tells the ramp below. Where there is a line, u < 0 and NaN make it at least 2²⁹, more than any on_line_count.
        let until_far = self.last_before_far[0].wrapping_sub(u.to_bits());
        if until_far < self.on_line_count[0] {
            let time = self.on_line(in_words(u.to_bits()));
            return match upper_word(time) {
                Some(time) => time as f32 * self.scale,
                None => self.rounded_near_0_apart(time),
            };
        }
        let (side, bits) = Self::nearer(u);
        let (time, scale) = match self.by_octave(side, bits, Side::end_if(until_far >> 31 == 1)) {
            Some(time) => match upper_word(time) {
                Some(time) => (time as f32, self.scale),
                None => (self.rounded_near_0(time), 1.0),
            },
            None => (f32::from_bits(self.searched(u)), 1.0),
        };
        time * scale
    }

    /// A time of fewer than 26 bits in its upper word, as an `f32` in the curve's unit, rounded once.
    // proofs/words.py
    #[inline(always)]
    fn rounded_near_0(&self, time: i64) -> f32 {
        // A time of one word moves up by 31, which keeps its sign.
        let sign = (time >> 63) as i32;
        let is_word = (time >> 32) as i32 == sign;
        let (time, down) = if is_word { (time << 31, 31) } else { (time, 0) };
        let (high, low) = ((time >> 32) as i32, time as u32);
        // Then up until the upper word is full.
        let up = (high ^ sign).leading_zeros().wrapping_sub(1) & 31;
        let filled = high << up | (low >> 1 >> (31 - up)) as i32 | (low << up != 0) as i32;
        // Two factors: their product may not be a normal number.
        filled as f32 * f32::from_bits((127 - down - up) << 23) * self.scale
    }

    /// For the plateau, which seldom needs it.
    #[cold]
    #[inline(never)]
    fn rounded_near_0_apart(&self, time: i64) -> f32 {
        self.rounded_near_0(time)
    }

    /// The time, in units, at a fraction.
    #[inline(always)]
    pub(crate) const fn time_at(&self, at: Fraction) -> i64 {
        match self.direct(at) {
            Some(time) => time,
            None => self.searched_time(at),
        }
    }

    /// The time, in units, at a fraction, if the plateau's line or a polynomial has it.
    #[inline(always)]
    pub(crate) const fn direct(&self, Fraction { side, a }: Fraction) -> Option<i64> {
        let bits = a.to_bits();
        let until_far = self.last_before_far[side as usize].wrapping_sub(bits);
        if until_far < self.on_line_count[side as usize] {
            let word = in_words(bits);
            // From the end the line is asked for 1 - a. In 2⁻³² that is 2³² - word, or -word as a `u32`.
            Some(self.on_line(if side.is(Start) { word } else { word.wrapping_neg() }))
        } else {
            self.by_octave(side, bits, side.other_if(until_far >> 31 == 1))
        }
    }

    /// The time, in units, by a polynomial of a ramp, at a fraction with these bits.
    // proofs/octaves.py: the look-up finds the octave that was built
    #[inline(always)]
    const fn by_octave(&self, side: Side, bits: u32, ramp: Side) -> Option<i64> {
        match self.look_up(side, ramp, bits) {
            // Tested before any coefficient is loaded, or the compiler loads all at once and saves registers for them.
            Some((octave, position)) if octave.exists() => {
                Some(octave.time(octave.offset(position)))
            }
            _ => None,
        }
    }

    /// The time, in units, at a fraction, by a search.
    #[cold]
    #[inline(never)]
    const fn searched_time(&self, Fraction { side, a }: Fraction) -> i64 {
        self.searched_moment(side, a).in_units(self.unit())
    }

    const fn searched_moment(&self, side: Side, a: f32) -> Moment {
        if a > 0.0 {
            self.exposure.at_fraction(side, Pair::new(a * WHOLE))
        } else {
            // Of 0: the end itself, though no light may fall there.
            Moment::at(self.exposure.end(side))
        }
    }

    /// The side from which `u` is counted, and the bits of `a = min(u, 1 - u)`. Outside [0, 1] `a` is negative, and for
    /// NaN it is NaN: neither has an octave.
    ///
    /// Integers, since a comparison of floats waits for the FPU; no branch, since the side is unpredictable.
    #[inline(always)]
    pub(crate) fn nearer(u: f32) -> (Side, u32) {
        let (bits, late) = (u.to_bits(), (1.0 - u).to_bits());
        // Signed: a negative `u` is not late.
        let is_late = bits as i32 > 0.5f32.to_bits() as i32;
        (Side::end_if(is_late), core::hint::select_unpredictable(is_late, late, bits))
    }

    /// The octave of an `a` with these bits on a ramp, and its position there. None for 0, outside [0, 1] and for NaN.
    #[inline(always)]
    pub(crate) const fn look_up(
        &self,
        side: Side,
        ramp: Side,
        bits: u32,
    ) -> Option<(&Octave, i32)> {
        let top = octave::top(self.tops[side as usize][ramp as usize]);
        let below = top.wrapping_sub(bits);
        let index = (below >> 23) as usize;
        if index >= OCTAVES {
            return None;
        }
        let octave = &self.octaves[side as usize][index];
        // Let a = (1 + f) 2^e. If 2^e is the octave's power, the position is f. If it is half of that, the position is
        // (f - 1) / 2. That is where `top - bits` borrows from the exponent: where bit 23 of top ^ bits ^ below is 1.
        // With f in the upper bits of a word, and that bit as its sign, the word is f / 2 or (f - 1) / 2 in 2⁻³². So it
        // is doubled if it is not negative:
        //   top    0.375   0 01111101 100...
        //   bits   0.3     0 01111101 00110...   no borrow:  0.2 / 2, and the position is 0.2
        //   bits   0.2     0 01111100 10011...   a borrow:  (0.6 - 1) / 2 = -0.2, which is the position
        let word = ((bits ^ (top ^ below) & 1 << 23) << 8) as i32;
        Some((octave, word.wrapping_add(word & !(word >> 31))))
    }

    /// The time on the plateau's line, in units, at a `u` in units of 2⁻³².
    // proofs/words.py
    #[inline(always)]
    const fn on_line(&self, u: u32) -> i64 {
        let (high, low) = ((self.slope as u64) >> 32, self.slope as u32 as u64);
        let way = high * u as u64 + ((low * u as u64) >> 32);
        self.base.wrapping_add(way as i64)
    }

    /// [`inverse_cdf`](Self::inverse_cdf) by a search. Out of line: direct answers save no registers for it. It returns
    /// bits, not a float, so that the caller cannot tail-call it: all answers on ramps share one return.
    #[cold]
    #[inline(never)]
    fn searched(&self, u: f32) -> u32 {
        let (side, bits) = Self::nearer(u);
        let a = f32::from_bits(bits);
        // For 0, 1, what is beyond, and NaN: an end.
        let side = if a > 0.0 { side } else { Side::end_if(u >= 1.0) };
        self.searched_moment(side, a).time().to_bits()
    }

    /// The evaluations of the mass that [`inverse_cdf`](Self::inverse_cdf) takes; none where it does not search.
    pub(crate) fn evaluations(&self, u: f32) -> Option<u32> {
        let until_far = self.last_before_far[0].wrapping_sub(u.to_bits());
        let (side, bits) = Self::nearer(u);
        let ramp = Side::end_if(until_far >> 31 == 1);
        if until_far < self.on_line_count[0] || self.by_octave(side, bits, ramp).is_some() {
            None
        } else {
            Some(self.searched_moment(side, f32::from_bits(bits)).evaluations)
        }
    }

    /// No fraction from a side that is above this, up to 1/2, needs a search.
    pub(crate) const fn least_direct(&self, side: Side) -> f64 {
        let [near, far] = self.exposure.joins(side);
        let mut least = self.least_served(side, side.other(), 0.5);
        if least <= far && near < far && near < least {
            // The plateau, by its line.
            if self.on_line_count[side as usize] == 0 {
                return least;
            }
            least = if near < FINE as f64 { FINE as f64 } else { near };
        }
        if least <= far { self.least_served(side, side, least) } else { least }
    }

    /// What [`least_direct`](Self::least_direct) is with one ramp's octaves, if it is `least` without them.
    const fn least_served(&self, side: Side, ramp: Side, mut least: f64) -> f64 {
        let part = build::range(&self.exposure, side, ramp);
        let top = octave::top(self.tops[side as usize][ramp as usize]);
        let mut index = 0;
        while index < OCTAVES {
            if let Some(span) = Span::new(part, octave::below(top, index)) {
                if !self.octaves[side as usize][index].exists() {
                    break;
                }
                least = span.from;
            }
            index += 1;
        }
        least
    }
}

/// The bits of the last `f32` before a join, and before 1, which has the exact end.
const fn last_before(join: f64) -> u32 {
    let (join, before_end) = (floor_bits(join), 1.0f32.to_bits() - 1);
    if join < before_end { join } else { before_end }
}

/// An `f32` above [`FINE`] and below 1, by its bits, in units of 2⁻³².
// proofs/words.py
#[inline(always)]
const fn in_words(bits: u32) -> u32 {
    let shift = (0.5f32.to_bits() >> 23).wrapping_sub(bits >> 23);
    (bits << 8 | 1 << 31) >> (shift & 31)
}

/// The upper word of a time, which rounds to the same `f32` as both words: a small processor converts 32 bits, not 64.
/// None if it has fewer than 26 bits. With 26, two more than an `f32`, all that counts of the lower word is whether it
/// is 0: the *sticky bit*.
// proofs/words.py
#[inline(always)]
fn upper_word(time: i64) -> Option<i32> {
    let high = (time >> 32) as i32;
    let has_enough = high.wrapping_add(1 << 25) as u32 >= 1 << 26;
    has_enough.then_some(high | (time as u32 != 0) as i32)
}
