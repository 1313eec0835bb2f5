//! What is refused, with the variant, the part and the point that it names, to the adjacent `f32` on each side of each
//! rule; and what is clamped.

use crate::support::curves::{
    LEAST_EXPOSURE, LEAST_INTERVAL, LEAST_SECTION, MOST_CROSSED, Rng, instant, is_valid, line,
};
use crate::support::oracle::{Curve, Points, exp2};
use CurveError as E;
use Part::{Closing, Opening, Plateau};
use shutter_curve::{CubicBezier, CurveError, Hz, Part, ScheduleError, ShutterCurve};

const OPENS: Points = [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)];
const CLOSES: Points = [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)];

fn verdict(opening: Points, closing: Points) -> Result<(), CurveError> {
    let is_accepted = is_valid(&Curve::shutter(opening, closing));
    let [opening, closing] = [opening, closing].map(CubicBezier::new);
    let verdict = ShutterCurve::<0>::with_octaves(opening, closing).map(|_| ());
    assert_eq!(verdict.is_ok(), is_accepted, "{verdict:?}: {opening:?} {closing:?}");
    verdict
}

fn density(points: Points) -> Result<(), CurveError> {
    ShutterCurve::density(CubicBezier::new(points)).map(|_| ())
}

/// A ramp with this one seen from the other end.
fn mirrored(ramp: Points) -> Points {
    let [a, b, c, d] = ramp.map(|(t, f)| (-t, f));
    [d, c, b, a]
}

/// The part of the mirrored curve.
fn other(part: Part) -> Part {
    match part {
        Opening => Closing,
        Closing => Opening,
        part => part,
    }
}

/// The same verdict on the curve and, with the other part and point, on the mirrored one.
fn both(opening: Points, closing: Points, expected: Result<(), CurveError>) {
    assert_eq!(verdict(opening, closing), expected, "{opening:?} {closing:?}");
    let expected = expected.map_err(|error| match error {
        E::TimeOutsideRamp { part, point } => E::TimeOutsideRamp { part: other(part), point: 3 - point },
        E::OpennessOutOfRange { part, point } => E::OpennessOutOfRange { part: other(part), point: 3 - point },
        E::TimesCross(part) => E::TimesCross(other(part)),
        E::NotFullyOpen(part) => E::NotFullyOpen(other(part)),
        E::TooShort(part) => E::TooShort(other(part)),
        E::NotFinite(part) => E::NotFinite(other(part)),
        error => error,
    });
    let [first, last] = [mirrored(closing), mirrored(opening)];
    assert_eq!(verdict(first, last), expected, "mirrored: {opening:?} {closing:?}");
}

/// The last number, upwards or downwards, for which this holds; the next one is beyond the edge.
fn edge(is_up: bool, holds: impl Fn(f32) -> bool) -> [f32; 2] {
    // All numbers in order: a positive one by its bits.
    let number = |place: i32| f32::from_bits(place.unsigned_abs()).copysign(place as f32);
    let most = f32::MAX.to_bits() as i32;
    let [mut last, mut beyond] = if is_up { [-most, most] } else { [most, -most] };
    while last.abs_diff(beyond) > 1 {
        let middle = i32::midpoint(last, beyond);
        *(if holds(number(middle)) { &mut last } else { &mut beyond }) = middle;
    }
    [last, beyond].map(number)
}

fn span(from: f32, to: f32) -> f64 {
    f64::from(to) - f64::from(from)
}

/// What the rules below do not meet: everything at once, and what broke a promise of versions before.
#[test]
fn refused() {
    let ramp = |f: f32, g: f32| move |from: f32, to: f32| line((from, f), (to, g));
    let (dark, opens, open) = (ramp(0.0, 0.0), ramp(0.0, 1.0), ramp(1.0, 0.0));
    let none = instant(1.0).map(|(t, _)| (t, 0.0));
    let shut = [(0.0, 0.0), (0.0, 1.0), (0.5, 1.0), (1.0, 0.0)];
    let back = [(0.0, 0.0), (1.3, 0.0), (-0.3, 1.0), (1.0, 1.0)];
    let outside = E::TimeOutsideRamp { part: Opening, point: 1 };
    // 2⁻¹⁰⁰ and 2⁻⁶¹.
    let [tiny, unit] = [exp2(-100) as f32, exp2(-61) as f32];
    for (name, opening, closing, error) in [
        ("no light", dark(0.0, 1.0), none, E::DensityTooSmall),
        ("an epoch in s", instant(1.7e9), instant((1.7e9 + 1e-3) as f32), E::IntervalUnresolved),
        ("one time out of order", opens(0.0, 0.5), open(0.25, 1.0), E::TimesOutOfOrder),
        ("times of 1e38", instant(-3e38), instant(3e38), E::IntervalOutOfRange),
        ("a dark ramp", dark(0.0, 1.0), open(1.0, 2.0), E::NotFullyOpen(Opening)),
        ("dark at the join", shut, open(1.0, 2.0), E::NotFullyOpen(Opening)),
        ("back in time", back, open(1.0, 2.0), outside),
        ("little light", opens(-1.0, -tiny / 4.0), open(-tiny / 4.0, tiny), E::TooShort(Closing)),
        ("ticks back", dark(-0.5, -2.0 * unit), dark(unit, 0.5), E::TooShort(Plateau)),
        ("2^-149", opens(-f32::from_bits(1), 0.0), instant(1.0), E::TooShort(Opening)),
    ] {
        assert_eq!(verdict(opening, closing), Err(error), "{name}");
    }
}

#[test]
fn rule_1_numbers_are_finite_and_times_in_order() {
    for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for point in 0..4 {
            let [mut t, mut f] = [OPENS; 2];
            (t[point].0, f[point].1) = (bad, bad);
            for opening in [t, f] {
                both(opening, CLOSES, Err(E::NotFinite(Opening)));
            }
        }
    }
    // Sections without length: an ulp less is out of order.
    let rng = &mut Rng::new(1, 0);
    for _ in 0..1000 {
        let t = rng.between(-1.0, 2.0) as f32;
        let [before, after] = [t - 1.0, t + 1.0];
        let triangle = [line((before, 0.0), (t, 1.0)), line((t, 1.0), (after, 0.0))];
        both(triangle[0], triangle[1], Ok(()));
        let late = line((before, 0.0), (t.next_up(), 1.0));
        both(late, triangle[1], Err(E::TimesOutOfOrder));
        both(instant(t), line((after, 1.0), (after + 1.0, 0.0)), Ok(()));
        let mut back = instant(t);
        back[3].0 = t.next_down();
        both(back, line((after, 1.0), (after + 1.0, 0.0)), Err(E::TimesOutOfOrder));
    }
}

#[test]
fn rule_2_inner_times_lie_on_the_ramp() {
    let rng = &mut Rng::new(2, 0);
    for i in 0..2000 {
        let typed = |x: f64| if i % 2 == 0 { (1e3 * x).round() / 1e3 } else { x };
        let from = typed(rng.between(-1.0, 1.0)) as f32;
        let to = from + typed(rng.between(0.01, 2.0)) as f32;
        let inner = from + 0.5 * (to - from);
        let closing = line((to + 0.25, 1.0), (to + 1.0, 0.0));
        let with = |t1: f32, t2: f32| [(from, 0.0), (t1, 0.3), (t2, 0.6), (to, 1.0)];
        let outside = |point| Err(E::TimeOutsideRamp { part: Opening, point });
        for end in [from, to] {
            let beyond = if end == to { to.next_up() } else { from.next_down() };
            both(with(end, inner), closing, Ok(()));
            both(with(beyond, inner), closing, outside(1));
            both(with(inner, end), closing, Ok(()));
            both(with(inner, beyond), closing, outside(2));
        }
    }
}

#[test]
fn rule_2_openness_lies_between_0_and_1() {
    let [below, above] = [-f32::from_bits(1), 1f32.next_up()];
    for point in 0..4 {
        for (edge, beyond) in [(0.0, below), (-0.0, below), (1.0, above)] {
            let with = |f: f32| {
                let mut ramp = OPENS;
                ramp[point].1 = f;
                ramp
            };
            let error = |part| E::OpennessOutOfRange { part, point: point as u8 };
            let at_edge = if point == 3 && edge == 0.0 { Err(E::NotFullyOpen(Opening)) } else { Ok(()) };
            both(with(edge), CLOSES, at_edge);
            both(with(beyond), CLOSES, Err(error(Opening)));
            assert_eq!(density(with(edge)), Ok(()));
            assert_eq!(density(with(beyond)), Err(E::DensityOutOfRange));
            // A ramp without length, too.
            let mut at_once = instant(0.0);
            at_once[point].1 = beyond;
            both(at_once, CLOSES, Err(error(Opening)));
        }
    }
}

#[test]
fn rule_2_the_first_inner_time_passes_the_second_by_15_16() {
    let rng = &mut Rng::new(3, 0);
    for i in 0..2000 {
        let typed = |x: f64| if i % 2 == 0 { (64.0 * x).round() / 64.0 } else { x };
        let from = typed(rng.between(-1.0, 1.0)) as f32;
        let to = from + typed(rng.between(0.02, 2.0)) as f32;
        let closing = line((to + 0.25, 1.0), (to + 1.0, 0.0));
        let with = |t1: f32, t2: f32, to: f32| [(from, 0.0), (t1, 0.3), (t2, 0.6), (to, 1.0)];
        let holds = |t1, t2, to| span(t2, t1) <= MOST_CROSSED * span(from, to);
        let second = (f64::from(from) + typed(0.0625 * rng.unit()) * span(from, to)) as f32;
        let [first, beyond] = edge(true, |t1| t1 <= to && holds(t1, second, to));
        both(with(first, second, to), closing, Ok(()));
        if beyond <= to {
            both(with(beyond, second, to), closing, Err(E::TimesCross(Opening)));
        }
        let [least, below] = edge(false, |t2| t2 >= from && holds(first, t2, to));
        both(with(first, least, to), closing, Ok(()));
        if below >= from {
            both(with(first, below, to), closing, Err(E::TimesCross(Opening)));
        }
        let [shortest, shorter] = edge(false, |to| to >= first && holds(first, second, to));
        both(with(first, second, shortest), closing, Ok(()));
        if shorter >= first {
            both(with(first, second, shorter), closing, Err(E::TimesCross(Opening)));
        }
    }
    // Exactly, as it is typed.
    for [t1, t2] in [[0.9375, 0.0], [1.0, 0.0625], [0.96875, 0.03125]] {
        let with = |t1, t2| [(0.0, 0.0), (t1, 0.0), (t2, 1.0), (1.0, 1.0)];
        both(with(t1, t2), instant(1.0), Ok(()));
        both(
            with(t1, f32::next_down(t2)),
            instant(1.0),
            if t2 == 0.0 { Err(E::TimeOutsideRamp { part: Opening, point: 2 }) } else { Err(E::TimesCross(Opening)) },
        );
    }
}

#[test]
fn rule_3_ramps_are_fully_open_at_their_join() {
    let rng = &mut Rng::new(4, 0);
    for _ in 0..1000 {
        let [t, f] = [0, 1].map(|_| rng.unit() as f32);
        let with = |last: f32| [(-1.0, 0.0), (-t, f), (-0.5 * t, f), (0.0, last)];
        let dim = 1f32.next_down();
        let not_open = Err(E::NotFullyOpen(Opening));
        // A plateau follows, a ramp, both, and nothing.
        for (closing, expected) in [
            (instant(1.0), not_open),
            (line((0.0, 1.0), (1.0, 0.0)), not_open),
            (line((0.5, 1.0), (1.0, 0.0)), not_open),
            (instant(0.0), Ok(())),
        ] {
            both(with(1.0), closing, Ok(()));
            both(with(dim), closing, expected);
            let above = E::OpennessOutOfRange { part: Opening, point: 3 };
            both(with(1f32.next_up()), closing, Err(above));
        }
        assert_eq!(density(with(dim)), Ok(()));
        assert_eq!(density(with(0.0)), Ok(()));
    }
}

#[test]
fn rule_4_the_interval_is_resolved_and_in_range() {
    let rng = &mut Rng::new(5, 0);
    let holds = |start: f32, end: f32| span(start, end) >= LEAST_INTERVAL * f64::from(start.abs().max(end.abs()));
    for i in 0..2000 {
        let start = if i % 2 == 0 {
            [1000.0, 0.1, 1.0, 3600.0, 1024.0, 65_535.0][i / 2 % 6]
        } else {
            rng.power_of_ten(-12.0, 12.0) as f32
        };
        let [end, short] = edge(false, |end| holds(start, end));
        both(instant(start), instant(end), Ok(()));
        both(instant(start), instant(short), Err(E::IntervalUnresolved));
        let [start, late] = edge(true, |start| holds(start, end));
        both(instant(start), instant(end), Ok(()));
        both(instant(late), instant(end), Err(E::IntervalUnresolved));
    }
    both(instant(65_535.0), instant(65_536.0), Ok(()));
    let out_of_range = Err(E::IntervalOutOfRange);
    for (length, beyond) in [(exp2(-64) as f32, f32::next_down as fn(f32) -> f32), (exp2(64) as f32, f32::next_up)] {
        for before in [0.0, 0.25, 0.5] {
            let [start, end] = [-before * length, (1.0 - before) * length];
            both(instant(start), instant(end), Ok(()));
            both(instant(start), instant(beyond(end)), out_of_range);
            if start < 0.0 {
                both(instant(-beyond(-start)), instant(end), out_of_range);
            }
        }
    }
    // No length at all, wherever.
    for t in [1.0, -1e-3, 1e38] {
        both(instant(t), instant(t), Err(E::IntervalUnresolved));
    }
    both(instant(0.0), instant(0.0), out_of_range);
}

#[test]
fn rule_5_sections_have_no_length_or_the_least() {
    // Too short by 2⁻¹⁰¹, which an `f64` beside 2⁻²⁴ does not have.
    assert_eq!(ShutterCurve::linear(-1.0, -1.0, exp2(-101) as f32, exp2(-24) as f32).map(|_| ()), Ok(()));
    let rng = &mut Rng::new(6, 0);
    for i in 0..2000 {
        let greatest =
            if i % 2 == 0 { [1.0, 10.0, 0.02, 1000.0][i / 2 % 4] } else { rng.power_of_ten(-9.0, 9.0) as f32 };
        let least = |end: f32| LEAST_SECTION * f64::from(end);
        // The short section begins here, where `f32` are fine enough.
        let from = (f64::from(greatest) * (rng.unit() - 0.5) * exp2(-(rng.below(20) as i32 + 10))) as f32;
        let [to, short] = edge(false, |to| span(from, to) >= least(greatest));
        let [_, late] = edge(true, |from| span(from, to) >= least(greatest));
        // Ends the ramp at a time.
        let until = |t: f32| line((t, 1.0), (greatest, 0.0));
        let since = |t: f32| line((-greatest, 0.0), (t, 1.0));
        for (opening, closing, part) in [
            (line((from, 0.0), (to, 1.0)), until(0.5 * greatest), None),
            (line((from, 0.0), (short, 1.0)), until(0.5 * greatest), Some(Opening)),
            (line((late, 0.0), (to, 1.0)), until(0.5 * greatest), Some(Opening)),
            (line((from, 0.0), (to, 1.0)), until(to), None),
            (line((from, 0.0), (short, 1.0)), until(short), Some(Opening)),
            (since(from), until(to), None),
            (since(from), until(short), Some(Plateau)),
            (since(late), until(to), Some(Plateau)),
            (instant(from), until(to), None),
            (instant(from), until(short), Some(Plateau)),
            (instant(from), until(from), None),
        ] {
            let expected = part.map_or(Ok(()), |part| Err(E::TooShort(part)));
            both(opening, closing, expected);
        }
        // Where the greatest time grows, the least section does.
        if f64::from(to - from) == least(greatest) {
            let farther = line((0.5 * greatest, 1.0), (greatest.next_up(), 0.0));
            both(line((from, 0.0), (to, 1.0)), farther, Err(E::TooShort(Opening)));
        }
    }
}

#[test]
fn rule_6_a_density_has_the_least_exposure() {
    let least = LEAST_EXPOSURE as f32;
    let too_small = Err(E::DensityTooSmall);
    let rng = &mut Rng::new(7, 0);
    for i in 0..1000 {
        let [start, length] = match i {
            0 => [0.0, 1.0],
            1 => [0.0, 1e-3],
            2 => [-3.3, 0.1],
            _ => [rng.between(-1.0, 1.0) as f32, rng.power_of_ten(-3.0, 3.0) as f32],
        };
        let [a, b] = [0, 1].map(|_| rng.unit() as f32);
        let at = |part: f32| start + part * length;
        let even = |f: f32| [(at(0.0), f), (at(a.min(b)), f), (at(a.max(b)), f), (at(1.0), f)];
        assert_eq!(density(even(least.next_up())), Ok(()));
        assert_eq!(density(even(least.next_down())), too_small);
        // Half of it on average, from 0 on.
        let rising = |f: f32| line((at(0.0), 0.0), (at(1.0), f));
        assert_eq!(density(rising(2.0 * least * (1.0 + 1e-3))), Ok(()));
        assert_eq!(density(rising(2.0 * least * (1.0 - 1e-3))), too_small);
    }
    assert_eq!(density(line((0.0, least), (1.0, least))), Ok(()));
    let mut trace = line((0.0, least), (1.0, least));
    trace[1].1 = least.next_down();
    assert_eq!(density(trace), too_small);
}

/// Which rule is named where several are broken: the first of the list.
#[test]
fn the_first_rule_is_named() {
    let mut ramp = [(0.0, -1.0), (2.0, 2.0), (-1.0, 0.5), (0.9, 0.5)];
    let closing = line((1.0, 1.0), (1.0 + 1e-7, 0.0));
    let mut errors = vec![verdict(ramp, [(0.5, f32::NAN); 4]), verdict(ramp, line((0.5, 1.0), (1.0, 0.0)))];
    errors.push(verdict(ramp, closing));
    ramp[0].1 = 0.0;
    errors.extend([verdict(ramp, instant(1.0))]);
    ramp[1] = (0.9, 0.5);
    errors.extend([verdict(ramp, instant(1.0))]);
    ramp[2].0 = 0.0;
    errors.extend([verdict(ramp, instant(1.0))]);
    ramp[2].0 = 0.1;
    errors.extend([verdict(ramp, instant(1.0))]);
    let expected = [
        E::NotFinite(Closing),
        E::TimesOutOfOrder,
        E::OpennessOutOfRange { part: Opening, point: 0 },
        E::TimeOutsideRamp { part: Opening, point: 1 },
        E::TimeOutsideRamp { part: Opening, point: 2 },
        E::TimesCross(Opening),
        E::NotFullyOpen(Opening),
    ];
    assert_eq!(errors, expected.map(Err));
}

/// Each message: the part, the rule and the remedy.
#[test]
fn messages() {
    let told = |error: &dyn std::error::Error, text: &str| assert_eq!(error.to_string(), text);
    let points = ["first point", "first inner point", "second inner point", "last point"];
    for (part, name) in [(Opening, "opening ramp"), (Plateau, "plateau"), (Closing, "closing ramp")] {
        assert_eq!(part.to_string(), name);
        let end = if part == Closing { "begin" } else { "end" };
        let open = format!("it has to {end} fully open, at openness 1");
        for (error, text) in [
            (E::NotFinite(part), "a control point is NaN, infinite or beyond f32 (3.4e38)"),
            (
                E::TimesCross(part),
                "its first inner point is later than its second by more than 15/16 of the ramp; \
                 move them closer",
            ),
            (E::NotFullyOpen(part), &open),
            (E::TooShort(part), "it is shorter than 2^-24 of the greatest time; make it longer, or give it no length"),
        ] {
            told(&error, &format!("{name}: {text}"));
        }
        for (point, at) in (0..).zip(points) {
            for (error, of, rule) in [
                (E::TimeOutsideRamp { part, point }, "time", "to lie between the ramp's ends"),
                (
                    E::FractionOutsideRamp { part, point },
                    "time",
                    "to lie on the ramp, as a fraction of the whole interval: 0 at open_start, \
                     1 at close_end",
                ),
                (E::OpennessOutOfRange { part, point }, "openness", "to be in [0, 1]"),
            ] {
                told(&error, &format!("{name}: the {of} of its {at} has {rule}"));
            }
        }
    }
    for (error, text) in [
        (E::TimesOutOfOrder, "times out of order: open_start <= open_end <= close_start <= close_end is required"),
        (
            E::DensityOutOfRange,
            "the density has to be in [0, 1] at each control point; scale a greater one down \
             (CubicBezier::scaled)",
        ),
        (
            E::IntervalUnresolved,
            "the interval is too short for its distance from time 0: below 2^-16 of its greatest \
             time; count times from a nearer origin",
        ),
        (E::IntervalOutOfRange, "the interval is shorter than 2^-64 (5.4e-20) or longer than 2^64 (1.8e19)"),
        (
            E::DensityTooSmall,
            "the density's exposure is below 2^-20 of its interval; scale it up \
             (CubicBezier::scaled)",
        ),
    ] {
        told(&error, text);
    }
    use ScheduleError as S;
    for (error, text) in [
        (S::RateZero, "the timer's rate is 0"),
        (
            S::RateTooHigh { max: Hz(9) },
            "the curve has more than 2^31 ticks; use a rate of at most 9 Hz, and times in seconds",
        ),
        (
            S::RateTooHigh { max: Hz(0) },
            "the curve has more than 2^31 ticks at any rate; its times have to be in seconds",
        ),
        (S::TooMany { max: 1 << 22 }, "more triggers or pulses than fit; use at most 4194304"),
        (
            S::GapTooSmall { trigger: 3, gap: 562, min_gap: 1000 },
            "the gap before trigger 3 is 562 ticks; the minimum is 1000; \
             use fewer triggers (max_triggers), or a faster timer",
        ),
        (
            S::GapTooSmall { trigger: u32::MAX, gap: 0, min_gap: u32::MAX },
            "the gap before trigger 4294967295 is 0 ticks; the minimum is 4294967295; \
             use fewer triggers (max_triggers), or a faster timer; is its rate in Hz?",
        ),
        (
            S::PulsesTooClose { pulse: 17, gap: 1, min_gap: 4711 },
            "the gap before pulse 17 is 1 tick; the minimum is 4711; \
             use fewer pulses, or a smaller duty; with min_gap(0) pulses may touch",
        ),
        (
            S::PulseTooShort { pulse: 17, length: 815, min_pulse: 4711 },
            "pulse 17 lasts 815 ticks; the minimum is 4711; use fewer pulses, a larger duty, or a faster timer",
        ),
        (S::DutyOutOfRange, "the duty has to be above 0 and at most 1"),
    ] {
        told(&error, text);
    }
}

/// A decimal as a person writes it, and a program reads it.
fn read(x: f64, decimals: usize) -> f32 {
    format!("{x:.decimals$}").parse().unwrap()
}

/// Inner times that mean an end or a join, typed as decimals or divided out: accepted, in s and in ms, and on the ramp.
/// At 0 and 1 they are exactly the curve's ends.
#[test]
fn inner_points_at_ends_and_joins_are_accepted() {
    let mut curves = 0;
    for (length, decimals) in [(0.1, 3), (0.01, 4), (1.0, 2), (10.0, 1), (100.0, 1), (0.02, 4), (2.13, 3), (8.1, 2)] {
        for start in [0.0, 0.1, 1000.0, -3.3, -2.0 * length, length, -0.37 * length] {
            for (open, close) in (0..=100).step_by(7).flat_map(|i| (i..=100).step_by(9).map(move |k| (i, k))) {
                let parts = [open, close].map(|part| f64::from(part) / 100.0);
                let [s, ms] = [1.0, 1000.0].map(|unit| {
                    let typed = |t: f64| read(unit * t, if unit == 1.0 { decimals + 2 } else { 1 });
                    [0.0, parts[0], parts[1], 1.0].map(|part| typed(start + length * part))
                });
                for times in [s, ms] {
                    curves += judge_inner(times, parts) as u32;
                }
            }
        }
    }
    println!("{curves} curves");
    assert!(curves > 10_000, "{curves}");
    // What was refused by versions before, once the closing ramp is as long as it has to be.
    for times in [[-1.3883804, -0.6941902, 4.2855483e-10, 1.8542775e-7], [-1e19, -1e19, 1000.0, 1e15]] {
        for inner in [[0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0]] {
            assert_eq!(ShutterCurve::shutteropening(times, inner).map(|_| ()), Ok(()), "{times:?}");
        }
    }
    for times in [[-1.3883804, -0.6941902, 4.2855483e-10, 1.8542775e-9], [-1e19, -1e19, 1000.0, 1500.0]] {
        let inner = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0];
        assert_eq!(ShutterCurve::shutteropening(times, inner), Err(E::TooShort(Closing)));
    }
}

/// Is a straight shutter with these times accepted? Then those with inner points at its ends have to be.
fn judge_inner(times: [f32; 4], parts: [f64; 2]) -> bool {
    let [start, open, close, end] = times;
    let straight = Curve::shutter(line((start, 0.0), (open, 1.0)), line((close, 1.0), (end, 0.0)));
    if !is_valid(&straight) {
        return false;
    }
    // As it is typed, and as `(join - start) / (end - start)` is computed in either precision.
    let divided = |join: f32| [(join - start) / (end - start), (span(start, join) / span(start, end)) as f32];
    let [opened, closes] = [(open, parts[0]), (close, parts[1])].map(|(join, part)| {
        let [single, double] = divided(join);
        [part as f32, single, double]
    });
    for (opened, closes) in opened.into_iter().zip(closes) {
        for inner in [[0.0, opened, closes, 1.0], [opened, opened, closes, closes], [0.0, 0.0, 1.0, 1.0]] {
            let [t1, t2, t5, t6] = inner;
            let inner = [t1, 0.0, t2, 1.0, t5, 1.0, t6, 0.0];
            let (opening, closing) = CubicBezier::shutteropening(times, inner);
            let curve = ShutterCurve::<0>::with_octaves(opening, closing).map(|_| ());
            assert_eq!(curve, Ok(()), "{times:?} {inner:?}");
            let points = [opening.points(), closing.points()].concat();
            for (i, (fraction, from, to)) in
                [(1, (t1, start, open)), (2, (t2, start, open)), (5, (t5, close, end)), (6, (t6, close, end))]
            {
                let t = points[i].0;
                assert!((from..=to).contains(&t), "{t:e} of {times:?} {inner:?}");
                let is_end = fraction == 0.0 && t == start || fraction == 1.0 && t == end;
                assert!(is_end || fraction != 0.0 && fraction != 1.0, "{t:e} of {times:?} {inner:?}");
                // In doubles, as far as rounding passes the ramp it is its end.
                let meant = f64::from(start) + f64::from(fraction) * span(start, end);
                let clamped = meant.clamp(f64::from(from), f64::from(to));
                assert!(
                    (f64::from(t) - clamped).abs()
                        <= exp2(-24) * clamped.abs() + exp2(-50) * f64::from(end.abs().max(start.abs())),
                    "{t:e} of {times:?} {inner:?}"
                );
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
}
