//! Everything that is promised, on inputs that meet difficulties exactly: see `support/aimed.rs`.
//!
//! `cargo test --test aimed -- --nocapture` prints the worst of each family.

mod support;

use shutter_curve::CubicBezier;
use support::aimed::{FAMILIES, aimed};
use support::cases::shutter;
use support::curves::{Rng, is_valid};
use support::oracle::{Curve, Dd, Exact, exp2};
use support::promise::{BACKWARD, Figures};
use support::times;

const SEED: u64 = 13;
/// Of each family, times [`times`].
const CURVES: u64 = 400;

fn keeps_every_promise(family: usize) {
    let mut figures = Figures::default();
    let curves = CURVES * times();
    for index in 0..curves {
        figures.judge(&aimed(family, SEED, index), &mut Rng::new(SEED, index));
    }
    println!("{}: {figures}", FAMILIES[family].0);
    assert!(figures.samples > 500 * curves, "only {} samples", figures.samples);
    assert!(figures.breaches.is_empty(), "{:#?}", figures.breaches);
}

/// A test for each family, so that they run side by side.
macro_rules! families {
    ($($name:ident: $family:expr,)*) => {
        $(#[test]
        fn $name() {
            keeps_every_promise($family);
        })*

        #[test]
        fn none_is_left_out() {
            assert!([$($family),*].into_iter().eq(0..FAMILIES.len()));
        }
    };
}

/// The families do meet what they are aimed at.
#[test]
fn the_curves_are_as_aimed() {
    fn is_tiny(share: Dd) -> bool {
        share.hi > 0.0 && share.hi < exp2(-90)
    }
    type Feature = (&'static str, fn(&Curve, &Exact) -> bool, u32);
    let features: [Feature; 8] = [
        (
            "an f32 is the fraction at a minimum, to 2^-34",
            |_, e| {
                e.landmarks().into_iter().any(|u| {
                    // Halves and quarters are met by symmetry.
                    let off = (Dd::from(u.to_f32()) / u - Dd::ONE).hi.abs();
                    u.hi > 0.0 && u.hi < 0.99 && off > 0.0 && off < exp2(-34)
                })
            },
            300,
        ),
        (
            "half of the light at a minimum",
            |_, e| e.landmarks()[2..].iter().any(|u| (u.hi - 0.5).abs() < 1e-15),
            30,
        ),
        (
            "a minimum within 2^-30 of the start",
            |c, e| {
                e.landmark_times()[4..].iter().any(|t| {
                    let after = (*t - Dd::from(c.open_start())).hi;
                    after > 0.0 && after < exp2(-30) * f64::from(c.close_end() - c.open_start())
                })
            },
            100,
        ),
        (
            "less than 2^-90 of the light in the opening ramp",
            |c, e| is_tiny(e.cdf(c.open_end())),
            40,
        ),
        (
            "less than 2^-90 of the light in the closing ramp",
            |c, e| is_tiny(e.complement_dd(Dd::from(c.close_start()))),
            100,
        ),
        ("an inner join at time 0", |c, _| c.open_end() == 0.0 || c.close_start() == 0.0, 1000),
        ("a ramp without light", |c, _| c.opening.iter().all(|p| p.1 == 0.0), 30),
        ("lifted", |_, e| e.is_lifted(), 500),
    ];
    let mut seen = [0; 8];
    for family in 0..FAMILIES.len() {
        for index in 0..300 {
            let curve = aimed(family, SEED, index);
            assert_eq!(curve, aimed(family, SEED, index));
            let exact = Exact::new(&curve);
            for ((_, has, _), seen) in features.iter().zip(&mut seen) {
                *seen += u32::from(has(&curve, &exact));
            }
        }
    }
    for ((name, _, least), seen) in features.iter().zip(seen) {
        println!("{seen:5} of {}: {name}", 300 * FAMILIES.len());
        assert!(seen >= *least, "{name}: only {seen}");
    }
}

families! {
    both_touch_0_together: 0,
    both_touch_0_apart: 1,
    both_nearly_touch_0_together: 2,
    time_stands_still: 3,
    openness_touches_0: 4,
    both_touch_0_next_to_an_end: 5,
    openness_touches_0_next_to_an_end: 6,
    symmetric_dips_where_time_stands_still: 7,
    symmetric_in_other_ways: 8,
    grazing: 9,
    next_to_no_light: 10,
    anything_hard: 11,
}

/// A ramp that is darkest at its join with the plateau, or with a bright ramp, is answered by an octave only while an error
/// next to the join cannot lead far into the light beyond. The openness at the join is the least that an octave takes.
#[test]
fn ramps_that_are_darkest_at_their_join() {
    let mut rng = Rng::new(39, 0);
    let (mut judged, mut worst) = (0, 0.0f64);
    for i in 0..1000 {
        // Around a curve on which the error is greatest at the join itself.
        let mut near = |x: f64| x * rng.between(0.7, 1.3);
        let times = [0.0705, 0.5505, 0.6501, 1.0743].map(&mut near);
        let opennesses = [1.0 / 3.0, 1.0, 0.75].map(|f| near(f).min(1.0));
        let with = |dark: f64| {
            let [f1, f2, f3] = opennesses;
            let f = [dark, f1, f2, f3];
            let closing = std::array::from_fn(|k| (times[k] as f32, f[k] as f32));
            // Bright until the join: a box and a plateau, or a ramp alone.
            let opening = if i % 3 == 0 {
                [(0.0, 1.0); 4]
            } else {
                CubicBezier::line((-0.5 * times[0] as f32, 1.0), (times[0] as f32, 1.0)).points()
            };
            Curve::shutter(opening, closing)
        };
        let is_direct = |dark: f64| {
            let join = Exact::new(&with(dark)).landmarks()[1].to_f32();
            let ours = shutter::<8>(&with(dark));
            [1, 2, 3].iter().all(|k| ours.is_direct(f32::from_bits(join.to_bits() + k)))
        };
        let (mut low, mut high) = (1e-6, 0.3);
        if !is_valid(&with(low)) || !is_valid(&with(high)) || is_direct(low) || !is_direct(high) {
            continue;
        }
        for _ in 0..20 {
            let middle = (low * high).sqrt();
            *(if is_direct(middle) { &mut high } else { &mut low }) = middle;
        }
        for curve in [with(high), with(high).mirrored()] {
            let (exact, ours) = (Exact::new(&curve), shutter::<8>(&curve));
            for landmark in &exact.landmarks()[..2] {
                let mut last = f32::NEG_INFINITY;
                let bits = landmark.to_f32().to_bits();
                for u in (bits.saturating_sub(60)..=bits + 60).map(f32::from_bits) {
                    let t = ours.inverse_cdf(u);
                    let errors = exact.judge(u, t);
                    assert!(errors.backward <= BACKWARD, "{u:e}: {errors:?}, {curve:?}");
                    assert!(t >= last, "a step back at {u:e}, {curve:?}");
                    (last, worst) = (t, worst.max(errors.backward));
                }
            }
        }
        judged += 1;
    }
    println!("{judged} ramps, at most {worst:.3} ulp");
    assert!(judged > 100, "only {judged}");
}
