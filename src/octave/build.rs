//! The octaves of a side: which part of a ramp each serves. A candidate is kept if it has a certificate.

use crate::exposure::Exposure;
use crate::fraction::Side;
use crate::number::units::{FINE, LEAST_TOP, TOP_STEP, floor_bits};
use crate::octave::certificate::certain;
use crate::octave::path::{Path, View};
use crate::octave::span::Span;
use crate::octave::{Octave, below};
use crate::ramp::shape::Shape;

/// By how many steps the tops are moved beyond the end of their ramp, one after the other. A ramp's last octave is
/// often too much for one polynomial. If the tops are moved, the last part of the ramp has a polynomial of its own. The
/// first number is taken that leaves no octave without a polynomial, or else the last. These were found by trial, on
/// random curves.
const MOVES: [u32; 4] = [0, 5, 6, 4];

/// The fractions between which a ramp has octaves, seen from a side. No side counts beyond 1/2.
pub(crate) const fn range(exposure: &Exposure, side: Side, ramp: Side) -> [f64; 2] {
    let [near, far] = exposure.joins(side);
    if !ramp.is(side) {
        return [far, 0.5];
    }
    // If the opening ramp ends below FINE, the plateau from there to FINE is not on its line, and the look-up takes it
    // for a part of this ramp. So this ramp gets no octaves; nor does such a closing ramp, for the mirror's sake.
    let is_hidden = near < far && near < FINE as f64;
    let to = if near < 0.5 { near } else { 0.5 };
    [0.0, if is_hidden { 0.0 } else { to }]
}

/// Builds the octaves of a side, in units of time of `2^unit`. Returns the tops by ramp, in [`TOP_STEP`]s above
/// [`LEAST_TOP`]. The far ramp's octaves come first, and the near ramp's top is raised by one octave for each of them,
/// so that a difference to a ramp's own top is an index among both.
///
/// Out of line, and with a slice, so that it is the same for any number of octaves.
#[inline(never)]
pub(crate) const fn build(
    exposure: &Exposure,
    shapes: &[Shape; 2],
    unit: i32,
    side: Side,
    octaves: &mut [Octave],
) -> [u8; 2] {
    let view = View { exposure, shapes, side, unit };
    let (mut tops, mut first, mut i) = ([0; 2], 0, 0);
    while i < 2 {
        let ramp = [side.other(), side][i];
        let (top, end) = view.of_ramp(ramp, octaves, first);
        // It fits a byte, since a raised top is below 2³. Let the far ramp have `n` octaves. Its top `f` is below 1,
        // and the top of its last octave, `2 f / 2ⁿ`, is above the near ramp's end and above LEAST_TOP / 2. The near
        // ramp's top is less than twice that end (a step beyond it and moved by six, at most 15/8), or twice LEAST_TOP:
        // so less than `8 f / 2ⁿ`. (If that ramp is hidden
        // or empty, its top is at most 9/8 of the far ramp's beginning, or LEAST_TOP.) Raised `n` times it is below
        // `8 f`.
        tops[ramp as usize] = ((top - LEAST_TOP + ((first as u32) << 23)) / TOP_STEP) as u8;
        first = end;
        i += 1;
    }
    tops
}

impl View<'_> {
    /// Builds the octaves of a ramp, in the places from `first` on. Returns the bits of their top, and the place after
    /// the last one.
    #[inline(never)]
    const fn of_ramp(&self, ramp: Side, octaves: &mut [Octave], first: usize) -> (u32, usize) {
        let range = range(self.exposure, self.side, ramp);
        if range[0] >= range[1] {
            // Here too a fraction may be looked up: on side 0, one of the plateau that is at most FINE, and so not on
            // its line, counts as on the near ramp. It must not find a polynomial. There is none from `first` on
            // ([`range`]), but from a lower top its index might be less than that, one of the far ramp's. So the top is
            // at or above all such fractions.
            let far = self.exposure.joins(self.side)[1];
            return (
                top_beyond([0.0, if far < FINE as f64 { far } else { FINE as f64 }], 0),
                first,
            );
        }
        let (path, mut trial) = (self.path(ramp), 0);
        loop {
            let highest = top_beyond(range, MOVES[trial % MOVES.len()]);
            trial += 1;
            let (mut index, mut end) = (first, first);
            while index < octaves.len() {
                octaves[index] = Octave::NONE;
                let top = below(highest, index - first);
                if f32::from_bits(top) as f64 > range[0] && top + (1 << 23) > LEAST_TOP {
                    // One octave whose top is below LEAST_TOP has a place, too, if never a polynomial. Let the ramps
                    // join at 0.7 LEAST_TOP, and the far ramp's tops be 7/8 of powers of two. Without that place, 0.8
                    // LEAST_TOP on the far ramp would be looked up in the near ramp's first octave.
                    end = index + 1;
                }
                if let Some(span) = Span::new(range, top) {
                    octaves[index] = self.certified(ramp, &path, &span);
                    if !octaves[index].exists() && trial < MOVES.len() {
                        // To be tried with the next top.
                        break;
                    }
                }
                index += 1;
            }
            if index >= octaves.len() {
                return (highest, end);
            }
        }
    }

    /// The octave of a part of a ramp, with a polynomial where one keeps the promise.
    #[inline(never)]
    const fn certified(&self, ramp: Side, path: &Path, span: &Span) -> Octave {
        let ends = [(span.middle - span.half) as f64, (span.middle + span.half) as f64];
        let places = [path.place(ends[0], false), path.place(ends[1], true)];
        let stretch = span.counted(path.stretch(places));
        let Some(candidate) = self.candidate(span, &stretch) else { return Octave::NONE };
        let is_certain = certain(&self.certificate(&candidate, span, stretch, ramp, places));
        if is_certain { candidate.octave } else { Octave::NONE }
    }
}

/// The bits of the top that is so many steps beyond the end of a range.
#[inline(never)]
const fn top_beyond([from, to]: [f64; 2], steps: u32) -> u32 {
    // At or above the end, or a 64-bit fraction below it would be looked up in the octave above.
    let end = floor_bits(to);
    let end = if (f32::from_bits(end) as f64) < to { end + 1 } else { end };
    let least = if end > LEAST_TOP { end.div_ceil(TOP_STEP) * TOP_STEP } else { LEAST_TOP };
    let top = least + steps * TOP_STEP;
    // If the range began within some ulp of an octave's end, rounding might put its first fraction into the octave
    // below.
    let beyond = top.wrapping_sub(floor_bits(from));
    if from > 0.0 && beyond.wrapping_add(16) & 0x7F_FFFF < 32 { top + TOP_STEP } else { top }
}
