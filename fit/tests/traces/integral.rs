//! A curve's integral, and how it moves with the curve's parameters, by sums and by differences.

use crate::curve::{Curve, Exposure, PARAMETERS, PLATEAU, START};

fn curves() -> [Curve; 4] {
    let free = |controls| Curve { controls, ..Curve::trapezoid(0.1, 0.5, 0.2, 0.9) };
    [
        Curve::trapezoid(-1.0, 0.3, 0.6, 0.1),
        Curve::trapezoid(2.0, 0.0, 1.0, 0.0),
        free([[0.4, 0.0, 0.6, 1.0], [0.1, 0.2, 0.9, 0.8]]),
        free([[0.9, 0.2, 0.1, 0.9], [0.0, 0.7, 0.1, 1.0]]),
    ]
}

#[test]
fn the_integral_is_that_of_the_openness() {
    for curve in curves() {
        let exposure = Exposure::new(&curve);
        let (n, mut sum) = (20_000, 0.0);
        let at = |i: f64| curve.start + curve.length() * (1.2 * i / f64::from(n) - 0.1);
        for i in 0..n {
            sum += exposure.openness(at(f64::from(i) + 0.5)) * curve.length() * 1.2 / f64::from(n);
            let here = exposure.collected(at(f64::from(i + 1))).amount;
            assert!((sum - here).abs() < 1e-4, "{curve:?} at {i}: {sum}, {here}");
        }
        assert!((exposure.area() - exposure.collected(1e9).amount).abs() < 1e-12);
    }
}

#[test]
fn triggers_and_moves_are_what_differences_say() {
    for curve in curves() {
        let exposure = Exposure::new(&curve);
        for u in [0.03, 0.3, 0.5, 0.9, 0.97] {
            let (t, moves) = exposure.trigger(u);
            let share = exposure.collected(t).amount / exposure.area();
            assert!((share - u).abs() < 1e-9, "{curve:?} {u}: {share}");
            // A box has no ramps that could change; a length of 0 moves one way only.
            let skip = |k: usize| curve.opening == 0.0 && k != START && k != PLATEAU;
            for k in (0..PARAMETERS).filter(|k| !skip(*k)) {
                let moved = |by: f64| {
                    let mut p = curve.parameters();
                    p[k] += by;
                    Exposure::new(&Curve::from_parameters(&p)).trigger(u).0
                };
                let slope = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                assert!((slope - moves[k]).abs() < 1e-5, "{curve:?} {u} {k}: {slope} {moves:?}");
            }
        }
    }
}
