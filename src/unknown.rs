//! What the compiler shall not know of a loop, so that its code stays small.

/// A loop's counter, unknown to the compiler, which would unroll the loop to several times its bytes. Loops that count
/// down end where it wraps, so that one comparison ends the loop and spares the check of a bound. (Masks of an index,
/// and conditions that always hold, spare it elsewhere.)
#[inline(always)]
pub(crate) const fn unknown(n: usize) -> usize {
    core::hint::black_box(n)
}
