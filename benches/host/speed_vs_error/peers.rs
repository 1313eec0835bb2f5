//! Further ways that are in use, written from their public descriptions, to see where each gives up.
//!
//! Two kinds: inverses of the cdf (Newton's method in several dresses, tables), and solvers of
//! `t(p) = t` as animation curves have them, which give the openness and the cdf. For the host alone.

use core::ops::{Add, Div, Mul, Sub};

use super::baseline::Ramp;

pub trait Float:
    Copy
    + PartialOrd
    + From<f32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    fn to_f32(self) -> f32;
}

impl Float for f32 {
    fn to_f32(self) -> f32 {
        self
    }
}

impl Float for f64 {
    fn to_f32(self) -> f32 {
        self as f32
    }
}

/// A ramp in powers of `p`: `t`, `f` and `∫ f t' dp`.
#[derive(Clone, Copy)]
pub struct PowerRamp<F> {
    t: [F; 4],
    f: [F; 4],
    mass: [F; 7],
}

/// The polynomial with these coefficients, the constant first, and its derivative.
pub fn horner<F: Float, const N: usize>(c: &[F; N], x: F) -> (F, F) {
    let (mut value, mut slope) = (c[N - 1], F::from(0.0));
    for &c in c[..N - 1].iter().rev() {
        slope = slope * x + value;
        value = value * x + c;
    }
    (value, slope)
}

impl<F: Float> PowerRamp<F> {
    pub fn new(points: Ramp) -> Self {
        let three = F::from(3.0);
        let powers = |v: [f32; 4]| {
            let [a, b, c, d] = v.map(F::from);
            [a, three * (b - a), three * (a - b - b + c), d - three * (c - b) - a]
        };
        let t = powers(points.map(|p| p.0));
        let f = powers(points.map(|p| p.1));
        let mut mass = [F::from(0.0); 7];
        for i in 0..4 {
            for j in 1..4 {
                let term = f[i] * t[j] * F::from(j as f32) / F::from((i + j) as f32);
                mass[i + j] = mass[i + j] + term;
            }
        }
        Self { t, f, mass }
    }

    fn time(&self, p: F) -> F {
        horner(&self.t, p).0
    }
}

/// A shutter as its three parts, in one float type; nothing is checked.
#[derive(Clone, Copy)]
pub struct Parts<F> {
    opening: PowerRamp<F>,
    closing: PowerRamp<F>,
    /// When the plateau starts and ends.
    plateau: [F; 2],
    /// The mass before the plateau, before the closing ramp, and in all.
    before: [F; 3],
}

/// What a solver found: the parameter, and after how many evaluations.
pub type Found<F> = (F, u32);

impl<F: Float> Parts<F> {
    pub fn new(opening: Ramp, closing: Ramp) -> Self {
        let plateau = [F::from(opening[3].0), F::from(closing[0].0)];
        let (opening, closing) = (PowerRamp::new(opening), PowerRamp::new(closing));
        let one = F::from(1.0);
        let first = horner(&opening.mass, one).0;
        let second = first + (plateau[1] - plateau[0]);
        let before = [first, second, second + horner(&closing.mass, one).0];
        Self { opening, closing, plateau, before }
    }

    /// The time at which the fraction `u` is collected, and the evaluations it took `solve`, which finds
    /// the `p` of a ramp with a given mass.
    #[inline]
    pub fn inverse_cdf(&self, u: f32, solve: impl Fn(&PowerRamp<F>, F) -> Found<F>) -> (f32, u32) {
        let mass = F::from(u) * self.before[2];
        let on_ramp = |ramp: &PowerRamp<F>, mass| {
            let (p, evaluations) = solve(ramp, mass);
            (ramp.time(p).to_f32(), evaluations)
        };
        if mass < self.before[0] {
            on_ramp(&self.opening, mass)
        } else if mass <= self.before[1] {
            ((self.plateau[0] + (mass - self.before[0])).to_f32(), 0)
        } else {
            on_ramp(&self.closing, mass - self.before[1])
        }
    }

    /// The openness at `t` by a solver of `t(p) = t`.
    #[inline]
    pub fn openness(&self, t: F, solve: impl Fn(&PowerRamp<F>, F) -> F) -> F {
        if t < self.plateau[0] {
            horner(&self.opening.f, solve(&self.opening, t)).0
        } else if t <= self.plateau[1] {
            F::from(1.0)
        } else {
            horner(&self.closing.f, solve(&self.closing, t)).0
        }
    }

    /// The fraction collected by `t`, by the same.
    #[inline]
    pub fn cdf(&self, t: F, solve: impl Fn(&PowerRamp<F>, F) -> F) -> F {
        let mass = if t < self.plateau[0] {
            horner(&self.opening.mass, solve(&self.opening, t)).0
        } else if t <= self.plateau[1] {
            self.before[0] + (t - self.plateau[0])
        } else {
            self.before[1] + horner(&self.closing.mass, solve(&self.closing, t)).0
        };
        mass / self.before[2]
    }
}

/// Newton's method inside a bracket, halving where it leaves it, until the residual or the bracket is
/// below an absolute 1e-6: what a renderer does for its splines.
pub fn bracketed(ramp: &PowerRamp<f32>, mass: f32) -> Found<f32> {
    let (mut low, mut high, mut p) = (0.0, 1.0, 0.5);
    for evaluations in 1..100 {
        if !(p > low && p < high) {
            p = 0.5 * (low + high);
        }
        let (value, slope) = horner(&ramp.mass, p);
        if (value - mass).abs() < 1e-6 || high - low < 1e-6 {
            return (p, evaluations);
        }
        *(if value < mass { &mut low } else { &mut high }) = p;
        p -= (value - mass) / slope;
    }
    (p, 100)
}

/// "Just use doubles": the same, as far as doubles go.
pub fn doubles(ramp: &PowerRamp<f64>, mass: f64) -> Found<f64> {
    let (mut low, mut high, mut p) = (0.0, 1.0, 0.5);
    for evaluations in 1..100 {
        if !(p > low && p < high) {
            p = 0.5 * (low + high);
        }
        let (value, slope) = horner(&ramp.mass, p);
        if (value - mass).abs() <= 1e-15 * mass || high - low < 1e-16 {
            return (p, evaluations);
        }
        *(if value < mass { &mut low } else { &mut high }) = p;
        p -= (value - mass) / slope;
    }
    (p, 100)
}

/// The inverse at `N` equally spaced `u`, and between them cubics that do not overshoot (Fritsch and
/// Carlson's).
#[derive(Clone, Copy)]
pub struct MonotoneCubicTable<const N: usize> {
    t: [f32; N],
    slope: [f32; N],
}

impl<const N: usize> MonotoneCubicTable<N> {
    pub fn new(inverse: impl Fn(f32) -> f32) -> Self {
        let t: [f32; N] = core::array::from_fn(|i| inverse(i as f32 / (N - 1) as f32));
        let chord = |i: usize| t[i + 1] - t[i];
        let slope = core::array::from_fn(|i| {
            if i == 0 {
                chord(0)
            } else if i == N - 1 {
                chord(N - 2)
            } else {
                // The harmonic mean keeps within three times either chord, and is 0 where one is.
                let (a, b) = (chord(i - 1), chord(i));
                if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 }
            }
        });
        Self { t, slope }
    }

    pub fn inverse_cdf(&self, u: f32) -> f32 {
        let place = u * (N - 1) as f32;
        let i = (place as usize).min(N - 2);
        let x = place - i as f32;
        let chord = self.t[i + 1] - self.t[i];
        let (a, b) = (self.slope[i], self.slope[i + 1]);
        self.t[i] + x * (a + x * ((3.0 * chord - 2.0 * a - b) + x * (a + b - 2.0 * chord)))
    }
}

/// The usual solver of an animation curve, for `t(p) = t`: 8 Newton steps from the time itself, then
/// bisection until the residual is below `epsilon`, relative to the ramp. [`None`] where the bisection
/// would never end.
#[inline]
pub fn animation(ramp: &PowerRamp<f32>, t: f32, epsilon: f32) -> Option<f32> {
    let x = (t - ramp.t[0]) / (ramp.t[1] + ramp.t[2] + ramp.t[3]);
    let epsilon = epsilon * (ramp.t[1] + ramp.t[2] + ramp.t[3]);
    let mut p = x;
    for _ in 0..8 {
        let (value, slope) = horner(&ramp.t, p);
        if (value - t).abs() < epsilon {
            return Some(p);
        }
        if slope.abs() < 1e-6 {
            break;
        }
        p -= (value - t) / slope;
    }
    let (mut low, mut high, mut p) = (0.0, 1.0, x);
    while low < high {
        let value = horner(&ramp.t, p).0;
        if (value - t).abs() < epsilon {
            return Some(p);
        }
        let bound = if value < t { &mut low } else { &mut high };
        if *bound == p {
            return None;
        }
        *bound = p;
        p = low + 0.5 * (high - low);
    }
    Some(p)
}
