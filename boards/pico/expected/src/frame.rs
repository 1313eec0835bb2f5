//! What an edge has to start: the pulses by the crate's ticks on this machine, apart from the controller's own planning.

use serde_json::{Value, json};
use shutter_curve::ShutterCurve;
use strobe::TICK_HZ;

/// How long the lamp shines.
#[derive(Clone, Copy)]
pub enum Light {
    /// So many ticks from each trigger on.
    Equal(u32),
    /// This part of each share.
    Doses(f32),
}

/// What is armed: the settings of a frame, as the script knows them.
#[derive(Clone, Copy)]
pub struct Frame<'a> {
    pub curve: &'a ShutterCurve,
    pub pulses: u32,
    pub gap: u32,
    pub light: Light,
    pub delay: u32,
    pub falls: bool,
    /// How many, and how far apart.
    pub frames: (u32, u32),
}

impl<'a> Frame<'a> {
    /// One frame of equal pulses.
    pub fn new(curve: &'a ShutterCurve, pulses: u32, gap: u32, length: u32) -> Self {
        let light = Light::Equal(length);
        Self { curve, pulses, gap, light, delay: 0, falls: false, frames: (1, 0) }
    }

    /// With pulses of another length.
    pub fn lit(self, length: u32) -> Self {
        Self { light: Light::Equal(length), ..self }
    }

    /// When each pulse starts, counted from the edge, and how long it is; for the emulator.
    pub fn value(&self) -> Value {
        let frame: Vec<(u32, u32)> = match self.light {
            Light::Equal(length) => {
                let ticks = self.curve.trigger_ticks(self.pulses, TICK_HZ).unwrap();
                ticks.map(|tick| (tick, length)).collect()
            }
            Light::Doses(duty) => {
                let pulses = self.curve.pulse_ticks(self.pulses, duty, TICK_HZ).unwrap();
                pulses.map(|pulse| (pulse.on, pulse.off - pulse.on)).collect()
            }
        };
        let (count, period) = self.frames;
        let bases = (0..count).map(|i| self.delay + i * period);
        let all: Vec<_> = bases
            .flat_map(|base| frame.iter().map(move |(on, length)| (base + on, *length)))
            .collect();
        let (ticks, lengths): (Vec<u32>, Vec<u32>) = all.into_iter().unzip();
        let is_dark = matches!(self.light, Light::Doses(_));
        json!({
            "ticks": ticks, "lengths": lengths, "gap": self.gap, "gapIsDark": is_dark, "falls": self.falls,
        })
    }
}
