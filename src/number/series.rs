//! A polynomial with coefficients in pairs, and its value: how mass, time and openness are measured.

use crate::number::pair::{Pair, lost_by_product};

/// A polynomial without a constant term: `c[0] x + c[1] x² + ... + last xᴺ`, where `c` has N - 1 coefficients. The last
/// one stands apart because the series from both ends of a ramp share it, but for a sign.
#[derive(Clone, Copy)]
pub(crate) struct Series<'a> {
    pub(crate) c: &'a [Pair],
    pub(crate) last: Pair,
}

impl Series<'_> {
    /// The value at `x`. It is within 2⁻⁴¹ Σ |c_k| |x|^k: Horner's rule in `hi`, while `lo` collects what its sums and
    /// products lose (Graillat, Langlois and Louvet 2005).
    // proofs/series.py
    pub(crate) const fn at(self, x: f32) -> Pair {
        // Hidden from the compiler, which would unroll the loop: 500 bytes less in a search.
        let mut c = core::hint::black_box(self.c);
        let Pair { mut hi, mut lo } = self.last;
        loop {
            let product = hi * x;
            lo = lo * x + lost_by_product(product, hi, x);
            let [lower @ .., next] = c else { return Pair { hi: product, lo } };
            let sum = Pair::sum(next.hi, product);
            hi = sum.hi;
            lo += next.lo + sum.lo;
            c = lower;
        }
    }

    /// The value at a place, `S(hi + lo) = S(hi) + S'(hi) lo`. The second term is at most N · 2⁻²⁴ of Σ |c_k| |x|^k, so
    /// single precision is enough for it: the value is within 2⁻⁴⁰ of that sum.
    // proofs/series.py
    pub(crate) const fn at_pair(self, place: Pair) -> Pair {
        let Pair { hi, lo } = self.at(place.hi);
        Pair { hi, lo: lo + self.slope(place.hi) * place.lo }
    }

    /// The slope at `x`, in single precision.
    pub(crate) const fn slope(self, x: f32) -> f32 {
        let mut c = self.c;
        let mut slope = (c.len() + 1) as f32 * self.last.hi;
        while let [lower @ .., highest] = c {
            slope = slope * x + c.len() as f32 * highest.hi;
            c = lower;
        }
        slope
    }
}
