//! Errors to make on purpose, to see that the check sees them: `TRIGGER_FAULT=lost` (or `twice`, `early`, `late`,
//! `close`) when this is built.

use crate::limits::MIN_LOW;

const FAULT: Option<&str> = option_env!("TRIGGER_FAULT");

/// The pulse that a fault spoils.
const SPOILED: usize = 5;

/// Spoils the first `n` of the ticks, which have room for one more, and gives their new number.
pub fn spoil(ticks: &mut [u32], n: usize, length: u32) -> usize {
    let (Some(fault), true) = (FAULT, n > SPOILED + 1) else { return n };
    match fault {
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
        "close" => ticks[SPOILED] = ticks[SPOILED - 1] + length + MIN_LOW,
        _ => panic!("TRIGGER_FAULT is lost, twice, early, late or close"),
    }
    n
}
