//! All that is measured on one core.

use std::fs::{File, write};

use measured::{CURVE_BYTES, CURVES, Function, Inputs, ROWS, SCALES, Series, TICK_HZ, TRAPEZOID, TYPICAL};
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::disassembly::Disassembly;
use crate::firmware::{Core, build, output};
use crate::trace::{Call, replay};

use Function::{Construct, InverseCdf, SqrtFpu, Static, TickStep};

/// What functions are measured on.
#[derive(Clone, Copy, PartialEq)]
pub enum On {
    /// Uniform inputs, on the curves with rows of their own.
    Rows,
    /// All that there is: hard inputs on all curves, too.
    All,
}

/// The series of these functions, with each of these numbers of octaves.
pub fn series(functions: &[Function], octaves: &[usize], on: On) -> Vec<Series> {
    let mut all = Vec::new();
    for (function, octaves) in functions.iter().flat_map(|f| octaves.iter().map(|c| (*f, *c))) {
        // Of uniform inputs, and of hard ones.
        let curves = match function {
            Construct => [1, 0],
            Static => [TYPICAL, TYPICAL],
            _ => [TYPICAL, CURVES.len()],
        };
        let most = match on {
            On::Rows => [ROWS.len(), 0],
            On::All => curves,
        };
        for (i, inputs) in Inputs::ALL.into_iter().enumerate() {
            let curves = 0..curves[i].min(most[i]);
            let serves = |curve: &usize| !function.is_for_straight_ramps() || *curve == TRAPEZOID;
            let curves = curves.filter(serves);
            all.extend(curves.map(|curve| Series { function, octaves, inputs, curve }));
        }
    }
    all
}

/// A series, and what each of its calls took.
pub struct Ran {
    pub series: Series,
    pub calls: Vec<Call>,
}

/// How what the calls of a series took is spread.
pub struct Spread {
    pub mean: f64,
    pub max: u32,
}

impl Ran {
    /// The curve's.
    pub fn name(&self) -> &'static str {
        CURVES[self.series.curve].name
    }

    pub fn cycles(&self) -> Spread {
        self.spread(|call| call.cycles)
    }

    pub fn instructions(&self) -> Spread {
        self.spread(|call| call.instructions)
    }

    fn spread(&self, of: fn(&Call) -> u32) -> Spread {
        let values = self.calls.iter().map(of);
        let total: f64 = values.clone().map(f64::from).sum();
        Spread { mean: total / values.len() as f64, max: values.max().unwrap_or(0) }
    }

    /// The share of the calls whose answers took a search.
    pub fn searched(&self) -> f64 {
        let asked = asked(self.series);
        asked.iter().filter(|(_, is_direct)| !is_direct).count() as f64 / asked.len() as f64
    }
}

pub struct Measured {
    pub name: &'static str,
    pub code: Disassembly,
    ran: Vec<Ran>,
}

impl Measured {
    pub fn new(core: Core, level: &str, series: &[Series]) -> Result<Self> {
        eprintln!("measuring a {} ...", core.name);
        let has = |series: &&Series| series.function != SqrtFpu || core.has_fpu();
        let series: Vec<Series> = series.iter().filter(has).copied().collect();
        let elf = build(core, "cost", level)?;
        let (code, curves) = (Disassembly::of(core, &elf)?, output(core, &elf)?);
        if curves.len() != CURVE_BYTES.iter().sum::<usize>() * CURVES.len() * SCALES.len() {
            return Err("the firmware's curves are not of the size that they have here".into());
        }
        let input = elf.with_extension("input");
        let asked: Vec<u8> = series.iter().flat_map(|series| series.to_bytes()).collect();
        write(&input, [curves, asked].concat())?;
        let (calls, printed) = replay(core, &elf, &code, Some(File::open(&input)?))?;
        let planned: usize = series.iter().map(|series| series.calls()).sum();
        if calls.len() != planned {
            return Err(format!("the firmware ran other series than planned\n{printed}").into());
        }
        let mut calls = calls.into_iter();
        let ran = series.into_iter().map(|series| {
            let calls = calls.by_ref().take(series.calls()).collect();
            Ran { series, calls }
        });
        Ok(Self { name: core.name, code, ran: ran.collect() })
    }

    /// A function's series over some inputs.
    pub fn over(&self, function: Function, inputs: Inputs, octaves: usize) -> impl Iterator<Item = &Ran> {
        let key = (function, inputs, octaves);
        self.ran.iter().filter(move |Ran { series: s, .. }| (s.function, s.inputs, s.octaves) == key)
    }

    /// The one over uniform inputs on one of the curves.
    pub fn on(&self, function: Function, curve: usize, octaves: usize) -> Option<&Ran> {
        self.over(function, Inputs::Uniform, octaves).find(|ran| ran.series.curve == curve)
    }

    /// The mean over all typical curves, if it is measured on them.
    pub fn typical(&self, function: Function, octaves: usize, of: fn(&Ran) -> Spread) -> Option<f64> {
        let means = self.over(function, Inputs::Uniform, octaves).map(|ran| of(ran).mean);
        let (count, sum) = means.fold((0, 0.0), |(count, sum), mean| (count + 1, sum + mean));
        (count == TYPICAL as u32).then(|| sum / f64::from(count))
    }

    /// The most cycles of a call that was not searched for, over all curves with hard inputs, if they were measured,
    /// and the typical ones with uniform ones; with its curve and its fraction.
    pub fn worst_direct(&self, function: Function, octaves: usize) -> Option<(u32, String)> {
        self.over(function, Inputs::Hard, octaves).next()?;
        let ran = [Inputs::Uniform, Inputs::Hard].into_iter().flat_map(|i| self.over(function, i, octaves));
        let calls = ran.flat_map(|ran| {
            let calls = asked(ran.series).into_iter().zip(&ran.calls);
            calls.map(|((u, is_direct), call)| (is_direct, call.cycles, ran.name(), u))
        });
        let (_, cycles, name, u) = calls.filter(|call| call.0).max_by_key(|call| call.1)?;
        Some((cycles, format!("{name}, u = {u}")))
    }

    /// The most cycles of a call over the hard inputs on any curve, and the curve.
    pub fn worst(&self, function: Function, octaves: usize) -> Option<(u32, &'static str)> {
        let curves = self.over(function, Inputs::Hard, octaves);
        curves.map(|ran| (ran.cycles().max, ran.name())).max()
    }

    pub fn code_bytes(&self, function: Function, octaves: usize) -> Option<u32> {
        Some(self.code.code_bytes(self.instance(function, octaves)?))
    }

    /// The stack of a call as the compiler says.
    pub fn stack_bytes(&self, function: Function, octaves: usize) -> Option<u32> {
        Some(self.code.stack_bytes(self.instance(function, octaves)?))
    }

    fn instance(&self, function: Function, octaves: usize) -> Option<u32> {
        Some(self.over(function, Inputs::Uniform, octaves).next()?.calls[0].called)
    }
}

/// The calls of a series, in order, as the host tells, whose answers have the same bits: each the fraction of the
/// exposure that it asked for, and whether a polynomial or the plateau's line answered it; none for functions other
/// than the inverse and the step of a frame's triggers.
fn asked(series: Series) -> Vec<(f64, bool)> {
    match series.octaves {
        0 => with::<0>(series),
        4 => with::<4>(series),
        8 => with::<8>(series),
        _ => with::<16>(series),
    }
}

fn with<const OCTAVES: usize>(series: Series) -> Vec<(f64, bool)> {
    let (opening, closing) = CURVES[series.curve].ramps(series.is_scaled());
    let curve = ShutterCurve::<OCTAVES>::with_octaves(opening, closing).expect("a good curve");
    match series.function {
        InverseCdf | Static => series.us().map(|u| (u.into(), curve.is_direct(u))).collect(),
        TickStep => {
            let steps = series.frames().flat_map(|(n, steps)| {
                let frame = curve.trigger_ticks(n, TICK_HZ).expect("a good rate");
                let u = move |i| (2.0 * f64::from(i) + 1.0) / (2.0 * f64::from(n));
                (0..steps).map(move |i| (u(i), frame.is_direct(i)))
            });
            steps.collect()
        }
        _ => Vec::new(),
    }
}
