//! What runs on other processors and on the host: the curves, the inputs, and the calls that are counted.
#![no_std]

use shutter_curve::{CubicBezier, Hz, ShutterCurve};

pub mod answers;
#[path = "../../../baseline.rs"]
pub mod baseline;

/// A curve of the reference data, or a hard case.
pub struct Curve {
    pub opening: baseline::Ramp,
    pub closing: baseline::Ramp,
    pub hard: &'static [f32],
}

// `CURVES`, first those of `NAMES`, then the other typical ones; and `TYPICAL`, how many are as scenes hold them.
include!(concat!(env!("OUT_DIR"), "/curves.rs"));

/// The first of [`CURVES`] as the reader knows them.
pub const NAMES: [&str; 3] = ["soft", "all ramp", "trapezoid"];
pub const SOFT: usize = 0;
pub const ALL_RAMP: usize = 1;
pub const TRAPEZOID: usize = 2;

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

/// The `i`-th of numbers spread evenly over [0, 1): the golden ratio's multiples. Any first so many of them are as even
/// as can be.
pub fn uniform(i: u32) -> f32 {
    (i.wrapping_mul(0x9E37_79B9).wrapping_add(0x4F1B_BCDC) >> 8) as f32 / (1 << 24) as f32
}

macro_rules! functions {
    ($($function:ident $name:literal)*) => {
        /// A function whose calls are counted, of curves with 8 octaves where its name has no other number.
        ///
        /// `Static` is the inverse of a typical curve in a `static`, which the compiler sees, as firmware has it; the
        /// others call by a reference. `Sqrt...` are for straight ramps.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Function { $($function),* }
        /// Each as the reader knows it, the baselines before what builds a curve.
        pub const FUNCTIONS: &[(Function, &str)] = &[$((Function::$function, $name)),*];
    };
}
functions! {
    InverseCdf "`inverse_cdf`"
    Static "`inverse_cdf` of a `static`"
    InverseCdf0 "`inverse_cdf`, `OCTAVES = 0`"
    InverseCdf4 "`inverse_cdf`, `OCTAVES = 4`"
    Cdf "`cdf`"
    Openness "`openness`"
    Tick "a tick"
    Schedule "a schedule"
    NearerEnd "Newton, nearer end"
    Table "linear table of 256"
    SqrtLibm "`libm::sqrtf`"
    SqrtMicromath "`micromath` `sqrt`"
    SqrtFpu "the FPU's square root"
    Construct0 "building, `OCTAVES = 0`"
    Construct "building, `OCTAVES = 8`"
}

impl Function {
    pub fn is_for_straight_ramps(self) -> bool {
        matches!(self, Self::SqrtLibm | Self::SqrtMicromath | Self::SqrtFpu)
    }

    pub fn builds(self) -> bool {
        matches!(self, Self::Construct | Self::Construct0)
    }

    /// The bytes of a curve, or of what stands for it.
    pub fn data_bytes(self) -> usize {
        match self {
            Self::InverseCdf0 | Self::Construct0 => size_of::<ShutterCurve<0>>(),
            Self::InverseCdf4 => size_of::<ShutterCurve<4>>(),
            Self::NearerEnd => size_of::<baseline::NearerEnd>(),
            Self::Table => size_of::<baseline::InverseTable<256>>(),
            Self::SqrtLibm | Self::SqrtMicromath | Self::SqrtFpu => size_of::<baseline::StraightRamps>(),
            _ => size_of::<ShutterCurve>(),
        }
    }
}

/// The triggers of a schedule, and the timer's rate.
pub const TRIGGERS: u32 = 64;
pub const TICK_HZ: Hz = Hz(1_000_000);

/// A tick is counted in a frame of the most triggers that there are: the one next to the fraction.
pub const MOST_TRIGGERS: u32 = 1 << 22;

pub fn trigger(u: f32) -> u32 {
    ((u * MOST_TRIGGERS as f32) as u32).min(MOST_TRIGGERS - 1)
}

/// The most fractions of a series.
pub const MOST: usize = 1024;
