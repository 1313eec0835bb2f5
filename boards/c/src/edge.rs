//! From the pointers of C to references: all that cannot be checked is here.
#![allow(unsafe_code)]

use core::slice;

/// Room for `n`; none behind a null pointer, one that is not aligned, or in more than half of the memory.
///
/// # Safety
/// Unless `first` is null, it points to room for `n` that nothing else uses meanwhile.
pub unsafe fn places<'a, T>(first: *mut T, n: u32) -> Option<&'a mut [T]> {
    let n = usize::try_from(n).ok()?;
    let bytes = n.checked_mul(size_of::<T>())?;
    if n == 0 {
        return Some(&mut []);
    }
    if first.is_null() || !first.is_aligned() || bytes > isize::MAX as usize {
        return None;
    }
    // SAFETY: it is neither null nor misaligned, not too large, and the caller says that there is room. It is written before
    // it is read; any bits are a `T`, which is made of whole numbers.
    Some(unsafe { slice::from_raw_parts_mut(first, n) })
}

/// Room for one.
///
/// # Safety
/// As for [`places`].
pub unsafe fn place<'a, T>(at: *mut T) -> Option<&'a mut T> {
    // SAFETY: the caller's.
    unsafe { places(at, 1) }?.first_mut()
}
