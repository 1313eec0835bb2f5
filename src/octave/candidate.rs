//! A candidate for an octave: the polynomial through the exact times at a few nodes, in the integers of the answer.

use crate::number::units::{exponent, fixed, fixed_f64, power_of_two_f64};
use crate::octave::path::{Path, View, root, singles, value};
use crate::octave::span::Span;
use crate::octave::{DEGREE, Octave};

/// Chebyshev's nodes: interpolating there comes within a small factor of the best polynomial.
pub(crate) const NODES: [f32; DEGREE + 1] = [
    -0.984_807_7,
    -0.8660254,
    -0.64278764,
    -0.34202015,
    0.0,
    0.34202015,
    0.64278764,
    0.8660254,
    0.984_807_7,
];

/// What the rounding of Horner's products adds, in the unit of the coefficients: from -1.992 to 0.664
/// (`proofs/octaves.py`), half of that range, and its mean, which a polynomial's middle makes up for.
const HALF_TRUNCATION: f32 = 1.328;
const MEAN_TRUNCATION: f64 = -0.664;

/// A polynomial as it is held against the exact time.
pub(crate) struct Candidate {
    pub(crate) octave: Octave,
    /// The time from the outer end that its value is added to.
    pub(crate) middle: f64,
    /// The time of a coefficient's 1.
    pub(crate) step: f64,
    /// A bound of its slope, in the unit of the coefficients over a width of the span.
    pub(crate) steep: f32,
    /// What rounding adds to it, in the unit of the coefficients: Horner's, and less than a unit of time where the
    /// outer end is cut to such units.
    pub(crate) truncated: f32,
}

impl View<'_> {
    /// The polynomial along a stretch, in the unit in which its coefficients fill their words.
    #[inline(always)]
    pub(crate) const fn candidate(&self, span: &Span, stretch: &Path) -> Option<Candidate> {
        let c = span.interpolated(stretch);
        // How far x reaches, with room for the center's lowest bits. Horner's rule by absolute values, for the value
        // and the slope: the largest value that it meets fills 31 bits, and rounding may not bring it beyond.
        let reach = span.half / span.width + 0.01;
        let (mut bound, mut most, mut steep, mut k) = (0.0, 0.0, 0.0, DEGREE);
        while k > 0 {
            steep = steep * reach + bound;
            bound = c[k].abs() as f32 + bound * reach;
            // A NaN stays.
            most = if bound <= most { most } else { bound };
            k = k - 1;
        }
        steep = steep * reach + bound;
        most *= 1.0 + 1.0 / (1 << 16) as f32;
        if !(most > 0.0 && most < f32::MAX) {
            return None;
        }
        let exponent = exponent(most) - 30;
        let exponent = if exponent < self.unit { self.unit } else { exponent };
        if exponent - self.unit > 30 {
            return None;
        }
        let step = power_of_two_f64(exponent);
        let factor = 1 << (exponent - self.unit);
        let mut octave = Octave { center: span.center() as u32, ..Octave::NONE };
        let mut k = DEGREE;
        while k > 0 {
            octave.c[DEGREE - k] = rounded(c[k], exponent);
            k = k - 1;
        }
        let middle = fixed_f64(c[0] - MEAN_TRUNCATION * step, self.unit);
        // The middle lies between nodes, so this is nearly a time of the ramp, and the sum below fits.
        if middle.unsigned_abs() > 1 << 62 {
            return None;
        }
        let start = fixed(self.exposure.end(self.side), self.unit);
        octave.middle = if self.side.is_end() { start - middle } else { start + middle };
        octave.factor = if self.side.is_end() { -factor } else { factor };
        Some(Candidate {
            octave,
            middle: middle as f64 * power_of_two_f64(self.unit),
            step,
            steep: steep / step as f32,
            truncated: HALF_TRUNCATION + 1.0 / factor as f32,
        })
    }
}

impl Span {
    /// The coefficients, from `x⁰` up, of the polynomial through the times at the nodes.
    #[inline(never)]
    const fn interpolated(&self, along: &Path) -> [f64; DEGREE + 1] {
        let (center, per_position) = self.offsets();
        let mut offset = singles(&along.fraction, center, per_position);
        let [x0, x1, x2, x3, x4, x5, x6] = offset;
        // Its values at ±1 are even ± odd, so that `even + odd n` is the node `n` between them.
        let (even, odd) = (x0 + x2 + x4 + x6, x1 + x3 + x5);
        // Divided differences ...
        let (mut x, mut d, mut i) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1], 0);
        while i <= DEGREE {
            // A polynomial interpolates wherever its nodes are. They need only be near Chebyshev's, from one end to the
            // other, for its error to be small; so single precision is enough.
            offset[0] = x0 - (even + odd * NODES[i]);
            let [place, _] = root(&offset, [-1.0, 1.0], NODES[i]);
            let place = place as f64;
            x[i] = (value(&along.fraction, place) - center) * per_position;
            d[i] = value(&along.time, place);
            i += 1;
        }
        let mut order = 1;
        while order <= DEGREE {
            divided_differences(&mut d, &x, order);
            order += 1;
        }
        // ... multiplied out into powers of x, from the highest order on.
        let (mut c, mut i) = ([0.0; DEGREE + 1], DEGREE + 1);
        while i > 0 {
            i -= 1;
            multiply(&mut c, x[i], d[i]);
        }
        c
    }
}

/// The divided differences of the next order, in the places from it on. Out of line, as the next function: unrolled in
/// each place, such loops cost kilobytes.
#[inline(never)]
const fn divided_differences(d: &mut [f64; DEGREE + 1], x: &[f64; DEGREE + 1], order: usize) {
    let (mut i, mut last) = (0, 0.0);
    while i <= DEGREE {
        let this = d[i];
        if i >= order {
            d[i] = (this - last) / (x[i] - x[i - order]);
        }
        last = this;
        i += 1;
    }
}

/// A polynomial times `x - root`, and a constant added; its last coefficient is 0.
#[inline(never)]
const fn multiply(c: &mut [f64; DEGREE + 1], root: f64, constant: f64) {
    let (mut k, mut below) = (0, constant);
    while k <= DEGREE {
        let this = c[k];
        c[k] = below - this * root;
        below = this;
        k += 1;
    }
}

/// The nearest number of units of `2^e`; of two that are as near, the one away from 0.
const fn rounded(x: f64, e: i32) -> i32 {
    let halves = fixed_f64(x, e - 1);
    ((halves + if halves < 0 { -1 } else { 1 }) / 2) as i32
}
