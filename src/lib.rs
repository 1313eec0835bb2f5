//! How a camera's shutter opens, as a probability density: an opening cubic Bezier, a fully open plateau, a closing
//! cubic Bezier, integrated in closed form and inverted to the last bit or so, in `f32` and without allocation.
//!
//! [`ShutterCurve`] is the shutter: [`inverse_cdf`](ShutterCurve::inverse_cdf) gives the time by which a fraction of
//! the exposure has been collected, [`trigger_ticks`](ShutterCurve::trigger_ticks) the ticks of a timer at which pulses
//! get equal shares of it. It is built of two [`CubicBezier`]s by a `const fn`, and [`valid`] turns a wrong curve in a
//! `static` into a compile error.
//!
//! ```
//! use shutter_curve::{ShutterCurve, valid};
//!
//! // In flash, at no cost at run time: open_start, open_end, close_start and close_end in seconds, then the inner
//! // control points of both ramps.
//! static SHUTTER: ShutterCurve = valid(ShutterCurve::shutteropening(
//!     [0.0, 0.0025, 0.0075, 0.010],
//!     [0.1, 0.0, 0.15, 1.0, 0.85, 1.0, 0.9, 0.0],
//! ));
//! assert_eq!(SHUTTER.inverse_cdf(0.5), 0.005);
//! let ticks: Vec<u32> = SHUTTER.trigger_ticks(4, 1_000_000)?.collect();
//! assert!(ticks.is_sorted() && ticks.len() == 4);
//! # Ok::<(), shutter_curve::ScheduleError>(())
//! ```
//!
//! The README has the promised accuracy, the cost on a microcontroller, and the limits. Features: `heapless-v0_9` for a
//! schedule in a `heapless::Vec`, `defmt` for `Format` of the public types.

#![cfg_attr(not(test), no_std)]
// docs.rs says of each item which feature it needs.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

// Begin with an answer: `answer/plan.rs` has the steps from a fraction to its time, `answer/cdf.rs` those from a time
// to its fraction, `trigger/ticks.rs` what makes ticks of times. In this list each needs only those before it, and
// `error`; `shutter` is built on `answer`, and `trigger` adds methods to it:
//
// fraction  an end of the curve, and a fraction counted from it
// number    units, pairs of `f32`, polynomials of pairs, a time before it is rounded
// search    where a polynomial reaches a target, and the proof that it does
// ramp      one Bezier: what makes it a ramp, its mass and time from either end, when a mass has been collected
// exposure  two ramps and the plateau, by fraction
// octave    polynomials that answer without a search: how they are built, and their certificates
// answer    the time of a fraction, and the fraction of a time
// trigger   the ticks of triggers and pulses
//
// Masks such as `i & 1` show the compiler that an index or a shift is in range, so that no panic links.
mod answer;
mod error;
mod exposure;
mod fraction;
mod measure;
mod number;
mod octave;
mod ramp;
mod search;
mod shutter;
mod trigger;

pub use error::{CurveError, Part, ScheduleError};
#[doc(hidden)]
pub use measure::MAX_EVALUATIONS;
pub use ramp::bezier::CubicBezier;
pub use shutter::{ShutterCurve, valid};
pub use trigger::{Pulse, PulseTicks, TriggerTicks, TriggerTimes};

#[cfg(test)]
#[path = "../tests/inside/mod.rs"]
mod inside;
/// The oracle and the curves of the integration tests, for tests of what is not public.
#[cfg(test)]
#[path = "../tests/support/mod.rs"]
mod support;
#[cfg(test)]
extern crate self as shutter_curve;

/// The README's code, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
