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

// To read in this order; each file's code needs only those before it, and `error`: what can be wrong with a curve or a schedule.
//
// Numbers    `units`: the scales. `exact`: what a sum and a product lose. `pair`: two `f32` as one number. `unknown`:
//            what keeps loops small. `series`: polynomials of pairs.
// Search     `solve`: where a series reaches a target, and the proof that it does. `guess`: where to begin.
// A ramp     `cubic`, `lift`, `bezier`, `shape`: what makes one Bezier a ramp, and its integral. `moment`: a time as it
//            is found. `ramp`: when a mass has been collected. `quick`: a place for a time without a search. `by_time`:
//            the same ramp, asked by time, and its openness.
// A curve    `exposure`: two ramps and a plateau, by fraction.
// Directly   `octave`: a polynomial that needs no search. How it is built: `path`, a ramp in `f64`; `span`, the part
//            that it serves; `candidate`, its coefficients; `bound` and `certificate`, its judge; `octaves`, all of
//            a side.
// An answer  `plan`: the steps from a `u` to a time. `by_u64`: the direct ones from a fraction of 64 bits. `by_octave`:
//            from a time to its `u` by a polynomial; `cdf`: by any way, and the ways of openness and density. `doubles`:
//            a short cut on processors of 64 bits, for one `u` and for many.
// Outside    `shutter`. `fraction`, `ticks`, `fill`, `frame`, `schedule`, `pulse`: the times and ticks of triggers
//            and pulses.
mod bezier;
mod bound;
mod by_time;
mod candidate;
mod cdf;
mod certificate;
mod cubic;
mod error;
mod exposure;
mod fraction;
mod frame;
mod guess;
mod lift;
mod moment;
mod octave;
mod octaves;
mod pair;
mod path;
mod plan;
mod pulse;
mod quick;
mod ramp;
mod schedule;
mod series;
mod shape;
mod shutter;
mod solve;
mod span;
mod ticks;
mod units;

pub use bezier::CubicBezier;
pub use error::{CurveError, Part, ScheduleError, valid};
pub use pulse::PulseTicks;
pub use schedule::{TriggerTicks, TriggerTimes};
pub use shutter::ShutterCurve;
pub use solve::MAX_EVALUATIONS;

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
