//! The edges of a camera's sync, recorded beside the light: its two levels, which of them is at rest, and which edge
//! starts which shot.

use super::pulse::Frame;
use super::samples::{CONTRAST, Trace, noise, sampling_interval};

/// Between these shares of the way from the low level to the high one the state stays what it was.
const SWITCH: (f64, f64) = (0.3, 0.7);
/// The most samples between the levels, as a share: with more there are no two levels.
const BETWEEN: f64 = 0.15;
/// Levels are looked for so often, each time by those found before.
const SPLITS: usize = 20;
/// A contact that closes again within so many seconds bounces.
const BOUNCE: f64 = 0.01;

/// What a sync does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// The level at rest, and the one of a shot, in the trace's unit.
    pub levels: [f64; 2],
    /// Halfway, where an edge counts.
    pub threshold: f64,
}

/// An edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// In seconds.
    pub time: f64,
    /// Its standard deviation: a sample's width, or that of a slow edge, by the root of 12.
    pub error: f64,
}

/// The edges before some shots.
#[derive(Clone, Debug)]
pub struct Edges {
    /// What the sync does, where it was recorded; and of that record from sample to sample.
    pub switch: Option<Switch>,
    pub step: f64,
    /// Which edge starts what.
    pub starts: Starts,
}

/// Which edges start which frames.
#[derive(Clone, Debug, Default)]
pub struct Starts {
    /// Of each frame the one that starts it, if there is one.
    pub of: Vec<Option<Edge>>,
    /// So many frames have more than one: the first counts.
    pub bounced: usize,
    /// From a frame's first edge to its last, in seconds, at most.
    pub bounces: f64,
    /// The one frame's edges do not come in pairs: the record begins or ends while the sync is active.
    pub is_cut: bool,
    /// So many start no frame.
    pub others: usize,
    /// So many start a frame that is half open before.
    late: usize,
    /// What seems to bounce goes on through two shots.
    is_clock: bool,
}

/// The edges of a sync that start some frames.
///
/// # Errors
/// A column without two levels, one that does not switch before a frame, and one that switches all the time.
pub fn edges(sync: &Trace, frames: &[Frame]) -> Result<Edges, String> {
    let [low, high] = levels(&sync.values)?;
    let share: Vec<f64> = sync.values.iter().map(|v| (v - low) / (high - low)).collect();
    let between = share.iter().filter(|s| **s > SWITCH.0 && **s < SWITCH.1).count();
    if between as f64 > BETWEEN * share.len() as f64 {
        return Err("its column has no two levels, as a switch has; is it the right one?".into());
    }
    // Edges take turns, and the first one leaves the level of the beginning. That is the level at rest, unless the
    // record begins in the middle of a shot: then the other level gives each shot an edge in time, and leaves none
    // over.
    let begins_high = share[0] > 0.5;
    let all = crossings(&sync.times, &share, begins_high);
    let [as_begun, other] = [0, 1].map(|first| Starts::new(&all[first.min(all.len())..], frames));
    let is_other = other.faults() + other.late < as_begun.faults();
    let (rests_high, starts) = if is_other { (!begins_high, other) } else { (begins_high, as_begun) };

    let started = starts.of.iter().flatten().count();
    if started == 0 {
        return Err("no edge in its column comes before a shot".into());
    }
    if starts.others > started || starts.is_clock {
        let (edges, shots) = (all.len(), frames.len());
        return Err(format!("its column switches {edges} times, and there are {shots} shots; is it the right one?"));
    }
    let levels = if rests_high { [high, low] } else { [low, high] };
    let switch = Switch { levels, threshold: 0.5 * (low + high) };
    Ok(Edges { switch: Some(switch), step: sampling_interval(&sync.times), starts })
}

impl Starts {
    /// Of edges that go to a shot's level and back in turn.
    fn new(all: &[Edge], frames: &[Frame]) -> Self {
        let apart = |pair: &[Frame]| pair[1].crossings[1] - pair[0].crossings[1];
        let bounce = frames.windows(2).map(|pair| 0.1 * apart(pair)).fold(BOUNCE, f64::min);
        // Each with the last one that follows it as a bounce does.
        let mut bursts: Vec<(Edge, Edge)> = Vec::new();
        let mut over = f64::NEG_INFINITY;
        for pair in all.chunks(2) {
            match bursts.last_mut() {
                Some(burst) if pair[0].time - over < bounce => burst.1 = pair[0],
                _ => bursts.push((pair[0], pair[0])),
            }
            over = pair.get(1).map_or(f64::INFINITY, |edge| edge.time);
        }
        let opens = |(first, last): &(Edge, Edge)| {
            frames.iter().filter(|it| (first.time..last.time).contains(&it.crossings[1])).count()
        };
        let is_clock = bursts.iter().any(|burst| opens(burst) > 1);
        let (mut of, mut bounced, mut bounces, mut late) = (Vec::new(), 0, 0.0, 0);
        let mut before = f64::NEG_INFINITY;
        for Frame { crossings, .. } in frames {
            let is_here = |edge: &Edge| edge.time > before && edge.time < crossings[5];
            let mut here = bursts.iter().filter(|(edge, _)| is_here(edge));
            let last = here.clone().rfind(|(edge, _)| edge.time < crossings[1]);
            let start = last.or(here.next());
            late += usize::from(last.is_none() && start.is_some());
            bounced += usize::from(start.is_some_and(|(first, last)| first != last));
            bounces = start.map_or(0.0, |(first, last)| last.time - first.time).max(bounces);
            of.push(start.map(|(edge, _)| *edge));
            before = crossings[5];
        }
        let others = bursts.len() - of.iter().flatten().count();
        let is_cut = frames.len() == 1 && all.len() % 2 == 1;
        Self { of, bounced, bounces, is_cut, others, late, is_clock }
    }

    fn faults(&self) -> usize {
        self.others + self.of.iter().filter(|edge| edge.is_none()).count()
    }
}

/// The medians of the low and of the high samples, which halfway between them parts: by the middle of the range at
/// first, so that few samples are enough, and spikes count for nothing in the end.
fn levels(values: &[f64]) -> Result<[f64; 2], String> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (Some(mut low), Some(mut high)) = (sorted.first().copied(), sorted.last().copied()) else {
        return Err("its column is empty".into());
    };
    for _ in 0..SPLITS {
        let (below, above) = sorted.split_at(sorted.partition_point(|v| *v <= 0.5 * (low + high)));
        if above.is_empty() {
            return Err("its column never switches".into());
        }
        [low, high] = [below, above].map(|part| part[part.len() / 2]);
    }
    let contrast = (high - low) / noise(values).max(f64::MIN_POSITIVE);
    if contrast < CONTRAST {
        return Err(format!(
            "its column never switches: its levels are {contrast:.1} times the noise apart, and {CONTRAST} are required"
        ));
    }
    Ok([low, high])
}

/// When the state changes, by two thresholds: each time halfway.
fn crossings(times: &[f64], share: &[f64], begins_high: bool) -> Vec<Edge> {
    let (mut edges, mut is_high) = (Vec::new(), begins_high);
    // The last sample before a threshold is left, and the last one on this side of the middle.
    let (mut left, mut here) = (0, 0);
    for (i, share_i) in share.iter().enumerate() {
        // Counted from the level that is left.
        let gone = if is_high { 1.0 - share_i } else { *share_i };
        if gone < SWITCH.0 {
            left = i;
        }
        if gone > SWITCH.1 {
            let part = (0.5 - share[here]) / (share[here + 1] - share[here]);
            let step = times[here + 1] - times[here];
            let error = (times[i] - times[left]) / 12f64.sqrt();
            edges.push(Edge { time: times[here] + part.clamp(0.0, 1.0) * step, error });
            (is_high, left, here) = (!is_high, i, i);
        } else if gone <= 0.5 {
            here = i;
        }
    }
    edges
}
