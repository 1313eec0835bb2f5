//! A ramp: one Bezier, and the places on it from which a search starts.
//!
//! Near its end a series is as its leading term, and a root of that is a good first guess. So it is near a place inside
//! where the density nearly vanishes, if the series is taken from there: what is a flat place for a search from the end,
//! where the slope tells next to nothing, is a cube root to be taken. A density `f t'` is that flat only where `f` or `t'`
//! has a minimum, and each of these cubics and parabolas has one at most. So every search for a mass starts at one of
//! four places, the one whose mass is nearest: the two ends and the two minima. From there no more than a few steps are
//! needed. A search for a time has the nearer end and the minimum of `t'`.

use crate::bezier::{CubicBezier, sqrt};
use crate::seed::{seed, seed_by_bits};
use crate::series::{
    ONE, Pair, Seed, Series, Start, Way, around, exactly, series, single, solve, sum,
};
use crate::wide::Wide;

// How exact a search has to be: what may be missing.

/// For an `f32` fraction of the mass: an eighth of the least distance between neighbours, so that these keep their order.
pub(crate) const FOR_FRACTION: f32 = bits(27);
/// For a fraction with more bits, and a time that is to be known to 2⁻³⁸.
pub(crate) const FOR_DELAY: f32 = bits(37);
/// For a time, relative to the way, since openness and mass may be steep where time is flat.
const FOR_TIME: f32 = bits(33);

/// A slope from a quarter to half of a ramp's mean `t'`, in the ramp's units.
const SLOW: f32 = (1u128 << 75) as f32;

/// `2^-n`
const fn bits(n: i32) -> f32 {
    f32::from_bits(((127 - n) as u32) << 23)
}

/// The exponents of the units in which a ramp's series count: its length and its mass count some 2¹⁰⁰, and so what is
/// 2⁻²⁰⁰ of them keeps its bits too.
#[derive(Clone, Copy)]
struct Units {
    time: i32,
    mass: i32,
}

impl Units {
    #[inline(always)]
    const fn new(length: f32, mass: f64) -> Self {
        let length = (length.to_bits() >> 23) as i32 - 127;
        let mass = (mass.to_bits() >> 52) as i32 - 1023;
        Self { time: length - 100, mass: mass - 100 }
    }
}

/// A cubic by its power coefficients from one of its ends: `value + c[0] p + c[1] p² + c[2] p³`.
#[derive(Clone, Copy)]
struct Cubic {
    value: f64,
    c: [f64; 3],
}

impl Cubic {
    /// From its Bernstein coefficients, measured from the first or the last. The differences of `f32` are exact in `f64`
    /// unless their exponents lie 29 apart.
    const fn new(v: [f64; 4], last: bool) -> Self {
        let [v0, v1, v2, v3] = if last { [v[3], v[2], v[1], v[0]] } else { v };
        let c = [3.0 * (v1 - v0), 3.0 * ((v2 - v1) - (v1 - v0)), (v3 - v0) - 3.0 * (v2 - v1)];
        Self { value: v0, c }
    }

    /// The same measured from `p`.
    const fn from(self, p: f64) -> Self {
        let Self { value, c: [a, b, c] } = self;
        Self {
            value: value + p * (a + p * (b + p * c)),
            c: [a + p * (2.0 * b + p * 3.0 * c), b + 3.0 * p * c, c],
        }
    }

    /// Where the slope `a + 2 b p + 3 c p²` is least, or nowhere on the ramp.
    const fn least_slope(self) -> f64 {
        let [_, b, c] = self.c;
        if c > 0.0 { -b / (3.0 * c) } else { -1.0 }
    }

    /// Where it has a minimum, or nowhere on the ramp.
    const fn minimum(self) -> f64 {
        let [a, b, c] = self.c;
        let discriminant = b * b - 3.0 * a * c;
        if discriminant <= 0.0 {
            return -1.0;
        }
        // By the form that does not cancel.
        let root = sqrt(discriminant);
        if b > 0.0 { -a / (b + root) } else { (root - b) / (3.0 * c) }
    }
}

/// The mass from the place where both are measured, by powers of `p`: the product of `f = f0 + a1 p + a2 p² + a3 p³`
/// and `t' = b1 + 2 b2 p + 3 b3 p²`, integrated.
const fn mass(openness: Cubic, elapsed: [f64; 3]) -> [f64; 6] {
    let (Cubic { value: f, c: a }, b) = (openness, elapsed);
    [
        f * b[0],
        (a[0] * b[0] + 2.0 * f * b[1]) / 2.0,
        (a[1] * b[0] + 2.0 * a[0] * b[1] + 3.0 * f * b[2]) / 3.0,
        (a[2] * b[0] + 2.0 * a[1] * b[1] + 3.0 * a[0] * b[2]) / 4.0,
        (2.0 * a[2] * b[1] + 3.0 * a[1] * b[2]) / 5.0,
        a[2] * b[2] / 2.0,
    ]
}

/// The time since an end. Away from the last end time runs down; what has elapsed runs up from both.
const fn elapsed(curve: &CubicBezier, last: bool) -> Cubic {
    let t = Cubic::new(curve.times(), last);
    Cubic { value: 0.0, c: if last { [-t.c[0], -t.c[1], -t.c[2]] } else { t.c } }
}

/// The mass since an end.
const fn collected(curve: &CubicBezier, last: bool) -> [f64; 6] {
    mass(Cubic::new(curve.opennesses(), last), elapsed(curve, last).c)
}

/// `∫ f dt` over a ramp, the same for a mirrored one.
pub(crate) const fn whole_mass(curve: &CubicBezier) -> f64 {
    let (m, n) = (collected(curve, false), collected(curve, true));
    let first = m[0] + m[1] + m[2] + m[3] + m[4] + m[5];
    let last = n[0] + n[1] + n[2] + n[3] + n[4] + n[5];
    // A density that grazes 0 from below can leave a mass below 0 by rounding.
    if first + last > 0.0 { 0.5 * (first + last) } else { 0.0 }
}

/// One end of a ramp: `p` is 0 here and 1 at the other end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct End {
    /// The time here.
    pub(crate) time: f32,
    /// `|t(p) - time|`
    elapsed: Series<3>,
}

impl End {
    /// The end at `P0` where `!last`, at `P3` where `last`.
    const fn new(curve: &CubicBezier, last: bool, units: Units) -> Self {
        let time = curve.points()[if last { 3 } else { 0 }].0;
        Self { time, elapsed: series(elapsed(curve, last).c, units.time) }
    }
}

/// The mass's coefficients from some place in single precision, all but the last, whose size is the same everywhere.
type Near = [f32; 5];

/// Rounded, in units of `2^unit`.
const fn near(c: [f64; 6], unit: i32) -> Near {
    let c = single(&series(c, unit));
    [c[0], c[1], c[2], c[3], c[4]]
}

/// A place inside a ramp where `t'` or `f` has a minimum, and the density may nearly vanish.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flat {
    /// The place, from the end where the mass is counted.
    p: f32,
    /// The mass there.
    mass: Pair,
    /// The mass from there, by powers of `p`.
    c: Near,
}

impl Flat {
    const NONE: Self = Self { p: 0.0, mass: Pair::INFINITE, c: [0.0; 5] };

    const fn new(p: f64, openness: Cubic, elapsed: Cubic, series: &Series<6>, unit: i32) -> Self {
        // Nearer to an end that serves as well, and the mass, of order 6, would leave the range of a pair.
        const NEAREST: f64 = 1.0 / (1 << 20) as f64;
        if !(p > NEAREST && p < 1.0 - NEAREST) {
            return Self::NONE;
        }
        let (at, p) = (p as f32 as f64, p as f32 * ONE);
        let c = near(mass(openness.from(at), elapsed.from(at).c), unit);
        Self { p, mass: exactly(series, p), c }
    }
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
    /// Is mass counted from the later end, back in time?
    back: bool,
    /// The openness of the control points, from the end where the mass is counted.
    openness: [f32; 4],
    /// `∫ f dt` between that end and `p`: the closed form of `∫ f t' dp`, of degree 6.
    collected: Series<6>,
    /// Where `t'` has its minimum, and where `f` has.
    flats: [Flat; 2],
    /// The mass from the other end.
    other: Near,
    /// `∫ f dt` over the ramp.
    pub(crate) mass: f64,
}

impl Segment {
    /// A ramp whose mass is counted from its last end where `back`, or else from its first.
    pub(crate) const fn new(curve: &CubicBezier, back: bool) -> Self {
        let points = curve.points();
        let mass = whole_mass(curve);
        let units = Units::new(points[3].0 - points[0].0, mass);
        let collected = series(collected(curve, back), units.mass);
        let (openness, elapsed) = (Cubic::new(curve.opennesses(), back), elapsed(curve, back));
        let f = [points[0].1, points[1].1, points[2].1, points[3].1];
        Self {
            ends: [End::new(curve, false, units), End::new(curve, true, units)],
            back,
            openness: if back { [f[3], f[2], f[1], f[0]] } else { f },
            collected,
            flats: [
                Flat::new(elapsed.least_slope(), openness, elapsed, &collected, units.mass),
                Flat::new(openness.minimum(), openness, elapsed, &collected, units.mass),
            ],
            other: near(self::collected(curve, !back), units.mass),
            mass,
        }
    }

    #[inline(always)]
    const fn units(&self) -> Units {
        Units::new(self.ends[1].time - self.ends[0].time, self.mass)
    }

    /// An end by its index, which is 0 or 1.
    pub(crate) const fn end(&self, index: usize) -> &End {
        &self.ends[index & 1]
    }

    /// The known place whose mass is nearest to a target, with what is to be collected from there.
    #[inline(always)]
    const fn start(&self, target: Pair, whole: Pair) -> Start<6> {
        let (mut place, mut beyond, mut c) = (ONE, target.less(whole), &self.other);
        let mut i = 0;
        while i < 2 {
            let flat = &self.flats[i];
            let from_flat = target.less(flat.mass);
            if from_flat.abs() < beyond.abs() {
                (place, beyond, c) = (flat.p, from_flat, &flat.c);
            }
            i += 1;
        }
        if target.hi <= beyond.abs() {
            let c = single(&self.collected);
            return Start { place: 0.0, back: false, c, sought: target.hi };
        }
        let ([c1, c2, c3, c4, c5], c6) = (*c, self.collected[5].hi);
        let back = beyond < 0.0;
        let c = if !back {
            [c1, c2, c3, c4, c5, c6]
        } else if place == ONE {
            // The other end looks back already.
            [c1, c2, c3, c4, c5, -c6]
        } else {
            [c1, -c2, c3, -c4, c5, -c6]
        };
        Start { place, back, c, sought: beyond.abs() }
    }

    /// What to search for, and from where, to find the place where `mass` has been collected, counted from the later end
    /// where `late`.
    #[inline(always)]
    const fn begin(&self, late: bool, mass: Wide) -> (Pair, Start<6>) {
        let unit = self.units().mass;
        let whole = Pair::new(Wide::from_f64(self.mass).in_unit(unit));
        let mass = Pair::new(mass.in_unit(unit));
        let target = if late == self.back { mass } else { whole.minus(mass) };
        (target, self.start(target, whole))
    }

    /// The place that a search finds, within an `error` relative to `size`.
    #[inline(always)]
    const fn found(
        &self,
        target: Pair,
        start: &Start<6>,
        seed: Seed,
        size: Wide,
        error: f32,
    ) -> Place {
        let units = self.units();
        let size = size.in_unit(units.mass).power_below();
        let way = solve(&self.collected, target, start, seed, size, error);
        // From the other end the way is known better than the place.
        let other = start.place == ONE;
        let (back, way) = (self.back != other, if other { way } else { way.from(start) });
        let Way { evaluations, .. } = way;
        let end = self.end(back as usize);
        let (elapsed, unit) = way.value(&end.elapsed);
        let elapsed = if elapsed.is_negative() { Pair::ZERO } else { elapsed };
        Place { time: end.time, back, elapsed, unit: unit + units.time, evaluations }
    }

    /// The place where `mass` has been collected, counted from the later end where `late`; `size` is the curve's mass up
    /// to there, to which an error is relative.
    #[inline(always)]
    pub(crate) fn at_mass(&self, late: bool, mass: Wide, size: Wide, error: f32) -> Place {
        let (target, start) = self.begin(late, mass);
        self.found(target, &start, seed(&start.c, start.sought), size, error)
    }

    /// The same, seeded as a constant can.
    pub(crate) const fn at_mass_const(&self, late: bool, mass: Wide, size: Wide) -> Place {
        let (target, start) = self.begin(late, mass);
        let seed = seed_by_bits(&start.c, start.sought);
        self.found(target, &start, seed, size, FOR_FRACTION)
    }

    /// The end nearer to `t`, by its index, and the way from there; `t` lies on the ramp.
    #[inline]
    pub(crate) fn at_time(&self, t: f32) -> OnRamp<'_> {
        let units = self.units();
        let before = Wide::between(self.ends[0].time, t);
        let after = Wide::between(t, self.ends[1].time);
        let (from, elapsed) = if before.exceeds(after) { (1, after) } else { (0, before) };
        let series = &self.end(from).elapsed;
        if elapsed.is_zero() {
            return OnRamp { from, ramp: self, way: Way::NONE, units };
        }
        let target = Pair::new(elapsed.in_unit(units.time));
        let mut start = Start { place: 0.0, back: false, c: single(series), sought: target.hi };
        // Where `t' = c1 + 2 c2 p + 3 c3 p²` is least, if time is slow there.
        let [c1, c2, c3] = start.c;
        let place = -c2 / (3.0 * c3);
        if c3 > 0.0 && place > 0.0 && place < ONE && c1 + c2 * place < SLOW {
            let beyond = target.less(exactly(series, place));
            if beyond.abs() < target.hi {
                let (c, back) = (around(series, place), beyond < 0.0);
                let c = if back { [c[0], -c[1], c[2]] } else { c };
                start = Start { place, back, c, sought: beyond.abs() };
            }
        }
        let seed = seed(&start.c, start.sought);
        let way = solve(series, target, &start, seed, start.sought, FOR_TIME).from(&start);
        OnRamp { from, ramp: self, way, units }
    }
}

/// A time on a ramp, found from the nearer end.
pub(crate) struct OnRamp<'a> {
    from: usize,
    ramp: &'a Segment,
    way: Way,
    units: Units,
}

impl OnRamp<'_> {
    /// The openness, at least 0.
    #[inline]
    pub(crate) fn openness(&self) -> Wide {
        let [v0, v1, v2, v3] = self.ramp.openness;
        let v =
            if self.ramp.back == (self.from == 1) { [v0, v1, v2, v3] } else { [v3, v2, v1, v0] };
        let unit = exponent(&v) - 100;
        let (gained, lift) = self.way.value(&gained(v, unit));
        let (gained, negative) = (gained.magnitude(lift + unit), gained.is_negative());
        let end = Wide::from_f32(v[0]);
        // The end itself may graze 0 from below.
        match (v[0] < 0.0, negative) {
            (false, false) => end.plus(gained),
            (false, true) => end.minus(gained),
            (true, false) => gained.minus(end),
            (true, true) => Wide::ZERO,
        }
    }

    /// Is its mass counted back in time?
    pub(crate) fn back(&self) -> bool {
        self.ramp.back
    }

    /// The mass between the end where it is counted and here.
    #[inline]
    pub(crate) fn mass(&self) -> Wide {
        let way = if self.ramp.back == (self.from == 1) {
            self.way
        } else {
            self.way.from(&Start { place: ONE, back: true, c: [], sought: 0.0 })
        };
        let (mass, unit) = way.value(&self.ramp.collected);
        if mass.is_negative() { Wide::ZERO } else { mass.magnitude(unit + self.units.mass) }
    }
}

/// The exponent of the greatest magnitude.
fn exponent(v: &[f32; 4]) -> i32 {
    let most = v.iter().fold(0, |most, v| most.max(v.to_bits() << 1));
    ((most >> 24) as i32 - 127).max(-126)
}

/// A cubic less its value at the first end, by its Bernstein coefficients, in units of `2^unit`.
fn gained(v: [f32; 4], unit: i32) -> Series<3> {
    let v = v.map(|v| Pair::scaled(v, -unit));
    let (first, second, all) = (v[1].minus(v[0]), v[2].minus(v[1]), v[3].minus(v[0]));
    let c = [first.thrice(), second.minus(first).thrice(), all.minus(second.thrice())];
    let (one, two) = (1.0 / ONE, 1.0 / ONE / ONE);
    [c[0].times(one), c[1].times(two), c[2].times(one * two)]
}
