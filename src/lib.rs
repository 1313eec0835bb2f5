//! For firmware that fires a burst of flashes during one camera exposure. You describe a shutter by its openness over
//! time. The crate splits the light that this shutter would collect into equal shares, and gives the timer tick in
//! the middle of each, at which to fire. If the camera's own shutter stays open all the while, equal flashes at these
//! ticks approximate how the described shutter would render a moving subject.
//!
//! ```
//! use shutter_curve::{Hz, ShutterCurve, TimedCurve, expect};
//!
//! // The times, in seconds, at which the shutter starts to open, is fully open, starts to close, and is closed.
//! static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
//! // On a 1 MHz timer, for a lamp that needs 1 ms between two flashes.
//! const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000))).min_gap(1_000);
//! // Five flashes, in the timer's ticks. Too many, or an invalid curve, would not compile.
//! const TICKS: [u32; 5] = expect!(FLASH.ticks());
//! assert_eq!(TICKS, [1936, 3500, 5000, 6500, 8064]);
//! // Half of the light is in after 5 ms.
//! assert_eq!(SHUTTER.inverse_cdf(0.5), 0.005);
//! ```
//!
//! # Terms
//!
//! - *Openness* is the fraction of the light that a shutter lets through at a moment, from 0 to 1.
//! - A *curve* is openness over time: an opening *ramp*, a fully open *plateau* and a closing ramp. Each ramp is a
//!   cubic Bezier.
//! - The *interval* is the time from `open_start` to `close_end`.
//! - The *exposure* is the area under the curve. `u` is a fraction of it, from 0 to 1.
//! - A *trigger* is the time at which a flash fires. A *pulse* is the time for which a steady lamp is on.
//! - A *frame* is all triggers, or all pulses, for one opening of the shutter.
//! - A *tick* is one count of your timer.
//! - An *ulp* is the distance from an `f32` to the next.
//! - *Typical curves* are boxes, trapezoids, leaf and rotary shutters, and random curves with gentle ramps, which
//!   [`accuracy`] defines.
//! - A *search* finds a time by iteration. Each curve stores polynomials that give most times without a search.
//!
//! # Units
//!
//! For triggers and pulses, a curve's times are in seconds. If you need neither, any unit of time will do. Answers are
//! in the unit that you gave to the constructor.
//!
//! # Which call
//!
//! | you want | call |
//! |---|---|
//! | a shutter from two [`CubicBezier`]s | [`ShutterCurve::new`] |
//! | - from straight ramps, or RenderMan's form | [`ShutterCurve::linear`], [`ShutterCurve::shutteropening`] |
//! | - in less memory, or with fewer searches | [`ShutterCurve::with_octaves`] |
//! | a probability density from one Bezier | [`ShutterCurve::density`] |
//! | a curve, ticks or pulses in a constant | [`expect!`](expect) |
//! | the time of a fraction | [`ShutterCurve::inverse_cdf`] |
//! | the fraction or the openness at a time | [`ShutterCurve::cdf`], [`ShutterCurve::openness`] |
//! | the probability density at a time | [`ShutterCurve::pdf`] |
//! | triggers or pulses on a timer | [`ShutterCurve::at`], which makes a [`TimedCurve`] |
//! | - the ticks of a frame, as an array or in a slice | [`TimedCurve::ticks`], [`TimedCurve::ticks_into`] |
//! | - the ticks of a frame one by one, as in an interrupt handler | [`TimedCurve::trigger_ticks`] |
//! | - how many triggers keep a minimum gap | [`TimedCurve::max_triggers`] |
//! | - pulses that send equal light through the shutter | [`TimedCurve::pulses`], [`TimedCurve::pulse_ticks`] |
//! | how many triggers are guaranteed to need no search | [`ShutterCurve::direct_triggers`] |
//!
//! # From a measured shutter
//!
//! The program `shutter`, in the crate's repository, fits a curve to a photodiode's record of a shutter. It writes a
//! module for firmware with the ticks of a frame and their delay from the camera's sync. With `--curve` the module also
//! holds the curve as a `static`, and needs this crate. You supply four facts that the record may not show: the
//! set-up, the sync's edge, the timer's rate, and what the lamp needs from one flash to the next. The set-up is
//! `in_path` if light passes through the measured shutter, and `emulated` if the camera's own shutter stays open.
//!
//! ```text
//! shutter fit trace.csv --sync 0 --out leaf.toml
//! shutter plan leaf.toml --set-up emulated --sync-falls true --timer-hz 1MHz --min-gap 100us \
//!     --emit rust --curve --to leaf.rs
//! ```
//!
//! Add `mod leaf;` to the firmware, and pass `leaf::due` your timer's count at the sync's edge. It returns the counts
//! at which to fire.
//!
//! # Accuracy
//!
//! On every curve, [`ShutterCurve::inverse_cdf`] returns the exact time of some fraction within 0.5 ulp of `u`, rounded
//! to `f32`. (For `u` below 2⁻²³ the fraction is within 2⁻⁴⁶.) On typical curves, the result is within 0.69 ulp of the
//! exact time of `u`. Times and ticks never decrease as `u` grows. The page [`accuracy`] lists all promises and the
//! evidence for them.
//!
//! Every machine with IEEE arithmetic gives the same bits.
//!
//! # Cost
//!
//! A `static` curve takes 1136 bytes of flash and no start-up code. The code for ticks takes about 4.5 kB, and 0.3 kB
//! of stack. On a Cortex-M4F, `inverse_cdf` takes 60 to 110 cycles on average. A search takes 500 to 2500 cycles, or
//! more on a density with little light at both ends. Building a curve at run time takes 2.8 million cycles. All cycles
//! are counted by a model; no chip has been measured. A frame of up to [`ShutterCurve::direct_triggers`] triggers needs
//! no search.
//!
//! # Features and minimum Rust
//!
//! Two features are off by default. `heapless-v0_9` adds `ticks_vec`, which returns a frame in a `heapless::Vec`.
//! `defmt` implements `defmt::Format` for the public types.
//!
//! The crate needs Rust 1.88. A minor version may raise this. It may also change the last bits of results, within the
//! promises.

#![cfg_attr(not(test), no_std)]
// docs.rs says of each item which feature it needs.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

// Begin with an answer: `inverse.rs` has the steps from a fraction to its time, `cdf.rs` those from a time, and
// `trigger/ticks.rs` those to a tick. `fixed.rs` says what a mass, a way and a place are, and in which units. In this
// list each part needs only those before it, and `error`, `text`, `rate`:
//
// fixed     masses, times and places as whole numbers
// fraction  an end of the curve, and a fraction counted from it
// search    where a polynomial reaches a target, and the measurement that it does
// ramp      one Bezier: its mass and time from either end, when a mass has been collected
// domain    which curves are accepted
// curve     two ramps and the plateau, integrated: the time of a fraction by a search
// octave    polynomials that answer without a search: how they are built, and their certificates
// inverse   the time of a fraction
// cdf       the fraction, the openness and the density at a time
// trigger   the ticks of triggers and pulses
// shutter   the public face of all this
//
// Hints to the compiler stay where they pay, on a Cortex-M4F at level 3: without any `inline(always)` a frame takes
// 33 % more cycles, and an inverse of a `static` 37 %; without any `inline(never)` building has 32 % more code.
//
// Some masks (`i & 31`), branches that are never taken, and `wrapping_` operations that never wrap only show the
// compiler that a value is in range, so that no panic links.
mod cdf;
mod curve;
mod domain;
mod error;
mod fixed;
mod fraction;
mod inverse;
mod octave;
mod ramp;
mod rate;
mod search;
mod shutter;
mod text;
mod trigger;

pub use error::{CurveError, Part, ScheduleError};
pub use ramp::bezier::CubicBezier;
pub use rate::Hz;
#[cfg(feature = "_measure")]
pub use search::MAX_STEPS;
pub use shutter::ShutterCurve;
pub use trigger::iterator::{PulseTicks, TriggerTicks};
pub use trigger::pulse::Pulse;
pub use trigger::timed::TimedCurve;

#[doc = include_str!("../docs/accuracy.md")]
#[cfg(doc)]
pub mod accuracy {}

// Tests of what is not public, for which the repository's own tests turn `_measure` on; not in the published package.
#[cfg(all(test, feature = "_measure"))]
extern crate self as shutter_curve;
#[cfg(all(test, feature = "_measure"))]
#[path = "../tests/inside/mod.rs"]
mod inside;
