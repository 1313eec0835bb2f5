//! What a frame is planned from.

use core::fmt;

use shutter_curve::ShutterCurve;

use crate::change::{Change, Refused};
use crate::curves::CURVES;
use crate::duration::Duration;

/// What a frame is planned from.
#[derive(Clone, PartialEq)]
pub struct Settings {
    /// The pulses of a frame.
    pub pulses: u32,
    /// From the start of a pulse to the start of the next, at least; in ticks.
    pub gap: u32,
    /// The length of a pulse, in ticks.
    pub length: u32,
    /// The curve.
    pub curve: Curve,
}

/// Where the curve is.
#[derive(Clone, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is no heap to put it on")]
pub enum Curve {
    /// In [`CURVES`].
    Stored(usize),
    /// Here, built at run time.
    Built(ShutterCurve),
}

impl Curve {
    /// The curve itself.
    pub fn get(&self) -> &ShutterCurve {
        match self {
            Curve::Stored(i) => &CURVES[*i],
            Curve::Built(curve) => curve,
        }
    }
}

impl Settings {
    /// These settings with a change. It may build a curve, which takes a tenth of a second or two.
    ///
    /// # Errors
    /// Numbers that are not a curve.
    pub fn with(&self, change: Change) -> Result<Self, Refused> {
        let mut settings = self.clone();
        match change {
            Change::Pulses(pulses) => settings.pulses = pulses,
            Change::Gap(gap) => settings.gap = gap,
            Change::Length(length) => settings.length = length,
            Change::Stored(i) => settings.curve = Curve::Stored(i),
            Change::Built([a, b, c, d, inner @ ..]) => {
                let curve = ShutterCurve::shutteropening([a, b, c, d], inner);
                settings.curve = Curve::Built(curve.map_err(Refused::Curve)?);
            }
        }
        Ok(settings)
    }
}

impl Default for Settings {
    /// Those that the controller starts with: 12 pulses of 2 µs through the soft shutter.
    fn default() -> Self {
        Self { pulses: 12, gap: 12_500, length: 250, curve: Curve::Stored(0) }
    }
}

impl fmt::Display for Settings {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "n {}, gap {}, pulse {}, ",
            self.pulses,
            Duration(self.gap),
            Duration(self.length)
        )?;
        match self.curve {
            Curve::Stored(i) => write!(out, "curve {}", i + 1),
            Curve::Built(_) => out.write_str("curve of its own"),
        }
    }
}
