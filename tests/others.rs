//! Where others fail, rebuilt from `peers.rs`: each must fail as described, while this crate's answer to the same
//! question is right; `promises.rs` judges it on the whole curve.

mod support;

use shutter_curve::{CubicBezier, CurveError, Part, ShutterCurve};
use support::baseline::{InverseTable, NearerEnd};
use support::cases::{ANIMATION, DIM, NO_ROOT, S_RAMP, case, evenly, exact, judge, shutter, worst};
use support::oracle::Exact;
use support::peers::{
    CellTable, Parts, PowerRamp, animation, bracketed, fixed_point, renderer, tolerant,
};

#[test]
fn a_rounded_total_leaves_no_root_at_the_end() {
    let case = case(NO_ROOT);
    let parts = Parts::<f32>::new(case.opening, case.closing);
    let (t, _) = parts.inverse_cdf(1.0, renderer);
    assert_eq!(t, case.closing[0].0, "the start of the closing ramp");
    assert_eq!(shutter::<8>(&case.curve()).inverse_cdf(1.0), case.closing[3].0);
}

#[test]
fn newton_runs_away_on_a_plain_ramp() {
    let case = case(S_RAMP);
    let parts = Parts::<f32>::new(case.opening, case.closing);
    let (error, steps_back) = worst(10_000, |u| parts.inverse_cdf(u, renderer).0, exact(case));
    assert!(error > 2.0 && steps_back > 500, "{error}, {steps_back}");
    let ours = shutter::<8>(&case.curve());
    let (error, steps_back) = worst(10_000, |u| ours.inverse_cdf(u), exact(case));
    assert!(error < 1e-7 && steps_back == 0, "{error}, {steps_back}");
}

#[test]
fn newton_with_care_is_right_and_steps_back() {
    let curve = case(S_RAMP).curve();
    let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
    let newton = NearerEnd::new(curve.opening, curve.closing);
    let newton = judge(&exact, |u| newton.inverse_cdf(u, f32::sqrt));
    assert!(newton.of_interval < 1e-7 && newton.steps_back > 0, "{newton:?}");
    assert_eq!(judge(&exact, |u| ours.inverse_cdf(u)).steps_back, 0);
}

#[test]
fn an_absolute_residual_is_no_accuracy() {
    // The openness is so low that every guess is within 1e-6: half of the interval off.
    let dim = case(DIM);
    let parts = Parts::<f32>::new(dim.opening, dim.closing);
    assert_eq!(parts.inverse_cdf(0.01, bracketed).0, 0.5);
    assert_eq!(shutter::<8>(&dim.curve()).inverse_cdf(0.01), 0.1);
    // u = 0 is answered with a time long after the start.
    let case = case("triangle: plateau without length");
    let parts = Parts::<f32>::new(case.opening, case.closing);
    assert!(parts.inverse_cdf(0.0, bracketed).0 > 4e-4);
    assert_eq!(shutter::<8>(&case.curve()).inverse_cdf(0.0), 0.0);
}

#[test]
fn a_table_is_off_at_the_ends() {
    let case = case("ends of order p^3");
    let ours = shutter::<8>(&case.curve());
    // Entries made at the middles of cells, read at their edges.
    let cells = CellTable::<256>::new(|t| ours.openness(t));
    let (error, _) = worst(10_000, |u| cells.inverse_cdf(u), exact(case));
    assert!(error > 0.02, "{error}");
    // Even a table of exact entries, read right.
    let table = InverseTable::<256>::new(|u| ours.inverse_cdf(u));
    let (error, _) = worst(10_000, |u| table.inverse_cdf(u), exact(case));
    assert!(error > 0.01, "{error}");
    let (error, _) = worst(10_000, |u| ours.inverse_cdf(u), exact(case));
    assert!(error < 1e-7, "{error}");
}

#[test]
fn nothing_exposed_and_still_a_time() {
    let dark = CellTable::<256>::new(|_| 0.0);
    assert!(dark.inverse_cdf(0.0) > 0.99);
    let dark = CubicBezier::new([(0.0, 0.0), (0.3, 0.0), (0.6, 0.0), (1.0, 0.0)]);
    let end = CubicBezier::new([(1.0, 0.0); 4]);
    assert_eq!(ShutterCurve::new(dark, end), Err(CurveError::DensityTooSmall));
}

#[test]
fn negative_openness_and_folding_time_are_accepted() {
    let closing = [(0.75, 1.0), (0.83, 0.67), (0.92, 0.33), (1.0, 0.0)];
    let below = [(0.0, 0.0), (0.1, -0.8), (0.2, 0.2), (0.25, 1.0)];
    let folded = [(0.0, 0.0), (0.6, 0.0), (-0.4, 1.0), (0.25, 1.0)];
    for (opening, error) in [
        (below, CurveError::OpennessOutOfRange { part: Part::Opening, point: 1 }),
        (folded, CurveError::TimeOutsideRamp { part: Part::Opening, point: 1 }),
    ] {
        let parts = Parts::<f32>::new(opening, closing);
        let inverse = |u| parts.inverse_cdf(u, renderer).0;
        assert!(evenly(1000).map(inverse).all(f32::is_finite), "answered as if nothing were wrong");
        let [opening, closing] = [opening, closing].map(CubicBezier::new);
        assert_eq!(ShutterCurve::new(opening, closing), Err(error));
    }
}

#[test]
fn an_animation_solver_hangs() {
    let case = case(ANIMATION);
    let ramp = PowerRamp::<f32>::new(case.opening);
    // A tolerance below the rounding of t(p) is never met, and the bracket stops shrinking.
    assert!(evenly(20_000).any(|t| animation(&ramp, t, 1e-7).is_none()));
    let ours = shutter::<8>(&case.curve());
    assert!(evenly(20_000).all(|t| ours.openness(t).is_finite()));
}

#[test]
fn animation_solvers_give_the_wrong_openness() {
    let case = case(ANIMATION);
    let exact = Exact::new(&case.curve());
    let truth = |t| exact.openness(t).to_f32();
    let parts = Parts::<f32>::new(case.opening, case.closing);
    let (error, back) = worst(10_000, |t| parts.openness(t, tolerant), truth);
    assert!(error > 0.1 && back > 5, "a tolerance of 0.01: {error}, {back}");
    let [x1, y1, x2, y2] = [992, 0, 32, 1024];
    let fixed = |t: f32| fixed_point((t * 1024.0) as i64, [x1, y1, x2, y2]) as f32 / 1024.0;
    let (error, back) = worst(1024, fixed, truth);
    assert!(error > 0.05 && back > 0, "1024ths: {error}, {back}");
    let ours = shutter::<8>(&case.curve());
    let (error, back) = worst(10_000, |t| ours.openness(t), truth);
    assert!(error < 1e-6 && back == 0, "{error}, {back}");
}

/// The document's own slip: `t = u/K` on the plateau.
#[test]
fn the_slip_in_the_document() {
    let case = case("ends of order p^2");
    let ours = shutter::<8>(&case.curve());
    let slip = 0.5 * ours.exposure();
    assert_eq!((ours.inverse_cdf(0.5), slip), (0.5, 0.375));
}
