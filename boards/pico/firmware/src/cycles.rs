//! The processor's cycles.

use cortex_m::peripheral::{SYST, syst::SystClkSource};

/// Counts cycles, by a counter that is nobody else's.
pub struct Cycles {
    _counter: SYST,
}

/// The counter has 24 bits.
const RANGE: u32 = 1 << 24;

impl Cycles {
    /// Starts the counter.
    pub fn new(mut syst: SYST) -> Self {
        syst.set_clock_source(SystClkSource::Core);
        syst.set_reload(RANGE - 1);
        syst.clear_current();
        syst.enable_counter();
        Self { _counter: syst }
    }

    /// What a job of up to 2²⁴ cycles, 134 ms, gives, and the cycles that it takes.
    pub fn of<T>(&self, job: impl FnOnce() -> T) -> (T, u32) {
        let begun = SYST::get_current();
        let done = job();
        (done, begun.wrapping_sub(SYST::get_current()) % RANGE)
    }
}
