//! Ticks are at fractions of 64 bits, finer than any `f32`: what only those meet.

mod support;

use shutter_curve::CubicBezier;
use support::cases::shutter;
use support::oracle::{Curve, Dd, Exact, exp2};
use support::promise::{DIRECT_TICKS, TICKS, tick_error, tick_error_at};

/// A bright box, and then a dark one with next to no light: where each trace of a fraction is many ticks.
fn dark_after_bright(openness: f32) -> Curve {
    let opening = CubicBezier::line((0.0, 1.0), (1.0, 1.0));
    let closing = CubicBezier::line((1.0, openness), (257.0, openness));
    Curve::shutter(opening.points(), closing.points())
}

fn rate(curve: &Curve) -> u32 {
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    (DIRECT_TICKS * (1.0 - 1e-9) / length) as u32
}

/// From the later side, what a fraction of 64 bits lacks counts in full.
#[test]
fn last_triggers_of_large_frames() {
    fn worst<const CELLS: usize>(openness: f32) -> (f64, [u32; 2]) {
        let curve = dark_after_bright(openness);
        let (exact, ours, hz) = (Exact::new(&curve), shutter::<CELLS>(&curve), rate(&curve));
        let last = |n: u32| [1, 2, 3, 10, 30, 100].map(|k| [n - k, n]);
        let triggers = (4_194_204..=1 << 22).flat_map(last).map(|[i, n]| {
            let tick = ours.trigger_ticks(n, hz).unwrap().nth(i as usize).unwrap();
            (tick_error(&exact, tick, [i, n], hz), [i, n])
        });
        triggers.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    }
    for openness in (18..=30).map(|k| exp2(-k) as f32) {
        for (error, trigger) in
            [worst::<16>(openness), worst::<20>(openness), worst::<64>(openness)]
        {
            assert!(error <= TICKS[0], "{error:.3} ticks: {trigger:?}, openness {openness:e}");
        }
    }
}

/// The same of the last pulse's end, which comes nearer to the curve's end.
#[test]
fn last_pulses_end() {
    let curve = dark_after_bright(8.231806e-11);
    let (exact, ours, hz) = (Exact::new(&curve), shutter::<32>(&curve), rate(&curve));
    for (n, duty) in [(9986, 0.99987376f32), (99_975, 0.9987359), (4_194_302, 0.946967)] {
        let (_, off) = ours.pulse_ticks(n, duty, hz).unwrap().next_back().unwrap();
        let u = Dd::from(2.0 * f64::from(n) - 1.0) + Dd::from(f64::from(duty));
        let error = tick_error_at(&exact, off, u / Dd::from(2.0 * f64::from(n)), hz);
        assert!(error <= TICKS[0], "{error:.3} ticks: {n} of duty {duty}");
    }
}

/// No `f32` lies on a plateau so short, but a trigger does; the ramp before it is dim.
#[test]
fn a_trigger_on_a_plateau_between_neighbouring_f32() {
    let found = [
        (
            [
                (-17.333332, 0.046875),
                (-11.555555, 0.036458332),
                (-5.7777777, 0.026041666),
                (0.0, 0.015625),
            ],
            [
                (2.9802322e-8, 0.25),
                (0.30555558, 0.41666666),
                (0.61111116, 0.5833333),
                (0.9166666, 0.75),
            ],
            [6, 12],
        ),
        (
            [
                (-1.624044, 0.5855756),
                (-1.082696, 0.46659985),
                (-0.541348, 0.15953967),
                (0.0, 0.12240308),
            ],
            [
                (2.9327483e-8, 0.2797219),
                (0.30434337, 0.5310168),
                (0.6086867, 0.76024395),
                (0.91303, 0.43698347),
            ],
            [6, 12],
        ),
        (
            [
                (-1.4792293, 0.56052166),
                (-0.9861529, 0.53772044),
                (-0.49307644, 0.3513715),
                (0.0, 0.14827006),
            ],
            [
                (2.8025521e-8, 0.5964531),
                (0.15987019, 0.8754111),
                (0.31974036, 0.99166363),
                (0.47961053, 0.9483318),
            ],
            [6, 11],
        ),
    ];
    let mut missed = Vec::new();
    for (opening, closing, [i, n]) in found {
        let curve = Curve::shutter(opening, closing);
        let (exact, hz) = (Exact::new(&curve), rate(&curve));
        let ticks = [
            shutter::<8>(&curve).trigger_ticks(n, hz).unwrap().nth(i as usize).unwrap(),
            shutter::<16>(&curve).trigger_ticks(n, hz).unwrap().nth(i as usize).unwrap(),
            shutter::<0>(&curve).trigger_ticks(n, hz).unwrap().nth(i as usize).unwrap(),
        ];
        let errors = ticks.map(|tick| tick_error(&exact, tick, [i, n], hz));
        if errors.iter().any(|error| *error > TICKS[0]) {
            missed.push((errors, i, n, hz, ticks));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}
