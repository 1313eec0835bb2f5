//! A ramp: one Bezier, seen from both of its ends.

use crate::bezier::CubicBezier;
use crate::seed::{seed, seed_by_bits};
use crate::series::{Enough, Pair, Root, Seed, Series, series, solve, sum};
use crate::wide::Wide;

/// For an `f32` fraction of the mass: an eighth of the least distance between neighbours, so that these keep their order.
pub(crate) const FOR_FRACTION: Enough = Enough { error: bits(27), of_place: false, flat: bits(27) };
/// For a fraction with more bits, and a time that is to be known to 2⁻³⁸.
pub(crate) const FOR_DELAY: Enough = Enough { error: bits(37), of_place: false, flat: bits(38) };
/// For a time, whose place is asked for, since openness and mass may be steep where time is flat.
const FOR_TIME: Enough = Enough { error: bits(33), of_place: true, flat: bits(44) };

/// `2^-n`
const fn bits(n: i32) -> f32 {
    f32::from_bits(((127 - n) as u32) << 23)
}

/// The exponents of the units in which a ramp's series count: its length, its mass and the curve's greatest openness
/// count some 2¹⁰⁰, and so what is 2⁻²⁰⁰ of them keeps its bits too.
#[derive(Clone, Copy)]
pub(crate) struct Units {
    time: i32,
    openness: i32,
    mass: i32,
}

impl Units {
    #[inline(always)]
    const fn new(length: f32, openness: i32, mass: f64) -> Self {
        let length = (length.to_bits() >> 23) as i32 - 127;
        let mass = (mass.to_bits() >> 52) as i32 - 1023;
        Self { time: length - 100, openness: openness - 100, mass: mass - 100 }
    }
}

/// Everything about a ramp measured from one of its ends: `p` is 0 here and 1 at the other end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    /// The time here.
    pub(crate) time: f32,
    /// The openness here.
    openness: f32,
    /// `|t(p) - time|`
    elapsed: Series<3>,
    /// `f(p) - openness`
    gained: Series<3>,
    /// `∫ f dt` between here and `p`: the closed form of `∫ f t' dp`, of degree 6.
    mass: Series<6>,
}

impl End {
    /// The end at `P0` where `!last`, at `P3` where `last`.
    const fn new(curve: &CubicBezier, last: bool, units: Units) -> Self {
        let points = curve.points();
        let (time, openness) = if last { points[3] } else { points[0] };
        Self {
            time,
            openness,
            elapsed: series(elapsed(curve, last), units.time),
            gained: series(powers(curve.opennesses(), last), units.openness),
            mass: series(mass(curve, last), units.mass),
        }
    }

    /// The place where `mass`, in its unit, has been collected from here, the end with index `from`.
    #[inline(always)]
    const fn at_mass(
        &self,
        from: usize,
        mass: Wide,
        seed: Seed,
        units: Units,
        enough: Enough,
    ) -> Place {
        let (time, back) = (self.time, from == 1);
        let root = solve(&self.mass, mass, seed, enough);
        let (elapsed, unit) = root.value(&self.elapsed);
        let elapsed = if elapsed.is_negative() { Pair::ZERO } else { elapsed };
        Place { time, back, elapsed, unit: unit + units.time, evaluations: root.evaluations }
    }
}

/// The time elapsed since an end, by powers of `p`.
const fn elapsed(curve: &CubicBezier, last: bool) -> [f64; 3] {
    let b = powers(curve.times(), last);
    // Away from the last end time runs down; what has elapsed runs up from both.
    if last { [-b[0], -b[1], -b[2]] } else { b }
}

/// The mass since an end, by powers of `p`: the product of `f = f0 + a1 p + a2 p² + a3 p³` and
/// `t' = b1 + 2 b2 p + 3 b3 p²`, integrated.
const fn mass(curve: &CubicBezier, last: bool) -> [f64; 6] {
    let f = curve.opennesses()[if last { 3 } else { 0 }];
    let a = powers(curve.opennesses(), last);
    let b = elapsed(curve, last);
    [
        f * b[0],
        (a[0] * b[0] + 2.0 * f * b[1]) / 2.0,
        (a[1] * b[0] + 2.0 * a[0] * b[1] + 3.0 * f * b[2]) / 3.0,
        (a[2] * b[0] + 2.0 * a[1] * b[1] + 3.0 * a[0] * b[2]) / 4.0,
        (2.0 * a[2] * b[1] + 3.0 * a[1] * b[2]) / 5.0,
        a[2] * b[2] / 2.0,
    ]
}

/// `∫ f dt` over a ramp, the same for a mirrored one.
pub(crate) const fn whole_mass(curve: &CubicBezier) -> f64 {
    let (m, n) = (mass(curve, false), mass(curve, true));
    let first = m[0] + m[1] + m[2] + m[3] + m[4] + m[5];
    let last = n[0] + n[1] + n[2] + n[3] + n[4] + n[5];
    // A density that grazes 0 from below can leave a mass below 0 by rounding.
    if first + last > 0.0 { 0.5 * (first + last) } else { 0.0 }
}

/// A cubic's coefficients of `p`, `p²` and `p³`, from its Bernstein coefficients, measured from the
/// first or the last. The differences of `f32` are exact in `f64` unless their exponents lie 29 apart.
const fn powers(v: [f64; 4], last: bool) -> [f64; 3] {
    let [v0, v1, v2, v3] = if last { [v[3], v[2], v[1], v[0]] } else { v };
    [3.0 * (v1 - v0), 3.0 * ((v2 - v1) - (v1 - v0)), (v3 - v0) - 3.0 * (v2 - v1)]
}

/// A time, `time + elapsed` or, where `back`, `time - elapsed`: an exact `f32` and the way from it.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) time: f32,
    pub(crate) back: bool,
    /// In units of `2^unit`.
    elapsed: Pair,
    unit: i32,
    /// Evaluations of the mass that it took to find.
    pub(crate) evaluations: u32,
}

impl Place {
    /// An end.
    const fn at(time: f32) -> Self {
        Self { time, back: false, elapsed: Pair::ZERO, unit: 0, evaluations: 0 }
    }

    /// A place on the plateau.
    pub(crate) const fn new(time: f32, back: bool, elapsed: Wide) -> Self {
        if elapsed.is_zero() {
            return Self::at(time);
        }
        Self {
            time,
            back,
            elapsed: Pair::significand(elapsed),
            unit: elapsed.e + 63,
            evaluations: 0,
        }
    }

    pub(crate) const fn elapsed(self) -> Wide {
        self.elapsed.magnitude(self.unit)
    }

    /// The time, rounded once.
    #[inline(always)]
    pub(crate) const fn time(self) -> f32 {
        sum(self.time, self.elapsed, self.unit, self.back)
    }
}

/// One Bezier as a part of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    /// The earlier end and the later one.
    pub(crate) ends: [End; 2],
    /// `∫ f dt` over the ramp.
    pub(crate) mass: f64,
}

impl Segment {
    /// A ramp of a curve whose greatest openness is about `2^openness`.
    pub(crate) const fn new(curve: &CubicBezier, openness: i32) -> Self {
        let (first, last) = (curve.points()[0], curve.points()[3]);
        let mass = whole_mass(curve);
        let units = Units::new(last.0 - first.0, openness, mass);
        Self { ends: [End::new(curve, false, units), End::new(curve, true, units)], mass }
    }

    #[inline(always)]
    const fn units(&self, openness: i32) -> Units {
        Units::new(self.ends[1].time - self.ends[0].time, openness, self.mass)
    }

    /// An end by its index, which is 0 or 1.
    pub(crate) const fn end(&self, index: usize) -> &End {
        &self.ends[index & 1]
    }

    /// The same mass counted from the end that has less of it, where the series is steepest and the
    /// seed best; with the end's index.
    #[inline(always)]
    pub(crate) const fn nearer(&self, from: usize, mass: Wide) -> (usize, Wide) {
        let all = Wide::from_f64(self.mass);
        let half = Wide { m: all.m, e: all.e - 1 };
        if mass.exceeds(half) { (1 - from, all.minus(mass)) } else { (from, mass) }
    }

    /// The place where `mass` has been collected, counted from end `from`.
    #[inline(always)]
    pub(crate) fn at_mass(&self, from: usize, mass: Wide, enough: Enough) -> Place {
        let (from, mass) = self.nearer(from, mass);
        let (end, units) = (self.end(from), self.units(0));
        if mass.is_zero() {
            return Place::at(end.time);
        }
        let mass = mass.in_unit(units.mass);
        end.at_mass(from, mass, seed(&end.mass, mass), units, enough)
    }

    /// The same, seeded as a constant can.
    pub(crate) const fn at_mass_const(&self, from: usize, mass: Wide) -> Place {
        let (from, mass) = self.nearer(from, mass);
        let (end, units) = (self.end(from), self.units(0));
        if mass.is_zero() {
            return Place::at(end.time);
        }
        let mass = mass.in_unit(units.mass);
        end.at_mass(from, mass, seed_by_bits(&end.mass, mass), units, FOR_FRACTION)
    }

    /// The end nearer to `t`, by its index, and the way from there; `t` lies on the ramp.
    #[inline]
    pub(crate) fn at_time(&self, t: f32, openness: i32) -> OnRamp<'_> {
        let units = self.units(openness);
        let before = Wide::between(self.ends[0].time, t);
        let after = Wide::between(t, self.ends[1].time);
        let (from, elapsed) = if before.exceeds(after) { (1, after) } else { (0, before) };
        let end = self.end(from);
        let root = if elapsed.is_zero() {
            Root::START
        } else {
            let elapsed = elapsed.in_unit(units.time);
            solve(&end.elapsed, elapsed, seed(&end.elapsed, elapsed), FOR_TIME)
        };
        OnRamp { from, end, root, units }
    }
}

/// A time on a ramp, found from the nearer end.
pub(crate) struct OnRamp<'a> {
    pub(crate) from: usize,
    end: &'a End,
    root: Root,
    units: Units,
}

impl OnRamp<'_> {
    /// The openness, at least 0.
    #[inline]
    pub(crate) fn openness(&self) -> Wide {
        let (gained, unit) = self.root.value(&self.end.gained);
        let (gained, negative) =
            (gained.magnitude(unit + self.units.openness), gained.is_negative());
        let end = Wide::from_f32(self.end.openness);
        // The end itself may graze 0 from below.
        match (self.end.openness < 0.0, negative) {
            (false, false) => end.plus(gained),
            (false, true) => end.minus(gained),
            (true, false) => gained.minus(end),
            (true, true) => Wide::ZERO,
        }
    }

    /// The mass between the end and here.
    #[inline]
    pub(crate) fn mass(&self) -> Wide {
        let (mass, unit) = self.root.value(&self.end.mass);
        if mass.is_negative() { Wide::ZERO } else { mass.magnitude(unit + self.units.mass) }
    }
}
