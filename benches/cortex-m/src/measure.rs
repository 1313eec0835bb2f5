//! All that is measured on one core.

use std::cmp::Reverse;
use std::fs::{File, write};

use measured::Function::{self, InverseCdf, InverseCdf0, InverseCdf4, Schedule, SqrtFpu, Static, Tick};
use measured::{CURVES, MOST, MOST_TRIGGERS, TICK_HZ, TRAPEZOID, TYPICAL, trigger, uniform};
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::firmware::Core;
use crate::trace::{Call, Run};

/// A series of calls on one curve, and what each took.
struct Series {
    of: Function,
    curve: usize,
    is_hard: bool,
    us: Vec<f32>,
    calls: Vec<Call>,
    stack: u32,
}

pub struct Measured {
    pub name: &'static str,
    pub run: Run,
    series: Vec<Series>,
}

impl Measured {
    /// Of these functions on the first so many curves at uniform fractions, and of some on all at hard ones.
    pub fn new(core: Core, functions: &[Function], curves: usize, at_hard: &[Function]) -> Result<Self> {
        eprintln!("measuring a {} ...", core.name);
        let elf = core.build("cost")?;
        let built = core.output(&elf)?;
        let bytes = [InverseCdf, InverseCdf0, InverseCdf4].map(Function::data_bytes);
        if built.len() != bytes.iter().sum::<usize>() * CURVES.len() {
            return Err("the firmware's curves are not of the size that they have here".into());
        }
        let mut series = series(core, functions, curves, at_hard);
        let asked = series.iter().flat_map(|series| {
            let head = [series.of as u32, series.curve as u32, series.us.len() as u32];
            head.into_iter().chain(series.us.iter().map(|u| u.to_bits())).flat_map(u32::to_le_bytes)
        });
        let input = elf.with_extension("input");
        write(&input, built.into_iter().chain(asked).collect::<Vec<_>>())?;
        let run = Run::new(core, &elf, File::open(&input)?)?;
        let (mut calls, mut stacks) = (run.calls.iter().copied(), run.output.chunks_exact(4));
        for series in &mut series {
            series.calls = calls.by_ref().take(series.us.len()).collect();
            series.stack = u32::from_le_bytes(stacks.next().ok_or("the firmware ran fewer series")?.try_into()?);
        }
        if calls.next().is_some() || series.iter().any(|series| series.calls.len() != series.us.len()) {
            return Err("the firmware ran other calls than it was asked for".into());
        }
        Ok(Self { name: core.name, run, series })
    }

    fn all(&self, of: Function) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(move |series| series.of == of)
    }

    /// The mean instructions, and on a Cortex-M4F cycles, at uniform fractions of a curve; nothing where they were not
    /// measured.
    pub fn mean(&self, of: Function, curve: usize) -> Option<[f64; 2]> {
        let calls = &self.all(of).find(|series| series.curve == curve && !series.is_hard)?.calls;
        let mean = |of: fn(&Call) -> u32| calls.iter().map(|c| f64::from(of(c))).sum::<f64>() / calls.len() as f64;
        Some([mean(|call| call.instructions), mean(|call| call.cycles)])
    }

    /// The most cycles of a call at hard fractions of any curve, or of one that took no search.
    pub fn worst(&self, of: Function, is_direct: bool) -> Option<u32> {
        let calls = self.all(of).filter(|series| series.is_hard).flat_map(|series| {
            let direct = if is_direct { direct(series) } else { vec![true; series.us.len()] };
            series.calls.iter().zip(direct).filter(|(_, counts)| *counts).map(|(call, _)| call.cycles)
        });
        calls.max()
    }

    /// The bytes of the functions that it ran, with their literals.
    pub fn code(&self, of: Function) -> Option<u32> {
        Some(self.run.ran[&self.all(of).next()?.calls[0].called].values().sum())
    }

    /// The most bytes of stack.
    pub fn stack(&self, of: Function) -> Option<u32> {
        self.all(of).map(|series| series.stack).max()
    }
}

fn series(core: Core, functions: &[Function], curves: usize, at_hard: &[Function]) -> Vec<Series> {
    let mut all = Vec::new();
    for &of in functions.iter().filter(|function| **function != SqrtFpu || core.has_fpu()) {
        let hard_curves = match of {
            _ if !at_hard.contains(&of) || of.builds() => 0,
            Static => TYPICAL,
            _ => CURVES.len(),
        };
        for (is_hard, curves) in [(false, if of.builds() { 1 } else { curves }), (true, hard_curves)] {
            for curve in (0..curves).filter(|curve| !of.is_for_straight_ramps() || *curve == TRAPEZOID) {
                let us = match of {
                    _ if of.builds() || of == Schedule => vec![0.0],
                    _ if is_hard => hard(curve, of),
                    _ => (0..512).map(uniform).collect(),
                };
                all.push(Series { of, curve, is_hard, us, calls: Vec::new(), stack: 0 });
            }
        }
    }
    all
}

/// The hard fractions of a curve, and those of 20 000 towards either end for which the mass is evaluated most often.
fn hard(place: usize, of: Function) -> Vec<f32> {
    let tails = (0..20_000).map(|i| uniform(i) * 2f32.powf(-24.0 * i as f32 / 20_000.0));
    let mut us: Vec<_> = tails.enumerate().map(|(i, u)| if i % 2 == 0 { u } else { 1.0 - u }).collect();
    match of {
        InverseCdf0 => sort::<0>(&mut us, place),
        InverseCdf4 => sort::<4>(&mut us, place),
        _ => sort::<8>(&mut us, place),
    }
    us.truncate(32);
    us.extend(CURVES[place].hard);
    us.truncate(MOST);
    us
}

fn curve<const OCTAVES: usize>(curve: usize) -> ShutterCurve<OCTAVES> {
    let (opening, closing) = CURVES[curve].ramps();
    ShutterCurve::with_octaves(opening, closing).expect("a good curve")
}

/// By how often the mass is evaluated for each, falling.
fn sort<const OCTAVES: usize>(us: &mut [f32], place: usize) {
    let curve = curve::<OCTAVES>(place);
    us.sort_by_cached_key(|u| Reverse(curve.steps(*u)));
}

/// Which answers of a series came without a search, as the host tells, whose answers have the same bits; none of other
/// functions than the inverse and a tick.
fn direct(series: &Series) -> Vec<bool> {
    let curve = curve::<8>(series.curve);
    let frame = curve.at(TICK_HZ).and_then(|timed| timed.min_gap(0).trigger_ticks(MOST_TRIGGERS)).expect("a good rate");
    let direct = series.us.iter().map(|u| match series.of {
        InverseCdf | Static => curve.steps(*u).is_none(),
        Tick => frame.is_direct(trigger(*u)),
        _ => false,
    });
    direct.collect()
}

/// Of 100 answers on typical curves, those that take a search.
pub fn searched() -> f64 {
    let of = |place| {
        let curve = curve::<8>(place);
        (0..512).filter(|i| curve.steps(uniform(*i)).is_some()).count()
    };
    (0..TYPICAL).map(of).sum::<usize>() as f64 / (5.12 * TYPICAL as f64)
}
