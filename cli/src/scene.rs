//! A scene: what stands in its text, and where it is wrong.

use serde::Deserialize;
use shutter_curve::CurveError;
use toml::Spanned;

use crate::shape::Shape;
use crate::unit::{Unit, short};

/// A scene as it is written; each value knows its place in the text.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Of all times; seconds without.
    pub(crate) unit: Option<Unit>,
    open_start: Spanned<Number>,
    open_end: Spanned<Number>,
    close_start: Spanned<Number>,
    close_end: Spanned<Number>,
    shutteropening: Option<Spanned<Vec<Number>>>,
    pub(crate) triggers: Spanned<Count>,
    pub(crate) timer_hz: Spanned<Count>,
    pub(crate) min_gap: Spanned<Number>,
    pub(crate) nominal: Option<Spanned<Number>>,
    pub(crate) pulse: Option<Spanned<Number>>,
    pub(crate) duty: Option<Spanned<Number>>,
    pub(crate) min_pulse: Option<Spanned<Number>>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "a number is required")]
pub(crate) enum Number {
    Any(f64),
}

impl Number {
    pub(crate) fn get(self) -> f64 {
        let Self::Any(x) = self;
        x
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(untagged, expecting = "a whole number from 0 to 4294967295 is required")]
pub(crate) enum Count {
    Any(u32),
}

impl Count {
    pub(crate) fn get(self) -> u32 {
        let Self::Any(n) = self;
        n
    }
}

/// What is wrong with a scene, and at which byte of its text, where that is known.
#[derive(Debug)]
pub struct Fault {
    /// The byte of the text.
    pub at: Option<usize>,
    /// What is wrong.
    pub reason: String,
    /// What may help, a line each.
    pub notes: Vec<String>,
}

impl Fault {
    pub(crate) fn at<T>(value: &Spanned<T>, reason: impl ToString) -> Self {
        Self { at: Some(value.span().start), reason: reason.to_string(), notes: Vec::new() }
    }

    /// `file:line: reason`, the line itself below it, and the notes.
    pub fn locate(&self, file: &str, text: &str) -> String {
        let Self { at, reason, notes } = self;
        let mut told = match at.and_then(|at| text.get(..at)) {
            Some(before) => {
                let line = before.matches('\n').count();
                let source = text.lines().nth(line).unwrap_or_default();
                format!("{file}:{number}: {reason}\n  {number} | {source}", number = line + 1)
            }
            None => format!("{file}: {reason}"),
        };
        for note in notes {
            told += &format!("\n  {note}");
        }
        told
    }
}

/// The scene that `text` describes.
///
/// # Errors
/// What is no TOML, and keys that are missing or unknown or have the wrong type.
pub fn parse(text: &str) -> Result<Scene, Fault> {
    toml::from_str(text).map_err(|error| {
        let reason = error.message().to_string();
        // What is missing is on no line; its span is the whole table.
        let missing = reason.starts_with("missing field");
        let at = error.span().filter(|_| !missing).map(|span| span.start);
        Fault { at, reason, notes: Vec::new() }
    })
}

/// So much of the interval a time may be off by its rounding to `f32`: less than what a good measurement is.
const ROUNDING: f64 = 1e-4;

impl Scene {
    /// The curve's numbers, known to be finite and kept by `f32`, with what the crate makes of them.
    pub(crate) fn shape(&self) -> Result<Shape, Fault> {
        let keys = ["open_start", "open_end", "close_start", "close_end"];
        let mut seconds = [0.0; 4];
        for ((key, value), seconds) in keys.into_iter().zip(self.times()).zip(&mut seconds) {
            *seconds = self.seconds(key, value)?;
        }
        let times = seconds.map(|time| time as f32);
        let length = (seconds[3] - seconds[0]).abs();
        for (i, value) in self.times().into_iter().enumerate() {
            let (key, off) = (keys[i], (f64::from(times[i]) - seconds[i]).abs());
            if times[i].is_infinite() {
                return Err(Fault::at(
                    value,
                    format!("{key}: {:e} s is beyond f32 (3.4e38)", seconds[i]),
                ));
            }
            if off > ROUNDING * length {
                let percent = short(100.0 * off / length, 2);
                let reason = format!(
                    "{key}: f32 is off by {percent} % of the interval here; count the times from \
                     nearer to open_start"
                );
                return Err(Fault::at(value, reason));
            }
        }
        let inner = self.shutteropening.as_ref().map(eight).transpose()?;
        Ok(Shape { times, inner })
    }

    /// A time in seconds, known to be finite.
    pub(crate) fn seconds(&self, key: &str, time: &Spanned<Number>) -> Result<f64, Fault> {
        let time = finite(key, time, time.get_ref().get())?;
        Ok(self.unit.unwrap_or(Unit::Second).seconds(time))
    }

    fn times(&self) -> [&Spanned<Number>; 4] {
        [&self.open_start, &self.open_end, &self.close_start, &self.close_end]
    }

    /// Where the value stands that a curve's error is about, and what may help.
    pub(crate) fn fault(&self, shape: &Shape, error: CurveError) -> Fault {
        let times = self.times();
        let out_of_order = || {
            let is = |i: &usize| shape.times[*i] > shape.times[*i + 1];
            (0..3).find(is).map(|i| times[i + 1])
        };
        let time = match error {
            CurveError::NotFinite(_)
            | CurveError::InnerTimesTurnBack(_)
            | CurveError::NegativeOpenness(_)
            | CurveError::OpennessAboveOne(_) => None,
            CurveError::TimesOutOfOrder => out_of_order(),
            _ => Some(&self.close_end),
        };
        let Some(inner) = self.shutteropening.as_ref().filter(|_| time.is_none()) else {
            return Fault::at(time.unwrap_or(&self.close_end), error);
        };
        let is_time = matches!(error, CurveError::InnerTimesTurnBack(_));
        let mut fault = Fault::at(inner, error);
        fault.notes.push("The numbers are [t1, y1, t2, y2, t5, y5, t6, y6].".into());
        if let Some((convention, inner)) =
            shape.misread(self.unit.unwrap_or(Unit::Second)).filter(|_| is_time)
        {
            let inner = inner.join(", ");
            fault.notes.push(format!("As {convention} they would fit; that is"));
            fault.notes.push(format!("shutteropening = [{inner}]"));
        }
        fault
    }
}

fn finite<T>(key: &str, place: &Spanned<T>, x: f64) -> Result<f64, Fault> {
    if x.is_finite() {
        return Ok(x);
    }
    Err(Fault::at(place, format!("{key}: a finite number is required")))
}

fn eight(numbers: &Spanned<Vec<Number>>) -> Result<[f32; 8], Fault> {
    let many = numbers.get_ref();
    let mut eight = [0.0; 8];
    if many.len() != eight.len() {
        let reason = format!("shutteropening: 8 numbers are required, not {}", many.len());
        return Err(Fault::at(numbers, reason));
    }
    for (kept, number) in eight.iter_mut().zip(many) {
        *kept = finite("shutteropening", numbers, number.get())? as f32;
        finite("shutteropening", numbers, (*kept).into())?;
    }
    Ok(eight)
}
