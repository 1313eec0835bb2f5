//! Prints the hash of many answers, on the host as on the microcontroller.
#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
use semihosting::println;

fn print() {
    let [a, b, c, d] = firmware::answers::hashes();
    println!("{a:016x} {b:016x} {c:016x} {d:016x}");
}

#[cfg(not(target_os = "none"))]
fn main() {
    print();
}

#[cfg(target_os = "none")]
mod board {
    use semihosting::process::ExitCode;

    #[cortex_m_rt::entry]
    fn main() -> ! {
        super::print();
        ExitCode::SUCCESS.exit_process()
    }

    #[panic_handler]
    fn panic(info: &core::panic::PanicInfo) -> ! {
        semihosting::eprintln!("{info}");
        ExitCode::FAILURE.exit_process()
    }
}
