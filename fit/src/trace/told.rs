//! Why a trace is refused, and what is doubtful about one that is not: the reason, and what to do.

use std::fmt;

use super::samples::{CONTRAST, LARGEST};
use crate::delay::Doubt;
use crate::unit;

/// Why a trace cannot be fitted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// Nothing that looks like rows of numbers.
    NotCsv {
        /// What it looks like.
        reason: String,
    },
    /// No column of times, and no rate.
    NoTimes {
        /// So many columns there are, and their names.
        columns: String,
        /// What stands beside the numbers, and may be a time that is not read.
        text: Option<String>,
        /// What may give a rate, but is not read.
        quoted: Option<String>,
    },
    /// Numbers that count rows, and no rate.
    Counter {
        /// The column's.
        name: String,
        /// What may give a rate, but is not read.
        quoted: Option<String>,
    },
    /// A unit of time with something beside it.
    UnclearUnit {
        /// The column's name.
        name: String,
    },
    /// A column that is asked for twice.
    SameColumn {
        /// Its name.
        name: String,
    },
    /// Several recordings below each other.
    Blocks {
        /// Where the second one begins.
        line: u64,
        /// What stands there.
        text: String,
    },
    /// Two lines above the numbers tell different rates.
    TwoRates {
        /// One of them.
        first: String,
        /// The other.
        second: String,
    },
    /// Numbers with a comma beside others with a point.
    Thousands {
        /// The one with a comma.
        number: String,
        /// The other.
        other: String,
    },
    /// A column that is asked for is not there.
    NoColumn {
        /// As asked for.
        name: String,
        /// What there is.
        there: String,
    },
    /// Too many rows that are no samples.
    BrokenRows {
        /// So many.
        count: usize,
        /// Of so many.
        rows: usize,
        /// The first one's line.
        line: u64,
        /// What is wrong with that.
        reason: String,
        /// What was read as what.
        reading: String,
    },
    /// Times and values that are not as many, not finite or beyond 10³⁰, or out of order; no file that was read gives these.
    Unsound,
    /// So few that nothing can be told.
    TooFewSamples {
        /// So many there are.
        samples: usize,
        /// So many are required.
        required: usize,
    },
    /// The signal stays at one level.
    NoPulse {
        /// In standard deviations of the noise.
        contrast: f64,
    },
    /// The pulse has so few samples that its shape cannot be told.
    ShortPulse {
        /// So many there are.
        samples: usize,
        /// So many are required.
        required: usize,
    },
    /// The first samples are not dark.
    BeginsInPulse {
        /// Was it said which way light moves the signal?
        has_way: bool,
    },
    /// The last samples are not dark.
    EndsInPulse {
        /// Was it said which way light moves the signal?
        has_way: bool,
    },
    /// A frame that is asked for is not there.
    NoFrame {
        /// As asked for, from 1.
        number: usize,
        /// So many there are.
        frames: usize,
    },
    /// The full light that is given is less than the trace shows.
    FullTooLow {
        /// As given.
        given: f64,
        /// As seen.
        seen: f64,
    },
    /// The samples of a ramp are missing.
    LostRamp {
        /// From when, in seconds.
        from: f64,
        /// Until when.
        to: f64,
    },
    /// No delay can be told from the edge of the camera's sync.
    NoDelay {
        /// Why not.
        reason: String,
    },
    /// The samples leave open what the shutter does: a result is no finite number.
    Undetermined,
    /// No scene can be written that can be planned.
    NoScene {
        /// Why not.
        reason: String,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotCsv { reason } => write!(
                out,
                "this is no CSV of samples: {reason}; export the trace as text, a time and a value in each row, both plain \
                 numbers"
            ),
            Self::NoTimes { columns, text, quoted } => {
                let beside = |text: &String| format!("; '{text}' beside them is no number");
                let text = text.as_ref().map_or(String::new(), beside);
                write!(
                    out,
                    "no column holds times (the columns of numbers are {columns}{text}), {}; {RATE}",
                    no_rate(quoted)
                )
            }
            Self::Counter { name, quoted } => write!(
                out,
                "column {name} counts without a unit, so it is no time, {}; {RATE}, or the unit with --unit if it is one",
                no_rate(quoted)
            ),
            Self::UnclearUnit { name } => write!(
                out,
                "'{name}' above the times is more than a unit, or one that is not read; give the unit with --unit us, ms or \
                 s, or the sampling rate in hertz, as in --rate 100000"
            ),
            Self::SameColumn { name } => {
                write!(out, "column {name} is asked for twice; see --columns")
            }
            Self::Blocks { line, text } => write!(
                out,
                "line {line}: '{text}' between the rows begins another recording; put each into a file of its own"
            ),
            Self::TwoRates { first, second } => write!(
                out,
                "'{first}' and '{second}' above the numbers tell different rates; give the right one, as in --rate 100000"
            ),
            Self::Thousands { number, other } if number == other => write!(
                out,
                "'{number}' may be one and a fraction, or a thousand; export without separators of thousands"
            ),
            Self::Thousands { number, other } => write!(
                out,
                "'{number}' has a comma and '{other}' a point, so one of them parts thousands; export without separators"
            ),
            Self::NoColumn { name, there } => {
                write!(out, "there is no column '{name}'; there are {there}; see --columns")
            }
            Self::BrokenRows { count, rows, line, reason, reading } => write!(
                out,
                "line {line}: {reason}; {count} of {rows} rows are like that, too many to leave out: is this the file, \
                 and are --columns right? Read: {reading}"
            ),
            Self::Unsound => write!(
                out,
                "times and values have to be as many, finite numbers up to {LARGEST:e}, and times in order"
            ),
            Self::TooFewSamples { samples, required } => write!(
                out,
                "{} in the trace, and at least {required} are required; sample faster",
                counted(*samples, "sample")
            ),
            Self::NoPulse { contrast } => write!(
                out,
                "no pulse: the brightest part stands out by {contrast:.1} times the noise, and {CONTRAST} are required; is \
                 this the right channel (--columns), and was the light on?"
            ),
            Self::ShortPulse { samples, required } => write!(
                out,
                "the pulse has {}, and at least {required} are required to tell its shape; sample faster, or zoom in",
                counted(*samples, "sample")
            ),
            Self::BeginsInPulse { has_way } => write!(
                out,
                "the trace begins in the pulse; record some of the dark before it as well (more pre-trigger){}",
                or_the_way(*has_way)
            ),
            Self::EndsInPulse { has_way } => write!(
                out,
                "the trace ends in the pulse; record some of the dark after it as well (a longer window){}",
                or_the_way(*has_way)
            ),
            Self::NoFrame { number, frames } => {
                write!(out, "there is no frame {number}; the trace has {}", counted(*frames, "whole frame"))
            }
            Self::FullTooLow { given, seen } => write!(
                out,
                "--full {given}: the trace reaches {seen:.4}, more than the signal of full light; it is given in the \
                 trace's own unit, the dark level included"
            ),
            Self::LostRamp { from, to } => write!(
                out,
                "samples are missing from {} to {}, and the light changes there: a ramp is lost; record it again",
                time(*from),
                time(*to)
            ),
            Self::NoDelay { reason } => write!(out, "--sync: {reason}"),
            Self::Undetermined => out.write_str(
                "the samples do not tell what the shutter does; look at the trace: is there one rise, one plateau at most, \
                 one fall, with samples on each?",
            ),
            Self::NoScene { reason } => write!(
                out,
                "no scene can be made of this: {reason}; look at the trace: is there one rise, one plateau at most, one fall?"
            ),
        }
    }
}

/// What helps where a file does not tell its times.
const RATE: &str = "give the sampling rate in hertz, as in --rate 100000";

fn no_rate(quoted: &Option<String>) -> String {
    let but = |text: &String| format!(" ('{text}' is not read as one)");
    format!("and nothing above the rows gives a rate{}", quoted.as_ref().map_or(String::new(), but))
}

/// What may help beside more dark, unless it was done.
fn or_the_way(has_way: bool) -> &'static str {
    if has_way {
        return "";
    }
    ", or say which way light moves the signal with --light up or --light down"
}

impl std::error::Error for Refusal {}

/// What is doubtful about a trace or about what was made of it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Rows that are no samples were left out.
    BrokenRows {
        /// So many.
        count: usize,
        /// The first one's line.
        line: u64,
        /// What is wrong with that.
        reason: String,
    },
    /// Samples that were out of order.
    Unsorted {
        /// The first one's line.
        line: u64,
    },
    /// Samples at the same time, averaged.
    Duplicates {
        /// So many too many.
        count: usize,
        /// The first one's line.
        line: u64,
    },
    /// The file does not tell the time's unit.
    UnitAssumed,
    /// Another column holds a pulse as well.
    SecondSignal {
        /// The one that was taken.
        taken: String,
        /// The other.
        other: String,
        /// How to take that.
        option: String,
    },
    /// Values that the instrument could not show.
    Overload {
        /// So many.
        count: usize,
        /// The first one's line.
        line: u64,
    },
    /// The camera's sync.
    Sync(Doubt),
    /// The file is a sound.
    SoundCard,
    /// The file ends before all samples that its beginning announces.
    CutOff {
        /// So many there are.
        samples: usize,
        /// So many are announced.
        announced: usize,
    },
    /// Samples left out as spikes.
    Spikes {
        /// So many.
        count: usize,
        /// When the first one comes.
        first: f64,
    },
    /// Flashes too small to be frames, left out.
    Glitches {
        /// So many.
        count: usize,
    },
    /// A pulse that the trace's beginning or end cuts, or that has another right beside it.
    PartialFrame {
        /// From 1.
        number: usize,
    },
    /// The exposures of the shots differ by more than a shutter's own scatter.
    ShotsDiffer {
        /// Their standard deviation, as a share of their mean.
        scatter: f64,
    },
    /// The lamp is switched on and off, and what was found are its pulses.
    Pulsed {
        /// In hertz.
        hertz: f64,
    },
    /// The recorder was coupled by a capacitor, which is undone.
    Coupled {
        /// Its time constant, in seconds.
        seconds: f64,
    },
    /// The signal goes to both sides of the dark.
    Undershoot {
        /// How far to the other side, as a share of the light.
        share: f64,
    },
    /// The trace ends before the light does.
    CutTail {
        /// What is left at the end, as a share of the light.
        left: f64,
    },
    /// The lamp's light goes up and down, which is taken out.
    Flicker {
        /// In hertz.
        hertz: f64,
        /// As a share of the light.
        amplitude: f64,
    },
    /// Light lowers the signal, by all appearance.
    Inverted,
    /// The brightest samples are all the same.
    Clipped {
        /// The share of the pulse's samples.
        share: f64,
        /// The value at which they stop.
        at: f64,
    },
    /// A sine in the signal.
    Hum {
        /// In hertz.
        hertz: f64,
        /// As a share of the light.
        amplitude: f64,
    },
    /// A sine of so few periods in the record that a drift or the shutter itself may pass for it.
    ShortHum {
        /// In hertz: the mains'.
        hertz: f64,
        /// As a share of the light.
        amplitude: f64,
        /// So many.
        periods: f64,
        /// Was the mains' frequency given?
        is_known: bool,
    },
    /// The dark level drifts.
    Drift {
        /// Over the frame, as a share of the light.
        amount: f64,
    },
    /// The ramps are lost in the noise.
    NoiseHidesRamps {
        /// As a share of the light.
        noise: f64,
    },
    /// Edges that are no longer than a sample.
    SharpEdges {
        /// The sampling interval, in seconds.
        step: f64,
    },
    /// There is no plateau: full light may never be reached.
    NoPlateau,
    /// A large standard error.
    WideError {
        /// The largest, as a share of the exposure.
        share: f64,
    },
    /// Samples are missing in the pulse or beside it.
    Gap {
        /// So many.
        count: usize,
        /// From when the longest gap lasts, in seconds.
        from: f64,
        /// Until when.
        to: f64,
    },
    /// So few samples, or so much noise, that the test of the fit is blind for much.
    Unseen {
        /// For so much of the light, over a fifth of the pulse.
        share: f64,
    },
    /// A drift that may as well be a capacitor's step.
    DriftOrCapacitor {
        /// As a share of the light.
        amount: f64,
    },
    /// No model passes the samples as closely as their noise allows.
    Misfit {
        /// The greatest structure that is left, as a share of the light.
        share: f64,
        /// So many seconds after the opening.
        after: f64,
        /// Are exposure and triggers the trace's own?
        by_trace: bool,
    },
    /// There is too little dark to tell whether the model explains the trace.
    Untested,
    /// The times are too far from 0 for the scene's numbers.
    ZeroMoved,
}

impl Warning {
    /// A name that a program can ask for: it stays as it is.
    pub const fn code(&self) -> &'static str {
        match self {
            Self::BrokenRows { .. } => "broken_rows",
            Self::Unsorted { .. } => "unsorted",
            Self::Duplicates { .. } => "duplicates",
            Self::UnitAssumed => "unit_assumed",
            Self::SecondSignal { .. } => "second_signal",
            Self::Overload { .. } => "overload",
            Self::SoundCard => "sound_card",
            Self::CutOff { .. } => "cut_off",
            Self::Spikes { .. } => "spikes",
            Self::Glitches { .. } => "glitches",
            Self::PartialFrame { .. } => "partial_frame",
            Self::ShotsDiffer { .. } => "shots_differ",
            Self::Pulsed { .. } => "pulsed",
            Self::Coupled { .. } => "ac_coupled",
            Self::Undershoot { .. } => "undershoot",
            Self::CutTail { .. } => "cut_tail",
            Self::Flicker { .. } => "flicker",
            Self::Inverted => "inverted",
            Self::Clipped { .. } => "clipped",
            Self::Hum { .. } => "hum",
            Self::ShortHum { .. } => "short_hum",
            Self::Drift { .. } => "drift",
            Self::NoiseHidesRamps { .. } => "noise",
            Self::SharpEdges { .. } => "sharp_edges",
            Self::NoPlateau => "no_plateau",
            Self::WideError { .. } => "wide_error",
            Self::Gap { .. } => "gap",
            Self::Unseen { .. } => "unseen",
            Self::DriftOrCapacitor { .. } => "drift_or_capacitor",
            Self::Misfit { .. } => "misfit",
            Self::Untested => "untested",
            Self::ZeroMoved => "zero_moved",
            Self::Sync(doubt) => doubt.code(),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BrokenRows { count: 1, line, reason } => {
                write!(out, "line {line}: {reason}; the row is left out")
            }
            Self::BrokenRows { count, line, reason } => {
                write!(out, "line {line}: {reason}; {count} such rows are left out")
            }
            Self::Unsorted { line } => {
                write!(out, "line {line}: time runs back; the samples are put in order")
            }
            Self::Duplicates { count, line } => write!(
                out,
                "line {line}: the same time again; {} averaged with the other of their time",
                if *count == 1 { "1 sample is".into() } else { format!("{count} samples are") }
            ),
            Self::UnitAssumed => out.write_str(
                "the file does not say in which unit its times are; they are taken as seconds (see --unit)",
            ),
            Self::SecondSignal { taken, other, option } => write!(
                out,
                "two columns hold a pulse: {taken} is taken for the light, and {other} is not ({option} takes that)"
            ),
            Self::Overload { count, line } => write!(
                out,
                "line {line}: the value is infinite; {} of the instrument {} taken as clipped, so the exposure may come out \
                 wrong; choose a larger range",
                counted(*count, "overload"),
                if *count == 1 { "is" } else { "are" }
            ),
            Self::Sync(doubt) => doubt.fmt(out),
            Self::SoundCard => out.write_str(
                "a sound card passes no steady light: it is coupled by a capacitor, and may change its gain by itself; take a \
                 recorder that is coupled for DC, where the exposure matters",
            ),
            Self::CutOff { samples, announced } => write!(
                out,
                "the file is cut off: it announces {} and holds {samples}; what was recorded after these is missing, so copy or \
                 save it again",
                counted(*announced, "sample")
            ),
            Self::Spikes { count, first } => {
                let first = unit::short(*first, 9);
                write!(out, "{} left out, the first at {first} s", counted(*count, "spike"))
            }
            Self::Glitches { count } => write!(
                out,
                "{} left out: with less than a fifth of the light of the largest pulse",
                counted(*count, "small pulse")
            ),
            Self::PartialFrame { number } => {
                write!(
                    out,
                    "pulse {number} of the trace has too little dark beside it, and is left out: --frame counts those that are \
                     whole"
                )
            }
            Self::ShotsDiffer { scatter } => write!(
                out,
                "the exposures of the shots scatter by {} %, so they are not of one setting; only one of them was fitted \
                 (--frame chooses which)",
                unit::short(100.0 * scatter, 2)
            ),
            Self::Pulsed { hertz } => write!(
                out,
                "pulses follow each other at {} Hz: that is a lamp which is switched on and off (PWM), and the exposure is one \
                 of its pulses', not the shutter's; use a steady lamp",
                unit::short(*hertz, 3)
            ),
            Self::Coupled { seconds } => write!(
                out,
                "the recorder is coupled by a capacitor (AC), with a time constant of {}; that is undone; couple it for DC",
                time(*seconds)
            ),
            Self::Undershoot { share } => write!(
                out,
                "the signal goes {} % of the light to the other side of the dark, which light does not do: a recorder that is \
                 coupled by a capacitor (AC, a sound card) does, and no result of such a trace is right; couple it for DC",
                unit::short(100.0 * share, 2)
            ),
            Self::CutTail { left } => write!(
                out,
                "the signal still falls where the trace ends, {} % of the light above the dark before: the tail is cut off, \
                 so the exposure comes out too short; record a longer window",
                unit::short(100.0 * left, 2)
            ),
            Self::Flicker { hertz, amplitude } => write!(
                out,
                "the lamp flickers at {} Hz by {} % of its light, which is fitted and taken out; a steady lamp is better",
                unit::short(*hertz, 4),
                unit::short(100.0 * amplitude, 2)
            ),
            Self::Inverted => out.write_str(
                "light seems to lower the signal, so it is turned round; if it does not, the trace begins and ends in \
                 the light (--light up)",
            ),
            Self::Clipped { share, at } => write!(
                out,
                "clipped: {:.0} % of the pulse's samples stop at {}; full light is above that, so the exposure comes out too \
                 long, by some percent; lower the gain",
                100.0 * share,
                unit::short(*at, 4)
            ),
            Self::Hum { hertz, amplitude } => write!(
                out,
                "hum of {} Hz, {:.2} % of the light, fitted and taken out; if it is the lamp's own flicker (mains, or an \
                 LED's PWM), use a steady one",
                unit::short(*hertz, 4),
                100.0 * amplitude
            ),
            Self::ShortHum { hertz, amplitude, periods, is_known } => write!(
                out,
                "hum of {:.2} % of the light, taken out at {}, of which the record holds {periods:.1} periods: a drift or the \
                 shutter's own shape may pass for it; record three periods (60 ms), or run it all on batteries",
                100.0 * amplitude,
                if *is_known {
                    format!("{} Hz", unit::short(*hertz, 4))
                } else {
                    format!("{} Hz (--mains 50 or 60 says which)", unit::short(*hertz, 2))
                },
            ),
            Self::Drift { amount } => write!(
                out,
                "the dark level drifts by {:.2} % of the light, fitted and taken out",
                100.0 * amount
            ),
            Self::NoiseHidesRamps { noise } => write!(
                out,
                "noise of {:.1} % of the light hides the ramps' shape; average several shots, or use more light",
                100.0 * noise
            ),
            Self::SharpEdges { step } => write!(
                out,
                "edges as short as a sample: each is known to {} at best (the sampling interval by the root of 12); \
                 sample faster if that matters",
                time(step / 12f64.sqrt())
            ),
            Self::NoPlateau => out.write_str(
                "there is no plateau to speak of: the shutter may never open fully; the peak counts as full light unless \
                 --full gives the signal of full light",
            ),
            Self::WideError { share } => write!(
                out,
                "the exposure or a trigger is known to ± {} % of the exposure only (a standard error): take more samples, or \
                 more light",
                unit::short(100.0 * share, 2)
            ),
            Self::Gap { count, from, to } => write!(
                out,
                "samples are missing at {} in the pulse or beside it, the longest gap from {} to {}: what the shutter did there \
                 is not known; record it again",
                counted(*count, "place"),
                time(*from),
                time(*to)
            ),
            Self::Unseen { share } => write!(
                out,
                "too few samples, or too much noise, to see a bounce, a dip or a tail of less than {} % of the light for a \
                 fifth of the pulse; that is in the errors; sample faster, or average several shots",
                unit::short(100.0 * share, 2)
            ),
            Self::DriftOrCapacitor { amount } => write!(
                out,
                "the dark is {:.2} % of the light {} after the pulse than before: a drift, as which it is taken out, or a \
                 capacitor before the recorder (AC), which would move the triggers; couple it for DC, or record more dark",
                100.0 * amount.abs(),
                if *amount < 0.0 { "lower" } else { "higher" }
            ),
            Self::Misfit { share, after, by_trace } => write!(
                out,
                "the trace has structure that the model has not: {} % of the light, {}; exposure and triggers are {}; look \
                 at --picture",
                unit::short(100.0 * share.abs(), 2),
                from_opening(*after),
                if *by_trace {
                    "the trace's own, and no curve stands for them"
                } else {
                    "the model's, and off by more than their errors say"
                }
            ),
            Self::Untested => out.write_str(
                "there is too little dark beside the pulse to tell whether the model explains the trace; record more of it",
            ),
            Self::ZeroMoved => out.write_str(
                "the trace's times are too far from 0 for the scene's numbers; time 0 is where the shutter starts to \
                 open, as with --zero open",
            ),
        }
    }
}

impl From<Doubt> for Warning {
    fn from(doubt: Doubt) -> Self {
        Self::Sync(doubt)
    }
}

/// A time that counts from the start of opening.
pub fn from_opening(seconds: f64) -> String {
    let way = if seconds < 0.0 { "before" } else { "after" };
    format!("{} {way} opening", time(seconds.abs()))
}

/// A time in the unit that suits it, to two digits.
fn time(seconds: f64) -> String {
    let unit = unit::Unit::fit(seconds);
    format!("{} {}", unit::short(unit.of(seconds), 2), unit.name())
}

fn counted(n: usize, thing: &str) -> String {
    unit::count(n as u64, thing)
}
