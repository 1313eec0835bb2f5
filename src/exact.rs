//! What rounding takes from a sum and from a product of two `f32`, exactly, with the same bits on every machine.
//!
//! With floats these are Knuth's sum (1969), in 6 operations, and Dekker's product (1971), in 11, as a mask cuts the
//! halves. Where floats are emulated, each operation is a call of about a hundred instructions. There the same numbers
//! come from integers: what is lost fits a word, so only the lowest word of the exact sum or product is needed, and
//! that wraps. Numbers so small that something may be subnormal, infinite ones and NaN are left to the floats, except
//! that beside a 0 nothing is lost.

/// Are floats emulated? (A stable compiler does not tell of a RISC-V core whether it has floats. But one that has them
/// has registers to control them, and of these it tells.) Where this is wrong, the bits are the same, only later.
const EMULATED: bool = cfg!(any(
    all(target_arch = "arm", target_abi = "eabi"),
    all(target_arch = "riscv32", not(target_feature = "zicsr"))
));

/// From this exponent on, as bits have it, the last place of a number is a normal number.
const LEAST: u32 = 24;

/// `a + b - sum`, exactly, for the rounded `sum` of both.
#[inline(always)]
pub(crate) const fn lost_by_sum(sum: f32, a: f32, b: f32) -> f32 {
    if EMULATED { sum_by_integers(sum, a, b) } else { sum_by_floats(sum, a, b) }
}

/// `a b - product`, exactly, for the rounded `product` of both.
#[inline(always)]
pub(crate) const fn lost_by_product(product: f32, a: f32, b: f32) -> f32 {
    if EMULATED { product_by_integers(product, a, b) } else { product_by_floats(product, a, b) }
}

/// The same for an `x` of 12 bits.
#[inline(always)]
pub(crate) const fn lost_by_short_product(product: f32, a: f32, x: f32) -> f32 {
    if EMULATED {
        return product_by_integers(product, a, x);
    }
    let high = upper(a);
    (high * x - product) + (a - high) * x
}

/// Knuth's.
#[inline(always)]
pub(crate) const fn sum_by_floats(sum: f32, a: f32, b: f32) -> f32 {
    let added = sum - a;
    (a - (sum - added)) + (b - added)
}

/// Dekker's.
#[inline(always)]
pub(crate) const fn product_by_floats(product: f32, a: f32, b: f32) -> f32 {
    let (a_high, b_high) = (upper(a), upper(b));
    let (a_low, b_low) = (a - a_high, b - b_high);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// The upper 12 of 24 bits. The product of two such halves is exact.
// proofs/words.py: upper
#[inline(always)]
pub(crate) const fn upper(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xFFFF_F000)
}

/// Of a normal number: its exponent, as its bits have it, and its significand, which has 24 bits.
#[inline(always)]
const fn parts(bits: u32) -> (u32, u32) {
    (bits >> 23 & 0xFF, bits & 0x7F_FFFF | 1 << 23)
}

/// In the unit of the lesser number's last place both numbers and the sum are whole numbers, and what is lost is at
/// most the lesser number, since the greater one was a choice for the sum.
#[inline(never)]
pub(crate) const fn sum_by_integers(sum: f32, a: f32, b: f32) -> f32 {
    let (a_bits, b_bits) = (a.to_bits(), b.to_bits());
    let (greater, lesser) =
        if a_bits << 1 > b_bits << 1 { (a_bits, b_bits) } else { (b_bits, a_bits) };
    if lesser << 1 == 0 {
        return 0.0;
    }
    let (exponent, less) = parts(lesser);
    let (exponent_of_sum, rounded) = parts(sum.to_bits());
    if exponent < LEAST || exponent_of_sum == 0xFF {
        return sum_by_floats(sum, a, b);
    }
    let (greatest, great) = parts(greater);
    let up = greatest - exponent;
    if up > 25 {
        // The sum is the greater number.
        return f32::from_bits(lesser);
    }
    if exponent_of_sum < exponent {
        // So much cancels that the sum is exact.
        return 0.0;
    }
    let up_of_sum = exponent_of_sum - exponent;
    let less = if (greater ^ lesser) >> 31 == 0 { less } else { less.wrapping_neg() };
    let lost = (great << up).wrapping_add(less).wrapping_sub(rounded << (up_of_sum & 31));
    counted(lost as i32, exponent as i32, greater)
}

/// In the unit of the last place of the exact product what is lost is at most 2²³.
#[inline(never)]
pub(crate) const fn product_by_integers(product: f32, a: f32, b: f32) -> f32 {
    let (a_bits, b_bits) = (a.to_bits(), b.to_bits());
    let [(a_exponent, a_significand), (b_exponent, b_significand)] = [parts(a_bits), parts(b_bits)];
    let (exponent, rounded) = parts(product.to_bits());
    if a_bits << 1 == 0 || b_bits << 1 == 0 {
        return 0.0;
    }
    if exponent < LEAST + 24 || exponent == 0xFF || a_exponent == 0 || b_exponent == 0 {
        return product_by_floats(product, a, b);
    }
    let unit = (a_exponent + b_exponent) as i32 - 150;
    let up = (exponent as i32 - unit) as u32;
    let exact = a_significand.wrapping_mul(b_significand);
    counted(exact.wrapping_sub(rounded << (up & 31)) as i32, unit, a_bits ^ b_bits)
}

/// `count · 2^(exponent - 150)`, with the sign of `sign` where the count is positive; 0 has none. A count of up to 2²⁴.
#[inline(always)]
const fn counted(count: i32, exponent: i32, sign: u32) -> f32 {
    if count == 0 {
        return 0.0;
    }
    let bits = (count as f32).to_bits().wrapping_add_signed((exponent - 150) << 23);
    f32::from_bits(bits ^ sign & 1 << 31)
}
