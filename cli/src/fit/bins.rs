//! A trace as means over intervals: each sample owns the time to its neighbours' midpoints, and where there are many of
//! them, several share an interval.

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

/// Each sample alone.
pub fn each(times: &[f64], values: &[f64]) -> Vec<Bin> {
    let n = times.len();
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = (n - 1) / 2;
    let step = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    // Across a gap no sample owns more than a step: nothing is known of the rest.
    let reach = |gap: f64| 0.5 * if gap > 1.5 * step { step } else { gap };
    (0..n)
        .map(|i| {
            let before = if i > 0 { times[i] - times[i - 1] } else { step };
            let after = if i + 1 < n { times[i + 1] - times[i] } else { step };
            let (from, to) = (times[i] - reach(before), times[i] + reach(after));
            Bin { from, to, mean: values[i], samples: 1.0 }
        })
        .collect()
}

/// Neighbours together, so that [`MOST`] or somewhat more are left: most of them on the `ramps`.
pub fn shared(each: &[Bin], ramps: [(f64, f64); 2]) -> Vec<Bin> {
    if each.len() <= MOST {
        return each.to_vec();
    }
    let inside = |bin: &Bin, (from, to): (f64, f64)| bin.to > from && bin.from < to;
    let place = |bin: &Bin| match ramps.map(|ramp| inside(bin, ramp)) {
        [true, _] => 0,
        [_, true] => 1,
        _ => 2,
    };
    let mut count = [0usize; 3];
    each.iter().for_each(|bin| count[place(bin)] += 1);
    let most = [ON_RAMP, ON_RAMP, MOST - 2 * ON_RAMP];
    let together = [0, 1, 2].map(|k| count[k].div_ceil(most[k]).max(1));
    let mut bins: Vec<Bin> = Vec::new();
    let mut last = None;
    for bin in each {
        let here = place(bin);
        match bins.last_mut() {
            // Never across a gap.
            Some(open)
                if last == Some(here)
                    && (open.samples as usize) < together[here]
                    && bin.from - open.to <= 1e-6 * (bin.to - bin.from) =>
            {
                let n = open.samples;
                open.mean = (open.mean * n + bin.mean) / (n + 1.0);
                open.samples += 1.0;
                open.to = bin.to;
            }
            _ => bins.push(*bin),
        }
        last = Some(here);
    }
    bins
}
