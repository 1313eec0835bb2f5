//! Runs the series of calls that it is asked for, for the host to count in QEMU's trace, and prints the stack that each
//! took.
//!
//! Building all curves takes a thousand times the instructions of what is counted, too many to trace. So the firmware
//! runs twice: where its input is empty it builds them and prints their bytes. These begin the second run's input. Each
//! series follows: its function, its curve, and how many fractions it has; then these.
#![no_std]
#![no_main]
#![feature(core_float_math)]

// The processor's, or else that of the compiler's library.
use core::f32::math::sqrt;
use core::hint::black_box;
use core::mem::MaybeUninit;

use measured::baseline::{InverseTable, NearerEnd, StraightRamps};
use measured::{CURVES, FUNCTIONS, Function, MOST, MOST_TRIGGERS, TICK_HZ, TRIGGERS, TYPICAL, trigger};
use shutter_curve::{CubicBezier, ShutterCurve, TriggerTicks, expect};

#[path = "../machine.rs"]
mod machine;

use machine::{panicked, read, write};

/// What is measured: a call and nothing else.
#[inline(never)]
fn the_call<A, B, O>(call: impl FnOnce(A, B) -> O, a: A, b: B) -> O {
    call(a, b)
}

/// The inverse of each typical curve, in a `static` of its own.
macro_rules! each_static {
    ($($i:literal)*) => { [$({
        static CURVE: ShutterCurve = {
            let measured::Curve { opening, closing, .. } = CURVES[$i];
            expect!(ShutterCurve::new(CubicBezier::new(opening), CubicBezier::new(closing)))
        };
        // Named so that the host finds it.
        #[inline(never)]
        fn the_call(u: f32) -> f32 {
            CURVE.inverse_cdf(u)
        }
        the_call as fn(f32) -> f32
    }),*] };
}
const EACH_STATIC: [fn(f32) -> f32; TYPICAL] = each_static!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14);

/// The words below the stack that are painted.
const PAINTED: usize = 4096;
const PAINT: u32 = 0x5AA5_C33C;

/// Paints what lies below the stack of whoever calls, or says down to which address the paint is gone.
#[inline(never)]
fn below(paints: bool) -> usize {
    let mut words = [const { MaybeUninit::<u32>::uninit() }; PAINTED];
    let mut end = words.as_ptr() as usize;
    for word in &mut words {
        let word = word.as_mut_ptr();
        // SAFETY: its own memory; volatile, since the compiler does not know what was painted there before.
        unsafe {
            if paints {
                word.write_volatile(PAINT);
            } else if word.read_volatile() != PAINT {
                break;
            }
        }
        end += size_of::<u32>();
    }
    end
}

#[inline(always)]
fn stack_pointer() -> usize {
    let address;
    // SAFETY: reads a register.
    unsafe {
        #[cfg(target_arch = "arm")]
        core::arch::asm!("mov {}, sp", out(reg) address);
        #[cfg(not(target_arch = "arm"))]
        core::arch::asm!("mv {}, sp", out(reg) address);
    }
    address
}

/// Calls for each input, and prints the bytes of stack that it took.
#[inline(never)]
fn each<I: Copy, O>(inputs: &[I], mut call: impl FnMut(I) -> O) {
    below(true);
    for input in inputs {
        black_box(call(black_box(*input)));
    }
    let taken = (stack_pointer() - below(false)) as u32;
    write(&taken.to_le_bytes());
}

/// All curves with so many octaves.
type Curves<const C: usize> = [ShutterCurve<C>; CURVES.len()];

/// The first run's curves; or else they are built, and written for the next.
fn curves<const C: usize>() -> Curves<C> {
    let mut place = MaybeUninit::<Curves<C>>::zeroed();
    let first = place.as_mut_ptr();
    // SAFETY: of that length, and zeroed.
    let bytes = || unsafe { core::slice::from_raw_parts_mut(first.cast(), size_of::<Curves<C>>()) };
    if read(bytes()) == 0 {
        for (i, (opening, closing)) in CURVES.iter().map(measured::Curve::ramps).enumerate() {
            let curve = ShutterCurve::with_octaves(opening, closing).expect("a good curve");
            // SAFETY: there are so many.
            unsafe { first.cast::<ShutterCurve<C>>().add(i).write(curve) };
        }
        write(bytes());
    }
    // SAFETY: written here, or by the first run of this very program.
    unsafe { place.assume_init() }
}

fn by_square_roots(us: &[f32], curve: &measured::Curve, sqrt: impl Fn(f32) -> f32 + Copy) {
    let ramps = black_box(curve.straight());
    let inverse = |ramps: &StraightRamps, u| ramps.inverse_cdf(u, sqrt);
    each(us, |u| the_call(inverse, &ramps, u))
}

fn run_series<const C: usize>(function: Function, i: usize, curves: &Curves<C>, us: &[f32]) {
    let (data, curve) = (&CURVES[i], black_box(&curves[i]));
    let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
    match function {
        Function::InverseCdf | Function::InverseCdf0 | Function::InverseCdf4 => {
            each(us, |u| the_call(ShutterCurve::inverse_cdf, curve, u))
        }
        Function::Static => each(us, EACH_STATIC[i]),
        Function::Cdf => each(us, |u| the_call(ShutterCurve::cdf, curve, start + length * u)),
        Function::Openness => each(us, |u| the_call(ShutterCurve::openness, curve, start + length * u)),
        Function::Tick => {
            let frame = curve
                .at(black_box(TICK_HZ))
                .and_then(|timed| timed.min_gap(0).trigger_ticks(MOST_TRIGGERS))
                .expect("a good rate");
            each(us, |u| {
                let mut ticks = frame.clone();
                if let Some(before) = trigger(u).checked_sub(1) {
                    ticks.nth(before as usize);
                }
                the_call(|ticks: &mut TriggerTicks<C>, ()| ticks.next(), &mut ticks, ())
            })
        }
        Function::Schedule => {
            let mut ticks = [0; TRIGGERS as usize];
            let plan = |curve: &ShutterCurve<C>, ticks: &mut [u32; TRIGGERS as usize]| {
                curve.at(TICK_HZ).is_ok_and(|timed| timed.ticks_into(ticks).is_ok())
            };
            each(us, |_| (the_call(plan, curve, &mut ticks), black_box(ticks)))
        }
        Function::Construct | Function::Construct0 => {
            let build = |opening: &_, closing: &_| ShutterCurve::<C>::with_octaves(*opening, *closing);
            let (opening, closing) = black_box(data.ramps());
            each(us, |_| the_call(build, &opening, &closing).is_ok())
        }
        Function::NearerEnd => {
            let newton = black_box(NearerEnd::new(data.opening, data.closing));
            let inverse = |newton: &NearerEnd, u| newton.inverse_cdf(u, sqrt);
            each(us, |u| the_call(inverse, &newton, u))
        }
        Function::Table => {
            let table = black_box(InverseTable::<256>::new(|u| curve.inverse_cdf(u)));
            each(us, |u| the_call(InverseTable::inverse_cdf, &table, u))
        }
        Function::SqrtLibm => by_square_roots(us, data, libm::sqrtf),
        Function::SqrtMicromath => by_square_roots(us, data, micromath::F32Ext::sqrt),
        Function::SqrtFpu => by_square_roots(us, data, sqrt),
    }
}

fn run() {
    let (with_0, with_4, with_8) = (curves::<0>(), curves::<4>(), curves::<8>());
    let mut words = [[0; 4]; MOST];
    let mut numbers = |count: usize| {
        words[..count].iter_mut().all(|word| read(word) == word.len()).then(|| words.map(u32::from_le_bytes))
    };
    while let Some([function, curve, count, ..]) = numbers(3) {
        let Some(us) = numbers(count as usize) else { break };
        let (function, curve) = (FUNCTIONS[function as usize].0, curve as usize);
        let us = &us.map(f32::from_bits)[..count as usize];
        match function {
            Function::InverseCdf0 | Function::Construct0 => run_series(function, curve, &with_0, us),
            Function::InverseCdf4 => run_series(function, curve, &with_4, us),
            _ => run_series(function, curve, &with_8, us),
        }
    }
}
