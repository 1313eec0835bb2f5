//! A second set of mechanics and instruments on which nothing was tuned, mostly by equations of motion, for one honest
//! count.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use shutter_fit::trace::Trace;
use strum::EnumIter;

use crate::generator::{Case, Random, Truth, circle};

#[derive(Clone, Copy, Debug, PartialEq, Eq, EnumIter)]
pub enum Mechanics {
    /// Straight-edged leaves on cranks, which overlap when closed, before a round pupil.
    Cranks,
    /// Cloth curtains on rollers, braked at their ends, with a slit that is narrower than the gate.
    Rollers,
    /// Metal curtains that strike their stops and come back, farther than their overlap hides.
    Rebound,
    /// A blade on a moving coil, with its inductance and back EMF, and a rubber stop.
    Coil,
    /// A plate with a slot that falls past a square beam.
    Falls,
    /// The sector of a cine camera's disc before a rectangular gate.
    Cine,
    /// A microscopic plate that a voltage snaps to its stop, and that rings when let go.
    Snaps,
    /// A wire of shape memory, with its latent heat.
    Memory,
    /// A ferroelectric liquid crystal, driven both ways.
    Crystal,
    /// A Pockels cell whose crystal rings.
    Pockels,
    /// A gated image intensifier: its gain droops, its phosphor recombines by pairs.
    Phosphor,
    /// An iris whose ring sticks and slips on a soft drive.
    Slips,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, EnumIter)]
pub enum Instrument {
    Clean,
    /// Twelve bits, and times that jitter.
    Jitter,
    EightBits,
    Few,
    /// Some two periods of hum.
    Mains,
    /// Noise of the same power in every octave, of sines.
    Sines,
    Capacitor,
    LostRows,
    /// A slow drift that bends.
    Bending,
    /// Noise that grows with the light.
    Shot,
}

const STEPS: usize = 80_000;
/// An integration's step; all its steps last for 20.
const DT: f64 = 1.0 / 4000.0;

/// A motion's places, and how many steps go by in a unit of its time.
struct Path(Vec<f64>, f64);

impl Path {
    /// `step` moves the state on by `DT` and gives the place; the place 1 is first reached at the time 1.
    fn new<S>(mut state: S, mut step: impl FnMut(&mut S) -> f64) -> Self {
        let places: Vec<f64> = (0..STEPS).map(|_| step(&mut state)).collect();
        let unit = places.iter().position(|p| *p >= 1.0 - 1e-9).expect("it arrives");
        Self(places, unit as f64 + 1.0)
    }

    /// A mass from rest at 0 until a stop at 1, if any, which throws it back by a share of its speed.
    fn moved(back: Option<f64>, force: impl Fn(f64, f64) -> f64) -> Self {
        Self::new([0.0, 0.0], |[x, speed]| {
            *speed += force(*x, *speed) * DT;
            *x += *speed * DT;
            if let (Some(back), true) = (back, *x > 1.0) {
                (*x, *speed) = (1.0, -back * *speed);
            }
            *x
        })
    }

    /// Before its first step it is at 0.
    fn at(&self, t: f64) -> f64 {
        let x = (t * self.1).clamp(0.0, STEPS as f64 - 1.0);
        let (k, part) = (x as usize, x.fract());
        let before = if k == 0 { 0.0 } else { self.0[k - 1] };
        before + (self.0[k] - before) * part
    }
}

/// The share of a round pupil of radius 1 within a regular polygon whose sides are so far from the centre.
fn polygon(sides: f64, far: f64) -> f64 {
    let far = far.clamp(0.0, 1.0);
    if far <= (PI / sides).cos() {
        sides * far * far * (PI / sides).tan() / PI
    } else {
        1.0 - sides * (far.acos() - far * (1.0 - far * far).sqrt()) / PI
    }
}

fn mechanics(mechanics: Mechanics, random: &mut Random) -> Truth {
    let (start, length) = (random.within(0.26, 0.33), random.within(0.26, 0.38));
    let (a, b) = (random.within(0.08, 0.4) * length, random.within(0.08, 0.4) * length);
    let end = start + length;
    let close = end - b;
    let [u, v, w, z] = [0; 4].map(|_| random.within(0.0, 1.0));
    // From a motion that opens, and another that closes.
    let both = |opens: &Path, closes: &Path, t: f64| opens.at((t - start) / a).min(1.0 - closes.at((t - close) / b));
    match mechanics {
        Mechanics::Cranks => {
            let ring = |drag: f64| Path::moved(Some(0.0), |x, speed| 1.0 - 0.5 * x - drag * speed);
            let (opens, closes, turn) = (ring(1.5 * u), ring(1.5 * v), PI * (0.45 + 0.45 * w));
            let lift = |x: f64| 1.0 - (x * turn).cos() + 0.15 * (x * turn).sin().powi(2);
            let (hidden, sides) = (0.05 + 0.15 * z, 3.0 + (5.0 * z).floor());
            Truth::of(|t| {
                let lifted = lift(both(&opens, &closes, t)) / lift(1.0);
                polygon(sides, (1.1 + hidden) * lifted - hidden)
            })
        }
        Mechanics::Rollers => {
            let curtain = |brake: f64| {
                let held = move |x: f64| if x > 0.86 { brake } else { 0.0 };
                Path::moved(Some(0.0), move |x, speed| 1.0 - 0.4 * x - held(x) * speed)
            };
            let (first, second) = (curtain(3.0 + 6.0 * u), curtain(3.0 + 6.0 * v));
            let (start, travel) = (start.min(0.29) - 0.03, 0.5 * length + 0.08);
            let (late, faster) = (0.55 + 0.2 * z, 0.94 + 0.12 * w);
            let gate = |x: f64| (x - 0.08).max(0.0) / 0.92;
            Truth::of(|t| {
                let z = (t - start) / travel;
                (gate(first.at(z)) - gate(second.at((z - late) * faster))).max(0.0)
            })
        }
        Mechanics::Rebound => {
            let curtain = |back: f64| Path::moved(Some(back), |_, speed| 1.0 - 0.6 * speed);
            let (first, second) = (curtain(0.1 + 0.4 * u), curtain(0.3 + 0.3 * v));
            let gate = |x: f64| ((x - 0.02) / 0.96).clamp(0.0, 1.0);
            Truth::of(|t| {
                let opened = gate(first.at((t - start) / (0.7 * a)));
                (opened - gate(second.at((t - close) / (0.5 * b)))).max(0.0)
            })
        }
        Mechanics::Coil => {
            let blade = |lag: f64, loss: f64| {
                Path::new([0.0, 0.0, 0.0], move |[x, speed, current]| {
                    *current += (1.0 - *current - 0.6 * *speed) / lag * DT;
                    let deep = *x - 1.0;
                    let rubber = 250.0 * deep + 2.0 * loss * 250f64.sqrt() * *speed;
                    *speed += (*current - if deep > 0.0 { rubber.max(0.0) } else { 0.0 }) * DT;
                    *x += *speed * DT;
                    *x
                })
            };
            let (opens, closes) = (blade(0.2 + u, 0.15 + 0.5 * w), blade(0.2 + v, 0.25 + 0.4 * w));
            let (arm, b) = (1.4 + 2.5 * z, 0.6 * b);
            Truth::of(|t| {
                let x = opens.at((t - start) / a).min(1.0 - closes.at((t - close) / b));
                let angle = (1.0 / arm).asin() * 1.08 * (2.0 * x.clamp(0.0, 1.0) - 1.0);
                circle(0.5 + 0.5 * arm * angle.sin())
            })
        }
        Mechanics::Falls => {
            let (above, slot) = (0.05 + 1.5 * u, 1.4 + 2.0 * v);
            let (from, to) = (f64::sqrt(above), f64::sqrt(above + slot + 1.0));
            Truth::of(|t| {
                let fallen = (from + (to - from) * ((t - start) / length).max(0.0)).powi(2) - from.powi(2);
                fallen.clamp(0.0, 1.0) - (fallen - slot).clamp(0.0, 1.0)
            })
        }
        Mechanics::Cine => {
            // The gate is 1 high, and begins so far from the axis.
            let (axis, wide, slower) = (0.5 + 1.5 * u, 0.7 + z, 0.12 * (w - 0.5));
            let (half, sector) = ((0.5 / axis).atan(), 1.5 + 3.0 * v);
            let edge = |angle: f64| {
                let slope = angle.clamp(-half, half).tan();
                let strip = |k: i32| (axis + wide * (f64::from(k) + 0.5) / 32.0) * slope + 0.5;
                (0..32).map(|k| strip(k).clamp(0.0, 1.0)).sum::<f64>() / 32.0
            };
            Truth::of(|t| {
                let z = ((t - start) / length).clamp(0.0, 1.0);
                let turned = (z + slower * z * (1.0 - z)) * (sector + 1.0) * 2.0 * half - half;
                (edge(turned) - edge(turned - 2.0 * half * sector)).max(0.0)
            })
        }
        Mechanics::Snaps => {
            let (pull, damping, hidden) = (0.36 + 0.4 * u, 0.7 + 0.6 * v, 0.06 + 0.1 * w);
            let spring = |x: f64, speed: f64| -x - damping * speed;
            let electric = |x: f64, speed| pull / (1.3 - x).powi(2) + spring(x, speed);
            let snaps = Path::moved(Some(0.3), electric);
            // Seen from the other end.
            let freed = Path::moved(None, |x, speed| 1.0 - x - damping * speed);
            let (close, unit) = (start + 0.65 * length, 0.08 * length + 0.05 * b);
            Truth::of(|t| {
                let x = snaps.at((t - start) / a).min(1.0 - freed.at((t - close) / unit));
                (x.abs() - hidden).max(0.0) / (1.0 - hidden)
            })
        }
        Mechanics::Memory => {
            let wire = |goal: f64| {
                Path::new(0.0, move |x| {
                    *x += (goal - *x) / (1.0 + w * FRAC_PI_2 * (PI * *x).sin()) * DT;
                    *x = f64::min(*x, 1.0);
                    0.5 - 0.5 * (PI * *x).cos()
                })
            };
            let (heats, cools) = (wire(1.5 + 3.0 * u), wire(1.1 + 0.6 * v));
            Truth::of(|t| both(&heats, &cools, t))
        }
        Mechanics::Crystal => {
            let cell = |first: f64, bias: f64| {
                Path::new(first, move |angle: &mut f64| {
                    *angle += angle.sin() * (1.0 + bias * angle.cos()) * DT;
                    (FRAC_PI_2 * (0.5 - 0.5 * angle.cos())).sin().powi(2)
                })
            };
            let (opens, closes) = (cell(0.04 + 0.1 * u, w - 0.5), cell(0.04 + 0.1 * v, z - 0.5));
            Truth::of(|t| both(&opens, &closes, t))
        }
        Mechanics::Pockels => {
            let (lag, share, damping) = (0.05 + 0.15 * u, 0.2 + 0.3 * v, 0.8 + 1.2 * w);
            let cell = Path::new([0.0, 0.0, 0.0], |[volts, strain, speed]| {
                *volts += (1.0 - *volts) / lag * DT;
                *speed += (36.0 * (*volts - *strain) - damping * *speed) * DT;
                *strain += *speed * DT;
                (1.0 - share) * *volts + share * *strain
            });
            let unit = (0.008 + 0.012 * z) * length;
            Truth::of(|t| {
                let turned = cell.at((t - start) / unit) - cell.at((t - close) / unit);
                (FRAC_PI_2 * turned).sin().powi(2)
            })
        }
        Mechanics::Phosphor => {
            let (tau, quench) = ((0.015 + 0.025 * u) * length, 0.3 + 0.7 * v);
            let (droop, off) = (0.02 + 0.1 * w, start + 0.7 * length);
            let (mut n, mut at, step) = (0.0, Vec::with_capacity(STEPS), 1.0 / STEPS as f64);
            for k in 0..STEPS {
                let since = k as f64 * step - start;
                let gain = 1.0 - droop * (1.0 - (-since / (0.3 * length)).exp());
                let lit = if since > 0.0 && since + start < off { gain } else { 0.0 };
                n += (lit - n * n - quench * n) * step / tau;
                at.push(n * n);
            }
            let peak = at.iter().copied().fold(0.0, f64::max);
            let glow = Path(at, STEPS as f64);
            Truth::of(|t| (glow.at(t) / peak).min(1.0))
        }
        Mechanics::Slips => {
            let ring = |sticks: f64, inert: f64| {
                Path::new([0.0, 0.0, 0.0], move |[x, speed, drive]| {
                    *drive = f64::min(*drive + DT, 1.5);
                    let pull = *drive - *x;
                    if *speed > 0.0 || pull > 0.1 + sticks {
                        *speed = f64::max(*speed + (pull - 0.1) / inert.powi(2) * DT, 0.0);
                    }
                    *x = f64::min(*x + *speed * DT, 1.0);
                    *x
                })
            };
            let (opens, closes) = (ring(0.03 + 0.1 * u, 0.02 + 0.05 * w), ring(0.03 + 0.1 * v, 0.02 + 0.05 * z));
            Truth::of(|t| ((1.2 * both(&opens, &closes, t)).sin() / 1.2f64.sin()).powi(2))
        }
    }
}

/// Noise of the same power in every octave and a standard deviation of 1: so many sines to a decade, at random.
fn sines(n: usize, random: &mut Random) -> Vec<f64> {
    const LINES: usize = 160;
    let mut sum = vec![0.0; n];
    for k in 0..LINES {
        let place = (k as f64 + random.within(0.0, 1.0)) / LINES as f64;
        let step = TAU * 0.3 * (n as f64 / 0.6).powf(place) / n as f64;
        let (cosine, sine) = (random.normal(), random.normal());
        for (i, v) in sum.iter_mut().enumerate() {
            let (s, c) = (step * i as f64).sin_cos();
            *v += (cosine * c + sine * s) / (LINES as f64).sqrt();
        }
    }
    sum
}

/// A trace of a shutter by an instrument.
pub fn measured(what: Mechanics, by: Instrument, random: &mut Random) -> Case {
    let truth = mechanics(what, random);
    let few = by == Instrument::Few;
    let n = if few { random.scale(60.0, 400.0) } else { random.scale(600.0, 6000.0) } as usize;
    let noise = random.scale(0.0015, 0.01);
    let mains = if random.within(0.0, 1.0) < 0.5 { 50.0 } else { 60.0 };
    let scale = match by {
        Instrument::Mains => random.within(0.7, 2.2) / mains,
        _ => random.scale(0.003, 0.2),
    };
    let (hum, phase) = (random.scale(0.004, 0.04), random.within(0.0, TAU));
    let passes = (-1.0 / (random.scale(6.0, 40.0) * truth.exposure() * n as f64)).exp();
    let (drift, bend) = (random.within(-0.06, 0.06), random.within(1.0, 4.0));
    let (gain, dark) = (random.scale(0.1, 4.0), random.within(-0.5, 0.5));
    let slow = if by == Instrument::Sines { sines(n, random) } else { Vec::new() };
    let bits = match by {
        Instrument::EightBits => 200.0,
        Instrument::Jitter => 3000.0,
        _ => 1e6,
    };
    let (mut times, mut values, mut charge) = (Vec::new(), Vec::new(), 0.0);
    for k in 0..n {
        let t = (k as f64 + 0.5) / n as f64;
        let light = truth.mean(t, 1.0 / n as f64);
        let white = noise * slow.get(k).copied().unwrap_or_else(|| random.normal());
        let v = match by {
            Instrument::Mains => light + white + hum * (TAU * mains * t * scale + phase).sin(),
            Instrument::Bending => light + white + drift * (-bend * t).exp(),
            Instrument::Shot => light + white * (0.1 + 0.9 * light).sqrt(),
            Instrument::Capacitor => {
                let before = charge;
                charge = light + (charge - light) * passes;
                light + white - 0.5 * (before + charge)
            }
            _ => light + white,
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
    Case { truth, trace: Trace { times, values }, scale, noise, others: Vec::new() }
}
