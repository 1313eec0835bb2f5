//! A strobe controller: see boards/pico/README.md. It never ends.
#![no_std]
#![no_main]

use core::cell::RefCell;
use core::fmt::{self, Write};

use cortex_m::asm;
use critical_section::Mutex;
use firmware::board::{Board, unmask};
use firmware::console::{self, Input};
use firmware::cycles::Cycles;
use firmware::flash::Saved;
use firmware::output::Output;
use rp2040_hal::dma::{CH0, DMAExt};
use rp2040_hal::gpio::bank0::Gpio2;
use rp2040_hal::gpio::{FunctionPio0, InputOverride, Pin, PullDown};
use rp2040_hal::pac::{self, interrupt};
use rp2040_hal::pio::{PIO, PIOExt, SM0};
use rp2040_hal::{Timer, entry};
use strobe::{Broken, Change, Edge, Frame, Lines, Refused, Request, Settings, store};

/// The pin whose edge starts a frame.
type Start = Pin<Gpio2, FunctionPio0, PullDown>;

/// The state machine waits for a rising edge, of what it is given to see.
fn set_edge(start: &mut Start, edge: Edge) {
    start.set_input_override(match edge {
        Edge::Rising => InputOverride::Normal,
        Edge::Falling => InputOverride::Invert,
    });
}

/// What fires. A second output is a second field, of `SM1` and `CH1`.
struct Firing {
    pio: PIO<pac::PIO0>,
    start: Start,
    lamp: Output<SM0, CH0>,
}

static FIRING: Mutex<RefCell<Option<Firing>>> = Mutex::new(RefCell::new(None));

/// A frame is over.
#[interrupt]
fn PIO0_IRQ_0() {
    critical_section::with(|cs| {
        if let Some(Firing { pio, start, lamp }) = FIRING.borrow_ref_mut(cs).as_mut() {
            // One bit for each state machine whose frame it was.
            let over = pio.get_irq_raw();
            pio.clear_irq(over);
            if over & 1 << 0 != 0 {
                // While the state machine waits for the frame's words, it looks at no edge.
                set_edge(start, lamp.next_edge());
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
    saved: Saved,
}

/// What a line led to.
enum Done {
    /// A frame is planned.
    Planned {
        /// In so many cycles.
        planning: u32,
        /// Its curve was built in so many microseconds: more cycles than can be counted.
        building: Option<u64>,
    },
    /// There is nothing to be done.
    Shown,
    /// The settings outlive the power; so many saves the flash has seen.
    Saved(u32),
}

impl Planner {
    /// Does what the line asks for, with `frame` to plan in.
    fn answer(&mut self, line: Result<&str, Broken>, frame: &mut Frame) -> Result<Done, Refused> {
        match Request::read(line.map_err(Refused::Broken)?)? {
            Request::Change(change) => self.change(change, frame),
            Request::Show => Ok(Done::Shown),
            Request::Save => {
                #[cfg(feature = "faults")]
                if strobe::is_planted(strobe::Fault::Save) {
                    stand_still(true);
                }
                let saved = store::save(&mut self.saved, &self.settings);
                #[cfg(feature = "faults")]
                stand_still(false);
                saved.map(Done::Saved).map_err(|store::NotSaved| Refused::NotSaved)
            }
        }
    }

    /// Plans `frame` with the change; the settings are kept only if that is done.
    fn change(&mut self, change: Change, frame: &mut Frame) -> Result<Done, Refused> {
        let begun = self.timer.get_counter();
        let settings = self.settings.with(change)?;
        let microseconds = (self.timer.get_counter() - begun).to_micros();
        let (planned, planning) = self.cycles.of(|| frame.plan(&settings));
        planned?;
        self.settings = settings;
        let is_built = matches!(change, Change::Built(_) | Change::Linear(_));
        Ok(Done::Planned { planning, building: is_built.then_some(microseconds) })
    }

    /// Plans the first frame, with what was saved if that can be planned, and says which.
    fn begin(&mut self, frame: &mut Frame) -> &'static str {
        if let Some((settings, _)) = store::load(&self.saved)
            && frame.plan(&settings).is_ok()
        {
            self.settings = settings;
            return "ready, as saved";
        }
        frame.plan(&self.settings).unwrap();
        "ready"
    }
}

/// Has the state machine see no edge, or see them again.
#[cfg(feature = "faults")]
fn stand_still(still: bool) {
    critical_section::with(|cs| {
        if let Some(firing) = FIRING.borrow_ref_mut(cs).as_mut() {
            firing.start.set_input_override(if still {
                InputOverride::AlwaysLow
            } else {
                InputOverride::Normal
            });
        }
    });
}

/// Says what a line led to.
fn tell(out: &mut impl Write, settings: &Settings, done: &Result<Done, Refused>) -> fmt::Result {
    match done {
        Ok(Done::Planned { planning, building }) => {
            write!(out, "ok {settings}; planned in {planning} cycles")?;
            if let Some(microseconds) = building {
                write!(out, ", the curve built in {microseconds} us")?;
            }
        }
        Ok(Done::Shown) => {
            write!(out, "strobe {}: {}", env!("CARGO_PKG_VERSION"), settings.in_full())?;
        }
        Ok(Done::Saved(number)) => write!(out, "saved {settings}; save {number} of this flash")?,
        Err(refused) => write!(out, "refused: {refused}")?,
    }
    out.write_str("\r\n")
}

#[entry]
fn main() -> ! {
    // One is fired, one comes after it, one is planned.
    static mut FRAMES: [Frame; 3] = [Frame::EMPTY; 3];
    let [first, next, mut spare] = FRAMES.each_mut();

    let mut board = Board::take();
    let mut console = console::start(board.uart, board.uart_pins, &mut board.resets, &board.clocks);
    let cycles = Cycles::new(board.syst);
    // SAFETY: the entry runs once.
    #[allow(unsafe_code)]
    let saved = unsafe { Saved::new() };
    let mut planner = Planner { settings: Settings::default(), cycles, timer: board.timer, saved };

    let ready = planner.begin(first);
    let (mut pio, machine, ..) = board.pio.split(&mut board.resets);
    let channel = board.dma.split(&mut board.resets).ch0;
    let pins = [board.start.id().num, board.lamp.id().num];
    let mut start = board.start;
    set_edge(&mut start, first.edge());
    let lamp = Output::new(&mut pio, machine, channel, pins, [first, next]);
    critical_section::with(|cs| FIRING.replace(cs, Some(Firing { pio, start, lamp })));
    unmask(pac::Interrupt::PIO0_IRQ_0);
    // What cannot be sent is lost: there is no one else to tell.
    let _ = write!(console, "{ready}: {}\r\n", planner.settings);

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
        let done = planner.answer(line, spare);
        if let Ok(Done::Planned { .. }) = done {
            critical_section::with(|cs| {
                if let Some(firing) = FIRING.borrow_ref_mut(cs).as_mut() {
                    firing.lamp.publish(&mut spare);
                }
            });
        }
        let _ = tell(&mut console, &planner.settings, &done);
    }
}
