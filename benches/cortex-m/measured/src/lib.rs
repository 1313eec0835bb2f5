//! What the firmware measures and the host reports: the calls, the curves, the inputs and their order.
#![no_std]

use shutter_curve::CubicBezier;

pub mod answers;
#[path = "../../../../tests/support/baseline.rs"]
pub mod baseline;
#[cfg(feature = "cost")]
pub mod roots;

/// A curve of the reference data or found by search.
pub struct Curve {
    pub name: &'static str,
    /// As scenes hold it, by the reference data.
    pub is_typical: bool,
    pub opening: baseline::Ramp,
    pub closing: baseline::Ramp,
    /// The hard inputs; see `hardest`.
    pub hard: &'static [f32],
}

include!(concat!(env!("OUT_DIR"), "/curves.rs"));

/// The places of the typical ones in [`CURVES`].
pub const TYPICAL: [usize; 15] = {
    let (mut places, mut found, mut i) = ([0; 15], 0, 0);
    while i < CURVES.len() {
        if CURVES[i].is_typical {
            places[found] = i;
            found += 1;
        }
        i += 1;
    }
    assert!(found == places.len());
    places
};

impl Curve {
    /// The ramps, on a scale of time.
    pub fn ramps(&self, scale: Option<u32>) -> (CubicBezier, CubicBezier) {
        let length = self.closing[3].0 - self.opening[0].0;
        let factor =
            scale.map_or(1.0, |k| f32::from_bits((254 + k - (length.to_bits() >> 23)) << 23));
        let ramp = |ramp: baseline::Ramp| CubicBezier::new(ramp.map(|(t, f)| (t * factor, f)));
        (ramp(self.opening), ramp(self.closing))
    }
}

/// The curves with rows of their own in the report, as the reader knows them: the first of [`CURVES`].
pub const ROWS: [&str; 3] = ["soft", "all ramp", "box"];

/// Uniform inputs a series.
pub const UNIFORM: u32 = 512;

/// The `i`-th of numbers spread evenly over [0, 1): the golden ratio's multiples, the first so many of
/// which are as even as can be, whatever their number.
pub fn uniform(i: u32) -> f32 {
    (i.wrapping_mul(0x9E37_79B9).wrapping_add(0x4F1B_BCDC) >> 8) as f32 / (1 << 24) as f32
}

/// A function whose calls are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    InverseCdf,
    /// The inverse of a curve in a `static`, which the compiler sees, as firmware has it; the others call by a reference.
    Static,
    Cdf,
    Opening,
    TickStep,
    Schedule,
    Construct,
    Newton,
    Table,
    Root,
}

impl Function {
    pub const ALL: [Self; 10] = {
        use Function::*;
        [InverseCdf, Static, Cdf, Opening, TickStep, Schedule, Construct, Newton, Table, Root]
    };

    /// Its bit in a selection.
    pub const fn bit(self) -> u32 {
        1 << (4 + self as u32)
    }
}

/// What a series of calls runs over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Inputs {
    /// Uniform inputs, on a typical curve.
    Uniform,
    /// The hard inputs of any curve.
    Hard,
    /// The same with intervals of so many ticks that every trigger is solved.
    Solved,
}

/// A series of calls on one curve; of [`Function::Root`] on no curve, but in one of so many [`WAYS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Series {
    pub function: Function,
    /// What has no cells counts as having [`DEFAULT`].
    pub cells: usize,
    pub inputs: Inputs,
    pub curve: usize,
}

impl Series {
    fn is_selected(self, selection: u32) -> bool {
        use Function::{Construct, Newton, Root, Schedule, Static, Table, TickStep};
        let Self { function, cells, inputs, curve } = self;
        let exists = match function {
            Root => inputs == Inputs::Uniform && cells == DEFAULT && curve < WAYS,
            Construct => inputs == Inputs::Uniform && curve == 0,
            Static => inputs != Inputs::Solved && cells == DEFAULT && CURVES[curve].is_typical,
            TickStep | Schedule => true,
            Newton | Table => inputs != Inputs::Solved && cells == DEFAULT,
            _ => inputs != Inputs::Solved,
        };
        let kind = match inputs {
            Inputs::Hard | Inputs::Solved => ON_HARD,
            Inputs::Uniform if function == Root || curve < ROWS.len() => ON_ROWS | ON_TYPICAL,
            Inputs::Uniform if CURVES[curve].is_typical => ON_TYPICAL,
            Inputs::Uniform => 0,
        };
        let cells = 1 << CELLS.iter().position(|c| *c == cells).unwrap_or(CELLS.len());
        let has = |bits| selection & bits != 0;
        exists && has(kind) && has(cells) && has(function.bit())
    }

    /// The fractions that are asked for, in order.
    pub fn us(self) -> impl Iterator<Item = f32> {
        let (count, hard) = match self.inputs {
            Inputs::Uniform => (UNIFORM, &[][..]),
            Inputs::Hard | Inputs::Solved => (0, CURVES[self.curve].hard),
        };
        (0..count).map(uniform).chain(hard.iter().copied())
    }

    /// The frames whose first steps are measured, as how many triggers and how many steps: one of [`UNIFORM`], or one of
    /// [`TRIGGERS`] and for each hard input the one that starts nearest to it.
    pub fn frames(self) -> impl Iterator<Item = (u32, u32)> {
        let is_hard = self.inputs != Inputs::Uniform;
        let whole = if is_hard { TRIGGERS } else { UNIFORM };
        let first = self.us().filter(move |u| is_hard && *u > 1.0 / u32::MAX as f32 && *u < 0.5);
        core::iter::once((whole, whole)).chain(first.map(|u| ((0.5 / u) as u32, 1)))
    }

    /// The curve's scale of time, of [`SCALES`].
    pub fn scale(self) -> usize {
        match (self.function, self.inputs) {
            (Function::TickStep | Function::Schedule, Inputs::Solved) => 2,
            (Function::TickStep | Function::Schedule, _) => 1,
            _ => 0,
        }
    }
}

/// The ways to a root that are measured, which are in `roots`.
pub const WAYS: usize = 12;

/// The scales of time on which curves are built: as they are, and with intervals of 2ᵏ seconds up to twice that,
/// for the rate of the timer is the same for all.
pub const SCALES: [Option<u32>; 3] = [None, Some(0), Some(6)];

/// The triggers of a planned frame, and the timer's rate.
pub const TRIGGERS: u32 = 64;
pub const TICK_HZ: u32 = 1_000_000;

/// The numbers of cells measured, the first four bits of a selection, and the crate's default.
pub const CELLS: [usize; 4] = [0, 4, 8, 16];
pub const DEFAULT: usize = 8;

/// The kinds of inputs in a selection: uniform ones on the rows and on all typical curves, and the hard ones.
pub const ON_ROWS: u32 = 1 << 29;
pub const ON_TYPICAL: u32 = 1 << 30;
pub const ON_HARD: u32 = 1 << 31;

/// The series that are selected, in the order in which the firmware runs them.
pub fn series(selection: u32) -> impl Iterator<Item = Series> {
    let of_cells = |cells| Function::ALL.into_iter().map(move |function| (cells, function));
    let inputs = [Inputs::Uniform, Inputs::Hard, Inputs::Solved];
    let all = CELLS.into_iter().flat_map(of_cells).flat_map(move |(cells, function)| {
        inputs.into_iter().flat_map(move |inputs| {
            (0..CURVES.len()).map(move |curve| Series { function, cells, inputs, curve })
        })
    });
    all.filter(move |series| series.is_selected(selection))
}
