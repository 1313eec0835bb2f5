//! The direct way: an octave of `u` as a polynomial that gives the elapsed time outright.
//!
//! Take `a`, the exposure's fraction from the nearer end of the curve: `u` or `1 - u`. Its exponent
//! picks the octave and its significand is the exact offset within, so octaves shrink towards the
//! end as fast as the density may, and a polynomial of one degree is as good, relatively, in all.

use crate::profile::Profile;
use crate::series::times_high;
use crate::wide::Wide;

/// One octave's polynomial: `elapsed = scale · P(x)`, `x` in [-1/2, 1/2) across the octave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave {
    /// A power of two, 0 where there is no polynomial.
    pub(crate) scale: f32,
    c: [i32; DEGREE + 1],
}

const DEGREE: usize = 8;

/// Chebyshev's nodes: interpolating there comes within a small factor of the best polynomial.
const NODES: [f64; DEGREE + 1] = [
    -0.984807753012208,
    -0.8660254037844387,
    -0.6427876096865394,
    -0.3420201433256687,
    0.0,
    0.3420201433256687,
    0.6427876096865394,
    0.8660254037844387,
    0.984807753012208,
];

/// The extrema between and beyond the nodes, where the interpolation's error peaks.
const PEAKS: [f64; DEGREE + 2] = [
    -1.0,
    -0.9396926207859084,
    -0.766044443118978,
    -0.5,
    -0.17364817766693041,
    0.17364817766693041,
    0.5,
    0.766044443118978,
    0.9396926207859084,
    1.0,
];

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp.
const TIME_ERROR: f64 = 1.5 / (1u32 << 27) as f64;
/// The error in `u` that it may have, in ulp. Below 1/2 no two neighbouring `u` can change places,
/// not even where one octave hands over to the next.
const ULP_ERROR: f64 = 0.4;
/// What the rounding of coefficients and products adds at most, in units of `scale`.
const NOISE: f64 = 1.5;

const WORD: f64 = 4294967296.0;

impl Octave {
    pub(crate) const NONE: Self = Self {
        scale: 0.0,
        c: [0; DEGREE + 1],
    };

    /// `P(x)` for `x` in units of 2⁻³², by Horner's rule: each step is one multiply-and-add of 32 bits
    /// on a microcontroller that has it.
    #[inline(always)]
    pub(crate) const fn at(&self, x: i32) -> i32 {
        let mut value = self.c[DEGREE];
        let mut k = DEGREE;
        while k > 0 {
            k -= 1;
            value = times_high(value, x).wrapping_add(self.c[k]);
        }
        value
    }

    /// The polynomial for the octave `a` in [2^-(index + 2), 2^-(index + 1)) from one side, or
    /// [`NONE`](Self::NONE) where no polynomial keeps the promised error: the curve's exact inverse
    /// then serves.
    pub(crate) const fn fit<const CELLS: usize>(
        profile: &Profile<CELLS>,
        side: usize,
        index: usize,
    ) -> Self {
        let low = 1.0 / (4.0 * f64::from_bits((1023 + index as u64) << 52));
        // The part of the octave that lies in a ramp.
        let [first, second] = profile.direct_bounds(side);
        let (from, to) = if low < first {
            (low, if first < 2.0 * low { first } else { 2.0 * low })
        } else if second < 2.0 * low {
            (if second > low { second } else { low }, 2.0 * low)
        } else {
            return Self::NONE;
        };
        let (middle, half) = ((from + to) / (2.0 * low) - 1.5, (to - from) / (2.0 * low));

        // Newton's divided differences through the nodes ...
        let (mut x, mut d) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        let mut i = 0;
        while i <= DEGREE {
            let offset = offset(middle + half * NODES[i]);
            x[i] = offset as f64 / WORD;
            d[i] = profile.elapsed(side, fraction(index, offset));
            i += 1;
        }
        let mut order = 1;
        while order <= DEGREE {
            let mut i = DEGREE;
            while i >= order {
                d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - order]);
                i -= 1;
            }
            order += 1;
        }
        // ... multiplied out into powers of x.
        let mut c = [0.0; DEGREE + 1];
        let mut i = DEGREE + 1;
        while i > 0 {
            i -= 1;
            let mut k = DEGREE;
            while k > 0 {
                c[k] = c[k - 1] - c[k] * x[i];
                k -= 1;
            }
            c[0] = d[i] - c[0] * x[i];
        }

        // The latest time fills 31 bits.
        let most = profile.elapsed(side, fraction(index, offset(middle + half)));
        if !(most > 0.0) {
            return Self::NONE;
        }
        let exponent = (most.to_bits() >> 52) as i32 - 1023 - 30;
        if exponent < -126 {
            return Self::NONE;
        }
        let unit = f64::from_bits(((1023 + exponent) as u64) << 52);
        let mut octave = Self {
            scale: f32::from_bits(((127 + exponent) as u32) << 23),
            c: [0; DEGREE + 1],
        };
        // Each product is rounded down, by 1/2 on average; only the last one's counts in full.
        c[0] += 0.5 * unit;
        let mut bound = 0.0;
        let mut k = DEGREE + 1;
        while k > 0 {
            k -= 1;
            let value = c[k] / unit;
            let size = if value < 0.0 { -value } else { value };
            bound = if k == 0 { size } else { size + bound / 2.0 };
            if !(bound < (1u32 << 31) as f64 - 4.0) {
                return Self::NONE;
            }
            octave.c[k] = round(value);
        }
        if octave.keeps_promise(profile, side, index, middle, half, unit) {
            octave
        } else {
            Self::NONE
        }
    }

    /// The error where it peaks, through the very arithmetic that will run: small in time, and small
    /// in `u`, in which time's slope across the octave measures it.
    const fn keeps_promise<const CELLS: usize>(
        &self,
        profile: &Profile<CELLS>,
        side: usize,
        index: usize,
        middle: f64,
        half: f64,
        unit: f64,
    ) -> bool {
        let mut i = 0;
        while i < PEAKS.len() {
            let x = offset(middle + half * PEAKS[i]);
            let exact = profile.elapsed(side, fraction(index, x));
            let error = self.at(x) as f64 * unit - exact;
            let error = (if error < 0.0 { -error } else { error }) + NOISE * unit;
            // d elapsed / d ulp(u): the octave is 2²³ ulp long.
            let step = self.slope(x) * unit / (1 << 23) as f64;
            let size = profile.size_of_time(side, exact);
            // Negated, so that a NaN fails.
            if !(error <= TIME_ERROR * size + NOISE * unit && error <= ULP_ERROR * step) {
                return false;
            }
            i += 1;
        }
        true
    }

    /// `P'(x)`
    const fn slope(&self, x: i32) -> f64 {
        let x = x as f64 / WORD;
        let mut slope = 0.0;
        let mut k = DEGREE;
        while k > 0 {
            slope = slope * x + k as f64 * self.c[k] as f64;
            k -= 1;
        }
        slope
    }
}

/// `x` in units of 2⁻³², within the octave.
const fn offset(x: f64) -> i32 {
    // A cast saturates.
    (x * WORD) as i32
}

/// `a` at the offset `x` of an octave.
const fn fraction(index: usize, x: i32) -> Wide {
    let m = 1 << 63 | ((x as u32 ^ 1 << 31) as u64) << 31;
    Wide {
        m,
        e: -(index as i32 + 2 + 63),
    }
}

const fn round(x: f64) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i32
}
