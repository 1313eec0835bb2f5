//! Plans as rows, one for each trigger. Units stand in the names.

use super::has_pulses;
use crate::planned::{Planned, Row};

/// The rows of a plan.
pub fn rows(scene: &str, plan: &Planned) -> String {
    table(std::iter::once((scene, plan)), false)
}

/// The rows of several plans, each with its scene's name.
pub fn all(plans: &[(String, Planned)]) -> String {
    table(plans.iter().map(|(scene, plan)| (scene.as_str(), plan)), true)
}

fn table<'a>(
    plans: impl Iterator<Item = (&'a str, &'a Planned)> + Clone,
    names_scenes: bool,
) -> String {
    let has_curves = plans.clone().any(|(_, plan)| plan.plan().is_some());
    let has_delays = plans.clone().any(|(_, plan)| plan.delay().is_some());
    let has_lamps = plans.clone().any(|(_, plan)| has_pulses(plan));
    let some = |is_there: bool, names: &[&str]| match is_there {
        true => names.iter().map(ToString::to_string).collect(),
        false => Vec::new(),
    };
    let mut records = vec![
        [
            some(names_scenes, &["scene"]),
            some(true, &["index"]),
            some(has_curves, &["u"]),
            some(true, &["time_s", "ticks", "gap_ticks"]),
            some(has_delays, &["from_edge_ticks"]),
            some(has_lamps, &["on_ticks", "off_ticks"]),
        ]
        .concat(),
    ];
    for (scene, plan) in plans {
        let mut last = None;
        for (index, row) in plan.rows().into_iter().enumerate() {
            let Row { u, time, ticks, pulse } = row;
            let gap = number(last.replace(ticks).map(|last| ticks - last));
            let (on, off) =
                (number(pulse.map(|pulse| pulse.0)), number(pulse.map(|pulse| pulse.1)));
            let edge = number(plan.from_edge(ticks));
            records.push(
                [
                    some(names_scenes, &[scene]),
                    some(true, &[&index.to_string()]),
                    some(has_curves, &[&number(u)]),
                    some(true, &[&time.to_string(), &ticks.to_string(), &gap]),
                    some(has_delays, &[&edge]),
                    some(has_lamps, &[&on, &off]),
                ]
                .concat(),
            );
        }
    }
    let mut out = csv::Writer::from_writer(Vec::new());
    for record in records {
        out.write_record(record).expect("memory takes all");
    }
    String::from_utf8(out.into_inner().expect("memory takes all")).expect("names are text")
}

/// A number, or nothing.
fn number(number: Option<impl ToString>) -> String {
    number.map_or(String::new(), |number| number.to_string())
}
