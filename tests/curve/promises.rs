//! Every promise of a curve, on every family of curves: named ones, random ones, ones that aim at a difficulty, ones as
//! people draw them, and those on which a version failed.
//!
//! `cargo test --test curve promises:: -- --nocapture` prints the worst of each family. `TIMES=8` before it tries eight
//! times as many random curves, the first of which are the same.

use std::collections::BTreeMap;

use crate::support::curves::{LEAST_EXPOSURE, LEAST_INTERVAL, LEAST_SECTION, MOST_CROSSED, Rng, accepted, named};
use crate::support::families::{DESIGNS, FAMILIES, aimed, design, random_hard, random_typical};
use crate::support::oracle::{Curve, Dd, Exact, exp2};
use crate::support::promise::{
    BACKWARD, BACKWARD_FLOOR, CDF_FLOOR, CDF_STEP_BACK, DENSITY_FLOOR, FORWARD, FORWARD_MEAN, Figures, SCALAR, TICK,
    TYPICAL_TICK, VALUE,
};
use crate::support::questions::{Frame, Questions, around, hard_us, neighbours};
use crate::support::times;
use shutter_curve::MAX_STEPS;

const SEED: u64 = 13;

/// Prints what was seen. No promise may be broken.
fn report(name: &str, figures: &Figures) {
    println!("{name}: {:?}", figures.worst);
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
        (accuracy, "steps of a search", format!("at most {MAX_STEPS} ")),
        (accuracy, "`cdf` as `t` grows", format!("falls by at most {CDF_STEP_BACK} ulp ")),
        (accuracy, "a tick, typical", format!("{TYPICAL_TICK} tick ")),
        (accuracy, "a tick, every", format!("{TICK} tick ")),
        (accuracy, "a pulse's `on`", format!("{TICK} tick ")),
    ] {
        let (_, told) = page.split_once(&format!("\n| {row}")).unwrap_or_else(|| panic!("no {row}"));
        assert!(told.split(" | ").nth(1).is_some_and(|it| format!("{it} ").starts_with(&promise)), "{row}: {promise}");
    }
    let of_readme =
        [format!("within {BACKWARD:?} ulp of `u`"), format!("within {TYPICAL_TICK} tick of its trigger's exact")];
    assert!(of_readme.iter().all(|told| readme.contains(told)));
    let floors = [BACKWARD * BACKWARD_FLOOR, CDF_FLOOR, DENSITY_FLOOR].map(f64::log2);
    assert_eq!(floors, [-46.0, -24.0, -57.0]);
    assert!(["at most 2⁻⁴⁶", "2⁻²⁴, for", "below 2⁻⁵⁷"].iter().all(|told| accuracy.contains(told)));
    // The worst direct tick is one number: the measured table's, and the one that the firmware example leaves time for.
    let (_, row) = include_str!("../../docs/internals/cost.md").split_once("\n| a tick |").unwrap();
    let most = row.split('|').nth(4).unwrap().trim();
    assert!(readme.contains(&format!("took at most {most} cycles")));
    let example = include_str!("../../examples/trigger/firmware.rs");
    assert!(example.contains(&format!("const DIRECT_TICK: u32 = {most};")));
}

/// With every number of octaves, or with some in turn.
fn ask(figures: &mut Figures, curve: &Curve, all_octaves: bool, turn: usize, is_typical: bool) {
    let exact = Exact::new(curve);
    let questions = Questions::plain(&exact, turn, is_typical);
    figures.ask(&exact, &questions);
    let others = [Figures::asked::<1>, Figures::asked::<3>, Figures::asked::<64>];
    for (i, asked) in others.into_iter().enumerate() {
        if all_octaves || turn % others.len() == i {
            asked(figures, &exact, &questions);
        }
    }
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
fn named_curves_and_cases() {
    let (mut figures, mut means) = (Figures::default(), Vec::new());
    let curves =
        ["typical", "hard", "case"].into_iter().flat_map(|kind| named(kind).into_iter().map(move |it| (kind, it)));
    for (turn, (kind, one)) in curves.enumerate() {
        let is_typical = kind == "typical";
        ask(&mut figures, &one.curve, true, turn, is_typical);
        let exact = Exact::new(&one.curve);
        let (spread, fresh) = if is_typical { (spread(20_000), 1000) } else { (Vec::new(), 2000) };
        let us = spread.into_iter().chain(hard_us(&exact, 1, fresh)).collect();
        let (questions, mut of_one) = (Questions::fractions(&exact, us, is_typical), Figures::default());
        of_one.asked::<8>(&exact, &questions);
        of_one.asked::<0>(&exact, &questions);
        assert!(of_one.breaches.is_empty(), "{:#?}", of_one.breaches);
        means.extend(is_typical.then(|| of_one.forward[0] / of_one.forward[1]));
    }
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    println!("mean forward error {mean:.3} ulp");
    assert!(means.len() == 15 && mean <= FORWARD_MEAN);
    report("named", &figures);
}

/// As scenes have them; fresh, as nothing was tuned on them.
#[test]
fn random_typical_curves() {
    let mut figures = Figures::default();
    for i in 0..150 * times() {
        let exact = Exact::new(&random_typical(2, i));
        let questions = Questions::fractions(&exact, spread(300), true);
        figures.asked::<8>(&exact, &questions);
        figures.asked::<0>(&exact, &questions);
        figures.judge(&random_typical(2026, i), &mut Rng::new(11, i));
    }
    report("random typical", &figures);
}

#[test]
fn aimed_curves() {
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        let mut figures = Figures::default();
        // More of the last two, which mix all.
        let curves = if family < 7 { 300 } else { 600 };
        for index in 0..curves * times() {
            figures.judge(&aimed(family, SEED, index), &mut Rng::new(SEED, index));
        }
        report(name, &figures);
    }
}

#[test]
fn designs() {
    for (family, (name, designs, _)) in DESIGNS.iter().enumerate() {
        let mut figures = Figures::default();
        for index in 0..designs * times() {
            let curve = design(family, index);
            ask(&mut figures, &curve, false, index as usize, name.starts_with("typical"));
        }
        report(name, &figures);
    }
}

/// Curves on which a version failed, or that an attack had in the source's rules, as far as they are accepted.
#[test]
fn faults() {
    let (mut figures, curves) = (Figures::default(), named("fault"));
    let curve = |name: &str| curves.iter().find(|one| one.name.starts_with(name)).expect("its row").curve;
    for (turn, one) in curves.iter().enumerate() {
        for curve in [one.curve, one.curve.mirrored()] {
            ask(&mut figures, &accepted(curve), turn < 9, turn, false);
        }
    }
    // The places, triggers and rates at which they failed.
    let us = |u: u32| neighbours(f32::from_bits(u), 1000).collect();
    let ts = |t: u32| around(f32::from_bits(t), 1000).collect();
    let (all, none, ulp) = (1 << 22, Vec::new, f32::EPSILON);
    let touching = (all, Some(1.0 - ulp), 0, 9);
    for (name, us, ts, (n, duty, first, count), hz) in [
        // A fixed point lost the order of times, cdf or ticks.
        ("steps back: 1", us(0x2e859478), ts(0), touching, None),
        ("steps back: 2", us(0x2e859478), ts(0x392cc304), touching, None),
        ("steps back: 3", us(0x2e859478), ts(0xa7800000), touching, None),
        ("steps back: 4", us(1), ts(0xa33877aa), touching, None),
        ("steps back: 5", us(0x2bae3adf), ts(0), touching, None),
        ("steps back: 6", us(1), ts(0xc7800010), touching, Some(1_907_010_622)),
        ("late", none(), none(), (all / 4, None, all / 4 - 2000, 2000), Some(1 << 31)),
        ("late", none(), none(), (all, None, all - 2000, 2000), Some(1 << 31)),
        ("late", none(), none(), (all, None, all - 2000, 2000), Some(1 << 24)),
        ("last", none(), none(), (all, None, all - 30, 30), Some(1_847_502_402)),
        ("first", none(), none(), (all - 1, Some(1.0 - ulp / 2.0), 0, 1), Some(2_147_483_448)),
        ("first", none(), none(), (1_000_007, Some(1.0 - ulp), 0, 1), Some(2_147_483_448)),
        // More than 0.6 ulp wrong, on the most typical curves that there are.
        ("typical: joined", neighbours(10.0 / 39.0, 20_000).collect(), none(), (0, None, 0, 0), None),
        ("typical: a closing", neighbours(0.5, 20_000).collect(), none(), (0, None, 0, 0), None),
        // Midway between two `f32`, where ramps are steep: half an ulp of the fraction is a quarter of a tick, and the
        // polynomial has its own error. 0.75 tick or more.
        ("typical: gentle", none(), none(), (10_912, None, 8182, 1), Some(805_319)),
        ("typical: plain", none(), none(), (4_176_094, None, 1_044_066, 1), Some(16_776_712)),
    ] {
        let exact = Exact::new(&curve(name));
        let mut questions = Questions::new(&exact, us, ts, vec![Frame::new(&exact, n, duty, first, count)]);
        questions.is_typical = name.starts_with("typical");
        questions.greatest.extend(hz);
        figures.asked::<8>(&exact, &questions);
        figures.asked::<0>(&exact, &questions);
    }
    report("faults", &figures);
}

/// What is drawn at random has each difficulty often enough; and it is the same every time.
#[test]
fn curves_are_as_nasty_as_meant() {
    let span = |from: f32, to: f32| f64::from(to) - f64::from(from);
    let families = FAMILIES.len() as u64;
    let draw = |i: u64| match i % 2 {
        0 => random_hard(7, i),
        _ => aimed((i / 2 % families) as usize, SEED, i / 2 / families),
    };
    let mut seen = BTreeMap::new();
    for index in 0..6000 {
        let curve = draw(index);
        assert_eq!(curve, draw(index));
        let (c, exact) = ([curve, curve.mirrored()][index as usize / 2 % 2], Exact::new(&curve));
        let [start, open, close, end] = [c.open_start(), c.open_end(), c.close_start(), c.close_end()];
        let (t, f) = (c.opening.map(|(t, _)| t), c.opening.map(|(_, f)| f));
        let sections = [span(start, open), span(open, close), span(close, end)];
        let ([ramp, ..], whole, greatest) = (sections, span(start, end), f64::from(start.abs().max(end.abs())));
        let landmarks = exact.landmarks();
        // Halves and quarters are met by symmetry.
        let is_hit = |u: &Dd| (exp2(-60)..exp2(-34)).contains(&(Dd::from(u.to_f32()) / *u - Dd::ONE).hi.abs());
        for (name, has, least) in [
            ("no opening ramp", ramp == 0.0, 200),
            ("no plateau", sections[1] == 0.0, 1000),
            ("an end of order 6", ramp > 0.0 && c.opening[..3] == [(start, 0.0); 3], 10),
            ("handles cross by exactly 15/16", ramp > 0.0 && span(t[2], t[1]) == MOST_CROSSED * ramp, 200),
            ("a dip", f[1] < 0.5 * f[0], 100),
            ("an inner join at time 0", start < 0.0 && end > 0.0 && (open == 0.0 || close == 0.0), 300),
            ("the least interval", whole == LEAST_INTERVAL * greatest, 200),
            ("a section of the least length", sections.contains(&(LEAST_SECTION * greatest)), 50),
            ("the least exposure", exact.area().hi < (1.0 + exp2(-19)) * LEAST_EXPOSURE * whole, 50),
            ("a density dark at both ends", close == end && f[0] == 0.0 && f[3] == 0.0, 10),
            ("a ramp with less than 2^-20 of the light", (exp2(-60)..exp2(-20)).contains(&landmarks[0].hi), 60),
            ("a join next to half", landmarks[..2].iter().any(|u| (u.hi - 0.5).abs() < exp2(-26)), 40),
            ("an f32 next to a landmark", landmarks.iter().any(|u| u.hi > 0.0 && u.hi < 0.99 && is_hit(u)), 300),
        ] {
            let count = seen.entry(name).or_insert((0, least));
            count.0 += u32::from(has);
        }
    }
    println!("{seen:#?}");
    assert!(seen.values().all(|(seen, least)| seen >= least));
}
