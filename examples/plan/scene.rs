//! A scene file: what stands in it, and where it is wrong.

use serde::Deserialize;
use shutter_curve::{CurveError, ShutterCurve};
use toml::Spanned;

/// A scene as it is written; each value knows its place in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Seconds.
    open_start: Spanned<f32>,
    open_end: Spanned<f32>,
    close_start: Spanned<f32>,
    close_end: Spanned<f32>,
    /// The ramps' inner control points `[t1, y1, t2, y2, t5, y5, t6, y6]`, their times as fractions of the
    /// interval; straight ramps without.
    shutteropening: Option<Spanned<Vec<f32>>>,
    pub triggers: Spanned<u32>,
    pub timer_hz: Spanned<u32>,
    /// Seconds.
    pub min_gap: Spanned<f64>,
}

/// What is wrong with a scene, and at which byte of its file, where that is known.
pub struct Fault {
    at: Option<usize>,
    reason: String,
}

impl Fault {
    pub fn at<T>(value: &Spanned<T>, reason: impl ToString) -> Self {
        Self { at: Some(value.span().start), reason: reason.to_string() }
    }

    /// `file:line: reason`, and the line itself below it.
    pub fn locate(&self, file: &str, text: &str) -> String {
        let Self { at, reason } = self;
        let Some(before) = at.and_then(|at| text.get(..at)) else {
            return format!("{file}: {reason}");
        };
        let line = before.matches('\n').count();
        let source = text.lines().nth(line).unwrap_or_default();
        format!("{file}:{number}: {reason}\n  {number} | {source}", number = line + 1)
    }
}

fn eight(numbers: &Spanned<Vec<f32>>) -> Result<[f32; 8], Fault> {
    let many = numbers.get_ref();
    many.as_slice().try_into().map_err(|_| {
        Fault::at(numbers, format!("shutteropening: 8 numbers are required, not {}", many.len()))
    })
}

pub fn parse(text: &str) -> Result<Scene, Fault> {
    toml::from_str(text).map_err(|error| {
        let reason = error.message().to_string();
        // What is missing is on no line; its span is the whole table.
        let missing = reason.starts_with("missing field");
        let at = error.span().filter(|_| !missing).map(|span| span.start);
        Fault { at, reason }
    })
}

impl Scene {
    pub fn curve(&self) -> Result<ShutterCurve, Fault> {
        let times @ [open_start, open_end, close_start, close_end] =
            self.times().map(|time| *time.get_ref());
        match &self.shutteropening {
            Some(inner) => ShutterCurve::shutteropening(times, eight(inner)?),
            None => ShutterCurve::linear(open_start, open_end, close_start, close_end),
        }
        .map_err(|error| Fault { at: self.culprit(error), reason: error.to_string() })
    }

    fn times(&self) -> [&Spanned<f32>; 4] {
        [&self.open_start, &self.open_end, &self.close_start, &self.close_end]
    }

    /// Where the value stands that a curve's error is about.
    fn culprit(&self, error: CurveError) -> Option<usize> {
        let times = self.times();
        let time = match error {
            CurveError::NotFinite(_) => times.into_iter().find(|time| !time.get_ref().is_finite()),
            CurveError::TimesOutOfOrder => {
                times.windows(2).find(|pair| pair[0] > pair[1]).map(|pair| pair[1])
            }
            CurveError::TimeTurnsBack(_)
            | CurveError::InnerTimesTurnBack(_)
            | CurveError::NegativeOpenness(_)
            | CurveError::OpennessAboveOne(_) => None,
            _ => Some(&self.close_end),
        };
        let inner = self.shutteropening.as_ref().map(|inner| inner.span());
        time.map(|time| time.span()).or(inner).map(|span| span.start)
    }
}
