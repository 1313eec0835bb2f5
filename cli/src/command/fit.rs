//! `shutter fit`: a measured trace in, the simplest shutter that serves out, as a scene.

use std::io::Write;
use std::iter::once;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use clap::builder::RangedI64ValueParser;
use shutter_fit::delay::{self, Delay};
use shutter_fit::trace::{self, Light, Tell, Warning};
use shutter_fit::unit::{Unit, count, rounded, short, stops};
use shutter_fit::{Kind, Options, Record};

use super::fit_many::{self, Speed};
use super::input::{file_name, names, shown, stem};
use super::mark;
use super::output::{Outputs, Ready, is_same, is_std, is_stream, print, svg_path};
use super::quantity::{rate, speed, time};
use super::read::{self, Asked, Read};
use crate::picture;
use shutter_plan::emit::Form;
use shutter_plan::facts::Facts;
use shutter_plan::fitted;
use shutter_plan::plan::{MOST_TRIGGERS, Plan};
use shutter_plan::scene::{Scene, Written};

/// Fit the simplest shutter to a measured trace, and write it as a scene
///
/// The trace is a CSV with a time and a signal in each row, as oscilloscopes, logic analysers and shutter testers
/// export it, or a WAV. The report goes to standard output, warnings to standard error. If the trace is refused, the
/// exit code is 2, and nothing is written.
#[derive(Clone, clap::Args)]
pub struct Args {
    /// The trace; `-` is standard input
    trace: PathBuf,
    /// More traces: shots whose exposures agree to 10 % make one scene; other speeds, or a --nominal for each, make a
    /// table
    #[arg(value_name = "TRACE")]
    others: Vec<PathBuf>,
    /// The nominal speed of each trace, in order, or one for a single setting: 1/250, 4ms
    #[arg(long, value_name = "TIME,...", value_delimiter = ',', value_parser = speed)]
    nominal: Vec<f64>,
    /// Write the scene to this file, for `shutter plan`, keeping your changes to one that a fit wrote; for several
    /// speeds, a folder of scenes; `-` is standard output, in place of the report
    #[arg(long, value_name = "SCENE.toml")]
    out: Option<PathBuf>,
    /// Write the picture to this file: trace, curve, residual, triggers
    #[arg(long, value_name = "FILE.svg", value_parser = svg_path)]
    picture: Option<PathBuf>,
    /// Replace files that hold something else, or that you have changed
    #[arg(long)]
    force: bool,
    /// The unit of the times, if the file does not say
    #[arg(long)]
    unit: Option<Unit>,
    /// The columns of time and signal, or of the signal alone, by number from 1 or by name; the signals of several
    /// sensors make a table of exposures and curtain travel
    #[arg(long, value_name = "TIME,SIGNAL,...", value_delimiter = ',', num_args = 1)]
    columns: Vec<String>,
    /// Samples per second, if the rows hold no time: 48000, 250kHz
    #[arg(long, value_name = "HERTZ", value_parser = rate)]
    rate: Option<f64>,
    /// The first time of the trace that counts: -5ms
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    from: Option<f64>,
    /// The last time of the trace that counts
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    to: Option<f64>,
    /// Which way light moves the signal
    #[arg(long, default_value = "auto")]
    light: Light,
    /// The signal of the fully open shutter, if this trace never reaches it
    #[arg(long, value_name = "SIGNAL", allow_negative_numbers = true)]
    full: Option<f64>,
    /// Which pulse to fit, counted from 1 through all traces of one setting; if left out, the one of median exposure
    #[arg(long, value_name = "NUMBER")]
    frame: Option<usize>,
    /// The shutter's model; if left out, the simplest that is good enough; the report tells by how much each moves the
    /// triggers
    #[arg(long)]
    model: Option<Kind>,
    /// How many triggers; if left out, as many as the existing scene has, or 16
    #[arg(long, value_name = "N", value_parser = trigger_count())]
    triggers: Option<u32>,
    /// The mains frequency in hertz, if there is hum in the trace
    #[arg(long, value_name = "50|60", value_parser = mains)]
    mains: Option<f64>,
    /// The camera's sync: its column by name or number (CH2, 3), the time of its edge in the trace (0, 1.5ms), or a
    /// file of the same record (F0001CH2.CSV); the scene gets the delay from the edge to the opening, and its spread
    /// between shots
    #[arg(long, value_name = "COLUMN|TIME|FILE", value_parser = read::sync, allow_hyphen_values = true)]
    sync: Vec<Asked>,
    /// The report's form; `json` is an object, or for several speeds an array; later versions keep its names
    #[arg(long, default_value = "text")]
    report: Report,
}

impl Args {
    /// So many of the columns are the time's, unless it is the file's own that is counted by; none of a single one.
    fn clock(&self) -> Result<Option<usize>, String> {
        let [first, _, _, ..] = &self.columns[..] else {
            return Ok((self.columns.len() == 2).then(|| usize::from(self.rate.is_none())));
        };
        let mut alone = self.asked().0;
        alone.columns = vec![first.clone()];
        // A column of signals has a time beside it.
        let is_signal = Read::new(&self.trace, &alone, &Options::default(), None)
            .is_ok_and(|read| read.reading.time.is_some_and(|time| time.0 != read.reading.signal.0));
        Ok(Some(usize::from(self.rate.is_none() && !is_signal)))
    }

    /// How a trace is read, and what its fit is asked for.
    fn asked(&self) -> (trace::Options, Options) {
        let &Self { unit, rate, from, to, light, full, frame, model, mains, .. } = self;
        let how = trace::Options { unit, columns: self.columns.clone(), rate, from, to, sync: None };
        (how, Options { light, full, frame, model, mains, ..Options::default() })
    }
}

/// The form of what goes to standard output.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Report {
    /// For a reader
    Text,
    /// For a program
    Json,
}

fn mains(text: &str) -> Result<f64, String> {
    match text {
        "50" => Ok(50.0),
        "60" => Ok(60.0),
        _ => Err("50 or 60 is required".into()),
    }
}

pub(super) fn trigger_count() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(MOST_TRIGGERS))
}

pub fn run(args: &Args, out: &mut dyn Write, err: &mut dyn Write) -> Result<(), String> {
    let traces: Vec<&Path> = once(&args.trace).chain(&args.others).map(PathBuf::as_path).collect();
    for (option, n) in [("--nominal", args.nominal.len()), ("--sync", args.sync.len())] {
        if ![0, 1, traces.len()].contains(&n) {
            let traces = count(traces.len() as u64, "trace");
            return Err(format!("{option}: {n} for {traces}; give one for all, or one for each"));
        }
    }
    let sync = |i: usize| args.sync.get(i).or(args.sync.first());
    let files: Vec<&Path> = args.sync.iter().filter_map(Asked::file).collect();
    if files.len() == 1 && traces.len() > 1 {
        return Err("--sync: each trace has a file of its own for its sync; give one for each".into());
    }
    for paths in [&traces, &files] {
        let is_twice = |i: &usize| paths[..*i].iter().any(|other| is_same(other, paths[*i]));
        if let Some(i) = (0..paths.len()).find(is_twice) {
            return Err(format!("{}: it is given twice", shown(paths[i])));
        }
    }
    if let Some(clock) = args.clock()?
        && args.columns.len() > clock + 1
    {
        if args.out.is_some() || args.picture.is_some() {
            return Err("--columns: several sensors have no scene and no picture; name one of them".into());
        }
        return sensors(args, &traces, clock, sync, out, err);
    }
    let names = names(&traces, file_name);
    let scenes = args.out.as_ref().map_or(Vec::new(), |file| scenes(file, &traces));
    let printed = (args.report == Report::Json).then_some(Path::new("-"));
    let to = scenes.iter().chain(&args.picture).map(PathBuf::as_path);
    let to: Vec<&Path> = to.chain(printed).collect();
    let mut outputs = Outputs::new(&[&traces[..], &files].concat(), &to, args.force)?;
    outputs.folder = args.out.clone().filter(|_| scenes.len() > 1);
    if let Some(picture) = &args.picture {
        outputs.check(picture, mark::SVG)?;
    }
    let olds = scenes.iter().map(|file| old(args, &mut outputs, file)).collect::<Result<Vec<_>, _>>()?;

    let (how, options) = args.asked();
    let read = traces.iter().enumerate();
    let read = read.map(|(i, path)| Read::new(path, &how, &options, sync(i)));
    let read: Vec<Read> = read.collect::<Result<_, _>>()?;
    let records = read.iter().map(|it| {
        Record::new(&it.trace, &it.options)
            .map_err(|refusal| format!("{}: {}; read: {}", shown(it.path), refusal.with_option(), it.reading))
    });
    let records: Vec<Record> = records.collect::<Result<_, _>>()?;
    let is_one = is_one_setting(args, &read, &records, scenes.len())?;
    let size = if is_one { read.len() } else { 1 };
    let mut speeds = Vec::new();
    for (i, (read, records)) in read.chunks(size).zip(records.chunks(size)).enumerate() {
        let triggers = args.triggers.or(triggers(olds.get(i)));
        let mut speed = measure(read, records, triggers)?;
        speed.fit.nominal = args.nominal.get(i).copied();
        if !is_one {
            speed.name = names[i].clone();
        }
        speeds.push(speed);
    }
    let fits = speeds.iter_mut().map(|speed| &mut speed.fit);
    delay::pool(fits.filter_map(|fit| Some((fit.exposure.value, fit.delay.as_mut()?))));

    // What is refused from here on leaves the report.
    let mut said = Said::default();
    let ready = write(args, &speeds, &scenes, olds, outputs, &mut said);
    let mut told = warned(&speeds);
    told.extend(speeds.iter().filter_map(|speed| far_from_nominal(speed, &speeds)));
    told.extend(edges_apart(args, &speeds));
    told += &said.told;
    let report = match (args.report, speeds.as_slice()) {
        (Report::Json, speeds) => json(speeds),
        (_, [Speed { name, fit, .. }]) => {
            let text = shutter_fit::text(name, fit);
            match scenes.is_empty() {
                true => text + "\nThe scene, which --out SCENE.toml writes:\n\n" + &said.scene,
                false => text,
            }
        }
        (_, speeds) => fit_many::table(speeds),
    };
    let ended = match ready {
        Ok(ready) => ready.finish(out, &report).map(|wrote| told += &wrote),
        Err(reason) => print(out, &report).and(Err(reason)),
    };
    if ended.is_ok() {
        told += &next(&scenes, &said.lacks);
    }
    // There is no one to tell if standard error cannot be written.
    let _ = err.write_all(told.as_bytes());
    ended
}

/// Several sensors of each record, all of one shot; so many columns before theirs are the time's.
fn sensors<'a>(
    args: &Args,
    traces: &[&Path],
    clock: usize,
    sync: impl Fn(usize) -> Option<&'a Asked>,
    out: &mut dyn Write,
    err: &mut dyn Write,
) -> Result<(), String> {
    let (names, (time, signals)) = (names(traces, file_name), args.columns.split_at(clock));
    let mut all = Vec::new();
    for (i, trace) in traces.iter().enumerate() {
        let mut speed = Vec::<Speed>::new();
        for signal in signals {
            let columns = [time, std::slice::from_ref(signal)].concat();
            let first = speed.first().map(|first| first.fit.frames);
            let frame = args.frame.or(first.map(|first| first.fitted));
            let (how, options) = Args { columns, frame, ..args.clone() }.asked();
            let read = Read::new(trace, &how, &options, sync(i))?;
            let refused = |reason| format!("{}: column {signal}: {reason}", shown(trace));
            let record = Record::new(&read.trace, &read.options).map_err(|e| refused(e.with_option()))?;
            let Speed { mut fit, warnings, .. } = measure(&[read], &[record], args.triggers).map_err(refused)?;
            let (here, first) = (fit.frames.count, first.map_or(fit.frames.count, |first| first.count));
            if first != here && args.frame.is_none() {
                return Err(format!(
                    "--columns: column {signal} has {here} whole pulses and the first sensor {first}, so nothing \
                     tells which belong together; see --from, --to and --frame"
                ));
            }
            fit.nominal = args.nominal.get(i).or(args.nominal.first()).copied();
            let name = fit.reading.as_ref().and_then(|it| it.signal.1.clone()).unwrap_or_else(|| signal.clone());
            let name = if traces.len() > 1 { format!("{} {name}", names[i]) } else { name };
            speed.push(Speed { name, fit, warnings });
        }
        all.push(speed);
    }
    let report = match args.report {
        Report::Json => json(&all.concat()),
        Report::Text => fit_many::sensors(&all),
    };
    print(out, &report)?;
    let _ = err.write_all(warned(&all.concat()).as_bytes());
    Ok(())
}

/// Warnings, those of one code once, with the names of all that they are about.
fn warned(speeds: &[Speed]) -> String {
    let mut told: Vec<(&str, &Warning, String)> = Vec::new();
    for (name, warning) in speeds.iter().flat_map(|it| it.warnings.iter().map(|warning| (&it.name, warning))) {
        match told.iter_mut().find(|(_, other, _)| other.code() == warning.code()) {
            Some((_, _, also)) if also.is_empty() => *also = format!("; so it is with {name}"),
            Some((_, _, also)) => *also += &format!(", {name}"),
            None => told.push((name, warning, String::new())),
        }
    }
    let named = |name| if speeds.len() > 1 { format!("{name}: ") } else { String::new() };
    let line = |(name, warning, also)| format!("warning: {}{}{also}\n", named(name), Warning::with_option(warning));
    told.into_iter().map(line).collect()
}

/// What is called by another speed is another one, or its trace is: it is far off, or a longer one is called shorter.
fn far_from_nominal(Speed { name, fit, .. }: &Speed, all: &[Speed]) -> Option<String> {
    let (nominal, exposure) = (fit.nominal?, fit.exposure.value);
    let ev = (exposure / nominal).log2();
    let is_crossed = |Speed { fit: other, .. }: &Speed| {
        other.nominal.is_some_and(|of| (of - nominal) * (other.exposure.value - exposure) < 0.0)
    };
    (ev.abs() >= 1.0 || all.iter().any(is_crossed)).then(|| {
        let (measured, unit) = (fit.unit().show(fit.exposure.value), Unit::fit(nominal));
        format!(
            "warning: {name}: {measured} is {} EV off its --nominal of {}: \
             are the speeds in the order of the traces?\n",
            stops(ev),
            unit.show(nominal)
        )
    })
}

/// One time of the edge is not that of each trace, if its shutter opens later in one than in another by more than is
/// known, and more than a hundredth of an exposure.
fn edges_apart(args: &Args, speeds: &[Speed]) -> Option<String> {
    let [Asked::Time(_)] = args.sync[..] else { return None };
    let opens = speeds.iter().filter_map(|it| Some((it, it.fit.delay.as_ref()?)));
    let by_delay = |a: &(_, &Delay), b: &(_, &Delay)| a.1.to_half().total_cmp(&b.1.to_half());
    let (early, first) = opens.clone().min_by(by_delay)?;
    let (late, last) = opens.max_by(by_delay)?;
    let apart = last.to_half() - first.to_half();
    let known = 3.0 * first.trigger_error().hypot(last.trigger_error());
    let matters = 0.01 * early.fit.exposure.value.min(late.fit.exposure.value);
    (apart > known.max(matters)).then(|| {
        format!(
            "warning: {} is half open {} later after its edge than {}: is the edge at that time in each trace? if not, \
             give a --sync for each\n",
            late.name,
            Unit::fit(apart).show(rounded(apart, 3)),
            early.name
        )
    })
}

/// Where scenes go: to the file of one, or into a folder, where each is called as its trace is.
fn scenes(out: &Path, traces: &[&Path]) -> Vec<PathBuf> {
    let is_toml = out.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml"));
    match traces {
        several @ [_, _, ..] if !is_toml && !is_std(out) => {
            several.iter().map(|trace| out.join(stem(trace) + ".toml")).collect()
        }
        _ => vec![out.into()],
    }
}

/// Are these the shots of one setting, which make one scene? If so, they are read alike; if not, each trace makes its
/// own.
fn is_one_setting(args: &Args, read: &[Read], records: &[Record], scenes: usize) -> Result<bool, String> {
    let (differ, is_one) = shutter_fit::setting(records);
    let (n, differ) = (read.len(), short(100.0 * differ, 2));
    if n == 1 {
        return Ok(true);
    }
    let is_one = is_one && args.nominal.len() < n;
    if !is_one {
        let reason = match (&args.nominal[..], scenes, &args.picture) {
            ([_], ..) => "--nominal: give a speed for each trace",
            (_, 1, _) => "--out: name a folder for a scene of each trace",
            (.., Some(_)) => "--picture: it is of one setting",
            _ => return Ok(false),
        };
        return Err(format!("{reason}; the exposures differ by {differ} %"));
    }
    if scenes > 1 {
        return Err(format!(
            "--out: the exposures differ by {differ} % only, so the traces are shots of one setting and make one \
             scene: name it SCENE.toml, or give each trace its speed with --nominal"
        ));
    }
    for (i, other) in read.iter().enumerate().skip(1) {
        other.like(&read[0])?;
        read[..i].iter().try_for_each(|shot| other.differs(shot))?;
    }
    Ok(true)
}

/// What is said of scenes.
#[derive(Default)]
struct Said {
    /// Of each what is doubtful once it is planned, and what else is to be known.
    told: String,
    /// The options by which their user tells what nobody else can.
    lacks: Vec<&'static str>,
    /// The one that goes to no file.
    scene: String,
}

/// All that is written: scenes, each in place of the shutter of an older one, and a picture.
fn write(
    args: &Args,
    speeds: &[Speed],
    files: &[PathBuf],
    olds: Vec<Option<Old>>,
    mut outputs: Outputs,
    said: &mut Said,
) -> Result<Ready, String> {
    let mut olds = olds.into_iter();
    for (i, Speed { name, fit, .. }) in speeds.iter().enumerate() {
        let old = olds.next().flatten();
        let unit = old.as_ref().map(|(scene, _)| scene.shutter.unit());
        let shutter =
            fitted::shutter(fit, name, unit).map_err(|refusal| format!("{name}: {}", refusal.with_option()))?;
        if let Some(old) = old.as_ref().map(|(scene, _)| &scene.shutter) {
            for (key, option, was, is) in
                [("nominal", "--nominal", old.nominal, shutter.nominal), ("delay", "--sync", old.delay, shutter.delay)]
            {
                if let (Some(was), None, Some(file)) = (was, is, files.get(i)) {
                    let (file, unit) = (file.display(), old.unit().name());
                    said.told +=
                        &format!("warning: {file}: its {key} of {was} {unit} is gone: this fit has no {option}\n");
                }
            }
        }
        let text = match old {
            Some((_, around)) => around.join(&shutter.text()),
            None => shutter.text() + &fitted::flashes(&shutter, fit.triggers.len()),
        };
        let scene = Scene::parse(&text).map_err(|fault| fault.locate(name, &text))?;
        let Some(file) = files.get(i) else {
            said.scene = text;
            continue;
        };
        let file_name = file.display();
        match Plan::new(&scene) {
            // What the fit finds doubtful is told already.
            Ok(plan) => {
                let doubts = Facts::new(&plan).doubts.into_iter().filter(|doubt| doubt.code != "trace");
                said.told.extend(doubts.map(|doubt| format!("warning: {file_name}: {}\n", doubt.text)));
            }
            Err(fault) => said.told += &format!("warning: {file_name}: as it is, {}\n", fault.reason()),
        }
        for (option, lacks) in scene.lacks() {
            if lacks && !said.lacks.contains(&option) {
                said.lacks.push(option);
            }
        }
        outputs.replace(file, text)?;
    }
    if let (Some(file), [Speed { name, fit, .. }]) = (&args.picture, speeds) {
        let picture = picture::trace(name, fit).map_err(|e| format!("the picture: {e}"))?;
        outputs.add(file, Some(mark::SVG), picture)?;
    }
    outputs.ready()
}

/// As many as an older scene has.
fn triggers(old: Option<&Option<Old>>) -> Option<u32> {
    let (scene, _) = old?.as_ref()?;
    let own = scene.flashes.triggers.map(|n| n as u32).filter(|n| (1..=MOST_TRIGGERS).contains(n));
    own.or(scene.shutter.trigger_times.as_ref().map(|times| times.len() as u32))
}

/// What to do with the scenes.
fn next(scenes: &[PathBuf], lacks: &[&str]) -> String {
    if scenes.is_empty() || scenes.iter().any(|file| is_stream(file)) {
        return String::new();
    }
    let quoted = |path: &Path| match path.display().to_string() {
        name if name.contains(char::is_whitespace) => format!(" '{name}'"),
        name => format!(" {name}"),
    };
    let plan: String = scenes.iter().map(|scene| quoted(scene)).collect();
    let to = match scenes {
        [one] => quoted(&one.with_file_name(Form::Rust.file(&stem(one)))),
        _ => " shutters.rs".into(),
    };
    let lacks: String = lacks.iter().map(|option| format!(" {option}")).collect();
    format!("next: shutter plan{plan}{lacks} --emit rust --to{to}\n")
}

/// A scene that is there, and what stands before and behind its shutter, which is replaced.
type Old = (Scene, [String; 2]);

/// The scene that is where one is to be written, if its shutter is one that a fit wrote, or is replaced by force.
fn old(args: &Args, outputs: &mut Outputs, file: &Path) -> Result<Option<Old>, String> {
    let Some(bytes) = outputs.old(file)? else { return Ok(None) };
    let name = file.display();
    let text = String::from_utf8(bytes).ok();
    let found = text.and_then(|text| Some((Scene::parse(&text).ok()?, Written::find(&text)?, text)));
    let Some((scene, Written { at, is_intact }, text)) = found else {
        return match args.force {
            true => Ok(None),
            false => Err(format!("{name}: it holds no scene that a fit wrote; --force replaces it all")),
        };
    };
    if !is_intact && !args.force {
        let reason = match scene.shutter.measured {
            Some(_) => "you have changed what a fit wrote below [shutter]; what is yours belongs below [flashes]",
            None => "no fit wrote its [shutter]",
        };
        return Err(format!("{name}: {reason}; --force replaces that table, and keeps the rest"));
    }
    if let (Some(asked), Some(has)) = (args.triggers, scene.flashes.triggers)
        && f64::from(asked) != has
    {
        return Err(format!(
            "{name}: --triggers {asked}: it has triggers = {has} below [flashes], which are yours: change it there"
        ));
    }
    Ok(Some((scene, [text[..at.start].into(), text[at.end..].into()])))
}

/// One object, or an array of those of several.
fn json(speeds: &[Speed]) -> String {
    let object = |it: &Speed| shutter_fit::json(&it.name, &it.fit, &it.warnings);
    let json = match speeds {
        [one] => object(one),
        several => several.iter().map(object).collect(),
    };
    format!("{json:#}\n")
}

/// The fit of the shots of one setting, and what is doubtful about it.
fn measure(read: &[Read], records: &[Record], triggers: Option<u32>) -> Result<Speed, String> {
    let more = |n: usize| if n > 1 { format!(", of {n} files") } else { String::new() };
    let options = Options { triggers, ..read[0].options.clone() };
    let mut fit = shutter_fit::fit_records(records, &options, &mut |_| ()).map_err(|refusal| {
        let (path, reading) = (shown(read[0].path) + &more(read.len()), &read[0].reading);
        format!("{path}: {}; read: {reading}", refusal.with_option())
    })?;
    let Read { path, reading, .. } = &read[fit.record];
    fit.reading = Some(reading.clone());
    let mut warnings = Vec::new();
    Warning::add(&mut warnings, read.iter().flat_map(|it| it.warnings.iter().cloned()));
    warnings.extend(fit.warnings.iter().cloned());
    Ok(Speed { name: file_name(path) + &more(read.len()), fit, warnings })
}
