//! What a command line sets in place of a scene.

use shutter_fit::unit::{Unit, short};

use super::fit::trigger_count;
use super::quantity::{time, whole_rate};
use shutter_plan::fault::Key;
use shutter_plan::lamp::SetUp;
use shutter_plan::scene::Scene;

/// The settings of a frame. They count in place of the scene's.
#[derive(clap::Args, Default)]
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
    pub fn set(&self, scene: &mut Scene) -> Vec<Key> {
        let (unit, flashes) = (scene.unit(), &mut scene.flashes);
        let mut keys = Vec::new();
        let mut set = |key, place: &mut Option<f64>, x: Option<f64>| {
            if x.is_some() {
                *place = x;
                keys.push(key);
            }
        };
        // To the digits that were given: 100 us are 0.1 ms, whatever the binary product is.
        let of = |seconds: Option<f64>| seconds.map(|it| tidy(unit, it));
        set("flashes.triggers", &mut flashes.triggers, self.triggers.map(f64::from));
        set("flashes.timer_hz", &mut flashes.timer_hz, self.timer_hz.map(f64::from));
        set("flashes.min_gap", &mut flashes.min_gap, of(self.min_gap));
        set("flashes.pulse", &mut flashes.pulse, of(self.pulse));
        set("flashes.duty", &mut flashes.duty, self.duty);
        set("flashes.min_pulse", &mut flashes.min_pulse, of(self.min_pulse));
        set("flashes.lamp_lag", &mut flashes.lamp_lag, of(self.lamp_lag));
        set("flashes.delay", &mut flashes.delay, of(self.delay));
        if self.set_up.is_some() {
            flashes.set_up = self.set_up;
            keys.push("flashes.set_up");
        }
        if self.sync_falls.is_some() {
            flashes.sync_falls = self.sync_falls;
            keys.push("flashes.sync_falls");
        }
        if self.fully_open {
            flashes.fully_open = Some(true);
            keys.push("flashes.fully_open");
        }
        keys
    }
}

fn tidy(unit: Unit, seconds: f64) -> f64 {
    let time = unit.of(seconds);
    short(time, 15).parse().unwrap_or(time)
}
