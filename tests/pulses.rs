//! Pulses with equal doses: each end at its tick, none overlapping the next, each dose through the curve.

mod support;

use shutter_curve::{CubicBezier, Pulse, ScheduleError, ShutterCurve, valid};
use support::aimed::{FAMILIES, aimed};
use support::cases::shutter;
use support::curves::{Kind, named, random_hard, random_typical};
use support::oracle::{Curve, Dd, Exact};
use support::promise::{EDGE_ULP, MOST_TRIGGERS, TICK, TYPICAL_TICKS, tick_error_at};

const SOFT: ShutterCurve = valid(ShutterCurve::shutteropening(
    [0.0, 0.25, 0.75, 1.0],
    [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0],
));

const DUTIES: [f32; 9] =
    [1.0, 1.0 - f32::EPSILON / 2.0, 0.999, 0.75, 0.5, 0.3, 1e-3, 1e-20, f32::from_bits(1)];

/// A rate at which the interval has some 2 to this ticks, if there is one.
fn rate(curve: &Curve, ticks: f64) -> Option<u32> {
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    let hz = (ticks - 1.0) / length;
    (hz >= 1.0 && hz <= f64::from(u32::MAX)).then_some(hz as u32)
}

/// Pulses here and there in frames of any size: every end at its tick, and the next pulse never before the end of this one.
/// Which duty goes with which frame, `turn` says.
fn judge(turn: usize, curve: &Curve, name: &dyn std::fmt::Debug) {
    judge_with(turn, &shutter::<8>(curve), curve, name);
    judge_with(turn + 4, &shutter::<0>(curve), curve, name);
}

fn judge_with<const OCTAVES: usize>(
    turn: usize,
    ours: &ShutterCurve<OCTAVES>,
    curve: &Curve,
    name: &dyn std::fmt::Debug,
) {
    let exact = Exact::new(curve);
    for (many, ticks) in [1000.0, TYPICAL_TICKS, 2147483648.0].into_iter().enumerate() {
        let Some(hz) = rate(curve, ticks) else { continue };
        let frames = [1, 2, 3, 12, 1000, MOST_TRIGGERS - 1, MOST_TRIGGERS];
        for (k, n) in frames.into_iter().enumerate() {
            let duty = DUTIES[(turn + 4 * many + k) % DUTIES.len()];
            let pulses = ours.pulse_ticks(n, duty, hz).unwrap();
            for i in [0, 1, n / 4, n / 2, n - 1].into_iter().filter(|i| *i < n) {
                let Pulse { on, off } = pulses.clone().nth(i as usize).unwrap();
                assert!(on <= off, "{i} of {n}, {duty}, {name:?}");
                if let Some(Pulse { on: next, .. }) = pulses.clone().nth(i as usize + 1) {
                    assert!(off <= next, "{i} of {n}, {duty}, {name:?}");
                }
                for (tick, sign) in [(on, -1.0), (off, 1.0)] {
                    let middle = Dd::from(2.0 * f64::from(i) + 1.0);
                    let edge = middle + Dd::from(sign * f64::from(duty));
                    let u = edge / Dd::from(2.0 * f64::from(n));
                    let error = tick_error_at(&exact, tick, u, hz, EDGE_ULP);
                    assert!(error <= TICK, "{error}: {i} of {n}, {duty}, {name:?}");
                }
            }
        }
    }
}

#[test]
fn on_named_curves() {
    for (turn, one) in named().into_iter().enumerate() {
        judge(turn, &one.curve, &one.name);
    }
}

#[test]
fn on_random_and_aimed_curves() {
    for i in 0..60 {
        judge(i as usize, &random_typical(31, i), &i);
        judge(i as usize, &random_hard(31, i), &i);
    }
    for family in 0..FAMILIES.len() {
        for i in 0..4 {
            judge(family + i as usize, &aimed(family, 31, i), &(family, i));
        }
    }
}

/// What each pulse of a steady lamp lets through the shutter, by the oracle's cdf; a tick at either end is half of one off.
#[test]
fn doses_are_equal() {
    for one in named().into_iter().filter(|one| one.kind == Kind::Typical) {
        let (exact, curve) = (Exact::new(&one.curve), shutter::<8>(&one.curve));
        let hz = rate(&one.curve, 1e6).unwrap();
        let at = |tick: u32| {
            let t = Dd::from(one.curve.open_start())
                + Dd::from(f64::from(tick)) / Dd::from(f64::from(hz));
            exact.cdf_dd(t)
        };
        for (n, duty) in [(12, 0.3), (12, 1.0), (5, 0.01), (64, 0.5)] {
            for Pulse { on, off } in curve.pulse_ticks(n, duty, hz).unwrap() {
                let dose = (at(off) - at(on)).hi;
                let even = f64::from(duty) / f64::from(n);
                // The openness is at most 1: a tick of it is 1/A ticks of the exposure.
                let tick = 1.0 / (f64::from(hz) * f64::from(curve.exposure()));
                assert!((dose - even).abs() <= 1.5 * tick, "{dose} for {even}, {}", one.name);
            }
        }
    }
}

#[test]
fn pulses_of_the_whole_share_touch() {
    for n in [1, 2, 12, 100, 1 << 22] {
        let pulses = SOFT.pulse_ticks(n, 1.0, 1 << 23).unwrap();
        assert_eq!(pulses.clone().next().map(|pulse| pulse.on), Some(0));
        assert_eq!(pulses.clone().last().map(|pulse| pulse.off), Some(1 << 23));
        let few: Vec<Pulse> = pulses.take(100).collect();
        assert!(few.windows(2).all(|pair| pair[0].off == pair[1].on));
    }
}

/// On this curve and at this rate, searches for 1/2 from either side find times that round to two ticks.
#[test]
fn ends_at_one_half_are_in_order() {
    let opening = CubicBezier::new([(0.0, 0.0), (0.3, 0.1), (0.6, 0.8), (0.93, 1.0)]);
    let closing = CubicBezier::line((0.93, 1.0), (1.0, 0.0));
    let curve = ShutterCurve::<8>::with_octaves(opening, closing).unwrap();
    let hz = 1_930_098_667;
    let touching: Vec<Pulse> = curve.pulse_ticks(2, 1.0, hz).unwrap().collect();
    assert_eq!(touching[0].off, touching[1].on);
    let Pulse { on, off } = curve.pulse_ticks(1, 1e-30, hz).unwrap().next().unwrap();
    assert_eq!(on, off);
    assert_eq!(curve.pulses_into(&mut [Pulse::default(); 2], 1.0, hz, 0, 0), Ok(()));
    assert_eq!(curve.pulses_into(&mut [Pulse::default(); 1], 1e-30, hz, 0, 0), Ok(()));
}

/// A first pulse that goes on next to the start, where most of its fraction's words are zeros.
#[test]
fn the_first_end_has_all_its_bits() {
    // The openness is p³, the time p: u = t⁴.
    let third = 1.0 / 3.0;
    let opening = CubicBezier::new([(0.0, 0.0), (third, 0.0), (2.0 * third, 0.0), (1.0, 1.0)]);
    let curve = Curve::shutter(opening.points(), [(1.0, 1.0), (1.0, 0.5), (1.0, 0.5), (1.0, 0.0)]);
    let (exact, hz) = (Exact::new(&curve), 2_147_483_448);
    for (n, duty) in [(4_194_303, 1.0 - f32::EPSILON / 2.0), (1_000_007, 1.0 - f32::EPSILON)] {
        let Pulse { on, .. } =
            shutter::<8>(&curve).pulse_ticks(n, duty, hz).unwrap().next().unwrap();
        let u = (Dd::from(1.0) - Dd::from(f64::from(duty))) / Dd::from(2.0 * f64::from(n));
        assert!(tick_error_at(&exact, on, u, hz, EDGE_ULP) <= TICK, "{on}: the first of {n}");
    }
}

#[test]
fn from_either_end_and_anywhere() {
    let all: Vec<Pulse> = SOFT.pulse_ticks(7, 0.4, 1_000_000).unwrap().collect();
    let frame = || SOFT.pulse_ticks(7, 0.4, 1_000_000).unwrap();
    assert_eq!(frame().len(), 7);
    assert!(frame().rev().eq(all.iter().rev().copied()));
    assert_eq!((frame().nth(3), frame().nth_back(3)), (Some(all[3]), Some(all[3])));
    assert_eq!(SOFT.pulse_ticks(0, 0.4, 1_000_000).unwrap().next(), None);
}

#[test]
fn what_cannot_be_is_refused() {
    for duty in [0.0, -0.0, -0.5, f32::NAN, 1.0 + f32::EPSILON, f32::INFINITY] {
        assert_eq!(SOFT.pulse_ticks(3, duty, 1000).err(), Some(ScheduleError::DutyOutOfRange));
    }
    assert_eq!(SOFT.pulse_ticks(3, 0.5, 0).err(), Some(ScheduleError::TickRateZero));
    assert_eq!(
        SOFT.pulse_ticks(3, 0.5, u32::MAX).err(),
        Some(ScheduleError::TickRateTooHigh { most: 1 << 31 })
    );
    let mut pulses = [Pulse::default(); 12];
    let mut checked = |duty, pulse, gap| SOFT.pulses_into(&mut pulses, duty, 1_000_000, pulse, gap);
    assert_eq!(checked(0.5, 30_000, 30_000), Ok(()));
    assert_eq!(
        checked(0.5, 32_000, 0),
        Err(ScheduleError::PulseTooShort { pulse: 2, length: 31_250, min_pulse: 32_000 })
    );
    assert!(matches!(
        checked(1.0, 0, 1),
        Err(ScheduleError::PulsesTooClose { pulse: 1, gap: 0, min_gap: 1 })
    ));
    for (error, numbers) in [
        (ScheduleError::DutyOutOfRange, &["0", "1"][..]),
        (
            ScheduleError::PulseTooShort { pulse: 17, length: 815, min_pulse: 4711 },
            &["17", "815", "4711"],
        ),
        (
            ScheduleError::PulsesTooClose { pulse: 17, gap: 815, min_gap: 4711 },
            &["17", "815", "4711", "gone off"],
        ),
    ] {
        let text = error.to_string();
        assert!(numbers.iter().all(|number| text.contains(number)), "{text}");
    }
}

/// The last pulse's end, next to the end of a curve with hardly any light there.
#[test]
fn last_pulses_end() {
    let openness = 8.231806e-11;
    let opening = CubicBezier::line((0.0, 1.0), (1.0, 1.0));
    let closing = CubicBezier::line((1.0, openness), (257.0, openness));
    let curve = Curve::shutter(opening.points(), closing.points());
    let (exact, ours, hz) =
        (Exact::new(&curve), shutter::<32>(&curve), rate(&curve, TYPICAL_TICKS).unwrap());
    for (n, duty) in [(9986, 0.99987376f32), (99_975, 0.9987359), (4_194_302, 0.946967)] {
        let Pulse { off, .. } = ours.pulse_ticks(n, duty, hz).unwrap().next_back().unwrap();
        let u = Dd::from(2.0 * f64::from(n) - 1.0) + Dd::from(f64::from(duty));
        let error = tick_error_at(&exact, off, u / Dd::from(2.0 * f64::from(n)), hz, EDGE_ULP);
        assert!(error <= TICK, "{error:.3} ticks: {n} of duty {duty}");
    }
}
