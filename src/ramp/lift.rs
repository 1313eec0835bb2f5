//! Rounded control points may take a curve slightly beyond a bound. It is accepted, and *lifted* onto the bound: time
//! never runs back, and the openness is nowhere below 0.

use super::cubic::{cubic_range, quadratic_min, widened};

/// The control values of a cubic, raised so that it is nowhere below 0.
///
/// Let `raise` be -min f plus 2⁻⁴⁸ of the greatest value, for rounding. `v` becomes `v + (stays - v) share`, rounded
/// up: -`raise` becomes 0, and `stays` keeps its value. `stays` is the greater end, so that an opening still reaches
/// the plateau at 1; but the greatest value if the end has less than half of that. So the curve moves nowhere by more
/// than `raise`.
///
/// An end at 0 moves even if only the inside dips. Otherwise the slope there would have to be raised to 0, which moves
/// the curve much farther: `3p² - s p` dips by only `s²/12`, or 2⁻²² for a slope of -3.5 · 2⁻¹¹.
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

/// A ramp's differences of control times, raised so that no slope is below 0, and scaled to keep the ramp's length.
///
/// No time moves by more than 0.469 · 2⁻²² of the length (`proofs/lifting.py`). The slope, computed exactly from raised
/// differences, is nowhere below 0. If nothing had to be raised, it may dip below 0 by rounding, but by less than its
/// coefficients lose as pairs.
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
