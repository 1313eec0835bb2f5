//! The models compared: a frame's fits, with a flicker where that explains what they do not, and with the dark's noise
//! where nothing does; what each kind's curve comes to, and which kind is the simplest that serves.

use std::cmp::max_by_key;

use crate::columns;
use crate::frame::FrameFits;
use crate::missed::Parts;
use crate::noise::slow_correlation;
use crate::outcome::{Candidate, Options, Reason};
use crate::signal::Kind;
use crate::structure::structure;
use crate::trace::{Frame, Pulses};

/// The fits of a frame; `progress` is told the share that is done, as far as that is known.
pub fn fits(pulses: &Pulses, frame: &Frame, mains: Option<f64>, progress: &mut dyn FnMut(f64)) -> FrameFits {
    let mut fits = columns::fits(pulses, frame, mains, progress);
    let is_explained = |fits: &FrameFits| structure(fits, Kind::Free).test.explained;
    if is_explained(&fits) {
        return fits;
    }
    if let Some(others) = columns::coupled_twice(&fits) {
        fits = others;
        if is_explained(&fits) {
            return fits;
        }
    }
    // A lamp's flicker is looked for where there is something to explain, and taken where it explains that.
    if let Some(others) = columns::flickering(&fits).filter(is_explained) {
        return others;
    }
    // What the freest curve misses is no noise, and counts for none of it.
    let parts = Parts::new(&fits, Kind::Free);
    let longer = max_by_key(parts.before, parts.after, |part| part.len());
    let dark = slow_correlation(&fits.of(Kind::Free).residuals[longer]);
    fits.correlation = dark.min(fits.correlation);
    fits
}

/// Every kind's curve, judged by `n` triggers.
pub fn candidates(fits: &FrameFits, n: u32) -> Vec<Candidate> {
    let least = Kind::ALL.into_iter().map(|kind| fits.bic(kind)).fold(f64::INFINITY, f64::min);
    let free = fits.triggers(Kind::Free, n);
    let candidate = |kind: Kind| {
        let fitted = fits.of(kind);
        let signal = &fitted.solution.signal;
        let shifts = fits.triggers(kind, n).into_iter().zip(&free).map(|(a, b)| (a - b).abs());
        Candidate {
            signal: fits.units.outside(signal),
            rms: fitted.variance().sqrt() / signal.gain,
            delta_bic: fits.bic(kind) - least,
            shift: shifts.fold(0.0, f64::max) * fits.units.pulse,
        }
    };
    Kind::ALL.into_iter().map(candidate).collect()
}

/// The kind that is asked for, or else the one of least criterion, and where that does not explain the trace, the
/// simplest freer one that does.
pub fn choose(options: &Options, candidates: &[Candidate], fits: &FrameFits) -> (Kind, Reason) {
    if let Some(kind) = options.model {
        return (kind, Reason::Asked);
    }
    let best = candidates.iter().find(|candidate| candidate.delta_bic <= 0.0);
    let kind = best.map_or(Kind::Free, |candidate| candidate.signal.kind);
    let mut freer = Kind::ALL[kind as usize..].iter();
    match freer.find(|freer| structure(fits, **freer).test.explained) {
        Some(freer) if *freer > kind => (*freer, Reason::Explains),
        _ => (kind, Reason::Criterion { effective: fits.effective() }),
    }
}
