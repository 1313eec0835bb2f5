//! Curves drawn at random, from fixed seeds that nothing was tuned on: typical ones; hard ones; families that meet a
//! difficulty exactly, where a random search comes near it at best; and designs, as people draw them. All are accepted.

use super::curves::{
    LEAST_EXPOSURE, LEAST_SECTION, MOST_CROSSED, Rng, Shape, accepted, instant, is_valid, placed, settled, shape,
};
use super::oracle::{Curve, Exact, exp2};

/// A well-behaved curve, as scenes hold them: openness rising from about 0 to 1 and falling again, over
/// ramps that are not tiny, in one of the usual units and placements of time.
pub fn random_typical(seed: u64, index: u64) -> Curve {
    typical(&mut Rng::new(seed, index), exp2(-60))
}

/// In multiples of a grain.
fn typical(rng: &mut Rng, grain: f64) -> Curve {
    let [fraction, split] = [between(rng, grain, 0.1, 1.0), between(rng, grain, 0.15, 0.85)];
    let ramps = [fraction * split, fraction * (1.0 - split)];
    let length = [1.0, 1.0, 1e3, 20.833, 1e-3, 1.0 / 48.0][rng.below(6) as usize];
    let start = [0.0, 0.0, 0.0, -0.5, 0.25][rng.below(5) as usize];
    let shapes = [gentle(rng, grain), gentle(rng, grain)];
    let opening = placed(shapes[0], false, start * length, length * ramps[0]);
    let closing = placed(shapes[1], true, (start + 1.0) * length, length * ramps[1]);
    accepted(settled(Curve::shutter(opening, closing)))
}

fn between(rng: &mut Rng, grain: f64, low: f64, high: f64) -> f64 {
    (rng.between(low, high) / grain).round() * grain
}

fn gentle(rng: &mut Rng, grain: f64) -> Shape {
    let [t1, t2] = [between(rng, grain, 0.15, 0.5), between(rng, grain, 0.5, 0.85)];
    match rng.below(5) {
        0 => shape([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]),
        1 => shape([0.0, t1, t2, 1.0], [0.0, 0.0, 1.0, 1.0]),
        2 => shape([0.0, t1, t2, 1.0], [0.0, between(rng, grain, 0.3, 0.7), 1.0, 1.0]),
        3 => shape([0.0, t1, t2, 1.0], [0.0, 0.0, between(rng, grain, 0.3, 0.7), 1.0]),
        _ => {
            let [a, b] = [between(rng, grain, 0.1, 0.5), between(rng, grain, 0.5, 0.95)];
            shape([0.0, t1, t2, 1.0], [0.0, a, b, 1.0])
        }
    }
}

/// A curve with nasty features mixed at random, anywhere in what is accepted and on its edges.
pub fn random_hard(seed: u64, index: u64) -> Curve {
    let rng = &mut Rng::new(seed, index);
    let shapes = [0, 1].map(|_| shape(hard_times(rng), hard_openness(rng)));
    let lengths = hard_lengths(rng);
    let curve = hard(shapes, lengths, rng);
    accepted(if rng.chance(0.4) { curve.mirrored() } else { curve })
}

/// A ramp alone as a density, which may be dim, down to the least exposure, and dark at either end.
pub fn random_density(seed: u64, index: u64) -> Curve {
    let rng = &mut Rng::new(seed, index);
    let (t, mut f) = (hard_times(rng), hard_openness(rng));
    match rng.below(4) {
        0 => f.reverse(),
        1 => f[3] = 0.0,
        _ => f[3] = rng.unit(),
    }
    let Curve { opening: bright, .. } = hard([shape(t, f); 2], [1.0, 0.0, 0.0], rng);
    // As dim as may be, or less.
    let area = Exact::new(&Curve::single(bright)).area().hi;
    let length = f64::from(bright[3].0) - f64::from(bright[0].0);
    let least = LEAST_EXPOSURE * length / area * (1.0 + exp2(-20));
    let dim = if rng.chance(0.3) { least } else { least.powf(rng.unit()) };
    // Raised where a single bright place has hardly any light in it.
    let raised = |f: f32| {
        if least > 1.0 { f.max((exp2(-20) as f32).next_up()) } else { (f64::from(f) * dim) as f32 }
    };
    accepted(Curve::single(bright.map(|(t, f)| (t, raised(f)))))
}

/// The sections' shares of the interval.
fn hard_lengths(rng: &mut Rng) -> [f64; 3] {
    let mut length = |zero: f64| {
        if rng.chance(zero) {
            0.0
        } else if rng.chance(0.3) {
            rng.power_of_ten(-7.0, 0.0)
        } else {
            rng.between(0.1, 1.0)
        }
    };
    let lengths = [length(0.08), length(0.25), length(0.08)];
    let total: f64 = lengths.iter().sum();
    if total > 0.0 { lengths.map(|length| length / total) } else { [0.0, 1.0, 0.0] }
}

/// The place of time 0, the unit of time and the sections, each at times as extreme as it may be.
fn hard(shapes: [Shape; 2], lengths: [f64; 3], rng: &mut Rng) -> Curve {
    let start = match rng.below(24) {
        0..10 => 0.0,
        10..12 => -rng.unit(),
        12 => -1.0,
        13..15 => -lengths[0],
        15..17 => -lengths[0] - lengths[1],
        17 => rng.power_of_ten(-3.0, 3.0),
        // The interval is the least for its distance from time 0, on either side.
        18 => 65_535.0,
        19 => -65_536.0,
        20 => -64_000.0 * rng.unit(),
        _ => rng.power_of_ten(3.0, 4.8),
    };
    let scale = match rng.below(4) {
        0 | 1 => 1.0,
        2 => exp2(rng.below(127) as i32 - 63),
        _ if start.abs() > 65_000.0 => exp2(-9),
        _ => rng.power_of_ten(-9.0, 9.0),
    };
    let mut curve = Curve::shutter(
        placed(shapes[0], false, scale * start, scale * lengths[0]),
        placed(shapes[1], true, scale * (start + 1.0), scale * lengths[2]),
    );
    if lengths[0] < 1.0 && rng.chance(0.15) {
        // A section of the least length, or little more.
        let greatest = f64::from(curve.open_start().abs().max(curve.close_end().abs()));
        let least = LEAST_SECTION * greatest * [1.0, 1.0, 1.5, 8.0][rng.below(4) as usize];
        let after = |t: f32| (f64::from(t) + least) as f32;
        match rng.below(3) {
            0 => curve.opening[3].0 = after(curve.opening[0].0),
            1 => curve.closing[0].0 = after(curve.opening[3].0),
            _ => curve.closing[0].0 = (f64::from(curve.closing[3].0) - least) as f32,
        }
        let [start, end] = [curve.open_start(), curve.close_end()];
        curve.opening[3].0 = curve.opening[3].0.clamp(start, end);
        curve.closing[0].0 = curve.closing[0].0.clamp(curve.opening[3].0, end);
    }
    if rng.chance(0.1) {
        for number in curve.opening.iter_mut().chain(&mut curve.closing).flat_map(|(t, f)| [t, f]) {
            if *number == 0.0 && rng.chance(0.5) {
                *number = -0.0;
            }
        }
    }
    settled(curve)
}

/// Control times in a ramp from 0 to 1.
fn hard_times(rng: &mut Rng) -> [f64; 4] {
    let [a, b] = rng.sorted();
    match rng.below(14) {
        // Control times together at an end: the mass starts with a higher power.
        0 => [0.0, 0.0, a, 1.0],
        1 => [0.0, 0.0, 0.0, 1.0],
        2 => [0.0, 0.0, 1.0, 1.0],
        3 => [0.0, a, 1.0, 1.0],
        4 => [0.0, 1.0, 1.0, 1.0],
        // The same, missed by a trace.
        5 => {
            let trace = rng.power_of_ten(-9.0, -4.0);
            [0.0, a * trace, trace, 1.0]
        }
        6 => {
            let trace = rng.power_of_ten(-7.0, -4.0);
            [0.0, b, 1.0 - trace, 1.0]
        }
        // The first point passes the second by as much as it may, at either end or between.
        7 | 8 => {
            let first = [MOST_CROSSED, 1.0, MOST_CROSSED + a * (1.0 - MOST_CROSSED)][rng.below(3) as usize];
            [0.0, first, first - MOST_CROSSED, 1.0]
        }
        // By less.
        9 => [0.0, b, a.max(b - MOST_CROSSED), 1.0],
        10 => [0.0, a, a, 1.0],
        _ => [0.0, a, b, 1.0],
    }
}

/// Openness from the outer end to the join, where it is 1.
fn hard_openness(rng: &mut Rng) -> [f64; 4] {
    let [a, b] = rng.sorted();
    match rng.below(12) {
        // Flat at the outer end, exactly and nearly.
        0 => [0.0, 0.0, a, 1.0],
        1 => [0.0, 0.0, 0.0, 1.0],
        2 => {
            let trace = rng.power_of_ten(-9.0, -4.0);
            [0.0, a * trace, trace, 1.0]
        }
        3 => [rng.power_of_ten(-30.0, -3.0), 0.0, a, 1.0],
        4 => [rng.power_of_ten(-12.0, -3.0), 0.0, 0.0, 1.0],
        // A jump at the outer end, with a dip inside, and without.
        5 => [1.0, 0.0, 0.0, 1.0],
        6 => [rng.unit(), 0.0, b, 1.0],
        7 => [rng.unit(), rng.unit(), rng.unit(), 1.0],
        8 => [1.0; 4],
        // Flat at the join.
        9 => [0.0, 1.0, 1.0, 1.0],
        10 => [0.0, b, a, 1.0],
        _ => [0.0, a, b, 1.0],
    }
}

/// What is difficult about the curves of a family, and how one is drawn.
type Family = (&'static str, fn(&mut Rng) -> Curve);

pub const FAMILIES: [Family; 9] = [
    ("handles cross by 15/16", |rng| {
        let shapes = [0, 1].map(|_| {
            let first = [MOST_CROSSED, 1.0, 0.5 * (1.0 + MOST_CROSSED)][rng.below(3) as usize];
            let dim = rng.power_of_ten(-6.0, -1.0);
            // Nearly open an octave just takes the kink; its error may be greatest anywhere.
            let open = [0; 4].map(|_| 1.0 - dim * rng.unit());
            let f = if rng.chance(0.5) { hard_openness(rng) } else { [open[0], open[1], open[2], 1.0] };
            let t = if rng.chance(0.8) { [0.0, first, first - MOST_CROSSED, 1.0] } else { hard_times(rng) };
            shape(t, f)
        });
        let ramps = [0, 1].map(|_| exp2(rng.below(7) as i32));
        joined(rng, shapes, ramps)
    }),
    ("ends of high order", |rng| {
        let shapes = [0, 1].map(|_| {
            let near = [0, 1].map(|_| trace(rng) * f64::from(rng.chance(0.6)));
            let few = |near: [f64; 2]| [0.0, near[0].min(near[1]), near[0].max(near[1]), 1.0];
            let t = match rng.below(4) {
                0 => few(near).map(|t| 1.0 - t),
                1 => [0.0, near[0], 1.0, 1.0],
                _ => few(near),
            };
            let t = if t[0] > t[3] { [t[3], t[2], t[1], t[0]] } else { t };
            let f = if rng.chance(0.7) {
                few([0, 1].map(|_| trace(rng) * f64::from(rng.chance(0.5))))
            } else {
                hard_openness(rng)
            };
            shape(t, f)
        });
        let ramps = [0, 1].map(|_| rng.between(0.1, 1.0));
        joined(rng, shapes, ramps)
    }),
    ("dark inside", |rng| {
        let shapes = [0, 1].map(|_| {
            let height = [1.0, rng.unit(), trace(rng)][rng.below(3) as usize];
            let low = [0.0, trace(rng)][rng.below(2) as usize];
            shape(hard_times(rng), [height, 0.0, low, 1.0])
        });
        let ramps = [0, 1].map(|_| rng.between(0.1, 1.0));
        joined(rng, shapes, ramps)
    }),
    // Tops of octaves are at these fractions, so that the join is next to one.
    ("joins next to plain fractions of the light", |rng| {
        let all = exp2(1 + rng.below(5) as i32);
        let part = if rng.chance(0.4) { 0.5 * all } else { (1 + rng.below(all as u64 - 1)) as f64 };
        // Handles of the same length on either side: half of the ramp's length is its light.
        let handle = [0.25, rng.unit()][rng.below(2) as usize].min(MOST_CROSSED);
        let times = [0.0, handle, 1.0 - handle, 1.0];
        let times = if rng.chance(0.3) { [0.0, 31.0 / 32.0, 1.0 / 32.0, 1.0] } else { times };
        let plain = shape(times, [0.0, 0.0, 1.0, 1.0]);
        let mut curve = Curve::shutter(
            placed(plain, false, -2.0 * part, 2.0 * part),
            placed(plain, true, 2.0 * (all - part), 2.0 * (all - part)),
        );
        // More light on one ramp, or a plateau.
        let near = (exp2(-(20 + rng.below(31) as i32)) * all) as f32;
        let long = 2.0 * part.max(all - part) * LEAST_SECTION * (1 + rng.below(8)) as f64;
        match rng.below(5) {
            0 => curve.opening[0].1 = near.min(1.0),
            1 => curve.closing[3].1 = near.min(1.0),
            2 => curve.opening[3].0 = -long as f32,
            3 => curve.closing[0].0 = long as f32,
            _ => {}
        }
        settled(curve)
    }),
    ("least sections, joins at time 0", |rng| {
        let shapes = [0, 1].map(|_| shape(hard_times(rng), hard_openness(rng)));
        let least = LEAST_SECTION * (1 + rng.below(16)) as f64;
        let [first, last] = [[1.0, least], [least, 1.0], [1.0, 1.0]][rng.below(3) as usize];
        let plateau = [0.0, least, 1.0][rng.below(3) as usize];
        // Time 0 at a join, or inside a section.
        let zero = [0.0, -plateau, -plateau * rng.unit(), -first * rng.unit()][rng.below(4) as usize];
        settled(Curve::shutter(
            placed(shapes[0], false, zero - first, first),
            placed(shapes[1], true, zero + plateau + last, last),
        ))
    }),
    ("least shares of the light", |rng| {
        // The light before the join, next to where octaves and the plateau's line begin.
        let off = rng.between(-1.0, 1.0) * exp2(-(rng.below(28) as i32));
        let share = [exp2(-9) * (1.0 + off), exp2(-(20 + rng.below(5) as i32)) * (1.0 + off)];
        let after = (1 + rng.below(20)) as f64;
        let light = share[rng.below(2) as usize] * after;
        let near = light * [1.0, 1.0, 0.5, exp2(-10), 0.0][rng.below(5) as usize];
        let shapes = [0, 1].map(|_| shape([0.0, 0.25, 0.75, 1.0], [0.0, 0.0, 1.0, 1.0]));
        let last = if rng.chance(0.5) { shape(hard_times(rng), hard_openness(rng)) } else { shapes[1] };
        let end = light - near + 2.0 * after;
        settled(Curve::shutter(placed(shapes[0], false, -2.0 * near, 2.0 * near), placed(last, true, end, 2.0 * after)))
    }),
    ("least intervals", |rng| {
        // In 256ths of the interval, which are ulps where it ends.
        let mut cuts = [0, 1].map(|_| [0.0, 1.0, 255.0, 256.0, rng.below(257) as f64][rng.below(5) as usize]);
        cuts.sort_by(f64::total_cmp);
        let shapes = [0, 1].map(|_| shape(hard_times(rng), hard_openness(rng)));
        let start = 256.0 * 65_535.0;
        let unit = exp2(rng.below(31) as i32 - 15);
        let curve = Curve::shutter(
            placed(shapes[0], false, unit * start, unit * cuts[0]),
            placed(shapes[1], true, unit * (start + 256.0), unit * (256.0 - cuts[1])),
        );
        settled(curve)
    }),
    ("densities", |rng| random_density(rng.bits(), 0)),
    ("anything hard", |rng| random_hard(rng.bits(), 0)),
];

/// Curve `index` of a family.
pub fn aimed(family: usize, seed: u64, index: u64) -> Curve {
    let mut rng = Rng::new(seed ^ (family as u64) << 40, index);
    let curve = accepted(FAMILIES[family].1(&mut rng));
    let curve = if rng.chance(0.4) { hitting(&curve, &mut rng) } else { curve };
    if rng.chance(0.3) { curve.mirrored() } else { curve }
}

/// Some power of ten.
fn trace(rng: &mut Rng) -> f64 {
    rng.power_of_ten(-16.0, -1.0)
}

/// Two ramps that meet, or with a plateau between them; from time 0 on, joined there, or later.
fn joined(rng: &mut Rng, shapes: [Shape; 2], [first, last]: [f64; 2]) -> Curve {
    let plateau = [0.0, 0.0, 1.0, 0.375, 1e-7][rng.below(5) as usize];
    let last = if rng.chance(0.2) { 0.0 } else { last };
    let start = [0.0, -first, -first, (rng.below(5000)) as f64][rng.below(4) as usize];
    settled(Curve::shutter(
        placed(shapes[0], false, start, first),
        placed(shapes[1], true, start + first + plateau + last, last),
    ))
}

/// The curve with another end, such that an f32 is next to exactly the fraction at one of its landmarks.
///
/// Without that, the rounding of u keeps it 2⁻²⁵ away from where the difficulty is; this leaves some 2⁻³⁵.
fn hitting(curve: &Curve, rng: &mut Rng) -> Curve {
    let exact = Exact::new(&Curve { closing: instant(curve.open_end()), ..*curve });
    let ramp = exact.area().hi;
    // Of another magnitude than the landmark no plateau could move it.
    let landmarks = exact.landmarks();
    let landmark = landmarks[rng.below(landmarks.len() as u64) as usize].hi * ramp;
    let length = f64::from(curve.open_end()) - f64::from(curve.open_start());
    let first = (f64::from(curve.open_end()) + length * rng.unit()) as f32;
    if !(landmark > 0.0 && first > 0.0 && first < 1e6) {
        return *curve;
    }
    let off = |end: f32| {
        let u = landmark / (ramp + (f64::from(end) - f64::from(curve.open_end())));
        (f64::from(u as f32) / u - 1.0).abs()
    };
    let ends = (0..1000).map(|i| f32::from_bits(first.to_bits() + i));
    let end = ends.min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(first);
    let hit = Curve { closing: instant(end), ..*curve };
    if is_valid(&hit) { hit } else { *curve }
}

/// A family of designs, how many are tried, and how one is drawn.
type Design = (&'static str, u64, fn(&mut Rng) -> Curve);

/// What people draw: whole milliseconds, plain fractions, the same number twice. A random share of the exposure is
/// never 5/8, and whole numbers give it at once.
pub const DESIGNS: [Design; 3] = [
    ("typical, in hundredths", 20, |rng| typical(rng, 0.01)),
    // In whole ms, the same in s, or in another unit; some far from time 0, or never dark, in tenths.
    ("whole numbers", 75, |rng| {
        let lengths = [length(rng), length(rng), length(rng)];
        let units = match rng.below(3) {
            0 => 1.0,
            1 => 1000.0,
            _ => [1e-3, 1e-6, 1e-9, 1e6, 60.0, 3600.0, 3.0, 7.0][rng.below(8) as usize],
        };
        let far = if rng.chance(0.2) { [1.0, 100.0, 1e4, -1e4][rng.below(4) as usize] } else { 0.0 };
        let low = if rng.chance(0.1) { whole(rng, 0, 10) / 10.0 } else { 0.0 };
        shutter_of(rng, lengths, ramp, [units, far, low])
    }),
    // From either side: exactly so many parts of `all` of the exposure before the join.
    ("joins at plain fractions", 50, |rng| {
        let all = [2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 3.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 20.0, 100.0];
        let all = all[rng.below(15) as usize];
        let part = whole(rng, 1, all as u64 - 1);
        let (rest, scale) = (all - part, [1.0, 1.0, 2.0, 5.0, 10.0][rng.below(5) as usize]);
        // The plateau's part of the rest.
        let open = [0.0, rest, rest / 2.0, whole(rng, 0, rest as u64)][rng.below(4) as usize];
        let lengths = [2.0 * part, open, 2.0 * (rest - open)].map(|length| length * scale);
        let curve = shutter_of(rng, lengths, symmetric, [1.0, 0.0, 0.0]);
        if rng.chance(0.4) { curve.mirrored() } else { curve }
    }),
];

/// Design `index` of a family.
pub fn design(family: usize, index: u64) -> Curve {
    accepted(DESIGNS[family].2(&mut Rng::new(58, index)))
}

fn whole(rng: &mut Rng, least: u64, most: u64) -> f64 {
    (least + rng.below(most - least + 1)) as f64
}

/// Lengths as people say them.
fn length(rng: &mut Rng) -> f64 {
    match rng.below(4) {
        0 => whole(rng, 0, 4),
        1 => whole(rng, 0, 20),
        _ => [0.0, 1.0, 2.0, 5.0, 10.0, 25.0, 50.0, 100.0, 125.0, 250.0, 500.0, 1000.0][rng.below(12) as usize],
    }
}

/// All that an editor offers: straight, S with equal or different handles, eased at one end, smoothstep, p², p³ and
/// these from the other end.
fn ramp(rng: &mut Rng, length: f64) -> Shape {
    let thirds = [0.0, length / 3.0, 2.0 * length / 3.0, length];
    let [h1, h2] = [0, 1].map(|_| whole(rng, 0, length as u64));
    let (t, [f1, f2]) = match rng.below(8) {
        0 => return symmetric(rng, length),
        1 => ([0.0, h1, length - h2.min(length - 0.5 * h1), length], [0.0, 1.0]),
        2 => ([0.0, h1, length, length], [0.0, 1.0]),
        3 => ([0.0, 0.0, length - h2, length], [0.0, 1.0]),
        _ => {
            let f = [[1.0, 2.0], [0.0, 3.0], [0.0, 1.0], [0.0, 0.0], [2.0, 3.0], [3.0, 3.0]][rng.below(6) as usize];
            (thirds, f.map(|f| f / 3.0))
        }
    };
    shape(t, [0.0, f1, f2, 1.0])
}

/// The symmetric ones: half of their length is their exposure, exactly where their times are whole.
fn symmetric(rng: &mut Rng, length: f64) -> Shape {
    let handle = match rng.below(4) {
        0 => whole(rng, 0, (length / 2.0) as u64),
        1 => length / 4.0,
        2 => length / 2.0,
        _ => whole(rng, 0, length as u64).min(31.0 / 32.0 * length),
    };
    shape([0.0, handle, length - handle, length], [0.0, 0.0, 1.0, 1.0])
}

/// A shutter whose four times are whole numbers of ms, or so many in a unit; so many lengths from time 0, and never
/// darker than `low`.
fn shutter_of(
    rng: &mut Rng,
    [opens, open, closes]: [f64; 3],
    drawn: fn(&mut Rng, f64) -> Shape,
    [units, far, low]: [f64; 3],
) -> Curve {
    let light = if opens + open + closes > 0.0 { open } else { 1.0 };
    let start = match rng.below(8) {
        0 => -opens,
        1 => -(opens + open),
        2 => whole(rng, 1, 1000),
        3 => -whole(rng, 1, 1000),
        _ => 0.0,
    };
    let start = start + (far * (opens + light + closes)).round();
    let first = drawn(rng, opens);
    let last = if rng.chance(0.3) && opens == closes { first } else { drawn(rng, closes) };
    let end = start + opens + light + closes;
    // As a program reads a decimal fraction, rounded once.
    let point = |t: f64, f: f64| ((t / units) as f32, (low + (1.0 - low) * f) as f32);
    let opening = first.map(|(t, f)| point(start + t, f));
    let [d, c, b, a] = last.map(|(t, f)| point(end - t, f));
    settled(Curve::shutter(opening, [a, b, c, d]))
}
