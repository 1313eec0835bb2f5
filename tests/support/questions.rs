//! What the curves are asked: the `u`, the times and the frames at which a curve is difficult.

use super::curves::Rng;
use super::oracle::{Dd, Exact, Near, exp2};
use super::promise::{MOST_TRIGGERS, TYPICAL_TICKS};

/// The rates of timers that a design is asked for, in ticks per unit of its time: plain ones, and primes.
const RATES: [u32; 8] = [1, 1000, 48_000, 1_000_000, 7, 1009, 65_537, 999_983];

/// What a curve is asked. The exact answers are found once; every `OCTAVES` is held against them.
pub struct Questions<'a> {
    /// In order, with the exact times.
    pub us: Vec<(f32, Dd)>,
    /// In order.
    pub ts: Vec<(f32, Near<'a>)>,
    pub frames: Vec<Frame>,
    /// Of plain ones those in turn go with a frame; the greatest that are allowed go with each.
    pub rates: Vec<u32>,
    pub greatest: Vec<u32>,
    /// Are the forward error and the tick's promised?
    pub is_typical: bool,
    /// How many neighbours are walked on either side.
    pub walk: u32,
}

/// Some neighbours of a frame, with the fraction and the exact time since the start of the curve for each end.
pub struct Frame {
    pub n: u32,
    /// None for triggers.
    pub duty: Option<f32>,
    pub first: u32,
    /// Of triggers both are the same.
    pub exact: Vec<[(Dd, Dd); 2]>,
}

impl Frame {
    pub fn new(exact: &Exact, n: u32, duty: Option<f32>, first: u32, count: u32) -> Self {
        let start = Dd::from(exact.curve().open_start());
        let end = |i: u32, more: f64| {
            let u = Dd::from(2.0 * f64::from(i) + 1.0) + Dd::from(more);
            let u = u / Dd::from(2.0 * f64::from(n));
            (u, exact.inverse_cdf_dd(u) - start)
        };
        let count = count.min(n - first.min(n));
        let exact = (first..first + count)
            .map(|i| match duty {
                None => [end(i, 0.0); 2],
                Some(duty) => [end(i, -f64::from(duty)), end(i, f64::from(duty))],
            })
            .collect();
        Self { n, duty, first, exact }
    }
}

impl<'a> Questions<'a> {
    /// These fractions, times and frames, as far as they are on the curve.
    pub fn new(exact: &'a Exact, mut us: Vec<f32>, mut ts: Vec<f32>, frames: Vec<Frame>) -> Self {
        let [start, end] = [exact.curve().open_start(), exact.curve().close_end()];
        let length = f64::from(end) - f64::from(start);
        us.retain(|u| (0.0..=1.0).contains(u));
        us.sort_by(f32::total_cmp);
        // Next to 1 many are the same `f32`, which would weigh too much in the mean.
        us.dedup_by_key(|u| u.to_bits());
        ts.retain(|t| (start..=end).contains(t));
        ts.sort_by(f32::total_cmp);
        ts.dedup_by_key(|t| t.to_bits());
        // What is allowed: up to 2^31 ticks.
        let allowed = |hz: &u32| *hz > 0 && f64::from(*hz) * length <= exp2(31);
        // A trace less, since f64 need not hold the length.
        let greatest = [TYPICAL_TICKS, exp2(31)].map(|ticks| (ticks * (1.0 - 1e-9) / length) as u32);
        Self {
            us: us.into_iter().map(|u| (u, exact.inverse_cdf(u))).collect(),
            ts: ts.into_iter().map(|t| (t, exact.near(t))).collect(),
            frames,
            rates: Vec::new(),
            greatest: greatest.into_iter().filter(allowed).collect(),
            is_typical: false,
            walk: 0,
        }
    }

    /// Those at which the curve is difficult, and some at random.
    pub fn aimed(exact: &'a Exact, rng: &mut Rng) -> Self {
        let mut frames = vec![[1, 0, 1], [2, 0, 2]];
        let landmarks = exact.landmarks();
        for n in [1 << 20, MOST_TRIGGERS - 1, MOST_TRIGGERS] {
            let landmark = landmarks[rng.below(landmarks.len() as u64) as usize].hi;
            let first = (f64::from(n) * landmark) as u32;
            frames.push([n, first.saturating_sub(6), 12]);
        }
        frames.extend(aimed_triggers(exact, 400).into_iter().map(|[n, i]| [n, i, 1]));
        let duties = [1.0, 1.0 - 0.5 * f32::EPSILON, 0.75, 0.3, 1e-3, 1e-20, 1e-45];
        let frames = frames.into_iter().flat_map(|[n, first, count]| {
            let duty = duties[rng.below(duties.len() as u64) as usize];
            [None, Some(duty)].map(|duty| Frame::new(exact, n, duty, first, count))
        });
        let frames = frames.collect();
        let (us, ts) = (aimed_us(exact, rng), aimed_ts(exact, rng));
        let length = f64::from(exact.curve().close_end()) - f64::from(exact.curve().open_start());
        let rates = Some((1000.0 / length) as u32).filter(|hz| *hz > 0).into_iter().collect();
        Self { rates, walk: 20, ..Self::new(exact, us, ts, frames) }
    }

    /// These fractions alone.
    pub fn fractions(exact: &'a Exact, us: Vec<f32>, is_typical: bool) -> Self {
        Self { is_typical, ..Self::new(exact, us, Vec::new(), Vec::new()) }
    }

    /// Plain fractions, all small frames, and what lies next to the joins; and some rates and duties in turn.
    pub fn plain(exact: &'a Exact, turn: usize, is_typical: bool) -> Self {
        let curve = *exact.curve();
        let mut us = Vec::new();
        for m in 1..=64 {
            us.extend((0..=m).flat_map(|k| neighbours(k as f32 / m as f32, 1)));
        }
        // Octaves end at eighths of a power of two; so does the least of them, and the line begins at a power.
        for exponent in 1..=32 {
            let power = exp2(-exponent) as f32;
            let (next, top) = (neighbours(power, 2), neighbours(1.0 - power, 2));
            us.extend(next.chain(top));
            for eighths in 9..16 {
                let end = 0.125 * eighths as f32 * power;
                us.extend(neighbours(end, 1).chain(neighbours(1.0 - end, 1)));
            }
        }
        for landmark in exact.landmarks() {
            us.extend(neighbours(landmark.to_f32(), if landmark.hi > 0.0 { 40 } else { 0 }));
        }
        let [start, end] = [curve.open_start(), curve.close_end()];
        let mut ts: Vec<f32> = (0..=20).map(|i| start + i as f32 * (end - start) / 20.0).collect();
        for time in exact.landmark_times() {
            ts.extend(around(time.to_f32(), 3));
        }
        let mut frames: Vec<_> = (1..=40).map(|n| Frame::new(exact, n, None, 0, n)).collect();
        for duty in [0.1, 0.25, 0.5, 0.75, 1.0] {
            let n = 1 + (turn as u32 * 7 + (duty * 20.0) as u32) % 40;
            frames.push(Frame::new(exact, n, Some(duty), 0, n));
            frames.push(Frame::new(exact, 12, Some(duty), 0, 12));
        }
        for place in exact.landmarks() {
            // Triggers that follow each other as closely as they may.
            for n in [1000, 1 << 20, MOST_TRIGGERS - 1, MOST_TRIGGERS] {
                let first = (f64::from(n) * place.hi.clamp(0.0, 1.0)) as u32;
                let first = first.saturating_sub(3);
                frames.push(Frame::new(exact, n, None, first, 6));
                frames.push(Frame::new(exact, n, Some(1.0), first, 5));
            }
        }
        for join in exact.landmarks()[..2].iter().map(|u| u.hi.clamp(0.0, 1.0)) {
            // Pulses of a few ticks, or less, around a trigger on the join, if there is one on it.
            for n in 1..=64 {
                let i = (f64::from(n) * join) as u32;
                let middle = (f64::from(i) + 0.5) / f64::from(n);
                if (middle - join).abs() < exp2(-20) && i < n {
                    let one = |k: i32| Frame::new(exact, n, Some(exp2(-k) as f32), i, 1);
                    frames.extend((4..40).map(one));
                    break;
                }
            }
            // A single pulse, whose ends are at any fraction: finer than `f32` are there.
            let duty = (1.0 - 2.0 * join).abs() as f32;
            let around = neighbours(duty, 40).filter(|duty| *duty > 0.0);
            frames.extend(around.map(|duty| Frame::new(exact, 1, Some(duty), 0, 1)));
        }
        let length = f64::from(end) - f64::from(start);
        let mut rates = RATES;
        rates.rotate_left(turn % RATES.len());
        let rates = rates.into_iter().filter(|hz| f64::from(*hz) * length <= exp2(31)).collect();
        Self { rates, is_typical, walk: 100, ..Self::new(exact, us, ts, frames) }
    }
}

/// So many neighbours of `x` on either side, and `x`, from 0 to 1.
pub fn neighbours(x: f32, count: u32) -> impl Iterator<Item = f32> {
    let bits = x.clamp(0.0, 1.0).to_bits();
    let most = 1f32.to_bits();
    (bits.saturating_sub(count)..=(bits + count).min(most)).map(f32::from_bits)
}

/// So many neighbours of any `x` on either side, and `x`.
pub fn around(x: f32, count: usize) -> impl Iterator<Item = f32> {
    let first = (0..count).fold(x, |x, _| x.next_down());
    std::iter::successors(Some(first), |x| Some(x.next_up())).take(2 * count + 1)
}

/// The `u` most likely to break a solver on this curve, and some `fresh` random ones.
pub fn hard_us(exact: &Exact, seed: u64, fresh: usize) -> Vec<f32> {
    let mut us = vec![-0.0, 0.0, 1.0];
    let ends = [(0.0, 3), (1.0, 3), (f32::MIN_POSITIVE, 2)];
    us.extend(ends.into_iter().flat_map(|(u, count)| neighbours(u, count)));
    for exponent in 1..=149 {
        let count = if exponent <= 32 { 2 } else { 0 };
        us.extend(neighbours(exp2(-exponent) as f32, count));
        us.extend(neighbours(1.0 - exp2(-exponent.min(24)) as f32, count));
    }
    us.extend(exact.landmarks().into_iter().flat_map(|u| neighbours(u.to_f32(), 6)));
    let mut rng = Rng::new(seed, 0);
    for i in 0..fresh {
        let tail = exp2(-(rng.below(24) as i32)) * rng.unit();
        us.push(match i % 4 {
            0 => rng.unit() as f32,
            1 => tail as f32,
            2 => 1.0 - tail as f32,
            _ => f32::from_bits(rng.below(1f32.to_bits() as u64) as u32),
        });
    }
    us
}

/// The u at which the curve is difficult, in order.
pub fn aimed_us(exact: &Exact, rng: &mut Rng) -> Vec<f32> {
    let landmarks = exact.landmarks().into_iter().map(Dd::to_f32);
    let mut us: Vec<f32> = landmarks.chain([0.25, 0.5, 0.75]).flat_map(|u| neighbours(u, 3)).collect();
    // And where a search from there starts out.
    for _ in 0..6 {
        let landmark = us[rng.below(us.len() as u64) as usize];
        us.extend(
            [1.0 + rng.power_of_ten(-7.0, 0.0), 1.0 - rng.power_of_ten(-7.0, 0.0)]
                .map(|by| (f64::from(landmark) * by) as f32),
        );
        us.push(rng.unit() as f32);
        us.push(f32::from_bits(rng.below(1f32.to_bits() as u64) as u32));
        let steps = 1 << rng.below(20);
        us.push(1.0 - exp2(-24) as f32 * rng.between(1.0, f64::from(steps)) as f32);
    }
    us.extend([1, 2, 3, 10_000].map(f32::from_bits));
    us.extend([f32::MIN_POSITIVE, 1f32.next_down()]);
    us.retain(|u| (0.0..=1.0).contains(u));
    us.extend([-0.0, 0.0, 1.0]);
    us.sort_by(f32::total_cmp);
    us.dedup_by_key(|u| u.to_bits());
    us
}

/// Times at which the curve is difficult, or beside it.
pub fn aimed_ts(exact: &Exact, rng: &mut Rng) -> Vec<f32> {
    let landmarks: Vec<f32> = exact.landmark_times().into_iter().map(Dd::to_f32).collect();
    let mut ts: Vec<f32> = landmarks.iter().flat_map(|t| around(*t, 3)).collect();
    for t in [1e-45, 1e-44, 1e-38, 1e-30, 1e-18, 1e-9, 1e-4] {
        ts.extend([-t, t]);
    }
    let length = f64::from(exact.curve().close_end()) - f64::from(exact.curve().open_start());
    for _ in 0..6 {
        let landmark = f64::from(landmarks[rng.below(landmarks.len() as u64) as usize]);
        let off = length * rng.power_of_ten(-12.0, 0.0);
        ts.extend([(landmark - off) as f32, (landmark + off) as f32]);
        ts.push(exact.inverse_cdf(rng.unit() as f32).to_f32());
    }
    ts.extend([-0.0, 0.0]);
    ts
}

/// Few triggers, one of which is next to a landmark: their number and that one.
pub fn aimed_triggers(exact: &Exact, most: u32) -> Vec<[u32; 2]> {
    let near = |u: f64| {
        let trigger = |n: u32| ((u * f64::from(n)) as u32).min(n - 1);
        let off = |n: u32| ((f64::from(trigger(n)) + 0.5) / f64::from(n) - u).abs();
        let n = (1..=most).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(1);
        [n, trigger(n)]
    };
    exact.landmarks().into_iter().map(|u| near(u.hi.clamp(0.0, 1.0))).collect()
}
