//! What a lamp does in a frame: flashes at the triggers, equal pulses around them, pulses of equal doses, or flashes
//! while the shutter is fully open.

use serde::{Deserialize, Serialize};
use shutter_curve::{Hz, ScheduleError, ShutterCurve};

/// A frame's last tick, counted from the edge: beyond it, wrapping ticks of 32 bits no longer tell past from future.
pub(crate) const LAST: f64 = (1u32 << 31) as f64;

/// How the flashes meet the shutter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "clap", value(rename_all = "snake_case"))]
#[serde(rename_all = "snake_case")]
pub enum SetUp {
    /// The camera's own shutter stays open, and the flashes make the exposure of the scene's curve
    Emulated,
    /// The scene's shutter is in the light's path, and dims the flashes
    InPath,
}

/// How a lamp exposes, which depends on the set-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lamp {
    /// It is triggered, and how long it shines is its own.
    Triggered,
    /// It shines for so many ticks around each trigger: equal pulses, for a curve that is emulated while the camera's
    /// own shutter stays open.
    Equal {
        /// The length of a pulse.
        ticks: u32,
    },
    /// It shines for this part, above 0 and at most 1, of each share of the exposure: the shutter, being in the light's
    /// path, lets equal doses through.
    Doses {
        /// That part.
        duty: f32,
    },
    /// It is triggered while the shutter, being in the light's path, is fully open: in equal steps, for flashes of one
    /// length.
    FullyOpen,
}

/// The plateau of a curve, in seconds from the start of opening.
pub struct FullyOpen {
    start: f64,
    from: f64,
    to: f64,
}

impl FullyOpen {
    /// Of a curve.
    pub fn new(curve: &ShutterCurve) -> Self {
        let [start, open, close] = [curve.open_start(), curve.open_end(), curve.close_start()].map(f64::from);
        Self { start, from: open - start, to: close - start }
    }

    fn after_start(&self, part: f64) -> f64 {
        self.from + part * self.length()
    }

    /// When such a part of it is over.
    pub fn time(&self, part: f64) -> f64 {
        self.start + self.after_start(part)
    }

    pub(crate) fn length(&self) -> f64 {
        self.to - self.from
    }

    /// The first tick and the last.
    pub(crate) fn ticks(&self, timer_hz: u32) -> (i64, i64) {
        let hz = f64::from(timer_hz);
        ((self.from * hz).ceil() as i64, (self.to * hz).floor() as i64)
    }
}

/// One trigger, in ticks after the shutter starts to open. Without pulses, `on` and `off` are the trigger's own tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flash {
    pub tick: u32,
    /// Below 0 where an equal pulse begins before the shutter opens.
    pub on: i64,
    pub off: i64,
}

impl Lamp {
    /// Has it pulses of the scene's own length?
    pub fn has_pulses(self) -> bool {
        matches!(self, Self::Equal { .. } | Self::Doses { .. })
    }

    /// A frame of `n` flashes.
    pub(crate) fn frame(self, curve: &ShutterCurve, n: u32, timer_hz: u32) -> Result<Vec<Flash>, ScheduleError> {
        let timed = curve.at(Hz(timer_hz))?.min_gap(0).min_pulse(0);
        let ticks = timed.trigger_ticks(n)?;
        let flash = |tick: u32, on: i64, off: i64| Flash { tick, on, off };
        let at = |tick: u32| flash(tick, tick.into(), tick.into());
        Ok(match self {
            Self::Triggered => ticks.map(at).collect(),
            Self::FullyOpen => {
                let plateau = FullyOpen::new(curve);
                let time = |i| plateau.after_start((f64::from(i) + 0.5) / f64::from(n));
                let tick = |i| (time(i) * f64::from(timer_hz)).round() as u32;
                (0..n).map(tick).map(at).collect()
            }
            Self::Equal { ticks: length } => ticks
                .map(|tick| {
                    let on = i64::from(tick) - i64::from(length / 2);
                    flash(tick, on, on + i64::from(length))
                })
                .collect(),
            Self::Doses { duty } => ticks
                .zip(timed.pulse_ticks(n, duty)?)
                .map(|(tick, pulse)| flash(tick, pulse.on.into(), pulse.off.into()))
                .collect(),
        })
    }
}
