//! The curves and the `u` that the tests judge: those of `tests/data/curves.csv`, by kind; what `families` draws; and
//! the rules of what is accepted, told once more without the library.

use shutter_curve::{CubicBezier, CurveError, Part, ShutterCurve};

use super::oracle::{Curve, Exact, Points, exp2};

pub struct Named {
    pub name: &'static str,
    pub curve: Curve,
}

/// The curves of a kind: `typical` as scenes hold them; `hard` and `case`, on which solvers are known to fail, one a
/// reason; `fault`, on which a version of the crate failed; `direct`, which once had no polynomials; `edge`, on the
/// edge of a rule; and `exact`, for the tests of integers. The oracle's reference values are of the first two.
pub fn named(kind: &str) -> Vec<Named> {
    let of_kind = |row: &'static str| row.strip_prefix(kind)?.strip_prefix(',');
    let curves: Vec<_> = include_str!("../data/curves.csv").lines().filter_map(of_kind).map(read).collect();
    assert!(!curves.is_empty(), "none is {kind}");
    curves
}

fn read(row: &'static str) -> Named {
    let mut cells = row.splitn(3, ',');
    let mut ramp = || -> Points {
        let numbers: Vec<f32> = cells.next().unwrap().split(' ').map(|number| number.parse().unwrap()).collect();
        std::array::from_fn(|i| (numbers[2 * i], numbers[2 * i + 1]))
    };
    let curve = Curve::shutter(ramp(), ramp());
    Named { curve, name: cells.next().unwrap() }
}

/// This crate's curve.
pub fn shutter<const OCTAVES: usize>(curve: &Curve) -> ShutterCurve<OCTAVES> {
    let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
    ShutterCurve::with_octaves(opening, closing).expect("a good curve")
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

    pub fn sorted(&mut self) -> [f64; 2] {
        let (a, b) = (self.unit(), self.unit());
        [a.min(b), a.max(b)]
    }
}

/// A ramp seen from the curve's outer end inwards: times from 0 to 1, and openness.
pub type Shape = [(f64, f64); 4];

pub fn shape(t: [f64; 4], f: [f64; 4]) -> Shape {
    std::array::from_fn(|i| (t[i], f[i]))
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
