//! A scene's triggers, checked.

use serde::{Deserialize, Serialize};
use shutter_curve::ShutterCurve;
pub use shutter_fit::MOST_TRIGGERS;
use shutter_fit::unit::Unit;

use crate::fault::{Fault, What};
use crate::frames::{Frames, whole_ticks};
use crate::lamp::{Flash, FullyOpen, Lamp, SetUp};
use crate::scene::Scene;
use crate::shape::{self, Shape};
use crate::sync::{Delay, Sync};
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
    /// Its peak, as a share of full light: below 1 where the trace's shutter never opened fully.
    pub peak: f64,
}

impl Curve {
    /// Its exposure in seconds of full light.
    pub fn exposure(&self) -> f32 {
        (f64::from(self.shutter.exposure()) * self.peak) as f32
    }

    /// The exposure's part of the time from opening to closed.
    pub fn efficiency(&self) -> f32 {
        (f64::from(self.shutter.efficiency()) * self.peak) as f32
    }
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
    /// What was asked for, its times in seconds.
    pub scene: Scene,
    /// The scene's unit, or the one that suits its times.
    pub unit: Unit,
}

/// A trigger under the keys that it has in all forms.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
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
    pub fn new(asked: &Scene) -> Result<Self, Fault> {
        let (shape, curve) = match asked.shutter.trigger_times {
            None => shape::curve(&asked.shutter).map(|(shape, curve)| (Some(shape), Some(curve)))?,
            Some(_) => (None, None),
        };
        let scene = asked.in_seconds()?;
        let (shutter, flashes) = (&scene.shutter, &scene.flashes);
        let (n, peak) = (number(&scene)?, shutter.peak()?);
        let [start, end] = match (&curve, &shutter.trigger_times) {
            (Some(curve), _) => [curve.open_start(), curve.close_end()].map(f64::from),
            (None, times) => {
                let missing = Fault::new("shutter.open_start", What::Missing);
                [shutter.open_start.ok_or(missing)?, times.iter().flatten().last().copied().unwrap_or_default()]
            }
        };
        let length = end - start;
        let delay = Delay::new(&scene)?;
        let timer = Timer::new(flashes, length + delay.map_or(0.0, |it| it.seconds.max(0.0)))?;
        let end = (length * f64::from(timer.hz)).round();
        let frames = Frames::new(&scene, curve.as_ref(), timer, end, asked.unit())?;
        let sync = Sync::new(delay, flashes.lamp_lag, timer.hz, end)?;
        timer.holds(f64::from(sync.ticks) + end)?;
        let frame = frames.checked(n).map_err(|problem| frames.told(problem, n))?;
        let length = if curve.is_some() { length } else { length.max(timer.seconds(1)) };
        let trigger = |(i, flash): (usize, &Flash)| {
            let part = |n: f64| (i as f64 + 0.5) / n;
            let u = (i as f32 + 0.5) / n as f32;
            let (u, time) = match (&curve, &shutter.trigger_times) {
                (Some(curve), _) if frames.lamp == Lamp::FullyOpen => {
                    let time = FullyOpen::new(curve).time(part(n.into())) as f32;
                    (Some(curve.cdf(time)), time.into())
                }
                (Some(curve), _) => (Some(u), curve.inverse_cdf(u).into()),
                (None, times) => (None, times.as_ref().map_or(start, |times| times[i])),
            };
            let pulse = frames.lamp.has_pulses().then_some((flash.on as u32, flash.off as u32));
            Trigger { u, time, ticks: flash.tick, pulse }
        };
        let mut plan = Self {
            start,
            length,
            triggers: frame.iter().enumerate().map(trigger).collect(),
            lamp: frames.lamp,
            timer,
            sync,
            hold_off: 0,
            curve: None,
            unit: asked.shutter.unit.or(asked.flashes.unit).unwrap_or_else(|| Unit::fit(length)),
            scene,
        };
        plan.starts(asked, &frame, &frames)?;
        let most = frames.most(n, MOST_TRIGGERS + 1);
        plan.curve = shape.zip(curve).map(|(shape, shutter)| {
            let moved = shape.rounding(&asked.shutter) * f64::from(timer.hz);
            Curve { shape, shutter, most, moved, peak }
        });
        plan.held_off()
    }

    /// The plan of the scene that `text` describes.
    ///
    /// # Errors
    /// Those of [`Scene::parse`] and [`Plan::new`].
    pub fn parse(text: &str) -> Result<Self, Fault> {
        Self::new(&Scene::parse(text)?)
    }

    /// Does no flash come before the edge?
    fn starts(&self, asked: &Scene, frame: &[Flash], frames: &Frames) -> Result<(), Fault> {
        let Sync { early, delay, lag, .. } = self.sync;
        let is_early = |flash: &Flash| flash.on < i64::from(early);
        let few = frame.iter().filter(|flash| is_early(flash)).count();
        let Some(first) = frame.first().filter(|_| few > 0) else { return Ok(()) };
        let by = self.timer.seconds((i64::from(early) - first.on) as f64);
        let is_behind = |frames: &Frames, n: u32| {
            let frame = frames.checked(n).unwrap_or_default();
            frame.first().is_some_and(|first| !is_early(first))
        };
        // Fewer triggers begin later.
        let (mut low, mut high) = (0, frame.len() as u32);
        while high - low > 1 {
            let middle = low.midpoint(high);
            *(if is_behind(frames, middle) { &mut low } else { &mut high }) = middle;
        }
        let is_emulated = self.scene.flashes.set_up == Some(SetUp::Emulated);
        let open = frames.fully_open().filter(|_| !is_emulated && self.lamp == Lamp::Triggered);
        let key = match delay {
            Some(delay) if lag.is_none() || delay.seconds < 0.0 => delay.key,
            _ => "flashes.lamp_lag",
        };
        let what = What::BeforeEdge {
            few,
            by,
            by_edge: delay.is_some(),
            most: (low > 0).then_some(low),
            fully_open: open.is_some_and(|open| is_behind(&open, frame.len() as u32)),
            lag: lag.map(|lag| lag - by).filter(|most| *most > 0.0),
            is_emulated: delay.is_some() && is_emulated,
            unit: asked.unit(),
        };
        Err(Fault::new(key, what))
    }

    /// With its hold-off.
    fn held_off(mut self) -> Result<Self, Fault> {
        let ticks = |seconds: Option<f64>| whole_ticks(seconds.unwrap_or_default(), self.timer.hz);
        let last = self.triggers.last().map_or(0, |last| last.pulse.map_or(last.ticks, |(_, off)| off));
        let last = u64::from(self.sync.ticks) + u64::from(last.saturating_sub(self.sync.early));
        let ready = last.saturating_add(ticks(self.scene.flashes.min_gap).max(1));
        let all = ready.max(ticks(self.scene.shutter.sync_settles));
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

    /// The light that comes of each flash, as a part of what it sends; of a pulse with a duty, as a part of the most
    /// that comes of one.
    pub fn doses(&self, set_up: SetUp) -> Vec<f64> {
        let (Some(curve), SetUp::InPath) = (&self.curve, set_up) else { return vec![1.0; self.triggers.len()] };
        let shutter = &curve.shutter;
        let time = |ticks| (f64::from(shutter.open_start()) + self.seconds(ticks)) as f32;
        let came = |trigger: &Trigger| match trigger.pulse {
            None => f64::from(shutter.openness(time(trigger.ticks))) * curve.peak,
            Some((on, off)) => f64::from(shutter.cdf(time(off))) - f64::from(shutter.cdf(time(on))),
        };
        let doses: Vec<f64> = self.triggers.iter().map(came).collect();
        let whole = match self.lamp {
            Lamp::Triggered | Lamp::FullyOpen => 1.0,
            Lamp::Equal { ticks } => self.seconds(ticks) / f64::from(curve.exposure()),
            Lamp::Doses { .. } => doses.iter().copied().fold(f64::MIN_POSITIVE, f64::max),
        };
        doses.iter().map(|dose| (dose / whole).min(1.0)).collect()
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
        let doses = self.scene.flashes.set_up.filter(|_| self.curve.is_some()).map(|set_up| self.doses(set_up));
        let mut last = None;
        let row = |(index, trigger): (usize, &Trigger)| {
            // Checked above: none comes that early, and the sums are at most 2³¹.
            let ticks = trigger.ticks.saturating_sub(early);
            let pulse = trigger.pulse.map(|(on, off)| (on.saturating_sub(early), off - early));
            Row {
                index,
                u: trigger.u,
                time_s: if self.curve.is_some() { digits(trigger.time as f32) } else { trigger.time },
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

/// How many triggers are asked for, or measured.
fn number(Scene { shutter, flashes, .. }: &Scene) -> Result<u32, Fault> {
    let Some(times) = &shutter.trigger_times else {
        let n = flashes.triggers.ok_or_else(|| Fault::new("flashes.triggers", What::Missing))?;
        let is_whole = n.fract() == 0.0 && (1.0..=MOST_TRIGGERS.into()).contains(&n);
        return match is_whole {
            true => Ok(n as u32),
            false => Err(Fault::new("flashes.triggers", What::Whole { most: MOST_TRIGGERS })),
        };
    };
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
    match flashes.set_up {
        Some(SetUp::InPath) => Err(Fault::new("flashes.set_up", What::TimesInPath)),
        _ => Ok(times.len() as u32),
    }
}

/// The `f64` that is written with the digits of this `f32`, and read back as it.
pub(crate) fn digits(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(x.into())
}
