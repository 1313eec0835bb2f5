//! Speed against error: what a call takes on this machine, beside other methods.
//!
//! `cargo bench` prints rough figures, in a minute after its build, and writes nothing. With `-- --write-docs` it takes
//! minutes, on a machine that does nothing else, and writes `docs/internals/speed-vs-error.md` with its picture.
//! `-- --every-f32` asks some curves for every `f32`, and writes `every-f32.md` beside it.

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
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => {
            println!("{}", report::methods(&measured(20, 500, 900, 5)?));
            Ok(())
        }
        ["--write-docs"] => {
            let measured = measured(200, 4000, 9000, 101)?;
            write("frontier.svg", picture::frontier(&measured)?)?;
            write("speed-vs-error.md", report::page(&measured))
        }
        ["--every-f32"] => write("every-f32.md", report::every_f32(&every_f32::every_f32())),
        _ => Err("usage: see speed_vs_error/main.rs".into()),
    }
}

/// On so many random and so many hard curves.
fn measured(random: u64, samples: usize, hard: usize, repeats: usize) -> Result<Measured> {
    let curves = accuracy::curves(random);
    Ok(Measured {
        curves: curves.len(),
        samples,
        hard: (hard, accuracy::of_hard_curves(hard)),
        figures: accuracy::measure(&curves, samples),
        times: timing::times(repeats),
        cycles: report::cycles(&std::fs::read_to_string(format!("{DOCS}/cost.md"))?)?,
    })
}

fn write(name: &str, text: String) -> Result {
    println!("writing {DOCS}/{name}");
    Ok(std::fs::write(format!("{DOCS}/{name}"), text)?)
}
