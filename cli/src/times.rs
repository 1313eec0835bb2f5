//! Trigger times as they were measured, in place of a curve: a scene's `trigger_times`, checked.

use std::ops::Deref;

use shutter_fit::unit::Unit;
use toml::Spanned;
use toml::de::DeTable;

use crate::common::Common;
use crate::delay::LAST;
use crate::fault::{Fault, Pair, Ticks, What};
use crate::lamp::SetUp;
use crate::plan::{MOST_TRIGGERS, whole_ticks};
use crate::scene::{self, Number, Scene, TRIGGER_TIMES as KEY, TriggerTimes};
use crate::timer::Timer;

/// A trigger that was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Its time in seconds, as it was given.
    pub time: f64,
    /// The timer's ticks after the shutter starts to open, rounded to the nearest.
    pub ticks: u32,
}

/// Triggers that can be played.
#[derive(Clone, Debug)]
pub struct Times {
    /// When the shutter starts to open, in seconds: ticks count from there.
    pub open_start: f64,
    /// In order.
    pub triggers: Vec<Given>,
    common: Common,
}

impl Deref for Times {
    type Target = Common;

    fn deref(&self) -> &Common {
        &self.common
    }
}

/// Why a key that goes with a curve has no meaning beside trigger times.
fn of_a_curve(key: &str) -> Option<&'static str> {
    Some(match key {
        "open_end" | "close_start" | "close_end" | "shutteropening" => {
            "it is a curve's, and the triggers of this scene are given by their times"
        }
        "triggers" => "their number is that of trigger_times",
        "fully_open" => "when the shutter is fully open is a curve's, and this scene has none",
        "pulse" | "duty" | "min_pulse" => "pulses are checked against a curve, and a scene with trigger_times has none",
        _ => return None,
    })
}

impl Times {
    /// The triggers of the scene that `text` describes.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let table = DeTable::parse(text).map(Spanned::into_inner).unwrap_or_default();
        for key in table.keys() {
            if let Some(why) = of_a_curve(key.get_ref()) {
                return Err(Fault::at(key, What::Text(format!("{}: {why}", key.get_ref()))));
            }
        }
        let mut scene = scene::read(text)?;
        let times = scene.trigger_times.take().unwrap_or_else(|| Spanned::new(0..0, Vec::new()));
        let mut times = Self::new(&scene, &times)?;
        times.common.fitted = scene::fitted(text);
        Ok(times)
    }

    /// The triggers at these times of a scene of numbers, counted from the start of opening at 0.
    pub fn of_numbers(mut scene: Scene, times: &[f64]) -> Result<Self, Fault> {
        let place = scene.triggers.span();
        let at = |time| Spanned::new(place.clone(), Number::Any(time));
        scene.open_start = Spanned::new(place.clone(), Number::Any(0.0));
        Self::new(&scene, &Spanned::new(place.clone(), times.iter().copied().map(at).collect()))
    }

    fn new(scene: &Scene, times: &TriggerTimes) -> Result<Self, Fault> {
        let unit = scene.unit();
        let open_start = scene::seconds(unit, "open_start", &scene.open_start)?;
        if let Some(place) = scene.set_up.as_ref().filter(|it| *it.get_ref() == SetUp::InPath) {
            return Err(Fault::at(place, What::TimesInPath));
        }
        let last = times.get_ref().last().map_or(0.0, |it| it.get_ref().get());
        let delay = scene.delay.as_ref().map_or(0.0, |delay| delay.get_ref().get());
        let until_end = unit.seconds(last + delay) - open_start;
        let timer = Timer::new(scene.timer_hz.as_ref(), scene.timer_bits.as_ref(), until_end)?;
        let min_gap = scene::not_negative(unit, "min_gap", &scene.min_gap)?;
        let triggers = triggers(times, unit, open_start, timer, whole_ticks(min_gap, timer.hz).max(1))?;
        let last = triggers.last().map_or(0.0, |last| last.time - open_start);
        let end = triggers.last().map_or(0.0, |last| last.ticks.into());
        let common = Common::new(scene, timer, last.max(1.0 / f64::from(timer.hz)), end)?;
        common.starts(triggers.first().map_or(0, |first| first.ticks), scene)?;
        Ok(Self { open_start, triggers, common })
    }

    /// From each trigger to the next, in ticks.
    pub fn gaps(&self) -> impl Iterator<Item = u32> {
        self.triggers.windows(2).map(|pair| pair[1].ticks - pair[0].ticks)
    }
}

/// The times in ticks, known to be in order and at least so many apart.
fn triggers(all: &TriggerTimes, unit: Unit, start: f64, timer: Timer, gap: u64) -> Result<Vec<Given>, Fault> {
    let (hz, gap) = (f64::from(timer.hz), i64::try_from(gap).unwrap_or(i64::MAX));
    let times = all.get_ref();
    if times.is_empty() || times.len() > MOST_TRIGGERS as usize {
        return Err(Fault::at(all, What::TimesCount(times.len())));
    }
    let mut triggers: Vec<Given> = Vec::new();
    for (i, place) in times.iter().enumerate() {
        let fault = |what| Err(Fault::at(place, what));
        let time = scene::seconds(unit, KEY, place)?;
        let ticks = ((time - start) * hz).round();
        if time < start {
            return fault(What::TimesEarly { i });
        }
        if ticks > LAST {
            return fault(What::TimesLate { i });
        }
        if let Some(last) = triggers.last() {
            let by = ticks as i64 - i64::from(last.ticks);
            if time < last.time {
                return fault(What::TimesOutOfOrder { i: i - 1 });
            }
            if by < gap {
                let ticks = |count| Ticks { count, hz: timer.hz, is_given: timer.is_given, unit };
                let (gap, least) = (ticks(by), ticks(gap));
                return fault(What::TimesClose(Pair { first: i - 1, gap, least }));
            }
        }
        triggers.push(Given { time, ticks: ticks as u32 });
    }
    Ok(triggers)
}
