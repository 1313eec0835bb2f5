//! Speed against error: the report `docs/speed-vs-error.md` and its pictures, from one run.
//!
//! `cargo bench -p benches --bench speed_vs_error`, and after `--`: `--quick` for seconds instead of minutes and a
//! report in `target/speed-vs-error`, `--search N` to look for the worst of N curves, `--every-f32` to try every
//! `f32` on a dozen curves. The last two leave tables in `docs`, which the next report takes in.

mod accuracy;
mod aimed;
mod cost;
#[path = "../curves.rs"]
mod curves;
mod every_f32;
mod follower;
mod methods;
mod number;
mod others;
mod pictures;
mod report;
mod search;
mod style;
#[path = "../../../tests/support/mod.rs"]
mod support;
mod sweep;
mod sweep_t;
mod sweep_u;
mod timing;

use accuracy::Amount;
use clap::Parser;
use curves::CURVES;
use indicatif::{ProgressBar, ProgressStyle};
use methods::METHODS;
use report::Measured;
use support::rendering::{PULSES, Picture, Pulses};

#[derive(Parser)]
#[command(about = "Speed against error")]
struct Args {
    /// Seconds instead of minutes, rougher figures, and the report in target/speed-vs-error.
    #[arg(long)]
    quick: bool,
    /// Look for the worst of so many curves that are bred and as many that are aimed, and write docs/search.csv.
    #[arg(long, value_name = "N")]
    search: Option<u64>,
    /// Try every f32 on ten curves, and write docs/every-f32.csv.
    #[arg(long)]
    every_f32: bool,
    /// What cargo adds.
    #[arg(long, hide = true)]
    bench: bool,
}

type Result<T = (), E = Box<dyn std::error::Error>> = std::result::Result<T, E>;

fn main() -> Result {
    let args = Args::parse();
    // All paths are the repository's; cargo starts a bench in its package.
    std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
    if let Some(curves) = args.search {
        let bar = progress("search", 2 * curves);
        let mut finds = search::search(curves, || bar.inc(1));
        finds.extend(aimed::search(curves, || bar.inc(1)));
        return save("docs/search.csv", &finds);
    }
    if args.every_f32 {
        let bar = progress("every f32", 1);
        return every_f32::every_f32(&bar, |rows| save("docs/every-f32.csv", rows));
    }
    let measured = measure(args.quick)?;
    // Rough figures are to be looked at, not to be kept.
    let (folder, curves) = if args.quick { ("target/speed-vs-error", 200) } else { ("docs", 3000) };
    std::fs::create_dir_all(folder)?;
    draw(&measured, curves, folder);
    let report = format!("{folder}/speed-vs-error.md");
    std::fs::write(&report, report::write(&measured))?;
    println!("{}", report::ratios(&measured.times));
    println!("wrote {report} and its pictures");
    Ok(())
}

fn measure(quick: bool) -> Result<Measured> {
    let amount = if quick {
        Amount { random_curves: 20, samples: 500, neighbours: 500 }
    } else {
        Amount { random_curves: 200, samples: 4000, neighbours: 4000 }
    };
    let curves = accuracy::count(&amount);
    let bar = progress("error", curves as u64);
    let figures = accuracy::measure(&amount, || bar.inc(1));
    bar.finish();

    let repeats = if quick { 5 } else { 101 };
    let bar = progress("time", (CURVES.len() * repeats) as u64);
    let all = 0..CURVES.len();
    let times =
        all.clone().map(|i| timing::inverses(&timing::curve(i), repeats, || bar.inc(1))).collect();
    let forwards = all.map(|i| timing::forwards(&timing::curve(i), repeats)).collect();
    bar.finish();

    let scene = Picture::new(&timing::curve(0));
    let rendering = PULSES.map(|pulses| {
        let errors = (6..=12).map(|k| (1 << k, rendered(&scene, pulses, 1 << k)));
        (pulses, errors.collect())
    });
    Ok(Measured {
        curves,
        samples: amount.samples,
        figures,
        times,
        forwards,
        costs: cost::read("docs/cost.md"),
        rendering: rendering.into(),
        finds: table("docs/search.csv")?,
        every_f32: table("docs/every-f32.csv")?,
    })
}

/// The root-mean-square error of a picture in `n` pulses; of several, where they are random.
fn rendered(scene: &Picture, pulses: Pulses, n: u32) -> f64 {
    let seeds = if pulses == Pulses::Random { 16 } else { 1 };
    let squares = (0..seeds).map(|seed| scene.error(&scene.exposed(pulses, n, seed)).1.powi(2));
    (squares.sum::<f64>() / seeds as f64).sqrt()
}

fn draw(measured: &Measured, curves: u64, folder: &str) {
    let path = |name: &str| format!("{folder}/{name}.svg");
    let host = measured.times[0].iter().map(|time| time.single).enumerate().collect();
    let mut panels = vec![("nanoseconds a sample on the host, soft curve", host)];
    let cycles = METHODS.iter().enumerate().filter_map(|(index, method)| {
        report::cost(measured, method).map(|cost| (index, cost.mean))
    });
    let cycles: Vec<_> = cycles.collect();
    if !cycles.is_empty() {
        panels.push(("mean cycles a sample on a Cortex-M4F (model), soft curve", cycles));
    }
    pictures::frontier(&path("frontier"), &panels, &measured.figures);
    pictures::over_u(&path("error-over-u"));
    pictures::histogram(&path("histogram"), &measured.figures);
    pictures::rendering(&path("rendering"), &measured.rendering);
    let bar = progress("worst cases", 2 * curves);
    pictures::worst_cases(&path("worst-cases"), curves, || bar.inc(1));
    bar.finish();
}

fn progress(what: &'static str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{msg:12} {wide_bar} {percent:>3} %, {eta} left");
    let style = style.expect("a good template");
    ProgressBar::new(length).with_style(style).with_message(what)
}

fn save<T: serde::Serialize>(path: &str, rows: &[T]) -> Result {
    let mut file = csv::Writer::from_path(path)?;
    for row in rows {
        file.serialize(row)?;
    }
    Ok(file.flush()?)
}

/// The rows of a table that another run left, or none.
fn table<T: serde::de::DeserializeOwned>(path: &str) -> Result<Vec<T>> {
    if !std::path::Path::new(path).exists() {
        return Ok(Vec::new());
    }
    Ok(csv::Reader::from_path(path)?.into_deserialize().collect::<Result<_, _>>()?)
}
