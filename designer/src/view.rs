//! All that the page shows of a scene.

use serde::Serialize;
use shutter::facts::{Facts, drift};
use shutter::plan::{MOST_TRIGGERS, Plan};
use shutter::scene::Scene;
use shutter::shape::Shape;
use shutter::times::Times;
use shutter_curve::CubicBezier;
use shutter_fit::unit::Unit;

use crate::answer::{Wrong, json};

/// The points along the cdf.
const POINTS: u16 = 200;

/// A scene's curve, and its plan where it has one. Times are in seconds.
#[derive(Serialize)]
struct View {
    times: Part,
    /// Both ramps' control points, time and openness of each.
    ramps: Part,
    /// Times, each with its share of the exposure.
    cdf: Part,
    /// Where the equal shares of the exposure begin and end; none where a trace tells the triggers.
    edges: Part,
    /// Of each trigger the time, the openness and the share of the exposure.
    marks: Part,
    /// The curve's exposure, and the share of the interval that it is.
    exposure: Part,
    plan: Result<Planned, Wrong>,
}

#[derive(Serialize)]
struct Planned {
    ticks: Vec<u32>,
    pulses: Vec<(u32, u32)>,
    /// In ticks, from the sync's edge to the start of opening.
    delay: Option<u32>,
    /// So many triggers keep what is asked for; unknown of times that were measured.
    most: Option<u32>,
    /// The least gap between two, or the least darkness, where there are two; what is asked for; how long it is half open.
    seconds: Part,
    /// When a delay that moves matters, as the program says it.
    drift: Option<String>,
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

/// A scene, and the times of its triggers in its unit where a trace tells them.
struct Question {
    scene: Scene,
    measured: Vec<f64>,
}

impl Question {
    /// Of the bytes of `f64`: the unit's place among all, the scene's numbers, the measured times.
    fn read(bytes: &[u8]) -> Result<Self, Wrong> {
        let numbers: Vec<_> =
            bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
        let short = || Wrong::from("the question is too short".to_string());
        let (unit, numbers) = numbers.split_first().ok_or_else(short)?;
        let (numbers, measured) = numbers.split_first_chunk().ok_or_else(short)?;
        let unit = Unit::ALL.get(*unit as usize).copied().unwrap_or(Unit::Second);
        Ok(Self { scene: Scene::of_numbers(unit, numbers), measured: measured.to_vec() })
    }
}

/// All that is shown of the scene in the question: JSON, and the numbers that it speaks of.
pub fn view(question: &[u8]) -> (String, Vec<f64>) {
    let mut numbers = Numbers::default();
    let view = Question::read(question).and_then(|question| View::new(question, &mut numbers));
    (json(&view), numbers.0)
}

/// How good the scene in the question is: 2 with a plan, 1 with a curve alone, 0 without. Only what is `deep` is planned.
pub fn allowed(question: &[u8], deep: bool) -> u32 {
    let scene = Question::read(question)
        .map(|question| question.scene)
        .ok()
        .filter(|scene| scene.curve().is_ok());
    scene.map_or(0, |scene| 1 + u32::from(deep && Plan::new(&scene).is_ok()))
}

impl View {
    /// Of a scene.
    ///
    /// # Errors
    /// A scene without a curve. What is only wrong with its triggers is told where the plan would be.
    fn new(question: Question, numbers: &mut Numbers) -> Result<Self, Wrong> {
        let Question { scene, measured } = question;
        let (shape, curve) = scene.curve()?;
        let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
        let times = (0..=POINTS).map(|i| start + length * (f32::from(i) / f32::from(POINTS)));
        let points = ramps(&shape).map(|ramp| ramp.points());
        let common = Self {
            times: numbers.put(shape.times),
            ramps: numbers.put(points.into_iter().flatten().flat_map(|(t, y)| [t, y])),
            cdf: numbers.put(times.flat_map(|t| [t, curve.cdf(t)])),
            exposure: numbers.put([curve.exposure(), curve.efficiency()]),
            edges: Part(0, 0),
            marks: Part(0, 0),
            plan: Err(String::new().into()),
        };
        if !measured.is_empty() {
            let n = measured.len() as f64;
            let mark =
                |(i, t): (usize, f64)| [t, curve.openness(t as f32).into(), (i as f64 + 0.5) / n];
            let times = measured.iter().map(|time| scene.unit().seconds(*time));
            return Ok(Self {
                marks: numbers.put(times.enumerate().flat_map(mark)),
                plan: Times::of_numbers(scene, &measured)
                    .map(|times| Planned::of_times(times, numbers))
                    .map_err(Wrong::from),
                ..common
            });
        }
        let n = scene.triggers().min(MOST_TRIGGERS);
        let u = |i: f32| i / n as f32;
        Ok(Self {
            edges: numbers.put((0..=n).map(|i| curve.inverse_cdf(u(i as f32)))),
            marks: numbers.put((0..n).flat_map(|i| {
                let u = u(i as f32 + 0.5);
                let t = curve.inverse_cdf(u);
                [t, curve.openness(t), u]
            })),
            plan: Plan::new(&scene).map(|plan| Planned::new(plan, numbers)).map_err(Wrong::from),
            ..common
        })
    }
}

impl Planned {
    fn new(plan: Plan, numbers: &mut Numbers) -> Self {
        let pulses: Vec<_> = plan.triggers.iter().filter_map(|trigger| trigger.pulse).collect();
        let dark = pulses.windows(2).map(|pair| pair[1].0 - pair[0].1).min();
        let closest = if pulses.is_empty() { plan.gaps().min() } else { dark };
        let closest = closest.map_or(f64::NAN, |ticks| plan.seconds(ticks));
        Self {
            ticks: plan.triggers.iter().map(|trigger| trigger.ticks).collect(),
            pulses,
            delay: plan.delay.map(|delay| delay.ticks),
            most: Some(plan.most),
            seconds: numbers.put([closest, plan.min_gap, Facts::new(&plan).half_open]),
            drift: drift(&plan.into()),
        }
    }

    fn of_times(times: Times, numbers: &mut Numbers) -> Self {
        let ticks: Vec<_> = times.triggers.iter().map(|given| given.ticks).collect();
        let closest = ticks.windows(2).map(|pair| pair[1] - pair[0]).min();
        let closest = closest.map_or(f64::NAN, |gap| f64::from(gap) / f64::from(times.timer.hz));
        Self {
            ticks,
            pulses: Vec::new(),
            delay: times.delay.map(|delay| delay.ticks),
            most: None,
            seconds: numbers.put([closest, times.min_gap, f64::NAN]),
            drift: drift(&times.into()),
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
