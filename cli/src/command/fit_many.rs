//! `shutter fit` of several traces or sensors: the speeds of a shutter, as a tester's list has them.

use shutter_fit::trace::Warning;
use shutter_fit::unit::{Unit, short, stops};
use shutter_fit::{Fit, From, Measured};

use crate::speeds::{self, printable};

/// A trace with what came of it.
#[derive(Clone)]
pub struct Speed {
    pub name: String,
    pub fit: Fit,
    pub warnings: Vec<Warning>,
}

/// A row for each trace.
pub fn table(speeds: &[Speed]) -> String {
    let header = ["trace", "nominal", "measured", "ΔEV", "spread", "pulses", "model"];
    speeds::table(header, speeds.iter().map(row))
        + "measured: TV, fully open for as much light, ± one standard error; spread: how much the \
           pulses of a trace differ\n"
        + &delays(speeds)
}

/// From the edge of the sync to the opening, as a table, if one is known.
fn delays(speeds: &[Speed]) -> String {
    let row = |Speed { name, fit, .. }: &Speed| {
        let (unit, delay) = (fit.unit(), fit.delay.as_ref()?);
        let digits = |seconds: f64| short(unit.of(seconds), 2);
        let optional = |seconds: Option<f64>| seconds.map_or("-".into(), digits);
        Some([
            printable(name),
            unit.plus_minus(delay.mean(), delay.error()),
            format!("± {}", digits(delay.trigger_error())),
            delay.shots.len().to_string(),
            optional(delay.spread()),
            optional(delay.worst()),
        ])
    };
    if speeds.iter().all(|speed| speed.fit.delay.is_none()) {
        return String::new();
    }
    let header = ["trace", "delay", "to any trigger", "shots", "spread", "worst"];
    let rows = speeds::table(header, speeds.iter().filter_map(row));
    let told = "delay: from the sync's edge to the opening; spread: its standard deviation between shots, and worst: \
                how far one is off their mean; shots of one speed, to 10 %, and of one edge count together\n";
    format!("\n{rows}{told}")
}

fn row(Speed { name, fit, .. }: &Speed) -> [String; 7] {
    let (unit, nominal) = (fit.unit(), fit.nominal);
    let Measured { value, error } = fit.exposure;
    let delta = |nominal: f64| {
        let of_ev = error / value / std::f64::consts::LN_2;
        let error = if of_ev < 0.005 { String::new() } else { format!(" ± {of_ev:.2}") };
        stops((value / nominal).log2()) + &error
    };
    let spread = match fit.frames.count {
        ..=1 => "-".into(),
        _ => format!("{} %", short(100.0 * fit.frames.scatter, 2)),
    };
    [
        printable(name),
        nominal.map_or("-".into(), |nominal| unit.show(nominal)),
        unit.plus_minus(value, error),
        nominal.map_or("-".into(), delta),
        spread,
        fit.frames.count.to_string(),
        match fit.from {
            From::Model => fit.chosen.title().into(),
            From::Trace => "none: by the trace".into(),
        },
    ]
}

/// A row for each sensor of each speed, as behind a curtain shutter, compared with the first: each one's exposure, and
/// how long the curtains travel between them.
pub fn sensors(speeds: &[Vec<Speed>]) -> String {
    let header = ["sensor", "exposure", "ΔEV", "stops", "opens later by", "closes later by", "model"];
    let row = |first: &Speed, k: usize, Speed { name, fit, .. }: &Speed| {
        let first = &first.fit;
        let later = |place: usize| {
            let ends = [0, fit.triggers.len() - 1].map(|k| [first, fit].map(|fit| fit.triggers[k].error));
            let [from, to] = [first, fit].map(|fit| fit.half_light()[place]);
            let error = ends[place][0].hypot(ends[place][1]);
            let unit = Unit::fit((to - from).abs().max(error));
            if k == 0 { "-".into() } else { unit.plus_minus(to - from, error) }
        };
        let (unit, Measured { value, error }) = (fit.unit(), fit.exposure);
        let more = if k == 0 { "-".into() } else { stops((value / first.exposure.value).log2()) };
        let ev = fit.nominal.map_or("-".into(), |nominal| stops((value / nominal).log2()));
        let exposure = unit.plus_minus(value, error);
        [name.clone(), exposure, ev, more, later(0), later(1), fit.chosen.title().into()]
    };
    let rows = speeds.iter().flat_map(|speed| speed.iter().enumerate().map(|(k, sensor)| row(&speed[0], k, sensor)));
    speeds::table(header, rows)
        + "ΔEV: against --nominal; stops: how much more light the sensor gets than the first one; opens, closes later \
           by: the\ntravel of the first and of the second curtain from the first sensor to this one, at half light\n"
}
