//! `cargo bench`: what a call takes on this machine; a minute after its build.
//!
//! `cargo bench -- trapezoid` measures what has that in its name. Nothing is written.

use std::fmt;
use std::time::Duration;

use divan::{Bencher, Divan, black_box};
use methods::{CURVES, Inverse, METHODS, curve, fractions};
use shutter_curve::ShutterCurve;
use support::cases::shutter;

#[path = "../host/speed_vs_error/accuracy.rs"]
#[allow(dead_code)] // The report has more figures.
mod accuracy;
#[path = "../host/speed_vs_error/methods.rs"]
#[allow(dead_code)]
mod methods;
#[path = "../../tests/support/mod.rs"]
mod support;

const CALLS: usize = 1000;
/// The fractions for which errors are taken, a curve.
const SAMPLES: usize = 1 << 14;
/// The triggers of a schedule.
const TRIGGERS: usize = 64;
/// The rate of the timer: the curves last for a second.
const TICK_HZ: u32 = 1 << 24;

fn main() {
    println!(
        "Times are of {CALLS} calls each at random fractions of the exposure, so µs stand for ns a call; of one\n\
         schedule, and of building one curve. Behind a method: the largest error and the mean one, as shares of the\n\
         interval; and the bytes of a curve. With 0 octaves each answer is a search.\n"
    );
    Divan::default().min_time(Duration::from_millis(300)).config_with_args().main();
}

/// What is measured in a row.
struct Row<T> {
    name: String,
    bytes: usize,
    what: T,
}

impl<T> fmt::Display for Row<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:<48}{:>6} B", self.name, self.bytes)
    }
}

/// Each method on each of the curves that it serves.
fn inverses() -> Vec<Row<Box<dyn Inverse>>> {
    let of_curve = (0..CURVES.len()).flat_map(|place| {
        let curve = curve(place);
        let figures = accuracy::measure(&[curve], SAMPLES);
        METHODS.iter().zip(figures).filter_map(move |(method, figures)| {
            let name = method.name.replace('`', "").replace("OCTAVES =", "this crate, octaves");
            let ((most, mean), what) = (figures.of_interval, (method.build)(&curve)?);
            let name = format!("{:<10}{name:<22}{most:>8.1e}{mean:>8.1e}", CURVES[place][0]);
            Some(Row { name, bytes: size_of_val(&*what), what })
        })
    });
    of_curve.collect()
}

#[divan::bench(args = inverses())]
fn inverse_cdf(bencher: Bencher, row: &Row<Box<dyn Inverse>>) {
    time(bencher, &*row.what);
}

/// Each time at other fractions.
fn time(bencher: Bencher, inverse: &dyn Inverse) {
    let us = fractions(1 << 20);
    let mut runs = us.chunks_exact(CALLS).cycle();
    bencher.with_inputs(move || runs.next().unwrap_or_default()).bench_local_values(|us| inverse.each(us));
}

fn curves() -> Vec<Row<ShutterCurve>> {
    let rows = CURVES.iter().enumerate().map(|(place, [name, _])| {
        let what = shutter(&curve(place));
        Row { name: name.to_string(), bytes: size_of_val(&what), what }
    });
    rows.collect()
}

/// All of the curves last from 0 to 1.
#[divan::bench(args = curves())]
fn cdf(bencher: Bencher, row: &Row<ShutterCurve>) {
    time(bencher, &|t| row.what.cdf(t));
}

#[divan::bench(args = curves())]
fn tick(bencher: Bencher, row: &Row<ShutterCurve>) {
    let frame = row.what.trigger_ticks(CALLS as u32, TICK_HZ).expect("a good rate");
    bencher.bench_local(|| frame.clone().for_each(|tick| _ = black_box(tick)));
}

#[divan::bench(name = "schedule of 64", args = curves())]
fn schedule(bencher: Bencher, row: &Row<ShutterCurve>) {
    let mut ticks = [0; TRIGGERS];
    bencher.bench_local(|| (black_box(&row.what).ticks_into(&mut ticks, TICK_HZ, 1).is_ok(), ticks[TRIGGERS - 1]));
}

#[divan::bench(args = 0..CURVES.len())]
fn building(bencher: Bencher, place: usize) {
    let curve = curve(place);
    bencher.bench_local(|| shutter::<8>(black_box(&curve)));
}
