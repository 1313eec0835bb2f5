//! The direct way: an octave of `u` as a polynomial that gives the time without a search.
//!
//! Let `a` be the exposure's fraction from the nearer end of the curve: `u` or `1 - u`. Octaves of `a` become narrower
//! towards the end as fast as the density may fall, so a polynomial of the same degree is as exact, relatively, in
//! each. Each ramp has octaves of its own. The first one ends at the ramp's *top*, which is the fraction at which the
//! ramp ends, or somewhat more; each further one ends at half of the one before. So no octave holds parts of two ramps,
//! unless their join is so near to 1/2 that it counts as that. The plateau between the ramps is answered by its line.
//!
//! The bits of the top less the bits of `a`, shifted right by 23, are the index of the octave that holds `a`, since the
//! exponent is the upper part of the bits of an `f32`.
//!
//! An octave holds the end of one binade and the start of the next one. A *position* in it is `a` less the power of two
//! between them. Above, it counts 2⁻³¹ of that power, from 0 to 2³¹, and has to be doubled; below, it counts 2⁻³² of
//! it, from -2³¹ up to 0. The offset from the middle of what the polynomial serves is exact.

pub(crate) mod bound;
pub(crate) mod build;
pub(crate) mod candidate;
pub(crate) mod certificate;
pub(crate) mod path;
pub(crate) mod span;

use crate::number::units::{LEAST_TOP, TOP_STEP};

/// One octave's polynomial: the time is `middle + factor · P(x)` in the plan's unit, `x` from -1/2 to 1/2 across
/// the part of the octave that it serves, or a narrower interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave {
    pub(crate) middle: i64,
    /// A power of two, or minus that from the later side; 0 where there is no polynomial.
    pub(crate) factor: i32,
    /// The position, doubled where it has to be, from which `x` is counted. Its lowest 5 bits are a shift, too: `x` is
    /// the difference times 2 to that.
    pub(crate) center: u32,
    /// `P(x) = c[7] x + c[6] x² + ...`: in the order in which Horner's rule needs them.
    pub(crate) c: [i32; DEGREE],
}

pub(crate) const DEGREE: usize = 8;

/// The bits of a center that are its shift.
pub(crate) const FINER: u32 = 31;

/// The bits of a top.
#[inline(always)]
pub(crate) const fn top(steps: u8) -> u32 {
    (steps as u32 + LEAST_TOP / TOP_STEP) * TOP_STEP
}

/// The bits of the top that is so many octaves below another one.
pub(crate) const fn below(top: u32, octaves: usize) -> u32 {
    top.saturating_sub((octaves as u32) << 23)
}

/// A position in 2⁻³² of the power of two throughout: one above the power counts 2⁻³¹, and is doubled.
#[inline(always)]
pub(crate) const fn doubled(position: i32) -> i32 {
    position.wrapping_add(position & !(position >> 31))
}

impl Octave {
    pub(crate) const NONE: Self = Self { middle: 0, factor: 0, center: 0, c: [0; DEGREE] };

    /// Is there a polynomial?
    #[inline(always)]
    pub(crate) const fn exists(&self) -> bool {
        self.factor != 0
    }

    /// The `x` of a position, in 2⁻³².
    #[inline(always)]
    pub(crate) const fn offset(&self, position: i32) -> i32 {
        self.ahead_of_center(doubled(position))
    }

    /// The `x` of a position that is [`doubled`] where it has to be.
    ///
    /// The difference and its multiple fit the word, even if one of the numbers does not: a span leaves room for that
    /// (`FILLED` in [`span`](crate::octave::span)).
    #[inline(always)]
    pub(crate) const fn ahead_of_center(&self, doubled: i32) -> i32 {
        doubled.wrapping_sub(self.center as i32) << (self.center & FINER)
    }

    /// The time, in the plan's unit, at an `x` that counts 2⁻³², by Horner's rule: each step is one
    /// multiply-and-add of 32 bits, and the last one of 64, on a microcontroller that has them.
    #[inline(always)]
    pub(crate) const fn time(&self, x: i32) -> i64 {
        self.middle.wrapping_add(self.factor as i64 * self.polynomial(x) as i64)
    }

    /// `P(x)`, written out, because firmware is often built for size, which would keep it a loop.
    #[inline(always)]
    pub(crate) const fn polynomial(&self, x: i32) -> i32 {
        let [c8, c7, c6, c5, c4, c3, c2, c1] = self.c;
        let value = times_high(c8, x).wrapping_add(c7);
        let value = times_high(value, x).wrapping_add(c6);
        let value = times_high(value, x).wrapping_add(c5);
        let value = times_high(value, x).wrapping_add(c4);
        let value = times_high(value, x).wrapping_add(c3);
        let value = times_high(value, x).wrapping_add(c2);
        let value = times_high(value, x).wrapping_add(c1);
        times_high(value, x)
    }
}

/// Has the processor no instruction for the upper word of a product? Armv6-M has none, and no compare-and-swap, of
/// which a stable compiler tells. Where this is wrong, the bits are the same, only later.
const HALVES: bool =
    cfg!(all(target_arch = "arm", target_abi = "eabi", not(target_has_atomic = "32")));

/// `a x`, in 32 bits, where `x` counts 2⁻³².
// proofs/octaves.py
#[inline(always)]
pub(crate) const fn times_high(a: i32, x: i32) -> i32 {
    if HALVES { times_high_by_halves(a, x) } else { ((a as i64 * x as i64) >> 32) as i32 }
}

/// The same by products of halves, of 16 bits each: a third of what a product of 64 bits costs where that is a call.
// proofs/octaves.py
#[inline(always)]
pub(crate) const fn times_high_by_halves(a: i32, x: i32) -> i32 {
    let [a_low, x_low] = [a & 0xFFFF, x & 0xFFFF];
    let [a_high, x_high] = [a >> 16, x >> 16];
    let carried = (a_low as u32).wrapping_mul(x_low as u32) >> 16;
    let middle = a_high * x_low + carried as i32;
    let other = a_low * x_high + (middle & 0xFFFF);
    a_high * x_high + (middle >> 16) + (other >> 16)
}
