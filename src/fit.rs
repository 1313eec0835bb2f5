//! How the octaves of a side are fitted, when a curve is built: the polynomial through the exact times at a few nodes,
//! which is kept if it keeps the promise.

use crate::exposure::Exposure;
use crate::octave::{DEGREE, FINE, FINER, LEAST, Octave, STEP, below, floor_bits, range};
use crate::pair::fixed;

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
const FORWARD_ERROR: f64 = 1.5 / (1u32 << 27) as f64;
/// The error in `u` that it may have, in ulp. Neighbouring `u` are an ulp apart, so below 1/2 their times cannot change
/// places, also not where one octave follows another.
const ULP_ERROR: f64 = 0.45;
/// What the rounding of products and of the middle adds at most, in the unit of the coefficients.
const NOISE: f64 = 2.5;

const WORD: f64 = 4294967296.0;

/// Part of an octave is counted in finer units as long as its half is less than this share of the octave's width, which
/// the next finer unit doubles. What the offsets leave of the word, 0.02 · 2³², is more than a center's lowest bits
/// come to, 2⁵, at the finest unit.
const FILLED: f64 = 0.24;
const MOST_FINER: u32 = 20;

/// By how many steps a top may be beyond the end of its ramp. A ramp's last octave is often too much for one
/// polynomial. If the tops are moved out, the last part of the ramp has a polynomial of its own. The first number is
/// taken that leaves no octave without a polynomial.
const STRETCHES: [u32; 4] = [0, 5, 6, 4];

/// Fits the octaves of a side, in units of time of `2^unit`. Returns the tops by ramp, in [`STEP`]s above [`LEAST`].
/// The far ramp's octaves come first, and the near ramp's top is raised by one octave for each of them.
///
/// Out of line, and with a slice, so that it is the same for any number of octaves.
#[inline(never)]
pub(crate) const fn fit(
    exposure: &Exposure,
    unit: i32,
    side: usize,
    octaves: &mut [Octave],
) -> [u8; 2] {
    let (mut tops, mut first, mut i) = ([0; 2], 0, 0);
    while i < 2 {
        let ramp = side ^ 1 ^ i;
        let range = range(exposure, side, ramp);
        // A ramp without octaves has a top, too: fractions of the plateau that are not on its line are looked up under
        // it, and have to find octaves without a polynomial.
        let far = exposure.joins(side)[1];
        let hidden = if far < FINE as f64 { far } else { FINE as f64 };
        let (mut highest, mut end, mut stretch) = (stretched([0.0, hidden], 0), first, 0);
        while stretch < STRETCHES.len() && range[0] < range[1] {
            highest = stretched(range, STRETCHES[stretch]);
            let (mut is_whole, mut index) = (true, first);
            while index < octaves.len() {
                octaves[index] = Octave::NONE;
                if let Some(span) = Span::new(side, range, below(highest, index - first)) {
                    octaves[index] = span.fitted(exposure, unit);
                    is_whole = is_whole && octaves[index].exists();
                    end = index + 1;
                }
                index += 1;
            }
            stretch = if is_whole { STRETCHES.len() } else { stretch + 1 };
        }
        tops[ramp & 1] = ((highest - LEAST + ((first as u32) << 23)) / STEP) as u8;
        first = end;
        i += 1;
    }
    tops
}

/// The bits of the top that is so many steps beyond the end of a range.
const fn stretched([from, to]: [f64; 2], steps: u32) -> u32 {
    let end = floor_bits(to);
    let top = if end > LEAST { end.div_ceil(STEP) * STEP } else { LEAST } + steps * STEP;
    // If the range began within some ulp of an octave's end, rounding might put its first fraction into the octave
    // below.
    let beyond = top.wrapping_sub(floor_bits(from));
    if from > 0.0 && beyond.wrapping_add(16) & 0x7F_FFFF < 32 { top + STEP } else { top }
}

impl Octave {
    /// Is the error where it peaks small enough in time, and in `u`? Measured through the arithmetic that will run.
    ///
    /// A polynomial through the values at Chebyshev's nodes has an error much like Chebyshev's polynomial, whose
    /// extrema the peaks are. Between them it is not bounded by an argument: the sweeps over every `f32` have seen 0.35
    /// ulp of `u`.
    const fn keeps_promise(
        &self,
        exposure: &Exposure,
        span: &Span,
        middle: f64,
        scale: f64,
    ) -> bool {
        let mut i = 0;
        while i < PEAKS.len() {
            let x = span.offset(PEAKS[i]);
            let exact = span.exact(exposure, x);
            let error = (middle + (self.rest(x) as f64 + 0.5) * scale) - exact;
            // The rounding of the exact time in `f64` counts, too.
            let error = error.abs() + exact / (1u64 << 51) as f64;
            let size = exposure.size_of_time(span.side, exact);
            // The time that an ulp of u takes: at the ends the lesser of both sides, since time may run slower beyond a
            // join.
            let ulp = self.slope(x) * scale * span.ulp() / span.width;
            let beyond = if i == 0 {
                exact - exposure.elapsed(span.side, span.middle - span.half - span.ulp())
            } else if i + 1 == PEAKS.len() {
                exposure.elapsed(span.side, span.middle + span.half + span.ulp()) - exact
            } else {
                ulp
            };
            let ulp = if beyond < ulp { beyond } else { ulp };
            // Written so that a NaN fails.
            if !(error <= FORWARD_ERROR * size && error + NOISE * scale <= ULP_ERROR * ulp) {
                return false;
            }
            i += 1;
        }
        true
    }

    /// `P'(x)`
    #[inline(never)]
    const fn slope(&self, x: i32) -> f64 {
        let x = x as f64 / WORD;
        let mut slope = 0.0;
        let mut k = DEGREE;
        while k > 0 {
            slope = slope * x + k as f64 * self.c[DEGREE - k] as f64;
            k -= 1;
        }
        slope
    }
}

/// The part of an octave that its polynomial serves, in `a`.
pub(crate) struct Span {
    side: usize,
    /// Where it begins.
    pub(crate) from: f64,
    middle: f64,
    half: f64,
    /// The width in `a` of an offset of 1, which is 2³² units.
    width: f64,
    /// By how many bits the width is less than the octave's.
    finer: u32,
}

impl Span {
    /// Of the octave below the bits of its `top`; none where it holds nothing of the range.
    pub(crate) const fn new(side: usize, range: [f64; 2], top: u32) -> Option<Self> {
        let high = f32::from_bits(top) as f64;
        let from = if range[0] > 0.5 * high { range[0] } else { 0.5 * high };
        let to = if range[1] < high { range[1] } else { high };
        if top < LEAST || from >= to {
            return None;
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        // The significand of the top is from 2³¹ to 2³², and offsets count in half of its unit.
        let significand = (top << 8 | 1 << 31) as f64;
        let (mut width, mut finer) = (0.5 * high / significand * WORD, 0);
        // A small part of an octave fills the word, too, or the coefficients would have few bits. But not all of it: the
        // center's lowest bits are a shift, so that an offset is beyond the half by as much, times 2 to the shift. At
        // a quarter of the width, a half of exactly this left the word, and the polynomial gave the time of its other
        // end.
        while finer < MOST_FINER && half <= FILLED * width {
            width *= 0.5;
            finer += 1;
        }
        Some(Self { side, from, middle, half, width, finer })
    }

    /// The middle's significand, nearly, doubled; and the shift in its lowest bits.
    const fn center(&self) -> u64 {
        let octave = self.width * (1 << self.finer) as f64;
        (self.middle / octave * WORD) as u64 & !(FINER as u64) | self.finer as u64
    }

    /// The least ulp of `a` in the span.
    const fn ulp(&self) -> f64 {
        let least = (self.middle - self.half) as f32;
        least.next_up() as f64 - least as f64
    }

    /// The offset of a point of [-1, 1], in units of 2⁻³².
    #[inline(never)]
    const fn offset(&self, point: f64) -> i32 {
        // A cast saturates.
        (self.half * point / self.width * WORD) as i32
    }

    /// The exact time from the side's start at an offset.
    #[inline(never)]
    const fn exact(&self, exposure: &Exposure, x: i32) -> f64 {
        let center = (self.center() * (1 << self.finer)) as f64;
        exposure.elapsed(self.side, (center + x as f64) / WORD * self.width)
    }

    /// The octave with a polynomial, where one keeps the promise.
    const fn fitted(&self, exposure: &Exposure, unit: i32) -> Octave {
        let c = self.interpolate(exposure);

        // The largest value that Horner's rule meets fills 31 bits.
        let (mut bound, mut most, mut k) = (0.0, 0.0, DEGREE);
        while k > 0 {
            bound = c[k].abs() + bound * (self.half / self.width);
            most = if bound > most { bound } else { most };
            k -= 1;
        }
        if !(most > 0.0 && most < f64::MAX) {
            return Octave::NONE;
        }
        let exponent = (most.to_bits() >> 52) as i32 - 1023 - 30;
        let exponent = if exponent < unit { unit } else { exponent };
        if exponent - unit > 30 {
            return Octave::NONE;
        }
        let scale = power_of_two_f64(exponent);
        let factor = 1 << (exponent - unit);
        let mut octave = Octave { center: self.center() as u32, ..Octave::NONE };
        let mut k = 0;
        while k < DEGREE {
            octave.c[DEGREE - 1 - k] = round(c[k + 1] / scale);
            k += 1;
        }
        // Each product is rounded down, by half a unit on average, and only the last one's counts in full.
        let middle = (c[0] / power_of_two_f64(unit)) as i64 + factor as i64 / 2;
        let start = fixed(exposure.start(self.side), unit);
        octave.middle = if self.side == 0 { start + middle } else { start - middle };
        octave.factor = if self.side == 0 { factor } else { -factor };
        if octave.keeps_promise(exposure, self, c[0], scale) { octave } else { Octave::NONE }
    }

    /// The coefficients, from `x⁰` up, of the polynomial through the exact times at the nodes.
    #[inline(never)]
    const fn interpolate(&self, exposure: &Exposure) -> [f64; DEGREE + 1] {
        // Newton's divided differences ...
        let (mut x, mut d) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        let mut i = 0;
        while i <= DEGREE {
            let offset = self.offset(NODES[i]);
            x[i] = offset as f64 / WORD;
            d[i] = self.exact(exposure, offset);
            i += 1;
        }
        let (mut newton, mut order) = ([d[0]; DEGREE + 1], 1);
        while order <= DEGREE {
            divided_differences(&mut d, &x, order);
            newton[order] = d[0];
            order += 1;
        }
        // ... multiplied out into powers of x.
        let (mut c, mut i) = ([0.0; DEGREE + 1], DEGREE + 1);
        while i > 0 {
            i -= 1;
            multiply(&mut c, x[i], newton[i]);
        }
        c
    }
}

/// The divided differences of the next order. Out of line, as the next function, because loops that the compiler
/// unrolls in each place cost kilobytes.
#[inline(never)]
const fn divided_differences(d: &mut [f64; DEGREE + 1], x: &[f64; DEGREE + 1], order: usize) {
    let mut i = 0;
    // The first condition follows from the second. With it the compiler drops the checks of bounds.
    while i < DEGREE && i + order <= DEGREE {
        d[i] = (d[i + 1] - d[i]) / (x[i + order] - x[i]);
        i += 1;
    }
}

/// A polynomial times `x - root`, and a constant added.
#[inline(never)]
const fn multiply(c: &mut [f64; DEGREE + 1], root: f64, constant: f64) {
    let mut k = DEGREE;
    while k > 0 {
        c[k] = c[k - 1] - c[k] * root;
        k -= 1;
    }
    c[0] = constant - c[0] * root;
}

const fn power_of_two_f64(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

const fn round(x: f64) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chebyshev's polynomial of degree `DEGREE + 1`, by its recurrence.
    fn chebyshev(x: f64) -> f64 {
        let (mut last, mut value) = (1.0, x);
        for _ in 0..DEGREE {
            (last, value) = (value, 2.0 * x * value - last);
        }
        value
    }

    /// The nodes are its roots; at the peaks it is -1 and 1 in turn.
    #[test]
    fn nodes_and_peaks_are_those_of_chebyshev() {
        assert!(NODES.iter().all(|node| chebyshev(*node).abs() < 1e-13));
        assert!(NODES.is_sorted_by(|a, b| a < b));
        let mut sign = -1.0;
        for peak in PEAKS {
            assert!((chebyshev(peak) - sign).abs() < 1e-13, "{peak}");
            sign = -sign;
        }
        assert!(PEAKS.is_sorted_by(|a, b| a < b));
    }
}
