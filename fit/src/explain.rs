//! A frame's fits, with a flicker where that explains what they do not, and with the dark's noise where nothing does.

use std::cmp::max_by_key;

use crate::frame::FrameFits;
use crate::missed::Parts;
use crate::noise::slow_correlation;
use crate::signal::Kind;
use crate::structure::structure;
use crate::trace::{Frame, Pulses};

/// The fits of a frame; `progress` is told the share that is done, as far as that is known.
pub fn fits(
    pulses: &Pulses,
    frame: &Frame,
    mains: Option<f64>,
    progress: &mut dyn FnMut(f64),
) -> FrameFits {
    let mut fits = FrameFits::new(pulses, frame, mains, progress);
    if structure(&fits, Kind::Free).test.explained {
        return fits;
    }
    // A lamp's flicker is looked for where there is something to explain, and taken where it explains that.
    if let Some(others) =
        fits.flickering().filter(|others| structure(others, Kind::Free).test.explained)
    {
        return others;
    }
    // What the freest curve misses is no noise, and counts for none of it.
    let parts = Parts::new(&fits, Kind::Free);
    let longer = max_by_key(parts.before, parts.after, |part| part.len());
    let dark = slow_correlation(&fits.of(Kind::Free).residuals[longer]);
    fits.correlation = dark.min(fits.correlation);
    fits
}
