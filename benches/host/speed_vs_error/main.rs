//! Speed against error: a report and its picture, from one run.
//!
//! `cargo bench -p benches` leaves rough figures in `target/speed-vs-error`, after seconds. With `-- --write-docs` it
//! takes minutes, on a machine that does nothing else, and writes `docs/internals/speed-vs-error.md`. `--every-f32`
//! tries every `f32` on some curves, and writes `every-f32.md`.

mod accuracy;
mod every_f32;
mod methods;
mod picture;
mod report;
#[path = "../../../tests/support/mod.rs"]
mod support;
mod timing;

use report::Measured;

const DOCS: &str = "docs/internals";

type Result<T = (), E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

fn main() -> Result {
    // All paths are the repository's; cargo starts a bench in its package, and adds an argument.
    std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
    let mut arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let asked = arguments.len();
    arguments.retain(|argument| argument != "--write-docs");
    let is_kept = arguments.len() < asked;
    let folder = if is_kept { DOCS } else { "target/speed-vs-error" };
    std::fs::create_dir_all(folder)?;
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] if is_kept => report(folder, 200, 4000, 101),
        [] => report(folder, 20, 500, 5),
        ["--every-f32"] => write(&format!("{folder}/every-f32.md"), report::every_f32(&every_f32::every_f32())),
        _ => Err("usage: see speed_vs_error/main.rs".into()),
    }
}

fn report(folder: &str, random: u64, samples: usize, repeats: usize) -> Result {
    let curves = accuracy::curves(random);
    let measured = Measured {
        curves: curves.len(),
        samples,
        figures: accuracy::measure(&curves, samples),
        times: timing::times(repeats),
        cycles: report::cycles(&std::fs::read_to_string(format!("{DOCS}/cost.md"))?)?,
    };
    write(&format!("{folder}/frontier.svg"), picture::frontier(&measured)?)?;
    write(&format!("{folder}/speed-vs-error.md"), report::methods(&measured))
}

fn write(path: &str, text: String) -> Result {
    println!("writing {path}");
    Ok(std::fs::write(path, text)?)
}
