//! Which calls of a series were searched for: told by the host, whose answers have the same bits.

use ::firmware::{CURVES, Function, SCALES};
use shutter_curve::ShutterCurve;

use crate::trace::Key;

/// What a call asked for.
#[derive(Clone, Copy)]
pub struct Asked {
    /// The fraction of the exposure.
    pub u: f64,
    /// Did the answer take a search? `None` where that can't be told.
    pub searched: Option<bool>,
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
            let asked = |u: f32| Asked { u: u.into(), searched: Some(curve.evaluations(u) > 0) };
            key.inputs.us(data).map(asked).collect()
        }
        Function::TickStep => {
            let curve = built::<CELLS>(key.curve, SCALES[key.inputs.scale()]);
            let frames = key.inputs.frames(data);
            let triggers = frames.flat_map(|(n, steps)| (0..steps).map(move |i| (n, i)));
            triggers.map(|(n, i)| trigger(&curve, n, i)).collect()
        }
        _ => Vec::new(),
    }
}

fn built<const CELLS: usize>(curve: usize, scale: Option<u32>) -> ShutterCurve<CELLS> {
    let (opening, closing) = CURVES[curve].scaled(scale);
    ShutterCurve::with_cells(opening, closing).expect("a good curve")
}

/// Trigger `i` of `n`. Its fraction need not be an `f32`: then it is told where its two neighbours agree.
fn trigger<const CELLS: usize>(curve: &ShutterCurve<CELLS>, n: u32, i: u32) -> Asked {
    let u = (2.0 * f64::from(i) + 1.0) / (2.0 * f64::from(n));
    let near = u as f32;
    let other = if f64::from(near) < u { near.next_up() } else { near.next_down() };
    let searched = curve.evaluations(near) > 0;
    let is_told = f64::from(near) == u || searched == (curve.evaluations(other) > 0);
    Asked { u, searched: is_told.then_some(searched) }
}
