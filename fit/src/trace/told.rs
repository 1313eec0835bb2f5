//! Why a trace is refused, and what is doubtful about one that is not: the reason, what to do, and the setting that
//! does it, which the program and a page each have under a name of their own.
//!
//! Each message stands above the values that it tells: times in seconds, rates in hertz, signals in the trace's own
//! unit, amounts as shares of the light. Lines, frames and pulses count from 1.

use std::fmt::Display;

use serde::Serialize;
use thiserror::Error;

use super::samples::{CONTRAST, LARGEST};
use crate::fact::Message;
use crate::unit::{self, short};

/// Why a trace cannot be fitted.
#[derive(Clone, Debug, Error, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "strum", derive(strum::EnumIter))]
#[expect(missing_docs, reason = "a message tells what its values are")]
#[non_exhaustive]
pub enum Refusal {
    #[error(
        "this is no CSV of samples: {reason}; export the trace as text, a time and a value in each row, both plain \
         numbers"
    )]
    NotCsv { reason: String },
    /// No column of times, and no rate; with what may be one of them, but is not read.
    #[error(
        "no column holds times (the columns of numbers are {columns}{}), {}; give the sampling rate in hertz",
        no_number(.text),
        no_rate(.quoted)
    )]
    NoTimes { columns: String, text: Option<String>, quoted: Option<String> },
    #[error(
        "column {name} counts without a unit, so it is no time, {}; give the sampling rate in hertz, or the unit if it \
         is one",
        no_rate(.quoted)
    )]
    Counter { name: String, quoted: Option<String> },
    /// A column runs on as times do, and its name or a setting says otherwise.
    #[error(
        "'{name}' above the numbers names no time in s, ms, us or ns, or leaves open which of them; if they are times, \
         give their unit"
    )]
    UnclearUnit { name: String },
    /// Beside the values stands what may be a time, but is no plain number.
    #[error(
        "'{text}' is no time that is read: write times as plain numbers, as in 9.25, or as hours, minutes and seconds \
         of a day, as in 14:06:09.25"
    )]
    NoPlainTimes { text: String },
    #[error("columns {first} and {second} hold different times; say which one, and the signal that belongs to it")]
    TwoTimes { first: String, second: String },
    #[error("column {name} is asked for twice")]
    SameColumn { name: String },
    #[error("line {line}: '{text}' between the rows begins another recording; put each into a file of its own")]
    Blocks { line: u64, text: String },
    #[error("'{first}' and '{second}' above the numbers tell different rates; give the right one")]
    TwoRates { first: String, second: String },
    #[error(
        "'{number}' has marks that may part thousands, or a whole number from its fraction; export plain numbers, \
         with the columns' names above them"
    )]
    Thousands { number: String },
    #[error("there is no column '{name}'; there are {there}")]
    NoColumn { name: String, there: String },
    #[error(
        "line {line}: {reason}; {count} of {rows} rows are like that, too many to leave out; is this the file, and are \
         these its columns? Read: {reading}"
    )]
    BrokenRows { count: usize, rows: usize, line: u64, reason: String, reading: String },
    /// Times and values that no file gives: not as many, not finite or beyond 10³⁰, or out of order.
    #[error("times and values have to be as many, finite numbers up to {LARGEST:e}, and times in order")]
    Unsound,
    #[error("{} in the trace, and at least {required} are required; sample faster", counted(.samples, "sample"))]
    TooFewSamples { samples: usize, required: usize },
    #[error(
        "no pulse: the brightest part stands out by {contrast:.1} times the noise, and {CONTRAST} are required; was \
         the light on, and is this the right channel?"
    )]
    NoPulse { contrast: f64 },
    #[error(
        "the pulse has {}, and at least {required} are required to tell its shape; {}",
        counted(.samples, "sample"),
        if *.pulses > 2 {
            "so many pulses may be those of a lamp that is switched on and off (PWM): use a steady one, or sample \
             faster"
        } else {
            "sample faster, or zoom in"
        }
    )]
    ShortPulse { samples: usize, required: usize, pulses: usize },
    /// Every pulse is cut off: the first samples or the last ones are not dark.
    #[error(
        "no whole pulse: the trace {} in the pulse; record some of the dark {} it as well ({})",
        either(.begins, .ends, "begins", "ends"),
        either(.begins, .ends, "before", "after"),
        if *.begins { "more pre-trigger" } else { "a longer window" }
    )]
    CutPulse { begins: bool, ends: bool },
    /// Light raises the signal and pulses are cut, or it lowers it.
    #[error(
        "the trace begins or ends in its higher level, which may be the dark, or a pulse that is cut off; say which \
         way light moves the signal"
    )]
    WhichWay,
    #[error("there is no frame {number}; the trace has {}", counted(.frames, "whole frame"))]
    NoFrame { number: usize, frames: usize },
    #[error(
        "the trace reaches {seen:.4}, more than the signal of full light, {given}; that is given in the trace's own \
         unit, the dark level included"
    )]
    FullTooLow { given: f64, seen: f64 },
    #[error(
        "samples are missing from {} to {}, and the light changes there: a ramp is lost; record it again",
        short(*.from, 4),
        short(*.to, 4)
    )]
    LostRamp { from: f64, to: f64 },
    /// What a capacitor before the recorder takes away is too much to be given back.
    #[error(
        "the recorder passes no steady light (AC, a sound card), in a way that the time constants of two capacitors do \
         not explain: no result of such a trace is right; take another input, or a window around one pulse, with ten \
         times its length of dark on both sides"
    )]
    Coupled,
    /// No delay can be told from the edge of the camera's sync.
    #[error("the sync tells no delay: {reason}")]
    NoDelay { reason: String },
    #[error("the edge of the sync is followed by pulse {first} first, and another one is fitted")]
    OtherPulse { first: usize },
    /// The samples leave open what the shutter does: a result is no finite number.
    #[error(
        "the samples do not tell what the shutter does; look at the trace: is there one rise, one plateau at most, one \
         fall, with samples on each?"
    )]
    Undetermined,
    #[error(
        "no scene can be made of this: {reason}; {}",
        if *.crowded {
            "ask for fewer triggers"
        } else {
            "look at the trace: is there one rise, one plateau at most, one fall?"
        }
    )]
    NoScene { reason: String, crowded: bool },
}

fn no_number(text: &Option<String>) -> String {
    text.as_ref().map_or(String::new(), |text| format!("; '{text}' beside them is no number"))
}

fn no_rate(quoted: &Option<String>) -> String {
    let but = |text: &String| format!(" ('{text}' is not read as one)");
    format!("and nothing above the rows gives a rate{}", quoted.as_ref().map_or(String::new(), but))
}

fn either(first: &bool, second: &bool, one: &str, other: &str) -> String {
    match (first, second) {
        (true, true) => format!("{one} and {other}"),
        (true, false) => one.into(),
        _ => other.into(),
    }
}

/// What is doubtful about a trace or about what was made of it. A variant's name in snake case is its code.
#[derive(Clone, Debug, Error, PartialEq, Serialize)]
#[cfg_attr(feature = "strum", derive(strum::EnumIter))]
#[expect(missing_docs, reason = "a message tells what its values are")]
#[non_exhaustive]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    #[error("line {line}: {reason}; {} left out", such_rows(.count))]
    BrokenRows { count: usize, line: u64, reason: String },
    #[error("line {line}: time runs back; the samples are put in order")]
    Unsorted { line: u64 },
    #[error(
        "line {line}: the same time again; {} {} averaged with the other of their time",
        counted(.count, "sample"),
        are(.count)
    )]
    Duplicates { count: usize, line: u64 },
    /// Times of a steady clock that were rounded to such a step.
    #[error(
        "the file rounds its times to {}; they are spread evenly, as a steady clock's, and the ± allow for it; export \
         them with more digits",
        time(.to)
    )]
    RoundedTimes { to: f64 },
    /// Blocks of so many rows are stamped by a clock with such a standard error.
    #[error(
        "the rows come in blocks of {rows} even samples with uneven pauses between them, so each block's time is as \
         good as the clock that stamps it, some {}; the ± allow for it; record without pauses, or with each sample's \
         own time",
        time(.error)
    )]
    StampedBlocks { rows: usize, error: f64 },
    #[error(
        "the rows list the changes of a level of two values, as a logic analyser's do: it is taken to stay in \
         between, so no ramp shows"
    )]
    Changes,
    #[error("the file does not say in which unit its times are; they are taken as seconds")]
    UnitAssumed,
    #[error("two columns hold a pulse: {taken} is taken for the light, and {other} is not")]
    SecondSignal { taken: String, other: String, columns: String },
    /// An edge of the sync was followed by others, as if a contact bounced, at so many of all shots, for so long at
    /// most.
    #[error(
        "the sync switches more than once at {few} of {}, the last time some {} after the first: its contact may \
         bounce, as it closes or as it opens; the first edge counts, so let the firmware take no other for so long",
        counted(.all, "shot"),
        time(.by)
    )]
    SyncBounced { few: usize, all: usize, by: f64 },
    #[error(
        "{few} of {} of this speed have no edge of the sync before them, and do not count in the delay; check the \
         lead",
        counted(.all, "shot")
    )]
    SyncMissing { few: usize, all: usize },
    #[error(
        "{} of the sync {} no whole shot of the trace",
        counted(.edges, "edge"),
        if *.edges == 1 { "starts" } else { "start" }
    )]
    SyncOthers { edges: usize },
    /// The edge comes after the opening in so many of all shots, by so much at most.
    #[error(
        "the edge of the sync comes after the start of opening in {few} of {}, by up to {}: no flash can come before \
         it; those while the shutter is fully open can (fully_open), as with an X contact",
        counted(.all, "shot"),
        time(.by)
    )]
    SyncLate { few: usize, all: usize, by: f64 },
    #[error(
        "a sound card passes no steady light, and may change its gain by itself: switch that off, and compare with \
         another input; where the exposure is in doubt, take a window around one pulse, with ten times its length of \
         dark on both sides"
    )]
    SoundCard,
    #[error(
        "the file is cut off: it announces {} and holds {samples}; what was recorded after these is missing, so copy \
         or save it again",
        counted(.announced, "sample")
    )]
    CutOff { samples: usize, announced: usize },
    #[error("{} left out, the first at {} s", counted(.count, "spike"), short(*.first, 9))]
    Spikes { count: usize, first: f64 },
    #[error("{} left out: with less than a fifth of the light of the largest pulse", counted(.count, "small pulse"))]
    Glitches { count: usize },
    #[error(
        "pulse {number} of the trace has too little dark beside it, and is left out; those that are whole are \
         counted"
    )]
    PartialFrame { number: usize },
    /// The exposures of the shots differ by more than a shutter's own scatter: standard deviation over mean.
    #[error(
        "the exposures of the shots scatter by {}, so they are not of one setting; only one of them was fitted",
        percent(.scatter)
    )]
    ShotsDiffer { scatter: f64 },
    #[error(
        "pulses follow each other at {} Hz: that is a lamp which is switched on and off (PWM), and the exposure is one \
         of its pulses', not the shutter's; use a steady lamp",
        short(*.hertz, 3)
    )]
    Pulsed { hertz: f64 },
    /// The recorder was coupled by a capacitor of this time constant, or by two, which are fitted.
    #[error(
        "the recorder is coupled by {} (AC), with a time constant of {}{}: fitted, and in the ±; DC coupling \
         is better, where there is a choice",
        if .second.is_some() { "two capacitors" } else { "a capacitor" },
        time(.seconds),
        .second.as_ref().map_or(String::new(), |second| format!(" and of {}", time(second)))
    )]
    #[serde(rename = "ac_coupled")]
    Coupled { seconds: f64, second: Option<f64> },
    #[error(
        "the signal still falls where the trace ends, {} of the light above the dark before: the tail is cut off, so \
         the exposure comes out too short; record a longer window",
        percent(.left)
    )]
    CutTail { left: f64 },
    #[error(
        "a tail that begins with {} of the light follows the pulse: it is taken for the sensor's lag, and left out; \
         if it is the light's own, the exposure is {}; a faster sensor tells",
        percent(.share),
        unit::Unit::fit(*with).show(*with)
    )]
    SlowTail { share: f64, with: f64 },
    #[error(
        "the lamp flickers at {} Hz by {} of its light, which is fitted and taken out; a steady lamp is better",
        short(*.hertz, 4),
        percent(.amplitude)
    )]
    Flicker { hertz: f64, amplitude: f64 },
    #[error(
        "light seems to lower the signal, so it is turned round; if it does not, the trace begins and ends in the \
         light"
    )]
    Inverted,
    /// The brightest samples, a share of the pulse's, are all the same.
    #[error(
        "clipped: {:.0} % of the pulse's samples stop at {}; full light is above that, so the exposure comes out too \
         long, by some percent; lower the gain",
        100.0 * share,
        short(*.at, 4)
    )]
    Clipped { share: f64, at: f64 },
    #[error(
        "hum of {} Hz, {:.2} % of the light, fitted and taken out; if it is the lamp's own flicker (mains, or an LED's \
         PWM), use a steady one",
        short(*.hertz, 4),
        100.0 * amplitude
    )]
    Hum { hertz: f64, amplitude: f64 },
    /// A sine of so few periods in the record that a drift or the shutter may pass for it; was its frequency given?
    #[error(
        "hum of {:.2} % of the light, taken out at {}, of which the dark and the pulse hold {periods:.1} periods: a \
         drift or the shutter's own shape may pass for it; run it all on batteries, or record more dark",
        100.0 * amplitude,
        format!("{} Hz", short(*hertz, if *.is_known { 4 } else { 2 }))
    )]
    ShortHum { hertz: f64, amplitude: f64, periods: f64, is_known: bool },
    #[error(
        "the dark level drifts by {:.2} % of the light over the samples that are fitted, and is taken out",
        100.0 * amount
    )]
    Drift { amount: f64 },
    #[error(
        "noise of {:.1} % of the light hides the ramps' shape; average several shots, or use more light",
        100.0 * noise
    )]
    #[serde(rename = "noise")]
    NoiseHidesRamps { noise: f64 },
    #[error(
        "edges within two samples: each is known to {} at best (the sampling interval by the root of 12); sample \
         faster if that matters",
        time(&(step / 12f64.sqrt()))
    )]
    SharpEdges { step: f64 },
    #[error(
        "there is no plateau to speak of: the shutter may never open fully; the peak counts as full light, unless the \
         signal of full light is given"
    )]
    NoPlateau,
    /// A large standard error, the largest, as a share of the exposure.
    #[error(
        "the exposure or a trigger is known to ± {} of the exposure only (a standard error): see to \
         the other warnings first, then take more samples, or more light",
        percent(.share)
    )]
    WideError { share: f64 },
    #[error(
        "samples are missing at {} in the pulse or beside it, the longest from {} to {} s: what the shutter did \
         there is not known; record it again",
        counted(.count, "place"),
        short(*.from, 7),
        short(*.to, 7)
    )]
    Gap { count: usize, from: f64, to: f64 },
    /// So few samples, or so much noise, that the test of the fit is blind for a dip of this share for a fifth of the
    /// pulse.
    #[error(
        "too few samples, or too much noise, to see a dip, a slope or a tail of less than {} of the light; the ± \
         allow for it; sample faster, or average several shots",
        percent(.share)
    )]
    Unseen { share: f64 },
    #[error(
        "the dark is {:.2} % of the light {} after the pulse than before: a drift, as which it is taken out, or a \
         capacitor before the recorder (AC), which would move the triggers; couple it for DC, or record more dark",
        100.0 * amount.abs(),
        if *.amount < 0.0 { "lower" } else { "higher" }
    )]
    DriftOrCapacitor { amount: f64 },
    /// No model passes the samples as closely as their noise allows: the greatest structure that is left, and how long
    /// after the opening; are exposure and triggers the trace's own?
    #[error(
        "the trace has structure that the model has not: {} of the light, {}; exposure and triggers are {}; look at \
         the residual",
        percent(&share.abs()),
        from_opening(*.after),
        if *.by_trace {
            "the trace's own, and no curve stands for them"
        } else {
            "the model's, and off by more than their errors say"
        }
    )]
    Misfit { share: f64, after: f64, by_trace: bool },
    #[error(
        "there is too little dark beside the pulse to tell whether the model explains the trace; record more of it"
    )]
    Untested,
    #[error("the trace's times are too far from 0 for the scene's numbers; time 0 is where the shutter starts to open")]
    ZeroMoved,
}

/// The setting that mends what is refused or doubtful.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "as the program's options are called")]
#[serde(rename_all = "snake_case")]
pub enum Remedy<'a> {
    Rate,
    Unit,
    /// The columns to ask for, if they are known.
    Columns(&'a str),
    Light,
    Full,
    Frame,
    Mains,
    Sync,
    Triggers,
    Picture,
    /// The first time that counts, and with it the last.
    From,
}

impl Remedy<'_> {
    /// The option's name.
    pub fn option(&self) -> &'static str {
        serde_variant::to_variant_name(self).unwrap_or_default()
    }
}

/// What is told of a trace.
pub trait Tell: Display + Serialize + Sized {
    /// The setting that mends it, if there is one.
    fn remedy(&self) -> Option<Remedy<'_>>;

    /// Its code, its words and the setting that mends it.
    fn message(&self) -> Message {
        let code = serde_variant::to_variant_name(self).unwrap_or_default();
        Message { code, text: self.to_string(), remedy: self.remedy().map(|remedy| remedy.option()) }
    }

    /// As the program tells it, with its option.
    fn with_option(&self) -> String {
        let Some(remedy) = self.remedy() else { return self.to_string() };
        let value = match remedy {
            Remedy::Rate => "100000",
            Remedy::Unit => "us, ms or s",
            Remedy::Columns(columns) => columns,
            Remedy::Light => "up or down",
            Remedy::Mains => "50 or 60",
            Remedy::From => "and --to",
            _ => "",
        };
        let option = format!("--{} {value}", remedy.option());
        format!("{self} ({})", option.trim_end())
    }
}

impl Tell for Refusal {
    fn remedy(&self) -> Option<Remedy<'_>> {
        use Remedy as M;
        Some(match self {
            Self::NoTimes { .. } | Self::Counter { .. } | Self::TwoRates { .. } => M::Rate,
            Self::UnclearUnit { .. } => M::Unit,
            Self::SameColumn { .. } | Self::NoColumn { .. } | Self::BrokenRows { .. } | Self::TwoTimes { .. } => {
                M::Columns("")
            }
            Self::NoPulse { .. } | Self::Undetermined => M::Columns(""),
            Self::WhichWay => M::Light,
            Self::NoFrame { .. } | Self::OtherPulse { .. } => M::Frame,
            Self::FullTooLow { .. } => M::Full,
            Self::NoDelay { .. } => M::Sync,
            Self::NoScene { crowded: true, .. } => M::Triggers,
            Self::Coupled => M::From,
            _ => return None,
        })
    }
}

impl Tell for Warning {
    fn remedy(&self) -> Option<Remedy<'_>> {
        use Remedy as M;
        Some(match self {
            Self::UnitAssumed => M::Unit,
            Self::SecondSignal { columns, .. } => M::Columns(columns),
            Self::ShotsDiffer { .. } | Self::PartialFrame { .. } => M::Frame,
            Self::Inverted => M::Light,
            Self::ShortHum { is_known: false, .. } => M::Mains,
            Self::NoPlateau => M::Full,
            Self::Misfit { .. } => M::Picture,
            Self::SoundCard => M::From,
            _ => return None,
        })
    }
}

impl Warning {
    /// A name that a program can ask for: it stays as it is.
    pub fn code(&self) -> &'static str {
        serde_variant::to_variant_name(self).unwrap_or_default()
    }

    /// Adds those of others that are not told yet.
    pub fn add(told: &mut Vec<Self>, others: impl IntoIterator<Item = Self>) {
        for other in others {
            if told.iter().all(|it| it.code() != other.code()) {
                told.push(other);
            }
        }
    }
}

/// A time that counts from the start of opening.
pub fn from_opening(seconds: f64) -> String {
    let way = if seconds < 0.0 { "before" } else { "after" };
    format!("{} {way} opening", time(&seconds.abs()))
}

/// A time in the unit that suits it, to two digits.
fn time(seconds: &f64) -> String {
    let unit = unit::Unit::fit(*seconds);
    format!("{} {}", short(unit.of(*seconds), 2), unit.name())
}

fn percent(share: &f64) -> String {
    format!("{} %", short(100.0 * share, 2))
}

fn counted(n: &usize, thing: &str) -> String {
    unit::count(*n as u64, thing)
}

fn such_rows(n: &usize) -> String {
    if *n == 1 { "the row is".into() } else { format!("{n} such rows are") }
}

fn are(n: &usize) -> &'static str {
    if *n == 1 { "is" } else { "are" }
}
