//! The curves and the `u` that the tests judge: the named ones of `tests/data/curves.csv`, and fresh
//! ones drawn at random from a fixed seed.

use shutter_curve::{CubicBezier, CurveError, Part};

use super::oracle::{Curve, Exact, Points, exp2};

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
    let rows: Vec<Vec<&str>> =
        include_str!("../data/curves.csv").lines().skip(1).map(|line| line.split(',').collect()).collect();
    let point = |row: &Vec<&str>| (row[4].parse().unwrap(), row[5].parse().unwrap());
    rows.chunks(8)
        .map(|rows| {
            let points: [(f32, f32); 8] = std::array::from_fn(|i| point(&rows[i]));
            let [opening, closing]: [Points; 2] = [points[..4].try_into().unwrap(), points[4..].try_into().unwrap()];
            let kind = if rows[0][1] == "typical" { Kind::Typical } else { Kind::Hard };
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

    fn sorted(&mut self) -> [f64; 2] {
        let (a, b) = (self.unit(), self.unit());
        [a.min(b), a.max(b)]
    }
}

/// A well-behaved curve, as scenes hold them: openness rising from about 0 to 1 and falling again, over
/// ramps that are not tiny, in one of the usual units and placements of time.
pub fn random_typical(seed: u64, index: u64) -> Curve {
    let mut rng = Rng::new(seed, index);
    let fraction = rng.between(0.1, 1.0);
    let split = rng.between(0.15, 0.85);
    let ramps = [fraction * split, fraction * (1.0 - split)];
    let length = [1.0, 1.0, 1e3, 20.833, 1e-3, 1.0 / 48.0][rng.below(6) as usize];
    let start = [0.0, 0.0, 0.0, -0.5, 0.25][rng.below(5) as usize];
    let shapes = [gentle(&mut rng), gentle(&mut rng)];
    let opening = placed(shapes[0], false, start * length, length * ramps[0]);
    let closing = placed(shapes[1], true, (start + 1.0) * length, length * ramps[1]);
    accepted(settled(Curve::shutter(opening, closing)))
}

/// A ramp seen from the curve's outer end inwards: times from 0 to 1, and openness.
pub type Shape = [(f64, f64); 4];

pub fn shape(t: [f64; 4], f: [f64; 4]) -> Shape {
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
pub fn placed(shape: Shape, is_late: bool, outer: f64, length: f64) -> Points {
    let sign = if is_late { -1.0 } else { 1.0 };
    let mut points = shape.map(|(t, f)| ((outer + sign * length * t) as f32, f as f32));
    if is_late {
        points.reverse();
    }
    points
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

pub const fn line(from: (f32, f32), to: (f32, f32)) -> Points {
    CubicBezier::line(from, to).points()
}

/// All in one moment.
pub const fn instant(t: f32) -> Points {
    [(t, 1.0); 4]
}

/// The curve, which has to be one that is promised to be accepted.
pub fn accepted(curve: Curve) -> Curve {
    assert!(is_valid(&curve), "not accepted: {curve:?}");
    curve
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

/// The curve, where rounding has taken it over an edge of what is accepted: sections that became too short have no
/// length, what is no ramp is fully open, and inner times move in, or nearer to each other.
pub fn settled(curve: Curve) -> Curve {
    let Curve { mut opening, mut closing } = curve;
    let greatest = f64::from(opening[0].0.abs().max(closing[3].0.abs()));
    let is_short = |from: f32, to: f32| {
        let length = f64::from(to) - f64::from(from);
        length <= 0.0 || length < LEAST_SECTION * greatest
    };
    if is_short(opening[0].0, opening[3].0) {
        opening = opening.map(|(_, f)| (opening[0].0, f));
    }
    if is_short(closing[0].0, closing[3].0) {
        closing = closing.map(|(_, f)| (closing[3].0, f));
    }
    if is_short(opening[3].0, closing[0].0) {
        // The longer ramp takes it in.
        let opens = opening[3].0 - opening[0].0 > closing[3].0 - closing[0].0;
        *(if opens { &mut opening[3].0 } else { &mut closing[0].0 }) = if opens { closing[0].0 } else { opening[3].0 };
    }
    for ramp in [&mut opening, &mut closing] {
        let [from, to] = [ramp[0].0, ramp[3].0];
        for point in [1, 2] {
            ramp[point].0 = ramp[point].0.max(from).min(to);
        }
        let most = MOST_CROSSED * (f64::from(to) - f64::from(from));
        let crossed = |ramp: &Points| f64::from(ramp[1].0) - f64::from(ramp[2].0);
        if crossed(ramp) > most {
            ramp[2].0 = ((f64::from(ramp[1].0) - most) as f32).clamp(from, to);
        }
        while crossed(ramp) > most {
            (ramp[1].0, ramp[2].0) = (ramp[1].0.next_down().max(from), ramp[2].0.next_up().min(to));
        }
    }
    Curve::shutter(opening, closing)
}

/// Control times in a ramp from 0 to 1.
pub fn hard_times(rng: &mut Rng) -> [f64; 4] {
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
pub fn hard_openness(rng: &mut Rng) -> [f64; 4] {
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

// What is accepted, told once more without the library.
pub const MOST_CROSSED: f64 = 15.0 / 16.0;
pub const LEAST_INTERVAL: f64 = 1.0 / 65_536.0;
pub const LEAST_SECTION: f64 = 1.0 / 16_777_216.0;
pub const LEAST_EXPOSURE: f64 = 1.0 / 1_048_576.0;

/// The first rule that a curve breaks.
pub fn verdict(curve: &Curve) -> Result<(), CurveError> {
    use CurveError as E;
    let refused = |is_broken: bool, error| if is_broken { Err(error) } else { Ok(()) };
    let span = |from: f32, to: f32| f64::from(to) - f64::from(from);
    let [start, open, close, end] = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
    let (length, greatest) = (span(start, end), f64::from(start.abs().max(end.abs())));
    let ramps = [(curve.opening, Part::Opening), (curve.closing, Part::Closing)];
    for (ramp, part) in ramps {
        refused(!ramp.iter().all(|(t, f)| t.is_finite() && f.is_finite()), E::NotFinite(part))?;
    }
    refused(![start, open, close, end].is_sorted(), E::TimesOutOfOrder)?;
    refused(length < LEAST_INTERVAL * greatest, E::IntervalUnresolved)?;
    refused(!(exp2(-64)..=exp2(64)).contains(&length), E::IntervalOutOfRange)?;
    for (from, to, part) in [(start, open, Part::Opening), (open, close, Part::Plateau), (close, end, Part::Closing)] {
        refused(from != to && span(from, to) < LEAST_SECTION * greatest, E::TooShort(part))?;
    }
    for (ramp, part) in ramps {
        let [from, first, second, to] = ramp.map(|(t, _)| t);
        for (point, (t, f)) in (0..).zip(ramp) {
            refused(!(from..=to).contains(&t), E::TimeOutsideRamp { part, point })?;
            refused(!(0.0..=1.0).contains(&f), E::OpennessOutOfRange { part, point })?;
        }
        refused(span(second, first) > MOST_CROSSED * span(from, to), E::TimesCross(part))?;
    }
    let is_density = open == close && (start == open || close == end);
    let meets = |ramp: Points, at: usize| !is_density && ramp[0].0 != ramp[3].0 && ramp[at].1 != 1.0;
    refused(meets(curve.opening, 3), E::NotFullyOpen(Part::Opening))?;
    refused(meets(curve.closing, 0), E::NotFullyOpen(Part::Closing))?;
    refused(Exact::new(curve).area().hi < LEAST_EXPOSURE * length, E::DensityTooSmall)
}

/// Is this a curve that the library promises to accept?
pub fn is_valid(curve: &Curve) -> bool {
    verdict(curve).is_ok()
}

/// So many neighbours of `x` on either side, and `x`, from 0 to 1.
pub fn neighbours(x: f32, count: u32) -> impl Iterator<Item = f32> {
    let bits = x.clamp(0.0, 1.0).to_bits();
    let most = 1f32.to_bits();
    (bits.saturating_sub(count)..=(bits + count).min(most)).map(f32::from_bits)
}

/// So many neighbours of any `x` on either side, and `x`.
pub fn around(x: f32, count: usize) -> impl Iterator<Item = f32> {
    let first = (0..count).fold(x, |x, _| x.next_down());
    std::iter::successors(Some(first), |x| Some(x.next_up())).take(2 * count + 1)
}

/// The `u` most likely to break a solver on this curve, and some `fresh` random ones.
pub fn hard_us(exact: &Exact, seed: u64, fresh: usize) -> Vec<f32> {
    let mut us = vec![-0.0, 0.0, 1.0];
    let ends = [(0.0, 3), (1.0, 3), (f32::MIN_POSITIVE, 2)];
    us.extend(ends.into_iter().flat_map(|(u, count)| neighbours(u, count)));
    for exponent in 1..=149 {
        let count = if exponent <= 32 { 2 } else { 0 };
        us.extend(neighbours(exp2(-exponent) as f32, count));
        us.extend(neighbours(1.0 - exp2(-exponent.min(24)) as f32, count));
    }
    us.extend(exact.landmarks().into_iter().flat_map(|u| neighbours(u.to_f32(), 6)));
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
