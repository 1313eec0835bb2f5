//! A second formulation of a curve in doubles, for arguments that move slowly: the `p` of one is the guess for the
//! next, so that a Newton step or two give the exact answer. Fast enough for every `f32`, and judged by the oracle
//! where it finds the greatest errors.

use crate::support::oracle::{Curve, Points, ulp_f32};

/// The exact inverse, cdf and openness of a curve.
pub struct Follower {
    /// The opening and the closing ramp.
    ramps: [Ramp; 2],
    pub area: f64,
    /// When the curve starts, the plateau starts and ends, and the curve ends.
    joins: [f64; 4],
    /// Where the curve runs across time 0: an ulp of the greater end, to which all errors in time are relative.
    pub across: Option<f64>,
}

impl Follower {
    pub fn new(curve: &Curve) -> Self {
        let ramps = [Ramp::new(curve.opening, false), Ramp::new(curve.closing, true)];
        let joins = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()].map(f64::from);
        let [start, open, close, end] = joins;
        let area = ramps[0].mass + ramps[1].mass + (close - open);
        let across = (start < 0.0 && end > 0.0).then(|| ulp_f32(end.max(-start)));
        Self { ramps, area, joins, across }
    }

    /// What errors at a time are relative to.
    pub fn ulp(&self, t: f64) -> f64 {
        self.across.unwrap_or_else(|| ulp_f32(t))
    }

    /// Where the fraction `u`, in (0, 1), has been collected.
    pub fn inverse(&mut self, u: f64) -> Inverse {
        let (before, after) = (u * self.area, (1.0 - u) * self.area);
        let [opening, closing] = &mut self.ramps;
        if before < opening.mass {
            opening.at_mass(before, self.area)
        } else if after < closing.mass {
            closing.at_mass(after, self.area)
        } else {
            let time = self.joins[1] + (before - opening.mass);
            Inverse { time, density: 1.0, noise: 0.0 }
        }
    }

    /// The cdf and the openness at a time.
    pub fn values(&mut self, t: f64) -> [f64; 2] {
        let [start, open, close, end] = self.joins;
        let [opening, closing] = &mut self.ramps;
        if t < start {
            [0.0, 0.0]
        } else if t > end {
            [1.0, 0.0]
        } else if t < open || (t == open && open == close && start < open) {
            let [mass, openness] = opening.at_time(t);
            [mass / self.area, openness]
        } else if t <= close && open < close {
            [(opening.mass + (t - open)) / self.area, 1.0]
        } else {
            let [mass, openness] = closing.at_time(t);
            [(self.area - mass) / self.area, openness]
        }
    }

    /// The least and the greatest openness inside the ramps, where within `reach` of `t`.
    pub fn extrema(&self, t: f64, reach: f64) -> impl Iterator<Item = f64> + '_ {
        let all = self.ramps.iter().flat_map(|ramp| &ramp.extrema);
        all.filter(move |(time, _)| (time - t).abs() <= reach).map(|(_, openness)| *openness)
    }
}

/// A time and the openness there, and how uncertain the mass is by which it was found.
pub struct Inverse {
    pub time: f64,
    pub density: f64,
    pub noise: f64,
}

struct Ramp {
    /// From the curve's end and from the plateau's.
    ends: [End; 2],
    mass: f64,
    /// The length of `ends[0]`'s half in time.
    half_way: f64,
    /// Inside: the time and the openness.
    extrema: Vec<(f64, f64)>,
}

impl Ramp {
    fn new(points: Points, is_late: bool) -> Self {
        let [a, b, c, d] = points;
        let (early, late) = (End::new(points, 1.0), End::new([d, c, b, a], -1.0));
        let extrema = early.extrema();
        let ends = if is_late { [late, early] } else { [early, late] };
        let mass = 0.5 * (ends[0].mass(1.0).0 + ends[1].mass(1.0).0);
        let half_way = ends[0].way(0.5).0;
        Self { ends, mass, half_way, extrema }
    }

    /// Where `mass` has been collected from the outer end.
    fn at_mass(&mut self, mass: f64, area: f64) -> Inverse {
        let rest = self.mass - mass;
        let is_inner = rest < mass;
        let end = &mut self.ends[usize::from(is_inner)];
        let x = end.solve(if is_inner { rest } else { mass }, End::mass);
        let noise = if is_inner { area } else { mass } * 4e-15;
        Inverse { time: end.time + end.sign * end.way(x).0, density: end.openness(x), noise }
    }

    /// The mass from the outer end to a time, and the openness there.
    fn at_time(&mut self, t: f64) -> [f64; 2] {
        let way = self.ends.each_ref().map(|end| end.sign * (t - end.time));
        let is_inner = way[0] > self.half_way;
        let end = &mut self.ends[usize::from(is_inner)];
        let x = end.solve(way[usize::from(is_inner)], End::way);
        let mass = end.mass(x).0;
        [if is_inner { self.mass - mass } else { mass }, end.openness(x)]
    }
}

/// A ramp in powers of the `x` that counts from one of its ends.
struct End {
    time: f64,
    /// Whether the ramp lies after this end, 1, or before it, -1.
    sign: f64,
    /// The way in time and the mass from here; the openness.
    way: [f64; 4],
    mass: [f64; 7],
    openness: [f64; 4],
    /// Where the last answer was.
    x: f64,
}

impl End {
    fn new(points: Points, sign: f64) -> Self {
        let powers = |first: f64, d: [f64; 3]| [first, 3.0 * d[0], 3.0 * (d[1] - d[0]), d[2] - 2.0 * d[1] + d[0]];
        let steps = |x: [f64; 4]| [x[1] - x[0], x[2] - x[1], x[3] - x[2]];
        let (t, f) = (points.map(|p| f64::from(p.0)), points.map(|p| f64::from(p.1)));
        let way = powers(0.0, steps(t).map(|d| sign * d));
        let openness = powers(f[0], steps(f));
        let mut mass = [0.0; 7];
        for i in 0..4 {
            for j in 1..4 {
                mass[i + j] += openness[i] * way[j] * j as f64 / (i + j) as f64;
            }
        }
        Self { time: t[0], sign, way, mass, openness, x: 0.5 }
    }

    fn way(&self, x: f64) -> (f64, f64) {
        horner(&self.way, x)
    }

    fn mass(&self, x: f64) -> (f64, f64) {
        horner(&self.mass, x)
    }

    fn openness(&self, x: f64) -> f64 {
        horner(&self.openness, x).0
    }

    /// The `x` where one of the two above reaches `target`.
    fn solve(&mut self, target: f64, of: impl Fn(&Self, f64) -> (f64, f64)) -> f64 {
        if target <= 0.0 {
            return 0.0;
        }
        let mut x = self.x;
        let mut steps = 0;
        loop {
            let (value, slope) = of(self, x);
            let step = (target - value) / slope;
            x += step;
            // The square of a step this small is beyond a double.
            if step.abs() <= 1e-8 * x && x <= 1.0 {
                break;
            }
            steps += 1;
            if steps > 20 || !(x > 0.0 && x <= 1.0) {
                x = bisect(|x| of(self, x).0 < target);
                break;
            }
        }
        self.x = x;
        x
    }

    /// Where the openness has a minimum or a maximum inside: its time and itself.
    fn extrema(&self) -> Vec<(f64, f64)> {
        let [_, a, b, c] = self.openness;
        let (b, c) = (2.0 * b, 3.0 * c);
        let q = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
        let inside = [q / c, a / q].into_iter().filter(|x| *x > 0.0 && *x < 1.0);
        inside.map(|x| (self.time + self.sign * self.way(x).0, self.openness(x))).collect()
    }
}

/// The first double in [0, 1] that is not below, by the middle of the bit patterns, which halves exponents first.
fn bisect(is_below: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0f64, 1.0f64);
    while high.to_bits() - low.to_bits() > 1 {
        let middle = f64::from_bits((low.to_bits() + high.to_bits()) / 2);
        *(if is_below(middle) { &mut low } else { &mut high }) = middle;
    }
    high
}

/// The polynomial with these coefficients, the constant first, and its derivative.
fn horner<const N: usize>(c: &[f64; N], x: f64) -> (f64, f64) {
    c.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}
