//! What the designer's page asks: plans, forms and fits by the code of the program `shutter`.
//!
//! Questions and answers are JSON, so that the page needs no binding but the few functions of `abi`. The page loads this
//! twice: at first without the feature `studio`, which makes it much larger.

#[cfg(target_family = "wasm")]
mod abi;
mod answer;
#[cfg(feature = "studio")]
mod studio;
mod view;
#[cfg(feature = "studio")]
mod words;

#[cfg(feature = "studio")]
pub use studio::ask;
pub use view::{allowed, view};
