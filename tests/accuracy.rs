//! The promised accuracy, against the oracle: on the named curves, and on fresh random ones.
//!
//! `cargo test --test accuracy -- --nocapture` prints the figures.

mod support;

use shutter_curve::{CubicBezier, CurveError, MAX_EVALUATIONS, ShutterCurve};
use support::aimed::aimed;
use support::cases::shutter;
use support::curves::{
    Kind, Rng, hard_us, is_valid, named, random_hard, random_single, random_typical,
};
use support::oracle::{Curve, Exact, Points, ulp_f32};
use support::promise::{BACKWARD, CDF_FLOOR, EVALUATIONS, VALUE};
use support::times;

/// On typical curves, in ulp of t.
const FORWARD: f64 = 0.69;
const FORWARD_MEAN: f64 = 0.215;
/// Of an octave's polynomial, in ulp of u, so that neighbours can't change places.
const DIRECT: f64 = 0.45;
/// Of the area and what follows from it, in ulp.
const SCALAR: f64 = 1.0;

/// The worst of what was seen.
#[derive(Default)]
struct Worst {
    samples: u64,
    forward: f64,
    sum: f64,
    backward: f64,
    evaluations: u32,
}

impl Worst {
    fn mean(&self) -> f64 {
        self.sum / self.samples as f64
    }
}

/// Judges the inverse at each `u`, which are sorted: error, range, order, steps.
fn judge<const OCTAVES: usize>(exact: &Exact, us: &[f32], worst: &mut Worst) {
    let curve = shutter::<OCTAVES>(exact.curve());
    let mut last = curve.open_start();
    for u in us {
        let t = curve.inverse_cdf(*u);
        assert!((curve.open_start()..=curve.close_end()).contains(&t));
        assert!(t >= last, "back to {t} from {last} at {u:e} of {:?}", exact.curve());
        last = t;
        let (errors, evaluations) = (exact.judge(*u, t), curve.evaluations(*u));
        assert!(
            errors.backward <= if evaluations == 0 { DIRECT } else { BACKWARD },
            "OCTAVES = {OCTAVES}: {} ulp(u) at {u:e}, {t:e} for {:e}, of {:?}",
            errors.backward,
            errors.exact.hi,
            exact.curve()
        );
        worst.samples += 1;
        worst.forward = worst.forward.max(errors.forward);
        worst.sum += errors.forward;
        worst.backward = worst.backward.max(errors.backward);
        worst.evaluations = worst.evaluations.max(evaluations);
    }
    // A search that takes longer has lost its way, though the cap would end it.
    assert!(worst.evaluations <= EVALUATIONS, "{} evaluations", worst.evaluations);
    assert_eq!(
        (curve.inverse_cdf(0.0), curve.inverse_cdf(1.0)),
        (curve.open_start(), curve.close_end())
    );
}

/// `n` evenly spread `u`, and as many towards both ends.
fn spread(n: u32) -> Vec<f32> {
    let mut rng = Rng::new(7, n as u64);
    let mut us: Vec<f32> = (0..n)
        .flat_map(|i| {
            let u = (i as f64 + rng.unit()) / n as f64;
            let tail = 2f64.powf(-30.0 * rng.unit());
            [u as f32, tail as f32, (1.0 - tail) as f32]
        })
        .collect();
    us.sort_by(f32::total_cmp);
    us
}

fn typical_curves<const OCTAVES: usize>() {
    let us = spread(20_000);
    let mut worst = Worst::default();
    let (mut curves, mut means) = (0, 0.0);
    for one in named().into_iter().filter(|one| one.kind == Kind::Typical) {
        let exact = Exact::new(&one.curve);
        let (mut us, before) = (us.clone(), (worst.sum, worst.samples));
        us.extend(hard_us(&exact, 1, 1000));
        us.sort_by(f32::total_cmp);
        judge::<OCTAVES>(&exact, &us, &mut worst);
        means += (worst.sum - before.0) / (worst.samples - before.1) as f64;
        curves += 1;
    }
    for i in 0..300 {
        let exact = Exact::new(&random_typical(2, i));
        judge::<OCTAVES>(&exact, &spread(300), &mut worst);
    }
    println!(
        "OCTAVES = {OCTAVES:2}, typical: forward {:.3} ulp, mean {:.3} ({:.3} over the named), backward {:.3} ulp(u), \
         {} evaluations at most, {} samples",
        worst.forward,
        worst.mean(),
        means / curves as f64,
        worst.backward,
        worst.evaluations,
        worst.samples
    );
    assert_eq!(curves, 15);
    assert!(worst.forward <= FORWARD);
    assert!(means / curves as f64 <= FORWARD_MEAN);
}

#[test]
fn typical() {
    typical_curves::<0>();
    typical_curves::<4>();
    typical_curves::<8>();
    typical_curves::<16>();
}

fn hard_curves<const OCTAVES: usize>() {
    let mut worst = Worst::default();
    let mut curves = 0;
    for one in named().into_iter().filter(|one| one.kind == Kind::Hard) {
        let exact = Exact::new(&one.curve);
        let mut us = spread(3000);
        us.extend(hard_us(&exact, 3, 2000));
        us.sort_by(f32::total_cmp);
        judge::<OCTAVES>(&exact, &us, &mut worst);
        curves += 1;
    }
    assert_eq!(curves, 21);
    println!(
        "OCTAVES = {OCTAVES:2}, hard: backward {:.3} ulp(u), {} evaluations at most, {} samples",
        worst.backward, worst.evaluations, worst.samples
    );
}

#[test]
fn hard() {
    hard_curves::<0>();
    hard_curves::<4>();
    hard_curves::<8>();
    hard_curves::<16>();
    hard_curves::<1>();
    hard_curves::<64>();
}

/// Fresh curves, 10⁵ in CI, which nothing was tuned on, with a dozen hard `u` each and a few that are random.
#[test]
fn random_hard_curves() {
    let mut worst = Worst::default();
    let mut histogram = [0u64; MAX_EVALUATIONS as usize + 1];
    for i in 0..25_000 * times() {
        let exact = Exact::new(&random_hard(2026, i));
        let mut rng = Rng::new(11, i);
        let all = hard_us(&exact, i, 8);
        let mut us: Vec<f32> = (0..24).map(|_| all[rng.below(all.len() as u64) as usize]).collect();
        us.sort_by(f32::total_cmp);
        if i % 10 == 0 {
            judge::<8>(&exact, &us, &mut worst);
        }
        judge::<0>(&exact, &us, &mut worst);
        let curve = shutter::<0>(exact.curve());
        for u in us {
            histogram[curve.evaluations(u) as usize] += 1;
        }
    }
    println!(
        "random hard curves: backward {:.3} ulp(u), {} evaluations at most, {} samples",
        worst.backward, worst.evaluations, worst.samples
    );
    println!("samples by evaluations: {histogram:?}");
}

/// Where the density all but touches 0, over eight decades of how near: the narrower the place, the nearer to its
/// middle a step may be taken for the last one that is not.
#[test]
fn nearly_flat_places() {
    let mut worst = Worst::default();
    for k in 0..80 {
        // f = 4 (p - 1/2)² + least, nearly.
        let least = 10f32.powf(-0.1 * k as f32);
        let dip = 4.0 / 3.0 * (1.0 - least);
        for (t1, t2) in [(1.0 / 3.0, 2.0 / 3.0), (0.2, 0.7)] {
            let curve = Curve {
                opening: [(0.0, 1.0), (t1, 1.0 - dip), (t2, 1.0 - dip), (1.0, 1.0)],
                closing: [(1.0, 1.0); 4],
            };
            let exact = Exact::new(&curve);
            // The mass up to the middle, and fractions around it on a logarithmic scale.
            let middle = exact.cdf(if t1 < 0.3 { 0.4625 } else { 0.5 }).to_f32();
            let mut us: Vec<f32> = (0..400)
                .flat_map(|i| {
                    let off = 2f32.powf(-24.0 * i as f32 / 400.0) * 0.2;
                    [middle - off, middle + off]
                })
                .collect();
            us.sort_by(f32::total_cmp);
            judge::<0>(&exact, &us, &mut worst);
        }
    }
    println!(
        "nearly flat: backward {:.3} ulp(u), {} evaluations at most, {} samples",
        worst.backward, worst.evaluations, worst.samples
    );
}

/// cdf, openness and pdf, and what is known of the whole curve.
fn judge_values(exact: &Exact, curve: &ShutterCurve, worst: &mut [f64; 5]) {
    let (start, end) = (curve.open_start() as f64, curve.close_end() as f64);
    let mut rng = Rng::new(5, 0);
    let mut ts: Vec<f32> = (0..400)
        .flat_map(|i| {
            let tail = (end - start) * 2f64.powf(-40.0 * rng.unit());
            let near = exact.inverse_cdf(rng.unit() as f32).to_f32();
            [
                (start + (end - start) * i as f64 / 400.0) as f32,
                (start + tail) as f32,
                (end - tail) as f32,
                near,
            ]
        })
        .chain([curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()])
        .flat_map(|t| [t.next_down(), t, t.next_up()])
        .filter(|t| (curve.open_start()..=curve.close_end()).contains(t))
        .collect();
    ts.sort_by(f32::total_cmp);
    let mut last = 0.0;
    for t in ts {
        let cdf = curve.cdf(t);
        assert!(cdf >= last, "cdf back to {cdf} from {last} at {t:e} of {:?}", exact.curve());
        last = cdf;
        let (opening, pdf) = (curve.openness(t), curve.pdf(t));
        let near = exact.near(t);
        let errors = [near.cdf_ulp(cdf, CDF_FLOOR), near.openness_ulp(opening), near.pdf_ulp(pdf)];
        worst[4] = worst[4].max(near.cdf_ulp(cdf, 0.0));
        for (error, worst) in errors.into_iter().zip(&mut *worst) {
            assert!(
                error <= VALUE,
                "{errors:?} ulp at {t:e}: {cdf}, {opening}, {pdf} of {:?}",
                exact.curve()
            );
            *worst = worst.max(error);
        }
    }
    // Where the curve starts and ends it may jump, and any value would do there: but it is its first and its last.
    for (t, f) in [exact.curve().opening[0], exact.curve().closing[3]] {
        let is_jump = exact.is_lifted()
            || curve.open_start() == curve.open_end()
            || curve.close_start() == curve.close_end();
        assert!(is_jump || curve.openness(t) == f.min(1.0), "{f} at {t:e} of {:?}", exact.curve());
    }
    for (got, exact) in [
        (curve.exposure(), exact.area()),
        (curve.normalization(), exact.normalization()),
        (curve.efficiency(), exact.efficiency()),
    ] {
        let error = (got as f64 - exact.hi).abs() / ulp_f32(exact.hi);
        assert!(error <= SCALAR);
        worst[3] = worst[3].max(error);
    }
}

#[test]
fn values() {
    let mut worst = [0.0; 5];
    for one in named() {
        judge_values(&Exact::new(&one.curve), &shutter(&one.curve), &mut worst);
    }
    for i in 0..200 {
        let curve = random_typical(4, i);
        judge_values(&Exact::new(&curve), &shutter(&curve), &mut worst);
        let curve = random_hard(4, i);
        judge_values(&Exact::new(&curve), &shutter(&curve), &mut worst);
    }
    let [cdf, openness, pdf, scalar, small] = worst;
    println!(
        "cdf {cdf:.3} ulp ({small:.3} without a floor), openness {openness:.3}, pdf {pdf:.3}; exposure and such {scalar:.3}"
    );
}

/// Where openness dips to a 10⁸th of its height, a pair's last bit of the height is seen: a number of its own is promised.
#[test]
fn openness_in_a_deep_dip() {
    let curve = Curve::shutter(
        [
            (3.6740906e-7, 0.39432076),
            (3.6741358e-7, -0.117061704),
            (3.674143e-7, 0.00029299562),
            (3.674143e-7, 0.040745884),
        ],
        [
            (3.6741443e-7, 0.32006663),
            (3.6741443e-7, 0.61704683),
            (3.6741443e-7, 0.77398366),
            (3.6741443e-7, 0.4407312),
        ],
    );
    let (exact, shutter) = (Exact::new(&curve), shutter::<8>(&curve));
    for bits in 0..20_000 {
        let t = f32::from_bits(3.6740906e-7f32.to_bits() + bits);
        assert!(exact.near(t).openness_ulp(shutter.openness(t)) <= VALUE, "{t:e}");
    }
}

/// A ramp alone, as faint as a curve may be.
#[test]
fn single_ramps() {
    let mut backward = 0.0f64;
    for i in 0..3000 {
        let curve = random_single(6, i);
        let exact = Exact::new(&curve);
        let ours = shutter::<8>(&curve);
        let mut last = curve.open_start();
        let mut us = hard_us(&exact, i, 8);
        us.sort_by(f32::total_cmp);
        for u in us.into_iter().step_by(17) {
            let t = ours.inverse_cdf(u);
            assert!(t >= last, "back to {t} from {last} at {u:e} of {curve:?}");
            last = t;
            backward = backward.max(exact.judge(u, t).backward);
            assert!(backward <= BACKWARD, "{u:e} {t:e} {curve:?}");
            let near = exact.near(t);
            assert!(near.cdf_ulp(ours.cdf(t), CDF_FLOOR) <= VALUE);
            let error = near.pdf_ulp(ours.pdf(t));
            assert!(error <= VALUE, "{error} ulp: pdf({t:e}) = {:e} of {curve:?}", ours.pdf(t));
        }
        let error = (ours.exposure() as f64 - exact.area().hi).abs() / ulp_f32(exact.area().hi);
        assert!(error <= SCALAR);
    }
    println!("single ramps: backward {backward:.3} ulp(u)");
}

/// Neighbouring `u` by the hundred thousand: from both ends, at the landmarks and anywhere.
#[test]
fn never_a_step_back() {
    let mut pairs = 0u64;
    let mut sweep = |curve: &Curve, length: u32| {
        let exact = Exact::new(curve);
        let (direct, compact) = (shutter::<8>(curve), shutter::<0>(curve));
        let mut rng = Rng::new(9, length as u64);
        let mut starts = vec![0, 1.0f32.to_bits() - length, 0.5f32.to_bits() - length / 2];
        starts.extend(
            exact.landmarks().iter().map(|u| (u.to_f32().to_bits()).saturating_sub(length / 2)),
        );
        starts.extend((1..10).map(|i| (0.5f32.to_bits() - (i << 23)) - length / 2));
        starts.extend((0..10).map(|_| (rng.unit() as f32).to_bits()));
        for start in starts {
            let (mut a, mut b) = (f32::NEG_INFINITY, f32::NEG_INFINITY);
            for bits in start..start + length {
                let u = f32::from_bits(bits);
                let (direct, compact) = (direct.inverse_cdf(u), compact.inverse_cdf(u));
                assert!(direct >= a && compact >= b, "{u:e}: {direct} {a} {compact} {b} {curve:?}");
                (a, b) = (direct, compact);
            }
            pairs += 2 * length as u64;
        }
    };
    for one in named() {
        sweep(&one.curve, 4000);
    }
    for i in 0..200 {
        sweep(&random_hard(8, i), 400);
    }
    println!("{pairs} neighbouring pairs");
    assert!(pairs > 5_000_000);
}

/// The same for the cdf, at the joins, at the landmarks, around time 0 and anywhere.
#[test]
fn the_cdf_never_steps_back() {
    let mut pairs = 0;
    let mut sweep = |curve: &Curve, length: u32| {
        let (exact, ours) = (Exact::new(curve), shutter::<8>(curve));
        let mut rng = Rng::new(10, length as u64);
        let mut starts: Vec<f32> = exact.landmark_times().iter().map(|t| t.to_f32()).collect();
        starts.push(0.0);
        starts.extend((0..10).map(|_| exact.inverse_cdf(rng.unit() as f32).to_f32()));
        for start in starts {
            let mut t = start;
            for _ in 0..length / 2 {
                t = t.next_down();
            }
            let mut last = 0.0;
            for _ in 0..length {
                let cdf = ours.cdf(t);
                assert!(cdf >= last && cdf <= 1.0, "{cdf:e} after {last:e} at {t:e} of {curve:?}");
                (t, last) = (t.next_up(), cdf);
            }
            pairs += length;
        }
    };
    for one in named() {
        sweep(&one.curve, 3000);
    }
    for i in 0..200 {
        sweep(&random_hard(8, i), 300);
    }
    println!("{pairs} neighbouring times");
    assert!(pairs > 2_000_000);
}

/// Where openness touches 0 far from the end, the terms of the mass there cancel all but a 500th of their sum, and what rounding
/// leaves is more than neighbouring times differ by. The plateau's length puts the middle of two `f32` right there.
#[test]
fn the_cdf_never_steps_back_where_terms_cancel() {
    let opening =
        [(0.0, 0.0), (0.2149356, 0.04391764), (-0.3171351, -0.043355178), (1.0, 0.03209994)];
    let ours = shutter::<8>(&Curve::shutter(opening, [(1.0071398, 1.0); 4]));
    let mut t = 0.2063f32;
    let (first, mut steps, mut last) = (ours.cdf(t), 0, ours.cdf(t));
    for _ in 0..10_000 {
        t = t.next_up();
        let cdf = ours.cdf(t);
        assert!(cdf >= last, "{cdf:e} after {last:e} at {t:e}");
        steps += u32::from(cdf > last);
        last = cdf;
    }
    assert!(steps == 1, "from {first:e} to {last:e}: not the middle of two f32");
}

/// The same on many ramps that are dark inside: the shutter closes at once, at the time, of thousands, that brings the mass at
/// the darkest place nearest to the middle of two `f32`.
#[test]
fn the_cdf_never_steps_back_in_the_dark() {
    let (mut walked, mut stepped) = (0, 0);
    for (family, index) in [0, 1, 4, 6].into_iter().flat_map(|f| (0..60).map(move |i| (f, i))) {
        let ramp = aimed(family, 41, index).opening;
        let [(start, _), .., (open, _)] = ramp;
        let closes = |end: f32| Curve::shutter(ramp, [(end, 1.0); 4]);
        if open <= start || !is_valid(&closes(open + (open - start))) {
            continue;
        }
        let exact = Exact::new(&closes(open + (open - start)));
        let area = exact.area().hi - f64::from((open + (open - start)) - open);
        let (us, ts) = (exact.landmarks(), exact.landmark_times());
        for (u, t) in us[2..].iter().zip(&ts[4..]) {
            let (mass, t) = (u.hi * exact.area().hi, t.to_f32());
            if !(t > start && t < open && mass > 0.0 && mass < area) {
                continue;
            }
            let from_middle = |end: f32| {
                let u = mass / (area + f64::from(end - open));
                ((u / ulp_f32(u)).fract() - 0.5).abs()
            };
            let step = (open - start) / 3000.0;
            let ends = (0..9000).map(|i| open + step * i as f32);
            let end = ends.min_by(|a, b| from_middle(*a).total_cmp(&from_middle(*b))).unwrap();
            let ours = shutter::<8>(&closes(end));
            let mut t = t;
            (0..1500).for_each(|_| t = t.next_down());
            let (first, mut last) = (ours.cdf(t), 0.0);
            for _ in 0..3000 {
                let cdf = ours.cdf(t);
                assert!(cdf >= last, "{cdf:e} after {last:e} at {t:e} of {:?}", closes(end));
                (t, last) = (t.next_up(), cdf);
            }
            (walked, stepped) = (walked + 1, stepped + u32::from(last > first));
        }
    }
    println!("{walked} walks, a step on {stepped}");
    assert!(stepped > 100, "a step on {stepped} of {walked}");
}

/// Around time 0 neighbours on a plateau are closer than two `f32` tell fractions apart. In each of these boxes the middle of two
/// fractions is where the time since the start gains a last bit, and with it another rounding.
#[test]
fn the_cdf_never_steps_back_next_to_time_0() {
    for (start, end) in [(-1.3730043, 2.5725152), (-1.7764826, 0.6210457), (-1.8631686, 2.4521976)]
    {
        let ours = shutter::<8>(&Curve::shutter([(start, 1.0); 4], [(end, 1.0); 4]));
        let first = 2f32.powi(-24).to_bits() - 200;
        let values: Vec<f32> = (first..first + 400).map(|t| ours.cdf(f32::from_bits(t))).collect();
        assert!(values.is_sorted(), "from {start} to {end}");
        assert!(values[0] < values[399], "from {start} to {end}: not the middle of two f32");
    }
}

#[test]
fn a_mirrored_curve_gives_mirrored_times() {
    let mut compared = 0;
    for i in 0..500 {
        let curve = if i < 36 { named()[i].curve } else { random_hard(10, i as u64) };
        let (a, b) = (shutter::<8>(&curve), shutter::<8>(&curve.mirrored()));
        for k in 1..=1000 {
            // A u whose complement is exact too.
            let u = (k * 16_777) as f32 / (1 << 24) as f32;
            assert_eq!(a.inverse_cdf(u), -b.inverse_cdf(1.0 - u), "{u} {curve:?}");
            compared += 1;
        }
    }
    assert_eq!(compared, 500_000);
}

#[test]
fn scaled_times_give_scaled_answers() {
    for one in named().iter().filter(|one| !one.name.starts_with("t_2")) {
        for power in [2.0, 0.125, 2f32.powi(30), 2f32.powi(-40)] {
            let (a, b) = (shutter::<8>(&one.curve), shutter::<8>(&one.curve.scaled(power)));
            for u in spread(500) {
                assert_eq!(power * a.inverse_cdf(u), b.inverse_cdf(u), "{u} {}", one.name);
            }
            for k in 0..500 {
                let t = a.open_start() + (a.close_end() - a.open_start()) * k as f32 / 500.0;
                assert_eq!(a.cdf(t), b.cdf(power * t), "{} {power} {t}", one.name);
                assert_eq!(a.openness(t), b.openness(power * t));
            }
        }
    }
}

/// Where an octave ends at time 0, it is an ulp of the curve's greater end that its polynomial is judged by: one of the time
/// itself would refuse any.
#[test]
fn time_0_at_half_of_the_light_needs_no_search() {
    for name in ["raised_cosine", "triangle"] {
        let curve = named().into_iter().find(|one| one.name == name).expect("its name").curve;
        let middle = 0.5 * (curve.open_start() + curve.close_end());
        let moved = |points: Points| points.map(|(t, f)| (t - middle, f));
        let ours = shutter::<8>(&Curve::shutter(moved(curve.opening), moved(curve.closing)));
        assert!([0.3, 0.4, 0.49, 0.51, 0.7].iter().all(|u| ours.evaluations(*u) == 0), "{name}");
    }
}

/// What the tests of searches go by: a search takes one evaluation to come near and one to measure, at least; all else takes none.
#[test]
fn evaluations_are_those_of_searches() {
    let curve =
        named().into_iter().find(|one| one.name == "raised_cosine").expect("its name").curve;
    let (direct, searched) = (shutter::<8>(&curve), shutter::<0>(&curve));
    for u in [1e-20, 0.01, 0.1, 0.4, 0.6, 0.9, 0.99] {
        assert!((2..=EVALUATIONS).contains(&searched.evaluations(u)), "at {u}");
        assert_eq!(direct.evaluations(u) == 0, direct.is_direct(u), "at {u}");
    }
    for u in [0.0, 1.0, -1.0, 2.0, f32::NAN] {
        assert_eq!(searched.evaluations(u), 0, "at {u}");
    }
}

/// However short the plateau around half of the light, the octaves end where it begins: beyond, where the shutter jumps from half to
/// fully open, no polynomial would serve.
#[test]
fn a_plateau_next_to_half_of_the_light_needs_no_search() {
    let trace = 2f32.powi(-24);
    let half = |start, end| CubicBezier::line((start, 0.5), (end, 0.5)).points();
    let ours = shutter::<8>(&Curve::shutter(half(-1.0, 0.0), half(trace, 1.0)));
    assert!([0.3, 0.4, 0.49, 0.51, 0.7].iter().all(|u| ours.evaluations(*u) == 0));
}

/// Ramps, openness and intervals as far apart as `f32` and the limits of a curve let them be; some are refused, since
/// `f32` does not hold their area or its reciprocal.
#[test]
fn extremes() {
    let line = |a, b| CubicBezier::line(a, b).points();
    let mut curves = Vec::new();
    for end in [1.8e19f32, 1.0, 1e-10] {
        let closing = line((end * 0.5, 1.0), (end, 0.0));
        for ramp in [1e-45f32, 1e-42, 1e-40, 1e-38, 1e-30, 1e-20, 1e-11] {
            let late = [(0.0, 0.0), (ramp * 0.25, 0.0), (ramp * 0.5, 1.0), (ramp, 1.0)];
            curves.push(Curve::shutter(line((0.0, 0.0), (ramp, 1.0)), closing));
            curves.push(Curve::shutter(late, closing));
            let (dark, darker) =
                (line((0.0, 1.0), (ramp, 1e-38)), line((ramp, 1e-38), (end, 1e-30)));
            curves.push(Curve::shutter(dark, darker));
        }
    }
    for height in [1e-37f32, 1e-30, 1e-20, 1.0] {
        for length in [6e-20f32, 1e-10, 1.0, 1e10, 1.8e19] {
            let at = |t: f32, f: f32| (length * t, height * f);
            curves.push(Curve::single([at(0.0, 0.0), at(0.3, 0.0), at(0.6, 1.0), at(1.0, 1.0)]));
            curves.push(Curve::single([at(0.0, 1.0), at(0.3, 1e-30), at(0.6, 0.0), at(1.0, 1.0)]));
            curves.push(Curve::single(line(at(0.0, 1.0), at(1.0, 1e-20))));
        }
    }
    let refused = |error| matches!(error, CurveError::ZeroArea | CurveError::AreaOutOfRange);
    let mut checked = 0;
    for curve in curves {
        let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
        let exact = Exact::new(&curve);
        let mut us = hard_us(&exact, 11, 8);
        us.sort_by(f32::total_cmp);
        let direct = match ShutterCurve::<8>::with_octaves(opening, closing) {
            Ok(direct) => direct,
            Err(error) => {
                assert!(refused(error), "{error}: {curve:?}");
                continue;
            }
        };
        let searched = shutter::<0>(&curve);
        judge::<0>(&exact, &us, &mut Worst::default());
        judge::<8>(&exact, &us, &mut Worst::default());
        let mut ts: Vec<f32> = us.iter().map(|u| direct.inverse_cdf(*u)).collect();
        assert!(ts.is_sorted());
        ts.extend((0..=40).map(|i| curve.opening[3].0 * (i as f32 / 40.0)));
        ts.extend((0..20).map(f32::from_bits));
        for t in ts.into_iter().filter(|t| *t <= curve.close_end()) {
            let near = exact.near(t);
            let errors = [
                near.cdf_ulp(searched.cdf(t), CDF_FLOOR),
                near.openness_ulp(searched.openness(t)),
                near.pdf_ulp(searched.pdf(t)),
            ];
            assert!(errors.iter().all(|e| *e <= VALUE), "{errors:?} ulp at {t:e} of {curve:?}");
        }
        checked += 1;
    }
    println!("{checked} extreme curves");
    assert!(checked > 100, "{checked}");
}
