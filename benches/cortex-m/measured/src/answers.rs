//! One hash over the bits of many answers, hard ones among them: the same on every machine. All that is public is
//! asked, so that what must not panic is just this.

use core::hash::{Hash, Hasher};

use shutter_curve::{CubicBezier, Hz, Pulse, ShutterCurve};

use crate::baseline::Ramp;
use crate::{CURVES, uniform};

/// FNV-1a, a byte at a time, of numbers as each machine holds them: the low byte first.
struct Fnv(u64);

impl Hasher for Fnv {
    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
    fn write_u32(&mut self, number: u32) {
        self.write(&number.to_le_bytes());
    }
    /// Of an enum's variant.
    fn write_isize(&mut self, number: isize) {
        self.write(&(number as i64).to_le_bytes());
    }
    fn finish(&self) -> u64 {
        self.0
    }
}

impl Fnv {
    fn add(&mut self, values: impl IntoIterator<Item: Hash>) {
        values.into_iter().for_each(|value| value.hash(self));
    }

    fn floats(&mut self, values: impl IntoIterator<Item = f32>) {
        self.add(values.into_iter().map(f32::to_bits));
    }

    /// What was made, or else why not.
    fn made<T, E: Hash>(&mut self, made: Result<T, E>) -> Option<T> {
        made.map_err(|error| self.add([error])).ok()
    }

    /// All that an iterator of the crate does.
    fn all<T: Hash>(&mut self, all: impl DoubleEndedIterator<Item = T> + ExactSizeIterator + Clone) {
        let mut ends = all.clone();
        let some = [ends.nth(2), ends.nth_back(2), ends.next_back(), all.clone().last()];
        self.add([all.len() as u32]);
        self.add(some.into_iter().flatten().chain(all));
    }
}

/// What is no fraction or no time of a curve, or just about one.
const ODD: [f32; 12] = {
    const NONE: f32 = f32::INFINITY;
    let [max, least, below_1] = [f32::MAX, f32::MIN_POSITIVE, 0.99999994];
    [f32::NAN, NONE, -NONE, -1.0, 2.0, max, -max, least, 1e-45, -0.0, 1.0, below_1]
};

/// The hash of all that is made of two ramps; of fractions, these beside others.
type Of = fn([Ramp; 2], &[f32]) -> u64;
/// By the number of octaves: 0, 4, 8, 16.
const OF: [Of; 4] = [of::<0>, of::<4>, of::<8>, of::<16>];

/// For each of these numbers of octaves the hash of the answers of every fourth curve of the data, built where this
/// runs: an emulated processor without floats takes minutes for all.
pub fn hashes() -> [u64; 4] {
    let mut all = [0; 4];
    for (curve, i) in CURVES.iter().zip((0..4).cycle()) {
        let more = OF[i]([curve.opening, curve.closing], curve.hard);
        all[i] = u64::rotate_left(all[i], 1) ^ more;
    }
    all
}

pub fn of_ramps(ramps: [Ramp; 2], us: &[f32]) -> [u64; 4] {
    OF.map(|of| of(ramps, us))
}

fn of<const OCTAVES: usize>(ramps: [Ramp; 2], us: &[f32]) -> u64 {
    let hash = &mut Fnv(0xCBF2_9CE4_8422_2325);
    let [opening, closing] = ramps.map(CubicBezier::new);
    if let Some(curve) = hash.made(ShutterCurve::<OCTAVES>::with_octaves(opening, closing)) {
        answers(hash, &curve, us.iter().copied().chain((0..512).map(uniform)).chain(ODD));
        for odd in ODD {
            hash.floats([curve.cdf(odd), curve.openness(odd), curve.pdf(odd)]);
            hash.add([curve.steps(odd)]);
        }
        schedules(hash, &curve);
    }

    // The other forms, with the times and the inner control points of this one.
    let [opening, closing] = ramps;
    let [a, b, c, d] = [opening[0].0, opening[3].0, closing[0].0, closing[3].0];
    let fraction = |t: f32| (t - a) / (d - a);
    let [[t1, t2], [t5, t6]] = ramps.map(|p| [fraction(p[1].0), fraction(p[2].0)]);
    let inner = [t1, opening[1].1, t2, opening[2].1, t5, closing[1].1, t6, closing[2].1];
    let times = [a, b, c, d];
    let (opening, closing) = CubicBezier::shutteropening(times, inner);
    let lines = (CubicBezier::line((a, 0.0), (b, 1.0)), CubicBezier::line((c, 1.0), (d, 0.0)));
    for (opening, closing) in [(opening, closing), lines, (lines.0, closing)] {
        if let Some(curve) = hash.made(ShutterCurve::<OCTAVES>::with_octaves(opening, closing)) {
            answers(hash, &curve, (0..16).map(uniform));
        }
    }
    if OCTAVES == 8 {
        let densities = [0.5, 1e-7, 2.0].map(|by| ShutterCurve::density(opening.scaled(by)));
        let forms = [ShutterCurve::shutteropening(times, inner), ShutterCurve::linear(a, b, c, d)];
        for curve in forms.into_iter().chain(densities).chain([ShutterCurve::new(opening, lines.1)]) {
            let curve = hash.made(curve);
            hash.add(curve.map(|curve| curve.direct_triggers()));
        }
        // Curves that are none, or only just: each number is odd in turn.
        for (place, odd) in (0..16).flat_map(|place| ODD.map(|odd| (place, odd))) {
            let mut ramps = ramps;
            for (t, f) in ramps.as_flattened_mut().iter_mut().skip(place / 2).take(1) {
                *(if place % 2 == 0 { t } else { f }) = odd;
            }
            let [opening, closing] = ramps.map(CubicBezier::new);
            let curve = hash.made(ShutterCurve::<0>::with_octaves(opening, closing));
            hash.floats(curve.map(|curve| curve.exposure()));
        }
    }
    hash.finish()
}

fn answers<const OCTAVES: usize>(hash: &mut Fnv, curve: &ShutterCurve<OCTAVES>, us: impl Iterator<Item = f32>) {
    let (start, end) = (curve.open_start(), curve.close_end());
    hash.floats([start, curve.open_end(), curve.close_start(), end]);
    hash.floats([curve.exposure(), curve.normalization(), curve.efficiency()]);
    for u in us {
        let t = curve.inverse_cdf(u);
        hash.floats([t]);
        for t in [t, start + (end - start) * u] {
            hash.floats([curve.cdf(t), curve.openness(t), curve.pdf(t)]);
        }
    }
}

fn schedules<const OCTAVES: usize>(hash: &mut Fnv, curve: &ShutterCurve<OCTAVES>) {
    hash.add([curve.direct_triggers()]);
    for (n, hz) in [(64, 1_000), (33, 1_000_000), (17, 1_000_000_000), (0, 1), (5, 0), (5, u32::MAX), (u32::MAX, 1)] {
        let Some(timed) = hash.made(curve.at(Hz(hz))) else { continue };
        hash.add([timed.length()]);
        let any = timed.min_gap(0).min_pulse(0);
        if let Some(ticks) = hash.made(any.trigger_ticks(n)) {
            hash.add([ticks.is_direct(2)]);
            hash.all(ticks);
        }
        for duty in [0.5, 1.0, 1e-6, 0.0, f32::NAN] {
            if let Some(pulses) = hash.made(any.pulse_ticks(n, duty)) {
                hash.all(pulses);
            }
        }
        let mut pulses = [Pulse::default(); 9];
        let limited = timed.min_pulse(3).min_gap(7);
        hash.made(limited.pulses_into(&mut pulses, 0.3));
        hash.add(pulses);
        let pulses = hash.made(limited.pulses::<3>(0.3));
        hash.add(pulses.into_iter().flatten());
        // The third is a gap that a part of the triggers would keep.
        for gap in [0, 7, (curve.exposure() * hz as f32 / 9.5) as u32, u32::MAX] {
            let (mut ticks, timed) = ([0; 20], timed.min_gap(gap));
            hash.made(timed.ticks_into(&mut ticks));
            hash.add(ticks);
            let ticks = hash.made(timed.ticks::<3>());
            hash.add(ticks.into_iter().flatten());
            let planned = hash.made(timed.ticks_vec::<64>(n));
            hash.add(planned.iter().flatten());
            hash.add([timed.max_triggers(n)]);
        }
    }
}
