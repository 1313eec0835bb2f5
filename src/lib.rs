//! Computes when a camera's shutter has collected a given fraction of its exposure, so that firmware can fire one
//! flash per equal share of it. In `f32`, without `std`, allocation or dependencies.
//!
//! A [`ShutterCurve`] is an opening cubic Bezier, a fully open plateau and a closing cubic Bezier. The crate treats its
//! openness over time as a probability density, and inverts the integral.
//!
//! ```
//! use shutter_curve::{ShutterCurve, expect_valid};
//!
//! // In seconds: starts to open, is fully open, starts to close, is closed.
//! static SHUTTER: ShutterCurve = expect_valid(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
//!
//! // Half of the light is collected by 0.005 s.
//! assert_eq!(SHUTTER.inverse_cdf(0.5), 0.005);
//! // Five triggers of a 1 MHz timer, at least 1000 ticks apart.
//! assert_eq!(SHUTTER.ticks(1_000_000, 1_000), Ok([1936, 3500, 5000, 6500, 8064]));
//! ```
//!
//! # Units
//!
//! Times are in seconds and rates in Hz. If a curve's times are in another unit, so are all answers, and rates are
//! ticks per that unit.
//!
//! # Which call
//!
//! A *frame* is the triggers, or the pulses, of one exposure. A *tick* is one count of your timer.
//!
//! | you want | call |
//! |---|---|
//! | a shutter from two [`CubicBezier`]s, from straight ramps, in RenderMan's form | [`new`], [`linear`], [`shutteropening`] |
//! | a constant curve; a fault in it stops the build | [`expect_valid`] |
//! | a smaller curve: fewer stored polynomials, more searches; or a larger one | [`with_octaves`] |
//! | one Bezier alone as a density | [`density`]; if it rises above 1, scale it first with [`scaled`] |
//! | the time of a fraction | [`inverse_cdf`] |
//! | the fraction, the openness, the normalised density at a time | [`cdf`], [`openness`], [`pdf`] |
//! | the ticks of a frame, every gap checked: in a constant, or at run time | [`ticks`], [`ticks_into`] |
//! | one tick after the other, as in an interrupt handler | [`trigger_ticks`] |
//! | how many triggers fit with a minimum gap; how many need no search | [`max_triggers`], [`direct_triggers`] |
//! | pulses of equal doses through a shutter in the light's path | [`pulse_ticks`], [`pulses`], [`pulses_into`] |
//!
//! # From a measured shutter
//!
//! You rarely know a shutter's control points, but you can record its light with a photodiode. The program in the
//! crate's repository fits the trace, and writes a module for the firmware: the ticks of a frame, the delay from the
//! camera's sync, and the curve as a `static`. You tell it what no trace shows: how shutter and lamp are set up, which
//! edge of the sync counts, and the timer's rate.
//!
//! ```text
//! shutter fit trace.csv --sync 0 --out leaf.toml
//! shutter plan leaf.toml --set-up emulated --sync-falls true --timer-hz 1MHz --emit rust --curve --to leaf.rs
//! ```
//!
//! In the firmware, add `mod leaf;` and fire whenever the timer reaches one of the counts in `leaf::due(edge)`, where
//! `edge` is the timer's count at the sync.
//!
//! # Accuracy
//!
//! On every accepted curve the *backward error* is at most 0.5 ulp: the answer is exact for a fraction within
//! 0.5 ulp, but for its rounding to an `f32`. On typical curves the time is within 0.69 ulp of the exact one. Times and
//! ticks never step back, and every machine with IEEE arithmetic gives the same bits. All of this holds unless a search
//! ends at its limit of 74 evaluations, which no input is known to reach. The page [`accuracy`] has every promise and
//! what backs it.
//!
//! # Cost
//!
//! A `static` curve takes 1144 bytes of flash and no time at start-up. By a model of a Cortex-M4F, an [`inverse_cdf`]
//! takes some 60 to 110 cycles on average, but a search 500 to 2200 (more on a [`density`] that is 0 at both ends).
//! Up to [`direct_triggers`] triggers never need one. Building a curve at run time takes some 2.9 million cycles. The
//! README compares other methods, and says when not to use this crate.
//!
//! # Features and minimum Rust
//!
//! Off by default: `heapless-v0_9` for a frame in a `heapless::Vec`, `defmt` for `Format` of the public types. The
//! crate needs Rust 1.88. A minor version may raise that, and change the last bits of answers within what is promised.
//!
//! [`new`]: ShutterCurve::new
//! [`linear`]: ShutterCurve::linear
//! [`shutteropening`]: ShutterCurve::shutteropening
//! [`with_octaves`]: ShutterCurve::with_octaves
//! [`density`]: ShutterCurve::density
//! [`scaled`]: CubicBezier::scaled
//! [`inverse_cdf`]: ShutterCurve::inverse_cdf
//! [`cdf`]: ShutterCurve::cdf
//! [`openness`]: ShutterCurve::openness
//! [`pdf`]: ShutterCurve::pdf
//! [`ticks`]: ShutterCurve::ticks
//! [`ticks_into`]: ShutterCurve::ticks_into
//! [`trigger_ticks`]: ShutterCurve::trigger_ticks
//! [`max_triggers`]: ShutterCurve::max_triggers
//! [`direct_triggers`]: ShutterCurve::direct_triggers
//! [`pulse_ticks`]: ShutterCurve::pulse_ticks
//! [`pulses`]: ShutterCurve::pulses
//! [`pulses_into`]: ShutterCurve::pulses_into

#![no_std]
// docs.rs says of each item which feature it needs.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

// Begin with an answer: `inverse.rs` has the steps from a fraction to its time, `cdf.rs` those from a time to its
// fraction, `trigger/ticks.rs` what makes ticks of times. In this list each needs only those before it, and `error`:
//
// fraction  an end of the curve, and a fraction counted from it
// number    units, pairs of `f32`, polynomials of pairs, a time before it is rounded
// search    where a polynomial reaches a target, and the proof that it does
// ramp      one Bezier: its mass and time from either end, when a mass has been collected
// domain    which curves are accepted
// exposure  two ramps and the plateau, by fraction
// octave    polynomials that answer without a search: how they are built, and their certificates
// inverse   the time of a fraction
// cdf       the fraction, the openness and the density at a time
// trigger   the ticks of triggers and pulses
// shutter   the public face of all this
//
// Hints to the compiler stay where they pay, on a Cortex-M4F at level 3: without any `inline(always)` a schedule takes
// 22 % more cycles, and an inverse of a `static` 10 %; without any `inline(never)` the code is 26 % larger.
//
// Masks such as `i & 31`, branches to an end that is never reached, and `wrapping_` where nothing wraps but what a
// comment says, show the compiler that an index, a shift or a sum is in range, so that no panic links.
mod cdf;
mod domain;
mod error;
mod exposure;
mod fraction;
mod inverse;
mod number;
mod octave;
mod ramp;
mod search;
mod shutter;
mod trigger;

pub use error::{CurveError, Part, ScheduleError};
pub use ramp::bezier::CubicBezier;
#[cfg(feature = "measure")]
pub use search::MAX_EVALUATIONS;
pub use shutter::{ShutterCurve, expect_valid};
pub use trigger::iterator::{PulseTicks, TriggerTicks};
pub use trigger::pulse::{Pulse, PulseLimits};

#[doc = include_str!("../docs/accuracy.md")]
#[cfg(doc)]
pub mod accuracy {}

/// The README's code, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
