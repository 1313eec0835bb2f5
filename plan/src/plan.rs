//! A scene's triggers, checked.

use serde::Serialize;
use shutter_curve::{Hz, ScheduleError, ShutterCurve};
pub use shutter_fit::MOST_TRIGGERS;
use shutter_fit::unit::Unit;

use crate::fault::{Fault, Pair, Ticks, What};
use crate::frames::{Frames, whole_ticks};
use crate::lamp::{Flash, FullyOpen, Lamp, SetUp};
use crate::scene::{Key, Measured, Scene};
use crate::set_up::doses;
use crate::shape::{self, Shape, noted};
use crate::sync::{Delay, LAST, Sync};
use crate::timer::Timer;

/// When to trigger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trigger {
    /// The fraction of the exposure collected by then, where a curve tells.
    pub u: Option<f32>,
    /// Its exact time in seconds, an `f32` where a curve tells.
    pub time: f64,
    /// The timer's ticks after the shutter starts to open.
    pub ticks: u32,
    /// When to switch the lamp on and off, in the same ticks, where the scene asks for pulses.
    pub pulse: Option<(u32, u32)>,
}

/// A curve that triggers are planned by.
#[derive(Clone)]
pub struct Curve {
    /// Its numbers.
    pub shape: Shape,
    /// The shutter.
    pub shutter: ShutterCurve,
    /// So many triggers keep what the scene asks for, and one more does not.
    pub most: u32,
    /// By so many ticks `f32` moves its times.
    pub moved: f64,
}

/// A scene that can be played.
#[derive(Clone)]
pub struct Plan {
    /// By its curve, or by trigger times as they were measured.
    pub curve: Option<Curve>,
    /// When the shutter starts to open, in seconds of the scene.
    pub start: f64,
    /// From opening to closed in seconds; without a curve, to the last trigger, and a tick at least.
    pub length: f64,
    /// In order.
    pub triggers: Vec<Trigger>,
    /// What the lamp does.
    pub lamp: Lamp,
    /// What counts the ticks.
    pub timer: Timer,
    /// From where they count.
    pub sync: Sync,
    /// After an edge, or the start of opening where there is no delay: the frame is over, and lamp and sync are ready
    /// for another one.
    pub hold_off: u32,
    /// How the flashes meet the shutter, if the scene tells.
    pub set_up: Option<SetUp>,
    /// Between two triggers, or from the end of a pulse to the start of the next: at least so many seconds.
    pub min_gap: Option<f64>,
    /// The exposure that the shutter's maker names, in seconds.
    pub nominal: Option<f64>,
    /// What the trace tells that the shutter comes from.
    pub measured: Option<Measured>,
    /// The delay of that trace, in seconds.
    pub traced_delay: Option<f64>,
    /// The edge that it counts from.
    pub traced_falls: Option<bool>,
    /// Was the shutter changed since a fit wrote it?
    pub is_edited: bool,
    /// The scene's unit, or the one that suits its times.
    pub unit: Unit,
}

/// A trigger under the keys that it has in all forms.
#[derive(Clone, Copy, Debug, Serialize)]
#[expect(missing_docs, reason = "docs/firmware.md tells what they are")]
pub struct Row {
    pub index: usize,
    pub u: Option<f32>,
    pub time_s: f64,
    pub ticks: u32,
    pub gap_ticks: Option<u32>,
    pub from_edge_ticks: Option<u32>,
    pub on_ticks: Option<u32>,
    pub off_ticks: Option<u32>,
    pub dose: Option<f64>,
}

impl Plan {
    /// The plan of a scene.
    ///
    /// # Errors
    /// Keys that are missing or out of their range, a curve that the crate refuses, triggers that cannot be fired.
    pub fn new(scene: &Scene) -> Result<Self, Fault> {
        Self::bare(scene).map_err(|fault| noted(scene, fault))
    }

    /// The same; what is wrong has no notes, and nothing is told in words.
    ///
    /// # Errors
    /// Those of [`Plan::new`].
    pub fn bare(scene: &Scene) -> Result<Self, Fault> {
        match &scene.shutter.trigger_times {
            None => Self::by_curve(scene),
            Some(times) => Self::by_times(scene, times),
        }
    }

    /// The plan of the scene that `text` describes.
    ///
    /// # Errors
    /// Those of [`Scene::parse`] and [`Plan::new`].
    pub fn parse(text: &str) -> Result<Self, Fault> {
        Self::new(&Scene::parse(text)?)
    }

    fn by_curve(scene: &Scene) -> Result<Self, Fault> {
        let (shutter, flashes) = (&scene.shutter, &scene.flashes);
        let triggers = flashes.triggers.ok_or_else(|| Fault::new("flashes.triggers", What::Missing))?;
        let n = whole("flashes.triggers", triggers, MOST_TRIGGERS)?;
        let (shape, curve) = shape::curve(shutter)?;
        let (start, close) = (f64::from(curve.open_start()), f64::from(curve.close_end()));
        let length = close - start;
        let delay = Delay::new(scene)?;
        let timer = Timer::new(flashes, delay.map_or(0.0, |it| it.seconds.max(0.0)) + length)?;
        // The rate is checked here, before anything is counted in ticks.
        Lamp::Triggered.frame(&curve, 0, timer.hz).map_err(|error| Fault::new("flashes.timer_hz", rate(error)))?;
        let end = (length * f64::from(timer.hz)).round();
        let plan = Self::common(scene, timer, delay, [start, length], end)?;
        let frames = Frames::new(scene, &curve, timer, plan.min_gap, end)?;
        let frame = frames.checked(n).map_err(|problem| frames.told(problem, n))?;
        plan.starts(scene, &frame.iter().map(|flash| flash.on).collect::<Vec<_>>(), Some(&frames))?;
        let trigger = |(i, flash): (u32, &Flash)| {
            let u = (i as f32 + 0.5) / n as f32;
            let (u, time) = match frames.lamp {
                Lamp::FullyOpen => {
                    let part = (f64::from(i) + 0.5) / f64::from(n);
                    let time = FullyOpen::new(&curve).time(part) as f32;
                    (curve.cdf(time), time)
                }
                _ => (u, curve.inverse_cdf(u)),
            };
            let pulse = frames.lamp.has_pulses().then_some((flash.on as u32, flash.off as u32));
            Trigger { u: Some(u), time: time.into(), ticks: flash.tick, pulse }
        };
        let triggers = (0..).zip(&frame).map(trigger).collect();
        let (lamp, most) = (frames.lamp, frames.most(n, MOST_TRIGGERS + 1));
        let moved = shape.rounding(shutter) * f64::from(timer.hz);
        Self { curve: Some(Curve { shape, shutter: curve, most, moved }), lamp, triggers, ..plan }.held_off(scene)
    }

    fn by_times(scene: &Scene, times: &[f64]) -> Result<Self, Fault> {
        let (shutter, flashes) = (&scene.shutter, &scene.flashes);
        let of_curve = [
            ("shutter.open_end", shutter.open_end.is_some()),
            ("shutter.close_start", shutter.close_start.is_some()),
            ("shutter.close_end", shutter.close_end.is_some()),
            ("shutter.shutteropening", shutter.shutteropening.is_some()),
            ("flashes.fully_open", flashes.fully_open.is_some()),
            ("flashes.pulse", flashes.pulse.is_some()),
            ("flashes.duty", flashes.duty.is_some()),
            ("flashes.min_pulse", flashes.min_pulse.is_some()),
        ];
        if let Some((key, _)) = of_curve.into_iter().find(|(_, is_there)| *is_there) {
            return Err(Fault::new(key, What::OfCurve));
        }
        if let Some(asked) = flashes.triggers.filter(|asked| *asked != times.len() as f64) {
            return Err(Fault::new("flashes.triggers", What::TimesOther { asked, has: times.len() }));
        }
        if flashes.set_up == Some(SetUp::InPath) {
            return Err(Fault::new("flashes.set_up", What::TimesInPath));
        }
        let unit = shutter.unit();
        let missing = Fault::new("shutter.open_start", What::Missing);
        let start = finite("shutter.open_start", unit, shutter.open_start)?.ok_or(missing)?;
        let delay = Delay::new(scene)?;
        let last = unit.seconds(times.last().copied().unwrap_or_default());
        let timer = Timer::new(flashes, last - start + delay.map_or(0.0, |it| it.seconds.max(0.0)))?;
        let min_gap = not_negative("flashes.min_gap", scene.unit(), flashes.min_gap)?;
        let gap = whole_ticks(min_gap.unwrap_or_default(), timer.hz).max(1);
        let triggers = measured(times, unit, start, timer, gap)?;
        let last = triggers.last().map_or(0.0, |last| last.time - start);
        let end = triggers.last().map_or(0.0, |last| last.ticks.into());
        let plan = Self::common(scene, timer, delay, [start, last.max(timer.seconds(1))], end)?;
        plan.starts(scene, &triggers.iter().map(|it| it.ticks.into()).collect::<Vec<_>>(), None)?;
        Self { triggers, ..plan }.held_off(scene)
    }

    /// What a plan by a curve and one by trigger times both have; its frame ends so many ticks after the opening.
    fn common(
        scene: &Scene,
        timer: Timer,
        delay: Option<Delay>,
        [start, length]: [f64; 2],
        end: f64,
    ) -> Result<Self, Fault> {
        let (shutter, flashes, unit) = (&scene.shutter, &scene.flashes, scene.unit());
        let lag = not_negative("flashes.lamp_lag", unit, flashes.lamp_lag)?;
        let sync = Sync::new(delay, lag, timer.hz, end)?;
        timer.holds(f64::from(sync.ticks) + end)?;
        Ok(Self {
            curve: None,
            start,
            length,
            triggers: Vec::new(),
            lamp: Lamp::Triggered,
            timer,
            sync,
            hold_off: 0,
            set_up: flashes.set_up,
            min_gap: not_negative("flashes.min_gap", unit, flashes.min_gap)?,
            nominal: positive("shutter.nominal", shutter.unit(), shutter.nominal)?,
            measured: shutter.measured.clone(),
            traced_delay: finite("shutter.delay", shutter.unit(), shutter.delay)?,
            traced_falls: shutter.sync_falls,
            is_edited: scene.is_edited,
            unit: shutter.unit.or(flashes.unit).unwrap_or_else(|| Unit::fit(length)),
        })
    }

    /// Does no flash, switched on after so many ticks, come before the edge?
    fn starts(&self, scene: &Scene, on: &[i64], frames: Option<&Frames>) -> Result<(), Fault> {
        let (early, delay) = (i64::from(self.sync.early), self.sync.delay);
        let few = on.iter().filter(|on| **on < early).count();
        if few == 0 {
            return Ok(());
        }
        let by = self.timer.seconds((early - on[0]) as f64);
        let is_behind = |frames: &Frames, n: u32| {
            let frame = frames.checked(n).unwrap_or_default();
            frame.first().is_some_and(|first| first.on >= early)
        };
        // Fewer triggers begin later.
        let (mut low, mut high) = (0, on.len() as u32);
        while let Some(frames) = frames.filter(|_| high - low > 1) {
            let middle = low + (high - low) / 2;
            *(if is_behind(frames, middle) { &mut low } else { &mut high }) = middle;
        }
        let most = (low > 0).then_some(low);
        let is_free = !self.lamp.has_pulses() && scene.flashes.set_up != Some(SetUp::Emulated);
        let open = frames.filter(|it| is_free && it.lamp == Lamp::Triggered).and_then(Frames::fully_open);
        let fully_open = open.is_some_and(|open| is_behind(&open, on.len() as u32));
        let key = match delay {
            Some(delay) if self.sync.lag.is_none() || delay.seconds < 0.0 => delay.key,
            _ => "flashes.lamp_lag",
        };
        let lag = self.sync.lag.map(|lag| lag - by).filter(|most| *most > 0.0);
        let (by_edge, unit) = (delay.is_some(), scene.unit());
        let is_emulated = by_edge && scene.flashes.set_up == Some(SetUp::Emulated);
        Err(Fault::new(key, What::BeforeEdge { few, by, by_edge, most, fully_open, lag, is_emulated, unit }))
    }

    /// With its hold-off.
    fn held_off(mut self, scene: &Scene) -> Result<Self, Fault> {
        let settles = not_negative("shutter.sync_settles", scene.shutter.unit(), scene.shutter.sync_settles)?;
        let last = self.triggers.last().map_or(0, |last| last.pulse.map_or(last.ticks, |(_, off)| off));
        let last = u64::from(self.sync.ticks) + u64::from(last.saturating_sub(self.sync.early));
        let ready = last.saturating_add(whole_ticks(self.min_gap.unwrap_or_default(), self.timer.hz).max(1));
        let all = ready.max(whole_ticks(settles.unwrap_or_default(), self.timer.hz));
        let most = (1u64 << self.timer.bits) - 1;
        if all > most && self.timer.is_given {
            return Err(Fault::new("flashes.min_gap", What::HoldOff { ticks: all, most }));
        }
        self.hold_off = all.min(most) as u32;
        Ok(self)
    }

    /// How long so many ticks last.
    pub fn seconds(&self, ticks: u32) -> f64 {
        self.timer.seconds(ticks)
    }

    /// From each trigger to the next, in ticks.
    pub fn gaps(&self) -> impl Iterator<Item = u32> {
        self.triggers.windows(2).map(|pair| pair[1].ticks - pair[0].ticks)
    }

    /// When each pulse goes on and off, where the scene asks for pulses.
    pub fn pulses(&self) -> impl Iterator<Item = (u32, u32)> + Clone {
        self.triggers.iter().filter_map(|trigger| trigger.pulse)
    }

    /// From the edge of the sync, or the start of opening where there is no delay, to the end of a frame, in seconds.
    pub fn edge_to_end(&self) -> f64 {
        self.sync.delay.map_or(0.0, |delay| delay.seconds) + self.length
    }

    /// What the times of a reader count from: the edge of the sync where that is known, or the scene's time 0.
    pub fn origin(&self) -> f64 {
        self.sync.delay.map_or(0.0, |delay| self.start - delay.seconds)
    }

    /// The triggers, in order, as a firmware counts them.
    pub fn rows(&self) -> Vec<Row> {
        let Sync { delay, ticks: from_edge, early, .. } = self.sync;
        let doses = self.set_up.filter(|_| self.curve.is_some()).map(|set_up| doses(set_up, self));
        let mut last = None;
        let row = |(index, trigger): (usize, &Trigger)| {
            // Checked above: none comes that early, and the sums are at most 2³¹.
            let ticks = trigger.ticks.saturating_sub(early);
            let pulse = trigger.pulse.map(|(on, off)| (on.saturating_sub(early), off - early));
            Row {
                index,
                u: trigger.u,
                time_s: if self.curve.is_some() { with_its_digits(trigger.time as f32) } else { trigger.time },
                ticks,
                gap_ticks: last.replace(ticks).map(|last| ticks - last),
                from_edge_ticks: delay.map(|_| from_edge + ticks),
                on_ticks: pulse.map(|pulse| pulse.0),
                off_ticks: pulse.map(|pulse| pulse.1),
                dose: doses.as_ref().map(|doses| doses[index]),
            }
        };
        self.triggers.iter().enumerate().map(row).collect()
    }
}

/// Measured times in ticks, known to be in order and at least so many apart.
fn measured(times: &[f64], unit: Unit, start: f64, timer: Timer, gap: u64) -> Result<Vec<Trigger>, Fault> {
    const KEY: Key = "shutter.trigger_times";
    let refused = |what| Err(Fault::new(KEY, what));
    let gap = i64::try_from(gap).unwrap_or(i64::MAX);
    if times.is_empty() || times.len() > MOST_TRIGGERS as usize {
        return refused(What::TimesCount(times.len()));
    }
    let mut triggers: Vec<Trigger> = Vec::new();
    for (i, time) in times.iter().enumerate() {
        let time = finite(KEY, unit, Some(*time))?.unwrap_or_default();
        let ticks = ((time - start) * f64::from(timer.hz)).round();
        if time < start {
            return refused(What::TimesEarly { i });
        }
        if ticks > LAST {
            return refused(What::TimesLate { i });
        }
        if let Some(last) = triggers.last() {
            let by = ticks as i64 - i64::from(last.ticks);
            if time < last.time {
                return refused(What::TimesOutOfOrder { i: i - 1 });
            }
            if by < gap {
                let ticks = |count| Ticks { count, hz: timer.hz, is_given: timer.is_given, unit };
                let (gap, least) = (ticks(by), ticks(gap));
                return refused(What::TimesClose(Pair { first: i - 1, gap, least }));
            }
        }
        triggers.push(Trigger { u: None, time, ticks: ticks as u32, pulse: None });
    }
    Ok(triggers)
}

/// A time in seconds, known to be finite, if there is one.
pub(crate) fn finite(key: Key, unit: Unit, time: Option<f64>) -> Result<Option<f64>, Fault> {
    match time {
        Some(time) if !time.is_finite() => Err(Fault::new(key, What::Finite)),
        time => Ok(time.map(|time| unit.seconds(time))),
    }
}

/// A time in seconds that has to be more than 0, if there is one.
pub(crate) fn positive(key: Key, unit: Unit, time: Option<f64>) -> Result<Option<f64>, Fault> {
    let seconds = finite(key, unit, time)?;
    if seconds.is_none_or(|seconds| seconds > 0.0) { Ok(seconds) } else { Err(Fault::new(key, What::Positive)) }
}

/// A time in seconds that has to be 0 or more, if there is one.
fn not_negative(key: Key, unit: Unit, time: Option<f64>) -> Result<Option<f64>, Fault> {
    let seconds = finite(key, unit, time)?;
    if seconds.is_none_or(|seconds| seconds >= 0.0) { Ok(seconds) } else { Err(Fault::new(key, What::NotNegative)) }
}

/// A whole number from 1 to `most`.
fn whole(key: Key, x: f64, most: u32) -> Result<u32, Fault> {
    let is_whole = x.fract() == 0.0 && (1.0..=most.into()).contains(&x);
    if is_whole { Ok(x as u32) } else { Err(Fault::new(key, What::Whole { most })) }
}

/// What is wrong with a timer's rate, in Hz, as all curves are in seconds here.
fn rate(error: ScheduleError) -> What {
    match error {
        ScheduleError::RateTooHigh { max: Hz(most @ 1..) } => What::RateTooHigh { most },
        _ => What::Schedule(error),
    }
}

/// The `f64` that is written with the digits of this `f32`, and read back as it.
fn with_its_digits(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(x.into())
}
