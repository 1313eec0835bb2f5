//! All that is measured on one core.

use std::fs::{File, write};

use measured::{CURVE_BYTES, CURVES, Function, ROWS, Series, TICK_HZ, TRAPEZOID, TYPICAL};
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
        for is_hard in [false, true] {
            let curves = match (function, on, is_hard) {
                (_, On::Rows, true) | (Construct, _, true) => 0,
                (Construct, ..) => 1,
                (_, On::Rows, _) => ROWS.len(),
                (Static, ..) | (_, _, false) => TYPICAL,
                _ => CURVES.len(),
            };
            let curves = (0..curves).filter(|curve| !function.is_for_straight_ramps() || *curve == TRAPEZOID);
            all.extend(curves.map(|curve| Series { function, octaves, is_hard, curve }));
        }
    }
    all
}

/// A series, and what each of its calls took.
struct Ran {
    series: Series,
    calls: Vec<Call>,
}

impl Ran {
    fn mean(&self, of: fn(&Call) -> u32) -> f64 {
        self.calls.iter().map(|call| f64::from(of(call))).sum::<f64>() / self.calls.len() as f64
    }

    fn name(&self) -> &'static str {
        CURVES[self.series.curve].name
    }
}

pub struct Measured {
    pub name: &'static str,
    pub code: Disassembly,
    ran: Vec<Ran>,
}

/// Of a function with so many octaves; nothing where it was not measured.
impl Measured {
    pub fn new(core: Core, series: &[Series]) -> Result<Self> {
        eprintln!("measuring a {} ...", core.name);
        let has = |series: &&Series| series.function != SqrtFpu || core.has_fpu();
        let series: Vec<Series> = series.iter().filter(has).copied().collect();
        let elf = build(core, "cost")?;
        let (code, curves) = (Disassembly::of(core, &elf)?, output(core, &elf)?);
        if curves.len() != CURVE_BYTES.iter().sum::<usize>() * CURVES.len() {
            return Err("the firmware's curves are not of the size that they have here".into());
        }
        let input = elf.with_extension("input");
        let asked: Vec<u8> = series.iter().flat_map(|series| series.to_bytes()).collect();
        write(&input, [curves, asked].concat())?;
        let calls = replay(core, &elf, &code, File::open(&input)?)?;
        if calls.len() != series.iter().map(|series| series.calls()).sum::<usize>() {
            return Err("the firmware ran other series than planned".into());
        }
        let mut calls = calls.into_iter();
        let ran = series.into_iter().map(|series| Ran { series, calls: calls.by_ref().take(series.calls()).collect() });
        Ok(Self { name: core.name, code, ran: ran.collect() })
    }

    /// The series over hard inputs, or over uniform ones.
    fn over(&self, function: Function, octaves: usize, is_hard: bool) -> impl Iterator<Item = &Ran> {
        let key = (function, octaves, is_hard);
        self.ran.iter().filter(move |Ran { series: s, .. }| (s.function, s.octaves, s.is_hard) == key)
    }

    /// The mean over uniform inputs on one of the curves.
    pub fn cycles(&self, function: Function, curve: usize, octaves: usize) -> Option<f64> {
        Some(self.on(function, curve, octaves)?.mean(|call| call.cycles))
    }

    pub fn instructions(&self, function: Function, curve: usize, octaves: usize) -> Option<f64> {
        Some(self.on(function, curve, octaves)?.mean(|call| call.instructions))
    }

    fn on(&self, function: Function, curve: usize, octaves: usize) -> Option<&Ran> {
        self.over(function, octaves, false).find(|ran| ran.series.curve == curve)
    }

    /// The mean cycles over all typical curves, and the share of the calls whose answers took a search.
    pub fn typical(&self, function: Function, octaves: usize) -> Option<[f64; 2]> {
        let each = self.over(function, octaves, false).map(|ran| {
            let asked = asked(ran.series);
            let searched = asked.iter().filter(|(_, is_direct)| !is_direct).count();
            [ran.mean(|call| call.cycles), searched as f64 / asked.len() as f64]
        });
        let each: Vec<_> = each.collect();
        let mean = |i: usize| each.iter().map(|figures| figures[i]).sum::<f64>() / TYPICAL as f64;
        (each.len() == TYPICAL).then(|| [mean(0), mean(1)])
    }

    /// The most cycles of a call that was not searched for, over all curves with hard inputs, if they were measured,
    /// and the typical ones with uniform ones; with its curve and its fraction.
    pub fn worst_direct(&self, function: Function, octaves: usize) -> Option<(u32, String)> {
        self.over(function, octaves, true).next()?;
        let ran = [false, true].into_iter().flat_map(|is_hard| self.over(function, octaves, is_hard));
        let calls = ran.flat_map(|ran| {
            let calls = asked(ran.series).into_iter().zip(&ran.calls);
            calls.map(|((u, is_direct), call)| (is_direct, call.cycles, ran.name(), u))
        });
        let (_, cycles, name, u) = calls.filter(|call| call.0).max_by_key(|call| call.1)?;
        Some((cycles, format!("{name}, u = {u}")))
    }

    /// The most cycles of a call over the hard inputs on any curve, and the curve.
    pub fn worst(&self, function: Function, octaves: usize) -> Option<(u32, String)> {
        let calls = self.over(function, octaves, true).flat_map(|ran| ran.calls.iter().map(|call| (call, ran.name())));
        calls.map(|(call, name)| (call.cycles, name.into())).max()
    }

    pub fn code_bytes(&self, function: Function, octaves: usize) -> Option<u32> {
        Some(self.code.code_bytes(self.instance(function, octaves)?))
    }

    /// The stack of a call as the compiler says.
    pub fn stack_bytes(&self, function: Function, octaves: usize) -> Option<u32> {
        Some(self.code.stack_bytes(self.instance(function, octaves)?))
    }

    fn instance(&self, function: Function, octaves: usize) -> Option<u32> {
        Some(self.over(function, octaves, false).next()?.calls[0].called)
    }
}

/// The calls of a series, in order, as the host tells, whose answers have the same bits: each the fraction of the
/// exposure that it asked for, and whether a polynomial or the plateau's line answered it; none for functions other
/// than the inverse and the step of a frame's triggers.
fn asked(series: Series) -> Vec<(f64, bool)> {
    match series.octaves {
        0 => with::<0>(series),
        4 => with::<4>(series),
        _ => with::<8>(series),
    }
}

fn with<const OCTAVES: usize>(series: Series) -> Vec<(f64, bool)> {
    let (opening, closing) = CURVES[series.curve].ramps();
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
