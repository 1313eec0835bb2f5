//! Curves and inputs that meet difficulties exactly, where a random search comes near them at best: the mass at a
//! minimum of f or t' to the last bit, minima that coincide, minima at the very end of a ramp, ramps without light,
//! joins at time 0. Fixed seeds, as in `curves`.

use super::curves::{Rng, hard_openness, hard_times, is_valid};
use super::oracle::{Curve, Dd, Exact, Points, exp2};

/// A ramp from time 0 onwards: times and openness.
type Ramp = [(f64, f64); 4];

/// What is difficult about the curves of a family, and how one of its ramps is drawn.
type Family = (&'static str, fn(&mut Rng) -> Ramp);

pub const FAMILIES: [Family; 12] = [
    ("f and t' touch 0 together", |rng| {
        let q = square(rng);
        ramp(q, touching(q, rng))
    }),
    ("f and t' touch 0 apart", |rng| {
        let (q, r) = (square(rng), square(rng));
        ramp(q, touching(r, rng))
    }),
    ("f and t' nearly touch 0 together", |rng| {
        let q = square(rng);
        let f = touching(q, rng);
        let [near, dim] = [0, 1].map(|_| trace(rng));
        ramp(q.map(|d| d + near * (q[0] + q[2])), raised(f, dim))
    }),
    ("t' touches 0", |rng| {
        let q = square(rng);
        ramp(q, hard_openness(rng))
    }),
    ("f touches 0", |rng| {
        let q = square(rng);
        let f = touching(q, rng);
        let times = hard_times(rng);
        ramp([times[1], times[2] - times[1], 1.0 - times[2]], f)
    }),
    ("both touch 0 next to an end", |rng| {
        let (q, r) = (square_at_the_end(rng), square_at_the_end(rng));
        let r = if rng.chance(0.5) { q } else { r };
        let reversed = rng.chance(0.3);
        let f = touching(if reversed { [r[2], r[1], r[0]] } else { r }, rng);
        ramp(q, f)
    }),
    ("f touches 0 next to an end", |rng| {
        let f = touching(square_at_the_end(rng), rng);
        ramp([1.0; 3], raised(f, if rng.chance(0.5) { 0.0 } else { trace(rng) }))
    }),
    ("symmetric, dips where time stands still", |rng| {
        let height = rng.between(0.05, 1.0);
        let low = -height / 3.0 * (1.0 - rng.power_of_ten(-9.0, -5.0));
        let slow = if rng.chance(0.7) { -1.0 } else { trace(rng) - 1.0 };
        ramp([1.0, slow, 1.0], [height, low, low, height])
    }),
    ("symmetric in other ways", |rng| {
        let [inner, low] = [rng.between(-1.0, 1.0), rng.between(-0.33, 1.0)];
        ramp([1.0, inner, 1.0], [1.0, low, low, 1.0])
    }),
    ("grazes", |rng| {
        let (q, r) = (square(rng), square(rng));
        let depth = -rng.graze();
        let f = raised(touching(r, rng), depth);
        let back = -rng.graze() / 3.0;
        ramp(if rng.chance(0.5) { q.map(|d| d + back * (q[0] + q[2])) } else { [1.0; 3] }, f)
    }),
    ("next to no light, or none", |rng| {
        let dim = rng.power_of_ten(-38.0, 0.0);
        let f = [
            [0.0; 4],
            [0.0, 0.0, 0.0, dim],
            [dim, 0.0, 0.0, 0.0],
            [0.0, dim, 0.0, 0.0],
            [dim, 0.0, 0.0, dim],
        ][rng.below(5) as usize];
        ramp(if rng.chance(0.5) { [1.0; 3] } else { square(rng) }, f)
    }),
    ("anything hard", |rng| {
        let times = hard_times(rng);
        ramp([times[1], times[2] - times[1], 1.0 - times[2]], hard_openness(rng))
    }),
];

/// Curve `index` of a family.
pub fn aimed(family: usize, seed: u64, index: u64) -> Curve {
    let mut rng = Rng::new(seed ^ (family as u64) << 40, index);
    loop {
        let one = FAMILIES[family].1(&mut rng);
        let curve = placed(one, &mut rng);
        if is_valid(&curve) {
            let curve = if rng.chance(0.4) { hitting(&curve, &mut rng) } else { curve };
            return if rng.chance(0.3) { curve.mirrored() } else { curve };
        }
    }
}

/// The square of a linear function with a root inside, as three Bernstein coefficients. Small integers, so that no
/// rounding takes the double root away.
fn square(rng: &mut Rng) -> [f64; 3] {
    if rng.chance(0.2) {
        return [1.0, -1.0, 1.0];
    }
    let most = [4, 16, 250][rng.below(3) as usize];
    let [a, b] = [0, 1].map(|_| (1 + rng.below(most)) as f64);
    [a * a, -a * b, b * b]
}

/// The same with the root next to an end: as near as 2⁻⁵⁰, and there `f32` round the last coefficient.
fn square_at_the_end(rng: &mut Rng) -> [f64; 3] {
    let near = exp2(-(5 + rng.below(46) as i32));
    let q = [near * near, -near, 1.0];
    if rng.chance(0.5) { q } else { [q[2], q[1], q[0]] }
}

/// That square times a linear function, as four Bernstein coefficients of at most 1.
fn touching(q: [f64; 3], rng: &mut Rng) -> [f64; 4] {
    let (c, d) = match rng.below(4) {
        0 => (3.0, 3.0),
        1 => (3.0, 0.0),
        2 => (0.0, 3.0),
        _ => ((3 * (1 + rng.below(9))) as f64, (3 * (1 + rng.below(9))) as f64),
    };
    let f =
        [q[0] * c, (2.0 * q[1] * c + q[0] * d) / 3.0, (q[2] * c + 2.0 * q[1] * d) / 3.0, q[2] * d];
    // By a power of two, which rounds nothing.
    let most = c.max(d) * q[0].max(q[2]);
    let scale = exp2(-(most.log2().ceil() as i32));
    f.map(|f| f * scale)
}

/// Openness moved up, or down by less than 0, by this share of its size.
fn raised(f: [f64; 4], by: f64) -> [f64; 4] {
    let size = f[0].max(f[3]);
    f.map(|f| (f + by * size) / (1.0 + by.max(0.0)))
}

/// Some power of ten.
fn trace(rng: &mut Rng) -> f64 {
    rng.power_of_ten(-16.0, -1.0)
}

/// From the differences of the times and the openness; a power of two long, or nearly.
fn ramp(steps: [f64; 3], f: [f64; 4]) -> Ramp {
    let sum: f64 = steps.iter().sum();
    let scale = exp2(-(sum.log2().ceil() as i32));
    let mut time = 0.0;
    std::array::from_fn(|i| {
        let at = time;
        if i < 3 {
            time += steps[i] * scale;
        }
        (at, f[i])
    })
}

fn length(ramp: &Ramp) -> f64 {
    ramp[3].0 - ramp[0].0
}

/// The ramp run backwards, again from time 0.
fn back(ramp: Ramp) -> Ramp {
    let end = ramp[3].0;
    let [a, b, c, d] = ramp.map(|(t, f)| (end - t, f));
    [d, c, b, a]
}

fn at(ramp: Ramp, start: f64) -> Points {
    ramp.map(|(t, f)| ((start + t) as f32, f as f32))
}

/// All in one moment.
fn instant(t: f64) -> Points {
    [(t as f32, 1.0); 4]
}

/// A curve with this ramp: alone, twice, with its mirror image, or with another ramp of much less light.
fn placed(one: Ramp, rng: &mut Rng) -> Curve {
    let end = length(&one);
    let plateau = [0.0, 0.0, 1.0, 0.375, 1e-7][rng.below(5) as usize];
    // Where time is finest, a ramp may be as short as it likes: at the join at time 0.
    let zero = if rng.chance(0.5) { 0.0 } else { -0.0 };
    let mut curve = match rng.below(7) {
        0 | 1 => Curve::shutter(at(one, 0.0), instant(end + plateau)),
        2 => Curve::shutter(at(one, 0.0), at(one, end + plateau)),
        3 => Curve::shutter(at(one, 0.0), at(back(one), end + plateau)),
        4 => Curve::shutter(at(one, -end), at(back(one), plateau)),
        5 => {
            // The other ramp has next to nothing of the light, or nearly all.
            let less = [12, 30, 60, 100, 130][rng.below(5) as usize];
            let share = rng.below(less + 1) as i32;
            let (shorter, darker) = (exp2(-share), exp2(share - less as i32));
            let other = FAMILIES[rng.below(FAMILIES.len() as u64) as usize].1(rng);
            let other = other.map(|(t, f)| (t * shorter, f * darker));
            let other = if rng.chance(0.5) { other } else { back(other) };
            Curve::shutter(at(one, -end), at(other, 0.0))
        }
        _ => {
            let other = FAMILIES[rng.below(FAMILIES.len() as u64) as usize].1(rng);
            Curve::shutter(at(one, -end), at(other, plateau))
        }
    };
    for points in [&mut curve.opening, &mut curve.closing] {
        for number in points.iter_mut().flat_map(|(t, f)| [t, f]) {
            if *number == 0.0 {
                *number = zero;
            }
        }
    }
    if rng.chance(0.2) { curve.scaled(exp2(rng.below(81) as i32 - 40) as f32) } else { curve }
}

/// The curve with another end, such that an f32 is next to exactly the fraction at one of its landmarks.
///
/// Without that, the rounding of u keeps it 2⁻²⁵ away from where the difficulty is; this leaves some 2⁻³⁵.
fn hitting(curve: &Curve, rng: &mut Rng) -> Curve {
    let exact = Exact::new(&Curve { closing: [(curve.open_end(), 1.0); 4], ..*curve });
    let ramp = exact.area().hi;
    // A dark ramp has no landmark, and one of another magnitude none that a plateau could move.
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
    let hit = Curve { closing: [(end, 1.0); 4], ..*curve };
    if is_valid(&hit) { hit } else { *curve }
}

/// The neighbours of `x`, three on either side, and `x`.
fn around(x: f32) -> impl Iterator<Item = f32> {
    let mut first = x;
    for _ in 0..3 {
        first = first.next_down();
    }
    std::iter::successors(Some(first), |x| Some(x.next_up())).take(7)
}

/// The u at which the curve is difficult, in order.
pub fn aimed_us(exact: &Exact, rng: &mut Rng) -> Vec<f32> {
    let landmarks = exact.landmarks().into_iter().map(Dd::to_f32);
    let mut us: Vec<f32> = landmarks.chain([0.25, 0.5, 0.75]).flat_map(around).collect();
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

/// The times at which the curve is difficult, in order.
pub fn aimed_ts(exact: &Exact, rng: &mut Rng) -> Vec<f32> {
    let (start, end) = (exact.curve().open_start(), exact.curve().close_end());
    let landmarks: Vec<f32> = exact.landmark_times().into_iter().map(Dd::to_f32).collect();
    let mut ts: Vec<f32> = landmarks.iter().copied().flat_map(around).collect();
    for t in [1e-45, 1e-44, 1e-38, 1e-30, 1e-18, 1e-9, 1e-4] {
        ts.extend([-t, t]);
    }
    let length = f64::from(end) - f64::from(start);
    for _ in 0..6 {
        let landmark = f64::from(landmarks[rng.below(landmarks.len() as u64) as usize]);
        let off = length * rng.power_of_ten(-12.0, 0.0);
        ts.extend([(landmark - off) as f32, (landmark + off) as f32]);
        ts.push(exact.inverse_cdf(rng.unit() as f32).to_f32());
    }
    ts.extend([-0.0, 0.0]);
    ts.retain(|t| (start..=end).contains(t));
    ts.sort_by(f32::total_cmp);
    ts.dedup_by_key(|t| t.to_bits());
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
