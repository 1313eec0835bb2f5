//! Prints, for each number of cells, the size of a curve and how deep each call's stack gets.
#![no_std]
#![no_main]

use core::arch::asm;
use core::fmt::Write;
use core::hint::black_box;

use firmware::{CELLS, CURVES, Function, Inputs, SCALES, TICK_HZ, TRIGGERS, UNIFORM, uniform};
use shutter_curve::ShutterCurve;

#[allow(dead_code, reason = "the baselines are not measured here")]
#[path = "../measured.rs"]
mod measured;

#[path = "../machine.rs"]
mod machine;
#[path = "../panicked.rs"]
mod panicked;

use machine::Out;
use measured::*;

const PAINT: u32 = 0xA5A5_5A5A;
/// More than any call takes.
const DEPTH: usize = 16 << 10;

/// The bytes of stack that `call` takes on the inputs: paints below the stack pointer, calls, and looks how much
/// is left.
#[inline(never)]
fn depth<T>(inputs: impl Iterator<Item = T>, mut call: impl FnMut(T)) -> u32 {
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
        call(input);
    }
    // SAFETY: as above.
    let untouched =
        words.take_while(|word| unsafe { (*word as *const u32).read_volatile() } == PAINT);
    (DEPTH - 4 * untouched.count()) as u32
}

fn run_with<const C: usize>() {
    let _ = writeln!(Out, "bytes {C} {}", size_of::<ShutterCurve<C>>());
    let mut deepest = [0; Function::ALL.len()];
    let mut note = |function: Function, depth: u32| {
        let deepest = &mut deepest[function as usize];
        *deepest = depth.max(*deepest);
    };
    for data in CURVES {
        let ramps = [data.ramps()];
        let mut built = None;
        note(
            Function::Construct,
            depth(ramps.into_iter(), |(opening, closing)| {
                built = measured_construct::<C>(opening, closing).ok();
            }),
        );
        let curve = black_box(built.as_ref().unwrap());
        let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
        let u = || data.hard_u().chain((0..UNIFORM).map(uniform));
        let t = || u().map(|u| start + length * u);
        let inverse = |u| {
            black_box(measured_inverse_cdf(curve, u));
        };
        note(Function::InverseCdf, depth(u(), inverse));
        let cdf = |t| {
            black_box(measured_cdf(curve, t));
        };
        note(Function::Cdf, depth(t(), cdf));
        let opening = |t| {
            black_box(measured_opening(curve, t));
        };
        note(Function::Opening, depth(t(), opening));
        for inputs in [Inputs::Hard, Inputs::Solved] {
            let (opening, closing) = data.scaled(SCALES[inputs.scale()]);
            let curve = black_box(ShutterCurve::<C>::with_cells(opening, closing).unwrap());
            for (n, steps) in inputs.frames(data) {
                let mut ticks = curve.trigger_ticks(n, TICK_HZ).unwrap();
                let step = |_| {
                    black_box(measured_tick_step(&mut ticks));
                };
                note(Function::TickStep, depth(0..steps, step));
            }
            // A gap that all frames keep, and one that some do not.
            let mut ticks = [0; TRIGGERS as usize];
            let plan = |gap| {
                let _ = black_box(measured_schedule(&curve, &mut ticks, gap));
            };
            note(Function::Schedule, depth([0, 1].into_iter(), plan));
        }
    }
    for function in Function::ALL {
        let _ = write!(Out, "{} ", deepest[function as usize]);
    }
    let _ = writeln!(Out);
}

fn run() {
    const { assert!(matches!(CELLS, [0, 4, 8, 16])) };
    run_with::<0>();
    run_with::<4>();
    run_with::<8>();
    run_with::<16>();
}
