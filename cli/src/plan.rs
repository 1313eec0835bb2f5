//! A scene's triggers, checked.

use shutter_curve::{ScheduleError, ShutterCurve};

use crate::scene::{Fault, Scene};
use crate::unit::Unit;

/// The most triggers of one scene.
const MOST_TRIGGERS: u32 = 10_000;

/// When to trigger.
pub struct Trigger {
    /// The fraction of the exposure collected by then.
    pub u: f32,
    /// Its exact time in seconds, rounded once.
    pub time: f32,
    /// The timer's ticks after the shutter starts to open.
    pub ticks: u32,
}

/// A scene that can be played.
pub struct Plan {
    /// The shutter.
    pub curve: ShutterCurve,
    /// The timer's ticks in a second.
    pub timer_hz: u32,
    /// Seconds, as the scene asks.
    pub min_gap: f64,
    /// Any number of triggers up to this one keeps the gap.
    pub most: u32,
    /// In order.
    pub triggers: Vec<Trigger>,
}

impl Plan {
    /// The plan of a scene.
    ///
    /// # Errors
    /// Whatever is wrong with the scene.
    pub fn new(scene: &Scene) -> Result<Self, Fault> {
        let Scene { triggers, timer_hz, min_gap, .. } = scene;
        let (&n, &hz, &gap) = (triggers.get_ref(), timer_hz.get_ref(), min_gap.get_ref());
        if n == 0 || n > MOST_TRIGGERS {
            let reason = format!("triggers: 1 to {MOST_TRIGGERS} can be planned");
            return Err(Fault::at(triggers, reason));
        }
        if !(gap.is_finite() && gap >= 0.0) {
            return Err(Fault::at(min_gap, "min_gap: seconds, 0 or more, are required"));
        }
        let curve = scene.curve()?;
        let ticks = ticks(&curve, n, hz).map_err(|error| Fault::at(timer_hz, error))?;
        let least = whole_ticks(gap, hz);
        let most = most_triggers(&curve, hz, least);
        if let Some(i) = first_too_close(&ticks, least) {
            let (next, apart) = (i + 1, ticks[i + 1] - ticks[i]);
            let reason = format!(
                "triggers {i} and {next} come {apart} ticks apart, and {least} are required; \
                 up to {most} triggers keep that"
            );
            return Err(Fault::at(triggers, reason));
        }
        let u = (0..n).map(|i| (i as f32 + 0.5) / n as f32);
        let triggers = u.zip(curve.trigger_times(n)).zip(ticks);
        let triggers = triggers.map(|((u, time), ticks)| Trigger { u, time, ticks }).collect();
        Ok(Self { curve, timer_hz: hz, min_gap: gap, most, triggers })
    }

    /// From opening to closed, in seconds.
    pub fn length(&self) -> f64 {
        f64::from(self.curve.close_end()) - f64::from(self.curve.open_start())
    }

    /// The unit that suits this plan's times.
    pub fn unit(&self) -> Unit {
        Unit::fit(self.length())
    }

    /// How long so many ticks last.
    pub fn seconds(&self, ticks: u32) -> f64 {
        f64::from(ticks) / f64::from(self.timer_hz)
    }

    /// From each trigger to the next, in ticks.
    pub fn gaps(&self) -> impl Iterator<Item = u32> {
        self.triggers.windows(2).map(|pair| pair[1].ticks - pair[0].ticks)
    }
}

fn ticks(curve: &ShutterCurve, n: u32, timer_hz: u32) -> Result<Vec<u32>, ScheduleError> {
    Ok(curve.trigger_ticks(n, timer_hz)?.collect())
}

/// The first trigger that the next one follows in fewer than `least` ticks.
fn first_too_close(ticks: &[u32], least: u64) -> Option<usize> {
    ticks.windows(2).position(|pair| u64::from(pair[1] - pair[0]) < least)
}

/// The fewest ticks that last as long as `gap`; at least one, as a timer fires once a tick.
fn whole_ticks(gap: f64, timer_hz: u32) -> u64 {
    let hz = f64::from(timer_hz);
    // Compared in seconds: gap and quotient are both the nearest to what is meant, so a gap written as
    // a decimal fraction that is a whole number of ticks counts as one.
    let nearest = (gap * hz).round();
    let short = nearest / hz < gap;
    (nearest as u64).saturating_add(short.into()).max(1)
}

/// The most triggers sure to come `least` ticks apart: those whose exact times do, less those that lose
/// a tick in rounding, which are few.
fn most_triggers(curve: &ShutterCurve, timer_hz: u32, least: u64) -> u32 {
    let exact = curve.max_triggers((least as f64 / f64::from(timer_hz)) as f32).min(MOST_TRIGGERS);
    let keeps = |n: &u32| {
        ticks(curve, *n, timer_hz).is_ok_and(|ticks| first_too_close(&ticks, least).is_none())
    };
    (1..=exact).rev().find(keeps).unwrap_or(1)
}
