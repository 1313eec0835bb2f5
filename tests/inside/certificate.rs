//! How octaves are fitted: the nodes, and that a certificate is never below the truth.

use crate::exposure::Exposure;
use crate::fraction::Side;
use crate::number::units::{WORD, fixed, power_of_two_f64, time_unit};
use crate::octave::build::{build, range};
use crate::octave::candidate::{Candidate, NODES};
use crate::octave::certificate::{FORWARD_ERROR, FRACTION_OFF, JOIN_OFF, Shares, ULP_ERROR};
use crate::octave::path::{Path, View, value};
use crate::octave::span::Span;
use crate::octave::{DEGREE, Octave, below, top};
use crate::ramp::bezier::CubicBezier;
use crate::support::aimed::{FAMILIES, aimed};
use crate::support::curves::{Rng, hard_openness, hard_times, named, random_hard, random_typical};
use crate::support::oracle::{Curve, Dd, Exact, ulp_f32};
use crate::support::times;

/// Chebyshev's polynomial of degree `DEGREE + 1`, by its recurrence.
fn chebyshev(x: f64) -> f64 {
    let (mut last, mut value) = (1.0, x);
    for _ in 0..DEGREE {
        (last, value) = (value, 2.0 * x * value - last);
    }
    value
}

/// The nodes are its roots.
#[test]
fn nodes_are_those_of_chebyshev() {
    assert!(NODES.iter().all(|node| chebyshev(f64::from(*node)).abs() < 1e-5));
    assert!(NODES.is_sorted_by(|a, b| a < b));
}

/// The greatest share of a bound that the truth comes to: relative to the time, and in light.
#[derive(Debug, Default)]
struct Truth {
    octaves: usize,
    greatest: [f64; 2],
}

impl Truth {
    /// Judges all octaves of a curve along `samples` places each, by the way that an answer takes from a position on.
    fn judge<const OCTAVES: usize>(&mut self, curve: &Curve, samples: u32) {
        let ramps = [curve.opening, curve.closing].map(CubicBezier::new);
        let Ok((exposure, shapes)) = Exposure::new(&ramps[0], &ramps[1]) else {
            return;
        };
        let (exact, unit) =
            (Exact::new(curve), time_unit(exposure.end(Side::Start), exposure.end(Side::End)));
        for side in Side::BOTH {
            let mut octaves = [Octave::NONE; OCTAVES];
            let tops = build(&exposure, &shapes, unit, side, &mut octaves);
            for (ramp, steps) in Side::BOTH.into_iter().zip(tops) {
                let this = View { exposure: &exposure, shapes: &shapes, side, ramp, unit };
                let (range, path) = (range(&exposure, side, ramp), this.path());
                for (index, octave) in octaves.iter().enumerate().filter(|(_, o)| o.exists()) {
                    if let Some(span) = Span::new(range, below(top(steps), index)) {
                        self.octaves += 1;
                        this.judge(octave, &path, &span, &exact, samples, &mut self.greatest);
                    }
                }
            }
        }
    }
}

impl View<'_> {
    /// What was built of a span: the polynomial, the stretch that it is held against, and the places where that lies.
    fn built(&self, span: &Span, path: &Path) -> (Candidate, Path, [f64; 2]) {
        let ends = [span.middle - span.half, span.middle + span.half].map(f64::from);
        let places = [path.place(ends[0], false), path.place(ends[1], true)];
        let stretch = span.counted(path.stretch(places));
        (self.candidate(span, &stretch).expect("it was built"), stretch, places)
    }

    #[allow(clippy::too_many_arguments)]
    fn judge(
        &self,
        octave: &Octave,
        path: &Path,
        span: &Span,
        exact: &Exact,
        samples: u32,
        greatest: &mut [f64; 2],
    ) {
        let (candidate, stretch, places) = self.built(span, path);
        assert_eq!(candidate.octave, *octave);
        let bounds = self.certificate(&candidate, span, stretch, places);
        let start = fixed(self.exposure.end(self.side), self.unit);
        let error_in_u = f64::from(ULP_ERROR) * ulp_f32(span.from);
        let trace = Dd::from(f64::from(JOIN_OFF + FRACTION_OFF * span.to));
        // The span itself rounds its end.
        let end = range(self.exposure, self.side, self.ramp)[1].min(f64::from(span.to));
        for i in 0..=samples {
            // Evenly, and so also next to both ends.
            let a = span.from + (end - span.from) * f64::from(i) / f64::from(samples);
            let a = f64::from(a as f32);
            // 1/2 is counted from the start.
            if a < span.from || a > end || a == 0.5 && self.side == Side::End {
                continue;
            }
            {
                let position = (a / f64::from(span.power) - 1.0) * f64::from(WORD);
                let position = position.floor() as i64 as i32;
                let time = octave.time(octave.offset(position)) - start;
                let time = time as f64 * power_of_two_f64(self.unit);
                let served = Dd::from(f64::from(self.exposure.end(self.side))) + Dd::from(time);
                let u = if self.side == Side::Start { Dd::from(a) } else { Dd::ONE - Dd::from(a) };
                // Next to a dark stretch a trace of the fraction takes long, and no more than that is known of joins.
                let [early, late] = [u - trace, u + trace].map(|u| exact.inverse_cdf_dd(u));
                let off = (early - served).max(served - late).hi.max(0.0);
                let size = f64::from(self.size_of_time(time.abs()));
                // Counted from the side, so that no bits are lost next to the later end.
                let light = if self.side == Side::Start {
                    exact.cdf_dd(served) - u
                } else {
                    exact.complement_dd(served) - Dd::from(a)
                };
                let share = [
                    off / (f64::from(FORWARD_ERROR) * size) / f64::from(bounds.forward),
                    light.hi.abs() / error_in_u / f64::from(bounds.backward.max(bounds.beyond)),
                ];
                for (greatest, share) in greatest.iter_mut().zip(share) {
                    assert!(share <= 1.0, "{share} of {bounds:?} at {a:e}: {:?}", exact.curve());
                    *greatest = greatest.max(share);
                }
            }
        }
    }
}

/// A certificate is never below the truth: on typical curves, hard ones, and those that are aimed at a difficulty.
/// `TIMES=30` before the command judges 30 times as many octaves, some 300 000.
#[test]
fn a_certificate_is_never_below_the_truth() {
    let times = times();
    let mut all = 0;
    let mut judge = |name: &str, curves: &mut dyn Iterator<Item = Curve>| {
        let mut truth = Truth::default();
        for (i, curve) in curves.enumerate() {
            match i % 8 {
                0 => truth.judge::<32>(&curve, 33),
                1 => truth.judge::<2>(&curve, 257),
                _ => truth.judge::<8>(&curve, 65),
            }
        }
        std::println!("{name}: {truth:?}");
        all += truth.octaves;
    };
    judge("named", &mut named().into_iter().map(|named| named.curve));
    judge("typical", &mut (0..200 * times).map(|i| random_typical(31, i)));
    judge("hard", &mut (0..200 * times).map(|i| random_hard(31, i)));
    // Joins so near to time 0 that a share of nearly all has too few bits to tell them.
    let least = |i| {
        let mut rng = Rng::new(31, i);
        let [open, close, end] =
            [-9.0, -9.0, 1.0].map(|most| rng.power_of_ten(most - 3.0, most) as f32);
        let dim = rng.unit() as f32;
        let [opening, closing] = [(open, [0.0, 0.0, dim, dim]), (end, [1.0, dim, 0.0, 0.0])];
        let thirds = |start: f32, (length, f): (f32, [f32; 4])| {
            std::array::from_fn(|k| (start + length * k as f32 / 3.0, f[k]))
        };
        Curve::shutter(thirds(-open, opening).map(|(t, f)| (t.min(0.0), f)), thirds(close, closing))
    };
    judge("least shares", &mut (0..25 * times).map(least));
    // Time stands still where the shutter is nearly open: between samples the error may be twice what it is at them.
    let kinks = |i| {
        let mut rng = Rng::new(31, i);
        let root = rng.between(0.1, 0.9);
        let d = [root * root, -root * (1.0 - root), (1.0 - root) * (1.0 - root)];
        let per = 1.0 / (d[0] + d[1] + d[2]);
        let dim = rng.power_of_ten(-5.0, -1.0);
        let t = [0.0, d[0] * per, (d[0] + d[1]) * per, 1.0];
        let opening = t.map(|t| (t as f32, (1.0 - dim * rng.unit()) as f32));
        Curve::shutter(opening, [(1.0 + rng.unit() as f32, 1.0); 4])
    };
    judge("kinks", &mut (0..400 * times).map(kinks));
    for (family, (name, ..)) in FAMILIES.iter().enumerate() {
        judge(name, &mut (0..25 * times).map(|i| aimed(family, 31, i)));
    }
    assert!(all > 10_000, "only {all} octaves");
}

/// A stretch on which an offset would leave its word is refused, whichever way it leaves: its samples would be those of another polynomial.
#[test]
fn an_offset_beyond_its_word_is_refused() {
    let thirds = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];
    let opening = std::array::from_fn(|k| (thirds[k], thirds[k]));
    let closing = std::array::from_fn(|k| (2.0 + thirds[k], 1.0 - thirds[k]));
    let ramps = [opening, closing].map(CubicBezier::new);
    let (exposure, shapes) = Exposure::new(&ramps[0], &ramps[1]).expect("a shutter");
    let unit = time_unit(exposure.end(Side::Start), exposure.end(Side::End));
    let mut judged = 0;
    for side in Side::BOTH {
        let this = View { exposure: &exposure, shapes: &shapes, side, ramp: side, unit };
        let mut octaves = [Octave::NONE; 8];
        let tops = build(&exposure, &shapes, unit, side, &mut octaves);
        for (index, _) in octaves.iter().enumerate().filter(|(_, octave)| octave.exists()) {
            let Some(span) =
                Span::new(range(&exposure, side, side), below(top(tops[side as usize]), index))
            else {
                continue;
            };
            let (candidate, stretch, places) = this.built(&span, &this.path());
            let (center, per_position) = span.offsets();
            let offset =
                |along: &Path, place| (value(&along.fraction, place) - center) * per_position;
            for to in [0.4998, 0.49991, 0.51, 0.75, 1.0, 1.5] {
                for end in [-1.0, 1.0] {
                    // Moved until its end is there.
                    let mut moved = stretch;
                    moved.fraction[0] += (end * to - offset(&stretch, end)) / per_position;
                    let bounds = this.certificate(&candidate, &span, moved, places);
                    let is_refused = bounds == Shares::REFUSED;
                    assert_eq!(is_refused, to > 0.4999, "{to} at {end}: {bounds:?}");
                    judged += 1;
                }
            }
        }
    }
    assert!(judged > 0, "no octave");
}

/// Without a plateau, what an error may add on the other ramp is bounded by the openness there: by no less than it is anywhere within
/// that time, also on ramps that are darkest where they meet, and whichever ramp is asked.
#[test]
fn the_openness_beyond_a_join_is_bounded() {
    let mut judged = 0;
    let mut judge = |t: [f64; 4], f: [f64; 4], time: f32| {
        let opening: [_; 4] = std::array::from_fn(|k| (t[k] as f32, f[k] as f32));
        let closing = std::array::from_fn(|k| (2.0 - opening[3 - k].0, opening[3 - k].1));
        let ramps = [opening, closing].map(CubicBezier::new);
        let Ok((exposure, shapes)) = Exposure::new(&ramps[0], &ramps[1]) else { return };
        let bounds = Side::BOTH.map(|ramp| {
            View { exposure: &exposure, shapes: &shapes, side: ramp, ramp, unit: 0 }
                .greatest_beyond(time)
        });
        assert_eq!(bounds[0], bounds[1], "a mirrored curve, {t:?} {f:?} {time:e}");
        let shape = shapes[1];
        let [openness, since] = [shape.openness().c, shape.time().c];
        let cubic =
            |constant: f64, c: [f64; 3], p: f64| constant + p * (c[0] + p * (c[1] + p * c[2]));
        let f0 = f64::from(shape.f[0]);
        for i in 0..=4096 {
            // Ever nearer to the join.
            let p = (f64::from(i) / 4096.0).powi(4);
            if cubic(0.0, since, p) < f64::from(time) {
                let there = cubic(f0, openness, p) * (1.0 - 1e-5) - 1e-12;
                assert!(
                    bounds[0] >= there,
                    "{} < {there} at {p:e}: {t:?} {f:?} {time:e}",
                    bounds[0]
                );
            }
        }
        judged += 1;
    };
    for time in [1e-9, 1e-8, 1e-6, 1e-3, 0.1] {
        judge([0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], time);
        judge([0.0, 1.0, 1.0, 1.0], [1.0, 0.0, 0.0, 0.0], time);
        judge([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [1.0, 0.0, 0.0, 0.0], time);
        judge([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [0.0, 0.0, 0.0, 1.0], time);
    }
    let mut rng = Rng::new(33, 0);
    for _ in 0..2000 {
        let (t, f) = (hard_times(&mut rng), hard_openness(&mut rng));
        let reversed = if rng.chance(0.5) { [f[3], f[2], f[1], f[0]] } else { f };
        judge(t, reversed, rng.power_of_ten(-9.0, -1.0) as f32);
    }
    assert!(judged > 1000, "only {judged}");
}
