//! Synthetic traces with a known truth. Nothing here is shared with what is tested: a shutter is any function of time,
//! integrated numerically, and a recorder samples that.

use std::env;
use std::f64::consts::TAU;
use std::fmt::Debug;
use std::ops::Range;
use std::str::FromStr;

use shutter_fit::trace::Trace;
use shutter_fit::{Fit, Kind, Options, fit};

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
        let (u, v) = (self.within(1e-300, 1.0), self.within(0.0, TAU));
        (-2.0 * u.ln()).sqrt() * v.cos()
    }
}

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
    pub fn new(opening: impl Fn(f64) -> f64, closing: impl Fn(f64) -> f64, times: [f64; 4]) -> Self {
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

    /// From when to when it is at least so open.
    pub fn within_openness(&self, least: f64) -> [f64; 2] {
        let is_open = |v: &f64| *v >= least;
        let places = [self.at.iter().position(is_open), self.at.iter().rposition(is_open)];
        let time = |place: usize| self.times[0] + (self.times[3] - self.times[0]) * place as f64 / FINE as f64;
        places.map(|place| time(place.expect("it opens")))
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
    fn mean(&self, t: f64, width: f64) -> f64 {
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

/// A trace with its truth, which is in the time of the trace.
pub struct Case {
    pub truth: Truth,
    pub trace: Trace,
    /// The times are these many times the truth's.
    pub scale: f64,
    /// The noise's share of the light.
    pub noise: f64,
    /// Another exposure that is as true: of shots of which one is fitted.
    pub other: Option<f64>,
    /// The simplest kind that has the shutter's curve, if any has it.
    pub kind: Option<Kind>,
    /// Start to open, open, start to close, closed, as far as it is known.
    pub times: Option<[f64; 4]>,
    /// Errors up to this share of the exposure are not wrong.
    pub allowed: f64,
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

/// The noise from one sample to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grain {
    White,
    /// It grows with the light.
    Shot,
    /// An autoregressive noise, 0.8 from one sample to the next.
    Coloured,
    /// 1/f noise, by octaves of which each changes half as often as the one above (Voss and McCartney).
    Octaves,
    /// 1/f noise, by sines of random frequencies, so many to a decade.
    Sines,
}

impl Grain {
    /// So many samples of a standard deviation of 1.
    fn samples(self, n: usize, random: &mut Random) -> Vec<f64> {
        const OCTAVES: usize = 12;
        const LINES: usize = 160;
        let mut white: Vec<f64> = (0..n).map(|_| random.normal()).collect();
        match self {
            Self::White | Self::Shot => (),
            Self::Coloured => (1..n).for_each(|i| white[i] = 0.8 * white[i - 1] + 0.6 * white[i]),
            Self::Octaves => {
                let mut octaves = [0; OCTAVES].map(|_| random.normal());
                for (i, v) in white.iter_mut().enumerate() {
                    octaves[(i.max(1).trailing_zeros() as usize).min(OCTAVES - 1)] = *v;
                    *v = octaves.iter().sum::<f64>() / (OCTAVES as f64).sqrt();
                }
            }
            Self::Sines => {
                white.fill(0.0);
                for k in 0..LINES {
                    let place = (k as f64 + random.within(0.0, 1.0)) / LINES as f64;
                    let step = TAU * 0.3 * (n as f64 / 0.6).powf(place) / n as f64;
                    let (high, phase) = ((2.0 / LINES as f64).sqrt(), random.within(0.0, TAU));
                    let waves = white.iter_mut().enumerate();
                    waves.for_each(|(i, v)| *v += high * (step * i as f64 + phase).sin());
                }
            }
        }
        white
    }
}

/// A function of time, where the trace is from 0 to 1.
pub type Over = Box<dyn Fn(f64) -> f64>;

/// What makes a trace of a truth.
pub struct Recorder {
    /// Of a shot, which lasts so many seconds; there may be several, and each other one lasts so many times as long.
    pub samples: f64,
    pub scale: f64,
    pub shots: usize,
    pub ratio: f64,
    /// Full light, and the dark beside it.
    pub gain: f64,
    pub dark: f64,
    pub noise: f64,
    pub grain: Grain,
    /// It shows what it has gathered since its last sample, not the moment.
    pub gathers: bool,
    /// By what the light is multiplied, and what is added to the signal.
    pub lamp: Over,
    pub beside: Over,
    /// Capacitors, by one over their time constants.
    pub poles: Vec<f64>,
    /// The most that its amplifier shows; is the noise, but for a tenth, from before it?
    pub clip: f64,
    pub is_clipped_with_noise: bool,
    /// So many steps of the values in full light.
    pub steps: f64,
    /// By how much of a sample times are off.
    pub jitter: f64,
    /// The share of the trace from where to where is lost.
    pub lost: Range<f64>,
}

impl Recorder {
    /// An undisturbed one.
    pub fn new(samples: f64, scale: f64, noise: f64) -> Self {
        Self {
            samples,
            scale,
            shots: 1,
            ratio: 1.0,
            gain: 1.0,
            dark: 0.0,
            noise,
            grain: Grain::White,
            gathers: true,
            lamp: Box::new(|_| 1.0),
            beside: Box::new(|_| 0.0),
            poles: Vec::new(),
            clip: f64::INFINITY,
            is_clipped_with_noise: false,
            steps: 1e9,
            jitter: 0.0,
            lost: 0.0..0.0,
        }
    }

    pub fn record(&self, truth: Truth, random: &mut Random) -> Case {
        let (mut times, mut values, mut from) = (Vec::new(), Vec::new(), 0.0);
        let mut charges = vec![0.0; self.poles.len()];
        for shot in 0..self.shots {
            let longer = if shot % 2 == 1 { self.ratio } else { 1.0 };
            let n = (self.samples * longer) as usize;
            let grain = self.grain.samples(n, random);
            // Many parts of a sample, so that no capacitor sees a staircase.
            let parts = if self.gathers { 8 } else { 1 };
            let width = 1.0 / (n * parts) as f64;
            for (i, grain) in grain.into_iter().enumerate() {
                let mut light = 0.0;
                for part in 0..parts {
                    let t = ((i * parts + part) as f64 + 0.5) * width;
                    let open = if self.gathers { truth.mean(t, width) } else { truth.openness(t) };
                    let mut v = open * (self.lamp)(t);
                    for (charge, rate) in charges.iter_mut().zip(&self.poles) {
                        let now = v + (*charge - v) * (-rate * width * longer).exp();
                        (v, *charge) = (v - 0.5 * (now + *charge), now);
                    }
                    light += v / parts as f64;
                }
                let t = (i as f64 + 0.5) / n as f64;
                let seen = if self.grain == Grain::Shot { (0.1 + 0.9 * light.max(0.0)).sqrt() } else { 1.0 };
                let noise = self.noise * grain * seen;
                let shown = match self.is_clipped_with_noise {
                    true => (light + noise).min(self.clip) + 0.1 * self.noise * random.normal(),
                    false => light.min(self.clip) + noise,
                };
                let shown = ((shown + (self.beside)(t)) * self.steps).round() / self.steps;
                let late = self.jitter * random.within(-1.0, 1.0) / n as f64;
                if !self.lost.contains(&t) {
                    times.push(from + self.scale * longer * (t + late));
                    values.push(self.dark + self.gain * shown);
                }
            }
            from += self.scale * longer;
        }
        let other = (self.shots > 1).then(|| self.ratio * self.scale * truth.exposure());
        let trace = Trace { times, values };
        Case { truth, trace, scale: self.scale, noise: self.noise, other, kind: None, times: None, allowed: 0.0 }
    }
}
