//! What integers say is lost by a sum or a product, held to what floats say.

use crate::exact::{product_by_floats, product_by_integers, sum_by_floats, sum_by_integers};

/// Significands with few bits, with all, at the ends, and without a pattern.
fn significands() -> impl Iterator<Item = u32> + Clone {
    let patterns = (0..23).step_by(3).flat_map(|k| [1 << k, (1 << k) - 1, (1 << 23) - (1 << k)]);
    patterns.chain((1..12).map(|k: u32| k.wrapping_mul(0x9E37_79B9) >> 9))
}

/// Numbers with these exponents, the subnormal, infinite and undefined ones among them, in both signs.
fn numbers(exponents: &[i32]) -> Vec<f32> {
    let of = |exponent: i32| {
        let bits = significands().map(move |significand| (exponent as u32) << 23 | significand);
        bits.flat_map(|bits| [f32::from_bits(bits), -f32::from_bits(bits)])
    };
    exponents.iter().filter(|e| (0..256).contains(*e)).flat_map(|exponent| of(*exponent)).collect()
}

#[test]
fn integers_lose_what_floats_lose() {
    for base in [0, 1, 22, 23, 24, 47, 63, 87, 100, 127, 150, 200, 229, 253, 255] {
        let others: Vec<i32> = [0, 1, 2, 11, 22, 23, 24, 25, 26, 27, 40, 90, 120]
            .into_iter()
            .flat_map(|apart| [base + apart, base - apart, 127 + apart, 127 - apart])
            .collect();
        let others = numbers(&others);
        for a in numbers(&[base]) {
            for &b in &others {
                let sum = a + b;
                let lost = [sum_by_integers(sum, a, b), sum_by_floats(sum, a, b)];
                assert!(is_one(lost), "{a:e} + {b:e}: {lost:?}");
                let product = a * b;
                let lost = [product_by_integers(product, a, b), product_by_floats(product, a, b)];
                assert!(is_one(lost), "{a:e} * {b:e}: {lost:?}");
            }
        }
    }
}

/// The same bits; whatever the first, where the second is undefined, since something on its way is beyond all numbers.
fn is_one([x, y]: [f32; 2]) -> bool {
    x.to_bits() == y.to_bits() || !y.is_finite()
}
