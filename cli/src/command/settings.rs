//! What a command line sets in place of a scene.

use clap::{Args, Command};
use serde::Serialize;
use shutter_fit::unit::short;
use shutter_plan::lamp::SetUp;
use shutter_plan::scene::Scene;
use toml::{Table, Value};

use super::fit::trigger_count;
use super::quantity::{time, whole_rate};

/// The settings of a frame. They count in place of the scene's.
#[derive(Args, Default, Serialize)]
pub struct Settings {
    /// How many triggers
    #[arg(long, value_name = "N", value_parser = trigger_count())]
    triggers: Option<u32>,
    /// The timer's rate: 1000000, 84MHz
    #[arg(long, value_name = "HERTZ", value_parser = whole_rate)]
    timer_hz: Option<u32>,
    /// The least time between two triggers, or of darkness between pulses: 100us, 0
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    min_gap: Option<f64>,
    /// Is the shutter in the light's path, or only emulated?
    #[arg(long)]
    set_up: Option<SetUp>,
    /// Equal pulses of this length around the triggers: 50us
    #[arg(long, value_name = "TIME", value_parser = time)]
    pulse: Option<f64>,
    /// Pulses of equal doses: the lamp is on for this part of each share of the exposure, above 0 and at most 1
    #[arg(long, value_name = "PART", conflicts_with = "pulse")]
    duty: Option<f64>,
    /// The shortest pulse that --duty may give
    #[arg(long, value_name = "TIME", value_parser = time)]
    min_pulse: Option<f64>,
    /// Flashes of one length in equal steps while the shutter is fully open
    #[arg(long, conflicts_with_all = ["duty", "pulse", "min_pulse"])]
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    fully_open: bool,
    /// From a trigger to the lamp's light; each trigger comes earlier by this time
    #[arg(long, value_name = "TIME", value_parser = time)]
    lamp_lag: Option<f64>,
    /// From the edge of the sync to the start of opening, in place of the trace's; below 0 if it opens before
    #[arg(long, value_name = "TIME", value_parser = time, allow_hyphen_values = true)]
    delay: Option<f64>,
    /// Does the delay count from the falling edge of the sync?
    #[arg(long, value_name = "true|false")]
    sync_falls: Option<bool>,
}

impl Settings {
    /// Sets them in a scene, and tells which.
    pub fn set(&self, scene: &mut Scene) -> Vec<String> {
        const PLAIN: &str = "keys, numbers and words";
        let unit = scene.unit();
        let mut own = Table::try_from(self).expect(PLAIN);
        // Those that the help calls times are in seconds.
        let options = Self::augment_args(Command::new(""));
        let names = |key: &str| options.get_arguments().find(|it| it.get_id() == key)?.get_value_names();
        for (_, time) in own.iter_mut().filter(|(key, _)| names(key.as_str()).is_some_and(|it| it[0] == "TIME")) {
            // To the digits that were given: 100 us are 0.1 ms, whatever the binary product is.
            let digits = time.as_float().map(|seconds| short(unit.of(seconds), 15).parse());
            *time = digits.and_then(Result::ok).map_or(time.clone(), Value::Float);
        }
        let mut flashes = Table::try_from(&scene.flashes).expect(PLAIN);
        let keys = own.keys().map(|key| format!("flashes.{key}")).collect();
        flashes.extend(own);
        scene.flashes = flashes.try_into().expect(PLAIN);
        keys
    }
}
