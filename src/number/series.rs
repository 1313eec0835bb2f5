//! A polynomial by its coefficients in pairs, and its value at an `f32`: how mass, time and openness are measured.

use crate::number::pair::{Pair, lost_by_product};

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
        // A loop that the compiler would unroll: hidden from it, a search takes 500 bytes less.
        self.value(x, core::hint::black_box(self.c))
    }

    #[inline(always)]
    const fn value(self, x: f32, mut c: &[Pair]) -> Pair {
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

    /// The value at a place. The place's second number adds itself times the slope. That is at most N · 2⁻²⁴ of Σ |c_k|
    /// |x|^k, so single precision is enough for it: the value is within 2⁻⁴⁰ of that sum.
    // proofs/series.py
    #[inline(always)]
    pub(crate) const fn at_pair(self, place: Pair) -> Pair {
        self.moved(self.at(place.hi), place)
    }

    /// The same with its loop unrolled: faster, and more bytes.
    #[inline(always)]
    pub(crate) const fn at_pair_unrolled(self, place: Pair) -> Pair {
        self.moved(self.value(place.hi, self.c), place)
    }

    /// The value at a place from that at its first number.
    #[inline(always)]
    const fn moved(self, Pair { hi, lo }: Pair, place: Pair) -> Pair {
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
