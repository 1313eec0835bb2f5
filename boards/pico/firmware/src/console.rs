//! The serial line, 115 200 baud. An interrupt collects what comes in while the processor plans.

use core::cell::RefCell;

use critical_section::Mutex;
use heapless::Deque;
use rp2040_hal::clocks::Clock;
use rp2040_hal::gpio::bank0::{Gpio0, Gpio1};
use rp2040_hal::gpio::{FunctionUart, Pin, PullNone, PullUp};
use rp2040_hal::uart::{Reader, UartConfig, UartPeripheral, Writer};
use rp2040_hal::{clocks::ClocksManager, pac, pac::interrupt};

use crate::board::unmask;

type Pins = (Pin<Gpio0, FunctionUart, PullNone>, Pin<Gpio1, FunctionUart, PullUp>);

/// What has come in and was not taken yet.
struct Received {
    reader: Reader<pac::UART0, Pins>,
    bytes: Deque<u8, 512>,
    lost: bool,
}

static RECEIVED: Mutex<RefCell<Option<Received>>> = Mutex::new(RefCell::new(None));

/// What comes in.
pub enum Input {
    /// A byte.
    Byte(u8),
    /// Before the next byte, some were lost.
    Lost,
}

/// Starts to receive, and gives what sends.
pub fn start(
    uart: pac::UART0,
    pins: Pins,
    resets: &mut pac::RESETS,
    clocks: &ClocksManager,
) -> Writer<pac::UART0, Pins> {
    let uart = UartPeripheral::new(uart, pins, resets)
        .enable(UartConfig::default(), clocks.peripheral_clock.freq())
        .ok()
        .unwrap();
    let (mut reader, writer) = uart.split();
    reader.enable_rx_interrupt();
    let received = Received { reader, bytes: Deque::new(), lost: false };
    critical_section::with(|cs| RECEIVED.replace(cs, Some(received)));
    unmask(pac::Interrupt::UART0_IRQ);
    writer
}

/// The next of what has come in.
pub fn next() -> Option<Input> {
    critical_section::with(|cs| {
        let mut received = RECEIVED.borrow_ref_mut(cs);
        let received = received.as_mut()?;
        let byte = received.bytes.pop_front().map(Input::Byte);
        #[cfg(feature = "faults")]
        if strobe::is_planted(strobe::Fault::Full) {
            received.lost = false;
        }
        // What was lost came after everything that there was room for.
        byte.or_else(|| core::mem::take(&mut received.lost).then_some(Input::Lost))
    })
}

#[interrupt]
fn UART0_IRQ() {
    critical_section::with(|cs| {
        if let Some(received) = RECEIVED.borrow_ref_mut(cs).as_mut() {
            receive(received);
        }
    });
}

fn receive(received: &mut Received) {
    // As many as the UART holds; it interrupts again for more.
    let mut bytes = [0; 32];
    let Ok(n) = received.reader.read_raw(&mut bytes) else {
        received.lost = true;
        return;
    };
    for byte in &bytes[..n] {
        // Once a byte is lost, so are those after it, until what is there has been taken.
        received.lost |= received.lost || received.bytes.push_back(*byte).is_err();
    }
}
