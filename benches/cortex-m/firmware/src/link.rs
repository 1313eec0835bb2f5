//! Calls every public function with inputs that the compiler knows nothing of.
//!
//! Left out are `valid`, which exists to panic in a constant, and `Debug`, `Display` and `defmt::Format`: core's
//! formatting has panics of its own.

use core::hint::black_box;

use firmware::baseline::Ramp;
use shutter_curve::{BezierPdf, CubicBezier, CurveError, ScheduleError, ShutterCurve};

/// A program that links only where its panic handler is never needed: it calls what does not exist.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    unsafe extern "C" {
        safe fn a_panic_can_be_reached() -> !;
    }
    a_panic_can_be_reached()
}

pub fn everything() {
    let ramp: &Ramp = black_box(&[(0.0, 0.0); 4]);
    let (opening, closing) =
        (CubicBezier::new(*ramp), black_box(CubicBezier::line(ramp[0], ramp[1])));
    black_box(opening.points());
    black_box(opening == closing);
    black_box(CubicBezier::shutteropening(black_box([0.0; 4]), black_box([0.0; 8])));
    black_box(ShutterCurve::new(opening, closing).map_err(curve_error).is_ok());
    black_box(
        ShutterCurve::linear(ramp[0].0, ramp[0].1, ramp[1].0, ramp[1].1)
            .map_err(curve_error)
            .is_ok(),
    );
    black_box(
        ShutterCurve::shutteropening(black_box([0.0; 4]), black_box([0.0; 8]))
            .map_err(curve_error)
            .is_ok(),
    );
    linear::<16>(ramp);
    shutter::<0>(opening, closing);
    shutter::<4>(opening, closing);
    shutter::<8>(opening, closing);
    shutter::<16>(opening, closing);
    black_box(BezierPdf::new(opening).map_err(curve_error).is_ok());
    pdf::<0>(opening);
    pdf::<8>(opening);
}

fn linear<const CELLS: usize>(ramp: &Ramp) {
    let [(a, b), (c, d), ..] = *ramp;
    black_box(ShutterCurve::<CELLS>::linear_with_cells(a, b, c, d).map_err(curve_error).is_ok());
    let (times, inner) = (black_box([0.0; 4]), black_box([0.0; 8]));
    black_box(
        ShutterCurve::<CELLS>::shutteropening_with_cells(times, inner).map_err(curve_error).is_ok(),
    );
}

fn shutter<const CELLS: usize>(opening: CubicBezier, closing: CubicBezier) {
    let curve = match ShutterCurve::<CELLS>::with_cells(opening, closing) {
        Ok(curve) => black_box(curve),
        Err(error) => return curve_error(error),
    };
    black_box([curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()]);
    black_box([curve.exposure(), curve.normalization(), curve.efficiency()]);
    let x: f32 = black_box(0.5);
    black_box([curve.opening(x), curve.pdf(x), curve.cdf(x), curve.inverse_cdf(x)]);
    // Their length is one and the same, which is all that the compiler knows of it.
    let (u, mut t, length) = (black_box([0.5; 300]), [0.0; 300], black_box(150));
    if let (Some(u), Some(t)) = (u.get(..length), t.get_mut(..length)) {
        curve.inverse_cdf_slice(u, t);
    }
    black_box(t);
    black_box((curve.is_direct(x), curve.evaluations(x)));
    let n: u32 = black_box(64);
    black_box(curve.max_triggers(x));
    black_box(curve.direct_triggers());
    let mut times = curve.trigger_times(n);
    black_box(times.len());
    black_box([times.nth(black_box(2)), times.next_back(), times.nth_back(black_box(2))]);
    black_box(times.clone().last());
    for t in times {
        black_box(t);
    }
    match curve.trigger_ticks(n, black_box(1_000)) {
        Ok(mut ticks) => {
            black_box((ticks.len(), ticks.is_direct(black_box(2))));
            black_box([ticks.nth(black_box(2)), ticks.next_back(), ticks.nth_back(black_box(2))]);
            black_box(ticks.clone().last());
            for tick in ticks {
                black_box(tick);
            }
        }
        Err(error) => schedule_error(error),
    }
    black_box(
        curve.most_triggers(n, black_box(1_000), black_box(3)).map_err(schedule_error).is_ok(),
    );
    let mut ticks = [0; 16];
    let places = ticks.get_mut(..black_box(9)).unwrap_or(&mut []);
    black_box(
        curve.schedule_into(places, black_box(1_000), black_box(3)).map_err(schedule_error).is_ok(),
    );
    black_box(ticks);
    match curve.pulse_ticks(n, black_box(0.5), black_box(1_000)) {
        Ok(mut pulses) => {
            black_box(pulses.len());
            black_box([
                pulses.nth(black_box(2)),
                pulses.next_back(),
                pulses.nth_back(black_box(2)),
            ]);
            black_box(pulses.clone().last());
            for pulse in pulses {
                black_box(pulse);
            }
        }
        Err(error) => schedule_error(error),
    }
    let mut pulses = [(0, 0); 16];
    let places = pulses.get_mut(..black_box(9)).unwrap_or(&mut []);
    let filled = curve.pulses_into(places, x, black_box(1_000), black_box(3), black_box(2));
    black_box(filled.map_err(schedule_error).is_ok());
    black_box(pulses);
    match curve.schedule::<64>(n, black_box(1_000), black_box(3)) {
        Ok(ticks) => drop(black_box(ticks)),
        Err(error) => schedule_error(error),
    }
    black_box(curve == black_box(curve));
}

fn pdf<const CELLS: usize>(curve: CubicBezier) {
    let pdf = match BezierPdf::<CELLS>::with_cells(curve) {
        Ok(pdf) => black_box(pdf),
        Err(error) => return curve_error(error),
    };
    let x: f32 = black_box(0.5);
    black_box([pdf.area(), pdf.normalization(), pdf.pdf(x), pdf.cdf(x), pdf.inverse_cdf(x)]);
    black_box(pdf == black_box(pdf));
}

fn curve_error(error: CurveError) {
    black_box(error.message());
    black_box(error == black_box(error));
}

fn schedule_error(error: ScheduleError) {
    black_box(error == black_box(error));
}
