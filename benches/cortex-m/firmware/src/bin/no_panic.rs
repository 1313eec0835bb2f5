//! Links only if no public function can panic.
#![no_std]
#![no_main]

#[path = "../link.rs"]
mod link;
#[allow(dead_code, unused_imports, reason = "nothing is printed")]
#[path = "../machine.rs"]
mod machine;

fn run() -> ! {
    link::everything();
    // Ends nowhere: what ends a program may panic.
    loop {
        core::hint::spin_loop();
    }
}
