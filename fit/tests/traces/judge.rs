//! What came of traces with a known truth: errors as shares of the exposure, what the stated errors hold, what is told.

// Each test needs a part.
#![allow(dead_code)]

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use shutter_fit::trace::Warning;
use shutter_fit::{Fit, From, Kind, Measured, Options, fit};

use crate::generator::{Case, quantile};

/// An interval of so many standard errors to either side holds 95 % of all values, if these are normal.
const INTERVAL: f64 = 1.96;
/// Results beyond these, as shares of the exposure, are wrong: of the triggers, of the exposure.
pub const WRONG: (f64, f64) = (0.0015, 0.005);

/// What came of a trace.
pub struct Row {
    pub refused: bool,
    pub kind: Kind,
    /// The root of the mean square of the triggers' errors, the greatest, and the exposure's.
    pub triggers: f64,
    pub greatest: f64,
    pub exposure: f64,
    /// The share of the triggers whose interval holds the truth; does the exposure's, and the efficiency's?
    pub triggers_covered: f64,
    pub covered: bool,
    pub efficiency_covered: bool,
    /// Is there a warning other than of noise or drift?
    pub told: bool,
    pub from_trace: bool,
    pub warnings: Vec<&'static str>,
    /// Beyond these errors it is wrong.
    allowed: (f64, f64),
    pub time: Duration,
}

impl Row {
    pub fn new(case: &Case) -> Self {
        let clock = Instant::now();
        let fit = fit(&case.trace, &Options::default(), &mut |_| ());
        let mut row = Self {
            refused: true,
            kind: Kind::Box,
            triggers: 0.0,
            greatest: 0.0,
            exposure: 0.0,
            triggers_covered: 1.0,
            covered: true,
            efficiency_covered: true,
            told: true,
            from_trace: false,
            warnings: vec!["refused"],
            allowed: WRONG,
            time: clock.elapsed(),
        };
        if let Ok(fit) = fit {
            row.compare(case, &fit);
        }
        row
    }

    fn compare(&mut self, case: &Case, fit: &Fit) {
        let exposure = case.exposure();
        let holds = |m: Measured, truth: f64| (m.value - truth).abs() <= INTERVAL * m.error;
        let (n, mut squares, mut held) = (fit.triggers.len() as f64, 0.0, 0.0);
        for (i, trigger) in fit.triggers.iter().enumerate() {
            let truth = case.trigger((i as f64 + 0.5) / n);
            let error = (trigger.value - truth).abs() / exposure;
            squares += error * error / n;
            self.greatest = self.greatest.max(error);
            held += f64::from(holds(*trigger, truth)) / n;
        }
        // Which of several shots was fitted is not known here: their triggers are not judged, and any exposure is as
        // true.
        self.triggers = if case.others.is_empty() { squares.sqrt() } else { 0.0 };
        let nearest = |near: f64, other: &f64| {
            let is_nearer = (fit.exposure.value - other).abs() < (fit.exposure.value - near).abs();
            if is_nearer { *other } else { near }
        };
        let truth = case.others.iter().fold(exposure, nearest);
        self.exposure = (fit.exposure.value - truth).abs() / exposure;
        self.covered = holds(fit.exposure, truth);
        self.efficiency_covered = match fit.most_efficiency() {
            Some(most) => case.truth.efficiency() <= most,
            None => (fit.efficiency.value - case.truth.efficiency()).abs() <= INTERVAL * fit.efficiency.error + 1e-5,
        };
        (self.refused, self.kind, self.triggers_covered) = (false, fit.chosen, held);
        self.told = fit.warnings.iter().any(is_about_the_result);
        self.from_trace = fit.from == From::Trace;
        self.warnings = fit.warnings.iter().map(Warning::code).collect();
    }

    /// Errors up to this share of the exposure are not wrong.
    pub fn allowing(mut self, most: f64) -> Self {
        self.allowed = (self.allowed.0.max(most), self.allowed.1.max(most));
        self
    }

    pub fn is_wrong(&self) -> bool {
        !self.refused && (self.triggers > self.allowed.0 || self.exposure > self.allowed.1)
    }

    pub fn is_wrong_silently(&self) -> bool {
        self.is_wrong() && !self.told
    }

    pub fn says(&self, code: &str) -> bool {
        self.warnings.contains(&code)
    }
}

pub fn is_about_the_result(warning: &Warning) -> bool {
    let beside = ["noise", "drift", "inverted", "sharp_edges", "hum", "spikes", "glitches", "partial_frame"];
    !beside.contains(&warning.code())
}

/// How many of the rows are so.
pub fn count(rows: &[Row], of: impl Fn(&Row) -> bool) -> usize {
    rows.iter().filter(|row| of(row)).count()
}

pub const HEAD: &str = "| | traces | triggers, median | 90 % | exposure, median | 90 % | triggers covered | exposure \
     covered | from the trace | wrong | silently | warnings |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|";

pub fn print(name: &str, rows: &[Row]) {
    let kept: Vec<&Row> = rows.iter().filter(|row| !row.refused).collect();
    let error = |q, of: fn(&Row) -> f64| 100.0 * quantile(kept.iter().map(|row| of(row)), q);
    let share =
        |of: &dyn Fn(&Row) -> f64| 100.0 * kept.iter().map(|row| of(row)).sum::<f64>() / kept.len().max(1) as f64;
    let mut codes: BTreeMap<&str, usize> = BTreeMap::new();
    rows.iter().flat_map(|row| &row.warnings).for_each(|code| *codes.entry(code).or_default() += 1);
    let codes: Vec<String> = codes.iter().map(|(code, n)| format!("{code} {n}")).collect();
    println!(
        "| {name} | {} | {:.3} | {:.3} | {:.3} | {:.3} | {:.0} % | {:.0} % | {} | {} | {} | {} |",
        rows.len(),
        error(0.5, |row| row.triggers),
        error(0.9, |row| row.triggers),
        error(0.5, |row| row.exposure),
        error(0.9, |row| row.exposure),
        share(&|row| row.triggers_covered),
        share(&|row| f64::from(row.covered)),
        count(rows, |row| row.from_trace),
        count(rows, Row::is_wrong),
        count(rows, Row::is_wrong_silently),
        codes.join(", "),
    );
}
