//! Curves that rounding takes below a bound in all ways, and curves with subnormal times: everything that is promised, and
//! that lifting moves a curve by no more than it has to.
//!
//! `cargo test --test families_lift -- --nocapture` prints the worst of each family.

/// The library's own rule, to be held against the oracle's.
#[path = "../src/ramp/cubic.rs"]
#[allow(dead_code)]
mod cubic;
#[path = "../src/ramp/lift.rs"]
mod lift;
mod support;

use support::aimed::{aimed_ts, aimed_us};
use support::cases::shutter;
use support::curves::{Rng, hard_openness, hard_times, is_valid};
use support::oracle::lift::{Lifted, range};
use support::oracle::{Curve, Dd, Exact, Points, exp2};
use support::promise::{BACKWARD, CDF_FLOOR, Figures, VALUE};

const SEED: u64 = 29;

/// Times from 0 to about 1, and openness.
type Ramp = ([f64; 4], [f64; 4]);

type Family = (&'static str, fn(&mut Rng) -> Ramp);

const FAMILIES: [Family; 10] = [
    ("t' dips inside", |rng| {
        let (root, below) = (root(rng), depth(rng));
        (sums(square(root).map(|d| d - below)), openness(rng, root))
    }),
    ("t' starts below 0", |rng| {
        let d0 = -depth(rng);
        let d1 = rng.between(1.0 / 3.0, 1.2);
        (sums([d0, d1, 1.0 - d0 - d1]), openness(rng, 0.0))
    }),
    ("t' ends below 0", |rng| {
        let d2 = -depth(rng);
        let d1 = rng.between(1.0 / 3.0, 1.2);
        (sums([1.0 - d2 - d1, d1, d2]), openness(rng, 1.0))
    }),
    ("t' starts at 0 and dips", |rng| {
        let d1 = -rng.power_of_ten(-12.0, -4.3);
        (sums([0.0, d1, 1.0 - d1]), openness(rng, -d1))
    }),
    ("t' ends at 0 and dips before", |rng| {
        let d1 = -rng.power_of_ten(-12.0, -4.3);
        (sums([1.0 - d1, d1, 0.0]), openness(rng, 1.0 + d1))
    }),
    ("t' starts next to 0 and dips", |rng| {
        let d0 = rng.power_of_ten(-14.0, -4.0);
        let d1 = -(d0 + depth(rng)).sqrt();
        (sums([d0, d1, 1.0 - d0 - d1]), openness(rng, -d1))
    }),
    ("f dips inside", |rng| {
        let (root, below) = (root(rng), 3.0 * depth(rng));
        (hard_times(rng), touching(rng, root, below))
    }),
    ("f starts or ends below 0", |rng| {
        let f = hard_openness(rng);
        let most = f.iter().fold(0.0, |most: f64, f| most.max(*f));
        let below = -depth(rng) * 3.0 * most;
        (
            hard_times(rng),
            if rng.chance(0.5) { [below, f[1], f[2], f[3]] } else { [f[0], f[1], f[2], below] },
        )
    }),
    ("f starts at 0 or next to it, and dips", |rng| {
        let f0 = if rng.chance(0.5) { 0.0 } else { rng.power_of_ten(-14.0, -5.0) };
        let f2 = rng.between(0.05, 1.0);
        let f1 = -(f2 * (f0 + depth(rng) * 3.0) * 0.75).sqrt();
        (hard_times(rng), [f0, f1, f2, rng.between(0.0, 1.0)])
    }),
    ("f and t' dip together", |rng| {
        let (root, below) = (root(rng), depth(rng));
        let below_too = 3.0 * depth(rng);
        (sums(square(root).map(|d| d - below)), touching(rng, root, below_too))
    }),
];

/// The square of `p - root`, as three Bernstein coefficients that add up to 1.
fn square(root: f64) -> [f64; 3] {
    let rest = 1.0 - root;
    let q = [root * root, -root * rest, rest * rest];
    q.map(|d| d / q.iter().sum::<f64>())
}

fn root(rng: &mut Rng) -> f64 {
    let near = rng.power_of_ten(-11.0, 0.0);
    [rng.unit(), near, 1.0 - near][rng.below(3) as usize]
}

/// A third of what is forgiven, or less; often as much as can be.
fn depth(rng: &mut Rng) -> f64 {
    if rng.chance(0.3) { exp2(-22) / 3.0 * rng.between(0.9, 0.999) } else { rng.graze() / 3.0 }
}

fn sums([d0, d1, d2]: [f64; 3]) -> [f64; 4] {
    let sum = d0 + d1 + d2;
    [0.0, d0 / sum, (d0 + d1) / sum, 1.0]
}

/// Openness that touches 0 where time nearly stands still, or any.
fn openness(rng: &mut Rng, at: f64) -> [f64; 4] {
    if rng.chance(0.3) { touching(rng, at, 0.0) } else { hard_openness(rng) }
}

/// A square with this root times a linear function, and less by a share of its greatest value.
fn touching(rng: &mut Rng, root: f64, below: f64) -> [f64; 4] {
    let rest = 1.0 - root;
    let q = [root * root, -root * rest, rest * rest];
    let [c, d] = [[1.0, 1.0], [rng.unit(), 1.0], [1.0, rng.unit()]][rng.below(3) as usize];
    let f =
        [q[0] * c, (2.0 * q[1] * c + q[0] * d) / 3.0, (q[2] * c + 2.0 * q[1] * d) / 3.0, q[2] * d];
    let most = range(f)[1];
    f.map(|f| f / most - below)
}

fn is_lifted(ramp: &Points) -> bool {
    Lifted::new(*ramp).is_lifted
}

fn back(points: Points) -> Points {
    let [a, b, c, d] = points.map(|(t, f)| (-t, f));
    [d, c, b, a]
}

/// Curve `index` of a family: its ramp opens, or closes, or both.
fn drawn(family: usize, index: u64) -> Curve {
    let mut rng = Rng::new(SEED ^ (family as u64) << 40, index);
    loop {
        let (times, f) = FAMILIES[family].1(&mut rng);
        let scale = if rng.chance(0.5) { 1.0 } else { exp2(rng.below(121) as i32 - 61) };
        let scale = if rng.chance(0.3) { scale * rng.between(0.5, 1.0) } else { scale };
        let start = [0.0, 0.0, 0.0, 0.0, -1.0, 1.0, rng.unit()][rng.below(7) as usize];
        let ramp: Points =
            std::array::from_fn(|i| ((scale * (start + times[i])) as f32, f[i] as f32));
        let end = ramp[3].0;
        let plateau = [0.0, 0.0, 1.0, 1e-7][rng.below(4) as usize] * scale;
        let close = (f64::from(end) + plateau) as f32;
        let twice =
            ramp.map(|(t, f)| ((f64::from(t) - f64::from(ramp[0].0) + f64::from(close)) as f32, f));
        let curve = match rng.below(3) {
            0 => Curve::shutter(ramp, [(close, 1.0); 4]),
            1 => Curve::shutter(ramp, twice),
            _ => Curve::shutter(back([(close, 1.0); 4]), back(ramp)),
        };
        if is_valid(&curve) && [curve.opening, curve.closing].iter().any(is_lifted) {
            return if rng.chance(0.3) { curve.mirrored() } else { curve };
        }
    }
}

fn keeps_every_promise(family: usize) {
    const CURVES: u64 = 600;
    let mut figures = Figures::default();
    for index in 0..CURVES {
        figures.judge(&drawn(family, index), &mut Rng::new(SEED, index));
    }
    println!("{}: {figures}", FAMILIES[family].0);
    assert!(figures.samples > 400 * CURVES, "only {} samples", figures.samples);
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
}

/// A test for each family, so that they run side by side.
macro_rules! families {
    ($($name:ident: $family:expr,)*) => {
        $(#[test]
        fn $name() {
            keeps_every_promise($family);
        })*

        #[test]
        fn none_is_left_out() {
            assert!([$($family),*].into_iter().eq(0..FAMILIES.len()));
        }
    };
}

families! {
    time_dips_inside: 0,
    time_starts_back: 1,
    time_ends_back: 2,
    time_starts_still_and_dips: 3,
    time_ends_still_and_dips_before: 4,
    time_starts_nearly_still_and_dips: 5,
    openness_dips_inside: 6,
    openness_starts_or_ends_below_0: 7,
    openness_starts_at_0_and_dips: 8,
    both_dip_together: 9,
}

/// De Casteljau's halves.
fn halves<const N: usize>(mut b: [Dd; N]) -> [[Dd; N]; 2] {
    let (mut left, mut right) = (b, b);
    for i in 0..N {
        (left[i], right[N - 1 - i]) = (b[0], b[N - 1 - i]);
        for k in 0..N - 1 - i {
            b[k] = (b[k] + b[k + 1]).scale(0.5);
        }
    }
    [left, right]
}

/// Is a polynomial in the Bernstein basis nowhere below 0 on [0, 1]? Double-doubles lose less than any trace here has.
fn is_nowhere_negative<const N: usize>(b: [Dd; N], depth: u32) -> bool {
    if b.iter().all(|b| *b >= Dd::ZERO) {
        return true;
    }
    if depth == 0 || b[0] < Dd::ZERO || b[N - 1] < Dd::ZERO {
        return false;
    }
    halves(b).into_iter().all(|half| is_nowhere_negative(half, depth - 1))
}

fn blend<const N: usize>(mut b: [Dd; N], p: f64) -> Dd {
    for i in 1..N {
        for k in 0..N - i {
            b[k] = b[k] + (b[k + 1] - b[k]) * p;
        }
    }
    b[0]
}

/// Lifted, a ramp has t' and f nowhere below 0; it is as the oracle has it, and the same from either end; and no more has
/// moved than is proven in `proofs/lifting.py`.
#[test]
fn lifting_moves_as_little_as_it_can() {
    let (mut times, mut opennesses, mut moved) = (0u32, 0u32, [0f64; 2]);
    for family in 0..FAMILIES.len() {
        for index in 0..2000 {
            let curve = drawn(family, index);
            for points in [curve.opening, curve.closing] {
                let (given, lifted) = (Lifted::as_given(points), Lifted::new(points));
                let length = f64::from(points[3].0) - f64::from(points[0].0);
                if length == 0.0 {
                    continue;
                }
                let at = |name: &str| format!("{name}: {points:?}");

                let t = points.map(|p| f64::from(p.0));
                let differences = cubic::differences(t);
                let steps = lift::forward(differences, length);
                assert!(
                    steps.iter().zip(lifted.steps).all(|(ours, exact)| {
                        (Dd::from(*ours) - exact).hi.abs() <= exp2(-50) * exact.hi.abs()
                    }),
                    "{} {steps:?} {lifted:?}",
                    at("t'")
                );
                let [d2, d1, d0] =
                    lift::forward([differences[2], differences[1], differences[0]], length);
                assert_eq!(
                    steps.map(f64::to_bits),
                    [d0, d1, d2].map(f64::to_bits),
                    "{}",
                    at("t' mirrored")
                );
                if steps != differences {
                    times += 1;
                    assert!(is_nowhere_negative(steps.map(Dd::from), 150), "{}", at("t' below 0"));
                    assert!(
                        is_nowhere_negative(lifted.steps, 150),
                        "{}",
                        at("the oracle's t' below 0")
                    );
                }

                let f = points.map(|p| p.1 + 0.0);
                let ours = lift::lifted(f);
                assert_eq!(ours, lifted.openness, "{}", at("f"));
                let [d, c, b, a] = lift::lifted([f[3], f[2], f[1], f[0]]);
                assert_eq!(ours, [a, b, c, d], "{}", at("f mirrored"));
                let [_, most] = range(f.map(f64::from));
                if ours != f {
                    opennesses += 1;
                    assert!(is_nowhere_negative(ours.map(Dd::from), 150), "{}", at("f below 0"));
                    let end = f[0].max(f[3]);
                    let stays = ours[0].max(ours[3]) == end || 2.0 * f64::from(end) < most;
                    assert!(stays, "{}", at("the greater end"));
                }

                for i in 1..200 {
                    let p = f64::from(i) / 200.0;
                    let time =
                        |[d0, d1, d2]: [Dd; 3]| blend([Dd::ZERO, d0, d0 + d1, d0 + d1 + d2], p);
                    let by = (time(lifted.steps) - time(given.steps)).hi.abs() / length;
                    moved[0] = moved[0].max(by * exp2(22));
                    let value = |f: [f32; 4]| blend(f.map(Dd::from), p);
                    let by = ((value(ours) - value(f)).hi.abs() - exp2(-149)) / most;
                    moved[1] = moved[1].max(by * exp2(22));
                }
            }
        }
    }
    let [t, f] = moved;
    println!(
        "lifted: {times} times t', {opennesses} times f; moved by {t:.4} and {f:.4} times 2^-22"
    );
    assert!(times > 8000 && opennesses > 8000);
    assert!(t <= 0.469 && f <= 1.87, "{t} {f}");
    assert!(t > 0.46 && f > 1.0, "the families are not aimed well: {t} {f}");
}

/// A time of a few subnormal steps, or of any number of them up to the least normal numbers; of either sign.
fn tiny(rng: &mut Rng) -> f32 {
    let most = [4, 100, 1 << 24][rng.below(3) as usize];
    let t = f32::from_bits(rng.below(most) as u32);
    if rng.chance(0.5) { t } else { -t }
}

/// A ramp or a plateau, or both, between subnormal times, next to another ramp that is long.
fn subnormal(index: u64) -> Curve {
    let mut rng = Rng::new(SEED, index);
    loop {
        let mut times = [0; 4].map(|_| tiny(&mut rng));
        times.sort_by(f32::total_cmp);
        let openness = |rng: &mut Rng| {
            let f = hard_openness(rng);
            let dim = [1.0, 1.0, 0.0, exp2(-149), exp2(-(rng.below(140) as i32))];
            let dim = dim[rng.below(5) as usize];
            f.map(|f| (f * dim) as f32)
        };
        let length = exp2(rng.below(128) as i32 - 63);
        let long = hard_times(&mut rng).map(|t| t * length);
        let f = openness(&mut rng);
        let points = |t: [f32; 4], f: [f32; 4]| std::array::from_fn(|i| (t[i], f[i]));
        let short = match rng.below(3) {
            0 => points([times[0]; 4], openness(&mut rng)),
            1 => points([times[0], times[1], times[1], times[2]], openness(&mut rng)),
            _ => points([times[0], times[1], times[2], times[2]], openness(&mut rng)),
        };
        let close = if rng.chance(0.3) { times[2] } else { times[3] };
        let short = short.map(|(t, f)| (t.min(close), f));
        let closing = if rng.chance(0.2) {
            [(length as f32, 1.0); 4]
        } else {
            points(long.map(|t| (f64::from(close) + t) as f32), f)
        };
        let curve = Curve::shutter(short, closing);
        if is_valid(&curve) {
            return if rng.chance(0.4) { curve.mirrored() } else { curve };
        }
    }
}

/// So many steps from `t` on.
fn onwards(t: f32, steps: u32) -> impl Iterator<Item = f32> {
    std::iter::successors(Some(t), |t| Some(t.next_up())).take(steps as usize)
}

#[test]
fn subnormal_times_keep_every_promise() {
    let mut figures = Figures::default();
    for index in 0..1500 {
        figures.judge(&subnormal(index), &mut Rng::new(SEED, index));
    }
    println!("subnormal times: {figures}");
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
}

/// From each subnormal time to the next the cdf steps forward, and is right even where it is far below what is promised:
/// without a least ulp. And so is the inverse of each value.
#[test]
fn neighbouring_subnormal_times_are_in_order() {
    let (mut worst, mut plateaus) = (0f64, 0u32);
    for index in 0..3000 {
        let curve = subnormal(index);
        let (exact, ours) = (Exact::new(&curve), shutter::<4>(&curve));
        let joins = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
        let near_zero = joins.into_iter().filter(|t| t.abs() < 1e-30);
        plateaus += u32::from(joins[1] < joins[2] && joins[2].abs() < 1e-30);
        let mut us = Vec::new();
        for join in near_zero {
            let first = onwards(-join, 12).last().map_or(join, |t| -t);
            let mut last = 0.0;
            for t in onwards(first, 24) {
                let [cdf, opening, pdf] = [ours.cdf(t), ours.openness(t), ours.pdf(t)];
                assert!(cdf >= last, "{cdf:e} after {last:e} at {t:e}: {curve:?}");
                let floor = if joins[0] == 0.0 { 0.0 } else { CDF_FLOOR };
                let near = exact.near(t);
                let error = near.cdf_ulp(cdf, floor);
                let [open, dense] = [near.openness_ulp(opening), near.pdf_ulp(pdf)];
                worst = worst.max(error).max(open).max(dense);
                assert!(
                    error.max(open).max(dense) <= VALUE,
                    "{error} {open} {dense} at {t:e}: {curve:?}"
                );
                last = cdf;
                us.push(cdf);
            }
        }
        us.extend(aimed_us(&exact, &mut Rng::new(SEED, index)));
        us.sort_by(f32::total_cmp);
        let mut last = f32::NEG_INFINITY;
        for u in us {
            let t = ours.inverse_cdf(u);
            let errors = exact.judge(u, t);
            assert!(
                t >= last && errors.backward <= BACKWARD,
                "{t:e} at {u:e}, {errors:?}: {curve:?}"
            );
            last = t;
        }
    }
    println!("subnormal neighbours: {worst:.3} ulp at most; {plateaus} plateaus end next to 0");
    assert!(plateaus > 500);
}

/// Openness of which some or all control values are subnormal, over as long a time as makes up for it.
#[test]
fn subnormal_openness_keeps_every_promise() {
    let (mut curves, mut lifted) = (0u32, 0u32);
    let mut worst = [0f64; 3];
    for index in 0..6000 {
        let mut rng = Rng::new(SEED, index);
        let family = rng.below(FAMILIES.len() as u64) as usize;
        let (times, f) = FAMILIES[family].1(&mut rng);
        let (long, faint) = (exp2(rng.below(64) as i32), exp2(-(118 + rng.below(31) as i32)));
        let points = std::array::from_fn(|i| ((times[i] * long) as f32, (f[i] * faint) as f32));
        let curve = Curve::single(points);
        if !is_valid(&curve) {
            continue;
        }
        let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
        let mut last = f32::NEG_INFINITY;
        for u in aimed_us(&exact, &mut rng) {
            let t = ours.inverse_cdf(u);
            let errors = exact.judge(u, t);
            assert!(
                t >= last && errors.backward <= BACKWARD,
                "{t:e} at {u:e}, {errors:?}: {curve:?}"
            );
            (last, worst[0]) = (t, worst[0].max(errors.backward));
        }
        let mut last = 0.0;
        for t in aimed_ts(&exact, &mut rng) {
            let [cdf, pdf] = [ours.cdf(t), ours.pdf(t)];
            let near = exact.near(t);
            let errors = [near.cdf_ulp(cdf, CDF_FLOOR), near.pdf_ulp(pdf)];
            assert!(
                cdf >= last && errors.iter().all(|e| *e <= VALUE),
                "{errors:?} at {t:e}: {curve:?}"
            );
            (last, worst[1], worst[2]) = (cdf, worst[1].max(errors[0]), worst[2].max(errors[1]));
        }
        (curves, lifted) = (curves + 1, lifted + u32::from(exact.is_lifted()));
    }
    println!(
        "subnormal openness: {worst:.3?} ulp of u, of the cdf and of the density; {lifted} of {curves} curves lifted"
    );
    assert!(curves > 2000 && lifted > 300);
}
