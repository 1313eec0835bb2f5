//! Says why a program ends.

use core::fmt::Write;

#[panic_handler]
fn panic(info: &core::panic::PanicInfo) -> ! {
    let _ = writeln!(crate::machine::Out, "{info}");
    crate::machine::exit(false)
}
