//! The contrast to the state machine: pulses from the interrupt of the chip's alarm, which counts microseconds. For the
//! table in boards/pico/README.md; a lamp deserves better.
//!
//! While GP4 is high the processor is busy: it plans, and hands the plan over in a critical section.
#![no_std]
#![no_main]

use core::cell::RefCell;

use cortex_m::asm;
use critical_section::Mutex;
use embedded_hal::digital::{InputPin, OutputPin};
use firmware::board::{Board, unmask};
use rp2040_hal::fugit::MicrosDurationU64;
use rp2040_hal::gpio::bank0::{Gpio2, Gpio3};
use rp2040_hal::gpio::{FunctionSioInput, FunctionSioOutput, Interrupt, Pin, PullDown};
use rp2040_hal::pac::{self, interrupt};
use rp2040_hal::timer::{Alarm, Alarm0, Instant};
use rp2040_hal::{Timer, entry};
use strobe::{CURVES, TICK_HZ};

type Ticks = [u32; 32];

struct Firing {
    timer: Timer,
    alarm: Alarm0,
    start: Pin<Gpio2, FunctionSioInput, PullDown>,
    lamp: Pin<Gpio3, FunctionSioOutput, PullDown>,
    /// When the frame started, its ticks, and how many of them are fired.
    base: Instant,
    ticks: Ticks,
    fired: usize,
}

static FIRING: Mutex<RefCell<Option<Firing>>> = Mutex::new(RefCell::new(None));

impl Firing {
    /// Sets the alarm to the microsecond nearest to the next pulse.
    fn arm(&mut self) {
        if let Some(tick) = self.ticks.get(self.fired) {
            const TICKS: u32 = TICK_HZ / 1_000_000;
            let delay = MicrosDurationU64::from_ticks(u64::from((tick + TICKS / 2) / TICKS));
            let _ = self.alarm.schedule_at(self.base + delay);
        }
    }
}

fn with(then: impl FnOnce(&mut Firing)) {
    critical_section::with(|cs| FIRING.borrow_ref_mut(cs).as_mut().map(then));
}

#[interrupt]
fn IO_IRQ_BANK0() {
    with(|firing| {
        firing.start.clear_interrupt(Interrupt::EdgeHigh);
        firing.base = firing.timer.get_counter();
        firing.fired = 0;
        firing.arm();
    });
}

#[interrupt]
fn TIMER_IRQ_0() {
    with(|firing| {
        let _ = firing.lamp.set_high();
        firing.alarm.clear_interrupt();
        firing.fired += 1;
        firing.arm();
        let _ = firing.lamp.set_low();
    });
}

fn plan() -> Ticks {
    let mut ticks = [0; 32];
    CURVES[0].ticks_into(&mut ticks, TICK_HZ, 0).unwrap();
    ticks
}

#[entry]
fn main() -> ! {
    let mut board = Board::take();
    let mut timer = board.timer;
    let mut alarm = timer.alarm_0().unwrap();
    alarm.enable_interrupt();
    let start: Pin<_, FunctionSioInput, _> = board.start.reconfigure();
    start.set_interrupt_enabled(Interrupt::EdgeHigh, true);
    let lamp = board.lamp.reconfigure();
    let base = timer.get_counter();
    let firing = Firing { timer, alarm, start, lamp, base, ticks: plan(), fired: usize::MAX };
    critical_section::with(|cs| FIRING.replace(cs, Some(firing)));
    unmask(pac::Interrupt::IO_IRQ_BANK0);
    unmask(pac::Interrupt::TIMER_IRQ_0);
    loop {
        if board.busy.is_high().unwrap() {
            let ticks = plan();
            with(|firing| firing.ticks = ticks);
        } else {
            asm::wfe();
        }
    }
}
