//! Speed against error: a report and its picture, from one run.
//!
//! `cargo bench -p benches` leaves rough figures in `target/speed-vs-error`, after seconds. With `-- --write-docs` it
//! takes minutes, on a machine that does nothing else, and writes `docs/internals/speed-vs-error.md`. `--search N`
//! looks for the worst of N curves, `--every-f32` tries every `f32` on a dozen: with `--write-docs` they leave tables
//! for the next report.

mod accuracy;
mod every_f32;
mod follower;
mod methods;
mod picture;
mod report;
mod search;
#[path = "../../../tests/support/mod.rs"]
mod support;
mod timing;

use report::Measured;

/// Where documents are; what other runs left is read from there.
const DOCS: &str = "docs/internals";
const SEARCH: &str = "search.csv";
const EVERY_F32: &str = "every-f32.csv";

type Result<T = (), E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

fn main() -> Result {
    // All paths are the repository's; cargo starts a bench in its package, and adds an argument.
    std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
    // The report says how long so many took.
    rayon::ThreadPoolBuilder::new().num_threads(2).build_global()?;
    let mut arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let asked = arguments.len();
    arguments.retain(|argument| argument != "--write-docs");
    let is_kept = arguments.len() < asked;
    let folder = if is_kept { DOCS } else { "target/speed-vs-error" };
    std::fs::create_dir_all(folder)?;
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] if is_kept => report(folder, 200, 4000, 101),
        [] => report(folder, 20, 500, 5),
        ["--search", curves] => save(folder, SEARCH, &search::search(curves.parse()?)),
        ["--every-f32"] => every_f32::every_f32(|rows| save(folder, EVERY_F32, rows)),
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
        cost: std::fs::read_to_string(format!("{DOCS}/cost.md"))?,
        search: read(SEARCH)?,
        every_f32: read(EVERY_F32)?,
    };
    picture::frontier(&format!("{folder}/frontier.svg"), &measured)?;
    let report = format!("{folder}/speed-vs-error.md");
    std::fs::write(&report, report::write(&measured))?;
    println!("wrote {report} and its picture");
    Ok(())
}

fn read<T: serde::de::DeserializeOwned>(name: &str) -> Result<Vec<T>> {
    Ok(csv::Reader::from_path(format!("{DOCS}/{name}"))?.into_deserialize().collect::<Result<_, _>>()?)
}

fn save<T: serde::Serialize>(folder: &str, name: &str, rows: &[T]) -> Result {
    let mut file = csv::Writer::from_path(format!("{folder}/{name}"))?;
    rows.iter().try_for_each(|row| file.serialize(row))?;
    Ok(file.flush()?)
}
