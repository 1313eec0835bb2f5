//! What the firmware measures and the host reports: the curves, the inputs and their order.
#![no_std]

use shutter_curve::CubicBezier;

pub mod answers;
#[path = "../../../../tests/support/baseline.rs"]
pub mod baseline;

/// A curve of the reference data or found by search, with the inputs that the reference has for it and those
/// that a search finds hardest.
pub struct Curve {
    pub name: &'static str,
    /// As scenes hold it, by the reference data.
    pub is_typical: bool,
    pub opening: baseline::Ramp,
    pub closing: baseline::Ramp,
    /// The fractions at which its sections meet.
    pub ends: [f32; 2],
    pub hard: &'static [f32],
}

include!(concat!(env!("OUT_DIR"), "/curves.rs"));

/// The curves with a row each in the report, as the reader and as the data know them.
pub const ROWS: [(&str, &str); 3] =
    [("soft", "rman_soft"), ("all ramp", "raised_cosine"), ("box", "box")];

impl Curve {
    /// The curve of the data with this name.
    pub const fn index(name: &str) -> usize {
        let mut i = 0;
        while i < CURVES.len() {
            if same(CURVES[i].name, name) {
                return i;
            }
            i += 1;
        }
        panic!("no such curve");
    }

    pub const fn ramps(&self) -> (CubicBezier, CubicBezier) {
        (CubicBezier::new(self.opening), CubicBezier::new(self.closing))
    }

    /// The ramps on a scale of time.
    pub fn scaled(&self, scale: Option<u32>) -> (CubicBezier, CubicBezier) {
        let length = self.closing[3].0 - self.opening[0].0;
        let factor =
            scale.map_or(1.0, |k| f32::from_bits((254 + k - (length.to_bits() >> 23)) << 23));
        let ramp = |ramp: baseline::Ramp| CubicBezier::new(ramp.map(|(t, f)| (t * factor, f)));
        (ramp(self.opening), ramp(self.closing))
    }

    /// The hard inputs: those of the reference and of the search, the ends of the sections with six neighbours
    /// on either side, every power of two from either end, and fractions that are uniform on a logarithmic scale.
    pub fn hard_u(&self) -> impl Iterator<Item = f32> {
        let near_ends = self.ends.into_iter().flat_map(|end| {
            (0..=12u32).map(move |i| f32::from_bits((end.to_bits() + i).saturating_sub(6)).min(1.0))
        });
        let powers = (0..150)
            .map(|k| if k < 23 { 1 << (22 - k) } else { (150 - k) << 23 })
            .map(f32::from_bits);
        let mirrored = (1..25).map(|k| 1.0 - 1.0 / (1 << k) as f32);
        let spread = (0..SPREAD).flat_map(|i| {
            // Exponents from 2^-12 up.
            let u = f32::from_bits(((115 << 23) as f32 + (12 << 23) as f32 * uniform(i)) as u32);
            [u, 1.0 - u]
        });
        self.hard.iter().copied().chain(near_ends).chain(powers).chain(mirrored).chain(spread)
    }
}

const SPREAD: u32 = 128;

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

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
    Cdf,
    Opening,
    TickStep,
    Schedule,
    Construct,
    Newton,
    Table,
}

impl Function {
    pub const ALL: [Self; 8] = [
        Self::InverseCdf,
        Self::Cdf,
        Self::Opening,
        Self::TickStep,
        Self::Schedule,
        Self::Construct,
        Self::Newton,
        Self::Table,
    ];

    /// Its bit in a selection.
    pub const fn bit(self) -> u32 {
        1 << (4 + self as u32)
    }

    /// The name of the firmware's function with this call in it.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::InverseCdf => "measured_inverse_cdf",
            Self::Cdf => "measured_cdf",
            Self::Opening => "measured_opening",
            Self::TickStep => "measured_tick_step",
            Self::Schedule => "measured_schedule",
            Self::Construct => "measured_construct",
            Self::Newton => "measured_newton",
            Self::Table => "measured_table",
        }
    }
}

/// What a series of calls runs over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Inputs {
    /// Uniform inputs, on the row of [`ROWS`].
    Row(usize),
    /// The same on every typical curve of the reference data.
    Typical,
    /// The hard inputs of every curve.
    Hard,
    /// The same with intervals of so many ticks that every trigger is solved.
    Solved,
}

impl Inputs {
    /// The curves by their index in [`CURVES`].
    pub fn curves(self) -> impl Iterator<Item = usize> {
        (0..CURVES.len()).filter(move |index| match self {
            Self::Row(row) => *index == Curve::index(ROWS[row].1),
            Self::Typical => CURVES[*index].is_typical,
            Self::Hard | Self::Solved => true,
        })
    }

    /// Are they those that are likely to cost most?
    pub fn are_hard(self) -> bool {
        matches!(self, Self::Hard | Self::Solved)
    }

    /// The inputs on a curve, in order.
    pub fn us(self, curve: &Curve) -> impl Iterator<Item = f32> {
        let count = if self.are_hard() { 0 } else { UNIFORM };
        let hard = self.are_hard().then(|| curve.hard_u());
        (0..count).map(uniform).chain(hard.into_iter().flatten())
    }

    /// The frames whose first steps are measured on a curve, as how many triggers and how many steps: one
    /// of [`UNIFORM`], or one of [`TRIGGERS`] and for each hard input the one that starts nearest to it.
    pub fn frames(self, curve: &Curve) -> impl Iterator<Item = (u32, u32)> {
        let whole = if self.are_hard() { TRIGGERS } else { UNIFORM };
        let hard = self.are_hard().then(|| curve.hard_u()).into_iter().flatten();
        let first = hard.filter(|u| *u > 1.0 / u32::MAX as f32 && *u < 0.5);
        [(whole, whole)].into_iter().chain(first.map(|u| ((0.5 / u) as u32, 1)))
    }

    /// The bit in a selection of inputs of this kind.
    const fn bit(self) -> u32 {
        match self {
            Self::Row(_) => ON_ROWS,
            Self::Typical => ON_TYPICAL,
            Self::Hard | Self::Solved => ON_HARD,
        }
    }

    /// The scale of time for triggers, of [`SCALES`].
    pub const fn scale(self) -> usize {
        match self {
            Self::Row(_) => 0,
            Self::Typical | Self::Hard => 1,
            Self::Solved => 2,
        }
    }
}

/// The scales of time on which curves are built: as they are, and with intervals of 2ᵏ seconds up to twice that,
/// for the rate of the timer is the same for all.
pub const SCALES: [Option<u32>; 3] = [None, Some(0), Some(6)];

/// The triggers of a planned frame, and the timer's rate, for the rows' interval of one second.
pub const TRIGGERS: u32 = 64;
pub const TICK_HZ: u32 = 1_000_000;

/// The series in the order in which the firmware runs them, for each number of cells.
pub fn series() -> impl Iterator<Item = (Function, Inputs)> {
    use Function::*;
    let calls = [InverseCdf, Cdf, Opening, TickStep, Schedule];
    let rows =
        calls.into_iter().flat_map(|call| (0..ROWS.len()).map(move |row| (call, Inputs::Row(row))));
    let rows = rows.chain([(Construct, Inputs::Row(0))]);
    let typical = calls.into_iter().map(|call| (call, Inputs::Typical));
    let hard = calls.into_iter().map(|call| (call, Inputs::Hard));
    rows.chain(typical)
        .chain(hard)
        .chain([TickStep, Schedule].into_iter().map(|call| (call, Inputs::Solved)))
}

/// The series of the baselines, after all others.
pub fn baselines() -> impl Iterator<Item = (Function, Inputs)> {
    use Function::*;
    [Newton, Table]
        .into_iter()
        .flat_map(|call| (0..ROWS.len()).map(move |row| (call, Inputs::Row(row))))
        .chain([Newton, Table].into_iter().map(|call| (call, Inputs::Typical)))
        .chain([Newton, Table].into_iter().map(|call| (call, Inputs::Hard)))
}

/// The numbers of cells measured.
pub const CELLS: [usize; 4] = [0, 4, 8, 16];

/// The address at which the host places a selection of what to run: one bit a number of cells, one a function, and one a kind
/// of inputs; and a page behind it the curves. In RAM, above the statics and far below the stack.
pub const SELECTED: u32 = selected_at(cfg!(m33));
pub const REGION: u32 = SELECTED + PAGE;
pub const PAGE: u32 = 4096;

/// The same of the board with a Cortex-M33, or else of all others.
pub const fn selected_at(is_m33: bool) -> u32 {
    if is_m33 { 0x3810_0000 } else { 0x2010_0000 }
}

/// The kinds of inputs in a selection: those of the rows, of all typical curves, and the hard ones.
pub const ON_ROWS: u32 = 1 << 29;
pub const ON_TYPICAL: u32 = 1 << 30;
pub const ON_HARD: u32 = 1 << 31;

pub fn selected(selection: u32, function: Function, inputs: Inputs) -> bool {
    selection & function.bit() != 0 && selection & inputs.bit() != 0
}
