//! Times in whole units.

use crate::fixed::{fixed_down, power_of_two_f64};
use crate::support::curves::Rng;

/// Rounded down on either side of time 0, so that times keep their order across it.
#[test]
fn times_in_units_are_rounded_down() {
    let mut rng = Rng::new(93, 0);
    for _ in 0..100_000 {
        let e = rng.below(140) as i32 - 70;
        let up = rng.below(150) as i32 - 90;
        let x = ((rng.unit() - 0.5) * power_of_two_f64(e + up)) as f32;
        let floor = (f64::from(x) / power_of_two_f64(e)).floor();
        assert_eq!(fixed_down(x, e) as f64, floor, "{x:e} in units of 2^{e}");
    }
}
