//! What a user would try: do samples follow the curve, and does a picture made of them come out right?
//!
//! Every scene of the main example is judged. With fixed seeds a test at 0.1 % either passes for ever or
//! is wrong; that it can fail, the document's own slip shows.

mod support;

use shutter_curve::CubicBezier;
use support::cases;
use support::curves::Rng;
use support::oracle::{Curve, Dd, Exact};
use support::rendering::{PULSES, Picture, middle_of_share};

const SEED: u64 = 2024;
const SAMPLES: usize = 100_000;

/// Kolmogorov's statistic times the root of the number of samples, at 0.1 %.
const KOLMOGOROV: f64 = 1.949;

/// Chi-square at 0.1 %, by Wilson and Hilferty's approximation.
fn chi_square_bound(freedom: f64) -> f64 {
    let scale = 2.0 / (9.0 * freedom);
    freedom * (1.0 - scale + 3.090 * scale.sqrt()).powi(3)
}

/// The greatest distance between the cdf and that of the samples, which are sorted.
fn kolmogorov(exact: &Exact, samples: &[f32]) -> f64 {
    let n = samples.len() as f64;
    let distances = samples.iter().enumerate().map(|(i, t)| {
        let cdf = exact.cdf(*t).hi;
        (cdf - i as f64 / n).max((i + 1) as f64 / n - cdf)
    });
    distances.fold(0.0, f64::max)
}

/// Chi-square over about 100 equal spans of time, and its degrees of freedom.
fn chi_square(exact: &Exact, samples: &[f32]) -> (f64, f64) {
    let (start, end) =
        (f64::from(exact.curve().open_start()), f64::from(exact.curve().close_end()));
    let edge = |i: usize| start + (end - start) * i as f64 / 100.0;
    let below = |t: f64| samples.partition_point(|sample| f64::from(*sample) < t);
    let (mut sum, mut spans) = (0.0, 0);
    let mut from = 0;
    for to in 1..=100 {
        let share = exact.cdf_dd(Dd::from(edge(to))) - exact.cdf_dd(Dd::from(edge(from)));
        let expected = share.hi * samples.len() as f64;
        // A span in which less is expected joins the next; the last is let go.
        if expected < 10.0 {
            continue;
        }
        let observed = (below(edge(to)) - below(edge(from))) as f64;
        sum += (observed - expected).powi(2) / expected;
        spans += 1;
        from = to;
    }
    (sum, f64::from(spans - 1))
}

fn sorted(samples: impl Iterator<Item = f32>) -> Vec<f32> {
    let mut samples: Vec<f32> = samples.collect();
    samples.sort_by(f32::total_cmp);
    samples
}

fn uniform() -> impl Iterator<Item = f32> {
    let mut rng = Rng::new(SEED, 0);
    (0..SAMPLES).map(move |_| rng.unit() as f32)
}

/// The scenes that ship, by their files' names.
fn scenes() -> Vec<(String, Curve)> {
    let folder = std::fs::read_dir("cli/scenes").expect("the scenes");
    let mut scenes: Vec<_> = folder
        .map(|file| {
            let path = file.expect("a file").path();
            let text = std::fs::read_to_string(&path).expect("text");
            (path.display().to_string(), curve(&text.parse().expect("TOML")))
        })
        .collect();
    scenes.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(scenes.len() >= 4);
    scenes
}

/// The curve of a scene: four times, and with them eight inner control numbers or straight ramps.
fn curve(scene: &toml::Table) -> Curve {
    let number = |value: &toml::Value| {
        let number = value.as_float().or(value.as_integer().map(|n| n as f64));
        number.expect("a number") as f32
    };
    let times = ["open_start", "open_end", "close_start", "close_end"].map(|k| number(&scene[k]));
    let (opening, closing) = match scene.get("shutteropening") {
        Some(inner) => {
            let inner: Vec<f32> = inner.as_array().expect("an array").iter().map(number).collect();
            CubicBezier::shutteropening(times, inner.try_into().expect("eight numbers"))
        }
        None => (
            CubicBezier::line((times[0], 0.0), (times[1], 1.0)),
            CubicBezier::line((times[2], 1.0), (times[3], 0.0)),
        ),
    };
    Curve::shutter(opening.points(), closing.points())
}

#[test]
fn random_samples_follow_the_curve() {
    for (name, curve) in scenes() {
        let (exact, ours) = (Exact::new(&curve), cases::shutter::<8>(&curve));
        let samples = sorted(uniform().map(|u| ours.inverse_cdf(u)));
        let distance = kolmogorov(&exact, &samples) * (SAMPLES as f64).sqrt();
        let (chi, freedom) = chi_square(&exact, &samples);
        println!("{name}: Kolmogorov {distance:.3}, chi-square {chi:.1} of {freedom} degrees");
        assert!(distance < KOLMOGOROV, "{name}");
        assert!(chi < chi_square_bound(freedom), "{name}");
        // Too good would be wrong as well: random samples are not stratified ones.
        assert!(distance > 0.3, "{name}");
    }
}

#[test]
fn stratified_samples_come_within_half_a_share() {
    for (name, curve) in scenes() {
        let (exact, ours) = (Exact::new(&curve), cases::shutter::<8>(&curve));
        for n in [1, 2, 7, 64, 1000, 4096] {
            let samples: Vec<f32> =
                (0..n).map(|i| ours.inverse_cdf(middle_of_share(i, n))).collect();
            let distance = kolmogorov(&exact, &samples) * f64::from(n);
            // Half a share, and what the rounding of t and of u = (i + 1/2)/n moves.
            assert!((distance - 0.5).abs() < 0.01, "{name}: {distance} shares of {n}");
        }
    }
}

/// The document writes `t = u/K` on the plateau; samples by that are rejected, so the tests can fail.
#[test]
fn samples_by_the_slip_are_rejected() {
    let curve = Curve::shutter(
        [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)],
        [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)],
    );
    let (exact, ours) = (Exact::new(&curve), cases::shutter::<8>(&curve));
    let slip = |u: f32| {
        let t = ours.inverse_cdf(u);
        let on_plateau = t > ours.open_end() && t < ours.close_start();
        if on_plateau { u * ours.exposure() } else { t }
    };
    let samples = sorted(uniform().map(slip));
    assert!(kolmogorov(&exact, &samples) * (SAMPLES as f64).sqrt() > 10.0 * KOLMOGOROV);
    let (chi, freedom) = chi_square(&exact, &samples);
    assert!(chi > 10.0 * chi_square_bound(freedom));
}

#[test]
fn a_picture_in_pulses_is_within_one_share_of_the_exact_one() {
    for (name, curve) in scenes() {
        let picture = Picture::new(&curve);
        for n in [64, 256, 1024, 4096] {
            let [triggers, weighted, random] =
                PULSES.map(|pulses| picture.error(&picture.exposed(pulses, n, SEED)));
            println!("{name}, {n}: {triggers:?} {weighted:?} {random:?}");
            assert!(triggers.0 <= 1.001 / f64::from(n), "{name}: {triggers:?} of {n}");
            assert!(triggers.1 < 0.3 * random.1, "{name}: {random:?}");
        }
    }
}
