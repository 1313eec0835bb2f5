//! Forms of files and of times: encodings, sounds, what is refused by name; segments, rounded times, lists of changes,
//! blocks. All files of one shutter show in the exposure what is taken for something else.

use std::collections::BTreeSet;

use shutter_fit::trace::{self, Recording, Warning, open};
use shutter_fit::{Fit, Kind, Options, Sync, fit};

use crate::exports::{judge, rows};
use crate::generator::{Random, asked, each};

/// A program may ask for them, so they stay.
#[test]
fn the_codes_of_warnings_are_the_documented_ones() {
    let pages = include_str!("../../../docs/measuring.md");
    let (_, list) = pages.split_once("\n## Warnings\n").unwrap();
    let before_colons = list.lines().filter_map(|line| line.strip_prefix("- ")?.split_once(':'));
    let codes = before_colons.flat_map(|(codes, _)| codes.split(", ").map(|it| it.trim_matches('`')));
    let told = Warning::each();
    let told = told.iter().map(|warning| warning.code());
    assert_eq!(codes.collect::<BTreeSet<_>>(), told.collect());
}

#[test]
fn what_is_refused_is_shown() {
    let in_one_line = |row: &str| rows(row).replace('\n', ",");
    let grouped = |row: fn(usize) -> String| (0..1500).map(row).collect::<String>();
    for (text, words) in [
        (grouped(|i| format!("{},{:03};{:.2}\n", 1 + i / 100, 10 * (i % 100), i as f64)), "plain number"),
        (grouped(|i| format!("{},{:03};{}\n", 1 + i / 100, 10 * (i % 100), i % 7)), "part thousands"),
        (grouped(|i| format!("1.000,{:02};0.{i}\n", i % 100)), "plain number"),
        (in_one_line("{v}"), "all values stand in one line"),
        (in_one_line("{t}") + "\n" + &in_one_line("{v}"), "all values stand in one line"),
        ("$timescale 1 us $end\n$var wire 1 ! light $end\n$enddefinitions $end\n#0\n0!\n#500\n1!\n".into(), "VCD"),
        ("<html>".into(), "its middle line is '<html>'"),
        ("\n \n".into(), "it is empty"),
    ] {
        judge(text.as_bytes(), "", &format!("!{words}")).expect("a refusal");
    }
    for (bytes, name) in [
        (&b"PK\x03\x04\x14\0"[..], "a workbook's sheet as CSV"),
        (b"RIFF\x04\0\0\0WAVEfmt", "WAV"),
        (&wav(2, 4, 1, 0), "format 2 of 4 bits"),
    ] {
        judge(bytes, "", &format!("!{name}")).expect("a refusal");
    }
}

/// Encodings, rows that are broken, come late or come twice: each is read, and told with its line.
#[test]
fn other_files_of_the_same_trace_are_read() {
    let text = "t (µs),V\n".to_string() + &rows("{us},{v}");
    let latin: Vec<u8> = text.chars().map(|c| c as u32 as u8).collect();
    // A mark may say the encoding.
    let marked = format!("\u{feff}{text}");
    let mac = text.replace('\n', "\r").into_bytes();
    for bytes in [latin, mac, marked.into()] {
        judge(&bytes, "", "2 in µs, by its name").expect("a trace");
    }
    let mut lines: Vec<&str> = text.lines().collect();
    let broken = ["3000.0,NaN", "3010.0,", "oops,0.5", "3030.0,1e300", "", "3050.0,inf"];
    lines.splice(301..307, broken);
    let told = "2 line 302: the value is NaN, and no finite number up to 1e30; 4 such rows|broken_rows";
    judge(lines.join("\n").as_bytes(), "", told).expect("a trace");
    let mut lines: Vec<&str> = text.lines().collect();
    lines.swap(101, 901);
    lines.insert(501, lines[500]);
    let told = "2 line 103: time runs back~line 502: the same time again; 1 sample is|unsorted duplicates";
    judge(lines.join("\n").as_bytes(), "", told).expect("a trace");
    // A channel that was recorded for a part of the times, be it a small one.
    for (before, behind) in [(0, 800), (800, 0), (2000, 2000)] {
        let dark = |range: std::ops::Range<i32>| range.map(|i| format!("{i}0,\n")).collect::<String>();
        let text = format!("t_us,A\n{}{}{}", dark(-before..0), rows("{us},{v}"), dark(1200..1200 + behind));
        judge(text.as_bytes(), "", "2 in µs").expect("a trace");
    }
    // Across a gap no sample stands for the light.
    let soon: String = text.lines().take(1000).chain(["9e9,0.06"]).map(|line| format!("{line}\n")).collect();
    judge(soon.as_bytes(), "", "2 in µs").expect("a trace");
    // As a simulator chooses its steps, each sample counts for its own time.
    let uneven = text.lines().enumerate().filter(|(i, _)| [0, 1, 2, 3, 5, 8].contains(&(i % 9)));
    judge(uneven.map(|(_, line)| format!("{line}\n")).collect::<String>().as_bytes(), "", "2 ").expect("a trace");
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
    let read = |bytes: &[u8], must: &str| judge(bytes, "", must).expect("a trace");
    for (tag, bits, wide, off) in [
        (1, 16, 2, 0),
        (1, 16, 2, 1),
        (1, 8, 1, 0),
        (1, 24, 3, 0),
        (1, 24, 4, 7),
        (1, 32, 4, 0),
        (3, 32, 4, 0),
        (3, 64, 8, 2),
    ] {
        read(&wav(tag, bits, wide, off), "2 100000 samples a second, by the file~(--from and --to)|sound_card");
    }
    let whole = wav(1, 16, 2, 0);
    judge(&whole, "--sync 2 --columns 2", "!is the signal's").expect("a refusal");
    judge(&whole, "--columns 3", "!no column '3'").expect("a refusal");
    // 4 bytes a sample, 200 samples short: the pulse is whole, and so is the dark after it.
    read(&whole[..whole.len() - 802], "2 announces 1200 samples and holds 999|sound_card cut_off");
    judge(&whole[..3001], "", "!").expect("a refusal");
    // The header of a recorder that did not know the length: as much as the field holds, or nothing.
    let data = whole.windows(4).position(|four| four == b"data").unwrap() + 4;
    let announcing = |bytes: u32| [&whole[..data], &bytes.to_le_bytes(), &whole[data + 4..]].concat();
    [0xffff_fffc, 0x7fff_0000].iter().for_each(|bytes| read(&announcing(*bytes), "2 |sound_card"));
    judge(&announcing(0), "", "!announces no samples").expect("a refusal");
}

/// A shot right at the beginning, two whole ones, a spark between them, and one that the end cuts.
#[test]
fn pulses_that_are_left_out_are_said() {
    let openness = |t: f64| (t - 0.002).min(0.009 - t).clamp(0.0, 0.002) / 0.002;
    let mut random = Random::new(5);
    let mut text = String::from("time_s,light_V\n");
    for i in 70..19_925 {
        let t = 5e-5 * f64::from(i);
        let shots: f64 = [0.0, 0.3, 0.6, 0.99].iter().map(|at| openness(t - at)).sum();
        let spark = if (0.45..0.4505).contains(&t) { 0.9 } else { 0.0 };
        text += &format!("{t:.5},{:.4}\n", shots + spark + 0.003 * random.normal());
    }
    let told = "2 ; 1 small pulse left out: with less~; pulse 1 of the trace has too little dark~; pulse 4 of\
        |glitches partial_frame partial_frame";
    judge(text.as_bytes(), "", told).expect("two pulses");
}

/// A shutter's openness: from when on, its ramps' length, its exposure.
fn level(t: f64, at: f64, ramp: f64, exposure: f64) -> f64 {
    ((t - at).min(at + exposure + ramp - t) / ramp).clamp(0.0, 1.0)
}

/// Rows of times as they are written, each with a level and some noise.
fn noisy(seed: u64, noise: f64, rows: impl Iterator<Item = (String, f64)>) -> String {
    let mut random = Random::new(seed);
    rows.map(|(time, level)| format!("{time},{:.5}\n", level + noise * random.normal())).collect()
}

/// The fit, what was read, and the codes of all that is doubted. The exposure lies within three of its errors, which
/// are no larger than `most`.
fn fitted(text: &str, sync: Option<Sync>, exposure: f64, most: f64) -> (Fit, Recording, Vec<&'static str>) {
    let recording = open(text.as_bytes(), &trace::Options::default()).unwrap();
    let options = Options { timing: recording.timing.clone(), sync, ..Options::default() };
    let fit = fit(&recording.trace, &options, &mut |_| ()).unwrap();
    let codes = recording.warnings.iter().chain(&fit.warnings).map(|warning| warning.code()).collect();
    let off = (fit.exposure.value - exposure).abs();
    assert!(off < 3.0 * fit.exposure.error.max(1e-5 * exposure) && fit.exposure.error < most, "{:?}", fit.exposure);
    (fit, recording, codes)
}

#[test]
fn segments_whose_times_begin_anew_are_shots() {
    let segment = |later: f64, longer: f64| {
        let times = (0..700).map(|i| -2e-3 + 2e-5 * f64::from(i));
        noisy(later as u64, 0.003, times.map(|t| (format!("{t:.6}"), level(t, later, 6e-4, 0.0044 + longer))))
    };
    let file = |segments: &[String]| format!("Time (s),A\n{}", segments.concat());
    let equal = file(&[segment(0.0, 0.0), segment(4e-4, 0.0), segment(2e-4, 0.0)]);
    let (fit, recording, codes) = fitted(&equal, Some(Sync::Edge(0.0)), 0.0044, 2e-6);
    assert_eq!((fit.frames.count, fit.chosen, recording.reading.segments), (3, Kind::Trapezoid, 3));
    assert!(codes.is_empty(), "{codes:?}");
    // Its times are those of its own segment.
    let later = [0.0, 4e-4, 2e-4][fit.frames.fitted - 1];
    assert!((fit.delay.unwrap().mean() - later).abs() < 3e-6);
    let (_, _, codes) = fitted(&file(&[segment(0.0, 0.0), segment(0.0, 0.003)]), None, 0.0044, 2e-6);
    assert_eq!(codes, ["shots_differ"]);
}

#[test]
fn rounded_times_are_spread_and_doubted() {
    type Form<'a> = &'a dyn Fn(f64) -> String;
    let forms: [(&str, Form, f64, f64); 6] = [
        ("t_s", &|t| format!("{:.2e}", t + 0.2), 1.0, 0.2),
        ("t_s", &|t| format!("{:.5e}", t + 20.0), 1.0, 20.0),
        ("t_ms", &|t| format!("{:.0}", 1e3 * t), 1.0, 0.0),
        ("t_ms", &|t| (1e3 * t + 1e-9).floor().to_string(), 1.0, 0.0),
        ("t_ms", &|t| format!("{:.1}", 1e3 * t), 1.0, 0.0),
        // No time comes twice.
        ("t_s", &|t| format!("{:.5}", 0.75 * t), 0.75, 0.0),
    ];
    let times = || (0..2000).map(|i| 2e-5 * f64::from(i));
    let rows = |form: Form| noisy(21, 0.003, times().map(|t| (form(t), level(t, 0.0123, 4e-4, 0.006))));
    for (name, form, pace, start) in forms {
        let (fit, _, codes) = fitted(&format!("{name},A\n{}", rows(form)), None, pace * 0.006, 2e-4);
        assert!(codes[0] == "rounded_times" && codes.len() < 3 && fit.chosen == Kind::Trapezoid, "{name}: {codes:?}");
        for (found, truth) in [(fit.triggers[0], 0.0126873), (fit.triggers[15], 0.0183127)] {
            assert!((found.value - pace * truth - start).abs() < 3.0 * found.error, "{name}: {found:?}");
        }
    }
    // Rows that come twice are no rounding.
    let once = rows(&|t| format!("{t:.5}"));
    let twice: String = once.lines().map(|line| format!("{line}\n").repeat(2)).collect();
    assert_eq!(fitted(&format!("t_s,A\n{twice}"), None, 0.006, 2e-4).2, ["duplicates"]);
}

/// Each block of samples has its time by a clock that ticks rarely; between two there is an uneven pause.
#[test]
fn the_stamps_of_blocks_are_doubted() {
    for (seed, tick, rows, pause) in
        [(1, 1.0 / 64.0, 10, 0.012), (2, 0.01, 8, 0.02), (3, 1.0 / 64.0, 16, 0.03), (4, 0.0, 10, 0.0)]
    {
        let (mut random, mut at, mut all) = (Random::new(seed), 0.0037 * seed as f64, Vec::new());
        while at < 16.0 {
            let stamp = if tick > 0.0 { (at / tick).floor() * tick } else { at };
            let since = (0..rows).map(|k| 0.01 * f64::from(k));
            all.extend(since.map(|since| (format!("{:.6}", stamp + since), level(at + since, 5.0, 1.0, 3.0))));
            at += 0.01 * f64::from(rows) + pause * random.within(0.5, 1.5);
        }
        let (_, _, codes) = fitted(&format!("Time (s),A\n{}", noisy(seed, 0.001, all.into_iter())), None, 3.0, 0.03);
        assert_eq!(codes.contains(&"stamped_blocks"), tick > 0.0, "{seed}: {codes:?}");
    }
}

/// The rest of a shot before, which hardly shows as a pulse as the record begins, is no part of the next one.
#[test]
fn a_record_may_begin_or_end_in_another_shot() {
    let shots = |t: f64| [0.0, 0.012, 0.024].map(|at| level(t, at, 0.002, 0.005)).iter().sum();
    for (seed, from, to) in [(1, 0.0059, 0.0235), (2, 0.0075, 0.0251)] {
        let times = (0..5000).map(|i| 2e-5 * f64::from(i)).filter(|t| (from..to).contains(t));
        let text = noisy(seed, 0.004, times.map(|t| (format!("{t:.5}"), shots(t))));
        assert_eq!(fitted(&format!("time_s,light\n{text}"), None, 0.005, 1e-5).2, [""; 0], "{seed}");
    }
}

/// Few steps of the values, and less noise than would spread them: a level is off by up to half a step.
#[test]
fn coarse_steps_are_in_the_errors() {
    let mut random = Random::new(12);
    for k in 0..36 {
        let steps = [10.0, 20.0, 40.0][k % 3];
        let (off, noise) = (random.within(0.0, 1.0), random.within(0.02, 0.25));
        let (ramp, exposure) = (random.within(3e-4, 1e-3), random.within(0.003, 0.007));
        let mut row = |t: f64| (steps * level(t, 0.005, ramp, exposure) + off + noise * random.normal()).round();
        let rows: String = (0..1000).map(|i| 2e-5 * f64::from(i)).map(|t| format!("{t:.5},{}\n", row(t))).collect();
        fitted(&format!("time_s,light\n{rows}"), None, exposure, 1e-3);
    }
}

/// Samples are missing behind a tail, so what was left of it is not known.
#[test]
fn a_gap_may_cut_a_tail() {
    let light = |t: f64| if t < 0.013 { level(t, 0.008, 5e-4, 1.0) } else { (-(t - 0.013) / 1.5e-3).exp() };
    let times = (0..5000).map(|i| 2e-5 * f64::from(i)).filter(|t| !(0.016..0.07).contains(t));
    let text = noisy(8, 0.003, times.map(|t| (format!("{t:.5}"), light(t))));
    let (_, _, codes) = fitted(&format!("time_s,light\n{text}"), None, 0.00625, 0.02);
    assert!(codes.contains(&"cut_tail"), "{codes:?}");
}

/// Blades scatter by some percent; a setting differs by more.
#[test]
fn shots_of_one_setting_scatter() {
    for (exposures, median, is_one) in [
        ([5.25, 5.41, 5.09, 5.33], 5.25, true),
        ([2.0, 2.05, 1.9, 2.08], 2.0, true),
        ([4.0, 4.0, 4.5, 4.0], 4.0, false),
    ] {
        let rows = (0..3200).map(|i| (i / 800, 0.05 * f64::from(i % 800)));
        let row = |(k, t)| (format!("{:.2}", 40.0 * f64::from(k) + t), level(t, 10.0, 0.8, exposures[k as usize]));
        let text = noisy(7, 0.004, rows.map(row));
        let (fit, _, codes) = fitted(&format!("t_ms,light\n{text}"), None, 1e-3 * median, 1e-5);
        assert_eq!((fit.frames.count, codes.contains(&"shots_differ")), (4, !is_one), "{exposures:?}");
    }
}

/// Traces without any noise: a logic analyser's, a gate's, a simulation's.
#[test]
fn without_noise_the_error_is_that_of_a_sample() {
    let step = 4e-6;
    // A box, or ramps of 1 ms: exposure, height, dark, samples.
    for (ramp, exposure, height, dark, n) in [
        (1e-9, 0.008, 1.0, 0.0, 2500),
        (1e-9, 0.003, -5.0, 1e-3, 2500),
        (1e-9, 40e-6, 1.0, 0.0, 500),
        (0.001, 0.007, 3.3, 0.1, 2500),
        (0.001, 0.007, 3.3, -1e-21, 2500),
    ] {
        let (is_box, times) = (ramp < step, (0..n).map(|i| step * f64::from(i)));
        let row = |t| format!("{t:.6},{}\n", height * level(t, 0.001, ramp, exposure) + dark);
        let text = format!("time_s,v\n{}", times.map(row).collect::<String>());
        let (fit, ..) = fitted(&text, None, exposure, step);
        // Two edges, each known to a sample by the root of 12; of ramps the foot leaves more of the length unknown.
        let efficiency = fit.efficiency.error / if is_box { step / exposure } else { 1e-3 };
        assert!(efficiency < 1.0 && (!is_box || fit.exposure.error > 0.3 * step), "{exposure}: {:?}", fit.exposure);
        let report = shutter_fit::text("logic", &fit);
        let is_dust = |word: &str| word.parse::<f64>().is_ok_and(|x| word.contains("e-") && x.abs() < 1e-8);
        let is_minus_zero = |word: &str| word.starts_with("-0") && word.parse::<f64>() == Ok(0.0);
        let mut words = report.split([' ', '\n', ',', ';', '(', ')']);
        assert!(!words.any(|word| is_dust(word) || is_minus_zero(word)), "{exposure}: {report}");
    }
}

#[test]
fn a_list_of_changes_is_read_as_light_and_as_sync() {
    let list = "Time [s],flash,light\n0,1,0\n0.5,0,0\n0.5031,0,1\n0.5093,0,0\n0.512,1,0\n\
        1.5,0,0\n1.5031,0,1\n1.5093,0,0\n1.513,1,0\n";
    let options = trace::Options { sync: Some("flash".into()), ..Default::default() };
    let recording = open(list.as_bytes(), &options).unwrap();
    assert_eq!(recording.warnings, [Warning::Changes]);
    let options = Options { sync: recording.sync.map(Sync::Channel), ..Options::default() };
    let fit = fit(&recording.trace, &options, &mut |_| ()).unwrap();
    assert_eq!((fit.frames.count, fit.chosen), (2, Kind::Box));
    assert!((fit.exposure.value - 0.0062).abs() < 1e-5, "{:?}", fit.exposure);
    assert!((fit.delay.unwrap().mean() - 0.0031).abs() < 1e-5);
    // A value may be unknown, the last row cut, the times those of days, in zones that change.
    for list in [
        "Time [s],Channel 0\n0.0,0\n0.7,1\n0.7625,0\n",
        "Time [s],A\n0,X\n0.7,1\n0.7625,0\n1,1\n1.0625,0\n2.7,1\n2.7625,0\n3.",
        "Time [s],A,B\n0,0,0\n0.6,0,1\n0.7,1,1\n0.73,1,0\n0.7625,0,0\n1.2",
        "Time [s],A\n0,0\n0.7,1\n0.7625,0\n1,1\n1.0625,X\n1.9,1\n1.9625,0\n2.7,1\n2.7625,0\n3.2,1\n3.2625,0\n0.",
        "t,A\n2025-12-31T23:59:59.9Z,0\n2026-01-01T01:00:00+01:00,1\n2025-12-31T18:30:00.062500000-0530,0\n",
    ] {
        assert_eq!(fitted(list, None, 0.0625, 1e-3).2[0], "changes", "{list}");
    }
    // A switch that was sampled is no list.
    let sampled = (0..60).map(|i| format!("{},{}\n", 0.1 * f64::from(i), i32::from((20..40).contains(&i))));
    let text = format!("t_s,A\n{}", sampled.collect::<String>());
    assert!(!fitted(&text, None, 2.0, 0.1).2.contains(&"changes"));
}

#[test]
fn columns_have_the_names_above_the_numbers() {
    let names = trace::columns(b"scope\nTime (ms);CH1\n0,5;1,25\n1,0;1,5\n1,5;2\n");
    assert_eq!(names, Ok(vec![Some("Time (ms)".into()), Some("CH1".into())]));
    assert!(trace::columns(b"<html>").is_err());
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
    let seed = asked("SEED", 77) << 32;
    each(asked("BROKEN_FILES", 120), |k| {
        let mut random = Random::new(seed + u64::from(k));
        let mut bytes = wholes[(k / 4) as usize % wholes.len()].clone();
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
        if let Ok(recording) = open(&bytes, &trace::Options::default()) {
            let _ = fit(&recording.trace, &Options::default(), &mut |_| ());
        }
    });
}
