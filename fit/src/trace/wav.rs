//! A sound file as a trace: the channels are its columns, and it tells its rate.

use super::asked::Options;
use super::heads::Heads;
use super::layout::Layout;
use super::reading::{Clock, Recording, Told};
use super::samples::Trace;
use super::select::recording;
use super::times::{Samples, Timing};
use super::told::{Refusal, Warning};

/// From this length in bytes on, a recorder writes that it does not know it yet (2 or 4 GiB, less a header).
const UNKNOWN: usize = (1 << 31) - (1 << 16);

pub fn is_wav(bytes: &[u8]) -> bool {
    bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WAVE")
}

/// What a WAV holds.
struct Sound {
    channels: usize,
    rate: f64,
    /// One channel's after the other's, as often as there are samples.
    values: Vec<f64>,
    /// So many samples of each channel are announced; none where the recorder did not know it.
    announced: Option<usize>,
}

impl Sound {
    /// Reads what a recorder may write, be its byte rate right or not.
    fn parse(bytes: &[u8]) -> Result<Self, String> {
        let number = |bytes: &[u8], at: usize, count: usize| {
            let few = bytes.get(at..at + count)?;
            Some(few.iter().rev().fold(0, |number, byte| number << 8 | usize::from(*byte)))
        };
        let (mut at, mut form) = (12, None);
        while let (Some(id), Some(size)) = (bytes.get(at..at + 4), number(bytes, at + 4, 4)) {
            let chunk = &bytes[at + 8..bytes.len().min((at + 8).saturating_add(size))];
            match (id, form) {
                (b"fmt ", _) => form = Some(chunk),
                (b"data", Some(form)) => {
                    let field = |at, count| number(form, at, count).ok_or("its format is cut off");
                    let (tag, channels, rate) = (field(0, 2)?, field(2, 2)?, field(4, 4)?);
                    let (block, bits) = (field(12, 2)?, field(14, 2)?);
                    let tag = if tag == 0xfffe { field(24, 2)? } else { tag };
                    if channels == 0 || rate == 0 {
                        return Err("it has no channel or no rate".into());
                    } else if size == 0 {
                        return Err("it announces no samples; was its recording ended?".into());
                    }
                    // Few bits may stand in a wider field.
                    let wide = block / channels;
                    let value: fn(&[u8]) -> f64 = match (tag, wide) {
                        (1, 1) => |few| f64::from(few[0]) / 128.0 - 1.0,
                        (1, 2..=4) => |few| {
                            let whole = few.iter().rev().fold(0, |whole: u32, byte| whole << 8 | u32::from(*byte));
                            f64::from((whole << (32 - 8 * few.len())) as i32) / 2f64.powi(31)
                        },
                        (3, 4) => |few| f32::from_le_bytes(few.try_into().unwrap_or_default()).into(),
                        (3, 8) => |few| f64::from_le_bytes(few.try_into().unwrap_or_default()),
                        _ => return Err(format!("format {tag} of {bits} bits; save it as PCM of 16 bits")),
                    };
                    let announced = Some(size / wide / channels).filter(|_| size < UNKNOWN);
                    let values = chunk.chunks_exact(wide).map(value).collect();
                    return Ok(Self { channels, rate: rate as f64, values, announced });
                }
                _ => (),
            }
            at = (at + 8).saturating_add(size).saturating_add(size % 2);
        }
        Err("it has no samples".into())
    }
}

/// The trace in the bytes of a WAV.
pub fn open(bytes: &[u8], options: &Options) -> Result<Recording, Refusal> {
    let refused = |reason: String| Refusal::NotCsv { reason: format!("it is a WAV that cannot be read: {reason}") };
    let Sound { channels, rate, values, announced } = Sound::parse(bytes).map_err(refused)?;
    let told = if options.rate.is_some() { Told::Asked } else { Told::Format };
    let rate = options.rate.unwrap_or(rate);
    let heads = Heads { width: channels, ..Heads::default() };
    let (mut signals, sync) = heads.asked(options)?;
    if signals.is_empty() {
        signals.extend((0..channels).filter(|k| Some(*k) != sync));
    }
    if signals.is_empty() {
        let reason = "its channel is the signal's; record the sync on one of its own".into();
        return Err(Refusal::NoDelay { reason });
    }
    let channel = |k: usize| {
        let timed = values.iter().skip(k).step_by(channels).enumerate().map(|(i, v)| (i as f64 / rate, *v));
        let (times, values) = timed.filter(|(t, v)| v.is_finite() && options.counts(*t)).unzip();
        Samples { trace: Trace { times, values }, timing: Timing::default(), warnings: Vec::new() }
    };
    let layout = Layout { time: None, clock: Clock::Rate(rate), from: 0.0, first: Some(0.0), told, signals, sync };
    let reading = |signal| layout.reading(&heads, signal, options);
    let mut warnings = vec![Warning::SoundCard];
    let there = values.len() / channels;
    if let Some(announced) = announced.filter(|announced| there < *announced) {
        warnings.push(Warning::CutOff { samples: there, announced });
    }
    let all = layout.signals.iter().map(|k| (*k, Ok(channel(*k)))).collect();
    recording(all, sync.map(channel), reading, warnings)
}
