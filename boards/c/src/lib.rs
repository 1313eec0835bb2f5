//! The crate's schedules for firmware in C; include/shutter.h says what each function does.
//!
//! Nothing is allocated, and nothing is kept between two calls. The curves are in [`speeds`], made by `shutter plan`.
#![no_std]

mod edge;
mod speeds;

use shutter_curve::{ScheduleError, ShutterCurve};

use edge::{place, places};

/// Why nothing was scheduled; the numbers are those of the header.
#[repr(i32)]
enum Error {
    NoSpeed = -1,
    NoRoom = -2,
    RateZero = -3,
    RateTooHigh = -4,
    Gap = -5,
    Duty = -6,
    PulseTooShort = -7,
    NoTrigger = -8,
    Other = -9,
    TooMany = -10,
}

impl From<ScheduleError> for Error {
    fn from(error: ScheduleError) -> Self {
        match error {
            ScheduleError::TickRateZero => Self::RateZero,
            ScheduleError::TickRateTooHigh { .. } => Self::RateTooHigh,
            ScheduleError::TooManyTriggers { .. } => Self::TooMany,
            ScheduleError::GapTooSmall { .. } => Self::Gap,
            ScheduleError::DutyOutOfRange => Self::Duty,
            ScheduleError::PulseTooShort { .. } => Self::PulseTooShort,
            // A later version of the crate may have more.
            _ => Self::Other,
        }
    }
}

/// When the lamp is on, as C has it.
#[repr(C)]
pub struct Pulse {
    on: u32,
    off: u32,
}

fn curve(speed: u32) -> Result<&'static ShutterCurve, Error> {
    usize::try_from(speed)
        .ok()
        .and_then(|i| speeds::SPEEDS.get(i))
        .map(|speed| speed.shutter)
        .ok_or(Error::NoSpeed)
}

fn code(done: Result<(), Error>) -> i32 {
    done.map_or_else(|error| error as i32, |()| 0)
}

/// A checked schedule of `n` triggers.
///
/// # Safety
/// `ticks` is null or has room for `n`.
// SAFETY: no other function of this name is linked: it begins as the library is called.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shutter_schedule(
    speed: u32,
    timer_hz: u32,
    min_gap: u32,
    n: u32,
    ticks: *mut u32,
) -> i32 {
    // SAFETY: the caller's.
    let ticks = unsafe { places(ticks, n) };
    code(curve(speed).and_then(|curve| {
        let ticks = ticks.ok_or(Error::NoRoom)?;
        Ok(curve.ticks_into(ticks, timer_hz, min_gap)?)
    }))
}

/// The tick of trigger `i` of `n`.
///
/// # Safety
/// `tick` is null or has room for one.
// SAFETY: as for `shutter_schedule`.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shutter_tick(
    speed: u32,
    timer_hz: u32,
    n: u32,
    i: u32,
    tick: *mut u32,
) -> i32 {
    // SAFETY: the caller's.
    let tick = unsafe { place(tick) };
    code(curve(speed).and_then(|curve| {
        let tick = tick.ok_or(Error::NoRoom)?;
        *tick = curve.trigger_ticks(n, timer_hz)?.nth(i as usize).ok_or(Error::NoTrigger)?;
        Ok(())
    }))
}

/// `n` pulses of equal doses.
///
/// # Safety
/// `pulses` is null or has room for `n`.
// SAFETY: as for `shutter_schedule`.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shutter_pulses(
    speed: u32,
    duty: f32,
    timer_hz: u32,
    min_pulse: u32,
    min_gap: u32,
    n: u32,
    pulses: *mut Pulse,
) -> i32 {
    // SAFETY: the caller's.
    let pulses = unsafe { places(pulses, n) };
    code(curve(speed).and_then(|curve| {
        let pulses = pulses.ok_or(Error::NoRoom)?;
        let (frame, mut last) = (curve.pulse_ticks(n, duty, timer_hz)?, None);
        for (place, shutter_curve::Pulse { on, off }) in pulses.iter_mut().zip(frame) {
            if off.wrapping_sub(on) < min_pulse {
                return Err(Error::PulseTooShort);
            }
            if last.is_some_and(|last| on.wrapping_sub(last) < min_gap) {
                return Err(Error::Gap);
            }
            *place = Pulse { on, off };
            last = Some(off);
        }
        Ok(())
    }))
}

/// Nothing here panics; without this, nothing would link.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}
