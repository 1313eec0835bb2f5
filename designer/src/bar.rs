//! The exposed picture of a bright bar that moves while the shutter is open: ideal, and as the triggers expose it.

use shutter::lamp::Lamp;
use shutter::plan::Plan;

/// The picture's columns.
const COLUMNS: u16 = 480;

/// Brightness along the way, 1 being the greatest of the ideal picture.
pub struct Bar {
    pub ideal: Vec<f32>,
    pub triggered: Vec<f32>,
}

impl Bar {
    /// Of a bar as wide as this part of the way that it moves while the shutter is open.
    pub fn new(plan: &Plan, width: f32) -> Self {
        let curve = &plan.curve;
        let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
        // A column is lit from when the bar's front reaches it until its end has passed.
        let columns = |light: &dyn Fn(f32) -> f32| -> Vec<f32> {
            let column = |i: u16| {
                let x = (f32::from(i) + 0.5) / f32::from(COLUMNS) * (1.0 + width);
                light(start + length * x) - light(start + length * (x - width))
            };
            (0..COLUMNS).map(column).collect()
        };
        let ideal = columns(&|t| curve.cdf(t));
        let flashes = Flashes::new(plan);
        let triggered = columns(&|t| flashes.light(plan, t));
        let most = ideal.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
        let relative = |light: Vec<f32>| light.iter().map(|light| light / most).collect();
        Self { ideal: relative(ideal), triggered: relative(triggered) }
    }
}

/// All flashes of a frame: when each begins and ends, and the light that came before it.
struct Flashes {
    edges: Vec<(f32, f32)>,
    before: Vec<f32>,
    all: f32,
}

impl Flashes {
    fn new(plan: &Plan) -> Self {
        let start = f64::from(plan.curve.open_start());
        let time = |ticks| (start + plan.seconds(ticks)) as f32;
        let edges: Vec<_> = plan
            .triggers
            .iter()
            .map(|trigger| trigger.pulse.unwrap_or((trigger.ticks, trigger.ticks)))
            .map(|(on, off)| (time(on), time(off)))
            .collect();
        let mut all = 0.0;
        let before = edges
            .iter()
            .map(|&edges| {
                let before = all;
                all += dose(plan, edges);
                before
            })
            .collect();
        Self { edges, before, all }
    }

    /// The share of the light that has come by the time `t`.
    fn light(&self, plan: &Plan, t: f32) -> f32 {
        let Some(last) = self.edges.partition_point(|&(on, _)| on <= t).checked_sub(1) else {
            return 0.0;
        };
        let (on, off) = self.edges[last];
        (self.before[last] + dose_until(plan, (on, off), t)) / self.all
    }
}

fn dose(plan: &Plan, edges: (f32, f32)) -> f32 {
    dose_until(plan, edges, edges.1)
}

/// The light of a flash by the time `t`: equal flashes have 1, and doses what the shutter lets through.
fn dose_until(plan: &Plan, (on, off): (f32, f32), t: f32) -> f32 {
    match plan.lamp {
        Lamp::Doses { .. } => plan.curve.cdf(t.min(off)) - plan.curve.cdf(on),
        _ if t >= off => 1.0,
        _ => (t - on) / (off - on),
    }
}
