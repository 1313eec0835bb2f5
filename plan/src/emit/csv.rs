//! Plans as rows, one for each trigger. Units stand in the names.

use serde::Serialize;

use crate::plan::{Plan, Row};

/// The scene's name, and the keys of a row.
const NAMES: &[u8] = b"scene,index,u,time_s,ticks,gap_ticks,from_edge_ticks,on_ticks,off_ticks,dose\n";

/// The rows of plans; what one of them does not have is empty.
pub fn rows<'a>(plans: impl IntoIterator<Item = (&'a str, &'a Plan)>) -> String {
    let mut out = csv::WriterBuilder::new().has_headers(false).from_writer(NAMES.to_vec());
    for (scene, plan) in plans {
        for Row { index, u, time_s, ticks, gap_ticks, from_edge_ticks, on_ticks, off_ticks, dose } in plan.rows() {
            let counts = [Some(ticks), gap_ticks, from_edge_ticks, on_ticks, off_ticks].map(cell);
            let row = [scene.into(), cell(index), cell(u), cell(time_s)].into_iter().chain(counts).chain([cell(dose)]);
            out.write_record(row).expect("memory takes all");
        }
    }
    String::from_utf8(out.into_inner().expect("memory takes all")).expect("names are text")
}

/// A number as JSON has it: one way to write them makes the page smaller.
fn cell(number: impl Serialize) -> String {
    serde_json::to_string(&number).unwrap_or_default().replace("null", "")
}
