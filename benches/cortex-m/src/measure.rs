//! All that is measured on one core.

use measured::{CURVES, DEFAULT, Function, Inputs, ROWS, Series};

use crate::Result;
use crate::disassembly::Disassembly;
use crate::firmware::Core;
use crate::searched::asked;
use crate::trace::{Call, Program, Trace};

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
    Series { function, cells, inputs: Inputs::Uniform, curve: ROWS[row].1 }
}

impl Measured {
    pub fn new(core: Core, selections: &[u32]) -> Result<Self> {
        eprintln!("measuring a {} ...", core.name);
        let (program, mut trace) = (Program::new(core)?, Trace::default());
        for selection in selections {
            program.trace(&mut trace, *selection, None)?;
        }
        Ok(Self { name: core.name, code: program.code, trace })
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

    /// The mean over all typical curves.
    pub fn typical_mean(&self, function: Function, cells: usize) -> Option<f64> {
        let means = self.series(function, Inputs::Uniform, cells);
        let means: Vec<f64> = means.filter_map(|(s, _)| Some(self.cycles(*s)?.mean)).collect();
        (!means.is_empty()).then(|| means.iter().sum::<f64>() / means.len() as f64)
    }

    /// The most cycles of a call that was not searched for, with the default cells, over all curves with hard inputs and the
    /// typical ones with uniform ones, too; with its curve and its fraction.
    pub fn worst_direct(&self, function: Function) -> Option<(u32, String)> {
        let of = |inputs| self.series(function, inputs, DEFAULT);
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

    /// The same over all hard inputs, with the default cells.
    pub fn worst_of_all(&self, function: Function) -> Option<(u32, &'static str)> {
        let worst = [Inputs::Hard, Inputs::Solved].map(|i| self.worst(function, i, DEFAULT));
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
