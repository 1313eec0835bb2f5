//! What is said of a trace, in the page's words: a person at a page has its controls, not the program's arguments.

use serde::Serialize;
use shutter_fit::trace::{Refusal, Warning};

/// Something that is wrong or doubtful, and the control that mends it.
#[derive(Serialize)]
pub struct Told {
    text: String,
    /// `rate`, `unit`, `signal`, `rises`, `full`, `frame`; another file where none of them helps.
    mend: Option<&'static str>,
}

/// Why there is no fit; was it said which way light moves the signal?
pub fn refusal(refusal: &Refusal, has_way: bool) -> Told {
    use Refusal as R;
    let (mend, text) = match refusal {
        R::NoTimes { columns, .. } => (
            "rate",
            format!("no column holds times, of {columns}: give the samples in a second"),
        ),
        R::Counter { name, .. } => (
            "rate",
            format!("column {name} counts 0, 1, 2 ... and is no time: give the samples in a second, or its unit if it is one"),
        ),
        R::UnclearUnit { name } => (
            "unit",
            format!("'{name}' above the times is more than a unit, or one that is not read: give their unit, or the samples in a second"),
        ),
        R::SameColumn { name } => ("signal", format!("column {name} cannot be the time and the signal")),
        R::TwoRates { first, second } => (
            "rate",
            format!("'{first}' and '{second}' above the numbers tell different rates: give the right one"),
        ),
        R::NoColumn { name, there } => {
            ("signal", format!("there is no column {name}; there are {there}"))
        }
        R::BrokenRows { count, rows, line, reason, .. } => (
            "signal",
            format!("line {line}: {reason}; {count} of {rows} rows are like that: are these the right columns?"),
        ),
        R::NoPulse { .. } if has_way => (
            "rises",
            "no pulse: nothing stands out of the noise this way; does light move the signal the other way?".into(),
        ),
        R::NoPulse { contrast } => (
            "signal",
            format!("no pulse: the brightest part stands out by {contrast:.1} times the noise; is this the right column, and was the light on?"),
        ),
        R::BeginsInPulse { has_way: false } => (
            "rises",
            "the trace begins in the pulse: say which way light moves the signal, or record some of the dark before it".into(),
        ),
        R::EndsInPulse { has_way: false } => (
            "rises",
            "the trace ends in the pulse: say which way light moves the signal, or record some of the dark after it".into(),
        ),
        R::NoFrame { .. } => ("frame", refusal.to_string()),
        R::FullTooLow { given, seen } => (
            "full",
            format!("full light of {given}: the trace reaches {seen:.4}, which is more; the dark level is included"),
        ),
        R::Undetermined => ("signal", refusal.to_string()),
        R::NoDelay { reason } => return Told { text: reason.clone(), mend: None },
        _ => return Told { text: refusal.to_string(), mend: None },
    };
    Told { text, mend: Some(mend) }
}

/// What is doubtful.
pub fn warning(warning: &Warning) -> Told {
    use Warning as W;
    let (mend, text) = match warning {
        W::UnitAssumed => (
            "unit",
            "the file does not say in which unit its times are: they are taken as seconds".into(),
        ),
        W::SecondSignal { taken, other, .. } => (
            "signal",
            format!("two columns hold a pulse: {taken} is taken for the light, and {other} is not"),
        ),
        W::ShotsDiffer { scatter } => (
            "frame",
            format!("the exposures of the shots scatter by {:.2} %, so they are not of one setting; one of them is fitted", 100.0 * scatter),
        ),
        W::Inverted => (
            "rises",
            "light seems to lower the signal, so it is turned round; if it does not, the trace begins and ends in the light".into(),
        ),
        W::PartialFrame { number } => (
            "frame",
            format!("pulse {number} of the trace has too little dark beside it, and is left out: the others are counted without it"),
        ),
        W::NoPlateau => (
            "full",
            "there is no plateau: the shutter may never open fully, and the peak counts as full light, unless you give the signal of full light".into(),
        ),
        W::ShortHum { amplitude, periods, .. } => {
            let text = format!("hum of {:.2} % of the light, of which the record holds {periods:.1} periods, is taken out; a drift or the shutter's own shape may pass for it: record three periods (60 ms)", 100.0 * amplitude);
            return Told { text, mend: None };
        }
        W::Misfit { share, by_trace, .. } => {
            let whose = match by_trace {
                true => "the trace's own",
                false => "the curve's, and off by more than their errors say",
            };
            let text = format!("the trace has structure that the curve has not, {:.2} % of the light: exposure and triggers are {whose}", 100.0 * share);
            return Told { text, mend: None };
        }
        W::ZeroMoved => {
            return Told { text: "time 0 is where the shutter starts to open".into(), mend: None };
        }
        _ => return Told { text: warning.to_string(), mend: None },
    };
    Told { text, mend: Some(mend) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_plain(told: Told) {
        assert!(!told.text.contains("--") && told.text.len() > 20, "{}", told.text);
    }

    #[test]
    fn no_message_names_an_argument_of_the_program() {
        use Refusal as R;
        use Warning as W;
        let text = || "a reason of some words".to_string();
        for told in [
            R::NotCsv { reason: text() },
            R::NoTimes { columns: text(), text: None, quoted: Some(text()) },
            R::Counter { name: text(), quoted: None },
            R::UnclearUnit { name: text() },
            R::SameColumn { name: text() },
            R::Blocks { line: 3, text: text() },
            R::TwoRates { first: text(), second: text() },
            R::Thousands { number: text(), other: text() },
            R::Thousands { number: text(), other: "1.5".into() },
            R::NoColumn { name: text(), there: text() },
            R::BrokenRows { count: 2, rows: 3, line: 4, reason: text(), reading: text() },
            R::Unsound,
            R::TooFewSamples { samples: 1, required: 2 },
            R::NoPulse { contrast: 2.0 },
            R::ShortPulse { samples: 1, required: 2 },
            R::BeginsInPulse { has_way: false },
            R::BeginsInPulse { has_way: true },
            R::EndsInPulse { has_way: false },
            R::EndsInPulse { has_way: true },
            R::NoFrame { number: 3, frames: 2 },
            R::FullTooLow { given: 1.0, seen: 2.0 },
            R::LostRamp { from: 0.1, to: 0.2 },
            R::NoDelay { reason: text() },
            R::Undetermined,
            R::NoScene { reason: text() },
        ] {
            is_plain(refusal(&told, false));
            is_plain(refusal(&told, true));
        }
        for told in [
            W::BrokenRows { count: 2, line: 3, reason: text() },
            W::Unsorted { line: 2 },
            W::Duplicates { count: 2, line: 3 },
            W::UnitAssumed,
            W::SecondSignal { taken: text(), other: text(), option: "--columns 1,3".into() },
            W::Overload { count: 1, line: 2 },
            W::SoundCard,
            W::CutOff { samples: 1, announced: 2 },
            W::Spikes { count: 1, first: 0.1 },
            W::Glitches { count: 2 },
            W::PartialFrame { number: 2 },
            W::ShotsDiffer { scatter: 0.1 },
            W::Pulsed { hertz: 100.0 },
            W::Coupled { seconds: 0.1 },
            W::Undershoot { share: 0.1 },
            W::CutTail { left: 0.1 },
            W::Flicker { hertz: 100.0, amplitude: 0.1 },
            W::Inverted,
            W::Clipped { share: 0.1, at: 1.0 },
            W::Hum { hertz: 50.0, amplitude: 0.1 },
            W::ShortHum { hertz: 50.0, amplitude: 0.1, periods: 1.0, is_known: false },
            W::Drift { amount: 0.1 },
            W::DriftOrCapacitor { amount: 0.1 },
            W::Gap { count: 1, from: 0.1, to: 0.2 },
            W::WideError { share: 0.1 },
            W::Unseen { share: 0.1 },
            W::NoiseHidesRamps { noise: 0.1 },
            W::SharpEdges { step: 0.1 },
            W::NoPlateau,
            W::Misfit { share: 0.1, after: 0.1, by_trace: true },
            W::Misfit { share: 0.1, after: 0.1, by_trace: false },
            W::Untested,
            W::ZeroMoved,
        ] {
            is_plain(warning(&told));
        }
    }
}
