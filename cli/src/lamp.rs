//! What a lamp does in a frame: flashes at the triggers, equal pulses around them, or pulses of equal doses.

use shutter_curve::{ScheduleError, ShutterCurve};

/// How a lamp exposes, which depends on the set-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lamp {
    /// It is triggered, and how long it shines is its own.
    Triggered,
    /// It shines for so many ticks around each trigger: equal pulses, for a curve that is emulated while the camera's own
    /// shutter stays open.
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
    /// A frame of `n` flashes.
    pub(crate) fn frame(
        self,
        curve: &ShutterCurve,
        n: u32,
        timer_hz: u32,
    ) -> Result<Vec<Flash>, ScheduleError> {
        let ticks = curve.trigger_ticks(n, timer_hz)?;
        let flash = |tick: u32, on: i64, off: i64| Flash { tick, on, off };
        Ok(match self {
            Self::Triggered => ticks.map(|tick| flash(tick, tick.into(), tick.into())).collect(),
            Self::Equal { ticks: length } => ticks
                .map(|tick| {
                    let on = i64::from(tick) - i64::from(length / 2);
                    flash(tick, on, on + i64::from(length))
                })
                .collect(),
            Self::Doses { duty } => ticks
                .zip(curve.pulse_ticks(n, duty, timer_hz)?)
                .map(|(tick, pulse)| flash(tick, pulse.on.into(), pulse.off.into()))
                .collect(),
        })
    }
}
