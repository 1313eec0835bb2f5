//! What is promised of a curve, each as a number, once; and what holds the answers to it ([`Figures`]).

use std::collections::BTreeMap;

use shutter_curve::{Hz, MAX_STEPS, ShutterCurve};

use super::curves::{Rng, shutter};
use super::oracle::{Curve, Dd, Exact, Near, exp2, ulp_f32};
use super::questions::{Frame, Questions, around, neighbours};

/// In ulp of u, from the least fraction of a frame on; below, in twice its ulp.
pub const BACKWARD: f64 = 0.5;
pub const LEAST_FRACTION: f32 = 1.0 / (1 << 23) as f32;
pub const BACKWARD_FLOOR: f64 = 1.0 / (1u64 << 45) as f64;
/// On typical curves, in ulp of the time; and its mean over the named ones.
pub const FORWARD: f64 = 0.69;
pub const FORWARD_MEAN: f64 = 0.227;
/// Of `cdf`, `openness` and `pdf`, in ulp at some time within an ulp of the one asked for.
pub const VALUE: f64 = 1.0;
/// Of `exposure`, `normalization` and `efficiency`, in ulp.
pub const SCALAR: f64 = 1.0;
/// An ulp of the cdf is at least that of this.
pub const CDF_FLOOR: f64 = 1.0 / (1 << 24) as f64;
/// By so many such ulp the cdf may fall from one time to the next.
pub const CDF_STEP_BACK: f64 = 1.0;
/// An ulp of the openness is at least this, one of the pdf this over the exposure.
pub const DENSITY_FLOOR: f64 = 1.0 / (1u64 << 57) as f64;
/// How far an openness at an end of the curve may be from its control point.
pub const END_OPENNESS: f64 = 1.0 / (1u64 << 60) as f64;
/// In ticks, from the exact time of a fraction within [`TRIGGER_ULP`] or [`EDGE_ULP`] of the one that is asked for.
pub const TICK: f64 = 0.52;
/// In ulp of the lesser of the fraction and its rest to 1: half for the `f32`, and half for the inverse.
pub const TRIGGER_ULP: f64 = 1.0;
/// The same of a pulse's end, whose `2i + 1 ± duty` is rounded before it is divided: one and a half for the `f32`.
pub const EDGE_ULP: f64 = 2.0;
/// On typical curves, in intervals of up to [`TYPICAL_TICKS`], from the exact time itself.
pub const TYPICAL_TICK: f64 = 0.85;
pub const TYPICAL_TICKS: f64 = (1 << 24) as f64;
/// The most triggers in a frame.
pub const MOST_TRIGGERS: u32 = 1 << 22;
/// Of the mass, for one u: as many as any search on a shutter is known to take. On a density that is dim at its later
/// end only the limit holds.
pub const STEPS: u32 = 12;
/// Of an octave's polynomial, in ulp of u: what its certificate allows.
pub const DIRECT: f64 = 0.49;

/// A backward error in what [`BACKWARD`] is in.
fn floored(u: f32, backward: f64) -> f64 {
    if u < LEAST_FRACTION { backward * ulp_f32(f64::from(u)) / BACKWARD_FLOOR } else { backward }
}

/// By how many ulp a cdf falls.
fn falls_by_ulps(from: f32, to: f32) -> f64 {
    (f64::from(from) - f64::from(to)) / ulp_f32(f64::from(to).max(CDF_FLOOR))
}

/// The worst that was seen, and what broke a promise.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    pub worst: BTreeMap<&'static str, f64>,
    /// The forward errors on typical curves: their sum, and how many.
    pub forward: [f64; 2],
    /// Of each promise that was broken: how often, and the first time.
    pub breaches: BTreeMap<&'static str, (u64, String)>,
}

impl Figures {
    /// Everything, on the inputs at which this curve is difficult, with 8 octaves and with none.
    pub fn judge(&mut self, curve: &Curve, rng: &mut Rng) {
        let exact = Exact::new(curve);
        self.ask(&exact, &Questions::aimed(&exact, rng));
    }

    /// Everything, with 8 octaves and with none.
    pub fn ask(&mut self, exact: &Exact, questions: &Questions) {
        self.asked::<8>(exact, questions);
        self.asked::<0>(exact, questions);
        self.walk(exact, questions.walk);
    }

    /// Everything that is asked, with so many octaves.
    pub fn asked<const OCTAVES: usize>(&mut self, exact: &Exact, questions: &Questions) {
        let ours = shutter::<OCTAVES>(exact.curve());
        self.fractions(exact, &ours, questions);
        self.direct(exact, &ours);
        for (i, frame) in questions.frames.iter().enumerate() {
            let in_turn = questions.rates.iter().skip(i % 2).step_by(2);
            for hz in in_turn.chain(&questions.greatest) {
                self.frame(exact, &ours, frame, *hz, questions.is_typical);
            }
        }
        if OCTAVES == 8 {
            self.values(exact, &shutter(exact.curve()), &questions.ts);
        } else {
            let eight = shutter::<8>(exact.curve());
            let same = |t| ours_values(&ours, t) == ours_values(&eight, t);
            let are_same = questions.ts.iter().all(|(t, _)| same(*t));
            self.expect("cdf, pdf and openness by OCTAVES", are_same, &String::new, exact);
        }
    }

    fn expect(&mut self, what: &'static str, holds: bool, at: &dyn Fn() -> String, exact: &Exact) {
        if !holds {
            let first = || (0, format!("{} of {:?}", at(), exact.curve()));
            self.breaches.entry(what).or_insert_with(first).0 += 1;
        }
    }

    /// Expects a figure to be at most a promised one.
    fn hold(&mut self, what: &'static str, figure: f64, most: f64, at: &dyn Fn() -> String, exact: &Exact) {
        let worst = self.worst.entry(what).or_insert(0.0);
        *worst = worst.max(figure);
        self.expect(what, figure <= most, at, exact);
    }

    /// Error, range, order, length of the search.
    fn fractions<const OCTAVES: usize>(&mut self, exact: &Exact, ours: &ShutterCurve<OCTAVES>, questions: &Questions) {
        let curve = exact.curve();
        let mut last = curve.open_start();
        for &(u, time) in &questions.us {
            let (t, steps) = (ours.inverse_cdf(u), ours.steps(u).unwrap_or(0));
            let errors = exact.judge_for(u, t, time);
            let at = || format!("u = {u:e}: {t:e}, {OCTAVES} octaves, {steps} steps, {errors:?}");
            if questions.is_typical && time.hi != 0.0 && u >= LEAST_FRACTION {
                self.forward = [self.forward[0] + errors.forward, self.forward[1] + 1.0];
                self.hold("forward error", errors.forward, FORWARD, &at, exact);
            }
            // A polynomial's is less, so that neighbours cannot change places.
            let (what, most) =
                if steps == 0 { ("direct backward error", DIRECT) } else { ("backward error", BACKWARD) };
            self.hold(what, floored(u, errors.backward), most, &at, exact);
            self.expect("step back", t >= last, &at, exact);
            let most = if curve.opening[3].1 < 1.0 { MAX_STEPS } else { STEPS };
            self.hold("steps", steps.into(), most.into(), &at, exact);
            last = t;
        }
        let ends = [f32::NAN, -1.0, -0.0, 0.0, 1.0, 2.0].map(|u| ours.inverse_cdf(u));
        let [start, end] = [curve.open_start(), curve.close_end()];
        let exactly = ends == [start, start, start, start, end, end];
        self.expect("ends", exactly, &|| format!("{ends:?}"), exact);
    }

    /// The cdf, the pdf and the openness; order of the cdf; and what is known of the whole curve.
    fn values(&mut self, exact: &Exact, ours: &ShutterCurve, ts: &[(f32, Near)]) {
        let mut last = 0.0;
        for &(t, ref near) in ts {
            let values @ [value, pdf, openness] = ours_values(ours, t);
            let at = || format!("t = {t:e}: {values:?}");
            self.hold("cdf", near.cdf_ulp(value, CDF_FLOOR), VALUE, &at, exact);
            self.hold("pdf", near.pdf_ulp(pdf, DENSITY_FLOOR), VALUE, &at, exact);
            self.hold("openness", near.openness_ulp(openness, DENSITY_FLOOR), VALUE, &at, exact);
            self.hold("cdf's step back", falls_by_ulps(last, value), CDF_STEP_BACK, &at, exact);
            last = value;
        }
        for (got, true_value) in [
            (ours.exposure(), exact.area()),
            (ours.normalization(), exact.normalization()),
            (ours.efficiency(), exact.efficiency()),
        ] {
            let error = (f64::from(got) - true_value.hi).abs() / ulp_f32(true_value.hi);
            self.hold("exposure and such", error, SCALAR, &|| format!("{got:e}"), exact);
        }
        let curve = exact.curve();
        let times = [ours.open_start(), ours.open_end(), ours.close_start(), ours.close_end()];
        let [first, .., second] = curve.opening;
        let [third, .., last] = curve.closing;
        let are_its_times = times == [first, second, third, last].map(|(t, _)| t);
        self.expect("its four times", are_its_times, &|| format!("{times:?}"), exact);
        // Where the curve starts and ends it may jump, and any value would do there: but it is its first and its last.
        let outer = [(curve.opening, curve.opening[0]), (curve.closing, curve.closing[3])];
        for (ramp, (t, f)) in outer {
            let off = f64::from(ours.openness(t)) - f64::from(f);
            let holds = ramp[0].0 == ramp[3].0 || off.abs() <= END_OPENNESS;
            self.expect("openness at an end", holds, &|| format!("{t:e}"), exact);
        }
    }

    /// No trigger is searched for in a frame that `direct_triggers` promises.
    fn direct<const OCTAVES: usize>(&mut self, exact: &Exact, ours: &ShutterCurve<OCTAVES>) {
        let most = ours.direct_triggers();
        let frames = (1..=most.min(20)).chain((0..22).map(|k| most >> k));
        for n in frames.filter(|n| *n > 0) {
            // At 1 tick per unit of time nearly every interval has few enough.
            let Ok(timed) = ours.at(Hz(1)) else { continue };
            let frame = timed.min_gap(0).trigger_ticks(n).expect("few triggers");
            for i in (0..n).step_by(n as usize / 50 + 1).chain([n / 2, n - 1]) {
                let u = (i as f32 + 0.5) / n as f32;
                let at = || format!("{i} of {n}, {most} with {OCTAVES} octaves");
                self.expect("a direct tick", frame.is_direct(i), &at, exact);
                let is_direct = ours.steps(u).is_none();
                self.expect("a direct time", is_direct, &at, exact);
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
        is_typical: bool,
    ) {
        let &Frame { n, duty, first, .. } = frame;
        let (skipped, count) = (first as usize, frame.exact.len());
        let Ok(timed) = ours.at(Hz(hz)) else {
            self.expect("tick rate", false, &|| format!("{n} at {hz} Hz"), exact);
            return;
        };
        let timed = timed.min_gap(0).min_pulse(0);
        let ticks: Vec<[u32; 2]> = match duty {
            None => {
                let ticks = timed.trigger_ticks(n).expect("few triggers");
                ticks.skip(skipped).take(count).map(|tick| [tick; 2]).collect()
            }
            Some(duty) => {
                let pulses = timed.pulse_ticks(n, duty).expect("few pulses");
                pulses.skip(skipped).take(count).map(|pulse| [pulse.on, pulse.off]).collect()
            }
        };
        let curve = exact.curve();
        let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
        let is_promised = is_typical && duty.is_none() && length * f64::from(hz) <= TYPICAL_TICKS;
        let mut last = 0;
        for ((i, on_off), ends) in (first..).zip(&ticks).zip(&frame.exact) {
            let which = || format!("{i} of {n}, duty {duty:?}, {hz} Hz, {OCTAVES} octaves: {on_off:?}");
            for (tick, (u, delay)) in on_off.iter().zip(ends) {
                let near = (*delay * f64::from(hz) - Dd::from(f64::from(*tick))).hi.abs();
                let ulp = if duty.is_some() { EDGE_ULP } else { TRIGGER_ULP };
                let error = if near <= 0.5 { near } else { tick_error(exact, *tick, *u, hz, ulp) };
                let at = || format!("{}, {error:.3} ticks off, or {near:.3}", which());
                self.hold("ticks", error, TICK, &at, exact);
                if is_promised {
                    self.hold("typical ticks", near, TYPICAL_TICK, &at, exact);
                }
            }
            let [on, off] = *on_off;
            let at = || format!("{} after {last}", which());
            self.expect("order of ticks", last <= on && on <= off, &at, exact);
            last = off;
        }
    }

    /// Neighbouring `f32`, so many around each place where something changes: no step back.
    fn walk(&mut self, exact: &Exact, count: u32) {
        let curve = exact.curve();
        let (direct, searched) = (shutter::<8>(curve), shutter::<0>(curve));
        // What changes on the curve, the end of the line, and where octaves may end.
        let octaves = (1..10).flat_map(|k| (8..16).map(move |eighths| f64::from(eighths) * exp2(-k - 3)));
        let octaves: Vec<f64> = octaves.flat_map(|u| [u, 1.0 - u]).collect();
        let places = exact.landmarks().into_iter().map(|u| u.hi).chain([0.0, 1.0]);
        let mut of_u = |place: f64, inverse: &dyn Fn(f32) -> f32, what| {
            let mut last = f32::NEG_INFINITY;
            for u in neighbours(place as f32, count) {
                let t = inverse(u);
                self.expect(what, t >= last, &|| format!("{t:e} after {last:e} at {u:e}"), exact);
                last = t;
            }
        };
        for place in places {
            of_u(place, &|u| direct.inverse_cdf(u), "step back between neighbours");
            of_u(place, &|u| searched.inverse_cdf(u), "step back between searches");
        }
        for place in octaves {
            of_u(place, &|u| direct.inverse_cdf(u), "step back next to an octave's end");
        }
        let mut places: Vec<f32> = exact.landmark_times().into_iter().map(Dd::to_f32).collect();
        // Midway between two f32, where a trace turns the rounding.
        let half_ulp = exp2(-25);
        let midway = [0.25 + 0.5 * half_ulp, 0.5 + half_ulp, 0.75 + half_ulp];
        let last = [1.0, 3.0, 5.0, 21.0, 1001.0].map(|odd| 1.0 - odd * half_ulp);
        let midway = midway.into_iter().chain(last).map(|u| exact.inverse_cdf_dd(Dd::from(u)));
        places.extend(midway.map(Dd::to_f32));
        let [start, end] = [curve.open_start(), curve.close_end()];
        if start < 0.0 && end > 0.0 {
            // Half of the farther end's power of two, where the grid begins, and its steps next to time 0.
            let farther = f64::from(end.max(-start));
            let half = exp2(farther.log2().floor() as i32 - 1) as f32;
            let steps = [0.5, 1.0, 1.5, 2.5].map(|k| half * k * exp2(-24) as f32);
            places.extend([0.0, half, -half].into_iter().chain(steps).chain(steps.map(|t| -t)));
        }
        for place in places {
            let mut last = 0.0;
            for t in around(place, count as usize) {
                let cdf = direct.cdf(t);
                let at = || format!("{cdf:e} after {last:e} at {t:e}");
                let falls = if cdf <= 1.0 { falls_by_ulps(last, cdf) } else { f64::INFINITY };
                self.hold("cdf's step back between neighbours", falls, CDF_STEP_BACK, &at, exact);
                last = cdf;
            }
        }
    }
}

fn ours_values<const OCTAVES: usize>(curve: &ShutterCurve<OCTAVES>, t: f32) -> [f32; 3] {
    [curve.cdf(t), curve.pdf(t), curve.openness(t)]
}

/// How far a tick is from the exact time of the fraction `u`, once so many ulp of the lesser of it and its rest are
/// forgiven.
pub fn tick_error(exact: &Exact, tick: u32, u: Dd, hz: u32, ulp: f64) -> f64 {
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
    let forgiven = Dd::from(ulp * ulp_f32(lesser.hi.max(0.0)).max(BACKWARD_FLOOR));
    (delay(u - forgiven) - tick).max(tick - delay(u + forgiven)).max(0.0)
}
