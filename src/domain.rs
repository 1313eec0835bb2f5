//! What is accepted: the rules of [`ShutterCurve`](crate::ShutterCurve)'s list, compared in `f64`; the last one in
//! [`curve`](crate::curve).
//!
//! By rule 2 openness is in [0, 1] all along a ramp, and time stands still only at its ends: on a ramp of length 1,
//! with the Bezier's parameter `p`, `t'` is at least `3 p²` up to `p = 1/8`, mirrored at the end, and at least 1/22
//! between. By rules 2 and 3 a ramp that meets another part has at least 1/20 of the exposure that its length would
//! have fully open (proofs/domain.py).

use crate::error::{CurveError, Part, tried};
use crate::fixed::DOUBLE_WORD;
use crate::ramp::bezier::CubicBezier;

/// By how much the first inner time may pass the second, as a share of the ramp.
pub(crate) const MOST_CROSSED: f64 = 15.0 / 16.0;
/// The least interval, as a share of the greatest |time|: 2⁷ ulp of that and more.
pub(crate) const LEAST_INTERVAL: f64 = 1.0 / (1 << 16) as f64;
/// The least length of a ramp or a plateau, as a share of the greatest |time|: half an ulp of that to an ulp.
pub(crate) const LEAST_PART: f64 = 1.0 / (1 << 24) as f64;
/// The least exposure of a density, as a share of the interval.
pub(crate) const LEAST_EXPOSURE: f64 = 1.0 / (1 << 20) as f64;

/// All rules but the one of the exposure, for which the curve has to be integrated.
#[inline(never)]
pub(crate) const fn check(opening: &CubicBezier, closing: &CubicBezier) -> Result<(), CurveError> {
    // Rule 1, and lengths by rules 4 and 5.
    tried!(check_finite(opening, Part::Opening));
    tried!(check_finite(closing, Part::Closing));
    let ([start, _, _, open], [close, _, _, end]) = (opening.times(), closing.times());
    if !(start <= open && open <= close && close <= end) {
        return Err(CurveError::TimesOutOfOrder);
    }
    let greatest = if -start > end { -start as f64 } else { end as f64 };
    let length = end as f64 - start as f64;
    if length < LEAST_INTERVAL * greatest {
        return Err(CurveError::IntervalUnresolved);
    }
    // The bounds are 2⁻⁶⁴ and 2⁶⁴.
    if length < 1.0 / DOUBLE_WORD || length > DOUBLE_WORD {
        return Err(CurveError::IntervalOutOfRange);
    }
    let least = LEAST_PART * greatest;
    tried!(check_part(start, open, least, Part::Opening));
    tried!(check_part(open, close, least, Part::Plateau));
    tried!(check_part(close, end, least, Part::Closing));
    // Rule 2.
    tried!(check_points(opening, Part::Opening));
    tried!(check_points(closing, Part::Closing));
    // Rule 3. A ramp that is the whole curve does not meet another part, and the openness of one without length does
    // not count.
    let ([.., opened], [still_open, ..]) = (opening.opennesses(), closing.opennesses());
    if start < open && open < end && opened < 1.0 {
        return Err(CurveError::NotFullyOpen(Part::Opening));
    }
    if start < close && close < end && still_open < 1.0 {
        return Err(CurveError::NotFullyOpen(Part::Closing));
    }
    Ok(())
}

const fn check_finite(ramp: &CubicBezier, part: Part) -> Result<(), CurveError> {
    let (t, f) = (ramp.times(), ramp.opennesses());
    let mut i = 0;
    while i < 4 {
        if !(t[i].is_finite() && f[i].is_finite()) {
            return Err(CurveError::NotFinite(part));
        }
        i += 1;
    }
    Ok(())
}

const fn check_part(from: f32, to: f32, least: f64, part: Part) -> Result<(), CurveError> {
    let length = to as f64 - from as f64;
    if length > 0.0 && length < least { Err(CurveError::TooShort(part)) } else { Ok(()) }
}

const fn check_points(ramp: &CubicBezier, part: Part) -> Result<(), CurveError> {
    let (t, f) = (ramp.times(), ramp.opennesses());
    let [from, first, second, to] = t;
    let mut i = 0;
    while i < 4 {
        let point = i as u8;
        if !(from <= t[i] && t[i] <= to) {
            return Err(CurveError::TimeOutsideRamp { part, point });
        }
        if !(0.0 <= f[i] && f[i] <= 1.0) {
            return Err(CurveError::OpennessOutOfRange { part, point });
        }
        i += 1;
    }
    let crossed = first as f64 - second as f64;
    if crossed > MOST_CROSSED * (to as f64 - from as f64) {
        return Err(CurveError::TimesCross(part));
    }
    Ok(())
}
