//! The control for `no_panic`: slices of different lengths, the one documented panic. It must not link.
#![no_std]
#![no_main]

use core::hint::black_box;

use shutter_curve::{CubicBezier, ShutterCurve};

#[path = "../link.rs"]
mod link;
#[path = "../machine.rs"]
mod machine;

use link::panicked;

fn run() -> ! {
    let ramp = CubicBezier::new(black_box([(0.0, 0.0); 4]));
    if let Ok(curve) = ShutterCurve::new(ramp, ramp) {
        let (u, mut t) = (black_box([0.5; 5]), [0.0; 5]);
        // An index would be a panic of its own.
        curve.inverse_cdf_slice(u.get(..black_box(4)).unwrap_or(&[]), &mut t);
        black_box(t);
    }
    link::run()
}
