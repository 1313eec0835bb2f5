//! A sound file as a trace: the channels are its columns, and it tells its rate.

use super::asked::{Column, Options};
use super::reading::{Clock, Reading, Recording, Samples, Told};
use super::samples::Trace;
use super::select::recording;
use super::times::Timing;
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
                    }
                    // Few bits may stand in a wider field.
                    let wide = Some(block / channels).filter(|wide| 8 * wide >= bits && *wide <= 8);
                    let wide = wide.unwrap_or(bits.div_ceil(8));
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
    if announced == Some(0) {
        return Err(refused("it announces no samples; was its recording ended?".into()));
    }
    let rate = options.rate.unwrap_or(rate);
    let there = values.len() / channels;
    let channel = |k: usize| -> Samples {
        let values = values.iter().skip(k).step_by(channels);
        let is_sound = |(_, v): &(usize, &f64)| v.is_finite();
        let timed = values.enumerate().filter(is_sound).map(|(i, v)| (i as f64 / rate, *v));
        let is_asked =
            |(t, _): &(f64, f64)| options.from.is_none_or(|from| *t >= from) && options.to.is_none_or(|to| *t <= to);
        let (times, values) = timed.filter(is_asked).unzip();
        Samples { trace: Trace { times, values }, timing: Timing::default(), warnings: Vec::new() }
    };
    let place = |column: &Column| match column {
        Column::Number(number) if (1..=channels).contains(number) => Ok(number - 1),
        other => {
            let there = format!("{channels} channels, by number");
            Err(Refusal::NoColumn { name: other.to_string(), there })
        }
    };
    let mut asked = options.columns.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let no_delay = |reason: String| Refusal::NoDelay { reason };
    let sync = options.sync.as_ref().map(place).transpose();
    let sync = sync.map_err(|refusal| no_delay(refusal.to_string()))?;
    if asked.is_empty() {
        asked.extend((0..channels).filter(|k| Some(*k) != sync));
    }
    if asked.is_empty() || sync.is_some_and(|sync| asked.contains(&sync)) {
        return Err(no_delay("its channel is the signal's; record the sync on one of its own".into()));
    }
    let named = |k: usize| (k + 1, None);
    let reading = |signal| Reading {
        columns: channels,
        time: None,
        signal: named(signal),
        sync: sync.map(named),
        clock: Clock::Rate(rate),
        first: Some(0.0),
        told: if options.rate.is_some() { Told::Asked } else { Told::Format },
        window: [options.from, options.to],
        segments: 0,
    };
    let mut warnings = vec![Warning::SoundCard];
    if let Some(announced) = announced.filter(|announced| there < *announced) {
        warnings.push(Warning::CutOff { samples: there, announced });
    }
    let all = asked.into_iter().map(|k| (k, Ok(channel(k)))).collect();
    recording(all, sync.map(channel), reading, warnings)
}
