//! From a camera's shutter to the ticks at which a firmware triggers.
//!
//! A scene (text in TOML) becomes a [`plan::Plan`]. Everything here but the
//! `command` is plain functions without input, output or a terminal, and builds for `wasm32-unknown-unknown` without
//! the default features.

#[cfg(feature = "terminal")]
pub mod command;
#[cfg(feature = "picture")]
pub mod picture;
pub mod fit;
pub mod plan;
#[cfg(feature = "terminal")]
pub mod report;
pub mod scene;
pub mod trace;
pub mod unit;
