//! The aimed half of `--search`: all that is promised, on the families of curves that meet difficulties exactly. The tests
//! do the same with fewer curves and another seed.

use crate::search::Find;
use crate::support::aimed::{FAMILIES, aimed};
use crate::support::curves::Rng;
use crate::support::promise::Figures;
use crate::sweep::on_two_threads;

const SEED: u64 = 20_261_124;

/// Tries about `curves` curves.
pub fn search(curves: u64) -> Vec<Find> {
    on_two_threads(FAMILIES.len(), |family| {
        let mut figures = Figures::default();
        for index in 0..curves / FAMILIES.len() as u64 {
            figures.judge(&aimed(family, SEED, index), &mut Rng::new(SEED, index));
        }
        find(FAMILIES[family].0, &figures)
    })
}

fn find(family: &str, figures: &Figures) -> Find {
    let count = |what| figures.breaches.get(what).map_or(0, |(count, _)| *count);
    let first = figures.breaches.iter().map(|(what, (n, at))| format!("{what}, {n} times: {at}"));
    Find {
        what: family.into(),
        is_bred: false,
        curves: figures.curves,
        backward: Some(figures.backward),
        evaluations: Some(figures.evaluations),
        steps_back: Some(count("step back")),
        cdf_steps_back: Some(count("cdf's step back")),
        tick_steps_back: Some(count("ticks' step back")),
        cdf: Some(figures.cdf),
        density: Some(figures.density),
        few_ticks: Some(figures.ticks[0]),
        many_ticks: Some(figures.ticks[1]),
        breaches: Some(figures.breaches.values().map(|(count, _)| count).sum()),
        at: first.collect::<Vec<_>>().join("; "),
        ..Find::default()
    }
}
