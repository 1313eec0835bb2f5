//! Runs the series of calls that it is asked for, for the host to count in QEMU's trace.
//!
//! Building all curves takes a thousand times the instructions of what is measured, too many to trace. So the firmware
//! runs twice: where its input is empty it builds them and prints their bytes. These begin the second run's input, and
//! the series follow.
#![no_std]
#![no_main]
#![cfg_attr(bare, feature(core_intrinsics), allow(internal_features))]

use core::hint::black_box;
use core::mem::MaybeUninit;

use measured::baseline::{InverseTable, NearerEnd, StraightRamps};
use measured::{CURVES, Function, Series, TICK_HZ, TRIGGERS, TYPICAL};
use shutter_curve::{CubicBezier, ShutterCurve, TriggerTicks, expect_valid};

#[path = "../machine.rs"]
mod machine;

use machine::{In, panicked, write};

/// What is measured: a call and nothing else.
#[inline(never)]
fn the_call<A, B, O>(call: impl FnOnce(A, B) -> O, a: A, b: B) -> O {
    call(a, b)
}

/// By the processor's instruction, where it has one: `sqrt` is not in stable `core`.
#[inline(always)]
fn fpu_sqrt(x: f32) -> f32 {
    #[cfg(bare)]
    return core::intrinsics::sqrtf32(x);
    #[cfg(not(bare))]
    libm::sqrtf(x)
}

/// The processor's instruction, or else `libm`'s code.
#[inline(always)]
fn own_sqrt(x: f32) -> f32 {
    if cfg!(any(target_abi = "eabihf", target_feature = "f")) { fpu_sqrt(x) } else { libm::sqrtf(x) }
}

/// The inverse of each typical curve, in a `static` of its own.
macro_rules! each_static {
    ($($i:literal)*) => { [$({
        static CURVE: ShutterCurve = {
            let measured::Curve { opening, closing, .. } = CURVES[$i];
            expect_valid(ShutterCurve::new(CubicBezier::new(opening), CubicBezier::new(closing)))
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

/// Calls for each input.
#[inline(never)]
fn each<I, O>(inputs: impl Iterator<Item = I>, mut call: impl FnMut(I) -> O) {
    for input in inputs {
        black_box(call(black_box(input)));
    }
}

/// All curves with so many octaves.
type Curves<const C: usize> = [ShutterCurve<C>; CURVES.len()];

/// The first run's curves; or else they are built, and written for the next.
fn curves<'a, const C: usize>(input: &mut In, place: &'a mut MaybeUninit<Curves<C>>) -> &'a Curves<C> {
    let first = place.as_mut_ptr();
    // SAFETY: of that length, and zeroed.
    let bytes = || unsafe { core::slice::from_raw_parts_mut(first.cast(), size_of::<Curves<C>>()) };
    if input.read(bytes()) == 0 {
        for (i, (opening, closing)) in CURVES.iter().map(measured::Curve::ramps).enumerate() {
            let curve = ShutterCurve::with_octaves(opening, closing).expect("a good curve");
            // SAFETY: there are so many.
            unsafe { first.cast::<ShutterCurve<C>>().add(i).write(curve) };
        }
        write(bytes());
    }
    // SAFETY: written here, or by the first run of this very program.
    unsafe { place.assume_init_ref() }
}

fn by_square_roots(us: impl Iterator<Item = f32>, curve: &measured::Curve, sqrt: impl Fn(f32) -> f32 + Copy) {
    let ramps = black_box(curve.straight());
    let inverse = |ramps: &StraightRamps, u| ramps.inverse_cdf(u, sqrt);
    each(us, |u| the_call(inverse, &ramps, u))
}

fn run_series<const C: usize>(series: Series, curves: &Curves<C>) {
    let data = &CURVES[series.curve];
    let curve = black_box(&curves[series.curve]);
    let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
    let us = series.us();
    let ts = series.us().map(|u| start + length * u);
    match series.function {
        Function::InverseCdf => each(us, |u| the_call(ShutterCurve::inverse_cdf, curve, u)),
        Function::Static => each(us, EACH_STATIC[series.curve]),
        Function::Cdf => each(ts, |t| the_call(ShutterCurve::cdf, curve, t)),
        Function::Openness => each(ts, |t| the_call(ShutterCurve::openness, curve, t)),
        Function::TickStep => each(series.frames(), |(n, steps)| {
            let mut ticks = curve.trigger_ticks(n, black_box(TICK_HZ)).expect("a good rate");
            for _ in 0..steps {
                black_box(the_call(|ticks: &mut TriggerTicks<C>, ()| ticks.next(), &mut ticks, ()));
            }
        }),
        Function::Schedule => {
            let mut ticks = [0; TRIGGERS as usize];
            let plan = |curve: &ShutterCurve<C>, (ticks, gap): (&mut [u32; TRIGGERS as usize], u32)| {
                curve.ticks_into(ticks, TICK_HZ, gap)
            };
            // On hard curves triggers may share a tick.
            let gap = u32::from(!series.is_hard);
            each([gap].into_iter(), |gap| {
                let planned = the_call(plan, curve, (&mut ticks, gap));
                black_box((planned, &ticks)).0.is_ok()
            })
        }
        Function::Construct => {
            let mut built = None;
            let build = |opening: &_, closing: &_| ShutterCurve::<C>::with_octaves(*opening, *closing);
            each([data.ramps()].into_iter(), |(opening, closing)| {
                built = the_call(build, &opening, &closing).ok();
            });
            black_box(built);
        }
        Function::NearerEnd => {
            let newton = black_box(NearerEnd::new(data.opening, data.closing));
            let inverse = |newton: &NearerEnd, u| newton.inverse_cdf(u, own_sqrt);
            each(us, |u| the_call(inverse, &newton, u))
        }
        Function::Table => {
            let table = black_box(InverseTable::<256>::new(|u| curve.inverse_cdf(u)));
            each(us, |u| the_call(InverseTable::inverse_cdf, &table, u))
        }
        Function::SqrtLibm => by_square_roots(us, data, libm::sqrtf),
        Function::SqrtMicromath => by_square_roots(us, data, micromath::F32Ext::sqrt),
        Function::SqrtFpu => by_square_roots(us, data, fpu_sqrt),
    }
}

fn run() {
    let mut input = In::new();
    let mut places = (MaybeUninit::zeroed(), MaybeUninit::zeroed(), MaybeUninit::zeroed());
    let with_0 = curves::<0>(&mut input, &mut places.0);
    let with_4 = curves::<4>(&mut input, &mut places.1);
    let with_8 = curves::<8>(&mut input, &mut places.2);
    let mut bytes = [0; 4];
    while input.read(&mut bytes) == bytes.len() {
        let series = Series::from_bytes(bytes);
        match series.octaves {
            0 => run_series(series, with_0),
            4 => run_series(series, with_4),
            _ => run_series(series, with_8),
        }
    }
}
