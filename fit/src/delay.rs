//! From the edge of the camera's sync to the start of opening: of each shot, and how far it differs from shot to shot.

use crate::bins;
use crate::curve::Exposure;
use crate::errors::Measured;
use crate::shots::ALIKE;
use crate::signal::Signal;
use crate::solve::{Cholesky, normal_equations};
use crate::trace::{Edge, Edges, Frame, Refusal, Starts, Switch, Trace, Warning, edges, sampling_interval};
use crate::unit::{Unit, decimals, short, trimmed};
use crate::{Record, Shot};

/// From where the edge is known.
#[derive(Clone, Debug)]
pub enum Sync {
    /// It comes at this time, in seconds of the trace.
    Edge(f64),
    /// It was recorded beside the light.
    Channel(Trace),
}

impl Switch {
    /// Does it fall in a shot?
    pub fn falls(&self) -> bool {
        self.levels[1] < self.levels[0]
    }
}

/// The delays of the shots of one speed.
#[derive(Clone, Debug)]
pub struct Delay {
    /// From the edge to the start of opening, in seconds, of each shot.
    pub shots: Vec<f64>,
    /// What the sync does, where it was recorded.
    pub switch: Option<Switch>,
    /// The standard deviation that the samples of edge and opening alone give a shot.
    pub measuring: f64,
    /// How well one fit knows the start of opening, and the trigger that it knows least.
    start: f64,
    trigger: f64,
    /// From the start of opening to the half-open shutter, which differs less between fits.
    half: f64,
    /// To when a 32nd of the exposure is collected, which no misfit moves.
    early: f64,
}

impl Delay {
    /// The mean.
    pub fn mean(&self) -> f64 {
        self.shots.iter().sum::<f64>() / self.shots.len() as f64
    }

    /// From the edge to the half-open shutter, which is known as well as any trigger.
    pub fn to_half(&self) -> f64 {
        self.mean() + self.half
    }

    /// The standard deviation between shots, where there are several.
    pub fn spread(&self) -> Option<f64> {
        let n = self.shots.len() as f64;
        let squares: f64 = self.shots.iter().map(|shot| (shot - self.mean()).powi(2)).sum();
        (n > 1.0).then(|| (squares / (n - 1.0)).sqrt())
    }

    /// By how much a shot is off the mean at most, where there are several.
    pub fn worst(&self) -> Option<f64> {
        let off = |shot: &f64| (shot - self.mean()).abs();
        (self.shots.len() > 1).then(|| self.shots.iter().map(off).fold(0.0, f64::max))
    }

    /// The standard error of a shot's delay: what shots differ by, the samples, and what one fit leaves open.
    pub fn error(&self) -> f64 {
        self.shot().hypot(self.start)
    }

    /// The standard error of the time from the edge to any trigger, which a ramp's hidden start does not touch.
    pub fn trigger_error(&self) -> f64 {
        self.shot().hypot(self.trigger)
    }

    fn shot(&self) -> f64 {
        self.spread().unwrap_or(0.0).hypot(self.measuring)
    }
}

/// Takes the shots of traces of one speed and of one edge together, each counted to the opening of the trace's own fit.
/// Each delay comes with its trace's exposure.
pub fn pool<'a>(delays: impl Iterator<Item = (f64, &'a mut Delay)>) {
    let mut delays: Vec<_> = delays.collect();
    let all: Vec<_> = delays.iter().map(|(exposure, delay)| (*exposure, (*delay).clone())).collect();
    for (exposure, own) in &mut delays {
        let falls = own.switch.map(|it| it.falls());
        let is_same = |(other, it): &&(f64, Delay)| {
            (other / *exposure - 1.0).abs() <= ALIKE && it.switch.map(|it| it.falls()) == falls
        };
        let same = || all.iter().filter(is_same);
        let shifted = |it: &Delay, shot: f64| shot + (it.early - own.early);
        let shots = same().flat_map(|(_, it)| it.shots.iter().map(move |shot| shifted(it, *shot)));
        own.shots = shots.collect();
        own.measuring = same().map(|(_, it)| it.measuring).fold(0.0, f64::max);
    }
}

/// What a record's sync tells.
fn synced(sync: &Sync, frames: &[Frame]) -> Result<Edges, String> {
    let time = match sync {
        Sync::Channel(channel) => return edges(channel, frames),
        Sync::Edge(time) => *time,
    };
    let mut starts = Starts::default();
    starts.of.resize(frames.len(), None);
    // It may come while the shutter is open, as that of an X contact does.
    let own = frames.iter().position(|frame| frame.crossings[5] > time);
    starts.of[own.ok_or("the given edge comes after all pulses")?] = Some(Edge { time, error: 0.0 });
    Ok(Edges { switch: None, step: 0.0, starts })
}

/// The delay where the shot `asked` has this signal, starts to open and has collected a 32nd at these times, and has
/// these triggers, and what is doubtful about it; none without a sync.
///
/// # Errors
/// An edge of a given time before another frame; a channel that does not tell the edges.
pub(crate) fn measure(
    records: &[Record],
    shots: &[Shot],
    asked: usize,
    signal: &Signal,
    [start, early]: [Measured; 2],
    triggers: &[Measured],
) -> Result<Option<(Delay, Vec<Warning>)>, Refusal> {
    let refused = |reason: &str| Err(Refusal::NoDelay { reason: reason.into() });
    let syncs = records.iter().filter_map(|record| Some((record.sync.as_ref()?, &record.pulses.frames)));
    let synced: Result<Vec<_>, _> = syncs.map(|(sync, frames)| synced(sync, frames)).collect();
    let synced = synced.map_err(|reason| Refusal::NoDelay { reason })?;
    if synced.is_empty() {
        return Ok(None);
    }
    let fitted = &shots[asked];
    let falls = |it: &Edges| it.switch.map(|switch| switch.falls());
    if synced.len() < records.len() || synced.iter().any(|it| falls(it) != falls(&synced[0])) {
        return refused("the sync is not the same in all traces: it falls, rises or is missing");
    }
    let Edges { switch, step, .. } = synced[fitted.record];
    let is_given = switch.is_none();
    let edges: Vec<Option<Edge>> = synced.iter().flat_map(|it| it.starts.of.clone()).collect();
    if is_given && edges[asked].is_none() {
        let is_own = |k: &usize| shots[*k].record == fitted.record && edges[*k].is_some();
        let first = (0..shots.len()).find(is_own).map_or(0, |k| k + 1);
        return Err(Refusal::OtherPulse { first });
    }

    let curve = signal.curve;
    let is_alike = |shot: &Shot| (shot.frame.exposure / fitted.frame.exposure - 1.0).abs() <= ALIKE;
    let all: Vec<_> = shots.iter().zip(edges).filter(|(shot, _)| is_alike(shot)).collect();
    // A model that does not explain the trace is off its own shot, and off all others alike.
    let own = later(signal, fitted, fitted.frame).value;
    let (mut delays, mut variance, mut edges_variance) = (Vec::new(), 0.0, 0.0);
    for (shot, edge) in &all {
        let Some(Edge { time, error }) = edge else { continue };
        // The one shot of a given edge is the fitted one.
        let later = match is_given && records.len() == 1 {
            true => Measured { value: own, error: 0.0 },
            false => later(signal, shot, fitted.frame),
        };
        delays.push(start.value + (later.value - own) - time);
        edges_variance += error.powi(2);
        variance += error.powi(2) + later.error.powi(2);
    }
    if delays.is_empty() {
        return refused("no shot of the fitted speed has an edge before it");
    }
    let is_late = delays.iter().filter(|delay| **delay < 0.0);
    let by = is_late.clone().fold(0.0, |most, delay| f64::max(most, -delay));
    let (late, n, all) = (is_late.count(), delays.len(), all.len());
    let width = 12f64.sqrt() * (edges_variance / n as f64).sqrt();
    if late == n && width > f64::max(0.2 * curve.opening, 2.5 * step) {
        return refused("its column changes after the opening, and as slowly as light does; is it the light's?");
    }
    let starts = synced.iter().map(|it| &it.starts);
    let bounced = starts.clone().map(|it| it.bounced).sum();
    let is_cut = starts.clone().any(|it| it.is_cut);
    let edges = starts.clone().map(|it| it.others).sum();
    let bounces = starts.map(|it| it.bounces).fold(0.0, f64::max);
    let missing = if is_given { 0 } else { all - n };
    let doubts = [
        (bounced, Warning::SyncBounced { few: bounced, all: shots.len(), by: bounces, is_cut }),
        (missing, Warning::SyncMissing { few: missing, all }),
        (edges, Warning::SyncOthers { edges }),
        (late, Warning::SyncLate { few: late, all: n, by }),
    ];
    let doubts = doubts.into_iter().filter(|(count, _)| *count > 0).map(|(_, doubt)| doubt);
    let delay = Delay {
        shots: delays,
        switch,
        measuring: (variance / n as f64).sqrt(),
        start: start.error,
        trigger: triggers.iter().map(|trigger| trigger.error).fold(0.0, f64::max),
        half: curve.start + Exposure::new(&curve).feet(0.5)[0] - start.value,
        early: early.value - start.value,
    };
    Ok(Some((delay, doubts.collect())))
}

/// By how much a frame opens later than the fitted one: by least squares, the fitted curve is shifted along the frame's
/// opening ramp, with levels of its own. Where that leads away, the crossings tell, to half of the ramp.
fn later(fitted: &Signal, &Shot { pulses, frame, .. }: &Shot, like: &Frame) -> Measured {
    let rise = |frame: &Frame| frame.crossings[..3].iter().sum::<f64>() / 3.0;
    let first = rise(frame) - rise(like);
    let exposure = Exposure::new(&fitted.curve);
    let part = pulses.trace.part(&frame.samples);
    let step = sampling_interval(&part.times);
    let middle = 0.5 * (frame.crossings[2] + frame.crossings[3]);
    let mut samples = bins::each(&part);
    samples.retain(|bin| bin.to < middle);
    let (mut shift, mut error) = (first, step);
    for _ in 0..10 {
        let rows = samples.iter().map(|bin| {
            let (from, to) = (bin.from - shift, bin.to - shift);
            let slope = (exposure.openness(to) - exposure.openness(from)) / (to - from);
            let openness = exposure.mean(from, to);
            (1.0, [-fitted.gain * slope, 1.0, openness], bin.mean - fitted.dark - fitted.gain * openness)
        });
        let (normal, right) = normal_equations(rows);
        let Some(factor) = Cholesky::new(normal) else { break };
        let by = factor.solve(&right)[0];
        shift += by;
        error = pulses.noise * factor.solve(&[1.0, 0.0, 0.0])[0].max(0.0).sqrt();
        if by.abs() < 1e-4 * step {
            break;
        }
    }
    let near = step.max(0.5 * fitted.curve.opening);
    // A NaN is not near.
    if (shift - first).abs() <= near {
        let sharp = if fitted.curve.opening < 2.0 * step { step / 12f64.sqrt() } else { 0.0 };
        return Measured { value: shift, error: error.hypot(sharp) };
    }
    Measured { value: first, error: near }
}

/// The delay with its standard errors, and how shots differ, for a report.
pub fn told(delay: Option<&Delay>, unit: Unit) -> [String; 2] {
    let Some(delay) = delay else {
        return ["unknown: the column of the sync tells it, or the time of its edge".into(), String::new()];
    };
    let digits = |error: f64| short(unit.of(error), 2);
    let value = unit.plus_minus(delay.mean(), delay.error());
    let told = format!("{value} to the opening, ± {} to any trigger", digits(delay.trigger_error()));
    let (Some(spread), Some(worst)) = (delay.spread(), delay.worst()) else {
        return [told, "unknown: one shot does not tell how shots differ".into()];
    };
    let n = delay.shots.len();
    // The standard error of a standard deviation.
    let error = spread / (2.0 * (n - 1) as f64).sqrt();
    let mut between = format!("{} between {n} shots, the worst {} off", unit.plus_minus(spread, error), digits(worst));
    if 2.0 * delay.measuring > spread {
        let measured = digits(delay.measuring);
        between += &format!("\n             each is measured to ± {measured} only: coarse samples or a slow edge");
    }
    [told, between]
}

/// What a sync does, for a report.
pub fn switch(switch: &Switch) -> String {
    let Switch { levels: [rest, on], threshold } = switch;
    let way = if switch.falls() { "falls" } else { "rises" };
    let places = decimals(on - rest, 3);
    let [rest, on, threshold] = [rest, on, threshold].map(|level| trimmed(*level, places));
    format!("{way} from {rest} to {on}; an edge counts at {threshold}")
}
