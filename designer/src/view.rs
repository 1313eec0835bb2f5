//! All that the page shows of a scene.

use serde::Serialize;
use shutter::facts;
use shutter::plan::Plan;
use shutter::scene::{Scene, Values};
use shutter::set_up::SetUps;
use shutter::shape::Shape;
use shutter::unit::Unit;
use shutter_curve::{CubicBezier, CurveError, Ramp, ShutterCurve};

use crate::bar::Bar;
use crate::cost::{BYTES, COSTS, Cost};
use crate::{Wrong, json};

/// The points along the cdf.
const POINTS: u16 = 200;
/// More triggers are not drawn.
const MOST: u32 = 10_000;
/// More pulses are not told apart in the pictures of the set-ups.
const MOST_DOSES: usize = 128;

/// A scene's curve, and its plan where it has one. Times are in seconds.
#[derive(Serialize)]
struct View {
    times: [f32; 4],
    /// Both ramps' control points as (time, openness).
    ramps: [[(f32, f32); 4]; 2],
    cdf: Vec<(f32, f32)>,
    /// Where the equal shares of the exposure begin and end.
    edges: Vec<f32>,
    /// The triggers as (time, openness, share of the exposure).
    marks: Vec<(f32, f32, f32)>,
    plan: Result<Planned, Wrong>,
}

#[derive(Serialize)]
struct Planned {
    facts: Vec<(&'static str, String)>,
    ticks: Vec<u32>,
    pulses: Vec<(u32, u32)>,
    /// The least darkness or gap between two, in seconds, and what is asked for.
    closest: Option<f64>,
    min_gap: f64,
    most: u32,
    direct: u32,
    exposure: f32,
    bar: Bar,
    set_ups: Vec<Doses>,
    bytes: u32,
    costs: [Cost; 3],
}

/// One of the set-ups: the lamp's pulses, each with its dose of light.
#[derive(Serialize)]
struct Doses {
    title: &'static str,
    is_shuttered: bool,
    pulses: Vec<(f32, f32, f32)>,
}

/// A scene's numbers, as the page writes them into memory.
struct Question(Vec<f64>);

impl Question {
    /// The numbers of a question.
    const LENGTH: usize = 22;

    /// Of the bytes of so many `f64`, or what is wrong with them.
    fn read(bytes: &[u8]) -> Result<Self, Wrong> {
        let (numbers, rest) = bytes.as_chunks();
        let numbers: Vec<_> = numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
        match numbers.len() == Self::LENGTH && rest.is_empty() {
            true => Ok(Self(numbers)),
            false => Err("the question has another length".to_string().into()),
        }
    }

    fn bar(&self) -> f32 {
        self.0[0] as f32
    }

    fn values(&self) -> Values {
        let Self(numbers) = self;
        // Which of the optional values there are, a bit each.
        let has = numbers[2] as u32;
        let optional = |i: usize| (has & (1 << i) != 0).then(|| numbers[18 + i]);
        Values {
            unit: match numbers[1] as u32 {
                0 => Unit::Second,
                1 => Unit::Millisecond,
                2 => Unit::Microsecond,
                _ => Unit::Nanosecond,
            },
            times: std::array::from_fn(|i| numbers[3 + i]),
            triggers: numbers[7],
            timer_hz: numbers[8],
            min_gap: numbers[9],
            shutteropening: (has & (1 << 4) != 0).then(|| std::array::from_fn(|i| numbers[10 + i])),
            nominal: optional(0),
            pulse: optional(1),
            duty: optional(2),
            min_pulse: optional(3),
        }
    }
}

/// All that is shown of the scene in the question.
pub fn view(question: &[u8]) -> String {
    json(&Question::read(question).and_then(|question| View::new(&question)))
}

impl View {
    /// Of a scene.
    ///
    /// # Errors
    /// A scene without a curve. What is only wrong with its triggers is told where the plan would be.
    fn new(question: &Question) -> Result<Self, Wrong> {
        let bar = question.bar();
        let scene = Scene::try_from(question.values())?;
        let planned = Plan::new(&scene);
        let shape = scene.shape()?;
        let curve = match shape.curve() {
            Ok(curve) => curve,
            Err(error) => {
                let fault = planned.err().ok_or_else(|| error.to_string())?;
                return Err(Wrong { ramp: ramp(error), ..fault.into() });
            }
        };
        let n = scene.triggers().min(MOST);
        let times = (0..=POINTS).map(|i| {
            let part = f32::from(i) / f32::from(POINTS);
            curve.open_start() + (curve.close_end() - curve.open_start()) * part
        });
        let u = |i: f32| i / n as f32;
        let marks = (0..n).zip(curve.trigger_times(n));
        Ok(Self {
            times: shape.times,
            ramps: ramps(&shape).map(|ramp| ramp.points()),
            cdf: times.map(|t| (t, curve.cdf(t))).collect(),
            edges: (0..=n).map(|i| curve.inverse_cdf(u(i as f32))).collect(),
            marks: marks.map(|(i, t)| (t, curve.opening(t), u(i as f32 + 0.5))).collect(),
            plan: planned.map(|plan| Planned::new(&plan, &curve, bar)).map_err(Wrong::from),
        })
    }
}

impl Planned {
    fn new(plan: &Plan, curve: &ShutterCurve, bar: f32) -> Self {
        let pulses: Vec<_> = plan.triggers.iter().filter_map(|trigger| trigger.pulse).collect();
        let dark = pulses.windows(2).map(|pair| pair[1].0 - pair[0].1).min();
        let closest = if pulses.is_empty() { plan.gaps().min() } else { dark };
        let SetUps { length, rows } = SetUps::new(plan);
        let rows = if plan.triggers.len() > MOST_DOSES { Vec::new() } else { Vec::from(rows) };
        let set_ups = rows.into_iter().map(|row| Doses {
            title: row.title,
            is_shuttered: row.is_shuttered,
            pulses: row
                .pulses
                .iter()
                .map(|&(on, off)| (on, off, row.dose(plan, length, (on, off))))
                .collect(),
        });
        // The name is the page's.
        let facts = facts::lines("", plan).into_iter().filter(|(what, _)| *what != "scene");
        Self {
            facts: facts.collect(),
            ticks: plan.triggers.iter().map(|trigger| trigger.ticks).collect(),
            closest: closest.map(|ticks| plan.seconds(ticks)),
            min_gap: plan.min_gap,
            most: plan.most,
            direct: facts::Facts::new(plan).direct_triggers,
            exposure: curve.exposure(),
            bar: Bar::new(plan, bar.clamp(0.005, 1.0)),
            set_ups: set_ups.collect(),
            bytes: BYTES,
            costs: COSTS,
            pulses,
        }
    }
}

/// Both ramps, straight ones as well.
fn ramps(shape: &Shape) -> [CubicBezier; 2] {
    let [open_start, open_end, close_start, close_end] = shape.times;
    shape.ramps().unwrap_or([
        CubicBezier::line((open_start, 0.0), (open_end, 1.0)),
        CubicBezier::line((close_start, 1.0), (close_end, 0.0)),
    ])
}

/// The ramp that an error is about.
fn ramp(error: CurveError) -> Option<&'static str> {
    use CurveError as E;
    match error {
        E::NotFinite(ramp)
        | E::TimeTurnsBack(ramp)
        | E::InnerTimesTurnBack(ramp)
        | E::NegativeOpenness(ramp)
        | E::OpennessAboveOne(ramp) => Some(match ramp {
            Ramp::Opening => "opening",
            Ramp::Closing => "closing",
            Ramp::Single => return None,
        }),
        _ => None,
    }
}
