//! Runs every series of calls of the plan, for the host to count in QEMU's trace.
#![no_std]
#![no_main]

use core::hint::black_box;

use firmware::baseline::{InverseTable, TextbookNewton};
use firmware::{CELLS, CURVES, Function, TICK_HZ, TRIGGERS, baselines, selected, series};

#[path = "../machine.rs"]
mod machine;
#[path = "../measured.rs"]
mod measured;
#[path = "../panicked.rs"]
mod panicked;
#[path = "../prebuilt.rs"]
mod prebuilt;

use measured::*;
use prebuilt::prebuilt;

/// Tells the host that the next series begins.
#[inline(never)]
fn series_begins() {
    // SAFETY: does nothing; any Arm core or RISC-V knows it.
    unsafe { core::arch::asm!("nop") };
}

fn run_with<const C: usize>() {
    let selection = prebuilt::selection();
    let index = CELLS.iter().position(|cells| *cells == C).unwrap();
    if selection & 1 << index == 0 {
        return;
    }
    for (function, inputs) in series().filter(|(f, i)| selected(selection, *f, *i)) {
        for index in inputs.curves() {
            series_begins();
            let scale = match function {
                Function::TickStep | Function::Schedule => inputs.scale(),
                _ => 0,
            };
            let curve = black_box(&prebuilt::<C>(scale)[index]);
            let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
            let us = inputs.us(&CURVES[index]);
            match function {
                Function::InverseCdf => us.for_each(|u| {
                    black_box(measured_inverse_cdf(curve, black_box(u)));
                }),
                Function::Cdf => us.for_each(|u| {
                    black_box(measured_cdf(curve, black_box(start + length * u)));
                }),
                Function::Opening => us.for_each(|u| {
                    black_box(measured_opening(curve, black_box(start + length * u)));
                }),
                Function::TickStep => {
                    for (n, steps) in inputs.frames(&CURVES[index]) {
                        let mut ticks =
                            curve.trigger_ticks(black_box(n), black_box(TICK_HZ)).unwrap();
                        for _ in 0..steps {
                            black_box(measured_tick_step(&mut ticks));
                        }
                    }
                }
                Function::Schedule => {
                    // On hard curves triggers may share a tick.
                    let gap = u32::from(!inputs.are_hard());
                    let mut ticks = [0; TRIGGERS as usize];
                    let _ = black_box(measured_schedule(curve, &mut ticks, black_box(gap)));
                    black_box(&ticks);
                }
                Function::Construct => {
                    let (opening, closing) = black_box(&CURVES[index]).ramps();
                    let _ = black_box(measured_construct::<C>(opening, closing));
                }
                Function::Newton | Function::Table => unreachable!(),
            }
        }
    }
}

fn run() {
    if !prebuilt::loaded() {
        return prebuilt::build();
    }
    const { assert!(matches!(CELLS, [0, 4, 8, 16])) };
    run_with::<0>();
    run_with::<4>();
    run_with::<8>();
    run_with::<16>();
    let selection = prebuilt::selection();
    for (function, inputs) in baselines().filter(|(f, i)| selected(selection, *f, *i)) {
        for index in inputs.curves() {
            series_begins();
            let curve = &CURVES[index];
            let newton = TextbookNewton::new(curve.opening, curve.closing);
            let table = InverseTable::new(|u| prebuilt::<8>(0)[index].inverse_cdf(u));
            inputs.us(curve).for_each(|u| {
                if function == Function::Newton {
                    black_box(measured_newton(black_box(&newton), black_box(u)));
                } else {
                    black_box(measured_table(black_box(&table), black_box(u)));
                }
            });
        }
    }
}
