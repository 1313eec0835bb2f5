//! A search for the worst curves: random ones, then uphill from the worst of them; and families of curves that meet
//! difficulties exactly.

use rayon::prelude::*;

use crate::accuracy::judge_on;
use crate::support::aimed::{FAMILIES, aimed};
use crate::support::cases::shutter;
use crate::support::curves::{Rng, hard_us, is_valid, random_hard, random_typical, settled};
use crate::support::oracle::{Curve, Dd, Exact, Points, ulp_f32};
use crate::support::promise::Figures;

const SEED: u64 = 20_261_123;
const AIMED_SEED: u64 = 20_261_124;
/// How many of the worst are climbed from, for each aim.
const STARTS: usize = 4;
/// The share of random curves in all that are tried; the rest are steps uphill.
const RANDOM_SHARE: f64 = 0.6;

/// What is searched for. Forward errors count where an ulp of u moves the time by no more than one, backward ones once
/// half an ulp(t) is forgiven.
const AIMS: [&str; 5] = [
    "error in ulp(t), where an ulp of u moves the time by at most one",
    "error in ulp(u)",
    "evaluations",
    "steps back",
    "cdf(inverse_cdf(u)) - u, over what one ulp of t and three of the cdf explain",
];

/// The columns of `docs/internals/search.csv`. Of curves that were bred for an aim there is the worst in it alone, and
/// where. Of an aimed family there is the worst in all that is promised: steps back of the inverse between fractions,
/// of the cdf between times, and of the ticks of a frame; errors in ulp, and in ticks; how often any promise was
/// broken, and the first breach of each.
const COLUMNS: &str = "what is_bred curves worst backward evaluations steps_back cdf_steps_back tick_steps_back cdf density \
                       ticks breaches at";

/// How bad a curve is, for each of the aims.
fn score(curve: &Curve) -> [f64; 5] {
    let (exact, ours) = (Exact::new(curve), shutter::<8>(curve));
    let mut us = hard_us(&exact, SEED, 60);
    us.sort_by(f32::total_cmp);
    let verdict = judge_on(&exact, |u| ours.inverse_cdf(u), &us);
    let (mut evaluations, mut forward, mut round_trip) = (0, 0.0f64, 0.0f64);
    for &u in us.iter().step_by(7) {
        evaluations = evaluations.max(ours.evaluations(u));
        let t = ours.inverse_cdf(u);
        // Of the two sides of a join, the darker one.
        let density = exact.pdf(t).min(exact.pdf(exact.inverse_cdf(u))).hi;
        let conditioned = ulp_f32(u.into()) <= density * ulp_f32(t.into());
        if conditioned && u > 0.0 && u < 1.0 {
            forward = forward.max(exact.judge(u, t).forward);
        }
        // What the fraction gains from an ulp before t to one after it, and three ulp of the cdf, which count from 2⁻²⁴
        // on.
        let ulp = Dd::from(exact.ulp_of_time(Dd::from(t)));
        let [low, high] = [Dd::from(t) - ulp, Dd::from(t) + ulp].map(|t| exact.cdf(t).hi);
        let explained = (high - low) + 3.0 * ulp_f32(f64::from(u).max(6e-8));
        let miss = (f64::from(ours.cdf(t)) - f64::from(u)).abs();
        round_trip = round_trip.max(miss / explained);
    }
    [forward, verdict.backward, evaluations.into(), verdict.steps_back.into(), round_trip]
}

/// A neighbour: one or two control points moved a little, on a scale of its own, or onto each other.
fn step(curve: &Curve, rng: &mut Rng) -> Curve {
    let mut next = *curve;
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    for _ in 0..=rng.below(2) {
        let points = if rng.chance(0.5) { &mut next.opening } else { &mut next.closing };
        let [i, other] = [0, 1].map(|_| rng.below(4) as usize);
        let size = rng.power_of_ten(-7.0, -0.5) * rng.between(-1.0, 1.0);
        match rng.below(5) {
            0 => points[i].0 = points[other].0,
            1 => points[i].1 = points[other].1,
            2 | 3 => points[i].0 = (f64::from(points[i].0) + size * length) as f32,
            _ => points[i].1 = (f64::from(points[i].1) + size) as f32,
        }
    }
    settled(next)
}

/// The lines of `docs/internals/search.csv`, after trying about `curves` curves of either half.
pub fn search(curves: u64) -> Vec<Vec<String>> {
    let columns = COLUMNS.split(' ').map(String::from).collect();
    let families = (0..FAMILIES.len()).into_par_iter();
    let aimed: Vec<_> = families.map(|family| aim(family, curves / FAMILIES.len() as u64)).collect();
    [vec![columns], breed(curves), aimed].concat()
}

/// Tries about `curves` curves, most of them random, the others uphill from the worst.
fn breed(curves: u64) -> Vec<Vec<String>> {
    let random = (curves as f64 * RANDOM_SHARE) as u64;
    let mut tried = 0;
    let mut worst: [Vec<(f64, Curve)>; 5] = Default::default();
    for index in 0..random {
        let curve = if index % 4 == 3 { random_typical(SEED, index) } else { random_hard(SEED, index) };
        for (worst, score) in worst.iter_mut().zip(score(&curve)) {
            worst.push((score, curve));
            worst.sort_by(|a, b| b.0.total_cmp(&a.0));
            worst.truncate(STARTS);
        }
        tried += 1;
    }
    let steps = (curves - random) / (AIMS.len() * STARTS) as u64;
    for (aim, worst) in worst.iter_mut().enumerate() {
        for (start, (best, curve)) in worst.iter_mut().enumerate() {
            let mut rng = Rng::new(SEED, ((aim * STARTS + start) as u64) << 32);
            for _ in 0..steps {
                let next = step(curve, &mut rng);
                if !is_valid(&next) {
                    continue;
                }
                tried += 1;
                let score = score(&next)[aim];
                if score >= *best {
                    (*best, *curve) = (score, next);
                }
            }
        }
        worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    }
    let text = |points: Points| points.map(|(t, f)| format!("({t:?}, {f:?})")).join(", ");
    let finds = worst.iter().enumerate().map(|(aim, worst)| {
        let (worst, curve) = worst[0];
        let mut find = vec![AIMS[aim].into(), "true".into(), tried.to_string(), format!("{worst:?}")];
        find.resize(13, String::new());
        find.push(format!("{}; {}", text(curve.opening), text(curve.closing)));
        find
    });
    finds.collect()
}

/// Judges all that is promised on so many curves of a family that meets difficulties exactly. The tests do the same
/// with fewer curves and another seed.
fn aim(family: usize, curves: u64) -> Vec<String> {
    let mut figures = Figures::default();
    for index in 0..curves {
        figures.judge(&aimed(family, AIMED_SEED, index), &mut Rng::new(AIMED_SEED, index));
    }
    let count = |what| figures.breaches.get(what).map_or(0, |(count, _)| *count).to_string();
    let first = figures.breaches.iter().map(|(what, (n, at))| format!("{what}, {n} times: {at}"));
    let breaches: u64 = figures.breaches.values().map(|(count, _)| count).sum();
    let [cdf, density, ticks] = [figures.cdf, figures.density, figures.ticks].map(|f| format!("{f:?}"));
    vec![
        FAMILIES[family].0.into(),
        "false".into(),
        curves.to_string(),
        String::new(),
        format!("{:?}", figures.backward),
        figures.evaluations.to_string(),
        count("step back"),
        count("cdf's step back"),
        count("ticks' step back"),
        cdf,
        density,
        ticks,
        breaches.to_string(),
        first.collect::<Vec<_>>().join("; "),
    ]
}
