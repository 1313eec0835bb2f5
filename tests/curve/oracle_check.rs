//! Holds the oracle against values from elsewhere, against closed forms and against itself.

use crate::support::curves::named;
use crate::support::families::{random_density, random_hard};
use crate::support::oracle::{Curve, Dd, Exact, exp2, rounding_cell, ulp_f32};
use crate::support::questions::hard_us;
use crate::support::times;

#[test]
fn the_reference_values_are_met() {
    let curves: Vec<_> =
        ["typical", "hard"].into_iter().flat_map(named).map(|c| (c.name, Exact::new(&c.curve))).collect();
    let (mut rows, mut worst, mut worst_pdf) = (0, 0f64, 0f64);
    for line in include_str!("../data/inverse_cdf.csv").lines().skip(1) {
        let mut cells = line.split(',');
        let name = cells.next().unwrap();
        let u: f32 = cells.next().unwrap().parse().unwrap();
        let [t, t_low, pdf] = [(); 3].map(|_| cells.next().unwrap().parse::<f64>().unwrap());
        let (_, exact) = curves.iter().find(|c| c.0 == name).expect("a curve of curves.csv");
        let time = exact.inverse_cdf(u);
        let off = (time - (Dd::from(t) + Dd::from(t_low))).hi.abs() / ulp_f32(t);
        assert!(off < 1e-12, "{name}: u = {u:e}, t is {off:e} ulp off");
        let density = exact.pdf(time).hi;
        let off_pdf = if pdf == density { 0.0 } else { (density / pdf - 1.0).abs() };
        assert!(off_pdf < 1e-9, "{name}: u = {u:e}, pdf {density:e} for {pdf:e}");
        (rows, worst, worst_pdf) = (rows + 1, worst.max(off), worst_pdf.max(off_pdf));
    }
    println!("{rows} values: t within {worst:.1e} ulp of f32, pdf within {worst_pdf:.1e}");
    assert_eq!(rows, 700);
}

/// Openness as a power of time, along paths of order 1 to 6.
#[test]
fn powers_have_a_closed_form() {
    // t = 3p, f = p³: u = (t/3)⁴.
    let quartic = Exact::new(&Curve::single([(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0)]));
    // t = p³, f = p³ in some scale: u = t².
    let square = Exact::new(&Curve::single([(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (1.0, 1e-30)]));
    // t = 3p² - 2p³, f = 1, from an offset: u = (t - 7) / 2.
    let even = Exact::new(&Curve::single([(7.0, 1.0), (7.0, 1.0), (9.0, 1.0), (9.0, 1.0)]));
    let fourth = |x: Dd| x * x * x * x;
    for u in hard_us(&quartic, 2, 4000) {
        let [four, two, one] = [&quartic, &square, &even].map(|exact| exact.inverse_cdf(u));
        for found in [fourth(four / 3.0), two * two, (one - 7.0) / 2.0] {
            let off = if u == 0.0 { found.hi } else { (found / u - 1.0).hi.abs() };
            assert!(off < 4e-29, "u = {u:e}: {found:?}");
        }
    }
}

/// The cdf just before and just after the time must enclose u: a test with no condition number in it.
#[test]
fn the_cdf_undoes_its_inverse() {
    let mut checked = 0u32;
    let hard = (0..240 * times()).map(|i| random_hard(1, i));
    for (i, curve) in hard.chain((0..60 * times()).map(|i| random_density(1, i))).enumerate() {
        let exact = Exact::new(&curve);
        for u in hard_us(&exact, i as u64, 32) {
            let time = exact.inverse_cdf(u);
            if u == 0.0 || u == 1.0 {
                let end = if u == 0.0 { curve.open_start() } else { curve.close_end() };
                assert_eq!(time, Dd::from(end));
                continue;
            }
            // A double-double holds a time of this size no better than so.
            let step = Dd::from(time.hi.abs() * exp2(-104));
            // From the nearer end, and relative to it.
            let past = |t| if u < 0.5 { exact.cdf(t) - u } else { Dd::ONE - u - exact.complement_dd(t) };
            let (low, high) = (past(time - step).hi, -past(time + step).hi);
            let slack = 1e-20 * u.min(1.0 - u) as f64;
            assert!(low <= slack && high <= slack, "u = {u:e}, {low:e} {high:e}: {curve:?}");
            checked += 1;
        }
    }
    println!("cdf of inverse_cdf: {checked} within 1e-20");
    assert!(checked > 120_000);
}

#[test]
fn errors_are_measured_in_ulp() {
    assert_eq!(ulp_f32(1.0), exp2(-23));
    assert_eq!(ulp_f32(0.999), exp2(-24));
    assert_eq!(ulp_f32(-6.0), exp2(-21));
    assert_eq!([ulp_f32(0.0), ulp_f32(1e-300), ulp_f32(1e-40)], [exp2(-149); 3]);
    assert_eq!(rounding_cell(1.0), [1.0 - exp2(-25), 1.0 + exp2(-24)]);
    assert_eq!(rounding_cell(0.0), [-exp2(-150), exp2(-150)]);
    // Halfway between two f32 the low part decides.
    let half = 1.0 + exp2(-24);
    for (lo, rounded) in [(-1e-30, 1.0), (0.0, 1.0), (1e-30, 1.0 + f32::EPSILON)] {
        assert_eq!(Dd { hi: half, lo }.to_f32(), rounded);
    }

    // A box from 0 to 1, where t = u.
    let start = [(0.0, 0.0), (0.0, 0.0), (0.0, 1.0), (0.0, 1.0)];
    let exact = Exact::new(&Curve::shutter(start, start.map(|(t, f)| (t + 1.0, 1.0 - f))));
    let judge = |u, t| [exact.judge(u, t).forward, exact.judge(u, t).backward];
    for (u, t, errors) in [
        (0.75, 0.75, [0.0, 0.0]),
        (0.75, 0.75f32.next_up(), [1.0, 0.5]),
        (0.75, 0.75f32.next_down().next_down(), [2.0, 1.5]),
        (1e-40, 1e-40f32.next_up(), [1.0, 0.5]),
        (f32::NAN, 0.0, [0.0, 0.0]),
        (7.0, 1.0, [0.0, 0.0]),
        (0.5, f32::NAN, [f64::INFINITY; 2]),
        (0.5, 1f32.next_up(), [f64::INFINITY; 2]),
        (0.5, -1e-45, [f64::INFINITY; 2]),
    ] {
        assert_eq!(judge(u, t), errors);
    }
    // Across time 0, ulp are those of the greater end.
    let across = Exact::new(&Curve::single([(-1.0, 1.0), (-0.5, 1.0), (0.5, 1.0), (1.0, 1.0)]));
    assert_eq!(across.judge(0.5, exp2(-24) as f32).forward, 0.5);
    // ... but backward they are not: there the rounding of the answer itself is forgiven, and no more.
    assert_eq!(across.judge(0.5, exp2(-40) as f32).backward, exp2(-17) * (1.0 - exp2(-25)));

    // A value is right if it is within reach of 1 ulp of t.
    let identity = |got| exact.near(0.5).cdf_ulp(got, 0.0);
    assert_eq!(identity(0.5 + 0.5 * f32::EPSILON), 0.0);
    assert_eq!(identity(0.5 + 1.5 * f32::EPSILON), 2.0);
    assert_eq!(identity(0.5 - 1.5 * f32::EPSILON), 4.0);
    assert_eq!(exact.near(0.5).cdf_ulp(0.5 - 1.5 * f32::EPSILON, 0.5), 2.0);
    assert_eq!(identity(f32::NAN), f64::INFINITY);
    // Next to time 0 the reach is 2⁻⁵³ of the interval.
    assert_eq!(exact.near(0.0).cdf_ulp(exp2(-53) as f32, 0.0), 0.0);
    assert_eq!(exact.near(0.0).cdf_ulp(1.5 * exp2(-53) as f32, 0.0), exp2(22));
    assert_eq!([exact.near(0.5).openness_ulp(1.0, 0.0), exact.near(2.0).openness_ulp(0.0, 0.0)], [0.0; 2]);
    assert_eq!(exact.near(0.5).openness_ulp(1f32.next_down(), 0.0), 0.5);
    // An ulp is at least a floor.
    let ramp = Exact::new(&Curve::single([(0.0, 0.0), (1.0, 0.0), (2.0, 0.25), (3.0, 0.5)]));
    assert_eq!(ramp.near(0.0).openness_ulp(0.125, 0.125), 1.0);
}
