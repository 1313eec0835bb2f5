//! Which calls of a series were searched for: told by the host, whose answers have the same bits.

use ::firmware::{CURVES, Function, SCALES, TICK_HZ};
use shutter_curve::ShutterCurve;

use crate::trace::Key;

/// What a call asked for.
#[derive(Clone, Copy)]
pub struct Asked {
    /// The fraction of the exposure.
    pub u: f64,
    /// Did the answer take more than a polynomial or the plateau's line?
    pub searched: bool,
}

/// The calls of a series, in order; none for functions other than the inverse and the step of a frame's triggers.
pub fn asked(key: &Key) -> Vec<Asked> {
    match key.cells {
        0 => series::<0>(key),
        4 => series::<4>(key),
        8 => series::<8>(key),
        _ => series::<16>(key),
    }
}

fn series<const CELLS: usize>(key: &Key) -> Vec<Asked> {
    let data = &CURVES[key.curve];
    match key.function {
        Function::InverseCdf => {
            let curve = built::<CELLS>(key.curve, None);
            let asked = |u: f32| Asked { u: u.into(), searched: !curve.is_direct(u) };
            key.inputs.us(data).map(asked).collect()
        }
        Function::TickStep => {
            let curve = built::<CELLS>(key.curve, SCALES[key.inputs.scale()]);
            let frames = key.inputs.frames(data);
            let steps = frames.flat_map(|(n, steps)| {
                let frame = curve.trigger_ticks(n, TICK_HZ).expect("a good rate");
                (0..steps).map(move |i| Asked {
                    u: (2.0 * f64::from(i) + 1.0) / (2.0 * f64::from(n)),
                    searched: !frame.is_direct(i),
                })
            });
            steps.collect()
        }
        _ => Vec::new(),
    }
}

fn built<const CELLS: usize>(curve: usize, scale: Option<u32>) -> ShutterCurve<CELLS> {
    let (opening, closing) = CURVES[curve].scaled(scale);
    ShutterCurve::with_cells(opening, closing).expect("a good curve")
}
