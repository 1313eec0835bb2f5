//! The usual ways to invert a shutter's cdf, written from their public descriptions, as baselines: Newton's method in
//! `f32` on sextics in powers of the Bezier's parameter, a table of the inverse, and square roots for straight ramps.
//!
//! The microcontroller's benchmark takes this file in by its path; hence only `core`.

/// A ramp's control points `P0..P3`, each as (t, f).
pub type Ramp = [(f32, f32); 4];

/// A curve's normalised integral as three parts, each inverted on its own, all in `f32`.
///
/// Newton's method starts from 0.5 and takes at most 10 steps, or stops where `|K F(p) - u|` is at most
/// 1e-6; failing that, 21 bisections. The plateau's formula is the right one (the description has a slip).
#[derive(Clone, Copy)]
pub struct TextbookNewton {
    opening: Sextic,
    closing: Sextic,
    open_end: f32,
    close_start: f32,
    /// `1/K`
    area: f32,
    /// The fractions of the exposure at which the plateau starts and ends.
    plateau: [f32; 2],
}

impl TextbookNewton {
    /// The shutter with these ramps; nothing is checked.
    pub const fn new(opening: Ramp, closing: Ramp) -> Self {
        let (open_end, close_start) = (opening[3].0, closing[0].0);
        let (opening, closing) = (Sextic::new(opening), Sextic::new(closing));
        let (before, length) = (opening.mass(1.0), close_start - open_end);
        let area = before + length + closing.mass(1.0);
        Self {
            opening: opening.scaled(1.0 / area),
            closing: closing.scaled(1.0 / area),
            open_end,
            close_start,
            area,
            plateau: [before / area, (before + length) / area],
        }
    }

    /// The time by which the fraction `u` of the exposure is collected.
    pub fn inverse_cdf(&self, u: f32) -> f32 {
        self.solve(u).0
    }

    /// That time, and how often the sextic was evaluated for it.
    #[inline]
    pub fn solve(&self, u: f32) -> (f32, u32) {
        let [start, end] = self.plateau;
        let on_ramp = |ramp: &Sextic, u| {
            let (p, evaluations) = ramp.solve(u);
            (ramp.time(p), evaluations)
        };
        if u < start {
            on_ramp(&self.opening, u)
        } else if u <= end {
            let t = self.open_end + (u - start) * self.area;
            (if t < self.close_start { t } else { self.close_start }, 0)
        } else {
            on_ramp(&self.closing, u - end)
        }
    }
}

/// A ramp in powers of p: `t(p)`, and `F(p) = ∫ f t' dp`.
#[derive(Clone, Copy)]
struct Sextic {
    t: [f32; 4],
    /// `F` without its constant term, which is 0.
    c: [f32; 6],
}

impl Sextic {
    const fn new(points: Ramp) -> Self {
        let [p0, p1, p2, p3] = points;
        let t = powers([p0.0, p1.0, p2.0, p3.0]);
        let f = powers([p0.1, p1.1, p2.1, p3.1]);
        let d = [t[1], 2.0 * t[2], 3.0 * t[3]];
        let mut c = [0.0; 6];
        let mut i = 0;
        while i < 4 {
            let mut j = 0;
            while j < 3 {
                c[i + j] += f[i] * d[j] / (i + j + 1) as f32;
                j += 1;
            }
            i += 1;
        }
        Self { t, c }
    }

    const fn scaled(mut self, by: f32) -> Self {
        let mut i = 0;
        while i < 6 {
            self.c[i] *= by;
            i += 1;
        }
        self
    }

    const fn mass(&self, p: f32) -> f32 {
        let c = &self.c;
        p * (c[0] + p * (c[1] + p * (c[2] + p * (c[3] + p * (c[4] + p * c[5])))))
    }

    fn density(&self, p: f32) -> f32 {
        let c = &self.c;
        c[0] + p * (2.0 * c[1] + p * (3.0 * c[2] + p * (4.0 * c[3] + p * (5.0 * c[4] + p * 6.0 * c[5]))))
    }

    fn time(&self, p: f32) -> f32 {
        let t = &self.t;
        t[0] + p * (t[1] + p * (t[2] + p * t[3]))
    }

    fn solve(&self, target: f32) -> (f32, u32) {
        let mut p = 0.5;
        for step in 1..=10 {
            let error = self.mass(p) - target;
            if error.abs() <= 1e-6 {
                return (p, step);
            }
            p -= error / self.density(p);
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..21 {
            let middle = 0.5 * (low + high);
            if self.mass(middle) < target {
                low = middle;
            } else {
                high = middle;
            }
        }
        (0.5 * (low + high), 10 + 21)
    }
}

/// The same textbook, done with care: sextics in powers from both ends of each ramp, built in `f64`, and the fraction
/// counted from the curve's nearer end.
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

/// The time and the share of the exposure, in powers of `p` from one end of a ramp.
#[derive(Clone, Copy)]
struct Powers {
    t: [f32; 4],
    /// Without the constant term, which is 0.
    c: [f32; 6],
}

impl NearerEnd {
    /// The shutter with these ramps; nothing is checked.
    pub fn new(opening: Ramp, closing: Ramp) -> Self {
        let [before, after] = [opening, closing].map(|ramp| sextic(ramp).1.iter().sum::<f64>());
        let plateau = f64::from(closing[0].0) - f64::from(opening[3].0);
        let area = before + plateau + after;
        let side = |ramp: Ramp, mass: f64, area: f64| {
            let [p0, p1, p2, p3] = ramp;
            Side {
                from_outside: Powers::new(ramp, area),
                from_inside: Powers::new([p3, p2, p1, p0], -area),
                share: (mass / area.abs()) as f32,
                area: area as f32,
            }
        };
        let [p0, p1, p2, p3] = closing;
        Self { sides: [side(opening, before, area), side([p3, p2, p1, p0], after, -area)] }
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
        if a < 0.5 * side.share { side.from_outside.time(a, p) } else { side.from_inside.time(side.share - a, 1.0 - p) }
    }
}

impl Powers {
    fn new(ramp: Ramp, area: f64) -> Self {
        let (t, c) = sextic(ramp);
        Self { t: t.map(|t| t as f32), c: c.map(|c| (c / area) as f32) }
    }

    /// By Newton's method from `p`, in a bracket, until the residual is 3e-7 of the target; then one step more.
    #[inline]
    fn time(&self, target: f32, mut p: f32) -> f32 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let (mut mass, mut slope) = (self.c[5], self.c[5]);
            for c in self.c[..5].iter().rev() {
                mass = mass * p + c;
                slope = slope * p + mass;
            }
            mass *= p;
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
        let t = &self.t;
        t[0] + p * (t[1] + p * (t[2] + p * t[3]))
    }
}

/// A ramp's time in powers of `p`, and what is collected, without its constant term; in `f64`.
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

/// A cubic's power coefficients from its Bernstein coefficients.
const fn powers([a, b, c, d]: [f32; 4]) -> [f32; 4] {
    [a, 3.0 * (b - a), 3.0 * (a - 2.0 * b + c), d - 3.0 * c + 3.0 * b - a]
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
    pub const fn new([start, open, close, end]: [f32; 4]) -> Self {
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
