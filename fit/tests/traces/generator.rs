//! Synthetic traces with a known truth. Nothing here is shared with what is tested: a shutter is any function of time,
//! sampled and integrated numerically.

// Each test needs a part.
#![allow(dead_code)]

use std::env;
use std::fmt::Debug;
use std::str::FromStr;

use shutter_fit::trace::Trace;
use shutter_fit::{Fit, Options, fit};

/// What a function is of each number below `n`, by two threads, since most tests of fits are one long loop.
pub fn each<T: Send>(n: u32, of: impl Fn(u32) -> T + Sync) -> Vec<T> {
    let half = |from: u32, to: u32| (from..to).map(&of).collect::<Vec<T>>();
    std::thread::scope(|scope| {
        let first = scope.spawn(|| half(0, n / 2));
        let second = half(n / 2, n);
        first.join().expect("its panic has been printed").into_iter().chain(second).collect()
    })
}

/// What a variable of the environment asks for.
pub fn asked<T: FromStr<Err: Debug>>(name: &str, otherwise: T) -> T {
    env::var(name).map_or(otherwise, |n| n.parse().expect("a whole number"))
}

/// The value below which so large a share of all lies.
pub fn quantile(values: impl Iterator<Item = f64>, q: f64) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(((values.len().max(1) - 1) as f64 * q).round() as usize).copied().unwrap_or(0.0)
}

/// Random numbers: Marsaglia's xorshift, seeded.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        (0..8).for_each(|_| _ = random.next());
        random
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// Uniform in [a, b).
    pub fn within(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Uniform by its logarithm.
    pub fn scale(&mut self, a: f64, b: f64) -> f64 {
        self.within(a.ln(), b.ln()).exp()
    }

    pub fn normal(&mut self) -> f64 {
        let (u, v) = (self.within(1e-300, 1.0), self.within(0.0, std::f64::consts::TAU));
        (-2.0 * u.ln()).sqrt() * v.cos()
    }
}

/// The shutters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shutter {
    Box,
    Trapezoid,
    Leaf,
    Iris,
    LiquidCrystal,
    Symmetric,
    Cubic,
}

pub const SHUTTERS: [Shutter; 7] = {
    use Shutter::*;
    [Box, Trapezoid, Leaf, Iris, LiquidCrystal, Symmetric, Cubic]
};

/// What disturbs a trace beside white noise, or instead of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Disturbance {
    White,
    /// An autoregressive noise, 0.8 from one sample to the next.
    Coloured,
    Hum,
    Drift,
    /// 1/f noise instead.
    Pink,
}

const OCTAVES: usize = 12;

/// A ramp from 0 at 0 to 1 at 1.
type Ramp = Box<dyn Fn(f64) -> f64>;

/// So many places at which the truth is worked out.
const FINE: usize = 60_000;

/// The truth: an openness over time, integrated by sums.
pub struct Truth {
    /// The openness, at even places from the first of the times to the last, and the integral up to each.
    at: Vec<f64>,
    sums: Vec<f64>,
    /// Start to open, open, start to close, closed; where that is not known, from the trace's start to its end.
    pub times: [f64; 4],
}

impl Truth {
    /// A ramp, a plateau, and a ramp that is seen backwards.
    pub fn new(opening: Ramp, closing: Ramp, times: [f64; 4]) -> Self {
        let [start, open, close, end] = times;
        let openness = |t: f64| match t {
            _ if t < open => opening((t - start) / (open - start)),
            _ if t <= close => 1.0,
            _ => closing((end - t) / (end - close)),
        };
        Self::within(openness, times)
    }

    /// Any openness over a trace, which is from 0 to 1.
    pub fn of(openness: impl Fn(f64) -> f64) -> Self {
        Self::within(openness, [0.0, 0.0, 1.0, 1.0])
    }

    fn within(openness: impl Fn(f64) -> f64, times: [f64; 4]) -> Self {
        let width = (times[3] - times[0]) / FINE as f64;
        let at: Vec<f64> = (0..FINE).map(|i| openness(times[0] + (i as f64 + 0.5) * width)).collect();
        let (mut sum, mut sums) = (0.0, vec![0.0]);
        for v in &at {
            sum += v * width;
            sums.push(sum);
        }
        Self { at, sums, times }
    }

    /// How many of the places have gone by.
    fn places(&self, t: f64) -> f64 {
        (t - self.times[0]) / (self.times[3] - self.times[0]) * FINE as f64
    }

    pub fn openness(&self, t: f64) -> f64 {
        let place = self.places(t);
        if (0.0..=FINE as f64).contains(&place) { self.at[(place as usize).min(FINE - 1)] } else { 0.0 }
    }

    pub fn exposure(&self) -> f64 {
        self.sums[FINE]
    }

    pub fn efficiency(&self) -> f64 {
        self.exposure() / (self.times[3] - self.times[0])
    }

    /// The integral up to a time.
    fn collected(&self, t: f64) -> f64 {
        let x = self.places(t).clamp(0.0, FINE as f64);
        let i = (x as usize).min(FINE - 1);
        self.sums[i] + (self.sums[i + 1] - self.sums[i]) * (x - i as f64)
    }

    /// The mean around a time.
    pub fn mean(&self, t: f64, width: f64) -> f64 {
        (self.collected(t + 0.5 * width) - self.collected(t - 0.5 * width)) / width
    }

    /// When the fraction `u` of the exposure is collected.
    pub fn trigger(&self, u: f64) -> f64 {
        let target = u * self.exposure();
        let i = self.sums.partition_point(|sum| *sum < target).clamp(1, FINE);
        let part = (target - self.sums[i - 1]) / (self.sums[i] - self.sums[i - 1]);
        let width = (self.times[3] - self.times[0]) / FINE as f64;
        self.times[0] + (i as f64 - 1.0 + part) * width
    }
}

/// A cubic Bezier with these inner control points.
pub fn bezier([x1, y1, x2, y2]: [f64; 4]) -> Ramp {
    let cubic = |a: f64, b: f64, p: f64| {
        let r = 1.0 - p;
        3.0 * r * r * p * a + 3.0 * r * p * p * b + p * p * p
    };
    Box::new(move |z| {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..50 {
            let p = 0.5 * (low + high);
            if cubic(x1, x2, p) < z { low = p } else { high = p }
        }
        cubic(y1, y2, low)
    })
}

/// The uncovered part of a circle behind an edge that has gone so far across it.
pub fn circle(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    ((1.0 - 2.0 * x).acos() - (1.0 - 2.0 * x) * 2.0 * (x * (1.0 - x)).sqrt()) / std::f64::consts::PI
}

pub fn truth(shutter: Shutter, random: &mut Random) -> Truth {
    let start = random.within(0.15, 0.35);
    let length = random.within(0.3, 0.5);
    let (a, b) = (random.within(0.05, 0.45) * length, random.within(0.05, 0.45) * length);
    let times = [start, start + a, start + length - b, start + length];
    let straight = || -> Ramp { Box::new(|z| z) };
    let controls = |random: &mut Random| [0; 4].map(|_| random.within(0.0, 1.0));
    match shutter {
        Shutter::Box => Truth::new(straight(), straight(), [start, start, start + length, start + length]),
        Shutter::Trapezoid => Truth::new(straight(), straight(), times),
        // The blades start from rest and uncover a round pupil; they come back at their own pace.
        Shutter::Leaf => {
            let (p, q) = (random.within(1.0, 2.0), random.within(1.0, 2.0));
            let blade = |p: f64| -> Ramp { Box::new(move |z| circle(z.powf(p))) };
            Truth::new(blade(p), blade(q), times)
        }
        // A round hole whose radius grows, evenly or with a smooth start.
        Shutter::Iris => {
            let (p, q) = (random.within(1.0, 1.5), random.within(1.0, 1.5));
            let radius = |p: f64| -> Ramp { Box::new(move |z| z.powf(2.0 * p)) };
            Truth::new(radius(p), radius(q), times)
        }
        // Driven open in an exponential, relaxing in a slower one with a tail of ten time constants.
        Shutter::LiquidCrystal => {
            let (rise, fall) = (random.within(0.02, 0.06), random.within(0.03, 0.08));
            let (rise, fall) = (rise * length, fall * length);
            let open = start + 10.0 * rise;
            let close = open.max(start + random.within(0.4, 0.7) * length);
            let end = (1.0f64 - 2e-2).min(close + 10.0 * fall);
            let (tau, tail) = (rise / (open - start), fall / (end - close));
            Truth::new(
                Box::new(move |z| 1.0 - (-z / tau).exp()),
                Box::new(move |z| (-(1.0 - z) / tail).exp()),
                [start, open, close, end],
            )
        }
        Shutter::Symmetric => {
            let controls = controls(random);
            Truth::new(bezier(controls), bezier(controls), times)
        }
        Shutter::Cubic => Truth::new(bezier(controls(random)), bezier(controls(random)), times),
    }
}

/// A trace with its truth, which is in the time of the trace.
pub struct Case {
    pub truth: Truth,
    pub trace: Trace,
    /// The times are these many times the truth's.
    pub scale: f64,
    /// The noise's share of the light.
    pub noise: f64,
    /// Another exposure that is as true: of shots that differ, and of those of which one is fitted.
    pub others: Vec<f64>,
}

impl Case {
    /// The fit of the trace.
    pub fn fitted(&self, options: &Options) -> Fit {
        fit(&self.trace, options, &mut |_| ()).expect("a fit")
    }

    /// When so much of the light has come, in the time of the trace.
    pub fn trigger(&self, u: f64) -> f64 {
        self.truth.trigger(u) * self.scale
    }

    /// In the time of the trace.
    pub fn exposure(&self) -> f64 {
        self.truth.exposure() * self.scale
    }
}

pub fn case(shutter: Shutter, disturbance: Disturbance, random: &mut Random) -> Case {
    let truth = truth(shutter, random);
    let n = random.scale(400.0, 4000.0) as usize;
    let noise = random.scale(0.003, 0.02);
    traced(truth, disturbance, n, noise, random)
}

pub fn traced(truth: Truth, disturbance: Disturbance, n: usize, noise: f64, random: &mut Random) -> Case {
    let (scale, dark) = (random.scale(1e-4, 10.0), random.within(-1.0, 1.0));
    let light = random.scale(0.05, 5.0) * if random.within(0.0, 1.0) < 0.3 { -1.0 } else { 1.0 };
    // One detector shows the moment, the other what it has gathered since its last sample.
    let gathers = random.within(0.0, 1.0) < 0.5;
    let step = 1.0 / n as f64;
    let (periods, phase) = (random.scale(3.0, 30.0), random.within(0.0, 6.3));
    let hum = random.scale(0.005, 0.03);
    let drift = random.within(-0.05, 0.05);
    let mut last = random.normal();
    let mut octaves = [0; OCTAVES].map(|_| random.normal());
    let mut values = Vec::with_capacity(n);
    for i in 0..n {
        let t = (i as f64 + 0.5) * step;
        let f = if gathers { truth.mean(t, step) } else { truth.openness(t) };
        let fresh = random.normal();
        last = match disturbance {
            Disturbance::Coloured => 0.8 * last + 0.6 * fresh,
            // Each octave changes half as often as the one above (Voss and McCartney).
            Disturbance::Pink => {
                octaves[(i.max(1).trailing_zeros() as usize).min(OCTAVES - 1)] = fresh;
                octaves.iter().sum::<f64>() / (OCTAVES as f64).sqrt()
            }
            _ => fresh,
        };
        let beside = match disturbance {
            Disturbance::Hum => hum * (std::f64::consts::TAU * periods * t + phase).sin(),
            Disturbance::Drift => drift * t,
            _ => 0.0,
        };
        values.push(dark + light * (f + noise * last + beside));
    }
    let times = (0..n).map(|i| scale * (i as f64 + 0.5) * step).collect();
    Case { truth, trace: Trace { times, values }, scale, noise, others: Vec::new() }
}
