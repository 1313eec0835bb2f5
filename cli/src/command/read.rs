//! What `shutter fit` reads: traces, each with the edge or the channel of the camera's sync.

use std::convert::Infallible;
use std::path::{Path, PathBuf};

use shutter_fit::trace::{self, Reading, Recording, Tell, Trace, Warning};
use shutter_fit::{Options, Sync};

use super::input::{self, file_name, shown};
use super::quantity::time;
use shutter_plan::scene::Scene;

/// Samples of one record are at the same time, to so much of the time between two.
const SAME: f64 = 0.01;

/// What is told of the sync.
#[derive(Clone)]
pub enum Asked {
    Time(f64),
    Column(String),
    File(PathBuf),
}

impl Asked {
    /// The file of its own, if it has one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::File(file) => Some(file),
            _ => None,
        }
    }
}

/// As it is written in an argument.
pub fn sync(text: &str) -> Result<Asked, Infallible> {
    Ok(match time(text) {
        Ok(time) => Asked::Time(time),
        Err(_) if Path::new(text).is_file() => Asked::File(text.into()),
        Err(_) => Asked::Column(text.into()),
    })
}

/// A trace, and what a fit is asked for with it.
pub struct Read<'a> {
    pub path: &'a Path,
    pub trace: Trace,
    pub options: Options,
    pub reading: Reading,
    pub warnings: Vec<Warning>,
}

impl<'a> Read<'a> {
    /// Reads a trace so, and the channel of its sync from there or from a file of its own; `options` are those of its
    /// fit.
    pub fn new(path: &'a Path, how: &trace::Options, options: &Options, sync: Option<&Asked>) -> Result<Self, String> {
        let column = match sync {
            Some(Asked::Column(column)) => Some(column.clone()),
            _ => None,
        };
        let how_light = trace::Options { sync: column, ..how.clone() };
        let Recording { trace, timing, sync: channel, mut reading, mut warnings } =
            open(path, &how_light).map_err(|reason| format!("{}: {reason}", shown(path)))?;
        let sync = match sync {
            Some(Asked::Time(_)) if reading.is_counted() => {
                return Err(format!(
                    "{}: --sync: times are counted from the first row, and nothing tells how long that is \
                     before or after the edge; name the column of the sync, or take a record with times; \
                     read: {reading}",
                    shown(path)
                ));
            }
            Some(Asked::Time(time)) => Some(Sync::Edge(*time)),
            Some(Asked::File(file)) => {
                let told = |reason: String| format!("{}: {reason}", shown(file));
                // Its names are its own.
                let is_number = |column: &String| column.parse::<usize>().is_ok();
                let mut how = how.clone();
                if !how.columns.iter().all(is_number) {
                    how.columns.clear();
                }
                let other = open(file, &how).map_err(told)?;
                if !other.warnings.contains(&Warning::Changes) {
                    same_record(&trace, &other).map_err(told)?;
                }
                let (number, name) = other.reading.signal;
                let name = name.map_or(String::new(), |name| format!("{name} of "));
                reading.sync = Some((number, Some(name + &file_name(file))));
                Warning::add(&mut warnings, other.warnings);
                Some(Sync::Channel(other.trace))
            }
            _ => channel.map(Sync::Channel),
        };
        let options = Options { sync, timing, ..options.clone() };
        Ok(Self { path, trace, options, reading, warnings })
    }

    /// Is it read as another one is, of which it is to be a shot?
    pub fn like(&self, other: &Self) -> Result<(), String> {
        let [of, than] = [self, other].map(|it| {
            let sync = it.reading.sync.as_ref().filter(|_| it.options.sync.is_some());
            (&it.reading.signal, sync.map(|sync| sync.0), it.reading.clock)
        });
        if of == than {
            return Ok(());
        }
        Err(format!(
            "{}: shots of one setting are read alike, and this is {}; {} is {}",
            shown(self.path),
            self.reading,
            shown(other.path),
            other.reading
        ))
    }

    /// Is it another shot? Where a signal has more than two levels, its noise tells.
    pub fn differs(&self, other: &Self) -> Result<(), String> {
        let (trace, first) = (&self.trace, self.trace.values[0]);
        let mut levels = trace.values.iter().filter(|value| **value != first);
        let second = levels.next();
        if *trace != other.trace || levels.all(|value| Some(value) == second) {
            return Ok(());
        }
        Err(format!("{}: it is the record of {} once more, and no other shot", shown(self.path), shown(other.path)))
    }
}

fn open(path: &Path, how: &trace::Options) -> Result<Recording, String> {
    let bytes = input::read(path)?;
    trace::open(&bytes, how).map_err(|refusal| match bytes.trim_ascii_start().first() {
        _ if str::from_utf8(&bytes).is_ok_and(|text| Scene::parse(text).is_ok()) => {
            format!("this is a scene, and no trace; `shutter plan {}` takes it", shown(path))
        }
        Some(b'{' | b'[') => "this is JSON; a trace is a table, with a row for each sample".into(),
        _ => refusal.with_option(),
    })
}

/// Is the channel of the same record as the light, sample for sample?
fn same_record(light: &Trace, channel: &Recording) -> Result<(), String> {
    if let Some(choice) = channel.warnings.iter().find(|it| matches!(it, Warning::SecondSignal { .. })) {
        return Err(format!("a sync's file has one signal, and here {}", choice.with_option()));
    }
    let (ours, theirs) = (&light.times, &channel.trace.times);
    let [n, m] = [ours.len(), theirs.len()];
    if n != m {
        return Err(format!("it is no channel of the same record: {m} samples, and the light has {n}"));
    }
    let step = (ours[n - 1] - ours[0]) / (n - 1).max(1) as f64;
    let differs = |k: &usize| (ours[*k] - theirs[*k]).abs() > SAME * step;
    let Some(k) = (0..n).find(differs) else { return Ok(()) };
    Err(format!(
        "it is no channel of the same record: sample {} is at {} s, the light's at {} s",
        k + 1,
        theirs[k],
        ours[k]
    ))
}
