//! What the firmware measures and the host reports: the calls, the curves, the inputs and their order.
#![no_std]

use shutter_curve::{CubicBezier, ShutterCurve};

pub mod answers;
#[path = "../../../baseline.rs"]
pub mod baseline;

/// A curve of the reference data, or a hard case.
pub struct Curve {
    pub name: &'static str,
    pub opening: baseline::Ramp,
    pub closing: baseline::Ramp,
    /// The hard inputs; see `hardest`.
    pub hard: &'static [f32],
}

// `CURVES`, first those with rows of their own in the report, and `TYPICAL`: so many of them are as scenes hold them,
// by the reference data; these are the first, too.
include!(concat!(env!("OUT_DIR"), "/curves.rs"));

impl Curve {
    /// The ramps in an interval of a second up to twice that, as the timer's rate is the same for all: a power of two
    /// changes no other bit of a time.
    pub fn ramps(&self) -> (CubicBezier, CubicBezier) {
        let exponent = (self.closing[3].0 - self.opening[0].0).to_bits() >> 23;
        let factor = f32::from_bits((254 - exponent) << 23);
        let ramp = |ramp: baseline::Ramp| CubicBezier::new(ramp.map(|(t, f)| (t * factor, f)));
        (ramp(self.opening), ramp(self.closing))
    }

    /// As if its ramps were straight.
    pub fn straight(&self) -> baseline::StraightRamps {
        let ([a, .., b], [c, .., d]) = (self.opening, self.closing);
        baseline::StraightRamps::new([a, b, c, d].map(|(t, _)| t))
    }
}

/// The first of [`CURVES`] as the reader knows them.
pub const ROWS: [&str; 4] = ["soft", "all ramp", "trapezoid", "box"];

/// The place of the one with straight ramps.
pub const TRAPEZOID: usize = 2;

/// Uniform inputs a series.
pub const UNIFORM: u32 = 512;

/// The `i`-th of numbers spread evenly over [0, 1): the golden ratio's multiples, the first so many of
/// which are as even as can be, whatever their number.
pub fn uniform(i: u32) -> f32 {
    (i.wrapping_mul(0x9E37_79B9).wrapping_add(0x4F1B_BCDC) >> 8) as f32 / (1 << 24) as f32
}

macro_rules! functions {
    ($($name:ident)*) => {
        /// A function whose calls are measured.
        ///
        /// `Static` is the inverse of a curve in a `static`, which the compiler sees, as firmware has it; the others
        /// call by a reference. `Sqrt...` are for straight ramps.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Function { $($name),* }
        const ALL: &[Function] = &[$(Function::$name),*];
    };
}
functions! { InverseCdf Static Cdf Openness TickStep Schedule Construct NearerEnd Table SqrtLibm SqrtMicromath SqrtFpu }

impl Function {
    pub fn is_for_straight_ramps(self) -> bool {
        matches!(self, Self::SqrtLibm | Self::SqrtMicromath | Self::SqrtFpu)
    }
}

/// A series of calls on one curve.
#[derive(Clone, Copy)]
pub struct Series {
    pub function: Function,
    /// What has no octaves counts as having [`DEFAULT`].
    pub octaves: usize,
    /// On the hard inputs of any curve, or on uniform ones on a typical curve.
    pub is_hard: bool,
    pub curve: usize,
}

impl Series {
    /// As the host tells the firmware of it.
    pub fn to_bytes(self) -> [u8; 4] {
        let Self { function, octaves, is_hard, curve } = self;
        [function as u8, octaves as u8, is_hard as u8, curve as u8]
    }

    pub fn from_bytes(bytes: [u8; 4]) -> Self {
        let [function, octaves, is_hard, curve] = bytes.map(usize::from);
        Self { function: ALL[function], octaves, is_hard: is_hard == 1, curve }
    }

    /// How many calls it makes.
    pub fn calls(self) -> usize {
        match self.function {
            Function::Construct | Function::Schedule => 1,
            Function::TickStep => self.frames().map(|(_, steps)| steps as usize).sum(),
            _ => self.us().count(),
        }
    }

    /// The fractions that are asked for, in order.
    pub fn us(self) -> impl Iterator<Item = f32> {
        let (count, hard) = if self.is_hard { (0, CURVES[self.curve].hard) } else { (UNIFORM, &[][..]) };
        (0..count).map(uniform).chain(hard.iter().copied())
    }

    /// The frames whose first steps are measured, as how many triggers and how many steps: one of [`UNIFORM`], or one
    /// of [`TRIGGERS`] and for each hard input the one that starts nearest to it.
    pub fn frames(self) -> impl Iterator<Item = (u32, u32)> {
        let whole = if self.is_hard { TRIGGERS } else { UNIFORM };
        // A frame has at most 2²² triggers.
        let first = self.us().filter(move |u| self.is_hard && (1.0 / (1 << 23) as f32..0.5).contains(u));
        core::iter::once((whole, whole)).chain(first.map(|u| ((0.5 / u) as u32, 1)))
    }
}

/// The triggers of a planned frame, and the timer's rate.
pub const TRIGGERS: u32 = 64;
pub const TICK_HZ: u32 = 1_000_000;

/// The numbers of octaves measured, and the crate's default.
pub const OCTAVES: [usize; 3] = [0, 4, 8];
pub const DEFAULT: usize = 8;

/// The bytes of a curve with each of them.
pub const CURVE_BYTES: [usize; 3] =
    [size_of::<ShutterCurve<0>>(), size_of::<ShutterCurve<4>>(), size_of::<ShutterCurve<8>>()];
