//! A ramp as the octaves of one side see it: openness, time and fraction of the exposure as polynomials of the Bezier's
//! parameter `p`, in `f64`.
//!
//! Seen so, nothing has to be inverted: each `p` has its time and its fraction, and what a polynomial of the fraction is
//! off by is itself a polynomial of `p` ([`certificate`](crate::certificate)).

use crate::cubic::{Cubic, integral};
use crate::exposure::Exposure;
use crate::shape::Shape;

/// A ramp from the end that faces a side.
#[derive(Clone, Copy)]
pub(crate) struct Path {
    openness: Cubic,
    /// The time since the side's start.
    elapsed: Cubic,
    /// The fraction collected since the side's start: at the end that faces it, and by powers of `p`.
    from: f64,
    collected: [f64; 6],
    area: f64,
}

/// A stretch of a path, by powers of `s`, which runs from -1 to 1 on it.
pub(crate) struct Stretch {
    pub(crate) openness: [f64; 4],
    pub(crate) elapsed: [f64; 4],
    pub(crate) fraction: [f64; 7],
    /// A bound of what rounding makes of a fraction here.
    pub(crate) noise: f64,
}

impl Path {
    /// The ramp with this shape and index.
    pub(crate) const fn new(exposure: &Exposure, shape: &Shape, side: usize, ramp: usize) -> Self {
        let shape = if side == 0 { *shape } else { shape.reversed() };
        let mut elapsed = shape.elapsed();
        let mut from = 0.0;
        if ramp != side {
            let way = exposure.plateau_start(side ^ 1) as f64 - exposure.start(side) as f64;
            elapsed.value = way.abs();
            from = exposure.exact_joins(side)[1];
        }
        let (mut collected, mut k) = (shape.collected(), 0);
        while k < 6 {
            collected[k] /= exposure.area;
            k += 1;
        }
        Self { openness: shape.openness(), elapsed, from, collected, area: exposure.area }
    }

    /// A `p` at which the fraction is at most `a` or, on the way `up`, at least; 0 or 1 where the ramp has none.
    #[inline(never)]
    pub(crate) const fn place(&self, a: f64, up: bool) -> f64 {
        let sought = a - self.from;
        let [c1, c2, c3, c4, c5, c6] = self.collected;
        // Newton's steps inside a bracket, which a step that leaves it halves.
        let (mut low, mut high) = (0.0, 1.0);
        let (mut p, mut i) = (0.5, 0);
        while i < MOST_STEPS {
            let missing = sought - p * (c1 + p * (c2 + p * (c3 + p * (c4 + p * (c5 + p * c6)))));
            *(if missing > 0.0 { &mut low } else { &mut high }) = p;
            let slope = c1
                + p * (2.0 * c2 + p * (3.0 * c3 + p * (4.0 * c4 + p * (5.0 * c5 + p * 6.0 * c6))));
            let next = p + missing / slope;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            // The rest of the way is far below what is allowed for.
            let is_there = (next - p).abs() <= p * EXACT;
            p = next;
            i = if is_there { MOST_STEPS } else { i + 1 };
        }
        // Outwards until it is certain.
        let mut step = p * EXACT;
        loop {
            p = if up { p + step } else { p - step };
            if p <= 0.0 {
                return 0.0;
            }
            if p >= 1.0 {
                return 1.0;
            }
            let missing = sought - p * (c1 + p * (c2 + p * (c3 + p * (c4 + p * (c5 + p * c6)))));
            if if up { missing <= 0.0 } else { missing >= 0.0 } {
                return p;
            }
            step *= 2.0;
        }
    }

    /// The stretch between two `p`.
    #[inline(never)]
    pub(crate) const fn stretch(&self, first: f64, last: f64) -> Stretch {
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        let (f, t) = (self.openness.around(middle), self.elapsed.around(middle));
        let mut c = integral(f, t);
        let (mut value, mut size, mut k) = (0.0, 0.0, 6);
        while k > 0 {
            k -= 1;
            value = (value + self.collected[k]) * middle;
            size = (size + self.collected[k].abs()) * last;
            c[k] /= self.area;
        }
        let mut stretch = Stretch {
            openness: [f.value, f.c[0], f.c[1], f.c[2]],
            elapsed: [t.value, t.c[0], t.c[1], t.c[2]],
            fraction: [self.from + value, c[0], c[1], c[2], c[3], c[4], c[5]],
            noise: (self.from + size) * NOISE,
        };
        scaled(&mut stretch.openness, half);
        scaled(&mut stretch.elapsed, half);
        scaled(&mut stretch.fraction, half);
        stretch
    }
}

/// A step of Newton's below this share of its place is the last one.
const EXACT: f64 = 1.0 / (1u64 << 40) as f64;
/// Each halves the bracket at least.
const MOST_STEPS: u32 = 60;
/// More than 30 roundings of an `f64` make of the sum of a fraction's terms.
const NOISE: f64 = 1.0 / (1u64 << 48) as f64;

/// The coefficients of a polynomial by powers of `x` as those by powers of `x / unit`.
#[inline(never)]
const fn scaled(c: &mut [f64], unit: f64) {
    let (mut power, mut k) = (1.0, 0);
    while k < c.len() {
        c[k] *= power;
        power *= unit;
        k += 1;
    }
}
