//! The tests' oracle: a shutter curve, its cdf and its inverse in double-double arithmetic.
//!
//! It shares no code with the library and takes the `f32` inputs as exact numbers. Every ramp is expanded in powers of
//! the distance `x` from each of its two ends, so that times, openness and mass near an end are accurate relative to
//! their distance from it, however flat the curve is there.

pub mod dd;

pub use dd::{Dd, exp2};

/// A cubic Bezier's control points as (time, openness).
pub type Points = [(f32, f32); 4];

/// Opening ramp, plateau with openness 1, closing ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    pub opening: Points,
    pub closing: Points,
}

impl Curve {
    pub fn shutter(opening: Points, closing: Points) -> Self {
        Self { opening, closing }
    }

    /// An opening ramp with nothing after it.
    pub fn single(points: Points) -> Self {
        Self::shutter(points, [(points[3].0, 0.0); 4])
    }

    /// The curve run backwards: its times negated.
    pub fn mirrored(&self) -> Self {
        let mirror = |points: Points| {
            let [a, b, c, d] = points.map(|(t, f)| (-t, f));
            [d, c, b, a]
        };
        Self::shutter(mirror(self.closing), mirror(self.opening))
    }

    pub fn open_start(&self) -> f32 {
        self.opening[0].0
    }

    pub fn open_end(&self) -> f32 {
        self.opening[3].0
    }

    pub fn close_start(&self) -> f32 {
        self.closing[0].0
    }

    pub fn close_end(&self) -> f32 {
        self.closing[3].0
    }
}

/// `c[0] x + c[1] x² + ...`, zero at the end from which `x` counts.
#[derive(Clone, Copy, Debug)]
struct Poly<const N: usize> {
    c: [Dd; N],
}

impl<const N: usize> Poly<N> {
    #[inline]
    fn at(&self, x: Dd) -> Dd {
        self.c.iter().rev().fold(Dd::ZERO, |sum, &c| (sum + c) * x)
    }

    /// In `f64`: the value and the slope.
    #[inline]
    fn approx(&self, x: f64) -> [f64; 2] {
        let [mut value, mut slope] = [0.0; 2];
        for c in self.c.iter().rev() {
            slope = slope * x + value;
            value = value * x + c.hi;
        }
        // The sums so far are those of value / x.
        [value * x, slope * x + value]
    }

    /// A bound on the rounding error of [`at`](Self::at).
    fn noise(&self, x: f64) -> f64 {
        let size = self.c.iter().rev().fold(0.0, |sum, c| (sum + c.hi.abs()) * x);
        size * f64::EPSILON * f64::EPSILON * 4.0
    }

    /// The `x` in [0, 1] where the polynomial, which does not fall but for rounding, reaches `target`.
    fn solve(&self, target: Dd) -> Dd {
        if target.hi <= 0.0 {
            return Dd::ZERO;
        }
        // In `f64`, by halves of what its bits count, as x is rarely of a low power of two; ...
        let (mut below, mut above) = (exp2(-256).to_bits(), 1f64.to_bits());
        while above - below > 1 << 30 {
            let middle = (below + above) / 2;
            let is_below = self.approx(f64::from_bits(middle))[0] < target.hi;
            *(if is_below { &mut below } else { &mut above }) = middle;
        }
        // ... then Newton's steps inside a bracket of all: rounding may have misled the halves.
        let (mut low, mut high, mut x) = (Dd::ZERO, Dd::ONE, Dd::from(f64::from_bits(above)));
        for iteration in 0..400 {
            let rest = target - self.at(x);
            if rest.hi == 0.0 || iteration > 8 && rest.hi.abs() <= self.noise(x.hi) {
                break;
            }
            *(if rest.hi > 0.0 { &mut low } else { &mut high }) = x;
            let step = rest.hi / self.approx(x.hi)[1];
            let next = x + Dd::from(step);
            let is_inside = next > low && next < high;
            let is_last = is_inside && step.abs() <= exp2(-80) * x.hi || (high - low).hi <= exp2(-103) * x.hi;
            x = if is_inside { next } else { (low + high).scale(0.5) };
            if is_last {
                break;
            }
        }
        x
    }
}

/// A ramp expanded at one of its ends; `x` runs from there to 1 at the other.
#[derive(Clone, Copy, Debug)]
struct End {
    /// Time and openness at the end.
    time: f64,
    openness: f64,
    /// +1 if the ramp lies after this end, -1 if before.
    sign: f64,
    /// The time between the end and x, the rise of openness, and the mass between.
    way: Poly<3>,
    rise: Poly<3>,
    mass: Poly<6>,
    /// `way` and `mass` at x = 1/2.
    half_way: Dd,
    half_mass: Dd,
}

impl End {
    fn new(points: Points, sign: f64) -> Self {
        let (t, f) = (points.map(|p| Dd::from(p.0)), points.map(|p| Dd::from(p.1)));
        let way = cubic([t[1] - t[0], t[2] - t[1], t[3] - t[2]].map(|d| d.scale(sign)));
        let rise = cubic([f[1] - f[0], f[2] - f[1], f[3] - f[2]]);
        let openness = [f[0], rise[0], rise[1], rise[2]];
        let mut mass = [Dd::ZERO; 6];
        for (i, &f) in openness.iter().enumerate() {
            for (j, &t) in way.iter().enumerate() {
                mass[i + j] = mass[i + j] + f * (t * (j + 1) as f64);
            }
        }
        for (i, c) in mass.iter_mut().enumerate() {
            *c = *c / Dd::from((i + 1) as f64);
        }
        let (way, rise, mass) = (Poly { c: way }, Poly { c: rise }, Poly { c: mass });
        let half = Dd::from(0.5);
        Self {
            time: t[0].hi,
            openness: f[0].hi,
            sign,
            way,
            rise,
            mass,
            half_way: way.at(half),
            half_mass: mass.at(half),
        }
    }
}

/// A cubic Bezier in powers of x, without the constant, from the differences of its control values.
fn cubic(d: [Dd; 3]) -> [Dd; 3] {
    let second = [d[1] - d[0], d[2] - d[1]];
    [d[0] * 3.0, second[0] * 3.0, second[1] - second[0]]
}

#[derive(Clone, Debug)]
struct Ramp {
    ends: [End; 2],
    mass: Dd,
}

/// A place on a ramp: the end from which it counts, and the distance.
#[derive(Clone, Copy)]
struct Spot {
    end: usize,
    x: Dd,
}

impl Ramp {
    fn new(points: Points) -> Self {
        let [a, b, c, d] = points;
        let ends = [End::new(points, 1.0), End::new([d, c, b, a], -1.0)];
        let mass = ends[0].mass.at(Dd::ONE);
        Self { ends, mass }
    }

    fn is_empty(&self) -> bool {
        self.ends[0].time == self.ends[1].time
    }

    fn spot(&self, p: f64) -> Spot {
        let end = (p > 0.5) as usize;
        Spot { end, x: Dd::from(if end == 0 { p } else { 1.0 - p }) }
    }

    fn at_mass(&self, end: usize, mass: Dd) -> Spot {
        if mass <= self.ends[end].half_mass {
            return Spot { end, x: self.ends[end].mass.solve(mass) };
        }
        let end = 1 - end;
        Spot { end, x: self.ends[end].mass.solve(self.mass - mass) }
    }

    fn at_time(&self, t: Dd) -> Spot {
        let way = [t - Dd::from(self.ends[0].time), Dd::from(self.ends[1].time) - t];
        let end = (way[0] > self.ends[0].half_way) as usize;
        Spot { end, x: self.ends[end].way.solve(way[end]) }
    }

    /// The masses before and after.
    fn masses(&self, spot: Spot) -> [Dd; 2] {
        let mass = self.ends[spot.end].mass.at(spot.x);
        let other = self.mass - mass;
        if spot.end == 0 { [mass, other] } else { [other, mass] }
    }

    fn time(&self, spot: Spot) -> Dd {
        let end = &self.ends[spot.end];
        Dd::from(end.time) + end.way.at(spot.x).scale(end.sign)
    }

    fn openness(&self, spot: Spot) -> Dd {
        let end = &self.ends[spot.end];
        Dd::from(end.openness) + end.rise.at(spot.x)
    }

    /// The parameters of the interior extrema of f.
    fn extrema_of_openness(&self) -> Vec<f64> {
        let rise = &self.ends[0].rise.c;
        let mut points = roots(rise[0].hi, 2.0 * rise[1].hi, 3.0 * rise[2].hi);
        points.retain(|p| *p > 0.0 && *p < 1.0);
        points
    }

    /// Time and openness at both ends and at the extrema of f between.
    fn turns(&self) -> Vec<[Dd; 2]> {
        let ends = self.ends.map(|end| [Dd::from(end.time), Dd::from(end.openness)]);
        let inside = self.extrema_of_openness().into_iter().map(|p| self.spot(p));
        let inside = inside.map(|spot| [self.time(spot), self.openness(spot)]);
        ends.into_iter().chain(inside).collect()
    }

    /// The interior extrema of f and t', and the middles of the ramp's parameter, mass and time.
    fn spots(&self) -> Vec<Spot> {
        if self.is_empty() {
            return Vec::new();
        }
        let way = &self.ends[0].way.c;
        let slowest = -way[1].hi / (3.0 * way[2].hi);
        let mut points = self.extrema_of_openness();
        points.extend(Some(slowest).filter(|p| *p > 0.0 && *p < 1.0));
        let mut spots: Vec<Spot> = points.into_iter().chain([0.5]).map(|p| self.spot(p)).collect();
        let middle = Dd::from(0.5 * (self.ends[0].time + self.ends[1].time));
        spots.extend([self.at_mass(0, self.mass.scale(0.5)), self.at_time(middle)]);
        spots
    }
}

/// The real roots of `a + b x + c x²`.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return Vec::new();
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    [q / c, a / q].into_iter().filter(|x| x.is_finite()).collect()
}

/// What an answer `t` to a question `u` is off by.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// In ulp of the exact time.
    pub forward: f64,
    /// How many ulp `u` must move for the time to round to the answer.
    pub backward: f64,
}

/// A curve with all that does not depend on `u` and `t`.
#[derive(Clone, Debug)]
pub struct Exact {
    curve: Curve,
    opening: Ramp,
    closing: Ramp,
    plateau: Dd,
    area: Dd,
    /// Time and openness of what is greatest or least on a ramp.
    turns: Vec<[Dd; 2]>,
}

impl Exact {
    pub fn new(curve: &Curve) -> Self {
        let [opening, closing] = [curve.opening, curve.closing].map(Ramp::new);
        let plateau = Dd::from(curve.close_start()) - Dd::from(curve.open_end());
        let area = opening.mass + plateau + closing.mass;
        let ramps = [&opening, &closing].into_iter().filter(|ramp| !ramp.is_empty());
        let turns = ramps.flat_map(Ramp::turns).collect();
        Self { curve: *curve, opening, closing, plateau, area, turns }
    }

    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// `∫ f dt`; on a shutter the exposure.
    pub fn area(&self) -> Dd {
        self.area
    }

    pub fn normalization(&self) -> Dd {
        Dd::ONE / self.area
    }

    pub fn efficiency(&self) -> Dd {
        self.area / (Dd::from(self.curve.close_end()) - Dd::from(self.curve.open_start()))
    }

    /// The exact time for `u`; as documented, `u` is clamped to [0, 1] and NaN counts as 0.
    pub fn inverse_cdf(&self, u: f32) -> Dd {
        self.inverse_cdf_dd(Dd::from(clamped(u)))
    }

    /// `u` in [0, 1]. Where there is no density over a stretch, it is one of the right times.
    pub fn inverse_cdf_dd(&self, u: Dd) -> Dd {
        let curve = &self.curve;
        if u <= Dd::ZERO {
            return Dd::from(curve.open_start());
        }
        if u >= Dd::ONE {
            return Dd::from(curve.close_end());
        }
        // From the nearer end of the whole, through the sections that lie on the way.
        let (side, part) = if u.hi <= 0.5 { (0, u) } else { (1, Dd::ONE - u) };
        let ramps = [&self.opening, &self.closing];
        let (near, far) = (ramps[side], ramps[1 - side]);
        let mass = part * self.area;
        let beyond = mass - near.mass;
        if beyond < Dd::ZERO {
            near.time(near.at_mass(side, mass))
        } else if beyond <= self.plateau && self.plateau > Dd::ZERO {
            Dd::from(near.ends[1 - side].time) + beyond.scale(near.ends[side].sign)
        } else {
            far.time(far.at_mass(side, beyond - self.plateau))
        }
    }

    /// The fraction of the exposure collected by `t`.
    pub fn cdf(&self, t: impl Into<Dd>) -> Dd {
        self.at(t.into())[0] / self.area
    }

    /// `1 - cdf`, relatively accurate at the later end.
    pub fn complement_dd(&self, t: Dd) -> Dd {
        self.at(t)[1] / self.area
    }

    /// The openness at `t`: 0 outside the interval.
    pub fn openness(&self, t: impl Into<Dd>) -> Dd {
        self.at(t.into())[2]
    }

    /// The masses before and after `t`, and the openness there.
    fn at(&self, t: Dd) -> [Dd; 3] {
        let curve = &self.curve;
        let [start, open, close, end] =
            [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()].map(Dd::from);
        // Where two ramps meet, it is on the opening one, if that has a length.
        let opens = t < open || t == open && open == close && !self.opening.is_empty();
        if t < start {
            [Dd::ZERO, self.area, Dd::ZERO]
        } else if t > end {
            [self.area, Dd::ZERO, Dd::ZERO]
        } else if !opens && t <= close && open < close {
            [self.opening.mass + (t - open), self.closing.mass + (close - t), Dd::ONE]
        } else {
            let ramp = if opens { &self.opening } else { &self.closing };
            let spot = ramp.at_time(t);
            let ([before, after], openness) = (ramp.masses(spot), ramp.openness(spot));
            if opens {
                [before, self.closing.mass + self.plateau + after, openness]
            } else {
                [self.opening.mass + self.plateau + before, after, openness]
            }
        }
    }

    pub fn pdf(&self, t: impl Into<Dd>) -> Dd {
        self.openness(t) / self.area
    }

    /// The forward and the backward error of the answer `t` to `u`.
    pub fn judge(&self, u: f32, t: f32) -> Errors {
        self.judge_for(u, t, self.inverse_cdf(u))
    }

    /// The same where the exact time is known already, for several answers to one question.
    pub fn judge_for(&self, u: f32, t: f32, exact: Dd) -> Errors {
        let [low, high] = rounding_cell(t).map(Dd::from);
        let backward = if !self.is_inside(t) {
            f64::INFINITY
        } else if exact >= low && exact <= high {
            0.0
        } else {
            let u = Dd::from(clamped(u));
            let miss = (self.cdf(low) - u).max(u - self.cdf(high)).max(Dd::ZERO);
            miss.hi / ulp_f32(u.hi)
        };
        Errors { forward: self.forward_ulp(t, exact), backward }
    }

    fn is_inside(&self, t: f32) -> bool {
        t >= self.curve.open_start() && t <= self.curve.close_end()
    }

    /// `|t - exact|` in ulp of the exact time, or of the greater end where the curve runs across time 0.
    /// Infinite if `t` lies outside the interval or is NaN.
    pub fn forward_ulp(&self, t: f32, exact: Dd) -> f64 {
        if !self.is_inside(t) {
            return f64::INFINITY;
        }
        let (start, end) = (self.curve.open_start() as f64, self.curve.close_end() as f64);
        let size = if start < 0.0 && end > 0.0 { end.max(-start) } else { exact.hi };
        (Dd::from(t) - exact).hi.abs() / ulp_f32(size)
    }

    /// What the curve takes on around a time, to judge several answers by.
    pub fn near(&self, t: f32) -> Near<'_> {
        let interval = Dd::from(self.curve.close_end()) - Dd::from(self.curve.open_start());
        let reach = ulp_f32(f64::from(t)).max(interval.hi * exp2(-53));
        let values = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|part| {
            let [before, _, openness] = self.at(Dd::from(t) + part * reach);
            [before / self.area, openness]
        });
        Near { exact: self, t, reach, values }
    }

    /// The u at which something changes: first the joins, then where the density or t' has an interior minimum or
    /// maximum, and the middles of ramps.
    pub fn landmarks(&self) -> Vec<Dd> {
        let mut masses = vec![self.opening.mass, self.opening.mass + self.plateau];
        let ramps = [(&self.opening, Dd::ZERO), (&self.closing, masses[1])];
        for (ramp, before) in ramps {
            masses.extend(ramp.spots().into_iter().map(|spot| before + ramp.masses(spot)[0]));
        }
        masses.into_iter().map(|mass| mass / self.area).collect()
    }

    /// The times of the ends and the joins, of 1/2, and of the other [`landmarks`](Self::landmarks).
    pub fn landmark_times(&self) -> Vec<Dd> {
        let curve = &self.curve;
        let joins = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()];
        let mut times = joins.map(Dd::from).to_vec();
        times.push(self.inverse_cdf(0.5));
        for ramp in [&self.opening, &self.closing] {
            times.extend(ramp.spots().into_iter().map(|spot| ramp.time(spot)));
        }
        times
    }
}

/// The cdf and the openness at five times within an ulp of one, or within 2⁻⁵³ of the interval where that is more.
pub struct Near<'a> {
    exact: &'a Exact,
    t: f32,
    reach: f64,
    values: [[Dd; 2]; 5],
}

impl Near<'_> {
    /// The error of a cdf of `got`, see [`value_ulp`]; an ulp is at least that of `floor`.
    pub fn cdf_ulp(&self, got: f32, floor: f64) -> f64 {
        value_ulp(got, self.values.iter().map(|[cdf, _]| *cdf), |value| ulp_f32(value.max(floor)))
    }

    /// The error of an openness of `got`, see [`value_ulp`]; an ulp is at least `floor`.
    pub fn openness_ulp(&self, got: f32, floor: f64) -> f64 {
        self.density_ulp(got, Dd::ONE, floor)
    }

    /// The same of a pdf; an ulp is at least `floor` over the exposure.
    pub fn pdf_ulp(&self, got: f32, floor: f64) -> f64 {
        self.density_ulp(got, self.exact.normalization(), floor)
    }

    fn density_ulp(&self, got: f32, scale: Dd, floor: f64) -> f64 {
        // Between two samples the openness may have an extremum, or a ramp its end.
        let is_near = |turn: &&[Dd; 2]| (turn[0] - Dd::from(self.t)).hi.abs() <= self.reach;
        let turns = self.exact.turns.iter().filter(is_near);
        let values = self.values.iter().chain(turns).map(|[_, openness]| *openness * scale);
        value_ulp(got, values, |value| ulp_f32(value).max(floor * scale.hi))
    }
}

fn clamped(u: f32) -> f32 {
    if u > 0.0 { u.min(1.0) } else { 0.0 }
}

/// The spacing of `f32` at the magnitude of `x`; below the normal numbers it is that of the subnormal.
pub fn ulp_f32(x: f64) -> f64 {
    let exponent = ((x.to_bits() >> 52) & 0x7FF) as i32 - 1023;
    exp2(exponent.max(-126) - 23)
}

/// The closed interval of what rounds to `t`: from the middle to its lower neighbour to the middle to
/// its upper one.
pub fn rounding_cell(t: f32) -> [f64; 2] {
    [t.next_down(), t.next_up()].map(|neighbour| 0.5 * (neighbour as f64 + t as f64))
}

/// How far `got` is, in ulp, from the least and the greatest of `values`.
///
/// These are what a function takes on in a neighbourhood; without a jump it takes every value in between, too.
/// Infinite if `got` is no number.
pub fn value_ulp(got: f32, values: impl Iterator<Item = Dd>, ulp: impl Fn(f64) -> f64) -> f64 {
    let got = got as f64;
    let (least, most) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(value.hi), most.max(value.hi)));
    if !got.is_finite() {
        f64::INFINITY
    } else if got < least {
        (least - got) / ulp(least)
    } else {
        ((got - most) / ulp(most)).max(0.0)
    }
}
