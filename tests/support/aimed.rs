//! Curves and inputs that meet difficulties exactly, where a random search comes near them at best: handles that cross
//! by as much as they may, joins next to 1/2 and at time 0, the least sections, intervals and exposures. All are
//! accepted, and fixed seeds draw them, as in `curves`.

use super::curves::{
    LEAST_SECTION, MOST_CROSSED, Rng, Shape, accepted, around, hard_openness, hard_times, instant, is_valid,
    neighbours, placed, random_density, random_hard, settled, shape,
};
use super::oracle::{Curve, Dd, Exact, exp2};

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

/// The u at which the curve is difficult, in order.
pub fn aimed_us(exact: &Exact, rng: &mut Rng) -> Vec<f32> {
    let landmarks = exact.landmarks().into_iter().map(Dd::to_f32);
    let mut us: Vec<f32> = landmarks.chain([0.25, 0.5, 0.75]).flat_map(|u| neighbours(u, 3)).collect();
    // And where a search from there starts out.
    for _ in 0..6 {
        let landmark = us[rng.below(us.len() as u64) as usize];
        us.extend(
            [1.0 + rng.power_of_ten(-7.0, 0.0), 1.0 - rng.power_of_ten(-7.0, 0.0)]
                .map(|by| (f64::from(landmark) * by) as f32),
        );
        us.push(rng.unit() as f32);
        us.push(f32::from_bits(rng.below(1f32.to_bits() as u64) as u32));
        let steps = 1 << rng.below(20);
        us.push(1.0 - exp2(-24) as f32 * rng.between(1.0, f64::from(steps)) as f32);
    }
    us.extend([1, 2, 3, 10_000].map(f32::from_bits));
    us.extend([f32::MIN_POSITIVE, 1f32.next_down()]);
    us.retain(|u| (0.0..=1.0).contains(u));
    us.extend([-0.0, 0.0, 1.0]);
    us.sort_by(f32::total_cmp);
    us.dedup_by_key(|u| u.to_bits());
    us
}

/// Times at which the curve is difficult, or beside it.
pub fn aimed_ts(exact: &Exact, rng: &mut Rng) -> Vec<f32> {
    let landmarks: Vec<f32> = exact.landmark_times().into_iter().map(Dd::to_f32).collect();
    let mut ts: Vec<f32> = landmarks.iter().flat_map(|t| around(*t, 3)).collect();
    for t in [1e-45, 1e-44, 1e-38, 1e-30, 1e-18, 1e-9, 1e-4] {
        ts.extend([-t, t]);
    }
    let length = f64::from(exact.curve().close_end()) - f64::from(exact.curve().open_start());
    for _ in 0..6 {
        let landmark = f64::from(landmarks[rng.below(landmarks.len() as u64) as usize]);
        let off = length * rng.power_of_ten(-12.0, 0.0);
        ts.extend([(landmark - off) as f32, (landmark + off) as f32]);
        ts.push(exact.inverse_cdf(rng.unit() as f32).to_f32());
    }
    ts.extend([-0.0, 0.0]);
    ts
}

/// Few triggers, one of which is next to a landmark: their number and that one.
pub fn aimed_triggers(exact: &Exact, most: u32) -> Vec<[u32; 2]> {
    let near = |u: f64| {
        let trigger = |n: u32| ((u * f64::from(n)) as u32).min(n - 1);
        let off = |n: u32| ((f64::from(trigger(n)) + 0.5) / f64::from(n) - u).abs();
        let n = (1..=most).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(1);
        [n, trigger(n)]
    };
    exact.landmarks().into_iter().map(|u| near(u.hi.clamp(0.0, 1.0))).collect()
}
