//! Fires the flashes of `leaf.rs` after each edge of a camera's sync. The timer captures the edge; its compare register
//! switches the lamp's line, and DMA writes the next edge into that: the processor has no part in when a pulse comes.
#![no_std]
#![no_main]

mod leaf;

use cortex_m::asm::dmb;
use cortex_m_rt::entry;
use panic_halt as _;
use stm32f4xx_hal::gpio::Pull;
use stm32f4xx_hal::pac::{self, DMA1, TIM2};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::{Config, Enable, Reset};

/// The timer's rate, which `leaf.rs` has to be planned for.
const TICK_HZ: u32 = 100_000_000;
/// How long a flash is where `leaf.rs` has triggers, not pulses: 2 µs.
const PULSE: u32 = 200;
/// What the DMA has, at least, from one edge of the lamp's line to the next: 0.5 µs.
const DMA_TIME: u32 = 50;
/// What the processor has, at least, from the sync's edge to the first flash: 0.4 µs for each flash, to count from
/// that edge, and 20 µs to arm.
const COUNTING: u32 = 40 * N as u32;
const ARMING: u32 = 2_000;

const N: usize = leaf::COUNT;
const _: () = {
    assert!(leaf::TIMER_HZ == TICK_HZ, "leaf.rs is of another timer: plan it with timer_hz = 100_000_000");
    assert!(0 < N && N <= 8_192, "the memory has room for 1 to 8192 flashes");
    let (mut i, mut ready) = (0, COUNTING + ARMING);
    while i < N {
        let (on, off) = leaf::on_off(i, PULSE);
        assert!(i > 0 || on >= ready, "the first flash comes too soon after the sync's edge: see ARMING");
        assert!(on >= ready, "a flash comes too soon after the one before it: see DMA_TIME");
        assert!(off >= on + DMA_TIME, "a flash is too short: see DMA_TIME");
        ready = off + DMA_TIME;
        i += 1;
    }
};

#[entry]
fn main() -> ! {
    // When the line is switched, on and off in turn, and a last one that is never reached: the frame is over before.
    static mut EDGES: [u32; 2 * N + 1] = [0; 2 * N + 1];

    let chip = pac::Peripherals::take().unwrap();
    // The crystal of 25 MHz that a Black Pill has: the chip's own oscillator is off by 1 %.
    let mut rcc = chip.RCC.freeze(Config::hse(25.MHz()).sysclk(TICK_HZ.Hz()).pclk1((TICK_HZ / 2).Hz()));
    assert!(rcc.clocks.timclk1().raw() == TICK_HZ);
    let pins = chip.GPIOA.split(&mut rcc);
    let pull = if leaf::SYNC_FALLS { Pull::Up } else { Pull::Down };
    let _sync = pins.pa0.into_alternate::<1>().internal_resistor(pull);
    let _lamp = pins.pa2.into_alternate::<1>();

    let (timer, dma) = (chip.TIM2, chip.DMA1);
    set_up(&timer, &dma, &mut rcc);
    loop {
        let Some(edge) = captured(&timer) else { continue };
        for (i, pair) in EDGES.chunks_exact_mut(2).enumerate() {
            let (on, off) = leaf::on_off(i, PULSE);
            pair.copy_from_slice(&[edge.wrapping_add(on), edge.wrapping_add(off)]);
        }
        EDGES[2 * N] = edge;
        // Too late to arm: no pulse is better than a wrong one.
        if EDGES[0].wrapping_sub(timer.cnt().read().bits()).wrapping_sub(ARMING / 2) as i32 > 0 {
            fire(&timer, &dma, EDGES);
        }
        // The lamp is ready again then, and the sync; edges that came meanwhile start nothing.
        while timer.cnt().read().bits().wrapping_sub(edge) < leaf::HOLD_OFF_TICKS {}
        timer.sr().write(|w| w.cc1if().clear().cc1of().clear());
    }
}

/// Channel 1 captures the edges at PA0, channel 3 drives PA2, low for now, and the first stream of DMA1 serves it.
fn set_up(timer: &TIM2, dma: &DMA1, rcc: &mut pac::RCC) {
    TIM2::enable(rcc);
    TIM2::reset(rcc);
    DMA1::enable(rcc);
    timer.arr().write(|w| w.arr().set(u32::MAX));
    timer.ccmr1_input().write(|w| w.cc1s().ti1());
    timer.ccmr2_output().write(|w| w.oc3m().force_inactive());
    timer.ccer().write(|w| w.cc1p().bit(leaf::SYNC_FALLS).cc1e().enabled().cc3e().enabled());
    timer.cr1().write(|w| w.cen().enabled());
    let stream = dma.st(1);
    stream.cr().write(|w| {
        let from_memory = w.dir().memory_to_peripheral().minc().incremented().pl().very_high();
        from_memory.msize().bits32().psize().bits32().chsel().set(3)
    });
    // SAFETY: the stream writes to this register alone.
    #[allow(unsafe_code)]
    stream.par().write(|w| unsafe { w.bits(timer.ccr3().as_ptr() as u32) });
}

/// The timer's count at an edge, if there was one; none if another came before it could be read.
fn captured(timer: &TIM2) -> Option<u32> {
    if !timer.sr().read().cc1if().bit() {
        return None;
    }
    let edge = timer.ccr1().read().bits();
    let is_lost = timer.sr().read().cc1of().bit();
    timer.sr().write(|w| w.cc1of().clear());
    (!is_lost).then_some(edge)
}

/// Has the edges come, and waits until the last of them is over.
fn fire(timer: &TIM2, dma: &DMA1, edges: &[u32; 2 * N + 1]) {
    let stream = dma.st(1);
    dma.lifcr().write(|w| w.ctcif1().clear().chtif1().clear().cteif1().clear().cdmeif1().clear());
    // SAFETY: the stream reads as many edges as there are, and is done before this function is.
    #[allow(unsafe_code)]
    stream.m0ar().write(|w| unsafe { w.bits(edges[1..].as_ptr() as u32) });
    stream.ndtr().write(|w| w.ndt().set(2 * N as u16));
    dmb();
    stream.cr().modify(|_, w| w.en().enabled());
    // The first edge by hand: nothing has been compared yet.
    timer.ccr3().write(|w| w.ccr().set(edges[0]));
    timer.sr().write(|w| w.cc3if().clear());
    timer.dier().write(|w| w.cc3de().enabled());
    timer.ccmr2_output().write(|w| w.oc3m().toggle());
    // Over at the last edge, which asks for the one that is never reached.
    while !dma.lisr().read().tcif1().bit() {}
    timer.ccmr2_output().write(|w| w.oc3m().force_inactive());
    timer.dier().write(|w| w.cc3de().disabled());
}
