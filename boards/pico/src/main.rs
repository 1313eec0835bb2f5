//! Fires the flashes of `leaf.rs` after each edge of a camera's sync. The state machine counts, the processor sleeps.
#![no_std]
#![no_main]

mod leaf;

use embassy_executor::Spawner;
use embassy_rp::gpio::{Level, Pull};
use embassy_rp::pac::IO_BANK0;
use embassy_rp::pac::io::vals::Inover;
use embassy_rp::peripherals::{DMA_CH0, PIO0};
use embassy_rp::pio::program::pio_file;
use embassy_rp::pio::{Config, Direction, FifoJoin, InterruptHandler, Pio};
use embassy_rp::{bind_interrupts, dma};
use panic_halt as _;

/// The state machine's rate, which `leaf.rs` has to be planned for.
const TICK_HZ: u32 = 125_000_000;
/// How long a flash is where `leaf.rs` has triggers, not pulses: 2 µs.
const PULSE: u32 = 250;
/// What the state machine takes beside counting: for a flash, to the next, and from the edge to the first.
const MIN_PULSE: u32 = 2;
const MIN_LOW: u32 = 6;
const LATE: u32 = 5;

const N: usize = leaf::COUNT;

/// A frame as `pulses.pio` reads it. Differences are counted from the edge on, so nothing wraps.
const FRAME: [u32; 2 + 2 * N] = {
    assert!(leaf::TIMER_HZ == TICK_HZ, "leaf.rs is of another timer: plan it with timer_hz = 125_000_000");
    assert!(0 < N && N <= 8_192, "the memory has room for 1 to 8192 flashes");
    let mut frame = [N as u32 - 1; 2 + 2 * N];
    let (mut ready, mut i) = (LATE, 0);
    while i < N {
        let (on, off) = leaf::on_off(i, PULSE);
        assert!(i > 0 || on >= ready, "the first flash comes too soon after the sync's edge: see LATE");
        assert!(on >= ready, "a flash comes too soon after the one before it: see MIN_LOW");
        assert!(off >= on + MIN_PULSE, "a flash is too short: see MIN_PULSE");
        frame[1 + 2 * i] = off - on - MIN_PULSE;
        frame[2 + 2 * i] = on - ready;
        ready = off + MIN_LOW;
        i += 1;
    }
    frame[1 + 2 * N] = leaf::HOLD_OFF_TICKS.saturating_sub(ready);
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
    sync.set_pull(if leaf::SYNC_FALLS { Pull::Up } else { Pull::Down });
    if leaf::SYNC_FALLS {
        // The program waits for a rising edge: inverted at the pin, a falling sync has that.
        IO_BANK0.gpio(sync.pin() as usize).ctrl().modify(|w| w.set_inover(Inover::INVERT));
    }
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
