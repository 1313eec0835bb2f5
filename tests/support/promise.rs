//! Everything that is promised of a curve, judged on the inputs of [`aimed`](super::aimed).

use std::collections::BTreeMap;
use std::fmt;

use shutter_curve::{BezierPdf, CubicBezier, ShutterCurve};

use super::aimed::{aimed_triggers, aimed_ts, aimed_us};
use super::cases::shutter;
use super::curves::{Rng, is_valid};
use super::oracle::{Curve, Dd, Exact, exp2, ulp_f32};

/// In ulp of u.
pub const BACKWARD: f64 = 1.0;
/// Of `cdf`, `opening` and `pdf`, in ulp at some time within an ulp of the one asked for.
pub const VALUE: f64 = 1.0;
/// An ulp of the cdf is at least that of this.
pub const CDF_FLOOR: f64 = 1.0 / (1 << 24) as f64;
/// In ticks: where the interval has at most [`DIRECT_TICKS`], and where it has more.
pub const TICKS: [f64; 2] = [0.75, 0.501];
pub const DIRECT_TICKS: f64 = (1 << 24) as f64;
/// Of the mass, for one u: as many as any search is known to take. What takes more has wandered.
pub const EVALUATIONS: u32 = 5;

/// The worst that was seen, and what broke a promise.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    pub curves: u64,
    pub samples: u64,
    pub backward: f64,
    pub evaluations: u32,
    pub cdf: f64,
    /// As `cdf`, in ulp of however small a value.
    pub small_cdf: f64,
    pub density: f64,
    pub ticks: [f64; 2],
    /// Of each promise that was broken: how often, and the first time.
    pub breaches: BTreeMap<&'static str, (u64, String)>,
}

impl Figures {
    pub fn judge(&mut self, curve: &Curve, rng: &mut Rng) {
        let exact = Exact::new(curve);
        let (direct, searched) = (shutter::<8>(curve), shutter::<0>(curve));
        let us = aimed_us(&exact, rng);
        self.inverse(&exact, &us, |u| direct.inverse_cdf(u), |u| direct.evaluations(u));
        self.inverse(&exact, &us, |u| searched.inverse_cdf(u), |u| searched.evaluations(u));
        let mut ts = vec![0.0; us.len()];
        direct.inverse_cdf_slice(&us, &mut ts);
        self.expect("slice", ts.iter().zip(&us).all(|(t, u)| *t == direct.inverse_cdf(*u)), curve);

        let ts = aimed_ts(&exact, rng);
        let values = |t| [direct.cdf(t), direct.pdf(t), direct.opening(t)];
        self.values(&exact, &ts, values);
        self.ticks(&exact, &direct, rng);
        self.ticks(&exact, &searched, rng);
        let others = |t| [searched.cdf(t), searched.pdf(t), searched.opening(t)];
        self.expect("values by CELLS", ts.iter().all(|t| values(*t) == others(*t)), curve);
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

    /// Error, range, order, length of the search.
    fn inverse(
        &mut self,
        exact: &Exact,
        us: &[f32],
        inverse: impl Fn(f32) -> f32,
        evaluations: impl Fn(f32) -> u32,
    ) {
        let curve = exact.curve();
        let mut last = curve.open_start();
        for &u in us {
            let (t, evaluations) = (inverse(u), evaluations(u));
            let errors = exact.judge(u, t);
            let at = || format!("u = {u:e}: {t:e}, {evaluations} evaluations, {errors:?}");
            self.samples += 1;
            self.backward = self.backward.max(errors.backward);
            self.evaluations = self.evaluations.max(evaluations);
            self.expect_at("u-error", errors.backward <= BACKWARD, at, curve);
            self.expect_at("step back", t >= last, at, curve);
            self.expect_at("evaluations", evaluations <= EVALUATIONS, at, curve);
            last = t;
        }
        let ends = [inverse(-0.0), inverse(0.0), inverse(1.0)];
        let starts = [curve.open_start(), curve.open_start(), curve.close_end()];
        self.expect_at("ends", ends == starts, || format!("{ends:?}"), curve);
    }

    /// The cdf, the pdf and, on a shutter, the openness; order of the cdf.
    fn values<const N: usize>(&mut self, exact: &Exact, ts: &[f32], at: impl Fn(f32) -> [f32; N]) {
        let curve = exact.curve();
        let mut last = 0.0;
        for &t in ts {
            let values = at(t);
            let cdf = exact.cdf_ulp(values[0], t, CDF_FLOOR);
            let pdf = exact.pdf_ulp(values[1], t);
            let openness = values.get(2).map_or(0.0, |openness| exact.openness_ulp(*openness, t));
            let what = || format!("t = {t:e}: {values:?}, {cdf:.2} {pdf:.2} {openness:.2} ulp");
            self.samples += N as u64;
            self.cdf = self.cdf.max(cdf);
            self.small_cdf = self.small_cdf.max(exact.cdf_ulp(values[0], t, 0.0));
            self.density = self.density.max(pdf).max(openness);
            self.expect_at("cdf", cdf <= VALUE, what, curve);
            self.expect_at("pdf", pdf <= VALUE, what, curve);
            self.expect_at("openness", openness <= VALUE, what, curve);
            self.expect_at("cdf's step back", values[0] >= last, what, curve);
            last = values[0];
        }
        if ts.contains(&0.0) {
            self.expect_at("t = -0.0", at(-0.0) == at(0.0), || format!("{:?}", at(-0.0)), curve);
        }
    }

    fn ticks<const CELLS: usize>(
        &mut self,
        exact: &Exact,
        ours: &ShutterCurve<CELLS>,
        rng: &mut Rng,
    ) {
        let curve = exact.curve();
        let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
        for most in [1000.0, DIRECT_TICKS, exp2(31)] {
            // A trace less, since f64 need not hold the length; a very long interval has more ticks at any rate.
            let hz = (most * (1.0 - 1e-9) / length) as u32;
            if hz == 0 {
                continue;
            }
            let mut frames = vec![[1, 0, 1], [2, 0, 2]];
            for n in [1 << 28, 1 << 30, u32::MAX] {
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
                    let kind = usize::from(length * f64::from(hz) > DIRECT_TICKS);
                    let at = || format!("trigger {i} of {n} at {hz} Hz: {error:.3} ticks off");
                    self.samples += 1;
                    self.ticks[kind] = self.ticks[kind].max(error);
                    self.expect_at("ticks", error <= TICKS[kind], at, curve);
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
            let other = shutter::<8>(&Curve { opening, closing, ..*curve });
            for &u in us.iter().step_by(5) {
                let at = || format!("u = {u:e}");
                self.expect_at("-0.0", ours.inverse_cdf(u) == other.inverse_cdf(u), at, curve);
            }
            for &t in ts.iter().step_by(5) {
                let values = |c: &ShutterCurve| [c.cdf(t), c.pdf(t), c.opening(t)];
                self.expect_at(
                    "-0.0",
                    values(&ours) == values(&other),
                    || format!("t = {t:e}"),
                    curve,
                );
            }
        }
    }

    /// The opening ramp alone, in any scale of openness.
    fn single(&mut self, curve: &Curve, rng: &mut Rng) {
        let scale = exp2(rng.below(41) as i32 - 20) as f32;
        let single = Curve::single(curve.opening.map(|(t, f)| (t, scale * f)));
        if !is_valid(&single) {
            return;
        }
        let exact = Exact::new(&single);
        let pdf =
            BezierPdf::<0>::with_cells(CubicBezier::new(single.opening)).expect("a good curve");
        let us = aimed_us(&exact, rng);
        self.inverse(&exact, &us, |u| pdf.inverse_cdf(u), |_| 0);
        self.values(&exact, &aimed_ts(&exact, rng), |t| [pdf.cdf(t), pdf.pdf(t)]);
        let [area, exact_area] = [f64::from(pdf.area()), exact.area().hi];
        self.expect("area", (area - exact_area).abs() <= ulp_f32(exact_area), &single);
    }
}

impl fmt::Display for Figures {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { curves, samples, backward, evaluations, cdf, small_cdf, density, .. } = self;
        let [few, many] = self.ticks;
        write!(
            out,
            "u-error {backward:.3} ulp, {evaluations} evaluations, cdf {cdf:.3} ulp ({small_cdf:.3} without a floor), \
             density {density:.3} ulp, {few:.3} and {many:.4} ticks; {samples} samples on {curves} curves"
        )
    }
}

/// How far a tick is from the exact time of trigger `i` of `n`, once a u-error of 2⁻³⁶ of `min(u, 1 - u)` is forgiven.
///
/// Where next to no light falls, the mass is the small sum of great terms: of 570 times its size where the families of `aimed` come
/// nearest to the 1083 that the text of `solve` bounds it by. Pairs have 2⁻⁴¹ of the terms for their bound, 2⁻³² of such a mass, and
/// miss a thirtieth of that here.
pub fn tick_error(exact: &Exact, tick: u32, [i, n]: [u32; 2], hz: u32) -> f64 {
    tick_error_at(
        exact,
        tick,
        Dd::from(2.0 * f64::from(i) + 1.0) / Dd::from(2.0 * f64::from(n)),
        hz,
    )
}

/// The same of the fraction `u`.
pub fn tick_error_at(exact: &Exact, tick: u32, u: Dd, hz: u32) -> f64 {
    let delay = |u: Dd| {
        let delay = exact.inverse_cdf_dd(u) - Dd::from(exact.curve().open_start());
        (delay * f64::from(hz)).hi
    };
    let tick = f64::from(tick);
    let error = (delay(u) - tick).abs();
    if error <= 0.5 {
        return error;
    }
    let forgiven = u.min(Dd::ONE - u).scale(exp2(-36));
    (delay(u - forgiven) - tick).max(tick - delay(u + forgiven)).max(0.0)
}
