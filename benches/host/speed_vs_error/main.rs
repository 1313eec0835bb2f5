//! Speed against error: what a call takes on this machine, beside other methods.
//!
//! `cargo bench` prints rough figures, in a minute after its build, and writes nothing. With `-- --write-docs` it takes
//! minutes, on a machine that does nothing else, and writes `docs/internals/speed-vs-error.md` with its picture.
//! `-- --every-f32` asks some curves for every `f32`, in half an hour.

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
    let cost = std::fs::read_to_string(format!("{DOCS}/cost.md"))?;
    match std::env::args().skip(1).find(|argument| argument != "--bench").as_deref() {
        None => println!("{}", report::methods(&Measured::new(20, 500, 900, 5, &cost)?)),
        Some("--every-f32") => every_f32::every_f32(),
        Some("--write-docs") => {
            let measured = Measured::new(200, 4000, 9000, 101, &cost)?;
            std::fs::write(format!("{DOCS}/frontier.svg"), picture::frontier(&measured)?)?;
            std::fs::write(format!("{DOCS}/speed-vs-error.md"), report::page(&measured))?;
        }
        Some(_) => return Err("usage: see speed_vs_error/main.rs".into()),
    }
    Ok(())
}
