//! A frame's own units: time counts from the pulse's middle in pulses, the signal from the dark in light.

use crate::signal::{Coupling, Flicker, Hum, Signal};
use crate::trace::{Crossings, Frame, Trace};

/// What leads from a frame's units to seconds and the trace's own unit, and back.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    middle: f64,
    /// How many seconds the unit of time is.
    pub pulse: f64,
    dark: f64,
    light: f64,
}

impl Units {
    pub fn new(frame: &Frame, (dark, light): (f64, f64)) -> Self {
        let [_, rise, .., fall, _] = frame.crossings;
        Self { middle: 0.5 * (rise + fall), pulse: fall - rise, dark, light }
    }

    /// A time in pulses from one in seconds.
    fn time(&self, seconds: f64) -> f64 {
        (seconds - self.middle) / self.pulse
    }

    /// A frame's crossings in pulses.
    pub fn crossings(&self, frame: &Frame) -> Crossings {
        frame.crossings.map(|t| self.time(t))
    }

    /// A time in seconds from one in pulses.
    pub fn seconds(&self, t: f64) -> f64 {
        self.middle + self.pulse * t
    }

    /// A value in the trace's own unit from one in light.
    pub fn value(&self, share: f64) -> f64 {
        self.dark + self.light * share
    }

    /// A part of the trace in these units.
    pub fn inside(&self, part: Trace) -> Trace {
        let value = |v: f64| (v - self.dark) / self.light;
        Trace {
            times: part.times.into_iter().map(|t| self.time(t)).collect(),
            values: part.values.into_iter().map(value).collect(),
        }
    }

    /// A signal in seconds and the trace's unit; its drift and its hum count time from the pulse's middle.
    pub fn outside(&self, signal: &Signal) -> Signal {
        Signal {
            kind: signal.kind,
            curve: signal.curve.mapped(self.pulse, self.middle),
            dark: self.dark + self.light * signal.dark,
            gain: self.light * signal.gain,
            drift: signal.drift.map(|drift| drift * self.light / self.pulse),
            hum: signal.hum.map(|Hum { frequency, range, cosine, sine }| Hum {
                frequency: frequency / self.pulse,
                range: (range.0 / self.pulse, range.1 / self.pulse),
                cosine: cosine * self.light,
                sine: sine * self.light,
            }),
            flicker: signal.flicker.map(|lamp| Flicker { frequency: lamp.frequency / self.pulse, ..lamp }),
            coupling: signal.coupling.map(|Coupling { charge, rates, held }| Coupling {
                held,
                charge: charge * self.light,
                rates: rates.map(|rate| rate.map(|rate| rate / self.pulse)),
            }),
        }
    }
}
