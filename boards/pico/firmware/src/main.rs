//! A strobe controller: see docs/firmware.md. It never ends.
#![no_std]
#![no_main]

use core::cell::RefCell;
use core::fmt::Write;

use cortex_m::asm;
use critical_section::Mutex;
use firmware::board::{Board, unmask};
use firmware::console::{self, Input};
use firmware::cycles::Cycles;
use firmware::output::Output;
use rp2040_hal::dma::{CH0, DMAExt};
use rp2040_hal::pac::{self, interrupt};
use rp2040_hal::pio::{PIO, PIOExt, SM0};
use rp2040_hal::{Timer, entry};
use strobe::{Broken, Change, Frame, Lines, Refused, Settings};

/// What fires. A second output is a second field, of `SM1` and `CH1`.
struct Firing {
    pio: PIO<pac::PIO0>,
    lamp: Output<SM0, CH0>,
}

static FIRING: Mutex<RefCell<Option<Firing>>> = Mutex::new(RefCell::new(None));

/// A frame is over.
#[interrupt]
fn PIO0_IRQ_0() {
    critical_section::with(|cs| {
        if let Some(Firing { pio, lamp }) = FIRING.borrow_ref_mut(cs).as_mut() {
            // One bit for each state machine whose frame it was.
            let over = pio.get_irq_raw();
            pio.clear_irq(over);
            if over & 1 << 0 != 0 {
                lamp.rearm();
            }
        }
    });
}

/// Plans with what a line asks for.
struct Planner {
    settings: Settings,
    cycles: Cycles,
    timer: Timer,
}

/// What a change cost.
struct Cost {
    /// To plan the frame, in cycles.
    planning: u32,
    /// To build the curve, in microseconds: more cycles than can be counted.
    building: Option<u64>,
}

impl Planner {
    /// Plans `frame` with the change; the settings are kept only if that is done.
    fn change(&mut self, line: Result<&str, Broken>, frame: &mut Frame) -> Result<Cost, Refused> {
        let change = Change::read(line.map_err(Refused::Broken)?)?;
        let begun = self.timer.get_counter();
        let settings = self.settings.with(change)?;
        let microseconds = (self.timer.get_counter() - begun).to_micros();
        let (planned, planning) = self.cycles.of(|| frame.plan(&settings));
        planned?;
        self.settings = settings;
        let building = matches!(change, Change::Built(_)).then_some(microseconds);
        Ok(Cost { planning, building })
    }
}

#[entry]
fn main() -> ! {
    // One is fired, one comes after it, one is planned.
    static mut FRAMES: [Frame; 3] = [Frame::EMPTY; 3];
    let [first, next, mut spare] = FRAMES.each_mut();

    let mut board = Board::take();
    let mut console = console::start(board.uart, board.uart_pins, &mut board.resets, &board.clocks);
    let cycles = Cycles::new(board.syst);
    let mut planner = Planner { settings: Settings::default(), cycles, timer: board.timer };

    first.plan(&planner.settings).unwrap();
    let (mut pio, machine, ..) = board.pio.split(&mut board.resets);
    let channel = board.dma.split(&mut board.resets).ch0;
    let pins = [board.start.id().num, board.lamp.id().num];
    let lamp = Output::new(&mut pio, machine, channel, pins, [first, next]);
    critical_section::with(|cs| FIRING.replace(cs, Some(Firing { pio, lamp })));
    unmask(pac::Interrupt::PIO0_IRQ_0);
    let _ = write!(console, "ready: {}\r\n", planner.settings);

    let mut lines = Lines::default();
    loop {
        let line = match console::next() {
            Some(Input::Byte(byte)) => lines.push(byte),
            Some(Input::Lost) => {
                lines.lost();
                None
            }
            None => {
                // An interrupt since the look at the console is an event that was registered: none is slept through.
                asm::wfe();
                None
            }
        };
        let Some(line) = line else { continue };
        match planner.change(line, spare) {
            Ok(cost) => {
                critical_section::with(|cs| {
                    if let Some(firing) = FIRING.borrow_ref_mut(cs).as_mut() {
                        firing.lamp.publish(&mut spare);
                    }
                });
                let _ =
                    write!(console, "ok {}; planned in {} cycles", planner.settings, cost.planning);
                if let Some(microseconds) = cost.building {
                    let _ = write!(console, ", the curve built in {microseconds} us");
                }
                let _ = write!(console, "\r\n");
            }
            Err(refused) => {
                let _ = write!(console, "refused: {refused}\r\n");
            }
        }
    }
}
