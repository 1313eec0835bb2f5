//! Links only if no public function can panic.
#![no_std]
#![no_main]

#[path = "../link.rs"]
mod link;

#[cortex_m_rt::entry]
fn main() -> ! {
    link::everything();
    loop {
        core::hint::spin_loop();
    }
}
