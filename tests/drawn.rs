//! What people draw: whole milliseconds, plain fractions, the same number twice.
//!
//! Random numbers never are that. A random share of the exposure is never 5/8, and whole numbers give it at once. Each
//! test here is one family of such designs, held against the oracle with several numbers of octaves.
//!
//! `cargo test --test drawn -- --nocapture` prints the worst of each family. `TIMES=200` before it tries 200 times as
//! many designs, the first of which are the same; `DRAWN_FROM=1000000` starts from another one.

mod support;

use shutter_curve::CubicBezier;
use support::cases::shutter;
use support::curves::{Rng, is_valid};
use support::oracle::{Curve, Exact, Points, exp2};
use support::promise::{Figures, Questions, Reach};
use support::times;

const SEED: u64 = 58;

/// Which designs of a family are tried: a quarter of so many, unless more are asked for.
fn indices(designs: u64) -> std::ops::Range<u64> {
    let from = std::env::var("DRAWN_FROM").map_or(0, |text| text.parse().expect("a whole number"));
    from..from + (designs * times()).div_ceil(4)
}

/// Which octaves a design is built with.
#[derive(Clone, Copy, PartialEq)]
enum Octaves {
    /// The usual number, none, and another one in turn.
    Few,
    /// From none to the most.
    All,
}

fn ask(figures: &mut Figures, curve: &Curve, octaves: Octaves, reach: Reach) {
    let exact = Exact::new(curve);
    let questions = Questions::new(&exact, reach);
    figures.curves += 1;
    figures.asked::<8>(&exact, &questions);
    figures.asked::<0>(&exact, &questions);
    let all = octaves == Octaves::All;
    if all || reach.turn.is_multiple_of(6) {
        figures.asked::<1>(&exact, &questions);
    }
    if all || reach.turn % 6 == 1 {
        figures.asked::<2>(&exact, &questions);
    }
    if all || reach.turn % 6 == 2 {
        figures.asked::<3>(&exact, &questions);
    }
    if all || reach.turn % 6 == 3 {
        figures.asked::<4>(&exact, &questions);
    }
    if all || reach.turn % 6 == 4 {
        figures.asked::<16>(&exact, &questions);
    }
    if all || reach.turn % 12 == 5 {
        figures.asked::<32>(&exact, &questions);
    }
    if all || reach.turn % 12 == 11 {
        figures.asked::<64>(&exact, &questions);
    }
}

/// Is a design as [`random_typical`](support::curves::random_typical) draws them? On these the forward error is promised.
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

/// Judges the valid ones of so many designs of a family.
fn keeps_every_promise(
    name: &str,
    designs: u64,
    octaves: Octaves,
    reach: Reach,
    draw: impl Fn(&mut Rng) -> Curve,
) {
    let mut figures = Figures::default();
    let indices = indices(designs);
    let drawn = indices.end - indices.start;
    for index in indices {
        let curve = draw(&mut Rng::new(SEED, index));
        if is_valid(&curve) {
            let is_typical = is_typical(&curve);
            let reach = Reach { turn: index as usize, is_typical, ..reach };
            ask(&mut figures, &curve, octaves, reach);
        }
    }
    println!("{name}: {figures}");
    assert!(figures.curves > drawn / 4, "only {} are valid", figures.curves);
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
}

/// A ramp as an editor draws it: from the outer end, dark, at 0 to the inner one; `length` and handles in whole units.
type Shape = [(f64, f64); 4];

fn shape(t: [f64; 4], f: [f64; 4]) -> Shape {
    std::array::from_fn(|i| (t[i], f[i]))
}

fn whole(rng: &mut Rng, least: u64, most: u64) -> f64 {
    (least + rng.below(most - least + 1)) as f64
}

/// All that an editor offers. Each opens fully.
fn ramp(rng: &mut Rng, length: f64) -> Shape {
    let thirds = [0.0, length / 3.0, 2.0 * length / 3.0, length];
    let [h1, h2] = [0, 1].map(|_| whole(rng, 0, length as u64));
    match rng.below(14) {
        // Straight.
        0 => shape(thirds, [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]),
        // S, with the same handle at both ends and with two.
        1 | 2 => shape([0.0, h1.min(length / 2.0), length - h1.min(length / 2.0), length], SMOOTH),
        3 | 4 => shape([0.0, h1, length - h2, length], SMOOTH),
        // Handles half of the way, and all of it.
        5 => shape([0.0, 0.5 * length, 0.5 * length, length], SMOOTH),
        6 => shape([0.0, length, 0.0, length], SMOOTH),
        // Ease-in, ease-out.
        7 => shape([0.0, h1, length, length], SMOOTH),
        8 => shape([0.0, 0.0, length - h2, length], SMOOTH),
        // Smoothstep, p², p³, and these from the other end.
        9 => shape(thirds, SMOOTH),
        10 => shape(thirds, [0.0, 0.0, 1.0 / 3.0, 1.0]),
        11 => shape(thirds, [0.0, 0.0, 0.0, 1.0]),
        12 => shape(thirds, [0.0, 2.0 / 3.0, 1.0, 1.0]),
        _ => shape(thirds, [0.0, 1.0, 1.0, 1.0]),
    }
}

const SMOOTH: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

/// The symmetric ones: half of their length is their exposure, exactly where their times are whole.
fn symmetric(rng: &mut Rng, length: f64) -> Shape {
    let handle = match rng.below(3) {
        0 => whole(rng, 0, (length / 2.0) as u64),
        1 => length / 4.0,
        _ => whole(rng, 0, length as u64),
    };
    shape([0.0, handle, length - handle, length], SMOOTH)
}

/// The shape in time, `unit` of which are one: as a program reads a decimal fraction, rounded once.
fn opening(shape: Shape, start: f64, units: f64) -> Points {
    shape.map(|(t, f)| (((start + t) / units) as f32, f as f32))
}

fn closing(shape: Shape, end: f64, units: f64) -> Points {
    let [a, b, c, d] = shape.map(|(t, f)| (((end - t) / units) as f32, f as f32));
    [d, c, b, a]
}

/// A shutter whose four times are whole numbers of ms, or so many in s.
fn shutter_of(
    rng: &mut Rng,
    [opens, open, closes]: [f64; 3],
    drawn: fn(&mut Rng, f64) -> Shape,
    units: f64,
) -> Curve {
    let start = match rng.below(8) {
        0 => -opens,
        1 => -(opens + open),
        2 => whole(rng, 1, 1000),
        3 => -whole(rng, 1, 1000),
        _ => 0.0,
    };
    let first = drawn(rng, opens);
    let last = if rng.chance(0.3) && opens == closes { first } else { drawn(rng, closes) };
    let end = start + opens + open + closes;
    Curve::shutter(opening(first, start, units), closing(last, end, units))
}

/// Lengths as people say them.
fn length(rng: &mut Rng) -> f64 {
    match rng.below(4) {
        0 => whole(rng, 0, 4),
        1 => whole(rng, 0, 20),
        2 => [25.0, 50.0, 100.0, 125.0, 250.0, 500.0, 1000.0][rng.below(7) as usize],
        _ => [0.0, 1.0, 2.0, 5.0, 10.0, 20.0][rng.below(6) as usize],
    }
}

const ALL: Reach = Reach { denominator: 64, frame: 40, turn: 0, is_typical: false };
const QUICK: Reach = Reach { denominator: 16, frame: 16, turn: 0, is_typical: false };

#[test]
fn whole_milliseconds() {
    keeps_every_promise("ms", 350, Octaves::Few, ALL, |rng| {
        let lengths = [length(rng), length(rng), length(rng)];
        shutter_of(rng, lengths, ramp, 1.0)
    });
}

#[test]
fn milliseconds_in_seconds() {
    keeps_every_promise("s", 300, Octaves::Few, ALL, |rng| {
        let lengths = [length(rng), length(rng), length(rng)];
        shutter_of(rng, lengths, ramp, 1000.0)
    });
}

#[test]
fn decimal_fractions_of_the_interval() {
    keeps_every_promise("shutteropening", 300, Octaves::Few, ALL, |rng| {
        // In twentieths or hundredths of the interval.
        let parts = [20.0, 100.0][rng.below(2) as usize];
        let mut inner = [0, 1].map(|_| whole(rng, 0, parts as u64));
        inner.sort_by(f64::total_cmp);
        let between = |rng: &mut Rng, from: f64, to: f64| {
            let mut two = [0, 1].map(|_| from + whole(rng, 0, (to - from) as u64));
            if rng.chance(0.8) {
                two.sort_by(f64::total_cmp);
            }
            two.map(|part| (part / parts) as f32)
        };
        let [[t1, t2], [t5, t6]] = [between(rng, 0.0, inner[0]), between(rng, inner[1], parts)];
        let level = |rng: &mut Rng, usual: f64| {
            if rng.chance(0.6) { usual as f32 } else { (whole(rng, 0, 10) / 10.0) as f32 }
        };
        let [y1, y2, y5, y6] = [level(rng, 0.0), level(rng, 1.0), level(rng, 1.0), level(rng, 0.0)];
        let length = [1.0, 8.0, 10.0, 0.01, 1.0 / 60.0, 0.02][rng.below(6) as usize];
        let at = |part: f64| (length * part / parts) as f32;
        let (opening, closing) = CubicBezier::shutteropening(
            [0.0, at(inner[0]), at(inner[1]), length as f32],
            [t1, y1, t2, y2, t5, y5, t6, y6],
        );
        Curve::shutter(opening.points(), closing.points())
    });
}

/// Lengths that give the opening ramp exactly `part / all` of the exposure.
fn lengths(rng: &mut Rng, part: f64, all: f64) -> [f64; 3] {
    let scale = [1.0, 1.0, 2.0, 5.0, 10.0][rng.below(5) as usize];
    let rest = all - part;
    // The plateau's part of the rest.
    let open = match rng.below(4) {
        0 => 0.0,
        1 => rest,
        2 => rest / 2.0,
        _ => whole(rng, 0, rest as u64),
    };
    [2.0 * part, open, 2.0 * (rest - open)].map(|length| length * scale)
}

/// A join at a plain fraction of the exposure, from either side.
#[test]
fn joins_at_plain_fractions() {
    keeps_every_promise("joins at k/2^m", 450, Octaves::Few, ALL, |rng| {
        let all = exp2(1 + rng.below(6) as i32);
        let part = whole(rng, 1, all as u64 - 1);
        let lengths = lengths(rng, part, all);
        let curve = shutter_of(rng, lengths, plain_symmetric, 1.0);
        if rng.chance(0.4) { curve.mirrored() } else { curve }
    });
}

#[test]
fn joins_at_thirds_fifths_and_tenths() {
    keeps_every_promise("joins at k/3, k/5, k/10", 350, Octaves::Few, ALL, |rng| {
        let all = [3.0, 5.0, 10.0, 6.0, 7.0, 9.0, 12.0, 20.0, 100.0][rng.below(9) as usize];
        let part = whole(rng, 1, all as u64 - 1);
        let lengths = lengths(rng, part, all);
        let curve = shutter_of(rng, lengths, plain_symmetric, 1.0);
        if rng.chance(0.4) { curve.mirrored() } else { curve }
    });
}

/// The symmetric ones that are no trouble: no handle beyond the half.
fn plain_symmetric(rng: &mut Rng, length: f64) -> Shape {
    let handle = if rng.chance(0.5) { length / 4.0 } else { whole(rng, 0, (length / 2.0) as u64) };
    shape([0.0, handle, length - handle, length], SMOOTH)
}

/// With every number of octaves, and handles up to the whole length, so that time stands still.
#[test]
fn plain_joins_with_any_number_of_octaves() {
    keeps_every_promise("any octaves", 60, Octaves::All, ALL, |rng| {
        let all = [2.0, 4.0, 8.0, 16.0, 32.0, 3.0, 5.0, 10.0][rng.below(8) as usize];
        let part = whole(rng, 1, all as u64 - 1);
        let lengths = lengths(rng, part, all);
        shutter_of(rng, lengths, symmetric, 1.0)
    });
}

/// A join next to a plain fraction, below or above, on a curve whose inner join is at time 0, where a plateau may be as
/// short as it likes. Tops of octaves are at these fractions, so that a join is next to one.
#[test]
fn joins_next_to_plain_fractions() {
    keeps_every_promise("joins next to k/2^m", 500, Octaves::Few, QUICK, |rng| {
        let all = exp2(1 + rng.below(5) as i32);
        let part = if rng.chance(0.3) { all / 2.0 } else { whole(rng, 1, all as u64 - 1) };
        let near = exp2(-(20 + rng.below(31) as i32));
        // A ramp may end dim at the join, and take the longer for its light: what follows is a jump.
        let mut drawn = |light: f64| {
            let dim = [1.0, 1.0, 0.5, 0.125, exp2(-7)][rng.below(5) as usize];
            plain_symmetric(rng, 2.0 * light).map(|(t, f)| (t / dim, f * dim))
        };
        let (first, last) = (drawn(part), drawn(all - part));
        let mut curve =
            Curve::shutter(opening(first, -first[3].0, 1.0), closing(last, last[3].0, 1.0));
        // More light on one ramp, or a plateau.
        match rng.below(4) {
            0 => curve.opening[0].1 = (near * all) as f32,
            1 => curve.closing[3].1 = (near * all) as f32,
            2 => curve.opening[3].0 = -(near * all) as f32,
            _ => curve.closing[0].0 = (near * all) as f32,
        }
        // A Bezier's inner points stay within, or time turns back where a handle is 0.
        curve.opening[2].0 = curve.opening[2].0.min(curve.opening[3].0);
        curve.closing[1].0 = curve.closing[1].0.max(curve.closing[0].0);
        if rng.chance(0.5) { curve.mirrored() } else { curve }
    });
}

/// The near ramp, or where the plateau ends, has so little of the light that it is at the least top of an octave; or
/// next to where the plateau's line begins to serve.
#[test]
fn least_shares() {
    keeps_every_promise("least shares", 250, Octaves::All, QUICK, |rng| {
        let off = rng.between(-1.0, 1.0) * exp2(-(rng.below(28) as i32));
        let edge = match rng.below(4) {
            0 => exp2(-9) * (1.0 + off),
            1 => exp2(-28) * (1.0 + off),
            // Below the least top by one octave, or more.
            2 => exp2(-28) * rng.between(0.5, 1.0),
            _ => exp2(-(26 + rng.below(5) as i32)),
        };
        // The light before the edge, of 1 after it: on the near ramp alone, or on it and the plateau.
        let after = whole(rng, 1, 20);
        let light = edge * after / (1.0 - edge);
        let near = light * [1.0, 1.0, 0.5, exp2(-10), 0.0][rng.below(5) as usize];
        // What it ends with, and what follows, may be any openness: a jump shows which polynomial answered.
        let jump = [1.0, 1.0, 0.5, 0.1, exp2(-10)];
        let [dim, dark] = [0, 1].map(|_| jump[rng.below(5) as usize]);
        let first = plain_symmetric(rng, 8.0).map(|(t, f)| (t / 8.0 * 2.0 * near / dim, f * dim));
        let near_length = 2.0 * near / dim;
        let last = if rng.chance(0.8) {
            plain_symmetric(rng, 2.0 * after)
        } else {
            ramp(rng, 2.0 * after)
        };
        let open = light - near;
        let last = if open > 0.0 { last } else { last.map(|(t, f)| (t / dark, f * dark)) };
        let curve =
            Curve::shutter(opening(first, -near_length, 1.0), closing(last, open + last[3].0, 1.0));
        if rng.chance(0.5) { curve.mirrored() } else { curve }
    });
}

/// A kink as sharp as an octave just takes: t' touches 0 inside, in whole units of time, and the openness is next to 1, by
/// as much as leaves the octave its polynomial. Its error may be greatest anywhere, so fractions are judged as densely as
/// pulses may have them.
#[test]
fn kinks_inside_an_octave() {
    let mut figures = Figures::default();
    for index in indices(250) {
        let rng = &mut Rng::new(SEED, index);
        let most = [4, 12, 40][rng.below(3) as usize];
        // Small integers near each other, so that the kink is not next to an end.
        let a = whole(rng, 1, most);
        let b = if rng.chance(0.5) { whole(rng, 1, most) } else { a + whole(rng, 0, 4) };
        let scale = whole(rng, 1, 9);
        let steps = [a * a, -a * b, b * b].map(|step| step * scale);
        let start = whole(rng, 0, 1) * whole(rng, 0, 5000);
        let levels = [0; 4].map(|_| whole(rng, 0, 9));
        let rest = [0.0, 0.0, 1.0, whole(rng, 1, 9)][rng.below(4) as usize];
        let with = |depth: f64| {
            let mut time = start;
            let opening: Points = std::array::from_fn(|i| {
                let at = time;
                time += if i < 3 { steps[i] } else { 0.0 };
                (at as f32, (1.0 - levels[i] * depth) as f32)
            });
            let length = f64::from(opening[3].0 - opening[0].0);
            let end = (f64::from(opening[3].0) + (length * rest / 4.0).round()) as f32;
            Curve::shutter(opening, [(end, 1.0); 4])
        };
        // The deepest with a polynomial.
        let (mut flat, mut deep) = (1e-7, 0.05);
        for _ in 0..24 {
            let middle = f64::sqrt(flat * deep);
            let curve = with(middle);
            let has_octave = is_valid(&curve)
                && shutter::<8>(&curve).is_direct(Exact::new(&curve).slowest(0) as f32);
            *(if has_octave { &mut flat } else { &mut deep }) = middle;
        }
        let curve = with(flat);
        if !is_valid(&curve) {
            continue;
        }
        let exact = Exact::new(&curve);
        let slowest = exact.slowest(0);
        let questions = Questions::closely(&exact, slowest, 300);
        figures.curves += 1;
        figures.asked::<8>(&exact, &questions);
        figures.asked::<4>(&exact, &questions);
    }
    println!("kinks: {figures}");
    assert!(figures.curves > 50, "only {} are valid", figures.curves);
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
}

/// Other units of time, far from time 0, and shutters that are never dark or never fully open, in tenths.
#[test]
fn other_units_and_levels() {
    keeps_every_promise("other units and levels", 250, Octaves::Few, ALL, |rng| {
        let lengths = [length(rng), length(rng), length(rng)];
        let units = [1e-3, 1e-6, 1e-9, 1e6, 60.0, 3600.0, 3.0, 7.0][rng.below(8) as usize];
        let shapes: fn(&mut Rng, f64) -> Shape = if rng.chance(0.5) { ramp } else { symmetric };
        let mut curve = shutter_of(rng, lengths, shapes, units);
        let later = if rng.chance(0.3) {
            let length = f64::from(curve.close_end() - curve.open_start());
            ([1.0, 100.0, 1e4, 1e6, -1e4][rng.below(5) as usize] * length).round()
        } else {
            0.0
        };
        let mut levels = [[0.0, 1.0]; 2];
        if rng.chance(0.3) {
            let mut two = [whole(rng, 0, 10), whole(rng, 1, 10)];
            two.sort_by(f64::total_cmp);
            let two = two.map(|level| level / 10.0);
            levels = if rng.chance(0.5) { [two, two] } else { [two, levels[1]] };
        }
        for (ramp, [low, high]) in [&mut curve.opening, &mut curve.closing].into_iter().zip(levels)
        {
            for (t, f) in ramp {
                *t = (f64::from(*t) + later) as f32;
                *f = (low + (high - low) * f64::from(*f)) as f32;
            }
        }
        curve
    });
}
