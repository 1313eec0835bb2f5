//! From a fraction of the exposure to its time.
//!
//! The steps of [`Inverse::inverse_cdf`], with the file of each:
//!
//! 1. On the plateau, above `u = 1/512`, the time is on a line, `base + area · u`. Go to 10.
//! 2. Else `a = min(u, 1 - u)` is counted from the nearer end of the curve, its *side* ([`fraction`](crate::fraction)).
//! 3. If the octave of `a` has a polynomial ([`octave`]), that gives the time. Go to 10.
//! 4. Else a search begins: `a` becomes a mass, an integer ([`fixed`](crate::fixed)).
//! 5. The part of the curve that reaches this mass ([`curve`](crate::curve)). The plateau gives the time: go to 10.
//! 6. A ramp is seen from the end that faces the side ([`ramp`](crate::ramp)).
//! 7. The search starts from the end of the ramp from which less mass is missing.
//! 8. The first guess: the least distance at which one term of the mass is enough ([`search`](crate::search)).
//! 9. Halley's steps, until what they leave, measured in integers, is within the error.
//! 10. One rounding to `f32`.
//!
//! A greater `u` has no earlier time. Below 2⁻²³ a search first rounds `u` to a grid, and equal ones have equal
//! answers. At the time of a polynomial or a search, the true fraction is off by less than half the distance to the
//! next one. On the line the product is rounded down. Beside the line the errors of both are too small to meet
//! (proofs/search.py).
//!
//! A tick's time, [`Inverse::time_units`], is not rounded to `f32`. In its step 1, too, a fraction is counted from the
//! nearer end: its line begins 1/512 from either end, that of `inverse_cdf` only from the start.

use crate::curve::Curve;
use crate::error::{CurveError, tried};
use crate::fixed::{EIGHTH, LINE_FROM, floor_bits, rounded, rounded_near_0, upper_word};
use crate::fraction::Fraction;
use crate::fraction::Side::{self, End, Start};
use crate::octave::Octave;
use crate::octave::build::build;
use crate::ramp::bezier::CubicBezier;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inverse<const OCTAVES: usize> {
    pub(crate) curve: Curve,
    /// By side, `[count, last]`: so many `f32` are on the plateau's line, down from the one with the bits `last`. That
    /// is the last below 1 at or before the far ramp's join.
    line_bits: [[u32; 2]; 2],
    /// By side: the bits of the tops at index 0, of the ramp at the start and of the one at the end. With them
    /// `(bits(top) - bits(a)) >> 23` indexes `octaves` for either ramp ([`octave`] has a drawing).
    tops: [[u32; 2]; 2],
    /// By side: the octaves of the far ramp, then those of the near one, each from the widest on.
    octaves: [[Octave; OCTAVES]; 2],
}

/// Where a fraction lies.
pub(crate) enum Section {
    /// On the plateau's line: the time, in units.
    Line(i64),
    /// On the ramp at a side; or on the plateau, at a fraction up to [`LINE_FROM`]: there `build::range` gives no
    /// octaves, and a search answers.
    Ramp(Side),
}

impl<const OCTAVES: usize> Inverse<OCTAVES> {
    pub(crate) const fn new(opening: &CubicBezier, closing: &CubicBezier) -> Result<Self, CurveError> {
        // A ramp without octaves gives every fraction an index of 64 or more (`NO_OCTAVES`), and a fraction of 0 has
        // 105 or more, the exponent field of a top (`LEAST_TOP`).
        const { assert!(OCTAVES <= 64, "at most 64 octaves a side") };
        let curve = tried!(Curve::new(opening, closing));
        let [from_start, from_end] = [curve.join_fractions(Start), curve.join_fractions(End)];
        let mut this = Self {
            curve,
            line_bits: [line_bits(from_start), line_bits(from_end)],
            tops: [[0; 2]; 2],
            octaves: [[Octave::NONE; OCTAVES]; 2],
        };
        // Where there are none, the code that builds octaves is left out.
        if OCTAVES > 0 {
            let (ramps, [start, end]) = ([*opening, *closing], &mut this.octaves);
            this.tops = [build(&curve, &ramps, Start, start), build(&curve, &ramps, End, end)];
        }
        Ok(this)
    }

    /// The time by which the fraction `u` has been collected: the start for `u <= 0` and NaN, the end for `u >= 1`.
    ///
    /// For a `static` curve the early return keeps register saves off the plateau, whose answers then take a third
    /// fewer cycles.
    #[inline(always)]
    pub(crate) fn inverse_cdf(&self, u: f32) -> f32 {
        // The line counts `u` from the start, up to its last `f32`: so it is tried before the nearer end is known.
        let ramp = match self.section(Start, u.to_bits()) {
            Section::Line(time) => return rounded(time, self.curve.units.word),
            Section::Ramp(ramp) => ramp,
        };
        let (time, scale) = match self.by_octave(Fraction::new(u), ramp) {
            Some(time) => match upper_word(time) {
                Some(high) => (high as f32, self.curve.units.word),
                None => (rounded_near_0(time, self.curve.units.word), 1.0),
            },
            None => (f32::from_bits(self.searched_bits(u)), 1.0),
        };
        // One product and one return for all three.
        time * scale
    }

    /// The time at a fraction, in units.
    #[inline(always)]
    pub(crate) const fn time_units(&self, fraction: Fraction) -> i64 {
        match self.direct_units(fraction) {
            Some(time) => time,
            None => self.searched_units(fraction),
        }
    }

    /// The time at a fraction, in units, if the plateau's line or a polynomial has it.
    #[inline(always)]
    pub(crate) const fn direct_units(&self, fraction: Fraction) -> Option<i64> {
        match self.section(fraction.side, fraction.bits) {
            Section::Line(time) => Some(time),
            Section::Ramp(ramp) => self.by_octave(fraction, ramp),
        }
    }

    /// How many steps of a search [`inverse_cdf`](Self::inverse_cdf) takes; none where it does not search.
    #[cfg(feature = "_measure")]
    pub(crate) fn steps(&self, u: f32) -> Option<u32> {
        let (fraction, section) = (Fraction::new(u), self.section(Start, u.to_bits()));
        let is_searched = matches!(section, Section::Ramp(ramp) if self.by_octave(fraction, ramp).is_none());
        is_searched.then(|| self.curve.time_units(fraction).1)
    }

    /// The section of a fraction from a side, which has these bits.
    #[inline(always)]
    pub(crate) const fn section(&self, side: Side, bits: u32) -> Section {
        let [count, last] = self.line_bits[side as usize];
        // Negative beyond the join. Of a negative number or NaN it is `count` or more: either ramp will do, as no
        // octave has such bits.
        let to_last = last.wrapping_sub(bits);
        if to_last >= count {
            return Section::Ramp(Side::end_if(side.is_end() != ((to_last as i32) < 0)));
        }
        let word = in_line_units(bits);
        // From the end the line is asked for 1 - a. In 2⁻³² that is 2³² - word, or -word as a `u32`.
        Section::Line(self.on_line(if side.is_end() { word.wrapping_neg() } else { word }))
    }

    /// The time on the plateau's line, in units, at a `u` that counts 2⁻³².
    // proofs/words.py
    #[inline(always)]
    const fn on_line(&self, u: u32) -> i64 {
        // `fixed::product` with what is known here: the slope is not negative, and there is no lower word.
        let slope = self.curve.line_slope as u64;
        let way = (slope >> 32) * u as u64 + (((slope & 0xFFFF_FFFF) * u as u64) >> 32);
        self.curve.line_base.wrapping_add(way as i64)
    }

    /// The time by a polynomial of a ramp, in units.
    // proofs/octaves.py: the look-up finds the octave that was built
    #[inline(always)]
    const fn by_octave(&self, fraction: Fraction, ramp: Side) -> Option<i64> {
        match self.look_up(fraction, ramp) {
            // Tested before any coefficient is loaded, or the compiler loads all at once and saves registers for them.
            Some((octave, position)) if octave.exists() => Some(octave.time(octave.offset(position))),
            _ => None,
        }
    }

    /// The octave of a fraction on a ramp, and its position there, which may wrap ([`octave`] has a table). None for 0,
    /// outside [0, 1] and for NaN.
    #[inline(always)]
    pub(crate) const fn look_up(&self, fraction: Fraction, ramp: Side) -> Option<(&Octave, i32)> {
        let Fraction { side, bits } = fraction;
        let top = self.tops[side as usize][ramp as usize];
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
        let with_borrow = bits ^ (top ^ below) & 1 << 23;
        let word = (with_borrow << 8) as i32;
        Some((octave, word.wrapping_add(word & !(word >> 31))))
    }

    /// The time at a fraction, in units, by a search.
    #[cold]
    #[inline(never)]
    const fn searched_units(&self, fraction: Fraction) -> i64 {
        self.curve.time_units(fraction).0
    }

    /// The time of `u` by a search. Out of line, and with `u` itself: keeping its fraction until here would cost each
    /// direct answer 6 cycles of register saves. It returns bits, not a float, so that the caller cannot tail-call it:
    /// all answers on ramps share one return. Unlike [`Fraction::new`], this counts every NaN from the start.
    #[cold]
    #[inline(never)]
    fn searched_bits(&self, u: f32) -> u32 {
        let (side, a) = if u > 0.5 { (End, 1.0 - u) } else { (Start, u) };
        let end = self.curve.end_time(side);
        if a > 0.0 {
            let (time, _) = self.curve.time_units(Fraction { side, bits: a.to_bits() });
            let time = rounded(time, self.curve.units.word);
            // In units the start is rounded down.
            let start = self.curve.end_time(Start);
            (if time > start { time } else { start }).to_bits()
        } else {
            end.to_bits()
        }
    }

    /// No fraction from a side that is above this, up to 1/2, needs a search.
    ///
    /// What answers changes only at a top, at [`LINE_FROM`] and at a join, and all but joins are multiples of an eighth
    /// of a power of two. From one multiple to the next there are at most an octave of the near ramp, the line, and an
    /// octave of the far ramp, in this order. The first and the last fraction ask both octaves, and the line always
    /// answers.
    pub(crate) const fn least_direct(&self, side: Side) -> f32 {
        let mut bits = 0.5f32.to_bits();
        loop {
            let [last, first] = [Fraction { side, bits }, Fraction { side, bits: bits - EIGHTH + 1 }];
            if self.direct_units(last).is_none() || self.direct_units(first).is_none() {
                return f32::from_bits(bits);
            }
            bits -= EIGHTH;
        }
    }
}

/// How many `f32` are on the line between two joins, and the bits of its last one. It begins above [`LINE_FROM`] and
/// ends below 1: the fraction 1 has the exact end.
const fn line_bits([near, far]: [f64; 2]) -> [u32; 2] {
    let (before, last, before_end) = (floor_bits(near), floor_bits(far), 1.0f32.to_bits() - 1);
    let last = if last < before_end { last } else { before_end };
    let before = if before < LINE_FROM.to_bits() { LINE_FROM.to_bits() } else { before };
    [last.saturating_sub(before), last]
}

/// An `f32` above [`LINE_FROM`] and below 1, by its bits, in units of 2⁻³².
// proofs/words.py
#[inline(always)]
const fn in_line_units(bits: u32) -> u32 {
    let shift = (0.5f32.to_bits() >> 23).wrapping_sub(bits >> 23);
    (bits << 8 | 1 << 31) >> (shift & 31)
}
