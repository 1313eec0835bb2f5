//! Errors to make on purpose, to see that the check sees them. Here only with the feature `faults`.

use core::sync::atomic::{AtomicUsize, Ordering};

use crate::limits::MIN_LOW;

const NAMES: [&str; 5] = ["lost", "twice", "early", "late", "close"];

/// Which of [`NAMES`]; none at first.
static PLANTED: AtomicUsize = AtomicUsize::new(NAMES.len());

/// The pulse that a fault spoils.
const SPOILED: usize = 5;

/// Has every frame that is planned from now on spoiled by the fault of this name, which zeros fill up.
///
/// # Panics
/// No fault has this name.
pub fn plant(name: [u8; 8]) {
    let is_it = |known: &&str| name.iter().copied().eq(known.bytes().chain([0; 8]).take(8));
    let fault = NAMES.iter().position(is_it).expect("a fault's name");
    PLANTED.store(fault, Ordering::Relaxed);
}

/// Spoils the first `n` of the ticks, which have room for one more, and gives their new number.
pub fn spoil(ticks: &mut [u32], n: usize, length: u32) -> usize {
    let (Some(fault), true) = (NAMES.get(PLANTED.load(Ordering::Relaxed)), n > SPOILED + 1) else {
        return n;
    };
    match *fault {
        "lost" => {
            ticks.copy_within(SPOILED + 1..n, SPOILED);
            return n - 1;
        }
        "twice" => {
            ticks.copy_within(SPOILED..n, SPOILED + 1);
            ticks[SPOILED + 1] += length + MIN_LOW;
            return n + 1;
        }
        "early" => ticks[SPOILED] -= 1,
        "late" => ticks[SPOILED] += 1,
        _ => ticks[SPOILED] = ticks[SPOILED - 1] + length + MIN_LOW,
    }
    n
}
