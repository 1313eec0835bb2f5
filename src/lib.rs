#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]

mod bezier;
mod error;
mod octave;
mod pdf;
mod profile;
mod ramp;
mod schedule;
mod seed;
mod series;
mod shutter;
mod wide;

pub use bezier::CubicBezier;
pub use error::{CurveError, Ramp, ScheduleError, valid};
pub use pdf::BezierPdf;
pub use series::MAX_EVALUATIONS;
pub use shutter::ShutterCurve;
