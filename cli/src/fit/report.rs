//! A fit as text: what was measured, each candidate, the results with their standard errors.

use std::fmt::{self, Write};

use super::outcome::{Fit, Reason, Tolerance};
use crate::unit::{count, decimals, short, trimmed};

/// Longer tables lose their middle; half as many rows stay at each end.
const MOST_ROWS: usize = 25;

/// The fit of the trace `name`, for a terminal.
pub fn text(name: &str, fit: &Fit) -> String {
    let mut text = String::new();
    write_text(&mut text, name, fit).expect("a string takes all");
    text
}

fn write_text(out: &mut String, name: &str, fit: &Fit) -> fmt::Result {
    let (unit, best) = (fit.unit(), fit.best());
    let curve = &best.signal.curve;
    let times = &fit.samples.times;
    let step = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    writeln!(out, "trace        {name}")?;
    write!(out, "pulse        {} of {}", fit.frames.fitted, fit.frames.count)?;
    if fit.frames.count > 1 {
        write!(out, "; the exposures scatter by {} %", short(100.0 * fit.frames.scatter, 2))?;
    }
    writeln!(out, "\nsamples      {}, {} apart", times.len(), unit_of(step))?;
    let way = if fit.inverted { "below" } else { "above" };
    let dark = if fit.inverted { -best.signal.dark } else { best.signal.dark };
    writeln!(
        out,
        "light        {} {way} the dark at {}",
        short(best.signal.gain, 4),
        short(dark, 4)
    )?;

    writeln!(
        out,
        "\n  model                     opens      open    closes   rms %    ΔBIC    shift"
    )?;
    for candidate in &fit.candidates {
        let kind = candidate.signal.kind;
        let c = &candidate.signal.curve;
        let mark = if kind == fit.chosen { '*' } else { ' ' };
        let [opens, open, closes] = [c.opening, c.plateau, c.closing].map(|t| short(unit.of(t), 4));
        let (rms, shift) = (short(100.0 * candidate.rms, 3), short(unit.of(candidate.shift), 2));
        let bic = trimmed(candidate.delta_bic, 0);
        let title = kind.title();
        writeln!(
            out,
            "{mark} {title:22}  {opens:>8}  {open:>8}  {closes:>8}  {rms:>6}  {bic:>6}  {shift:>7}"
        )?;
        if let Some(error) = candidate.left_out {
            writeln!(out, "    on shots left out: {} % of the exposure", short(100.0 * error, 2))?;
        }
    }
    let name = unit.name();
    writeln!(out, "  in {name}; shift: the most by which a trigger lies off the free model's")?;
    writeln!(out, "chosen       {}", fit.chosen.title())?;
    writeln!(out, "because      {}", because(fit))?;

    let known = |m: super::Measured| plus_minus(unit.of(m.value), unit.of(m.error), name);
    writeln!(
        out,
        "\nopens        from {} to {} {name}",
        at(fit, curve.start),
        at(fit, curve.open_end())
    )?;
    writeln!(
        out,
        "closes       from {} to {} {name}",
        at(fit, curve.close_start()),
        at(fit, curve.end())
    )?;
    if fit.chosen.parameters() > 4 {
        let [o, c] = curve.controls.map(|controls| controls.map(|x| trimmed(x, 3)).join(" "));
        writeln!(out, "ramps        x1 y1 x2 y2: {o} opening, {c} closing")?;
        writeln!(out, "             (the closing ramp seen backwards; fractions of each ramp)")?;
    }
    writeln!(out, "exposure     {}", known(fit.exposure))?;
    let efficiency = plus_minus(100.0 * fit.efficiency.value, 100.0 * fit.efficiency.error, "%");
    writeln!(out, "efficiency   {efficiency}")?;
    if fit.peak < 1.0 {
        writeln!(out, "peak         {} % of full light", short(100.0 * fit.peak, 4))?;
    }
    writeln!(out, "             (standard errors behind ±)")?;

    let (time, error) = (format!("time ({name})"), format!("error ({name})"));
    writeln!(out, "\n    #        u  {time:>15}  {error:>12}")?;
    let n = fit.triggers.len();
    let least = fit.triggers.iter().map(|trigger| unit.of(trigger.error));
    // Two digits of the least error, and as many decimals for all: a column that the eye can run down.
    let places = decimals(least.fold(f64::INFINITY, f64::min), 2).min(12);
    let hidden = if n > MOST_ROWS { MOST_ROWS / 2..n - MOST_ROWS / 2 } else { n..n };
    for (i, trigger) in fit.triggers.iter().enumerate() {
        if i == hidden.start {
            writeln!(out, "  ...  {} more", hidden.len())?;
        }
        if hidden.contains(&i) {
            continue;
        }
        let u = (i as f64 + 0.5) / n as f64;
        let (time, error) = (at(fit, trigger.value), unit.of(trigger.error));
        writeln!(out, "{i:5}  {u:.5}  {time:>15}  {error:>12.places$}")?;
    }
    Ok(())
}

/// A time, to a hundredth of a per mille of the interval.
fn at(fit: &Fit, seconds: f64) -> String {
    let unit = fit.unit();
    let places = decimals(unit.of(fit.best().signal.curve.length()), 5);
    format!("{:.places$}", unit.of(seconds))
}

fn unit_of(seconds: f64) -> String {
    crate::unit::Unit::fit(seconds).show(seconds)
}

/// Why the model was chosen.
pub fn because(fit: &Fit) -> String {
    match fit.reason {
        Reason::Asked => "as asked".into(),
        Reason::Tolerance(Tolerance::Share(share)) => format!(
            "the simplest whose triggers are within {} % of the exposure of the free model's",
            short(100.0 * share, 3)
        ),
        Reason::Tolerance(Tolerance::Seconds(seconds)) => format!(
            "the simplest whose triggers are within {} of the free model's",
            fit.unit().show(seconds)
        ),
        Reason::Shots { shots, scatter } => format!(
            "the simplest that meets shots left out as well as {} meet each other, to {} %",
            count(shots as u64, "shot"),
            short(100.0 * scatter, 2)
        ),
        Reason::Criterion { effective } => {
            format!("least BIC, from one shot of {} independent samples", trimmed(effective, 0))
        }
    }
}

/// A value and its standard error, to the digits that the error leaves.
pub fn plus_minus(value: f64, error: f64, unit: &str) -> String {
    let places =
        if error > 0.0 && error.is_finite() { decimals(error, 2) } else { decimals(value, 5) };
    let places = places.min(12);
    format!("{value:.places$} ± {error:.places$} {unit}")
}
