//! The control for `no_panic`: `expect_valid` of an error, the one documented panic. It must not link.
#![no_std]
#![no_main]

#[path = "../link.rs"]
mod link;
#[path = "../machine.rs"]
mod machine;

use link::panicked;

fn run() -> ! {
    let curve = core::hint::black_box(shutter_curve::ShutterCurve::linear(0.0, 1.0, 2.0, 3.0));
    core::hint::black_box(shutter_curve::expect_valid(curve));
    link::run()
}
