//! The direct way: an octave of `u` as a polynomial that gives the time outright.
//!
//! Take `a`, the exposure's fraction from the nearer end of the curve: `u` or `1 - u`. Its exponent
//! picks the octave and its significand is the exact offset within, so octaves shrink towards the
//! end as fast as the density may, and a polynomial of one degree is as good, relatively, in all.

use crate::profile::{Profile, floor_bits};
use crate::wide::{Wide, times_high};

/// One octave's polynomial: the time is `middle + factor · P(x)` in the profile's unit, `x` in
/// [-1/2, 1/2) across the octave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave {
    middle: i64,
    /// A power of two, or minus that from the later side.
    factor: i32,
    /// The bits of the first `f32` that the polynomial serves, and how many it serves.
    pub(crate) from: u32,
    pub(crate) length: u32,
    /// `P(x) = c[0] x + c[1] x² + ...`
    c: [i32; DEGREE],
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
/// What the rounding of products and of the middle adds at most, in the unit of the coefficients.
const NOISE: f64 = 2.5;

const WORD: f64 = 4294967296.0;

impl Octave {
    pub(crate) const NONE: Self = Self { middle: 0, factor: 0, from: 0, length: 0, c: [0; DEGREE] };

    /// The time, in the profile's unit, at an `x` that counts 2⁻³², by Horner's rule: each step is one
    /// multiply-and-add of 32 bits, and the last one of 64, on a microcontroller that has them.
    #[inline(always)]
    pub(crate) const fn time(&self, x: i32) -> i64 {
        self.middle.wrapping_add(self.factor as i64 * self.rest(x) as i64)
    }

    /// `P(x)`, written out, because firmware is often built for size, which would keep it a loop.
    #[inline(always)]
    const fn rest(&self, x: i32) -> i32 {
        let [c1, c2, c3, c4, c5, c6, c7, c8] = self.c;
        let value = times_high(c8, x).wrapping_add(c7);
        let value = times_high(value, x).wrapping_add(c6);
        let value = times_high(value, x).wrapping_add(c5);
        let value = times_high(value, x).wrapping_add(c4);
        let value = times_high(value, x).wrapping_add(c3);
        let value = times_high(value, x).wrapping_add(c2);
        let value = times_high(value, x).wrapping_add(c1);
        times_high(value, x)
    }

    /// The polynomial for the octave `a` in [2^-(index + 2), 2^-(index + 1)) from one side, or
    /// [`NONE`](Self::NONE) where none keeps the promised error.
    pub(crate) const fn fit<const CELLS: usize>(
        profile: &Profile<CELLS>,
        side: usize,
        index: usize,
    ) -> Self {
        let low = 1.0 / (4.0 * power_of_two(index as i32));
        let high = 2.0 * low;
        // The longer part of the octave that lies in one ramp.
        let [first, second] = profile.bounds(side);
        let first = if first < low {
            low
        } else if first < high {
            first
        } else {
            high
        };
        let second = if second > high {
            high
        } else if second > low {
            second
        } else {
            low
        };
        let (from, to) = if first - low > high - second { (low, first) } else { (second, high) };
        if from >= to {
            return Self::NONE;
        }
        // A bound belongs to neither part; that of the octave does.
        let start = floor_bits(from) + (from > low) as u32;
        let length = floor_bits(to) - start;
        let part = Part {
            side,
            index,
            middle: (from + to) / (2.0 * low) - 1.5,
            half: (to - from) / (2.0 * low),
        };
        part.direct(profile, start, length)
    }

    /// The error where it peaks, through the very arithmetic that will run: small in time, and small
    /// in `u`, in which time's slope across the octave measures it.
    const fn keeps_promise<const CELLS: usize>(
        &self,
        profile: &Profile<CELLS>,
        part: &Part,
        middle: f64,
        scale: f64,
    ) -> bool {
        let mut i = 0;
        while i < PEAKS.len() {
            let x = part.offset(PEAKS[i]);
            let exact = part.exact(profile, x);
            let error = (middle + (self.rest(x) as f64 + 0.5) * scale) - exact;
            let error = if error < 0.0 { -error } else { error };
            // What one ulp of u is in time: the octave is 2²³ ulp long.
            let ulp = self.slope(x) * scale / (1 << 23) as f64;
            let size = profile.size_of_time(part.side, exact);
            // Written so that a NaN fails.
            if !(error <= TIME_ERROR * size && error + NOISE * scale <= ULP_ERROR * ulp) {
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
            slope = slope * x + k as f64 * self.c[k - 1] as f64;
            k -= 1;
        }
        slope
    }
}

/// The part of an octave that its polynomial serves, in the offset `x`.
struct Part {
    side: usize,
    index: usize,
    middle: f64,
    half: f64,
}

impl Part {
    /// The offset of a point of [-1, 1], in units of 2⁻³².
    const fn offset(&self, point: f64) -> i32 {
        // A cast saturates.
        ((self.middle + self.half * point) * WORD) as i32
    }

    /// The exact time from the side's start at an offset.
    const fn exact<const CELLS: usize>(&self, profile: &Profile<CELLS>, x: i32) -> f64 {
        let m = 1 << 63 | ((x as u32 ^ 1 << 31) as u64) << 31;
        let a = Wide { m, e: -(self.index as i32 + 2 + 63) };
        profile.elapsed(self.side, a)
    }

    /// The octave that gives the time, where it keeps the promise.
    const fn direct<const CELLS: usize>(
        &self,
        profile: &Profile<CELLS>,
        from: u32,
        length: u32,
    ) -> Octave {
        let c = self.interpolate(profile);

        // The largest value that Horner's rule meets fills 31 bits.
        let (mut bound, mut most, mut k) = (0.0, 0.0, DEGREE);
        while k > 0 {
            bound = (if c[k] < 0.0 { -c[k] } else { c[k] }) + bound / 2.0;
            most = if bound > most { bound } else { most };
            k -= 1;
        }
        if !(most > 0.0 && most < f64::MAX) {
            return Octave::NONE;
        }
        let exponent = (most.to_bits() >> 52) as i32 - 1023 - 30;
        let exponent = if exponent < profile.unit() { profile.unit() } else { exponent };
        if exponent - profile.unit() > 30 {
            return Octave::NONE;
        }
        let scale = power_of_two(exponent);
        let factor = 1 << (exponent - profile.unit());
        let mut octave = Octave { middle: 0, factor, from, length, c: [0; DEGREE] };
        let mut k = 0;
        while k < DEGREE {
            octave.c[k] = round(c[k + 1] / scale);
            k += 1;
        }
        // Each product is rounded down, by half a unit on average, and only the last one's counts in full.
        let middle = (c[0] / power_of_two(profile.unit())) as i64 + factor as i64 / 2;
        octave.middle =
            profile.start_in_units(self.side) + if self.side == 0 { middle } else { -middle };
        octave.factor = if self.side == 0 { factor } else { -factor };
        if octave.keeps_promise(profile, self, c[0], scale) { octave } else { Octave::NONE }
    }

    /// The coefficients, from `x⁰` up, of the polynomial through the exact times at the nodes.
    const fn interpolate<const CELLS: usize>(&self, profile: &Profile<CELLS>) -> [f64; DEGREE + 1] {
        // Newton's divided differences ...
        let (mut x, mut d) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        let mut i = 0;
        while i <= DEGREE {
            let offset = self.offset(NODES[i]);
            x[i] = offset as f64 / WORD;
            d[i] = self.exact(profile, offset);
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
        c
    }
}

const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

const fn round(x: f64) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i32
}
