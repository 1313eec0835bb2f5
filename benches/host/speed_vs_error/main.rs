//! Speed against error: the report `docs/internals/speed-vs-error.md` and its pictures, from one run.
//!
//! `cargo bench -p benches --bench speed_vs_error`, and after `--`: `--quick` for seconds instead of minutes and a
//! report in `target/speed-vs-error`, `--search N` to look for the worst of N curves, `--every-f32` to try every
//! `f32` on a dozen curves. The last two leave tables in `docs`, which the next report takes in.

mod accuracy;
mod every_f32;
mod follower;
mod methods;
mod pictures;
mod report;
mod search;
#[path = "../../../tests/support/mod.rs"]
mod support;
mod sweep;
mod sweep_t;
mod sweep_u;
mod table;
mod timing;

use methods::CURVES;
use report::Measured;
use support::rendering::{PULSES, Picture, Pulses};

type Result<T = (), E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

fn main() -> Result {
    // All paths are the repository's; cargo starts a bench in its package, and adds an argument.
    std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
    // The report says how long so many took.
    rayon::ThreadPoolBuilder::new().num_threads(2).build_global()?;
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => report("docs/internals", 200, 4000, 101),
        // Rough figures are to be looked at, not to be kept.
        ["--quick"] => report("target/speed-vs-error", 20, 500, 5),
        ["--search", curves] => save("docs/internals/search.csv", &search::search(curves.parse()?)),
        ["--every-f32"] => every_f32::every_f32(|rows| save("docs/internals/every-f32.csv", rows)),
        _ => Err("usage: see speed_vs_error/main.rs".into()),
    }
}

fn report(folder: &str, random: u64, samples: usize, repeats: usize) -> Result {
    std::fs::create_dir_all(folder)?;
    let curves = accuracy::curves(random);
    let scene = Picture::new(&CURVES[0].1);
    let rendering =
        (6..=12).map(|k| (1 << k, PULSES.map(|pulses| rendered(&scene, pulses, 1 << k))));
    let measured = Measured {
        curves: curves.len(),
        samples,
        figures: accuracy::measure(&curves, samples),
        times: CURVES.map(|(_, curve)| timing::times(&curve, repeats)),
        cost: std::fs::read_to_string("docs/internals/cost.md")?,
        rendering: rendering.collect(),
        search: table::read("docs/internals/search.csv")?,
        every_f32: table::read("docs/internals/every-f32.csv")?,
    };
    pictures::frontier(&format!("{folder}/frontier.svg"), &measured);
    pictures::rendering(&format!("{folder}/rendering.svg"));
    pictures::worst_cases(&format!("{folder}/worst-cases.svg"), 15 * random);
    let report = format!("{folder}/speed-vs-error.md");
    std::fs::write(&report, report::write(&measured))?;
    println!("{}\nwrote {report} and its pictures", report::ratios(&measured));
    Ok(())
}

/// The root-mean-square error of a picture in `n` pulses; of several, where they are random.
fn rendered(scene: &Picture, pulses: Pulses, n: u32) -> f64 {
    let seeds = if pulses == Pulses::Random { 16 } else { 1 };
    let squares = (0..seeds).map(|seed| scene.error(&scene.exposed(pulses, n, seed)).1.powi(2));
    (squares.sum::<f64>() / seeds as f64).sqrt()
}

fn save<T: serde::Serialize>(path: &str, rows: &[T]) -> Result {
    let mut file = csv::Writer::from_path(path)?;
    rows.iter().try_for_each(|row| file.serialize(row))?;
    Ok(file.flush()?)
}
