//! The inverse at every `u`.

use crate::follower::Follower;
use crate::support::cases::shutter;
use crate::support::oracle::{Curve, Exact, rounding_cell, ulp_f32};
use crate::sweep::{SAMPLED, Sweep, in_parts};

/// As the report knows it.
pub const INVERSE: &str = "inverse_cdf";

/// Sweeps the `f32` from 0 to 1.
pub fn sweep(curve: &Curve) -> Sweep {
    let (shutter, exact) = (shutter::<8>(curve), Exact::new(curve));
    let (start, end) = (curve.open_start(), curve.close_end());
    let at = |bits| f32::from_bits(bits as u32);
    let [found] = in_parts(0, 1f32.to_bits().into(), |from, to| {
        let count = (to - from) as u64 + 1;
        let mut found = Sweep { function: INVERSE, count, ..Sweep::default() };
        let (mut steps_back, mut greatest, mut evaluations) = (0, 0.0, 0);
        let mut follower = Follower::new(curve);
        // The neighbour below, so that no pair is left out between two parts.
        let mut last = if from == 0 { start } else { shutter.inverse_cdf(at(from - 1)) };
        let mut worst = [from; 2];
        for bits in from..=to {
            let u = at(bits);
            let t = shutter.inverse_cdf(u);
            found.out_of_range += u64::from(!(t >= start && t <= end));
            steps_back += u64::from(t < last);
            last = t;
            if bits % 16 == 0 {
                evaluations = evaluations.max(shutter.evaluations(u));
            }
            let (forward, backward) = errors(&mut follower, u, t);
            if forward > greatest {
                (greatest, worst[0]) = (forward, bits);
            }
            if backward > found.error {
                (found.error, worst[1]) = (backward, bits);
            }
            if bits % SAMPLED == 0 {
                found.judge(exact.judge(u, t).backward);
            }
        }
        for u in worst.map(at) {
            found.judge(exact.judge(u, shutter.inverse_cdf(u)).backward);
        }
        let (steps_back, forward) = (Some(steps_back), Some(greatest));
        [Sweep { steps_back, forward, evaluations: Some(evaluations), ..found }]
    });
    found
}

/// The errors of `t`: in ulp(t), and in ulp(u) once half an ulp(t) is forgiven.
fn errors(follower: &mut Follower, u: f32, t: f32) -> (f64, f64) {
    if u == 0.0 || u == 1.0 {
        return (0.0, 0.0);
    }
    let exact = follower.inverse(u.into());
    let error = (f64::from(t) - exact.time).abs();
    let ulp = follower.ulp(exact.time);
    // Where the density is next to nothing doubles cannot tell the time to an ulp.
    let is_told = exact.noise <= exact.density * ulp * 0.002;
    let [low, high] = rounding_cell(t);
    let excess = (low - exact.time).max(exact.time - high).max(0.0);
    let backward = excess * (exact.density / follower.area) / ulp_f32(u.into());
    (if is_told { error / ulp } else { 0.0 }, backward)
}
