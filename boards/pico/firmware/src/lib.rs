//! The parts of the chip that the strobe controller, and the alarm beside it, are made of.
#![no_std]

pub mod board;
pub mod console;
pub mod cycles;
pub mod flash;
pub mod output;

/// A debugger stops here; without one, the processor stops for good.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        cortex_m::asm::bkpt();
    }
}
