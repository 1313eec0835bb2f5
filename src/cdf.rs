//! From a time: the openness, the pdf, and the cdf.
//!
//! A cdf is the part of the exposure up to the time's *place* ([`ramp`](crate::ramp)). Like the inverse, it counts from
//! the nearer end of the curve. It never steps back (proofs/cdf.py): a place is off by less than a quarter
//! of the distance to that of the next time, measuring the part there loses far less than lies between two times, and
//! at a join the sections on both sides use the same stored shares.

use crate::exposure::Exposure;
use crate::fraction::Side::{self, End, Start};
use crate::number::moment::rounded;
use crate::number::pair::{Pair, significand};
use crate::number::units::{WHOLE, WHOLE_EXPONENT, exponent, power_of_two};

/// Where a time lies on the curve.
enum Section {
    Outside,
    Plateau,
    /// On the ramp at a side.
    Ramp(Side),
}

/// The section of a time, which is [`on_grid`].
#[inline]
fn section(exposure: &Exposure, t: f32) -> Section {
    let [start, end] = [exposure.end_time(Start), exposure.end_time(End)];
    let [open, close] = [exposure.join_time(Start), exposure.join_time(End)];
    if t < open {
        if t >= start { Section::Ramp(Start) } else { Section::Outside }
    } else if t > close {
        if t <= end { Section::Ramp(End) } else { Section::Outside }
    } else if t.is_nan() {
        Section::Outside
    } else if open < close {
        Section::Plateau
    } else {
        // The join of both ramps is on the opening one, if that has length.
        Section::Ramp(Side::end_if(start == open))
    }
}

/// The openness at `t`, at least 0, as a pair in units of a power of two, and the exponent of that.
#[inline]
fn openness_pair(exposure: &Exposure, t: f32) -> (Pair, i32) {
    let t = on_grid(exposure, t);
    match section(exposure, t) {
        Section::Outside => (Pair::ZERO, 0),
        Section::Plateau => (Pair::new(1.0), 0),
        Section::Ramp(side) => exposure.ramp(side).at_time(t).openness(),
    }
}

/// The openness at `t`.
#[inline]
pub(crate) fn openness(exposure: &Exposure, t: f32) -> f32 {
    rounded(openness_pair(exposure, t))
}

/// The openness at `t` over the exposure.
#[inline]
pub(crate) fn pdf(exposure: &Exposure, t: f32) -> f32 {
    let (f, f_exponent) = openness_pair(exposure, t);
    let (area, exponent) = significand(exposure.area);
    rounded((f.over(area), f_exponent - exponent))
}

/// The fraction of the exposure collected by `t`.
#[inline]
pub(crate) fn cdf(exposure: &Exposure, t: f32) -> f32 {
    let t = on_grid(exposure, t);
    match section(exposure, t) {
        Section::Outside if t > exposure.end_time(End) => 1.0,
        Section::Outside => 0.0,
        Section::Plateau => cdf_on_plateau(exposure, t),
        Section::Ramp(side) => cdf_on_ramp(exposure, side, t),
    }
}

// Out of line: the code for ramps then saves no registers for this.
#[inline(never)]
fn cdf_on_plateau(exposure: &Exposure, t: f32) -> f32 {
    let (area, exponent) = significand(exposure.area);
    from_nearer_end(|side| {
        let join = exposure.join_time(side);
        let way = if side.is(Start) { Pair::sum(t, -join) } else { Pair::sum(join, -t) };
        // Scaled first: a quotient of a subnormal way has too few bits.
        let way = way.shifted(WHOLE_EXPONENT - exponent);
        exposure.ramp(side).share.plus(way.over(area))
    })
}

#[inline(never)]
fn cdf_on_ramp(exposure: &Exposure, ramp: Side, t: f32) -> f32 {
    let point = exposure.ramp(ramp).at_time(t);
    from_nearer_end(|side| {
        let part = point.fraction(side);
        if ramp.is(side) {
            // With the nearest `hi`: `minus` keeps the order of such pairs (proofs/cdf.py).
            Pair::sum(part.hi, part.lo)
        } else {
            exposure.ramp(side).share.plus(exposure.plateau).plus(part)
        }
    })
}

/// The fraction collected since the start. `fraction_since(side)` is the one since a side's end, in [`WHOLE`]. Below
/// half the one since the start counts, else what the one since the end leaves. They are measured apart, and may differ
/// by a trace at half: hence `max(HALF)`.
fn from_nearer_end(fraction_since: impl Fn(Side) -> Pair) -> f32 {
    const HALF: f32 = 0.5 * WHOLE;
    let from_start = fraction_since(Start).rounded();
    let fraction = if from_start < HALF {
        // Not `max`, which may leave -0.0, by machine.
        if from_start > 0.0 { from_start } else { 0.0 }
    } else {
        Pair::new(WHOLE).minus(fraction_since(End)).rounded().max(HALF)
    };
    fraction / WHOLE
}

/// The time `t`. Inside a curve across time 0, where `f32` may lie closer together than a place is exact, it is rounded
/// to a multiple of 1/4, 1/2 or 1 ulp of the end that is farther from 0; or to an end, if that is passed.
#[inline]
fn on_grid(exposure: &Exposure, t: f32) -> f32 {
    let [start, end] = [exposure.end_time(Start), exposure.end_time(End)];
    if start < 0.0 && end > 0.0 && t > start && t < end { gridded(start, end, t) } else { t }
}

/// [`on_grid`] where that may round.
#[inline(never)]
const fn gridded(start: f32, end: f32, t: f32) -> f32 {
    let half = 0.5 * power_of_two(exponent(if end > -start { end } else { -start }));
    if t.abs() >= half {
        return t;
    }
    // The farther end is 2 to 4 times `half`, and `t + 1.5 half` is 0.5 to 2.5 times `half`. So an ulp of that sum, to
    // which `t` is rounded, is 1/4, 1/2 or 1 ulp of the farther end.
    let t = (t + 1.5 * half) - 1.5 * half;
    if t < start {
        start
    } else if t > end {
        end
    } else {
        t
    }
}
