//! What is said of a trace, in the page's words: a person at a page has its controls, not the program's arguments.

use serde::Serialize;
use shutter_fit::trace::{Refusal, Warning};

/// Something that is wrong or doubtful, and the control that mends it.
#[derive(Serialize)]
pub struct Told {
    text: String,
    /// `rate`, `unit`, `signal`, `rises`, `full`, `frame`, `sync`; another file where none of them helps.
    mend: Option<&'static str>,
    /// The number that is doubtful: `exposure`, `times`, `delay`, `efficiency`.
    about: &'static str,
}

/// What is doubtful about the exposure is so about all.
const ALL: &str = "exposure";

/// Why there is no fit; was it said which way light moves the signal?
pub fn refusal(refusal: &Refusal, has_way: bool) -> Told {
    use Refusal as R;
    let mend = match refusal {
        R::NoPulse { .. } if has_way => {
            let text = "no pulse: nothing stands out of the noise this way; does light move the signal the other way?";
            return Told { text: text.into(), mend: Some("rises"), about: ALL };
        }
        R::NoTimes { .. } | R::Counter { .. } | R::TwoRates { .. } => Some("rate"),
        R::UnclearUnit { .. } => Some("unit"),
        R::SameColumn { .. } | R::NoColumn { .. } | R::BrokenRows { .. } => Some("signal"),
        R::NoPulse { .. } | R::Undetermined => Some("signal"),
        R::WhichWay => Some("rises"),
        R::NoFrame { .. } => Some("frame"),
        R::FullTooLow { .. } => Some("full"),
        _ => None,
    };
    Told { text: without_arguments(&refusal.to_string()), mend, about: ALL }
}

/// What is doubtful.
pub fn warning(warning: &Warning) -> Told {
    use Warning as W;
    let mend = match warning {
        W::UnitAssumed => Some("unit"),
        W::SecondSignal { .. } => Some("signal"),
        W::ShotsDiffer { .. } | W::PartialFrame { .. } => Some("frame"),
        W::Inverted => Some("rises"),
        W::NoPlateau => Some("full"),
        _ => None,
    };
    let about = match warning {
        W::SyncBounced { .. } | W::SyncMissing { .. } | W::SyncOthers { .. } | W::SyncLate { .. } => "delay",
        W::NoiseHidesRamps { .. } | W::SharpEdges { .. } => "times",
        _ => ALL,
    };
    Told { text: without_arguments(&warning.to_string()), mend, about }
}

/// A message of the program without what it says of its arguments: before the text, in brackets, or behind a semicolon.
fn without_arguments(message: &str) -> String {
    let message = match message.split_once(": ") {
        Some((argument, rest)) if argument.starts_with("--") => rest,
        _ => message,
    };
    let mut text = message.to_string();
    while let Some(from) = text.find(" (--")
        && let Some(length) = text[from..].find(')')
    {
        text.replace_range(from..=from + length, "");
    }
    // A word that begins so: two hyphens within one are a name's, of the file.
    let names_one = |part: &str| part.starts_with("--") || part.contains(" --");
    let kept: Vec<_> = text.split("; ").filter(|part| !names_one(part)).collect();
    if kept.is_empty() { text } else { kept.join("; ") }
}

#[cfg(test)]
mod tests {
    use strum::IntoEnumIterator;

    use super::*;

    fn is_plain(told: Told) {
        assert!(!told.text.contains("--") && told.text.len() > 20, "{}", told.text);
    }

    #[test]
    fn no_message_names_an_argument_of_the_program() {
        let some = |text: &str| Some(text.to_string());
        let refusals = [
            Refusal::NoTimes { columns: "2".into(), text: some("a"), quoted: some("b") },
            Refusal::Thousands { number: "1,500".into(), other: "1.5".into() },
            Refusal::CutPulse { begins: true, ends: true },
            Refusal::NoDelay { reason: "a reason of some words".into() },
        ];
        let no_reason = |told: &Refusal| !matches!(told, Refusal::NoDelay { .. });
        for told in Refusal::iter().filter(no_reason).chain(refusals) {
            is_plain(refusal(&told, false));
            is_plain(refusal(&told, true));
        }
        let (taken, other) = ("column 2, \"A\"".into(), "column 3, \"B\"".into());
        let warnings = [
            Warning::SecondSignal { taken, other, option: "--columns 1,3".into() },
            Warning::Misfit { share: 0.1, after: 0.1, by_trace: true },
        ];
        Warning::iter().chain(warnings).for_each(|told| is_plain(warning(&told)));
    }

    #[test]
    fn what_is_left_is_a_sentence() {
        let full = Refusal::FullTooLow { given: 1.0, seen: 2.0 };
        for (told, part) in [
            (warning(&Warning::NoPlateau), "unless the signal of full light is given"),
            (refusal(&full, false), "the trace reaches 2.0000, more"),
            (refusal(&Refusal::UnclearUnit { name: "a--b".into() }, false), "'a--b' above"),
        ] {
            assert!(told.text.contains(part) && !told.text.contains(" --"), "{}", told.text);
        }
    }
}
