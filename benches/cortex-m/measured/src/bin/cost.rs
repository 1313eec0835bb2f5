//! Runs the series of calls that are selected, for the host to count in QEMU's trace, and prints, for each number of cells,
//! the size of a curve and how deep each function's stack gets.
//!
//! Building all curves takes a thousand times the instructions of what is measured, too many to trace. So the firmware runs
//! twice: where its input is empty it builds them and prints their bytes, which are the second run's input behind the
//! selection.
#![no_std]
#![no_main]

use core::arch::asm;
use core::fmt::Write;
use core::hint::black_box;
use core::mem::MaybeUninit;

use measured::baseline::{InverseTable, TextbookNewton};
use measured::roots::{DIVISOR, ROOTS, dividend};
use measured::{CELLS, CURVES, DEFAULT, Function, Inputs, SCALES, Series, TICK_HZ, TRIGGERS};
use shutter_curve::{CubicBezier, CurveError, ScheduleError, ShutterCurve};

#[path = "../machine.rs"]
mod machine;

use machine::{In, Out, panicked, write};

#[inline(never)]
fn measured_inverse_cdf<const C: usize>(curve: &ShutterCurve<C>, u: f32) -> f32 {
    curve.inverse_cdf(u)
}

#[inline(never)]
fn measured_cdf<const C: usize>(curve: &ShutterCurve<C>, t: f32) -> f32 {
    curve.cdf(t)
}

#[inline(never)]
fn measured_opening<const C: usize>(curve: &ShutterCurve<C>, t: f32) -> f32 {
    curve.opening(t)
}

#[inline(never)]
fn measured_tick_step(ticks: &mut impl Iterator<Item = u32>) -> Option<u32> {
    ticks.next()
}

#[inline(never)]
fn measured_schedule<const C: usize>(
    curve: &ShutterCurve<C>,
    ticks: &mut [u32; TRIGGERS as usize],
    gap: u32,
) -> Result<(), ScheduleError> {
    curve.schedule_into(ticks, TICK_HZ, gap)
}

#[inline(never)]
fn measured_construct<const C: usize>(
    (opening, closing): (CubicBezier, CubicBezier),
) -> Result<ShutterCurve<C>, CurveError> {
    ShutterCurve::with_cells(opening, closing)
}

#[inline(never)]
fn measured_newton(curve: &TextbookNewton, u: f32) -> f32 {
    curve.inverse_cdf(u)
}

#[inline(never)]
fn measured_table(table: &InverseTable<256>, u: f32) -> f32 {
    table.inverse_cdf(u)
}

#[inline(never)]
fn measured_root<const I: usize>(x: f32, divisor: f32) -> f32 {
    (ROOTS[I].of)(x, divisor)
}

const MEASURED_ROOTS: [fn(f32, f32) -> f32; ROOTS.len()] = [
    measured_root::<0>,
    measured_root::<1>,
    measured_root::<2>,
    measured_root::<3>,
    measured_root::<4>,
    measured_root::<5>,
    measured_root::<6>,
    measured_root::<7>,
    measured_root::<8>,
    measured_root::<9>,
    measured_root::<10>,
    measured_root::<11>,
];

/// Tells the host that the next series begins.
#[inline(never)]
fn series_begins() {
    // SAFETY: does nothing; any Arm core or RISC-V knows it.
    unsafe { asm!("nop") };
}

const PAINT: u32 = 0xA5A5_5A5A;
/// More than any call takes.
const DEPTH: usize = 16 << 10;

/// Calls for each input, and tells the bytes of stack that took: paints below the stack pointer before, and looks how
/// much is left.
#[inline(never)]
fn depth<I, O>(inputs: impl Iterator<Item = I>, mut call: impl FnMut(I) -> O) -> u32 {
    let top: usize;
    // SAFETY: reads a register.
    unsafe {
        #[cfg(target_arch = "arm")]
        asm!("mov {}, sp", out(reg) top);
        #[cfg(target_arch = "riscv32")]
        asm!("mv {}, sp", out(reg) top);
    };
    let words = (top - DEPTH..top).step_by(4);
    for word in words.clone() {
        // SAFETY: below the stack pointer is free RAM, and no interrupt is enabled.
        unsafe { (word as *mut u32).write_volatile(PAINT) };
    }
    for input in inputs {
        black_box(call(black_box(input)));
    }
    // SAFETY: as above.
    let untouched =
        words.take_while(|word| unsafe { (*word as *const u32).read_volatile() } == PAINT);
    (DEPTH - 4 * untouched.count()) as u32
}

/// All curves with so many cells, on each of the scales.
type Curves<const C: usize> = [[ShutterCurve<C>; CURVES.len()]; SCALES.len()];

fn run_with<const C: usize>(selection: u32, input: &mut In) {
    let mut curves = MaybeUninit::<Curves<C>>::zeroed();
    let place = curves.as_mut_ptr();
    if selection == 0 {
        let built = SCALES.iter().flat_map(|scale| CURVES.iter().map(|curve| curve.ramps(*scale)));
        for (i, (opening, closing)) in built.enumerate() {
            let curve = ShutterCurve::with_cells(opening, closing).expect("a good curve");
            // SAFETY: there are so many.
            unsafe { place.cast::<ShutterCurve<C>>().add(i).write(curve) };
        }
    }
    // SAFETY: of that length, and zeroed before anything was written.
    let bytes = unsafe { core::slice::from_raw_parts_mut(place.cast(), size_of::<Curves<C>>()) };
    if selection == 0 {
        return write(bytes);
    }
    input.read(bytes);
    // SAFETY: written by the first run of this very program.
    let curves = unsafe { curves.assume_init_ref() };
    let mut deepest = [0; Function::ALL.len()];
    for series in measured::series(selection).filter(|series| series.cells == C) {
        series_begins();
        let deepest = &mut deepest[series.function as usize];
        *deepest = run_series(series, &curves[series.scale()][series.curve]).max(*deepest);
    }
    let _ = writeln!(Out, "{} {deepest:?}", size_of::<ShutterCurve<C>>());
}

fn run_series<const C: usize>(series: Series, curve: &ShutterCurve<C>) -> u32 {
    let data = &CURVES[series.curve];
    let curve = black_box(curve);
    let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
    let us = series.us();
    match series.function {
        Function::InverseCdf => depth(us, |u| measured_inverse_cdf(curve, u)),
        Function::Cdf => depth(us.map(|u| start + length * u), |t| measured_cdf(curve, t)),
        Function::Opening => depth(us.map(|u| start + length * u), |t| measured_opening(curve, t)),
        Function::TickStep => depth(series.frames(), |(n, steps)| {
            let mut ticks = curve.trigger_ticks(n, black_box(TICK_HZ)).expect("a good rate");
            for _ in 0..steps {
                black_box(measured_tick_step(&mut ticks));
            }
        }),
        Function::Schedule => {
            // On hard curves triggers may share a tick.
            let gap = u32::from(series.inputs == Inputs::Uniform);
            let mut ticks = [0; TRIGGERS as usize];
            depth([gap].into_iter(), |gap| {
                let _ = black_box(measured_schedule(curve, &mut ticks, gap));
                black_box(&ticks);
            })
        }
        Function::Construct => {
            let mut built = None;
            let depth = depth([data.ramps(None)].into_iter(), |ramps| {
                built = measured_construct::<C>(ramps).ok();
            });
            black_box(built);
            depth
        }
        Function::Newton => {
            let newton = TextbookNewton::new(data.opening, data.closing);
            depth(us, |u| measured_newton(black_box(&newton), u))
        }
        Function::Table => {
            let table = InverseTable::new(|u| curve.inverse_cdf(u));
            depth(us, |u| measured_table(black_box(&table), u))
        }
        Function::Root => {
            let root = MEASURED_ROOTS[series.curve];
            depth(us.map(dividend), |x| root(x, black_box(DIVISOR)))
        }
    }
}

fn run() {
    let mut input = In::new();
    let mut selection = [0; 4];
    input.read(&mut selection);
    let selection = u32::from_le_bytes(selection);
    const { assert!(matches!(CELLS, [0, 4, DEFAULT, 16])) };
    run_with::<0>(selection, &mut input);
    run_with::<4>(selection, &mut input);
    run_with::<8>(selection, &mut input);
    run_with::<16>(selection, &mut input);
}
