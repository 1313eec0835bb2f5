//! Octaves: polynomials that give the time of a fraction without a search. [`build`] makes them, by way of [`path`],
//! [`span`], [`candidate`], [`certificate`] and [`bound`].
//!
//! Let `a` be the fraction from the nearer end of the curve, its side. An octave holds the `a` above half of its *top*,
//! up to the top. A ramp's first top is at or above its greatest `a`; each further one is half of the one before. Next
//! to a dark end the time is about a power of `a`, which looks the same from any `a` to `2 a`: so one degree is about
//! as exact, relatively, in each octave.
//!
//! A side's array has the far ramp's `k` octaves, then the near ramp's. Of each ramp the top *at index 0* is stored: of
//! the near ramp it is the first top, times `2^k`. So `(bits(top at index 0) - bits(a)) >> 23` is an index for either.
//!
//! An octave's *power* is the power of two at or below its top. In the code `top` and `tops` are the bits of tops, as
//! `f32`.
//!
//! | word | meaning | type, unit |
//! |---|---|---|
//! | *position* | `a`, less the power | `i32`, 2⁻³² of the power; it wraps from 3/2 of the power on |
//! | *center* | a position near the middle of the span | the same; as their difference fits, wrapping does no harm |
//! | *shift* | 0, or more for a short span | the lowest 5 bits of a center |
//! | *width* | the power, halved `shift` times | `f32` |
//! | *offset*, `x` | position less center | `i32`, 2⁻³² of the width; in `f64` in widths |
//! | *lsb* | the unit of the polynomial's coefficients | `abs(factor)` units of time |
//! | time since the side's end | the way from the curve's end at the side | `f64`, in the user's unit, 0 or more |
//! | *span* | the part of an octave on one ramp | from one `a` to another ([`span`]) |
//! | `p` | the parameter of the ramp's Bezier | `f64`, 0 at the end that faces the side, 1 at the other ([`path`]) |
//! | *stretch* | the part of the Bezier that has all of a span | by `s`, -1 at one end, 1 at the other |
//!
//! ```text
//! a             0     0.023   0.047   0.09375   0.125   0.25    0.5
//! index          ... 4  |   3   |   2   |         |   1   |   0   |
//! serves        near ramp, up to 0.09             far ramp, from 0.2
//! at index 0    0.09375 · 2² = 0.375              0.5
//!
//! index 2, top 0.09375, power 0.0625:         bits          position      (a - power) / power
//!               a = 0.078125  = 1.25 · 2⁻⁴    0x3DA0_0000   0x4000_0000    1/4
//!               a = 0.0546875 = 1.75 · 2⁻⁵    0x3D60_0000   0xE000_0000   -1/8
//! ```

pub(crate) mod bound;
pub(crate) mod build;
pub(crate) mod candidate;
pub(crate) mod certificate;
pub(crate) mod path;
pub(crate) mod span;

/// One octave's polynomial: the time, in units, is `middle + factor · P(x)`, at the offset `x` from -1/2 to 1/2, which
/// is `(position - center) << shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave {
    pub(crate) middle: i64,
    /// A power of two, at most 2³⁰, or minus that from `Side::End`; 0 where there is no polynomial.
    pub(crate) factor: i32,
    /// A position. Its lowest 5 bits are the shift as well.
    pub(crate) center: i32,
    /// The coefficients from the highest down: `P(x) = c[0] x⁸ + ... + c[6] x² + c[7] x`.
    pub(crate) c: [i32; DEGREE],
}

pub(crate) const DEGREE: usize = 8;

/// The bits of a center that are its shift: a position's unit is `2^shift` of an offset's.
pub(crate) const SHIFT_MASK: i32 = 31;

/// The bits of the top at an index, from those of the one at index 0; 0 if that is too small.
pub(crate) const fn top_at(top: u32, index: usize) -> u32 {
    top.saturating_sub((index as u32) << 23)
}

impl Octave {
    pub(crate) const NONE: Self = Self { middle: 0, factor: 0, center: 0, c: [0; DEGREE] };

    pub(crate) const fn exists(&self) -> bool {
        self.factor != 0
    }

    /// The offset of a position. It fits the word (`FILLED` in [`span`]).
    #[inline(always)]
    pub(crate) const fn offset(&self, position: i32) -> i32 {
        position.wrapping_sub(self.center) << (self.center & SHIFT_MASK)
    }

    /// The time at an offset, in units.
    #[inline(always)]
    pub(crate) const fn time(&self, x: i32) -> i64 {
        self.middle.wrapping_add(self.factor as i64 * self.polynomial(x) as i64)
    }

    /// `P(x)`, each product rounded down. Written out, or firmware that is built for size would keep a loop.
    #[inline(always)]
    pub(crate) const fn polynomial(&self, x: i32) -> i32 {
        let [c8, c7, c6, c5, c4, c3, c2, c1] = self.c;
        let value = product_high(c8, x).wrapping_add(c7);
        let value = product_high(value, x).wrapping_add(c6);
        let value = product_high(value, x).wrapping_add(c5);
        let value = product_high(value, x).wrapping_add(c4);
        let value = product_high(value, x).wrapping_add(c3);
        let value = product_high(value, x).wrapping_add(c2);
        let value = product_high(value, x).wrapping_add(c1);
        product_high(value, x)
    }
}

/// Is this Armv6-M, which has no instruction for the upper word of a product? Stable Rust can tell it by its lack of
/// compare-and-swap. A wrong answer costs time and changes no bits.
const HALVES: bool = cfg!(all(target_arch = "arm", target_abi = "eabi", not(target_has_atomic = "32")));

/// `floor(a x / 2³²)`
// proofs/octaves.py
#[inline(always)]
pub(crate) const fn product_high(a: i32, x: i32) -> i32 {
    if HALVES { product_high_by_halves(a, x) } else { ((a as i64 * x as i64) >> 32) as i32 }
}

/// `floor(a x / 2³²)` by products of 16-bit halves: a third of the cost where a product of 64 bits is a call.
// proofs/octaves.py
#[inline(always)]
pub(crate) const fn product_high_by_halves(a: i32, x: i32) -> i32 {
    let [a_low, x_low] = [a & 0xFFFF, x & 0xFFFF];
    let [a_high, x_high] = [a >> 16, x >> 16];
    let carried = (a_low as u32).wrapping_mul(x_low as u32) >> 16;
    let middle = a_high * x_low + carried as i32;
    let other = a_low * x_high + (middle & 0xFFFF);
    a_high * x_high + (middle >> 16) + (other >> 16)
}
