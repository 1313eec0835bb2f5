//! `shutter fit`: what cannot be fitted is refused with a reason and leaves nothing behind, and what is doubtful is
//! told.

use std::fmt::Write;
use std::fs;

use serde_json::Value;
use shutter_fit::trace::{self, Light, Recording, Refusal, Tell, Trace, Warning};
use shutter_fit::{Curve, Fit, Kind, Options, Sync, fit, report};
use shutter_plan::fitted;
use shutter_plan::plan::Plan;
use shutter_plan::scene;

use crate::generator::{Case, Random, Recorder, Truth, each};
use crate::scenes::MEASURED;
use crate::shutters::{Draw, TUNED};
use crate::support::{Folder, SCENES, codes, keys, leaf, number, rows, sampled, trapezoid};

fn fitted(trace: &Trace, options: &Options) -> Result<Fit, Refusal> {
    fit(trace, options, &mut |_| ())
}

fn plainly(trace: &Trace) -> Fit {
    fitted(trace, &Options::default()).unwrap()
}

/// Reads a file and fits it.
fn through(file: impl AsRef<[u8]>, options: &trace::Options) -> (Fit, Vec<Warning>) {
    let Recording { trace, warnings, .. } = trace::open(file.as_ref(), options).unwrap();
    (plainly(&trace), warnings)
}

fn is_the_trapezoid(fit: &Fit) {
    assert_eq!(fit.chosen, Kind::Trapezoid);
    assert!((fit.exposure.value - 0.005).abs() < 5e-6, "{:?}", fit.exposure);
    assert!((fit.triggers[7].value + fit.triggers[8].value - 0.011).abs() < 5e-6);
}

fn told(fit: &Fit, is: impl Fn(&Warning) -> bool) -> bool {
    fit.warnings.iter().any(is)
}

#[test]
fn what_is_doubtful_is_told() {
    let with = |f: &dyn Fn(f64, f64) -> f64| {
        let mut trace = sampled(trapezoid, 1500, 0.005);
        let Trace { times, values } = &mut trace;
        values.iter_mut().zip(times).for_each(|(v, t)| *v = f(*t, *v));
        plainly(&trace)
    };
    type Test<'a> = &'a dyn Fn(&Warning) -> bool;
    let is_told = |fit: &Fit, is: Test| assert!(told(fit, is), "{:?}", fit.warnings);
    let still = |fit: &Fit, is: Test| {
        is_told(fit, is);
        is_the_trapezoid(fit);
    };
    let lowered = with(&|_, v| -v);
    still(&lowered, &|_| lowered.warnings == [Warning::Inverted]);
    let clipped = with(&|_, v| v.min(1.9));
    is_told(&clipped, &|w| matches!(w, Warning::Clipped { at: 1.9, share } if *share > 0.4));
    for (fit, tested) in [(&clipped, false), (&lowered, true)] {
        assert_eq!(report::untested(fit).is_none(), tested);
        assert_eq!(shutter_fit::json("", fit, &[])["fit"]["tested"], tested);
    }
    let near = |x: f64, to: f64, by: f64| (x - to).abs() < by;
    still(
        &with(&|t, v| v + 0.04 * (std::f64::consts::TAU * 400.0 * t).sin()),
        &|w| matches!(w, Warning::Hum { hertz: f, amplitude } if near(*f, 400.0, 4.0) && near(*amplitude, 0.02, 0.002)),
    );
    still(&with(&|t, v| v + 8.0 * t), &|w| matches!(w, Warning::Drift { amount } if near(*amount, 0.048, 0.004)));
    let spikes = with(&|t, v| {
        if [200, 201, 700, 1201].contains(&((t * 1.25e5).round() as u32)) { v + 1.7 } else { v }
    });
    still(&spikes, &|w| {
        let is_first = matches!(w, Warning::Spikes { count: 4, first } if near(*first, 0.0016, 1e-9));
        is_first && spikes.warnings.len() == 1
    });
    is_told(&plainly(&sampled(trapezoid, 200, 0.2)), &|w| matches!(w, Warning::NoiseHidesRamps { .. }));
    let sharp = plainly(&sampled(|t| f64::from((0.003..0.008).contains(&t)), 600, 0.005));
    assert_eq!(sharp.chosen, Kind::Box);
    is_told(&sharp, &|w| matches!(w, Warning::SharpEdges { .. }));
    // The whole uncertainty is the sampling's: both edges' to a root of 12.
    let step = 0.012 / 600.0;
    assert!((sharp.exposure.error / step - (2.0 / 12.0f64).sqrt()).abs() < 0.01);
    let triangle = |t: f64| (1.0 - (t - 0.006).abs() / 0.004).max(0.0);
    is_told(&plainly(&sampled(triangle, 1000, 0.005)), &|w| *w == Warning::NoPlateau);
    is_told(&plainly(&sampled(bounces, 1500, 0.003)), &|w| matches!(w, Warning::Misfit { .. }));
}

fn bounces(t: f64) -> f64 {
    trapezoid(t) * (1.0 - 0.3 * (9000.0 * t).sin().powi(2))
}

/// The least of many samples lies far below the dark by noise alone.
#[test]
fn noise_is_no_capacitor() {
    for n in [200, 300] {
        let noisy = plainly(&sampled(trapezoid, n, 0.17));
        assert!(!told(&noisy, |w| matches!(w, Warning::Coupled { .. })), "{n}: {:?}", noisy.warnings);
    }
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let options = Options::default();
    let refused = |trace: &Trace| fitted(trace, &options).err();
    let whole = sampled(trapezoid, 1000, 0.005);
    let part = |from: usize, to: usize| Trace {
        times: whole.times[from..to].to_vec(),
        values: whole.values[from..to].to_vec(),
    };
    for light in [Light::Auto, Light::Up] {
        for (part, begins, ends) in [(part(500, 1000), true, false), (part(0, 500), false, true)] {
            let refused = fitted(&part, &Options { light, ..Options::default() }).err();
            assert_eq!(refused, Some(Refusal::CutPulse { begins, ends }), "{light:?}");
        }
    }
    // Cut on both ramps, slow and fast ones, so that none of the dark is recorded.
    for ramp in [0.0001, 0.0004, 0.001, 0.002] {
        for cut in [0.05, 0.3, 0.5, 0.7] {
            let openness = |t: f64| (t / 0.012 * (0.01 - 2.0 * cut * ramp) + cut * ramp).min(0.01) / ramp;
            let trace = sampled(|t| openness(t).min(openness(0.012 - t)).min(1.0), 1000, 0.002);
            assert_eq!(refused(&trace), Some(Refusal::CutPulse { begins: true, ends: true }), "{ramp} {cut}");
        }
    }
    assert_eq!(refused(&part(0, 12)), Some(Refusal::TooFewSamples { samples: 12, required: 16 }));
    assert!(matches!(refused(&part(0, 160)), Some(Refusal::NoPulse { .. })));
    assert!(matches!(refused(&sampled(|_| 0.0, 1000, 0.0)), Some(Refusal::NoPulse { .. })));
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let mut noise = part(0, 1000);
        noise.values.iter_mut().for_each(|v| *v = random.normal());
        assert!(matches!(refused(&noise), Some(Refusal::NoPulse { .. })), "{seed}");
    }
    let short = sampled(|t| f64::from((0.006..0.00605).contains(&t)), 1000, 0.001);
    assert!(matches!(refused(&short), Some(Refusal::ShortPulse { .. })), "{:?}", refused(&short));
    let asked = |options: &Options| fitted(&whole, options).err();
    assert_eq!(
        asked(&Options { frame: Some(2), ..Options::default() }),
        Some(Refusal::NoFrame { number: 2, frames: 1 })
    );
    assert!(matches!(asked(&Options { full: Some(1.5), ..Options::default() }), Some(Refusal::FullTooLow { .. })));
    for broken in [(f64::NAN, 0.0), (0.0, f64::INFINITY), (7.0, 0.0)] {
        let mut trace = part(0, 1000);
        (trace.times[500], trace.values[500]) = broken;
        assert_eq!(refused(&trace), Some(Refusal::Unsound));
    }
    let unequal = Trace { times: whole.times.clone(), values: whole.values[1..].to_vec() };
    assert_eq!(refused(&unequal), Some(Refusal::Unsound));
    // Rows that are lost: with a ramp, and of the plateau alone.
    let lost = |from: usize, to: usize| {
        let mut trace = part(0, 1000);
        trace.times.drain(from..to);
        trace.values.drain(from..to);
        fitted(&trace, &options)
    };
    assert!(matches!(lost(150, 340), Err(Refusal::LostRamp { .. })));
    assert!(told(&lost(400, 500).unwrap(), |w| matches!(w, Warning::Gap { count: 1, .. })));
    // Light lowers nothing here: the trace would begin and end in it.
    assert!(asked(&Options { light: Light::Down, ..Options::default() }).is_some());
}

/// A trace of a shutter.
fn traced(shutter: &str, samples: f64, noise: f64, random: &mut Random) -> Case {
    let truth = Draw::tuned(random).shutter(shutter);
    Recorder::new(samples, 1.0, noise).record(truth, random)
}

/// Five frames of a leaf shutter whose exposures differ by some per mille.
fn frames(noise: f64) -> Trace {
    let mut random = Random::new(3);
    let leaf = Draw::tuned(&mut random).shutter("leaf");
    let mut trace = Trace::default();
    for k in 0..5 {
        let pace = [1.0, 1.004, 0.997, 1.002, 0.999][k];
        for i in 0..900 {
            let t = (i as f64 + 0.5) / 900.0;
            trace.times.push(k as f64 + t);
            trace.values.push(leaf.openness(t * pace) + noise * random.normal());
        }
    }
    trace
}

#[test]
fn of_several_frames_the_median_one_is_fitted_and_the_scatter_told() {
    let trace = frames(0.005);
    let fit = plainly(&trace);
    assert_eq!((fit.frames.count, fit.frames.fitted), (5, 1));
    assert!((0.002..0.004).contains(&fit.frames.scatter), "{:?}", fit.frames);
    assert!(fit.chosen > Kind::Trapezoid);
    let fourth = Options { frame: Some(4), model: Some(Kind::Free), ..Options::default() };
    let fourth = fitted(&trace, &fourth).unwrap();
    assert!(fourth.triggers.iter().all(|trigger| (3.0..4.0).contains(&trigger.value)));
}

/// A record of pulses `lit` ms wide at half, 12 ms apart, from a time to another; it says the exposure in ms, how many
/// pulses are left out and whether light is said to lower it, or refuses.
fn of_train(lit: f64, window: [f64; 2], light: Light, sign: f64) -> Result<(f64, usize, bool), Refusal> {
    let mut random = Random::new(5);
    let times: Vec<f64> = (0..((window[1] - window[0]) / 0.02) as u32).map(|i| 2e-5 * f64::from(i)).collect();
    let openness = |t: f64| (t.rem_euclid(12.0).min(lit + 0.8 - t.rem_euclid(12.0)) / 0.8).clamp(0.0, 1.0);
    let values = times.iter().map(|t| sign * (openness(1e3 * t + window[0]) + 0.004 * random.normal())).collect();
    let fit = fitted(&Trace { times, values }, &Options { light, ..Options::default() })?;
    let cut = fit.warnings.iter().filter(|w| matches!(w, Warning::PartialFrame { .. })).count();
    Ok((1e3 * fit.exposure.value, cut, told(&fit, |w| *w == Warning::Inverted)))
}

#[test]
fn pulses_that_the_record_cuts_are_left_out() {
    let is = |found: Result<(f64, usize, bool), Refusal>, lit: f64, left_out: usize| {
        let (exposure, cut, inverted) = found.unwrap();
        assert!((exposure / lit - 1.0).abs() < 2e-3 && (cut, inverted) == (left_out, false), "{exposure} {cut}");
    };
    let ways = [(Light::Auto, 1.0), (Light::Up, 1.0), (Light::Down, -1.0)];
    for (light, sign) in ways {
        // In a plateau, in a ramp.
        for begin in [2.0, 0.5] {
            is(of_train(4.0, [begin, 35.0], light, sign), 4.0, 1);
            is(of_train(4.0, [begin, 38.0], light, sign), 4.0, 2);
        }
        is(of_train(4.0, [-5.0, 14.0], light, sign), 4.0, 1);
    }
    // Of longer pulses than gaps nothing tells which is which, unless it is said; a gap is no pulse.
    for (window, left_out) in [([5.0, 32.5], 2), ([-1.0, 30.0], 1), ([3.0, 35.0], 1)] {
        assert_eq!(of_train(9.0, window, Light::Auto, 1.0), Err(Refusal::WhichWay), "{window:?}");
        is(of_train(9.0, window, Light::Up, 1.0), 9.0, left_out);
    }
    // With light that lowers the signal it is the same, but for much dark at the ends.
    assert_eq!(of_train(2.0, [-1.0, 16.0], Light::Auto, -1.0), Err(Refusal::WhichWay));
    let (exposure, cut, inverted) = of_train(2.0, [-9.0, 11.0], Light::Auto, -1.0).unwrap();
    assert!((exposure / 2.0 - 1.0).abs() < 2e-3 && (cut, inverted) == (0, true), "{exposure}");
}

/// Short ramps move few of the triggers, and a box comes as near to other shots: but it is not what the samples show.
#[test]
fn shots_that_agree_do_not_make_ramps_edges() {
    let mut random = Random::new(8);
    let times: Vec<f64> = (0..3600).map(|i| 1e-5 * f64::from(i)).collect();
    let openness = |t: f64| (t - 0.002).min(0.0087 - t).clamp(0.0, 3e-4) / 3e-4;
    let values = times.iter().map(|t| openness(t % 0.012) + 0.002 * random.normal()).collect();
    let fit = plainly(&Trace { times, values });
    assert_eq!((fit.frames.count, fit.chosen, fit.warnings.len()), (3, Kind::Trapezoid, 0));
    let Curve { opening, closing, .. } = fit.best().signal.curve;
    assert!((opening / 3e-4 - 1.0).abs() < 0.03 && (closing / 3e-4 - 1.0).abs() < 0.03);
}

/// The gaps between shots are no part of their sampling, however long they are.
#[test]
fn shots_an_hour_apart_are_as_good_as_shots_side_by_side() {
    let one = sampled(trapezoid, 900, 0.005);
    let at = |apart: f64| {
        let mut trace = Trace::default();
        for k in 0..3 {
            trace.times.extend(one.times.iter().map(|t| t + apart * f64::from(k)));
            trace.values.extend(&one.values);
        }
        plainly(&trace)
    };
    let near = at(0.012);
    for apart in [0.1, 10.0, 3600.0] {
        let far = at(apart);
        assert_eq!((far.frames.count, far.chosen), (3, near.chosen), "{apart} s");
        let [a, b] = [near.exposure, far.exposure];
        assert!((a.value / b.value - 1.0).abs() < 2e-4, "{apart} s: {b:?}");
        assert!(b.error < 1.3 * a.error, "{apart} s: {b:?}, {a:?}");
    }
}

/// The exposure counts in full light, and noise hides how high a peak without a plateau is: not as a linear model has
/// it.
#[test]
fn the_exposure_is_known_without_a_plateau_too() {
    let covered = each(24, |seed| {
        let mut random = Random::new(700 + u64::from(seed));
        let [start, peak, end] = [0.2, random.within(0.3, 0.6), random.within(0.65, 0.8)];
        let straight: fn(f64) -> f64 = |z| z;
        let ramp = if seed % 2 == 0 { straight } else { soft };
        let truth = Truth::new(ramp, ramp, [start, peak, peak, end]);
        let (n, noise) = (random.scale(400.0, 1000.0), random.scale(0.003, 0.02));
        let case = Recorder::new(n, 1.0, noise).record(truth, &mut random);
        let fit = case.fitted(&Options::default());
        let (exposure, truth) = (fit.exposure, case.exposure());
        assert!(exposure.error < 0.03 * truth, "{seed}: {exposure:?}");
        assert!(fit.efficiency.error < 0.1, "{seed}: {:?}", fit.efficiency);
        (exposure.value - truth).abs() <= 1.96 * exposure.error
    });
    let share = covered.iter().filter(|covered| **covered).count() as f64 / covered.len() as f64;
    assert!(share > 0.85, "covered: {share}");
}

/// A photodiode with a time constant of 60 µs in front of a 10-bit converter, 50 kHz: solved in steps of a microsecond.
fn photodiode(openness: impl Fn(f64) -> f64) -> String {
    let (mut level, mut text) = (0.0, String::from("time_ms,counts\n"));
    let mut random = Random::new(9);
    for i in 0..24_000 {
        level += (openness(f64::from(i) * 1e-6) - level) / 60.0;
        if i % 20 == 0 {
            let counts = (35.0 + 870.0 * level + 1.5 * random.normal()).round();
            writeln!(text, "{:.3},{counts}", f64::from(i) * 1e-3).unwrap();
        }
    }
    text
}

/// A leaf shutter's ramp, smooth at both ends.
fn soft(z: f64) -> f64 {
    let z = z.clamp(0.0, 1.0);
    z * z * (3.0 - 2.0 * z)
}

#[test]
fn a_photodiode_shifts_the_triggers_by_its_time_constant() {
    let truth = Truth::new(soft, soft, [0.004, 0.008, 0.013, 0.019]);
    let (fit, _) = through(photodiode(|t| truth.openness(t)), &trace::Options::default());
    let exposure = truth.exposure();
    assert!((fit.exposure.value / exposure - 1.0).abs() < 0.001, "{:?}", fit.exposure);
    for (i, trigger) in fit.triggers.iter().enumerate() {
        let late = trigger.value - truth.trigger((i as f64 + 0.5) / 16.0);
        assert!((late - 60e-6).abs() < 0.002 * exposure, "trigger {i}: {late}");
    }
}

/// A scene with a fit's shutter.
fn scene(shutter: &scene::Shutter, fit: &Fit) -> String {
    shutter.text() + &fitted::flashes(shutter, fit.triggers.len())
}

/// The triggers of the scene that a fit writes, by the crate itself.
fn planned(fit: &Fit) -> Plan {
    Plan::parse(&scene(&fitted::shutter(fit, "a trace\nwith two lines", None).unwrap(), fit)).unwrap()
}

#[test]
fn the_scene_gives_the_same_triggers() {
    for (k, shutter) in TUNED.into_iter().enumerate() {
        let mut random = Random::new(40 + k as u64);
        let case = traced(shutter, 1000.0, 0.005, &mut random);
        let fit = case.fitted(&Options::default());
        let plan = planned(&fit);
        assert_eq!((plan.triggers.len(), plan.start), (16, 0.0));
        for (a, b) in plan.triggers.iter().zip(&fit.triggers) {
            let off = a.time - (b.value - fit.opens);
            assert!(off.abs() < 2e-6 * fit.exposure.value, "{shutter:?}: {off:e}");
        }
    }
}

#[test]
fn every_corner_of_the_control_numbers_is_a_scene() {
    each(16, |corner| {
        let own = std::array::from_fn(|k| f64::from(corner >> (k % 4) & 1));
        let truth = Draw { start: 0.2, length: 0.6, a: 0.2, b: 0.3, own }.shutter("symmetric cubics");
        let case = Recorder::new(200.0, 1.0, 0.0).record(truth, &mut Random::new(0));
        for model in [Kind::Symmetric, Kind::Free] {
            let options = Options { model: Some(model), ..Options::default() };
            planned(&case.fitted(&options));
        }
    });
}

#[test]
fn hostile_texts_are_refused_or_fitted_and_never_more() {
    let options = trace::Options::default();
    let refused = |bytes: &[u8]| match trace::open(bytes, &options) {
        Err(refusal) => refusal.to_string(),
        Ok(Recording { trace, .. }) => fitted(&trace, &Options::default()).err().expect("a refusal").to_string(),
    };
    let timed = |v: &str| (0..100).map(|i| format!("{},{v}\n", 0.3 * f64::from(i))).collect::<String>();
    for (bytes, reason) in [
        (b"hello\nworld\n".into(), "no row of numbers"),
        (b"{\"a\": 1}".into(), "no row of numbers"),
        (vec![b'7'; 50 << 20], "all values stand in one line"),
        ("1,2,".repeat(12 << 20).into(), "all values stand in one line"),
        ("t,v\n".repeat(1 << 20).into(), "no row of numbers"),
        ("0,NaN\n".repeat(100).into(), "no column holds times"),
        ("NaN,NaN\n".repeat(100).into(), "no column holds times"),
        ("1e308,-1e308\n".repeat(100).into(), "no column holds times"),
        ("1,2,3\n".repeat(100).into(), "no column holds times"),
        (timed("NaN").into(), "100 of 100 rows"),
        (timed("1e308").into(), "no finite number up to 1e30"),
        ("0.5\n".repeat(100).into(), "give the sampling rate"),
    ] {
        let said = refused(&bytes);
        assert!(said.contains(reason), "{reason}: {said}");
    }
    let huge: String = (0..100).map(|i| format!("{i}e28,{}e29\n", i % 7)).collect();
    refused(huge.as_bytes());
    let tiny: String = (0..100).map(|i| format!("{i}e-300,{}e-300\n", i32::from(i > 30 && i < 70))).collect();
    let trace = trace::open(tiny.as_bytes(), &options).unwrap().trace;
    let _ = fitted(&trace, &Options::default());
}

#[test]
fn the_program_writes_a_scene_and_a_picture_that_plan_takes() {
    let folder = Folder::new("written");
    folder.write("leaf&co.csv", leaf(1.0));
    let line = "fit 'leaf&co.csv' --out a.toml --picture a.svg --triggers 5";
    let out = folder.run(line).well().out;
    assert!(out.lines().all(|line| line.chars().count() <= 80), "{out}");
    let scene = folder.text("a.toml");
    let plan = Plan::parse(&scene).unwrap();
    assert_eq!(plan.triggers.len(), 5);
    assert!((plan.curve.unwrap().shutter.exposure() - 0.005).abs() < 5e-6 && plan.start == 0.0);
    let picture = folder.text("a.svg");
    assert!(picture.contains("\n<svg ") && picture.contains("leaf&amp;co.csv"));
    assert_eq!(picture.matches("<circle").count(), 5);
}

/// The README's way: a trace that no Bezier made (a leaf shutter whose blades swing on a spring, a photodiode with an
/// RC of 30 µs, 10 bits) becomes a scene, and that the module by which the firmware's example fires.
#[test]
fn from_a_trace_to_the_firmwares_module() {
    let read = |path: &str| fs::read_to_string(format!("{SCENES}/../{path}")).unwrap();
    let trace = trace::open(read("traces/leaf.csv").as_bytes(), &trace::Options::default()).unwrap();
    assert!(trace.warnings.is_empty(), "{:?}", trace.warnings);
    // Its oscilloscope was triggered by the sync.
    let options = Options { sync: Some(Sync::Edge(0.0)), ..Options::default() };
    let [fit, synced] = [Options::default(), options].map(|options| fitted(&trace.trace, &options).unwrap());
    // The same with the timer of the board and what the lamp needs, which a user fills in.
    let kept = Plan::parse(MEASURED).unwrap();
    for (fitted, kept) in planned(&fit).triggers.iter().zip(&kept.triggers) {
        assert!((fitted.time - kept.time).abs() < 1e-4 * fit.exposure.value);
    }
    let seconds = |plan: &Plan| plan.sync.delay.unwrap().seconds;
    let delay = seconds(&planned(&synced));
    assert!((delay - seconds(&kept)).abs() < 1e-4 * fit.exposure.value);
    let form = shutter_plan::emit::Form::Rust;
    let module = shutter_plan::emit::emit(form, "measured", &kept, true).unwrap();
    assert_eq!(module, read("../examples/trigger/measured.rs"));
}

/// Its pulses match the trace without any curve: by each trigger, the samples themselves have gathered that trigger's
/// share.
#[test]
fn the_firmwares_pulses_split_the_light_of_the_trace() {
    let leaf = include_bytes!("../../traces/leaf.csv");
    let trace = trace::open(leaf, &trace::Options::default()).unwrap().trace;
    let samples = || trace.times.iter().zip(&trace.values);
    let dark = |t: f64| !(0.004..0.0145).contains(&t);
    let (sum, count) = samples().filter(|(t, _)| dark(**t)).fold((0.0, 0.0), |(sum, n), (_, v)| (sum + v, n + 1.0));
    let level = sum / count;
    // Each sample stands for the time around it.
    let step = trace.times[1] - trace.times[0];
    let light =
        |until: f64| -> f64 { samples().map(|(t, v)| ((until - t) / step + 0.5).clamp(0.0, 1.0) * (v - level)).sum() };
    let plan = Plan::parse(MEASURED).unwrap();
    for trigger in &plan.triggers {
        let time = f64::from(trigger.ticks) / f64::from(plan.timer.hz);
        let share = light(plan.sync.delay.unwrap().seconds + time) / light(1.0);
        assert!((share - f64::from(trigger.u.unwrap())).abs() < 5e-4, "{trigger:?}: {share}");
    }
}

/// One object whose names and codes stay as they are, with what the report says.
#[test]
fn a_program_reads_json() {
    let folder = Folder::new("json");
    for (name, trace, from) in
        [("model.csv", sampled(trapezoid, 1200, 0.005), "model"), ("trace.csv", sampled(bounces, 1500, 0.003), "trace")]
    {
        folder.write(name, format!("time,v\n{}", rows(&trace, |t, v| format!("{t:.6},{v:.5}"))));
        let json = folder.json(&format!("{name} --triggers 5"));
        assert_eq!(json["triggers_from"], from);
        assert_eq!(json["fit"]["explained"], from == "model");
        assert_eq!(json["columns"]["signal"], 2);
        assert_eq!(json["triggers"].as_array().unwrap().len(), 5);
        assert!(number(&json["triggers"][4], "time_s") < 0.009);
        ["exposure_error_s", "efficiency", "opens_s"].iter().for_each(|key| _ = number(&json, key));
        assert_eq!(json["efficiency_error"].is_null(), json["efficiency_most"].is_number());
        if from == "model" {
            assert!((number(&json, "exposure_s") - 0.005).abs() < 5e-6);
        }
        let codes = codes(&json);
        assert!(codes.contains(&"unit_assumed"), "{codes:?}");
        assert_eq!(codes.contains(&"misfit"), from == "trace", "{codes:?}");
        assert_eq!((&json["unit"], &json["delay_s"]), (&"s".into(), &Value::Null));
    }
    // Several are an array of such objects, with the same keys; so is one with the name of its speed.
    let plain = folder.json("model.csv --sync 0.4ms");
    let both = folder.json("model.csv trace.csv --sync 0 --nominal 1/250,5ms");
    let sorted = |json: &Value| keys(json).into_iter().collect::<std::collections::BTreeSet<_>>();
    assert_eq!((both.as_array().unwrap().len(), sorted(&both[1])), (2, sorted(&plain)));
    assert_eq!([0, 1].map(|i| number(&both[i], "nominal_s")), [0.004, 0.005]);
    let off = number(&plain, "opens_s") - number(&plain, "delay_s");
    assert!((off - 4e-4).abs() < 1e-12 && number(&plain, "delay_error_s") > 0.0, "{off}");
}

/// The fit ends its window where the light ends, not the light where its window does.
#[test]
fn tails_are_looked_at_to_their_end() {
    let sampled = |f: &dyn Fn(f64) -> f64, ends: [f64; 2], n: usize, seed: u64| {
        let mut random = Random::new(seed);
        let times: Vec<f64> = (0..n).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / n as f64).collect();
        let values = times.iter().map(|t| f(*t) + 0.002 * random.normal()).collect();
        plainly(&Trace { times, values })
    };
    let decay = |t: f64| (t / 2e-4).clamp(0.0, 1.0) * (-(t - 2e-4).max(0.0) / 7e-4).exp();
    each(4, |seed| {
        let fit = sampled(&decay, [-0.02, 0.03], 3000, u64::from(seed));
        let off = (fit.exposure.value - 8e-4).abs();
        assert!(off < (2.5 * fit.exposure.error).min(4e-5), "{seed}: {:?}", fit.exposure);
        assert!(!told(&fit, |w| matches!(w, Warning::CutTail { .. })), "{seed}: {:?}", fit.warnings);
    });
    let cut = sampled(&decay, [-0.02, 0.0015], 2000, 1);
    assert!(told(&cut, |w| matches!(w, Warning::CutTail { .. })), "{:?}", cut.warnings);
    // A third of the signal lags by 60 ms behind a shutter of 6 ms: by its step answer, worked out for each ramp.
    let lag = |t: f64| if t > 0.0 { t - 0.06 * (1.0 - (-t / 0.06).exp()) } else { 0.0 };
    let lagging =
        |t: f64| [(0.0, 1.0), (5e-4, -1.0), (6e-3, -1.0), (6.5e-3, 1.0)].map(|(at, by)| by * lag(t - at) / 5e-4);
    let shutter = |t: f64| (t.min(6.5e-3 - t) / 5e-4).clamp(0.0, 1.0);
    let slow = |t: f64| 0.7 * shutter(t) + 0.3 * lagging(t).iter().sum::<f64>();
    let fit = sampled(&slow, [-0.03, 0.4], 8600, 3);
    let with = fit.warnings.iter().find_map(|w| match w {
        Warning::SlowTail { with, .. } => Some(*with),
        _ => None,
    });
    assert!((fit.exposure.value - 6e-3).abs() < 5e-5, "{:?}", fit.exposure);
    // All of it is 6 ms at 1, and full light 0.7 with some of the lag.
    assert!((0.0078..0.0088).contains(&with.unwrap_or(0.0)), "{:?}", fit.warnings);
    assert!(!told(&fit, |w| matches!(w, Warning::Drift { .. })), "{:?}", fit.warnings);
}

#[test]
fn what_mends_is_an_option_of_the_program() {
    let help = Folder::new("mends").run("fit --help").quietly();
    let (refusals, warnings) = (Refusal::each(), Warning::each());
    let remedies = refusals.iter().filter_map(Tell::remedy).chain(warnings.iter().filter_map(Tell::remedy));
    for option in remedies.map(|it| it.option()) {
        assert!(help.contains(&format!(" --{option} ")), "{option}");
    }
}
