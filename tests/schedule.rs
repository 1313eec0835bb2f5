//! Triggers: evenly spread exposure, ticks, and the checked schedule.

mod support;

use shutter_curve::{CubicBezier, ShutterCurve, valid};
use support::cases::shutter;
use support::curves::{Kind, named, random_hard};
use support::oracle::{Curve, Dd, Exact, Points};
use support::promise::{DIRECT_TICKS, TICKS, tick_error};

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

/// The worst distance of the ticks from the exact times, in ticks.
fn worst(curve: &Curve, n: u32, hz: u32) -> f64 {
    let (exact, start) = (Exact::new(curve), Dd::from(curve.open_start()));
    let ticks: Vec<u32> = shutter::<8>(curve).trigger_ticks(n, hz).unwrap().collect();
    assert!(ticks.is_sorted());
    let share = Dd::ONE / Dd::from(2.0 * n as f64);
    let error = |(i, tick): (usize, &u32)| {
        let time = exact.inverse_cdf_dd(share * (2 * i + 1) as f64);
        ((time - start) * hz as f64 - Dd::from(*tick as f64)).hi.abs()
    };
    ticks.iter().enumerate().map(error).fold(0.0, f64::max)
}

/// The same on a curve of any kind, where a u-error of 2⁻³⁸ is forgiven.
fn worst_but_for_u(curve: &Curve, n: u32, hz: u32) -> f64 {
    let exact = Exact::new(curve);
    let ticks: Vec<u32> = shutter::<8>(curve).trigger_ticks(n, hz).unwrap().collect();
    assert!(ticks.is_sorted());
    let error = |(i, tick)| tick_error(&exact, tick, [i, n], hz);
    (0..).zip(ticks).map(error).fold(0.0, f64::max)
}

/// Every interval is 1 long, so the rate is its length in ticks.
#[test]
fn ticks_are_correct_to_the_tick() {
    let (low, high) = (CubicBezier::line((0.0, 0.25), (0.375, 1.0)), (0.625, 1.0));
    let pedestal = Curve::shutter(low.points(), CubicBezier::line(high, (1.0, 0.25)).points());
    let order4 = [(0.0, 0.0), (0.125, 0.0), (0.25, 0.0), (0.375, 1.0)];
    let mirrored = [(0.625, 1.0), (0.75, 0.0), (0.875, 0.0), (1.0, 0.0)];
    let soft = [(0.0, 0.0), (0.125, 0.0), (0.25, 1.0), (0.5, 1.0)];
    let across = [(0.0, 1.0), (0.125, 1.0), (0.375, 0.0), (0.5, 0.0)];
    let dip = [(0.0, 1.0), (0.125, -0.3333), (0.25, -0.3333), (0.375, 1.0)];
    let moved = |points: Points, by: f32| points.map(|(t, f)| (t + by, f));
    for (name, curve) in [
        ("pedestal", pedestal),
        ("ends of order p^4", Curve::shutter(order4, mirrored)),
        ("a dip to 0.00003", Curve::shutter(dip, moved(dip, 0.625))),
        ("across time 0", Curve::shutter(moved(soft, -0.625), moved(across, -0.125))),
        ("far from time 0", Curve::shutter(moved(soft, 1024.0), moved(across, 1024.5))),
        ("far before time 0", Curve::shutter(moved(soft, -1024.0), moved(across, -1023.5))),
    ] {
        // An error of the direct way's shows that it is the one taken.
        for (hz, least, most) in [
            (1_000, 0.0, 0.501),
            (1_000_000, 0.0, 0.51),
            ((1 << 24) - 1, 0.501, 0.75),
            (1 << 24, 0.501, 0.75),
            ((1 << 24) + 1, 0.0, 0.501),
            (168_000_000, 0.0, 0.501),
            (1 << 31, 0.0, 0.501),
        ] {
            for n in [1, 2, 3, 17, 1000, 65_535] {
                let error = worst(&curve, n, hz);
                println!("{name}: {n} triggers at {hz} Hz: {error:.4} ticks");
                assert!(error <= most, "{name}: {n} triggers at {hz} Hz: {error} ticks");
                assert!(n < 65_535 || error >= least, "{name} at {hz} Hz: only {error} ticks");
            }
        }
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

/// Triggers so dense that many share a tick, from either end of the curve.
#[test]
fn dense_ticks_never_step_back() {
    for one in named().iter().filter(|one| one.kind == Kind::Typical) {
        for curve in [one.curve, one.curve.mirrored()] {
            let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
            let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
            for ticks in [(1 << 24) as f64, (1u32 << 31) as f64] {
                let hz = ((0.999 * ticks / length) as u32).max(1);
                for n in [1 << 20, 1 << 28, 1 << 30, u32::MAX] {
                    let ticks: Vec<u32> = ours.trigger_ticks(n, hz).unwrap().take(4000).collect();
                    assert!(ticks.is_sorted(), "{}: {n} triggers at {hz} Hz", one.name);
                    for (i, tick) in (0..).zip(ticks).step_by(97) {
                        let error = tick_error(&exact, tick, [i, n], hz);
                        let most = TICKS[usize::from(length * f64::from(hz) > DIRECT_TICKS)];
                        assert!(error <= most, "{}: trigger {i} of {n} at {hz} Hz", one.name);
                    }
                }
            }
        }
    }
}

#[cfg(feature = "heapless-v0_9")]
mod checked {
    use super::SOFT;
    use shutter_curve::{CubicBezier, ScheduleError, ShutterCurve};

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

    /// A shutter that never opens more than half.
    fn half_open() -> ShutterCurve {
        let [opening, closing] = [0.0, 1.0].map(|t| CubicBezier::line((t, 0.5), (t + 1.0, 0.5)));
        ShutterCurve::new(opening, closing).unwrap()
    }

    #[test]
    fn the_most_that_keep_the_gap() {
        for curve in [SOFT, ShutterCurve::linear(0.0, 0.0, 1.0, 1.0).unwrap(), half_open()] {
            for (hz, gap) in
                [(1000, 47), (1000, 50), (1_000_000, 33_333), (100, 7), (10, 9), (7, 100)]
            {
                let most = |n| match curve.schedule::<64>(n, hz, gap) {
                    Err(ScheduleError::GapTooSmall { most }) => Some(most),
                    _ => None,
                };
                let found = most(64).expect("64 are too many");
                assert!((1..64).contains(&found) && most(found).is_none());
                assert!(most(found + 1).is_some_and(|most| most <= found));
                assert!(found + 1 >= (curve.exposure() * hz as f32 / gap as f32) as u32);
            }
        }
    }

    #[test]
    fn the_most_on_a_shutter_that_never_fully_opens() {
        for n in 21..=64 {
            let most = Err(ScheduleError::GapTooSmall { most: 20 });
            assert_eq!(half_open().schedule::<64>(n, 500, 50), most, "{n}");
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

/// Any curve, at 2²⁴ ticks and at the most that there may be.
#[test]
fn ticks_of_random_hard_curves() {
    let mut checked = 0;
    for i in 0..1000 {
        let curve = random_hard(77, i);
        let rate = (1u64 << 31) as f64 / (curve.close_end() as f64 - curve.open_start() as f64);
        // Rounding the rate down leaves the last tick out.
        if !(rate > 4096.0 && rate < u32::MAX as f64) {
            continue;
        }
        let few = (rate / 128.0) as u32;
        for (hz, most) in [(few, TICKS[0]), (rate as u32, TICKS[1])] {
            let error = worst_but_for_u(&curve, 301, hz);
            assert!(error <= most, "{error} ticks at {hz} Hz: {curve:?}");
        }
        checked += 1;
    }
    assert!(checked > 300, "{checked}");
}
