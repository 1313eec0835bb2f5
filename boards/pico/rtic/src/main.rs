//! A frame as a task of RTIC.
#![no_std]
#![no_main]
#![allow(missing_docs)]

use shutter_curve::{ShutterCurve, valid};

static SHUTTER: ShutterCurve = valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));

/// The second boot stage, which sets up the Pico's flash.
#[allow(unsafe_code)]
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        cortex_m::asm::bkpt();
    }
}

#[rtic::app(device = rp2040_hal::pac, dispatchers = [SW0_IRQ])]
mod app {
    use embedded_hal::digital::OutputPin;
    use rp2040_hal::Sio;
    use rp2040_hal::gpio::bank0::Gpio3;
    use rp2040_hal::gpio::{FunctionSioOutput, Pin, Pins, PullDown};
    use rtic_monotonics::rp2040::prelude::*;

    use crate::SHUTTER;

    rp2040_timer_monotonic!(Mono);

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        lamp: Pin<Gpio3, FunctionSioOutput, PullDown>,
    }

    #[init]
    fn init(cx: init::Context) -> (Shared, Local) {
        let mut resets = cx.device.RESETS;
        Mono::start(cx.device.TIMER, &resets, Priority::rtic_default());
        let sio = Sio::new(cx.device.SIO);
        let pins = Pins::new(cx.device.IO_BANK0, cx.device.PADS_BANK0, sio.gpio_bank0, &mut resets);
        let _ = fire::spawn(Mono::now() + 10.millis());
        (Shared {}, Local { lamp: pins.gpio3.reconfigure() })
    }

    // docs/firmware.md:
    #[task(local = [lamp])]
    async fn fire(cx: fire::Context, base: <Mono as Timebase>::Instant) {
        let Ok(ticks) = SHUTTER.trigger_ticks(16, 1_000_000) else { return };
        for tick in ticks {
            Mono::delay_until(base + u64::from(tick).micros()).await;
            let _ = cx.local.lamp.set_high();
            Mono::delay(2.micros()).await;
            let _ = cx.local.lamp.set_low();
        }
    }
    // :docs/firmware.md
}
