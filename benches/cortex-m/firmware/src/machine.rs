//! Where a program runs: on one of QEMU's boards with an Arm core; as a bare Linux program, by system calls alone, for other
//! processors in QEMU's user mode; or as WebAssembly, of which the host is asked to print. It starts in the crate's `run`.

use core::fmt;

pub use on::{exit, write};

/// What is printed.
pub struct Out;

impl fmt::Write for Out {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        write(text.as_bytes());
        Ok(())
    }
}

#[cfg(target_arch = "arm")]
mod on {
    use semihosting::io::{Write, stdout};
    use semihosting::process::ExitCode;

    #[cortex_m_rt::entry]
    #[allow(unreachable_code, reason = "some programs run for ever")]
    fn main() -> ! {
        crate::run();
        exit(true)
    }

    pub fn write(bytes: &[u8]) {
        let _ = stdout().and_then(|mut out| out.write_all(bytes));
    }

    pub fn exit(succeeded: bool) -> ! {
        if succeeded { ExitCode::SUCCESS } else { ExitCode::FAILURE }.exit_process()
    }
}

#[cfg(target_arch = "wasm32")]
mod on {
    #[link(wasm_import_module = "host")]
    unsafe extern "C" {
        #[link_name = "write"]
        fn host_write(bytes: *const u8, length: usize);
    }

    #[unsafe(no_mangle)]
    #[allow(unreachable_code, reason = "some programs run for ever")]
    extern "C" fn _start() {
        crate::run();
    }

    pub fn write(bytes: &[u8]) {
        // SAFETY: the host reads so many bytes from there.
        unsafe { host_write(bytes.as_ptr(), bytes.len()) }
    }

    pub fn exit(_: bool) -> ! {
        core::arch::wasm32::unreachable()
    }
}

#[cfg(not(any(target_arch = "arm", target_arch = "wasm32")))]
mod on {
    use core::arch::{asm, global_asm};

    // Linux aligns the stack; what a function expects beside that differs.
    #[cfg(any(target_arch = "riscv32", target_arch = "riscv64"))]
    global_asm!(".globl _start", "_start: call started");
    #[cfg(target_arch = "x86")]
    global_asm!(".globl _start", "_start: call started");
    #[cfg(target_arch = "s390x")]
    global_asm!(".globl _start", "_start: aghi %r15, -160", "brasl %r14, started");
    #[cfg(target_arch = "powerpc")]
    global_asm!(".globl _start", "_start: stwu 1, -16(1)", "bl started");

    #[unsafe(no_mangle)]
    #[allow(unreachable_code, reason = "some programs run for ever")]
    extern "C" fn started() -> ! {
        crate::run();
        exit(true)
    }

    pub fn write(bytes: &[u8]) {
        let number =
            if cfg!(any(target_arch = "riscv32", target_arch = "riscv64")) { 64 } else { 4 };
        // SAFETY: `write` to stdout, which reads so many bytes from there.
        unsafe { call(number, [1, bytes.as_ptr() as usize, bytes.len(), 0, 0, 0]) };
    }

    pub fn exit(succeeded: bool) -> ! {
        let number =
            if cfg!(any(target_arch = "riscv32", target_arch = "riscv64")) { 93 } else { 1 };
        // SAFETY: `exit` ends the program.
        unsafe { call(number, [usize::from(!succeeded), 0, 0, 0, 0, 0]) };
        loop {}
    }

    /// Linux's system call of this number: three arguments, six on a RISC-V.
    unsafe fn call(number: usize, [a, b, c, d, e, f]: [usize; 6]) -> usize {
        let result;
        #[cfg(any(target_arch = "riscv32", target_arch = "riscv64"))]
        // SAFETY: as the caller says.
        unsafe {
            asm!("ecall", in("a7") number, inlateout("a0") a => result,
                in("a1") b, in("a2") c, in("a3") d, in("a4") e, in("a5") f)
        };
        #[cfg(not(any(target_arch = "riscv32", target_arch = "riscv64")))]
        let _ = (d, e, f);
        #[cfg(target_arch = "x86")]
        // SAFETY: as the caller says.
        unsafe {
            asm!("int 0x80", inlateout("eax") number => result, in("ebx") a, in("ecx") b, in("edx") c)
        };
        #[cfg(target_arch = "s390x")]
        // SAFETY: as the caller says.
        unsafe {
            asm!("svc 0", in("r1") number, inlateout("r2") a => result, in("r3") b, in("r4") c)
        };
        #[cfg(target_arch = "powerpc")]
        // SAFETY: as the caller says.
        unsafe {
            asm!("sc", inlateout("r0") number => _, inlateout("r3") a => result,
                inlateout("r4") b => _, inlateout("r5") c => _, lateout("r6") _, lateout("r7") _,
                lateout("r8") _, lateout("r9") _, lateout("r10") _, lateout("r11") _, lateout("r12") _,
                lateout("cr0") _)
        };
        result
    }

    /// The memory at a fixed address, filled from stdin as far as that goes.
    #[cfg(target_arch = "riscv32")]
    #[allow(dead_code, reason = "only what is measured needs memory of its own")]
    pub fn map(address: usize, length: usize) {
        const READ_WRITE: usize = 3;
        const PRIVATE_FIXED_ANONYMOUS: usize = 0x32;
        // SAFETY: `mmap2` where nothing is, and `read` into it.
        unsafe {
            call(222, [address, length, READ_WRITE, PRIVATE_FIXED_ANONYMOUS, usize::MAX, 0]);
            let mut filled = 0;
            loop {
                let read = call(63, [0, address + filled, length - filled, 0, 0, 0]);
                if read.cast_signed() <= 0 {
                    return;
                }
                filled += read;
            }
        }
    }
}

#[cfg(target_arch = "riscv32")]
#[allow(unused_imports, reason = "only what is measured needs memory of its own")]
pub use on::map;
