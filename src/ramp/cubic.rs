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

    /// By powers of `x - p`.
    pub(crate) const fn around(self, p: f64) -> Self {
        let Self { value, c: [a, b, c] } = self;
        Self {
            value: value + p * (a + p * (b + p * c)),
            c: [a + p * (2.0 * b + p * 3.0 * c), b + 3.0 * p * c, c],
        }
    }

    /// Where the slope `a + 2 b x + 3 c x²` is least, or -1 for nowhere.
    pub(crate) const fn least_slope(self) -> f64 {
        let [_, b, c] = self.c;
        if c > 0.0 { -b / (3.0 * c) } else { -1.0 }
    }

    /// Where it has a minimum, or -1 for nowhere.
    pub(crate) const fn minimum(self) -> f64 {
        let [a, b, c] = self.c;
        let discriminant = b * b - 3.0 * a * c;
        if discriminant <= 0.0 {
            return -1.0;
        }
        let root = sqrt(discriminant);
        // By the form that does not cancel.
        if b > 0.0 { -a / (b + root) } else { (root - b) / (3.0 * c) }
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

/// The least value on [0, 1] of a quadratic in the Bernstein basis, and a bound of its rounding, which is 0 at an end.
///
/// The vertex is inside just where `b` is below both ends. The quadratic there is `(ac - b²) / (a - 2b + c)`. Rounding
/// is at most 6 · 2⁻⁵³ of `(|ac| + b²) / (a - 2b + c)`, and 8 · 2⁻⁵³ where [`forward`](crate::ramp::lift::forward)
/// raises and scales the coefficients; the bound is 16 · 2⁻⁵³.
#[inline(never)]
pub(crate) const fn quadratic_min([a, b, c]: [f64; 3]) -> (f64, f64) {
    let ends = if a < c { a } else { c };
    if b >= ends {
        return (ends, 0.0);
    }
    let (outer, inner, divisor) = (a * c, b * b, (a - b) + (c - b));
    ((outer - inner) / divisor, (outer.abs() + inner) / divisor / (1u64 << 49) as f64)
}

/// The least and greatest value on [0, 1] of a cubic in the Bernstein basis, with the same bits for a mirrored one. An
/// extremum inside counts as 0 if it is within rounding of 0, so that a curve that touches 0 is not lifted.
#[inline(never)]
pub(crate) const fn cubic_range([a, b, c, d]: [f64; 4]) -> (f64, f64) {
    let (there, back) = (range_from_start([a, b, c, d]), range_from_start([d, c, b, a]));
    (
        if back.0 < there.0 { back.0 } else { there.0 },
        if back.1 > there.1 { back.1 } else { there.1 },
    )
}

const fn range_from_start(f: [f64; 4]) -> (f64, f64) {
    let (mut low, mut high) = if f[0] < f[3] { (f[0], f[3]) } else { (f[3], f[0]) };
    // f'/3 = a + 2 half p + square p²; its roots by the form that does not cancel.
    let [a, b, c] = differences(f);
    let (half, square) = (b - a, a - 2.0 * b + c);
    let discriminant = half * half - a * square;
    if discriminant >= 0.0 {
        let root = sqrt(discriminant);
        let q = if half < 0.0 { -half + root } else { -half - root };
        let candidates = [q / square, a / q];
        let mut i = 0;
        while i < 2 {
            let p = candidates[i & 1];
            // False for the NaN of 0/0.
            if p > 0.0 && p < 1.0 {
                let (r, mut sums, mut noise, mut k) = (1.0 - p, [0.0; 2], 0.0, 0);
                while k < f.len() {
                    // term = f[k] C(3, k) r^(3 - k) p^k
                    let (mut term, mut j) = (if k == 1 || k == 2 { 3.0 } else { 1.0 }, k);
                    while j < k + 3 {
                        term *= if j < 3 { r } else { p };
                        j += 1;
                    }
                    term *= f[k & 3];
                    // 0 and 1, then 2 and 3: the mirrored cubic has the same two sums.
                    sums[k >> 1 & 1] += term;
                    noise += term.abs();
                    k += 1;
                }
                // Room for 32 roundings of the terms; there are 8: at most 5 in a term, and 3 in their sum.
                let noise = noise / (1u64 << 48) as f64;
                let value = sums[0] + sums[1];
                let value = if value.abs() <= noise { 0.0 } else { value };
                low = if value < low { value } else { low };
                high = if value > high { value } else { high };
            }
            i += 1;
        }
    }
    (low, high)
}

/// The square root of 0, or of a normal `x` above 0. (`core` has none in a constant.)
#[inline(never)]
const fn sqrt(x: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    // Half the exponent, within 6 %. Four of Newton's steps are enough; a fifth settles the last bit.
    let mut y = f64::from_bits((x.to_bits() >> 1) + (1023 << 51));
    let mut i = 0;
    while i < 5 {
        y = 0.5 * (y + x / y);
        i += 1;
    }
    y
}
