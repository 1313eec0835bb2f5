//! A leaf shutter behind one capacitor, or two: of 2 to 50 Hz, by a sound card's samples.

use shutter_fit::trace::Trace;

use crate::families::{Measured, Openness};
use crate::generator::{Random, circle};

/// A trace of one shot, or of three; `poles` are the capacitors' frequencies in hertz.
pub fn measured(
    exposure: f64,
    poles: &[f64],
    window: (f64, f64),
    shots: u32,
    falls: bool,
    random: &mut Random,
) -> Measured {
    let rate = if random.within(0.0, 1.0) < 0.5 { 44_100.0 } else { 48_000.0 };
    let noise = random.scale(0.001, 0.01);
    let (a, b) = (random.within(0.1, 0.4) * exposure, random.within(0.1, 0.4) * exposure);
    // A leaf's ramps let half of the light through.
    let open = exposure - 0.5 * (a + b);
    let (before, after) = window;
    let length = before + after;
    let leaf = |z: f64| {
        let z = z.clamp(0.0, 1.0);
        circle(z * z * (3.0 - 2.0 * z))
    };
    let shown = move |t: f64| leaf(t / a).min(leaf((a + open + b - t) / b));
    let truth = Openness::new(|t| shown(t * length - before));
    let (fine, n) = (16, (rate * length * f64::from(shots)) as usize);
    let step = 1.0 / (rate * fine as f64);
    let mut charges = vec![0.0; poles.len()];
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for k in 0..n {
        let mut sum = 0.0;
        for i in 0..fine {
            let t = (k * fine + i) as f64 * step + 0.5 * step;
            let mut v = shown(t % length - before);
            for (charge, hertz) in charges.iter_mut().zip(poles) {
                let keeps = (-std::f64::consts::TAU * hertz * step).exp();
                let now = *charge * keeps + v * (1.0 - keeps);
                (v, *charge) = (v - 0.5 * (now + *charge), now);
            }
            sum += v / fine as f64;
        }
        let sign = if falls { -1.0 } else { 1.0 };
        let v = sign * (sum + noise * random.normal());
        times.push((k as f64 + 0.5) / rate);
        values.push((12_000.0 * v).round());
    }
    // Which of several shots was fitted is not known.
    let others = if shots > 1 { vec![truth.exposure() * length] } else { Vec::new() };
    Measured { truth, trace: Trace { times, values }, scale: length, others }
}
