//! One hash over the bits of many answers, hard ones among them: the same on every machine.

use shutter_curve::ShutterCurve;

use crate::{CURVES, uniform};

/// FNV-1a over 32-bit words, a byte at a time.
struct Hash(u64);

impl Hash {
    fn add(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }
}

/// The hash of the answers with so many cells: every curve of the data, built where this runs; every
/// hard input and as many uniform ones, in `u` and in time; and ticks at three rates.
///
/// # Panics
/// If a curve does not build.
pub fn hash<const CELLS: usize>() -> u64 {
    let mut hash = Hash(0xCBF2_9CE4_8422_2325);
    for data in CURVES {
        let (opening, closing) = data.ramps();
        let curve = ShutterCurve::<CELLS>::with_cells(opening, closing);
        let curve = curve.unwrap_or_else(|error| panic!("{}: {error}", data.name));
        for value in [curve.exposure(), curve.normalization(), curve.efficiency()] {
            hash.add(value.to_bits());
        }
        let (start, length) = (curve.open_start(), curve.close_end() - curve.open_start());
        let odd = [f32::NAN, -1.0, 2.0, f32::INFINITY, f32::NEG_INFINITY, 0.0, 1.0];
        let uniform = (0..512).map(uniform);
        for u in data.hard_u().chain(uniform).chain(odd) {
            let t = curve.inverse_cdf(u);
            hash.add(t.to_bits());
            for t in [t, start + length * u] {
                hash.add(curve.cdf(t).to_bits());
                hash.add(curve.opening(t).to_bits());
                hash.add(curve.pdf(t).to_bits());
            }
        }
        for (n, hz) in [(64, 1_000), (33, 1_000_000), (17, 1_000_000_000)] {
            match curve.trigger_ticks(n, hz) {
                Ok(ticks) => ticks.for_each(|tick| hash.add(tick)),
                Err(_) => hash.add(u32::MAX),
            }
        }
    }
    hash.0
}

/// The hash for every number of cells that is measured, 0, 4, 8 and 16.
pub fn hashes() -> [u64; 4] {
    [hash::<0>(), hash::<4>(), hash::<8>(), hash::<16>()]
}
