//! Every `f32` in [0, 1], against a second formulation in doubles.
//!
//! The `p` of one `u` is the guess for the next, so that a Newton step or two give the exact time, and all
//! 1 065 353 217 of them take a minute or two a curve.

use std::sync::atomic::{AtomicU32, Ordering};

use shutter_curve::ShutterCurve;

use crate::Result;
use crate::support::cases::{CASES, shutter};
use crate::support::curves::named;
use crate::support::oracle::{Curve, Exact, Points, rounding_cell, ulp_f32};

/// The bits of 1: those of the `f32` in [0, 1] are at most these.
const LAST: u32 = 1.0f32.to_bits();
/// The bits that one thread takes at a time.
const CHUNK: u32 = 1 << 22;
/// Every so many answers are judged by the double-double oracle too.
const SAMPLED: u32 = 1 << 18;

/// What a sweep found; the parts of one add up.
#[derive(Clone, Copy, Debug, Default)]
struct Sweep {
    count: u64,
    out_of_range: u64,
    steps_back: u64,
    /// The greatest |t - exact| in ulp(t).
    forward: f64,
    /// The greatest error in ulp(u) once half an ulp(t) is forgiven.
    backward: f64,
    /// The same by the oracle, where the two greatest were found and on samples.
    judged: f64,
    evaluations: u32,
}

impl Sweep {
    fn and(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            out_of_range: self.out_of_range + other.out_of_range,
            steps_back: self.steps_back + other.steps_back,
            forward: self.forward.max(other.forward),
            backward: self.backward.max(other.backward),
            judged: self.judged.max(other.judged),
            evaluations: self.evaluations.max(other.evaluations),
        }
    }
}

/// A sweep as a line of `docs/every-f32.csv`.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Row {
    pub curve: String,
    pub kind: String,
    pub cells: usize,
    pub count: u64,
    pub out_of_range: u64,
    pub steps_back: u64,
    pub forward: f64,
    pub backward: f64,
    pub judged: f64,
    pub evaluations: u32,
    pub seconds: f64,
}

const TYPICAL: [&str; 6] =
    ["rman_soft", "raised_cosine", "trapezoid", "triangle", "fast_open_slow_close", "pedestal_.2"];
const HARD: [&str; 6] = [
    "ends of order p^6",
    "time stands still inside",
    "openness touches 0 inside",
    "a vertical step",
    "ramps of 1e-6 beside a plateau of 1",
    "times from -1 to 1",
];

/// Below this, no octave serves, whatever their number.
const LOWEST_OCTAVE: f32 = 1.0 / (1 << 20) as f32;

/// Twelve curves: 8 octaves on every `f32`, then other counts where octaves serve. `found` hears of each row.
pub fn every_f32(bar: &indicatif::ProgressBar, found: impl Fn(&[Row]) -> Result) -> Result {
    let typical = named().into_iter().filter(|named| TYPICAL.contains(&named.name));
    let typical = typical.map(|named| (named.name, "typical", named.curve));
    let hard = CASES.iter().filter(|case| HARD.contains(&case.name));
    let hard = hard.map(|case| (case.name, "hard", case.curve()));
    let curves: Vec<_> = typical.chain(hard).collect();
    let upper = u64::from(LAST - LOWEST_OCTAVE.to_bits()) + 1;
    bar.set_length(curves.len() as u64 * (u64::from(LAST) + 1 + 3 * upper));
    let mut rows = Vec::new();
    for cells in [8, 0, 4, 16] {
        for (name, kind, curve) in &curves {
            let start = std::time::Instant::now();
            let tick = |count| bar.inc(count);
            let swept = match cells {
                8 => sweep::<8>(curve, 0.0, &tick),
                0 => sweep::<0>(curve, LOWEST_OCTAVE, &tick),
                4 => sweep::<4>(curve, LOWEST_OCTAVE, &tick),
                _ => sweep::<16>(curve, LOWEST_OCTAVE, &tick),
            };
            rows.push(Row {
                curve: name.to_string(),
                kind: kind.to_string(),
                cells,
                count: swept.count,
                out_of_range: swept.out_of_range,
                steps_back: swept.steps_back,
                forward: swept.forward,
                backward: swept.backward,
                judged: swept.judged,
                evaluations: swept.evaluations,
                seconds: start.elapsed().as_secs_f64(),
            });
            found(&rows)?;
        }
    }
    Ok(())
}

/// Sweeps the `f32` from `first` to 1 on two threads; `tick` hears how many are done.
fn sweep<const CELLS: usize>(curve: &Curve, first: f32, tick: &(impl Fn(u64) + Sync)) -> Sweep {
    let (shutter, exact) = (&shutter::<CELLS>(curve), &Exact::new(curve));
    let next = &AtomicU32::new(first.to_bits());
    let work = move || {
        let mut found = Sweep::default();
        loop {
            let from = next.fetch_add(CHUNK, Ordering::Relaxed);
            if from > LAST {
                return found;
            }
            let to = from.saturating_add(CHUNK - 1).min(LAST);
            found = found.and(part(shutter, exact, from, to));
            tick(u64::from(to - from) + 1);
        }
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(work);
        work().and(other.join().expect("the sweep does not panic"))
    })
}

fn part<const CELLS: usize>(
    shutter: &ShutterCurve<CELLS>,
    exact: &Exact,
    from: u32,
    to: u32,
) -> Sweep {
    let mut found = Sweep { count: u64::from(to - from) + 1, ..Sweep::default() };
    let mut follower = Follower::new(exact.curve());
    let (start, end) = (shutter.open_start(), shutter.close_end());
    // The neighbour below, so that no pair is left out between two parts.
    let mut last = if from == 0 { start } else { shutter.inverse_cdf(f32::from_bits(from - 1)) };
    let mut worst = [from; 2];
    for bits in from..=to {
        let u = f32::from_bits(bits);
        let t = shutter.inverse_cdf(u);
        found.out_of_range += u64::from(!(t >= start && t <= end));
        found.steps_back += u64::from(t < last);
        last = t;
        if bits % 16 == 0 {
            found.evaluations = found.evaluations.max(shutter.evaluations(u));
        }
        let (forward, backward) = follower.errors(u, t);
        if forward > found.forward {
            (found.forward, worst[0]) = (forward, bits);
        }
        if backward > found.backward {
            (found.backward, worst[1]) = (backward, bits);
        }
        if bits % SAMPLED == 0 {
            found.judged = found.judged.max(exact.judge(u, t).backward);
        }
    }
    for u in worst.map(f32::from_bits) {
        found.judged = found.judged.max(exact.judge(u, shutter.inverse_cdf(u)).backward);
    }
    found
}

/// The exact inverse for a slowly moving `u`.
struct Follower {
    /// The opening ramp from its outer and its inner end, and the closing ramp from the same.
    ends: [[End; 2]; 2],
    /// The mass of the opening ramp, of the closing ramp, and of all.
    mass: [f64; 2],
    area: f64,
    /// When the plateau starts.
    plateau: f64,
    /// Does the curve run across time 0? Then errors are relative to the greater end.
    across: Option<f64>,
}

impl Follower {
    fn new(curve: &Curve) -> Self {
        let back = |[a, b, c, d]: Points| [d, c, b, a];
        let (opening, closing) = (curve.opening, curve.closing);
        let ends = [
            [End::new(opening), End::new(back(opening))],
            [End::new(back(closing)), End::new(closing)],
        ];
        let mass = [0, 1].map(|i| 0.5 * (ends[i][0].mass(1.0).0 + ends[i][1].mass(1.0).0));
        let [start, open, close, end] =
            [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()]
                .map(f64::from);
        let area = mass[0] + mass[1] + (close - open);
        let across = (start < 0.0 && end > 0.0).then(|| ulp_f32(end.max(-start)));
        Self { ends, mass, area, plateau: open, across }
    }

    /// The errors of `t`: in ulp(t), and in ulp(u) once half an ulp(t) is forgiven.
    fn errors(&mut self, u: f32, t: f32) -> (f64, f64) {
        if u == 0.0 || u == 1.0 {
            return (0.0, 0.0);
        }
        let u = f64::from(u);
        let (before, after) = (u * self.area, (1.0 - u) * self.area);
        let (exact, density, noise) = if before < self.mass[0] {
            self.on_ramp(0, before)
        } else if after < self.mass[1] {
            self.on_ramp(1, after)
        } else {
            (self.plateau + (before - self.mass[0]), 1.0, 0.0)
        };
        let error = (f64::from(t) - exact).abs();
        let ulp = self.across.unwrap_or(ulp_f32(exact));
        // Where the density is next to nothing doubles cannot tell the time to an ulp.
        let told = noise <= density * ulp * 0.002;
        let [low, high] = rounding_cell(t);
        let excess = (low - exact).max(exact - high).max(0.0);
        (if told { error / ulp } else { 0.0 }, excess * density / self.area / ulp_f32(u))
    }

    /// The time and the openness where a ramp has collected `mass` from its outer end, and how uncertain
    /// that mass is.
    fn on_ramp(&mut self, ramp: usize, mass: f64) -> (f64, f64, f64) {
        let rest = self.mass[ramp] - mass;
        let inner = rest < mass;
        let noise = if inner { self.area } else { mass } * 4e-15;
        let (time, density) =
            self.ends[ramp][usize::from(inner)].at(if inner { rest } else { mass });
        (time, density, noise)
    }
}

/// A ramp in powers of the `p` that counts from one of its ends.
struct End {
    t: [f64; 4],
    f: [f64; 4],
    mass: [f64; 7],
    /// Where the last answer was.
    p: f64,
}

/// The polynomial's value and slope.
fn horner<const N: usize>(c: &[f64; N], x: f64) -> (f64, f64) {
    c.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c, slope * x + value))
}

impl End {
    fn new(points: Points) -> Self {
        let powers = |v: [f32; 4]| {
            let v = v.map(f64::from);
            let d = [v[1] - v[0], v[2] - v[1], v[3] - v[2]];
            [v[0], 3.0 * d[0], 3.0 * (d[1] - d[0]), d[2] - 2.0 * d[1] + d[0]]
        };
        let (t, f) = (powers(points.map(|p| p.0)), powers(points.map(|p| p.1)));
        let mut mass = [0.0; 7];
        for i in 0..4 {
            for j in 1..4 {
                mass[i + j] += f[i] * t[j] * j as f64 / (i + j) as f64;
            }
        }
        // Backwards in time the mass still counts up.
        let sign = if points[3].0 < points[0].0 { -1.0 } else { 1.0 };
        Self { t, f, mass: mass.map(|c| sign * c), p: 0.5 }
    }

    fn mass(&self, p: f64) -> (f64, f64) {
        horner(&self.mass, p)
    }

    /// The time and the openness where `mass` is collected from here.
    fn at(&mut self, mass: f64) -> (f64, f64) {
        let mut p = self.p;
        let mut steps = 0;
        loop {
            let (value, slope) = self.mass(p);
            let step = (mass - value) / slope;
            p += step;
            // The square of a step this small is beyond a double.
            if step.abs() <= 1e-8 * p && p <= 1.0 {
                break;
            }
            steps += 1;
            if steps > 20 || !(p > 0.0 && p <= 1.0) {
                p = self.bisect(mass);
                break;
            }
        }
        self.p = p;
        (horner(&self.t, p).0, horner(&self.f, p).0)
    }

    fn bisect(&self, mass: f64) -> f64 {
        let (mut low, mut high) = (0.0f64, 1.0f64);
        // The middle of the bit patterns, which halves exponents first.
        while high.to_bits() - low.to_bits() > 1 {
            let middle = f64::from_bits((low.to_bits() + high.to_bits()) / 2);
            *(if self.mass(middle).0 < mass { &mut low } else { &mut high }) = middle;
        }
        high
    }
}
