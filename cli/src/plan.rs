//! A scene's triggers, checked.

use std::ops::Deref;

use shutter_curve::{Hz, ScheduleError, ShutterCurve};
pub use shutter_fit::MOST_TRIGGERS;
use shutter_fit::unit::{Unit, count};

use crate::common::Common;
use crate::fault::{Fault, Pair, Ticks, What};
use crate::lamp::{Flash, FullyOpen, Lamp, SetUp};
use crate::scene::{Scene, positive, whole};
use crate::shape::Shape;
use crate::timer::Timer;

/// When to trigger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trigger {
    /// The fraction of the exposure collected by then.
    pub u: f32,
    /// Its exact time in seconds, rounded once.
    pub time: f32,
    /// The timer's ticks after the shutter starts to open.
    pub ticks: u32,
    /// When to switch the lamp on and off, in the same ticks, where the scene asks for pulses.
    pub pulse: Option<(u32, u32)>,
}

/// A scene that can be played.
#[derive(Clone)]
pub struct Plan {
    /// The curve's numbers.
    pub shape: Shape,
    /// The shutter.
    pub curve: ShutterCurve,
    /// What the lamp does.
    pub lamp: Lamp,
    /// So many triggers keep what the scene asks for, and one more does not.
    pub most: u32,
    /// In order.
    pub triggers: Vec<Trigger>,
    common: Common,
}

impl Deref for Plan {
    type Target = Common;

    fn deref(&self) -> &Common {
        &self.common
    }
}

impl Plan {
    /// The plan of the scene that `text` describes.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let scene = crate::scene::parse(text)?;
        let mut plan = Self::new(&scene).map_err(|fault| scene.noted(fault))?;
        plan.common.fitted.splice(..0, crate::scene::fitted(text));
        Ok(plan)
    }

    /// The plan of a scene.
    pub fn new(scene: &Scene) -> Result<Self, Fault> {
        let n = whole("triggers", &scene.triggers, MOST_TRIGGERS)?;
        let (shape, curve) = scene.curve()?;
        let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
        let until = scene.delay.as_ref().map_or(0.0, |it| scene.unit().seconds(it.get_ref().get()));
        let timer = Timer::new(scene.timer_hz.as_ref(), scene.timer_bits.as_ref(), until + length)?;
        let timer_hz = timer.hz;
        // The rate is checked here, before anything is counted in ticks.
        Lamp::Triggered
            .frame(&curve, 0, timer_hz)
            .map_err(|error| Fault::of(scene.timer_hz.as_ref().map(|it| it.span().start), rate(error)))?;
        let end = (length * f64::from(timer_hz)).round();
        let mut common = Common::new(scene, timer, length, end)?;
        let asked = Asked::new(scene, &curve, timer_hz, common.min_gap)?;
        let frames = Frames { curve: &curve, timer, unit: scene.unit(), end: end as i64 };
        let frame = match frames.checked(&asked, n) {
            Ok(frame) => frame,
            Err(problem) => return Err(problem.told(scene, &frames, &asked, n)),
        };
        let first = frame.first().map_or(0, |first| first.on as u32);
        common.starts(first, scene)?;
        let trigger = |(i, flash): (u32, &Flash)| {
            let u = (i as f32 + 0.5) / n as f32;
            let (u, time) = match asked.lamp {
                Lamp::FullyOpen => {
                    let part = (f64::from(i) + 0.5) / f64::from(n);
                    let time = FullyOpen::new(&curve).time(part) as f32;
                    (curve.cdf(time), time)
                }
                _ => (u, curve.inverse_cdf(u)),
            };
            let pulse = asked.lamp.has_pulses().then_some((flash.on as u32, flash.off as u32));
            Trigger { u, time, ticks: flash.tick, pulse }
        };
        let moved = scene.rounding(&shape) * f64::from(timer_hz);
        let moved = (timer.is_given && moved >= 0.5).then(|| {
            format!(
                "f32 moves the curve's times by up to {}; they are nearest where open_start is 0.",
                count(moved.ceil() as u64, "tick")
            )
        });
        let triggers = (0..).zip(&frame).map(trigger).collect();
        let most = frames.most(&asked, n, MOST_TRIGGERS + 1);
        common.fitted = moved.map(|told| ("doubt", told)).into_iter().collect();
        Ok(Self { shape, curve, lamp: asked.lamp, most, triggers, common })
    }

    /// From each trigger to the next, in ticks.
    pub fn gaps(&self) -> impl Iterator<Item = u32> {
        self.triggers.windows(2).map(|pair| pair[1].ticks - pair[0].ticks)
    }
}

/// What a scene asks of each frame, in ticks.
struct Asked {
    lamp: Lamp,
    /// Between the end of one flash and the start of the next.
    dark: u64,
    /// What a pulse has to last.
    lit: u64,
}

impl Asked {
    fn new(scene: &Scene, curve: &ShutterCurve, timer_hz: u32, min_gap: f64) -> Result<Self, Fault> {
        let unit = scene.unit();
        let pulse = positive(unit, "pulse", scene.pulse.as_ref())?;
        let min_pulse = positive(unit, "min_pulse", scene.min_pulse.as_ref())?;
        let fully_open = scene.fully_open.as_ref().filter(|it| *it.get_ref());
        if let Some(place) = fully_open.filter(|_| scene.pulse.is_some() || scene.duty.is_some()) {
            return Err(Fault::at(place, What::FullyOpenPulses));
        }
        if let Some(place) = fully_open.filter(|_| curve.open_end() == curve.close_start()) {
            return Err(Fault::at(place, What::FullyOpenNever));
        }
        if scene.set_up.as_ref().is_some_and(|it| *it.get_ref() == SetUp::Emulated) {
            if let Some(place) = &scene.duty {
                return Err(Fault::at(place, What::DutyEmulated));
            }
            if let Some(place) = fully_open {
                return Err(Fault::at(place, What::FullyOpenEmulated));
            }
        }
        let lamp = match (&scene.pulse, &scene.duty) {
            _ if fully_open.is_some() => Lamp::FullyOpen,
            (Some(_), Some(duty)) => return Err(Fault::at(duty, What::DutyAndPulse)),
            (Some(place), None) => {
                let ticks = (pulse.unwrap_or_default() * f64::from(timer_hz)).round();
                if ticks == 0.0 {
                    return Err(Fault::at(place, What::PulseOfNoTick { hz: timer_hz }));
                }
                // The cast saturates; what is so long is refused later.
                Lamp::Equal { ticks: ticks as u32 }
            }
            (None, Some(place)) => {
                let duty = place.get_ref().get() as f32;
                if !(duty > 0.0 && duty <= 1.0) {
                    return Err(Fault::at(place, What::Duty));
                }
                Lamp::Doses { duty }
            }
            (None, None) => Lamp::Triggered,
        };
        if let (Some(place), None) = (&scene.min_pulse, &scene.duty) {
            return Err(Fault::at(place, What::MinPulse));
        }
        // A timer fires once a tick; a lamp that shines on needs no gap.
        let least = u64::from(!lamp.has_pulses());
        let dark = whole_ticks(min_gap, timer_hz).max(least);
        let lit = match lamp {
            Lamp::Triggered | Lamp::FullyOpen => 0,
            Lamp::Equal { .. } => 1,
            Lamp::Doses { .. } => whole_ticks(min_pulse.unwrap_or_default(), timer_hz).max(1),
        };
        Ok(Self { lamp, dark, lit })
    }
}

/// The frames of a shutter, of any number of triggers.
struct Frames<'a> {
    curve: &'a ShutterCurve,
    timer: Timer,
    unit: Unit,
    /// The ticks until the shutter is closed.
    end: i64,
}

/// What is wrong with a frame.
#[derive(Clone, Copy)]
enum Problem {
    /// A flash and the next, with so many ticks between them.
    Close(usize, i64),
    /// A pulse lasts so many ticks.
    Short(usize, i64),
    /// The first pulse begins too early, or the last one ends too late.
    Outside,
}

impl Frames<'_> {
    /// The frame of `n` triggers, if it keeps what is asked for.
    fn checked(&self, asked: &Asked, n: u32) -> Result<Vec<Flash>, Problem> {
        // The rate is known to be good.
        let frame = asked.lamp.frame(self.curve, n, self.timer.hz).unwrap_or_default();
        let less = |ticks: i64, least: u64| i128::from(ticks) < i128::from(least);
        let gap = |pair: &[Flash]| pair[1].on - pair[0].off;
        if let Some(i) = frame.windows(2).position(|pair| less(gap(pair), asked.dark)) {
            return Err(Problem::Close(i, gap(&frame[i..])));
        }
        let length = |flash: &Flash| flash.off - flash.on;
        if let Some(i) = frame.iter().position(|flash| less(length(flash), asked.lit)) {
            return Err(Problem::Short(i, length(&frame[i])));
        }
        let ends = match asked.lamp {
            Lamp::FullyOpen => FullyOpen::new(self.curve).ticks(self.timer.hz),
            _ => (0, self.end),
        };
        if frame.iter().any(|flash| flash.on < ends.0 || flash.off > ends.1) {
            return Err(Problem::Outside);
        }
        Ok(frame)
    }

    /// So many triggers keep what is asked for, and one more does not, where `keep` do and `fail` do not.
    fn most(&self, asked: &Asked, mut keep: u32, mut fail: u32) -> u32 {
        // Where the openness is 1, a share of the exposure takes its own length; the answer is near what that leaves
        // room for.
        let lit = match asked.lamp {
            Lamp::Equal { ticks } => ticks.into(),
            _ => asked.lit,
        };
        let room = f64::from(self.curve.exposure()) * f64::from(self.timer.hz);
        let mut next = (room / asked.dark.saturating_add(lit).max(1) as f64) as u32;
        // Away from there in growing steps, until it lies between two of them.
        let (mut step, mut is_between) = (1, [false; 2]);
        while fail - keep > 1 {
            next = next.clamp(keep + 1, fail - 1);
            let kept = self.checked(asked, next).is_ok();
            *(if kept { &mut keep } else { &mut fail }) = next;
            is_between[usize::from(kept)] = true;
            next = match (is_between, kept) {
                ([true, true], _) => keep + (fail - keep) / 2,
                (_, true) => keep.saturating_add(step),
                (_, false) => fail.saturating_sub(step),
            };
            step = step.saturating_mul(2);
        }
        keep
    }

    /// The longest equal pulse that `n` triggers leave room for, in ticks.
    fn longest(&self, asked: &Asked, n: u32) -> i64 {
        let ticks = Lamp::Triggered.frame(self.curve, n, self.timer.hz).unwrap_or_default();
        let ticks: Vec<_> = ticks.iter().map(|flash| i64::from(flash.tick)).collect();
        let dark = i64::try_from(asked.dark).unwrap_or(i64::MAX);
        let apart = ticks.windows(2).map(|pair| (pair[1] - pair[0]).saturating_sub(dark));
        // Half of it, rounded down, comes before its trigger.
        let first = ticks.first().map(|first| 2 * first + 1);
        let last = ticks.last().map(|last| 2 * (self.end - last));
        apart.chain(first).chain(last).min().unwrap_or_default()
    }
}

impl Problem {
    /// What is wrong with the frame of `n` triggers, and what would help.
    fn told(&self, scene: &Scene, frames: &Frames, asked: &Asked, n: u32) -> Fault {
        let most = frames.checked(asked, 1).is_ok().then(|| frames.most(asked, 1, n));
        let ticks = |count| Ticks { count, hz: frames.timer.hz, is_given: frames.timer.is_given, unit: frames.unit };
        let [dark, lit] = [asked.dark, asked.lit].map(|least| ticks(i64::try_from(least).unwrap_or(i64::MAX)));
        let pair = |first, gap| Pair { first, gap: ticks(gap), least: dark };
        let what = match (asked.lamp, *self) {
            (Lamp::Equal { ticks: length }, problem) => {
                let pair = match problem {
                    Self::Close(i, gap) => Some(pair(i, gap)),
                    _ => None,
                };
                let longest = ticks(frames.longest(asked, n));
                let place = scene.pulse.as_ref().map_or(0, |pulse| pulse.span().start);
                let what = What::Pulses { length: ticks(length.into()), pair, longest, most };
                return Fault::of(Some(place), what);
            }
            (Lamp::Doses { .. }, Self::Close(i, gap)) => What::DosesClose { pair: pair(i, gap), most },
            (Lamp::Doses { .. }, Self::Short(i, lasts)) => What::DoseShort { i, lasts: ticks(lasts), least: lit, most },
            (_, Self::Close(i, gap)) => What::Close { pair: pair(i, gap), most },
            _ => What::Unfit { most },
        };
        Fault::at(&scene.triggers, what)
    }
}

/// What is wrong with a timer's rate, in Hz, as all curves are in seconds here.
fn rate(error: ScheduleError) -> What {
    match error {
        ScheduleError::RateTooHigh { max: Hz(most @ 1..) } => What::RateTooHigh { most },
        _ => What::Schedule(error),
    }
}

/// The fewest ticks that last as long as `gap`.
pub(crate) fn whole_ticks(gap: f64, timer_hz: u32) -> u64 {
    let hz = f64::from(timer_hz);
    // Compared in seconds: gap and quotient are both the nearest to what is meant, so a gap written as
    // a decimal fraction that is a whole number of ticks counts as one.
    let nearest = (gap * hz).round();
    let short = nearest / hz < gap;
    (nearest as u64).saturating_add(short.into())
}
