//! Calls code whose cycles others have published, each once, for the host to count.
#![no_std]
#![no_main]

use core::arch::naked_asm;

#[path = "../machine.rs"]
mod machine;

use machine::panicked;

type Program = unsafe extern "C" fn(u32, u32, u32) -> u32;

/// A program of these instructions, which begins at a word.
macro_rules! program {
    ($name:ident: $($instruction:literal)*) => {
        #[unsafe(naked)]
        extern "C" fn $name(_: u32, _: u32, _: u32) -> u32 {
            naked_asm!($($instruction),*)
        }
    };
}

program!(nothing: "bx lr");
// A loop from a 32-bit instruction across two words, and one from a 16-bit instruction.
program!(wide_loop:
    "mov r2, r0" "mov.w r0, #1" "2: mul r0, r0, r2"
    "sub.w r1, r1, #1" "cmp r1, #0" "bne 2b" "bx lr"
);
program!(narrow_loop:
    "mov r2, r0" "mov.w r0, #1" "2: add r0, r2"
    "sub.w r1, r1, #1" "cmp r1, #0" "bne 2b" "bx lr"
);
// 32-bit instructions across two words each, and not.
program!(split: "mov r8, r8" "mov.w r8, r8" "mov.w r8, r8" "mov.w r8, r8" "bx lr");
program!(whole: "mov.w r8, r8" "mov.w r8, r8" "mov.w r8, r8" "mov.w r8, r8" "bx lr");
program!(delay: "2: subs r0, #1" "bne 2b" "bx lr");
program!(delay_nop: "2: nop" "subs r0, #1" "bne 2b" "bx lr");

#[cfg(p256)]
core::arch::global_asm!(include_str!(env!("P256")), options(raw));

#[cfg(p256)]
unsafe extern "C" {
    fn P256_decompress_point(y: u32, x: u32, parity: u32) -> u32;
}

/// What is measured; the host takes off what it measures of `nothing`.
#[inline(never)]
fn the_call(program: Program, a: u32, b: u32, c: u32) -> u32 {
    // SAFETY: those programs take numbers, or addresses of as many words as they read and write.
    unsafe { program(a, b, c) }
}

fn measure(program: Program, [a, b, c]: [u32; 3]) -> u32 {
    the_call(core::hint::black_box(program), a, b, c)
}

fn run() {
    measure(nothing, [0; 3]);
    assert_eq!(measure(wide_loop, [2, 3, 0]), 8);
    assert_eq!(measure(narrow_loop, [2, 3, 0]), 7);
    measure(split, [0; 3]);
    measure(whole, [0; 3]);
    measure(delay, [1000, 0, 0]);
    measure(delay_nop, [1000, 0, 0]);
    #[cfg(p256)]
    {
        // The generator's.
        let x = [
            0xD898C296u32,
            0xF4A13945,
            0x2DEB33A0,
            0x77037D81,
            0x63A440F2,
            0xF8BCE6E5,
            0xE12C4247,
            0x6B17D1F2,
        ];
        let mut y = [0u32; 8];
        let places = [(&raw mut y) as u32, (&raw const x) as u32, 1];
        assert_eq!(measure(P256_decompress_point, places), 1);
        assert_eq!(core::hint::black_box(y)[0], 0x37BF51F5);
    }
}
