//! The rows of a table that a terminal shows.

use std::ops::Range;

/// Longer tables lose their middle; half as many rows stay at each end.
const MOST_ROWS: usize = 25;

/// The rows of a table of `n` that are left out.
pub fn hidden_rows(n: usize) -> Range<usize> {
    if n > MOST_ROWS { MOST_ROWS / 2..n - MOST_ROWS / 2 } else { n..n }
}
