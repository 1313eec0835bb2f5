//! All that is measured of one build: a core and a seed.

use std::collections::BTreeMap;

use ::firmware::{CELLS, CURVES, Function, Inputs};

use crate::disassembly::Disassembly;
use crate::firmware::{Core, Flavour, M4F, build, output};
use crate::searched::asked;
use crate::trace::{Call, Key, Selection, Trace, trace};

pub struct Measured {
    pub code: Disassembly,
    calls: BTreeMap<Key, Vec<Call>>,
    instance: BTreeMap<(Function, usize), u32>,
    /// By function and cells.
    painted: BTreeMap<(Function, usize), u32>,
    pub curve_bytes: BTreeMap<usize, u32>,
}

/// What the calls of a function cost on a typical curve, over uniform inputs.
pub struct Typical {
    pub name: &'static str,
    pub cycles: Spread,
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

impl Measured {
    /// Builds for a core with a seed and traces each selection; the stack is looked at on a Cortex-M4F alone, since in soft
    /// float that takes longer than all else.
    pub fn new(core: Core, seed: &'static str, selections: &[Selection]) -> Result<Self, String> {
        let elf = build(core, "cost", Flavour::fast(seed))?;
        let code = Disassembly::of(core, &elf)?;
        let (mut calls, mut instance) = (BTreeMap::new(), BTreeMap::new());
        for selection in selections {
            let Trace { calls: more, instance: and, .. } =
                trace(core, &elf, &code, selection, None)?;
            calls.extend(more);
            instance.extend(and);
        }
        let (painted, curve_bytes) =
            if core == M4F { stack(core, seed)? } else { Default::default() };
        Ok(Self { code, calls, instance, painted, curve_bytes })
    }

    pub fn calls(&self, key: &Key) -> &[Call] {
        self.calls.get(key).map_or(&[], Vec::as_slice)
    }

    pub fn cycles(&self, key: &Key) -> Option<Spread> {
        Spread::new(self.calls(key).iter().map(|call| call.cycles).collect())
    }

    pub fn instructions(&self, key: &Key) -> Option<Spread> {
        Spread::new(self.calls(key).iter().map(|call| call.instructions).collect())
    }

    /// A function's calls on each typical curve.
    pub fn typical(&self, function: Function, cells: usize) -> Vec<Typical> {
        let curves = Inputs::Typical.curves().filter_map(|curve| {
            let key = Key { function, cells, inputs: Inputs::Typical, curve };
            let cycles = self.cycles(&key)?;
            let asked = asked(&key);
            let searched = asked.iter().filter(|asked| asked.searched).count();
            Some(Typical {
                name: CURVES[curve].name,
                cycles,
                searched: searched as f64 / asked.len() as f64,
            })
        });
        curves.collect()
    }

    /// The mean over all typical curves.
    pub fn typical_mean(&self, function: Function, cells: usize) -> Option<f64> {
        let curves = self.typical(function, cells);
        let total: f64 = curves.iter().map(|curve| curve.cycles.mean).sum();
        (!curves.is_empty()).then(|| total / curves.len() as f64)
    }

    /// The most cycles of a call that was not searched for, over all curves with hard inputs and the typical ones with uniform
    /// ones, too; with its curve and its fraction.
    pub fn worst_direct(&self, function: Function, cells: usize) -> Option<(u32, String)> {
        let keys = self.calls.keys().filter(|key| {
            let is_measured = key.function == function && key.cells == cells;
            is_measured && matches!(key.inputs, Inputs::Typical | Inputs::Hard)
        });
        let calls = keys.flat_map(|key| {
            let calls = asked(key).into_iter().zip(self.calls(key));
            calls.map(|(asked, call)| (call.cycles, key.curve, asked))
        });
        let direct = calls.filter(|(.., asked)| !asked.searched);
        let (cycles, curve, asked) = direct.max_by_key(|(cycles, ..)| *cycles)?;
        Some((cycles, format!("{}, u = {}", CURVES[curve].name, asked.u)))
    }

    /// The most cycles of a call over the hard curves and these inputs, and the curve.
    pub fn worst(
        &self,
        function: Function,
        inputs: Inputs,
        cells: usize,
    ) -> Option<(u32, &'static str)> {
        let hard = self.calls.iter().filter(|(key, _)| {
            key.inputs == inputs && key.function == function && key.cells == cells
        });
        hard.flat_map(|(key, calls)| calls.iter().map(|call| (call.cycles, CURVES[key.curve].name)))
            .max()
    }

    pub fn code_bytes(&self, function: Function, cells: usize) -> Option<u32> {
        Some(self.code.code_bytes(*self.instance.get(&(function, cells))?))
    }

    /// The stack of a call as the compiler says.
    pub fn stack_said(&self, function: Function, cells: usize) -> Option<u32> {
        Some(self.code.stack_bytes(*self.instance.get(&(function, cells))?))
    }

    /// The stack of a call as painted, and as the compiler says.
    pub fn stack(&self, function: Function, cells: usize) -> Option<(u32, u32)> {
        let instance = self.instance.get(&(function, cells))?;
        Some((*self.painted.get(&(function, cells))?, self.code.stack_bytes(*instance)))
    }
}

type Stack = (BTreeMap<(Function, usize), u32>, BTreeMap<usize, u32>);

/// Two lines a number of cells: `bytes 8 1376`, and the depth of each function.
fn stack(core: Core, seed: &'static str) -> Result<Stack, String> {
    let output = output(core, &build(core, "stack", Flavour::fast(seed))?)?;
    let output = String::from_utf8_lossy(&output);
    let numbers =
        output.lines().map(|line| line.split_whitespace().filter_map(|n| n.parse().ok()).collect());
    let lines: Vec<Vec<u32>> = numbers.collect();
    let (mut painted, mut bytes) = (BTreeMap::new(), BTreeMap::new());
    for (cells, lines) in CELLS.into_iter().zip(lines.chunks(2)) {
        let [size, depths] = lines else { return Err(format!("stack: {output}")) };
        bytes.insert(cells, *size.last().ok_or("stack: no size")?);
        painted.extend(Function::ALL.iter().zip(depths).map(|(f, depth)| ((*f, cells), *depth)));
    }
    Ok((painted, bytes))
}
