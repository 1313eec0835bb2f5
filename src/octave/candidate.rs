//! A candidate for an octave: the polynomial through the exact times at nine nodes, its coefficients rounded to
//! integers.

use crate::fixed::{exponent, fixed_towards_0, power_of_two_f64};
use crate::octave::path::{Path, Stretch, root, singles, value};
use crate::octave::{DEGREE, Octave};

/// Chebyshev's nodes on [-1, 1]: interpolating there comes within a small factor of the best polynomial.
pub(crate) const NODES: [f32; DEGREE + 1] =
    [-0.984_807_7, -0.8660254, -0.64278764, -0.34202015, 0.0, 0.34202015, 0.64278764, 0.8660254, 0.984_807_7];

/// What the eight products of `Octave::polynomial`, each rounded down, add to `P(x)`: from -1.992 to 0.664 in the unit
/// of the coefficients, for |x| up to `MOST_OFFSET`, as a negative `x` turns a loss round (`proofs/octaves.py`). Half
/// of that range, and its mean, for which the octave's middle makes up.
const HALF_TRUNCATION: f32 = 1.328;
const MEAN_TRUNCATION: f64 = -0.664;

/// What a time is off by, in units, as the side's end is rounded down. Beside a neighbour that is searched for, in
/// whole units too, order needs no more (proofs/search.py).
const UNITS_OFF: f32 = 1.0;

/// An octave, and how its polynomial is held against the exact time.
pub(crate) struct Candidate {
    pub(crate) octave: Octave,
    /// The time of the octave's middle since the side's end.
    pub(crate) middle_time: f64,
    /// The unit of the coefficients: `|factor|` units, in the user's unit of time.
    pub(crate) lsb: f64,
    /// A bound of the polynomial's slope, in lsb for a width.
    pub(crate) slope_bound_lsb: f32,
    /// What rounding adds to its time, in lsb: Horner's, and that of the side's end.
    pub(crate) truncation_lsb: f32,
}

/// The polynomial along a stretch. The unit of its coefficients, the *lsb*, is the least power of two in which Horner's
/// sums fit 32 bits, but at least a unit. None if its numbers are out of range.
pub(crate) const fn candidate(path: &Path, stretch: &Stretch) -> Option<Candidate> {
    let (span, c) = (&stretch.span, interpolated(stretch));
    // |x| <= reach, with room for a center's rounding.
    let reach = span.half / span.width + 0.01;
    // Horner's rule without signs, for the values and the slope.
    let (mut bound, mut most, mut slope_bound, mut k) = (0.0, 0.0, 0.0, DEGREE);
    while k > 0 {
        slope_bound = slope_bound * reach + bound;
        bound = c[k].abs() as f32 + bound * reach;
        // A NaN stays.
        most = if bound <= most { most } else { bound };
        k -= 1;
    }
    slope_bound = slope_bound * reach + bound;
    // All of Horner's sums are at most `most`, with what rounding adds.
    most *= 1.0 + 1.0 / (1 << 16) as f32;
    if !(most > 0.0 && most < f32::MAX) {
        return None;
    }
    let unit_exponent = path.curve.units.exponent();
    let lsb_exponent = exponent(most) - 30;
    let lsb_exponent = if lsb_exponent > unit_exponent { lsb_exponent } else { unit_exponent };
    // The factor is an `i32`.
    if lsb_exponent - unit_exponent > 30 {
        return None;
    }
    let (factor, lsb) = (1 << (lsb_exponent - unit_exponent), power_of_two_f64(lsb_exponent));
    let mut octave = Octave { center: span.center() as i32, ..Octave::NONE };
    let mut k = DEGREE;
    while k > 0 {
        octave.c[DEGREE - k] = to_nearest(c[k], lsb_exponent);
        k -= 1;
    }
    let middle = fixed_towards_0(c[0] - MEAN_TRUNCATION * lsb, unit_exponent);
    // A time since the side's end, so hardly above 2⁶². Up to that the sum below fits, as |side_end| is less.
    if middle.unsigned_abs() > 1 << 62 {
        return None;
    }
    let side_end = path.curve.in_units(path.curve.end_time(path.side));
    octave.middle = path.side.inwards(side_end, middle);
    octave.factor = if path.side.is_end() { -factor } else { factor };
    Some(Candidate {
        octave,
        middle_time: middle as f64 * power_of_two_f64(unit_exponent),
        lsb,
        slope_bound_lsb: slope_bound / lsb as f32,
        truncation_lsb: HALF_TRUNCATION + UNITS_OFF / factor as f32,
    })
}

/// The time since the side's end as a polynomial of `x` in widths, coefficients from the constant up.
#[inline(never)]
const fn interpolated(stretch: &Stretch) -> [f64; DEGREE + 1] {
    let (center, per_position) = stretch.span.offsets();
    let mut offset = singles(&stretch.position, center, per_position);
    let [x0, x1, x2, x3, x4, x5, x6] = offset;
    // x(±1) = even ± odd: the node `n` is at x = even + odd n.
    let (even, odd) = (x0 + x2 + x4 + x6, x1 + x3 + x5);
    let (mut x, mut d, mut i) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1], 0);
    while i <= DEGREE {
        // Single precision is enough: any nodes interpolate, and near Chebyshev's the error is small.
        offset[0] = x0 - (even + odd * NODES[i]);
        let (s, _) = root(&offset, [-1.0, 1.0], NODES[i]);
        x[i] = (value(&stretch.position, s as f64) - center) * per_position;
        d[i] = value(&stretch.time, s as f64);
        i += 1;
    }
    let mut order = 1;
    while order <= DEGREE {
        divided_differences(&mut d, &x, order);
        order += 1;
    }
    // Newton's form, multiplied out: c = d[0] + (x - x[0]) (d[1] + (x - x[1]) (d[2] + ...)).
    let (mut c, mut i) = ([0.0; DEGREE + 1], DEGREE + 1);
    while i > 0 {
        i -= 1;
        multiply(&mut c, x[i], d[i]);
    }
    c
}

/// From one order of divided differences to the next: `d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - order])`.
// Out of line, like `multiply`: unrolled copies cost kilobytes.
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

/// `c = c (x - root) + constant`, for a `c` whose highest coefficient is 0.
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

/// `x` in units of `2^e`, to the nearest; halves away from 0.
const fn to_nearest(x: f64, e: i32) -> i32 {
    let halves = fixed_towards_0(x, e - 1);
    ((halves + if halves < 0 { -1 } else { 1 }) / 2) as i32
}
