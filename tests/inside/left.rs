//! The bound by which a search accepts its last step.

use crate::search::{ROUNDING_SAME, Taylor, left};
use crate::support::curves::Rng;

/// `c[0] x + c[1] x² + ...` in doubles.
fn value(c: &[f32; 6], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |value, c| (value + f64::from(*c)) * x)
}

/// What is missing after a step never exceeds it, for coefficients of either sign that differ by powers of ten, some of
/// them 0.
#[test]
fn what_a_step_leaves_is_within_the_bound() {
    let mut rng = Rng::new(91, 0);
    for _ in 0..100_000 {
        let c: [f32; 6] = core::array::from_fn(|_| {
            let size = [0.0, 1e-6, 1e-3, 1.0, 1e3][rng.below(5) as usize];
            (size * (rng.unit() - 0.5)) as f32
        });
        let x = 2.0 * rng.unit() as f32;
        let step = (rng.unit() as f32 - 0.5) * [1.0, 1e-2, 1e-4][rng.below(3) as usize];
        let local = Taylor::new(&c, x);
        let exact = value(&c, f64::from(x) + f64::from(step)) - value(&c, f64::from(x));
        // All but the third term and those beyond.
        let missing = step * (local.d1 + local.d2 * step);
        let after = (f64::from(missing) - exact).abs();
        let bound = f64::from(left(&c, &local, 0.0, missing, step, ROUNDING_SAME));
        assert!(after <= bound, "{after:e} after a step of {step}, bound {bound:e}: {c:?} at {x}");
    }
}
