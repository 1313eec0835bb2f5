//! The edges of a camera's sync, recorded beside the light: its two levels, which of them is at rest, and which edge starts
//! which shot.

use super::pulse::{Frame, noise};
use super::samples::{CONTRAST, Trace, median};

/// Between these shares of the way from the low level to the high one the state stays what it was.
const SWITCH: (f64, f64) = (0.3, 0.7);
/// The most samples between the levels, as a share: with more there are no two levels.
const BETWEEN: f64 = 0.15;
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
    /// Of the column.
    pub switch: Switch,
    /// Of each frame the one that starts it, if there is one.
    pub starts: Vec<Option<Edge>>,
    /// So many frames have more than one: the first counts.
    pub bounced: usize,
    /// So many start no frame.
    pub others: usize,
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
    let begins_high = share[0] > 0.5;
    let rests_high = rests_high(&share, frames.len());
    // In turn: the first one leaves the level at the beginning.
    let all = crossings(&sync.times, &share, begins_high);
    let first = usize::from(rests_high != begins_high);
    let apart = |pair: &[Frame]| pair[1].crossings[1] - pair[0].crossings[1];
    let bounce = frames.windows(2).map(|pair| 0.25 * apart(pair)).fold(BOUNCE, f64::min);

    // Each with the edges that follow it as a bounce does.
    let mut bursts: Vec<(Edge, usize)> = Vec::new();
    let mut over = f64::NEG_INFINITY;
    for (k, edge) in all.iter().enumerate().skip(first).step_by(2) {
        match bursts.last_mut() {
            Some(burst) if edge.time - over < bounce => burst.1 += 1,
            _ => bursts.push((*edge, 1)),
        }
        over = all.get(k + 1).map_or(f64::INFINITY, |edge| edge.time);
    }
    let (mut starts, mut bounced, mut before) = (Vec::new(), 0, f64::NEG_INFINITY);
    for Frame { crossings, .. } in frames {
        let here = bursts.iter().filter(|(edge, _)| edge.time > before && edge.time < crossings[5]);
        let last = here.clone().rfind(|(edge, _)| edge.time < crossings[1]);
        let start = last.or(here.clone().next());
        bounced += usize::from(start.is_some_and(|(_, count)| *count > 1));
        starts.push(start.map(|(edge, _)| *edge));
        before = crossings[5];
    }
    let started = starts.iter().flatten().count();
    let others = bursts.len() - started;
    if started == 0 {
        return Err("no edge in its column comes before a shot".into());
    }
    if others > started {
        return Err(format!(
            "its column switches {} times, and there are {} shots; is it the right one?",
            bursts.len(),
            frames.len()
        ));
    }
    let levels = if rests_high { [high, low] } else { [low, high] };
    let switch = Switch { levels, threshold: 0.5 * (low + high) };
    Ok(Edges { switch, starts, bounced, others })
}

/// The medians of the low and of the high samples. Otsu's split finds them despite spikes; where the high ones are so few that it
/// splits the noise, the middle of the range does.
fn levels(values: &[f64]) -> Result<[f64; 2], String> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (n, all) = (sorted.len(), sorted.iter().sum::<f64>());
    if n == 0 {
        return Err("its column is empty".into());
    }
    let (mut best, mut otsu, mut sum) = (0.0, 0, 0.0);
    for k in 1..n {
        sum += sorted[k - 1];
        let (below, above) = (k as f64, (n - k) as f64);
        let apart = below * above * (sum / below - (all - sum) / above).powi(2);
        if sorted[k] > sorted[k - 1] && apart > best {
            (best, otsu) = (apart, k);
        }
    }
    let middle = sorted.partition_point(|v| *v < 0.5 * (sorted[0] + sorted[n - 1]));
    let noise = noise(values).max(f64::MIN_POSITIVE);
    let mut contrast = 0.0;
    for split in [otsu, middle].into_iter().filter(|k| (1..n).contains(k)) {
        let levels = [&sorted[..split], &sorted[split..]].map(|part| median(part.to_vec()));
        let found = (levels[1] - levels[0]) / noise;
        if found >= CONTRAST {
            return Ok(levels);
        }
        contrast = f64::max(contrast, found);
    }
    Err(match contrast {
        0.0 => "its column never switches".into(),
        _ => format!(
            "its column never switches: its levels are {contrast:.1} times the noise apart, and {CONTRAST} are required"
        ),
    })
}

/// Is the high level the one at rest? It is the one at the beginning, unless that is in the middle of a shot before: so the end
/// and most samples say, where there are several shots.
fn rests_high(share: &[f64], shots: usize) -> bool {
    let is_high = |s: f64| s > 0.5;
    let [first, last] = [share[0], share[share.len() - 1]].map(is_high);
    let most = 2 * share.iter().filter(|s| is_high(**s)).count() > share.len();
    if shots > 1 && last == most { last } else { first }
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
