//! Plans as rows, one for each trigger. Units stand in the names.

use super::has_pulses;
use crate::plan::{Plan, Trigger};

/// The rows of a plan.
pub fn rows(scene: &str, plan: &Plan) -> String {
    table(std::iter::once((scene, plan)), false)
}

/// The rows of several plans, each with its scene's name.
pub fn all(plans: &[(String, Plan)]) -> String {
    table(plans.iter().map(|(scene, plan)| (scene.as_str(), plan)), true)
}

fn table<'a>(
    plans: impl Iterator<Item = (&'a str, &'a Plan)> + Clone,
    names_scenes: bool,
) -> String {
    let has_delays = plans.clone().any(|(_, plan)| plan.delay.is_some());
    let has_lamps = plans.clone().any(|(_, plan)| has_pulses(plan));
    let some = |is_there: bool, names: &[&str]| match is_there {
        true => names.iter().map(ToString::to_string).collect(),
        false => Vec::new(),
    };
    let mut records = vec![
        [
            some(names_scenes, &["scene"]),
            some(true, &["index", "u", "time_s", "ticks", "gap_ticks"]),
            some(has_delays, &["from_edge_ticks"]),
            some(has_lamps, &["on_ticks", "off_ticks"]),
        ]
        .concat(),
    ];
    for (scene, plan) in plans {
        let mut last = None;
        for (index, trigger) in plan.triggers.iter().enumerate() {
            let &Trigger { u, time, ticks, pulse } = trigger;
            let gap = number(last.replace(ticks).map(|last| ticks - last));
            let (on, off) =
                (number(pulse.map(|pulse| pulse.0)), number(pulse.map(|pulse| pulse.1)));
            let edge = number(plan.from_edge(ticks));
            let record =
                [index.to_string(), u.to_string(), time.to_string(), ticks.to_string(), gap];
            records.push(
                [
                    some(names_scenes, &[scene]),
                    record.to_vec(),
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
fn number(ticks: Option<u32>) -> String {
    ticks.map_or(String::new(), |ticks| ticks.to_string())
}
