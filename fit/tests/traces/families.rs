//! Families of traces as tables: a shutter, what is done to its signal, and what a fit of it has to keep.

use std::f64::consts::TAU;

use shutter_fit::Kind;

use crate::generator::{Case, Grain, Over, Random, Recorder};
use crate::shutters::Draw;

/// What an instrument or a disturbance does to a recorder.
pub type Instrument = fn(&mut Recorder, &mut Random);

fn plain(_: &mut Recorder, _: &mut Random) {}

/// What disturbs traces of the shutters on which the fit was tuned.
pub const DISTURBED: [(&str, Instrument); 5] = [
    ("white noise", plain),
    ("coloured noise", |it, _| it.grain = Grain::Coloured),
    ("hum", |it, random| it.beside = sine(random.scale(3.0, 30.0), random.scale(0.005, 0.03), random)),
    ("drift", |it, random| it.beside = times(random.within(-0.05, 0.05), |t| t)),
    ("1/f noise", |it, _| it.grain = Grain::Octaves),
];

/// Those on which nothing was tuned.
pub const INSTRUMENTS: [(&str, Instrument); 10] = [
    ("clean", plain),
    ("jitter", |it, _| (it.steps, it.jitter) = (3000.0, 0.2)),
    ("eight bits", |it, _| it.steps = 200.0),
    ("few samples", |it, random| it.samples = random.scale(60.0, 400.0)),
    ("mains", |it, random| {
        let periods = random.within(0.7, 2.2);
        it.scale = periods / mains(random);
        it.beside = sine(periods, random.scale(0.004, 0.04), random);
    }),
    ("1/f noise", |it, _| it.grain = Grain::Sines),
    ("a capacitor", |it, random| it.poles = vec![4.0 / random.scale(6.0, 40.0)]),
    ("lost rows", |it, random| {
        let from = random.within(0.2, 0.7);
        it.lost = from..from + random.scale(0.005, 0.1);
    }),
    ("a drift that bends", |it, random| {
        let bend = random.within(1.0, 4.0);
        it.beside = times(random.within(-0.06, 0.06), move |t| (-bend * t).exp());
    }),
    ("shot noise", |it, _| it.grain = Grain::Shot),
];

/// Shutters, lamps and recorders that no model of the program has: a name, the shutter, and the recorder.
pub const FAMILIES: [(&str, &str, Instrument); 19] = [
    ("bounces", "bounce", plain),
    ("deep bounces", "deep bounce", plain),
    ("dips", "dip", plain),
    ("overshoots", "overshoot", plain),
    ("opens again", "reopens", plain),
    ("a slit", "slit", plain),
    ("a liquid crystal of two time constants", "thick crystal", plain),
    ("a liquid crystal's tail cut off", "thicker crystal", |it, random| it.lost = random.within(0.66, 0.78)..1.0),
    ("a capacitor", "plain", |it, random| it.poles = vec![1.0 / random.scale(0.3, 30.0)]),
    ("two capacitors", "plain", |it, random| {
        it.poles = vec![1.0 / random.scale(0.1, 1.0), 1.0 / random.scale(0.1, 2.0)]
    }),
    ("clipped", "plain", |it, random| it.clip = random.within(0.85, 0.97)),
    ("clipped, with the noise", "plain", |it, random| {
        (it.clip, it.is_clipped_with_noise) = (random.within(0.85, 0.97), true)
    }),
    ("flicker of 1 to 30 %", "plain", |it, random| {
        let periods = 2.0 * mains(random) * it.scale;
        let (first, second) = (random.scale(0.01, 0.3), random.within(0.0, 0.3));
        let phase = random.within(0.0, TAU);
        it.lamp = Box::new(move |t| {
            let angle = TAU * periods * t + phase;
            1.0 + first * (angle.cos() + second * (2.0 * angle).cos())
        });
    }),
    ("a switched lamp", "plain", |it, random| {
        let (periods, duty) = (random.scale(300.0, 3000.0) * it.scale, random.within(0.3, 0.8));
        it.lamp = Box::new(move |t| f64::from((periods * t).fract() < duty));
    }),
    ("shots that differ", "plain", |it, random| (it.shots, it.ratio) = (4, random.within(1.05, 3.0))),
    ("30 to 120 steps", "plain", |it, random| it.steps = random.within(30.0, 120.0).round()),
    ("a leaf that creeps", "creeps", plain),
    ("full light that sinks by 0.5 to 2 %", "sinks", plain),
    // It may be hidden.
    ("a dip of 1 %", "shallow dip", |it, random| {
        (it.samples, it.noise) = (random.scale(400.0, 2000.0), random.scale(0.001, 0.02))
    }),
];

/// A trace of a family.
pub fn of_family((_, shutter, instrument): (&str, &str, Instrument), random: &mut Random) -> Case {
    let truth = Draw::new([(0.25, 0.32), (0.3, 0.42), (0.1, 0.3)], random).shutter(shutter);
    let (samples, scale) = (random.scale(800.0, 5000.0), random.scale(0.01, 0.06));
    let mut recorder = Recorder::new(samples, scale, random.scale(0.001, 0.01));
    instrument(&mut recorder, random);
    recorder.record(truth, random)
}

/// One of a shutter on which the fit was tuned.
pub fn tuned(shutter: &str, disturb: Instrument, random: &mut Random) -> Case {
    let truth = Draw::tuned(random).shutter(shutter);
    let (samples, scale) = (random.scale(400.0, 4000.0), random.scale(1e-4, 10.0));
    let mut recorder = Recorder::new(samples, scale, random.scale(0.003, 0.02));
    // One detector shows the moment, the other what it has gathered since its last sample.
    recorder.gathers = random.within(0.0, 1.0) < 0.5;
    level(&mut recorder, random);
    disturb(&mut recorder, random);
    let kinds = [("box", Kind::Box), ("straight ramps", Kind::Trapezoid), ("symmetric cubics", Kind::Symmetric)];
    let kind = kinds.iter().find(|(name, _)| *name == shutter).map(|(_, kind)| *kind);
    // A liquid crystal has no ends: those of all but 0.5 % of the light.
    let [[start, end], [open, close]] = [0.005, 0.995].map(|openness| truth.within_openness(openness));
    let times = if shutter == "liquid crystal" { [start, open, close, end] } else { truth.times };
    let times = Some(times.map(|time| time * scale));
    Case { kind, times, ..recorder.record(truth, random) }
}

/// One of mechanics and an instrument on which nothing was tuned.
pub fn unseen(shutter: &str, instrument: Instrument, random: &mut Random) -> Case {
    let truth = Draw::new([(0.26, 0.33), (0.26, 0.38), (0.08, 0.4)], random).shutter(shutter);
    let (samples, scale) = (random.scale(600.0, 6000.0), random.scale(0.003, 0.2));
    let mut recorder = Recorder::new(samples, scale, random.scale(0.0015, 0.01));
    level(&mut recorder, random);
    instrument(&mut recorder, random);
    recorder.record(truth, random)
}

/// A leaf shutter before a sound card of capacitors of these frequencies in hertz: one shot or several, with so much
/// dark before each and so much more from its opening on, in seconds; light may lower the signal.
pub fn coupled(
    exposure: f64,
    poles: &[f64],
    (before, after): (f64, f64),
    shots: usize,
    falls: bool,
    random: &mut Random,
) -> Case {
    let length = before + after;
    let [a, b] = [0; 2].map(|_| random.within(0.1, 0.4) * exposure / length);
    // A leaf's ramps let half of the light through.
    let open = exposure / length + 0.5 * (a + b);
    let truth = Draw { start: before / length, length: open, a, b, own: [0.0; 8] }.shutter("plain");
    let rate = if random.within(0.0, 1.0) < 0.5 { 44_100.0 } else { 48_000.0 };
    let mut recorder = Recorder::new(rate * length, length, random.scale(0.001, 0.01));
    recorder.poles = poles.iter().map(|hertz| TAU * hertz * length).collect();
    (recorder.shots, recorder.steps) = (shots, 12_000.0);
    recorder.gain = if falls { -1.0 } else { 1.0 };
    recorder.record(truth, random)
}

fn level(recorder: &mut Recorder, random: &mut Random) {
    recorder.dark = random.within(-1.0, 1.0);
    recorder.gain = random.scale(0.05, 5.0) * if random.within(0.0, 1.0) < 0.3 { -1.0 } else { 1.0 };
}

/// The mains' frequency in hertz.
fn mains(random: &mut Random) -> f64 {
    if random.within(0.0, 1.0) < 0.5 { 50.0 } else { 60.0 }
}

fn sine(periods: f64, high: f64, random: &mut Random) -> Over {
    let phase = random.within(0.0, TAU);
    times(high, move |t| (TAU * periods * t + phase).sin())
}

fn times(factor: f64, of: impl Fn(f64) -> f64 + 'static) -> Over {
    Box::new(move |t| factor * of(t))
}
