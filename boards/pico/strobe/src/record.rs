//! Settings as the words that flash keeps, and back.

use crate::change::Change;
use crate::curves::CURVES;
use crate::limits::MIN_PULSE;
use crate::settings::{Curve, Edge, Frames, Light, Numbers, Settings};

/// So many words.
pub const WORDS: usize = 22;

impl Settings {
    /// The words that give these settings back.
    pub fn to_words(&self) -> [u32; WORDS] {
        let mut words = [0; WORDS];
        let (light, amount) = match self.light {
            Light::Equal(length) => (0, length),
            Light::Doses(duty) => (1, duty.to_bits()),
        };
        let edge = (self.edge == Edge::Falling).into();
        let curve = match &self.curve {
            Curve::Stored(i) => *i as u32,
            Curve::Built(numbers, _) => {
                for (word, number) in words[10..].iter_mut().zip(numbers.get()) {
                    *word = number.to_bits();
                }
                0x100 + numbers.get().len() as u32
            }
        };
        let Frames { count, period } = self.frames;
        let plain =
            [self.pulses, self.gap, light, amount, self.delay, edge, count, period, curve, 0];
        words[..10].copy_from_slice(&plain);
        words
    }

    /// The settings of such words, if they are any that lines can make.
    pub fn from_words(words: &[u32; WORDS]) -> Option<Self> {
        let [pulses, gap, light, amount, delay, edge, count, period, curve, _, numbers @ ..] =
            *words;
        let numbers = numbers.map(f32::from_bits);
        let curve = match (curve, numbers) {
            (stored, _) if (stored as usize) < CURVES.len() => Change::Stored(stored as usize),
            (0x104, [a, b, c, d, ..]) => Change::Linear([a, b, c, d]),
            (0x10C, _) => Change::Built(numbers),
            _ => return None,
        };
        let light = match (light, f32::from_bits(amount)) {
            (0, _) if amount >= MIN_PULSE => Light::Equal(amount),
            (1, duty) if duty > 0.0 && duty <= 1.0 => Light::Doses(duty),
            _ => return None,
        };
        let edge = match edge {
            0 => Edge::Rising,
            1 => Edge::Falling,
            _ => return None,
        };
        if pulses == 0 || count == 0 {
            return None;
        }
        let frames = Frames { count, period };
        let settings = Self { pulses, gap, light, delay, edge, frames, curve: Curve::Stored(0) };
        settings.with(curve).ok()
    }
}

const _: () = assert!(WORDS == 10 + size_of::<Numbers>() / 4 - 1);
