//! Triggers and pulses: ticks, schedules, iterators, frames without a search. `promises.rs` judges the ticks
//! themselves.

use crate::support::curves::{line, named, shutter};
use crate::support::families::{random_hard, random_typical};
use crate::support::oracle::Curve;
use crate::support::promise::MOST_TRIGGERS;
use shutter_curve::{CubicBezier, Hz, Pulse, ScheduleError, ShutterCurve, TimedCurve, expect};

const INNER: [f32; 8] = [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0];
const SOFT: ShutterCurve = expect!(ShutterCurve::shutteropening([0.0, 0.25, 0.75, 1.0], INNER));

/// A curve on a timer whose triggers may share a tick, and whose pulses may be empty and touch.
fn at<const OCTAVES: usize>(curve: &ShutterCurve<OCTAVES>, hz: u32) -> TimedCurve<'_, OCTAVES> {
    curve.at(Hz(hz)).unwrap().min_gap(0).min_pulse(0)
}

/// A curve and its ticks are the same at compile time: also those of a density dark at both ends, whose inner times
/// cross, where a search meets a slope of 0 and a NaN, whose sign differs by machine.
#[test]
fn a_constant_is_what_run_time_makes() {
    static CURVE: ShutterCurve = SOFT;
    assert_eq!(Ok(CURVE.clone()), ShutterCurve::shutteropening([0.0, 0.25, 0.75, 1.0], INNER));
    static DARK: ShutterCurve =
        expect!(ShutterCurve::density(CubicBezier::new([(0.0, 0.0), (1.0, 1.0), (0.0, 0.0), (1.0799999, 0.0)])));
    const TICKS: Result<[u32; 16], ScheduleError> = expect!(DARK.at(Hz(1_000_000_000))).ticks();
    assert_eq!(std::hint::black_box(&DARK).at(Hz(1_000_000_000)).unwrap().ticks(), TICKS);
    // Sixteen octaves a side are within what the compiler evaluates.
    static LARGE: ShutterCurve<16> = expect!(ShutterCurve::with_octaves(
        CubicBezier::new([(0.0, 0.0), (0.18, 0.0), (0.32, 1.0), (0.5, 1.0)]),
        CubicBezier::new([(0.5, 1.0), (0.68, 1.0), (0.82, 0.0), (1.0, 0.0)]),
    ));
    assert_eq!(LARGE.inverse_cdf(0.5), 0.5);
}

/// Every way to a frame refuses the same, in the same words.
#[test]
fn frames_that_are_refused() {
    use ScheduleError as S;
    let rate = |hz| SOFT.at(Hz(hz)).err();
    assert_eq!((rate(0), rate(1), rate(1 << 31)), (Some(S::RateZero), None, None));
    let too_high = Some(S::RateTooHigh { max: Hz(1 << 31) });
    assert_eq!((rate((1 << 31) + 1), rate(u32::MAX)), (too_high, too_high));

    let (timed, many) = (at(&SOFT, 1000), Some(S::TooMany { max: MOST_TRIGGERS }));
    for (n, expected) in
        [(0, None), (MOST_TRIGGERS, None), (MOST_TRIGGERS + 1, many), (1 << 31, many), (u32::MAX, many)]
    {
        assert_eq!(timed.trigger_ticks(n).err(), expected, "{n}");
        assert_eq!(timed.pulse_ticks(n, 0.5).err(), expected, "{n}");
        assert_eq!(timed.max_triggers(n), n.min(MOST_TRIGGERS));
        // No slices of gigabytes.
        if n <= MOST_TRIGGERS + 1 {
            assert_eq!(timed.ticks_into(&mut vec![0; n as usize]).err(), expected, "{n}");
            assert_eq!(timed.pulses_into(&mut vec![Pulse::default(); n as usize], 0.5).err(), expected, "{n}");
        }
    }
    for duty in [0.0, -0.0, -0.5, f32::NAN, 1.0 + f32::EPSILON, f32::INFINITY] {
        assert_eq!(timed.pulse_ticks(3, duty).err(), Some(S::DutyOutOfRange));
        assert_eq!(timed.pulses::<3>(duty), Err(S::DutyOutOfRange));
    }
    let timed = SOFT.at(Hz(1_000_000)).unwrap();
    let checked = |duty, min_pulse, min_gap| {
        let timed = timed.min_pulse(min_pulse).min_gap(min_gap);
        let error = timed.pulses::<12>(duty).err();
        assert_eq!(timed.pulse_ticks(12, duty).err(), error);
        error
    };
    let (pulse, length, min_pulse) = (2, 31_250, 32_000);
    assert_eq!(checked(0.5, 30_000, 30_000), None);
    assert_eq!(checked(0.5, length, 0), None);
    assert_eq!(checked(0.5, min_pulse, 0), Some(S::PulseTooShort { pulse, length, min_pulse }));
    let apart = timed.pulses::<12>(0.5).unwrap();
    let gap = apart.windows(2).map(|pair| pair[1].on - pair[0].off).min().unwrap();
    assert_eq!(checked(0.5, 0, gap), None);
    assert!(matches!(checked(0.5, 0, gap + 1), Some(S::PulsesTooClose { gap: least, .. }) if least == gap));
    let touch = Some(S::PulsesTooClose { pulse: 1, gap: 0, min_gap: 1 });
    assert_eq!((checked(1.0, 0, 0), checked(1.0, 0, 1)), (None, touch));
}

#[test]
fn the_greatest_tick_rate_is_named() {
    for length in [0.51, 0.7, 1.0, 10.0, 12345.678, 2.0f32.powi(31)] {
        let curve = ShutterCurve::linear(0.0, 0.0, length, length).unwrap();
        let Err(ScheduleError::RateTooHigh { max }) = curve.at(Hz(u32::MAX)) else {
            panic!("{length}: the interval has more than 2^31 ticks");
        };
        assert!(max > Hz(0) && curve.at(max).is_ok(), "{length}: {max:?}");
        assert!(curve.at(max).unwrap().length() <= 1 << 31);
        assert_eq!(curve.at(Hz(max.0 + 1)).err(), Some(ScheduleError::RateTooHigh { max }), "{length}");
    }
    let long = ShutterCurve::linear(0.0, 0.0, 1e10, 1e10).unwrap();
    assert_eq!(long.at(Hz(1)).err(), Some(ScheduleError::RateTooHigh { max: Hz(0) }));
}

#[test]
fn the_max_triggers_of_anything() {
    let curve = ShutterCurve::linear(0.0, 0.25, 0.75, 1.0).unwrap();
    let most = |n, gap| at(&curve, 1000).min_gap(gap).max_triggers(n);
    assert_eq!((most(0, 1), most(1, u32::MAX), most(MOST_TRIGGERS, u32::MAX)), (0, 1, 1));
    // A gap of 0 asks for nothing.
    assert_eq!((most(MOST_TRIGGERS, 0), most(u32::MAX, 0)), (MOST_TRIGGERS, MOST_TRIGGERS));
    assert_eq!((most(2, 376), most(2, 375)), (1, 2));
    // As many as there are ticks, and none to spare.
    let most = at(&curve, 1 << 31).min_gap(1 << 20).max_triggers(MOST_TRIGGERS);
    assert!((1535..=1537).contains(&most), "{most}");
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
}

#[test]
fn iterators_from_either_end_and_anywhere() {
    let mut ticks = at(&SOFT, 1000).trigger_ticks(3).unwrap();
    ticks.next();
    assert_eq!(format!("{ticks:?}"), "TriggerTicks { left: 1..3, .. }");
    for n in [0, 1, 2, 7, 64, 300] {
        // Direct, and direct with some searched for.
        for hz in [1_000_000, 1 << 24] {
            let ticks: Vec<u32> = at(&SOFT, hz).trigger_ticks(n).unwrap().collect();
            judge_iterator(&ticks, || at(&SOFT, hz).trigger_ticks(n).unwrap());
        }
        let pulses: Vec<Pulse> = at(&SOFT, 1_000_000).pulse_ticks(n, 0.4).unwrap().collect();
        judge_iterator(&pulses, || at(&SOFT, 1_000_000).pulse_ticks(n, 0.4).unwrap());
    }
}

/// How many triggers need no search; that none of them does, `promises.rs` holds.
#[test]
fn direct_frames_are_large() {
    for one in named("typical") {
        let curve = shutter::<8>(&one.curve);
        let most = curve.direct_triggers();
        println!("{}: {most}", one.name);
        assert!(most >= 127, "{}: {most}", one.name);
        // No frame of one more is direct, unless the plateau's line is the limit, or what is left out for rounding.
        let frame = at(&curve, 1).trigger_ticks(most + 2 + most / 512).unwrap();
        let last = frame.len() as u32 - 1;
        assert!(!frame.is_direct(0) || !frame.is_direct(last), "{} has more", one.name);
    }
    // No top is below 2⁻²²: an octave from 2⁻²³ on would answer beside searches on a grid coarser than its ulp.
    assert_eq!(shutter::<64>(&named("typical")[1].curve).direct_triggers(), 2_236_962);
    let least = (0..2000).map(|i| shutter::<8>(&random_typical(2024, i)).direct_triggers()).min();
    println!("random typical: at least {least:?}");
    assert!(least >= Some(64), "{least:?}");
    let none = (0..1000).filter(|i| shutter::<8>(&random_hard(2024, *i)).direct_triggers() == 0);
    let none = none.count();
    println!("hard: {none} of 1000 have none");
    assert!(none < 200, "{none}");
}

/// Curves on which octaves once had no certificate, or a look-up took the wrong ramp.
#[test]
fn these_need_no_search() {
    for one in named("direct") {
        for curve in [one.curve, one.curve.mirrored()] {
            let (ours, least) = (shutter::<8>(&curve), if one.name.ends_with("shutter") { 255 } else { 64 });
            assert!(ours.direct_triggers() >= least, "{}: {}", ours.direct_triggers(), one.name);
            assert!((10..990).all(|i| ours.steps(i as f32 / 1000.0).is_none()), "{}", one.name);
        }
    }
    // What the tests of searches go by: a search takes a step at least.
    let tent = shutter::<0>(&Curve::shutter(line((0.0, 0.0), (0.4, 1.0)), line((0.4, 1.0), (1.0, 0.0))));
    assert!([1e-14, 0.01, 0.1, 0.99].iter().all(|u| tent.steps(*u) >= Some(1)));
    assert!([0.0, 1.0, -1.0, 2.0, f32::NAN].iter().all(|u| tent.steps(*u) <= Some(0)));
}

/// A schedule has the ticks of its triggers, and says which is the first that comes too soon; so does the iterator.
fn judge_filled<const OCTAVES: usize>(shutter: &ShutterCurve<OCTAVES>, n: u32, hz: u32) {
    let Ok(timed) = shutter.at(Hz(hz)) else { return };
    let mut filled = vec![0; n as usize];
    let ticks: Vec<u32> = timed.min_gap(0).trigger_ticks(n).unwrap().collect();
    timed.min_gap(0).ticks_into(&mut filled).unwrap();
    assert_eq!(filled, ticks, "{n} triggers at {hz} Hz: {shutter:?}");
    assert!(ticks.last() <= Some(&timed.length()));
    let gaps = ticks.windows(2).map(|pair| pair[1] - pair[0]);
    let mut sorted: Vec<u32> = gaps.clone().collect();
    sorted.sort_unstable();
    for gap in [sorted.first(), sorted.get(n as usize / 2), sorted.last()].into_iter().flatten() {
        for min_gap in [*gap, gap + 1] {
            let soon = gaps.clone().position(|gap| gap < min_gap);
            let error = soon.map(|soon| {
                let (trigger, gap) = (soon as u32 + 1, ticks[soon + 1] - ticks[soon]);
                ScheduleError::GapTooSmall { trigger, gap, min_gap }
            });
            let timed = timed.min_gap(min_gap);
            assert_eq!(timed.ticks_into(&mut filled).err(), error, "{n}: {shutter:?}");
            assert_eq!(timed.trigger_ticks(n).err(), error, "{n}: {shutter:?}");
        }
    }
}

#[test]
fn a_filled_schedule_is_each_trigger_alone() {
    let random = (0..60).flat_map(|i| [random_typical(7, i), random_hard(7, i)]);
    let curves = ["typical", "hard"].into_iter().flat_map(named).map(|one| one.curve);
    for curve in curves.chain(random) {
        let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
        let (few, many) = (shutter::<8>(&curve), shutter::<64>(&curve));
        for n in [1, 2, 3, 5, 16, 63, 64, 100, 1000, 4097] {
            for most in [f64::from(n), 1e5, 1e7, 1e8] {
                let hz = (most / length).clamp(1.0, 4e9) as u32;
                if most < 2e7 || n < 20 {
                    judge_filled(&few, n, hz);
                    judge_filled(&many, n, hz);
                }
            }
        }
        judge_filled(&shutter::<0>(&curve), 7, (1e6 / length).clamp(1.0, 4e9) as u32);
    }
    judge_filled(&shutter::<8>(&random_typical(7, 0)), 1 << 22, 1 << 22);
}

#[cfg(feature = "heapless-v0_9")]
mod checked {
    use super::{SOFT, ScheduleError, at};

    #[test]
    fn a_schedule_is_the_ticks() {
        let timed = at(&SOFT, 1_000_000);
        let schedule = timed.min_gap(100).ticks_vec::<64>(64).unwrap();
        assert!(schedule.iter().copied().eq(timed.trigger_ticks(64).unwrap()));
        assert!(schedule.windows(2).all(|pair| pair[1] - pair[0] >= 100));
        assert!(timed.ticks_vec::<4>(0).unwrap().is_empty());
        let error = |n, gap| at(&SOFT, 500).min_gap(gap).ticks_vec::<16>(n).err();
        let many = Some(ScheduleError::TooMany { max: 16 });
        assert_eq!((error(16, 0), error(17, 0), error(u32::MAX, 0)), (None, many, many));
        assert_eq!(error(4, 114), Some(ScheduleError::GapTooSmall { trigger: 1, gap: 94, min_gap: 114 }));
    }
}

#[test]
fn the_most_that_keep_the_gap() {
    let keeps =
        |curve: &ShutterCurve, n: u32, hz, gap| at(curve, hz).min_gap(gap).ticks_into(&mut vec![0; n as usize]).is_ok();
    // One of them never opens more than half.
    let half_open = ShutterCurve::density(CubicBezier::line((0.0, 0.5), (2.0, 0.5))).unwrap();
    assert!((21..=64).all(|n| at(&half_open, 500).min_gap(50).max_triggers(n) == 20));
    for curve in [SOFT, ShutterCurve::linear(0.0, 0.0, 1.0, 1.0).unwrap(), half_open] {
        for (hz, gap) in
            [(1000, 47), (1000, 50), (1_000_000, 33_333), (1_000_000, 1_000), (100, 7), (10, 9), (7, 100), (50, 1)]
        {
            for wanted in [2, 3, 64, 1000, 10_000] {
                let found = at(&curve, hz).min_gap(gap).max_triggers(wanted);
                if keeps(&curve, wanted, hz, gap) {
                    assert_eq!(found, wanted, "{hz} Hz, {gap} ticks");
                    continue;
                }
                assert!(found >= 1 && found < wanted, "{found} of {wanted}");
                assert!(keeps(&curve, found, hz, gap), "{found} of {wanted} at {hz} Hz, {gap} ticks");
                assert!(!keeps(&curve, found + 1, hz, gap), "{found} and one more, {hz} Hz, {gap} ticks");
                let sure = curve.exposure() * hz as f32 / (gap as f32 + 1.5);
                assert!(found >= sure as u32, "{found}, and {sure} are sure");
            }
        }
    }
}

#[test]
fn a_curve_has_so_many_bytes() {
    assert_eq!(size_of::<ShutterCurve>(), 1136);
    assert_eq!([size_of::<ShutterCurve<0>>(), size_of::<ShutterCurve<64>>()], [368, 368 + 96 * 64]);
}

#[test]
fn pulses_of_the_whole_share_touch() {
    for n in [1, 2, 12, 100, 1 << 22] {
        let pulses = at(&SOFT, 1 << 23).pulse_ticks(n, 1.0).unwrap();
        assert_eq!(pulses.clone().next().map(|pulse| pulse.on), Some(0));
        assert_eq!(pulses.clone().next_back().map(|pulse| pulse.off), Some(1 << 23));
        let few: Vec<Pulse> = pulses.take(100).collect();
        assert!(few.windows(2).all(|pair| pair[0].off == pair[1].on));
    }
    // At this rate, searches for 1/2 from either side find times that round to two ticks.
    let opening = CubicBezier::new([(0.0, 0.0), (0.3, 0.1), (0.6, 0.8), (0.93, 1.0)]);
    let curve = ShutterCurve::new(opening, CubicBezier::line((0.93, 1.0), (1.0, 0.0))).unwrap();
    let [first, second] = at(&curve, 1_930_098_667).pulses(1.0).unwrap();
    let [alone] = at(&curve, 1_930_098_667).pulses(1e-30).unwrap();
    assert_eq!((first.off, alone.on), (second.on, alone.off));
}
