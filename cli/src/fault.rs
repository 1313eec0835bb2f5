//! What is wrong with a scene, and where.

use std::fmt;

use shutter_curve::{CurveError, ScheduleError};
use shutter_fit::MOST_TRIGGERS;
use shutter_fit::unit::{Unit, count, short};
use thiserror::Error;
use toml::Spanned;

/// The digits of an inner control number: all that `f32` keeps.
pub(crate) const DIGITS: i32 = 9;

/// What is wrong with a scene, and at which byte of its text, where that is known.
#[derive(Debug)]
pub struct Fault {
    /// The byte of the text.
    pub at: Option<usize>,
    /// What is wrong.
    pub what: Box<What>,
    /// What may help, a line each.
    pub notes: Vec<String>,
    /// From where to where among the eight numbers of `shutteropening` it is.
    pub inner: Option<(usize, usize)>,
}

impl Fault {
    pub(crate) fn at<T>(value: &Spanned<T>, what: impl Into<What>) -> Self {
        Self::of(Some(value.span().start), what)
    }

    pub(crate) fn of(at: Option<usize>, what: impl Into<What>) -> Self {
        Self { at, what: Box::new(what.into()), notes: Vec::new(), inner: None }
    }

    /// What is wrong, in words.
    pub fn reason(&self) -> String {
        self.what.to_string()
    }

    /// The number of its line, from 1, and the line.
    pub fn line<'a>(&self, text: &'a str) -> Option<(usize, &'a str)> {
        let line = text.get(..self.at?)?.matches('\n').count();
        Some((line + 1, text.lines().nth(line).unwrap_or_default()))
    }

    /// `file:line: reason`, the line itself below it, and the notes.
    pub fn locate(&self, file: &str, text: &str) -> String {
        let reason = &self.what;
        let mut told = match self.line(text) {
            Some((number, line)) => format!("{file}:{number}: {reason}\n  {number} | {line}"),
            None => format!("{file}: {reason}"),
        };
        for note in &self.notes {
            told += &format!("\n  {note}");
        }
        told
    }
}

/// So many ticks, told as a time where nobody has given the timer's rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ticks {
    pub(crate) count: i64,
    pub(crate) hz: u32,
    pub(crate) is_given: bool,
    pub(crate) unit: Unit,
}

impl Ticks {
    /// How long they last.
    pub fn seconds(self) -> f64 {
        self.count as f64 / f64::from(self.hz)
    }

    /// The same, as what is required.
    fn required(self) -> String {
        match (self.is_given, self.count) {
            (false, _) => format!("{self} is required"),
            (true, 1) => "1 is required".into(),
            (true, ticks) => format!("{ticks} are required"),
        }
    }

    /// How far the thing `i` and the next one are apart.
    fn apart(self, things: &str, i: usize) -> String {
        let next = i + 1;
        match self.count {
            ..0 => format!("{things} {i} and {next} overlap by {self}"),
            _ => format!("{things} {i} and {next} come {self} apart"),
        }
    }
}

impl fmt::Display for Ticks {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&match self.is_given {
            true => count(self.count.unsigned_abs(), "tick"),
            false => self.unit.show(self.seconds().abs()),
        })
    }
}

/// Two neighbours that come too close.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The first.
    pub first: usize,
    /// Between them.
    pub gap: Ticks,
    /// What is required.
    pub least: Ticks,
}

impl Pair {
    fn told(&self, things: &str) -> String {
        format!("{}, and {}", self.gap.apart(things, self.first), self.least.required())
    }
}

/// What is wrong. A page has words of its own, by the codes.
#[derive(Clone, Debug, Error, PartialEq)]
#[expect(missing_docs, reason = "a message tells what its values are")]
#[cfg_attr(
    feature = "codes",
    derive(strum::EnumDiscriminants),
    strum_discriminants(derive(strum::VariantNames), name(Code), allow(missing_docs)),
    strum_discriminants(doc = "What is wrong, without the values.", strum(serialize_all = "snake_case"))
)]
pub enum What {
    /// What only a text can have wrong.
    #[error("{0}")]
    Text(String),
    #[error("{0}")]
    Curve(#[from] CurveError),
    #[error("{error}; it lasts {}", .unit.show(*.seconds))]
    Lasts { error: CurveError, seconds: f64, unit: Unit },
    #[error("{error}; it is {}", short(*.number, DIGITS))]
    Inner { error: CurveError, number: f64 },
    #[error("{key}: it is beyond f32 (3.4e38 s)")]
    Beyond { key: &'static str },
    #[error(
        "{key}: f32 is off by {} % of the interval here; count the times from nearer to open_start",
        short(*.percent, 2)
    )]
    Lost { key: &'static str, percent: f64 },
    #[error("{key}: a finite number is required")]
    Finite { key: &'static str },
    #[error("{key}: more than 0 is required")]
    Positive { key: &'static str },
    #[error("{key}: 0 or more is required")]
    NotNegative { key: &'static str },
    #[error("{key}: a whole number from 1 to {most} is required")]
    Whole { key: &'static str, most: u32 },
    #[error("shutteropening: 8 numbers are required, not {0}")]
    NotEight(usize),
    #[error("timer_hz: a rate from 1 to 4294967295 is required")]
    Rate,
    #[error("timer_hz: the interval is longer than 2^31 ticks; up to {most} Hz it is not")]
    RateTooHigh { most: u32 },
    #[error("timer_hz: {0}")]
    Schedule(ScheduleError),
    #[error("timer_bits: 16 or 32 is required")]
    Bits,
    #[error(
        "timer_bits: the frame ends at tick {ticks}, and with {bits} bits it may end at {most} at the latest; \
         a prescaler of {by} fits: timer_hz = {}",
        short(*.hz, 10)
    )]
    Wraps { ticks: f64, bits: u32, most: f64, by: f64, hz: f64 },
    #[error("fully_open: it is for flashes whose length is the lamp's own, and this scene makes pulses")]
    FullyOpenPulses,
    #[error("fully_open: this shutter begins to close as soon as it is open")]
    FullyOpenNever,
    #[error("fully_open: {EMULATED}flashes come at the triggers")]
    FullyOpenEmulated,
    #[error("duty: {EMULATED}`pulse` makes equal pulses")]
    DutyEmulated,
    #[error(
        "duty and pulse: a scene has one of them (pulse where the curve is emulated, duty where the shutter is in the \
         light's path)"
    )]
    DutyAndPulse,
    #[error("duty: above 0 and at most 1 is required")]
    Duty,
    #[error("pulse: it is less than half a tick of {hz} Hz")]
    PulseOfNoTick { hz: u32 },
    #[error("min_pulse: it goes with duty, which makes pulses of many lengths")]
    MinPulse,
    #[error("delay_spread: 0 or more is required, and a delay")]
    Spread,
    #[error("sync_falls: it goes with a delay")]
    Falls,
    #[error("delay: 0 or more is required; an edge cannot trigger what comes before it")]
    Delay,
    #[error("delay: the frame ends more than 2^31 ticks after the edge; with up to {most} ticks of delay it does not")]
    DelayTooLong { most: f64 },
    #[error(
        "lamp_lag: the first trigger would come {} before {}; a lag of {} is the most",
        .unit.show(*.by),
        if *.by_edge { "the edge of the sync" } else { "the start of opening, from where ticks count without a delay" },
        .unit.show(*.most)
    )]
    Lag { by: f64, most: f64, by_edge: bool, unit: Unit },
    #[error("{}; {}", .pair.told("triggers"), keep(.most))]
    Close { pair: Pair, most: Option<u32> },
    #[error("{}; {}; a smaller duty leaves more", .pair.told("pulses"), keep(.most))]
    DosesClose { pair: Pair, most: Option<u32> },
    #[error("pulse {i} lasts {lasts}, and {}; {}; a greater duty lasts longer", .least.required(), keep(.most))]
    DoseShort { i: usize, lasts: Ticks, least: Ticks, most: Option<u32> },
    #[error("pulses of {length}: {}; {}{}", reach(.pair), fitting(.longest), or_keep(.most))]
    Pulses { length: Ticks, pair: Option<Pair>, longest: Ticks, most: Option<u32> },
    #[error("the frame does not fit; {}", keep(.most))]
    Unfit { most: Option<u32> },
    #[error(
        "set_up: what a shutter in the light's path leaves of a flash comes from its curve, and this scene has none; \
         `shutter fit --model free` writes one"
    )]
    TimesInPath,
    #[error("trigger_times: 1 to {MOST_TRIGGERS} can be planned, not {0}")]
    TimesCount(usize),
    #[error("trigger_times: trigger {i} comes before open_start, from where ticks count")]
    TimesEarly { i: usize },
    #[error(
        "trigger_times: trigger {i} comes more than 2^31 ticks after open_start; count from nearer to it, or take a \
         slower timer"
    )]
    TimesLate { i: usize },
    #[error("trigger_times: trigger {} comes before trigger {i}", i + 1)]
    TimesOutOfOrder { i: usize },
    #[error("trigger_times: {}", .0.told("triggers"))]
    TimesClose(Pair),
}

const EMULATED: &str = "it is for a shutter in the light's path, and set_up is \"emulated\"; there, ";

/// What would help.
fn keep(most: &Option<u32>) -> String {
    match most {
        Some(1) => "1 trigger keeps that".into(),
        Some(most) => format!("{most} triggers keep that"),
        None => "no number of triggers keeps that".into(),
    }
}

fn or_keep(most: &Option<u32>) -> String {
    most.map_or(String::new(), |_| format!(", or {}", keep(most)))
}

fn reach(pair: &Option<Pair>) -> String {
    let beyond = || "they reach beyond the time that the shutter is open".into();
    pair.map_or_else(beyond, |pair| pair.told("pulses"))
}

fn fitting(longest: &Ticks) -> String {
    match longest.count {
        ..=0 => "none is short enough".into(),
        _ => format!("those of up to {longest} fit"),
    }
}
