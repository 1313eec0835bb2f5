//! The direct way: an octave of `u` as a polynomial that gives the time outright.
//!
//! Take `a`, the exposure's fraction from the nearer end of the curve: `u` or `1 - u`. Octaves of it shrink towards the
//! end as fast as the density may, and a polynomial of one degree is as good, relatively, in all. Each ramp has octaves of
//! its own, powers of two apart from its *top*, which is where the ramp ends, or somewhat more. So no octave holds parts of
//! two ramps. The plateau between them is answered by its line.
//!
//! The difference of the bits of the top's and of `a`'s `f32` counts the octaves between them, since the exponent is their
//! upper part. The offset within the octave is exact: the significand of `a`, less the octave's middle.

use crate::exposure::Exposure;
use crate::pair::fixed;

/// One octave's polynomial: the time is `middle + factor · P(x)` in the plan's unit, `x` from -1/2 to 1/2 across
/// the part of the octave that it serves, or somewhat less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave {
    middle: i64,
    /// A power of two, or minus that from the later side; 0 where there is no polynomial.
    factor: i32,
    /// From where `x` counts: a place of the octave, as [`Octave::offset`] has it; the lowest bits tell by which power of two
    /// `x` counts finer than that.
    center: u32,
    /// `P(x) = c[7] x + c[6] x² + ...`: the first to be needed comes first.
    c: [i32; DEGREE],
}

/// What an octave without a polynomial gives for a time, in units. (Where it is the time, a search gives the same.)
pub(crate) const NO_TIME: i64 = 1;

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

/// The bits of a center that are a power of two.
const FINER: u32 = 31;

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp.
const TIME_ERROR: f64 = 1.5 / (1u32 << 27) as f64;
/// The error in `u` that it may have, in ulp. Below 1/2 no two neighbouring `u` can change places,
/// not even where one octave hands over to the next.
const ULP_ERROR: f64 = 0.45;
/// What the rounding of products and of the middle adds at most, in the unit of the coefficients.
const NOISE: f64 = 2.5;

const WORD: f64 = 4294967296.0;

/// The bits of the least top: below 2⁻²⁸ there are no octaves, so that the bits of 0 are not among theirs.
const LEAST: u32 = (1.0 / (1 << 28) as f32).to_bits();

/// From here on a `u` loses no bit when counted in 2⁻³², as the plateau's line counts it.
pub(crate) const FINE: f32 = 1.0 / 512.0;

/// Tops are so many bits apart: eight to a power of two. So each fits a byte.
const STEP: u32 = 1 << 20;

/// By how many steps a top may be beyond the end of its ramp. A ramp's last octave is often too much for one polynomial; so cut,
/// its last part has one of its own, and the next octave ends before time runs too differently. The first number is taken that
/// leaves no octave without a polynomial.
const STRETCHES: [u32; 4] = [0, 5, 6, 4];

/// The bits of a top.
#[inline(always)]
pub(crate) const fn top(steps: u8) -> u32 {
    (steps as u32 + LEAST / STEP) * STEP
}

/// The fractions at which the octaves of a ramp begin and end, seen from a side. No side counts beyond 1/2.
pub(crate) const fn part(exposure: &Exposure, side: usize, ramp: usize) -> [f64; 2] {
    let [near, far] = exposure.joins(side);
    if ramp != side {
        return [far, 0.5];
    }
    // Behind so little, some of the plateau is not on its line, and nothing tells it from the ramp.
    let is_hidden = near < far && near < FINE as f64;
    let to = if near < 0.5 { near } else { 0.5 };
    [0.0, if is_hidden { 0.0 } else { to }]
}

/// Fits the octaves of a side, in units of time of `2^unit`. Returns the tops by ramp, in [`STEP`]s. The far ramp's octaves come first; the near ramp's top
/// stands so many octaves higher.
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
        let part = part(exposure, side, ramp);
        // Where there is no part, no polynomial fills the octaves that what is hidden falls into.
        let far = exposure.joins(side)[1];
        let hidden = if far < FINE as f64 { far } else { FINE as f64 };
        let (mut highest, mut end, mut stretch) = (stretched([0.0, hidden], 0), first, 0);
        while stretch < STRETCHES.len() && part[0] < part[1] {
            highest = stretched(part, STRETCHES[stretch]);
            let (mut is_whole, mut index) = (true, first);
            while index < octaves.len() {
                octaves[index] = Octave::NONE;
                if let Some(span) = Span::new(side, part, below(highest, index - first)) {
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

/// The bits of the top that is so many steps beyond the end of a part.
const fn stretched([from, to]: [f64; 2], steps: u32) -> u32 {
    let end = floor_bits(to);
    let top = if end > LEAST { end.div_ceil(STEP) * STEP } else { LEAST } + steps * STEP;
    // The first fraction of the part is not to be the last one of an octave below it.
    let beyond = top.wrapping_sub(floor_bits(from));
    if from > 0.0 && beyond.wrapping_add(16) & 0x7F_FFFF < 32 { top + STEP } else { top }
}

/// The bits of the top so many octaves below another one.
pub(crate) const fn below(top: u32, octaves: usize) -> u32 {
    top.saturating_sub((octaves as u32) << 23)
}

impl Octave {
    pub(crate) const NONE: Self = Self { middle: NO_TIME, factor: 0, center: 0, c: [0; DEGREE] };

    /// Is there a polynomial?
    #[inline(always)]
    pub(crate) const fn exists(&self) -> bool {
        self.factor != 0
    }

    /// The `x` of a place, in 2⁻³².
    ///
    /// A place is how far a significand is above 2³¹, if its exponent is that of the octave's top. If it is the one below, it is
    /// how far it is below 2³², negative, and counts half as much.
    #[inline(always)]
    pub(crate) const fn offset(&self, place: i32) -> i32 {
        let ahead = place & !(place >> 31);
        // What passes the ends of the word comes back.
        let x = place.wrapping_add(ahead).wrapping_sub(self.center as i32);
        x << (self.center & FINER)
    }

    /// The time, in the plan's unit, at an `x` that counts 2⁻³², by Horner's rule: each step is one
    /// multiply-and-add of 32 bits, and the last one of 64, on a microcontroller that has them.
    #[inline(always)]
    pub(crate) const fn time(&self, x: i32) -> i64 {
        self.middle.wrapping_add(self.factor as i64 * self.rest(x) as i64)
    }

    /// `P(x)`, written out, because firmware is often built for size, which would keep it a loop.
    #[inline(always)]
    const fn rest(&self, x: i32) -> i32 {
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

    /// The error where it peaks, through the very arithmetic that will run: small in time, and small
    /// in `u`, in which time's slope across the octave measures it.
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
            // What `f64` cannot tell of a time so far from the side's start counts, too.
            let error = error.abs() + exact / (1u64 << 51) as f64;
            let size = exposure.size_of_time(span.side, exact);
            // What an ulp of u is in time: at the ends the lesser one, since time may run slower beyond a join.
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
            if !(error <= TIME_ERROR * size && error + NOISE * scale <= ULP_ERROR * ulp) {
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
    /// What an offset of 1, that is 2³² units, is in `a`.
    width: f64,
    /// By which power of two that is less than the octave.
    finer: u32,
}

impl Span {
    /// Of the octave below the bits of its `top`; none where it holds nothing of the part.
    pub(crate) const fn new(side: usize, part: [f64; 2], top: u32) -> Option<Self> {
        let high = f32::from_bits(top) as f64;
        let from = if part[0] > 0.5 * high { part[0] } else { 0.5 * high };
        let to = if part[1] < high { part[1] } else { high };
        if top < LEAST || from >= to {
            return None;
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        // The significand of the top counts 2³¹ to 2³², and a unit of a place is half of one of its.
        let significand = (top << 8 | 1 << 31) as f64;
        let (mut width, mut finer) = (0.5 * high / significand * WORD, 0);
        // A small part of an octave fills the word, too, or else the coefficients would have few bits.
        while finer < FINER && half <= 0.25 * width {
            width *= 0.5;
            finer += 1;
        }
        Some(Self { side, from, middle, half, width, finer })
    }

    /// Twice the significand of the middle, nearly: where offsets count from.
    const fn center(&self) -> u64 {
        let octave = self.width * (1 << self.finer) as f64;
        (self.middle / octave * WORD) as u64 & !(FINER as u64) | self.finer as u64
    }

    /// The least ulp of `a` in the part.
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

/// The divided differences of the next order, of neighbours. Out of line, as the next one, for loops that are written out
/// over and over cost kilobytes.
#[inline(never)]
const fn divided_differences(d: &mut [f64; DEGREE + 1], x: &[f64; DEGREE + 1], order: usize) {
    let mut i = 0;
    // The first condition follows from the second; it spares checks where the compiler does not see that.
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

/// `a x`, in 32 bits, where `x` counts 2⁻³².
#[inline(always)]
const fn times_high(a: i32, x: i32) -> i32 {
    ((a as i64 * x as i64) >> 32) as i32
}

/// The bits of the greatest `f32` at or below a non-negative `x` that is at most about 1.
pub(crate) const fn floor_bits(x: f64) -> u32 {
    let rounded = x as f32;
    let bits = rounded.to_bits();
    if rounded as f64 > x { bits - 1 } else { bits }
}
