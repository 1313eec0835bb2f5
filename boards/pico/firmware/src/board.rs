//! The board: its clock of 125 MHz, its pins, and the parts of the chip that the controller uses.

use rp2040_hal::clocks::{Clock, ClocksManager, init_clocks_and_plls};
use rp2040_hal::gpio::bank0::{Gpio0, Gpio1, Gpio2, Gpio3, Gpio4};
use rp2040_hal::gpio::{
    FunctionPio0, FunctionSioInput, FunctionUart, Pin, Pins, PullDown, PullNone, PullUp,
};
use rp2040_hal::{Sio, Timer, Watchdog, pac};
use strobe::TICK_HZ;

/// The second boot stage, which sets up the Pico's flash.
#[allow(unsafe_code)]
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

const CRYSTAL_HZ: u32 = 12_000_000;

/// What is left to be used once the clocks run.
#[allow(missing_docs)]
pub struct Board {
    pub clocks: ClocksManager,
    pub timer: Timer,
    /// GP0: what the controller answers; GP1: what it is told.
    pub uart_pins: (Pin<Gpio0, FunctionUart, PullNone>, Pin<Gpio1, FunctionUart, PullUp>),
    /// GP2: a rising edge starts a frame.
    pub start: Pin<Gpio2, FunctionPio0, PullDown>,
    /// GP3: high while the lamp is on.
    pub lamp: Pin<Gpio3, FunctionPio0, PullDown>,
    /// GP4, for `alarm` alone.
    pub busy: Pin<Gpio4, FunctionSioInput, PullDown>,
    pub uart: pac::UART0,
    pub pio: pac::PIO0,
    pub dma: pac::DMA,
    pub syst: pac::SYST,
    pub resets: pac::RESETS,
}

impl Board {
    /// Sets up the clocks and the pins.
    ///
    /// # Panics
    /// The second time.
    pub fn take() -> Self {
        let chip = pac::Peripherals::take().unwrap();
        let core = pac::CorePeripherals::take().unwrap();
        #[cfg(feature = "faults")]
        plant(&chip.WATCHDOG);
        let mut resets = chip.RESETS;
        let mut watchdog = Watchdog::new(chip.WATCHDOG);
        let clocks = init_clocks_and_plls(
            CRYSTAL_HZ,
            chip.XOSC,
            chip.CLOCKS,
            chip.PLL_SYS,
            chip.PLL_USB,
            &mut resets,
            &mut watchdog,
        )
        .ok()
        .unwrap();
        // Every duration is counted in these.
        assert!(clocks.system_clock.freq().to_Hz() == TICK_HZ);
        let sio = Sio::new(chip.SIO);
        let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, &mut resets);
        Self {
            timer: Timer::new(chip.TIMER, &mut resets, &clocks),
            clocks,
            uart_pins: (pins.gpio0.reconfigure(), pins.gpio1.reconfigure()),
            start: pins.gpio2.reconfigure(),
            lamp: pins.gpio3.reconfigure(),
            busy: pins.gpio4.reconfigure(),
            uart: chip.UART0,
            pio: chip.PIO0,
            dma: chip.DMA,
            syst: core.SYST,
            resets,
        }
    }
}

/// Plants the fault whose name the scratch registers hold, if they hold any.
#[cfg(feature = "faults")]
fn plant(watchdog: &pac::WATCHDOG) {
    let name = [watchdog.scratch0().read().bits(), watchdog.scratch1().read().bits()];
    let [[a, b, c, d], [e, f, g, h]] = name.map(u32::to_le_bytes);
    if name != [0; 2] {
        strobe::plant([a, b, c, d, e, f, g, h]);
    }
}

/// Lets an interrupt come.
pub fn unmask(interrupt: pac::Interrupt) {
    // SAFETY: no critical section relies on the mask.
    #[allow(unsafe_code)]
    unsafe {
        pac::NVIC::unmask(interrupt)
    }
}
