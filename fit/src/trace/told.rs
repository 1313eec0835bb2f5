//! Why a trace is refused, and what is doubtful about one that is not: the reason, what to do, and the setting that
//! does it, which the program and a page each have under a name of their own.
//!
//! Each message stands above the values that it tells: times in seconds, rates in hertz, signals in the trace's own
//! unit, amounts as shares of the light. Lines, frames and pulses count from 1.

use std::fmt::{self, Display};

use serde::Serialize;

use super::samples::{CONTRAST, LARGEST};
use crate::fact::Message;
use crate::unit::{self, short};

/// Messages, each with its values, the setting that mends it in brackets, and its words. Its name in snake case is its
/// code.
macro_rules! messages {
    ($(#[$of:meta])* $Name:ident: $(
        $(#[$about:meta])* $Variant:ident $({ $($value:ident: $Type:ty),* })? $([$remedy:expr])?
        $text:literal $(, $arg:expr)*;
    )*) => {
        $(#[$of])*
        #[derive(Clone, Debug, PartialEq, Serialize)]
        #[expect(missing_docs, reason = "a message tells what its values are")]
        #[non_exhaustive]
        #[serde(rename_all = "snake_case")]
        pub enum $Name { $($(#[$about])* $Variant $({ $($value: $Type),* })?,)* }

        impl $Name {
            /// Each message once, with empty values: for tests.
            #[doc(hidden)]
            pub fn each() -> Vec<Self> {
                vec![$(Self::$Variant $({ $($value: Default::default()),* })?,)*]
            }
        }

        impl std::error::Error for $Name {}

        #[allow(unused_variables, reason = "not all of a message's values are in its words")]
        impl fmt::Display for $Name {
            fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self { $(Self::$Variant $({ $($value),* })? => write!(out, $text $(, $arg)*),)* }
            }
        }

        #[allow(unused_variables, reason = "nor in its remedy")]
        impl Tell for $Name {
            fn remedy(&self) -> Option<Remedy<'_>> {
                match self {
                    $(Self::$Variant $({ $($value),* })? => None::<Remedy>$(.or($remedy.into()))?,)*
                }
            }
        }
    };
}

messages! {
    /// Why a trace cannot be fitted.
    Refusal:

    NotCsv { reason: String }
        "this is no CSV of samples: {reason}; export the trace as text, a time and a value in each row, both plain \
         numbers";
    /// No column of times, and no rate; with what may be one of them, but is not read.
    NoTimes { columns: String, text: Option<String>, quoted: Option<String> } [Remedy::Rate]
        "no column holds times (the columns of numbers are {columns}{}), {}; give the sampling rate in hertz",
        no_number(text), no_rate(quoted);
    Counter { name: String, quoted: Option<String> } [Remedy::Rate]
        "column {name} counts without a unit, so it is no time, {}; give the sampling rate in hertz, or the unit if \
         it is one",
        no_rate(quoted);
    /// A column runs on as times do, and its name or a setting says otherwise.
    UnclearUnit { name: String } [Remedy::Unit]
        "'{name}' above the numbers names no time in s, ms, us or ns, or leaves open which of them; if they are \
         times, give their unit";
    /// Beside the values stands what may be a time, but is no plain number.
    NoPlainTimes { text: String }
        "'{text}' is no time that is read: write times as plain numbers, as in 9.25, or as hours, minutes and \
         seconds of a day, as in 14:06:09.25";
    TwoTimes { first: String, second: String } [Remedy::Columns("")]
        "columns {first} and {second} hold different times; say which one, and the signal that belongs to it";
    Blocks { line: u64, text: String }
        "line {line}: '{text}' between the rows may begin another recording; put each into a file of its own, or leave \
         the line out";
    TwoRates { first: String, second: String } [Remedy::Rate]
        "'{first}' and '{second}' above the numbers tell different rates; give that of the rows";
    Thousands { number: String }
        "'{number}' has marks that may part thousands, or a whole number from its fraction; export plain numbers, \
         with the columns' names above them";
    NoColumn { name: String, there: String } [Remedy::Columns("")] "there is no column '{name}'; there are {there}";
    BrokenRows { count: usize, rows: usize, line: u64, reason: String, reading: String } [Remedy::Columns("")]
        "line {line}: {reason}; {count} of {rows} rows are like that, too many to leave out; is this the file, and \
         are these its columns? Read: {reading}";
    /// Times and values that no file gives: not as many, not finite or beyond 10³⁰, or out of order.
    Unsound "times and values have to be as many, finite numbers up to {LARGEST:e}, and times in order";
    TooFewSamples { samples: usize, required: usize }
        "{} in the trace, and at least {required} are required; sample faster",
        counted(samples, "sample");
    NoPulse { contrast: f64 } [Remedy::Columns("")]
        "no pulse: the brightest part stands out by {contrast:.1} times the noise, and {CONTRAST} are required; was \
         the light on, and is this the right channel?";
    ShortPulse { samples: usize, required: usize, pulses: usize }
        "the pulse has {}, and at least {required} are required to tell its shape; {}",
        counted(samples, "sample"),
        match pulses {
            0..=2 => "sample faster, or zoom in",
            _ => "so many pulses may be a lamp's that is switched on and off (PWM): use a steady one, or sample faster",
        };
    /// Every pulse is cut off: the first samples or the last ones are not dark.
    CutPulse { begins: bool, ends: bool }
        "no whole pulse: the trace {} in the pulse; record some of the dark {} it as well ({})",
        either(begins, ends, "begins", "ends"), either(begins, ends, "before", "after"),
        if *begins { "more pre-trigger" } else { "a longer window" };
    /// Light raises the signal and pulses are cut, or it lowers it.
    WhichWay [Remedy::Light]
        "the trace begins or ends in its higher level, which may be the dark, or a pulse that is cut off; say which \
         way light moves the signal";
    NoFrame { number: usize, frames: usize } [Remedy::Frame]
        "there is no frame {number}; the trace has {}",
        counted(frames, "whole frame");
    FullTooLow { given: f64, seen: f64 } [Remedy::Full]
        "the trace reaches {seen:.4}, more than the signal of full light, {given}; that is given in the trace's own \
         unit, the dark level included";
    LostRamp { from: f64, to: f64 }
        "samples are missing from {} to {}, and the light changes there: a ramp is lost; record it again",
        short(*from, 4), short(*to, 4);
    /// What a capacitor before the recorder takes away is too much to be given back.
    Coupled [Remedy::From]
        "the recorder passes no steady light (AC, a sound card), in a way that the time constants of two capacitors \
         do not explain: no result of such a trace is right; take another input, or a window around one pulse, with \
         ten times its length of dark on both sides";
    /// No delay can be told from the edge of the camera's sync.
    NoDelay { reason: String } [Remedy::Sync] "the sync tells no delay: {reason}";
    OtherPulse { first: usize } [Remedy::Frame]
        "the edge of the sync is followed by pulse {first} first, and another one is fitted";
    /// The samples leave open what the shutter does: a result is no finite number.
    Undetermined [Remedy::Columns("")]
        "the samples do not tell what the shutter does; look at the trace: is there one rise, one plateau at most, \
         one fall, with samples on each?";
    NoScene { reason: String, crowded: bool } [crowded.then_some(Remedy::Triggers)]
        "no scene can be made of this: {reason}; {}",
        match crowded {
            true => "ask for fewer triggers",
            false => "look at the trace: is there one rise, one plateau at most, one fall?",
        };
}

messages! {
    /// What is doubtful about a trace or about what was made of it.
    Warning:

    BrokenRows { count: usize, line: u64, reason: String }
        "line {line}: {reason}; {} left out",
        such_rows(count);
    Unsorted { line: u64 } "line {line}: time runs back; the samples are put in order";
    Duplicates { count: usize, line: u64 }
        "line {line}: the same time again; {} {} averaged with the other of their time",
        counted(count, "sample"), are(count);
    /// Times of a steady clock that were rounded to such a step.
    RoundedTimes { to: f64 }
        "the file rounds its times to {}; they are spread evenly, as a steady clock's, and the ± allow for it; \
         export them with more digits",
        time(to);
    /// Blocks of so many rows are stamped by a clock with such a standard error.
    StampedBlocks { rows: usize, error: f64 }
        "the rows come in blocks of {rows} even samples with uneven pauses between them, so each block's time is as \
         good as the clock that stamps it, some {}; the ± allow for it; record without pauses, or with each sample's \
         own time",
        time(error);
    Changes
        "the rows list the changes of a level of two values, as a logic analyser's do: it is taken to stay in \
         between, so no ramp shows";
    UnitAssumed [Remedy::Unit] "the file does not say in which unit its times are; they are taken as seconds";
    SecondSignal { taken: String, other: String, columns: String } [Remedy::Columns(columns)]
        "two columns hold a pulse: {taken} is taken for the light, and {other} is not";
    /// An edge of the sync was followed by others, as if a contact bounced, at so many of all shots, for so long at
    /// most.
    SyncBounced { few: usize, all: usize, by: f64, is_cut: bool } [is_cut.then_some(Remedy::From)]
        "the sync switches more than once at {few} of {}, the last time some {} after the first: its contact may \
         bounce, as it closes or as it opens{}; the first edge counts, so let the firmware take no other for so long",
        counted(all, "shot"), time(by), cut(is_cut);
    SyncMissing { few: usize, all: usize }
        "{few} of {} of this speed have no edge of the sync before them, and do not count in the delay; check the \
         lead",
        counted(all, "shot");
    SyncOthers { edges: usize }
        "{} of the sync {} no whole shot of the trace",
        counted(edges, "edge"), if *edges == 1 { "starts" } else { "start" };
    /// The edge comes after the opening in so many of all shots, by so much at most.
    SyncLate { few: usize, all: usize, by: f64 }
        "the edge of the sync comes after the start of opening in {few} of {}, by up to {}: no flash can come \
         before it; those while the shutter is fully open can (`fully_open`), as with an X contact",
        counted(all, "shot"), time(by);
    SoundCard [Remedy::From]
        "a sound card passes no steady light, and may change its gain by itself: switch that off, and compare with \
         another input; where the exposure is in doubt, take a window around one pulse, with ten times its length of \
         dark on both sides";
    CutOff { samples: usize, announced: usize }
        "the file is cut off: it announces {} and holds {samples}; what was recorded after these is missing, so \
         copy or save it again",
        counted(announced, "sample");
    Spikes { count: usize, first: f64 }
        "{} left out, the first at {} s",
        counted(count, "spike"), short(*first, 9);
    Glitches { count: usize }
        "{} left out: with less than a fifth of the light of the largest pulse",
        counted(count, "small pulse");
    PartialFrame { number: usize } [Remedy::Frame]
        "pulse {number} of the trace has too little dark beside it, and is left out; those that are whole are \
         counted";
    /// The exposures of the shots differ by more than a shutter's own scatter: standard deviation over mean.
    ShotsDiffer { scatter: f64 } [Remedy::Frame]
        "the exposures of the shots scatter by {}, so they are not of one setting; only one of them was fitted",
        percent(scatter);
    Pulsed { hertz: f64 }
        "pulses follow each other at {} Hz: that is a lamp which is switched on and off (PWM), and the exposure is \
         one of its pulses', not the shutter's; use a steady lamp",
        short(*hertz, 3);
    /// The recorder was coupled by a capacitor of this time constant, or by two, which are fitted.
    #[serde(rename = "ac_coupled")]
    Coupled { seconds: f64, second: Option<f64> }
        "the recorder is coupled by {} (AC), with a time constant of {}{}: fitted, and in the ±; DC coupling is \
         better, where there is a choice",
        if second.is_some() { "two capacitors" } else { "a capacitor" }, time(seconds),
        second.as_ref().map_or(String::new(), |second| format!(" and of {}", time(second)));
    CutTail { left: f64 }
        "the signal still falls where the trace ends, {} of the light above the dark before: the tail is cut off, \
         so the exposure comes out too short; record a longer window",
        percent(left);
    SlowTail { share: f64, with: f64 }
        "a tail that begins with {} of the light follows the pulse: it is taken for the sensor's lag, and left out; \
         if it is the light's own, the exposure is {}; a faster sensor tells",
        percent(share), unit::Unit::fit(*with).show(*with);
    Flicker { hertz: f64, amplitude: f64 }
        "the lamp flickers at {} Hz by {} of its light, which is fitted and taken out; a steady lamp is better",
        short(*hertz, 4), percent(amplitude);
    Inverted [Remedy::Light]
        "light seems to lower the signal, so it is turned round; if it does not, the trace begins and ends in the \
         light";
    /// The brightest samples, a share of the pulse's, are all the same.
    Clipped { share: f64, at: f64 }
        "clipped: {:.0} % of the pulse's samples stop at {}; full light is above that, so the exposure comes out \
         too long, by some percent; lower the gain",
        100.0 * share, short(*at, 4);
    Hum { hertz: f64, amplitude: f64 }
        "hum of {} Hz, {:.2} % of the light, fitted and taken out; if it is the lamp's own flicker (mains, or an \
         LED's PWM), use a steady one",
        short(*hertz, 4), 100.0 * amplitude;
    /// A sine of so few periods in the record that a drift or the shutter may pass for it; was its frequency given?
    ShortHum { hertz: f64, amplitude: f64, periods: f64, is_known: bool } [(!is_known).then_some(Remedy::Mains)]
        "hum of {:.2} % of the light, taken out at {}, of which the dark and the pulse hold {periods:.1} periods: a \
         drift or the shutter's own shape may pass for it; run it all on batteries, or record more dark",
        100.0 * amplitude, format!("{} Hz", short(*hertz, if *is_known { 4 } else { 2 }));
    Drift { amount: f64 }
        "the dark level drifts by {:.2} % of the light over the samples that are fitted, and is taken out",
        100.0 * amount;
    #[serde(rename = "noise")]
    NoiseHidesRamps { noise: f64 }
        "noise of {:.1} % of the light hides the ramps' shape; average several shots, or use more light",
        100.0 * noise;
    /// A sample as a share of the exposure: a recorder of moments does not show where between two of them an edge was.
    SharpEdges { step: f64, share: f64 }
        "edges within two samples: each is known to {} at best (the sampling interval by the root of 12), and the \
         exposure to a sample, {} of it; sample faster if that matters",
        time(&(step / 12f64.sqrt())), percent(share);
    NoPlateau [Remedy::Full]
        "there is no plateau to speak of: the shutter may never open fully; the peak counts as full light, unless \
         the signal of full light is given";
    /// A large standard error, the largest, as a share of the exposure.
    WideError { share: f64 }
        "the exposure or a trigger is known to ± {} of the exposure only (a standard error): see to the other \
         warnings first, then take more samples, or more light",
        percent(share);
    Gap { count: usize, from: f64, to: f64 }
        "samples are missing at {} in the pulse or beside it, the longest from {} to {} s: what the shutter did \
         there is not known; record it again",
        counted(count, "place"), short(*from, 7), short(*to, 7);
    /// So few samples, or so much noise, that the test of the fit is blind for a dip of this share for a fifth of the
    /// pulse.
    Unseen { share: f64 }
        "too few samples, or too much noise, to see a dip, a slope or a tail of less than {} of the light; the ± \
         allow for it; sample faster, or average several shots",
        percent(share);
    DriftOrCapacitor { amount: f64 }
        "the dark is {:.2} % of the light {} after the pulse than before: a drift, as which it is taken out, or a \
         capacitor before the recorder (AC), which would move the triggers; couple it for DC, or record more dark",
        100.0 * amount.abs(), if *amount < 0.0 { "lower" } else { "higher" };
    /// No model passes the samples as closely as their noise allows: the greatest structure that is left, and how long
    /// after the opening; are exposure and triggers the trace's own?
    Misfit { share: f64, after: f64, by_trace: bool } [Remedy::Picture]
        "the trace has structure that the model has not: {} of the light, {}; exposure and triggers are {}; look at \
         the residual",
        percent(&share.abs()), from_opening(*after),
        match by_trace {
            true => "the trace's own, and no curve stands for them",
            false => "the model's, and off by more than their errors say",
        };
    Untested
        "there is too little dark beside the pulse to tell whether the model explains the trace; record more of it";
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
            Remedy::Rate => "HERTZ",
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

fn cut(is_cut: &bool) -> &'static str {
    match is_cut {
        true => ", or the record begins while it is still closed, and a part from later on or more shots help",
        false => "",
    }
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
