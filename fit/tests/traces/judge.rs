//! What came of traces with a known truth: errors as shares of the exposure, what the stated errors hold, what is told.

use std::collections::BTreeMap;
use std::time::Instant;

use shutter_fit::trace::Warning;
use shutter_fit::{Fit, From, Measured, Options, Sync, fit};

use crate::generator::{Case, quantile};

/// So long before a trace its sync is said to come: then what is known of the delay is what is known of the opening.
const EARLY: f64 = 1e3;

/// An interval of so many standard errors to either side holds 95 % of all values, if these are normal.
const INTERVAL: f64 = 1.96;
/// Results beyond these, as shares of the exposure, are wrong: of the triggers, of the exposure.
const WRONG: (f64, f64) = (0.0015, 0.005);
/// Intervals are too wide where more of them hold the truth than would once in so many times, if so large a share did:
/// fewer than 194 never are.
const TOO_WIDE: (f64, f64) = (50.0, 0.98);

/// What came of a trace.
#[derive(Default)]
pub struct Row {
    pub refused: bool,
    /// Was a simple curve not fitted by a freer one?
    simple: Option<bool>,
    /// The root of the mean square of the triggers' errors, the greatest, and the exposure's.
    pub triggers: f64,
    greatest: f64,
    pub exposure: f64,
    /// The share of the triggers whose interval holds the truth, and of the start and a tester's T1 to T3; does the
    /// exposure's, and the efficiency's?
    triggers_covered: Option<f64>,
    times_covered: Option<f64>,
    pub covered: bool,
    efficiency_covered: bool,
    pub from_trace: bool,
    pub warnings: Vec<&'static str>,
    /// Does a warning tell that it may be wrong?
    pub is_told: bool,
    /// Its errors are beyond what is allowed.
    pub is_wrong: bool,
    seconds: f64,
}

impl Row {
    pub fn new(case: &Case) -> Self {
        let clock = Instant::now();
        let sync = case.other.is_none().then_some(Sync::Edge(-EARLY));
        let fit = fit(&case.trace, &Options { sync, ..Options::default() }, &mut |_| ());
        let seconds = clock.elapsed().as_secs_f64();
        match fit {
            Ok(fit) => Self { seconds, ..Self::of(case, &fit) },
            Err(_) => Self { seconds, refused: true, is_told: true, warnings: vec!["refused"], ..Self::default() },
        }
    }

    fn of(case: &Case, fit: &Fit) -> Self {
        let exposure = case.exposure();
        let holds = |m: Measured, truth: f64| (m.value - truth).abs() <= INTERVAL * m.error + 1e-9 * case.scale;
        let (n, mut row, mut held) = (fit.triggers.len() as f64, Self::default(), 0.0);
        for (i, trigger) in fit.triggers.iter().enumerate() {
            let truth = case.trigger((i as f64 + 0.5) / n);
            let error = (trigger.value - truth).abs() / exposure;
            row.triggers += error * error / n;
            row.greatest = row.greatest.max(error);
            held += f64::from(holds(*trigger, truth)) / n;
        }
        row.triggers = row.triggers.sqrt();
        row.triggers_covered = Some(held);
        // Which of several shots was fitted is not known here: their triggers are not judged, and any exposure is as
        // true.
        if case.other.is_some() {
            row = Self::default();
        }
        let off = |truth: &f64| (fit.exposure.value - truth).abs();
        let truth = [exposure].into_iter().chain(case.other).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
        row.exposure = off(&truth) / exposure;
        row.is_wrong = row.triggers > WRONG.0.max(case.allowed) || row.exposure > WRONG.1.max(case.allowed);
        row.covered = holds(fit.exposure, truth);
        row.efficiency_covered = match fit.most_efficiency() {
            Some(most) => case.truth.efficiency() <= most,
            None => (fit.efficiency.value - case.truth.efficiency()).abs() <= INTERVAL * fit.efficiency.error + 1e-5,
        };
        row.times_covered = case.times.zip(fit.delay.as_ref()).map(|([start, open, close, end], delay)| {
            let delay = Measured { value: delay.mean() - EARLY, error: delay.error() };
            let parts = fit.parts.into_iter().zip([open - start, close - open, end - close]);
            let all = parts.chain([(delay, start)]);
            all.map(|(measured, truth)| f64::from(holds(measured, truth)) / 4.0).sum()
        });
        row.simple = case.kind.map(|kind| fit.chosen <= kind);
        row.from_trace = fit.from == From::Trace;
        row.warnings = fit.warnings.iter().map(Warning::code).collect();
        row.is_told = fit.warnings.iter().any(|warning| row.is_told_by(warning));
        row
    }

    /// Does a warning tell that the results may be so wrong? None of noise or drift does, and one of sharp edges no
    /// more than what it says: half a sample at an edge, a sample of the exposure.
    fn is_told_by(&self, warning: &Warning) -> bool {
        const TELL: &str = "shots_differ pulsed ac_coupled clipped cut_tail slow_tail flicker short_hum no_plateau \
                            wide_error gap unseen drift_or_capacitor misfit untested sound_card";
        match warning {
            Warning::SharpEdges { share, .. } => self.triggers <= 0.5 * share && self.exposure <= *share,
            other => TELL.split_whitespace().any(|code| code == other.code()),
        }
    }

    pub fn is_wrong_silently(&self) -> bool {
        self.is_wrong && !self.is_told
    }

    pub fn says(&self, code: &str) -> bool {
        self.warnings.contains(&code)
    }
}

/// How many of the rows are so.
pub fn count(rows: &[Row], of: impl Fn(&Row) -> bool) -> usize {
    rows.iter().filter(|row| of(row)).count()
}

/// The mean of what is known.
fn share(rows: &[&Row], of: impl Fn(&Row) -> Option<f64>) -> f64 {
    let known: Vec<f64> = rows.iter().filter_map(|row| of(row)).collect();
    known.iter().sum::<f64>() / known.len() as f64
}

/// How often the stated errors hold the truth: of triggers, exposure, efficiency, and times where there are some.
fn coverage(rows: &[&Row]) -> [f64; 4] {
    [
        share(rows, |row| row.triggers_covered),
        share(rows, |row| Some(f64::from(row.covered))),
        share(rows, |row| Some(f64::from(row.efficiency_covered))),
        share(rows, |row| row.times_covered),
    ]
}

/// Limits on how often an interval holds the truth: not too seldom, and not because it is too wide, but for what is in
/// it that these shutters do not do.
pub fn judge_coverage(rows: &[Row], least: [f64; 4]) {
    let covered = coverage(&rows.iter().collect::<Vec<_>>());
    assert!(covered.iter().zip(least).all(|(share, least)| *share >= least), "covered: {covered:.3?}");
    let sighted: Vec<&Row> = rows.iter().filter(|row| !row.says("unseen")).collect();
    let [triggers, exposures, ..] = coverage(&sighted);
    let (times, n) = (TOO_WIDE.0, sighted.len());
    let are_too_wide = [triggers, exposures].map(|share| times * chance(n, n as f64 * (1.0 - share)) < 1.0);
    assert!(are_too_wide == [false; 2], "covered without `unseen`: {triggers}, {exposures} of {n}");
}

/// How likely it is that no more than so many of `n` intervals miss the truth, where that of [`TOO_WIDE`] holds it.
fn chance(n: usize, missed: f64) -> f64 {
    let holds = TOO_WIDE.1;
    let (mut term, mut sum) = (holds.powf(n as f64), 0.0);
    for k in 0..=missed.round() as usize {
        sum += term;
        term *= (n - k) as f64 / (k + 1) as f64 * (1.0 - holds) / holds;
    }
    sum
}

/// Limits on the triggers' errors, their median and what 90 % of the rows keep, and on the choice of the kind.
pub fn judge_errors(rows: &[Row], (median, most): (f64, f64)) {
    assert!(count(rows, |row| row.refused) * 1000 <= rows.len(), "traces without a result");
    let [half, nearly_all] = [0.5, 0.9].map(|q| quantile(rows.iter().map(|row| row.triggers), q));
    assert!(half <= median && nearly_all <= most, "errors: {half}, {nearly_all}");
    let simple = share(&rows.iter().collect::<Vec<_>>(), |row| row.simple.map(f64::from));
    assert!(simple >= 0.9, "kept simple: {simple}");
}

pub fn head(title: &str) {
    println!(
        "\n| {title} | traces | triggers, median; 90 % | worst trigger | exposure | covered: triggers; exposure; \
         efficiency; times | without `unseen` | kept simple | from the trace | refused | wrong; silently | ms | \
         warnings |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|"
    );
}

pub fn print(name: &str, all: &[Row]) {
    let rows: Vec<&Row> = all.iter().filter(|row| !row.refused).collect();
    let sighted: Vec<&Row> = rows.iter().copied().filter(|row| !row.says("unseen")).collect();
    let error = |of: fn(&Row) -> f64| {
        let [half, most] = [0.5, 0.9].map(|q| 100.0 * quantile(rows.iter().map(|row| of(row)), q));
        format!("{half:.3}; {most:.3}")
    };
    let covered = |rows: &[&Row]| coverage(rows).map(|share| format!("{:.0}", 100.0 * share)).join("; ");
    let mut codes: BTreeMap<&str, usize> = BTreeMap::new();
    all.iter().flat_map(|row| &row.warnings).for_each(|code| *codes.entry(code).or_default() += 1);
    let codes: Vec<String> = codes.iter().map(|(code, n)| format!("{code} {n}")).collect();
    println!(
        "| {name} | {} | {} | {} | {} | {} | {}: {} | {:.0} | {} | {} | {}; {} | {:.0} | {} |",
        all.len(),
        error(|row| row.triggers),
        error(|row| row.greatest),
        error(|row| row.exposure),
        covered(&rows),
        sighted.len(),
        covered(&sighted),
        100.0 * share(&rows, |row| row.simple.map(f64::from)),
        count(all, |row| row.from_trace),
        count(all, |row| row.refused),
        count(all, |row| row.is_wrong),
        count(all, Row::is_wrong_silently),
        1e3 * share(&rows, |row| Some(row.seconds)),
        codes.join(", "),
    );
}
