//! The two set-ups: which light the same shutter leaves of equal pulses, and of those made for it.

use crate::lamp::{Lamp, SetUp};
use shutter_curve::ShutterCurve;

use crate::plan::{Curve, Plan, Trigger};

/// The light of each flash of a plan, the greatest being 1; without a curve, all are alike.
pub fn doses(set_up: SetUp, plan: &Plan) -> Vec<f64> {
    let Some(Curve { shutter: curve, .. }) = &plan.curve else { return vec![1.0; plan.triggers.len()] };
    let time = |ticks| (f64::from(curve.open_start()) + plan.seconds(ticks)) as f32;
    let dose = |trigger: &Trigger| match (set_up, trigger.pulse) {
        (SetUp::Emulated, None) => 1.0,
        (SetUp::Emulated, Some((on, off))) => f64::from(off - on),
        (SetUp::InPath, None) => f64::from(curve.openness(time(trigger.ticks))),
        (SetUp::InPath, Some((on, off))) => f64::from(curve.cdf(time(off))) - f64::from(curve.cdf(time(on))),
    };
    let doses: Vec<f64> = plan.triggers.iter().map(dose).collect();
    let most = doses.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    doses.iter().map(|dose| dose / most).collect()
}

/// How much of each share the lamp is on, where the scene does not say.
const DUTY: f32 = 0.5;

/// A plan's pulses in both set-ups.
pub struct SetUps {
    /// How long an equal pulse is, in seconds.
    pub length: f32,
    /// The curve emulated; the same pulses with the shutter in the light's path; pulses of equal doses there.
    pub rows: [Row; 3],
}

/// What exposes, in one of the set-ups.
pub struct Row {
    /// What happens in it.
    pub title: &'static str,
    /// Is the shutter in the light's path, with its openness?
    pub is_shuttered: bool,
    /// When the lamp is on, in seconds.
    pub pulses: Vec<(f32, f32)>,
}

impl SetUps {
    /// Those of a plan.
    pub fn new(plan: &Plan, curve: &ShutterCurve) -> Self {
        let n = plan.triggers.len();
        let duty = match plan.lamp {
            Lamp::Doses { duty } => duty,
            _ => DUTY,
        };
        // As long as a pulse of the same dose where the shutter is fully open, so that both set-ups get the same light.
        let length = duty * curve.exposure() / n as f32;
        let around = |t: f32| (t - 0.5 * length, t + 0.5 * length);
        let equal: Vec<_> = plan.triggers.iter().map(|trigger| around(trigger.time as f32)).collect();
        let time = |fraction: f32| curve.inverse_cdf(fraction / n as f32);
        let doses = (0..n).map(|i| {
            let middle = i as f32 + 0.5;
            (time(middle - 0.5 * duty), time(middle + 0.5 * duty))
        });
        let emulated = Row {
            title: "The curve is emulated: the camera stays open, equal pulses come at the triggers",
            is_shuttered: false,
            pulses: equal.clone(),
        };
        let dimmed = Row {
            title: "The shutter is in the light's path: it dims the same pulses a second time",
            is_shuttered: true,
            pulses: equal,
        };
        let equalised = Row {
            title: "The shutter is in the light's path: these pulses get equal doses through it",
            is_shuttered: true,
            pulses: doses.collect(),
        };
        Self { length, rows: [emulated, dimmed, equalised] }
    }
}

impl Row {
    /// The light of a pulse, against that of an equal pulse, `length` seconds long, which nothing dims.
    pub fn dose(&self, curve: &ShutterCurve, length: f32, (on, off): (f32, f32)) -> f32 {
        match self.is_shuttered {
            true => (curve.cdf(off) - curve.cdf(on)) * curve.exposure() / length,
            false => (off - on) / length,
        }
    }
}
