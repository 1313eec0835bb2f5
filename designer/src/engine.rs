//! All that the page draws of a scene, fast enough to follow the mouse. Times are in seconds.
//!
//! A scene comes number by number, by its keys: a reader of JSON, or of JavaScript's objects, and what tells in words
//! what is wrong, would each make the page's first load half as large again.

use serde::de::DeserializeOwned;
use serde::de::value::{Error, StrDeserializer};
use shutter_curve::{CubicBezier, ShutterCurve};
use shutter_plan::fault::Fault;
use shutter_plan::lamp::Lamp;
use shutter_plan::plan::{MOST_TRIGGERS, Plan};
use shutter_plan::scene::{Scene, Shutter};
use shutter_plan::shape::Shape;
use wasm_bindgen::prelude::wasm_bindgen;

/// Sets the key that is called so, if it is one of these.
macro_rules! set {
    ($name:ident = $value:expr; $($table:ident.$key:ident)*) => {
        $(if $name == concat!(stringify!($table), ".", stringify!($key)) {
            $table.$key = $value;
        })*
    };
}

/// The points along the cdf.
const POINTS: u16 = 200;

/// A scene; where no curve explains its trace, with the trace's own triggers beside.
#[wasm_bindgen]
#[derive(Default)]
pub struct Question {
    scene: Scene,
    own: Shutter,
}

/// What is drawn.
#[wasm_bindgen(getter_with_clone)]
#[derive(Default)]
pub struct View {
    /// The curve's four times; none where the scene has no curve.
    pub times: Vec<f64>,
    /// Both ramps' control points: time and openness of each.
    pub ramps: Vec<f64>,
    /// Points of the cdf: time and share.
    pub cdf: Vec<f64>,
    /// Where the equal shares of the exposure begin and end.
    pub edges: Vec<f64>,
    /// Of each trigger the time, the openness and the share of the exposure.
    pub marks: Vec<f64>,
    /// The triggers as a firmware counts them; none where the scene cannot be planned.
    pub ticks: Vec<u32>,
    /// When each pulse goes on and off, in the same ticks.
    pub pulses: Vec<u32>,
    /// What is taken off each tick.
    pub early: u32,
    /// From the sync's edge to where they count from.
    pub from_edge: Option<u32>,
    /// The timer's rate.
    pub hz: u32,
    /// The key that is wrong, as `flashes.triggers`; empty where it is none's.
    pub wrong: Option<String>,
    /// From where to where it is wrong among the inner control points.
    pub inner: Vec<u32>,
}

#[wasm_bindgen]
impl Question {
    /// Nothing is told yet.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Tells the numbers of a key; yes is 1.
    pub fn set(&mut self, key: &str, numbers: Vec<f64>) {
        let Self { scene: Scene { shutter, flashes, .. }, own } = self;
        let x = numbers.first().copied();
        set!(key = x; shutter.open_start shutter.open_end shutter.close_start shutter.close_end shutter.delay
            shutter.delay_spread shutter.sync_settles shutter.nominal own.open_start flashes.triggers flashes.min_gap
            flashes.timer_hz flashes.timer_bits flashes.pulse flashes.duty flashes.min_pulse flashes.lamp_lag
            flashes.delay flashes.delay_spread);
        set!(key = x.map(|x| x == 1.0); shutter.sync_falls flashes.sync_falls flashes.fully_open);
        set!(key = Some(numbers.clone()); shutter.shutteropening own.trigger_times);
    }

    /// Tells the word of a key.
    pub fn say(&mut self, key: &str, word: &str) {
        let Scene { shutter, flashes, .. } = &mut self.scene;
        set!(key = is(word); shutter.unit flashes.unit flashes.set_up);
    }

    /// The scene's curve, if it has one.
    pub fn curve(&self) -> Option<Curve> {
        Some(Curve(self.shape()?.1))
    }

    /// All that is drawn of it.
    pub fn view(&self) -> View {
        let mut view = View::default();
        if let Err(fault) = self.show(&mut view) {
            view.wrong = Some(fault.key.into());
            view.inner = fault.inner.map_or(Vec::new(), |(from, to)| vec![from as u32, to as u32]);
        }
        view
    }
}

/// A curve.
#[wasm_bindgen]
pub struct Curve(ShutterCurve);

#[wasm_bindgen]
impl Curve {
    /// The openness at a time.
    pub fn openness(&self, time: f64) -> f64 {
        self.0.openness(time as f32).into()
    }
}

impl Question {
    fn shape(&self) -> Option<(Shape, ShutterCurve)> {
        let shape = Shape::new(&self.scene.shutter).ok()?;
        Some((shape, shape.curve().ok()?))
    }

    /// Its plan, of the trace's own times where it has them.
    fn plan(&self) -> Result<Plan, Fault> {
        let Some(times) = &self.own.trigger_times else { return Plan::new(&self.scene) };
        let (open_start, trigger_times) = (self.own.open_start, Some(times.clone()));
        let (open_end, close_start, close_end, shutteropening) = (None, None, None, None);
        let shutter = self.scene.shutter.clone();
        let shutter =
            Shutter { open_start, trigger_times, open_end, close_start, close_end, shutteropening, ..shutter };
        Plan::new(&Scene { shutter, ..self.scene.clone() })
    }

    fn show(&self, view: &mut View) -> Result<(), Fault> {
        let plan = self.plan();
        let Some((shape, curve)) = self.shape() else { return plan.map(drop) };
        let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
        let times = (0..=POINTS).map(|i| start + length * (f32::from(i) / f32::from(POINTS)));
        let points = ramps(&shape).map(|ramp| ramp.points());
        view.times = shape.times.map(f64::from).to_vec();
        view.ramps = points.into_iter().flatten().flat_map(|(t, y)| [t.into(), y.into()]).collect();
        view.cdf = times.flat_map(|t| [t.into(), curve.cdf(t).into()]).collect();
        let asked = self.scene.flashes.triggers.unwrap_or_default() as u32;
        let n = asked.min(MOST_TRIGGERS);
        let u = |i: f32| i / n as f32;
        // Flashes while the shutter is fully open share out the time, not the exposure; measured ones have no curve
        // that does.
        let is_shared = plan.as_ref().is_ok_and(|plan| plan.curve.is_some() && plan.lamp != Lamp::FullyOpen);
        view.edges = (0..=n).filter(|_| is_shared).map(|i| curve.inverse_cdf(u(i as f32)).into()).collect();
        let mark = |t: f64, u: f64| [t, curve.openness(t as f32).into(), u];
        let unit = self.scene.shutter.unit();
        view.marks = match (&self.own.trigger_times, &plan) {
            (Some(times), _) => {
                let middles = (0..times.len()).map(|i| (i as f64 + 0.5) / times.len() as f64);
                times.iter().zip(middles).flat_map(|(t, u)| mark(unit.seconds(*t), u)).collect()
            }
            (None, Ok(plan)) => {
                plan.triggers.iter().flat_map(|it| mark(it.time, it.u.unwrap_or_default().into())).collect()
            }
            (None, Err(_)) => {
                let middles = (0..n).map(|i| u(i as f32 + 0.5));
                middles.flat_map(|u| mark(curve.inverse_cdf(u).into(), u.into())).collect()
            }
        };
        let plan = plan?;
        let early = plan.sync.early;
        view.ticks = plan.triggers.iter().map(|trigger| trigger.ticks - early).collect();
        view.pulses = plan.pulses().flat_map(|(on, off)| [on.saturating_sub(early), off - early]).collect();
        view.early = early;
        view.from_edge = plan.sync.delay.map(|_| plan.sync.ticks);
        view.hz = plan.timer.hz;
        Ok(())
    }
}

/// What a word is.
fn is<T: DeserializeOwned>(word: &str) -> Option<T> {
    T::deserialize(StrDeserializer::<Error>::new(word)).ok()
}

/// Both ramps, straight ones as well.
fn ramps(shape: &Shape) -> [CubicBezier; 2] {
    let [open_start, open_end, close_start, close_end] = shape.times;
    shape.ramps().unwrap_or([
        CubicBezier::line((open_start, 0.0), (open_end, 1.0)),
        CubicBezier::line((close_start, 1.0), (close_end, 0.0)),
    ])
}
