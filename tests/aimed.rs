//! Everything that is promised, on inputs that meet difficulties exactly: see `support/aimed.rs`.
//!
//! `cargo test --test aimed -- --nocapture` prints the worst of each family.

mod support;

use support::aimed::{FAMILIES, aimed};
use support::curves::Rng;
use support::oracle::{Curve, Dd, Exact, exp2};
use support::promise::Figures;

const SEED: u64 = 13;
/// Of each family; together they take half a minute on one core.
const CURVES: u64 = 1500;

fn keeps_every_promise(family: usize) {
    let mut figures = Figures::default();
    for index in 0..CURVES {
        figures.judge(&aimed(family, SEED, index), &mut Rng::new(SEED, index));
    }
    println!("{}: {figures}", FAMILIES[family].0);
    assert!(figures.samples > 500 * CURVES, "only {} samples", figures.samples);
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
