//! Fires the pulses of `leaf.rs` after each rising edge of a camera's sync. The state machine counts, the processor sleeps.
#![no_std]
#![no_main]

mod leaf;

use embassy_executor::Spawner;
use embassy_rp::gpio::{Level, Pull};
use embassy_rp::peripherals::{DMA_CH0, PIO0};
use embassy_rp::pio::program::pio_file;
use embassy_rp::pio::{Config, Direction, FifoJoin, InterruptHandler, Pio};
use embassy_rp::{bind_interrupts, dma};
use panic_halt as _;

/// The state machine's rate, which leaf.rs was planned for.
const TICK_HZ: u32 = 125_000_000;
/// How long the lamp's line is high: 2 µs.
const PULSE: u32 = 250;
/// What the state machine takes beside counting: for a pulse, to the next, and from the edge to the first.
const MIN_PULSE: u32 = 2;
const MIN_LOW: u32 = 6;
const LATE: u32 = 5;

const N: usize = leaf::TICKS.len();

/// A frame as `pulses.pio` reads it. Differences are counted from the edge on, so nothing wraps.
const FRAME: [u32; 1 + 2 * N] = {
    assert!(leaf::TIMER_HZ == TICK_HZ);
    let mut frame = [N as u32 - 1; 1 + 2 * N];
    let (mut ready, mut i) = (LATE, 0);
    while i < N {
        let start = leaf::DELAY_TICKS + leaf::TICKS[i];
        assert!(start >= ready, "a pulse would begin before the one before it is over");
        frame[1 + 2 * i] = PULSE - MIN_PULSE;
        frame[2 + 2 * i] = start - ready;
        ready = start + PULSE + MIN_LOW;
        i += 1;
    }
    frame
};

bind_interrupts!(struct Irqs {
    PIO0_IRQ_0 => InterruptHandler<PIO0>;
    DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>;
});

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let chip = embassy_rp::init(embassy_rp::config::Config::default());
    assert!(embassy_rp::clocks::clk_sys_freq() == TICK_HZ);

    let Pio { mut common, mut sm0, .. } = Pio::new(chip.PIO0, Irqs);
    let mut sync = common.make_pio_pin(chip.PIN_2);
    sync.set_pull(Pull::Down);
    let lamp = common.make_pio_pin(chip.PIN_3);
    let program = common.load_program(&pio_file!("src/pulses.pio").program);
    let mut config = Config::default();
    config.use_program(&program, &[&lamp]);
    config.set_in_pins(&[&sync]);
    config.fifo_join = FifoJoin::TxOnly;
    sm0.set_config(&config);
    sm0.set_pins(Level::Low, &[&lamp]);
    sm0.set_pin_dirs(Direction::Out, &[&lamp]);
    sm0.set_enable(true);

    let (mut channel, frame) = (dma::Channel::new(chip.DMA_CH0, Irqs), FRAME);
    loop {
        // The next frame waits in the state machine's buffer, and behind it, until this one is over.
        sm0.tx().dma_push(&mut channel, &frame, false).await;
    }
}
