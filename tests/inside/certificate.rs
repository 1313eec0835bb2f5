//! A certificate is never below the truth.

use crate::fixed::{WORD, fixed_down, power_of_two_f64};
use crate::fraction::Side;
use crate::inside::support::curves::{Rng, named};
use crate::inside::support::families::{FAMILIES, aimed, random_hard, random_typical};
use crate::inside::support::oracle::{Curve, Dd, Exact, ulp_f32};
use crate::inside::support::times;
use crate::octave::build::{build, range};
use crate::octave::candidate::{Candidate, candidate};
use crate::octave::certificate::{ErrorOverLimit, FORWARD_ERROR, FRACTION_OFF, JOIN_OFF, ULP_ERROR, certificate};
use crate::octave::path::{Path, Stretch, value};
use crate::octave::span::Span;
use crate::octave::{Octave, top_at};
use crate::ramp::bezier::CubicBezier;

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
        let Ok(integrated) = crate::curve::Curve::new(&ramps[0], &ramps[1]) else {
            return;
        };
        let exact = Exact::new(curve);
        for side in Side::BOTH {
            let mut octaves = [Octave::NONE; OCTAVES];
            let tops = build(&integrated, &ramps, side, &mut octaves);
            for (ramp, steps) in Side::BOTH.into_iter().zip(tops) {
                let (range, path) = (range(&integrated, side, ramp), Path::new(&integrated, &ramps, side, ramp));
                for (index, octave) in octaves.iter().enumerate().filter(|(_, o)| o.exists()) {
                    if let Some(span) = Span::new(range, top_at(steps, index)) {
                        self.octaves += 1;
                        path.judge(octave, span, &exact, samples, &mut self.greatest);
                    }
                }
            }
        }
    }
}

impl Path<'_> {
    /// What was built of a span: the polynomial, and the stretch that it is held against.
    fn built(&self, span: Span) -> (Candidate, Stretch) {
        let stretch = self.stretch(span);
        (candidate(self, &stretch).expect("it was built"), stretch)
    }

    fn judge(&self, octave: &Octave, span: Span, exact: &Exact, samples: u32, greatest: &mut [f64; 2]) {
        let (candidate, stretch) = self.built(span);
        let span = &stretch.span;
        assert_eq!(candidate.octave, *octave);
        let bounds = certificate(self, &candidate, &stretch);
        let start = fixed_down(self.curve.end_time(self.side), self.curve.units.exponent());
        let error_in_u = f64::from(ULP_ERROR) * ulp_f32(span.from);
        let trace = Dd::from(f64::from(JOIN_OFF + FRACTION_OFF * span.to));
        // The span itself rounds its end.
        let end = range(self.curve, self.side, self.ramp)[1].min(f64::from(span.to));
        for i in 0..=samples {
            // Evenly, and so also next to both ends.
            let a = span.from + (end - span.from) * f64::from(i) / f64::from(samples);
            let a = f64::from(a as f32);
            // 1/2 is counted from the start.
            if a < span.from || a > end || a == 0.5 && self.side == Side::End {
                continue;
            }
            let position = (a / f64::from(span.power) - 1.0) * f64::from(WORD);
            let position = position.floor() as i64 as i32;
            let time = octave.time(octave.offset(position)) - start;
            let time = time as f64 * power_of_two_f64(self.curve.units.exponent());
            let served = Dd::from(f64::from(self.curve.end_time(self.side))) + Dd::from(time);
            let u = if self.side == Side::Start { Dd::from(a) } else { Dd::ONE - Dd::from(a) };
            // Next to a dark stretch a trace of the fraction takes long, and no more than that is known of joins.
            let [early, late] = [u - trace, u + trace].map(|u| exact.inverse_cdf_dd(u));
            let off = (early - served).max(served - late).hi.max(0.0);
            let size = f64::from(self.size_of_time(time.abs()));
            // Counted from the side, so that no bits are lost next to the later end.
            let light = if self.side == Side::Start {
                exact.cdf(served) - u
            } else {
                exact.complement_dd(served) - Dd::from(a)
            };
            let share = [
                off / (f64::from(FORWARD_ERROR) * size) / f64::from(bounds.forward),
                light.hi.abs() / error_in_u / f64::from(bounds.backward),
            ];
            for (greatest, share) in greatest.iter_mut().zip(share) {
                assert!(share <= 1.0, "{share} of {bounds:?} at {a:e}: {:?}", exact.curve());
                *greatest = greatest.max(share);
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
    judge("named", &mut ["typical", "hard"].into_iter().flat_map(named).map(|one| one.curve));
    judge("typical", &mut (0..200 * times).map(|i| random_typical(31, i)));
    judge("hard", &mut (0..200 * times).map(|i| random_hard(31, i)));
    // Joins so near to time 0 that a share of nearly all has too few bits to tell them.
    let least = |i| {
        let mut rng = Rng::new(31, i);
        let [open, close, end] = [-9.0, -9.0, 1.0].map(|most| rng.power_of_ten(most - 3.0, most) as f32);
        let dim = rng.unit() as f32;
        let [opening, closing] = [(open, [0.0, 0.0, dim, dim]), (end, [1.0, dim, 0.0, 0.0])];
        let thirds =
            |start: f32, (length, f): (f32, [f32; 4])| std::array::from_fn(|k| (start + length * k as f32 / 3.0, f[k]));
        Curve::shutter(thirds(-open, opening).map(|(t, f)| (t.min(0.0), f)), thirds(close, closing))
    };
    judge("least shares", &mut (0..25 * times).map(least));
    for (family, (name, ..)) in FAMILIES.iter().enumerate() {
        judge(name, &mut (0..25 * times).map(|i| aimed(family, 31, i)));
    }
    assert!(all > 9000, "only {all} octaves");
}

/// A stretch on which an offset would leave its word is refused, whichever way it leaves: its samples would be those of
/// another polynomial.
#[test]
fn an_offset_beyond_its_word_is_refused() {
    let trapezoid = &named("typical")[1].curve;
    let ramps = [trapezoid.opening, trapezoid.closing].map(CubicBezier::new);
    let integrated = crate::curve::Curve::new(&ramps[0], &ramps[1]).expect("a shutter");
    let mut judged = 0;
    for side in Side::BOTH {
        let path = Path::new(&integrated, &ramps, side, side);
        let mut octaves = [Octave::NONE; 8];
        let tops = build(&integrated, &ramps, side, &mut octaves);
        for (index, _) in octaves.iter().enumerate().filter(|(_, octave)| octave.exists()) {
            let Some(span) = Span::new(range(&integrated, side, side), top_at(tops[side as usize], index)) else {
                continue;
            };
            let (candidate, mut stretch) = path.built(span);
            let (center, per_position) = stretch.span.offsets();
            let position = stretch.position;
            for to in [0.4998, 0.49991, 0.51, 0.75, 1.0, 1.5] {
                for end in [-1.0, 1.0] {
                    // Moved until its end is there.
                    let offset = (value(&position, end) - center) * per_position;
                    stretch.position = position;
                    stretch.position[0] += (end * to - offset) / per_position;
                    let bounds = certificate(&path, &candidate, &stretch);
                    let is_refused = bounds == ErrorOverLimit::REFUSED;
                    assert_eq!(is_refused, to > 0.4999, "{to} at {end}: {bounds:?}");
                    judged += 1;
                }
            }
        }
    }
    assert!(judged > 0, "no octave");
}
