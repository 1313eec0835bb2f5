//! Rounded control points may take a curve a trace beyond a bound. It is accepted, and *lifted* onto the bound, so that
//! time never runs back and the openness is nowhere below 0.

use super::cubic::{cubic_range, quadratic_min, widened};

/// The control values of a cubic that grazes 0 from below, raised until it does not: by -min f and 2⁻⁴⁸ of its size for
/// the rounding of that, less and less towards the greater end, which stays. So an opening that dips below 0 still
/// reaches the plateau at 1. Each is rounded to the next `f32` above. A Bezier moves with its control values.
///
/// Where the greater end has less than half of the greatest value, that value stays, so that nothing moves by more than
/// the raise. An end at 0 has to move even if only the inside dips. If it stayed, the slope there would have to be
/// raised to 0, and that moves the curve much farther: `3p² - s p` dips by only `s²/12`, so by 2⁻²² with a slope of
/// -3.5 · 2⁻¹¹.
pub(crate) const fn lifted(mut v: [f32; 4]) -> [f32; 4] {
    let (low, high) = cubic_range(widened(v));
    if low >= 0.0 {
        return v;
    }
    let raise = -low + high / (1u64 << 48) as f64;
    let end = if v[0] < v[3] { v[3] } else { v[0] } as f64;
    let stays = if 2.0 * end < high { high } else { end };
    let share = raise / (stays + raise);
    let mut i = 0;
    while i < 4 {
        let exact = v[i] as f64 + (stays - v[i] as f64) * share;
        let near = exact as f32;
        v[i] = if (near as f64) < exact { near.next_up() } else { near };
        i += 1;
    }
    v
}

/// The differences of the control times of a ramp, whose slope may graze 0 from below, so that it does not: all three
/// raised by what the slope is below 0 and by its rounding, and scaled, so that the ramp keeps its length.
///
/// A constant added to the slope adds a multiple of `p` to the time, and scaling takes as much away at the end: no time
/// moves by more than 0.469 of the ramp's length times the 2⁻²² that are accepted (`proofs/lifting.py`). The slope of
/// the result, computed exactly from its three numbers, is nowhere below 0. That of a ramp that is not lifted may be,
/// by rounding, but by less than what its coefficients lose as pairs.
pub(crate) const fn forward(d: [f64; 3], length: f64) -> [f64; 3] {
    let (least, noise) = quadratic_min(d);
    if least >= 0.0 {
        return d;
    }
    let raise = noise - least;
    let [d0, d1, d2] = [d[0] + raise, d[1] + raise, d[2] + raise];
    let scale = length / ((d0 + d2) + d1);
    [d0 * scale, d1 * scale, d2 * scale]
}
