//! What the designer's page asks: plans, forms and fits by the code of the program `shutter`.
//!
//! It is built twice: what the page begins with, in numbers; and with the feature `studio`, which makes it much larger,
//! what comes later, in words and JSON.

#[cfg(not(feature = "studio"))]
mod engine;
#[cfg(feature = "studio")]
mod fits;
#[cfg(feature = "studio")]
mod studio;

#[cfg(not(feature = "studio"))]
pub use engine::{Question, View};
#[cfg(feature = "studio")]
pub use studio::{emit, fit, open, tell};
