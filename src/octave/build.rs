//! The octaves of a side: which part of a ramp each serves. A candidate is kept if it has a certificate.

use crate::curve::Curve;
use crate::fixed::{EIGHTH, LEAST_TOP, LINE_FROM, floor_bits, power_of_two};
use crate::fraction::Side;
use crate::octave::candidate::candidate;
use crate::octave::certificate::certificate;
use crate::octave::path::Path;
use crate::octave::span::Span;
use crate::octave::{Octave, top_at};
use crate::ramp::bezier::CubicBezier;

/// By how many eighths a ramp's tops are raised: the first of these that gives every octave a polynomial, or else the
/// one that serves most, above all before its first missing octave. (The octave at the join is often too much for a
/// polynomial; from another top it may have less of the ramp.) Found by trial.
const MOVES: [u32; 4] = [0, 5, 6, 4];

/// The top of a ramp without octaves. Of every fraction, and of NaN, the index is 64 or more, beyond any array, though
/// the near ramp's top is raised by as many octaves as the far ramp has.
// proofs/octaves.py
const NO_OCTAVES: u32 = power_of_two(63).to_bits();

/// The least and the greatest `a` for which a ramp has octaves, at most 1/2; none if they are not in order.
pub(crate) const fn range(curve: &Curve, side: Side, ramp: Side) -> [f64; 2] {
    let [near, far] = curve.join_fractions(side);
    if !ramp.is(side) {
        return [far, 0.5];
    }
    // The line begins above LINE_FROM. What lies between a join below that and LINE_FROM is on the plateau, but neither
    // on the line nor on the far ramp: `Inverse::section` takes it for the near ramp. There an octave would answer
    // wrongly, so the ramp gets none.
    let would_take_plateau = near < far && near < LINE_FROM as f64;
    let to = if near < 0.5 { near } else { 0.5 };
    [0.0, if would_take_plateau { 0.0 } else { to }]
}

/// Builds the octaves of a side: the far ramp's, then the near ramp's. Returns the tops at index 0, by ramp.
// Out of line, with a slice: one copy for any number of octaves.
#[inline(never)]
pub(crate) const fn build(curve: &Curve, ramps: &[CubicBezier; 2], side: Side, octaves: &mut [Octave]) -> [u32; 2] {
    let (mut tops, mut first, mut i) = ([0; 2], 0, 0);
    while i < 2 {
        let ramp = [side.other(), side][i];
        let Some((_, rest)) = octaves.split_at_mut_checked(first) else { break };
        let (top, count) = on_ramp(&Path::new(curve, ramps, side, ramp), rest);
        tops[ramp as usize] = top + ((first as u32) << 23);
        first += count;
        i += 1;
    }
    tops
}

/// Builds the octaves on a ramp. Returns its first top, and how many indices it takes.
#[inline(never)]
const fn on_ramp(path: &Path, octaves: &mut [Octave]) -> (u32, usize) {
    let range = range(path.curve, path.side, path.ramp);
    if range[0] >= range[1] {
        return (NO_OCTAVES, 0);
    }
    // Each move, then the best again.
    let (mut trial, mut best, mut most) = (0, 0, 0.0);
    loop {
        let is_last = trial == MOVES.len();
        let top = top_beyond(range, MOVES[if is_last { best } else { trial } & 3]);
        let (count, served, is_whole) = try_top(path, top, range, octaves);
        if is_whole || is_last {
            return (top, count);
        }
        if served > most {
            (best, most) = (trial, served);
        }
        trial += 1;
    }
}

/// Builds the octaves on a ramp from a first top on. Returns how many indices the ramp takes, what share of exposure
/// their polynomials serve, and whether none is missing. What is served before a first missing one counts 1024 times:
/// only that raises `direct_triggers`.
#[inline(never)]
const fn try_top(path: &Path, first: u32, range: [f64; 2], octaves: &mut [Octave]) -> (usize, f32, bool) {
    let (mut index, mut count, mut served, mut is_whole) = (0, 0, 0.0, true);
    while index < octaves.len() {
        octaves[index] = Octave::NONE;
        let top = top_at(first, index);
        if f32::from_bits(top) as f64 > range[0] {
            // With a polynomial or without: a far ramp's fractions must not find the near ramp's octaves.
            count = index + 1;
        }
        if let Some(span) = Span::new(range, top) {
            let part = span.to - span.from as f32;
            octaves[index] = certified(path, span);
            if octaves[index].exists() {
                served += part * if is_whole { 1024.0 } else { 1.0 };
            } else {
                is_whole = false;
            }
        }
        index += 1;
    }
    (count, served, is_whole)
}

/// The octave of a span, without a polynomial if the candidate has no certificate.
#[inline(never)]
const fn certified(path: &Path, span: Span) -> Octave {
    let stretch = path.stretch(span);
    let Some(candidate) = candidate(path, &stretch) else { return Octave::NONE };
    if certificate(path, &candidate, &stretch).are_certain() { candidate.octave } else { Octave::NONE }
}

/// The bits of a ramp's first top: the least that is at or above the range's end, raised by so many eighths, or by one
/// more.
#[inline(never)]
const fn top_beyond([from, to]: [f64; 2], eighths: u32) -> u32 {
    // Rounded up: no `a` of the ramp is above its top. (An `a` just beyond the range may be looked up here, too, as a
    // join is rounded differently from either end: a certificate allows for that by JOIN_OFF.)
    let end = floor_bits(to);
    let end = if (f32::from_bits(end) as f64) < to { end + 1 } else { end };
    let least = if end > LEAST_TOP { end.div_ceil(EIGHTH) * EIGHTH } else { LEAST_TOP };
    let top = least + eighths * EIGHTH;
    // By rounding, the range's first fraction might fall below its last octave, where look-ups find the other ramp's.
    // So one more is added if the range begins within 16 ulp of an octave's end: there bits differ from the top's
    // by a multiple of 2²³.
    let to_top = top.wrapping_sub(floor_bits(from));
    let is_near_an_end = to_top.wrapping_add(16) & 0x7F_FFFF < 32;
    if from > 0.0 && is_near_an_end { top + EIGHTH } else { top }
}
