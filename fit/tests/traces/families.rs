//! Shutters, lamps and recorders that no model of the program has, with the truth by numerical integration.

use std::f64::consts::{PI, TAU};

use shutter_fit::trace::Trace;
use strum::EnumIter;

use crate::generator::{Case, Random, Truth, circle};

#[derive(Clone, Copy, Debug, PartialEq, Eq, EnumIter)]
pub enum Family {
    Bounce,
    DeepBounce,
    Dip,
    Overshoot,
    Reopens,
    Slit,
    LiquidCrystal,
    CutTail,
    Coupled,
    SoundCard,
    Clipped,
    ClippedNoise,
    Flicker,
    Pulsed,
    Differing,
    Coarse,
    Creep,
    Sinks,
    Shallow,
}

/// A leaf's ramp from rest to rest.
fn leaf(z: f64) -> f64 {
    let z = z.clamp(0.0, 1.0);
    circle(z * z * (3.0 - 2.0 * z))
}

/// A damped oscillation from 1 at 0 on.
fn ringing(t: f64, periods: f64, decay: f64) -> f64 {
    if t < 0.0 { 0.0 } else { (-t / decay).exp() * (TAU * t / periods).cos() }
}

/// What the shutter does, where the recorder adds nothing.
fn mechanics(family: Family, random: &mut Random) -> Truth {
    let start = random.within(0.25, 0.32);
    let length = random.within(0.3, 0.42);
    let (a, b) = (random.within(0.1, 0.3) * length, random.within(0.1, 0.3) * length);
    let (open, close, end) = (start + a, start + length - b, start + length);
    let plain = move |t: f64| leaf((t - start) / a).min(leaf((end - t) / b));
    let swing = random.within(0.05, 0.1) * length;
    match family {
        // Blades hit their stop and come back a little, some times.
        Family::Bounce | Family::DeepBounce => {
            let deep = if family == Family::Bounce { (0.01, 0.06) } else { (0.1, 0.35) };
            let (deep, fades) = (random.within(deep.0, deep.1), random.within(0.8, 2.0) * swing);
            Truth::of(move |t| {
                let since = t - open;
                let back = deep * (-since / fades).exp() * (PI * since / swing).sin().abs();
                if (0.0..close - open).contains(&since) { 1.0 - back } else { plain(t) }
            })
        }
        Family::Dip => {
            let at = open + random.within(0.15, 0.3) * (close - open);
            let (deep, wide) = (random.within(0.05, 0.09), random.within(0.1, 0.2) * (close - open));
            Truth::of(move |t| plain(t) - deep * (-((t - at) / wide).powi(2)).exp() * f64::from(plain(t) >= 1.0))
        }
        // A magnet draws the blade beyond its place, where it rings until it rests.
        Family::Overshoot => {
            let (high, decay) = (random.within(0.05, 0.2), random.within(0.6, 1.5) * swing);
            let fall = random.within(0.02, 0.05) * length;
            Truth::of(move |t| {
                let rise = 1.0 - (1.0 - high) * ringing(t - start, 2.0 * swing, decay);
                let open = if t < start { 0.0 } else { rise - high * (-(t - start) / decay).exp() };
                let late = t - close;
                if late > 0.0 { open * (-late / fall).exp() } else { open.max(0.0) }
            })
        }
        Family::Reopens => {
            let (high, wide) = (random.within(0.02, 0.12), random.within(0.05, 0.12) * length);
            let at = end + random.within(0.3, 0.8) * wide;
            Truth::of(move |t| {
                let x = (t - at) / wide;
                plain(t) + if (0.0..1.0).contains(&x) { high * (PI * x).sin() } else { 0.0 }
            })
        }
        // Two curtains before a round sensor, with an acceleration each.
        Family::Slit => {
            let (p, q) = (random.within(0.8, 1.3), random.within(0.8, 1.3));
            Truth::of(move |t| {
                let first = circle(((t - start) / a).clamp(0.0, 1.0).powf(p));
                let second = circle(((t - close) / b).clamp(0.0, 1.0).powf(q));
                first - second
            })
        }
        Family::LiquidCrystal | Family::CutTail => {
            let (rise, fall) = (random.within(0.02, 0.05), random.within(0.04, 0.08));
            let (open, closed) = (rise * length, fall * length);
            // Two time constants in the relaxation, as thick cells have it.
            let slow = if family == Family::CutTail { random.within(4.0, 8.0) } else { 2.0 };
            let share = random.within(0.1, 0.3);
            Truth::of(move |t| {
                let late = (t - close).max(0.0) / closed;
                let up = 1.0 - (-(t - start).max(0.0) / open).exp();
                up * ((1.0 - share) * (-late).exp() + share * (-late / slow).exp())
            })
        }
        // A leaf that hardly moves when it is nearly closed.
        Family::Creep => {
            let slow = random.within(0.5, 1.5);
            Truth::of(move |t| {
                let late = (t - close).max(0.0) / b;
                let down = 0.85 * (1.0 - late).max(0.0).powi(2) + 0.15 * (-late / slow).exp();
                leaf((t - start) / a) * if late > 0.0 { down } else { 1.0 }
            })
        }
        // The lamp warms up, or the blades sag.
        Family::Sinks => {
            let by = random.within(0.005, 0.02);
            Truth::of(move |t| plain(t) * (1.0 - by * ((t - open) / (close - open)).clamp(0.0, 1.0)))
        }
        // A dip of a hundredth for a fifth of the time.
        Family::Shallow => {
            let wide = 0.2 * length;
            let at = random.within(open + 0.5 * wide, close - 0.5 * wide);
            Truth::of(move |t| plain(t) - 0.01 * f64::from((t - at).abs() < 0.5 * wide))
        }
        _ => Truth::of(plain),
    }
}

/// One high-pass pole, with its time constant in the time of the trace.
fn high_pass(values: &mut [f64], tau: f64, step: f64) {
    let (mut charge, mut before) = (values[0], values[0]);
    for v in values {
        let (now, pass) = (*v, (-step / tau).exp());
        // Between two samples the signal goes straight.
        charge = charge * pass + (1.0 - pass) * 0.5 * (now + before);
        before = now;
        *v = now - charge;
    }
}

/// A trace of a family.
pub fn measured(family: Family, random: &mut Random) -> Case {
    let truth = mechanics(family, random);
    // Milliseconds to some tens, as the lamp's frequencies need.
    let scale = random.scale(0.01, 0.06);
    // A shallow dip may be hidden.
    let (most, least, noisy) = if family == Family::Shallow { (2000.0, 400.0, 0.02) } else { (5000.0, 800.0, 0.01) };
    let n = random.scale(least, most) as usize;
    let noise = random.scale(0.001, noisy);
    let lamp = lamp(family, scale, random);
    let light = |t: f64| lamp(t) * truth.openness(t);
    // Many steps to a sample, so that no recorder sees a staircase.
    let fine: usize = 8;
    let step = 1.0 / (n * fine) as f64;
    let mut signal: Vec<f64> = (0..n * fine).map(|i| light((i as f64 + 0.5) * step)).collect();
    let mut clip = f64::INFINITY;
    match family {
        Family::Coupled => high_pass(&mut signal, random.scale(0.3, 30.0), step),
        Family::SoundCard => {
            high_pass(&mut signal, random.scale(0.1, 1.0), step);
            high_pass(&mut signal, random.scale(0.1, 2.0), step);
        }
        Family::Clipped | Family::ClippedNoise => clip = random.within(0.85, 0.97),
        _ => (),
    }
    // The mean over a sample.
    let means = signal.chunks(fine).map(|few| few.iter().sum::<f64>() / fine as f64);
    // An amplifier clips what it is given, noise and all; behind it the recorder adds a little.
    let (early, late) = if family == Family::ClippedNoise { (1.0, 0.1) } else { (0.0, 1.0) };
    let mut noisy = |v: f64| {
        let shown = (v + early * noise * random.normal()).min(clip);
        shown + late * noise * random.normal()
    };
    let mut values: Vec<f64> = means.map(&mut noisy).collect();
    let mut times: Vec<f64> = (0..n).map(|i| scale * (i as f64 + 0.5) / n as f64).collect();
    let mut others = Vec::new();
    match family {
        Family::CutTail => {
            let kept = (n as f64 * random.within(0.66, 0.78)) as usize;
            (times, values) = (times[..kept].to_vec(), values[..kept].to_vec());
        }
        Family::Coarse => {
            let levels = random.within(30.0, 120.0).round();
            values.iter_mut().for_each(|v| *v = (*v * levels).round() / levels);
        }
        Family::Differing => {
            let ratio = random.within(1.05, 3.0);
            let other = mechanics(Family::Differing, random);
            let second = ratio * scale * other.exposure() / truth.exposure();
            for shot in 1..4 {
                let odd = shot % 2 == 1;
                let from = scale * 3.0 * f64::from(shot);
                let scale = if odd { scale * ratio } else { scale };
                let shown = if odd { &other } else { &truth };
                for i in 0..n {
                    let t = (i as f64 + 0.5) / n as f64;
                    times.push(from + scale * t);
                    values.push(shown.openness(t) + noise * random.normal());
                }
            }
            others.push(second * truth.exposure());
        }
        _ => (),
    }
    Case { truth, trace: Trace { times, values }, scale, noise, others }
}

/// A lamp's light over the trace.
fn lamp(family: Family, scale: f64, random: &mut Random) -> Box<dyn Fn(f64) -> f64> {
    let phase = random.within(0.0, TAU);
    match family {
        Family::Flicker => {
            let mains = if random.within(0.0, 1.0) < 0.5 { 100.0 } else { 120.0 };
            let (first, second) = (random.scale(0.01, 0.3), random.within(0.0, 0.3));
            Box::new(move |t| {
                let angle = TAU * mains * t * scale + phase;
                1.0 + first * (angle.cos() + second * (2.0 * angle).cos())
            })
        }
        Family::Pulsed => {
            let (hertz, duty) = (random.scale(300.0, 3000.0), random.within(0.3, 0.8));
            Box::new(move |t| f64::from((hertz * t * scale + phase).rem_euclid(1.0) < duty))
        }
        _ => Box::new(|_| 1.0),
    }
}

/// A leaf shutter before a sound card of one capacitor or two, of these frequencies in hertz: one shot or several, with
/// so much dark before each and so much more from its opening on, in seconds; light may lower the signal.
pub fn coupled(exposure: f64, poles: &[f64], window: (f64, f64), shots: u32, falls: bool, random: &mut Random) -> Case {
    let rate = if random.within(0.0, 1.0) < 0.5 { 44_100.0 } else { 48_000.0 };
    let noise = random.scale(0.001, 0.01);
    let (a, b) = (random.within(0.1, 0.4) * exposure, random.within(0.1, 0.4) * exposure);
    // A leaf's ramps let half of the light through.
    let open = exposure - 0.5 * (a + b);
    let (before, after) = window;
    let length = before + after;
    let shown = move |t: f64| leaf(t / a).min(leaf((a + open + b - t) / b));
    let truth = Truth::of(|t| shown(t * length - before));
    let (fine, n) = (16, (rate * length * f64::from(shots)) as usize);
    let step = 1.0 / (rate * fine as f64);
    let mut charges = vec![0.0; poles.len()];
    let (mut times, mut values) = (Vec::new(), Vec::new());
    for k in 0..n {
        let mut sum = 0.0;
        for i in 0..fine {
            let t = (k * fine + i) as f64 * step + 0.5 * step;
            let mut v = shown(t % length - before);
            for (charge, hertz) in charges.iter_mut().zip(poles) {
                let keeps = (-TAU * hertz * step).exp();
                let now = *charge * keeps + v * (1.0 - keeps);
                (v, *charge) = (v - 0.5 * (now + *charge), now);
            }
            sum += v / fine as f64;
        }
        let sign = if falls { -1.0 } else { 1.0 };
        let v = sign * (sum + noise * random.normal());
        times.push((k as f64 + 0.5) / rate);
        values.push((12_000.0 * v).round());
    }
    // Which of several shots was fitted is not known.
    let others = if shots > 1 { vec![truth.exposure() * length] } else { Vec::new() };
    Case { truth, noise, trace: Trace { times, values }, scale: length, others }
}
