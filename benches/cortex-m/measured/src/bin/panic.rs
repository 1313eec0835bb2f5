//! The control for `no_panic`: slices of different lengths, the one documented panic. It must not link.
#![no_std]
#![no_main]

#[path = "../link.rs"]
mod link;
#[path = "../machine.rs"]
mod machine;

use link::panicked;

fn run() -> ! {
    let curve = core::hint::black_box(shutter_curve::ShutterCurve::linear(0.0, 1.0, 2.0, 3.0));
    let _ = curve.map(|curve| curve.inverse_cdf_slice(&[0.5], &mut [0.0; 2]));
    link::run()
}
