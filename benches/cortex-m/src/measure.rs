//! All that is measured on one core.

use measured::{CURVES, Function, Inputs, SCALES, Series, TICK_HZ};
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::disassembly::Disassembly;
use crate::firmware::{Core, build, output};
use crate::trace::{Call, Trace};

pub struct Measured {
    pub name: &'static str,
    pub code: Disassembly,
    pub trace: Trace,
}

/// What the calls of a function cost on a typical curve, over uniform inputs.
pub struct Typical {
    pub name: &'static str,
    pub mean: f64,
    /// The share of the calls whose answers took a search.
    pub searched: f64,
}

/// Of the calls of a series.
#[derive(Clone, Copy)]
pub struct Spread {
    pub min: u32,
    pub median: u32,
    pub mean: f64,
    pub most: u32,
    pub max: u32,
}

impl Spread {
    fn new(mut values: Vec<u32>) -> Option<Self> {
        values.sort_unstable();
        let (n, total) = (values.len(), values.iter().map(|v| f64::from(*v)).sum::<f64>());
        Some(Self {
            min: *values.first()?,
            median: values[n / 2],
            mean: total / n as f64,
            most: values[(n * 99 / 100).min(n - 1)],
            max: *values.last()?,
        })
    }
}

/// The series of a function over uniform inputs on one of the rows.
pub fn on_row(function: Function, row: usize, cells: usize) -> Series {
    Series { function, cells, inputs: Inputs::Uniform, curve: row }
}

impl Measured {
    pub fn new(core: Core, level: &str, selections: &[u32]) -> Result<Self> {
        eprintln!("measuring a {} ...", core.name);
        let elf = build(core, "cost", level)?;
        let (code, built) = (Disassembly::of(core, &elf)?, output(core, &elf)?);
        let mut trace = Trace::default();
        for selection in selections {
            trace.add(core, &elf, &code, &built, *selection)?;
        }
        Ok(Self { name: core.name, code, trace })
    }

    pub fn cycles(&self, series: Series) -> Option<Spread> {
        self.spread(series, |call| call.cycles)
    }

    pub fn instructions(&self, series: Series) -> Option<Spread> {
        self.spread(series, |call| call.instructions)
    }

    fn spread(&self, series: Series, of: fn(&Call) -> u32) -> Option<Spread> {
        Spread::new(self.trace.calls.get(&series)?.iter().map(of).collect())
    }

    /// A function's series over some inputs, with their calls.
    fn series(
        &self,
        function: Function,
        inputs: Inputs,
        cells: usize,
    ) -> impl Iterator<Item = (&Series, &Vec<Call>)> {
        let is = move |s: &Series| (s.function, s.inputs, s.cells) == (function, inputs, cells);
        self.trace.calls.iter().filter(move |(series, _)| is(series))
    }

    /// A function's calls on each typical curve.
    pub fn typical(&self, function: Function, cells: usize) -> Vec<Typical> {
        let all = self.series(function, Inputs::Uniform, cells).filter_map(|(series, _)| {
            let asked = asked(*series);
            let searched = asked.iter().filter(|(_, is_searched)| *is_searched).count();
            let searched = searched as f64 / asked.len() as f64;
            let (name, mean) = (CURVES[series.curve].name, self.cycles(*series)?.mean);
            Some(Typical { name, mean, searched })
        });
        all.collect()
    }

    /// The mean of the cycles over all typical curves.
    pub fn typical_mean(&self, function: Function, cells: usize) -> Option<f64> {
        self.over_typical(function, cells, |call| call.cycles)
    }

    /// The mean of the instructions.
    pub fn typical_instructions(&self, function: Function, cells: usize) -> Option<f64> {
        self.over_typical(function, cells, |call| call.instructions)
    }

    fn over_typical(&self, function: Function, cells: usize, of: fn(&Call) -> u32) -> Option<f64> {
        let means = self.series(function, Inputs::Uniform, cells);
        let means: Vec<f64> = means.filter_map(|(s, _)| Some(self.spread(*s, of)?.mean)).collect();
        (!means.is_empty()).then(|| means.iter().sum::<f64>() / means.len() as f64)
    }

    /// The most cycles of a call that was not searched for, over all curves with hard inputs and the typical ones with uniform
    /// ones, too; with its curve and its fraction.
    pub fn worst_direct(&self, function: Function, cells: usize) -> Option<(u32, String)> {
        let of = |inputs| self.series(function, inputs, cells);
        let calls = of(Inputs::Uniform).chain(of(Inputs::Hard)).flat_map(|(series, calls)| {
            let calls = asked(*series).into_iter().zip(calls);
            calls.map(|((u, is_searched), call)| (call.cycles, series.curve, u, is_searched))
        });
        let direct = calls.filter(|(.., is_searched)| !is_searched);
        let (cycles, curve, u, _) = direct.max_by_key(|(cycles, ..)| *cycles)?;
        Some((cycles, format!("{}, u = {u}", CURVES[curve].name)))
    }

    /// The most cycles of a call over all curves and these hard inputs, and the curve.
    pub fn worst(
        &self,
        function: Function,
        inputs: Inputs,
        cells: usize,
    ) -> Option<(u32, &'static str)> {
        let calls = self.series(function, inputs, cells).flat_map(|(series, calls)| {
            calls.iter().map(|call| (call.cycles, CURVES[series.curve].name))
        });
        calls.max()
    }

    /// The same over all hard inputs.
    pub fn worst_of_all(&self, function: Function, cells: usize) -> Option<(u32, &'static str)> {
        let worst = [Inputs::Hard, Inputs::Solved].map(|i| self.worst(function, i, cells));
        worst.into_iter().flatten().max()
    }

    pub fn code_bytes(&self, function: Function, cells: usize) -> Option<u32> {
        Some(self.code.code_bytes(self.instance(function, cells)?))
    }

    /// The stack of a call as the compiler says.
    pub fn stack_said(&self, function: Function, cells: usize) -> Option<u32> {
        Some(self.code.stack_bytes(self.instance(function, cells)?))
    }

    /// The same as painted.
    pub fn stack_painted(&self, function: Function, cells: usize) -> Option<u32> {
        self.trace.painted.get(&(function, cells)).copied().filter(|depth| *depth > 0)
    }

    fn instance(&self, function: Function, cells: usize) -> Option<u32> {
        let mut all = self.trace.instances.iter();
        all.find(|(s, _)| (s.function, s.cells) == (function, cells)).map(|(_, address)| *address)
    }
}

/// The calls of a series, in order, as the host tells, whose answers have the same bits: each the fraction of the exposure that
/// it asked for, and whether the answer took more than a polynomial or the plateau's line; none for functions other than the
/// inverse and the step of a frame's triggers.
fn asked(series: Series) -> Vec<(f64, bool)> {
    match series.cells {
        0 => with::<0>(series),
        4 => with::<4>(series),
        8 => with::<8>(series),
        _ => with::<16>(series),
    }
}

fn with<const CELLS: usize>(series: Series) -> Vec<(f64, bool)> {
    let (opening, closing) = CURVES[series.curve].ramps(SCALES[series.scale()]);
    let curve = ShutterCurve::<CELLS>::with_cells(opening, closing).expect("a good curve");
    match series.function {
        Function::InverseCdf | Function::Static => {
            series.us().map(|u| (u.into(), !curve.is_direct(u))).collect()
        }
        Function::TickStep => {
            let steps = series.frames().flat_map(|(n, steps)| {
                let frame = curve.trigger_ticks(n, TICK_HZ).expect("a good rate");
                let u = move |i| (2.0 * f64::from(i) + 1.0) / (2.0 * f64::from(n));
                (0..steps).map(move |i| (u(i), !frame.is_direct(i)))
            });
            steps.collect()
        }
        _ => Vec::new(),
    }
}
