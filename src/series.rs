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
    /// It is within 2⁻⁴¹ Σ |c_k| |x|^k: of N = 6 products and 5 sums each loses at most 2⁻²⁴ of that sum, so what is
    /// carried along is at most 12 · 2⁻²⁴ of it. It grows as it is carried, so its own roundings are 118 · 2⁻⁴⁸ in all
    /// (Graillat, Langlois and Louvet 2005; counted by `proofs/series.py`).
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::tests::numbers;
    use crate::solve::Offset;

    /// What `proofs/series.py` takes for these functions is what they are.
    #[test]
    fn series_are_as_transcribed() {
        for row in numbers::<18>(include_str!("../proofs/vectors/series.csv")) {
            let c: [Pair; 6] =
                core::array::from_fn(|k| Pair { hi: row[2 * k], lo: row[2 * k + 1] });
            let [.., x, rest, hi, lo, slope, with_rest] = row;
            let series = Series { c: &c[..5], last: c[5] };
            assert_eq!(series.at(x), Pair { hi, lo });
            assert_eq!(series.slope(x), slope);
            let offset = Offset { x, rest, evaluations: 0 };
            assert_eq!(offset.value(series), Pair { hi, lo: with_rest });
        }
    }
}
