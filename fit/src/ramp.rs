//! A ramp from (0, 0) to (1, 1): a cubic Bezier in (time, openness), its integral over time, and what both lose or gain as
//! the control numbers move, all in closed form.
//!
//! With `x(p)` the time and `y(p)` the openness, the integral up to the place `p` is `G(p) = ∫₀ᵖ y x' dp`, a polynomial of
//! degree 6. At a fixed time it moves with the control numbers as
//!
//! - `∂G/∂y₁ = ∫ B₁ x' dp`, because `x` does not depend on them;
//! - `∂G/∂x₁ = -∫ B₁ y' dp`: integrated by parts, `G = y x - ∫ x y' dp`, and at a fixed time what the move of `p` does to
//!   both parts cancels.
//!
//! No derivative divides by `x'`, so a ramp whose time stands still somewhere is as good as any.

/// The control numbers `x1, y1, x2, y2`.
pub type Controls = [f64; 4];

/// Where each of them stays. The crate takes no first time that passes the second by more than 15/16: here it is 0.92, and
/// the rest is for a scene's rounding.
pub const BOUNDS: [(f64, f64); 4] = [(0.0, 0.96), (0.0, 1.0), (0.04, 1.0), (0.0, 1.0)];

/// The straight line.
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

impl At {
    /// Before the ramp.
    pub const START: Self = Self { openness: 0.0, area: 0.0, moves: [0.0; 4] };
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
        if z.is_nan() || z <= 0.0 {
            return At::START;
        }
        let p = if z < 1.0 { self.place(z) } else { 1.0 };
        let integral =
            |c: &Integral| p * p * (c[0] + p * (c[1] + p * (c[2] + p * (c[3] + p * c[4]))));
        At {
            openness: cubic(self.y, p),
            area: integral(&self.area),
            moves: self.moves.each_ref().map(integral),
        }
    }

    /// When it reaches an openness.
    pub fn reaches(&self, openness: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.at(middle).openness < openness { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// The integral over the whole ramp, and how it moves.
    pub fn whole(&self) -> At {
        self.at(1.0)
    }

    /// The place `p` at which the time is `z`: Newton's method inside a bracket that is halved where that leaves it.
    ///
    /// The error that is left in `p` counts for next to nothing: the integral at a fixed time is the same to first order.
    fn place(&self, z: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let mut p = z;
        for _ in 0..60 {
            let missing = cubic(self.x, p) - z;
            if missing.abs() <= 1e-14 {
                break;
            }
            if missing < 0.0 {
                low = p
            } else {
                high = p
            }
            let [a, b, c] = self.x;
            let next = p - missing / (a + p * (2.0 * b + p * 3.0 * c));
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

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Controls; 5] =
        [STRAIGHT, [0.4, 0.0, 0.6, 1.0], [0.0, 0.7, 0.1, 1.0], [1.0, 0.2, 0.0, 0.9], [0.0; 4]];

    #[test]
    fn the_integral_is_that_of_the_openness() {
        for controls in SHAPES {
            let ramp = UnitRamp::new(&controls);
            let (n, mut sum) = (20_000, 0.0);
            for i in 0..n {
                sum += ramp.at((f64::from(i) + 0.5) / f64::from(n)).openness / f64::from(n);
                let here = ramp.at(f64::from(i + 1) / f64::from(n)).area;
                assert!((sum - here).abs() < 1e-5, "{controls:?} at {i}: {sum}, {here}");
            }
        }
    }

    #[test]
    fn the_moves_are_differences() {
        for controls in &SHAPES[..3] {
            for k in 0..4 {
                for z in [0.05, 0.3, 0.7, 0.99, 1.0] {
                    let step = 1e-5;
                    let moved = |by: f64| {
                        let mut controls = *controls;
                        controls[k] += by;
                        UnitRamp::new(&controls).at(z).area
                    };
                    // One-sided and of second order: control numbers at 0 must stay in range.
                    let to = if controls[k] < 0.5 { step } else { -step };
                    let slope = (4.0 * moved(to) - moved(2.0 * to) - 3.0 * moved(0.0)) / (2.0 * to);
                    let exact = UnitRamp::new(controls).at(z).moves[k];
                    assert!((slope - exact).abs() < 1e-6, "{controls:?} {k} {z}: {slope}, {exact}");
                }
            }
        }
    }
}
