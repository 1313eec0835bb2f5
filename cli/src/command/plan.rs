//! `shutter plan`: scene files in, checked lists of trigger times out, with a picture of one.

use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use shutter_fit::unit::short;

use super::input::{self, shown, stem};
use super::mark::{self, Comment};
use super::output::{Outputs, svg_path};
use super::settings::Settings;
use crate::emit::Form;
use crate::plan::Plan;
use crate::planned::Planned;
use crate::{emit, facts, picture, report, speeds};

/// The scene without a file, and the name it goes by.
const DEFAULT: (&str, &str) = ("soft", include_str!("../../scenes/soft.toml"));

/// Plan a shutter's triggers, each in the middle of an equal share of the exposure
///
/// Several scenes are taken as the speeds of one shutter: they make a table or, with --emit, one text with an array of
/// all.
#[derive(clap::Args, Default)]
pub struct Args {
    /// The scenes, such as those in cli/scenes; if left out, a soft shutter; `-` is standard input
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    settings: Settings,
    /// Write the picture to this file
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    out: Option<PathBuf>,
    /// Write a picture of both set-ups to this file: the curve emulated, and the shutter in the light's path
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    set_ups: Option<PathBuf>,
    /// Print the plan in this form, and no report
    #[arg(long, value_name = "FORM")]
    emit: Option<Form>,
    /// Add the curve to the Rust module, for firmware that uses the crate
    #[arg(long, requires = "emit")]
    curve: bool,
    /// Write the form to this file instead of standard output
    #[arg(long, value_name = "FILE", requires = "emit")]
    to: Option<PathBuf>,
    /// Replace files that hold something else, or that you have changed
    #[arg(long)]
    force: bool,
    /// The plan's name; if left out, the scene's file name, or `shutter` for several
    #[arg(long)]
    name: Option<String>,
}

type Draw = fn(&str, &Planned) -> Result<String, Box<dyn Error>>;

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    let Args { scenes, out: picture, set_ups, emit: form, to, .. } = args;
    if scenes.len() > 1 && (picture.is_some() || set_ups.is_some()) {
        return Err("a picture is of one scene".into());
    }
    let inputs: Vec<&Path> = scenes.iter().map(PathBuf::as_path).collect();
    let printed = form.filter(|_| to.is_none()).map(|_| Path::new("-"));
    let files = [picture, set_ups, to].into_iter().flatten().map(PathBuf::as_path);
    let files: Vec<&Path> = files.chain(printed).collect();
    let mut outputs = Outputs::new(&inputs, &files, args.force)?;
    let mut told = String::new();
    let plans = match scenes.as_slice() {
        [] => vec![(DEFAULT.0.into(), checked(args, DEFAULT.0, DEFAULT.1)?)],
        paths => paths.iter().map(|path| read(args, path, &mut told)).collect::<Result<Vec<_>, String>>()?,
    };
    for (name, plan) in plans.iter().filter(|_| form.is_some()) {
        let of_curve = |fact: fn(&Plan) -> Option<String>| plan.plan().and_then(fact);
        let doubts = [
            of_curve(facts::dimmed).map(|doses| {
                format!(
                    "the shutter is in the light's path, and dims the flashes to {doses}; \
                     --duty 0.5 (pulses) or --fully-open (xenon) makes doses equal"
                )
            }),
            of_curve(facts::unequal).map(|by| {
                format!("a tick is so long that the doses differ by up to {by} %; a faster timer makes them equal")
            }),
            facts::coarse(plan).map(|by| {
                let by = short(by, 2);
                format!(
                    "a tick is so long that flashes move by up to {by} % of a share; a faster timer moves them less"
                )
            }),
        ];
        told.extend(doubts.into_iter().flatten().map(|doubt| format!("warning: {name}: {doubt}\n")));
    }
    let text = match (plans.as_slice(), form) {
        ([(name, plan)], _) => {
            let name = args.name.as_ref().unwrap_or(name);
            let pictures: [(_, Draw); 2] = [(picture, picture::svg), (set_ups, draw_set_ups)];
            for (file, draw) in pictures {
                if let Some(file) = file {
                    let svg = draw(name, plan).map_err(|e| format!("the picture: {e}"))?;
                    outputs.add(file, mark::SVG, &svg)?;
                }
            }
            match form {
                Some(form) => emit::emit(*form, name, plan, args.curve)
                    .map_err(|reason| format!("{}: {reason}", scenes.first().map_or(name.clone(), |it| shown(it))))?,
                None => report::text(name, plan, report::width()),
            }
        }
        (plans, Some(form)) => emit::several(*form, args.name.as_deref().unwrap_or("shutter"), plans, args.curve)?,
        (plans, None) => speeds::text(plans),
    };
    let printed = match to.as_ref().zip(*form) {
        Some((file, form)) => {
            match comment(form) {
                Some(comment) => outputs.add(file, comment, &text)?,
                None => outputs.add_table(file, text)?,
            }
            String::new()
        }
        None => text,
    };
    told += &outputs.ready()?.finish(out, &printed)?;
    // There is no one to tell if standard error cannot be written.
    let _ = err.write_all(told.as_bytes());
    Ok(())
}

/// The comments of a form, if it has some.
fn comment(form: Form) -> Option<Comment> {
    match form {
        Form::Rust => Some(mark::RUST),
        Form::C => Some(mark::C),
        Form::Csv | Form::Json => None,
    }
}

/// The picture of both set-ups, whose doses come from a curve.
fn draw_set_ups(name: &str, plan: &Planned) -> Result<String, Box<dyn Error>> {
    let curve = plan.plan().ok_or("the set-ups are told apart by a curve, and the scene has none")?;
    picture::set_ups(name, curve)
}

fn read(args: &Args, path: &Path, told: &mut String) -> Result<(String, Planned), String> {
    let file = shown(path);
    let text =
        input::read(path).and_then(|bytes| String::from_utf8(bytes).map_err(|_| "it is no text in UTF-8".into()));
    let text = text.map_err(|reason| format!("{file}: {reason}"))?;
    if let Some(doubt) = args.settings.doubt(&file, &text) {
        *told += &format!("warning: {doubt}\n");
    }
    Ok((stem(path), checked(args, &file, &text)?))
}

fn checked(args: &Args, file: &str, text: &str) -> Result<Planned, String> {
    let set = args.settings.of(text);
    Planned::parse(&set).map_err(|mut fault| {
        if set != text {
            // What stands in no file has no line there.
            fault.at = fault.at.filter(|_| fault.line(&set) == fault.line(text));
            fault.notes.push("The command line sets some of this scene.".into());
        }
        fault.locate(file, text)
    })
}
