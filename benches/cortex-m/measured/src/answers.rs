//! One hash over the bits of many answers, hard ones among them: the same on every machine.

use core::fmt::{self, Display, Write};

use shutter_curve::{BezierPdf, CubicBezier, ShutterCurve};

use crate::baseline::Ramp;
use crate::{CURVES, uniform};

/// FNV-1a, a byte at a time.
struct Hash(u64);

impl Hash {
    fn words(&mut self, words: impl IntoIterator<Item = u32>) {
        words.into_iter().for_each(|word| self.bytes(&word.to_le_bytes()));
    }

    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }

    fn floats(&mut self, values: impl IntoIterator<Item = f32>) {
        self.words(values.into_iter().map(f32::to_bits));
    }

    /// What was made, or else what was said.
    fn made<T>(&mut self, made: Result<T, impl Display>) -> Option<T> {
        made.map_err(|error| write!(self, "{error}")).ok()
    }
}

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.bytes(text.as_bytes());
        Ok(())
    }
}

/// What is no fraction or no time of a curve, or just about one.
const ODD: [f32; 13] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    -1.0,
    2.0,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    f32::from_bits(1),
    -0.0,
    0.0,
    1.0,
    f32::from_bits(1.0f32.to_bits() - 1),
];

/// The hash for every number of cells that is measured, 0, 4, 8 and 16.
pub fn hashes() -> [u64; 4] {
    [hash::<0>(), hash::<4>(), hash::<8>(), hash::<16>()]
}

/// The hash of the answers with so many cells: every curve of the data, built where this runs; every hard input, as many
/// uniform ones and odd ones, in `u` and in time; schedules and pulses; and what is said to curves that are none.
fn hash<const CELLS: usize>() -> u64 {
    let mut hash = Hash(0xCBF2_9CE4_8422_2325);
    for data in CURVES {
        let us = data.hard.iter().copied().chain((0..512).map(uniform)).chain(ODD);
        assert!(ramps::<CELLS>(&mut hash, [data.opening, data.closing], us), "{}", data.name);
    }
    for (t, f) in HOSTILE {
        let [opening, closing] = [0, 4].map(|i| core::array::from_fn(|k| (t[i + k], f[i + k])));
        ramps::<CELLS>(&mut hash, [opening, closing], (0..64).map(uniform).chain(ODD));
    }
    hash.0
}

/// All that is made of two ramps; are they a curve?
fn ramps<const CELLS: usize>(
    hash: &mut Hash,
    ramps: [Ramp; 2],
    us: impl Iterator<Item = f32>,
) -> bool {
    let [opening, closing] = ramps.map(CubicBezier::new);
    let curve = hash.made(ShutterCurve::<CELLS>::with_cells(opening, closing));
    if let Some(curve) = &curve {
        answers(hash, curve, us);
        hash.floats(ODD.into_iter().flat_map(|t| [curve.cdf(t), curve.opening(t), curve.pdf(t)]));
        schedules(hash, curve);
    }
    single::<CELLS>(hash, opening);
    single::<CELLS>(hash, closing);
    forms::<CELLS>(hash, ramps);
    curve.is_some()
}

fn answers<const CELLS: usize>(
    hash: &mut Hash,
    curve: &ShutterCurve<CELLS>,
    us: impl Iterator<Item = f32>,
) {
    hash.floats([curve.exposure(), curve.normalization(), curve.efficiency()]);
    let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
    for u in us {
        let t = curve.inverse_cdf(u);
        hash.floats([t]);
        for t in [t, start + length * u] {
            hash.floats([curve.cdf(t), curve.opening(t), curve.pdf(t)]);
        }
    }
    // More than one chunk of what a slice is worked off in.
    let (mut us, mut ts) = ([0.0; 150], [0.0; 150]);
    us.iter_mut().zip(ODD.into_iter().chain((0..).map(uniform))).for_each(|(u, value)| *u = value);
    curve.inverse_cdf_slice(&us, &mut ts);
    hash.floats(ts);
}

/// The other forms of a curve, with the times and the inner control points of this one.
fn forms<const CELLS: usize>(hash: &mut Hash, [opening, closing]: [Ramp; 2]) {
    let [a, b, c, d] = [opening[0].0, opening[3].0, closing[0].0, closing[3].0];
    let fraction = |t: f32| (t - a) / (d - a);
    let [[t1, t2], [t5, t6]] = [opening, closing].map(|p| [fraction(p[1].0), fraction(p[2].0)]);
    let inner = [t1, opening[1].1, t2, opening[2].1, t5, closing[1].1, t6, closing[2].1];
    let full = ShutterCurve::<CELLS>::shutteropening_with_cells([a, b, c, d], inner);
    for curve in [full, ShutterCurve::linear_with_cells(a, b, c, d)] {
        if let Some(curve) = hash.made(curve) {
            answers(hash, &curve, (0..16).map(uniform));
        }
    }
}

fn schedules<const CELLS: usize>(hash: &mut Hash, curve: &ShutterCurve<CELLS>) {
    hash.floats(curve.trigger_times(9));
    hash.floats(curve.trigger_times(u32::MAX).nth(1 << 30));
    hash.words([curve.direct_triggers()]);
    hash.words(ODD.map(|gap| curve.max_triggers(gap)));
    for (n, hz) in
        [(64, 1_000), (33, 1_000_000), (17, 1_000_000_000), (0, 1), (5, 0), (5, u32::MAX)]
    {
        let ticks = hash.made(curve.trigger_ticks(n, hz));
        hash.words(ticks.into_iter().flatten());
        for duty in [0.5, 1.0, 1e-6, 0.0, f32::NAN] {
            let pulses = hash.made(curve.pulse_ticks(n, duty, hz));
            hash.words(pulses.into_iter().flatten().flat_map(<[u32; 2]>::from));
        }
        let mut pulses = [(0, 0); 9];
        hash.made(curve.pulses_into(&mut pulses, 0.3, hz, 3, 7));
        hash.words(pulses.into_iter().flat_map(<[u32; 2]>::from));
        // The third is a gap that a part of the triggers would keep.
        for gap in [0, 7, (curve.exposure() * hz as f32 / 9.5) as u32, u32::MAX] {
            let mut ticks = [0; 20];
            hash.made(curve.schedule_into(&mut ticks, hz, gap));
            hash.words(ticks);
            let most = hash.made(curve.most_triggers(n, hz, gap));
            hash.words(most);
        }
    }
}

fn single<const CELLS: usize>(hash: &mut Hash, curve: CubicBezier) {
    let times = curve.points().map(|(t, _)| t);
    let Some(pdf) = hash.made(BezierPdf::<CELLS>::with_cells(curve)) else { return };
    hash.floats([pdf.area(), pdf.normalization()]);
    for u in (0..32).map(uniform).chain(ODD) {
        let t = times[0] + (times[3] - times[0]) * u;
        hash.floats([pdf.inverse_cdf(u), pdf.cdf(t), pdf.pdf(t)]);
    }
}

/// The openness of plain ramps, up and down, and no openness.
const UP_DOWN: [f32; 8] = [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0];
const DARK: [f32; 8] = [0.0; 8];

/// Ramps that are refused, and the last that are not: the times of both, and their openness.
const HOSTILE: &[([f32; 8], [f32; 8])] = &[
    ([f32::NAN, 0.0, 0.0, 1.0, 2.0, 2.0, 3.0, 3.0], UP_DOWN),
    ([0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0], [0.0, f32::INFINITY, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0]),
    ([0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, f32::INFINITY], UP_DOWN),
    ([0.0, 0.0, 1.0, 1.0, 0.5, 0.5, 3.0, 3.0], UP_DOWN),
    ([0.0; 8], DARK),
    ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-30, 1e-30], DARK),
    ([-f32::MAX, -f32::MAX, -f32::MAX, -f32::MAX, f32::MAX, f32::MAX, f32::MAX, f32::MAX], DARK),
    ([0.0, 3.0, -2.0, 1.0, 2.0, 2.0, 3.0, 3.0], UP_DOWN),
    ([0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0], [-0.1, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0]),
    ([0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0], [0.0, 0.0, 1.5, 1.0, 1.0, 1.0, 0.0, 0.0]),
    ([0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0], DARK),
    ([0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0], [0.0, 0.0, 1e-44, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ([1e9, 1e9, 1e9, 1e9, 1e9, 1e9, 1e9 + 64.0, 1e9 + 64.0], UP_DOWN),
    ([0.0, 0.0, 1e-19, 1e-19, 1e-19, 1e-19, 2e-19, 2e-19], UP_DOWN),
    ([-9e18, -9e18, 0.0, 0.0, 0.0, 0.0, 9e18, 9e18], UP_DOWN),
    ([-1.0, 0.0, -1.0, 0.0, 1e-40, 1.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0, 1.0, 1e-40, 0.0, 1e-45]),
];
