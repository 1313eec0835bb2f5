//! What a fit is asked for, and what comes out.

use crate::curve::Exposure;
use crate::delay::{Delay, Sync};
use crate::errors::Measured;
use crate::signal::{Kind, Signal};
use crate::trace::{Frame, Light, Pulses, Reading, Refusal, Timing, Trace, Warning};
use crate::unit::Unit;

/// What a fit is asked for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The curve's kind; chosen without.
    pub model: Option<Kind>,
    /// The signal of a shutter that is fully open, the dark level included, in the trace's unit.
    pub full: Option<f64>,
    /// Which pulse, from 1; the one of median exposure without.
    pub frame: Option<usize>,
    /// Which way light moves the signal.
    pub light: Light,
    /// How many triggers are judged and planned: 1 to [`crate::MOST_TRIGGERS`], clamped to that; 16 without.
    pub triggers: Option<u32>,
    /// The mains' frequency in hertz, where that is known: a hum has it.
    pub mains: Option<f64>,
    /// The edge of the camera's sync, where that is known.
    pub sync: Option<Sync>,
    /// What is known of the trace's times.
    pub timing: Timing,
}

/// A kind's best curve.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The signal, times in seconds, levels in the trace's unit; a drift and a hum count time from the pulse's middle.
    pub signal: Signal,
    /// The root of the mean square of what the samples are missed by, as a share of the light.
    pub rms: f64,
    /// Schwarz's criterion, above the least of all kinds.
    pub delta_bic: f64,
    /// The most that a trigger lies from that of the freest kind, in seconds.
    pub shift: f64,
}

/// Why a kind was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason {
    /// It was asked for.
    Asked,
    /// Schwarz's criterion took a simpler one, which does not explain the trace; this is the simplest that does.
    Explains,
    /// Schwarz's criterion is least.
    Criterion {
        /// So many samples count as independent.
        effective: f64,
    },
}

/// The pulses of the trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// So many whole ones.
    pub count: usize,
    /// The one that was fitted, from 1.
    pub fitted: usize,
    /// The standard deviation of their exposures, as a share of their mean.
    pub scatter: f64,
}

impl Frames {
    pub(super) fn new(frames: &[Frame], fitted: usize) -> Self {
        let n = frames.len() as f64;
        let mean = frames.iter().map(|frame| frame.exposure).sum::<f64>() / n;
        let squares: f64 = frames.iter().map(|frame| (frame.exposure / mean - 1.0).powi(2)).sum();
        let scatter = if frames.len() > 1 { (squares / (n - 1.0)).sqrt() } else { 0.0 };
        Self { count: frames.len(), fitted: fitted + 1, scatter }
    }
}

/// The peak of a signal as a share of full light, where the signal of full light is given; else 1.
pub(super) fn peak(full: Option<f64>, pulses: &Pulses, best: &Candidate) -> Result<f64, Refusal> {
    let Some(given) = full else { return Ok(1.0) };
    let Signal { dark, gain, .. } = best.signal;
    let peak = gain / (pulses.turned(given) - dark);
    // The noise may have put the peak a little above.
    if !(peak > 0.0 && peak <= 1.0 + best.rms) {
        return Err(Refusal::FullTooLow { given, seen: pulses.turned(dark + gain) });
    }
    Ok(peak.min(1.0))
}

/// What exposure and triggers are taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum From {
    /// The chosen model, which explains the trace.
    Model,
    /// The samples themselves, since it does not.
    Trace,
}

/// Whether the chosen model explains the trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Test {
    /// It does.
    pub explained: bool,
    /// There is enough dark beside the pulse to know the noise by.
    pub tested: bool,
    /// By how many standard deviations the most telling of the tests is off.
    pub sigma: f64,
    /// A dip, a slope or a tail below this share of the light may not be seen.
    pub unseen: f64,
    /// The greatest structure that is left, as a share of the light.
    pub share: f64,
    /// When that is, in seconds.
    pub at: f64,
}

/// What came out.
#[derive(Clone)]
pub struct Fit {
    /// Every kind, simplest first.
    pub candidates: Vec<Candidate>,
    /// The chosen one among them.
    pub chosen: Kind,
    /// Why that.
    pub reason: Reason,
    /// In seconds; of full light where that was given.
    pub exposure: Measured,
    /// The exposure by the time from the start of opening to the end of closing, as far as the curve shows that.
    pub efficiency: Measured,
    /// How long the curve opens, is fully open, and closes, in seconds: a tester's T1 to T3.
    pub parts: [Measured; 3],
    /// When the shutter starts to open, in seconds: with the curve, or with light that comes before it.
    pub opens: f64,
    /// From the edge of the camera's sync to the start of opening, where the edge is known.
    pub delay: Option<Delay>,
    /// The times in seconds by which (i + 1/2)/n of the exposure is collected.
    pub triggers: Vec<Measured>,
    /// What these are taken from.
    pub from: From,
    /// The chosen model's own, wherever those are taken from.
    pub model_exposure: Measured,
    /// The same of its triggers.
    pub model_triggers: Vec<Measured>,
    /// Does the chosen model explain the trace?
    pub test: Test,
    /// The peak as a share of full light, where that was given; else 1.
    pub peak: f64,
    /// The place of the record that holds the fitted pulse, among those that were given.
    pub record: usize,
    /// The pulses of all records.
    pub frames: Frames,
    /// What the exposure is called, in seconds, where whoever knows that says so.
    pub nominal: Option<f64>,
    /// How the trace was read, where whoever read it says so.
    pub reading: Option<Reading>,
    /// What is doubtful.
    pub warnings: Vec<Warning>,
    /// The samples that were fitted: times in seconds, light upwards.
    pub samples: Trace,
    /// Does light lower the signal as it was measured?
    pub inverted: bool,
    /// When a drift is 0, and from when a hum's phase counts.
    pub(super) middle: f64,
}

impl Fit {
    /// The chosen candidate.
    pub fn best(&self) -> &Candidate {
        &self.candidates[self.chosen as usize]
    }

    /// The most that the efficiency may be, in 39 of 40 traces: blades may start more softly than any curve shows. None
    /// where straight ramps, which have no soft start, are the best model and explain the trace.
    pub fn most_efficiency(&self) -> Option<f64> {
        let is_best = self.best().delta_bic <= 0.0 && self.test.explained;
        let is_straight = self.chosen <= Kind::Trapezoid && is_best;
        let Measured { value, error } = self.efficiency;
        (!is_straight).then_some((value + 1.96 * error).min(1.0))
    }

    /// Is every result a number, and each error one that says something?
    pub(super) fn is_determined(&self) -> bool {
        let sound = |m: &Measured| m.value.is_finite() && m.error.is_finite() && m.error >= 0.0;
        let length = self.best().signal.curve.length();
        let signals = self.candidates.iter().map(|candidate| candidate.signal);
        [self.exposure, self.efficiency].iter().chain(&self.triggers).all(sound)
            && self.exposure.value > 0.0
            && self.efficiency.value <= 1.0
            && length > 0.0
            && signals.into_iter().all(|s| s.gain > 0.0 && s.gain.is_finite() && s.dark.is_finite())
    }

    /// When the chosen curve reaches half of the light, and when it leaves it, in seconds.
    pub fn half_light(&self) -> [f64; 2] {
        Exposure::new(&self.best().signal.curve).between(0.5)
    }

    /// How long the chosen curve takes from 10 to 90 % of the light, and back, in seconds.
    pub fn rise_and_fall(&self) -> [f64; 2] {
        let exposure = Exposure::new(&self.best().signal.curve);
        let [[rises, falls], [rose, fell]] = [0.1, 0.9].map(|openness| exposure.between(openness));
        [rose - rises, falls - fell]
    }

    /// The fitted signal at a time in seconds, light upwards.
    pub fn value(&self, t: f64) -> f64 {
        let signal = &self.best().signal;
        let Signal { curve, dark, gain, drift, hum, .. } = *signal;
        let since = t - self.middle;
        let hum = hum.map_or(0.0, |hum| hum.at(since));
        let lamp = signal.lamp(since, 0.0);
        dark + gain * lamp * Exposure::new(&curve).openness(t) + drift.unwrap_or(0.0) * since + hum
    }

    /// A value with light upwards as it was measured.
    pub fn as_measured(&self, value: f64) -> f64 {
        if self.inverted { -value } else { value }
    }

    /// The unit that its times are told in.
    pub fn unit(&self) -> Unit {
        Unit::fit(self.best().signal.curve.length())
    }
}
