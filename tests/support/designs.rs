//! What people draw: whole milliseconds, plain fractions, the same number twice.
//!
//! Random numbers never are that. A random share of the exposure is never 5/8, and whole numbers give it at once.

use shutter_curve::CubicBezier;

use super::curves::{Rng, Shape, accepted, placed, settled, shape};
use super::oracle::Curve;

/// What designs are drawn, how many are tried, and how one is drawn.
type Family = (&'static str, u64, fn(&mut Rng) -> Curve);

/// Design `index` of a family.
pub fn design(family: usize, index: u64) -> Curve {
    accepted(DESIGNS[family].2(&mut Rng::new(58, index)))
}

pub const DESIGNS: [Family; 5] = [
    // In whole ms, the same in s, or in another unit; some far from time 0, or never dark, in tenths.
    ("whole ms", 118, |rng| {
        let lengths = [length(rng), length(rng), length(rng)];
        let units = match rng.below(3) {
            0 => 1.0,
            1 => 1000.0,
            _ => [1e-3, 1e-6, 1e-9, 1e6, 60.0, 3600.0, 3.0, 7.0][rng.below(8) as usize],
        };
        let shapes: fn(&mut Rng, f64) -> Shape = if rng.chance(0.8) { ramp } else { symmetric };
        let Curve { mut opening, mut closing } = shutter_of(rng, lengths, shapes, units);
        let length = f64::from(closing[3].0 - opening[0].0);
        let far = if rng.chance(0.2) { [1.0, 100.0, 1e4, -1e4][rng.below(4) as usize] } else { 0.0 };
        let low = if rng.chance(0.1) { whole(rng, 0, 10) / 10.0 } else { 0.0 };
        for (t, f) in opening.iter_mut().chain(&mut closing) {
            *t = (f64::from(*t) + (far * length).round()) as f32;
            *f = (low + (1.0 - low) * f64::from(*f)) as f32;
        }
        settled(Curve { opening, closing })
    }),
    ("decimal fractions of the interval", 40, decimal),
    // From either side; no handle is beyond the half.
    ("joins at plain fractions", 100, |rng| {
        let powers = [2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
        let others = [3.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 20.0, 100.0];
        let all = if rng.chance(0.5) { powers[rng.below(6) as usize] } else { others[rng.below(9) as usize] };
        let curve = joined_at(rng, all, |rng, length| {
            let half = (length / 2.0) as u64;
            let handle = if rng.chance(0.5) { length / 4.0 } else { whole(rng, 0, half) };
            shape([0.0, handle, length - handle, length], SMOOTH)
        });
        if rng.chance(0.4) { curve.mirrored() } else { curve }
    }),
    ("joins at any, handles to the end", 8, |rng| {
        let all = [2.0, 4.0, 8.0, 16.0, 32.0, 3.0, 5.0, 10.0][rng.below(8) as usize];
        joined_at(rng, all, symmetric)
    }),
    // In thousandths, and ramps across it.
    ("joins next to time 0", 30, |rng| {
        let mut decimal = |most| 0.001 * whole(rng, 1, most);
        let (open, join, end) = (decimal(4000), decimal(4000), decimal(6000));
        let plateau = [0.0, 0.0, join, 0.001][rng.below(4) as usize];
        let handle = [0.25, 0.5, 0.75, 31.0 / 32.0][rng.below(4) as usize];
        let times = [0.0, handle, 1.0 - handle, 1.0];
        let curve = settled(Curve::shutter(
            placed(shape(times, SMOOTH), false, -join - open, open),
            placed(shape(times, SMOOTH), true, plateau - join + end, end),
        ));
        if rng.chance(0.5) { curve.mirrored() } else { curve }
    }),
];

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
        3 | 4 => shape([0.0, h1, length - h2.min(length - 0.5 * h1), length], SMOOTH),
        // Handles half of the way, and nearly all of it.
        5 => shape([0.0, 0.5 * length, 0.5 * length, length], SMOOTH),
        6 => shape([0.0, 31.0 / 32.0, 1.0 / 32.0, 1.0].map(|t| t * length), SMOOTH),
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
        _ => whole(rng, 0, length as u64).min(31.0 / 32.0 * length),
    };
    shape([0.0, handle, length - handle, length], SMOOTH)
}

/// A shutter whose four times are whole numbers of ms, or so many in s.
fn shutter_of(rng: &mut Rng, [opens, open, closes]: [f64; 3], drawn: fn(&mut Rng, f64) -> Shape, units: f64) -> Curve {
    let start = match rng.below(8) {
        0 => -opens,
        1 => -(opens + open),
        2 => whole(rng, 1, 1000),
        3 => -whole(rng, 1, 1000),
        _ => 0.0,
    };
    let first = drawn(rng, opens);
    let last = if rng.chance(0.3) && opens == closes { first } else { drawn(rng, closes) };
    let light = if opens + open + closes > 0.0 { open } else { 1.0 };
    let end = start + opens + light + closes;
    // As a program reads a decimal fraction, rounded once.
    let opening = first.map(|(t, f)| (((start + t) / units) as f32, f as f32));
    let [d, c, b, a] = last.map(|(t, f)| (((end - t) / units) as f32, f as f32));
    settled(Curve::shutter(opening, [a, b, c, d]))
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

/// A join at exactly so many parts of `all` of the exposure.
fn joined_at(rng: &mut Rng, all: f64, drawn: fn(&mut Rng, f64) -> Shape) -> Curve {
    let part = whole(rng, 1, all as u64 - 1);
    let scale = [1.0, 1.0, 2.0, 5.0, 10.0][rng.below(5) as usize];
    let rest = all - part;
    // The plateau's part of the rest.
    let open = [0.0, rest, rest / 2.0, whole(rng, 0, rest as u64)][rng.below(4) as usize];
    let lengths = [2.0 * part, open, 2.0 * (rest - open)].map(|length| length * scale);
    shutter_of(rng, lengths, drawn, 1.0)
}

/// As RenderMan has them.
fn decimal(rng: &mut Rng) -> Curve {
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
    let levels = [0.0, 1.0, 1.0, 0.0];
    let [y1, y2, y5, y6] = levels.map(|usual| if rng.chance(0.6) { usual } else { (whole(rng, 0, 10) / 10.0) as f32 });
    let length = [1.0, 8.0, 10.0, 0.01, 1.0 / 60.0, 0.02][rng.below(6) as usize];
    let at = |part: f64| (length * part / parts) as f32;
    let (opening, closing) =
        CubicBezier::shutteropening([0.0, at(inner[0]), at(inner[1]), length as f32], [t1, y1, t2, y2, t5, y5, t6, y6]);
    settled(Curve::shutter(opening.points(), closing.points()))
}
