//! How the octaves of a side are built: the polynomial through the exact times at a few nodes, which is kept if a
//! certificate says that it keeps the promise.

use crate::certificate::{KINDS, WAYS, errors};
use crate::exposure::Exposure;
use crate::octave::{DEGREE, FINER, Octave, below};
use crate::path::{Path, absolute, root, scale, singles, unknown, value};
use crate::shape::Shape;
use crate::units::{
    FINE, LEAST_TOP, TOP_STEP, WORD, exponent, fixed, floor_bits, power_of_two, power_of_two_f64,
};

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

/// The error in time that a polynomial may have, relative to the time: below 0.19 ulp.
pub(crate) const FORWARD_ERROR: f32 = 1.5 / (1u32 << 27) as f32;
/// The error in time that it may have, relative to the interval, with what a tick's fraction loses in 32 bits: below a
/// quarter of a tick in an interval of 2²⁴, of which 1/40 is left for the tick's own rounding.
pub(crate) const TICK_ERROR: f32 = 0.9 / (1u32 << 26) as f32;
/// The error in `u` that it may have, in ulp of where its span begins. Neighbouring `u` are at least an ulp of the lesser
/// one apart, so below 1/2 their times cannot change places, also not where one octave follows another.
pub(crate) const ULP_ERROR: f32 = 0.49;

/// What the rounding of Horner's products adds, in the unit of the coefficients: from -1.992 to 0.664
/// (`proofs/octaves.py`). A polynomial's middle makes up for the middle of that.
const TRUNCATION: f32 = 1.328;
const TRUNCATED: f64 = -0.664;

/// How far off a fraction may be, by this and by this share of it: where an octave's ramp is looked up, for joins are
/// rounded, and on a path, where it is a sum of terms up to 1083 times as great, with 60 roundings of an `f64`.
// proofs/certificate.py
pub(crate) const OFF: [f32; 2] = [1.0 / (1u64 << 54) as f32, 1.0 / (1u64 << 36) as f32];
/// The same of a time.
const ROUNDED: f32 = 1.0 / (1u64 << 46) as f32;

/// As long as half of a part is at most this share of the width, the unit is halved; so the half is at most 0.48 of it. The
/// 0.02 · 2³² that this leaves of the word is more than a center's lowest five bits, shifted by the most.
// proofs/octaves.py
const FILLED: f32 = 0.24;
const MOST_FINER: u32 = 17;

/// By how many steps a top may be beyond the end of its ramp. A ramp's last octave is often too much for one
/// polynomial. If the tops are moved out, the last part of the ramp has a polynomial of its own. The first number is
/// taken that leaves no octave without a polynomial, or else the last.
const STRETCHES: [u32; 4] = [0, 5, 6, 4];

/// The fractions between which a ramp has octaves, seen from a side. No side counts beyond 1/2.
pub(crate) const fn range(exposure: &Exposure, side: usize, ramp: usize) -> [f64; 2] {
    let [near, far] = exposure.joins(side);
    if ramp != side {
        return [far, 0.5];
    }
    // If the near ramp ends below FINE, the plateau from there to FINE is not on its line, and the look-up takes it for
    // a part of this ramp. So this ramp gets no octaves.
    let is_hidden = near < far && near < FINE as f64;
    let to = if near < 0.5 { near } else { 0.5 };
    [0.0, if is_hidden { 0.0 } else { to }]
}

/// A side of the curve, as its octaves are built.
pub(crate) struct Side<'a> {
    pub(crate) exposure: &'a Exposure,
    pub(crate) shapes: &'a [Shape; 2],
    pub(crate) side: usize,
    /// The exponent of the unit of time.
    pub(crate) unit: i32,
}

/// Builds the octaves of a side, in units of time of `2^unit`. Returns the tops by ramp, in [`TOP_STEP`]s above [`LEAST_TOP`].
/// The far ramp's octaves come first, and the near ramp's top is raised by one octave for each of them.
///
/// Out of line, and with a slice, so that it is the same for any number of octaves.
#[inline(never)]
pub(crate) const fn build(
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
        let path = this.path(ramp);
        while stretch < STRETCHES.len() && range[0] < range[1] {
            highest = stretched(range, STRETCHES[stretch]);
            stretch += 1;
            let mut index = first;
            while index < octaves.len() {
                octaves[index] = Octave::NONE;
                let top = below(highest, index - first);
                // An octave below the least top has a place, too, or a fraction there would be looked up in the next
                // ramp's.
                if f32::from_bits(top) as f64 > range[0] && top + (1 << 23) > LEAST_TOP {
                    end = index + 1;
                }
                if let Some(span) = Span::new(range, top) {
                    octaves[index] = this.octave(ramp, &path, &span);
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
        tops[ramp & 1] = ((highest - LEAST_TOP + ((first as u32) << 23)) / TOP_STEP) as u8;
        first = end;
        i += 1;
    }
    tops
}

/// The bits of the top that is so many steps beyond the end of a range.
const fn stretched([from, to]: [f64; 2], steps: u32) -> u32 {
    // At or above the end, or a 64-bit fraction below it would be looked up in the octave above.
    let end = floor_bits(to);
    let end = if (f32::from_bits(end) as f64) < to { end + 1 } else { end };
    let top = if end > LEAST_TOP { end.div_ceil(TOP_STEP) * TOP_STEP } else { LEAST_TOP }
        + steps * TOP_STEP;
    // If the range began within some ulp of an octave's end, rounding might put its first fraction into the octave
    // below.
    let beyond = top.wrapping_sub(floor_bits(from));
    if from > 0.0 && beyond.wrapping_add(16) & 0x7F_FFFF < 32 { top + TOP_STEP } else { top }
}

/// The part of an octave that its polynomial serves, in `a`.
pub(crate) struct Span {
    /// Where it begins, and where it ends.
    pub(crate) from: f64,
    pub(crate) to: f32,
    /// The middle, and how far the polynomial reaches from there: some ulp beyond what it serves.
    pub(crate) middle: f32,
    pub(crate) half: f32,
    /// The power of two that is in the octave, or at its end: what positions count 2⁻³² of.
    pub(crate) octave: f32,
    /// What offsets count 2⁻³² of: 2 to minus `finer` of that.
    width: f32,
    finer: u32,
}

impl Span {
    /// Of the octave below the bits of its `top`; none where it holds nothing of the range.
    pub(crate) const fn new(range: [f64; 2], top: u32) -> Option<Self> {
        let high = f32::from_bits(top);
        let from = if range[0] > 0.5 * high as f64 { range[0] } else { 0.5 * high as f64 };
        let to = if range[1] < high as f64 { range[1] } else { high as f64 };
        if top < LEAST_TOP || from >= to {
            return None;
        }
        let to = to as f32;
        let octave = power_of_two(exponent(high));
        let half = 0.5 * (to - from as f32) + 4.0 * f32::EPSILON * octave;
        let middle = 0.5 * (from as f32 + to);
        // A small part of an octave fills the word, too, or the coefficients would have few bits. But not all of it: the
        // center's lowest bits are a shift, so that an offset is beyond the half by as much, times 2 to the shift. At
        // a quarter of the width, a half of exactly this left the word, and the polynomial gave the time of its other
        // end.
        let (mut width, mut finer) = (octave, 0);
        while finer < MOST_FINER && half <= FILLED * width {
            width *= 0.5;
            finer += 1;
        }
        Some(Self { from, to, middle, half, octave, width, finer })
    }

    /// The middle's position, nearly, with the shift in its lowest bits; in 33 bits, as it counts from 0.
    const fn center(&self) -> u64 {
        (self.middle / self.octave * WORD) as u64 & !(FINER as u64) | self.finer as u64
    }

    /// A stretch, its fractions counted as positions are, from the power of two on.
    pub(crate) const fn counted(&self, mut stretch: Path) -> Path {
        stretch.fraction[0] -= self.octave as f64;
        scale(&mut stretch.fraction, (WORD / self.octave) as f64, 1.0);
        stretch
    }

    /// The center as a position, and the offset of a position.
    const fn offsets(&self) -> (f64, f64) {
        (self.center() as f64 - WORD as f64, (self.octave / self.width / WORD) as f64)
    }

    /// The coefficients, from `x⁰` up, of the polynomial through the times at the nodes.
    #[inline(never)]
    const fn interpolated(&self, along: &Path) -> [f64; DEGREE + 1] {
        let (center, per_position) = self.offsets();
        let mut offset = singles(&along.fraction, center, per_position);
        let [x0, x1, x2, x3, x4, x5, x6] = offset;
        let (even, odd) = (x0 + x2 + x4 + x6, x1 + x3 + x5);
        // Divided differences ...
        let (mut x, mut d, mut i) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1], DEGREE + 1);
        loop {
            i = unknown(i).wrapping_sub(1);
            if i > DEGREE {
                break;
            }
            // A polynomial interpolates wherever its nodes are. They need only be near Chebyshev's, from one end to the
            // other, for its error to be small; so single precision is enough.
            offset[0] = x0 - (even + odd * NODES[i]);
            let [place, _] = root(&offset, [-1.0, 1.0], NODES[i]);
            let place = place as f64;
            x[i] = (value(&along.fraction, place) - center) * per_position;
            d[i] = value(&along.time, place);
        }
        let mut order = 1;
        while order <= DEGREE {
            divided_differences(&mut d, &x, order);
            order = unknown(order + 1);
        }
        // ... multiplied out into powers of x, from the highest order on.
        let (mut c, mut i) = ([0.0; DEGREE + 1], DEGREE + 1);
        loop {
            i = unknown(i).wrapping_sub(1);
            if i > DEGREE {
                return c;
            }
            multiply(&mut c, x[i], d[i]);
        }
    }
}

/// A polynomial as it is held against the exact time.
pub(crate) struct Candidate {
    pub(crate) octave: Octave,
    /// The time from the side's start that its value is added to.
    middle: f64,
    /// The unit of its value, in time.
    unit: f64,
    /// A bound of its slope.
    steep: f32,
    /// What rounding adds to it, with that of the side's start.
    truncated: f32,
}

impl Side<'_> {
    pub(crate) const fn path(&self, ramp: usize) -> Path {
        Path::new(self.exposure, &self.shapes[ramp & 1], self.side, ramp)
    }

    /// The octave of a part of a ramp, with a polynomial where one keeps the promise.
    #[inline(never)]
    const fn octave(&self, ramp: usize, path: &Path, span: &Span) -> Octave {
        let ends = [(span.middle - span.half) as f64, (span.middle + span.half) as f64];
        let places = [path.place(ends[0], false), path.place(ends[1], true)];
        let stretch = span.counted(path.stretch(places));
        let Some(candidate) = self.candidate(span, &stretch) else { return Octave::NONE };
        let mut is_certain = certain(&self.certificate(&candidate, span, stretch, ramp, places));
        // Without a plateau, and with a join so near to 1/2 that it counts as that, the near ramp's polynomial serves
        // what is beyond the join, too.
        let join = self.exposure.exact_joins(self.side)[0];
        if ramp == self.side && !self.exposure.has_plateau() && span.to >= 0.5 && join < 0.5 {
            let path = self.path(ramp ^ 1);
            let places = [0.0, path.place(ends[1], true)];
            let stretch = span.counted(path.stretch(places));
            let beyond = self.certificate(&candidate, span, stretch, ramp ^ 1, places);
            is_certain = is_certain && certain(&beyond);
        }
        if is_certain { candidate.octave } else { Octave::NONE }
    }

    /// The polynomial along a stretch, in the unit in which its coefficients fill their words.
    #[inline(always)]
    pub(crate) const fn candidate(&self, span: &Span, stretch: &Path) -> Option<Candidate> {
        let c = span.interpolated(stretch);
        // The largest value that Horner's rule meets fills 31 bits; rounding may not bring it beyond.
        let reach = span.half / span.width + 0.01;
        let (mut bound, mut most, mut steep, mut k) = (0.0, 0.0, 0.0, DEGREE);
        while k > 0 && k <= DEGREE {
            steep = steep * reach + bound;
            bound = c[k].abs() as f32 + bound * reach;
            most = if bound > most { bound } else { most };
            k = unknown(k - 1);
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
        let (unit, per_unit) = (power_of_two_f64(exponent), power_of_two_f64(-exponent));
        let factor = 1 << (exponent - self.unit);
        let mut octave = Octave { center: span.center() as u32, ..Octave::NONE };
        let mut k = DEGREE;
        while k > 0 && k <= DEGREE {
            octave.c[DEGREE - k] = round(c[k] * per_unit);
            k = unknown(k - 1);
        }
        let middle = (c[0] * power_of_two_f64(-self.unit) - TRUNCATED * factor as f64) as i64;
        let start = fixed(self.exposure.outer(self.side), self.unit);
        octave.middle = if self.side == 0 { start + middle } else { start - middle };
        octave.factor = if self.side == 0 { factor } else { -factor };
        Some(Candidate {
            octave,
            middle: middle as f64 * power_of_two_f64(self.unit),
            unit,
            steep: steep * per_unit as f32,
            truncated: TRUNCATION + 1.0 / factor as f32,
        })
    }

    /// Bounds of a polynomial's errors along a stretch of a ramp between two places, in what they may be at most.
    #[inline(never)]
    pub(crate) const fn certificate(
        &self,
        candidate: &Candidate,
        span: &Span,
        mut along: Path,
        ramp: usize,
        [first, last]: [f64; 2],
    ) -> [f32; 4] {
        let Candidate { ref octave, middle, unit, steep, truncated } = *candidate;
        let (exposure, side) = (self.exposure, self.side);
        // What an error may be is 1 in each of these units.
        let ends = [value(&along.time, -1.0), value(&along.time, 1.0)];
        let (off, ulp) = (
            OFF[0] + OFF[1] * span.to,
            power_of_two(exponent(f32::from_bits(floor_bits(span.from))) - 23),
        );
        let per = unit as f32;
        let per_tick = per / (exposure.outer(1) - exposure.outer(0)) / TICK_ERROR;
        // In `f64`, since the openness of a single curve may have any scale.
        let per_light = unit / exposure.area / (ULP_ERROR * ulp - off) as f64;
        let per_size = [
            per / self.size_of_time(ends[0]) / FORWARD_ERROR,
            per / self.size_of_time(ends[1]) / FORWARD_ERROR,
        ];
        // In the unit of the coefficients.
        along.time[0] -= middle;
        scale(&mut along.time, 1.0 / unit, 1.0);
        let time = singles(&along.time, 0.0, 1.0);
        let openness = singles(&along.openness, 0.0, per_light);
        // The error is relative to a size that follows the time, or is constant. The size's reciprocal is convex in time, so
        // it lies below the chord between both ends.
        let [_, t1, t2, t3] = time;
        let half = 0.5 * (per_size[1] - per_size[0]) / (t1 + t3);
        let size = [0.5 * (per_size[0] + per_size[1]) - half * t2, half * t1, half * t2, half * t3];
        let (center, per_position) = span.offsets();
        let offset = singles(&along.fraction, center, per_position);
        let is_joined = if ramp == side { last >= 1.0 } else { first <= 0.0 };
        let limits = Limits {
            rounding: truncated + steep * off / span.width + (ends[1] / unit) as f32 * ROUNDED,
            lost: steep * 2.0 * (per_position as f32),
            per_tick,
            per_size: if per_size[0] > per_size[1] { per_size[0] } else { per_size[1] },
            beyond: if is_joined {
                (self.greatest_beyond(ramp, per / per_tick) * per_light) as f32
            } else {
                0.0
            },
            time,
            openness,
        };
        let weights = [[1.0, 0.0, 0.0, 0.0], openness, size];
        let noise = limits.rounding + 0.25 * limits.lost;
        let (mut way, mut bounds) = (0, [f32::INFINITY; 4]);
        while way < WAYS {
            let errors = errors(octave, &along, &offset, &weights, noise, way);
            bounds = limits.share(&errors.most);
            // If the samples alone are too wrong, no closer bound helps.
            way = if certain(&bounds) || !certain(&limits.share(&errors.least)) {
                WAYS
            } else {
                way + 1
            };
        }
        bounds
    }

    /// What an error in time is relative to: the time itself, or, if the curve runs across time 0, its farther end; but
    /// at most the interval, since ticks are counted from its start.
    #[inline(never)]
    pub(crate) const fn size_of_time(&self, since: f64) -> f32 {
        let [start, end] = [self.exposure.outer(0), self.exposure.outer(1)];
        let time = if self.side == 0 { start as f64 + since } else { end as f64 - since };
        let size = if !(start < 0.0 && end > 0.0) {
            (time as f32).abs()
        } else if end > -start {
            end
        } else {
            -start
        };
        if size < end - start { size } else { end - start }
    }

    /// A bound of the openness within some time of where a ramp meets the plateau or the other ramp, on the other side.
    #[inline(never)]
    const fn greatest_beyond(&self, ramp: usize, time: f32) -> f64 {
        if self.exposure.has_plateau() {
            return 1.0;
        }
        // Seen from there.
        let (other, is_back) = (&self.shapes[(ramp ^ 1) & 1], ramp == 1);
        let ([f0, f1, f2, f3], [d0, d1, d2]) = (other.f, other.differences());
        let (f0, d0, d2) = if is_back { (f3, d2, d0) } else { (f0, d0, d2) };
        let (mut p, mut doublings) = (1.0 / (1 << 30) as f32, 30);
        while doublings > 0
            && p * (3.0 * d0 + p * (3.0 * (d1 - d0) + p * (d0 - 2.0 * d1 + d2))) < time
        {
            p *= 2.0;
            doublings = unknown(doublings - 1);
        }
        // f' is three times the differences, or between.
        let bends = (f1 - f0).abs() + (f2 - f1).abs() + (f3 - f2).abs();
        f0 as f64 + 3.0 * p as f64 * bends as f64
    }
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
    time: [f32; 4],
    openness: [f32; 4],
}

impl Limits {
    /// Errors in time, in light, and relative to the time, with what rounding adds, as shares of what they may be: for a
    /// tick, relative to the time, in light, and in light beyond the ramp.
    #[inline(never)]
    const fn share(&self, &[time, light, relative]: &[f32; KINDS]) -> [f32; 4] {
        let error = time + self.rounding;
        // How far along the ramp so much time is at most: it passes at the least slope at least, and a cubic that
        // never falls rises at least as fast as around a point where it stands still.
        let [_, t1, t2, t3] = self.time;
        let (thrice, most) = (3.0 * t3, t1.abs() + 2.0 * t2.abs() + 3.0 * t3.abs());
        let slowest =
            if thrice > t2.abs() { t1 - t2 * t2 / thrice } else { t1 + thrice - 2.0 * t2.abs() };
        let slowest = slowest - most / (1 << 20) as f32;
        let mut way = error / most;
        while way < 2.0 && way * slowest < error && way * way * way * t3 < 4.0 * error {
            way *= 2.0;
        }
        let [_, f1, f2, f3] = self.openness;
        let bends = f1.abs() + 2.0 * f2.abs() + 3.0 * f3.abs();
        [
            (error + self.lost) * self.per_tick,
            relative + self.rounding * self.per_size,
            light + self.rounding * absolute(&self.openness, 1.0) + error * way * bends,
            error * self.beyond,
        ]
    }
}

/// Is none more than it may be? Written so that a NaN fails.
const fn certain(&[tick, relative, light, beyond]: &[f32; 4]) -> bool {
    tick <= CERTAIN && relative <= CERTAIN && light <= CERTAIN && beyond <= CERTAIN
}

/// 1, but for what single precision rounds.
const CERTAIN: f32 = 1.0 - 1.0 / (1 << 16) as f32;

/// The divided differences of the next order, in the places from it on. Out of line, as the next function, because loops
/// that the compiler unrolls in each place cost kilobytes.
#[inline(never)]
const fn divided_differences(d: &mut [f64; DEGREE + 1], x: &[f64; DEGREE + 1], order: usize) {
    let (mut i, mut last) = (order.wrapping_sub(1), 0.0);
    while i <= DEGREE {
        let (this, first) = (d[i], i.wrapping_sub(order));
        // Not where it has but begun.
        if first <= DEGREE {
            d[i] = (this - last) / (x[i] - x[first]);
        }
        last = this;
        i = unknown(i + 1);
    }
}

/// A polynomial times `x - root`, and a constant added.
#[inline(never)]
const fn multiply(c: &mut [f64; DEGREE + 1], root: f64, constant: f64) {
    let mut k = DEGREE;
    while k > 0 && k <= DEGREE {
        c[k] = c[k - 1] - c[k] * root;
        k = unknown(k - 1);
    }
    c[0] = constant - c[0] * root;
}

const fn round(x: f64) -> i32 {
    (if x < 0.0 { x - 0.5 } else { x + 0.5 }) as i32
}
