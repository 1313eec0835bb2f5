//! Links only if no panic can be reached: every public function with inputs that the compiler knows nothing of.
//!
//! Left out are `expect!`, which exists to panic in a constant, and `Debug`, `Display` and `defmt::Format`: core's
//! formatting has panics of its own. As the program `panic` it is the control, which must not link: `expect!` too.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;

#[path = "../machine.rs"]
mod machine;

/// Calls what does not exist.
fn panicked(_: &PanicInfo) -> ! {
    unsafe extern "C" {
        safe fn a_panic_can_be_reached() -> !;
    }
    a_panic_can_be_reached()
}

fn run() -> ! {
    if let b"panic" = env!("CARGO_BIN_NAME").as_bytes() {
        let curve = black_box(shutter_curve::ShutterCurve::linear(0.0, 1.0, 2.0, 3.0));
        black_box(shutter_curve::expect!(curve));
    }
    let us: &[f32] = black_box(&[0.5; 300]);
    black_box(measured::answers::of_ramps(black_box([[(0.0, 0.0); 4]; 2]), us));
    // Ends nowhere: what ends a program may panic.
    loop {
        core::hint::spin_loop();
    }
}
