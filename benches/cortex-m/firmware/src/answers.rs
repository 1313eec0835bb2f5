//! One hash over the bits of many answers, hard ones among them: the same on every machine.

use core::fmt::{self, Display, Write};

use shutter_curve::{BezierPdf, CubicBezier, ShutterCurve};

use crate::baseline::Ramp;
use crate::{CURVES, uniform};

/// FNV-1a, a byte at a time.
struct Hash(u64);

impl Hash {
    fn add(&mut self, word: u32) {
        self.add_bytes(&word.to_le_bytes());
    }

    fn add_bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }

    fn add_all(&mut self, values: impl IntoIterator<Item = f32>) {
        values.into_iter().for_each(|value| self.add(value.to_bits()));
    }

    fn add_message(&mut self, error: impl Display) {
        let _ = write!(self, "{error}");
    }
}

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.add_bytes(text.as_bytes());
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

/// The hash of the answers with so many cells: every curve of the data, built where this runs; every hard input, as many
/// uniform ones and odd ones, in `u` and in time; schedules and pulses; and what is said to curves that are none.
///
/// # Panics
/// If a curve of the data does not build.
pub fn hash<const CELLS: usize>() -> u64 {
    let mut hash = Hash(0xCBF2_9CE4_8422_2325);
    for data in CURVES {
        let (opening, closing) = data.ramps();
        let curve = ShutterCurve::<CELLS>::with_cells(opening, closing);
        let curve = curve.unwrap_or_else(|error| panic!("{}: {error}", data.name));
        answers(&mut hash, &curve, data.hard_u().chain((0..512).map(uniform)).chain(ODD));
        slice(&mut hash, &curve);
        for t in ODD {
            hash.add_all([curve.cdf(t), curve.opening(t), curve.pdf(t)]);
        }
        schedules(&mut hash, &curve);
        single::<CELLS>(&mut hash, opening);
        forms::<CELLS>(&mut hash, data.opening, data.closing);
    }
    for ramps in HOSTILE {
        let [opening, closing] = ramps.map(CubicBezier::new);
        match ShutterCurve::<CELLS>::with_cells(opening, closing) {
            Ok(curve) => {
                let us = (0..64).map(uniform).chain(ODD);
                answers(&mut hash, &curve, us);
                slice(&mut hash, &curve);
                schedules(&mut hash, &curve);
            }
            Err(error) => hash.add_message(error),
        }
        single::<CELLS>(&mut hash, opening);
        single::<CELLS>(&mut hash, closing);
        forms::<CELLS>(&mut hash, ramps[0], ramps[1]);
    }
    hash.0
}

fn answers<const CELLS: usize>(
    hash: &mut Hash,
    curve: &ShutterCurve<CELLS>,
    us: impl Iterator<Item = f32>,
) {
    hash.add_all([curve.exposure(), curve.normalization(), curve.efficiency()]);
    let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
    for u in us {
        let t = curve.inverse_cdf(u);
        hash.add_all([t]);
        for t in [t, start + length * u] {
            hash.add_all([curve.cdf(t), curve.opening(t), curve.pdf(t)]);
        }
    }
}

/// The other forms of a curve, with the times and the inner control points of this one.
fn forms<const CELLS: usize>(hash: &mut Hash, opening: Ramp, closing: Ramp) {
    let [a, b, c, d] = [opening[0].0, opening[3].0, closing[0].0, closing[3].0];
    let fraction = |t: f32| (t - a) / (d - a);
    let [[t1, t2], [t5, t6]] = [opening, closing].map(|p| [fraction(p[1].0), fraction(p[2].0)]);
    let inner = [t1, opening[1].1, t2, opening[2].1, t5, closing[1].1, t6, closing[2].1];
    let full = ShutterCurve::<CELLS>::shutteropening_with_cells([a, b, c, d], inner);
    for curve in [full, ShutterCurve::linear_with_cells(a, b, c, d)] {
        match curve {
            Ok(curve) => answers(hash, &curve, (0..16).map(uniform)),
            Err(error) => hash.add_message(error),
        }
    }
}

/// More than one chunk of what a slice is worked off in.
fn slice<const CELLS: usize>(hash: &mut Hash, curve: &ShutterCurve<CELLS>) {
    let (mut us, mut ts) = ([0.0; 150], [0.0; 150]);
    us.iter_mut().zip(ODD.into_iter().chain((0..).map(uniform))).for_each(|(u, value)| *u = value);
    curve.inverse_cdf_slice(&us, &mut ts);
    hash.add_all(ts);
}

fn schedules<const CELLS: usize>(hash: &mut Hash, curve: &ShutterCurve<CELLS>) {
    hash.add_all(curve.trigger_times(9));
    hash.add_all(curve.trigger_times(u32::MAX).nth(1 << 30));
    hash.add(curve.direct_triggers());
    ODD.iter().for_each(|gap| hash.add(curve.max_triggers(*gap)));
    for (n, hz) in
        [(64, 1_000), (33, 1_000_000), (17, 1_000_000_000), (0, 1), (5, 0), (5, u32::MAX)]
    {
        match curve.trigger_ticks(n, hz) {
            Ok(ticks) => ticks.for_each(|tick| hash.add(tick)),
            Err(error) => hash.add_message(error),
        }
        for duty in [0.5, 1.0, 1e-6, 0.0, f32::NAN] {
            match curve.pulse_ticks(n, duty, hz) {
                Ok(pulses) => pulses.flat_map(<[u32; 2]>::from).for_each(|tick| hash.add(tick)),
                Err(error) => hash.add_message(error),
            }
        }
        let mut pulses = [(0, 0); 9];
        match curve.pulses_into(&mut pulses, 0.3, hz, 3, 7) {
            Ok(()) => pulses
                .map(|(on, off)| [on, off])
                .as_flattened()
                .iter()
                .for_each(|tick| hash.add(*tick)),
            Err(error) => hash.add_message(error),
        }
        // The third is a gap that a part of the triggers would keep.
        for gap in [0, 7, (curve.exposure() * hz as f32 / 9.5) as u32, u32::MAX] {
            let mut ticks = [0; 20];
            match curve.schedule_into(&mut ticks, hz, gap) {
                Ok(()) => ticks.iter().for_each(|tick| hash.add(*tick)),
                Err(error) => hash.add_message(error),
            }
            match curve.most_triggers(n, hz, gap) {
                Ok(most) => hash.add(most),
                Err(error) => hash.add_message(error),
            }
        }
    }
}

fn single<const CELLS: usize>(hash: &mut Hash, curve: CubicBezier) {
    let (times, pdf) = (curve.points().map(|(t, _)| t), BezierPdf::<CELLS>::with_cells(curve));
    let pdf = match pdf {
        Ok(pdf) => pdf,
        Err(error) => return hash.add_message(error),
    };
    hash.add_all([pdf.area(), pdf.normalization()]);
    for u in (0..32).map(uniform).chain(ODD) {
        let t = times[0] + (times[3] - times[0]) * u;
        hash.add_all([pdf.inverse_cdf(u), pdf.cdf(t), pdf.pdf(t)]);
    }
}

/// Ramps that are refused, and the last that are not.
const HOSTILE: &[[Ramp; 2]] = &[
    [[(f32::NAN, 0.0), (0.0, 0.0), (0.0, 0.0), (1.0, 1.0)], closing_at(2.0)],
    [[(0.0, 0.0), (0.0, f32::INFINITY), (1.0, 0.0), (1.0, 1.0)], closing_at(2.0)],
    [OPENING, [(2.0, 1.0), (2.0, 1.0), (3.0, 0.0), (f32::INFINITY, 0.0)]],
    [OPENING, closing_at(0.5)],
    [[(0.0, 0.0); 4], [(0.0, 0.0); 4]],
    [[(0.0, 0.0); 4], [(0.0, 0.0), (0.0, 0.0), (1e-30, 0.0), (1e-30, 0.0)]],
    [[(-f32::MAX, 0.0); 4], [(f32::MAX, 0.0); 4]],
    [[(0.0, 0.0), (3.0, 0.0), (-2.0, 1.0), (1.0, 1.0)], closing_at(2.0)],
    [[(0.0, -0.1), (0.0, 0.0), (1.0, 1.0), (1.0, 1.0)], closing_at(2.0)],
    [[(0.0, 0.0), (0.0, 0.0), (1.0, 1.5), (1.0, 1.0)], closing_at(2.0)],
    [
        [(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (1.0, 0.0)],
        [(1.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 0.0)],
    ],
    [
        [(0.0, 0.0), (0.0, 0.0), (1.0, 1e-44), (1.0, 0.0)],
        [(1.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 0.0)],
    ],
    [
        [(1e9, 0.0), (1e9, 0.0), (1e9, 1.0), (1e9, 1.0)],
        [(1e9, 1.0), (1e9, 1.0), (1e9 + 64.0, 0.0), (1e9 + 64.0, 0.0)],
    ],
    [
        [(0.0, 0.0), (0.0, 0.0), (1e-19, 1.0), (1e-19, 1.0)],
        [(1e-19, 1.0), (1e-19, 1.0), (2e-19, 0.0), (2e-19, 0.0)],
    ],
    [
        [(-9e18, 0.0), (-9e18, 0.0), (0.0, 1.0), (0.0, 1.0)],
        [(0.0, 1.0), (0.0, 1.0), (9e18, 0.0), (9e18, 0.0)],
    ],
    [
        [(-1.0, 0.0), (0.0, 0.0), (-1.0, 1.0), (0.0, 1.0)],
        [(1e-40, 1.0), (1.0, 1e-40), (1.0, 0.0), (1.0, 1e-45)],
    ],
];

const OPENING: Ramp = [(0.0, 0.0), (0.0, 0.0), (1.0, 1.0), (1.0, 1.0)];

const fn closing_at(start: f32) -> Ramp {
    [(start, 1.0), (start, 1.0), (3.0, 0.0), (3.0, 0.0)]
}

/// The hash for every number of cells that is measured, 0, 4, 8 and 16.
pub fn hashes() -> [u64; 4] {
    [hash::<0>(), hash::<4>(), hash::<8>(), hash::<16>()]
}
