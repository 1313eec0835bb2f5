//! How the octaves of a side are fitted, when a curve is built: the polynomial through the exact times at a few nodes,
//! which is kept if a certificate says that it keeps the promise.

use crate::certificate::{WAYS, absolute, errors, value};
use crate::cubic::{quadratic_min, sqrt};
use crate::exposure::Exposure;
use crate::octave::{DEGREE, FINE, FINER, LEAST, Octave, STEP, below, floor_bits, range};
use crate::pair::{exponent, fixed};
use crate::path::{Path, Stretch};
use crate::shape::Shape;

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

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp.
const FORWARD_ERROR: f64 = 1.5 / (1u32 << 27) as f64;
/// The error in time that it may have, relative to the interval, with what a tick's fraction loses in 32 bits: below a
/// quarter of a tick in an interval of 2²⁴, of which 1/40 is left for the tick's own rounding.
const TICK_ERROR: f64 = 0.9 / (1u32 << 26) as f64;
/// The error in `u` that it may have, in ulp. Neighbouring `u` are an ulp apart, so below 1/2 their times cannot change
/// places, also not where one octave follows another.
const ULP_ERROR: f64 = 0.49;

/// What the rounding of Horner's products adds, in the unit of the coefficients: from -1.992 to 0.664
/// (proofs/octave.py). A polynomial's middle makes up for the middle of that.
const TRUNCATION: f64 = 1.328;
const TRUNCATED: f64 = -0.664;

/// An octave's ramp is looked up by joins that are rounded by this and by this share of them.
const JOIN: [f64; 2] = [1.0 / (1u64 << 54) as f64, 1.0 / (1u64 << 43) as f64];

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

    /// The middle's significand, nearly, doubled; and the shift in its lowest bits.
    const fn center(&self) -> u64 {
        (self.middle / self.octave * WORD) as u64 & !(FINER as u64) | self.finer as u64
    }

    /// A stretch, whose fractions become offsets from the center.
    const fn counted(&self, mut along: Stretch) -> Stretch {
        along.fraction[0] -= self.center() as f64 / WORD * self.octave;
        let (per_width, mut k) = (1.0 / self.width(), 0);
        while k < along.fraction.len() {
            along.fraction[k] *= per_width;
            k += 1;
        }
        along.noise *= per_width;
        along
    }
}

/// A polynomial in the unit of its coefficients, as an octave evaluates it.
struct Fitted {
    /// From that of `x` up.
    q: [f64; DEGREE],
    /// The time from the side's start that its value is added to.
    middle: f64,
    /// The unit of its value, in time.
    scale: f64,
    /// A bound of its slope.
    steep: f64,
}

/// What errors may be, in the unit of the coefficients.
struct Limits {
    /// What rounding adds to each error in time.
    rounding: f64,
    /// What a tick's fraction loses in 32 bits, in time.
    lost: f64,
    /// Relative to the time.
    relative: f64,
    /// In a tick's time.
    tick: f64,
    /// In exposure.
    light: f64,
}

impl Side<'_> {
    /// The octave of a part of a ramp, with a polynomial where one keeps the promise.
    const fn fitted(&self, ramp: usize, path: &Path, span: &Span) -> Octave {
        let first = path.place(span.middle - span.half, false);
        let last = path.place(span.middle + span.half, true);
        let along = span.counted(path.stretch(first, last));
        let c = interpolated(&along);

        // The largest value that Horner's rule meets fills 31 bits.
        let reach = span.half / span.width() + 0.01;
        let (mut bound, mut most, mut steep, mut k) = (0.0, 0.0, 0.0, DEGREE);
        while k > 0 {
            steep = steep * reach + bound;
            bound = c[k].abs() + bound * reach;
            most = if bound > most { bound } else { most };
            k -= 1;
        }
        steep = steep * reach + bound;
        // Rounding may not bring it beyond.
        most *= 1.0 + 1.0 / (1 << 20) as f64;
        if !(most > 0.0 && most < f64::MAX) {
            return Octave::NONE;
        }
        let exponent = (most.to_bits() >> 52) as i32 - 1023 - 30;
        let exponent = if exponent < self.unit { self.unit } else { exponent };
        if exponent - self.unit > 30 {
            return Octave::NONE;
        }
        let (scale, unit) = (power_of_two(exponent), power_of_two(self.unit));
        let factor = 1 << (exponent - self.unit);
        let mut octave = Octave { center: span.center() as u32, ..Octave::NONE };
        let (mut q, mut k) = ([0.0; DEGREE], 0);
        while k < DEGREE {
            let rounded = round(c[k + 1] / scale);
            octave.c[DEGREE - 1 - k] = rounded;
            q[k] = rounded as f64;
            k += 1;
        }
        let middle = (c[0] / unit - TRUNCATED * factor as f64) as i64;
        let start = fixed(self.exposure.start(self.side), self.unit);
        octave.middle = if self.side == 0 { start + middle } else { start - middle };
        octave.factor = if self.side == 0 { factor } else { -factor };

        let fitted = Fitted { q, middle: middle as f64 * unit, scale, steep: steep / scale };
        let is_joined = if ramp == self.side { last >= 1.0 } else { first <= 0.0 };
        if !self.is_certain(&fitted, span, along, ramp, is_joined) {
            return Octave::NONE;
        }
        octave
    }

    /// Does a polynomial keep the promise on a stretch of a ramp? `is_joined` says whether the stretch reaches the ramp's
    /// inner end.
    #[inline(never)]
    const fn is_certain(
        &self,
        polynomial: &Fitted,
        span: &Span,
        mut along: Stretch,
        ramp: usize,
        is_joined: bool,
    ) -> bool {
        let Fitted { ref q, middle, scale, steep } = *polynomial;
        let (exposure, side) = (self.exposure, self.side);
        let [t0, t1, t2, t3] = along.elapsed;
        let ends = [t0 - t1 + t2 - t3, t0 + t1 + t2 + t3];
        // What the error in time is relative to changes as fast as the time, or not at all. Its reciprocal is below each
        // line between two of its points.
        let sizes = [exposure.size_of_time(side, ends[0]), exposure.size_of_time(side, ends[1])];
        let roots = [sqrt(sizes[0]), sqrt(sizes[1])];
        let between = ends[0] + (ends[1] - ends[0]) * (roots[0] / (roots[0] + roots[1]));
        let size = exposure.size_of_time(side, between);
        let early = line(&along.elapsed, [ends[0], between], [1.0 / sizes[0], 1.0 / size]);
        let late = line(&along.elapsed, [between, ends[1]], [1.0 / size, 1.0 / sizes[1]]);
        let weights = [along.openness, early, late];

        // From here on in the unit of the coefficients.
        along.elapsed = [(t0 - middle) / scale - TRUNCATED, t1 / scale, t2 / scale, t3 / scale];
        let joins = JOIN[0] + JOIN[1] * span.to;
        let rounding = TRUNCATION
            + steep * (along.noise + joins / span.width())
            + ends[1] / scale / (1u64 << 48) as f64;
        let limits = Limits {
            rounding,
            lost: steep * (2u64 << span.finer) as f64 / WORD,
            relative: FORWARD_ERROR / scale
                - rounding / if sizes[0] < sizes[1] { sizes[0] } else { sizes[1] },
            tick: TICK_ERROR * (exposure.start(1) as f64 - exposure.start(0) as f64) / scale,
            light: (ULP_ERROR * span.ulp - joins) * exposure.area / scale,
        };
        let mut way = 0;
        while way < WAYS {
            let errors = errors(q, &along, &weights, way);
            if !self.keeps(&errors.seen, &limits, &along, ramp, is_joined, scale) {
                return false;
            }
            if self.keeps(&errors.bound, &limits, &along, ramp, is_joined, scale) {
                return true;
            }
            way += 1;
        }
        false
    }

    /// Are errors within the limits?
    const fn keeps(
        &self,
        &[time, light, early, late]: &[f64; 4],
        limits: &Limits,
        along: &Stretch,
        ramp: usize,
        is_joined: bool,
        scale: f64,
    ) -> bool {
        let error = time + limits.rounding;
        // Written so that a NaN fails.
        if !(early <= limits.relative
            && late <= limits.relative
            && error + limits.lost <= limits.tick)
        {
            return false;
        }
        // How far along the ramp so much time is at most: it passes at the least slope at least, and a cubic that
        // never falls rises at least as fast as around a point where it stands still.
        let [_, t1, t2, t3] = along.elapsed;
        let slowest =
            quadratic_min([t1 - 2.0 * t2 + 3.0 * t3, t1 - 3.0 * t3, t1 + 2.0 * t2 + 3.0 * t3]);
        let mut way = error / (t1.abs() + t2.abs() + t3.abs());
        while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error {
            way *= 2.0;
        }
        let [_, f1, f2, f3] = along.openness;
        let bends = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
        let light = light + limits.rounding * absolute(&along.openness, 1.0) + error * way * bends;
        let beyond = if is_joined { self.greatest_beyond(ramp, error * scale) } else { 0.0 };
        light <= limits.light && error * beyond <= limits.light
    }

    /// The greatest openness within some time of where a ramp meets the plateau or the other ramp, on the other side.
    const fn greatest_beyond(&self, ramp: usize, time: f64) -> f64 {
        if self.exposure.has_plateau() {
            return 1.0;
        }
        let shape = if ramp == 1 { self.shapes[0].reversed() } else { self.shapes[1] };
        let (f, t) = (shape.openness(), shape.elapsed());
        let mut p = 1.0 / (1 << 30) as f64;
        while p < 1.0 && p * value(&t.c, p) < time {
            p *= 2.0;
        }
        f.value.abs() + p * absolute(&f.c, p)
    }
}

/// The line through two points, as a polynomial of what a cubic is one of.
const fn line(c: &[f64; 4], [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> [f64; 4] {
    let slope = (y1 - y0) / (x1 - x0);
    [y0 + slope * (c[0] - x0), slope * c[1], slope * c[2], slope * c[3]]
}

/// The coefficients, from `x⁰` up, of the polynomial through the times at the nodes.
#[inline(never)]
const fn interpolated(along: &Stretch) -> [f64; DEGREE + 1] {
    let [first, last] = [value(&along.fraction, -1.0), value(&along.fraction, 1.0)];
    let (mut x, mut d) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
    let mut i = 0;
    while i <= DEGREE {
        let s = place(
            &along.fraction,
            0.5 * (first + last) + 0.5 * (last - first) * NODES[i],
            NODES[i],
        );
        x[i] = value(&along.fraction, s);
        d[i] = value(&along.elapsed, s);
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

/// Where the fraction is nearly `x`, from a first guess on. A polynomial interpolates wherever its nodes are; they need
/// only be near Chebyshev's for its error to be small. So single precision is enough, and no step is checked.
#[inline(never)]
const fn place(fraction: &[f64; 7], x: f64, guess: f64) -> f64 {
    let mut s = guess as f32;
    let mut steps = 0;
    while steps < 4 {
        let (mut value, mut slope, mut k) = (0.0, 0.0, 7);
        while k > 0 {
            k -= 1;
            slope = slope * s + value;
            value = value * s + fraction[k] as f32;
        }
        let next = s - (value - x as f32) / slope;
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
        assert!(NODES.iter().all(|node| chebyshev(*node).abs() < 1e-13));
        assert!(NODES.is_sorted_by(|a, b| a < b));
    }
}
