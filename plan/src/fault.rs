//! What is wrong with a scene, and where: one table of messages, each with its code and, below, what would help.

use std::fmt;

use serde::Serialize;
use shutter_curve::{CurveError, ScheduleError};
use shutter_fit::MOST_TRIGGERS;
use shutter_fit::unit::{Unit, count, short};
use thiserror::Error;
use toml::de::{DeTable, DeValue};

/// The digits of an inner control number: all that `f32` keeps.
const DIGITS: i32 = 9;

/// A key of a scene with its table, as `flashes.pulse`.
pub type Key = &'static str;

/// What is wrong with a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The key whose value it is about; empty where it is about none.
    pub key: Key,
    /// The byte of the text, where it is no value's.
    pub at: Option<usize>,
    /// What is wrong.
    pub what: Box<What>,
    /// What may help, a line each.
    pub notes: Vec<String>,
    /// From where to where among the eight numbers of `shutteropening` it is.
    pub inner: Option<(usize, usize)>,
}

impl Fault {
    pub(crate) fn new(key: Key, what: impl Into<What>) -> Self {
        Self { key, at: None, what: Box::new(what.into()), notes: Vec::new(), inner: None }
    }

    /// What is wrong, in words.
    pub fn reason(&self) -> String {
        match self.name() {
            "" => self.what.to_string(),
            name => format!("{name}: {}", self.what),
        }
    }

    /// The key without its table.
    pub fn name(&self) -> &str {
        self.key.rsplit('.').next().unwrap_or_default()
    }

    /// `file:line: reason`, the line itself below it, and the notes.
    pub fn locate(&self, file: &str, text: &str) -> String {
        let reason = self.reason();
        let mut told = match self.at.or_else(|| place(text, self.key)).and_then(|at| text.get(..at)) {
            Some(before) => {
                let line = before.matches('\n').count();
                let (number, line) = (line + 1, text.lines().nth(line).unwrap_or_default());
                format!("{file}:{number}: {reason}\n  {number} | {line}")
            }
            None => format!("{file}: {reason}"),
        };
        for note in &self.notes {
            told += &format!("\n  {note}");
        }
        told
    }
}

/// Where a text has the value of a key.
fn place(text: &str, key: &str) -> Option<usize> {
    let mut table = DeTable::parse(text).ok()?.into_inner();
    let (path, last) = key.rsplit_once('.').unwrap_or(("", key));
    for part in path.split('.').filter(|part| !part.is_empty()) {
        let (_, value) = table.into_iter().find(|(key, _)| key.get_ref() == part)?;
        let DeValue::Table(inner) = value.into_inner() else { return None };
        table = inner;
    }
    Some(table.get(last)?.span().start)
}

/// So many ticks, told in this unit, and as ticks where the timer's rate is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ticks {
    pub(crate) count: i64,
    pub(crate) hz: u32,
    pub(crate) is_given: bool,
    pub(crate) unit: Unit,
}

impl fmt::Display for Ticks {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let time = self.unit.show(self.count.unsigned_abs() as f64 / f64::from(self.hz));
        match self.is_given {
            true => write!(out, "{time} ({})", count(self.count.unsigned_abs(), "tick")),
            false => out.write_str(&time),
        }
    }
}

/// Two neighbours that come too close.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
        let Self { first, gap, least } = self;
        let gap = if gap.count < 0 { format!("overlap by {gap}") } else { format!("come {gap} apart") };
        format!("{things} {first} and {} {gap}, and {least} is required", first + 1)
    }
}

/// What is wrong.
#[derive(Clone, Debug, Error, PartialEq)]
#[expect(missing_docs, reason = "a message tells what its values are")]
pub enum What {
    /// What only a text can have wrong.
    #[error("{0}")]
    Text(String),
    #[error("it is required")]
    Missing,
    #[error("{0}")]
    Curve(#[from] CurveError),
    #[error("{error}; it lasts {}", .unit.show(*.seconds))]
    Lasts { error: CurveError, seconds: f64, unit: Unit },
    #[error("{error}; it is {}", short(*.number, DIGITS))]
    Inner { error: CurveError, number: f64 },
    #[error("it is beyond f32 (3.4e38 s)")]
    Beyond,
    #[error(
        "f32 is off by {} % of the interval here; count the times from nearer to `open_start`",
        short(*.percent, 2)
    )]
    Lost { percent: f64 },
    #[error("a finite number is required")]
    Finite,
    #[error("more than 0 is required")]
    Positive,
    #[error("0 or more is required")]
    NotNegative,
    #[error("a whole number from 1 to {most} is required")]
    Whole { most: u32 },
    #[error("8 numbers are required, not {0}")]
    NotEight(usize),
    #[error("a rate from 1 to 4294967295 is required")]
    Rate,
    #[error("the interval is longer than 2^31 ticks; up to {most} Hz it is not")]
    RateTooHigh { most: u32 },
    #[error("{0}")]
    Schedule(ScheduleError),
    #[error("16 or 32 is required")]
    Bits,
    #[error(
        "the frame ends at tick {ticks}, and with {bits} bits it may end at {most} at the latest; a prescaler of {by} \
         fits: `timer_hz` = {}",
        short(*.hz, 10)
    )]
    Wraps { ticks: f64, bits: u32, most: f64, by: f64, hz: f64 },
    #[error("it is for flashes whose length is the lamp's own, and this scene makes pulses")]
    FullyOpenPulses,
    #[error("this shutter begins to close as soon as it is open")]
    FullyOpenNever,
    #[error("{EMULATED}flashes come at the triggers")]
    FullyOpenEmulated,
    #[error("{EMULATED}`pulse` makes equal pulses")]
    DutyEmulated,
    #[error(
        "a scene has `duty` or `pulse` (pulse where the curve is emulated, duty where the shutter is in the light's \
         path)"
    )]
    DutyAndPulse,
    #[error("above 0 and at most 1 is required")]
    Part,
    #[error("it is less than half a tick of {hz} Hz")]
    PulseOfNoTick { hz: u32 },
    #[error("it goes with `duty`, which makes pulses of many lengths")]
    MinPulse,
    #[error("0 or more is required, and a delay")]
    Spread,
    #[error("it goes with a delay")]
    Falls,
    #[error("frame and gap, or a sync that bounces, last {ticks} ticks, and the timer's count has {most}")]
    HoldOff { ticks: u64, most: u64 },
    #[error("the frame ends more than 2^31 ticks after the edge; with up to {most} ticks of delay it does not")]
    DelayTooLong { most: f64 },
    /// So many triggers come before the edge, or before where ticks count; what keeps all behind it.
    #[error(
        "{} {} before {}{}",
        if *.few == 1 { "trigger 0 comes".into() } else { format!("triggers 0 to {} come, the first", .few - 1) },
        .unit.show(*.by),
        if *.by_edge { "the edge of the sync" } else { "the start of opening, from where ticks count without a delay" },
        ways(.most, .fully_open, .by_edge, .lag.map(|lag| unit.show(lag)), .is_emulated)
    )]
    BeforeEdge {
        few: usize,
        by: f64,
        by_edge: bool,
        most: Option<u32>,
        fully_open: bool,
        lag: Option<f64>,
        is_emulated: bool,
        unit: Unit,
    },
    #[error("{}; {}", .pair.told("triggers"), keep(.most))]
    Close { pair: Pair, most: Option<u32> },
    #[error("{}; {}; a smaller `duty` leaves more", .pair.told("pulses"), keep(.most))]
    DosesClose { pair: Pair, most: Option<u32> },
    #[error("pulse {i} lasts {lasts}, and {least} is required; {}; a greater `duty` lasts longer", keep(.most))]
    DoseShort { i: usize, lasts: Ticks, least: Ticks, most: Option<u32> },
    #[error("pulses of {length}: {}; {}{}", reach(.pair), fitting(.longest), or_keep(.most))]
    Pulses { length: Ticks, pair: Option<Pair>, longest: Ticks, most: Option<u32> },
    #[error("the frame does not fit; {}", keep(.most))]
    Unfit { most: Option<u32> },
    #[error(
        "what a shutter in the light's path leaves of a flash comes from its curve, and this scene has none; \
         `shutter fit --model free` writes one"
    )]
    TimesInPath,
    #[error("it goes with a curve, and this scene has `trigger_times`, as they were measured")]
    OfCurve,
    #[error("{asked} are asked for, and `trigger_times` has {has}: a fit with --triggers {asked} writes as many")]
    TimesOther { asked: f64, has: usize },
    #[error("1 to {MOST_TRIGGERS} can be planned, not {0}")]
    TimesCount(usize),
    #[error("trigger {i} comes before `open_start`, from where ticks count")]
    TimesEarly { i: usize },
    #[error(
        "trigger {i} comes more than 2^31 ticks after `open_start`; count from nearer to it, or take a slower timer"
    )]
    TimesLate { i: usize },
    #[error("trigger {} comes before trigger {i}", i + 1)]
    TimesOutOfOrder { i: usize },
    #[error("{}", .0.told("triggers"))]
    TimesClose(Pair),
}

const EMULATED: &str = "it is for a shutter in the light's path, and `set_up` is \"emulated\"; there, ";

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

/// How to go on where triggers come before the edge.
fn ways(most: &Option<u32>, fully_open: &bool, by_edge: &bool, lag: Option<String>, is_emulated: &bool) -> String {
    let ways = [
        most.map(|most| match most {
            1 => "a single trigger comes behind it".into(),
            most => format!("all of up to {most} triggers come behind it"),
        }),
        fully_open.then(|| "`fully_open` = true fires behind it, while the shutter is fully open".into()),
        lag.map(|lag| format!("a lag of {lag} is the most")),
        is_emulated.then(|| "an emulated curve may begin with the edge: the flashes' own `delay` = 0".into()),
        (*by_edge && !is_emulated).then(|| "an earlier contact gives more time".into()),
    ];
    ways.into_iter().flatten().map(|way: String| format!("; {way}")).collect()
}
