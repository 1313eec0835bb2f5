//! The form of every answer.

use serde::Serialize;
use shutter::scene::Fault;

/// What is wrong, and where.
#[derive(Serialize)]
pub struct Wrong {
    pub reason: String,
    pub notes: Vec<String>,
    /// The key in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub key: Option<&'static str>,
    /// From where to where among the numbers of `shutteropening`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inner: Option<(usize, usize)>,
    /// What would help, each tried: `triggers` with a number, `min_gap`, `timer_bits` or `lamp` without it.
    pub remedies: Vec<(&'static str, u32)>,
}

/// Of a scene of numbers.
impl From<Fault> for Wrong {
    fn from(fault: Fault) -> Self {
        let (key, Fault { inner, reason, notes, .. }) = (fault.key(), fault);
        Self { key, inner, notes, ..Self::from(reason) }
    }
}

impl From<String> for Wrong {
    fn from(reason: String) -> Self {
        Self { reason, notes: Vec::new(), key: None, inner: None, remedies: Vec::new() }
    }
}

/// The answer, as JSON: what was asked for as `Ok`, or else what is wrong as `Err`.
pub fn json(answer: &Result<impl Serialize, Wrong>) -> String {
    // It always succeeds; a message of what went wrong would be a fiftieth of the page's first load.
    serde_json::to_string(answer).unwrap_or_default()
}
