//! Triggers: evenly spread exposure, ticks, and the checked schedule.

mod support;

use shutter_curve::{CubicBezier, ScheduleError, ShutterCurve, valid};
use support::cases::shutter;
use support::curves::{Kind, named, random_hard, random_typical};
use support::oracle::{Curve, Dd, Exact, Points, exp2};
use support::promise::{MOST_TRIGGERS, TICK, TYPICAL_TICK, TYPICAL_TICKS, tick_error};

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
    assert_eq!(Ok(CURVE.clone()), again);
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

/// The same on a curve of any kind, from the exact time of a fraction within an ulp.
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
        for (hz, most) in [
            (1_000, 0.501),
            (1_000_000, 0.52),
            ((1 << 24) - 1, TYPICAL_TICK),
            (1 << 24, TYPICAL_TICK),
            // An ulp of a fraction is as many more ticks, divided by the openness there.
            (1 << 27, 4.0),
            (1 << 31, 60.0),
        ] {
            for n in [1, 2, 3, 17, 1000, 65_535] {
                let error = worst(&curve, n, hz);
                println!("{name}: {n} triggers at {hz} Hz: {error:.4} ticks");
                let most = if name == "a dip to 0.00003" { f64::INFINITY } else { most };
                assert!(error <= most, "{name}: {n} triggers at {hz} Hz: {error} ticks");
                let error = worst_but_for_u(&curve, n, hz);
                assert!(error <= TICK, "{name}: {n} triggers at {hz} Hz: {error} ticks");
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
    let mut ticks = SOFT.trigger_ticks(MOST_TRIGGERS, 1 << 31).unwrap();
    assert_eq!(ticks.len(), MOST_TRIGGERS as usize);
    assert!(ticks.next().unwrap() < ticks.nth(1000).unwrap());
    let refused = Some(ScheduleError::TooManyTriggers { most: MOST_TRIGGERS });
    for n in [MOST_TRIGGERS + 1, 1 << 31, u32::MAX] {
        assert_eq!(SOFT.trigger_ticks(n, 1 << 31).err(), refused);
        assert_eq!(SOFT.pulse_ticks(n, 0.5, 1 << 31).err(), refused);
        assert_eq!(SOFT.most_triggers(n, 1000, 0).err(), refused);
    }
    // Times are of any number.
    assert!(SOFT.trigger_times(u32::MAX).nth(1000).unwrap() < 0.01);
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
                for n in [1 << 20, MOST_TRIGGERS - 1, MOST_TRIGGERS] {
                    let ticks: Vec<u32> = ours.trigger_ticks(n, hz).unwrap().take(4000).collect();
                    assert!(ticks.is_sorted(), "{}: {n} triggers at {hz} Hz", one.name);
                    for (i, tick) in (0..).zip(ticks).step_by(97) {
                        let error = tick_error(&exact, tick, [i, n], hz);
                        assert!(error <= TICK, "{}: trigger {i} of {n} at {hz} Hz", one.name);
                    }
                }
            }
        }
    }
}

/// Every way through an iterator meets the same items.
fn judge_iterator<T, I>(all: &[T], frame: impl Fn() -> I)
where
    T: Copy + PartialEq + std::fmt::Debug,
    I: DoubleEndedIterator<Item = T> + ExactSizeIterator + Clone,
{
    let n = all.len();
    assert_eq!(frame().len(), n);
    assert_eq!(frame().size_hint(), (n, Some(n)));
    assert!(frame().rev().eq(all.iter().rev().copied()));
    assert_eq!((frame().last(), frame().count()), (all.last().copied(), n));
    for i in 0..n + 2 {
        let mut ahead = frame();
        assert_eq!(ahead.nth(i), all.get(i).copied());
        let ahead_of = all.get(i + 1..).unwrap_or(&[]);
        assert_eq!(ahead.len(), ahead_of.len());
        assert!(ahead.clone().eq(ahead_of.iter().copied()));
        let mut back = frame();
        let from_back = n.checked_sub(i + 1);
        assert_eq!(back.nth_back(i), from_back.map(|i| all[i]));
        assert!(back.eq(all[..from_back.unwrap_or(0)].iter().copied()));
    }
    // From both ends in turn, to where they meet, and no farther.
    let (mut both, mut met) = (frame(), (Vec::new(), Vec::new()));
    while both.len() > 0 {
        met.0.extend(both.next());
        met.1.extend(both.next_back());
    }
    met.0.extend(met.1.into_iter().rev());
    assert_eq!(met.0, all);
    assert_eq!((both.next(), both.next_back(), both.nth(3), both.len()), (None, None, None, 0));
}

#[test]
fn iterators_from_either_end_and_anywhere() {
    let bytes = |iterator: &dyn std::fmt::Debug| format!("{iterator:?}");
    assert_eq!(bytes(&SOFT.trigger_times(3)), "TriggerTimes { left: 0..3, .. }");
    let mut ticks = SOFT.trigger_ticks(3, 1000).unwrap();
    ticks.next();
    assert_eq!(bytes(&ticks), "TriggerTicks { left: 1..3, .. }");
    for n in [0, 1, 2, 7, 64, 300] {
        let times: Vec<f32> =
            (0..n).map(|i| SOFT.inverse_cdf((i as f32 + 0.5) / n as f32)).collect();
        judge_iterator(&times, || SOFT.trigger_times(n));
        // Direct, and direct with some searched for.
        for hz in [1_000_000, 1 << 24] {
            let ticks: Vec<u32> = SOFT.trigger_ticks(n, hz).unwrap().collect();
            judge_iterator(&ticks, || SOFT.trigger_ticks(n, hz).unwrap());
        }
    }
}

/// An interrupt handler's: of a curve in a static, and named.
#[test]
fn a_static_can_hold_an_iterator() {
    use shutter_curve::{TriggerTicks, TriggerTimes};
    static CURVE: ShutterCurve = SOFT;
    static FRAME: std::sync::Mutex<Option<TriggerTicks<'static>>> = std::sync::Mutex::new(None);
    let times: TriggerTimes<'static> = CURVE.trigger_times(2);
    assert_eq!(times.len(), 2);
    *FRAME.lock().unwrap() = CURVE.trigger_ticks(3, 1000).ok();
    let next = || FRAME.lock().unwrap().as_mut().and_then(Iterator::next);
    let ticks: Vec<u32> = std::iter::from_fn(next).collect();
    assert!(ticks.iter().copied().eq(CURVE.trigger_ticks(3, 1000).unwrap()));
    assert_eq!(ticks[1], 500);
}

/// Neighbours at both ends and anywhere between, in frames of any size.
#[test]
fn frames_of_any_size_are_in_order() {
    for hz in [1_000_000, 1 << 24, 1 << 31] {
        for n in [1000, 1 << 20, MOST_TRIGGERS - 1, MOST_TRIGGERS] {
            let at = |i: u32| SOFT.trigger_ticks(n, hz).unwrap().nth(i as usize).unwrap();
            let time = |i: u32| SOFT.trigger_times(n).nth(i as usize).unwrap();
            for k in 0..200u64 {
                let i = (k * (u64::from(n) - 2) / 199) as u32;
                assert!(at(i) <= at(i + 1), "{i} of {n} at {hz} Hz");
                assert!(time(i) <= time(i + 1), "{i} of {n}");
                let mirrored = SOFT.trigger_ticks(n, hz).unwrap().nth_back((n - 1 - i) as usize);
                assert_eq!(mirrored, Some(at(i)));
            }
        }
    }
}

/// Every trigger of every frame of up to so many, and the first `u` beyond.
fn judge_direct<const OCTAVES: usize>(
    curve: &ShutterCurve<OCTAVES>,
    name: &dyn std::fmt::Debug,
) -> u32 {
    let most = curve.direct_triggers();
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    for ticks in [0.3, 1000.0, (1 << 24) as f64] {
        let hz = ticks * (1.0 - 1e-9) / length;
        if !(hz >= 1.0 && hz <= f64::from(u32::MAX)) {
            continue;
        }
        // Every frame of few, and each power of two of many.
        let frames = (1..=most.min(if ticks > 1e7 { 300 } else { 30 }))
            .chain((8..22).map(|k| most >> k))
            .chain([most]);
        for n in frames.filter(|n| *n > 0) {
            let frame = curve.trigger_ticks(n, hz as u32).unwrap();
            for i in (0..n).step_by(n as usize / 1000 + 1).chain([n - 1]) {
                assert!(frame.is_direct(i), "{i} of {n}, {most} on {name:?}");
                let u = (i as f32 + 0.5) / n as f32;
                assert!(curve.is_direct(u) && curve.evaluations(u) == 0, "{u}, {most} on {name:?}");
            }
        }
    }
    most
}

#[test]
fn direct_frames_need_no_search() {
    for one in named() {
        let most = judge_direct(&shutter::<8>(&one.curve), &one.name);
        let others = [
            judge_direct(&shutter::<0>(&one.curve), &one.name),
            judge_direct(&shutter::<4>(&one.curve), &one.name),
            judge_direct(&shutter::<16>(&one.curve), &one.name),
        ];
        println!("{}: {most}; with 0, 4 and 16 octaves {others:?}", one.name);
        assert!(one.kind == Kind::Hard || most >= 255, "{}: {most}", one.name);
    }
}

/// No frame of one more is direct, unless the plateau's line is the limit, or what is left out for rounding.
#[test]
fn direct_frames_are_not_understated() {
    for one in named().into_iter().filter(|one| one.kind == Kind::Typical) {
        let curve = shutter::<8>(&one.curve);
        let most = curve.direct_triggers();
        let frame = curve.trigger_ticks(most + 2 + most / 512, 1).unwrap();
        let n = frame.len() as u32;
        assert!(
            !frame.is_direct(0) || !frame.is_direct(n - 1),
            "{} has more than {most}",
            one.name
        );
    }
}

#[test]
fn direct_frames_of_random_curves() {
    let mut least = u32::MAX;
    for i in 0..2000 {
        let curve = random_typical(2024, i);
        let most = judge_direct(&shutter::<8>(&curve), &curve);
        assert!(most >= 64, "{most}: {curve:?}");
        least = least.min(most);
    }
    println!("typical: at least {least}");
    let none = (0..1000).filter(|i| {
        let curve = random_hard(2024, *i);
        judge_direct(&shutter::<8>(&curve), &curve) == 0
    });
    let none = none.count();
    println!("hard: {none} of 1000 have none");
    assert!(none < 200, "{none}");
}

/// A schedule has the ticks of its triggers, and says which is the first that comes too soon.
fn judge_filled<const OCTAVES: usize>(curve: &Curve, n: u32, hz: u32) {
    let shutter = shutter::<OCTAVES>(curve);
    let mut filled = vec![0; n as usize];
    let ticks: Vec<u32> = match shutter.trigger_ticks(n, hz) {
        Ok(ticks) => ticks.collect(),
        Err(error) => return assert_eq!(shutter.schedule_into(&mut filled, hz, 0), Err(error)),
    };
    shutter.schedule_into(&mut filled, hz, 0).unwrap();
    assert_eq!(filled, ticks, "{n} triggers at {hz} Hz, OCTAVES = {OCTAVES}: {curve:?}");
    let gaps = ticks.windows(2).map(|pair| pair[1] - pair[0]);
    let mut sorted: Vec<u32> = gaps.clone().collect();
    sorted.sort_unstable();
    for min_gap in [sorted.first(), sorted.get(n as usize / 2), sorted.last()].into_iter().flatten()
    {
        let min_gap = min_gap + 1;
        let soon = gaps.clone().position(|gap| gap < min_gap).unwrap();
        let (trigger, gap) = (soon as u32 + 1, ticks[soon + 1] - ticks[soon]);
        let error = ScheduleError::GapTooSmall { trigger, gap, min_gap };
        assert_eq!(shutter.schedule_into(&mut filled, hz, min_gap), Err(error), "{n}: {curve:?}");
    }
}

#[test]
fn a_filled_schedule_is_each_trigger_alone() {
    let random = (0..60).flat_map(|i| [random_typical(7, i), random_hard(7, i)]);
    for curve in named().into_iter().map(|named| named.curve).chain(random) {
        let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
        for n in [1, 2, 3, 5, 16, 63, 64, 100, 1000, 4097] {
            for most in [f64::from(n), 1e5, 1e7, 1e8] {
                let hz = (most / length).clamp(1.0, 4e9) as u32;
                if most < 2e7 || n < 20 {
                    judge_filled::<8>(&curve, n, hz);
                    judge_filled::<64>(&curve, n, hz);
                }
            }
        }
        judge_filled::<0>(&curve, 7, (1e6 / length).clamp(1.0, 4e9) as u32);
    }
    judge_filled::<8>(&random_typical(7, 0), 1 << 22, 1 << 22);
}

#[cfg(feature = "heapless-v0_9")]
mod checked {
    use super::{SOFT, ScheduleError};

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
        let capacity = Some(ScheduleError::CapacityExceeded { capacity: 16 });
        assert_eq!(error(17, 1000, 0), capacity);
        assert_eq!(error(u32::MAX, 1000, 0), capacity);
        assert_eq!(error(16, 1000, 0), None);
        assert_eq!(error(4, 0, 0), Some(ScheduleError::TickRateZero));
        let too_high = Some(ScheduleError::TickRateTooHigh { most: 1 << 31 });
        assert_eq!(error(4, u32::MAX, 0), too_high);
        let gap = Some(ScheduleError::GapTooSmall { trigger: 1, gap: 94, min_gap: 114 });
        assert_eq!(error(4, 500, 114), gap);
    }
}

/// A shutter that never opens more than half.
fn half_open() -> ShutterCurve {
    let [opening, closing] = [0.0, 1.0].map(|t| CubicBezier::line((t, 0.5), (t + 1.0, 0.5)));
    ShutterCurve::new(opening, closing).unwrap()
}

#[test]
fn the_most_that_keep_the_gap() {
    let keeps = |curve: &ShutterCurve, n: u32, hz, gap| {
        curve.schedule_into(&mut vec![0; n as usize], hz, gap).is_ok()
    };
    for curve in [SOFT, ShutterCurve::linear(0.0, 0.0, 1.0, 1.0).unwrap(), half_open()] {
        for (hz, gap) in [
            (1000, 47),
            (1000, 50),
            (1_000_000, 33_333),
            (1_000_000, 1_000),
            (100, 7),
            (10, 9),
            (7, 100),
            (50, 1),
        ] {
            for wanted in [2, 3, 64, 1000, 10_000] {
                let found = curve.most_triggers(wanted, hz, gap).unwrap();
                if keeps(&curve, wanted, hz, gap) {
                    assert_eq!(found, wanted, "{hz} Hz, {gap} ticks");
                    continue;
                }
                assert!(found >= 1 && found < wanted, "{found} of {wanted}");
                assert!(
                    keeps(&curve, found, hz, gap),
                    "{found} of {wanted} at {hz} Hz, {gap} ticks"
                );
                assert!(
                    !keeps(&curve, found + 1, hz, gap),
                    "{found} and one more, {hz} Hz, {gap} ticks"
                );
                let sure = curve.exposure() * hz as f32 / (gap as f32 + 1.5);
                assert!(found >= sure as u32, "{found}, and {sure} are sure");
            }
        }
    }
}

#[test]
fn the_most_on_a_shutter_that_never_fully_opens() {
    for n in 21..=64 {
        assert_eq!(half_open().most_triggers(n, 500, 50), Ok(20), "{n}");
    }
}

/// Sixteen octaves a side are within what the compiler evaluates in a constant.
#[test]
fn a_large_curve_is_a_constant_too() {
    static LARGE: ShutterCurve<16> = valid(ShutterCurve::with_octaves(
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
        for hz in [few, rate as u32] {
            let error = worst_but_for_u(&curve, 301, hz);
            assert!(error <= TICK, "{error} ticks at {hz} Hz: {curve:?}");
        }
        checked += 1;
    }
    assert!(checked > 300, "{checked}");
}

/// A bright box, and then a dark one with next to no light: where each trace of a fraction is many ticks.
fn dark_after_bright(openness: f32) -> Curve {
    let opening = CubicBezier::line((0.0, 1.0), (1.0, 1.0));
    let closing = CubicBezier::line((1.0, openness), (257.0, openness));
    Curve::shutter(opening.points(), closing.points())
}

fn rate(curve: &Curve) -> u32 {
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    (TYPICAL_TICKS * (1.0 - 1e-9) / length) as u32
}

/// Counted from the end, a fraction has all the bits of its rest.
#[test]
fn last_triggers_of_large_frames() {
    fn worst<const OCTAVES: usize>(openness: f32) -> (f64, [u32; 2]) {
        let curve = dark_after_bright(openness);
        let (exact, ours, hz) = (Exact::new(&curve), shutter::<OCTAVES>(&curve), rate(&curve));
        let last = |n: u32| [1, 2, 3, 10, 30, 100].map(|k| [n - k, n]);
        let triggers = (4_194_204..=MOST_TRIGGERS).flat_map(last).map(|[i, n]| {
            let tick = ours.trigger_ticks(n, hz).unwrap().nth(i as usize).unwrap();
            (tick_error(&exact, tick, [i, n], hz), [i, n])
        });
        triggers.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    }
    for openness in (18..=30).map(|k| exp2(-k) as f32) {
        for (error, trigger) in
            [worst::<16>(openness), worst::<20>(openness), worst::<64>(openness)]
        {
            assert!(error <= TICK, "{error:.3} ticks: {trigger:?}, openness {openness:e}");
        }
    }
}

/// A liquid-crystal shutter that closes in two bends: with 49 points alone an octave of it has no certificate, and 2
/// triggers are direct.
#[test]
fn a_closing_ramp_with_two_bends_has_direct_triggers() {
    let inner = [0.01, 0.6, 0.015, 1.0, 0.46, 0.1, 0.6, 0.0];
    let curve = ShutterCurve::shutteropening([0.0, 0.0003, 0.003, 0.008], inner).unwrap();
    assert!(curve.direct_triggers() >= 255, "{}", curve.direct_triggers());
}

/// On a plateau that ends next to the curve's end, ticks from there count the line by the rest to 1, whose ulp is down to
/// 2⁻³².
#[test]
fn the_line_counted_from_either_end() {
    for [open, close] in [[0.001, 0.9995], [0.3, 0.999], [0.0, 1.0], [0.002, 0.6]] {
        let lines = [
            CubicBezier::line((0.0, 0.0), (open, 1.0)),
            CubicBezier::line((close, 1.0), (1.0, 0.0)),
        ];
        let curve = Curve::shutter(lines[0].points(), lines[1].points());
        for curve in [curve, curve.mirrored()] {
            let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
            for n in (65..600).step_by(7) {
                let ticks = ours.trigger_ticks(n, (1 << 31) - 1).unwrap();
                for (i, tick) in (0..n).zip(ticks) {
                    let error = tick_error(&exact, tick, [i, n], (1 << 31) - 1);
                    assert!(error <= TICK, "{i} of {n}: {error} ticks, {curve:?}");
                }
            }
        }
    }
}

/// The worst direct tick is one number: the README's, the measured table's, and the one that the firmware example leaves
/// time for.
#[test]
fn one_figure_for_the_worst_direct_tick() {
    let number = |text: &str, before: &str, after: &str| -> u32 {
        let (_, rest) = text.split_once(before).unwrap_or_else(|| panic!("no {before:?}"));
        let (number, _) = rest.split_once(after).unwrap();
        number.trim().parse().unwrap_or_else(|_| panic!("{number:?} after {before:?}"))
    };
    let readme = number(include_str!("../README.md"), "a tick costs at most ", " cycles");
    let example = include_str!("../examples/trigger/firmware.rs");
    assert_eq!(number(example, "const DIRECT_TICK: u32 = ", ";"), readme);
    // | a tick | soft | all ramp | trapezoid | box | typical | worst | direct | ...
    let (_, row) = include_str!("../docs/internals/cost.md").split_once("\n| a tick |").unwrap();
    assert_eq!(row.split('|').nth(6).unwrap().trim().parse(), Ok(readme));
}

/// Fractions that lie midway between two `f32`, on a curve whose ramps are steep there: half an ulp of the fraction is a
/// quarter of a tick, and the polynomial has its own error.
#[test]
fn the_worst_tick_of_a_typical_curve() {
    let opening = [(0.0, 0.0), (0.5498377, 0.38116276), (1.9749786, 0.9056642), (3.1201088, 1.0)];
    let closing = [(4.160642, 1.0), (6.806004, 0.6767999), (16.227335, 0.49375978), (20.833, 0.0)];
    let curve = Curve::shutter(opening, closing);
    let (exact, start) = (Exact::new(&curve), Dd::from(curve.open_start()));
    let (n, i, hz) = (10_912, 8182, 805_319);
    let tick = shutter::<8>(&curve).trigger_ticks(n, hz).unwrap().nth(i).unwrap();
    let u = Dd::from(2.0 * i as f64 + 1.0) / Dd::from(2.0 * f64::from(n));
    let error = ((exact.inverse_cdf_dd(u) - start) * f64::from(hz) - Dd::from(f64::from(tick))).hi;
    assert!((0.75..=TYPICAL_TICK).contains(&error.abs()), "{error}");
}
