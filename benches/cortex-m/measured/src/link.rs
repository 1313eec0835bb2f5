//! What must link without a panic: every public function with inputs that the compiler knows nothing of.
//!
//! Left out are `expect_valid`, which exists to panic in a constant, and `Debug`, `Display` and `defmt::Format`: core's
//! formatting has panics of its own.

use core::hint::black_box;
use core::panic::PanicInfo;

/// A program that links only where its panic handler is never needed: it calls what does not exist.
pub fn panicked(_: &PanicInfo) -> ! {
    unsafe extern "C" {
        safe fn a_panic_can_be_reached() -> !;
    }
    a_panic_can_be_reached()
}

pub fn run() -> ! {
    let us: &[f32] = black_box(&[0.5; 300]);
    black_box(measured::answers::of_ramps(black_box([[(0.0, 0.0); 4]; 2]), us));
    // Ends nowhere: what ends a program may panic.
    loop {
        core::hint::spin_loop();
    }
}
