//! What a scene asks of its lamp, and the frames that keep it.

use shutter_curve::{Hz, ScheduleError, ShutterCurve};
use shutter_fit::MOST_TRIGGERS;
use shutter_fit::unit::Unit;

use crate::fault::{Fault, Key, Pair, Ticks, What};
use crate::lamp::{Flash, FullyOpen, LAST, Lamp, SetUp};
use crate::scene::{Flashes, Scene};
use crate::timer::Timer;

/// The frames of a shutter, and what a scene asks of each, in ticks.
pub(crate) struct Frames<'a> {
    source: Source<'a>,
    timer: Timer,
    unit: Unit,
    pub lamp: Lamp,
    /// The ticks until the shutter is closed.
    end: i64,
    /// Between the end of one flash and the start of the next.
    dark: u64,
    /// What a pulse has to last.
    lit: u64,
}

/// What frames come from.
#[derive(Clone)]
enum Source<'a> {
    /// A curve has frames of any number of triggers.
    Curve(&'a ShutterCurve),
    /// Measured triggers are the only frame.
    Times(Vec<Flash>),
}

/// What is wrong with a frame.
#[derive(Clone, Copy)]
pub(crate) enum Problem {
    /// A flash and the next, with so many ticks between them.
    Close(usize, i64),
    /// A pulse lasts so many ticks.
    Short(usize, i64),
    /// The first pulse begins too early, or the last one ends too late.
    Outside,
}

impl<'a> Frames<'a> {
    /// Those of a scene in seconds, with this curve, or else with its trigger times; what is wrong is told in this
    /// unit.
    ///
    /// # Errors
    /// Keys that are out of their range or do not go together.
    pub fn new(
        scene: &Scene,
        curve: Option<&'a ShutterCurve>,
        timer: Timer,
        end: f64,
        unit: Unit,
    ) -> Result<Self, Fault> {
        let flashes = &scene.flashes;
        let source = match curve {
            Some(curve) => Source::Curve(curve),
            None => Source::Times(measured(scene, timer)?),
        };
        let lamp = lamp(flashes, curve, timer)?;
        // A timer fires once a tick; a lamp that shines on needs no gap.
        let least = u64::from(!lamp.has_pulses());
        let dark = whole_ticks(flashes.min_gap.unwrap_or_default(), timer.hz).max(least);
        let lit = match lamp {
            Lamp::Triggered | Lamp::FullyOpen => 0,
            Lamp::Equal { .. } => 1,
            Lamp::Doses { .. } => whole_ticks(flashes.min_pulse.unwrap_or_default(), timer.hz).max(1),
        };
        Ok(Self { source, timer, unit, lamp, end: end as i64, dark, lit })
    }

    /// Those whose flashes come while the shutter is fully open, if it ever is.
    pub fn fully_open(&self) -> Option<Self> {
        let Source::Curve(curve) = self.source else { return None };
        let is_open = curve.open_end() < curve.close_start();
        let (source, dark) = (self.source.clone(), self.dark.max(1));
        is_open.then_some(Self { source, lamp: Lamp::FullyOpen, dark, lit: 0, ..*self })
    }

    /// The frame of `n` triggers.
    fn frame(&self, lamp: Lamp, n: u32) -> Vec<Flash> {
        match &self.source {
            // The rate is known to be good.
            Source::Curve(curve) => lamp.frame(curve, n, self.timer.hz).unwrap_or_default(),
            Source::Times(frame) => frame.clone(),
        }
    }

    /// The frame of `n` triggers, if it keeps what is asked for.
    pub fn checked(&self, n: u32) -> Result<Vec<Flash>, Problem> {
        let frame = self.frame(self.lamp, n);
        let less = |ticks: i64, least: u64| i128::from(ticks) < i128::from(least);
        let gap = |pair: &[Flash]| pair[1].on - pair[0].off;
        if let Some(i) = frame.windows(2).position(|pair| less(gap(pair), self.dark)) {
            return Err(Problem::Close(i, gap(&frame[i..])));
        }
        let length = |flash: &Flash| flash.off - flash.on;
        if let Some(i) = frame.iter().position(|flash| less(length(flash), self.lit)) {
            return Err(Problem::Short(i, length(&frame[i])));
        }
        let ends = match (&self.source, self.lamp) {
            (Source::Curve(curve), Lamp::FullyOpen) => FullyOpen::new(curve).ticks(self.timer.hz),
            _ => (0, self.end),
        };
        if frame.iter().any(|flash| flash.on < ends.0 || flash.off > ends.1) {
            return Err(Problem::Outside);
        }
        Ok(frame)
    }

    /// So many triggers keep what is asked for, and one more does not, where `keep` do and `fail` do not.
    pub fn most(&self, mut keep: u32, mut fail: u32) -> u32 {
        let Source::Curve(curve) = self.source else { return keep };
        let lit = match self.lamp {
            Lamp::Equal { ticks } => ticks.into(),
            _ => self.lit,
        };
        // Where the openness is 1, a share of the exposure takes its own length: the answer is near what that leaves
        // room for, and else halfway between what is known.
        let room = f64::from(curve.exposure()) * f64::from(self.timer.hz);
        let near = (room / self.dark.saturating_add(lit).max(1) as f64).min(fail.into()) as u32;
        let mut guesses = [near + near / 8 + 1, near - near / 8].into_iter();
        while fail - keep > 1 {
            let next = guesses.next().map_or(keep.midpoint(fail), |near| near.clamp(keep + 1, fail - 1));
            *(if self.checked(next).is_ok() { &mut keep } else { &mut fail }) = next;
        }
        keep
    }

    /// The longest equal pulse that `n` triggers leave room for, in ticks.
    fn longest(&self, n: u32) -> i64 {
        let ticks = self.frame(Lamp::Triggered, n);
        let ticks: Vec<_> = ticks.iter().map(|flash| i64::from(flash.tick)).collect();
        let dark = i64::try_from(self.dark).unwrap_or(i64::MAX);
        let apart = ticks.windows(2).map(|pair| (pair[1] - pair[0]).saturating_sub(dark));
        // Half of it, rounded down, comes before its trigger.
        let first = ticks.first().map(|first| 2 * first + 1);
        let last = ticks.last().map(|last| 2 * (self.end - last));
        apart.chain(first).chain(last).min().unwrap_or_default()
    }

    /// What is wrong with the frame of `n` triggers, and what would help.
    pub fn told(&self, problem: Problem, n: u32) -> Fault {
        let most = self.checked(1).is_ok().then(|| self.most(1, n));
        let length = if let Lamp::Equal { ticks } = self.lamp { ticks.into() } else { 0 };
        let asked = self.timer.seconds(self.dark.max(self.lit).max(length) as f64);
        // The scene's unit is not that of the command line: 1.5 ms are no 0.0015 s.
        let unit = if (0.1..1e4).contains(&self.unit.of(asked)) { self.unit } else { Unit::fit(asked) };
        let ticks = |count| Ticks { count, hz: self.timer.hz, is_given: self.timer.is_given, unit };
        let [dark, lit] = [self.dark, self.lit].map(|least| ticks(i64::try_from(least).unwrap_or(i64::MAX)));
        let pair = |first, gap| Pair { first, gap: ticks(gap), least: dark };
        let what = match (self.lamp, problem) {
            (_, Problem::Close(i, gap)) if matches!(self.source, Source::Times(_)) => {
                return Fault::new(TIMES, What::TimesClose(pair(i, gap)));
            }
            (Lamp::Equal { ticks: length }, problem) => {
                let pair = match problem {
                    Problem::Close(i, gap) => Some(pair(i, gap)),
                    _ => None,
                };
                let what = What::Pulses { length: ticks(length.into()), pair, longest: ticks(self.longest(n)), most };
                return Fault::new("flashes.pulse", what);
            }
            (Lamp::Doses { .. }, Problem::Close(i, gap)) => What::DosesClose { pair: pair(i, gap), most },
            (Lamp::Doses { .. }, Problem::Short(i, lasts)) => {
                What::DoseShort { i, lasts: ticks(lasts), least: lit, most }
            }
            (_, Problem::Close(i, gap)) => What::Close { pair: pair(i, gap), most },
            _ => What::Unfit { most },
        };
        Fault::new("flashes.triggers", what)
    }
}

const TIMES: Key = "shutter.trigger_times";

/// Measured times in ticks, known to be in order.
fn measured(scene: &Scene, timer: Timer) -> Result<Vec<Flash>, Fault> {
    let times = scene.shutter.trigger_times.as_deref().unwrap_or_default();
    let start = scene.shutter.open_start.unwrap_or_default();
    let refused = |what| Err(Fault::new(TIMES, what));
    if times.is_empty() || times.len() > MOST_TRIGGERS as usize {
        return refused(What::TimesCount(times.len()));
    }
    let ticks = |time: f64| ((time - start) * f64::from(timer.hz)).round();
    if let Some(i) = times.iter().position(|time| *time < start) {
        return refused(What::TimesEarly { i });
    }
    if let Some(i) = times.iter().position(|time| ticks(*time) > LAST) {
        return refused(What::TimesLate { i });
    }
    if let Some(i) = times.windows(2).position(|pair| pair[1] < pair[0]) {
        return refused(What::TimesOutOfOrder { i });
    }
    let flash = |time: &f64| Flash { tick: ticks(*time) as u32, on: ticks(*time) as i64, off: ticks(*time) as i64 };
    Ok(times.iter().map(flash).collect())
}

/// What the lamp is asked for, known to go with the set-up and the curve.
fn lamp(flashes: &Flashes, curve: Option<&ShutterCurve>, timer: Timer) -> Result<Lamp, Fault> {
    let fully_open = flashes.fully_open == Some(true);
    let is_emulated = flashes.set_up == Some(SetUp::Emulated);
    let refused = |key, what: What| Err(Fault::new(key, what));
    const OPEN: &str = "flashes.fully_open";
    if let Some(curve) = curve {
        Lamp::Triggered.frame(curve, 0, timer.hz).map_err(|error| Fault::new("flashes.timer_hz", rate(error)))?;
    }
    match (flashes.pulse, flashes.duty) {
        (Some(_), _) | (_, Some(_)) if fully_open => refused(OPEN, What::FullyOpenPulses),
        _ if fully_open && curve.is_some_and(|it| it.open_end() == it.close_start()) => {
            refused(OPEN, What::FullyOpenNever)
        }
        (_, Some(_)) if is_emulated => refused("flashes.duty", What::DutyEmulated),
        (Some(_), Some(_)) => refused("flashes.duty", What::DutyAndPulse),
        (_, None) if flashes.min_pulse.is_some() => refused("flashes.min_pulse", What::MinPulse),
        (None, None) if fully_open && is_emulated => refused(OPEN, What::FullyOpenEmulated),
        (None, None) if fully_open => Ok(Lamp::FullyOpen),
        (None, None) => Ok(Lamp::Triggered),
        (Some(pulse), None) => match (pulse * f64::from(timer.hz)).round() {
            0.0 => refused("flashes.pulse", What::PulseOfNoTick { hz: timer.hz }),
            // The cast saturates; what is so long is refused later.
            ticks => Ok(Lamp::Equal { ticks: ticks as u32 }),
        },
        (None, Some(duty)) => match duty as f32 {
            duty if duty > 0.0 && duty <= 1.0 => Ok(Lamp::Doses { duty }),
            _ => refused("flashes.duty", What::Part),
        },
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
