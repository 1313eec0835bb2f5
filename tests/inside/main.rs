//! Tests of what is not public: the crate's modules, compiled once more into this test, so that the crate holds none of
//! it.
#![allow(dead_code, unused_imports)] // Each test needs a part.

extern crate self as shutter_curve;

#[path = "../../src/cdf.rs"]
mod cdf;
#[path = "../../src/domain.rs"]
mod domain;
#[path = "../../src/error.rs"]
mod error;
#[path = "../../src/exposure.rs"]
mod exposure;
#[path = "../../src/fixed.rs"]
mod fixed;
#[path = "../../src/fraction.rs"]
mod fraction;
#[path = "../../src/inverse.rs"]
mod inverse;
#[path = "../../src/octave/mod.rs"]
mod octave;
#[path = "../../src/ramp/mod.rs"]
mod ramp;
#[path = "../../src/rate.rs"]
mod rate;
#[path = "../../src/search.rs"]
mod search;
#[path = "../../src/shutter.rs"]
mod shutter;
#[path = "../../src/text.rs"]
mod text;
#[path = "../../src/trigger/mod.rs"]
mod trigger;

#[path = "../support/mod.rs"]
mod support;

mod certificate;
mod exact;

pub use error::{CurveError, Part, ScheduleError};
pub use ramp::bezier::CubicBezier;
pub use rate::Hz;
pub use search::MAX_EVALUATIONS;
pub use shutter::ShutterCurve;
pub use trigger::iterator::{PulseTicks, TriggerTicks};
pub use trigger::pulse::Pulse;
pub use trigger::timed::TimedCurve;
