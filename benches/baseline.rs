//! The usual ways to invert a shutter's cdf, written from their public descriptions, as baselines: Newton's method in
//! `f32` on sextics in powers of the Bezier's parameter, a table of the inverse, and square roots for straight ramps.
//!
//! The microcontroller's benchmark takes this file in by its path; hence only `core`.

/// A ramp's control points `P0..P3`, each as (t, f).
pub type Ramp = [(f32, f32); 4];

/// A ramp in powers of `p` from one of its ends, built in `f64`: the time, and the share of the exposure that is
/// collected, without its constant term, which is 0.
#[derive(Clone, Copy)]
struct Powers {
    t: [f32; 4],
    c: [f32; 6],
}

impl Powers {
    /// Of a curve with so much exposure, negative where time is counted backwards.
    fn new(ramp: Ramp, area: f64) -> Self {
        let (t, c) = sextic(ramp);
        Self { t: t.map(|t| t as f32), c: c.map(|c| (c / area) as f32) }
    }

    /// What is collected at `p`, and its slope.
    #[inline]
    fn mass(&self, p: f32) -> (f32, f32) {
        let (mut mass, mut slope) = (self.c[5], self.c[5]);
        for c in self.c[..5].iter().rev() {
            mass = mass * p + c;
            slope = slope * p + mass;
        }
        (mass * p, slope)
    }

    #[inline]
    fn time(&self, p: f32) -> f32 {
        let t = &self.t;
        t[0] + p * (t[1] + p * (t[2] + p * t[3]))
    }
}

/// A ramp's time in powers of `p`, and what is collected, without its constant term.
fn sextic(ramp: Ramp) -> ([f64; 4], [f64; 6]) {
    let powers = |values: [f32; 4]| {
        let [a, b, c, d] = values.map(f64::from);
        [a, 3.0 * (b - a), 3.0 * (a - 2.0 * b + c), d - 3.0 * c + 3.0 * b - a]
    };
    let (t, f) = (powers(ramp.map(|point| point.0)), powers(ramp.map(|point| point.1)));
    let mut c = [0.0; 6];
    for (i, f) in f.iter().enumerate() {
        for (j, t) in t.iter().enumerate().skip(1) {
            c[i + j - 1] += f * t * j as f64 / (i + j) as f64;
        }
    }
    (t, c)
}

/// Newton's method, done with care: sextics from both ends of each ramp, and the fraction counted from the curve's
/// nearer end.
#[derive(Clone, Copy)]
pub struct NearerEnd {
    /// The opening ramp, and the closing one seen from its end.
    sides: [Side; 2],
}

/// A ramp from the curve's end inwards.
#[derive(Clone, Copy)]
struct Side {
    from_outside: Powers,
    from_inside: Powers,
    /// Its share of the exposure.
    share: f32,
    /// The exposure, negative where time is counted backwards.
    area: f32,
}

impl NearerEnd {
    /// The shutter with these ramps; nothing is checked.
    pub fn new(opening: Ramp, closing: Ramp) -> Self {
        let [before, after] = [opening, closing].map(|ramp| sextic(ramp).1.iter().sum::<f64>());
        let area = before + (f64::from(closing[0].0) - f64::from(opening[3].0)) + after;
        let reversed = |[p0, p1, p2, p3]: Ramp| [p3, p2, p1, p0];
        let side = |ramp: Ramp, mass: f64, area: f64| Side {
            from_outside: Powers::new(ramp, area),
            from_inside: Powers::new(reversed(ramp), -area),
            share: (mass / area.abs()) as f32,
            area: area as f32,
        };
        Self { sides: [side(opening, before, area), side(reversed(closing), after, -area)] }
    }

    /// The time by which the fraction `u` of the exposure is collected, by this square root.
    #[inline]
    pub fn inverse_cdf(&self, u: f32, sqrt: impl Fn(f32) -> f32) -> f32 {
        let [opening, closing] = &self.sides;
        let rest = 1.0 - u;
        let (side, a) = if u < opening.share {
            (opening, u)
        } else if rest < closing.share {
            (closing, rest)
        } else {
            let (side, a) = if u < rest { (opening, u) } else { (closing, rest) };
            return side.from_inside.t[0] + (a - side.share) * side.area;
        };
        // Where a straight ramp has the answer.
        let p = sqrt(a / side.share);
        if a < 0.5 * side.share {
            Self::on_ramp(&side.from_outside, a, p)
        } else {
            Self::on_ramp(&side.from_inside, side.share - a, 1.0 - p)
        }
    }

    /// By Newton's method from `p`, in a bracket, until the residual is 3e-7 of the target; then one step more.
    #[inline]
    fn on_ramp(ramp: &Powers, target: f32, mut p: f32) -> f32 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let (mass, slope) = ramp.mass(p);
            let error = mass - target;
            *(if error < 0.0 { &mut low } else { &mut high }) = p;
            let next = p - error / slope;
            let (is_inside, is_last) = (low <= next && next <= high, error.abs() <= 3e-7 * target);
            if is_inside {
                p = next;
            } else if !is_last {
                p = 0.5 * (low + high);
            }
            if is_last {
                break;
            }
        }
        ramp.time(p)
    }
}

/// The inverse at `N` equally spaced `u` from 0 to 1, and straight lines between.
#[derive(Clone, Copy)]
pub struct InverseTable<const N: usize> {
    t: [f32; N],
}

impl<const N: usize> InverseTable<N> {
    /// The table of the inverse that `inverse` gives.
    pub fn new(inverse: impl Fn(f32) -> f32) -> Self {
        Self { t: core::array::from_fn(|i| inverse(i as f32 / (N - 1) as f32)) }
    }

    /// The time by which the fraction `u`, in [0, 1], of the exposure is collected.
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        let place = u * (N - 1) as f32;
        // The last line serves its own end too; the cast saturates.
        let i = (place as usize).min(N - 2);
        self.t[i] + (self.t[i + 1] - self.t[i]) * (place - i as f32)
    }
}

/// Ramps that are straight, from 0 to 1 and back: one square root a side, from the nearer end.
#[derive(Clone, Copy)]
pub struct StraightRamps {
    start: f32,
    end: f32,
    /// The square of a ramp's time from its end for all of the exposure: twice its length times the area.
    squares: [f32; 2],
    /// The middle of the opening ramp: there a box with the same exposure would open.
    middle: f32,
    area: f32,
    /// The fractions of the exposure at which the plateau starts and ends.
    plateau: [f32; 2],
}

impl StraightRamps {
    /// The shutter that starts to open, is open, starts to close and is closed at these times; nothing is checked.
    pub fn new([start, open, close, end]: [f32; 4]) -> Self {
        let [opening, closing] = [open - start, end - close];
        let area = (close - open) + 0.5 * (opening + closing);
        Self {
            start,
            end,
            squares: [2.0 * opening * area, 2.0 * closing * area],
            middle: 0.5 * (start + open),
            area,
            plateau: [0.5 * opening / area, 1.0 - 0.5 * closing / area],
        }
    }

    /// The time by which the fraction `u` of the exposure is collected, by this square root.
    #[inline]
    pub fn inverse_cdf(&self, u: f32, sqrt: impl Fn(f32) -> f32) -> f32 {
        if u < self.plateau[0] {
            self.start + sqrt(u * self.squares[0])
        } else if u <= self.plateau[1] {
            self.middle + u * self.area
        } else {
            self.end - sqrt((1.0 - u) * self.squares[1])
        }
    }
}
