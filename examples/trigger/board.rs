//! The board: a counter, a timer with an interrupt, and the trigger line. All at 25 MHz.

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::NVIC;

/// The rate of the counter and the timer.
pub const TICK_HZ: u32 = 25_000_000;

/// The CMSDK APB timer 0: counts down to 0 and interrupts.
const TIMER: usize = 0x4000_0000;
/// The CMSDK dual timer's first half: 32 bits, free-running, downwards.
const COUNTER: usize = 0x4000_2000;
/// The user LEDs; the first one is the trigger line.
const LEDS: usize = 0x4002_8000;

/// The interrupt of [`TIMER`].
pub const TIMER_IRQ: i16 = 8;

#[derive(Clone, Copy)]
struct Timer;

// SAFETY: the number is that of an interrupt of this board.
unsafe impl InterruptNumber for Timer {
    fn number(self) -> u16 {
        TIMER_IRQ as u16
    }
}

fn write(block: usize, register: usize, value: u32) {
    // SAFETY: only called with the registers of this file, which have no effect on memory.
    unsafe { ((block + register) as *mut u32).write_volatile(value) }
}

fn read(block: usize, register: usize) -> u32 {
    // SAFETY: as for `write`.
    unsafe { ((block + register) as *const u32).read_volatile() }
}

/// Starts the counter `ticks` before it wraps, and lets the timer interrupt.
pub fn start(ticks: u32) {
    write(COUNTER, 0x0, ticks - 1);
    write(COUNTER, 0x8, 1 << 7 | 1 << 1);
    // Once an interrupt has come, the timer starts over from far away.
    write(TIMER, 0x8, u32::MAX);
    write(TIMER, 0x0, 1 << 3 | 1 << 0);
    // SAFETY: no critical section relies on the mask.
    unsafe { NVIC::unmask(Timer) }
}

/// The ticks since an arbitrary moment, modulo 2³².
pub fn now() -> u32 {
    !read(COUNTER, 0x4)
}

/// Has the timer interrupt once, in so many ticks, at least 1.
pub fn interrupt_in(ticks: u32) {
    write(TIMER, 0xC, 1);
    write(TIMER, 0x4, ticks);
}

/// The timer's interrupt is answered.
pub fn acknowledge() {
    write(TIMER, 0xC, 1);
}

/// Raises or lowers the trigger line.
pub fn trigger_line(high: bool) {
    write(LEDS, 0x0, u32::from(high));
}
