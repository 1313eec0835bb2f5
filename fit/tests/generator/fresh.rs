//! Mechanics and lamps on which nothing was tuned, for one honest count.

use std::f64::consts::{PI, TAU};

use super::Random;
use super::physics::{Measured, Openness};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Device {
    /// A disc with a sector cut out, whose speed swings.
    Disc,
    /// A vane on a spring and a magnet: of second order, hardly damped.
    Vane,
    /// A mirror that sweeps a beam of a normal profile across a pinhole, and swings out.
    Mirror,
    /// A twisted cell that relaxes with a bump.
    Cell,
    /// A leaf that stops on its way, then goes on.
    Stages,
    /// A leaf that creeps when it is nearly closed.
    Creep,
    /// A blade that strikes the frame and lets some light in twice more.
    Strikes,
    /// Any rise and fall, from random points.
    Wild,
    /// A lamp that grows brighter while it is measured.
    Warming,
    /// A lamp on the mains behind a rectifier: its light is the current's size.
    Rectified,
    /// Noise that grows with the light, of a colour.
    Shot,
    /// A vane, recorded through a capacitor.
    CoupledVane,
}

pub const DEVICES: [Device; 12] = [
    Device::Disc,
    Device::Vane,
    Device::Mirror,
    Device::Cell,
    Device::Stages,
    Device::Creep,
    Device::Strikes,
    Device::Wild,
    Device::Warming,
    Device::Rectified,
    Device::Shot,
    Device::CoupledVane,
];

/// The step response of a swinging body: from 0 to 1.
fn response(t: f64, period: f64, damping: f64) -> f64 {
    if t <= 0.0 {
        return 0.0;
    }
    let (w, root) = (TAU / period, (1.0 - damping * damping).sqrt());
    let angle = w * root * t;
    1.0 - (-damping * w * t).exp() * (angle.cos() + damping / root * angle.sin())
}

/// The normal distribution, near enough and without a corner.
fn normal_sum(x: f64) -> f64 {
    0.5 * (1.0 + (0.797_88 * (x + 0.044_715 * x * x * x)).tanh())
}

fn smooth(z: f64) -> f64 {
    let z = z.clamp(0.0, 1.0);
    z * z * z * (10.0 - z * (15.0 - 6.0 * z))
}

fn mechanics(device: Device, random: &mut Random) -> Openness {
    let start = random.within(0.25, 0.33);
    let length = random.within(0.28, 0.4);
    let ramp = random.within(0.08, 0.25) * length;
    let end = start + length;
    let shut = random.within(0.08, 0.25) * length;
    let plain = move |t: f64| smooth((t - start) / ramp).min(smooth((end - t) / shut));
    let (u, v) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
    match device {
        Device::Disc => {
            let swing = move |t: f64| t + 0.01 * u * (TAU * t / (0.1 + 0.2 * v)).sin() / TAU;
            Openness::new(move |t| {
                let t = swing(t);
                ((t - start) / ramp).clamp(0.0, 1.0) - ((t - end + ramp) / ramp).clamp(0.0, 1.0)
            })
        }
        Device::Vane | Device::CoupledVane => {
            let (period, damping) = (2.0 * ramp, 0.25 + 0.4 * u);
            Openness::new(move |t| {
                let at =
                    response(t - start, period, damping) - response(t - end + shut, period, 0.8);
                // The hole is covered as the vane goes; it cannot be more than open.
                at.clamp(0.0, 1.1).min(1.0) - 0.5 * (at - 1.0).clamp(0.0, 0.1)
            })
        }
        Device::Mirror => Openness::new(move |t| {
            let at = response(t - start, 1.5 * ramp, 0.4 + 0.3 * u)
                - response(t - end + shut, shut, 0.9);
            let dark = normal_sum(-2.5);
            (normal_sum(5.0 * at - 2.5) - dark) / (1.0 - 2.0 * dark)
        }),
        Device::Cell => Openness::new(move |t| {
            let late = (t - end + shut).max(0.0) / (0.3 * shut);
            let up = 1.0 - (-((t - start).max(0.0) / (0.3 * ramp)).powi(2)).exp();
            let bump = 0.06 * u * late * late * (2.0 - 0.7 * late).clamp(-0.3, 2.0) * (-late).exp();
            up * ((-late).exp() * (1.0 + late) + bump).max(0.0)
        }),
        Device::Stages => Openness::new(move |t| {
            let rest = 0.5 + 0.4 * u;
            let second = start + ramp * (1.0 + v);
            let up = rest * smooth((t - start) / ramp)
                + (1.0 - rest) * smooth((t - second) / (0.5 * ramp));
            up.min(smooth((end - t) / shut))
        }),
        Device::Creep => Openness::new(move |t| {
            let late = (t - end + shut).max(0.0) / shut;
            let down =
                (1.0 - late).max(0.0).powi(2) * (1.0 - 0.15) + 0.15 * (-late / (0.5 + u)).exp();
            smooth((t - start) / ramp) * if late > 0.0 { down } else { 1.0 }
        }),
        Device::Strikes => Openness::new(move |t| {
            let again = |after: f64, wide: f64, high: f64| {
                let x = (t - end - after) / wide;
                if (0.0..1.0).contains(&x) { high * (PI * x).sin().powi(2) } else { 0.0 }
            };
            let high = 0.02 + 0.15 * u;
            plain(t)
                + again(0.3 * shut, 0.5 * shut, high)
                + again(1.0 * shut, 0.3 * shut, 0.4 * high)
        }),
        Device::Wild => {
            let mut knots = vec![0.0];
            for _ in 0..5 {
                knots.push(knots[knots.len() - 1] + random.within(0.05, 1.0));
            }
            let top = knots[5];
            let rise = move |z: f64| {
                let z = 5.0 * z.clamp(0.0, 1.0);
                let k = (z as usize).min(4);
                (knots[k] + (knots[k + 1] - knots[k]) * smooth(z - k as f64)) / top
            };
            Openness::new(move |t| rise((t - start) / ramp).min(rise((end - t) / shut)))
        }
        _ => Openness::new(plain),
    }
}

/// A trace of a device.
pub fn measured(device: Device, random: &mut Random) -> Measured {
    let truth = mechanics(device, random);
    let scale = random.scale(0.005, 0.1);
    let n = random.scale(700.0, 6000.0) as usize;
    let noise = random.scale(0.001, 0.008);
    let (phase, slope) = (random.within(0.0, PI), random.within(0.01, 0.05));
    let lamp = |t: f64| match device {
        Device::Warming => 1.0 + slope * (t - 0.5),
        Device::Rectified => {
            0.8 + 0.2 * (100.0 * PI * t * scale + phase).sin().abs() * std::f64::consts::FRAC_PI_2
        }
        _ => 1.0,
    };
    let tau = random.scale(0.4, 20.0);
    let (mut charge, mut last) = (0.0, 0.0);
    let mut values = Vec::new();
    let mut times = Vec::new();
    for i in 0..n {
        let t = (i as f64 + 0.5) / n as f64;
        let mut v = lamp(t) * truth.mean(t, 1.0 / n as f64);
        if device == Device::CoupledVane {
            charge += (v - charge) / (tau * n as f64);
            v -= charge;
        }
        let fresh = random.normal();
        last = if device == Device::Shot { 0.6 * last + 0.8 * fresh } else { fresh };
        let size = if device == Device::Shot { (0.1 + v.max(0.0)).sqrt() } else { 1.0 };
        values.push(3.0 * (v + noise * size * last) - 1.0);
        times.push(scale * t);
    }
    Measured { truth, times, values, scale, shift: 0.0, others: Vec::new() }
}
