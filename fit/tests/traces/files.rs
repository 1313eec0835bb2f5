//! What `shutter fit` reads of the files of instruments: which column, in which unit or at which rate, and what it
//! refuses, in words that help. All files are of one shutter, so what is taken for something else shows in the
//! exposure.

use std::collections::BTreeSet;

use shutter_fit::trace::{self, Column, Recording, Tell, Warning, open};
use shutter_fit::{Fit, Kind, Options, Sync, fit};
use strum::IntoEnumIterator;

use crate::exports::{asked, rows};
use crate::generator::{Random, asked as asked_for};

/// What stands above the rows of the exports' light, and a row for each of its samples.
fn with(above: &str, row: impl Fn(usize, f64, f64) -> String) -> String {
    let samples = rows("{t},{v}");
    let samples = samples.lines().map(|line| line.split(',').map(|it| it.parse().unwrap()));
    let samples = samples.map(|mut sample| [0; 2].map(|_| sample.next().unwrap()));
    let rows = samples.enumerate().map(|(i, [t, v])| row(i, t, v) + "\n");
    above.to_string() + &rows.collect::<String>()
}

fn read(bytes: &[u8], options: &trace::Options) -> Result<(Recording, f64), String> {
    let recording = open(bytes, options).map_err(|refusal| refusal.with_option())?;
    let fit = fit(&recording.trace, &Options::default(), &mut |_| ());
    let exposure = fit.map_err(|refusal| refusal.with_option())?.exposure.value;
    Ok((recording, exposure))
}

/// A program may ask for them, so they stay.
#[test]
fn the_codes_of_warnings_are_the_documented_ones() {
    let pages = include_str!("../../../docs/measuring.md");
    let (_, list) = pages.split_once("\n## Warnings\n").unwrap();
    let before_colons = list.lines().filter_map(|line| line.strip_prefix("- ")?.split_once(':'));
    let codes = before_colons.flat_map(|(codes, _)| codes.split(", ").map(|it| it.trim_matches('`')));
    let told = Warning::iter().map(|warning| warning.code());
    assert_eq!(codes.collect::<BTreeSet<_>>(), told.collect());
}

#[test]
fn of_two_signals_the_light_is_taken_and_the_other_named() {
    for (names, row) in
        [("x-axis,1,2\nsecond,Volt,Volt\n", "{t},{g},{v}"), ("Time (s);sync;photodiode\n", "{t};{g};{v}")]
    {
        let text = names.to_string() + &rows(row);
        let (recording, exposure) = read(text.as_bytes(), &trace::Options::default()).unwrap();
        assert!((exposure / 0.005 - 1.0).abs() < 1e-3, "{exposure}");
        let [Warning::SecondSignal { taken, other, columns }] = &recording.warnings[..] else {
            panic!("{:?}", recording.warnings);
        };
        assert!(taken.starts_with("column 3") && other.starts_with("column 2"), "{taken} {other}");
        assert_eq!(columns, "1,2");
        // And those take it, without a word.
        let columns = vec![Column::Number(1), Column::Number(2)];
        let asked = trace::Options { columns, ..Default::default() };
        let (recording, exposure) = read(text.as_bytes(), &asked).unwrap();
        assert!((exposure / 0.007 - 1.0).abs() < 5e-3, "{exposure}");
        assert_eq!(recording.warnings, []);
    }
}

#[test]
fn what_is_refused_is_shown() {
    let refused = |bytes: &[u8]| read(bytes, &trace::Options::default()).map(|_| ()).expect_err("a refusal");
    let grouped = |i: usize| {
        if i < 1000 { i.to_string() } else { format!("{},{:03}", i / 1000, i % 1000) }
    };
    let in_one_line = |row: &str| rows(row).replace('\n', ",");
    for (text, words) in [
        (with("us;v\n", |i, _, v| format!("{};{v:.2}", grouped(10 * i))), "plain number"),
        (with("us;v\n", |i, _, v| format!("{};{:.0}", grouped(10 * i), 100.0 * v)), "part thousands"),
        (with("t;v\n", |i, _, v| format!("1.000,{:02};{v:.5}", i % 100)), "plain number"),
        (with("", |_, t, v| format!("{:.3} ms; {v:.4} V", 1e3 * t)), "'0.000 ms;' is no time that is read"),
        (in_one_line("{v}"), "all values stand in one line"),
        (in_one_line("{t}") + "\n" + &in_one_line("{v}"), "all values stand in one line"),
        (in_one_line("{T}").repeat(10), "each sample needs a line of its own"),
        ("$timescale 1 us $end\n$var wire 1 ! light $end\n$enddefinitions $end\n#0\n0!\n#500\n1!\n".into(), "VCD"),
        ("<html>".into(), "its middle line is '<html>'"),
        ("\n \n".into(), "it is empty"),
        (with("", |_, _, v| format!("{},{:.0}", u8::from(v > 0.5), 9.0 * v)), "a whole number from its fraction"),
    ] {
        let said = refused(text.as_bytes());
        assert!(said.contains(words), "{words}: {said}");
    }
    for (bytes, name) in [
        (&b"\x1f\x8b\x08\0"[..], "gzip"),
        (b"PK\x03\x04\x14\0", "xlsx"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1", "xls"),
        (b"fLaC\0\0\0", "FLAC"),
        (b"\x89PNG\r\n\x1a\n\0", "PNG"),
        (b"\x89HDF\r\n\x1a\n\0", "HDF5"),
        (b"RIFF\x04\0\0\0WAVEfmt", "WAV"),
        (b"t\0,\0v\0\n\0", "binary"),
    ] {
        assert!(refused(bytes).contains(name), "{name}: {}", refused(bytes));
    }
}

/// Encodings, rows that are broken, come late or come twice: each is read, and told with its line.
#[test]
fn other_files_of_the_same_trace_are_read() {
    let text = with("t (µs),V\n", |_, t, v| format!("{:.2},{v:.5}", 1e6 * t));
    let latin: Vec<u8> = text.chars().map(|c| c as u32 as u8).collect();
    // A mark may say the encoding.
    let wide = |text: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> { text.encode_utf16().flat_map(bytes).collect() };
    let marked = format!("\u{feff}{text}");
    let broken = with("time_s,v\n", |i, t, v| match i {
        300 => format!("{t:.6},NaN"),
        301 => format!("{t:.6},"),
        302 => "oops,0.5".into(),
        303 => format!("{t:.6},1e300"),
        304 => "\n".into(),
        305 => format!("{t:.6},inf"),
        _ => format!("{t:.6},{v:.5}"),
    });
    let reason = "the value is NaN, and no finite number up to 1e30".into();
    let broken_rows = Warning::BrokenRows { count: 5, line: 302, reason };
    let sorted = with("time_s,v\n", |_, t, v| format!("{t:.6},{v:.5}"));
    let mut lines: Vec<&str> = sorted.lines().collect();
    lines.swap(101, 901);
    lines.insert(501, lines[500]);
    let unsorted = [Warning::Unsorted { line: 103 }, Warning::Duplicates { count: 1, line: 502 }];
    for (bytes, told) in [
        (latin, vec![]),
        (wide(&marked, u16::to_le_bytes), vec![]),
        (wide(&marked, u16::to_be_bytes), vec![]),
        (marked.into(), vec![]),
        (text.replace('\n', "\r").into(), vec![]),
        (broken.into(), vec![broken_rows]),
        (lines.join("\n").into(), unsorted.into()),
    ] {
        let (recording, exposure) = read(&bytes, &trace::Options::default()).unwrap();
        assert_eq!(recording.warnings, told);
        assert!((exposure / 0.005 - 1.0).abs() < 1e-3, "{exposure}");
    }
}

/// A sound of two channels: tag, bits of a sample and bytes that it takes, and a byte rate that is so far off.
fn wav(tag: u16, bits: u16, wide: usize, off: u32) -> Vec<u8> {
    let (rate, block) = (100_000u32, 2 * wide as u16);
    let data: Vec<u8> = rows("{v}")
        .lines()
        .flat_map(|line| [0.01, line.parse::<f64>().unwrap()])
        .flat_map(|v| {
            let whole = (v * 2f64.powi(31)) as i32;
            match (tag, wide) {
                (3, 4) => (v as f32).to_le_bytes().to_vec(),
                (3, _) => v.to_le_bytes().to_vec(),
                (_, 1) => vec![(128.0 + 127.0 * v) as u8],
                _ => whole.to_le_bytes()[4 - wide..].to_vec(),
            }
        })
        .collect();
    // In an extension the tag stands further behind.
    let is_extended = bits as usize != 8 * wide;
    let mut form = [if is_extended { 0xfffe } else { tag }, 2].map(u16::to_le_bytes).concat();
    form.extend([rate, rate * u32::from(block) + off].map(u32::to_le_bytes).concat());
    form.extend([block, bits, 22, bits, 3, 0, tag].map(u16::to_le_bytes).concat());
    form.resize(if is_extended { 40 } else { 16 }, 0);
    let chunk = |id: &[u8], body: &[u8]| [id, &(body.len() as u32).to_le_bytes(), body].concat();
    let body = [b"WAVE".to_vec(), chunk(b"fmt ", &form), chunk(b"LIST", b"INFO"), chunk(b"data", &data)].concat();
    chunk(b"RIFF", &body)
}

#[test]
fn a_sound_is_read_and_doubted() {
    // 8 bits are 1 / 128 of the range.
    let forms = [
        (1, 16, 2, 0),
        (1, 16, 2, 1),
        (1, 8, 1, 0),
        (1, 24, 3, 0),
        (1, 24, 4, 7),
        (1, 32, 4, 0),
        (3, 32, 4, 0),
        (3, 64, 8, 2),
    ];
    for (tag, bits, wide, off) in forms {
        let (recording, exposure) = read(&wav(tag, bits, wide, off), &trace::Options::default()).unwrap();
        assert!(
            (exposure / 0.005 - 1.0).abs() < if bits == 8 { 3e-3 } else { 1e-3 },
            "{tag} {bits} {wide}: {exposure}"
        );
        assert_eq!(recording.reading.to_string(), "column 2 of 2; times: 100000 samples a second, by the file");
        assert_eq!(recording.warnings, [Warning::SoundCard]);
    }
    let said = read(&wav(2, 4, 1, 0), &trace::Options::default()).unwrap_err();
    assert!(said.contains("format 2 of 4 bits"), "{said}");
}

#[test]
fn a_sound_that_is_cut_off_is_said_to_be() {
    let plain = trace::Options::default();
    let whole = wav(1, 16, 2, 0);
    // 4 bytes a sample, 200 samples short: the pulse is whole, and so is the dark after it.
    let (recording, exposure) = read(&whole[..whole.len() - 802], &plain).unwrap();
    assert!((exposure / 0.005 - 1.0).abs() < 1e-3, "{exposure}");
    assert_eq!(recording.warnings, [Warning::SoundCard, Warning::CutOff { samples: 999, announced: 1200 }]);
    assert!(read(&whole[..3001], &plain).is_err());

    // The header of a recorder that did not know the length: as much as the field holds, or nothing.
    let data = whole.windows(4).position(|four| four == b"data").unwrap() + 4;
    let announcing = |bytes: u32| {
        let mut wav = whole.clone();
        wav[data..data + 4].copy_from_slice(&bytes.to_le_bytes());
        read(&wav, &plain)
    };
    for bytes in [0xffff_fffc, 0x7fff_0000] {
        assert_eq!(announcing(bytes).unwrap().0.warnings, [Warning::SoundCard]);
    }
    assert!(announcing(0).unwrap_err().contains("announces no samples"));
}

/// Every message about pulses that are left out, as a reader sees it.
#[test]
fn pulses_that_are_left_out_are_said() {
    // A shot of 5 ms right at the beginning, two whole ones, a spark between them, and one that the end cuts.
    let openness = |t: f64| (t - 0.002).min(0.009 - t).clamp(0.0, 0.002) / 0.002;
    let mut random = Random::new(5);
    let mut text = String::from("time_s,light_V\n");
    for i in 70..19_925 {
        let t = 5e-5 * f64::from(i);
        let shots: f64 = [0.0, 0.3, 0.6, 0.99].iter().map(|at| openness(t - at)).sum();
        let spark = if (0.45..0.4505).contains(&t) { 0.9 } else { 0.0 };
        text += &format!("{t:.5},{:.4}\n", shots + spark + 0.003 * random.normal());
    }
    let recording = open(text.as_bytes(), &trace::Options::default()).unwrap();
    let fit = fit(&recording.trace, &Options::default(), &mut |_| ()).unwrap();
    assert!((fit.exposure.value / 0.005 - 1.0).abs() < 2e-3, "{:?}", fit.exposure);
    assert_eq!(fit.frames.count, 2);
    let said: Vec<String> = fit.warnings.iter().map(Warning::to_string).collect();
    let left_out = |number: usize| {
        format!(
            "pulse {number} of the trace has too little dark beside it, and is left out; those that are whole are \
             counted"
        )
    };
    let spark = "1 small pulse left out: with less than a fifth of the light of the largest pulse";
    assert_eq!(said, [spark.to_string(), left_out(1), left_out(4)]);
    let codes: Vec<&str> = fit.warnings.iter().map(Warning::code).collect();
    assert_eq!(codes, ["glitches", "partial_frame", "partial_frame"]);
}

/// The codes of all that is doubted, and the fit.
fn doubted(text: &str, sync: Option<Sync>) -> (Fit, Recording, Vec<&'static str>) {
    let recording = open(text.as_bytes(), &trace::Options::default()).unwrap();
    let options = Options { timing: recording.timing.clone(), sync, ..Options::default() };
    let fit = fit(&recording.trace, &options, &mut |_| ()).unwrap();
    let codes = recording.warnings.iter().chain(&fit.warnings).map(|warning| warning.code()).collect();
    (fit, recording, codes)
}

#[test]
fn segments_whose_times_begin_anew_are_shots() {
    let segment = |later: f64, longer: f64| -> String {
        let times = (0..700).map(|i| -2e-3 + 2e-5 * f64::from(i));
        let mut random = Random::new(later as u64);
        let openness = |t: f64| (t.min(0.005 + longer - t) / 6e-4).clamp(0.0, 1.0);
        let rows = times.map(|t| format!("{t:.6},{:.5}\n", openness(t - later) + 0.003 * random.normal()));
        rows.collect()
    };
    let file = |segments: &[String]| format!("Time (s),A\n{}", segments.concat());
    let equal = file(&[segment(0.0, 0.0), segment(4e-4, 0.0), segment(2e-4, 0.0)]);
    let (fit, recording, codes) = doubted(&equal, Some(Sync::Edge(0.0)));
    assert_eq!((fit.frames.count, fit.chosen, recording.reading.segments), (3, Kind::Trapezoid, 3));
    assert!(codes.is_empty(), "{codes:?}");
    assert!((fit.exposure.value - 0.0044).abs() < 4.0 * fit.exposure.error && fit.exposure.error < 2e-6);
    // Its times are those of its own segment.
    let later = [0.0, 4e-4, 2e-4][fit.frames.fitted - 1];
    assert!((fit.delay.unwrap().mean() - later).abs() < 3e-6);
    let (_, _, codes) = doubted(&file(&[segment(0.0, 0.0), segment(0.0, 0.003)]), None);
    assert_eq!(codes, ["shots_differ"]);
    // Another column's names between them begin another recording; the same ones do not.
    let [first, second] = [0.0, 1e-4].map(|later| segment(later, 0.0));
    let parted = |names: &str| {
        open(file(&[first.clone(), format!("{names}\n"), second.clone()]).as_bytes(), &trace::Options::default())
    };
    assert!(parted("Time (s),B").unwrap_err().to_string().contains("'Time (s),B' between the rows"));
    assert_eq!(parted("Time (s),A").unwrap().reading.segments, 2);
}

/// As a simulator chooses its steps.
#[test]
fn uneven_samples_count_for_their_own_time() {
    let text = with("time_s,v\n", |_, t, v| format!("{t:.6},{v:.4}"));
    let lines = text.lines().enumerate().filter(|(i, _)| [0, 1, 2, 3, 5, 8].contains(&(i % 9)));
    let text: String = lines.map(|(_, line)| format!("{line}\n")).collect();
    let (recording, _) = read(text.as_bytes(), &trace::Options::default()).unwrap();
    let pulses = trace::pulses(&recording.trace, trace::Light::Auto).unwrap();
    assert!((pulses.frames[0].exposure / 0.005 - 1.0).abs() < 5e-3, "{:?}", pulses.frames);
}

#[test]
fn a_timers_count_and_a_channels_number_are_not_misread() {
    let timer = with("time,adc\n", |i, _, v| format!("{},{v:.4}", 212 * i));
    let said = read(timer.as_bytes(), &trace::Options::default()).unwrap_err();
    assert!(said.contains("\"time\" counts without a unit"), "{said}");
    let keysight = "x-axis,1,2\nsecond,Volt,Volt\n".to_string() + &rows("{t},{v},{g}");
    for (name, is_read) in [("2", false), ("2 Volt", true), ("3", true)] {
        let options = trace::Options { sync: Some(Column::parse(name)), ..Default::default() };
        assert_eq!(open(keysight.as_bytes(), &options).is_ok(), is_read, "{name}");
    }
}

#[test]
fn rounded_times_are_spread_and_doubted() {
    let mut random = Random::new(21);
    let openness = |t: f64| ((t - 0.0123).min(0.0187 - t) / 4e-4).clamp(0.0, 1.0);
    let values: Vec<f64> = (0..2000).map(|i| openness(2e-5 * f64::from(i)) + 0.003 * random.normal()).collect();
    type Form<'a> = &'a dyn Fn(f64) -> String;
    let forms: [(&str, Form, f64); 6] = [
        ("t_s", &|t| format!("{:.2e}", t + 0.2), 0.2),
        ("t_s", &|t| format!("{:.5e}", t + 20.0), 20.0),
        ("t_ms", &|t| format!("{:.0}", 1e3 * t), 0.0),
        ("t_ms", &|t| (1e3 * t + 1e-9).floor().to_string(), 0.0),
        ("t_ms", &|t| format!("{:.1}", 1e3 * t), 0.0),
        // No time comes twice.
        ("t_s", &|t| format!("{:.5}", 0.75 * t), 0.0),
    ];
    for (k, (name, form, start)) in forms.into_iter().enumerate() {
        let pace = if k == 5 { 0.75 } else { 1.0 };
        let rows: String =
            values.iter().enumerate().map(|(i, v)| format!("{},{v:.5}\n", form(2e-5 * i as f64))).collect();
        let (fit, _, codes) = doubted(&format!("{name},A\n{rows}"), None);
        assert!(codes[0] == "rounded_times" && codes.len() < 3, "{k}: {codes:?}");
        let off = [
            (fit.exposure, pace * 0.006),
            (fit.triggers[0], pace * 0.0126873 + start),
            (fit.triggers[15], pace * 0.0183127 + start),
        ];
        for (found, truth) in off {
            assert!((found.value - truth).abs() < 3.0 * found.error, "{k}: {found:?} {truth}");
        }
        assert!(fit.exposure.error < 2e-4 && fit.chosen == Kind::Trapezoid, "{k}: {:?} {:?}", fit.exposure, fit.chosen);
    }
    // Rows that come twice are no rounding.
    let twice: String =
        values.iter().enumerate().map(|(i, v)| format!("{:.5},{v:.5}\n", 2e-5 * i as f64).repeat(2)).collect();
    assert_eq!(doubted(&format!("t_s,A\n{twice}"), None).2, ["duplicates"]);
}

#[test]
fn a_list_of_changes_is_read_as_light_and_as_sync() {
    let list = "Time [s],flash,light\n0,1,0\n0.5,0,0\n0.5031,0,1\n0.5093,0,0\n0.512,1,0\n\
        1.5,0,0\n1.5031,0,1\n1.5093,0,0\n1.513,1,0\n";
    let options = trace::Options { sync: Some(Column::Name("flash".into())), ..Default::default() };
    let recording = open(list.as_bytes(), &options).unwrap();
    assert_eq!(recording.warnings, [Warning::Changes]);
    let options = Options { sync: recording.sync.map(Sync::Channel), ..Options::default() };
    let fit = fit(&recording.trace, &options, &mut |_| ()).unwrap();
    assert_eq!((fit.frames.count, fit.chosen), (2, Kind::Box));
    assert!((fit.exposure.value - 0.0062).abs() < 1e-5, "{:?}", fit.exposure);
    assert!((fit.delay.unwrap().mean() - 0.0031).abs() < 1e-5);
    // A value may be unknown, the last row cut, the times those of days.
    for list in [
        "Time [s],Channel 0\n0.0,0\n0.7,1\n0.7625,0\n",
        "Time [s],A\n0,X\n0.7,1\n0.7625,0\n1,1\n1.0625,0\n2.7,1\n2.7625,0\n3.",
        "Time [s],A,B\n0,0,0\n0.6,0,1\n0.7,1,1\n0.73,1,0\n0.7625,0,0\n1.2",
        "Time [s],A\n0,0\n0.7,1\n0.7625,0\n1,1\n1.0625,X\n1.9,1\n1.9625,0\n2.7,1\n2.7625,0\n3.2,1\n3.2625,0\n0.",
        "t,A\n2025-12-31T23:59:59.9Z,0\n2026-01-01T00:00:00Z,1\n2026-01-01T00:00:00.062500000Z,0\n",
    ] {
        let (fit, _, codes) = doubted(list, None);
        assert!(codes[0] == "changes" && (fit.exposure.value - 0.0625).abs() < 1e-4, "{list}: {:?}", fit.exposure);
    }
    // A switch that was sampled is no list.
    let sampled: String =
        (0..60).map(|i| format!("{},{}\n", 0.1 * f64::from(i), i32::from((20..40).contains(&i)))).collect();
    assert!(!doubted(&format!("t_s,A\n{sampled}"), None).2.contains(&"changes"));
}

#[test]
fn the_first_rows_are_those_of_the_numbers() {
    let text = b"scope\nTime (ms);CH1\n0,5;1,25\n1,0;1,5\n1,5;2\n";
    let preview = trace::preview(text, 2).unwrap();
    assert_eq!(preview.names, [Some("Time (ms)".to_string()), Some("CH1".to_string())]);
    let rows = [(3, vec!["0,5".into(), "1,25".into()]), (4, vec!["1,0".into(), "1,5".into()])];
    assert_eq!(preview.rows, rows);
    assert!(trace::preview(b"<html>", 2).is_err());
}

/// Each block of samples has its time by a clock that ticks rarely; between two there is an uneven pause.
#[test]
fn the_stamps_of_blocks_are_doubted() {
    for (seed, tick, rows, pause) in
        [(1, 1.0 / 64.0, 10, 0.012), (2, 0.01, 8, 0.02), (3, 1.0 / 64.0, 16, 0.03), (4, 0.0, 10, 0.0)]
    {
        let mut random = Random::new(seed);
        let openness = |t: f64| ((t - 5.0) / 1.0).min((9.0 - t) / 1.0).clamp(0.0, 1.0);
        let (mut text, mut at) = (String::from("Time (s)\tVoltage (V)\n"), 0.0037 * seed as f64);
        while at < 16.0 {
            let stamp = if tick > 0.0 { (at / tick).floor() * tick } else { at };
            for k in 0..rows {
                let since = 0.01 * f64::from(k);
                text += &format!("{:.6}\t{:.5}\n", stamp + since, openness(at + since) + 0.001 * random.normal());
            }
            at += 0.01 * f64::from(rows) + pause * random.within(0.5, 1.5);
        }
        let (fit, _, codes) = doubted(&text, None);
        assert_eq!(codes.contains(&"stamped_blocks"), tick > 0.0, "{seed}: {codes:?}");
        let off = (fit.exposure.value - 3.0).abs() / fit.exposure.error;
        assert!(off < 3.0 && fit.exposure.error < 0.03, "{seed}: {:?}", fit.exposure);
    }
}

/// Blades scatter by some percent; a setting differs by more.
#[test]
fn shots_of_one_setting_scatter() {
    for (exposures, is_one) in
        [([5.25, 5.41, 5.09, 5.33], true), ([2.0, 2.05, 1.9, 2.08], true), ([4.0, 4.0, 4.5, 4.0], false)]
    {
        let mut random = Random::new(7);
        let level = |t: f64, exposure: f64| ((t - 10.0) / 0.8).min((10.8 + exposure - t) / 0.8).clamp(0.0, 1.0);
        let rows = |k: usize| (0..800).map(move |i| (k, 0.05 * i as f64));
        let line = |(k, t): (usize, f64)| {
            format!("{:.2},{:.4}\n", 40.0 * k as f64 + t, level(t, exposures[k]) + 0.004 * random.normal())
        };
        let text: String = (0..4).flat_map(rows).map(line).collect();
        let (fit, _, codes) = doubted(&format!("t_ms,light\n{text}"), None);
        assert_eq!((fit.frames.count, codes.contains(&"shots_differ")), (4, !is_one), "{exposures:?}");
    }
}

/// A channel that was recorded for a part of the times, be it a small one.
#[test]
fn empty_fields_at_an_end_are_no_broken_rows() {
    for (before, behind) in [(0, 800), (800, 0), (2000, 2000)] {
        let dark =
            |from: i32, to: i32| (from..to).map(|i| format!("{:.5},\n", 1e-5 * f64::from(i))).collect::<String>();
        let text = format!("Time (s),A\n{}{}{}", dark(-before, 0), rows("{t},{v}"), dark(1200, 1200 + behind));
        let (recording, exposure) = read(text.as_bytes(), &asked("", None, None)).unwrap();
        assert!(recording.warnings.is_empty() && (exposure / 0.005 - 1.0).abs() < 1e-3, "{exposure}");
    }
}

/// Whatever a file holds, it is read or refused: lines cut, bytes changed, parts doubled.
#[test]
fn no_broken_file_breaks_the_reading() {
    let wholes = [
        rows("{t},{v}"),
        "Time [s],A\n0,0\n0.7,1\n0.8,0\n1.7,1\n1.8,0\n".into(),
        rows("{,ms};{,v}"),
        rows("{day} {adc}"),
    ];
    let mut wholes: Vec<Vec<u8>> = wholes.into_iter().map(String::into_bytes).collect();
    wholes.push(wav(1, 16, 2, 0));
    wholes.push(wav(3, 64, 8, 0));
    let mut random = Random::new(77);
    for k in 0..asked_for("BROKEN_FILES", 120) {
        let mut bytes = wholes[k % wholes.len()].clone();
        for _ in 0..1 + k % 9 {
            let mut place = || (random.within(0.0, bytes.len() as f64)) as usize;
            let (at, to) = (place(), place());
            let byte = b"\n,;:.-+eE\t \"0179XN\0\xff#"[place() % 21];
            match k % 4 {
                0 => bytes[at] = byte,
                1 => bytes.truncate(at.max(40)),
                2 => bytes.rotate_left(at % 60),
                _ => drop(bytes.drain(at.min(to)..at.max(to).min(at.min(to) + 400))),
            }
        }
        if let Ok(recording) = open(&bytes, &asked("", None, None)) {
            let _ = fit(&recording.trace, &Options::default(), &mut |_| ());
        }
    }
}
