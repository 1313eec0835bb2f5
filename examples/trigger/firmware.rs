//! The frames: plan, fire, check.

use core::cell::RefCell;
use core::mem::MaybeUninit;

use cortex_m::asm::wfi;
use cortex_m_rt::{entry, exception};
use critical_section::Mutex;
use defmt::{Format, error, info};
use defmt_semihosting as _;
use heapless::Vec;
use semihosting::process::ExitCode;
use semihosting::sys::arm_compat::sys_get_cmdline_uninit;
use shutter_curve::{Hz, ScheduleError, TimedCurve, TriggerTicks, expect};

use crate::board::{TICK_HZ, TIMER_IRQ, acknowledge, interrupt_in, now, start, trigger_line};
use crate::measured::{self, SHUTTER};

// The program that planned knew this timer.
const _: () = assert!(measured::TIMER_HZ == TICK_HZ);

const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(TICK_HZ)));
/// The most triggers in a frame.
const CAPACITY: usize = 96;
/// The triggers that each frame asks for; the last asks for more than its lamp can follow.
const FRAMES: [u32; 6] = [8, 16, 33, 48, 64, 90];
/// What the lamp needs between two pulses: 100 µs.
const MIN_GAP: u32 = TICK_HZ / 10_000;
/// The most ticks that a pulse may be late, 0.64 µs.
const LATEST: u32 = 16;
/// How long before a pulse its interrupt comes, to have the handler ready.
const LEAD: u32 = 128;
/// The camera's delay, by its trace: 4.247 ms from the edge of its sync to the start of opening.
const _: () = assert!(measured::DELAY_TICKS == 106_175);
/// From one edge of the sync to the next: 20 ms.
const PERIOD: u32 = TICK_HZ / 50;

// The handler computes a tick between two pulses, so none may be searched for: a curve that needs that does not
// compile.
const _: () = assert!(SHUTTER.direct_triggers() >= CAPACITY as u32);
/// The most cycles of a direct tick, by the crate's README; the timer counts cycles.
const DIRECT_TICK: u32 = 179;
// And there is time enough between two pulses.
const _: () = assert!(LATEST + DIRECT_TICK + LEAD < MIN_GAP);

/// Errors to make, to see that they are seen.
const FAULTS: [&str; 7] = ["lost", "twice", "early", "late", "close", "nodelay", "nowrap"];

/// The fault that the command line names, which the runner makes of the environment's `TRIGGER_FAULT`; none without. An
/// unknown one ends the program.
fn planted() -> &'static str {
    let mut line = [MaybeUninit::uninit(); 256];
    let line = sys_get_cmdline_uninit(&mut line).ok().and_then(|line| str::from_utf8(line).ok());
    let named = line.and_then(|line| line.trim_end_matches('\0').strip_prefix("TRIGGER_FAULT="));
    let Some(named) = named.filter(|named| !named.is_empty()) else { return "" };
    FAULTS.into_iter().find(|fault| *fault == named).unwrap_or_else(|| {
        error!("TRIGGER_FAULT is one of {}", FAULTS);
        ExitCode::from(2).exit_process()
    })
}

/// A frame as it is being fired.
struct Frame {
    fault: &'static str,
    /// The pulses that come after the next, and when the shutter starts to open: the delay after the edge of the sync.
    ticks: Option<TriggerTicks<'static>>,
    base: u32,
    /// When the next pulse has to come, and its number.
    due: Option<u32>,
    next: usize,
    /// When the line went high, with room for one time too many. Nothing but the check reads it.
    fired: Vec<u32, { CAPACITY + 1 }>,
}

static FRAME: Mutex<RefCell<Frame>> =
    Mutex::new(RefCell::new(Frame { fault: "", ticks: None, base: 0, due: None, next: 0, fired: Vec::new() }));

impl Frame {
    /// Arms the timer for the next pulse, if there is one.
    fn proceed(&mut self) {
        let tick = self.ticks.as_mut().and_then(Iterator::next);
        self.due = tick.map(|tick| self.base.wrapping_add(tick));
        if let Some(due) = self.due {
            arm(due);
        }
    }
}

/// What is wrong with a frame's pulses.
#[derive(Format)]
enum Wrong {
    Missing(usize),
    TooMany(usize),
    Early(usize),
    Late(usize, u32),
    TooClose(usize, u32),
    /// Not the ticks that the host planned for as many triggers.
    Other,
}

/// The ticks of a frame, of fewer triggers where the gap asks for it.
fn plan(wanted: u32, fault: &str) -> Result<TriggerTicks<'static>, ScheduleError> {
    // A pulse may be late and the next on time.
    let gap = if fault == "close" { 1 } else { MIN_GAP + LATEST };
    let flash = FLASH.min_gap(gap);
    flash.trigger_ticks(flash.max_triggers(wanted.min(CAPACITY as u32)))
}

/// Fires the pulse that is due, and has the next one come.
fn fire(frame: &mut Frame) {
    acknowledge();
    let Some(due) = frame.due else { return };
    // A fault spoils one pulse; how, is settled before it is waited for.
    let (due, pulses) = match (frame.next, frame.fault) {
        (5, "lost") => (due, 0),
        (5, "twice") => (due, 2),
        (5, "early") => (due.wrapping_sub(LEAD), 1),
        (5, "late") => (due.wrapping_add(LATEST + 1), 1),
        _ => (due, 1),
    };
    while is_before(due) {}
    for _ in 0..pulses {
        pulse(frame);
    }
    frame.next += 1;
    frame.proceed();
}

fn is_before(due: u32) -> bool {
    (now().wrapping_sub(due) as i32) < 0
}

/// One pulse, and when it was.
fn pulse(frame: &mut Frame) {
    trigger_line(true);
    let fired = now();
    trigger_line(false);
    let _ = frame.fired.push(fired);
}

/// Has the interrupt come [`LEAD`] ticks before `due`, or at once if that has passed.
fn arm(due: u32) {
    let ticks = due.wrapping_sub(LEAD).wrapping_sub(now()) as i32;
    interrupt_in(if ticks > 1 { ticks as u32 } else { 1 });
}

#[exception]
unsafe fn DefaultHandler(irq: i16) {
    if irq == TIMER_IRQ {
        critical_section::with(|cs| fire(&mut FRAME.borrow_ref_mut(cs)));
    }
}

/// The greatest lateness of a frame's pulses, if they are what was planned. Those on time are in order, for
/// the plan is.
fn check(edge: u32, plan: TriggerTicks<'_>, fired: &[u32]) -> Result<u32, Wrong> {
    let base = edge.wrapping_add(measured::DELAY_TICKS);
    if fired.len() < plan.len() {
        return Err(Wrong::Missing(fired.len()));
    }
    if fired.len() > plan.len() {
        return Err(Wrong::TooMany(fired.len()));
    }
    if plan.len() == measured::TICKS.len() && !plan.clone().eq(measured::TICKS) {
        return Err(Wrong::Other);
    }
    let mut worst = 0;
    for (i, (tick, &at)) in plan.zip(fired).enumerate() {
        let late = at.wrapping_sub(base.wrapping_add(tick));
        if (late as i32) < 0 {
            return Err(Wrong::Early(i));
        }
        if late > LATEST {
            return Err(Wrong::Late(i, late));
        }
        if i > 0 && at.wrapping_sub(fired[i - 1]) < MIN_GAP {
            return Err(Wrong::TooClose(i, at.wrapping_sub(fired[i - 1])));
        }
        worst = worst.max(late);
    }
    Ok(worst)
}

/// Sleeps until the frame that starts at `base` is over: until a gap has passed after its end.
fn wait_for_end(base: u32) {
    let length = FLASH.length() + MIN_GAP;
    while is_before(base.wrapping_add(length)) {
        // An interrupt that comes in here wakes the processor, and is served at the end: none is missed.
        critical_section::with(|cs| {
            let frame = FRAME.borrow_ref(cs);
            if frame.due.is_some() {
                wfi();
            }
        });
    }
}

#[entry]
fn main() -> ! {
    let fault = planted();
    critical_section::with(|cs| FRAME.borrow_ref_mut(cs).fault = fault);
    // The counter wraps in the middle of the third frame.
    start(if fault == "nowrap" { u32::MAX } else { PERIOD * 3 + PERIOD / 5 * 2 });
    let begin = now().wrapping_add(PERIOD);
    let mut good = true;
    let mut wrapped = false;
    info!("{}: exposure {} s", SHUTTER, SHUTTER.exposure());
    for (i, wanted) in FRAMES.into_iter().enumerate() {
        // What a capture unit holds of the sync's edge: the counter at that moment, which no interrupt makes late.
        let edge = begin.wrapping_add(i as u32 * PERIOD);
        let delay = if fault == "nodelay" { 0 } else { measured::DELAY_TICKS };
        let base = edge.wrapping_add(delay);
        let begun = now();
        let plan = match plan(wanted, fault) {
            Ok(plan) => plan,
            Err(error) => {
                error!("frame {}: {}", i, error);
                exit(false)
            }
        };
        let planning = now().wrapping_sub(begun);
        critical_section::with(|cs| {
            let mut frame = FRAME.borrow_ref_mut(cs);
            (frame.ticks, frame.base, frame.next) = (Some(plan.clone()), base, 0);
            frame.fired.clear();
            frame.proceed();
        });
        wait_for_end(base);
        let fired = critical_section::with(|cs| FRAME.borrow_ref(cs).fired.clone());
        let across = fired.last() < fired.first();
        wrapped |= across;
        match check(edge, plan, &fired) {
            Ok(late) => info!(
                "frame {}: {} of {} triggers, {} ticks late at most, planned in {} ticks{}",
                i,
                fired.len(),
                wanted,
                late,
                planning,
                if across { ", across the counter's wrap" } else { "" }
            ),
            Err(wrong) => {
                error!("frame {}: {} of {} triggers: {}", i, fired.len(), wanted, wrong);
                good = false;
            }
        }
    }
    if !wrapped {
        error!("no frame crossed the counter's wrap");
    }
    exit(good && wrapped)
}

fn exit(good: bool) -> ! {
    if good { ExitCode::SUCCESS } else { ExitCode::FAILURE }.exit_process()
}

#[panic_handler]
fn panic(info: &core::panic::PanicInfo) -> ! {
    error!("{}", defmt::Display2Format(info));
    exit(false)
}
