//! From a camera's shutter to the ticks at which a firmware triggers.
//!
//! A [`scene::Scene`] becomes a [`plan::Plan`], and that [`facts::Facts`], which all forms render. A measured trace becomes
//! a [`shutter_fit::Fit`], and that a scene's shutter.
//!
//! Everything here but the `command` is plain functions without input, output or a terminal, and builds for
//! `wasm32-unknown-unknown` without the default features.

#[cfg(feature = "terminal")]
pub mod command;
pub mod emit;
pub mod facts;
pub mod fault;
pub mod fitted;
mod frames;
pub mod lamp;
#[cfg(feature = "terminal")]
pub mod picture;
pub mod plan;
#[cfg(feature = "terminal")]
pub mod report;
pub mod scene;
pub mod set_up;
pub mod shape;
#[cfg(feature = "terminal")]
pub mod speeds;
pub mod sync;
pub mod timer;
