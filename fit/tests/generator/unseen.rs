//! Mechanics and instruments on which nothing was tuned, for one honest count.

use std::f64::consts::{PI, TAU};

use super::physics::{Measured, Openness};
use super::{Random, circle};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mechanics {
    /// Two curtains that are pulled by springs, before a round hole.
    Curtains,
    /// An iris of five blades on a cam, whose area is the square of its opening.
    Iris,
    /// A leaf on a solenoid, against friction, that strikes its stop and rebounds.
    Solenoid,
    /// A cell whose fall is a stretched exponential.
    Stretched,
    /// A disc with a sector, whose edge crosses a round beam.
    Chopper,
    /// A blade that catches half of the way.
    Catches,
    /// A lamp's afterglow behind an electronic switch.
    Afterglow,
    /// A plateau that sinks by some percent.
    Sinks,
    /// Two polarisers, of which one turns: there is no plateau.
    Polariser,
    /// Blades that turn back before they are open.
    TurnsBack,
    /// Leaves on a cam of the fifth order, around a star.
    CamLeaf,
    /// A blade that sticks until a spring tears it off, against a damper, up to a stop.
    Sticks,
    /// A hole in a turning disc before a smaller round beam.
    Disc,
}

/// Made after the others had been looked at.
pub const LATER: [Mechanics; 3] = [Mechanics::CamLeaf, Mechanics::Sticks, Mechanics::Disc];

pub const MECHANICS: [Mechanics; 10] = [
    Mechanics::Curtains,
    Mechanics::Iris,
    Mechanics::Solenoid,
    Mechanics::Stretched,
    Mechanics::Chopper,
    Mechanics::Catches,
    Mechanics::Afterglow,
    Mechanics::Sinks,
    Mechanics::Polariser,
    Mechanics::TurnsBack,
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instrument {
    Clean,
    /// Twelve bits, and times that jitter.
    Jitter,
    EightBits,
    Few,
    Mains,
    /// Noise of the same power in every octave.
    Pink,
    Capacitor,
    LostRows,
    /// An exponential drift.
    Warming,
    /// Clipped before the noise is added, so that nothing shows it.
    Clipped,
}

pub const INSTRUMENTS: [Instrument; 10] = [
    Instrument::Clean,
    Instrument::Jitter,
    Instrument::EightBits,
    Instrument::Few,
    Instrument::Mains,
    Instrument::Pink,
    Instrument::Capacitor,
    Instrument::LostRows,
    Instrument::Warming,
    Instrument::Clipped,
];

/// The place of a body that a growing force pulls against friction, until a stop throws it back by a share of its speed.
fn solenoid(lag: f64, rebound: f64) -> impl Fn(f64) -> f64 {
    const STEPS: usize = 4000;
    let (mut x, mut v, mut places) = (0.0, 0.0, vec![0.0]);
    for k in 0..3 * STEPS {
        let t = k as f64 / STEPS as f64;
        let force = 4.0 * (1.0 - (-t / lag).exp()) - 0.4;
        v += f64::max(force, if v > 0.0 { force } else { 0.0 }) / STEPS as f64;
        x += v / STEPS as f64;
        if x > 1.0 {
            (x, v) = (1.0, -rebound * v);
        }
        places.push(f64::max(x, 0.0));
    }
    move |t| places[((t.max(0.0) * STEPS as f64) as usize).min(3 * STEPS)]
}

/// The place of a mass on a damped spring that is let go, which stays where it has come to the stop.
fn spring(damping: f64) -> impl Fn(f64) -> f64 {
    const STEPS: usize = 4000;
    let (mut x, mut v, mut places) = (0.0, 0.0, vec![0.0]);
    for _ in 0..3 * STEPS {
        v += (9.0 * (1.05 - x) - 6.0 * damping * v) / STEPS as f64;
        x = f64::min(x + v / STEPS as f64, 1.0);
        places.push(x);
    }
    move |t| places[((t.max(0.0) * STEPS as f64) as usize).min(3 * STEPS)]
}

/// The share of a disc of radius 1 that a larger one covers, so far away.
fn overlap(radius: f64, apart: f64) -> f64 {
    if apart <= radius - 1.0 {
        return 1.0;
    }
    if apart >= radius + 1.0 {
        return 0.0;
    }
    let (d, r) = (apart, radius);
    let alpha = ((d * d + 1.0 - r * r) / (2.0 * d)).clamp(-1.0, 1.0).acos();
    let beta = ((d * d + r * r - 1.0) / (2.0 * d * r)).clamp(-1.0, 1.0).acos();
    (alpha - 0.5 * (2.0 * alpha).sin() + r * r * (beta - 0.5 * (2.0 * beta).sin())) / PI
}

fn mechanics(mechanics: Mechanics, random: &mut Random) -> Openness {
    let (start, length) = (random.within(0.27, 0.34), random.within(0.25, 0.38));
    let end = start + length;
    let (a, b) = (random.within(0.1, 0.35) * length, random.within(0.1, 0.35) * length);
    let (u, v) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
    let up = move |t: f64| ((t - start) / a).clamp(0.0, 1.0);
    let down = move |t: f64| ((end - t) / b).clamp(0.0, 1.0);
    // From rest to rest.
    let cam = |z: f64| z - (TAU * z).sin() / TAU;
    match mechanics {
        Mechanics::Curtains => Openness::new(move |t| {
            let pulled = |z: f64| (z * (0.4 + 0.6 * z * (1.0 - 0.3 * u))) / (1.0 - 0.18 * u);
            circle(pulled(up(t))) - circle(1.0 - pulled(down(t)))
        }),
        Mechanics::Iris => Openness::new(move |t| {
            let radius = |z: f64| (1.0 - 0.5 * u) * cam(z) + 0.5 * u * z;
            radius(up(t)).powi(2).min(radius(down(t)).powi(2))
        }),
        Mechanics::Solenoid => {
            let place = solenoid(0.1 + 0.5 * u, 0.05 + 0.3 * v);
            Openness::new(move |t| {
                circle(place((t - start) / a).min(1.0 - place((t - end + b) / b)))
            })
        }
        Mechanics::Stretched => Openness::new(move |t| {
            let late = (t - end + b).max(0.0) / (0.3 * b);
            (1.0 - (-(t - start).max(0.0) / (0.2 * a)).exp()) * (-late.powf(0.6 + 0.3 * u)).exp()
        }),
        Mechanics::Chopper => Openness::new(move |t| circle(up(t)).min(circle(down(t)))),
        Mechanics::Catches => Openness::new(move |t| {
            let z = up(t);
            let (at, wide) = (0.4 + 0.3 * u, 0.05 + 0.2 * v);
            let gone = (z - ((z - at).clamp(0.0, wide))) / (1.0 - wide);
            circle(gone).min(circle(down(t)))
        }),
        Mechanics::Afterglow => Openness::new(move |t| {
            let glow = |t: f64| {
                (1.0 - 0.2 * u) * (-t / (0.02 * length)).exp()
                    + 0.2 * u * (-t / (0.1 * length)).exp()
            };
            if t < start {
                0.0
            } else {
                let lit = 1.0 - glow(t - start);
                if t < end { lit } else { lit * glow(t - end) }
            }
        }),
        Mechanics::Sinks => Openness::new(move |t| {
            let sunk = (0.01 + 0.06 * u) * ((t - start - a) / length).clamp(0.0, 1.0);
            (cam(up(t)) - sunk).max(0.0).min(cam(down(t)))
        }),
        Mechanics::Polariser => Openness::new(move |t| {
            let z = ((t - start) / length).clamp(0.0, 1.0);
            (0.4 + 0.5 * u) * (PI * z).sin().powi(2)
        }),
        Mechanics::TurnsBack => Openness::new(move |t| {
            let z = ((t - start) / length).clamp(0.0, 1.0);
            (0.2 + 0.5 * u) * circle((2.0 * z.min(1.0 - z)).powf(1.0 + v))
        }),
        Mechanics::CamLeaf => Openness::new(move |t| {
            let place = |z: f64| z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z);
            place(up(t)).powf(1.3 + 0.7 * u).min(place(down(t)).powf(1.3 + 0.7 * v))
        }),
        Mechanics::Sticks => {
            let (opens, closes) = (spring(0.2 + 0.7 * u), spring(0.2 + 0.7 * v));
            Openness::new(move |t| {
                circle(opens((t - start) / a).min(1.0 - closes((t - end + b) / b)))
            })
        }
        Mechanics::Disc => Openness::new(move |t| {
            // The hole's radius, and how far it is from the beam, whose radius is 1.
            let hole = 1.2 + 1.5 * u;
            let apart = (t - start - 0.5 * length).abs() * 2.0 * (hole + 1.0) / length;
            overlap(hole, apart)
        }),
    }
}

/// Noise of the same power in every octave, by Voss and McCartney's method, of a standard deviation of 1.
fn pink(n: usize, random: &mut Random) -> Vec<f64> {
    const ROWS: u32 = 12;
    let mut rows = [0; ROWS as usize].map(|_| random.normal());
    let next = |k: usize| {
        let row = (k.max(1).trailing_zeros()).min(ROWS - 1);
        rows[row as usize] = random.normal();
        rows.iter().sum::<f64>() / f64::from(ROWS).sqrt()
    };
    (0..n).map(next).collect()
}

/// A trace of a shutter by an instrument, and the noise's share of the light, by which its results may be off.
pub fn measured(what: Mechanics, by: Instrument, random: &mut Random) -> (Measured, f64) {
    let truth = mechanics(what, random);
    let n = match by {
        Instrument::Few => random.scale(60.0, 400.0),
        _ => random.scale(600.0, 6000.0),
    } as usize;
    let noise = random.scale(0.0015, 0.01);
    let mains = [50.0, 60.0][usize::from(random.within(0.0, 1.0) < 0.5)];
    let scale = match by {
        Instrument::Mains => random.within(0.7, 2.2) / mains,
        _ => random.scale(0.003, 0.2),
    };
    let (size, phase) = (random.scale(0.004, 0.04), random.within(0.0, TAU));
    let tau = random.scale(6.0, 40.0) * truth.exposure();
    let clip = random.within(0.85, 0.97);
    let (gain, dark, drift) =
        (random.scale(0.1, 4.0), random.within(-0.5, 0.5), random.within(-0.06, 0.06));
    let slow = if by == Instrument::Pink { pink(n, random) } else { Vec::new() };
    let (mut times, mut values) = (Vec::new(), Vec::new());
    let mut charge = 0.0;
    for k in 0..n {
        let t = (k as f64 + 0.5) / n as f64;
        let mut v = truth.mean(t, 1.0 / n as f64);
        match by {
            Instrument::Mains => v += size * (TAU * mains * t * scale + phase).sin(),
            Instrument::Warming => v += drift * (1.0 - (-2.0 * t).exp()),
            Instrument::Clipped => v = v.min(clip * truth.at.iter().copied().fold(0.0, f64::max)),
            Instrument::Capacitor => {
                charge += (v - charge) / (tau * n as f64);
                v -= charge;
            }
            _ => (),
        }
        v += noise * slow.get(k).copied().unwrap_or_else(|| random.normal());
        let bits = match by {
            Instrument::EightBits => 200.0,
            Instrument::Jitter => 3000.0,
            _ => 1e6,
        };
        let late = if by == Instrument::Jitter { random.within(-0.2, 0.2) / n as f64 } else { 0.0 };
        times.push(scale * (t + late));
        values.push(gain * (v * bits).round() / bits + dark);
    }
    if by == Instrument::LostRows {
        let from = (random.within(0.2, 0.7) * n as f64) as usize;
        let lost = from..from + 3 + (random.scale(0.003, 0.1) * n as f64) as usize;
        times.drain(lost.clone());
        values.drain(lost);
    }
    (Measured { truth, times, values, scale, shift: 0.0, others: Vec::new() }, noise)
}
