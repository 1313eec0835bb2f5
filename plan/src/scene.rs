//! A scene: a shutter, which a fit writes as a whole, and the flashes, which are their user's.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::{Deserialize, Serialize};
use shutter_fit::unit::Unit;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::fault::{Fault, Key, What};
use crate::lamp::SetUp;

/// What stands in a scene, in TOML or JSON.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// How the shutter opens and closes.
    pub shutter: Shutter,
    /// What is to be fired.
    #[serde(default)]
    pub flashes: Flashes,
    /// Has anyone changed the shutter since a fit wrote it?
    #[serde(skip)]
    pub is_edited: bool,
}

/// A shutter's curve, or its trigger times as they were measured; times are in its unit.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
#[expect(missing_docs, reason = "docs/scene.md tells what the keys are")]
pub struct Shutter {
    pub unit: Option<Unit>,
    pub open_start: Option<f64>,
    pub open_end: Option<f64>,
    pub close_start: Option<f64>,
    pub close_end: Option<f64>,
    pub shutteropening: Option<Vec<f64>>,
    pub trigger_times: Option<Vec<f64>>,
    pub delay: Option<f64>,
    pub delay_spread: Option<f64>,
    pub sync_falls: Option<bool>,
    pub sync_settles: Option<f64>,
    pub nominal: Option<f64>,
    pub measured: Option<Measured>,
}

/// What a fit found, with standard errors; times are in its own unit.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/scene.md tells what the keys are")]
pub struct Measured {
    pub trace: String,
    pub read: Option<String>,
    pub model: String,
    pub unit: Unit,
    pub exposure: f64,
    pub exposure_error: f64,
    /// The curve's peak, as a share of full light.
    pub peak: Option<f64>,
    pub efficiency: String,
    pub sync: Option<String>,
    pub delay_error: Option<f64>,
    /// That of the time from the edge to any trigger.
    pub trigger_error: Option<f64>,
    pub delay_worst: Option<f64>,
    pub shots: Option<usize>,
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Of the table in a text.
    pub checksum: Option<String>,
}

/// What is to be fired; times are in its unit, or in the shutter's.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
#[expect(missing_docs, reason = "docs/scene.md tells what the keys are")]
pub struct Flashes {
    pub unit: Option<Unit>,
    pub triggers: Option<f64>,
    pub min_gap: Option<f64>,
    pub timer_hz: Option<f64>,
    pub timer_bits: Option<f64>,
    pub set_up: Option<SetUp>,
    pub pulse: Option<f64>,
    pub duty: Option<f64>,
    pub min_pulse: Option<f64>,
    pub fully_open: Option<bool>,
    pub lamp_lag: Option<f64>,
    pub delay: Option<f64>,
    pub delay_spread: Option<f64>,
    pub sync_falls: Option<bool>,
}

impl Scene {
    /// The scene that `text` describes.
    ///
    /// # Errors
    /// What is no TOML, and keys that are unknown or have the wrong type.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let mut scene: Self = toml::from_str(text).map_err(|error| told(text, &error))?;
        scene.is_edited = scene.shutter.measured.is_some() && !Written::find(text).is_some_and(|it| it.is_intact);
        Ok(scene)
    }

    /// The unit of the flashes' times.
    pub fn unit(&self) -> Unit {
        self.flashes.unit.or(self.shutter.unit).unwrap_or(Unit::Second)
    }

    /// What hardware needs and only a user can tell: the options that tell it, and whether each is lacking.
    pub fn lacks(&self) -> [(&'static str, bool); 4] {
        let Self { shutter, flashes, .. } = self;
        let has_own = flashes.delay.is_some();
        let is_told = flashes.sync_falls.is_some() || !has_own && shutter.sync_falls.is_some();
        [
            ("--set-up emulated|in_path", flashes.set_up.is_none()),
            ("--timer-hz HERTZ", flashes.timer_hz.is_none()),
            ("--min-gap TIME", flashes.min_gap.is_none()),
            ("--sync-falls true|false", (has_own || shutter.delay.is_some()) && !is_told),
        ]
    }

    /// The same with its times in seconds.
    ///
    /// # Errors
    /// Times that are not finite, or out of their ranges.
    pub(crate) fn in_seconds(&self) -> Result<Self, Fault> {
        type Range = fn(f64) -> Option<What>;
        let mut scene = self.clone();
        let Self { shutter, flashes, .. } = &mut scene;
        let [ours, theirs] = [self.shutter.unit(), self.unit()];
        let any = |_| None;
        let positive = |x| (x <= 0.0).then_some(What::Positive);
        let not_negative = |x| (x < 0.0).then_some(What::NotNegative);
        let spread = |x| (x < 0.0).then_some(What::Spread);
        let times: [(Key, Unit, &mut Option<f64>, Range); 14] = [
            ("shutter.open_start", ours, &mut shutter.open_start, any),
            ("shutter.open_end", ours, &mut shutter.open_end, any),
            ("shutter.close_start", ours, &mut shutter.close_start, any),
            ("shutter.close_end", ours, &mut shutter.close_end, any),
            ("shutter.delay", ours, &mut shutter.delay, any),
            ("shutter.delay_spread", ours, &mut shutter.delay_spread, spread),
            ("shutter.sync_settles", ours, &mut shutter.sync_settles, not_negative),
            ("shutter.nominal", ours, &mut shutter.nominal, positive),
            ("flashes.min_gap", theirs, &mut flashes.min_gap, not_negative),
            ("flashes.pulse", theirs, &mut flashes.pulse, positive),
            ("flashes.min_pulse", theirs, &mut flashes.min_pulse, positive),
            ("flashes.lamp_lag", theirs, &mut flashes.lamp_lag, not_negative),
            ("flashes.delay", theirs, &mut flashes.delay, any),
            ("flashes.delay_spread", theirs, &mut flashes.delay_spread, spread),
        ];
        let several =
            shutter.trigger_times.iter_mut().flatten().map(|it| ("shutter.trigger_times", ours, it, any as _));
        let single = times.into_iter().filter_map(|(key, unit, time, wrong)| Some((key, unit, time.as_mut()?, wrong)));
        for (key, unit, time, wrong) in single.chain(several) {
            *time = unit.seconds(*time) + 0.0;
            if let Some(what) = if time.is_finite() { wrong(*time) } else { Some(What::Finite) } {
                return Err(Fault::new(key, what));
            }
        }
        (shutter.unit, flashes.unit) = (None, None);
        Ok(scene)
    }
}

impl Shutter {
    /// The unit of its times.
    pub fn unit(&self) -> Unit {
        self.unit.unwrap_or(Unit::Second)
    }

    /// Its curve's peak, as a share of full light.
    ///
    /// # Errors
    /// One that is no share.
    pub fn peak(&self) -> Result<f64, Fault> {
        let peak = self.measured.as_ref().and_then(|it| it.peak).unwrap_or(1.0);
        let is_share = peak > 0.0 && peak <= 1.0;
        is_share.then_some(peak).ok_or_else(|| Fault::new("shutter.measured.peak", What::Part))
    }

    /// As a table of a scene's text, with its checksum where it was measured: its own, or the one that it has.
    pub fn text(&self) -> String {
        let text = toml::to_string(&BTreeMap::from([("shutter", self)])).expect("numbers and texts are TOML");
        let lacks_sum = self.measured.as_ref().is_some_and(|it| it.checksum.is_none());
        if lacks_sum { format!("{text}{CHECKSUM}\"{}\"\n", checksum(&text)) } else { text }
    }
}

const CHECKSUM: &str = "checksum = ";

/// The hash of the lines, whatever ends them, but for that of the checksum itself.
fn checksum(lines: &str) -> String {
    let lines = lines.lines().filter(|line| !line.starts_with(CHECKSUM));
    let bytes = lines.flat_map(|line| line.bytes().chain([b'\n']));
    format!("{:08x}", fnv(bytes))
}

/// Fowler, Noll and Vo's hash (FNV-1a).
pub fn fnv(bytes: impl Iterator<Item = u8>) -> u32 {
    bytes.fold(0x811C_9DC5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

/// Where a text has its shutter.
pub struct Written {
    /// All of its lines.
    pub at: Range<usize>,
    /// Is it as a fit wrote it?
    pub is_intact: bool,
}

impl Written {
    /// The shutter of a text, if that is a table of its own lines.
    pub fn find(text: &str) -> Option<Self> {
        let table = DeTable::parse(text).ok()?.into_inner();
        let (key, shutter) = table.get_key_value("shutter")?;
        let start = text[..key.span().start].rfind('\n').map_or(0, |end| end + 1);
        let last = end(shutter)?;
        let at = start..text[last..].find('\n').map_or(text.len(), |more| last + more + 1);
        let lines = &text[at.clone()];
        // A header between its lines is another's, and those are no table of its own.
        let headers = lines.lines().filter(|line| line.trim_start().starts_with('['));
        let is_own = |line: &str| line.starts_with("[shutter]") || line.starts_with("[shutter.measured]");
        if !lines.starts_with("[shutter]") || !headers.clone().all(is_own) {
            return None;
        }
        let sum = shutter.get_ref().get("measured").and_then(|it| it.get_ref().get("checksum")?.get_ref().as_str());
        let is_intact = sum.is_some_and(|sum| sum == checksum(lines));
        Some(Self { at, is_intact })
    }
}

/// Where the last value of a table ends.
fn end(value: &Spanned<DeValue>) -> Option<usize> {
    match value.get_ref() {
        DeValue::Table(table) => table.values().filter_map(end).max(),
        _ => Some(value.span().end),
    }
}

/// What is wrong with a text, in words for those who do not know what a float is.
fn told(text: &str, error: &toml::de::Error) -> Fault {
    let mut reason = error.message().to_string();
    // What is missing is on no line; its span is the whole table.
    let at = error.span().filter(|_| !reason.starts_with("missing field")).map(|span| span.start);
    if reason.contains("field `") && !reason.contains("trace") {
        let is_root = reason.contains("`shutter`");
        reason += if is_root { ": a scene has the tables [shutter] and [flashes]" } else { "" };
    }
    if let Some(name) = at.and_then(|at| key_at(DeTable::parse(text).ok()?.get_ref(), at)) {
        reason = match name.as_str() {
            "unit" => "unit: \"s\", \"ms\", \"us\" or \"ns\" is required".into(),
            "set_up" => "set_up: \"emulated\" or \"in_path\" is required".into(),
            "sync_falls" | "fully_open" => format!("{name}: true or false is required"),
            "shutteropening" | "trigger_times" => format!("{name}: numbers in brackets are required"),
            _ if reason.contains("expected f64") => format!("{name}: a number is required"),
            _ => format!("{name}: {reason}"),
        };
    }
    Fault { at, ..Fault::new("", What::Text(reason)) }
}

/// The key whose value is there.
fn key_at(table: &DeTable, at: usize) -> Option<String> {
    table.iter().find_map(|(key, value)| match value.get_ref() {
        DeValue::Table(inner) => key_at(inner, at),
        _ => value.span().contains(&at).then(|| key.get_ref().to_string()),
    })
}
