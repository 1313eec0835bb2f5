//! Cubics in `f64`, for building a curve: extremes, and the power form around a parameter `p`.

/// A cubic by its power coefficients around some `p`: `value + c[0] x + c[1] x² + c[2] x³`.
#[derive(Clone, Copy)]
pub(crate) struct Cubic {
    pub(crate) value: f64,
    pub(crate) c: [f64; 3],
}

impl Cubic {
    /// From its value at 0 and the differences of its Bernstein coefficients.
    pub(crate) const fn new(value: f64, [d0, d1, d2]: [f64; 3]) -> Self {
        // Seen from the other end, the last one has the same bits, or the other sign for an openness.
        Self { value, c: [3.0 * d0, 3.0 * (d1 - d0), (d0 + d2) - 2.0 * d1] }
    }
}

/// `∫ f t' dx` from 0, by powers of `x`, where both are around one `p`.
#[inline(never)]
pub(crate) const fn integral(f: Cubic, t: Cubic) -> [f64; 6] {
    // (x^k)' = k x^(k-1), and the integral divides by the next exponent.
    const COUNT: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];
    let (Cubic { value, c: [f1, f2, f3] }, t) = (f, t.c);
    let (f, mut integral, mut j) = ([value, f1, f2, f3], [0.0; 6], 0);
    while j < t.len() {
        let mut k = 0;
        while k < f.len() {
            integral[j + k] += COUNT[j] * f[k] * t[j];
            k += 1;
        }
        j += 1;
    }
    let mut k = 0;
    while k < COUNT.len() {
        integral[k] /= COUNT[k];
        k += 1;
    }
    // 3/6 = 1/2: a rounding less, and the same bits seen from the other end.
    integral[5] = f3 * t[2] / 2.0;
    integral
}

pub(crate) const fn widened(v: [f32; 4]) -> [f64; 4] {
    [v[0] as f64, v[1] as f64, v[2] as f64, v[3] as f64]
}

/// The differences of neighbours. Those of `f32` are exact unless their exponents lie 29 apart.
pub(crate) const fn differences(v: [f64; 4]) -> [f64; 3] {
    [v[1] - v[0], v[2] - v[1], v[3] - v[2]]
}
