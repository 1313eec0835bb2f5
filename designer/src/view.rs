//! All that the page shows of a scene.

use serde::Serialize;
use shutter::facts;
use shutter::plan::{MOST_TRIGGERS, Plan};
use shutter::scene::{Scene, Values};
use shutter::set_up::{Row, SetUps};
use shutter::shape::Shape;
use shutter_curve::{CubicBezier, CurveError, Part as CurvePart};
use shutter_fit::unit::Unit;

use crate::answer::{Wrong, json};
use crate::bar::Bar;
use crate::cost::{BYTES, COSTS, Cost};

/// The points along the cdf.
const POINTS: u16 = 200;

/// More pulses are not told apart in the pictures of the set-ups.
const MOST_DOSES: usize = 128;

/// A scene's curve, and its plan where it has one. Times are in seconds.
#[derive(Serialize)]
struct View {
    times: Part,
    /// Both ramps' control points, time and openness of each.
    ramps: Part,
    /// Times, each with its share of the exposure.
    cdf: Part,
    /// Where the equal shares of the exposure begin and end.
    edges: Part,
    /// Of each trigger the time, the openness and the share of the exposure.
    marks: Part,
    plan: Result<Planned, Wrong>,
}

#[derive(Serialize)]
struct Planned {
    facts: Vec<(&'static str, String)>,
    ticks: Vec<u32>,
    pulses: Vec<(u32, u32)>,
    /// The least gap between two, or the least darkness, where there are two; what is asked for; the exposure.
    seconds: Part,
    direct: u32,
    /// The moving bar's brightness along its way: ideal, and as it is triggered.
    ideal: Part,
    triggered: Part,
    set_ups: Vec<Doses>,
    bytes: u32,
    costs: [Cost; 3],
}

/// One of the set-ups.
#[derive(Serialize)]
struct Doses {
    title: &'static str,
    is_shuttered: bool,
    /// When the lamp is on and off, and the dose of light, of each pulse.
    pulses: Part,
}

/// Where numbers of the answer are, from and to: the page reads them as they are in memory, which is faster than as text and
/// leaves out of its first load what writes floats.
#[derive(Serialize)]
struct Part(usize, usize);

/// All numbers of an answer.
#[derive(Default)]
struct Numbers(Vec<f64>);

impl Numbers {
    fn put<T: Into<f64>>(&mut self, numbers: impl IntoIterator<Item = T>) -> Part {
        let from = self.0.len();
        self.0.extend(numbers.into_iter().map(Into::into));
        Part(from, self.0.len())
    }
}

/// A scene's numbers, as the page writes them into memory.
struct Question(Vec<f64>);

impl Question {
    /// The numbers of a question.
    const LENGTH: usize = 23;

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
            shutteropening: (has & (1 << 5) != 0).then(|| std::array::from_fn(|i| numbers[10 + i])),
            nominal: optional(0),
            pulse: optional(1),
            duty: optional(2),
            min_pulse: optional(3),
            delay: optional(4),
        }
    }
}

/// All that is shown of the scene in the question: JSON, and the numbers that it speaks of.
pub fn view(question: &[u8]) -> (String, Vec<f64>) {
    let mut numbers = Numbers::default();
    let view = Question::read(question).and_then(|question| View::new(&question, &mut numbers));
    (json(&view), numbers.0)
}

/// How good the scene in the question is: 2 with a plan, 1 with a curve alone, 0 without. Only what is `deep` is planned.
pub fn allowed(question: &[u8], deep: bool) -> u32 {
    let scene = Question::read(question)
        .map(|question| Scene::from(question.values()))
        .ok()
        .filter(|scene| scene.shape().is_ok_and(|shape| shape.curve().is_ok()));
    scene.map_or(0, |scene| 1 + u32::from(deep && Plan::new(&scene).is_ok()))
}

impl View {
    /// Of a scene.
    ///
    /// # Errors
    /// A scene without a curve. What is only wrong with its triggers is told where the plan would be.
    fn new(question: &Question, numbers: &mut Numbers) -> Result<Self, Wrong> {
        let scene = Scene::from(question.values());
        let planned = Plan::new(&scene);
        let shape = scene.shape()?;
        let curve = match shape.curve() {
            Ok(curve) => curve,
            Err(error) => {
                let fault = planned.err().ok_or_else(|| error.to_string())?;
                return Err(Wrong { ramp: ramp(error), ..fault.into() });
            }
        };
        let n = scene.triggers().min(MOST_TRIGGERS);
        let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
        let times = (0..=POINTS).map(|i| start + length * (f32::from(i) / f32::from(POINTS)));
        let u = |i: f32| i / n as f32;
        let marks = (0..n).zip(curve.trigger_times(n));
        let points = ramps(&shape).map(|ramp| ramp.points());
        Ok(Self {
            times: numbers.put(shape.times),
            ramps: numbers.put(points.into_iter().flatten().flat_map(|(t, y)| [t, y])),
            cdf: numbers.put(times.flat_map(|t| [t, curve.cdf(t)])),
            edges: numbers.put((0..=n).map(|i| curve.inverse_cdf(u(i as f32)))),
            marks: numbers.put(marks.flat_map(|(i, t)| [t, curve.openness(t), u(i as f32 + 0.5)])),
            plan: planned
                .map(|plan| Planned::new(&plan, question.bar(), numbers))
                .map_err(Wrong::from),
        })
    }
}

impl Planned {
    fn new(plan: &Plan, bar: f32, numbers: &mut Numbers) -> Self {
        let pulses: Vec<_> = plan.triggers.iter().filter_map(|trigger| trigger.pulse).collect();
        let dark = pulses.windows(2).map(|pair| pair[1].0 - pair[0].1).min();
        let closest = if pulses.is_empty() { plan.gaps().min() } else { dark };
        let closest = closest.map_or(f64::NAN, |ticks| plan.seconds(ticks));
        let bar = Bar::new(plan, bar.clamp(0.005, 1.0));
        let SetUps { length, rows } = SetUps::new(plan);
        let rows = if plan.triggers.len() > MOST_DOSES { Vec::new() } else { Vec::from(rows) };
        let mut doses = |row: &Row| {
            let dose = |&(on, off): &(f32, f32)| [on, off, row.dose(plan, length, (on, off))];
            let pulses = numbers.put(row.pulses.iter().flat_map(dose));
            Doses { title: row.title, is_shuttered: row.is_shuttered, pulses }
        };
        let set_ups = rows.iter().map(&mut doses).collect();
        // The name is the page's.
        let facts = facts::lines("", plan).into_iter().filter(|(what, _)| *what != "scene");
        Self {
            facts: facts.collect(),
            ticks: plan.triggers.iter().map(|trigger| trigger.ticks).collect(),
            pulses,
            seconds: numbers.put([closest, plan.min_gap, plan.curve.exposure().into()]),
            direct: facts::Facts::new(plan).direct_triggers,
            ideal: numbers.put(bar.ideal),
            triggered: numbers.put(bar.triggered),
            set_ups,
            bytes: BYTES,
            costs: COSTS,
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
            CurvePart::Opening => "opening",
            CurvePart::Closing => "closing",
        }),
        _ => None,
    }
}
