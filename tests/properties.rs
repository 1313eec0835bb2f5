//! Random bit patterns: an error, or a curve that keeps its promises.

mod support;

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngSeed, TestRunner};
use shutter_curve::{CubicBezier, ShutterCurve};
use support::curves::is_valid;
use support::oracle::{Curve, Exact};
use support::promise::{BACKWARD, CDF_FLOOR, DENSITY_FLOOR, EVALUATIONS, VALUE};

type Points = [(f32, f32); 4];

/// Any bits, with a weight for the numbers that curves are made of.
fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        1 => any::<u32>().prop_map(f32::from_bits),
        4 => 0.0f32..=1.0,
        2 => prop::sample::select(vec![0.0, -0.0, 1.0, 0.5, 1e-7, 1e-30, 1e-45, 1.0 - f32::EPSILON / 2.0]),
    ]
}

/// Eight times at any offset and scale, and eight opennesses; sorted, within [0, 1] and 1 at the joins, so that some make
/// a curve, or not.
fn ramps() -> impl Strategy<Value = (Points, Points)> {
    let times = prop::array::uniform8(number());
    let scale = (-70i32..70, prop_oneof![3 => Just(0.0f32), 1 => number()]);
    (times, prop::array::uniform8(number()), scale, any::<u8>()).prop_map(
        |(mut t, mut f, (power, offset), tamed)| {
            if tamed & 3 > 0 {
                t.sort_by(f32::total_cmp);
            }
            if tamed & 12 > 0 {
                f = f.map(|f| f.abs().min(1.0));
                (f[3], f[4]) = (1.0, 1.0);
            }
            let scale = 2f64.powi(power);
            let t = t.map(|t| (scale * (t as f64 + offset as f64)) as f32);
            let point = |i: usize| (t[i], f[i]);
            ([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point))
        },
    )
}

/// What the tests below judge is curves, not refusals alone.
#[test]
fn enough_curves_are_accepted() {
    let mut runner = TestRunner::deterministic();
    let mut accepted = 0;
    for _ in 0..10_000 {
        let (opening, closing) = ramps().new_tree(&mut runner).expect("a value").current();
        let [opening, closing] = [opening, closing].map(CubicBezier::new);
        accepted += u32::from(ShutterCurve::<0>::with_octaves(opening, closing).is_ok());
    }
    assert!(accepted > 1000, "{accepted} of 10 000");
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 20_000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(2026),
        ..Default::default()
    })]

    #[test]
    fn a_shutter_is_refused_or_keeps_its_promises(
        (opening, closing) in ramps(),
        mut us in prop::collection::vec(number(), 8),
        ts in prop::collection::vec(number(), 4),
    ) {
        let made = ShutterCurve::<4>::with_octaves(CubicBezier::new(opening), CubicBezier::new(closing));
        let [start, end] = [opening[0].0, closing[3].0];
        // The oracle's `f64` do not hold what is far out of range.
        let is_judged = [start, end].iter().all(|t| t.is_finite()) && (end - start).abs() < 1e30;
        let asked = Curve::shutter(opening, closing);
        prop_assert!(!is_judged || made.is_ok() == is_valid(&asked), "{:?}", made);
        let Ok(curve) = made else { return Ok(()) };
        let exact = Exact::new(&asked);
        us.sort_by(f32::total_cmp);
        let mut last = curve.open_start();
        prop_assert_eq!(curve.inverse_cdf(0.0), curve.open_start());
        prop_assert_eq!(curve.inverse_cdf(1.0), curve.close_end());
        for u in us {
            let t = curve.inverse_cdf(u);
            prop_assert!(t >= curve.open_start() && t <= curve.close_end(), "{} at {:e}", t, u);
            if !u.is_nan() {
                prop_assert!(t >= last, "back to {} from {} at {:e}", t, last, u);
                last = t;
                let error = exact.judge(u, t);
                prop_assert!(error.backward <= BACKWARD, "{:?} at {:e}", error, u);
                let is_shutter = opening[3].1 == 1.0;
                prop_assert!(!is_shutter || curve.evaluations(u) <= EVALUATIONS, "{} at {:e}", curve.evaluations(u), u);
            }
        }
        let (start, end) = (curve.open_start() as f64, curve.close_end() as f64);
        for part in ts {
            for t in [part, (start + (end - start) * part as f64) as f32] {
                let (cdf, f, pdf) = (curve.cdf(t), curve.openness(t), curve.pdf(t));
                prop_assert!((0.0..=1.0).contains(&cdf) && (0.0..=1.0).contains(&f) && pdf >= 0.0);
                if t >= curve.open_start() && t <= curve.close_end() {
                    prop_assert!(exact.near(t).cdf_ulp(cdf, CDF_FLOOR) <= VALUE, "cdf({:e}) = {:e}", t, cdf);
                    prop_assert!(exact.near(t).openness_ulp(f, DENSITY_FLOOR) <= VALUE, "opening({:e}) = {:e}", t, f);
                    prop_assert!(exact.near(t).pdf_ulp(pdf, DENSITY_FLOOR) <= VALUE, "pdf({:e}) = {:e}", t, pdf);
                }
            }
        }
    }

    /// Wherever it stands: in a curve, as a fraction, as a time.
    #[test]
    fn minus_zero_is_zero(
        (opening, closing) in ramps(),
        signs in any::<u16>(),
        u in number(),
        t in number(),
    ) {
        let build = |opening, closing| {
            ShutterCurve::<4>::with_octaves(CubicBezier::new(opening), CubicBezier::new(closing))
        };
        let signed = |points: Points, signs: u16| {
            let sign = |x: f32, bit: usize| match signs >> bit & 1 {
                _ if x != 0.0 => x,
                0 => 0.0,
                _ => -0.0,
            };
            [0, 1, 2, 3].map(|i| (sign(points[i].0, 2 * i), sign(points[i].1, 2 * i + 1)))
        };
        let made = build(opening, closing);
        let other = build(signed(opening, signs), signed(closing, signs >> 8));
        prop_assert_eq!(made.as_ref().err(), other.as_ref().err());
        let (Ok(curve), Ok(other)) = (made, other) else { return Ok(()) };
        prop_assert_eq!(curve.inverse_cdf(u), other.inverse_cdf(u));
        prop_assert_eq!(curve.inverse_cdf(-0.0), curve.inverse_cdf(0.0));
        let values = |curve: &ShutterCurve<4>, t| [curve.cdf(t), curve.openness(t), curve.pdf(t)];
        let length = curve.close_end() - curve.open_start();
        for t in [t, curve.open_start() + t * length, 0.0, 1e-45, curve.open_end()] {
            prop_assert_eq!(values(&curve, t), values(&other, t), "at {:e}", t);
            prop_assert_eq!(values(&curve, -0.0), values(&curve, 0.0));
        }
    }

    #[test]
    fn triggers_return_for_any_numbers(
        (opening, closing) in ramps(),
        n in 0u32..200,
        hz in any::<u32>(),
        gap in any::<u32>(),
    ) {
        let made = ShutterCurve::<0>::with_octaves(CubicBezier::new(opening), CubicBezier::new(closing));
        let Ok(curve) = made else { return Ok(()) };
        if let Ok(most) = curve.most_triggers(n, hz, gap) {
            prop_assert!(most <= n && (most > 0 || n == 0));
        }
        if let Ok(ticks) = curve.trigger_ticks(n, hz) {
            prop_assert!(ticks.is_sorted());
        }
    }
}
