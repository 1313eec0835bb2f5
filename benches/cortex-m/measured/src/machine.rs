//! Where a program runs: on Linux, by system calls, as QEMU's user mode has it for each processor. It starts in the
//! program's `run` and panics in its `panicked`.
#![allow(dead_code, unreachable_code, reason = "a program needs a part, and some run for ever")]

use core::fmt::{self, Write};
use core::panic::PanicInfo;

use syscalls::{Sysno, syscall};

// Linux aligns the stack.
#[cfg(target_arch = "arm")]
core::arch::global_asm!(".globl _start", ".thumb_func", "_start: bl main");
#[cfg(target_arch = "riscv32")]
core::arch::global_asm!(".globl _start", "_start: call main");
#[cfg(target_arch = "s390x")]
core::arch::global_asm!(".globl _start", "_start: aghi %r15, -160", "brasl %r14, main");

#[unsafe(no_mangle)]
fn main() -> ! {
    crate::run();
    exit(0)
}

/// What is printed.
pub struct Out;

impl Write for Out {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        write(text.as_bytes());
        Ok(())
    }
}

/// Says why a program ends.
pub fn panicked(info: &PanicInfo) -> ! {
    let _ = writeln!(Out, "{info}");
    exit(1)
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    crate::panicked(info)
}

/// As many bytes of the input, a file, as there are.
pub fn read(bytes: &mut [u8]) -> usize {
    // SAFETY: so many bytes are written there.
    unsafe { syscall!(Sysno::read, 0, bytes.as_mut_ptr(), bytes.len()) }.expect("it can be read")
}

pub fn write(bytes: &[u8]) {
    // SAFETY: so many bytes are taken from there.
    let _ = unsafe { syscall!(Sysno::write, 1, bytes.as_ptr(), bytes.len()) };
}

fn exit(status: usize) -> ! {
    // SAFETY: ends the program.
    let _ = unsafe { syscall!(Sysno::exit, status) };
    loop {
        core::hint::spin_loop();
    }
}
