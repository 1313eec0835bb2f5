//! A polynomial by its coefficients in pairs, and its value at an `f32`: how mass, time and openness are measured.

use crate::pair::{Pair, upper};

/// A polynomial without a constant term: `c[0] x + c[1] x² + ... + last xᴺ`, where `c` has N - 1 coefficients.
///
/// The last one stands apart because the series from both ends of a ramp share it.
#[derive(Clone, Copy)]
pub(crate) struct Series<'a> {
    pub(crate) c: &'a [Pair],
    pub(crate) last: Pair,
}

impl Series<'_> {
    /// The value at `x`, by Horner's rule with what each sum and each product loses carried along.
    ///
    /// It is within 2⁻⁴¹ Σ |c_k| |x|^k (Graillat, Langlois and Louvet 2005).
    // proofs/series.py
    #[inline(always)]
    pub(crate) const fn at(self, x: f32) -> Pair {
        let x_high = upper(x);
        let x_low = x - x_high;
        let Pair { mut hi, mut lo } = self.last;
        // Unknown to the compiler, which would unroll the loop to several times its bytes.
        let mut k = core::hint::black_box(self.c.len());
        loop {
            let product = hi * x;
            let high = upper(hi);
            let low = hi - high;
            let lost = ((high * x_high - product) + high * x_low + low * x_high) + low * x_low;
            lo = lo * x + lost;
            k = k.wrapping_sub(1);
            if k >= self.c.len() {
                return Pair { hi: product, lo };
            }
            let sum = Pair::sum(self.c[k].hi, product);
            hi = sum.hi;
            lo += self.c[k].lo + sum.lo;
        }
    }

    /// The value at a place. The place's second number adds itself times the slope. That is at most N · 2⁻²⁴ of Σ |c_k|
    /// |x|^k, so single precision is enough for it: the value is within 2⁻⁴⁰ of that sum.
    // proofs/series.py
    #[inline(always)]
    pub(crate) const fn at_pair(self, place: Pair) -> Pair {
        let Pair { hi, lo } = self.at(place.hi);
        Pair { hi, lo: lo + self.slope(place.hi) * place.lo }
    }

    /// The slope at `x`, in single precision.
    #[inline(always)]
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
