//! Faults of versions 0.1.0 and 0.2.0, each with the input that showed it.

mod support;

use shutter_curve::{Pulse, ScheduleError, ShutterCurve};
use support::cases::shutter;
use support::oracle::lift::Lifted;
use support::oracle::{Curve, Dd, Exact, Points, exp2};
use support::promise::{
    BACKWARD, EDGE_ULP, EVALUATIONS, FORWARD, TICK, VALUE, tick_error, tick_error_at,
};

/// A ramp without length.
const fn instant(t: f32, f: f32) -> Points {
    [(t, f); 4]
}

/// Control points by the bits of their numbers.
fn by_bits(points: [(u32, u32); 4]) -> Points {
    points.map(|(t, f)| (f32::from_bits(t), f32::from_bits(f)))
}

/// An S between two times: openness (from, from, to, to), and times a quarter of the length in from either end.
fn quarters([from, to]: [f32; 2], start: f32, end: f32) -> Points {
    let handle = (end - start) / 4.0;
    [(start, from), (start + handle, from), (end - handle, to), (end, to)]
}

/// The ticks of a frame, with any number of octaves: each in order and where it should be.
fn judge_ticks(curve: &Curve, n: u32, hz: u32) {
    let exact = Exact::new(curve);
    let frames: [Vec<u32>; 3] = [
        shutter::<8>(curve).trigger_ticks(n, hz).unwrap().collect(),
        shutter::<4>(curve).trigger_ticks(n, hz).unwrap().collect(),
        shutter::<16>(curve).trigger_ticks(n, hz).unwrap().collect(),
    ];
    for ticks in frames {
        assert!(ticks.is_sorted(), "{ticks:?}");
        for (i, tick) in (0..n).zip(ticks) {
            let error = tick_error(&exact, tick, [i, n], hz);
            assert!(error <= TICK, "trigger {i} of {n}, {tick}, is {error} ticks off");
        }
    }
}

/// So many neighbours of `x` on either side, and `x`.
fn around(x: f32, neighbours: u32) -> impl Iterator<Item = f32> {
    let first = x.to_bits() - neighbours;
    (first..=first + 2 * neighbours).map(f32::from_bits)
}

/// The inverse at `us`, in order: the right times, none a step back, none with a long search.
fn judge_inverse(curve: &Curve, us: impl Iterator<Item = f32>) {
    let (exact, direct, searched) = (Exact::new(curve), shutter::<8>(curve), shutter::<0>(curve));
    let mut last = [f32::NEG_INFINITY; 2];
    for u in us {
        let times = [direct.inverse_cdf(u), searched.inverse_cdf(u)];
        for (time, last) in times.into_iter().zip(last) {
            let errors = exact.judge(u, time);
            assert!(errors.backward <= BACKWARD, "{time:e} at {u:e}: {errors:?}");
            assert!(time >= last, "back to {time:e} from {last:e} at {u:e}");
        }
        let evaluations = direct.evaluations(u).max(searched.evaluations(u));
        assert!(evaluations <= EVALUATIONS, "{evaluations} evaluations at {u:e}");
        last = times;
    }
}

#[test]
fn a_dip_while_time_stands_still() {
    let dip = [(0.0, 1.0), (3.0, -0.33333328), (0.0, -0.33333328), (3.0, 1.0)];
    judge_inverse(&Curve::shutter(dip, instant(3.0, 1.0)), around(0.5, 40));

    let dip = [(0.0, 0.39811182), (1.0, -0.13270363), (0.0, -0.13270363), (1.0, 0.39811182)];
    let twice = Curve::shutter(dip, dip.map(|(t, f)| (t + 1.0, f)));
    judge_inverse(&twice, around(0.25, 40).chain(around(0.75, 40)));

    let dip = [(0.0, 0.9471645), (1.0, -0.31572148), (0.0, -0.31572148), (1.0, 0.9471645)];
    let curve = shutter::<8>(&Curve::shutter(dip, instant(1.0, 1.0)));
    assert!(curve.trigger_ticks(1, 10_000_000).unwrap().eq([5_000_000]));
}

#[test]
fn a_plateau_from_zero_to_minus_zero() {
    let third = 1.0 / 3.0;
    let closing =
        |start: f32| [(start, 1.0), (third, 2.0 * third), (2.0 * third, third), (1.0, 0.0)];
    for [open, close] in [[0.0, -0.0], [-0.0, 0.0], [-0.0, -0.0], [0.0, 0.0]] {
        let curve = Curve::shutter(instant(open, 1.0), closing(close));
        let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
        assert!(exact.near(0.1).cdf_ulp(ours.cdf(0.1), 0.0) <= 1.0, "{}", ours.cdf(0.1));
        assert!((ours.inverse_cdf(0.25) - 0.1339746).abs() < 1e-7, "{}", ours.inverse_cdf(0.25));
        judge_inverse(&curve, around(0.25, 40));
    }
}

#[test]
fn a_plateau_of_1e_36_and_no_other_light() {
    let closing = [(1e-36, 0.0), (0.3, 0.0), (0.6, 0.0), (1.0, 0.0)];
    let curve = Curve::shutter(instant(0.0, 0.0), closing);
    judge_inverse(&curve, [1e-45, 1e-44, 1e-43, 1e-42, 1e-41, 1e-40, 1e-38, 1e-30].into_iter());
}

#[test]
fn the_cdf_beside_an_inner_end_at_time_0() {
    let opening = [(-0.25, 0.0), (-0.16, 0.0), (-0.09, 1.0), (0.0, 1.0)];
    let closing = [(0.0, 1.0), (0.095, 1.0), (0.155, 0.0), (0.25, 0.0)];
    let curve = Curve::shutter(opening, closing);
    for (scale, times) in
        [(1.0, [1e-45, 1e-38]), (4e7, [1e-45, 4e-31]), (2f32.powi(65), [1e-38, 2e-19])]
    {
        let scaled = |points: Points| points.map(|(t, f)| (scale * t, f));
        let curve = Curve::shutter(scaled(curve.opening), scaled(curve.closing));
        let exact = Exact::new(&curve);
        let ramp = shutter::<8>(&Curve::single(curve.opening));
        for t in times {
            for t in [-t, t] {
                let cdf = shutter::<8>(&curve).cdf(t);
                assert!(
                    exact.near(t).cdf_ulp(cdf, 0.0) <= 1.0,
                    "cdf({t:e}) = {cdf} with times of {scale}"
                );
            }
            assert_eq!(ramp.cdf(-t), 1.0, "at {:e} with times of {scale}", -t);
        }
    }
}

#[test]
fn a_minimum_within_a_millionth_of_the_end() {
    let opening = [
        (0.0, 4.267577e-13),
        (0.33333334, -4.3551086e-7),
        (0.6666667, 0.33333245),
        (1.0, 0.9999987),
    ];
    judge_inverse(&Curve::shutter(opening, instant(1.0, 1.0)), around(2.7878835e-19, 400));
}

#[test]
fn curves_that_graze() {
    let opening = [
        (0.0, 0.9999998),
        (0.0013366778, 0.5084915),
        (0.0026733556, 0.0013091149),
        (0.03123285, 0.0013231464),
    ];
    let closing = [
        (0.054455247, 1.0022207e-7),
        (0.054456588, 1.00237e-7),
        (0.0397689, 5.5676655e-6),
        (160.5523, 0.9999998),
    ];
    judge_inverse(&Curve::shutter(opening, closing), around(3.51307e-4, 400));
}

fn soft_like() -> Curve {
    Curve::shutter(
        [(0.0, 0.0), (0.2, 0.0), (0.25, 0.4), (0.3, 1.0)],
        [(0.6, 1.0), (0.65, 0.4), (0.7, 0.0), (1.0, 0.0)],
    )
}

#[test]
fn late_ticks_where_hardly_any_light_precedes_the_closing_ramp() {
    let opening = [(0.0, 0.0), (3e-5, 0.3), (6e-5, 0.6), (1e-4, 1.0)];
    let closing = [(1e-4, 1.0), (0.33, 0.0), (0.66, 0.0), (1.0, 0.0)];
    let curve = Curve::shutter(opening, closing);
    let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
    for (n, hz) in [(1 << 20, 1 << 31), (1 << 22, 1 << 31), (1 << 22, 1 << 24)] {
        let first = n - 2000;
        let ticks = ours.trigger_ticks(n, hz).unwrap().skip(first as usize);
        for (i, tick) in (first..).zip(ticks) {
            let error = tick_error(&exact, tick, [i, n], hz);
            assert!(error <= TICK, "trigger {i} of {n} at {hz} Hz is {error} ticks off");
        }
    }
}

#[test]
fn searches_that_lost_their_way() {
    let opening = [
        (-2.71683e-7, 0.00017516818),
        (1.0039916e-5, 5.818074e-6),
        (7.07793e-6, 4.9936727e-5),
        (3.3364995e-5, 0.46133545),
    ];
    let closing = [
        (3.3365028e-5, 0.25172412),
        (3.343443e-5, -0.01441935),
        (0.5748188, 0.0006186791),
        (0.5748188, 2.7659848e-7),
    ];
    judge_inverse(&Curve::shutter(opening, closing), around(0.9999961, 60));

    let opening =
        [(-4e-45, 0.15040798), (-1e-45, 0.019838786), (-3e-45, 0.14087537), (-0.0, 0.020776268)];
    let closing = [
        (4e-45, 0.9997022),
        (0.26292956, -0.11040781),
        (0.22830494, 0.009214157),
        (0.24204205, 3.8321763e-5),
    ];
    judge_inverse(&Curve::shutter(opening, closing), around(0.99998724, 200));
}

#[test]
fn values_at_time_0_where_time_stands_still() {
    let opening = [(-1.0, 0.0), (1.0, 0.0), (-1.0, 1.0), (1.0, 1.0)];
    let closing = [(1.0, 1.0), (1.25, 1.0), (1.5, 0.0), (2.0, 0.0)];
    let curve = Curve::shutter(opening, closing);
    let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
    let times = [-1e-7, -1e-18, -1e-38, -1e-45, -0.0, 0.0, 1e-45, 1e-38, 1e-18, 1e-7];
    for t in times {
        let (opening, pdf) = (ours.openness(t), ours.pdf(t));
        let near = exact.near(t);
        assert!(near.openness_ulp(opening) <= 1.0, "opening({t:e}) = {opening}");
        assert!(near.pdf_ulp(pdf) <= 1.0, "pdf({t:e}) = {pdf}");
    }
    assert!(times.map(|t| ours.openness(t)).is_sorted());
    assert_eq!([-0.0, 0.0].map(|t| ours.openness(t)), [0.5; 2]);
}

#[test]
fn more_triggers_than_f32_has_fractions() {
    let curve = soft_like();
    let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
    for n in [1u32 << 24, (1 << 24) + 1, 1 << 26] {
        let times: Vec<f32> = ours.trigger_times(n).skip(n as usize - 1000).collect();
        assert_eq!(times.len(), 1000);
        assert!(times.is_sorted());
        for (i, t) in (n - 1000..n).zip(times) {
            let u = (2.0 * f64::from(i) + 1.0) / (2.0 * f64::from(n));
            let off = (exact.cdf(t) - Dd::from(u)).hi.abs();
            // Two ulp of u: 2i + 1 is rounded, and so is its share. There is next to no light here, so that the rounding of
            // t is none of it.
            assert!(off <= exp2(-23), "trigger {i} of {n}: the cdf is {off:e} off");
        }
    }
}

#[test]
fn a_gap_too_small_tells_its_numbers() {
    let text = ScheduleError::GapTooSmall { trigger: 17, gap: 815, min_gap: 4711 }.to_string();
    for number in ["17", "815", "4711"] {
        assert!(text.contains(number), "{text}");
    }
}

// Found by an attack on 0.2.0 before it was released.

#[test]
fn the_cdf_on_either_side_of_half() {
    let curve = Curve::shutter(
        [
            (-0.7629831, 0.31652436),
            (-0.4296497, 0.082664944),
            (-0.09631639, -0.08190364),
            (0.23701695, 0.042908728),
        ],
        [
            (0.32037073, 0.50004053),
            (0.3203911, 0.50004053),
            (0.3204114, 0.50004053),
            (0.32043177, 0.50004053),
        ],
    );
    let curve = shutter::<8>(&curve);
    let values = around(1.4723837e-4, 100).map(|t| curve.cdf(t));
    assert!(values.is_sorted());
}

#[test]
fn ticks_where_a_search_hands_over_to_the_line() {
    let opening = [(0.0, 0.0), (0.3, 0.0), (0.6, 0.0), (1.0, 0.0)];
    let curve = shutter::<8>(&Curve::shutter(opening, instant(1.0008758, 1.0)));
    assert!(curve.trigger_ticks(4_193_403, 8_479_616).unwrap().take(9000).is_sorted());
}

#[test]
fn ticks_many_lengths_from_time_0() {
    let curve = Curve::shutter(
        [(16.0, 0.23115787), (16.069315, 0.9636907), (16.188118, 0.94166076), (16.204382, 0.70933)],
        [
            (16.204382, 0.23798369),
            (16.933697, 0.4028296),
            (16.949995, 0.9828322),
            (17.0, 0.09975028),
        ],
    );
    let exact = Exact::new(&curve);
    for n in 1..200 {
        for (i, tick) in shutter::<8>(&curve).trigger_ticks(n, 16_777_215).unwrap().enumerate() {
            let error = tick_error(&exact, tick, [i as u32, n], 16_777_215);
            assert!(error <= TICK, "trigger {i} of {n} is {error} ticks off");
        }
    }
}

#[test]
fn subnormal_times() {
    let closing =
        [(2.6020853e-19, 1.0), (4.3368087e-19, 0.7), (6.938894e-19, 0.3), (8.6736174e-19, 0.0)];
    let curve = Curve::shutter(instant(-1.1912527e-38, 1.0), closing);
    judge_inverse(&curve, around(3.4428106e-22, 1000));
}

#[test]
fn a_tiny_near_ramp_with_many_octaves() {
    let opening = [
        (-6.934739e-10, 0.5538806),
        (-4.6231594e-10, 0.5538806),
        (-2.3115797e-10, 0.5538806),
        (0.0, 0.5538806),
    ];
    let closing = [(0.052208774, 1.0), (0.38550878, 0.66), (0.7188688, 0.33), (1.0522088, 0.0)];
    let curve = Curve::shutter(opening, closing);
    let (exact, ours) = (Exact::new(&curve), shutter::<64>(&curve));
    let mut last = f32::NEG_INFINITY;
    for i in 0..2000 {
        let u = 2e-10 * 1.002f32.powi(i);
        let t = ours.inverse_cdf(u);
        assert!(t >= last && exact.judge(u, t).backward <= BACKWARD, "{t:e} at {u:e}");
        last = t;
    }
}

/// Where the second half of a product of pairs was taken for less than it is: up to 30 ticks late.
#[test]
fn the_last_ticks_of_an_interval_of_2_to_the_31() {
    let opening = [(-1.0, 0.0), (-1.0, 1.472065e-5), (-1.0, 1.768388e-5), (0.0, 1.0)];
    let curve = Curve::shutter(opening, instant(0.16237123, 1.0));
    let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
    let (n, hz) = (1 << 22, 1_847_502_402);
    for (i, tick) in (0..n).zip(ours.trigger_ticks(n, hz).unwrap()).rev().take(30) {
        let error = tick_error(&exact, tick, [i, n], hz);
        assert!(error <= TICK, "trigger {i} is {error} ticks off");
    }
}

#[test]
fn a_tent_is_answered_without_a_search() {
    for p in [0.3625, 0.4, 0.45, 0.6] {
        let curve = ShutterCurve::linear(0.0, p, p, 1.0).unwrap();
        for i in 10..990 {
            let u = i as f32 / 1000.0;
            assert_eq!(curve.evaluations(u), 0, "{u} of {p}");
        }
    }
}

/// The middles of the shares of up to 64 triggers, on every typical curve.
#[test]
fn no_typical_frame_is_searched_for() {
    use support::curves::{Kind, named};
    for one in named().into_iter().filter(|one| one.kind == Kind::Typical) {
        let curve = shutter::<8>(&one.curve);
        for n in 1..=64 {
            for i in 0..n {
                let u = (i as f32 + 0.5) / n as f32;
                assert_eq!(curve.evaluations(u), 0, "{i} of {n} on {}", one.name);
            }
        }
    }
}

// Found after 0.2.0, by inputs that no family of the tests had.

/// Whole milliseconds, and joins at 5/8 and 9/16 of the exposure: there an octave's polynomial was evaluated at its other end.
#[test]
fn joins_at_plain_fractions() {
    let closing = quarters([1.0, 0.0], 1.0, 7.0);
    judge_ticks(&Curve::shutter(instant(0.0, 1.0), closing), 2, 1000);
    let ticks = |curve: &Curve, n| -> Vec<u32> {
        shutter::<8>(curve).trigger_ticks(n, 1000).unwrap().collect()
    };
    assert_eq!(ticks(&Curve::shutter(instant(0.0, 1.0), closing), 2)[0], 1000);

    let opening = quarters([0.0, 1.0], 0.0, 10.0);
    let curve = Curve::shutter(opening, quarters([1.0, 0.0], 10.0, 16.0));
    judge_inverse(&curve, around(0.625, 400));
    assert_eq!(shutter::<8>(&curve).inverse_cdf(0.625), 10.0);
    let curve = Curve::shutter(opening, instant(13.0, 1.0));
    judge_ticks(&curve, 4, 1000);
    assert_eq!(ticks(&curve, 4)[2], 10_000);

    // Every join at k/16 and k/32, from either side, with a plateau behind it and without.
    for all in [16u8, 32] {
        for part in 1..all {
            let [part, rest] = [part, all - part].map(f32::from);
            let opening = quarters([0.0, 1.0], 0.0, 2.0 * part);
            for open in [0.0, 0.5 * rest, rest] {
                let start = 2.0 * part + open;
                let closing = quarters([1.0, 0.0], start, start + 2.0 * (rest - open));
                let curve = Curve::shutter(opening, closing);
                for curve in [curve, curve.mirrored()] {
                    let share = part / f32::from(all);
                    judge_inverse(&curve, around(share, 40));
                    judge_inverse(&curve, around(1.0 - share, 40));
                    for n in [2, 4, 8, 16] {
                        judge_ticks(&curve, n, 1000);
                    }
                }
            }
        }
    }
}

/// The same where a join is within some 2⁻³³ of 3/8 and 7/16: a pulse went on before the last one was off.
#[test]
fn pulses_next_to_plain_fractions() {
    let opening = by_bits([
        (0x46d8_10ac, 0x39dd_03f2),
        (0x46d8_126a, 0x3e4e_e51c),
        (0x46d8_10ff, 0x3f7f_f972),
        (0x46d8_12cc, 0x370c_1c25),
    ]);
    let closing = by_bits([(0x46d8_12cc, 0), (0x46d8_155b, 0), (0x46d8_1539, 0), (0x46d8_15f5, 0)]);
    let curve = Curve::shutter(opening, closing);
    let (exact, n, duty, hz) = (Exact::new(&curve), 12, f32::from_bits(0x317f_df45), 6_348_806);
    let pulses: Vec<Pulse> = shutter::<8>(&curve).pulse_ticks(n, duty, hz).unwrap().collect();
    assert!(pulses.iter().all(|pulse| pulse.on <= pulse.off), "{pulses:?}");
    assert!(pulses.windows(2).all(|pair| pair[0].off <= pair[1].on), "{pulses:?}");
    for (i, Pulse { on, off }) in pulses.into_iter().enumerate() {
        for (tick, half) in [(on, -0.5), (off, 0.5)] {
            let u = Dd::from(i as f64 + 0.5) + Dd::from(half * f64::from(duty));
            let error = tick_error_at(&exact, tick, u / Dd::from(f64::from(n)), hz, EDGE_ULP);
            assert!(error <= TICK, "an end of pulse {i}, {tick}, is {error} ticks off");
        }
    }
}

/// Where t' touches 0 inside an octave and f is nearly flat, a polynomial's error between its peaks was up to twice that
/// at them.
#[test]
fn ticks_at_a_kink_inside_an_octave() {
    let opening = by_bits([
        (0x454e_7000, 0x3f7f_eee9),
        (0x4585_4000, 0x3f7f_dc77),
        (0x4546_b000, 0x3f7f_f2f1),
        (0x4589_a000, 0x3f7f_fc8c),
    ]);
    let curve = Curve::shutter(opening, instant(4404.0, 1.0));
    judge_ticks(&curve, 89, 15_104);
    judge_ticks(&curve, 272, 15_056);
}

/// A far octave below the least top was not counted, so the near ramp's polynomial answered for it.
#[test]
fn a_near_share_at_the_least_top() {
    let opening = by_bits([
        (0xb1cc_b2e1, 0x39fc_890e),
        (0xb188_7740, 0x382a_ba1b),
        (0xb108_7740, 0x3353_ae5e),
        (0, 0x3f7f_f972),
    ]);
    let closing = by_bits([
        (0, 0x3f7f_f972),
        (0x3e5d_84f2, 0x3de8_2b34),
        (0xbebb_2c4e, 0x3e91_4b1b),
        (0x3f99_8fe6, 0x3f1c_ad1d),
    ]);
    let curve = Curve::shutter(opening, closing);
    let exact = Exact::new(&curve);
    let join = exact.landmarks()[0].to_f32();
    let ours = shutter::<64>(&curve);
    let mut last = f32::NEG_INFINITY;
    let beyond = (1..4000).map(|i| join * 1.001f32.powi(i)).skip(1);
    for u in around(join, 400).chain(beyond) {
        let t = ours.inverse_cdf(u);
        let errors = exact.judge(u, t);
        assert!(errors.backward <= BACKWARD, "{t:e} at {u:e}: {errors:?}");
        assert!(t >= last, "back to {t:e} from {last:e} at {u:e}");
        last = t;
    }
}

/// Where the opening ramp has exactly half of the light and a plateau follows, the trigger of a frame of one was searched
/// for: ticks count 1/2 from the later end, from where neither an octave nor the plateau's line held it.
#[test]
fn one_trigger_at_a_join_of_one_half() {
    let opening = quarters([0.0, 1.0], 0.0, 4.0);
    for (open, closes) in [(1.0, 2.0), (2.0, 0.0), (0.5, 3.0)] {
        let closing = quarters([1.0, 0.0], 4.0 + open, 4.0 + open + closes);
        let curve = Curve::shutter(opening, closing);
        for curve in [curve, curve.mirrored()] {
            let ours = shutter::<8>(&curve);
            assert!(ours.direct_triggers() >= 64, "{}", ours.direct_triggers());
            for n in 1..=ours.direct_triggers() {
                let frame = ours.trigger_ticks(n, 1000).unwrap();
                for i in 0..n {
                    assert!(frame.is_direct(i), "{i} of {n}, {open}, {closes}");
                }
            }
        }
    }
}

/// The near ramp ends less than an ulp of an `f32` above a possible top, which was then its top. What ticks count in
/// between, up to the join, found the far ramp's last octave instead, which may serve quite other fractions.
#[test]
fn pulses_between_a_top_and_a_join() {
    fn judge<const OCTAVES: usize>() {
        // The opening ramp has 1/2 to 1/1024 of the light, and some 2⁻²⁵ of that more.
        for k in 1..=10 {
            let closes = 2.0 * exp2(k) as f32 - 2.0;
            let mut opening = quarters([0.0, 1.0], -2.0, 0.0);
            opening[0].1 = exp2(-24) as f32;
            let curve = Curve::shutter(opening, quarters([1.0, 0.0], 0.0, closes));
            for (curve, is_back) in [(curve, false), (curve.mirrored(), true)] {
                let (exact, ours) = (Exact::new(&curve), shutter::<OCTAVES>(&curve));
                let (n, hz) = (1 << (k - 1), 4000);
                let first = if is_back { n - 1 } else { 0 };
                for duty in (20..40).map(|k| exp2(-k)) {
                    let mut pulses = ours.pulse_ticks(n, duty as f32, hz).unwrap();
                    let Pulse { on, off } = pulses.nth(first as usize).unwrap();
                    for (tick, half) in [(on, -0.5), (off, 0.5)] {
                        let u = Dd::from(f64::from(first) + 0.5) + Dd::from(half * duty);
                        let error =
                            tick_error_at(&exact, tick, u / Dd::from(f64::from(n)), hz, EDGE_ULP);
                        let at = || format!("2^-{k}, {OCTAVES} octaves, {duty:e}, {is_back}");
                        assert!(error <= TICK, "{}: {error} ticks off", at());
                    }
                }
            }
        }
    }
    judge::<8>();
    judge::<4>();
    judge::<3>();
    judge::<2>();
    judge::<1>();
}

/// Two plain S ramps, each with handles of a quarter: the most typical curve that there is, and more than 0.6 ulp of its
/// time wrong where an octave's polynomial was.
#[test]
fn the_forward_error_of_plain_ramps() {
    let instant = instant(0.0, 1.0);
    let ramp = quarters([0.0, 1.0], 0.0, 10.0);
    for (curve, u) in [
        (Curve::shutter(ramp, quarters([1.0, 0.0], 10.0, 20.0)), 10.0 / 39.0),
        (Curve::shutter(instant, [(1.0, 1.0), (7.0, 0.33333334), (13.0, 0.0), (19.0, 0.0)]), 0.5),
    ] {
        let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
        for u in around(u, 20_000) {
            let errors = exact.judge(u, ours.inverse_cdf(u));
            assert!(errors.forward <= FORWARD, "{u}: {errors:?}");
        }
    }
}

/// Decimal fractions of the interval, with an inner point at its ramp's inner end: rounding puts it an ulp beyond, which
/// was refused as a time that turns back.
#[test]
fn inner_points_at_the_inner_ends_are_accepted() {
    let mut refused = Vec::new();
    for (length, decimals) in
        [(0.1, 3), (0.01, 4), (1.0, 2), (10.0, 1), (100.0, 0), (0.02, 4), (2.13, 2), (8.1, 1)]
    {
        // As a person writes it, and a program reads it.
        let read = |x: f64, decimals| -> f32 { format!("{x:.decimals$}").parse().unwrap() };
        for (open, close) in (1..100).flat_map(|i| (i..100).step_by(3).map(move |k| (i, k))) {
            let parts = [open, close].map(|part| f64::from(part) / 100.0);
            let [open, close] = parts.map(|part| read(part, 2));
            for start in [0.0, -2.0 * length, length] {
                let [opened, closes] = parts.map(|part| read(start + length * part, decimals + 2));
                let times = [read(start, decimals), opened, closes, read(start + length, decimals)];
                for inner in [
                    [0.0, 0.0, open, 1.0, close, 1.0, 1.0, 0.0],
                    [open, 0.0, open, 1.0, close, 1.0, close, 0.0],
                ] {
                    let curve = ShutterCurve::shutteropening(times, inner);
                    refused.extend(curve.err().map(|error| (error, times, inner)));
                }
            }
        }
    }
    assert!(refused.is_empty(), "{}, as {:?}", refused.len(), refused[0]);
}

/// Lifting t' moved times by 140 · 2⁻²² of the ramp where it may move them by half of 2⁻²².
#[test]
fn lifted_times_stay_where_they_were() {
    let times = [0, 0x347de048, 0xba132015, 0x3f7fdb38].map(f32::from_bits);
    for f in [[0.0, 0.0, 1.0, 1.0], [0.0, 0.5, 0.75, 1.0], [1.0, 0.25, 0.25, 0.0]] {
        let opening = std::array::from_fn(|i| (times[i], f[i]));
        let curve = Curve::shutter(opening, instant(times[3], 1.0));
        judge_inverse(&curve, (1..1000).map(|i| i as f32 / 1000.0));
        let (as_given, ours) = (Exact::as_given(&curve), shutter::<8>(&curve));
        for i in 1..1000 {
            // A time of the curve that was asked for, and what it has within half of 2⁻²² of the ramp and an ulp.
            let p = f64::from(i) / 1000.0;
            let blend = |[a, b, c, d]: [f32; 4]| {
                let r = 1.0 - p;
                let [a, b, c, d] = [a, b, c, d].map(f64::from);
                r * r * r * a + 3.0 * r * r * p * b + 3.0 * r * p * p * c + p * p * p * d
            };
            let (t, openness) = (blend(times), f64::from(ours.openness(blend(times) as f32)));
            let reach = f64::from(times[3]) * exp2(-23) + exp2(-24);
            let near = [t - reach, t + reach]
                .map(|t| Dd::from(t.clamp(0.0, f64::from(times[3]))))
                .map(|t| as_given.openness_dd(t).hi);
            let [low, high] = [near[0].min(near[1]), near[0].max(near[1])];
            let ulp = exp2(-24);
            assert!(
                openness >= low - ulp && openness <= high + ulp,
                "{openness} at {t}, outside {low} to {high}: {f:?}"
            );
        }
    }
}

/// A dip below 0 at the start moved the openness at the other end, which joins the plateau, to more than 1.
#[test]
fn a_lifted_opening_joins_the_plateau() {
    let faint = -exp2(-23) as f32;
    let inside = [1.0 / 9.0, (-5.0f32 / 27.0).next_down(), 1.0 / 9.0, 1.0];
    for f in [[faint, 0.25, 0.75, 1.0], [faint, 0.0, 1.0, 1.0], inside] {
        let [a, b, c, d] = f;
        let opening = [(0.0, a), (0.3, b), (0.7, c), (1.0, d)];
        let curve = Curve::shutter(opening, instant(1.0, 1.0));
        let lifted = Lifted::new(curve.opening);
        assert!(lifted.is_lifted, "{f:?}");
        assert_eq!(lifted.openness[3], 1.0, "{f:?}");
        judge_inverse(&curve, around(0.5, 40).chain(around(0.999999, 8)));
        let at_end = shutter::<8>(&Curve::single(opening)).openness(1.0);
        assert!((at_end - 1.0).abs() <= 1.5 * f32::EPSILON, "{at_end}: {f:?}");
    }
}

/// A division before its scaling had a subnormal quotient, whose products lose all they have.
#[test]
fn the_cdf_on_a_plateau_at_subnormal_times() {
    let bits = |points: [[u32; 2]; 4]| points.map(|[t, f]| (f32::from_bits(t), f32::from_bits(f)));
    let opening = bits([[0xbe2f69c6, 0], [0xbcad511c, 1], [0xbe19bfa2, 0], [0, 1]]);
    let closing = bits([
        [1, 0x3e9fe97f],
        [0x3ed21182, 0x3e5f3099],
        [0x3ea4153a, 0xb8f2e130],
        [0x3edddf78, 0x3d04d40f],
    ]);
    let curve = Curve::shutter(opening, closing);
    let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
    let values = [0, 1, 2, 3, 4, 5].map(|bits| ours.cdf(f32::from_bits(bits)));
    assert!(values.is_sorted(), "{values:?}");
    for (bits, value) in values.into_iter().enumerate() {
        let t = f32::from_bits(bits as u32);
        assert!(exact.near(t).cdf_ulp(value, 0.0) <= VALUE, "{value:e} at {t:e}");
    }
}

/// A sum of which rounding saw the wrong sign was rounded twice: the time between two right ones stepped back.
#[test]
fn a_ramp_that_ends_a_subnormal_step_before_0() {
    let opening =
        [(-1.2298783e-38, 0.0), (-4.6e-44, 0.24176656), (-4.6e-44, 0.6375081), (-1e-45, 1.0)];
    judge_inverse(&Curve::shutter(opening, instant(1.1641532e-10, 1.0)), around(2.3047462e-29, 40));
}

/// The last pulse of a full duty ends with the curve, also after a dark ramp; with 27 pulses it ended 250 s before.
#[test]
fn the_last_full_pulse_ends_with_the_curve() {
    let dark = |from: f32, to: f32| [(from, 0.0), (from, 0.0), (to, 0.0), (to, 0.0)];
    let curve = shutter::<8>(&Curve::shutter(dark(0.0, 1000.0), dark(2000.0, 252_000.0)));
    for n in 1..100 {
        let Pulse { off, .. } = curve.pulse_ticks(n, 1.0, 1).unwrap().next_back().unwrap();
        assert_eq!(off, 252_000, "of {n}");
    }
}

/// A search next to the dark inner end of a ramp ended beyond that end, and the tick was hundreds too late.
#[test]
fn no_trigger_is_beyond_its_ramp() {
    const LATE_DIP: [(f32, f32); 4] =
        [(0.0, 0.9), (0.06622612, -0.3036056), (-0.21775882, 0.07681351), (1.0, 1.7496717e-7)];
    const DARK_END: [(f32, f32); 4] =
        [(0.0, 0.9), (0.07204671, -0.28748026), (-0.22503921, 0.06887071), (1.0, 7.605897e-8)];
    const TO_ZERO: [(f32, f32); 4] =
        [(-1.0, 0.9), (-0.9279533, -0.2874707), (-1.2250392, 0.068869285), (0.0, 7.605897e-8)];
    const TO_ZERO_TOO: [(f32, f32); 4] =
        [(-1.0, 0.9), (-0.9279533, -0.28746474), (-1.2250392, 0.06887321), (0.0, 7.605897e-8)];
    /// A mass next to a dip, measured as a sum of terms 577 times as great.
    const NEXT_TO_DIP: [(f32, f32); 4] =
        [(0.0, 0.0), (0.55103207, 2.441999), (-0.29308096, -0.4703094), (1.0, 0.0679332)];

    // The opening, where the shutter is closed at once, the triggers, the ticks in a second, the trigger that was late.
    let frames: [(_, f32, u32, u32, u32); 6] = [
        (LATE_DIP, 1.0202826, 3_327_964, 16_443_694, 1_658_143),
        (LATE_DIP, 1.0202826, 4_116_136, 2_104_792_917, 2_050_846),
        (DARK_END, 1.0402455, 2_289_871, 16_128_130, 774_551),
        (TO_ZERO, 0.020572096, 1, 2_104_195_716, 0),
        (TO_ZERO_TOO, 0.034289874, 4, 2_076_287_786, 1),
        (NEXT_TO_DIP, 1.547705, 4_163_321, 1_387_527_707, 1_037_105),
    ];
    let frames = frames
        .map(|(points, end, n, hz, at)| (Curve::shutter(points, instant(end, 1.0)), n, hz, at));
    for (curve, n, hz, at) in frames {
        let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
        let frame = ours.trigger_ticks(n, hz).unwrap();
        let near = at.saturating_sub(200)..n.min(at + 200);
        let ticks: Vec<u32> =
            near.clone().map(|i| frame.clone().nth(i as usize).unwrap()).collect();
        assert!(ticks.is_sorted(), "{ticks:?}");
        for (i, tick) in near.zip(ticks) {
            let error = tick_error(&exact, tick, [i, n], hz);
            assert!(error <= TICK, "trigger {i} of {n} at {tick}: {error}");
        }
    }
    let (curve, n, hz, _) = frames[2];
    let ours = shutter::<8>(&curve);
    ours.schedule_into(&mut vec![0; n as usize], hz, 0).unwrap();
    assert_eq!(ours.most_triggers(n, hz, 0), Ok(n));
    let pulses = ours.pulse_ticks(4_190_000, 0.5, 2_064_400_737).unwrap();
    let pulses: Vec<Pulse> = pulses.skip(1_417_240).take(200).collect();
    assert!(pulses.is_sorted_by(|a, b| a.off <= b.on), "{pulses:?}");
}

/// Where a ramp is measured from its other end, the noise changes: the last time before was settled by the inverse, the
/// next one by its own mass, which was within the noise of the inverse.
#[test]
fn the_cdf_where_a_ramp_changes_ends() {
    let ramp = |points: [(f32, f32); 4], end: f32| Curve::shutter(points, instant(end, 1.0));
    let cases = [
        (
            ramp(
                [
                    (0.7781116, 0.990099),
                    (0.9402255, -0.12617572),
                    (0.5329293, 0.012059636),
                    (1.5562232, 0.0),
                ],
                1.6831726,
            ),
            1.1671674f32,
        ),
        (
            ramp(
                [
                    (0.9951655, 0.990099),
                    (1.0856684, -0.13246524),
                    (0.7507236, 0.013291884),
                    (1.990331, 0.0),
                ],
                2.070436,
            ),
            1.4927484,
        ),
        (
            ramp(
                [
                    (-0.88865644, 0.990099),
                    (-0.76812714, -0.12795477),
                    (-1.138575, 0.012402111),
                    (0.0, 0.0),
                ],
                0.039733905,
            ),
            -0.4443282,
        ),
    ];
    for (curve, t) in cases {
        let ours = shutter::<8>(&curve);
        let first = t.to_bits() - 2000;
        let mut ts: Vec<f32> = (first..first + 4000).map(f32::from_bits).collect();
        ts.sort_by(f32::total_cmp);
        let values: Vec<f32> = ts.iter().map(|t| ours.cdf(*t)).collect();
        assert!(values.is_sorted(), "{curve:?}");
    }
}

/// In a dip the openness is what is left of terms 27 times as great as the greatest openness.
#[test]
fn the_openness_in_a_deep_dip() {
    let cases = [
        ([(0.0, 0.0), (0.0, 2.3838537), (0.0, -1.4847157), (1.0, 0.6935348)], 0.4433879f32),
        (
            [
                (0.0, 5.179933e-7),
                (0.28752717, 1.559024),
                (-0.0058819656, -1.1125908),
                (1.0, 0.595498),
            ],
            0.44178855,
        ),
    ];
    for (points, t) in cases {
        let curve = Curve::shutter(points, instant(2.0, 1.0));
        let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
        for t in around(t, 200) {
            let error = exact.near(t).openness_ulp(ours.openness(t));
            assert!(error <= VALUE, "{error} at {t:e}");
        }
    }
}
