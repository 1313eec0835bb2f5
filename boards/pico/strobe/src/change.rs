//! What a line asks for, and the settings that it leads to.

use crate::curves::CURVES;
use crate::duration::{Rounding, parse};
use crate::limits::MIN_PULSE;
use crate::refused::Refused;
use crate::settings::{Curve, Edge, Frames, Light, Numbers, Settings};

/// What a line asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// To be planned with.
    Change(Change),
    /// `?`: the version and all settings.
    Show,
    /// `save`: the settings are to outlive the power.
    Save,
}

/// What a line changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// `n 32`: the pulses of a frame.
    Pulses(u32),
    /// `gap 100us`: at least; in ticks.
    Gap(u32),
    /// `pulse 2us` or `duty 0.3`.
    Light(Light),
    /// `delay 4.247ms`: from the edge to the start of opening; in ticks.
    Delay(u32),
    /// `edge falling`.
    Edge(Edge),
    /// `frames 3 20ms`: for one edge.
    Frames(Frames),
    /// `curve 1`: one of the curves in flash, counted from 0 here.
    Stored(usize),
    /// `curve` and four numbers: its times in seconds; the ramps are straight.
    Linear([f32; 4]),
    /// `curve` and twelve numbers: the four times and the eight inner control points of `shutteropening`.
    Built([f32; 12]),
}

impl Request {
    /// Reads a line.
    ///
    /// # Errors
    /// What is wrong with it, as far as that can be said without the settings.
    pub fn read(line: &str) -> Result<Self, Refused> {
        let request = match line.split_ascii_whitespace().next() {
            Some("?") => Request::Show,
            Some("save") => Request::Save,
            _ => return Change::read(line).map(Request::Change),
        };
        match line.split_ascii_whitespace().nth(1) {
            None => Ok(request),
            Some(_) => Err(Refused::Alone),
        }
    }
}

impl Change {
    /// Reads a line that is to change something.
    ///
    /// # Errors
    /// As for [`Request::read`].
    pub fn read(line: &str) -> Result<Self, Refused> {
        let mut words = line.split_ascii_whitespace();
        let name = words.next();
        match name {
            Some("n") => match only(words).and_then(|n| n.parse().ok()) {
                Some(0) | None => Err(Refused::Pulses),
                Some(n) => Ok(Change::Pulses(n)),
            },
            Some("gap") => ticks(words, Rounding::Up).map(Change::Gap),
            Some("pulse") => match ticks(words, Rounding::Up)? {
                ..MIN_PULSE => Err(Refused::TooShort),
                length => Ok(Change::Light(Light::Equal(length))),
            },
            Some("duty") => match only(words).and_then(|duty| duty.parse().ok()) {
                Some(duty) if duty > 0.0 && duty <= 1.0 => Ok(Change::Light(Light::Doses(duty))),
                _ => Err(Refused::Duty),
            },
            Some("delay") => ticks(words, Rounding::Nearest).map(Change::Delay),
            Some("edge") => match only(words) {
                Some("rising") => Ok(Change::Edge(Edge::Rising)),
                Some("falling") => Ok(Change::Edge(Edge::Falling)),
                _ => Err(Refused::Edge),
            },
            Some("frames") => frames(words).map(Change::Frames).ok_or(Refused::Frames),
            Some("curve") => curve(words).ok_or(Refused::Numbers),
            _ => Err(Refused::Unknown),
        }
    }
}

impl Settings {
    /// These settings with a change. It may build a curve, which takes a tenth of a second or two.
    ///
    /// # Errors
    /// Numbers that are not a curve.
    pub fn with(&self, change: Change) -> Result<Self, Refused> {
        let mut settings = self.clone();
        match change {
            Change::Pulses(pulses) => settings.pulses = pulses,
            Change::Gap(gap) => settings.gap = gap,
            Change::Light(light) => settings.light = light,
            Change::Delay(delay) => settings.delay = delay,
            Change::Edge(edge) => settings.edge = edge,
            Change::Frames(frames) => settings.frames = frames,
            Change::Stored(i) => settings.curve = Curve::Stored(i),
            Change::Linear(numbers) => settings.curve = Numbers::Four(numbers).build()?,
            Change::Built(numbers) => settings.curve = Numbers::Twelve(numbers).build()?,
        }
        Ok(settings)
    }
}

/// The only word that is left.
fn only<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let word = words.next();
    if words.next().is_none() { word } else { None }
}

fn ticks<'a>(words: impl Iterator<Item = &'a str>, rounding: Rounding) -> Result<u32, Refused> {
    only(words).and_then(|word| parse(word, rounding)).ok_or(Refused::Duration)
}

fn frames<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<Frames> {
    let count = words.next()?.parse().ok()?;
    match count {
        0 => None,
        1 => words.next().is_none().then_some(Frames::ONE),
        _ => Some(Frames { count, period: parse(only(words)?, Rounding::Nearest)? }),
    }
}

/// A stored curve, or numbers, finite or not: the crate has a word for those that are not.
fn curve<'a>(words: impl Iterator<Item = &'a str> + Clone) -> Option<Change> {
    if let Some(word) = only(words.clone()) {
        let curve: usize = word.parse().ok()?;
        return (1..=CURVES.len()).contains(&curve).then(|| Change::Stored(curve - 1));
    }
    let mut numbers = [0.0; 12];
    let mut count = 0;
    for word in words {
        *numbers.get_mut(count)? = word.parse().ok()?;
        count += 1;
    }
    match (count, numbers) {
        (4, [a, b, c, d, ..]) => Some(Change::Linear([a, b, c, d])),
        (12, _) => Some(Change::Built(numbers)),
        _ => None,
    }
}
