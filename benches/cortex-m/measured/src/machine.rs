//! Where a program runs: on one of QEMU's boards with an Arm core, or in QEMU's user mode, by semihosting; on s390x,
//! which has none, by system calls of Linux. It starts in the program's `run` and panics in its `panicked`.
#![allow(dead_code, unreachable_code, unused_imports, reason = "a program needs a part, and some run for ever")]

use core::fmt::{self, Write};
use core::panic::PanicInfo;

pub use on::*;

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
    on::exit(false)
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    crate::panicked(info)
}

#[cfg(not(target_arch = "s390x"))]
mod on {
    use semihosting::fs::File;
    use semihosting::io::{Read, Write, stdout};
    use semihosting::process::ExitCode;

    // Linux aligns the stack.
    #[cfg(target_arch = "riscv32")]
    core::arch::global_asm!(".globl _start", "_start: call main");

    #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
    #[cfg_attr(target_arch = "riscv32", unsafe(no_mangle))]
    fn main() -> ! {
        crate::run();
        exit(true)
    }

    pub struct In(File);

    impl In {
        pub fn new() -> Self {
            Self(File::open(c"/dev/stdin").expect("the host has an input"))
        }

        /// As many bytes as there are.
        pub fn read(&mut self, bytes: &mut [u8]) -> usize {
            self.0.read(bytes).expect("it can be read")
        }
    }

    pub fn write(bytes: &[u8]) {
        let _ = stdout().and_then(|mut out| out.write_all(bytes));
    }

    pub fn exit(succeeded: bool) -> ! {
        if succeeded { ExitCode::SUCCESS } else { ExitCode::FAILURE }.exit_process()
    }
}

#[cfg(target_arch = "s390x")]
mod on {
    use syscalls::{Sysno, syscall};

    core::arch::global_asm!(".globl _start", "_start: aghi %r15, -160", "brasl %r14, main");

    #[unsafe(no_mangle)]
    fn main() -> ! {
        crate::run();
        exit(true)
    }

    pub fn write(bytes: &[u8]) {
        // SAFETY: `stdout` takes so many bytes from there.
        let _ = unsafe { syscall!(Sysno::write, 1, bytes.as_ptr(), bytes.len()) };
    }

    pub fn exit(succeeded: bool) -> ! {
        // SAFETY: ends the program.
        let _ = unsafe { syscall!(Sysno::exit, usize::from(!succeeded)) };
        loop {}
    }
}
