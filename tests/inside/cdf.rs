//! The `cdf` where one way to it follows another: places found from either end of a ramp, by a few steps or by a search;
//! the plateau; the join of two ramps; time 0.

use crate::ShutterCurve;
use crate::exposure::Exposure;
use crate::fraction::Side;
use crate::ramp::Ramp;
use crate::support::aimed::{FAMILIES, aimed};
use crate::support::cases::shutter;
use crate::support::curves::{Rng, named, random_hard, random_typical};
use crate::support::oracle::{Curve, Exact};
use crate::support::promise::{CDF_FLOOR, VALUE};

/// How a `cdf` is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    Outside,
    Plateau,
    Ramp { ramp: Side, side: Side, is_quick: bool },
}

const CHANGES: [&str; 7] = [
    "an end",
    "plateau to place",
    "plateau to search",
    "ramp to ramp",
    "end to end",
    "place to search",
    "across time 0",
];

impl Ramp {
    /// The side from which `t` is counted, and whether a few steps lead to its place.
    fn way(&self, t: f32) -> (Side, bool) {
        let (side, target) = self.since(self.on_grid(t));
        (side, self.quick_place(side, target).is_some())
    }
}

fn way(exposure: &Exposure, t: f32) -> Way {
    let [start, open, close, end] = [
        exposure.end(Side::Start),
        exposure.join(Side::Start),
        exposure.join(Side::End),
        exposure.end(Side::End),
    ];
    if !(t >= start && t <= end) {
        return Way::Outside;
    }
    if open < close && t >= open && t <= close {
        return Way::Plateau;
    }
    let ramp = Side::end_if(t > open || t == open && start == open);
    let (side, is_quick) = exposure.ramp(ramp).way(t);
    Way::Ramp { ramp, side, is_quick }
}

/// Which change it is, by the names above.
fn change(ways: [Way; 2]) -> usize {
    let mut ways = ways;
    ways.sort_unstable();
    match ways {
        [Way::Outside, _] => 0,
        [Way::Plateau, Way::Ramp { is_quick: true, .. }] => 1,
        [Way::Plateau, _] => 2,
        [Way::Ramp { ramp, side, .. }, Way::Ramp { ramp: other, side: from, .. }] => {
            if ramp != other {
                3
            } else if side != from {
                4
            } else {
                5
            }
        }
        _ => unreachable!(),
    }
}

/// Walks so many neighbours around each change of way that so many samples show, and judges order and error.
fn walk(exact: &Exact, exposure: &Exposure, samples: u32, seen: &mut [u32; 7]) {
    let [start, end] = [exposure.end(Side::Start), exposure.end(Side::End)];
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
        let first = way(exposure, low);
        if first == way(exposure, high) {
            continue;
        }
        // The last time that has the way of the first, by halves.
        while low.next_up() < high {
            let middle = (low / 2.0 + high / 2.0).clamp(low.next_up(), high.next_down());
            *(if way(exposure, middle) == first { &mut low } else { &mut high }) = middle;
        }
        starts.push((low, change([first, way(exposure, high)])));
    }
    if start < 0.0 && end > 0.0 {
        starts.push((0.0, 6));
    }
    for (middle, change) in starts {
        seen[change] += 1;
        let mut t = middle;
        for _ in 0..40 {
            t = t.next_down();
        }
        let mut last = 0.0;
        for i in 0..80 {
            let cdf = exposure.cdf(t);
            assert!(
                cdf >= last,
                "{cdf:e} after {last:e} at {t:e}, {}, of {:?}",
                CHANGES[change],
                exact.curve()
            );
            if (30..50).contains(&i) && t >= start && t <= end {
                let error = exact.near(t).cdf_ulp(cdf, CDF_FLOOR);
                assert!(
                    error <= VALUE,
                    "{error} ulp at {t:e}, {}, of {:?}",
                    CHANGES[change],
                    exact.curve()
                );
            }
            (t, last) = (t.next_up(), cdf);
        }
    }
}

fn walk_on(curve: &Curve, samples: u32, seen: &mut [u32; 7]) {
    let ours: ShutterCurve<0> = shutter(curve);
    walk(&Exact::new(curve), &ours.plan.exposure, samples, seen);
}

/// No plateau, and a ramp across time 0: at the join the time is exact, and next to it rounded to a multiple. Plain
/// decimals, and whole ramps of random length.
fn joined_across_0(rng: &mut Rng) -> Curve {
    let mut decimal = |most| 0.001 * (1 + rng.below(most)) as f64;
    let (open, join, end) = (decimal(4000), decimal(4000), decimal(6000));
    let inner = [0.5, 0.5, 0.25, 0.75][rng.below(4) as usize];
    let ramp = |from: f64, to: f64, [f, g]: [f32; 2]| {
        let at = |share: f64| (from + (to - from) * share) as f32;
        [(from as f32, f), (at(inner), f), (at(1.0 - inner), g), (to as f32, g)]
    };
    let (start, join) = (-join - open, -join);
    let curve = Curve::shutter(ramp(start, join, [0.0, 1.0]), ramp(join, end, [1.0, 0.0]));
    if rng.below(2) == 0 { curve } else { curve.mirrored() }
}

#[test]
fn no_step_back_and_no_error_where_one_way_follows_another() {
    let mut seen = [0; 7];
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
    // The first on which a cdf stepped back at the join.
    let opening = [(-3.42, 0.0), (-1.89, 0.0), (-1.89, 1.0), (-0.36, 1.0)];
    let closing = [(-0.36, 1.0), (1.395, 1.0), (1.395, 0.0), (3.15, 0.0)];
    walk_on(&Curve::shutter(opening, closing), 300, &mut seen);
    let mut rng = Rng::new(25, 0);
    for _ in 0..1000 {
        walk_on(&joined_across_0(&mut rng), 20, &mut seen);
    }
    for (change, seen) in CHANGES.iter().zip(seen) {
        println!("{change}: {seen}");
        // Not just once: at a ramp's very end any way is quick.
        assert!(seen >= 20, "{change} seen {seen} times");
    }
}
