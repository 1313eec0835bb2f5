//! An output: a state machine that fires the pulses of a frame, fed by DMA, armed again by an interrupt.
//!
//! The processor has no part in when a pulse comes. It has until the end of a frame to plan the next.

use core::mem;

use embedded_dma::ReadBuffer;
use pio::{Program, pio_file};
use rp2040_hal::dma::single_buffer::{Config, Transfer};
use rp2040_hal::dma::{Channel, ChannelIndex, SingleChannel};
use rp2040_hal::pac::PIO0;
use rp2040_hal::pio::{
    Buffers, PIO, PIOBuilder, PinDir, PinState, StateMachineIndex, Tx, UninitStateMachine,
};
use strobe::{Edge, Frame};

/// What the state machine does, an instruction each 8 ns. The edge that it waits for is inverted before it, where that is the falling
/// one, and its interrupt at a frame's end arms the next.
fn program() -> Program<32> {
    pio_file!("../../pico-embassy/src/pulses.pio").program
}

/// A frame while the DMA reads it.
struct Armed(&'static mut Frame);

// SAFETY: the words are in a static that nothing writes to while this owns the only reference to it.
#[allow(unsafe_code)]
unsafe impl ReadBuffer for Armed {
    type Word = u32;

    unsafe fn read_buffer(&self) -> (*const u32, usize) {
        (self.0.words().as_ptr(), self.0.words().len())
    }
}

/// The DMA, while it feeds the state machine.
type Feed<SM, CH> = Transfer<Channel<CH>, Armed, Tx<(PIO0, SM)>>;

/// The state machine `SM` and the DMA channel `CH`, armed with a frame, and the frame that comes after it.
pub struct Output<SM: StateMachineIndex, CH: ChannelIndex> {
    transfer: Option<Feed<SM, CH>>,
    /// Of the frame that is armed.
    edge: Edge,
    next: &'static mut Frame,
    is_fresh: bool,
}

impl<SM: StateMachineIndex, CH: ChannelIndex> Output<SM, CH>
where
    Channel<CH>: SingleChannel,
{
    /// Starts the state machine with a frame: a rising edge at the pin `start` fires it at the pin `lamp`.
    ///
    /// The program takes 13 of the 32 places for instructions, so there is room for two outputs.
    pub fn new(
        pio: &mut PIO<PIO0>,
        machine: UninitStateMachine<(PIO0, SM)>,
        channel: Channel<CH>,
        [start, lamp]: [u8; 2],
        [first, next]: [&'static mut Frame; 2],
    ) -> Self {
        let program = pio.install(&program()).unwrap();
        let (mut machine, _, fifo) = PIOBuilder::from_installed_program(program)
            .in_pin_base(start)
            .side_set_pin_base(lamp)
            .buffers(Buffers::OnlyTx)
            .clock_divisor_fixed_point(1, 0)
            .build(machine);
        machine.set_pins([(lamp, PinState::Low)]);
        machine.set_pindirs([(lamp, PinDir::Output)]);
        pio.irq0().enable_sm_interrupt(SM::id() as u8);
        machine.start();
        let edge = first.edge();
        let transfer = Some(Config::new(channel, Armed(first), fifo).start());
        Self { transfer, edge, next, is_fresh: false }
    }

    /// Takes a frame, to be fired from the next arming on, for one to plan in.
    pub fn publish(&mut self, frame: &mut &'static mut Frame) {
        mem::swap(&mut self.next, frame);
        self.is_fresh = true;
    }

    /// The edge that the next frame waits for; to be set up before it is armed.
    pub fn next_edge(&self) -> Edge {
        match self.is_fresh {
            true => self.next.edge(),
            false => self.edge,
        }
    }

    /// Arms the next frame, or the same again; to be called at the interrupt that ends a frame.
    pub fn rearm(&mut self) {
        let Some(transfer) = self.transfer.take() else { return };
        // It is done: the state machine has read every word.
        let (channel, Armed(mut frame), fifo) = transfer.wait();
        if mem::take(&mut self.is_fresh) {
            mem::swap(&mut frame, &mut self.next);
        }
        self.edge = frame.edge();
        self.transfer = Some(Config::new(channel, Armed(frame), fifo).start());
    }
}
