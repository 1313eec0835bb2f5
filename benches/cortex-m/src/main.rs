//! What the crate costs on a microcontroller: instructions, cycles, bytes and stack. run.sh has the options.

mod answers;
mod budget;
mod firmware;
mod links;
mod measure;
mod model;
mod report;
mod trace;

type Error = Box<dyn std::error::Error + Send + Sync>;
type Result<T = (), E = Error> = std::result::Result<T, E>;

fn main() {
    let result = match std::env::args().nth(1).as_deref() {
        None => budget::run(),
        Some("--write-docs") => report::write(),
        Some("--answers") => answers::run(),
        Some("--links") => links::run(),
        Some(_) => Err("usage: see run.sh".into()),
    };
    if let Err(error) = result {
        eprintln!("{error}");
        std::process::exit(1);
    }
}
