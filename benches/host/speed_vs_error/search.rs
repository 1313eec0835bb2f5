//! A search for the worst curves: random and aimed ones, then uphill from the worst of them.

use rayon::prelude::*;

use crate::support::aimed::{FAMILIES, aimed};
use crate::support::curves::{Rng, is_valid, random_hard, settled};
use crate::support::oracle::Curve;
use crate::support::promise::Figures;

const SEED: u64 = 20_261_123;
/// How many of the worst are climbed from, for each aim.
const STARTS: usize = 4;

const AIMS: [&str; 5] = [
    "backward error of the inverse, ulp(u)",
    "evaluations",
    "error of `cdf`, ulp",
    "error of `openness` and `pdf`, ulp",
    "error of ticks",
];

/// A line of `docs/internals/search.csv`: the worst of so many curves, and where it is.
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Find {
    pub what: String,
    pub curves: usize,
    pub worst: f64,
    curve: String,
}

/// How bad a curve is, for each of the aims. No promise may be broken.
fn score(curve: &Curve) -> [f64; AIMS.len()] {
    let mut figures = Figures::default();
    figures.judge(curve, &mut Rng::new(SEED, 0));
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
    let Figures { backward, evaluations, cdf, density, ticks, .. } = figures;
    [backward, evaluations.into(), cdf, density, ticks]
}

/// A neighbour, which may not be valid: one or two control points moved a little, on a scale of its own, or onto each
/// other.
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
    let joins = [next.open_start(), next.open_end(), next.close_start(), next.close_end()];
    if joins.is_sorted() { settled(next) } else { next }
}

/// The worst of about so many curves: half of them random or aimed, the others uphill from the worst.
pub fn search(curves: u64) -> Vec<Find> {
    let drawn = (0..curves / 2).into_par_iter().map(|i| {
        let curve = if i % 2 == 0 { random_hard(SEED, i) } else { aimed(i as usize / 2 % FAMILIES.len(), SEED, i) };
        (score(&curve), curve)
    });
    let drawn: Vec<_> = drawn.collect();
    let steps = curves / 2 / (AIMS.len() * STARTS) as u64;
    let climbs = (0..AIMS.len() * STARTS).into_par_iter().map(|i| {
        let (aim, mut rng) = (i / STARTS, Rng::new(SEED, (i as u64) << 32));
        let mut starts: Vec<_> = drawn.iter().collect();
        starts.sort_by(|a, b| b.0[aim].total_cmp(&a.0[aim]));
        let (mut best, mut tried) = (*starts[i % STARTS], 0);
        for _ in 0..steps {
            let next = step(&best.1, &mut rng);
            if !is_valid(&next) {
                continue;
            }
            tried += 1;
            let score = score(&next);
            if score[aim] >= best.0[aim] {
                best = (score, next);
            }
        }
        (aim, best, tried)
    });
    let climbs: Vec<_> = climbs.collect();
    let tried = drawn.len() + climbs.iter().map(|(.., tried)| tried).sum::<usize>();
    let finds = AIMS.iter().enumerate().map(|(aim, what)| {
        let worst = climbs.iter().map(|(_, best, _)| best).max_by(|a, b| a.0[aim].total_cmp(&b.0[aim]));
        let (score, curve) = worst.expect("a curve");
        Find { what: what.to_string(), curves: tried, worst: score[aim], curve: format!("{curve:?}") }
    });
    finds.collect()
}
