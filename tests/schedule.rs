//! Triggers: evenly spread exposure, ticks, and the checked schedule.

use shutter_curve::{CubicBezier, ShutterCurve, valid};

const SOFT: ShutterCurve = valid(ShutterCurve::shutteropening(
    [0.0, 0.25, 0.75, 1.0],
    [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0],
));

#[test]
fn a_static_curve_is_the_one_built_at_run_time() {
    static CURVE: ShutterCurve = SOFT;
    let again = ShutterCurve::shutteropening(
        [0.0, 0.25, 0.75, 1.0],
        [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0],
    );
    assert_eq!(Ok(CURVE), again);
}

#[test]
fn fractions_are_of_the_interval() {
    let a = SOFT;
    let b = ShutterCurve::shutteropening(
        [8.0, 9.0, 11.0, 12.0],
        [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0],
    )
    .unwrap();
    for i in 0..=64 {
        let u = i as f32 / 64.0;
        assert!((8.0 + 4.0 * a.inverse_cdf(u) - b.inverse_cdf(u)).abs() < 2e-6);
    }
}

#[test]
fn times_are_the_inverse_at_the_middle_of_each_share() {
    for n in [1, 2, 3, 7, 64, 1000] {
        let times: Vec<f32> = SOFT.trigger_times(n).collect();
        assert_eq!(SOFT.trigger_times(n).len(), n as usize);
        for (i, t) in times.iter().enumerate() {
            assert_eq!(*t, SOFT.inverse_cdf((i as f32 + 0.5) / n as f32));
        }
        assert!(times.is_sorted());
    }
}

/// Ramps from 1/4 to 1 whose control points `f32` holds exactly: f = 1/4 + 2t up to 3/8, and mirrored.
fn pedestal() -> ShutterCurve {
    let opening = CubicBezier::line((0.0, 0.25), (0.375, 1.0));
    let closing = CubicBezier::line((0.625, 1.0), (1.0, 0.25));
    ShutterCurve::new(opening, closing).unwrap()
}

/// Its inverse in doubles, by the square root.
fn pedestal_inverse(u: f64) -> f64 {
    const RAMP: f64 = 0.234375;
    const AREA: f64 = 2.0 * RAMP + 0.25;
    let ramp = |mass: f64| 2.0 * mass / (0.25 + (0.0625 + 4.0 * mass).sqrt());
    let mass = u * AREA;
    if mass < RAMP {
        ramp(mass)
    } else if mass < RAMP + 0.25 {
        0.375 + mass - RAMP
    } else {
        1.0 - ramp(AREA - mass)
    }
}

/// The worst distance of the ticks from the exact times, in ticks.
fn worst(curve: &ShutterCurve, n: u32, hz: u32) -> f64 {
    let ticks = curve.trigger_ticks(n, hz).unwrap();
    let exact = (0..n).map(|i| pedestal_inverse((i as f64 + 0.5) / n as f64) * hz as f64);
    ticks.zip(exact).map(|(tick, exact)| (tick as f64 - exact).abs()).fold(0.0, f64::max)
}

#[test]
fn ticks_are_correct_to_the_tick() {
    let curve = pedestal();
    for (hz, most) in [
        (1_000, 0.501),
        (1_000_000, 0.51),
        ((1 << 24) - 1, 0.75),
        (1 << 24, 0.75),
        ((1 << 24) + 1, 0.501),
        (168_000_000, 0.501),
        (1 << 31, 0.51),
    ] {
        for n in [1, 2, 3, 17, 1000, 65_535] {
            let error = worst(&curve, n, hz);
            println!("{n} triggers at {hz} Hz: {error:.4} ticks");
            assert!(error <= most, "{n} triggers at {hz} Hz: {error} ticks");
        }
        let ticks: Vec<u32> = curve.trigger_ticks(65_535, hz).unwrap().collect();
        assert!(ticks.is_sorted());
    }
}

#[test]
fn ticks_count_from_the_start() {
    let curve = ShutterCurve::linear(1000.0, 1000.0, 1001.0, 1001.0).unwrap();
    let ticks: Vec<u32> = curve.trigger_ticks(4, 8).unwrap().collect();
    assert_eq!(ticks, [1, 3, 5, 7]);
    let before = ShutterCurve::linear(-1.0, -1.0, 0.0, 0.0).unwrap();
    assert!(before.trigger_ticks(4, 8).unwrap().eq([1, 3, 5, 7]));
}

#[test]
fn many_triggers() {
    let n = u32::MAX;
    let mut ticks = SOFT.trigger_ticks(n, 1 << 31).unwrap();
    assert_eq!(ticks.len(), n as usize);
    assert!(ticks.next().unwrap() < ticks.nth(1000).unwrap());
    assert!(SOFT.trigger_times(n).nth(1000).unwrap() < 0.01);
}

#[cfg(feature = "heapless-v0_9")]
mod checked {
    use super::SOFT;
    use shutter_curve::{ScheduleError, ShutterCurve};

    #[test]
    fn a_schedule_is_the_ticks() {
        let schedule = SOFT.schedule::<64>(64, 1_000_000, 100).unwrap();
        assert!(schedule.iter().copied().eq(SOFT.trigger_ticks(64, 1_000_000).unwrap()));
        assert!(schedule.windows(2).all(|pair| pair[1] - pair[0] >= 100));
        assert!(SOFT.schedule::<4>(0, 1000, 10).unwrap().is_empty());
    }

    #[test]
    fn each_reason_its_own_error() {
        let error = |n, hz, gap| SOFT.schedule::<16>(n, hz, gap).err();
        assert_eq!(error(17, 1000, 0), Some(ScheduleError::CapacityExceeded));
        assert_eq!(error(16, 1000, 0), None);
        assert_eq!(error(4, 0, 0), Some(ScheduleError::TickRateZero));
        assert_eq!(error(4, u32::MAX, 0), Some(ScheduleError::TickRateTooHigh));
    }

    #[test]
    fn the_most_that_keep_the_gap() {
        for curve in [SOFT, ShutterCurve::linear(0.0, 0.0, 1.0, 1.0).unwrap()] {
            for (hz, gap) in
                [(1000, 47), (1000, 50), (1_000_000, 33_333), (100, 7), (10, 9), (7, 100)]
            {
                let Err(ScheduleError::GapTooSmall { most }) = curve.schedule::<64>(64, hz, gap)
                else {
                    panic!("64 triggers keep {gap} at {hz} Hz");
                };
                assert!(curve.schedule::<64>(most, hz, gap).is_ok());
                assert!(most <= (curve.exposure() * hz as f32 / gap as f32) as u32 || most == 1);
                assert!(most + 1 >= (curve.exposure() * hz as f32 / gap as f32) as u32);
            }
        }
    }
}

/// Sixteen octaves a side are within what the compiler evaluates in a constant.
#[test]
fn a_large_curve_is_a_constant_too() {
    static LARGE: ShutterCurve<16> = valid(ShutterCurve::with_cells(
        CubicBezier::new([(0.0, 0.0), (0.18, 0.0), (0.32, 1.0), (0.5, 1.0)]),
        CubicBezier::new([(0.5, 1.0), (0.68, 1.0), (0.82, 0.0), (1.0, 0.0)]),
    ));
    assert_eq!(LARGE.inverse_cdf(0.5), 0.5);
}
