//! Where one way to a `cdf` follows another: octaves, a quick place, a search and the plateau.

use crate::ShutterCurve;
use crate::plan::Plan;
use crate::support::aimed::{FAMILIES, aimed};
use crate::support::cases::shutter;
use crate::support::curves::{named, random_hard, random_typical};
use crate::support::oracle::{Curve, Exact};
use crate::support::promise::{CDF_FLOOR, VALUE};

/// How a `cdf` is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    Outside,
    Plateau,
    Octave(usize, usize),
    Quick(usize),
    Search(usize),
}

const WAYS: [&str; 10] = [
    "an end",
    "plateau to octave",
    "plateau to place",
    "plateau to search",
    "octave to octave",
    "side to side",
    "octave to place",
    "octave to search",
    "place to search",
    "across time 0",
];

impl<const CELLS: usize> Plan<CELLS> {
    fn way(&self, t: f32) -> Way {
        let exposure = &self.exposure;
        let [start, open, close, end] =
            [exposure.outer(0), exposure.inner(0), exposure.inner(1), exposure.outer(1)];
        if !(t >= start && t <= end) {
            return Way::Outside;
        }
        if open < close && t >= open && t <= close {
            return Way::Plateau;
        }
        let ramp = (t > open || t == open && start == open) as usize;
        if let Some(u) = self.cdf_by_octave(ramp, t) {
            let (side, a) = Self::nearer(u);
            let (octave, _) =
                self.look_up(side, ramp, a).expect("an octave's answer is looked up there");
            let place = self.octaves[side].iter().position(|one| core::ptr::eq(one, octave));
            return Way::Octave(side, place.expect("one of the side's"));
        }
        if exposure.ramp(ramp).is_quick(t) { Way::Quick(ramp) } else { Way::Search(ramp) }
    }
}

/// Which change it is, by the names above.
fn change(ways: [Way; 2]) -> usize {
    let mut ways = ways;
    ways.sort_unstable();
    match ways {
        [Way::Outside, _] => 0,
        [Way::Plateau, Way::Octave(..)] => 1,
        [Way::Plateau, Way::Quick(_)] => 2,
        [Way::Plateau, _] => 3,
        [Way::Octave(one, _), Way::Octave(other, _)] => 4 + usize::from(one != other),
        [Way::Octave(..), Way::Quick(_)] => 6,
        [Way::Octave(..), _] => 7,
        _ => 8,
    }
}

/// Walks so many neighbours around each change of way that so many samples show, and judges order and error.
fn walk<const CELLS: usize>(exact: &Exact, plan: &Plan<CELLS>, samples: u32, seen: &mut [u32; 10]) {
    let [start, end] = [plan.exposure.outer(0), plan.exposure.outer(1)];
    let length = f64::from(end) - f64::from(start);
    let mut ts: Vec<f32> = (0..=samples)
        .map(|i| (f64::from(start) + length * f64::from(i) / f64::from(samples)) as f32)
        .chain(exact.landmark_times().iter().map(|t| t.to_f32()))
        .chain([start.next_down(), end.next_up(), exact.inverse_cdf(0.5).to_f32()])
        .collect();
    ts.sort_by(f32::total_cmp);
    let mut starts: Vec<(f32, usize)> = Vec::new();
    for pair in ts.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        let first = plan.way(low);
        if first == plan.way(high) {
            continue;
        }
        // The last time that has the way of the first, by halves.
        while low.next_up() < high {
            let middle = (low / 2.0 + high / 2.0).clamp(low.next_up(), high.next_down());
            *(if plan.way(middle) == first { &mut low } else { &mut high }) = middle;
        }
        starts.push((low, change([first, plan.way(high)])));
    }
    if start < 0.0 && end > 0.0 {
        starts.push((0.0, 9));
    }
    for (middle, change) in starts {
        seen[change] += 1;
        let mut t = middle;
        for _ in 0..40 {
            t = t.next_down();
        }
        let mut last = 0.0;
        for i in 0..80 {
            let cdf = plan.cdf(t);
            assert!(
                cdf >= last,
                "{cdf:e} after {last:e} at {t:e}, {}, of {:?}",
                WAYS[change],
                exact.curve()
            );
            if (30..50).contains(&i) && t >= start && t <= end {
                let error = exact.near(t).cdf_ulp(cdf, CDF_FLOOR);
                assert!(
                    error <= VALUE,
                    "{error} ulp at {t:e}, {}, of {:?}",
                    WAYS[change],
                    exact.curve()
                );
            }
            (t, last) = (t.next_up(), cdf);
        }
    }
}

fn walk_on(curve: &Curve, samples: u32, seen: &mut [u32; 10]) {
    let exact = Exact::new(curve);
    let (eight, none): (ShutterCurve<8>, ShutterCurve<0>) = (shutter(curve), shutter(curve));
    walk(&exact, &eight.plan, samples, seen);
    walk(&exact, &none.plan, samples, seen);
}

#[test]
fn no_step_back_and_no_error_where_one_way_follows_another() {
    let mut seen = [0; 10];
    for one in named() {
        walk_on(&one.curve, 2000, &mut seen);
    }
    for i in 0..60 {
        walk_on(&random_typical(25, i), 300, &mut seen);
        walk_on(&random_hard(25, i), 300, &mut seen);
    }
    for family in 0..FAMILIES.len() {
        for i in 0..8 {
            walk_on(&aimed(family, 25, i), 300, &mut seen);
        }
    }
    for (way, seen) in WAYS.iter().zip(seen) {
        println!("{way}: {seen}");
        assert!(seen > 0, "{way} not seen");
    }
}
