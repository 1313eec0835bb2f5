//! What the designer's page asks: plans, forms and fits by the code of the program `shutter`.
//!
//! It is built twice: what the page begins with, whose questions and answers are numbers; and with the feature
//! `studio`, which makes it much larger, what comes later, in JSON.

#[cfg(target_family = "wasm")]
mod abi;
pub mod flat;
#[cfg(feature = "studio")]
mod studio;
#[cfg(not(feature = "studio"))]
mod view;
#[cfg(feature = "studio")]
mod words;

#[cfg(feature = "studio")]
pub use studio::ask;
#[cfg(not(feature = "studio"))]
pub use view::{allowed, view};
