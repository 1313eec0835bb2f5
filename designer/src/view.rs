//! All that the page shows of a scene.
//!
//! The answer is numbers, in parts that each begin with their length: the page reads them as they are in memory, which
//! is faster than any text, and its first load has nothing that writes one. Times are in seconds; NaN is none.

use shutter_curve::{CubicBezier, CurveError};
use shutter_fit::unit::Unit;
use shutter_plan::facts::{Facts, closest, coarse, drift, ends};
use shutter_plan::fault::{Code, Fault, Pair, What};
use shutter_plan::lamp::Lamp;
use shutter_plan::plan::{Curve, MOST_TRIGGERS, Plan};
use shutter_plan::scene::Scene;
use shutter_plan::set_up::doses;
use shutter_plan::shape::{self, Shape};

use crate::flat::{KEYS, NUMBERS, of_numbers, place};

/// The points along the cdf.
const POINTS: u16 = 200;
/// What would help, each tried: fewer triggers, no gap, a timer of 32 bits, a lamp without pulses.
const REMEDIES: [&[&str]; 4] =
    [&["triggers"], &["min_gap"], &["timer_bits"], &["pulse", "duty", "min_pulse", "fully_open"]];

/// Numbers in parts.
#[derive(Default)]
struct Parts(Vec<f64>);

impl Parts {
    fn put<T: Into<f64>>(&mut self, numbers: impl IntoIterator<Item = T>) {
        let length = self.0.len();
        self.0.push(0.0);
        self.0.extend(numbers.into_iter().map(Into::into));
        self.0[length] = (self.0.len() - length - 1) as f64;
    }

    /// What is wrong, as code, key, place among the inner control points and the values; and what would help: each
    /// remedy with a number.
    fn put_wrong(&mut self, fault: &Fault, question: &Question) {
        let place = |i: Option<usize>| i.map_or(f64::NAN, |i| i as f64);
        let inner = [fault.inner.map(|inner| inner.0), fault.inner.map(|inner| inner.1)].map(place);
        let key = KEYS.iter().position(|key| *key == fault.name());
        let head = [place(Some(Code::from(&*fault.what) as usize)), place(key)];
        self.put(head.into_iter().chain(inner).chain(values(&fault.what)));
        self.put(question.remedies());
    }
}

/// A scene's unit and numbers, and the times of its triggers in that unit where a trace tells them.
struct Question {
    unit: Unit,
    numbers: [f64; NUMBERS],
    measured: Vec<f64>,
}

impl Question {
    /// Of the bytes of `f64`: the unit's place among all, the scene's numbers, the measured times.
    fn read(bytes: &[u8]) -> Option<Self> {
        let numbers: Vec<_> = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
        let (unit, numbers) = numbers.split_first()?;
        let (numbers, measured) = numbers.split_first_chunk()?;
        let unit = Unit::ALL.get(*unit as usize).copied()?;
        Some(Self { unit, numbers: *numbers, measured: measured.to_vec() })
    }

    fn scene(&self) -> Scene {
        of_numbers(self.unit, &self.numbers)
    }

    /// Its plan, of the trace's own times, counted from the start of opening, where it has them.
    fn plan(&self) -> Result<Plan, Fault> {
        let mut scene = self.scene();
        if !self.measured.is_empty() {
            let Scene { shutter, flashes, .. } = &mut scene;
            (shutter.open_start, shutter.trigger_times) = (Some(0.0), Some(self.measured.clone()));
            [shutter.open_end, shutter.close_start, shutter.close_end] = [None; 3];
            (shutter.shutteropening, flashes.triggers, flashes.fully_open) = (None, None, None);
            [flashes.pulse, flashes.duty, flashes.min_pulse] = [None; 3];
        }
        Plan::new(&scene)
    }

    /// Can it be planned with other numbers of these keys?
    fn is_planned(&self, keys: &[&str], number: f64) -> bool {
        let mut numbers = self.numbers;
        for key in keys {
            numbers[place(key)] = number;
        }
        Self { unit: self.unit, numbers, measured: self.measured.clone() }.plan().is_ok()
    }

    /// What would help a scene that cannot be planned: each place among the remedies, and its number.
    fn remedies(&self) -> Vec<f64> {
        let asked = triggers(&self.scene()).min(MOST_TRIGGERS + 1);
        let (mut low, mut high) = (0, if self.measured.is_empty() { asked } else { 0 });
        while high > low + 1 {
            let middle = low.midpoint(high);
            let is_planned = self.is_planned(REMEDIES[0], middle.into());
            *(if is_planned { &mut low } else { &mut high }) = middle;
        }
        let numbers = [low.into(), 0.0, f64::NAN, f64::NAN];
        let helps = |i: &usize| match i {
            0 => low > 0,
            i => self.is_planned(REMEDIES[*i], numbers[*i]),
        };
        (0..REMEDIES.len()).filter(helps).flat_map(|i| [i as f64, numbers[i]]).collect()
    }
}

/// All that is shown of the scene in the question. Two parts are what is wrong and what would help; a scene with a
/// curve has six before them, and in their place four where it can be planned.
pub fn view(question: &[u8]) -> Vec<f64> {
    let mut parts = Parts::default();
    if let Some(question) = Question::read(question)
        && let Err(fault) = show(&question, &mut parts)
    {
        parts.put_wrong(&fault, &question);
    }
    parts.0
}

/// Has the scene in the question a curve?
pub fn allowed(question: &[u8]) -> bool {
    Question::read(question).is_some_and(|question| shape::curve(&question.scene().shutter).is_ok())
}

/// How many flashes a scene asks for, as near as a count can be; not all can be planned.
fn triggers(scene: &Scene) -> u32 {
    scene.flashes.triggers.unwrap_or_default() as u32
}

fn show(question: &Question, parts: &mut Parts) -> Result<(), Fault> {
    let (scene, measured) = (question.scene(), &question.measured);
    let (shape, curve) = shape::curve(&scene.shutter)?;
    let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
    let times = (0..=POINTS).map(|i| start + length * (f32::from(i) / f32::from(POINTS)));
    let points = ramps(&shape).map(|ramp| ramp.points());
    parts.put(shape.times);
    // Both ramps' control points, time and openness of each.
    parts.put(points.into_iter().flatten().flat_map(|(t, y)| [t, y]));
    parts.put(times.flat_map(|t| [t, curve.cdf(t)]));
    parts.put([curve.exposure(), curve.efficiency()]);
    let plan = question.plan();
    let n = triggers(&scene).min(MOST_TRIGGERS);
    let u = |i: f32| i / n as f32;
    // Flashes while the shutter is fully open share out the time, not the exposure; measured ones have no curve that
    // does.
    let is_shared = matches!(&plan, Ok(Plan { curve: Some(_), lamp, .. }) if *lamp != Lamp::FullyOpen);
    // Where the equal shares of the exposure begin and end.
    parts.put((0..=n).filter(|_| is_shared).map(|i| curve.inverse_cdf(u(i as f32))));
    let mark = |t: f32, u: f32| [t, curve.openness(t), u].map(f64::from);
    let given = measured.iter().map(|time| scene.unit().seconds(*time)).zip(0..);
    // Of each trigger the time, the openness and the share of the exposure.
    parts.put(match &plan {
        _ if !measured.is_empty() => given
            .flat_map(|(t, i)| {
                let u = (f64::from(i) + 0.5) / measured.len() as f64;
                [t, curve.openness(t as f32).into(), u]
            })
            .collect(),
        Ok(plan) => {
            plan.triggers.iter().flat_map(|it| mark(it.time as f32, it.u.unwrap_or_default())).collect::<Vec<_>>()
        }
        _ => {
            let middles = (0..n).map(|i| u(i as f32 + 0.5));
            middles.flat_map(|u| mark(curve.inverse_cdf(u), u)).collect()
        }
    });
    put_plan(&plan?, parts);
    Ok(())
}

fn put_plan(plan: &Plan, parts: &mut Parts) {
    let (rows, sync, none) = (plan.rows(), plan.sync, f64::NAN);
    parts.put([
        plan.timer.hz.into(),
        sync.early.into(),
        sync.delay.map_or(none, |_| sync.ticks.into()),
        plan.curve.as_ref().map_or(none, |Curve { most, .. }| f64::from(*most)),
        closest(plan).unwrap_or(none),
        plan.min_gap.unwrap_or_default(),
        Facts::new(plan).number("half_open_s").unwrap_or(none),
        drift(plan).unwrap_or(none),
        coarse(plan).unwrap_or(none),
    ]);
    parts.put(rows.iter().map(|row| row.ticks));
    parts.put(plan.pulses().flat_map(|(on, off)| [on, off]));
    // The light of the first, the middle and the last flash, where the set-up is known and they differ.
    let doses = plan.set_up.filter(|_| plan.curve.is_some()).map(|set_up| doses(set_up, plan)).unwrap_or_default();
    let is_even = doses.iter().all(|dose| *dose > 0.985);
    parts.put(if is_even { Vec::new() } else { ends(&doses) });
}

/// The values of what is wrong: how many flashes would do, before all others.
fn values(what: &What) -> Vec<f64> {
    use What as W;
    let many = |most: &Option<u32>| most.unwrap_or_default().into();
    let of = |Pair { first, gap, least }: &Pair| [*first as f64, gap.seconds(), least.seconds()];
    let with = |most, pair: &Pair| [&[many(most)], &of(pair)[..]].concat();
    match what {
        W::Curve(error) | W::Lasts { error, .. } => vec![kind(error)],
        W::Inner { error, number } => vec![kind(error), *number],
        W::Lost { percent } => vec![*percent],
        W::Whole { most } | W::RateTooHigh { most } => vec![(*most).into()],
        W::Wraps { bits, by, hz, .. } => vec![(*bits).into(), *by, *hz],
        W::PulseOfNoTick { hz } => vec![(*hz).into()],
        W::BeforeEdge { by, most, few, .. } => vec![many(most), *by, *few as f64],
        W::Close { pair, most } | W::DosesClose { pair, most } => with(most, pair),
        W::DoseShort { i, lasts, least, most } => {
            vec![many(most), *i as f64, lasts.seconds(), least.seconds()]
        }
        W::Pulses { length, pair, longest, most } => {
            let own = [many(most), length.seconds(), longest.seconds()];
            own.into_iter().chain(pair.iter().flat_map(of)).collect()
        }
        W::Unfit { most } => vec![many(most)],
        W::TimesEarly { i } | W::TimesLate { i } | W::TimesOutOfOrder { i } => vec![*i as f64],
        W::TimesClose(pair) => of(pair).into(),
        _ => Vec::new(),
    }
}

/// The number of a curve's error, for the page's words.
fn kind(error: &CurveError) -> f64 {
    use CurveError as E;
    match error {
        E::TimesOutOfOrder => 0.0,
        E::FractionOutsideRamp { .. } => 1.0,
        E::OpennessOutOfRange { .. } => 2.0,
        E::TimesCross(_) => 3.0,
        E::TooShort(_) => 4.0,
        E::IntervalUnresolved => 5.0,
        E::IntervalOutOfRange => 6.0,
        _ => 7.0,
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
