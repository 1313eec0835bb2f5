//! What the designer's page asks: plans, forms and fits by the code of the program `shutter`.
//!
//! Questions and answers are JSON, so that the page needs no binding but the few functions of `abi`. The page loads this
//! twice: at first without the feature `studio`, which makes it much larger.

#[cfg(target_family = "wasm")]
mod abi;
mod bar;
mod cost;
#[cfg(feature = "studio")]
mod studio;
mod view;

use serde::Serialize;
use shutter::scene::Fault;

#[cfg(feature = "studio")]
pub use studio::ask;
pub use view::view;

/// What is wrong, and where.
#[derive(Serialize)]
struct Wrong {
    reason: String,
    notes: Vec<String>,
    /// The key in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    key: Option<&'static str>,
    /// The ramp of the curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    ramp: Option<&'static str>,
}

/// Of a scene made of values.
impl From<Fault> for Wrong {
    fn from(fault: Fault) -> Self {
        Self { key: fault.key_of_values(), ramp: None, reason: fault.reason, notes: fault.notes }
    }
}

impl From<String> for Wrong {
    fn from(reason: String) -> Self {
        Self { reason, notes: Vec::new(), key: None, ramp: None }
    }
}

/// The answer, as JSON: what was asked for as `Ok`, or else what is wrong as `Err`.
fn json(answer: &Result<impl Serialize, Wrong>) -> String {
    serde_json::to_string(answer).expect("numbers and names are JSON")
}
