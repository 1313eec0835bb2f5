//! Every promise of a curve, on every family of curves: named ones, random ones, ones that aim at a difficulty, ones as
//! people draw them, and those on which a version failed.
//!
//! `cargo test --test curve promises:: -- --nocapture` prints the worst of each family. `TIMES=8` before it tries eight
//! times as many random curves, the first of which are the same.

use crate::support::aimed::{FAMILIES, aimed};
use crate::support::cases::{CASES, shutter};
use crate::support::curves::{
    Kind, LEAST_EXPOSURE, LEAST_INTERVAL, LEAST_SECTION, MOST_CROSSED, Rng, accepted, hard_openness, hard_times,
    hard_us, instant, line, named, neighbours, placed, random_density, random_hard, random_typical, settled, shape,
};
use crate::support::designs::DESIGNS;
use crate::support::oracle::{Curve, Dd, Exact, Points, exp2};
use crate::support::promise::{
    BACKWARD, BACKWARD_FLOOR, CDF_FLOOR, CDF_STEP_BACK, DENSITY_FLOOR, FORWARD, FORWARD_MEAN, Figures, Questions,
    Reach, SCALAR, TICK, TYPICAL_TICK, VALUE,
};
use crate::support::times;
use shutter_curve::MAX_EVALUATIONS;

const SEED: u64 = 13;
/// What is asked of curves that are few.
const ALL: Reach = Reach { denominator: 64, frame: 40, turn: 0, is_typical: false };

/// Prints what was seen. No promise may be broken.
fn report(name: &str, figures: &Figures) {
    println!("{name}: {figures}");
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
}

/// What is held here is what the pages promise.
#[test]
fn the_pages_have_these_numbers() {
    let [accuracy, readme] = [include_str!("../../docs/accuracy.md"), include_str!("../../README.md")];
    let forward = format!("{FORWARD} ulp, mean {FORWARD_MEAN} ");
    for (page, row, promise) in [
        (accuracy, "`inverse_cdf`, backward", format!("{BACKWARD:?} ulp ")),
        (accuracy, "`inverse_cdf`, forward", forward),
        (accuracy, "`cdf`", format!("{VALUE} ulp ")),
        (accuracy, "`openness` and `pdf`", format!("{VALUE} ulp ")),
        (accuracy, "`exposure`", format!("{SCALAR} ulp ")),
        (accuracy, "steps of a search", format!("at most {MAX_EVALUATIONS} ")),
        (accuracy, "`cdf` as `t` grows", format!("falls by at most {CDF_STEP_BACK} ulp ")),
        (accuracy, "a tick, typical", format!("{TYPICAL_TICK} tick ")),
        (accuracy, "a tick, every", format!("{TICK} tick ")),
        (accuracy, "a pulse's `on`", format!("{TICK} tick ")),
        (readme, "`inverse_cdf`, backward", format!("{BACKWARD:?} ulp ")),
        (readme, "`inverse_cdf`, forward", format!("{FORWARD} ulp ")),
        (readme, "`trigger_ticks`", format!("{TYPICAL_TICK} tick ")),
    ] {
        let (_, told) = page.split_once(&format!("\n| {row}")).unwrap_or_else(|| panic!("no {row}"));
        assert!(told.split(" | ").nth(1).is_some_and(|it| format!("{it} ").starts_with(&promise)), "{row}: {promise}");
    }
    let floors = [BACKWARD * BACKWARD_FLOOR, CDF_FLOOR, DENSITY_FLOOR].map(f64::log2);
    assert_eq!(floors, [-46.0, -24.0, -57.0]);
    assert!(["at most 2⁻⁴⁶", "2⁻²⁴, for", "below 2⁻⁵⁷"].iter().all(|told| accuracy.contains(told)));
}

/// With every number of octaves, or with some in turn.
fn ask(figures: &mut Figures, curve: &Curve, all_octaves: bool, reach: Reach) {
    let exact = Exact::new(curve);
    let questions = Questions::plain(&exact, reach);
    figures.ask(&exact, &questions);
    type Asked = fn(&mut Figures, &Exact, &Questions);
    let others: [Asked; 7] = [
        Figures::asked::<1>,
        Figures::asked::<2>,
        Figures::asked::<3>,
        Figures::asked::<4>,
        Figures::asked::<16>,
        Figures::asked::<32>,
        Figures::asked::<64>,
    ];
    for (i, asked) in others.into_iter().enumerate() {
        if all_octaves || reach.turn % others.len() == i {
            asked(figures, &exact, &questions);
        }
    }
}

/// Is a design as [`random_typical`](crate::support::curves::random_typical) draws them? On these the forward error is
/// promised.
fn is_typical(curve: &Curve) -> bool {
    let is_gentle = |ramp: Points| {
        let length = ramp[3].0 - ramp[0].0;
        let [t1, t2] = [1, 2].map(|i| (ramp[i].0 - ramp[0].0) / length);
        let f = ramp.map(|(_, f)| f);
        let is_first = (0.149..=0.501).contains(&t1) && (0.499..=0.851).contains(&t2);
        length == 0.0 || is_first && f.is_sorted() && f[0] == 0.0 && f[3] == 1.0
    };
    let [start, end] = [curve.open_start(), curve.close_end()];
    let ramps = (curve.open_end() - start) + (end - curve.close_start());
    start >= -0.5 * (end - start)
        && start <= 0.25 * (end - start)
        && (ramps == 0.0 || ramps >= 0.1 * (end - start))
        && is_gentle(curve.opening)
        && is_gentle(curve.mirrored().opening)
}

/// `n` evenly spread `u`, and as many towards both ends.
fn spread(n: u32) -> Vec<f32> {
    let mut rng = Rng::new(7, n as u64);
    let spread = (0..n).flat_map(|i| {
        let u = (i as f64 + rng.unit()) / n as f64;
        let tail = 2f64.powf(-30.0 * rng.unit());
        [u as f32, tail as f32, (1.0 - tail) as f32]
    });
    spread.collect()
}

#[test]
fn named_typical_curves() {
    let (mut figures, mut means, mut curves) = (Figures::default(), 0.0, 0);
    for (turn, one) in named().iter().filter(|one| one.kind == Kind::Typical).enumerate() {
        ask(&mut figures, &one.curve, true, Reach { turn, is_typical: true, ..ALL });
        let exact = Exact::new(&one.curve);
        let us = spread(20_000).into_iter().chain(hard_us(&exact, 1, 1000)).collect();
        let questions = Questions::fractions(&exact, us, true);
        let mut spread = Figures::default();
        spread.asked::<8>(&exact, &questions);
        spread.asked::<0>(&exact, &questions);
        assert!(spread.breaches.is_empty(), "{:#?}", spread.breaches);
        means += spread.forward_sum / spread.forward_samples as f64;
        curves += 1;
    }
    let mean = means / f64::from(curves);
    println!("mean forward error {mean:.3} ulp");
    assert!(curves == 15 && mean <= FORWARD_MEAN);
    report("named typical", &figures);
}

#[test]
fn named_hard_curves_and_cases() {
    let mut figures = Figures::default();
    let hard = named().into_iter().filter(|one| one.kind == Kind::Hard).map(|one| one.curve);
    for (turn, curve) in hard.chain(CASES.iter().map(|case| case.curve())).enumerate() {
        ask(&mut figures, &curve, true, Reach { turn, ..ALL });
        let exact = Exact::new(&curve);
        let questions = Questions::fractions(&exact, hard_us(&exact, 3, 2000), false);
        figures.asked::<8>(&exact, &questions);
        figures.asked::<0>(&exact, &questions);
    }
    report("named hard", &figures);
}

/// Fresh curves, which nothing was tuned on.
fn fresh(name: &str, curves: u64, draw: fn(u64, u64) -> Curve) {
    let mut figures = Figures::default();
    for i in 0..curves * times() {
        figures.judge(&draw(2026, i), &mut Rng::new(11, i));
    }
    report(name, &figures);
}

#[test]
fn random_typical_curves() {
    let mut figures = Figures::default();
    for i in 0..150 * times() {
        let exact = Exact::new(&random_typical(2, i));
        let questions = Questions::fractions(&exact, spread(300), true);
        figures.asked::<8>(&exact, &questions);
        figures.asked::<0>(&exact, &questions);
    }
    report("random typical, spread", &figures);
    fresh("random typical", 150, random_typical);
}

#[test]
fn random_hard_curves() {
    fresh("random hard", 1200, random_hard);
}

#[test]
fn random_densities() {
    fresh("random densities", 500, random_density);
}

fn judge_aimed(family: usize) {
    let mut figures = Figures::default();
    for index in 0..600 * times() {
        figures.judge(&aimed(family, SEED, index), &mut Rng::new(SEED, index));
    }
    report(FAMILIES[family].0, &figures);
}

fn judge_designs(family: usize) {
    let (mut figures, family) = (Figures::default(), &DESIGNS[family]);
    for index in 0..family.designs * times() {
        let curve = family.design(index);
        let reach = Reach { turn: index as usize, is_typical: is_typical(&curve), ..family.reach };
        ask(&mut figures, &curve, family.all_octaves, reach);
    }
    report(family.name, &figures);
}

/// A test for each family, so that they run side by side.
macro_rules! families {
    ($none_is_left_out:ident, $judge:ident, $all:expr; $($name:ident: $family:expr,)*) => {
        $(#[test]
        fn $name() {
            $judge($family);
        })*

        #[test]
        fn $none_is_left_out() {
            assert!([$($family),*].into_iter().eq(0..$all.len()));
        }
    };
}

families! {
    no_aimed_family_is_left_out, judge_aimed, FAMILIES;
    aimed_handles_cross: 0,
    aimed_high_order: 1,
    aimed_dark_inside: 2,
    aimed_joins_next_to_plain_fractions: 3,
    aimed_least_sections: 4,
    aimed_least_shares: 5,
    aimed_least_intervals: 6,
    aimed_densities: 7,
    aimed_anything_hard: 8,
}

families! {
    no_design_is_left_out, judge_designs, DESIGNS;
    designs_whole_ms: 0,
    designs_ms_in_s: 1,
    designs_decimal_fractions: 2,
    designs_joins_at_powers_of_two: 3,
    designs_joins_at_thirds_fifths_tenths: 4,
    designs_handles_to_the_end: 5,
    designs_other_units_and_levels: 6,
    designs_joins_next_to_time_0: 7,
}

/// Ramps of which an octave just takes a place: where handles cross, or where it is dark, a trace more and a search
/// would answer there. So errors are as great as polynomials may have them, anywhere in the octave.
#[test]
fn octaves_at_their_limit() {
    let (mut figures, mut direct) = (Figures::default(), 0);
    for index in 0..600 * times() {
        let rng = &mut Rng::new(SEED, index);
        let [at, a, b] = [0; 3].map(|_| rng.unit());
        let (flat, rest) = (hard_openness(rng), [0.0, 1.0, 30.0, 1000.0][rng.below(4) as usize] as f32);
        let t = hard_times(rng);
        let with = |dial: f64| {
            let first = dial * MOST_CROSSED + at * (1.0 - dial * MOST_CROSSED);
            let ramp = match index % 3 {
                0 => shape([0.0, first, first - dial * MOST_CROSSED, 1.0], flat),
                1 => shape(t, [1e-12f64.powf(dial), 0.0, a * 1e-6f64.powf(dial), 1.0]),
                _ => shape([0.0, a * (1.0 - dial), b * (1.0 - dial), 1.0], flat),
            };
            settled(Curve::shutter(placed(ramp, false, 0.0, 1.0), instant(1.0 + rest)))
        };
        // The middle of the ramp's parameter.
        let place = |curve: &Curve| Exact::new(curve).middle().to_f32();
        let is_direct = |dial: f64| shutter::<8>(&with(dial)).evaluations(place(&with(dial))).is_none();
        let (mut low, mut high) = (0.0, 1.0);
        if !is_direct(low) || is_direct(high) {
            continue;
        }
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            *(if is_direct(middle) { &mut low } else { &mut high }) = middle;
        }
        direct += 1;
        for curve in [with(low), with(low).mirrored()] {
            let exact = Exact::new(&accepted(curve));
            let u = f64::from(place(&with(low)));
            let us = (0..600).map(|i| u * exp2(-1) * (1.0 + f64::from(i) / 200.0));
            let us = us.map(|u| if curve == with(low) { u } else { 1.0 - u } as f32);
            figures.asked::<8>(&exact, &Questions::fractions(&exact, us.collect(), false));
        }
    }
    println!("{direct} dials");
    assert!(direct >= 75, "only {direct}");
    report("octaves at their limit", &figures);
}

/// Curves on which a version failed, or that an attack had in the source's rules, as far as they are accepted.
#[test]
fn faults() {
    let mut figures = Figures::default();
    let quick = Reach { denominator: 16, frame: 16, ..ALL };
    let smooth = |start: f32, end: f32, [from, to]: [f32; 2]| {
        let handle = (end - start) / 4.0;
        [(start, from), (start + handle, from), (end - handle, to), (end, to)]
    };
    let mut curves = Vec::new();
    for [open, close] in [[0.0, -0.0], [-0.0, 0.0], [-0.0, -0.0], [0.0, 0.0]] {
        curves.push(Curve::shutter(instant(open), line((close, 1.0), (1.0, 0.0))));
    }
    let opening = [(-0.25, 0.0), (-0.16, 0.0), (-0.09, 1.0), (0.0, 1.0)];
    let closing = [(0.0, 1.0), (0.095, 1.0), (0.155, 0.0), (0.25, 0.0)];
    for scale in [1.0, 4e7, exp2(65) as f32] {
        curves.push(Curve::shutter(opening, closing).scaled(scale));
    }
    // Time stands nearly still at time 0.
    curves.push(Curve::shutter(
        [(-1.0, 0.0), (0.875, 0.0), (-1.0, 1.0), (1.0, 1.0)],
        [(1.0, 1.0), (1.25, 1.0), (1.5, 0.0), (2.0, 0.0)],
    ));
    // Many lengths from time 0.
    curves.push(Curve::shutter(
        [(16.0, 0.23115787), (16.069315, 0.9636907), (16.188118, 0.94166076), (16.204382, 1.0)],
        [(16.204382, 1.0), (16.933697, 0.4028296), (16.949995, 0.9828322), (17.0, 0.09975028)],
    ));
    // A closing ramp to time 0, of 2⁻²⁵ of the exposure: its cdf stepped back where its mass was not normalised.
    let closing = [(-1.22e-7, 1.0), (-1.525e-8, 0.0), (-1.0675e-7, 0.0), (0.0, 1.0)];
    curves.push(Curve::shutter(instant(-1.338), closing));
    // Subnormal times.
    let closing = [(2.6020853e-19, 1.0), (4.3368087e-19, 0.7), (6.938894e-19, 0.3), (8.6736174e-19, 0.0)];
    curves.push(Curve::shutter(instant(-1.1912527e-38), closing));
    let opening = [(-6e-20, 0.0), (-4.6e-44, 0.24176656), (-4.6e-44, 0.6375081), (-1e-45, 1.0)];
    curves.push(Curve::shutter(opening, instant(1e-20)));
    // The join at half of the light, and a plateau across time 0, each as short as it may be.
    let [least, unit] = [exp2(-24) as f32, exp2(-26) as f32];
    let half = line((-unit, 1.0), (least - unit, 0.0));
    curves.push(Curve::shutter(line((-1.0, 0.0), (-unit, 1.0)), half));
    let plateau = [-1.75 * unit, 0.75 * unit];
    curves.push(Curve::shutter(line((-0.5, 0.0), (plateau[0], 1.0)), line((plateau[1], 1.0), (0.5, 0.0))));
    // The line, counted from either end.
    for [open, close] in [[0.001, 0.9995], [0.3, 0.999], [0.0, 1.0], [0.002, 0.6]] {
        let [opening, closing] = [line((0.0, 0.0), (open, 1.0)), line((close, 1.0), (1.0, 0.0))];
        curves.push(Curve::shutter(opening, closing));
    }
    // 1/2 to 1/1024 of the light, and some 2⁻²⁵ of that more: between the top of an octave and the join.
    for k in 1..=10 {
        let mut opening = smooth(-2.0, 0.0, [0.0, 1.0]);
        opening[0].1 = exp2(-24) as f32;
        curves.push(Curve::shutter(opening, smooth(0.0, 2.0 * exp2(k) as f32 - 2.0, [1.0, 0.0])));
    }
    for (turn, curve) in curves.into_iter().enumerate() {
        for curve in [curve, curve.mirrored()] {
            ask(&mut figures, &accepted(curve), turn < 16, Reach { turn, ..quick });
        }
    }
    // Boxes in which the middle of two fractions is where the time since the start gains a last bit.
    for (start, end) in [(-1.3730043, 2.5725152), (-1.7764826, 0.6210457), (-1.8631686, 2.4521976)] {
        let ours = shutter::<8>(&Curve::shutter(instant(start), instant(end)));
        let first = (exp2(-24) as f32).to_bits() - 200;
        let values: Vec<f32> = (first..first + 400).map(|t| ours.cdf(f32::from_bits(t))).collect();
        assert!(values.is_sorted(), "from {start} to {end}");
    }
    // Parts of frames: hardly any light precedes a closing ramp; the last of 2³¹ ticks; a first pulse next to the
    // start.
    let third = 1.0 / 3.0;
    let late = Curve::shutter(
        [(0.0, 0.0), (3e-5, 0.3), (6e-5, 0.6), (1e-4, 1.0)],
        [(1e-4, 1.0), (0.33, 0.0), (0.66, 0.0), (1.0, 0.0)],
    );
    let last = Curve::shutter([(-1.0, 0.0), (-1.0, 1.472065e-5), (-1.0, 1.768388e-5), (0.0, 1.0)], instant(0.16237123));
    let first = Curve::shutter([(0.0, 0.0), (third, 0.0), (2.0 * third, 0.0), (1.0, 1.0)], instant(1.0));
    let all = 1 << 22;
    for (curve, n, duty, at, count, hz) in [
        (late, all / 4, None, all / 4 - 2000, 2000, 1 << 31),
        (late, all, None, all - 2000, 2000, 1 << 31),
        (late, all, None, all - 2000, 2000, 1 << 24),
        (last, all, None, all - 30, 30, 1_847_502_402),
        (first, all - 1, Some(1.0 - f32::EPSILON / 2.0), 0, 1, 2_147_483_448),
        (first, 1_000_007, Some(1.0 - f32::EPSILON), 0, 1, 2_147_483_448),
    ] {
        let exact = Exact::new(&curve);
        figures.asked::<8>(&exact, &Questions::frame(&exact, n, duty, at, count, hz));
    }
    // The most typical curves that there are, and more than 0.6 ulp wrong.
    let ramp = smooth(0.0, 10.0, [0.0, 1.0]);
    for (curve, u) in [
        (Curve::shutter(ramp, smooth(10.0, 20.0, [1.0, 0.0])), 10.0 / 39.0),
        (Curve::shutter(instant(0.0), line((1.0, 1.0), (19.0, 0.0))), 0.5),
    ] {
        let exact = Exact::new(&curve);
        let us = neighbours(u, 20_000).collect();
        figures.asked::<8>(&exact, &Questions::fractions(&exact, us, true));
    }
    report("faults", &figures);
}

/// What curves may be like.
type Feature = (&'static str, fn(&Curve, &Exact) -> bool, u32);

/// Of so many curves at least so many have each feature; and they are the same every time.
fn have(features: &[Feature], count: u64, draw: impl Fn(u64) -> Curve) {
    let mut seen = vec![0; features.len()];
    for index in 0..count {
        let curve = draw(index);
        assert_eq!(curve, draw(index));
        let exact = Exact::new(&curve);
        for ((_, has, _), seen) in features.iter().zip(&mut seen) {
            *seen += u32::from(has(&curve, &exact));
        }
    }
    for ((name, _, least), seen) in features.iter().zip(seen) {
        println!("{seen:5} of {count}: {name}");
        assert!(seen >= *least, "{name}: only {seen}");
    }
}

fn span(from: f32, to: f32) -> f64 {
    f64::from(to) - f64::from(from)
}

fn whole(c: &Curve) -> f64 {
    span(c.open_start(), c.close_end())
}

/// The sections' lengths.
fn sections(c: &Curve) -> [f64; 3] {
    let [start, open] = [c.open_start(), c.open_end()];
    let [close, end] = [c.close_start(), c.close_end()];
    [span(start, open), span(open, close), span(close, end)]
}

fn greatest(c: &Curve) -> f64 {
    f64::from(c.open_start().abs().max(c.close_end().abs()))
}

/// By how much the first inner time of the opening ramp passes the second.
fn crossed(c: &Curve) -> f64 {
    span(c.opening[2].0, c.opening[1].0)
}

fn is_across(c: &Curve) -> bool {
    c.open_start() < 0.0 && c.close_end() > 0.0
}

#[test]
fn random_hard_curves_are_as_nasty_as_meant() {
    let features: [Feature; 15] = [
        ("zero-length opening", |c, _| sections(c)[0] == 0.0, 100),
        ("zero-length plateau", |c, _| sections(c)[1] == 0.0, 500),
        ("order 3 of t", |c, _| c.opening[2].0 == c.open_start() && sections(c)[0] > 0.0, 100),
        ("order 3 of f", |c, _| c.opening[2].1 == 0.0 && c.opening[1].1 == 0.0, 100),
        ("handles cross", |c, _| crossed(c) > 0.0, 500),
        ("handles cross by 9/10", |c, _| crossed(c) > 0.9 * sections(c)[0], 300),
        ("a jump at the start", |c, _| c.opening[0].1 > 0.0, 500),
        ("a jump from the start on", |c, _| c.opening.iter().all(|p| p.1 == 1.0), 100),
        ("a dip", |c, _| c.opening[1].1 < 0.5 * c.opening[0].1, 100),
        ("across time 0", |c, _| is_across(c), 200),
        ("far from time 0", |c, _| f64::from(c.open_start().abs()) > 1e3 * whole(c), 100),
        ("the least interval", |c, _| f64::from(c.open_start().abs()) > 65_534.0 * whole(c), 50),
        ("huge and tiny times", |c, _| !(1e-12..1e12).contains(&c.close_end().abs()), 200),
        ("a tiny ramp", |c, _| (1e-30..1e-3).contains(&(sections(c)[0] / whole(c))), 300),
        ("-0.0", |c, _| c.opening.iter().any(|p| p.0.to_bits() == 1 << 31), 50),
    ];
    have(&features, 4000, |index| random_hard(7, index));
    assert_ne!(random_hard(7, 0), random_hard(8, 0));
}

#[test]
fn aimed_curves_meet_what_they_are_aimed_at() {
    let features: [Feature; 11] = [
        (
            "handles cross by exactly 15/16",
            |c, _| {
                [*c, c.mirrored()].iter().any(|c| {
                    let length = sections(c)[0];
                    length > 0.0 && crossed(c) == MOST_CROSSED * length
                })
            },
            200,
        ),
        ("an end of order 6", |c, _| c.opening[2] == (c.open_start(), 0.0) && sections(c)[0] > 0.0, 30),
        ("a section of the least length", |c, _| sections(c).contains(&(LEAST_SECTION * greatest(c))), 50),
        ("the least interval", |c, _| whole(c) == LEAST_INTERVAL * greatest(c), 200),
        ("the least exposure, to 2^-19", |c, e| e.area().hi < (1.0 + exp2(-19)) * LEAST_EXPOSURE * whole(c), 50),
        ("a density dark at both ends", |c, _| c.opening[0].1 == 0.0 && c.opening[3].1 == 0.0, 50),
        ("an inner join at time 0", |c, _| c.open_end() == 0.0 || c.close_start() == 0.0, 300),
        ("across time 0", |c, _| is_across(c), 400),
        (
            "a join within 2^-26 of half of the light",
            |_, e| e.landmarks()[..2].iter().any(|u| (u.hi - 0.5).abs() < exp2(-26)),
            40,
        ),
        ("a ramp with less than 2^-20 of the light", |_, e| (exp2(-60)..exp2(-20)).contains(&e.landmarks()[0].hi), 60),
        (
            "an f32 is the fraction where something changes, to 2^-34",
            |_, e| {
                e.landmarks().into_iter().any(|u| {
                    // Halves and quarters are met by symmetry.
                    let off = (Dd::from(u.to_f32()) / u - Dd::ONE).hi.abs();
                    u.hi > 0.0 && u.hi < 0.99 && off > 0.0 && off < exp2(-34)
                })
            },
            300,
        ),
    ];
    let families = FAMILIES.len() as u64;
    have(&features, 300 * families, |index| aimed((index % families) as usize, SEED, index / families));
}
