//! Calls every public function with inputs that the compiler knows nothing of.
//!
//! Left out are `valid`, which exists to panic in a constant, and `Debug`, `Display` and `defmt::Format`: core's
//! formatting has panics of its own.

use core::hint::black_box;

use measured::baseline::Ramp;
use shutter_curve::{BezierPdf, CubicBezier, CurveError, ScheduleError, ShutterCurve};

/// A program that links only where its panic handler is never needed: it calls what does not exist.
pub fn panicked(_: &core::panic::PanicInfo) -> ! {
    unsafe extern "C" {
        safe fn a_panic_can_be_reached() -> !;
    }
    a_panic_can_be_reached()
}

pub fn run() -> ! {
    let ramp: &Ramp = black_box(&[(0.0, 0.0); 4]);
    let [(a, b), (c, d), ..] = *ramp;
    let (times, inner) = (black_box([0.0; 4]), black_box([0.0; 8]));
    let opening = CubicBezier::new(*ramp);
    let closing = black_box(CubicBezier::line(ramp[0], ramp[1]));
    black_box((opening.points(), opening == closing));
    black_box(CubicBezier::shutteropening(times, inner));
    shutter(ShutterCurve::new(opening, closing));
    shutter(ShutterCurve::linear(a, b, c, d));
    shutter(ShutterCurve::shutteropening(times, inner));
    shutter::<16>(ShutterCurve::linear_with_cells(a, b, c, d));
    shutter::<16>(ShutterCurve::shutteropening_with_cells(times, inner));
    shutter::<0>(ShutterCurve::with_cells(opening, closing));
    shutter::<4>(ShutterCurve::with_cells(opening, closing));
    shutter::<8>(ShutterCurve::with_cells(opening, closing));
    shutter::<16>(ShutterCurve::with_cells(opening, closing));
    pdf(BezierPdf::new(opening));
    pdf::<0>(BezierPdf::with_cells(opening));
    pdf::<8>(BezierPdf::with_cells(opening));
    // Ends nowhere: what ends a program may panic.
    loop {
        core::hint::spin_loop();
    }
}

#[inline(never)]
fn shutter<const CELLS: usize>(built: Result<ShutterCurve<CELLS>, CurveError>) {
    let Some(curve) = curve_of(built) else { return };
    black_box([curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()]);
    black_box([curve.exposure(), curve.normalization(), curve.efficiency()]);
    let (x, n, rate, gap): (f32, u32, u32, u32) = black_box((0.5, 64, 1_000, 3));
    black_box([curve.opening(x), curve.pdf(x), curve.cdf(x), curve.inverse_cdf(x)]);
    // Their length is one and the same, which is all that the compiler knows of it.
    let (u, mut t, length) = (black_box([0.5; 300]), [0.0; 300], black_box(150));
    if let (Some(u), Some(t)) = (u.get(..length), t.get_mut(..length)) {
        curve.inverse_cdf_slice(u, t);
    }
    black_box((t, curve.is_direct(x), curve.evaluations(x)));
    black_box((curve.max_triggers(x), curve.direct_triggers()));
    every(curve.trigger_times(n));
    if let Some(ticks) = scheduled(curve.trigger_ticks(n, rate)) {
        black_box(ticks.is_direct(n));
        every(ticks);
    }
    scheduled(curve.pulse_ticks(n, x, rate)).map(every);
    scheduled(curve.most_triggers(n, rate, gap));
    let mut ticks = [0; 16];
    let places = ticks.get_mut(..black_box(9)).unwrap_or(&mut []);
    scheduled(curve.schedule_into(places, rate, gap));
    let mut pulses = [(0, 0); 16];
    let places = pulses.get_mut(..black_box(9)).unwrap_or(&mut []);
    scheduled(curve.pulses_into(places, x, rate, gap, n));
    black_box((ticks, pulses));
    scheduled(curve.schedule::<64>(n, rate, gap));
    black_box(curve == black_box(curve));
}

/// All that an iterator of the crate can do.
fn every<T>(mut all: impl DoubleEndedIterator<Item = T> + ExactSizeIterator + Clone) {
    black_box(all.len());
    black_box([all.nth(black_box(2)), all.next_back(), all.nth_back(black_box(2))]);
    black_box(all.clone().last());
    for one in all {
        black_box(one);
    }
}

fn pdf<const CELLS: usize>(built: Result<BezierPdf<CELLS>, CurveError>) {
    let Some(pdf) = curve_of(built) else { return };
    let x: f32 = black_box(0.5);
    black_box([pdf.area(), pdf.normalization(), pdf.pdf(x), pdf.cdf(x), pdf.inverse_cdf(x)]);
    black_box(pdf == black_box(pdf));
}

fn curve_of<T>(built: Result<T, CurveError>) -> Option<T> {
    built
        .map_err(|error| black_box((error.message(), error == black_box(error))))
        .ok()
        .map(black_box)
}

fn scheduled<T>(made: Result<T, ScheduleError>) -> Option<T> {
    made.map_err(|error| black_box(error == black_box(error))).ok().map(black_box)
}
