//! Prints the hash of many answers, on the host as everywhere else.
#![cfg_attr(bare, no_std, no_main)]

#[cfg(bare)]
#[path = "../machine.rs"]
mod machine;
#[cfg(bare)]
use machine::panicked;

#[cfg(bare)]
fn run() {
    use core::fmt::Write;
    let _ = writeln!(machine::Out, "{:016x?}", measured::answers::hashes());
}

#[cfg(not(bare))]
fn main() {
    println!("{:016x?}", measured::answers::hashes());
}
