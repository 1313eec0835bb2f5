//! What a command line sets in place of a scene.

use shutter_fit::unit::{Unit, short};
use toml_edit::{DocumentMut, Item, value};

use super::fit::trigger_count;
use super::quantity::{self, time, whole_rate};
use crate::lamp::SetUp;

/// The settings of a frame. They count in place of the scene's.
#[derive(clap::Args, Default)]
pub struct Settings {
    /// How many triggers
    #[arg(long, value_name = "N", value_parser = trigger_count())]
    triggers: Option<u32>,
    /// The timer's rate: 1000000, 84MHz
    #[arg(long, value_name = "HERTZ", value_parser = whole_rate)]
    timer_hz: Option<u32>,
    /// The least time between two triggers, or of darkness between pulses: 100us
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    min_gap: Option<f64>,
    /// Pulses of equal doses: the lamp is on for this part of each share of the exposure, above 0 and at most 1
    #[arg(long, value_name = "PART")]
    duty: Option<f64>,
    /// Flashes of one length in equal steps while the shutter is fully open
    #[arg(long, conflicts_with = "duty")]
    fully_open: bool,
    /// Is the shutter in the light's path, or only emulated?
    #[arg(long)]
    set_up: Option<SetUp>,
    /// Does the delay count from the falling edge of the sync?
    #[arg(long, value_name = "true|false")]
    sync_falls: Option<bool>,
}

impl Settings {
    /// The scene with these settings; itself where there are none, or where it is no TOML.
    pub fn of(&self, text: &str) -> String {
        let Ok(mut scene) = text.parse::<DocumentMut>() else { return text.into() };
        let unit = scene.get("unit").and_then(Item::as_str).and_then(quantity::unit);
        let gap = self.min_gap.map(|gap| unit.unwrap_or(Unit::Second).of(gap));
        // To the digits that were given: 100 us are 0.1 ms, whatever the binary product is.
        let gap = gap.map(|gap| short(gap, 15).parse().unwrap_or(gap));
        let set = [
            ("triggers", self.triggers.map(|n| value(i64::from(n)))),
            ("timer_hz", self.timer_hz.map(|hz| value(i64::from(hz)))),
            ("min_gap", gap.map(value)),
            ("duty", self.duty.map(value)),
            ("fully_open", self.fully_open.then(|| value(true))),
            ("set_up", self.set_up.map(|it| value(it.name()))),
            ("sync_falls", self.sync_falls.map(value)),
        ];
        for (key, item) in set {
            if let Some(item) = item {
                scene[key] = item;
            }
        }
        // A scene has one of them.
        let others: &[_] = match (self.duty.is_some(), self.fully_open) {
            (true, _) => &["pulse", "fully_open"],
            (_, true) => &["pulse", "duty", "min_pulse"],
            _ => &[],
        };
        for key in others {
            scene.remove(key);
        }
        scene.to_string()
    }

    /// What is doubtful: an edge that is not the scene's, which a trace may have told.
    pub fn doubt(&self, file: &str, text: &str) -> Option<String> {
        let scene: DocumentMut = text.parse().ok()?;
        let told = scene.get("sync_falls")?.as_bool()?;
        let said = self.sync_falls.filter(|said| *said != told)?;
        let edge = if said { "falling" } else { "rising" };
        Some(format!(
            "{file} has sync_falls = {told}, and --sync-falls {said} counts from the {edge} edge: that is right if \
             something between the camera and the timer inverts the sync"
        ))
    }
}
