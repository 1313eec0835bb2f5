//! A frame as a task of embassy.
#![no_std]
#![no_main]

use embassy_executor::Spawner;
use embassy_time::{Duration, Instant, Timer};
use embedded_hal::digital::OutputPin;
use rp2040_hal::gpio::bank0::Gpio3;
use rp2040_hal::gpio::{FunctionSioOutput, Pin, Pins, PullDown};
use rp2040_hal::{Sio, pac};
use shutter_curve::{ShutterCurve, valid};

static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));

type Lamp = Pin<Gpio3, FunctionSioOutput, PullDown>;

// docs/firmware.md:
#[embassy_executor::task]
async fn fire(mut lamp: Lamp, base: Instant) {
    let Ok(ticks) = SHUTTER.trigger_ticks(16, 1_000_000) else { return };
    for tick in ticks {
        Timer::at(base + Duration::from_micros(tick.into())).await;
        let _ = lamp.set_high();
        Timer::after_micros(2).await;
        let _ = lamp.set_low();
    }
}
// :docs/firmware.md

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    let chip = pac::Peripherals::take().unwrap();
    let mut resets = chip.RESETS;
    let sio = Sio::new(chip.SIO);
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, &mut resets);
    let base = Instant::now() + Duration::from_millis(10);
    spawner.spawn(fire(pins.gpio3.reconfigure(), base).unwrap());
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        cortex_m::asm::bkpt();
    }
}
