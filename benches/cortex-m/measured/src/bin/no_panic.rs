//! Links only if no public function can panic.
#![no_std]
#![no_main]

#[path = "../link.rs"]
mod link;
#[path = "../machine.rs"]
mod machine;

use link::{panicked, run};
