//! Everything that is promised of a curve, judged on the inputs of [`aimed`](super::aimed), and on what is asked of a
//! design ([`Questions`]).

use std::collections::BTreeMap;
use std::fmt;

use shutter_curve::ShutterCurve;

use super::aimed::{aimed_triggers, aimed_ts, aimed_us};
use super::cases::shutter;
use super::curves::{Rng, is_valid};
use super::oracle::{Curve, Dd, Exact, Near, exp2, ulp_f32};

/// In ulp of u.
pub const BACKWARD: f64 = 0.5;
/// On typical curves, in ulp of the time.
pub const FORWARD: f64 = 0.69;
/// Of `cdf`, `opening` and `pdf`, in ulp at some time within an ulp of the one asked for.
pub const VALUE: f64 = 1.0;
/// An ulp of the cdf is at least that of this.
pub const CDF_FLOOR: f64 = 1.0 / (1 << 24) as f64;
/// In ticks, from the exact time of a fraction within [`TRIGGER_ULP`] or [`EDGE_ULP`] of the one that is asked for.
pub const TICK: f64 = 0.52;
/// In ulp of the lesser of the fraction and its rest to 1: half for the `f32`, and half for the inverse.
pub const TRIGGER_ULP: f64 = 1.0;
/// The same of a pulse's end, whose `2i + 1 ± duty` is rounded before it is divided: one and a half for the `f32`.
pub const EDGE_ULP: f64 = 2.0;
/// On typical curves, in intervals of up to [`TYPICAL_TICKS`], from the exact time itself.
pub const TYPICAL_TICK: f64 = 0.8;
pub const TYPICAL_TICKS: f64 = (1 << 24) as f64;
/// The most triggers in a frame.
pub const MOST_TRIGGERS: u32 = 1 << 22;
/// The rates of timers that a design is asked for, in ticks per unit of its time: plain ones, and primes.
pub const RATES: [u32; 8] = [1, 1000, 48_000, 1_000_000, 7, 1009, 65_537, 999_983];
/// Of the mass, for one u: as many as any search is known to take. What takes more has wandered.
pub const EVALUATIONS: u32 = 5;

/// The worst that was seen, and what broke a promise.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    pub curves: u64,
    pub samples: u64,
    pub backward: f64,
    /// On designs, all of which are typical or near it; on other curves it may be any number.
    pub forward: f64,
    pub evaluations: u32,
    pub cdf: f64,
    /// As `cdf`, in ulp of however small a value.
    pub small_cdf: f64,
    pub density: f64,
    pub ticks: f64,
    /// Of each promise that was broken: how often, and the first time.
    pub breaches: BTreeMap<&'static str, (u64, String)>,
}

impl Figures {
    pub fn judge(&mut self, curve: &Curve, rng: &mut Rng) {
        let exact = Exact::new(curve);
        let (direct, searched) = (shutter::<8>(curve), shutter::<0>(curve));
        let us = aimed_us(&exact, rng);
        let times = timed(&exact, &us);
        self.inverse(&exact, &times, |u| direct.inverse_cdf(u), |u| direct.evaluations(u));
        self.inverse(&exact, &times, |u| searched.inverse_cdf(u), |u| searched.evaluations(u));

        let ts = aimed_ts(&exact, rng);
        let values = |t| [direct.cdf(t), direct.pdf(t), direct.openness(t)];
        let others = |t| [searched.cdf(t), searched.pdf(t), searched.openness(t)];
        let near = near(&exact, &ts);
        self.values(&exact, &near, values);
        self.ticks(&exact, &direct, rng);
        self.ticks(&exact, &searched, rng);
        let same = |t: &f32| values(*t) == others(*t);
        self.expect("cdf, pdf and openness by OCTAVES", ts.iter().all(same), curve);
        self.twins(curve, &us, &ts);
        self.single(curve, rng);
        self.curves += 1;
    }

    fn expect(&mut self, what: &'static str, holds: bool, curve: &Curve) {
        self.expect_at(what, holds, String::new, curve);
    }

    fn expect_at(
        &mut self,
        what: &'static str,
        holds: bool,
        at: impl Fn() -> String,
        curve: &Curve,
    ) {
        if !holds {
            let first = || (0, format!("{} of {curve:?}", at()));
            self.breaches.entry(what).or_insert_with(first).0 += 1;
        }
    }

    /// Error, range, order, length of the search; of fractions with their exact times.
    fn inverse(
        &mut self,
        exact: &Exact,
        us: &[(f32, Dd)],
        inverse: impl Fn(f32) -> f32,
        evaluations: impl Fn(f32) -> u32,
    ) {
        let curve = exact.curve();
        let mut last = curve.open_start();
        for &(u, time) in us {
            let (t, evaluations) = (inverse(u), evaluations(u));
            let errors = exact.judge_for(u, t, time);
            let at = || format!("u = {u:e}: {t:e}, {evaluations} evaluations, {errors:?}");
            self.samples += 1;
            self.backward = self.backward.max(errors.backward);
            self.evaluations = self.evaluations.max(evaluations);
            self.expect_at("backward error", errors.backward <= BACKWARD, at, curve);
            self.expect_at("step back", t >= last, at, curve);
            self.expect_at("evaluations", evaluations <= EVALUATIONS, at, curve);
            last = t;
        }
        let ends = [inverse(-0.0), inverse(0.0), inverse(1.0)];
        let starts = [curve.open_start(), curve.open_start(), curve.close_end()];
        self.expect_at("ends", ends == starts, || format!("{ends:?}"), curve);
    }

    /// The cdf, the pdf and, on a shutter, the openness; order of the cdf.
    fn values<const N: usize>(
        &mut self,
        exact: &Exact,
        ts: &[(f32, Near)],
        at: impl Fn(f32) -> [f32; N],
    ) {
        let curve = exact.curve();
        let mut last = 0.0;
        for &(t, ref near) in ts {
            let values = at(t);
            let cdf = near.cdf_ulp(values[0], CDF_FLOOR);
            let pdf = near.pdf_ulp(values[1]);
            let openness = values.get(2).map_or(0.0, |openness| near.openness_ulp(*openness));
            let what = || format!("t = {t:e}: {values:?}, {cdf:.2} {pdf:.2} {openness:.2} ulp");
            self.samples += N as u64;
            self.cdf = self.cdf.max(cdf);
            self.small_cdf = self.small_cdf.max(near.cdf_ulp(values[0], 0.0));
            self.density = self.density.max(pdf).max(openness);
            self.expect_at("cdf", cdf <= VALUE, what, curve);
            self.expect_at("pdf", pdf <= VALUE, what, curve);
            self.expect_at("openness", openness <= VALUE, what, curve);
            self.expect_at("cdf's step back", values[0] >= last, what, curve);
            last = values[0];
        }
        if ts.iter().any(|(t, _)| *t == 0.0) {
            self.expect_at("t = -0.0", at(-0.0) == at(0.0), || format!("{:?}", at(-0.0)), curve);
        }
    }

    fn ticks<const OCTAVES: usize>(
        &mut self,
        exact: &Exact,
        ours: &ShutterCurve<OCTAVES>,
        rng: &mut Rng,
    ) {
        let curve = exact.curve();
        let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
        for most in [1000.0, TYPICAL_TICKS, exp2(31)] {
            // A trace less, since f64 need not hold the length; a very long interval has more ticks at any rate.
            let hz = (most * (1.0 - 1e-9) / length) as u32;
            if hz == 0 {
                continue;
            }
            let mut frames = vec![[1, 0, 1], [2, 0, 2]];
            for n in [1 << 20, MOST_TRIGGERS - 1, MOST_TRIGGERS] {
                let landmarks = exact.landmarks();
                let landmark = landmarks[rng.below(landmarks.len() as u64) as usize].hi;
                let first = (f64::from(n) * landmark) as u32;
                frames.push([n, first.saturating_sub(6), 12]);
            }
            frames.extend(aimed_triggers(exact, 400).into_iter().map(|[n, i]| [n, i, 1]));
            for [n, first, count] in frames {
                let Ok(ticks) = ours.trigger_ticks(n, hz) else {
                    self.expect("tick rate", false, curve);
                    return;
                };
                let mut last = 0;
                for (i, tick) in (first..n).zip(ticks.skip(first as usize).take(count as usize)) {
                    let error = tick_error(exact, tick, [i, n], hz);
                    let at = || format!("trigger {i} of {n} at {hz} Hz: {error:.3} ticks off");
                    self.samples += 1;
                    self.ticks = self.ticks.max(error);
                    self.expect_at("ticks", error <= TICK, at, curve);
                    self.expect_at("ticks' step back", tick >= last, at, curve);
                    last = tick;
                }
            }
        }
    }

    /// The mirrored curve gives mirrored times, and -0.0 counts as 0.0 wherever it stands.
    fn twins(&mut self, curve: &Curve, us: &[f32], ts: &[f32]) {
        let ours = shutter::<8>(curve);
        let mirrored = shutter::<8>(&curve.mirrored());
        // To the bit on ordinary curves (see accuracy.rs); here, where the exact time may be a tie or time stand still, to
        // what is promised of u: what one curve answers is an answer on the other.
        let exact = Exact::new(curve);
        for &u in us.iter().filter(|u| 1.0 - (1.0 - **u) == **u) {
            let [t, back] = [ours.inverse_cdf(u), -mirrored.inverse_cdf(1.0 - u)];
            let at = || format!("u = {u:e}: {t:e} and {back:e}");
            let same = t == back || exact.judge(u, back).backward <= BACKWARD;
            self.expect_at("mirrored", same, at, curve);
        }
        for zero in [0.0, -0.0] {
            let signed = |x: f32| if x == 0.0 { zero } else { x };
            let signed = |ramp: [(f32, f32); 4]| ramp.map(|(t, f)| (signed(t), signed(f)));
            let [opening, closing] = [curve.opening, curve.closing].map(signed);
            let other = shutter::<8>(&Curve { opening, closing });
            for &u in us.iter().step_by(5) {
                let at = || format!("u = {u:e}");
                self.expect_at("-0.0", ours.inverse_cdf(u) == other.inverse_cdf(u), at, curve);
            }
            for &t in ts.iter().step_by(5) {
                let values = |c: &ShutterCurve| [c.cdf(t), c.pdf(t), c.openness(t)];
                self.expect_at(
                    "-0.0",
                    values(&ours) == values(&other),
                    || format!("t = {t:e}"),
                    curve,
                );
            }
        }
    }

    /// The opening ramp alone, in some scale of openness.
    fn single(&mut self, curve: &Curve, rng: &mut Rng) {
        let scale = exp2(-(rng.below(41) as i32)) as f32;
        let single = Curve::single(curve.opening.map(|(t, f)| (t, scale * f)));
        if !is_valid(&single) {
            return;
        }
        let exact = Exact::new(&single);
        let ours = shutter::<0>(&single);
        let us = aimed_us(&exact, rng);
        self.inverse(&exact, &timed(&exact, &us), |u| ours.inverse_cdf(u), |_| 0);
        self.values(&exact, &near(&exact, &aimed_ts(&exact, rng)), |t| [ours.cdf(t), ours.pdf(t)]);
        let [area, exact_area] = [f64::from(ours.exposure()), exact.area().hi];
        self.expect("area", (area - exact_area).abs() <= ulp_f32(exact_area), &single);
    }
}

/// What is asked of a design: plain fractions, all small frames, and what lies next to the joins. The exact answers are
/// found once; every `OCTAVES` is held against them.
pub struct Questions<'a> {
    /// In order, with the exact times.
    us: Vec<(f32, Dd)>,
    /// In order.
    ts: Vec<(f32, Near<'a>)>,
    frames: Vec<Frame>,
    /// Of plain ones those in turn go with a frame; the greatest that are allowed go with each.
    rates: Vec<u32>,
    greatest: Vec<u32>,
    /// Is the forward error promised?
    is_typical: bool,
}

/// Some neighbours of a frame, with the exact time since the start of the curve for each end.
struct Frame {
    n: u32,
    /// None for triggers.
    duty: Option<f32>,
    first: u32,
    /// Of triggers both are the same.
    exact: Vec<[(Dd, Dd); 2]>,
}

impl Frame {
    fn new(exact: &Exact, n: u32, duty: Option<f32>, first: u32, count: u32) -> Self {
        let start = Dd::from(exact.curve().open_start());
        let end = |i: u32, half: f64| {
            let u = Dd::from(2.0 * f64::from(i) + 1.0) + Dd::from(half);
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

/// Each fraction with its exact time.
fn timed(exact: &Exact, us: &[f32]) -> Vec<(f32, Dd)> {
    us.iter().map(|u| (*u, exact.inverse_cdf(*u))).collect()
}

/// Each time with what the curve takes on around it.
fn near<'a>(exact: &'a Exact, ts: &[f32]) -> Vec<(f32, Near<'a>)> {
    ts.iter().map(|t| (*t, exact.near(*t))).collect()
}

/// So many neighbours of `x` on either side, and `x`, from 0 to 1.
fn neighbours(x: f32, count: u32) -> impl Iterator<Item = f32> {
    let bits = x.clamp(0.0, 1.0).to_bits();
    let most = 1f32.to_bits();
    (bits.saturating_sub(count)..=(bits + count).min(most)).map(f32::from_bits)
}

/// The greatest denominator of the fractions, and the greatest frame of which every trigger is asked for.
#[derive(Clone, Copy)]
pub struct Reach {
    pub denominator: u32,
    pub frame: u32,
    /// Which rates and duties; a few of each go with a design.
    pub turn: usize,
    pub is_typical: bool,
}

impl<'a> Questions<'a> {
    pub fn new(exact: &'a Exact, reach: Reach) -> Self {
        let curve = *exact.curve();
        let joins: Vec<f64> = exact.landmarks()[..2].iter().map(|u| u.hi.clamp(0.0, 1.0)).collect();
        let mut us = vec![-0.0, 0.0, 1.0];
        for m in 1..=reach.denominator {
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
        us.sort_by(f32::total_cmp);
        us.dedup_by_key(|u| u.to_bits());
        let us = timed(exact, &us);

        let [start, end] = [curve.open_start(), curve.close_end()];
        let length = f64::from(end) - f64::from(start);
        let mut ts: Vec<f32> = (0..=20).map(|i| start + i as f32 * (end - start) / 20.0).collect();
        for time in exact.landmark_times() {
            let time = time.to_f32();
            let mut first = time;
            for _ in 0..3 {
                first = first.next_down();
            }
            ts.extend(std::iter::successors(Some(first), |t| Some(t.next_up())).take(7));
        }
        ts.retain(|t| (start..=end).contains(t));
        ts.sort_by(f32::total_cmp);
        ts.dedup();
        let ts = near(exact, &ts);

        let mut frames: Vec<_> =
            (1..=reach.frame).map(|n| Frame::new(exact, n, None, 0, n)).collect();
        for duty in [0.1, 0.25, 0.5, 0.75, 1.0] {
            let n = 1 + (reach.turn as u32 * 7 + (duty * 20.0) as u32) % reach.frame.max(1);
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
        for join in &joins {
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
            if duty > 0.0 {
                let around = neighbours(duty, 40).filter(|duty| *duty > 0.0);
                let one = |duty| Frame::new(exact, 1, Some(duty), 0, 1);
                frames.extend(around.map(one));
            }
        }
        // What is allowed: up to 2^31 ticks.
        let allowed = |hz: &u32| *hz > 0 && f64::from(*hz) * length <= exp2(31);
        let greatest =
            [TYPICAL_TICKS, exp2(31)].map(|ticks| (ticks * (1.0 - 1e-9) / length) as u32);
        let greatest = greatest.into_iter().filter(allowed).collect();
        let mut rates = RATES;
        rates.rotate_left(reach.turn % RATES.len());
        let rates = rates.into_iter().filter(allowed).collect();
        Self { us, ts, frames, rates, greatest, is_typical: reach.is_typical }
    }
}

impl<'a> Questions<'a> {
    /// Of the fractions around a place alone, as far as those that an octave's polynomial serves with it: where time runs
    /// so unevenly that a polynomial follows it least, between the places at which it is judged.
    pub fn closely(exact: &'a Exact, place: f64, frames: u32) -> Self {
        let length = f64::from(exact.curve().close_end()) - f64::from(exact.curve().open_start());
        let mut list = Vec::new();
        // Triggers, ...
        for n in 1..=frames {
            let [from, to] = [0.9, 1.1].map(|by| (f64::from(n) * place * by) as u32);
            list.push(Frame::new(exact, n, None, from, to + 1 - from));
        }
        // ... and the two ends of a single pulse, which is at any fraction.
        let (mut us, mut off) = (Vec::new(), 1e-6);
        while off < 0.6 {
            us.extend([place * (1.0 - off), place, place * (1.0 + off)]);
            off *= 1.12;
        }
        let duties = us.iter().map(|u| (1.0 - 2.0 * u).abs() as f32);
        let duties = duties.filter(|duty| *duty > 0.0 && *duty <= 1.0);
        list.extend(duties.map(|duty| Frame::new(exact, 1, Some(duty), 0, 1)));
        let hz = (TYPICAL_TICKS * (1.0 - 1e-9) / length) as u32;
        let mut us: Vec<f32> = us.into_iter().flat_map(|u| neighbours(u as f32, 1)).collect();
        us.sort_by(f32::total_cmp);
        us.dedup();
        let us = timed(exact, &us);
        let greatest = vec![hz.max(1)];
        Self { us, ts: vec![], frames: list, rates: vec![], greatest, is_typical: false }
    }
}

impl Figures {
    /// Everything that is asked, with so many octaves.
    pub fn asked<const OCTAVES: usize>(&mut self, exact: &Exact, questions: &Questions) {
        let curve = exact.curve();
        let ours = shutter::<OCTAVES>(curve);
        self.fractions(exact, &ours, questions);
        self.direct(exact, &ours);
        for (i, frame) in questions.frames.iter().enumerate() {
            let in_turn = questions.rates.iter().skip(i % 2).step_by(2);
            for hz in in_turn.chain(&questions.greatest) {
                self.frame(exact, &ours, frame, *hz);
            }
        }
        if OCTAVES == 8 {
            let values = |t| [ours.cdf(t), ours.pdf(t), ours.openness(t)];
            self.values(exact, &questions.ts, values);
        }
    }

    fn fractions<const OCTAVES: usize>(
        &mut self,
        exact: &Exact,
        ours: &ShutterCurve<OCTAVES>,
        questions: &Questions,
    ) {
        let curve = exact.curve();
        let mut last = curve.open_start();
        for &(u, time) in &questions.us {
            let (t, evaluations) = (ours.inverse_cdf(u), ours.evaluations(u));
            let errors = exact.judge_for(u, t, time);
            let at = || format!("u = {u:e}: {t:e}, {OCTAVES} octaves, {errors:?}");
            self.samples += 1;
            self.backward = self.backward.max(errors.backward);
            self.evaluations = self.evaluations.max(evaluations);
            if questions.is_typical && time.hi != 0.0 {
                self.forward = self.forward.max(errors.forward);
                self.expect_at("forward error", errors.forward <= FORWARD, at, curve);
            }
            self.expect_at("backward error", errors.backward <= BACKWARD, at, curve);
            self.expect_at("step back", t >= last, at, curve);
            self.expect_at("evaluations", evaluations <= EVALUATIONS, at, curve);
            last = t;
        }
    }

    /// No trigger is searched for in a frame that `direct_triggers` promises.
    fn direct<const OCTAVES: usize>(&mut self, exact: &Exact, ours: &ShutterCurve<OCTAVES>) {
        let curve = exact.curve();
        let most = ours.direct_triggers();
        let frames = (1..=most.min(20)).chain((0..22).map(|k| most >> k));
        for n in frames.filter(|n| *n > 0) {
            // At 1 tick per unit of time nearly every design's interval has few enough.
            let Ok(frame) = ours.trigger_ticks(n, 1) else { continue };
            for i in (0..n).step_by(n as usize / 50 + 1).chain([n / 2, n - 1]) {
                let u = (i as f32 + 0.5) / n as f32;
                let at = || format!("{i} of {n}, {most} with {OCTAVES} octaves");
                self.expect_at("a direct tick", frame.is_direct(i), at, curve);
                let is_direct = ours.is_direct(u) && ours.evaluations(u) == 0;
                self.expect_at("a direct time", is_direct, at, curve);
            }
        }
    }

    /// The ticks of a frame's part.
    fn frame<const OCTAVES: usize>(
        &mut self,
        exact: &Exact,
        ours: &ShutterCurve<OCTAVES>,
        frame: &Frame,
        hz: u32,
    ) {
        let curve = exact.curve();
        let (n, first) = (frame.n, frame.first as usize);
        let ticks: Option<Vec<(u32, u32)>> = match frame.duty {
            None => ours.trigger_ticks(n, hz).ok().map(|ticks| {
                ticks.skip(first).take(frame.exact.len()).map(|tick| (tick, tick)).collect()
            }),
            Some(duty) => ours.pulse_ticks(n, duty, hz).ok().map(|ticks| {
                ticks.skip(first).take(frame.exact.len()).map(|p| (p.on, p.off)).collect()
            }),
        };
        let Some(ticks) = ticks else {
            self.expect("tick rate", false, curve);
            return;
        };
        let mut last = 0;
        for ((i, (on, off)), ends) in (frame.first..=u32::MAX).zip(&ticks).zip(&frame.exact) {
            for (tick, (u, delay)) in [on, off].into_iter().zip(ends) {
                let near = (*delay * f64::from(hz) - Dd::from(f64::from(*tick))).hi.abs();
                let ulp = if frame.duty.is_some() { EDGE_ULP } else { TRIGGER_ULP };
                let error =
                    if near <= 0.5 { near } else { tick_error_at(exact, *tick, *u, hz, ulp) };
                let at = || {
                    let duty = frame.duty;
                    format!(
                        "{i} of {n}, duty {duty:?}, {hz} Hz, {OCTAVES} octaves: {error:.3} ticks off"
                    )
                };
                self.samples += 1;
                self.ticks = self.ticks.max(error);
                let what = if frame.duty.is_some() { "pulses" } else { "ticks" };
                self.expect_at(what, error <= TICK, at, curve);
            }
            let at = || {
                let duty = frame.duty;
                format!(
                    "{i} of {n}, duty {duty:?}, {hz} Hz, {OCTAVES} octaves: {on}, {off} after {last}"
                )
            };
            self.expect_at("order of ticks", last <= *on && on <= off, at, curve);
            last = *off;
        }
    }
}

impl fmt::Display for Figures {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { curves, samples, backward, evaluations, cdf, small_cdf, density, ticks, .. } =
            self;
        if self.forward > 0.0 {
            write!(out, "forward {:.3} ulp, ", self.forward)?;
        }
        write!(
            out,
            "backward error {backward:.3} ulp, {evaluations} evaluations, cdf {cdf:.3} ulp ({small_cdf:.3} without a floor), \
             density {density:.3} ulp, {ticks:.3} ticks; {samples} samples on {curves} curves"
        )
    }
}

/// How far a tick is from the exact time of trigger `i` of `n`, once [`TRIGGER_ULP`] is forgiven.
pub fn tick_error(exact: &Exact, tick: u32, [i, n]: [u32; 2], hz: u32) -> f64 {
    let u = Dd::from(2.0 * f64::from(i) + 1.0) / Dd::from(2.0 * f64::from(n));
    tick_error_at(exact, tick, u, hz, TRIGGER_ULP)
}

/// The same of the fraction `u`, once so many ulp of the lesser of it and its rest are forgiven.
pub fn tick_error_at(exact: &Exact, tick: u32, u: Dd, hz: u32, ulp: f64) -> f64 {
    let delay = |u: Dd| {
        let delay = exact.inverse_cdf_dd(u) - Dd::from(exact.curve().open_start());
        (delay * f64::from(hz)).hi
    };
    let tick = f64::from(tick);
    let error = (delay(u) - tick).abs();
    if error <= 0.5 {
        return error;
    }
    let lesser = u.min(Dd::ONE - u);
    let forgiven = Dd::from(ulp * ulp_f32(lesser.hi.max(0.0)));
    (delay(u - forgiven) - tick).max(tick - delay(u + forgiven)).max(0.0)
}
