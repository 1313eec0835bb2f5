//! A ramp: one Bezier, seen from both of its ends.

use crate::bezier::CubicBezier;
use crate::seed::{seed, seed_by_bits, seed_from};
use crate::series::{Coefficient, Enough, Root, Seed, Series, solve};
use crate::wide::{Wide, sum};

/// For the mass, in a flat place, an eighth of the least distance between neighbouring `u`, so that these
/// keep their order.
const MASS_ENOUGH: Enough =
    Enough { near: bits(10), slope: bits(-1), flat: bits(27), middle: false };
/// For the time all the bits there are, since openness and mass may be steep where time is flat.
const TIME_ENOUGH: Enough =
    Enough { near: bits(23), slope: bits(12), flat: bits(60), middle: true };

/// `2^-n`
const fn bits(n: i32) -> f32 {
    f32::from_bits(((127 - n) as u32) << 23)
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
    const fn new(curve: &CubicBezier, last: bool) -> (Self, f64) {
        let points = curve.points();
        let (time, openness) = if last { points[3] } else { points[0] };
        let b = powers(curve.times(), last);
        let a = powers(curve.opennesses(), last);
        // Away from the last end time runs down; what has elapsed runs up from both.
        let sign = if last { -1.0 } else { 1.0 };
        let b = [sign * b[0], sign * b[1], sign * b[2]];
        let f = openness as f64;
        // The product of f = f0 + a1 p + a2 p² + a3 p³ and t' = b1 + 2 b2 p + 3 b3 p², integrated.
        let m = [
            f * b[0],
            (a[0] * b[0] + 2.0 * f * b[1]) / 2.0,
            (a[1] * b[0] + 2.0 * a[0] * b[1] + 3.0 * f * b[2]) / 3.0,
            (a[2] * b[0] + 2.0 * a[1] * b[1] + 3.0 * a[0] * b[2]) / 4.0,
            (2.0 * a[2] * b[1] + 3.0 * a[1] * b[2]) / 5.0,
            a[2] * b[2] / 2.0,
        ];
        let total = m[0] + m[1] + m[2] + m[3] + m[4] + m[5];
        let end = Self { time, openness, elapsed: cubic(b), gained: cubic(a), mass: sextic(m) };
        (end, total)
    }

    /// The place where `mass` has been collected from here, the end with index `from`.
    #[inline(always)]
    const fn at_mass(&self, from: usize, mass: Wide, seed: Seed) -> Place {
        let (time, back) = (self.time, from == 1);
        if mass.is_zero() {
            return Place { time, back, elapsed: 0, unit: 0, evaluations: 0 };
        }
        let root = solve(&self.mass, mass, seed, MASS_ENOUGH);
        let (elapsed, unit) = root.value(&self.elapsed);
        let elapsed = if elapsed < 0 { 0 } else { elapsed as u64 };
        Place { time, back, elapsed, unit, evaluations: root.evaluations }
    }
}

/// A cubic's coefficients of `p`, `p²` and `p³`, from its Bernstein coefficients, measured from the
/// first or the last. The differences of `f32` are exact in `f64` unless their exponents lie 29 apart.
const fn powers(v: [f64; 4], last: bool) -> [f64; 3] {
    let [v0, v1, v2, v3] = if last { [v[3], v[2], v[1], v[0]] } else { v };
    [3.0 * (v1 - v0), 3.0 * ((v2 - v1) - (v1 - v0)), (v3 - v0) - 3.0 * (v2 - v1)]
}

const fn cubic(c: [f64; 3]) -> Series<3> {
    [Coefficient::new(c[0]), Coefficient::new(c[1]), Coefficient::new(c[2])]
}

const fn sextic(c: [f64; 6]) -> Series<6> {
    let [c1, c2, c3, c4, c5, c6] = c;
    let ([c1, c2, c3], [c4, c5, c6]) = (cubic([c1, c2, c3]), cubic([c4, c5, c6]));
    [c1, c2, c3, c4, c5, c6]
}

/// A time, `time + elapsed` or, where `back`, `time - elapsed`: an exact `f32` and the way from it.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) time: f32,
    pub(crate) back: bool,
    /// In units of `2^unit`.
    elapsed: u64,
    unit: i32,
    /// Evaluations of the mass that it took to find.
    pub(crate) evaluations: u32,
}

impl Place {
    /// A place on the plateau.
    pub(crate) const fn new(time: f32, back: bool, elapsed: Wide) -> Self {
        let Wide { m, e } = elapsed;
        // Two bits of room.
        Self { time, back, elapsed: m >> 2, unit: e + 2, evaluations: 0 }
    }

    pub(crate) const fn elapsed(self) -> Wide {
        Wide::new(self.elapsed, self.unit)
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
    pub(crate) const fn new(curve: &CubicBezier) -> Self {
        let (first, mass) = End::new(curve, false);
        let (last, again) = End::new(curve, true);
        // The mean is the same from both ends, and so for a mirrored ramp. A density that grazes 0 from
        // below can leave a mass below 0 by rounding.
        let mass = 0.5 * (mass + again);
        Self { ends: [first, last], mass: if mass > 0.0 { mass } else { 0.0 } }
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

    /// The place where `mass` has been collected, counted from end `from`, which may be about `guess`, in
    /// units of 2⁻¹⁸, from there.
    #[inline(always)]
    pub(crate) fn at_mass(&self, from: usize, mass: Wide, guess: impl FnOnce() -> i32) -> Place {
        let (near, mass) = self.nearer(from, mass);
        let end = self.end(near);
        let guess = guess();
        let guess = if near == from { guess } else { (1 << 18) - guess };
        // Less than 2⁻⁸ is not a guess to rely on.
        let seed = if guess > 1 << 10 && guess < 1 << 18 {
            seed_from(guess)
        } else {
            seed(&end.mass, mass)
        };
        end.at_mass(near, mass, seed)
    }

    /// The same, seeded as a constant can.
    pub(crate) const fn at_mass_const(&self, from: usize, mass: Wide) -> Place {
        let (near, mass) = self.nearer(from, mass);
        let end = self.end(near);
        end.at_mass(near, mass, seed_by_bits(&end.mass, mass))
    }

    /// How far into the ramp that is, from end `from`.
    pub(crate) const fn fraction(&self, from: usize, mass: Wide) -> f64 {
        let (near, mass) = self.nearer(from, mass);
        if mass.is_zero() {
            return if near == from { 0.0 } else { 1.0 };
        }
        let series = &self.end(near).mass;
        let p = solve(series, mass, seed_by_bits(series, mass), MASS_ENOUGH).place();
        if near == from { p } else { 1.0 - p }
    }

    /// The end nearer to `t`, by its index, and the way from there; `t` lies on the ramp.
    #[inline]
    pub(crate) fn at_time(&self, t: f32) -> OnRamp<'_> {
        let before = Wide::between(self.ends[0].time, t);
        let after = Wide::between(t, self.ends[1].time);
        let (from, elapsed) = if before.exceeds(after) { (1, after) } else { (0, before) };
        let end = self.end(from);
        let root = if elapsed.is_zero() {
            Root::START
        } else {
            solve(&end.elapsed, elapsed, seed(&end.elapsed, elapsed), TIME_ENOUGH)
        };
        OnRamp { from, end, root }
    }
}

/// A time on a ramp, found from the nearer end.
pub(crate) struct OnRamp<'a> {
    pub(crate) from: usize,
    end: &'a End,
    root: Root,
}

impl OnRamp<'_> {
    /// The openness, at least 0.
    #[inline]
    pub(crate) fn openness(&self) -> Wide {
        let (gained, unit) = self.root.value(&self.end.gained);
        let (gained, negative) = (Wide::new(gained.unsigned_abs(), unit), gained < 0);
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
        if mass < 0 { Wide::ZERO } else { Wide::new(mass as u64, unit) }
    }
}
