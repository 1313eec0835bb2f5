//! The integers of the answers, held to 128 bits or to `f64`: each function that a script of `proofs` names.

use crate::fixed::{
    fixed_down, fixed_towards_0, floor_bits, in_2_60, power_of_two, power_of_two_f64, product, product_up, single,
};
use crate::fraction::{Fraction, Side};
use crate::inside::support::curves::{Rng, named};
use crate::inside::support::families::{random_hard, random_typical};
use crate::inside::support::oracle::{Curve, Dd, Exact, ulp_f32};
use crate::inverse::Inverse;
use crate::octave::build::{build, range};
use crate::octave::{Octave, bound, product_high_by_halves, top_at};
use crate::ramp::bezier::CubicBezier;
use crate::rate::Hz;
use crate::search::MAX_STEPS;
use crate::trigger::ticks::TickScale;

/// Numbers of all lengths, and those next to powers of two.
fn numbers(rng: &mut Rng, n: usize) -> Vec<i64> {
    let near = |word: i64| (-2..=2).map(move |more| word.wrapping_add(more));
    let mut numbers: Vec<i64> = (0..64).map(|k| 1i64 << k).flat_map(near).collect();
    numbers.extend((0..n).map(|_| rng.bits() as i64 >> rng.below(64)));
    numbers
}

/// All named curves, random ones, steps and slow ends, and curves across time 0 or far from it.
fn curves() -> Vec<Curve> {
    let named = ["typical", "hard", "exact"].into_iter().flat_map(named).map(|one| one.curve);
    named.chain((0..40).flat_map(|i| [random_typical(41, i), random_hard(41, i)])).collect()
}

fn ramps() -> impl Iterator<Item = [CubicBezier; 2]> {
    curves().into_iter().map(|curve| [curve.opening, curve.closing].map(CubicBezier::new))
}

fn integrated([opening, closing]: &[CubicBezier; 2]) -> crate::curve::Curve {
    crate::curve::Curve::new(opening, closing).expect("a shutter")
}

fn inverses() -> impl Iterator<Item = Inverse<8>> {
    ramps().filter_map(|[opening, closing]| Inverse::new(&opening, &closing).ok())
}

/// Fractions of all sizes up to 1/2.
fn fraction(rng: &mut Rng) -> f32 {
    (0.25 + 0.25 * rng.unit()) as f32 * power_of_two(-(rng.below(24) as i32))
}

#[test]
fn products_of_two_words() {
    let mut rng = Rng::new(90, 0);
    let numbers = numbers(&mut rng, 1000);
    for &a in &numbers {
        for &x in &numbers {
            let [b, y] = [a, x].map(|word| word as i32);
            assert_eq!(product_high_by_halves(b, y), ((b as i64 * y as i64) >> 32) as i32, "{b} * {y}");
            let x = x as u64;
            let exact = a as i128 * x as i128;
            let low = exact - ((product(a, x) as i128) << 64);
            assert!((0..3 << 64).contains(&low), "{a} * {x}");
            for shift in [0, 3, 9, 31] {
                let exact = exact >> (64 - shift);
                if let Ok(exact) = i64::try_from(exact) {
                    assert_eq!(product_up(a, x, shift), exact, "{a} * {x}, up by {shift}");
                }
            }
        }
    }
    for &x in numbers.iter().filter(|x| **x >= 0) {
        let error = (f64::from(single(x)) - x as f64).abs();
        assert!(error <= 1.5 * x as f64 / f64::from(1 << 23), "{x}");
    }
}

/// As in 128 bits, for coefficients of up to 60 bits and places up to either end.
#[test]
fn a_sample_is_by_words_what_it_is_by_more_bits() {
    let mut rng = Rng::new(92, 0);
    for i in 0..100_000 {
        let c: [i64; 7] = core::array::from_fn(|_| rng.bits() as i64 >> (4 + rng.below(60)));
        let place = match i % 4 {
            0 => 1 << 30,
            1 => -(1 << 30),
            _ => rng.bits() as i32 >> 1,
        };
        let wide = c.iter().rev().fold(0, |value: i128, c| ((value * place as i128) >> 30) + *c as i128);
        assert_eq!(i128::from(bound::at(&c, place)), wide, "{c:?} at {place}");
    }
}

/// Rounded down on either side of time 0, so that times keep their order across it; a double towards 0.
#[test]
fn conversions_to_whole_units() {
    let mut rng = Rng::new(93, 0);
    for _ in 0..100_000 {
        let e = rng.below(140) as i32 - 70;
        let up = rng.below(150) as i32 - 90;
        let x = (rng.unit() - 0.5) * power_of_two_f64(e + up);
        let units = |x: f64| x / power_of_two_f64(e);
        assert_eq!(fixed_down(x as f32, e) as f64, units(f64::from(x as f32)).floor(), "{x:e} in 2^{e}");
        assert_eq!(fixed_towards_0(x, e) as i128, units(x).trunc() as i128, "{x:e} in 2^{e}");
        let a = rng.unit() * power_of_two_f64(-(rng.below(40) as i32));
        assert_eq!(in_2_60(a as f32) as f64, (f64::from(a as f32) * power_of_two_f64(60)).floor(), "{a:e}");
        let [at, next] = [0, 1].map(|more| f64::from(f32::from_bits(floor_bits(a) + more)));
        assert!(at <= a && a < next, "{a:e}");
    }
    for x in [0.0, -0.0, f32::from_bits(1), -f32::from_bits(1)] {
        assert_eq!(fixed_down(x, -125), if x < 0.0 { -1 } else { 0 });
    }
    assert_eq!([f64::NAN, 1e30, -1e30].map(|x| fixed_towards_0(x, -20)), [i64::MAX, i64::MAX, -i64::MAX]);
}

/// Where a search for a mass ends: within its error, or, if that is too small for it, at one of two neighbouring
/// places.
#[test]
fn series_of_masses_and_their_search() {
    let (mut rng, mut most, mut all, mut bisected) = (Rng::new(94, 0), 0, [0; 2], 0);
    for inverse in inverses() {
        for ramp in Side::BOTH.map(|side| inverse.curve.ramp(side)).into_iter().filter(|ramp| ramp.whole > 0) {
            for (side, series) in Side::BOTH.map(|side| (side, ramp.mass_since(side))) {
                assert!(series.c.iter().map(|c| c.unsigned_abs()).sum::<u64>() < 1 << 62, "{ramp:?}");
                for _ in 0..60 {
                    let target = (rng.unit() * 0.5 * ramp.whole as f64) as i64;
                    let (place, steps) = series.solve(target, (target >> 27) + (1 << 12));
                    assert!((target - series.at(place)).abs() <= (target >> 27) + (1 << 12), "{target} {ramp:?}");
                    most = most.max(steps);
                    all = [all[0] + steps, all[1] + 1];
                    // What is beyond the middle is searched for from the other end.
                    let [near, far] = [(side, target), (side.other(), ramp.whole - target)]
                        .map(|(side, mass)| ramp.time_of_mass(side, mass, 1 << 40, inverse.curve.units));
                    assert_eq!(near, far, "{target} {ramp:?}");
                    let (place, steps) = series.solve(target, 0);
                    let missing = target - series.at(place);
                    assert!(missing.abs() <= 7683, "{missing} of {target}: {ramp:?}");
                    bisected += u32::from(steps == MAX_STEPS);
                }
            }
        }
    }
    let mean = f64::from(all[0]) / f64::from(all[1]);
    std::println!("steps: {mean}, at most {most}; bisected to the end: {bisected}");
    assert!(mean < 2.42 && most <= 12 && bisected > 100);
    // A search here takes more than 12 steps unless `step` divides by `1 + bend`.
    let crossed = CubicBezier::new([(0.0, 0.00012889), (0.93853, 0.54823), (0.38236, 0.011353), (1.0, 0.0011553)]);
    let crossed = integrated(&[crossed, CubicBezier::new([(1.0, 0.0); 4])]);
    let steps = (0..500).map(|k| crossed.time_units(Fraction { side: Side::End, bits: 0.444f32.to_bits() + k }).1);
    assert!(steps.max() <= Some(12));
}

/// The look-up leads to the octave that was built for a fraction, and its offset to the fraction; Horner's rule rounds
/// each product down.
#[test]
fn the_octave_of_a_fraction() {
    let (mut rng, mut seen) = (Rng::new(95, 0), 0);
    for (inverse, ramps) in ramps().filter_map(|r| Some((Inverse::<8>::new(&r[0], &r[1]).ok()?, r))) {
        let integrated = integrated(&ramps);
        for (side, ramp) in Side::BOTH.into_iter().flat_map(|side| Side::BOTH.map(|ramp| (side, ramp))) {
            let first_top = build(&integrated, &ramps, side, &mut [Octave::NONE; 8])[ramp as usize];
            let [from, to] = range(&integrated, side, ramp);
            for _ in 0..1000 {
                let a = fraction(&mut rng);
                if f64::from(a) <= from || f64::from(a) > to {
                    continue;
                }
                let bits = a.to_bits();
                let Some((octave, position)) = inverse.look_up(Fraction { side, bits }, ramp) else { continue };
                if !octave.exists() {
                    continue;
                }
                // The octave's top by its definition: halved until the fraction is above half of it.
                let mut top = first_top;
                while top_at(top, 1) >= bits {
                    top = top_at(top, 1);
                }
                let power = f64::from(f32::from_bits(top & 0xFF80_0000));
                let exact = (f64::from(a) / power * power_of_two_f64(32)) as i128;
                assert_eq!(position as u32, exact as u32, "{a}");
                let (center, shift) = (octave.center, octave.center & 31);
                // Position and center may have wrapped: the nearest distance that both words allow.
                let distance = (exact as i32).wrapping_sub(center) as i128;
                let x = octave.offset(position);
                assert_eq!(i128::from(x), distance << shift, "{a}");
                let wide = octave.c.iter().fold(0i128, |sum, c| ((sum + i128::from(*c)) * i128::from(x)) >> 32);
                assert_eq!(i128::from(octave.polynomial(x)), wide, "{a}");
                assert_eq!(octave.time(x), (i128::from(octave.middle) + i128::from(octave.factor) * wide) as i64);
                seen += 1;
            }
        }
    }
    assert!(seen > 10_000, "{seen}");
}

/// The plateau's line is rounded down; and each answer, of the line, a polynomial or a search, is its time in units,
/// rounded once.
#[test]
fn a_time_in_units_is_rounded_once() {
    let (mut rng, mut lines, mut near_0) = (Rng::new(96, 0), 0, 0);
    for inverse in inverses() {
        let (integrated, unit) = (&inverse.curve, inverse.curve.units.exponent());
        let start = integrated.end_time(Side::Start);
        let [near, far] = integrated.join_fractions(Side::Start);
        // Across time 0 also the fractions about it.
        let at_0 = crate::cdf::cdf(integrated, 0.0);
        for k in 0..3000 {
            let u = match k % 3 {
                0 => fraction(&mut rng),
                1 => 1.0 - fraction(&mut rng),
                _ => f32::from_bits(at_0.to_bits().saturating_add(k).saturating_sub(1500)).min(1.0),
            };
            let fraction = Fraction::new(u);
            let time = inverse.time_units(fraction);
            // Next to the end a frame is not on the line, from the start it is.
            if fraction.side.is_end() && fraction.get() <= 1.0 / 512.0 {
                continue;
            }
            let rounded = (time as f64 * power_of_two_f64(unit)) as f32;
            // An f64 holds all but the longest, and those to far more than an f32.
            let exact = if time.unsigned_abs() < 1 << 53 { rounded } else { time as f32 * power_of_two(unit) };
            assert_eq!(inverse.inverse_cdf(u), exact.max(start), "{u:e}");
            near_0 += u32::from(time.unsigned_abs() < 1 << 57 && time != 0);
            let is_on_line = f64::from(u) > near * 1.000_001 && f64::from(u) < far * 0.999_999 && u > 1.0 / 512.0;
            if is_on_line {
                let word = (f64::from(u) * power_of_two_f64(32)) as i128;
                let line = i128::from(integrated.line_base) + ((i128::from(integrated.line_slope) * word) >> 32);
                assert_eq!(i128::from(time), line, "{u:e}");
                lines += 1;
            }
        }
    }
    assert!(lines > 10_000 && near_0 > 100, "{lines} {near_0}");
}

/// Where rounding would lead beyond an end: the last time on a plateau, and the mass next to a dark start.
#[test]
fn nothing_is_beyond_its_part() {
    let narrow = [
        [(0.0, 0.0), (1.3168558e-11, 0.3), (1.6617529e-8, 0.8), (4.6710692e-8, 1.0)],
        [(1.1186821e-7, 1.0), (0.23374878, 0.9), (0.24665284, 0.4), (0.44425082, 0.0)],
    ];
    let narrow = integrated(&narrow.map(CubicBezier::new));
    let last = Fraction { side: Side::Start, bits: 3.726127e-7f32.to_bits() };
    assert!(narrow.time_units(last).0 <= narrow.in_units(narrow.join_time(Side::End)));
    let faint = 7.105428e-18;
    let dark = CubicBezier::new([(0.0, faint), (0.9375, faint), (0.0, 0.0), (1.0, 1.0)]);
    let dark = integrated(&[dark, CubicBezier::new([(1.0, 0.0); 4])]);
    assert!((1..60).all(|k| crate::cdf::cdf(&dark, power_of_two(-k)) >= 0.0));
}

/// What the oracle collects by a time is within what is proven: on the line 2⁻⁶ ulp of the fraction, by a search 0.425
/// ulp, or 2⁻⁴⁶·², a unit of time either way, or four beyond the near ramp, as a product on the plateau loses three.
///
/// A cdf is within 0.875 ulp at a time within 1/4 ulp and 2⁻⁵⁴ of the interval.
#[test]
fn searches_and_the_cdf_are_within_what_is_proven() {
    let (mut rng, mut worst) = (Rng::new(99, 0), [0.0f64; 3]);
    for curve in curves() {
        let [opening, closing] = [curve.opening, curve.closing].map(CubicBezier::new);
        let Ok(inverse) = Inverse::<0>::new(&opening, &closing) else { continue };
        let integrated = &inverse.curve;
        let (exact, unit) = (Exact::new(&curve), power_of_two_f64(integrated.units.exponent()));
        let [start, end] = Side::BOTH.map(|side| f64::from(integrated.end_time(side)));
        for k in 0..1500 {
            let side = Side::end_if(k % 2 == 0);
            let a = fraction(&mut rng) * power_of_two(-(rng.below(8) as i32));
            let fraction_of_side = Fraction { side, bits: a.to_bits() };
            let line = inverse.direct_units(fraction_of_side);
            let time = line.unwrap_or_else(|| integrated.time_units(fraction_of_side).0);
            let is_beyond = f64::from(a) > integrated.join_fractions(side)[0];
            let slack = [1, 4, 0][if line.is_some() { 2 } else { is_beyond as usize }];
            let [low, high] = [-slack, slack].map(|more| {
                let time = time + more;
                let upper = time >> 20 << 20;
                let time = Dd::from(upper as f64 * unit) + Dd::from((time - upper) as f64 * unit);
                let collected = if side.is_end() { exact.complement_dd(time) } else { exact.cdf(time) };
                (collected - Dd::from(f64::from(a))).hi
            });
            let off = (-low.max(high)).max(low.min(high)).max(0.0);
            let ulp = ulp_f32(f64::from(a));
            match line {
                Some(_) => worst[0] = worst[0].max(off / (ulp / 64.0)),
                None => worst[1] = worst[1].max(off / (0.425 * ulp).max(0.86 * power_of_two_f64(-46))),
            }
            // Evenly, and next to either end.
            let part = if k % 3 == 0 { rng.unit() } else { f64::from(fraction(&mut rng)) };
            let t = (if k % 2 == 0 { start + part * (end - start) } else { end - part * (end - start) }) as f32;
            let moved = ulp_f32(f64::from(t)) / 4.0 + (end - start) * power_of_two_f64(-54);
            let value = f64::from(crate::cdf::cdf(integrated, t));
            let [early, late] = [-moved, moved].map(|by| exact.cdf(Dd::from(f64::from(t)) + Dd::from(by)));
            let off = (early - Dd::from(value)).hi.max((Dd::from(value) - late).hi).max(0.0);
            worst[2] = worst[2].max(off / (0.875 * ulp_f32(value).max(power_of_two_f64(-47))));
        }
    }
    std::println!("parts of what is proven: {worst:?}");
    assert!(worst.iter().all(|worst| *worst <= 1.0), "{worst:?}");
}

/// A tick is the nearest one to the exact product of delay and rate; and a rate is accepted as long as the interval has
/// 2³¹ ticks or fewer.
#[test]
fn a_tick_is_the_nearest() {
    let mut rng = Rng::new(98, 0);
    for inverse in inverses() {
        let (integrated, e) = (&inverse.curve, inverse.curve.units.exponent());
        let [start, end] = Side::BOTH.map(|side| integrated.in_units(integrated.end_time(side)));
        let length = end - start;
        // In half ticks, rounded down: 128 bits hold all that is not 0.
        let halves = |delay: i64, rate: u32| {
            let product = i128::from(delay) * i128::from(rate);
            if e >= -1 { product << (e + 1).min(30) } else { product >> (-1 - e).min(127) }
        };
        for k in 0..64 {
            let rate = if k < 32 { 1 << k } else { (rng.bits() as u32 | 1 << 31) >> (k - 32) };
            let product = i128::from(length) * i128::from(rate);
            let is_short = if e <= 31 { product <= 1i128 << (31 - e).min(126) } else { false };
            let scale = TickScale::new(&inverse, Hz(rate));
            assert_eq!(scale.is_ok(), is_short, "{rate} {e} {length}");
            let Ok(scale) = scale else { continue };
            for _ in 0..40 {
                let delay = ((rng.bits() >> 1) as i64 >> rng.below(60)) % (length + 1);
                let tick = (halves(delay, rate) + 1) >> 1;
                assert_eq!(i128::from(scale.tick(start + delay)), tick, "{delay} {rate} {e}");
            }
            assert_eq!(i128::from(scale.tick(end)), (halves(length, rate) + 1) >> 1);
        }
    }
}
