//! How a camera's shutter opens, as a probability density: an opening cubic Bezier, a fully open plateau, a closing
//! cubic Bezier, integrated in closed form and inverted to the last bit or so, in `f32` and without allocation.
//!
//! [`ShutterCurve`] is the shutter: [`inverse_cdf`](ShutterCurve::inverse_cdf) gives the time by which a fraction of
//! the exposure has been collected, [`trigger_ticks`](ShutterCurve::trigger_ticks) the ticks of a timer at which pulses
//! get equal shares of it. [`BezierPdf`] is one [`CubicBezier`] alone. Both are built by `const fn`s, and [`valid`]
//! turns a wrong curve in a `static` into a compile error.
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
//! The README has the promised accuracy, the cost on a microcontroller, the features and the limits.

#![cfg_attr(not(test), no_std)]
// docs.rs says of each item which feature it needs.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

// To read in this order: two `f32` as one number, `pair`; polynomials of these, `series`; where such a polynomial
// reaches a target, `solve` and its first `guess`. One Bezier: `bezier`, `cubic`, `shape`; seen from either end,
// `ramp`; a time as it is found, `moment`. Two ramps and a plateau, `exposure`. Without a search: `octave`, `fit`. All
// of it together is a `plan`, which lists the steps of one answer; `batch` shortens them on large processors. The
// public types stand on that: `shutter`, `pdf`, `schedule` (with `fraction` and `ticks`), `pulse`, `error`.
mod batch;
mod bezier;
mod certificate;
mod cubic;
mod error;
mod exposure;
mod fit;
mod fraction;
mod guess;
mod moment;
mod octave;
mod pair;
mod path;
mod pdf;
mod plan;
mod pulse;
mod ramp;
mod schedule;

mod series;
mod shape;
mod shutter;
mod solve;
mod ticks;

pub use bezier::CubicBezier;
pub use error::{CurveError, Part, ScheduleError, valid};
pub use pdf::BezierPdf;
pub use pulse::PulseTicks;
pub use schedule::{TriggerTicks, TriggerTimes};
pub use shutter::ShutterCurve;
pub use solve::MAX_EVALUATIONS;

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
