//! What is refused, with the variant, the part and the point that it names, to the adjacent `f32` on each side of each
//! rule; and what is clamped.

use std::collections::BTreeMap;

use crate::support::curves::{LEAST_EXPOSURE, instant, is_valid, line, named, verdict};
use crate::support::families::{DESIGNS, FAMILIES, aimed, design, random_typical};
use crate::support::oracle::{Curve, Exact, Points, exp2};
use CurveError as E;
use Part::{Closing, Opening, Plateau};
use shutter_curve::{CubicBezier, CurveError, Hz, Part, ScheduleError, ShutterCurve};

/// The verdict on a curve, the same as the tests' own, on the mirrored curve too.
fn judged(curve: &Curve) -> Result<(), CurveError> {
    let [_, judged] = [curve.mirrored(), *curve].map(|curve| {
        let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
        let (got, ours) = (ShutterCurve::<0>::with_octaves(opening, closing).map(|_| ()), verdict(&curve));
        // Next to the least exposure, but not at it, an `f64` may round the difference away.
        let is_rounded = [got, ours].contains(&Err(E::DensityTooSmall)) && {
            let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
            let off = (Exact::new(&curve).area().hi / (LEAST_EXPOSURE * length) - 1.0).abs();
            off > 0.0 && off < exp2(-45)
        };
        assert!(got == ours || is_rounded, "{got:?} for {ours:?}: {curve:?}");
        ours
    });
    judged
}

/// Plain curves, on the edge of a rule or where a version failed; then some of each family.
fn accepted() -> impl Iterator<Item = Curve> {
    let aimed = (0..200).map(|i| aimed(i % FAMILIES.len(), 1, (i / FAMILIES.len()) as u64));
    let designs = (0..80).map(|i| design(i % DESIGNS.len(), (i / DESIGNS.len()) as u64));
    let plain = named("edge").into_iter().map(|one| one.curve);
    plain.chain((0..20).map(|i| random_typical(1, i))).chain(aimed).chain(designs)
}

/// Each number of a curve, alone or with those that equal it, moved to the last that is accepted and to the next one.
#[test]
fn each_rule_to_the_adjacent_f32() {
    // All numbers in order: a positive one by its bits.
    let number = |place: i32| f32::from_bits(place.unsigned_abs()).copysign(place as f32);
    let mut seen = BTreeMap::new();
    for curve in accepted() {
        assert_eq!(judged(&curve), Ok(()), "{curve:?}");
        for (which, all) in (0..16).flat_map(|which| [(which, false), (which, true)]) {
            let one = |curve: &Curve| {
                let (t, f) = [curve.opening, curve.closing].concat()[which / 2];
                if which % 2 == 0 { t } else { f }
            };
            let moved = |x: f32| {
                let to = |(i, (t, f)): (usize, (f32, f32))| {
                    let is_moved = |y: f32| i == which / 2 || all && y == one(&curve);
                    if which % 2 == 0 {
                        (if is_moved(t) { x } else { t }, f)
                    } else {
                        (t, if is_moved(f) { x } else { f })
                    }
                };
                let points: Vec<_> = [curve.opening, curve.closing].concat().into_iter().enumerate().map(to).collect();
                Curve::shutter(points[..4].try_into().unwrap(), points[4..].try_into().unwrap())
            };
            for most in [f32::MAX.to_bits() as i32, -(f32::MAX.to_bits() as i32)] {
                let x = one(&curve);
                let (mut last, mut beyond) = (x.abs().to_bits() as i32 * if x < 0.0 { -1 } else { 1 }, most);
                while last.abs_diff(beyond) > 1 {
                    let middle = i32::midpoint(last, beyond);
                    *(if verdict(&moved(number(middle))).is_ok() { &mut last } else { &mut beyond }) = middle;
                }
                assert_eq!(judged(&moved(number(last))), Ok(()));
                let error = judged(&moved(number(beyond))).expect_err("beyond the edge");
                *seen.entry(format!("{error:?}")).or_insert(0) += 1;
            }
            for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                *seen.entry(format!("{:?}", judged(&moved(bad)).expect_err("no number"))).or_insert(0) += 1;
            }
        }
    }
    println!("{seen:#?}");
    // Every error with each part and point that it may name.
    assert!(seen.len() == 25 && seen.values().all(|count| *count >= 10));
}

/// Several rules at once, and what broke a promise of versions before.
#[test]
fn refused() {
    let ramp = |f: f32, g: f32| move |from: f32, to: f32| line((from, f), (to, g));
    let (dark, opens, open) = (ramp(0.0, 0.0), ramp(0.0, 1.0), ramp(1.0, 0.0));
    let shut = [(0.0, 0.0), (0.0, 1.0), (0.5, 1.0), (1.0, 0.0)];
    let back = [(0.0, 0.0), (1.3, 0.0), (-0.3, 1.0), (1.0, 1.0)];
    // 2⁻¹⁰⁰ and 2⁻⁶¹.
    let [tiny, unit] = [exp2(-100) as f32, exp2(-61) as f32];
    for (name, opening, closing, error) in [
        ("no light", dark(0.0, 1.0), [(1.0, 0.0); 4], E::DensityTooSmall),
        ("an epoch in s", instant(1.7e9), instant((1.7e9 + 1e-3) as f32), E::IntervalUnresolved),
        ("times of 1e38", instant(-3e38), instant(3e38), E::IntervalOutOfRange),
        ("no length", instant(0.0), instant(0.0), E::IntervalOutOfRange),
        ("no length, and not at time 0", instant(-1e-3), instant(-1e-3), E::IntervalUnresolved),
        ("dark at the join", shut, open(1.0, 2.0), E::NotFullyOpen(Opening)),
        ("back in time", back, open(1.0, 2.0), E::TimeOutsideRamp { part: Opening, point: 1 }),
        ("little light", opens(-1.0, -tiny / 4.0), open(-tiny / 4.0, tiny), E::TooShort(Closing)),
        ("ticks back", dark(-0.5, -2.0 * unit), dark(unit, 0.5), E::TooShort(Plateau)),
        ("2^-149", opens(-f32::from_bits(1), 0.0), instant(1.0), E::TooShort(Opening)),
    ] {
        assert_eq!(judged(&Curve::shutter(opening, closing)), Err(error), "{name}");
    }
    // A density's openness counts in units of its own.
    let density = |points: Points| ShutterCurve::density(CubicBezier::new(points)).map(|_| ());
    for (f, expected) in [(1.0, Ok(())), (1f32.next_up(), Err(E::DensityOutOfRange)), (1e-7, Err(E::DensityTooSmall))] {
        assert_eq!(density(line((0.0, f), (1.0, f))), expected);
    }
}

/// Messages that are put together: the part, the point, the rule, numbers and the remedy.
#[rustfmt::skip]
#[test]
fn messages() {
    use ScheduleError as S;
    let part = Opening;
    for (error, text) in [
        (E::TimeOutsideRamp { part, point: 2 },
         "opening ramp: the time of its second inner point has to lie between the ramp's ends"),
        (E::FractionOutsideRamp { part: Closing, point: 1 },
         "closing ramp: the time of its first inner point has to lie on the ramp, as a fraction of the whole interval: \
          0 at open_start, 1 at close_end"),
        (E::OpennessOutOfRange { part, point: 0 }, "opening ramp: the openness of its first point has to be in [0, 1]"),
        (E::OpennessOutOfRange { part, point: 3 }, "opening ramp: the openness of its last point has to be in [0, 1]"),
        (E::NotFullyOpen(Opening), "opening ramp: it has to end fully open, at openness 1"),
        (E::NotFullyOpen(Closing), "closing ramp: it has to begin fully open, at openness 1"),
        (E::TooShort(Plateau),
         "plateau: it is shorter than 2^-24 of the greatest time; make it longer, or give it no length"),
    ] {
        assert_eq!(error.to_string(), text);
    }
    for (error, text) in [
        (S::RateTooHigh { max: Hz(9) },
         "the curve has more than 2^31 ticks; use a rate of at most 9 Hz, and times in seconds"),
        (S::RateTooHigh { max: Hz(0) },
         "the curve has more than 2^31 ticks at any rate; its times have to be in seconds"),
        (S::TooMany { max: 1 << 22 }, "more triggers or pulses than fit; use at most 4194304"),
        (S::GapTooSmall { trigger: u32::MAX, gap: 0, min_gap: u32::MAX },
         "the gap before trigger 4294967295 is 0 ticks; the minimum is 4294967295; \
          use fewer triggers (max_triggers), or a faster timer; is its rate in Hz?"),
        (S::PulsesTooClose { pulse: 17, gap: 1, min_gap: 4711 },
         "the gap before pulse 17 is 1 tick; the minimum is 4711; \
          use fewer pulses, or a smaller duty; with min_gap(0) pulses may touch"),
        (S::PulseTooShort { pulse: 17, length: 815, min_pulse: 4711 },
         "pulse 17 lasts 815 ticks; the minimum is 4711; use fewer pulses, a larger duty, or a faster timer"),
    ] {
        assert_eq!(error.to_string(), text);
    }
}

/// Inner times that mean an end or a join, typed as decimals or divided out: accepted, in s and in ms, and on the ramp.
/// At 0 and 1 they are exactly the curve's ends.
#[test]
fn inner_points_at_ends_and_joins_are_accepted() {
    let mut curves = 0;
    for (length, decimals) in [(0.1, 5), (0.01, 6), (1.0, 4), (10.0, 3), (100.0, 3), (0.02, 6), (2.13, 5), (8.1, 4)] {
        for start in [0.0, 0.1, 1000.0, -3.3, -2.0 * length, length, -0.37 * length] {
            for (open, close) in (0..=100).step_by(7).flat_map(|i| (i..=100).step_by(9).map(move |k| (i, k))) {
                let parts = [0, open, close, 100].map(|part| f64::from(part) / 100.0);
                // As a person writes a decimal, and a program reads it.
                let times = |unit: f64, decimals: usize| {
                    parts.map(|part| format!("{:.decimals$}", unit * (start + length * part)).parse().unwrap())
                };
                for times in [times(1.0, decimals), times(1000.0, 1)] {
                    curves += judge_inner(times, [parts[1], parts[2]]) as u32;
                }
            }
        }
    }
    assert!(curves > 10_000, "{curves}");
    // What was refused by versions before, once the closing ramp is as long as it has to be.
    let inner = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0];
    for (times, expected) in [
        ([-1.3883804, -0.6941902, 4.2855483e-10, 1.8542775e-7], Ok(())),
        ([-1.3883804, -0.6941902, 4.2855483e-10, 1.8542775e-9], Err(E::TooShort(Closing))),
        ([-1e19, -1e19, 1000.0, 1e15], Ok(())),
        // At 1 also to the bit, which the start and a length do not have.
        ([-1.0, -0.5, -1e-7, 9.5e-16], Ok(())),
        ([-1e19, -1e19, 1000.0, 1500.0], Err(E::TooShort(Closing))),
    ] {
        assert_eq!(ShutterCurve::shutteropening(times, inner).map(|_| ()), expected, "{times:?}");
        assert_eq!(CubicBezier::shutteropening(times, inner).1.points()[1].0, times[3]);
    }
}

/// Is a straight shutter with these times accepted? Then those with inner points at its ends have to be.
fn judge_inner(times: [f32; 4], parts: [f64; 2]) -> bool {
    let [start, open, close, end] = times;
    if !is_valid(&Curve::shutter(line((start, 0.0), (open, 1.0)), line((close, 1.0), (end, 0.0)))) {
        return false;
    }
    let [from, to] = [start, end].map(f64::from);
    // As it is typed, and as `(join - start) / (end - start)` is computed in either precision.
    let [opened, closes] = [(open, parts[0]), (close, parts[1])].map(|(join, part)| {
        [part as f32, (join - start) / (end - start), ((f64::from(join) - from) / (to - from)) as f32]
    });
    for (opened, closes) in opened.into_iter().zip(closes) {
        for [t1, t2, t5, t6] in [[0.0, opened, closes, 1.0], [opened, opened, closes, closes], [0.0, 0.0, 1.0, 1.0]] {
            let (opening, closing) = CubicBezier::shutteropening(times, [t1, 0.0, t2, 1.0, t5, 1.0, t6, 0.0]);
            let (opening, closing) = (opening.points(), closing.points());
            assert_eq!(judged(&Curve::shutter(opening, closing)), Ok(()), "{times:?}");
            for (t, fraction, ramp) in [
                (opening[1].0, t1, [start, open]),
                (opening[2].0, t2, [start, open]),
                (closing[1].0, t5, [close, end]),
                (closing[2].0, t6, [close, end]),
            ] {
                let is_end = fraction == 0.0 && t == start || fraction == 1.0 && t == end;
                // In doubles, as far as rounding passes the ramp it is its end.
                let meant = (from + f64::from(fraction) * (to - from)).clamp(ramp[0].into(), ramp[1].into());
                let rounding = exp2(-24) * meant.abs() + exp2(-50) * to.abs().max(from.abs());
                let is_right = (f64::from(t) - meant).abs() <= rounding && (ramp[0]..=ramp[1]).contains(&t);
                assert!(if [0.0, 1.0].contains(&fraction) { is_end } else { is_right }, "{t:e}, {fraction}, {times:?}");
            }
        }
    }
    true
}

/// Inner times that are fractions of each ramp, as an easing curve has them, and numbers that are none.
#[test]
fn shutteropening_names_what_is_wrong() {
    let curve = |times, inner| ShutterCurve::shutteropening(times, inner).map(|_| ());
    let (times, inner) = ([0.0, 0.25, 0.75, 1.0], [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0]);
    assert_eq!(curve(times, inner), Ok(()));
    for (i, part, point) in [(0, Opening, 1), (2, Opening, 2), (4, Closing, 1), (6, Closing, 2)] {
        // More than rounding beyond its ramp.
        let [from, to] = if i < 4 { [0.0, 0.25] } else { [0.75, 1.0] };
        for beyond in [from - 1e-6, to + 1e-6] {
            let mut inner = inner;
            inner[i] = beyond;
            assert_eq!(curve(times, inner), Err(E::FractionOutsideRamp { part, point }), "{beyond}");
        }
    }
    // Six ulp beyond, on an interval of 256.
    let far = [65535.0, 65535.25, 65535.75, 65536.0];
    let beyond = curve(far, [0.1, 0.0, 0.2734, 1.0, 0.85, 1.0, 0.9, 0.0]);
    assert_eq!(beyond, Err(E::FractionOutsideRamp { part: Opening, point: 2 }));
    assert_eq!(curve(far, [0.1, 0.0, 0.2539, 1.0, 0.85, 1.0, 0.9, 0.0]), Ok(()));
    // The ramp whose number it is.
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for i in 0..12 {
            let (mut times, mut inner) = (times, inner);
            *(if i < 4 { &mut times[i] } else { &mut inner[i - 4] }) = bad;
            let ramp = if matches!(i, 0 | 1 | 4..8) { Opening } else { Closing };
            assert_eq!(curve(times, inner), Err(E::NotFinite(ramp)), "number {i} is {bad}");
        }
    }
}

#[test]
fn fractions_and_times_beyond_the_curve() {
    let curve = ShutterCurve::linear(2.0, 2.25, 2.75, 3.0).unwrap();
    for u in [0.0, -0.0, -1e-45, -0.3, -1.0, -2.0, f32::MIN, f32::NEG_INFINITY, f32::NAN, -f32::NAN] {
        assert_eq!(curve.inverse_cdf(u), 2.0, "{u}");
    }
    for u in [1.0, 1.0f32.next_up(), 1.3, 2.0, f32::MAX, f32::INFINITY] {
        assert_eq!(curve.inverse_cdf(u), 3.0, "{u}");
    }
    let jumps = ShutterCurve::density(CubicBezier::line((2.0, 0.25), (3.0, 0.75))).unwrap();
    for (t, cdf) in [
        (2.0f32.next_down(), 0.0),
        (f32::NEG_INFINITY, 0.0),
        (f32::NAN, 0.0),
        (-f32::NAN, 0.0),
        (3.0f32.next_up(), 1.0),
        (f32::INFINITY, 1.0),
    ] {
        assert_eq!((curve.openness(t), curve.pdf(t), curve.cdf(t)), (0.0, 0.0, cdf), "{t}");
        assert_eq!((jumps.openness(t), jumps.pdf(t), jumps.cdf(t)), (0.0, 0.0, cdf), "{t}");
    }
    assert_eq!((curve.cdf(2.0), curve.cdf(3.0)), (0.0, 1.0));
    // The ends belong to the curve, where it jumps.
    assert_eq!((jumps.pdf(2.0), jumps.pdf(3.0)), (0.5, 1.5));
    let flash = ShutterCurve::linear(0.0, 0.0, 1.0, 1.0).unwrap();
    assert_eq!((flash.openness(0.0), flash.openness(1.0)), (1.0, 1.0));
    // A mass whose coefficients are cut is below 0 here.
    let dim = [(0.0, 6.9078763e-18), (0.9375, 0.0), (0.0, 0.0), (1.0, 1.0)];
    let dim = ShutterCurve::density(CubicBezier::new(dim)).unwrap();
    assert!([2.1808408e-17, 3.1034353e-12, 2.107859e-8].iter().all(|t| dim.cdf(*t) >= 0.0));
}
