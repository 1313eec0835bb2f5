//! A certificate is never below the truth.

use crate::fixed::{LEAST_TOP, WORD, power_of_two_f64};
use crate::fraction::Side;
use crate::inside::support::curves::named;
use crate::inside::support::families::{FAMILIES, aimed, random_hard, random_typical};
use crate::inside::support::oracle::{Curve, Dd, Exact, ulp_f32};
use crate::inside::support::times;
use crate::octave::bound::errors;
use crate::octave::build::{build, range};
use crate::octave::candidate::{Candidate, candidate};
use crate::octave::certificate::{FORWARD_ERROR, FRACTION_OFF, JOIN_OFF, ULP_ERROR, certificate};
use crate::octave::path::{Path, Stretch, value};
use crate::octave::span::Span;
use crate::octave::{Octave, top_at};
use crate::ramp::bezier::CubicBezier;

/// Judges all octaves of a curve at `samples` places each, by the way that an answer takes from a position on. Returns
/// how many there are; `greatest` becomes the greatest share of a bound that the truth comes to, in time and in light.
fn judge<const OCTAVES: usize>(curve: &Curve, samples: u32, greatest: &mut [f64; 2]) -> usize {
    let ramps = [curve.opening, curve.closing].map(CubicBezier::new);
    let Ok(integrated) = crate::curve::Curve::new(&ramps[0], &ramps[1]) else { return 0 };
    let (exact, mut count) = (Exact::new(curve), 0);
    for (side, ramp) in Side::BOTH.into_iter().flat_map(|side| Side::BOTH.map(|ramp| (side, ramp))) {
        let mut octaves = [Octave::NONE; OCTAVES];
        let top = build(&integrated, &ramps, side, &mut octaves)[ramp as usize];
        let (range, path) = (range(&integrated, side, ramp), Path::new(&integrated, &ramps, side, ramp));
        for (index, octave) in octaves.iter().enumerate().filter(|(_, octave)| octave.exists()) {
            if let Some(span) = Span::new(range, top_at(top, index)) {
                path.judge(octave, span, &exact, samples, greatest);
                count += 1;
            }
        }
    }
    count
}

impl Path<'_> {
    /// What was built of a span: the polynomial, and the stretch that it is held against.
    fn built(&self, span: Span) -> (Candidate, Stretch) {
        let stretch = self.stretch(span);
        (candidate(self, &stretch).expect("it was built"), stretch)
    }

    fn judge(&self, octave: &Octave, span: Span, exact: &Exact, samples: u32, greatest: &mut [f64; 2]) {
        let (candidate, stretch) = self.built(span);
        assert_eq!(candidate.octave, *octave);
        let (bounds, span) = (certificate(self, &candidate, &stretch), &stretch.span);
        let [unit, start] = [power_of_two_f64(self.curve.units.exponent()), self.curve.end_time(self.side).into()];
        let start_units = self.curve.in_units(self.curve.end_time(self.side));
        let trace = Dd::from(f64::from(JOIN_OFF + FRACTION_OFF * span.to));
        // The span itself rounds its end.
        let end = range(self.curve, self.side, self.ramp)[1].min(f64::from(span.to));
        // Evenly, and so also next to both ends.
        let places = (0..=samples).map(|i| span.from + (end - span.from) * f64::from(i) / f64::from(samples));
        for a in places.map(|a| f64::from(a as f32)) {
            // 1/2 is counted from the start.
            if a < span.from || a > end || a == 0.5 && self.side == Side::End {
                continue;
            }
            let position = (a / f64::from(span.power) - 1.0) * f64::from(WORD);
            let time = (octave.time(octave.offset(position.floor() as i64 as i32)) - start_units) as f64 * unit;
            let served = Dd::from(start) + Dd::from(time);
            let u = if self.side == Side::Start { Dd::from(a) } else { Dd::ONE - Dd::from(a) };
            // Next to a dark stretch a trace of the fraction takes long, and no more than that is known of joins.
            let [early, late] = [u - trace, u + trace].map(|u| exact.inverse_cdf_dd(u));
            // Counted from the side, so that no bits are lost next to the later end.
            let light = if self.side.is_end() { exact.complement_dd(served) } else { exact.cdf(served) };
            let errors = [(early - served).max(served - late).hi.max(0.0), (light - Dd::from(a)).hi.abs()];
            let limits =
                [f64::from(FORWARD_ERROR * self.size_of_time(time.abs())), f64::from(ULP_ERROR) * ulp_f32(span.from)];
            for (i, bound) in [bounds.forward, bounds.backward].into_iter().enumerate() {
                let share = errors[i] / limits[i] / f64::from(bound);
                assert!(share <= 1.0, "{share} of {bounds:?} at {a:e}: {:?}", exact.curve());
                greatest[i] = greatest[i].max(share);
            }
        }
    }
}

/// A certificate is never below the truth: on typical curves, hard ones, and those that are aimed at a difficulty.
/// `TIMES=30` before the command judges 30 times as many octaves, some 300 000.
#[test]
fn a_certificate_is_never_below_the_truth() {
    let (times, mut all) = (times(), 0);
    let mut judge = |name: &str, curves: &mut dyn Iterator<Item = Curve>| {
        let mut greatest = [0.0; 2];
        for (i, curve) in curves.enumerate() {
            all += match i % 8 {
                0 => judge::<32>(&curve, 33, &mut greatest),
                1 => judge::<2>(&curve, 257, &mut greatest),
                _ => judge::<8>(&curve, 65, &mut greatest),
            }
        }
        std::println!("{name}: {greatest:?}");
    };
    judge("named", &mut ["typical", "hard"].into_iter().flat_map(named).map(|one| one.curve));
    judge("typical", &mut (0..200 * times).map(|i| random_typical(31, i)));
    judge("hard", &mut (0..200 * times).map(|i| random_hard(31, i)));
    for (family, (name, ..)) in FAMILIES.iter().enumerate() {
        judge(name, &mut (0..25 * times).map(|i| aimed(family, 31, i)));
    }
    assert!(all > 9000, "only {all} octaves");
}

/// An octave in lsb. Its `x` is `at + 0.49 s`, in widths; its polynomial errs by `peak (1 - s)⁸ / 2⁸`, less that at 0
/// and `time[0]`.
#[derive(Clone, Copy, Default)]
struct Made {
    at: f64,
    peak: f64,
    time: [f64; 4],
    since_end: f64,
    openness: [f64; 4],
    truncation: f32,
    slope: f32,
    is_joined: bool,
}

/// A bound has room for each of what may be wrong, where that is all that is: for most, half of the room would not do.
#[test]
fn a_certificate_has_room_for_each_error() {
    let ramps = [[(1.0, 0.0), (2.0, 1.0)], [(3.0, 1.0), (4.0, 0.0)]].map(|[from, to]| CubicBezier::line(from, to));
    let integrated = crate::curve::Curve::new(&ramps[0], &ramps[1]).expect("a shutter");
    let path = Path::new(&integrated, &ramps, Side::Start, Side::Start);
    // The curve lasts 3.
    assert_eq!([0.5, 2.5].map(|since_end| path.size_of_time(since_end)), [1.5, 3.0]);
    // In an lsb in which these errors are far beyond their limits, all points are sampled, and in a small one half.
    for (top, lsb) in [(0.234f32.to_bits(), -40), (LEAST_TOP, -40), (0.234f32.to_bits(), -90), (LEAST_TOP, -90)] {
        let (span, lsb) = (|| Span::new([0.0, 0.5], top).expect("an octave"), power_of_two_f64(lsb));
        let (center, per_position) = span().offsets();
        // As they are in lsb; in light fully open.
        let bounds = |made: Made| {
            let (mut candidate, mut stretch) = path.built(span());
            for (k, binomial) in [-8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0].into_iter().enumerate() {
                let c = made.peak / 256.0 * binomial + made.time.get(k + 1).unwrap_or(&0.0);
                candidate.octave.c[7 - k] = (c / 0.49f64.powi(k as i32 + 1)).round() as i32;
            }
            (candidate.middle_time, candidate.lsb) = (made.since_end, lsb);
            (candidate.slope_bound_lsb, candidate.truncation_lsb) = (made.slope, made.truncation);
            (stretch.openness, stretch.is_joined) = (made.openness, made.is_joined);
            stretch.time = made.time.map(|t| t * lsb);
            stretch.time[0] += made.since_end;
            stretch.position = [center + made.at / per_position, 0.49 / per_position, 0.0, 0.0, 0.0, 0.0, 0.0];
            let bounds = certificate(&path, &candidate, &stretch);
            let size = f64::from(FORWARD_ERROR * path.size_of_time(made.since_end));
            let limit = f64::from(ULP_ERROR) * ulp_f32(stretch.span.from) / integrated.per_area;
            [f64::from(bounds.forward) * size / lsb, f64::from(bounds.backward) * limit / lsb]
        };
        let fraction_off = f64::from(JOIN_OFF) + f64::from(FRACTION_OFF * span().to);
        let path_off = 1e15 * (0.5 * per_position + fraction_off / f64::from(span().width));
        let (none, open) = (Made::default(), [1.0, 0.0, 0.0, 0.0]);
        // From the dark, which all of the error in time leads from, for 0.8933 of `s`; 0.35 of that lies before time
        // nearly stands still, so light is half of 0.7362 of it. Or for 0.4, from where it stands still: two thirds.
        let dark = Made { openness: [0.5, 0.5, 0.0, 0.0], peak: 16e6, ..none };
        let ([t, base], still) = ([dark.peak / 0.2263, -dark.peak / 256.0], 0.687);
        let cubic = [base, 3.0 * t * still * still, 3.0 * t * still, t];
        let square = [base, 12.5 * dark.peak, 6.25 * dark.peak, 0.0];
        let rounded = Made { truncation: 1e6, time: [0.0, 5e8, 0.0, 0.0], peak: 0.0, ..dark };
        let cut = 0.99 * power_of_two_f64(-24);
        for (what, made, least) in [
            ("Horner's rule, in a sample and an answer", rounded, [2e6; 2]),
            ("a position, and a path", Made { slope: 1e15, openness: open, ..none }, [path_off; 2]),
            ("a path's time", Made { since_end: 1.0, ..none }, [0.99 * power_of_two_f64(-46) / lsb, 0.0]),
            ("a fraction", none, [0.0, fraction_off / lsb / integrated.per_area]),
            ("a sample's time", Made { time: [cut; 4], openness: open, ..none }, [4.0 * cut; 2]),
            ("a way across", Made { time: cubic, ..dark }, [dark.peak, 0.5 * 0.7362 * 0.8933 * dark.peak]),
            ("a way away", Made { time: square, ..dark }, [dark.peak, 0.5 * 0.4 / 1.5 * dark.peak]),
            ("beyond a join", Made { time: [1e6, 0.0, 0.0, 0.0], is_joined: true, ..none }, [1e6; 2]),
        ] {
            let (bounds, rounds) = (bounds(made), 1.0 - power_of_two_f64(-16));
            let holds = bounds[0] >= least[0] * rounds && bounds[1] >= least[1] * rounds;
            assert!(holds, "{what}: {bounds:?}, not {least:?}");
        }
        // An offset beyond its word, whichever way: its samples would be those of another polynomial.
        for at in [0.0098, 0.00991, 0.02, 0.25, 1.0] {
            let is_refused = |at| bounds(Made { at, ..none })[0] == f64::INFINITY;
            assert_eq!([is_refused(at), is_refused(-at)], [at > 0.0099; 2], "{at}");
        }
    }
}

/// On waves of which each sample misses the crest, too. Without its factor the bound of time would be too small, that
/// of light even with half of it.
#[test]
fn a_bound_is_not_below_what_samples_miss() {
    let waves = Octave { c: [1 << 30, 0, -1 << 29, 0, 5 << 24, 0, -1 << 22, 0], ..Octave::NONE };
    for (all, width, at, skew) in [(true, 0.99, 0.008, 0.0), (true, 0.985, 0.01, 1.0), (false, 0.985, 0.01, 1.0)] {
        // The error is T₈(T₆(width s + at)) · 2¹⁵, by Chebyshev's polynomials, and a hump.
        let mut c = [0.0; 7];
        for t6 in [32.0, 0.0, -48.0, 0.0, 18.0, 0.0, -1.0] {
            c = std::array::from_fn(|k| at * c[k] + if k > 0 { width * c[k - 1] } else { t6 });
        }
        let position = c.map(|c| (c * 0.499995 * power_of_two_f64(32 + 20)) as i64);
        let t8 = [1.0, 0.0, -32.0, 0.0, 160.0, 0.0, -256.0, 0.0, 128.0];
        let openness = [1.0, -skew, -1.0, skew];
        for (which, hump) in [(0, -0.4), (1, 0.0)] {
            let time = [-1.0 - hump, 0.0, hump, 0.0].map(|t| (t * power_of_two_f64(15 + 24)) as i64);
            let (of_time, of_light) = errors(&waves, &position, &time, &openness.map(|f| f as f32), [4.0; 2], all);
            let bound = f64::from([of_time, of_light][which]) * power_of_two_f64(-15);
            for s in (-50_000..=50_000).map(|i| f64::from(i) / 50_000.0) {
                let error = value(&t8, 0.99999 * value(&c, s)) + hump * (1.0 - s * s);
                let light = [1.0, value(&openness, s)][which];
                assert!((error * light).abs() <= bound, "{error} at {s}: {light}, {bound}");
            }
        }
    }
}
