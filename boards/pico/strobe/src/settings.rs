//! What a frame is planned from.

use core::fmt;

use shutter_curve::ShutterCurve;

use crate::curves::CURVES;
use crate::duration::Duration;
use crate::refused::Refused;

/// What a frame is planned from.
#[derive(Clone, PartialEq)]
pub struct Settings {
    /// The pulses of a frame.
    pub pulses: u32,
    /// Between two pulses, at least; in ticks. From start to start where they are equal, else from end to start.
    pub gap: u32,
    /// How long the lamp shines.
    pub light: Light,
    /// From the edge to the start of opening, in ticks.
    pub delay: u32,
    /// Which edge starts a frame.
    pub edge: Edge,
    /// How many frames it starts.
    pub frames: Frames,
    /// The curve.
    pub curve: Curve,
}

/// How long the lamp shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// From each trigger on for so many ticks.
    Equal(u32),
    /// For this part of each share: equal doses through a shutter that is in the light's path.
    Doses(f32),
}

/// Which edge starts a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
}

/// The frames of one edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frames {
    /// So many.
    pub count: u32,
    /// From the start of one to the start of the next, in ticks.
    pub period: u32,
}

impl Frames {
    /// A frame for each edge.
    pub const ONE: Self = Self { count: 1, period: 0 };
}

/// Where the curve is.
#[derive(Clone, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is no heap to put it on")]
pub enum Curve {
    /// In [`CURVES`].
    Stored(usize),
    /// Here, built at run time from numbers that are shown and saved: four, or twelve.
    Built(Numbers, ShutterCurve),
}

/// The numbers of a curve of one's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Numbers {
    /// Its times; the ramps are straight.
    Four([f32; 4]),
    /// Its times and inner control points.
    Twelve([f32; 12]),
}

impl Numbers {
    /// Each of them.
    pub fn get(&self) -> &[f32] {
        match self {
            Numbers::Four(numbers) => numbers,
            Numbers::Twelve(numbers) => numbers,
        }
    }

    /// Builds the curve, which takes a tenth of a second or two.
    pub(crate) fn build(self) -> Result<Curve, Refused> {
        let curve = match self {
            Numbers::Four([a, b, c, d]) => ShutterCurve::linear(a, b, c, d),
            Numbers::Twelve([a, b, c, d, inner @ ..]) => {
                ShutterCurve::shutteropening([a, b, c, d], inner)
            }
        };
        Ok(Curve::Built(self, curve.map_err(Refused::Curve)?))
    }
}

impl Curve {
    /// The curve itself.
    pub fn get(&self) -> &ShutterCurve {
        match self {
            Curve::Stored(i) => &CURVES[*i],
            Curve::Built(_, curve) => curve,
        }
    }
}

impl Settings {
    /// Everything, the numbers of a curve of one's own as well.
    pub fn in_full(&self) -> InFull<'_> {
        InFull(self)
    }

    fn write(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "n {}, gap {}, ", self.pulses, Duration(self.gap))?;
        match self.light {
            Light::Equal(length) => write!(out, "pulse {}, ", Duration(length))?,
            Light::Doses(duty) => write!(out, "duty {duty}, ")?,
        }
        let edge = match self.edge {
            Edge::Rising => "rising",
            Edge::Falling => "falling",
        };
        write!(out, "delay {}, edge {edge}, frames {}, ", Duration(self.delay), self.frames.count)?;
        if self.frames.count > 1 {
            write!(out, "every {}, ", Duration(self.frames.period))?;
        }
        out.write_str("curve")
    }
}

impl Default for Settings {
    /// Those that the controller starts with: 12 pulses of 2 µs through the soft shutter.
    fn default() -> Self {
        Self {
            pulses: 12,
            gap: 12_500,
            light: Light::Equal(250),
            delay: 0,
            edge: Edge::Rising,
            frames: Frames::ONE,
            curve: Curve::Stored(0),
        }
    }
}

impl fmt::Display for Settings {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(out)?;
        match self.curve {
            Curve::Stored(i) => write!(out, " {}", i + 1),
            Curve::Built(..) => out.write_str(" of its own"),
        }
    }
}

/// Settings with all their numbers, each with the digits that give it back.
pub struct InFull<'a>(&'a Settings);

impl fmt::Display for InFull<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(settings) = self;
        let Curve::Built(numbers, _) = &settings.curve else { return settings.fmt(out) };
        settings.write(out)?;
        numbers.get().iter().try_for_each(|number| write!(out, " {number:?}"))
    }
}
