//! One Bezier as a density, by the terms of the note that this crate implements: the curve `(t(p), f(p))`, its integral
//! `cdf(p) = K ∫ f t' dp`, the factor `K` that makes all of it 1, and the inverse.
//!
//! `cargo run --example density`

use shutter_curve::{CubicBezier, CurveError, ShutterCurve};

const POINTS: [(f32, f32); 4] = [(0.0, 0.0), (1.0, 80.0), (2.0, 80.0), (5.0, 10.0)];
/// Densities of up to 128 fit an openness of up to 1: a power of two rounds nothing.
const SCALE: f32 = 1.0 / 128.0;

/// A Bezier's value at `p`, and its slope.
fn bezier(c: [f64; 4], p: f64) -> (f64, f64) {
    let q = 1.0 - p;
    let value = c[0] * q * q * q + 3.0 * c[1] * q * q * p + 3.0 * c[2] * q * p * p + c[3] * p * p * p;
    let slope = (c[1] - c[0]) * q * q + 2.0 * (c[2] - c[1]) * q * p + (c[3] - c[2]) * p * p;
    (value, 3.0 * slope)
}

fn main() -> Result<(), CurveError> {
    let curve = ShutterCurve::density(CubicBezier::new(POINTS).scaled(SCALE))?;
    let k = curve.normalization() * SCALE;
    println!("K = {k}\n\n    p      t(p)   K ∫ f t' dp       cdf(t)  inverse_cdf");
    let (t, f) = (POINTS.map(|point| point.0.into()), POINTS.map(|point| point.1.into()));
    // The integral by the midpoint rule, to hold the closed form against.
    const STEPS: u32 = 100_000;
    let mut integral = 0.0;
    for i in 0..STEPS {
        let p = (f64::from(i) + 0.5) / f64::from(STEPS);
        integral += bezier(f, p).0 * bezier(t, p).1 / f64::from(STEPS);
        if (i + 1) % (STEPS / 10) == 0 {
            let p = f64::from(i + 1) / f64::from(STEPS);
            let time = bezier(t, p).0 as f32;
            let cdf = curve.cdf(time);
            println!("{p:5.1} {time:9.6} {:13.7} {cdf:12.7} {:12.6}", f64::from(k) * integral, curve.inverse_cdf(cdf));
        }
    }
    Ok(())
}
