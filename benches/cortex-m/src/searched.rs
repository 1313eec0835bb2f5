//! Which calls of a series were searched for: told by the host, whose answers have the same bits.

use measured::{CURVES, Function, SCALES, Series, TICK_HZ};
use shutter_curve::ShutterCurve;

/// The calls of a series, in order: each the fraction of the exposure that it asked for, and whether the answer took more
/// than a polynomial or the plateau's line; none for functions other than the inverse and the step of a frame's triggers.
pub fn asked(series: Series) -> Vec<(f64, bool)> {
    match series.cells {
        0 => with::<0>(series),
        4 => with::<4>(series),
        8 => with::<8>(series),
        _ => with::<16>(series),
    }
}

fn with<const CELLS: usize>(series: Series) -> Vec<(f64, bool)> {
    let (opening, closing) = CURVES[series.curve].ramps(SCALES[series.scale()]);
    let curve = ShutterCurve::<CELLS>::with_cells(opening, closing).expect("a good curve");
    match series.function {
        Function::InverseCdf => series.us().map(|u| (u.into(), !curve.is_direct(u))).collect(),
        Function::TickStep => {
            let steps = series.frames().flat_map(|(n, steps)| {
                let frame = curve.trigger_ticks(n, TICK_HZ).expect("a good rate");
                let u = move |i| (2.0 * f64::from(i) + 1.0) / (2.0 * f64::from(n));
                (0..steps).map(move |i| (u(i), !frame.is_direct(i)))
            });
            steps.collect()
        }
        _ => Vec::new(),
    }
}
