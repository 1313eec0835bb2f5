//! A sound file as a trace: the channels are its columns, and it tells its rate.

use std::io::Cursor;

use hound::{SampleFormat, WavReader};

use super::asked::{Column, Options};
use super::reading::{Clock, Reading, Recording, Samples, Told};
use super::samples::Trace;
use super::select::light_among;
use super::times::Timing;
use super::told::{Refusal, Warning};

/// From this length in bytes on, a recorder writes that it does not know it yet (2 or 4 GiB, less a header).
const UNKNOWN: u64 = (1 << 31) - (1 << 16);

pub fn is_wav(bytes: &[u8]) -> bool {
    bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WAVE")
}

/// The trace in the bytes of a WAV.
pub fn open(bytes: &[u8], options: &Options) -> Result<Recording, Refusal> {
    let refused = |reason: String| Refusal::NotCsv { reason };
    let broken = |e: hound::Error| refused(format!("it is a WAV that cannot be read ({e})"));
    let mut file = WavReader::new(Cursor::new(bytes)).map_err(broken)?;
    let spec = file.spec();
    let (channels, rate) = (usize::from(spec.channels), options.rate.unwrap_or(spec.sample_rate.into()));
    if channels == 0 || rate <= 0.0 {
        return Err(refused("it is a WAV without a channel or a rate".into()));
    }
    let values: Vec<f64> = match spec.sample_format {
        SampleFormat::Float => file.samples::<f32>().map_while(Result::ok).map(f64::from).collect(),
        SampleFormat::Int => {
            let full = 2f64.powi(i32::from(spec.bits_per_sample) - 1);
            file.samples::<i32>().map_while(Result::ok).map(|x| f64::from(x) / full).collect()
        }
    };
    // A recorder that never went back to its header says nothing of the length, or as much as the field holds.
    let announced = file.len() as usize / channels;
    let is_said = u64::from(file.len()) * u64::from(spec.bits_per_sample.div_ceil(8)) < UNKNOWN;
    let there = values.len() / channels;
    if announced == 0 {
        return Err(refused("it is a WAV that announces no samples; was its recording ended?".into()));
    }
    let channel = |k: usize| {
        let values = values.iter().skip(k).step_by(channels);
        let is_sound = |(_, v): &(usize, &f64)| v.is_finite();
        let timed = values.enumerate().filter(is_sound).map(|(i, v)| (i as f64 / rate, *v));
        let is_asked =
            |(t, _): &(f64, f64)| options.from.is_none_or(|from| *t >= from) && options.to.is_none_or(|to| *t <= to);
        let (times, values) = timed.filter(is_asked).unzip();
        let timing = Timing::default();
        Ok(Samples { trace: Trace { times, values }, timing, warnings: Vec::new() })
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
    let told = if options.rate.is_some() { Told::Asked } else { Told::Format };
    let clock = Clock::Rate(rate);
    let (columns, signal, of_sync) = (channels, named(0), sync.map(named));
    let mut reading = Reading {
        columns,
        time: None,
        signal,
        sync: of_sync,
        clock,
        first: Some(0.0),
        told,
        window: [options.from, options.to],
        segments: 0,
    };
    let mut warnings = vec![Warning::SoundCard];
    if there < announced && is_said {
        warnings.push(Warning::CutOff { samples: there, announced });
    }
    let name = |k: usize| format!("channel {}", k + 1);
    let all = asked.into_iter().map(|k| (k, channel(k))).collect();
    let (signal, samples) = light_among(all, name, None, &mut warnings)?;
    reading.signal = named(signal);
    let sync: Result<_, Refusal> = sync.map(channel).transpose();
    let sync = sync?.map(|sync: Samples| sync.trace);
    Ok(Recording { trace: samples.trace, timing: samples.timing, sync, reading, warnings })
}
