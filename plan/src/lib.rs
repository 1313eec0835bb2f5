//! From a camera's shutter to the ticks at which a firmware triggers.
//!
//! A [`scene::Scene`] becomes a [`plan::Plan`], and that [`facts::Facts`], which all forms render. A measured trace
//! becomes a [`shutter_fit::Fit`], and that a scene's shutter. Each module uses those before it alone: what is wrong
//! (`fault`), lamp, scene, shape, timer and sync, frames, plan, facts, forms.
//!
//! All are plain functions without input, output or a terminal, and build for `wasm32-unknown-unknown`.

pub mod emit;
pub mod facts;
pub mod fault;
pub mod fitted;
mod frames;
pub mod lamp;
pub mod plan;
pub mod scene;
pub mod shape;
pub mod sync;
pub mod timer;
