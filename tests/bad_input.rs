//! Every kind of bad input, and what happens: its own error, a clamp, or an empty answer.

use shutter_curve::{CubicBezier, CurveError, Part, ScheduleError, ShutterCurve};

type Points = [(f32, f32); 4];

const OPENING: Points = [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)];
const CLOSING: Points = [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)];

fn shutter(opening: Points, closing: Points) -> Result<ShutterCurve, CurveError> {
    ShutterCurve::new(CubicBezier::new(opening), CubicBezier::new(closing))
}

/// With nothing after it.
fn single(points: Points) -> Result<ShutterCurve, CurveError> {
    shutter(points, [(points[3].0, 0.0); 4])
}

/// The good curve with one coordinate changed.
fn with(
    ramp: Part,
    point: usize,
    t: Option<f32>,
    f: Option<f32>,
) -> Result<ShutterCurve, CurveError> {
    let (mut opening, mut closing) = (OPENING, CLOSING);
    let points = if ramp == Part::Opening { &mut opening } else { &mut closing };
    points[point].0 = t.unwrap_or(points[point].0);
    points[point].1 = f.unwrap_or(points[point].1);
    shutter(opening, closing)
}

#[test]
fn a_good_curve_is_built() {
    assert!(shutter(OPENING, CLOSING).is_ok());
    assert!(single(OPENING).is_ok());
}

#[test]
fn control_points_must_be_finite() {
    for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for point in 0..4 {
            for ramp in [Part::Opening, Part::Closing] {
                let expected = Err(CurveError::NotFinite(ramp));
                assert_eq!(with(ramp, point, Some(bad), None), expected);
                assert_eq!(with(ramp, point, None, Some(bad)), expected);
            }
        }
    }
}

#[test]
fn times_must_be_in_order() {
    let expected = Err(CurveError::TimesOutOfOrder);
    assert_eq!(ShutterCurve::linear(0.0, 0.5, 0.25, 1.0), expected);
    assert_eq!(ShutterCurve::linear(0.3, 0.25, 0.75, 1.0), expected);
    assert_eq!(ShutterCurve::linear(0.0, 0.25, 0.75, 0.7), expected);
}

#[test]
fn time_must_not_turn_back() {
    let back = |ramp, point, t| {
        assert_eq!(with(ramp, point, Some(t), None), Err(CurveError::TimeTurnsBack(ramp)))
    };
    back(Part::Opening, 1, -0.01);
    back(Part::Opening, 2, 0.26);
    back(Part::Closing, 1, 0.74);
    back(Part::Closing, 2, 1.01);
    // Both ends run forward, the middle does not: d1² > d0 d2.
    let s = [(0.0, 0.0), (0.3, 0.0), (0.0, 1.0), (0.25, 1.0)];
    assert_eq!(shutter(s, CLOSING), Err(CurveError::TimeTurnsBack(Part::Opening)));
    // And just forward: d1² = d0 d2.
    assert!(shutter([(0.0, 0.0), (0.25, 0.0), (0.0, 1.0), (0.25, 1.0)], CLOSING).is_ok());
}

#[test]
fn openness_must_stay_in_bounds() {
    let negative = |ramp, point, f| {
        assert_eq!(with(ramp, point, None, Some(f)), Err(CurveError::NegativeOpenness(ramp)))
    };
    negative(Part::Opening, 0, -1e-3);
    negative(Part::Opening, 1, -0.1);
    negative(Part::Closing, 2, -0.1);
    negative(Part::Closing, 3, -1e-3);
    let above = |ramp, point, f| {
        assert_eq!(with(ramp, point, None, Some(f)), Err(CurveError::OpennessAboveOne(ramp)))
    };
    above(Part::Opening, 3, 1.001);
    above(Part::Opening, 2, 1.1);
    above(Part::Closing, 0, 1.001);
    above(Part::Closing, 1, 1.1);
    let dip = [(0.0, 1.0), (0.1, -0.4), (0.2, -0.4), (0.3, 1.0)];
    assert_eq!(single(dip), Err(CurveError::NegativeOpenness(Part::Opening)));
}

#[test]
fn grazing_by_rounding_is_accepted_and_solved() {
    // A double root of f at p = 1/2 would need -1/3.
    for f in [-0.33333334, -0.3333333, -0.3333334] {
        let touch = [(0.0, 1.0), (0.1, f), (0.2, f), (0.3, 1.0)];
        let curve = shutter(touch, CLOSING).unwrap();
        assert!((0..=1000).all(|i| (0.0..=1.0).contains(&curve.openness(i as f32 * 3e-4))));
        let mut last = 0.0;
        for i in 0..=100_000 {
            let t = curve.inverse_cdf(i as f32 / 100_000.0);
            assert!(t >= last && t <= 1.0);
            last = t;
        }
    }
    // Control values outside [0, 1], the curve just touching 1 at p = 1/2: f = 1 - (1 - 2p)².
    let bump = [(0.0, 0.0), (0.1, 4.0 / 3.0), (0.2, 4.0 / 3.0), (0.3, 0.0)];
    assert!(shutter(bump, CLOSING).is_ok());
    // One bit more passes 1 by 2^-23, which `f32` can tell.
    let above = bump.map(|(t, f)| (t, if f > 0.0 { f.next_up() } else { f }));
    let curve = shutter(above, CLOSING).unwrap();
    assert!((0..=10_000).all(|i| curve.openness(0.1 + i as f32 * 1e-5) <= 1.0));
    // t' with a double root at 1/2, grazing it by the rounding of the control times.
    for t in [0.3f32, 0.3f32.next_up(), 0.3f32.next_down()] {
        assert!(shutter([(0.0, 0.0), (t, 0.1), (0.0, 0.9), (0.3, 1.0)], CLOSING).is_ok());
    }
}

/// The bound is held from both sides.
#[test]
fn grazing_ends_at_2_to_the_minus_22() {
    const GRAZE: f32 = 1.0 / (1 << 22) as f32;
    // f = 3/4 (1/3 + f1) at p = 1/2, and 1 at most.
    let dip = |by: f32| {
        let f = (-1.0 / 3.0 - by as f64 * 4.0 / 3.0) as f32;
        [(0.0, 1.0), (0.1, f), (0.2, f), (0.3, 1.0)]
    };
    assert!(shutter(dip(0.75 * GRAZE), CLOSING).is_ok());
    let below = CurveError::NegativeOpenness;
    assert_eq!(shutter(dip(1.25 * GRAZE), CLOSING), Err(below(Part::Opening)));
    assert_eq!(shutter(dip(2.0 * GRAZE), CLOSING), Err(below(Part::Opening)));
    // The same upside down.
    let bump = |by: f32| dip(by).map(|(t, f)| (t, 1.0 - f));
    assert!(shutter(bump(0.75 * GRAZE), CLOSING).is_ok());
    let error = Err(CurveError::OpennessAboveOne(Part::Opening));
    assert_eq!(shutter(bump(1.5 * GRAZE), CLOSING), error);
    assert_eq!(shutter(bump(2.0 * GRAZE), CLOSING), error);
    // t' = 3/4 t2 at p = 1/2, nearly.
    let turn = |by: f32| [(0.0, 0.0), (1.0, 0.3), (-by * 4.0 / 3.0, 0.6), (1.0, 1.0)];
    let back = CurveError::TimeTurnsBack(Part::Opening);
    assert!(single(turn(0.75 * GRAZE)).is_ok());
    assert_eq!(single(turn(1.25 * GRAZE)), Err(back));
    assert_eq!(single(turn(2.0 * GRAZE)), Err(back));
}

#[test]
fn there_must_be_an_area() {
    let nothing = |t0, t1| CubicBezier::new([(t0, 0.0), (t0, 0.0), (t1, 0.0), (t1, 0.0)]);
    assert_eq!(ShutterCurve::new(nothing(0.0, 0.5), nothing(0.5, 1.0)), Err(CurveError::ZeroArea));
    let faint = [(0.0, 1e-45), (0.1, 1e-45), (0.2, 1e-45), (0.3, 1e-45)];
    assert_eq!(single(faint), Err(CurveError::AreaOutOfRange));
}

#[test]
fn the_interval_must_be_in_range() {
    let long = 2f32.powi(64);
    let expected = Err(CurveError::IntervalOutOfRange);
    assert!(ShutterCurve::linear(0.0, 0.0, long, long).is_ok());
    assert_eq!(ShutterCurve::linear(0.0, 0.0, long.next_up(), long.next_up()), expected);
    assert!(ShutterCurve::linear(0.0, 0.0, 1.0 / long, 1.0 / long).is_ok());
    let short = (1.0 / long).next_down();
    assert_eq!(ShutterCurve::linear(0.0, 0.0, short, short), expected);
    assert_eq!(ShutterCurve::linear(f32::MIN, 0.0, 1.0, f32::MAX), expected);
    // No length is another error than too little of it, for f32 may be at fault.
    let expected = Err(CurveError::IntervalUnresolved);
    assert_eq!(ShutterCurve::linear(1.0, 1.0, 1.0, 1.0), expected);
    let (now, later) = (1.7e9, (1.7e9 + 1e-3) as f32);
    assert_eq!(ShutterCurve::linear(now, now, later, later), expected);
}

#[test]
fn the_fraction_is_clamped() {
    let curve = ShutterCurve::linear(2.0, 2.25, 2.75, 3.0).unwrap();
    for u in [0.0, -0.0, -1e-45, -0.3, -1.0, -2.0, f32::MIN, f32::NEG_INFINITY, f32::NAN, -f32::NAN]
    {
        assert_eq!(curve.inverse_cdf(u), 2.0, "{u}");
    }
    for u in [1.0, 1.0f32.next_up(), 1.3, 2.0, f32::MAX, f32::INFINITY] {
        assert_eq!(curve.inverse_cdf(u), 3.0, "{u}");
    }
}

#[test]
fn a_time_outside_is_before_or_after() {
    let curve = ShutterCurve::linear(2.0, 2.25, 2.75, 3.0).unwrap();
    let jumps = single(CubicBezier::line((2.0, 0.25), (3.0, 0.75)).points()).unwrap();
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
}

#[test]
fn no_triggers() {
    let curve = ShutterCurve::linear(0.0, 0.25, 0.75, 1.0).unwrap();
    assert_eq!(curve.trigger_times(0).len(), 0);
    assert_eq!(curve.trigger_times(0).next(), None);
    assert_eq!(curve.trigger_times(0).next_back(), None);
    assert_eq!(curve.trigger_ticks(0, 1000).unwrap().next(), None);
    assert_eq!(curve.trigger_ticks(0, 1000).unwrap().nth(1), None);
}

#[test]
fn tick_rates() {
    let curve = ShutterCurve::linear(0.0, 0.25, 0.75, 1.0).unwrap();
    let error = |hz| curve.trigger_ticks(4, hz).err();
    assert_eq!(error(0), Some(ScheduleError::TickRateZero));
    assert_eq!(error(1), None);
    assert_eq!(error(1 << 31), None);
    let too_high = Some(ScheduleError::TickRateTooHigh { most: 1 << 31 });
    assert_eq!(error((1 << 31) + 1), too_high);
    assert_eq!(error(u32::MAX), too_high);
    // The rate that the error names is the greatest, on intervals of any length.
    for length in [0.51, 0.7, 1.0, 10.0, 12345.678, 2.0f32.powi(31)] {
        let curve = ShutterCurve::linear(0.0, 0.0, length, length).unwrap();
        let Err(ScheduleError::TickRateTooHigh { most }) = curve.trigger_ticks(1, u32::MAX) else {
            panic!("{length}: the interval has more than 2^31 ticks");
        };
        assert!(most > 0 && curve.trigger_ticks(1, most).is_ok(), "{length}: {most}");
        let error = curve.trigger_ticks(1, most + 1).err();
        assert_eq!(error, Some(ScheduleError::TickRateTooHigh { most }), "{length}");
    }
    let long = ShutterCurve::linear(0.0, 0.0, 1e10, 1e10).unwrap();
    assert_eq!(long.trigger_ticks(1, 1).err(), Some(ScheduleError::TickRateTooHigh { most: 0 }));
}

#[test]
fn slices_for_a_schedule() {
    let curve = ShutterCurve::linear(0.0, 0.25, 0.75, 1.0).unwrap();
    // n = 0: nothing to keep, but the rate is still one.
    assert_eq!(curve.schedule_into(&mut [], 1000, u32::MAX), Ok(()));
    assert_eq!(curve.schedule_into(&mut [], 0, 0), Err(ScheduleError::TickRateZero));
    let too_high = ScheduleError::TickRateTooHigh { most: 1 << 31 };
    assert_eq!(curve.schedule_into(&mut [0; 4], u32::MAX, 0), Err(too_high));
    // One trigger keeps any gap; two do not.
    assert_eq!(curve.schedule_into(&mut [0], 1000, u32::MAX), Ok(()));
    let gap = ScheduleError::GapTooSmall { trigger: 1, gap: 375, min_gap: u32::MAX };
    assert_eq!(curve.schedule_into(&mut [0; 2], 1000, u32::MAX), Err(gap));
    // More triggers than ticks.
    let Err(error) = curve.schedule_into(&mut [0; 5000], 1000, 1) else {
        panic!("5000 ticks of 1000")
    };
    assert!(matches!(error, ScheduleError::GapTooSmall { gap: 0, min_gap: 1, .. }), "{error}");
    assert_eq!(curve.schedule_into(&mut [0; 5000], 1000, 0), Ok(()));
}

/// The most triggers in a frame.
const MOST: u32 = 1 << 22;

#[test]
fn the_most_triggers_of_anything() {
    let curve = ShutterCurve::linear(0.0, 0.25, 0.75, 1.0).unwrap();
    assert_eq!(curve.most_triggers(0, 1000, 1), Ok(0));
    assert_eq!(curve.most_triggers(1, 1000, u32::MAX), Ok(1));
    // A gap of 0 asks for nothing.
    assert_eq!(curve.most_triggers(MOST, 1000, 0), Ok(MOST));
    assert_eq!(curve.most_triggers(MOST, 1000, u32::MAX), Ok(1));
    assert_eq!(curve.most_triggers(2, 1000, 376), Ok(1));
    assert_eq!(curve.most_triggers(2, 1000, 375), Ok(2));
    assert_eq!(curve.most_triggers(9, 0, 1), Err(ScheduleError::TickRateZero));
    let too_high = ScheduleError::TickRateTooHigh { most: 1 << 31 };
    assert_eq!(curve.most_triggers(9, u32::MAX, 1), Err(too_high));
    // As many as there are ticks, and none to spare.
    let most = curve.most_triggers(MOST, 1 << 31, 1 << 20).unwrap();
    assert!((1535..=1537).contains(&most), "{most}");
}

#[test]
fn any_trigger_of_the_most_that_there_can_be() {
    let curve = ShutterCurve::linear(0.0, 0.0, 1.0, 1.0).unwrap();
    let n = u32::MAX;
    assert_eq!(curve.trigger_times(n).len(), n as usize);
    assert_eq!(curve.trigger_times(n).nth(n as usize), None);
    assert_eq!(curve.trigger_times(n).nth(n as usize / 2), Some(0.5));
    assert_eq!(curve.trigger_times(n).next(), Some(0.5 / n as f32));
    // Within half a share, that is 2^-33, the last time is the end.
    assert_eq!(curve.trigger_times(n).last(), Some(1.0));
    assert_eq!(curve.trigger_ticks(MOST, 1000).unwrap().nth_back(0), Some(1000));
    assert_eq!(curve.trigger_ticks(MOST, 1000).unwrap().nth_back(MOST as usize), None);
}

/// Inner times that are fractions of each ramp, as an easing curve has them, and values that are none.
#[test]
fn shutteropening_is_told_from_times() {
    let curve = |times, inner| ShutterCurve::shutteropening(times, inner).map(|_| ());
    let (times, inner) = ([0.0, 0.25, 0.75, 1.0], [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0]);
    assert_eq!(curve(times, inner), Ok(()));
    let of_ramps = [0.4, 0.0, 0.6, 1.0, 0.4, 1.0, 0.6, 0.0];
    assert_eq!(curve(times, of_ramps), Err(CurveError::InnerTimesTurnBack(Part::Opening)));
    let of_closing = [0.1, 0.0, 0.15, 1.0, 0.4, 1.0, 0.6, 0.0];
    assert_eq!(curve(times, of_closing), Err(CurveError::InnerTimesTurnBack(Part::Closing)));
    // The ramp whose number it is.
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for i in 0..4 {
            let mut times = times;
            times[i] = bad;
            let ramp = if i < 2 { Part::Opening } else { Part::Closing };
            assert_eq!(curve(times, inner), Err(CurveError::NotFinite(ramp)), "times[{i}] = {bad}");
        }
        for i in 0..8 {
            let mut inner = inner;
            inner[i] = bad;
            let ramp = if i < 4 { Part::Opening } else { Part::Closing };
            assert_eq!(curve(times, inner), Err(CurveError::NotFinite(ramp)), "inner[{i}] = {bad}");
        }
    }
}

/// Each error's text, with its numbers.
#[test]
fn errors_say_which_and_why() {
    use CurveError as E;
    for (error, text) in [
        (
            E::NotFinite(Part::Opening),
            "opening ramp: a control point is NaN, infinite or beyond f32 (3.4e38)",
        ),
        (
            E::TimesOutOfOrder,
            "times out of order: open_start <= open_end <= close_start <= close_end is required",
        ),
        (
            E::IntervalUnresolved,
            "the interval has no length, or is too short for f32 so far from time 0: \
             it starts and ends at the same f32",
        ),
        (
            E::IntervalOutOfRange,
            "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19)",
        ),
        (
            E::TimeTurnsBack(Part::Closing),
            "closing ramp: time turns back along it; with control times in order it does not",
        ),
        (
            E::InnerTimesTurnBack(Part::Opening),
            "opening ramp: time turns back along it; \
             t1 and t2 are fractions of the whole interval, 0 at open_start and 1 at close_end",
        ),
        (
            E::InnerTimesTurnBack(Part::Closing),
            "closing ramp: time turns back along it; \
             t5 and t6 are fractions of the whole interval, 0 at open_start and 1 at close_end",
        ),
        (E::NegativeOpenness(Part::Opening), "opening ramp: the openness falls below 0"),
        (E::OpennessAboveOne(Part::Closing), "closing ramp: the openness rises above 1"),
        (E::ZeroArea, "the area under the curve is 0"),
        (E::AreaOutOfRange, "the area under the curve is below 2^-126 (1.2e-38)"),
    ] {
        assert_eq!(error.to_string(), text);
    }
    use ScheduleError as S;
    for (error, text) in [
        (S::TickRateZero, "the tick rate is 0"),
        (
            S::TickRateTooHigh { most: 9 },
            "the interval is longer than 2^31 ticks; a rate of up to 9 ticks in the curve's unit of time keeps to that",
        ),
        (
            S::TickRateTooHigh { most: 0 },
            "the interval is longer than 2^31 ticks, whatever the rate: its unit of time is too small",
        ),
        (
            S::CapacityExceeded { capacity: 16 },
            "more triggers than the 16 that the schedule can hold",
        ),
        (
            S::GapTooSmall { trigger: 3, gap: 562, min_gap: 1000 },
            "trigger 3 comes 562 ticks after the one before, and 1000 are required",
        ),
        (
            S::GapTooSmall { trigger: 1, gap: 1, min_gap: 2 },
            "trigger 1 comes 1 tick after the one before, and 2 are required",
        ),
    ] {
        assert_eq!(error.to_string(), text);
        let _: &dyn std::error::Error = &error;
    }
}
