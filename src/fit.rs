//! How the octaves of a side are fitted, when a curve is built: the polynomial through the exact times at a few nodes,
//! which is kept if a certificate says that it keeps the promise.

use crate::certificate::{WAYS, absolute, errors};
use crate::cubic::quadratic_min;
use crate::exposure::Exposure;
use crate::octave::{DEGREE, FINE, FINER, LEAST, Octave, STEP, below, floor_bits, range};
use crate::pair::{exponent, fixed};
use crate::path::{Path, scale, value};
use crate::shape::Shape;

/// Chebyshev's nodes: interpolating there comes within a small factor of the best polynomial.
const NODES: [f32; DEGREE + 1] = [
    -0.98480775, -0.8660254, -0.64278764, -0.34202015, 0.0, 0.34202015, 0.64278764, 0.8660254, 0.98480775,
];

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp.
const FORWARD_ERROR: f32 = 1.5 / (1u32 << 27) as f32;
/// The error in time that it may have, relative to the interval, with what a tick's fraction loses in 32 bits: below a
/// quarter of a tick in an interval of 2²⁴, of which 1/40 is left for the tick's own rounding.
const TICK_ERROR: f32 = 0.9 / (1u32 << 26) as f32;
/// The error in `u` that it may have, in ulp. Neighbouring `u` are an ulp apart, so below 1/2 their times cannot change
/// places, also not where one octave follows another.
const ULP_ERROR: f32 = 0.49;

/// What the rounding of Horner's products adds, in the unit of the coefficients: from -1.992 to 0.664
/// (proofs/octave.py). A polynomial's middle makes up for the middle of that.
const TRUNCATION: f32 = 1.328;
const TRUNCATED: f64 = -0.664;

/// An octave's ramp is looked up by joins that are rounded by this and by this share of them.
const JOIN: [f32; 2] = [1.0 / (1u64 << 54) as f32, 1.0 / (1u64 << 43) as f32];

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

/// A side of the curve, as its octaves are fitted to it.
struct Side<'a> {
    exposure: &'a Exposure,
    shapes: &'a [Shape; 2],
    side: usize,
    /// The exponent of the unit of time.
    unit: i32,
}

/// Fits the octaves of a side, in units of time of `2^unit`. Returns the tops by ramp, in [`STEP`]s above [`LEAST`].
/// The far ramp's octaves come first, and the near ramp's top is raised by one octave for each of them.
///
/// Out of line, and with a slice, so that it is the same for any number of octaves.
#[inline(never)]
pub(crate) const fn fit(
    exposure: &Exposure,
    shapes: &[Shape; 2],
    unit: i32,
    side: usize,
    octaves: &mut [Octave],
) -> [u8; 2] {
    let this = Side { exposure, shapes, side, unit };
    let (mut tops, mut first, mut i) = ([0; 2], 0, 0);
    while i < 2 {
        let ramp = side ^ 1 ^ i;
        let range = range(exposure, side, ramp);
        // A ramp without octaves has a top, too: fractions of the plateau that are not on its line are looked up under
        // it, and have to find octaves without a polynomial.
        let far = exposure.joins(side)[1];
        let hidden = if far < FINE as f64 { far } else { FINE as f64 };
        let (mut highest, mut end, mut stretch) = (stretched([0.0, hidden], 0), first, 0);
        let path = Path::new(exposure, &shapes[ramp & 1], side, ramp);
        while stretch < STRETCHES.len() && range[0] < range[1] {
            highest = stretched(range, STRETCHES[stretch]);
            stretch += 1;
            let mut index = first;
            while index < octaves.len() {
                octaves[index] = Octave::NONE;
                let top = below(highest, index - first);
                // An octave below the least top has a place, too, or a fraction there would be looked up in the next
                // ramp's.
                if f32::from_bits(top) as f64 > range[0] && top + (1 << 23) > LEAST {
                    end = index + 1;
                }
                if let Some(span) = Span::new(range, top) {
                    octaves[index] = this.fitted(ramp, &path, &span);
                    if !octaves[index].exists() && stretch < STRETCHES.len() {
                        // To be tried with the next top.
                        break;
                    }
                }
                index += 1;
            }
            if index == octaves.len() {
                break;
            }
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

/// The part of an octave that its polynomial serves, in `a`.
pub(crate) struct Span {
    /// Where it begins, and where it ends.
    pub(crate) from: f64,
    to: f64,
    /// The least ulp of `a` in it.
    ulp: f64,
    /// The middle, and how far the polynomial reaches from there: an ulp beyond what it serves.
    middle: f64,
    half: f64,
    /// The power of two that is in the octave, or at its end; an octave's offsets count 2⁻³² of it, ...
    octave: f64,
    /// ... and those of a part 2 to minus this of that.
    finer: u32,
}

impl Span {
    /// Of the octave below the bits of its `top`; none where it holds nothing of the range.
    pub(crate) const fn new(range: [f64; 2], top: u32) -> Option<Self> {
        let high = f32::from_bits(top) as f64;
        let from = if range[0] > 0.5 * high { range[0] } else { 0.5 * high };
        let to = if range[1] < high { range[1] } else { high };
        if top < LEAST || from >= to {
            return None;
        }
        let ulp = power_of_two(exponent(from as f32) - 23);
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from) + ulp);
        let octave = power_of_two(exponent(high as f32));
        // A small part of an octave fills the word, too, or the coefficients would have few bits. But not all of it: the
        // center's lowest bits are a shift, so that an offset is beyond the half by as much, times 2 to the shift. At
        // a quarter of the width, a half of exactly this left the word, and the polynomial gave the time of its other
        // end.
        let (mut width, mut finer) = (octave, 0);
        while finer < MOST_FINER && half <= FILLED * width {
            width *= 0.5;
            finer += 1;
        }
        Some(Self { from, to, ulp, middle, half, octave, finer })
    }

    /// The `a` that counts as an offset of 1, or 2³² of the offset's units.
    const fn width(&self) -> f64 {
        self.octave / (1 << self.finer) as f64
    }

    /// The fractions of a stretch as offsets from the center.
    const fn offsets(&self, along: &Path) -> [f32; 7] {
        let (mut offsets, per_width) = ([0.0; 7], 1.0 / self.width());
        let mut k = 0;
        while k < 7 {
            let center = if k == 0 { self.center() as f64 / WORD * self.octave } else { 0.0 };
            offsets[k] = ((along.fraction[k] - center) * per_width) as f32;
            k += 1;
        }
        offsets
    }

    /// The middle's significand, nearly, doubled; and the shift in its lowest bits.
    const fn center(&self) -> u64 {
        (self.middle / self.octave * WORD) as u64 & !(FINER as u64) | self.finer as u64
    }

    /// The coefficients, from `x⁰` up, of the polynomial through the times at the nodes.
    #[inline(never)]
    const fn interpolated(&self, along: &Path) -> [f64; DEGREE + 1] {
        let offsets = self.offsets(along);
        let (center, per_width) = (self.center() as f64 / WORD * self.octave, 1.0 / self.width());
        let (mut x, mut d) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        let mut i = 0;
        while i <= DEGREE {
            let place = node(&offsets, NODES[i]);
            x[i] = (value(&along.fraction, place) - center) * per_width;
            d[i] = value(&along.elapsed, place);
            i += 1;
        }
        // Newton's divided differences ...
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

impl Side<'_> {
    /// The octave of a part of a ramp, with a polynomial where one keeps the promise.
    #[inline(never)]
    const fn fitted(&self, ramp: usize, path: &Path, span: &Span) -> Octave {
        let first = path.place(span.middle - span.half, false);
        let last = path.place(span.middle + span.half, true);
        let (stretch, noise) = path.stretch(first, last);
        let c = span.interpolated(&stretch);

        // The largest value that Horner's rule meets fills 31 bits; rounding may not bring it beyond.
        let reach = (span.half / span.width()) as f32 + 0.01;
        let (mut bound, mut most, mut steep, mut k) = (0.0, 0.0, 0.0, DEGREE);
        while k > 0 {
            steep = steep * reach + bound;
            bound = c[k].abs() as f32 + bound * reach;
            most = if bound > most { bound } else { most };
            k -= 1;
        }
        steep = steep * reach + bound;
        most *= 1.0 + 1.0 / (1 << 16) as f32;
        if !(most > 0.0 && most < f32::MAX) {
            return Octave::NONE;
        }
        let exponent = exponent(most) - 30;
        let exponent = if exponent < self.unit { self.unit } else { exponent };
        if exponent - self.unit > 30 {
            return Octave::NONE;
        }
        let per_unit = power_of_two(-exponent);
        let factor = 1 << (exponent - self.unit);
        let mut octave = Octave { center: span.center() as u32, ..Octave::NONE };
        let mut k = 0;
        while k < DEGREE {
            octave.c[DEGREE - 1 - k] = round(c[k + 1] * per_unit);
            k += 1;
        }
        let middle = (c[0] * power_of_two(-self.unit) - TRUNCATED * factor as f64) as i64;
        let start = fixed(self.exposure.start(self.side), self.unit);
        octave.middle = if self.side == 0 { start + middle } else { start - middle };
        octave.factor = if self.side == 0 { factor } else { -factor };
        let served = Served { octave, middle: middle as f64 * power_of_two(self.unit), unit: power_of_two(exponent), steep: steep * per_unit as f32, noise };
        let is_joined = if ramp == self.side { last >= 1.0 } else { first <= 0.0 };
        if self.is_certain(&served, span, stretch, ramp, is_joined) { octave } else { Octave::NONE }
    }

    /// Does a polynomial keep the promise along a stretch of a ramp? `is_joined` says whether it comes to the ramp's
    /// inner end.
    #[inline(never)]
    const fn is_certain(
        &self,
        served: &Served,
        span: &Span,
        mut along: Path,
        ramp: usize,
        is_joined: bool,
    ) -> bool {
        let Served { ref octave, middle, unit, steep, noise } = *served;
        let (exposure, side) = (self.exposure, self.side);
        let x = span.offsets(&along);
        let ends = [value(&along.elapsed, -1.0), value(&along.elapsed, 1.0)];
        // What an error may be is 1 in each of these units.
        let (single, joins) = (unit as f32, JOIN[0] + JOIN[1] * span.to as f32);
        let per_tick = single / (exposure.start(1) - exposure.start(0)) / TICK_ERROR;
        let per_light = single / (exposure.area as f32) / (ULP_ERROR * span.ulp as f32 - joins);
        let per_size = [
            single / (exposure.size_of_time(side, ends[0]) as f32) / FORWARD_ERROR,
            single / (exposure.size_of_time(side, ends[1]) as f32) / FORWARD_ERROR,
        ];

        // In the unit of the coefficients, and as positions count.
        along.elapsed[0] -= middle;
        scale(&mut along.elapsed, 1.0 / unit, 1.0);
        along.fraction[0] -= span.octave;
        scale(&mut along.fraction, WORD / span.octave, 1.0);
        let elapsed = singles(&along.elapsed, 1.0);
        let openness = singles(&along.openness, per_light);
        // What the error in time is relative to changes as fast as the time, or not at all. Its reciprocal is below the
        // line between two of its points.
        let [_, t1, t2, t3] = elapsed;
        let half = 0.5 * (per_size[1] - per_size[0]) / (t1 + t3);
        let size = [0.5 * (per_size[0] + per_size[1]) - half * t2, half * t1, half * t2, half * t3];
        let limits = Limits {
            rounding: TRUNCATION
                + steep * (noise as f32 + joins) / span.width() as f32
                + (ends[1] / unit) as f32 / (1u64 << 48) as f32,
            lost: steep * (2u64 << span.finer) as f32 / WORD as f32,
            per_tick,
            per_size: if per_size[0] > per_size[1] { per_size[0] } else { per_size[1] },
            beyond: if is_joined { self.greatest_beyond(ramp, single / per_tick) * per_light } else { 0.0 },
            elapsed,
            openness,
        };
        let weights = [[1.0, 0.0, 0.0, 0.0], openness, size];
        let mut way = 0;
        while way < WAYS {
            let errors = errors(octave, &along, &x, &weights, limits.rounding + limits.lost, way);
            if limits.keep(&errors.most) {
                return true;
            }
            if !limits.keep(&errors.least) {
                return false;
            }
            way += 1;
        }
        false
    }

    /// The greatest openness within some time of where a ramp meets the plateau or the other ramp, on the other side.
    #[inline(never)]
    const fn greatest_beyond(&self, ramp: usize, time: f32) -> f32 {
        if self.exposure.has_plateau() {
            return 1.0;
        }
        // Seen from there.
        let (other, is_back) = (&self.shapes[(ramp ^ 1) & 1], ramp == 1);
        let ([f0, f1, f2, f3], [d0, d1, d2]) = (other.f, other.differences());
        let (f0, d0, d2) = if is_back { (f3, d2, d0) } else { (f0, d0, d2) };
        let mut p = 1.0 / (1 << 30) as f32;
        while p < 1.0 && p * (3.0 * d0 + p * (3.0 * (d1 - d0) + p * (d0 - 2.0 * d1 + d2))) < time {
            p *= 2.0;
        }
        // f' is three times the differences, or between.
        let [e0, e1, e2] = [(f1 - f0).abs(), (f2 - f1).abs(), (f3 - f2).abs()];
        f0 + 3.0 * p * (e0 + e1 + e2)
    }
}

/// A polynomial as it is held against the exact time.
struct Served {
    octave: Octave,
    /// The time from the side's start that its value is added to.
    middle: f64,
    /// The unit of its value, in time.
    unit: f64,
    /// A bound of its slope.
    steep: f32,
    /// How far rounding takes a fraction.
    noise: f64,
}

/// What an error is held against, in single precision. An error of 1 is the greatest that is allowed.
struct Limits {
    /// What rounding adds to the error in time.
    rounding: f32,
    /// What a tick's fraction loses in 32 bits, in time.
    lost: f32,
    per_tick: f32,
    /// The greater one of both ends'.
    per_size: f32,
    /// The light in a unit of time beyond the ramp's inner end.
    beyond: f32,
    elapsed: [f32; 4],
    openness: [f32; 4],
}

impl Limits {
    /// Are errors in time, in light, and relative to the time as small as they have to be?
    #[inline(never)]
    const fn keep(&self, &[time, light, relative]: &[f32; 3]) -> bool {
        let error = time + self.rounding;
        // How far along the ramp so much time is at most: it passes at the least slope at least, and a cubic that
        // never falls rises at least as fast as around a point where it stands still.
        let [_, t1, t2, t3] = self.elapsed;
        let (first, last) = (t1 - 2.0 * t2 + 3.0 * t3, t1 + 2.0 * t2 + 3.0 * t3);
        let slowest = quadratic_min([first as f64, (t1 - 3.0 * t3) as f64, last as f64]) as f32;
        let mut way = error / (t1.abs() + t2.abs() + t3.abs());
        while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error {
            way *= 2.0;
        }
        let [_, f1, f2, f3] = self.openness;
        let bends = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
        let light = light + self.rounding * absolute(&self.openness, 1.0) + error * way * bends;
        // Written so that a NaN fails.
        relative + self.rounding * self.per_size <= CERTAIN
            && (error + self.lost) * self.per_tick <= CERTAIN
            && light <= CERTAIN
            && error * self.beyond <= CERTAIN
    }
}

/// 1, but for what single precision rounds.
const CERTAIN: f32 = 1.0 - 1.0 / (1 << 16) as f32;

/// A cubic in single precision, times a factor.
const fn singles(&[c0, c1, c2, c3]: &[f64; 4], factor: f32) -> [f32; 4] {
    [c0 as f32 * factor, c1 as f32 * factor, c2 as f32 * factor, c3 as f32 * factor]
}

/// Where the offset is nearly as far between those of both ends as a `node` is between -1 and 1. A polynomial
/// interpolates wherever its nodes are; they need only be near Chebyshev's for its error to be small. So single
/// precision is enough, and no step is checked.
#[inline(never)]
const fn node(offsets: &[f32; 7], node: f32) -> f64 {
    let [x0, x1, x2, x3, x4, x5, x6] = *offsets;
    let (even, odd) = (x0 + x2 + x4 + x6, x1 + x3 + x5);
    let (mut s, mut steps) = (node, 0);
    while steps < 4 {
        let (mut value, mut slope) = (0.0, 0.0);
        let mut c: &[f32] = offsets;
        while let [lower @ .., highest] = c {
            slope = slope * s + value;
            value = value * s + *highest;
            c = lower;
        }
        let next = s - (value - (even + odd * node)) / slope;
        s = if next > 1.0 {
            1.0
        } else if next < -1.0 {
            -1.0
        } else {
            next
        };
        steps += 1;
    }
    s as f64
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

const fn power_of_two(exponent: i32) -> f64 {
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

    /// The nodes are its roots.
    #[test]
    fn nodes_are_those_of_chebyshev() {
        assert!(NODES.iter().all(|node| chebyshev(f64::from(*node)).abs() < 1e-5));
        assert!(NODES.is_sorted_by(|a, b| a < b));
    }
}
