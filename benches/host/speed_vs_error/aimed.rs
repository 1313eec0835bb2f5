//! The aimed half of `--search`: all that is promised, on the families of curves that meet difficulties exactly. The tests
//! do the same with fewer curves and another seed.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::search::Find;
use crate::support::aimed::{FAMILIES, aimed};
use crate::support::curves::Rng;
use crate::support::promise::Figures;

const SEED: u64 = 20_240_612;

/// Tries about `curves` curves, on two threads that take a family at a time; `tick` hears of each.
pub fn search(curves: u64, tick: impl Fn() + Sync) -> Vec<Find> {
    let each = curves / FAMILIES.len() as u64;
    let (next, tick) = (&AtomicUsize::new(0), &tick);
    let work = move || {
        let mut finds = Vec::new();
        loop {
            let family = next.fetch_add(1, Ordering::Relaxed);
            if family >= FAMILIES.len() {
                return finds;
            }
            let mut figures = Figures::default();
            for index in 0..each {
                figures.judge(&aimed(family, SEED, index), &mut Rng::new(SEED, index));
                tick();
            }
            finds.push((family, find(FAMILIES[family].0, &figures)));
        }
    };
    let mut finds = std::thread::scope(|scope| {
        let other = scope.spawn(work);
        let mut finds = work();
        finds.extend(other.join().expect("the search does not panic"));
        finds
    });
    finds.sort_by_key(|(family, _)| *family);
    finds.into_iter().map(|(_, find)| find).collect()
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
