//! A ramp from (0, 0) to (1, 1): a cubic Bezier in (time, openness), its integral over time, and what both lose or gain
//! as the control numbers move, all in closed form.
//!
//! With `x(p)` the time and `y(p)` the openness, the integral up to the place `p` is `G(p) = ∫₀ᵖ y x' dp`, a polynomial
//! of degree 6. At a fixed time it moves with the control numbers as
//!
//! - `∂G/∂y₁ = ∫ B₁ x' dp`, because `x` does not depend on them;
//! - `∂G/∂x₁ = -∫ B₁ y' dp`: integrated by parts, `G = y x - ∫ x y' dp`, and at a fixed time what the move of `p` does
//!   to both parts cancels.
//!
//! No derivative divides by `x'`, so a ramp whose time stands still somewhere is as good as any.

/// The control numbers `x1, y1, x2, y2`.
pub type Controls = [f64; 4];

/// Where each of them stays. The crate takes no first time that passes the second by more than 15/16: here it is 0.92,
/// and the rest is for a scene's rounding.
pub const BOUNDS: [(f64, f64); 4] = [(0.0, 0.96), (0.0, 1.0), (0.04, 1.0), (0.0, 1.0)];

pub const STRAIGHT: Controls = [1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];

/// `∫₀ᵖ` of a product of a cubic without a constant term and a cubic's slope: the coefficients of p² to p⁶.
type Integral = [f64; 5];

/// The inner Bernstein polynomials `3 p (1-p)²` and `3 p² (1-p)`, by powers of p from 1.
const INNER: [[f64; 3]; 2] = [[3.0, -6.0, 3.0], [0.0, 3.0, -3.0]];

#[derive(Clone, Copy, Debug)]
pub struct UnitRamp {
    x: [f64; 3],
    y: [f64; 3],
    area: Integral,
    /// Of the area, by each control number.
    moves: [Integral; 4],
}

/// What a ramp is at a time.
#[derive(Clone, Copy, Debug)]
pub struct At {
    pub openness: f64,
    pub area: f64,
    /// Of the area, by each control number.
    pub moves: [f64; 4],
}

impl UnitRamp {
    pub fn new(controls: &Controls) -> Self {
        let [x1, y1, x2, y2] = *controls;
        let (x, y) = (powers(x1, x2), powers(y1, y2));
        let negative = |integral: Integral| integral.map(|c| -c);
        Self {
            x,
            y,
            area: integral(y, x),
            moves: [
                negative(integral(INNER[0], y)),
                integral(INNER[0], x),
                negative(integral(INNER[1], y)),
                integral(INNER[1], x),
            ],
        }
    }

    /// The ramp at the share `z` of its length, which is clamped to [0, 1].
    pub fn at(&self, z: f64) -> At {
        let p = self.place(z);
        let moves = self.moves.each_ref().map(|integral| up_to(integral, p));
        At { openness: cubic(self.y, p), area: up_to(&self.area, p), moves }
    }

    /// The openness alone.
    pub fn openness(&self, z: f64) -> f64 {
        cubic(self.y, self.place(z))
    }

    pub fn reaches(&self, openness: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.openness(middle) < openness { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// The place `p` at which the time is `z`: Halley's method inside a bracket that is halved where that leaves it. A
    /// step from so near that the next one would change nothing is the last. Inside the ramp the slope is above 0, by
    /// [`BOUNDS`].
    ///
    /// The error that is left in `p` counts for next to nothing: the integral at a fixed time is the same to first
    /// order.
    fn place(&self, z: f64) -> f64 {
        if z.is_nan() || z <= 0.0 {
            return 0.0;
        }
        if z >= 1.0 {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut p = z;
        let [a, b, c] = self.x;
        for _ in 0..60 {
            let missing = p * (a + p * (b + p * c)) - z;
            (low, high) = if missing < 0.0 { (p, high) } else { (low, p) };
            let (slope, bend) = (a + p * (2.0 * b + p * 3.0 * c), b + p * 3.0 * c);
            let next = p - missing * slope / (slope * slope - missing * bend);
            if missing.abs() <= 1e-7 {
                return next.clamp(low, high);
            }
            p = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        p
    }
}

/// The power form of the cubic Bezier from 0 to 1 with these inner control numbers, by powers of p from 1.
fn powers(first: f64, second: f64) -> [f64; 3] {
    [3.0 * first, 3.0 * (second - 2.0 * first), 1.0 + 3.0 * (first - second)]
}

fn cubic([a, b, c]: [f64; 3], p: f64) -> f64 {
    p * (a + p * (b + p * c))
}

fn up_to(c: &Integral, p: f64) -> f64 {
    p * p * (c[0] + p * (c[1] + p * (c[2] + p * (c[3] + p * c[4]))))
}

/// `∫₀ᵖ f g' dp` of two cubics without a constant term.
fn integral(f: [f64; 3], g: [f64; 3]) -> Integral {
    let slope = [g[0], 2.0 * g[1], 3.0 * g[2]];
    let mut product = [0.0; 5];
    for (i, f) in f.iter().enumerate() {
        for (j, s) in slope.iter().enumerate() {
            product[i + j] += f * s;
        }
    }
    // p¹ is the product's lowest power, p² the integral's.
    std::array::from_fn(|i| product[i] / (i + 2) as f64)
}
