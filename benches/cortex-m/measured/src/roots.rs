//! The k-th root of a quotient in several ways, what a search may start from; and the FPU's square root.

use micromath::F32Ext;

#[allow(dead_code, unused_imports)] // Its tests are the crate's.
#[path = "../../../../src/search/guess.rs"]
mod guess;

pub struct Root {
    pub way: &'static str,
    pub k: i32,
    /// Of the first number over the second.
    pub of: fn(f32, f32) -> f32,
}

const fn root(way: &'static str, k: i32, of: fn(f32, f32) -> f32) -> Root {
    Root { way, k, of }
}

/// The crate's own takes the least root over a series' coefficients up to the k-th, the others but 0.
pub const ROOTS: [Root; 12] = [
    root("this crate", 2, |x, c| guess::guess(&[0.0, c], x)),
    root("`libm`: `sqrtf`", 2, |x, c| libm::sqrtf(x / c)),
    root("`micromath`: `sqrt`", 2, |x, c| F32Ext::sqrt(x / c)),
    root("this crate", 3, |x, c| guess::guess(&[0.0, 0.0, c], x)),
    root("`libm`: `cbrtf`", 3, |x, c| libm::cbrtf(x / c)),
    root("`micromath`: `powf`", 3, |x, c| F32Ext::powf(x / c, 1.0 / 3.0)),
    root("this crate", 4, |x, c| guess::guess(&[0.0, 0.0, 0.0, c], x)),
    root("`libm`: `sqrtf` twice", 4, |x, c| libm::sqrtf(libm::sqrtf(x / c))),
    root("`micromath`: `sqrt` twice", 4, |x, c| F32Ext::sqrt(F32Ext::sqrt(x / c))),
    root("this crate", 6, |x, c| guess::guess(&[0.0, 0.0, 0.0, 0.0, 0.0, c], x)),
    root("`libm`: `powf`", 6, |x, c| libm::powf(x / c, 1.0 / 6.0)),
    root("`micromath`: `powf`", 6, |x, c| F32Ext::powf(x / c, 1.0 / 6.0)),
];

/// By the processor's instruction, where it has one: `sqrt` is not in stable `core`.
#[inline(always)]
pub fn fpu_sqrt(x: f32) -> f32 {
    #[cfg(bare)]
    return core::intrinsics::sqrtf32(x);
    #[cfg(not(bare))]
    libm::sqrtf(x)
}

/// The divisor that is measured with.
pub const DIVISOR: f32 = 3.0;

/// What is divided, for a number in [0, 1]: from 2⁻⁶⁰ to 1, evenly on a logarithmic scale.
pub fn dividend(x: f32) -> f32 {
    f32::from_bits((67 << 23) + (x * (60 << 23) as f32) as u32)
}
