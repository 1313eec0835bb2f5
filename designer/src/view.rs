//! All that the page shows of a scene.

use serde::Serialize;
use shutter::facts::{Facts, drift, few};
use shutter::lamp::Lamp;
use shutter::plan::{MOST_TRIGGERS, Plan};
use shutter::scene::{KEYS, Scene};
use shutter::set_up::doses;
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
    /// The rate of all ticks.
    timer_hz: u32,
    /// In ticks, from the sync's edge to the start of opening.
    delay: Option<u32>,
    /// So many triggers keep what is asked for; unknown of times that were measured.
    most: Option<u32>,
    /// The least gap between two, or the least darkness, where there are two; what is asked for; how long it is half open.
    seconds: Part,
    /// The light of the first, the middle and the last flash, where the set-up is known and they differ.
    doses: Option<String>,
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

/// A scene's unit and numbers, and the times of its triggers in that unit where a trace tells them.
struct Question {
    unit: Unit,
    numbers: [f64; Scene::NUMBERS],
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
        Ok(Self { unit, numbers: *numbers, measured: measured.to_vec() })
    }

    fn scene(&self) -> Scene {
        Scene::of_numbers(self.unit, &self.numbers)
    }

    /// Can it be planned with other numbers? NaN is none.
    fn is_planned(&self, changes: &[(&str, f64)]) -> bool {
        let mut numbers = self.numbers;
        for (key, number) in changes {
            let place = KEYS.iter().position(|known| known == key).unwrap_or_default();
            let curve = KEYS.iter().position(|known| *known == "shutteropening");
            // That key has eight numbers.
            numbers[place + if Some(place) > curve { 7 } else { 0 }] = *number;
        }
        let scene = Scene::of_numbers(self.unit, &numbers);
        match &*self.measured {
            [] => Plan::new(&scene).is_ok(),
            times => Times::of_numbers(scene, times).is_ok(),
        }
    }

    /// What would help a scene that cannot be planned.
    fn remedies(&self) -> Vec<(&'static str, u32)> {
        let with = |n: u32| self.is_planned(&[("triggers", n.into())]);
        let asked = self.scene().triggers().min(MOST_TRIGGERS + 1);
        let (mut low, mut high) = (0, if self.measured.is_empty() { asked } else { 0 });
        while high > low + 1 {
            let middle = low.midpoint(high);
            *(if with(middle) { &mut low } else { &mut high }) = middle;
        }
        let none = f64::NAN;
        let lamp = ["pulse", "duty", "min_pulse", "fully_open"].map(|key| (key, none));
        let others: [(_, &[_]); 3] = [
            ("min_gap", &[("min_gap", 0.0)]),
            ("timer_bits", &[("timer_bits", none)]),
            ("lamp", &lamp),
        ];
        let helps = others.into_iter().filter(|(_, changes)| self.is_planned(changes));
        let fewer = (low > 0).then_some(("triggers", low));
        fewer.into_iter().chain(helps.map(|(code, _)| (code, 0))).collect()
    }
}

/// All that is shown of the scene in the question: JSON, and the numbers that it speaks of.
pub fn view(question: &[u8]) -> (String, Vec<f64>) {
    let mut numbers = Numbers::default();
    let view = Question::read(question).and_then(|question| View::new(question, &mut numbers));
    (json(&view), numbers.0)
}

/// Has the scene in the question a curve?
pub fn allowed(question: &[u8]) -> bool {
    Question::read(question).is_ok_and(|question| question.scene().curve().is_ok())
}

impl View {
    /// Of a scene.
    ///
    /// # Errors
    /// A scene without a curve. What is only wrong with its triggers is told where the plan would be.
    fn new(question: Question, numbers: &mut Numbers) -> Result<Self, Wrong> {
        let (scene, measured) = (question.scene(), &question.measured);
        // What would help is tried where something is wrong.
        let wrong = |fault| Wrong { remedies: question.remedies(), ..Wrong::from(fault) };
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
                plan: Times::of_numbers(scene, measured)
                    .map(|times| Planned::of_times(times, numbers))
                    .map_err(wrong),
                ..common
            });
        }
        let n = scene.triggers().min(MOST_TRIGGERS);
        let u = |i: f32| i / n as f32;
        let plan = Plan::new(&scene);
        let mark = |t, u| [t, curve.openness(t), u];
        let marks: Vec<_> = match &plan {
            Ok(plan) => plan.triggers.iter().map(|it| mark(it.time, it.u)).collect(),
            Err(_) => {
                let middles = (0..n).map(|i| u(i as f32 + 0.5));
                middles.map(|u| mark(curve.inverse_cdf(u), u)).collect()
            }
        };
        // Flashes while the shutter is fully open share out the time, not the exposure.
        let is_shared = plan.as_ref().is_ok_and(|plan| plan.lamp != Lamp::FullyOpen);
        let edges = (0..=n).filter(|_| is_shared).map(|i| curve.inverse_cdf(u(i as f32)));
        Ok(Self {
            edges: numbers.put(edges),
            marks: numbers.put(marks.into_iter().flatten()),
            plan: plan.map(|plan| Planned::new(plan, numbers)).map_err(wrong),
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
            timer_hz: plan.timer.hz,
            delay: plan.delay.map(|delay| delay.ticks),
            most: Some(plan.most),
            seconds: numbers.put([closest, plan.min_gap, Facts::new(&plan).half_open]),
            doses: plan.set_up.map(|set_up| doses(set_up, &plan)).and_then(|doses| {
                let is_even = doses.iter().all(|dose| *dose > 0.985);
                (!is_even).then(|| few(&doses))
            }),
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
            timer_hz: times.timer.hz,
            delay: times.delay.map(|delay| delay.ticks),
            most: None,
            seconds: numbers.put([closest, times.min_gap, f64::NAN]),
            doses: None,
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
