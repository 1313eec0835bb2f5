//! The direct way: an octave of `u` as a polynomial that gives the time outright.
//!
//! Take `a`, the exposure's fraction from the nearer end of the curve: `u` or `1 - u`. Octaves of it shrink towards the
//! end as fast as the density may, and a polynomial of one degree is as good, relatively, in all. Their boundaries
//! are a power of two apart from the *top* of their side, which is chosen so that where the near ramp ends is a boundary. So no
//! octave holds parts of two ramps. (One may hold the end of the plateau and the start of the far ramp; the plateau is
//! answered before by its line.)
//!
//! The difference of the bits of the top's and of `a`'s `f32` counts the octaves between them, since the exponent is their
//! upper part. The offset within the octave is exact: the significand of `a`, less the octave's middle.

use crate::exposure::Exposure;

/// One octave's polynomial: the time is `middle + factor · P(x)` in the plan's unit, `x` from -1/2 to 1/2 across
/// the octave, or somewhat less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Octave {
    middle: i64,
    /// A power of two, or minus that from the later side; 0 where there is no polynomial.
    factor: i32,
    /// The bits of the greatest `f32` in it.
    pub(crate) top: u32,
    /// `P(x) = c[0] x + c[1] x² + ...`
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

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp.
const TIME_ERROR: f64 = 1.5 / (1u32 << 27) as f64;
/// The error in `u` that it may have, in ulp. Below 1/2 no two neighbouring `u` can change places,
/// not even where one octave hands over to the next.
const ULP_ERROR: f64 = 0.45;
/// What the rounding of products and of the middle adds at most, in the unit of the coefficients.
const NOISE: f64 = 2.5;

const WORD: f64 = 4294967296.0;

/// Counts of a curve's times: the unit's exponent, and the times at which the sides start.
#[derive(Clone, Copy)]
pub(crate) struct Unit {
    pub(crate) exponent: i32,
    pub(crate) starts: [i64; 2],
}

/// The bits of the least top: below 2⁻³⁰ there are no octaves, so that the bits of 0 are not among theirs.
pub(crate) const LEAST: u32 = (1.0 / (1 << 30) as f32).to_bits();

/// The bits of the greatest `f32` that a side's octaves serve, or 0 where there are none: some to choose from, the best first.
///
/// It is 1/2 if the near ramp goes beyond that, or else where the near ramp ends. If the far ramp begins below 1/2, too, it is that
/// times a power of two, so that the octaves reach 1/2. Otherwise it may as well be somewhat more, which leaves the widest
/// octave less to serve.
pub(crate) const fn tops(exposure: &Exposure, side: usize) -> [u32; 3] {
    const HALF: u32 = 0.5f32.to_bits();
    let [near, far] = exposure.joins(side);
    let join = if near > 0.0 { near } else { far };
    let floor = floor_bits(join);
    // Next to 1/2 is 1/2 for a polynomial.
    if floor + 4 >= HALF {
        return [if near > 0.0 { HALF } else { 0 }, 0, 0];
    }
    // Up to the join, and where the plateau's line follows, which is asked before, to the next `f32`.
    let is_plateau = near > 1.0 / 512.0 && near < far;
    let bits = if is_plateau && (f32::from_bits(floor) as f64) < join { floor + 1 } else { floor };
    // Below 2⁻⁹ the line does not serve, and what is beyond the join has to be searched for.
    if far >= 0.5 && near <= 1.0 / 512.0 {
        [bits, 0, 0]
    } else if far >= 0.5 {
        [bits, floor_bits(1.25 * near), floor_bits(1.375 * near)]
    } else if bits < LEAST {
        [HALF, 0, 0]
    } else {
        // As many octaves up as reach 1/2.
        [bits + ((HALF - bits + (1 << 23) - 1) >> 23 << 23), 0, 0]
    }
}

impl Octave {
    pub(crate) const NONE: Self = Self { middle: NO_TIME, factor: 0, top: 0, c: [0; DEGREE] };

    /// Is there a polynomial?
    #[inline(always)]
    pub(crate) const fn exists(&self) -> bool {
        self.factor != 0
    }

    /// The offset of a significand, whose top bit is set, from the octave's middle.
    #[inline(always)]
    pub(crate) const fn offset(top: u32, significand: u32) -> i32 {
        let top = top << 8 | 1 << 31;
        // What is above the octave's top has the exponent below.
        let down = (significand > top) as u32;
        // Doubled, so that the offset fills the word; what passes its end comes back.
        (significand >> down << 1).wrapping_sub(top.wrapping_add(top >> 1)) as i32
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

    /// The polynomial of a side's octave below the bits of its `top`, without one where none keeps the promised error.
    pub(crate) const fn fit(exposure: &Exposure, unit: &Unit, side: usize, top: u32) -> Self {
        let high = f32::from_bits(top) as f64;
        let [near, far] = exposure.joins(side);
        // The part that lies on a ramp: on the near one, or behind what is not.
        let (half, high_or_half) = (0.5 * high, if high > 0.5 { 0.5 } else { high });
        let (from, to) = if near > half {
            // Where the far ramp follows within a trace, the polynomial has to serve its start, too.
            (half, if near < far && near < high { near } else { high_or_half })
        } else {
            (if far > half { far } else { half }, high_or_half)
        };
        let none = Self { top, ..Self::NONE };
        // Below 2⁻⁹ the plateau's line has not all of it.
        let is_beside_plateau = near < far && (from > half || near > half && near < high);
        if from >= to || is_beside_plateau && high < 1.0 / 128.0 {
            return none;
        }
        let part = Part { side, top, high, middle: 0.5 * (from + to), half: 0.5 * (to - from) };
        part.fitted(exposure, unit, none)
    }

    /// The error where it peaks, through the very arithmetic that will run: small in time, and small
    /// in `u`, in which time's slope across the octave measures it.
    const fn keeps_promise(
        &self,
        exposure: &Exposure,
        part: &Part,
        middle: f64,
        scale: f64,
    ) -> bool {
        let mut i = 0;
        while i < PEAKS.len() {
            let x = part.offset(PEAKS[i]);
            let exact = part.exact(exposure, x);
            let error = (middle + (self.rest(x) as f64 + 0.5) * scale) - exact;
            // What `f64` cannot tell of a time so far from the side's start counts, too.
            let error = error.abs() + exact / (1u64 << 51) as f64;
            let size = exposure.size_of_time(part.side, exact);
            // What an ulp of u is in time: at the ends the lesser one, since time may run slower beyond a join.
            let ulp = self.slope(x) * scale * part.ulp() / part.width();
            let beyond = if i == 0 {
                exact - exposure.elapsed(part.side, part.middle - part.half - part.ulp())
            } else if i + 1 == PEAKS.len() {
                exposure.elapsed(part.side, part.middle + part.half + part.ulp()) - exact
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

/// The part of an octave that its polynomial serves, in `a`.
struct Part {
    side: usize,
    top: u32,
    /// The octave's upper end.
    high: f64,
    middle: f64,
    half: f64,
}

impl Part {
    /// What an offset of 1, that is 2³² units, is in `a`.
    const fn width(&self) -> f64 {
        // The significand of the top counts 2³¹ to 2³², and a unit of the offset is half of one of its.
        let significand = (self.top << 8 | 1 << 31) as f64;
        0.5 * self.high / significand * WORD
    }

    /// The least ulp of `a` in the part.
    const fn ulp(&self) -> f64 {
        let least = (self.middle - self.half) as f32;
        least.next_up() as f64 - least as f64
    }

    /// The offset of a point of [-1, 1], in units of 2⁻³².
    const fn offset(&self, point: f64) -> i32 {
        // A cast saturates.
        ((self.middle + self.half * point - 0.75 * self.high) / self.width() * WORD) as i32
    }

    /// The exact time from the side's start at an offset.
    const fn exact(&self, exposure: &Exposure, x: i32) -> f64 {
        exposure.elapsed(self.side, 0.75 * self.high + x as f64 / WORD * self.width())
    }

    /// The octave with the polynomial, where it keeps the promise.
    const fn fitted(&self, exposure: &Exposure, unit: &Unit, none: Octave) -> Octave {
        let c = self.interpolate(exposure);

        // The largest value that Horner's rule meets fills 31 bits.
        let (mut bound, mut most, mut k) = (0.0, 0.0, DEGREE);
        while k > 0 {
            bound = c[k].abs() + bound / 2.0;
            most = if bound > most { bound } else { most };
            k -= 1;
        }
        if !(most > 0.0 && most < f64::MAX) {
            return none;
        }
        let exponent = (most.to_bits() >> 52) as i32 - 1023 - 30;
        let exponent = if exponent < unit.exponent { unit.exponent } else { exponent };
        if exponent - unit.exponent > 30 {
            return none;
        }
        let scale = power_of_two(exponent);
        let factor = 1 << (exponent - unit.exponent);
        let mut octave = Octave { factor, ..none };
        let mut k = 0;
        while k < DEGREE {
            octave.c[k] = round(c[k + 1] / scale);
            k += 1;
        }
        // Each product is rounded down, by half a unit on average, and only the last one's counts in full.
        let middle = (c[0] / power_of_two(unit.exponent)) as i64 + factor as i64 / 2;
        let start = unit.starts[self.side & 1];
        octave.middle = if self.side == 0 { start + middle } else { start - middle };
        octave.factor = if self.side == 0 { factor } else { -factor };
        if octave.keeps_promise(exposure, self, c[0], scale) { octave } else { none }
    }

    /// The coefficients, from `x⁰` up, of the polynomial through the exact times at the nodes.
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
