//! A frame's samples as means over intervals: each sample owns the time to its neighbours' midpoints, and where there
//! are many of them, several share an interval, fewer on the ramps than elsewhere.

use crate::trace::{Crossings, Trace, sampling_interval};

/// More samples than this share intervals.
const MOST: usize = 800;
/// Of these intervals, so many lie on each ramp.
const ON_RAMP: usize = 270;

/// The mean of the signal over an interval.
#[derive(Clone, Copy, Debug)]
pub struct Bin {
    pub from: f64,
    pub to: f64,
    pub mean: f64,
    /// How many samples it is the mean of.
    pub samples: f64,
}

impl Bin {
    pub fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }

    pub fn width(&self) -> f64 {
        self.to - self.from
    }

    /// Does the next bin begin where this one ends, and not behind a gap?
    fn touches(&self, next: &Self) -> bool {
        next.from - self.to <= 1e-6 * (next.to - next.from)
    }

    /// Takes in the sample that comes next.
    fn add(&mut self, sample: &Self) {
        let n = self.samples;
        self.mean = (self.mean * n + sample.mean) / (n + 1.0);
        self.samples += 1.0;
        self.to = sample.to;
    }
}

/// Each sample alone.
pub fn each(samples: &Trace) -> Vec<Bin> {
    let Trace { times, values } = samples;
    let n = times.len();
    let usual = sampling_interval(times);
    // Across a gap no sample owns more than the usual step: nothing is known of the rest.
    let reach = |step: f64| 0.5 * if step > 1.5 * usual { usual } else { step };
    (0..n)
        .map(|i| {
            let before = if i > 0 { times[i] - times[i - 1] } else { usual };
            let after = if i + 1 < n { times[i + 1] - times[i] } else { usual };
            let (from, to) = (times[i] - reach(before), times[i] + reach(after));
            Bin { from, to, mean: values[i], samples: 1.0 }
        })
        .collect()
}

/// Neighbours together, so that [`MOST`] or somewhat more are left: most of them on the ramps.
pub fn shared(each: &[Bin], crossings: &Crossings, step: f64) -> Vec<Bin> {
    if each.len() <= MOST {
        return each.to_vec();
    }
    let [opening, closing] = ramps(crossings, step);
    let inside = |bin: &Bin, (from, to): (f64, f64)| bin.to > from && bin.from < to;
    // On the opening ramp, on the closing one, elsewhere.
    let place = |bin: &Bin| match (inside(bin, opening), inside(bin, closing)) {
        (true, _) => 0,
        (_, true) => 1,
        _ => 2,
    };
    let count = |at: usize| each.iter().filter(|bin| place(bin) == at).count();
    let most = [ON_RAMP, ON_RAMP, MOST - 2 * ON_RAMP];
    let together = [0, 1, 2].map(|k| count(k).div_ceil(most[k]).max(1));
    let mut bins: Vec<Bin> = Vec::new();
    let mut last = None;
    for sample in each {
        let here = place(sample);
        let has_room = |bin: &Bin| (bin.samples as usize) < together[here] && bin.touches(sample);
        match bins.last_mut() {
            Some(bin) if last == Some(here) && has_room(bin) => bin.add(sample),
            _ => bins.push(*sample),
        }
        last = Some(here);
    }
    bins
}

/// Where intervals are to be short: from a ramp's first quarter to its third and as much again on both sides, and the
/// far tail that a slow end may have.
fn ramps(crossings: &Crossings, step: f64) -> [(f64, f64); 2] {
    let [up25, _, up75, down75, _, down25] = *crossings;
    let wide = |a: f64, b: f64| 1.5 * (b - a) + 10.0 * step;
    let (up, down) = (wide(up25, up75), wide(down75, down25));
    [(up25 - up, up75 + up), (down75 - down, down25 + down)]
}
