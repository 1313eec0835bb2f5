//! `cargo bench`: what a call takes on this machine, beside its error and its bytes; a minute after its build.
//!
//! `cargo bench -- trapezoid` measures what has that in its name. Nothing is written.

use std::fmt;
use std::time::Duration;

use divan::{Bencher, Divan, black_box};
use methods::{CURVES, Inverse, METHODS, Method, Task, fractions};
use shutter_curve::ShutterCurve;
use support::cases::shutter;
use support::oracle::{Curve, Exact};

#[path = "../host/speed_vs_error/accuracy.rs"]
#[allow(dead_code)] // The report has more figures.
mod accuracy;
#[path = "../host/speed_vs_error/methods.rs"]
#[allow(dead_code)]
mod methods;
#[path = "../../tests/support/mod.rs"]
mod support;

/// The fractions for which errors are taken, a curve.
const SAMPLES: usize = 1 << 14;
/// The triggers of a schedule.
const TRIGGERS: usize = 64;
/// The rate of the timer: the curves last for a second, and half a tick is about as much as an `f32` rounds.
const TICK_HZ: u32 = 1 << 24;

fn main() {
    println!(
        "Times are of one call, at random fractions of the exposure. Behind a name: the largest error and the mean one, as\n\
         shares of the interval (of `cdf`: of the exposure); and the bytes of a curve. With 0 octaves each answer is a search.\n"
    );
    Divan::default().min_time(Duration::from_millis(300)).config_with_args().main();
}

/// What is measured in a row.
struct Row<T> {
    name: String,
    /// The largest error and the mean.
    errors: Vec<f64>,
    bytes: usize,
    what: T,
}

impl<T> fmt::Display for Row<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { name, errors, bytes, .. } = self;
        let errors = errors.iter().map(|error| format!("{error:>8.1e}")).collect::<String>();
        write!(f, "{name:<22}{errors:<16}{bytes:>6} B")
    }
}

/// The methods that serve one of [`CURVES`].
fn inverses(curve: usize) -> Vec<Row<Method>> {
    let curve = CURVES[curve].1;
    let figures = accuracy::measure(&[curve], SAMPLES);
    let served = METHODS.into_iter().zip(figures).filter(|(_, figures)| figures.curves > 0);
    let name = |method: Method| {
        let name = method.name().replace('`', "");
        let octaves = name.strip_prefix("OCTAVES = ");
        octaves.map(|octaves| format!("this crate, {octaves} octaves")).unwrap_or(name)
    };
    let rows = served.map(|(method, figures)| Row {
        name: name(method),
        errors: vec![figures.of_interval.0, figures.of_interval.1],
        bytes: method.build(&curve).map_or(0, |inverse| size_of_val(&*inverse)),
        what: method,
    });
    rows.collect()
}

impl Task for Bencher<'_, '_> {
    type Answer = ();
    fn on(self, inverse: impl Inverse + 'static) {
        let mut u = fractions().into_iter().cycle();
        let next = move || u.next().unwrap_or_default();
        self.with_inputs(next).bench_local_values(|u| inverse.inverse_cdf(u));
    }
}

mod inverse_cdf {
    use super::*;

    #[divan::bench(args = inverses(0))]
    fn soft(bencher: Bencher, row: &Row<Method>) {
        row.what.on(&CURVES[0].1, bencher);
    }
    #[divan::bench(name = "all ramp", args = inverses(1))]
    fn all_ramp(bencher: Bencher, row: &Row<Method>) {
        row.what.on(&CURVES[1].1, bencher);
    }
    #[divan::bench(args = inverses(2))]
    fn trapezoid(bencher: Bencher, row: &Row<Method>) {
        row.what.on(&CURVES[2].1, bencher);
    }
    #[divan::bench(name = "box", args = inverses(3))]
    fn without_ramps(bencher: Bencher, row: &Row<Method>) {
        row.what.on(&CURVES[3].1, bencher);
    }
}

/// The curves, with the errors of some call of theirs.
fn curves(errors: fn(&Curve) -> Vec<f64>) -> Vec<Row<Curve>> {
    let rows = CURVES.map(|(name, curve)| Row {
        name: name.into(),
        errors: errors(&curve),
        bytes: size_of::<ShutterCurve>(),
        what: curve,
    });
    rows.into()
}

/// The largest error and the mean.
fn spread(errors: impl Iterator<Item = f64>) -> Vec<f64> {
    let (most, sum, count) = errors.fold((0.0f64, 0.0, 0), |(most, sum, n), e| (most.max(e), sum + e, n + 1));
    vec![most, sum / f64::from(count)]
}

/// Of ticks, as times.
fn of_ticks(curve: &Curve, count: u32, ticks: impl Iterator<Item = u32>) -> Vec<f64> {
    let (exact, start) = (Exact::new(curve), f64::from(curve.open_start()));
    let length = f64::from(curve.close_end()) - start;
    let us = (0..count).map(|i| (f64::from(i) + 0.5) / f64::from(count));
    spread(us.zip(ticks).map(|(u, tick)| {
        let t = start + f64::from(tick) / f64::from(TICK_HZ);
        (t - exact.inverse_cdf(u as f32).hi).abs() / length
    }))
}

fn next_ticks(curve: &Curve) -> Vec<f64> {
    let frame = shutter::<8>(curve);
    of_ticks(curve, 1 << 12, frame.trigger_ticks(1 << 12, TICK_HZ).expect("a good rate"))
}

#[divan::bench(args = curves(next_ticks))]
fn tick(bencher: Bencher, row: &Row<Curve>) {
    let curve = shutter::<8>(&row.what);
    let frame = || curve.trigger_ticks(1 << 12, TICK_HZ).expect("a good rate").cycle();
    let mut ticks = frame();
    bencher.bench_local(|| ticks.next());
}

fn scheduled(curve: &Curve) -> Vec<f64> {
    let mut ticks = [0; TRIGGERS];
    shutter::<8>(curve).ticks_into(&mut ticks, TICK_HZ, 1).expect("wide gaps");
    of_ticks(curve, TRIGGERS as u32, ticks.into_iter())
}

#[divan::bench(name = "schedule of 64", args = curves(scheduled))]
fn schedule(bencher: Bencher, row: &Row<Curve>) {
    let curve = shutter::<8>(&row.what);
    let mut ticks = [0; TRIGGERS];
    bencher.bench_local(|| {
        let planned = black_box(&curve).ticks_into(&mut ticks, TICK_HZ, 1).is_ok();
        (planned, ticks[TRIGGERS - 1])
    });
}

fn fraction(curve: &Curve) -> Vec<f64> {
    let (exact, ours) = (Exact::new(curve), shutter::<8>(curve));
    let times = fractions().into_iter().take(SAMPLES);
    spread(times.map(|t| (f64::from(ours.cdf(t)) - exact.cdf(t).hi).abs()))
}

/// All of the curves last from 0 to 1.
#[divan::bench(args = curves(fraction))]
fn cdf(bencher: Bencher, row: &Row<Curve>) {
    let (curve, mut times) = (shutter::<8>(&row.what), fractions().into_iter().cycle());
    let next = move || times.next().unwrap_or_default();
    bencher.with_inputs(next).bench_local_values(|t| curve.cdf(t));
}

#[divan::bench(args = curves(|_| Vec::new()))]
fn building(bencher: Bencher, row: &Row<Curve>) {
    bencher.bench_local(|| shutter::<8>(black_box(&row.what)));
}
