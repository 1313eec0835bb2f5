//! The unit of time, and the limits of what one edge starts.

/// The rate at which the state machine runs, and so the unit of every duration: 8 ns.
pub const TICK_HZ: u32 = 125_000_000;
/// The most pulses in a frame.
pub const LONGEST_FRAME: usize = 64;
/// The most pulses of all frames that one edge starts.
pub const MOST_PULSES: usize = 1024;
/// The latest that a pulse may start after the edge, in ticks: 17 s.
pub const LATEST: u64 = 1 << 31;
/// The shortest pulse, in ticks: a `mov` and one `jmp`.
pub const MIN_PULSE: u32 = 2;
/// The least time between two pulses, in ticks: what the state machine takes from one to the next.
pub const MIN_LOW: u32 = 6;
/// From the edge that starts a frame to a pulse at tick 0: what the state machine takes once it has seen the edge.
pub const OVERHEAD: u32 = 5;
