//! What is said of a trace, with the page's field that mends it.

use serde::Serialize;
use shutter_fit::trace::{Refusal, Remedy, Tell, Warning};

/// Something that is wrong or doubtful, and the field that mends it.
#[derive(Serialize)]
pub struct Told {
    text: String,
    /// Another file where none of them helps.
    mend: Option<&'static str>,
    /// The number that is doubtful: `exposure`, `times`, `delay`.
    about: &'static str,
}

/// What is doubtful about the exposure is so about all.
const ALL: &str = "exposure";

/// Why there is no fit; was it said which way light moves the signal?
pub fn refusal(refusal: &Refusal, has_way: bool) -> Told {
    if has_way && matches!(refusal, Refusal::NoPulse { .. }) {
        let text = "no pulse: nothing stands out of the noise this way; does light move the signal the other way?";
        return Told { text: text.into(), mend: Some("light"), about: ALL };
    }
    told(refusal, ALL)
}

/// What is doubtful.
pub fn warning(warning: &Warning) -> Told {
    use Warning as W;
    let about = match warning {
        W::SyncBounced { .. } | W::SyncMissing { .. } | W::SyncOthers { .. } | W::SyncLate { .. } => "delay",
        W::NoiseHidesRamps { .. } | W::SharpEdges { .. } => "times",
        _ => ALL,
    };
    told(warning, about)
}

fn told(it: &impl Tell, about: &'static str) -> Told {
    let mend = match it.remedy() {
        Some(Remedy::Columns(_)) => Some("signal"),
        Some(Remedy::Mains | Remedy::Triggers | Remedy::Picture) | None => None,
        Some(other) => Some(other.option()),
    };
    Told { text: it.to_string(), mend, about }
}

#[cfg(test)]
mod tests {
    use strum::IntoEnumIterator;

    use super::*;

    #[test]
    fn no_message_names_an_argument_of_the_program() {
        let (refusals, warnings) = (Refusal::iter(), Warning::iter());
        let all = refusals.map(|it| refusal(&it, true)).chain(warnings.map(|it| warning(&it)));
        all.for_each(|Told { text, .. }| assert!(!text.contains("--"), "{text}"));
    }
}
