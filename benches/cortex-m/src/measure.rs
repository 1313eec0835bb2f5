//! All that is measured on one core.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fs::{File, write};

use measured::{CURVE_BYTES, CURVES, DEFAULT, Function, MOST, MOST_TRIGGERS, TICK_HZ, TRAPEZOID, TYPICAL};
use measured::{trigger, uniform};
use shutter_curve::ShutterCurve;

use crate::Result;
use crate::firmware::Core;
use crate::support::curves::Rng;
use crate::trace::{Call, Run, run};

use Function::{Construct, InverseCdf, Schedule, SqrtFpu, Static, Tick};

/// A function with so many octaves; what has none counts as having [`DEFAULT`].
pub type Of = (Function, usize);

/// A series of calls on one curve, and what each took.
struct Series {
    of: Of,
    curve: usize,
    is_hard: bool,
    us: Vec<f32>,
    calls: Vec<Call>,
    stack: u32,
}

pub struct Measured {
    pub name: &'static str,
    /// The bytes of `.data` and `.bss`.
    pub statics: u64,
    series: Vec<Series>,
    ran: std::collections::HashMap<u32, BTreeMap<u32, u32>>,
}

impl Measured {
    /// Of these functions on the first so many curves at uniform fractions, and of some on all at hard ones.
    pub fn new(core: Core, functions: &[Of], curves: usize, at_hard: &[Of]) -> Result<Self> {
        eprintln!("measuring a {} ...", core.name);
        let elf = core.build("cost")?;
        let built = core.output(&elf)?;
        if built.len() != CURVE_BYTES.iter().sum::<usize>() * CURVES.len() {
            return Err("the firmware's curves are not of the size that they have here".into());
        }
        let mut series = series(core, functions, curves, at_hard);
        let asked = series.iter().flat_map(|series| {
            let head = [series.of.0 as u32, series.of.1 as u32, series.curve as u32, series.us.len() as u32];
            head.into_iter().chain(series.us.iter().map(|u| u.to_bits())).flat_map(u32::to_le_bytes)
        });
        let input = elf.with_extension("input");
        write(&input, built.into_iter().chain(asked).collect::<Vec<_>>())?;
        let Run { calls, ran, output, statics } = run(core, &elf, File::open(&input)?)?;
        let (mut calls, mut stacks) = (calls.into_iter(), output.chunks_exact(4));
        for series in &mut series {
            series.calls = calls.by_ref().take(series.us.len()).collect();
            series.stack = u32::from_le_bytes(stacks.next().ok_or("the firmware ran fewer series")?.try_into()?);
        }
        if calls.next().is_some() || series.iter().any(|series| series.calls.len() != series.us.len()) {
            return Err("the firmware ran other calls than it was asked for".into());
        }
        Ok(Self { name: core.name, statics, series, ran })
    }

    fn all(&self, of: Of) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(move |series| series.of == of)
    }

    /// The mean instructions, and on a Cortex-M4F cycles, at uniform fractions of a curve; nothing where they were not
    /// measured.
    pub fn mean(&self, of: Of, curve: usize) -> Option<[f64; 2]> {
        let calls = &self.all(of).find(|series| series.curve == curve && !series.is_hard)?.calls;
        let mean = |of: fn(&Call) -> u32| calls.iter().map(|c| f64::from(of(c))).sum::<f64>() / calls.len() as f64;
        Some([mean(|call| call.instructions), mean(|call| call.cycles)])
    }

    /// The most cycles of a call at hard fractions of any curve, or of one that took no search.
    pub fn worst(&self, of: Of, is_direct: bool) -> Option<u32> {
        let calls = self.all(of).filter(|series| series.is_hard).flat_map(|series| {
            let direct = if is_direct { direct(series) } else { vec![true; series.us.len()] };
            series.calls.iter().zip(direct).filter(|(_, counts)| *counts).map(|(call, _)| call.cycles)
        });
        calls.max()
    }

    /// The bytes of the functions that it ran, with their literals.
    pub fn code(&self, of: Of) -> Option<u32> {
        Some(self.ran[&self.all(of).next()?.calls[0].called].values().sum())
    }

    /// The most bytes of stack.
    pub fn stack(&self, of: Of) -> Option<u32> {
        self.all(of).map(|series| series.stack).max()
    }
}

fn series(core: Core, functions: &[Of], curves: usize, at_hard: &[Of]) -> Vec<Series> {
    let mut all = Vec::new();
    for &(function, octaves) in functions.iter().filter(|(function, _)| *function != SqrtFpu || core.has_fpu()) {
        for is_hard in [false, true].into_iter().filter(|is_hard| !is_hard || at_hard.contains(&(function, octaves))) {
            let curves = match (is_hard, function) {
                (false, Construct) => 0..1,
                (false, _) => 0..curves,
                (true, Construct) => 0..0,
                (true, Static) => 0..TYPICAL,
                (true, _) => 0..CURVES.len(),
            };
            let is_straight = function.is_for_straight_ramps();
            for curve in curves.filter(|curve| !is_straight || *curve == TRAPEZOID) {
                let us = match (function, is_hard) {
                    (Construct | Schedule, _) => vec![0.0],
                    (_, false) => (0..512).map(uniform).collect(),
                    (_, true) => hard(curve, octaves),
                };
                all.push(Series { of: (function, octaves), curve, is_hard, us, calls: Vec::new(), stack: 0 });
            }
        }
    }
    all
}

/// The hard fractions of a curve, and those for which the mass is evaluated most often: the first few of 20 000, and of
/// those around them, ever nearer.
fn hard(curve: usize, octaves: usize) -> Vec<f32> {
    let evaluations: Box<dyn Fn(f32) -> u32> = match octaves {
        0 => evaluations::<0>(curve),
        4 => evaluations::<4>(curve),
        _ => evaluations::<8>(curve),
    };
    let mut rng = Rng::new(0, 0);
    let tail = |rng: &mut Rng| (rng.unit() * 2f64.powf(-24.0 * rng.unit())) as f32;
    let hard = CURVES[curve].hard.to_vec();
    let mut us: Vec<_> = (0..20_000).map(|i| if i % 2 == 0 { tail(&mut rng) } else { 1.0 - tail(&mut rng) }).collect();
    us.extend(&hard);
    for reach in [65536.0, 8192.0, 1024.0, 128.0, 16.0, 0.0] {
        us.sort_by_cached_key(|u| (Reverse(evaluations(*u)), u.to_bits()));
        us.dedup();
        us.truncate(32);
        let around = us.iter().flat_map(|u| [*u; 400]).map(|u| {
            let steps = rng.between(-reach, reach) as i32;
            f32::from_bits(u.to_bits().saturating_add_signed(steps))
        });
        let around: Vec<f32> = around.filter(|u| *u <= 1.0).collect();
        us.extend(around);
    }
    us.truncate(32);
    us.extend(hard);
    us.truncate(MOST);
    us
}

fn curve<const OCTAVES: usize>(curve: usize) -> ShutterCurve<OCTAVES> {
    let (opening, closing) = CURVES[curve].ramps();
    ShutterCurve::with_octaves(opening, closing).expect("a good curve")
}

fn evaluations<const OCTAVES: usize>(place: usize) -> Box<dyn Fn(f32) -> u32> {
    let curve = curve::<OCTAVES>(place);
    Box::new(move |u| curve.evaluations(u))
}

/// Which answers of a series came without a search, as the host tells, whose answers have the same bits; none of other
/// functions than the inverse and a tick.
fn direct(series: &Series) -> Vec<bool> {
    let curve = curve::<DEFAULT>(series.curve);
    let frame = curve.at(TICK_HZ).and_then(|timed| timed.min_gap(0).trigger_ticks(MOST_TRIGGERS)).expect("a good rate");
    let direct = series.us.iter().map(|u| match series.of {
        (InverseCdf | Static, DEFAULT) => curve.is_direct(*u),
        (Tick, DEFAULT) => frame.is_direct(trigger(*u)),
        _ => false,
    });
    direct.collect()
}

/// Of 100 answers on typical curves, those that take a search.
pub fn searched() -> f64 {
    let of = |place| {
        let curve = curve::<DEFAULT>(place);
        (0..512).filter(|i| !curve.is_direct(uniform(*i))).count()
    };
    (0..TYPICAL).map(of).sum::<usize>() as f64 / (5.12 * TYPICAL as f64)
}
