//! `shutter plan`: scene files in, checked lists of trigger times out, with a picture of one.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::input::{self, shown, stem};
use super::mark::{self, Comment};
use super::output::{Outputs, svg_path};
use super::settings::Settings;
use crate::{picture, report, speeds};
use shutter_plan::emit;
use shutter_plan::emit::Form;
use shutter_plan::facts::Facts;
use shutter_plan::plan::Plan;
use shutter_plan::scene::Scene;

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

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    let Args { scenes, out: picture, emit: form, to, .. } = args;
    if scenes.len() > 1 && picture.is_some() {
        return Err("a picture is of one scene".into());
    }
    let inputs: Vec<&Path> = scenes.iter().map(PathBuf::as_path).collect();
    let printed = form.filter(|_| to.is_none()).map(|_| Path::new("-"));
    let files = [picture, to].into_iter().flatten().map(PathBuf::as_path);
    let files: Vec<&Path> = files.chain(printed).collect();
    let mut outputs = Outputs::new(&inputs, &files, args.force)?;
    let plans = match scenes.as_slice() {
        [] => vec![(DEFAULT.0.into(), checked(args, DEFAULT.0, DEFAULT.1)?)],
        _ => {
            let plans: Vec<Plan> = inputs.iter().map(|path| read(args, path)).collect::<Result<_, _>>()?;
            input::names(&inputs, stem).into_iter().zip(plans).collect()
        }
    };
    // A report has them itself.
    let mut told = match (scenes.is_empty(), form) {
        (true, Some(_)) => "warning: no scene is named, so this is the example, soft\n".into(),
        _ => String::new(),
    };
    for (name, plan) in plans.iter().filter(|_| form.is_some() || plans.len() > 1) {
        let doubts = Facts::new(plan).doubts;
        told.extend(doubts.iter().map(|doubt| format!("warning: {name}: {}\n", doubt.text)));
    }
    let text = match (plans.as_slice(), form) {
        ([(name, plan)], _) => {
            let name = args.name.as_ref().unwrap_or(name);
            if let Some(file) = picture {
                let svg = picture::svg(name, plan).map_err(|e| format!("the picture: {e}"))?;
                outputs.add(file, Some(mark::SVG), svg)?;
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
            outputs.add(file, comment(form), text)?;
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

fn read(args: &Args, path: &Path) -> Result<Plan, String> {
    let file = shown(path);
    let text =
        input::read(path).and_then(|bytes| String::from_utf8(bytes).map_err(|_| "it is no text in UTF-8".into()));
    let text = text.map_err(|reason| format!("{file}: {reason}"))?;
    checked(args, &file, &text)
}

fn checked(args: &Args, file: &str, text: &str) -> Result<Plan, String> {
    let mut scene = Scene::parse(text).map_err(|fault| fault.locate(file, text))?;
    let set = args.settings.set(&mut scene);
    Plan::new(&scene).map_err(|mut fault| {
        if !set.is_empty() {
            fault.notes.push("The command line sets some of this scene.".into());
        }
        // What stands in no file has no line there.
        fault.locate(file, if set.iter().any(|key| key == fault.key) { "" } else { text })
    })
}
