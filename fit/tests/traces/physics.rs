//! What `shutter fit` makes of shutters, lamps and recorders that no model of it has: right, or doubted aloud, or
//! refused. The ordinary test judges some traces of each; the tables of docs/internals/fit.md come from
//!
//! ```text
//! cargo test --package shutter-fit --test traces physics:: -- --ignored --nocapture
//! ```
//!
//! `SEED=9000011` before it makes other traces, and `EACH=100` more of them.

use shutter_fit::trace::{Trace, Warning};
use shutter_fit::{From, Kind, Options, Sync, fit};
use strum::IntoEnumIterator;

use crate::families::{Family, coupled, measured};
use crate::generator::{Case, Disturbance, Random, SHUTTERS, Shutter, asked, case, each, quantile};
use crate::judge::{HEAD, Row, count, is_about_the_result, print};
use crate::unseen::{self, Instrument, Mechanics};

/// The rows of cases with seeds of their own.
fn rows(cases: u32, seed: u64, of: impl Fn(u32, &mut Random) -> Case + std::marker::Sync) -> Vec<Row> {
    each(cases, |k| Row::new(&of(k, &mut Random::new(seed + u64::from(k)))))
}

fn family_rows(family: Family, cases: u32, seed: u64) -> Vec<Row> {
    rows(cases, seed + 1000 * family as u64, |_, random| measured(family, random))
}

#[test]
#[ignore = "some minutes: the tables, for docs/internals/fit.md"]
fn table() {
    let (each, seed) = (asked("EACH", 20), asked("SEED", 1));
    println!("\n{HEAD}");
    for family in Family::iter() {
        let rows = family_rows(family, each, seed);
        print(&format!("{family:?}"), &rows);
        // Blades that do what no model does: the trace's own exposure is within what is stated.
        let is_blade =
            matches!(family, Family::Bounce | Family::DeepBounce | Family::Dip | Family::Overshoot | Family::Reopens);
        let covered = count(&rows, |row| row.covered) as f64 / rows.len() as f64;
        assert!(!is_blade || covered >= 0.8, "{family:?}: exposures covered: {covered}");
    }
}

/// Results beyond what is wrong, or four times what the noise allows, on mechanics and by instruments that nothing was
/// tuned on.
fn unseen_rows(what: Mechanics, by: Instrument, cases: u32, seed: u64) -> Vec<Row> {
    let seed = seed + 900_000 + 10_000 * what as u64 + 100 * by as u64;
    each(cases, |k| {
        let case = unseen::measured(what, by, &mut Random::new(seed + u64::from(k)));
        let lit = case.trace.times.len() as f64 * case.truth.exposure();
        let is_slow = by == Instrument::Sines;
        Row::new(&case).allowing(case.noise * if is_slow { 2.0 } else { 4.0 * (1.5 / lit).sqrt() })
    })
}

#[test]
#[ignore = "some minutes: the table of unseen traces, for docs/internals/fit.md"]
fn unseen_mechanics() {
    let (each, seed) = (asked("EACH", 4), asked("SEED", 1));
    println!("\n{HEAD}");
    let mut all = Vec::new();
    for by in Instrument::iter() {
        let rows: Vec<Row> = Mechanics::iter().flat_map(|what| unseen_rows(what, by, each, seed)).collect();
        print(&format!("{by:?}"), &rows);
        all.extend(rows);
    }
    print("all", &all);
    for what in Mechanics::iter() {
        let clean = [Instrument::Clean, Instrument::Jitter].map(|by| unseen_rows(what, by, 5 * each, seed));
        print(&format!("{what:?}, clean"), &clean.into_iter().flatten().collect::<Vec<_>>());
    }
}

#[test]
#[ignore = "some minutes: 600 records of 1/f noise, for docs/internals/fit.md"]
fn slow_noise() {
    let (each, seed) = (asked("EACH", 25), asked("SEED", 1));
    println!("\n{HEAD}");
    let rows = Mechanics::iter().flat_map(|what| unseen_rows(what, Instrument::Sines, each, seed + 50));
    print("1/f noise, unseen mechanics", &rows.collect::<Vec<_>>());
    let own = rows_of_own(12 * each, seed);
    print("1/f noise, the models' own", &own);
}

fn rows_of_own(cases: u32, seed: u64) -> Vec<Row> {
    each(cases, |k| {
        let shutter = SHUTTERS[k as usize % SHUTTERS.len()];
        let case = case(shutter, Disturbance::Pink, &mut Random::new(seed + 6_000_000 + u64::from(k)));
        Row::new(&case).allowing(2.0 * case.noise)
    })
}

/// Right, or doubted aloud, or refused: some traces of each family. Of clipping nothing is left to see where the noise
/// comes after it.
#[test]
fn nothing_is_wrong_without_a_word() {
    for family in Family::iter().filter(|family| *family != Family::Clipped) {
        let rows = family_rows(family, 3, 77);
        assert_eq!(count(&rows, Row::is_wrong_silently), 0, "{family:?}");
        let trigger = quantile(rows.iter().map(|row| row.triggers), 1.0);
        let exposure = quantile(rows.iter().map(|row| row.exposure), 0.5);
        // What is lost in the recorder or the lamp cannot be had back; the rest is.
        match family {
            Family::Bounce | Family::DeepBounce | Family::Dip | Family::Overshoot => {
                assert!(trigger < 0.0015, "{family:?}: {trigger}");
                // A blade that has not come to rest leaves open what full light is.
                let most = if family == Family::DeepBounce { 0.005 } else { 0.002 };
                assert!(exposure < most, "{family:?}: {exposure}");
            }
            Family::Coupled | Family::Slit | Family::Coarse => {
                assert!(trigger < 0.001 && exposure < 0.002, "{family:?}: {trigger}, {exposure}");
            }
            _ => (),
        }
    }
}

/// A leaf that creeps to its end: in some of these traces nothing but the test of the tail tells it.
#[test]
fn a_tail_is_told() {
    let rows = family_rows(Family::Creep, 25, 1);
    let told = count(&rows, |row| row.from_trace);
    assert!(told >= 23 && count(&rows, Row::is_wrong_silently) == 0, "{told}");
}

/// A tail that the trace cuts off is no drift, though a line comes near to it.
#[test]
fn a_tail_is_no_drift() {
    let rows = family_rows(Family::CutTail, 4, 1);
    assert_eq!(count(&rows, |row| row.says("drift")), 0, "{:?}", rows[0].warnings);
}

/// A dip of 1 % for a fifth of the time is told, or that it would not be seen; full light that sinks by 0.5 to 2 % is,
/// or is in the errors.
#[test]
fn a_dip_and_a_slope_are_told() {
    let [dips, slopes] = [Family::Shallow, Family::Sinks].map(|family| family_rows(family, 60, 5));
    let (told, found) = (count(&dips, |row| row.told), count(&dips, |row| row.from_trace));
    assert!(told >= 57 && found >= 42, "{told} {found}");
    let held = count(&slopes, |row| row.covered);
    assert!(held >= 56, "{held}");
}

/// And what is right is not doubted.
#[test]
fn the_models_own_kind_is_not_doubted() {
    for disturbance in [Disturbance::White, Disturbance::Coloured] {
        for shutter in SHUTTERS {
            for seed in 0..2 {
                let case = case(shutter, disturbance, &mut Random::new(31_000 + seed));
                let fit = case.fitted(&Options::default());
                assert!(fit.test.explained && fit.test.tested, "{shutter:?}: {:?}", fit.test);
                assert_eq!(fit.from, From::Model);
                assert!(fit.warnings.iter().all(|it| it.code() != "hum"), "{:?}", fit.warnings);
            }
        }
    }
}

/// A kind that was asked for is judged like any other: a box is no leaf, whose ramps are not its dark.
#[test]
fn a_kind_that_was_asked_for_is_judged() {
    for shutter in [Shutter::Leaf, Shutter::Iris, Shutter::Trapezoid] {
        let case = case(shutter, Disturbance::White, &mut Random::new(50));
        let asked = |kind| case.fitted(&Options { model: Some(kind), ..Options::default() });
        let [boxed, free] = [Kind::Box, Kind::Free].map(asked);
        assert!(!boxed.test.explained && free.test.explained, "{shutter:?}: {:?}", boxed.test);
        assert!((boxed.exposure.value / case.exposure() - 1.0).abs() < 0.01, "{shutter:?}");
    }
}

/// On the model's own kind nearly nothing is doubted.
#[test]
#[ignore = "some minutes: the table of false alarms, for docs/internals/fit.md"]
fn false_alarms() {
    let (all, seed) = (asked("EACH", 20), asked("SEED", 1));
    use Disturbance::*;
    for (k, disturbance) in [White, Coloured, Hum, Drift, Pink].into_iter().enumerate() {
        for shutter in SHUTTERS {
            let alarms = each(all, |i| {
                let seed = seed + 70_000 + 10_000 * k as u64 + 1000 * shutter as u64 + u64::from(i);
                let case = case(shutter, disturbance, &mut Random::new(seed));
                let fit = case.fitted(&Options::default());
                let about = fit.warnings.iter().filter(|w| is_about_the_result(w));
                let codes: Vec<&str> = about.map(Warning::code).filter(|c| *c != "no_plateau").collect();
                (!codes.is_empty()).then(|| format!("{codes:?} {:.1} {:.2}%", fit.test.sigma, 100.0 * fit.test.share))
            });
            let told: Vec<String> = alarms.into_iter().flatten().collect();
            println!("| {shutter:?} | {disturbance:?} | {all} | {} | {}", told.len(), told.join("; "));
        }
    }
}

/// How often the true start of opening lies within what a fit states of the delay to it. Of 24 traces of each shutter,
/// 96 % or more were covered. For a liquid crystal, whose tail hides the length, the stated error is some thirty times
/// too large; for no shutter was it too small on the whole.
#[test]
fn the_true_start_of_opening_is_within_its_stated_error() {
    let options = Options { sync: Some(Sync::Edge(-1e3)), ..Options::default() };
    let held = each(6 * SHUTTERS.len() as u32, |i| {
        let (shutter, k) = (SHUTTERS[i as usize / 6], i % 6);
        let mut random = Random::new(77_000 + 13 * u64::from(k) + shutter as u64);
        let case = case(shutter, Disturbance::White, &mut random);
        let delay = case.fitted(&options).delay.unwrap();
        let off = delay.mean() - 1e3 - case.truth.times[0] * case.scale;
        off.abs() <= 1.96 * delay.error() + 1e-9 * case.scale
    });
    let missed = held.iter().filter(|held| !**held).count();
    assert!(20 * missed <= held.len(), "{missed} of {}", held.len());
}

/// Delays of noisy shots differ from the true ones as much as is stated.
#[test]
fn a_shots_delay_is_as_well_known_as_stated() {
    let mut random = Random::new(41);
    let (step, shots) = (2e-5, 12);
    let delays: Vec<f64> = (0..shots).map(|_| 1e-3 + random.within(0.0, 2e-4)).collect();
    let times: Vec<f64> = (0..1500 * shots).map(|i| step * i as f64).collect();
    // Each edge comes 5 ms after its 30 ms begin.
    let since = |t: f64| (t / 0.03) as usize;
    let sync = times.iter().map(|t| f64::from(u8::from(t - 0.03 * since(*t) as f64 > 0.005)));
    let sync = Trace { values: sync.collect(), times: times.clone() };
    let light = times.iter().map(|t| {
        let opened = t - 0.03 * since(*t) as f64 - 0.005 - delays[since(*t).min(shots - 1)];
        (opened.min(0.014 - opened) / 0.004).clamp(0.0, 1.0) + 0.05 * random.normal()
    });
    let trace = Trace { values: light.collect(), times: times.clone() };
    let options = Options { sync: Some(Sync::Channel(sync)), ..Options::default() };
    let delay = fit(&trace, &options, &mut |_| ()).expect("a fit").delay.expect("a delay");
    let mean = delays.iter().sum::<f64>() / shots as f64;
    let off = |(shot, truth): (&f64, &f64)| (shot - delay.mean() - (truth - mean)).powi(2);
    let scatter = (delay.shots.iter().zip(&delays).map(off).sum::<f64>() / (shots - 1) as f64).sqrt();
    assert!((0.5..1.6).contains(&(scatter / delay.measuring)), "{scatter} {}", delay.measuring);
}

/// A tester's T1 to T3 are within their stated errors as well: of 24 traces of each shutter, 98 % were. A liquid
/// crystal's have no ends: there they are those of all but 0.5 % of the light.
#[test]
fn a_testers_times_are_within_their_stated_errors() {
    let held = each(6 * SHUTTERS.len() as u32, |i| {
        let (shutter, k) = (SHUTTERS[i as usize / 6], i % 6);
        let case = case(shutter, Disturbance::White, &mut Random::new(91_000 + 13 * u64::from(k) + shutter as u64));
        let fit = case.fitted(&Options::default());
        let within = |openness| {
            let times = (0..200_000).map(|i| f64::from(i) / 2e5).filter(|t| case.truth.openness(*t) >= openness);
            times.fold([1.0, 0.0], |[first, last], t| [t.min(first), t.max(last)])
        };
        let [start, open, close, end] = case.truth.times;
        let has_ends = shutter != Shutter::LiquidCrystal;
        let [[start, end], [open, close]] =
            if has_ends { [[start, end], [open, close]] } else { [0.005, 0.995].map(within) };
        let truths = [open - start, close - open, end - close].map(|part| case.scale * part);
        let off = |k: &usize| {
            let part = fit.parts[*k];
            (part.value - truths[*k]).abs() > 1.96 * part.error + 1e-9 * case.scale
        };
        (0..3).filter(off).count()
    });
    let missed: usize = held.iter().sum();
    assert!(20 * missed <= 3 * held.len(), "{missed} of {}", 3 * held.len());
}

/// The codes of what is told of a pulse: 2000 samples of this openness from -1 to 1, and of this noise, by the light.
fn told(openness: impl Fn(f64) -> f64, noise: impl Fn(f64) -> f64, seed: u64) -> Vec<&'static str> {
    let mut random = Random::new(seed);
    let times: Vec<f64> = (0..2000).map(|i| f64::from(i) * 2e-6 - 2e-3).collect();
    let values = times.iter().map(|t| {
        let light = openness(t * 1e3);
        light + noise(light) * random.normal()
    });
    let trace = Trace { values: values.collect(), times };
    let fit = fit(&trace, &Options::default(), &mut |_| ()).expect("a fit");
    fit.warnings.iter().map(Warning::code).collect()
}

/// Noise of the light is no spike, and a spike in it still is one.
#[test]
fn shot_noise_has_no_spikes() {
    let trapezoid = |t: f64| ((0.8 - t.abs()) / 0.1).clamp(0.0, 1.0);
    let shot = |light: f64| 0.002 + 0.03 * light.sqrt();
    let false_ones = (0..20).filter(|seed| told(trapezoid, shot, *seed).contains(&"spikes"));
    assert_eq!(false_ones.count(), 0);
    let struck = |t: f64| trapezoid(t) + if (0.1..0.102).contains(&t) { 0.4 } else { 0.0 };
    let found = (0..20).filter(|seed| told(struck, shot, *seed).contains(&"spikes"));
    assert_eq!(found.count(), 20);
}

/// A slit that passes a wider sensor never opens fully, and says so; a short plateau does.
#[test]
fn a_bell_may_never_be_fully_open() {
    let bell = |t: f64| 0.4 * (1.0 - (t / 0.7).abs().powf(2.5)).max(0.0);
    assert!(told(bell, |_| 0.001, 1).contains(&"no_plateau"));
    let short = |t: f64| ((0.7 - t.abs()) / 0.5).clamp(0.0, 1.0);
    assert!(!told(short, |_| 0.002, 1).contains(&"no_plateau"));
}

/// 1/f noise is no hum: of 800 traces 21 had one, these among them, where a few periods had to stand out as many do.
#[test]
fn slow_noise_is_no_hum() {
    for i in [54, 141, 181, 218, 288, 408, 432, 456, 512, 514] {
        let shutter = SHUTTERS[i as usize % SHUTTERS.len()];
        let fit = case(shutter, Disturbance::Pink, &mut Random::new(83_000 + i)).fitted(&Options::default());
        assert!(fit.warnings.iter().all(|it| !it.code().contains("hum")), "{i}: {:?}", fit.warnings);
    }
}

/// A leaf shutter behind these capacitors: exposures in seconds, windows from 70 ms to the whole file, both polarities,
/// one shot and three.
fn capacitor_rows(poles: &[f64], exposures: &[f64], seed: u64) -> Vec<Row> {
    let of = |exposure: &f64| {
        let windows = [(0.05, 0.02 + exposure), (0.05, 0.9), (0.3, 0.3), (0.01 + exposure, 0.02 + 2.0 * exposure)];
        let single = windows.into_iter().flat_map(|window| [(window, 1, false), (window, 1, true)]);
        let all: Vec<_> = single.chain([((0.1, 0.2), 3, false)]).collect();
        rows(all.len() as u32, seed + (1e6 * exposure) as u64, |k, random| {
            let (window, shots, falls) = all[k as usize];
            coupled(*exposure, poles, window, shots, falls, random)
        })
    };
    exposures.iter().flat_map(of).collect()
}

#[test]
#[ignore = "some minutes: the table of capacitors, for docs/internals/fit.md"]
fn capacitors() {
    println!("\n{HEAD}");
    let sets: [&[f64]; 9] = [&[], &[2.0], &[5.0], &[10.0], &[20.0], &[50.0], &[20.0, 2.0], &[10.0, 5.0], &[20.0, 20.0]];
    for poles in sets {
        print(&format!("{poles:?} Hz"), &capacitor_rows(poles, &[0.001, 0.002, 0.008, 0.033], asked("SEED", 1)));
    }
}

/// A sound card's capacitor costs nothing, and two of them are right or refused.
#[test]
fn capacitors_are_fitted_or_refused() {
    for (poles, refused) in [(&[20.0][..], 0), (&[20.0, 2.0], 3)] {
        let rows = capacitor_rows(poles, &[0.002, 0.008], 5);
        assert!(count(&rows, |row| row.refused) <= refused, "{poles:?} refused");
        assert_eq!(count(&rows, Row::is_wrong), 0, "{poles:?}");
        assert!(count(&rows, |row| !row.covered) <= 2, "{poles:?}: not covered");
        assert_eq!(count(&rows, |row| !row.refused && !row.says("ac_coupled")), 0, "{poles:?}");
    }
}
