//! Random bit patterns: an error, or a curve that keeps its promises.

use crate::support::curves::{Rng, is_valid, verdict};
use crate::support::oracle::{Curve, Exact, Points, exp2};
use crate::support::promise::Figures;
use crate::support::questions::Questions;
use crate::support::times;
use shutter_curve::{CubicBezier, CurveError, Hz, ShutterCurve};

/// Any bits, with a weight for the numbers that curves are made of.
fn number(rng: &mut Rng) -> f32 {
    match rng.below(7) {
        0 => f32::from_bits(rng.bits() as u32),
        1..5 => rng.unit() as f32,
        _ => [0.0, -0.0, 1.0, 0.5, 1e-7, 1e-30, 1e-45, 1f32.next_down()][rng.below(8) as usize],
    }
}

/// Eight times at any offset and scale, and eight opennesses; sorted, within [0, 1] and 1 at the joins, so that some
/// make a curve, or not.
fn ramps(rng: &mut Rng) -> Curve {
    let [mut t, mut f] = [0, 1].map(|_| [0; 8].map(|_| number(rng)));
    let scale = exp2(rng.below(140) as i32 - 70);
    let offset = if rng.chance(0.75) { 0.0 } else { number(rng) };
    if rng.chance(0.75) {
        t.sort_by(f32::total_cmp);
    }
    if rng.chance(0.75) {
        f = f.map(|f| f.abs().min(1.0));
        (f[3], f[4]) = (1.0, 1.0);
    }
    let point = |i: usize| ((scale * (f64::from(t[i]) + f64::from(offset))) as f32, f[i]);
    Curve::shutter([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point))
}

fn build<const OCTAVES: usize>(curve: &Curve) -> Result<ShutterCurve<OCTAVES>, CurveError> {
    let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
    ShutterCurve::with_octaves(opening, closing)
}

fn values(curve: &ShutterCurve<4>, t: f32) -> [u32; 3] {
    [curve.cdf(t), curve.openness(t), curve.pdf(t)].map(f32::to_bits)
}

#[test]
fn a_shutter_is_refused_or_keeps_its_promises() {
    let (mut figures, mut accepted) = (Figures::default(), 0);
    for index in 0..5000 * times() {
        let rng = &mut Rng::new(2026, index);
        let asked = ramps(rng);
        let made = build(&asked);
        let [start, end] = [asked.open_start(), asked.close_end()];
        // The oracle's `f64` do not hold what is far out of range.
        let is_judged = start.is_finite() && end.is_finite() && (end - start).abs() < 1e30;
        assert!(!is_judged || made.as_ref().err() == verdict(&asked).err().as_ref(), "{made:?}: {asked:?}");
        // Either sign of 0 is 0, wherever it stands, to the bit.
        let mut signed = |x: f32| if x == 0.0 && rng.chance(0.5) { -x } else { x };
        let mut signed = |ramp: Points| ramp.map(|(t, f)| (signed(t), signed(f)));
        let other = build(&Curve::shutter(signed(asked.opening), signed(asked.closing)));
        assert_eq!(format!("{made:?}"), format!("{other:?}"), "{asked:?}");
        let (Ok(ours), Ok(other)) = (made, other) else { continue };
        accepted += 1;
        let us: Vec<f32> = (0..8).map(|_| number(rng)).collect();
        let parts: Vec<f32> = (0..4).map(|_| number(rng)).collect();
        let at = |part: f32| (f64::from(start) + (f64::from(end) - f64::from(start)) * f64::from(part)) as f32;
        let ts = parts.iter().flat_map(|part| [*part, at(*part)]);
        let ts: Vec<f32> = ts.chain([0.0, -0.0, 1e-45, ours.open_end()]).collect();
        for u in us.iter().chain(&[0.0, -0.0]) {
            let t = ours.inverse_cdf(*u);
            assert_eq!(t.to_bits(), other.inverse_cdf(*u).to_bits(), "{u:e}: {asked:?}");
            assert!((start..=end).contains(&t), "{t:e} at {u:e}: {asked:?}");
        }
        for t in &ts {
            assert_eq!(values(&other, *t), values(&ours, *t), "{t:e}: {asked:?}");
            let [cdf, openness, pdf] = values(&ours, *t).map(f32::from_bits);
            let are_in_range = [cdf, openness].iter().all(|x| (0.0..=1.0).contains(x));
            assert!(are_in_range && pdf >= 0.0, "{t:e}: {asked:?}");
        }
        let exact = Exact::new(&asked);
        let questions = Questions::new(&exact, us, ts, Vec::new());
        figures.asked::<4>(&exact, &questions);
        figures.asked::<8>(&exact, &questions);
    }
    println!("{accepted} curves: {:?}", figures.worst);
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
    assert!(accepted > 1000, "only {accepted}");
}

#[test]
fn triggers_return_for_any_numbers() {
    for index in 0..20_000 {
        let rng = &mut Rng::new(2027, index);
        let asked = ramps(rng);
        let Ok(curve) = build::<0>(&asked) else { continue };
        let (n, hz, gap) = (rng.below(200) as u32, rng.bits() as u32, rng.bits() as u32);
        let shift = rng.below(32);
        for (hz, gap) in [(hz, gap), (hz >> shift, gap >> shift)] {
            let Ok(timed) = curve.at(Hz(hz)) else { continue };
            let most = timed.min_gap(gap).max_triggers(n);
            assert!(most <= n && (most > 0 || n == 0), "{most} of {n}: {asked:?}");
            assert!(timed.min_gap(gap).trigger_ticks(most).is_ok(), "{most} of {n}: {asked:?}");
            let ticks = timed.min_gap(0).trigger_ticks(n).expect("few triggers");
            assert!(ticks.is_sorted(), "{n} at {hz} Hz: {asked:?}");
        }
    }
}

/// How many of some fractions are searched for, and the greatest frame that is known to need no search.
fn served<const OCTAVES: usize>(curve: &Curve) -> (usize, u32) {
    let ours = build::<OCTAVES>(curve).expect("a shutter");
    let us = (1..400).map(|i| i as f32 / 400.0);
    (us.filter(|u| ours.steps(*u).is_some()).count(), ours.direct_triggers())
}

/// More octaves never search more, nor lower `direct_triggers`, however the handles lie: of points in whole hundredths.
#[test]
fn more_octaves_search_no_more() {
    for i in 0..350 * times() {
        let rng = &mut Rng::new(51, i);
        let mut t = [0; 4].map(|_| rng.below(101) as i32);
        t.sort();
        let mut ramp = |from: i32, to: i32, f: [f32; 2]| {
            let inner = [0; 2].map(|_| (from + rng.below((to - from + 1) as u64) as i32, rng.below(101)));
            let [b, c] = inner.map(|(t, f)| (t as f32 / 100.0, f as f32 / 100.0));
            [(from as f32 / 100.0, f[0]), b, c, (to as f32 / 100.0, f[1])]
        };
        let curve = Curve::shutter(ramp(t[0], t[1], [0.0, 1.0]), ramp(t[2], t[3], [1.0, 0.0]));
        if is_valid(&curve) {
            let served = [served::<2>(&curve), served::<4>(&curve), served::<8>(&curve), served::<12>(&curve)];
            let is_sorted = served.is_sorted_by(|fewer, more| fewer.0 >= more.0 && fewer.1 <= more.1);
            assert!(is_sorted, "{served:?}: {curve:?}");
        }
    }
}
