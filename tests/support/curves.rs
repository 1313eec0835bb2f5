//! The curves and the `u` that the tests judge: the named ones of `tests/data/curves.csv`, and fresh
//! ones drawn at random from a fixed seed.

use crate::support::oracle::lift::range;
use crate::support::oracle::{Curve, Dd, Exact, Points, exp2};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// As scenes hold them.
    Typical,
    /// Valid, and built to break a solver.
    Hard,
}

#[derive(Clone, Debug)]
pub struct Named {
    pub name: &'static str,
    pub kind: Kind,
    pub curve: Curve,
}

/// All curves of `tests/data/curves.csv`.
pub fn named() -> Vec<Named> {
    let rows: Vec<Vec<&str>> = include_str!("../data/curves.csv")
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let point = |row: &Vec<&str>| (row[4].parse().unwrap(), row[5].parse().unwrap());
    rows.chunks(8)
        .map(|rows| {
            for (i, row) in rows.iter().enumerate() {
                let ramp = if i < 4 { "opening" } else { "closing" };
                let index = (i % 4).to_string();
                assert_eq!([row[0], row[2], row[3]], [rows[0][0], ramp, &index]);
            }
            let points: [(f32, f32); 8] = std::array::from_fn(|i| point(&rows[i]));
            let [opening, closing]: [Points; 2] =
                [points[..4].try_into().unwrap(), points[4..].try_into().unwrap()];
            let kind = match rows[0][1] {
                "typical" => Kind::Typical,
                "hard" => Kind::Hard,
                other => panic!("curve kind {other}"),
            };
            Named { name: rows[0][0], kind, curve: Curve::shutter(opening, closing) }
        })
        .collect()
}

/// splitmix64 (Steele, Lea and Flood 2014): each (seed, index) starts a stream of its own.
#[derive(Clone, Debug)]
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64, index: u64) -> Self {
        let mut rng = Self(seed);
        rng.0 = rng.bits() ^ index.wrapping_mul(0xD134_2543_DE82_EF95);
        rng.bits();
        rng
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * exp2(-53)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm, between two powers of 10.
    pub fn power_of_ten(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// As far as rounding may take a curve past a bound, or any power of ten less.
    pub fn graze(&mut self) -> f64 {
        GRAZE * self.power_of_ten(-9.0, 0.0)
    }

    fn sorted(&mut self) -> [f64; 2] {
        let (a, b) = (self.unit(), self.unit());
        [a.min(b), a.max(b)]
    }
}

/// A well-behaved curve, as scenes hold them: openness rising from about 0 to 1 and falling again, over
/// ramps that are not tiny, in one of the usual units and placements of time.
pub fn random_typical(seed: u64, index: u64) -> Curve {
    let mut rng = Rng::new(seed, index);
    drawn_until_valid(|| {
        let fraction = rng.between(0.1, 1.0);
        let split = rng.between(0.15, 0.85);
        let ramps = [fraction * split, fraction * (1.0 - split)];
        let length = [1.0, 1.0, 1e3, 20.833, 1e-3, 1.0 / 48.0][rng.below(6) as usize];
        let start = [0.0, 0.0, 0.0, -0.5, 0.25][rng.below(5) as usize];
        let shapes = [gentle(&mut rng), gentle(&mut rng)];
        Curve::shutter(
            placed(shapes[0], false, start * length, length * ramps[0]),
            placed(shapes[1], true, (start + 1.0) * length, length * ramps[1]),
        )
    })
}

/// A ramp seen from the curve's outer end inwards: times from 0 to 1, and openness.
type Shape = [(f64, f64); 4];

fn shape(t: [f64; 4], f: [f64; 4]) -> Shape {
    std::array::from_fn(|i| (t[i], f[i]))
}

fn gentle(rng: &mut Rng) -> Shape {
    let [t1, t2] = [rng.between(0.15, 0.5), rng.between(0.5, 0.85)];
    match rng.below(5) {
        0 => shape([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]),
        1 => shape([0.0, t1, t2, 1.0], [0.0, 0.0, 1.0, 1.0]),
        2 => shape([0.0, t1, t2, 1.0], [0.0, rng.between(0.3, 0.7), 1.0, 1.0]),
        3 => shape([0.0, t1, t2, 1.0], [0.0, 0.0, rng.between(0.3, 0.7), 1.0]),
        _ => {
            let [a, b] = [rng.between(0.1, 0.5), rng.between(0.5, 0.95)];
            shape([0.0, t1, t2, 1.0], [0.0, a, b, 1.0])
        }
    }
}

/// The shape in time, counted inwards from the outer end: forwards from an early one, backwards from a late.
fn placed(shape: Shape, is_late: bool, outer: f64, length: f64) -> Points {
    let sign = if is_late { -1.0 } else { 1.0 };
    let mut points = shape.map(|(t, f)| ((outer + sign * length * t) as f32, f as f32));
    if is_late {
        points.reverse();
    }
    points
}

/// A valid curve with nasty features mixed at random.
pub fn random_hard(seed: u64, index: u64) -> Curve {
    let mut rng = Rng::new(seed, index);
    drawn_until_valid(|| hard(&mut rng))
}

/// As [`random_hard`], but a ramp with nothing after it, and as faint as a curve may be.
pub fn random_single(seed: u64, index: u64) -> Curve {
    let mut rng = Rng::new(seed, index);
    drawn_until_valid(|| {
        let curve = hard(&mut rng);
        let points = if rng.chance(0.5) { curve.opening } else { curve.closing };
        let least = if rng.chance(0.5) { -8.0 } else { -36.0 };
        let scale = rng.power_of_ten(least, 0.0);
        Curve::single(points.map(|(t, f)| (t, (f as f64 * scale) as f32)))
    })
}

fn drawn_until_valid(mut draw: impl FnMut() -> Curve) -> Curve {
    loop {
        let curve = draw();
        if is_valid(&curve) {
            return curve;
        }
    }
}

fn hard(rng: &mut Rng) -> Curve {
    let shapes = [0, 1].map(|_| {
        let (t, mut f) = (hard_times(rng), hard_openness(rng));
        if rng.chance(0.05) {
            let dim = rng.power_of_ten(-12.0, 0.0);
            f = f.map(|f| f * dim);
        }
        shape(t, f)
    });
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
    let start = match rng.below(20) {
        0..12 => 0.0,
        12..15 => -total * rng.unit(),
        15 => -total,
        16 => total * rng.power_of_ten(-3.0, 3.0),
        17 => 1e5 * total * rng.between(0.5, 1.0),
        18 => -1e5 * total * rng.between(0.5, 1.0),
        _ => total * rng.power_of_ten(3.0, 6.0),
    };
    let scale = match rng.below(4) {
        0 | 1 => 1.0,
        2 => exp2(rng.below(121) as i32 - 60),
        _ => rng.power_of_ten(-9.0, 9.0),
    };
    let (outer, length) = ([start, start + total], [lengths[0], lengths[2]]);
    let mut curve = Curve::shutter(
        placed(shapes[0], false, scale * outer[0], scale * length[0]),
        placed(shapes[1], true, scale * outer[1], scale * length[1]),
    );
    if rng.chance(0.1) {
        for number in curve.opening.iter_mut().chain(&mut curve.closing).flat_map(|(t, f)| [t, f]) {
            if *number == 0.0 && rng.chance(0.5) {
                *number = -0.0;
            }
        }
    }
    curve
}

/// The square of `p - root`, as three Bernstein coefficients.
fn double_root(root: f64) -> [f64; 3] {
    let rest = 1.0 - root;
    [root * root, -root * rest, rest * rest]
}

pub fn hard_times(rng: &mut Rng) -> [f64; 4] {
    let [a, b] = rng.sorted();
    match rng.below(13) {
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
        // t' = 0 inside, control times mostly outside; then nearly so.
        7 | 8 => {
            let slope = double_root(rng.between(0.05, 0.95));
            let near = match rng.below(4) {
                0 => -rng.graze(),
                1 => 0.0,
                _ => rng.power_of_ten(-8.0, -1.0),
            };
            let [d0, d1, d2] = slope.map(|d| d + near);
            let sum = d0 + d1 + d2;
            [0.0, d0 / sum, (d0 + d1) / sum, 1.0]
        }
        // Anything; what turns back is drawn anew.
        9 => [0.0, rng.between(-0.2, 1.5), rng.between(-0.5, 1.2), 1.0],
        // Back by a trace at the start, or before the end; 1 itself hides a trace, so that this is rare.
        10 if rng.chance(0.3) => [0.0, a, 1.0 + rng.graze() / 3.0, 1.0],
        10 => [0.0, -rng.graze() / 3.0, b, 1.0],
        _ => [0.0, a, b, 1.0],
    }
}

pub fn hard_openness(rng: &mut Rng) -> [f64; 4] {
    let [a, b] = rng.sorted();
    match rng.below(15) {
        // Flat at the outer end, exactly and nearly.
        0 => [0.0, 0.0, a, 1.0],
        1 => [0.0, 0.0, 0.0, 1.0],
        2 => {
            let trace = rng.power_of_ten(-9.0, -4.0);
            [0.0, a * trace, trace, 1.0]
        }
        3 => [rng.power_of_ten(-12.0, -3.0), 0.0, a, 1.0],
        // Touching 0 or 1 inside, exactly (but for rounding) and nearly.
        4..8 => {
            let [q0, q1, q2] = double_root(rng.between(0.05, 0.95));
            let (c, d) = (rng.unit(), rng.unit());
            let touching =
                [q0 * c, (2.0 * q1 * c + q0 * d) / 3.0, (q2 * c + 2.0 * q1 * d) / 3.0, q2 * d];
            // The polynomial is at most max(c, d) on [0, 1].
            let near = match rng.below(4) {
                0 => -rng.graze() * c.max(d),
                1 => 0.0,
                _ => rng.power_of_ten(-8.0, -1.0),
            };
            let touching = touching.map(|f| (f + near) / (c.max(d) + near));
            if rng.chance(0.4) { touching.map(|f| 1.0 - f) } else { touching }
        }
        // Jumps at both ends; dark at the inner one; no light at all.
        8 => [0.0; 4].map(|_| rng.unit()),
        9 => [1.0, b, 0.0, 0.0],
        10 if rng.chance(0.2) => [0.0; 4],
        10 => [1.0, 1.0, 1.0, rng.unit()],
        // Control values outside [0, 1]; what leaves it is drawn anew.
        11 => [rng.unit(), rng.between(-0.5, 1.5), rng.between(-0.5, 1.5), rng.unit()],
        // Below 0 by a trace at an end.
        12 if rng.chance(0.5) => [-rng.graze(), a, b, 1.0],
        12 => [1.0, b, a, -rng.graze()],
        13 => [0.0, rng.between(0.0, 1.5), rng.between(-0.5, 1.5), 1.0],
        _ => [0.0, a, b, 1.0],
    }
}

/// How far rounding may take f or t' past its bound: what the library accepts, and no more than `f64` doubts.
const GRAZE: f64 = (1.0 - 1e-6) / (1u64 << 22) as f64;

/// Is this a curve that the library promises to accept?
pub fn is_valid(curve: &Curve) -> bool {
    let times = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
    let length = times[3] as f64 - times[0] as f64;
    if !times.is_sorted() || !(exp2(-64)..=exp2(64)).contains(&length) {
        return false;
    }
    if ![curve.opening, curve.closing].iter().all(is_ramp) {
        return false;
    }
    // The area and its reciprocal are normal numbers of f32.
    (exp2(-125)..=exp2(125)).contains(&Exact::new(curve).area().hi)
}

fn is_ramp(points: &Points) -> bool {
    let (t, f) = (points.map(|p| p.0 as f64), points.map(|p| p.1 as f64));
    let length = t[3] - t[0];
    // Time stays between its ends, but for what a start at the least slope explains, ...
    let [first, last] = range(t.map(|time| time - t[0]));
    let leaves = (-first).max(last - length) > 0.25 * GRAZE * GRAZE * length;
    // ... and runs forward: d0 (1-p)² + 2 d1 p (1-p) + d2 p² is a third of t'.
    let [d0, d1, d2] = [t[1] - t[0], t[2] - t[1], t[3] - t[2]];
    let slope = |p: f64| d0 * (1.0 - p) * (1.0 - p) + 2.0 * d1 * p * (1.0 - p) + d2 * p * p;
    let slowest = (d0 - d1) / (d0 - 2.0 * d1 + d2);
    let inside = if slowest > 0.0 && slowest < 1.0 { slope(slowest) } else { d0 };
    let runs_forward = d0.min(d2).min(inside) >= -GRAZE / 3.0 * length;
    let [low, high] = range(f);
    !leaves && runs_forward && low >= -GRAZE * high.max(-low) && high <= 1.0 + GRAZE
}

/// The `u` most likely to break a solver on this curve, and some `fresh` random ones.
pub fn hard_us(exact: &Exact, seed: u64, fresh: usize) -> Vec<f32> {
    let mut us = vec![-0.0, 0.0, 1.0];
    let mut around = |u: f32, neighbours: i32| {
        for offset in -neighbours..=neighbours {
            let bits = u.to_bits() as i32 + offset;
            if (0..=1f32.to_bits() as i32).contains(&bits) {
                us.push(f32::from_bits(bits as u32));
            }
        }
    };
    around(0.0, 3);
    around(1.0, 3);
    around(f32::MIN_POSITIVE, 2);
    for exponent in 1..=149 {
        let neighbours = if exponent <= 32 { 2 } else { 0 };
        around(exp2(-exponent) as f32, neighbours);
        around(1.0 - exp2(-exponent.min(24)) as f32, neighbours);
    }
    for landmark in exact.landmarks() {
        around(landmark.max(Dd::ZERO).min(Dd::ONE).to_f32(), 6);
    }
    let mut rng = Rng::new(seed, 0);
    for i in 0..fresh {
        let tail = exp2(-(rng.below(24) as i32)) * rng.unit();
        us.push(match i % 4 {
            0 => rng.unit() as f32,
            1 => tail as f32,
            2 => 1.0 - tail as f32,
            _ => f32::from_bits(rng.below(1f32.to_bits() as u64) as u32),
        });
    }
    us
}
