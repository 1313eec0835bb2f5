//! `shutter fit --sync CH2`: the delay from the edges of a camera's sync, recorded beside the light, and its spread
//! between shots.

use serde_json::Value;

use crate::generator::Random;
use crate::support::{Folder, codes, number};

/// Opens from 0 to 1 ms and closes from 5 to 6.
fn openness(t: f64) -> f64 {
    t.min(0.006 - t).clamp(0.0, 0.001) / 0.001
}

/// A record of shots: light, and a sync.
struct Record {
    /// From each shot's edge to its opening.
    delays: Vec<f64>,
    hertz: f64,
    /// The sync's levels at rest and in a shot, and its noise.
    levels: [f64; 2],
    noise: f64,
    /// How long it stays switched, without a gap where its contact bounces.
    length: f64,
    bounces: bool,
    /// Does it bounce as it opens?
    reopens: bool,
    /// How long an edge takes; its middle counts.
    slow: f64,
    /// Shots without an edge.
    lost: Vec<usize>,
    /// Do the ramps begin and end softly, and in more noise, which hides when?
    soft: bool,
    seed: u64,
}

impl Record {
    /// So many shots, whose delay of 3 ms jitters by 20 µs.
    fn new(shots: usize, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let delays = (0..shots).map(|_| 0.003 + 20e-6 * random.normal()).collect();
        let (levels, noise, length) = ([3.3, 0.1], 0.2, 0.004);
        let (hertz, bounces, reopens, slow, lost) = (2e5, false, false, 1e-9, Vec::new());
        Self { delays, hertz, levels, noise, length, bounces, reopens, slow, lost, soft: false, seed }
    }

    fn mean(&self) -> f64 {
        self.delays.iter().sum::<f64>() / self.delays.len() as f64
    }

    fn spread(&self) -> f64 {
        let squares: f64 = self.delays.iter().map(|d| (d - self.mean()).powi(2)).sum();
        (squares / (self.delays.len() as f64 - 1.0)).sqrt()
    }

    /// A record of each shot alone, and the arguments that name them.
    fn apart(&self, folder: &Folder, seed: u64) -> String {
        let write = |(delay, k): (&f64, u64)| {
            let shot = Self { delays: vec![*delay], seed: seed + k, ..Self::new(1, 0) };
            let name = format!("{k}.csv ");
            folder.write(name.trim(), Self { soft: self.soft, ..shot }.csv());
            name
        };
        self.delays.iter().zip(0..).map(write).collect()
    }

    /// The mean and the spread of the delay, of all shots, are those that were put in.
    #[track_caller]
    fn is(&self, json: &Value, most: [f64; 2]) {
        assert_eq!(json["delay_shots"], self.delays.len(), "{json}");
        assert!((number(json, "delay_s") - self.mean()).abs() < most[0], "{json}");
        assert!((number(json, "delay_spread_s") - self.spread()).abs() < most[1], "{json}");
    }

    /// Time, light and sync. A shot every 24 ms.
    fn rows(&self) -> Vec<[f64; 3]> {
        let mut random = Random::new(self.seed + 1);
        // Where between two samples an edge comes is chance.
        let edges: Vec<f64> =
            (0..self.delays.len()).map(|k| 0.008 + 0.024 * k as f64 + random.within(0.0, 1.0) / self.hertz).collect();
        let samples = (0.024 * self.delays.len() as f64 * self.hertz) as usize;
        let row = |i: usize| {
            let t = i as f64 / self.hertz;
            let k = ((t / 0.024) as usize).min(edges.len() - 1);
            let since = t - edges[k];
            let open = openness(since - self.delays[k]);
            let open = if self.soft { open * open * (3.0 - 2.0 * open) } else { open };
            let bounces = self.bounces && (2e-4..5e-4).contains(&since)
                || self.reopens && (since + 4e-4..since + 7e-4).contains(&self.length);
            let is_off = bounces || self.lost.contains(&k);
            let on = 0.5 + since.min(self.length - since) / self.slow;
            let on = if is_off { 0.0 } else { on.clamp(0.0, 1.0) };
            let level = self.levels[0] + on * (self.levels[1] - self.levels[0]);
            let noise = if self.soft { 0.05 } else { 0.01 };
            [t, 0.1 + 2.0 * open + noise * random.normal(), level + self.noise * random.normal()]
        };
        (0..samples).map(row).collect()
    }

    fn csv(&self) -> String {
        self.rewritten(|row| row)
    }

    /// The file with other rows.
    fn rewritten(&self, row: impl Fn([f64; 3]) -> [f64; 3]) -> String {
        let line = |[t, light, sync]: [f64; 3]| format!("{t:.7},{light:.4},{sync:.4}\n");
        let lines = self.rows().into_iter().map(|it| line(row(it)));
        String::from("Time (s),CH1,CH2\n") + &lines.collect::<String>()
    }
}

/// Whatever the sync looks like: the mean, the spread and the worst are those that were put in.
#[test]
fn the_spread_is_what_was_put_in() {
    let folder = Folder::new("spread");
    for seed in 0..2 {
        let plain = || Record::new(5, 7 + seed);
        let [up, down] = [[0.0, 5.0], [3.3, 0.1]];
        for (i, (record, doubts)) in [
            (plain(), vec![]),
            (Record { levels: up, noise: 0.4, length: 0.02, ..plain() }, vec![]),
            // Short: 20 samples of 24 000, and the noise is split before these are.
            (Record { levels: down, noise: 0.05, length: 1e-4, ..plain() }, vec![]),
            (Record { bounces: true, ..plain() }, vec!["sync_bounced"]),
            (Record { noise: 0.0, ..plain() }, vec![]),
        ]
        .into_iter()
        .enumerate()
        {
            folder.write("five.csv", record.csv());
            let json = folder.json("five.csv --sync CH2");
            let put_in = |key: &str, value: f64| {
                let off = number(&json, key) - value;
                assert!(off.abs() < 3e-6, "record {i} of {seed}: {key} is off by {off}");
            };
            let off = |shot: &f64| (shot - record.mean()).abs();
            record.is(&json, [3e-6; 2]);
            put_in("delay_worst_s", record.delays.iter().map(off).fold(0.0, f64::max));
            // The spread is a part of what is behind ±.
            assert!(number(&json, "delay_error_s") >= number(&json, "delay_spread_s"));
            assert!(number(&json, "delay_trigger_error_s") >= number(&json, "delay_spread_s"));
            assert_eq!(codes(&json), doubts);
            assert_eq!(json["columns"]["sync_name"], "CH2");
        }
    }
}

/// Where no model explains a shutter, its own triggers still count from the edge: no misfit is in the delay.
#[test]
fn a_shot_of_its_own_is_not_shifted_by_its_misfit() {
    let folder = Folder::new("misfit");
    let record = Record { hertz: 1e6, ..Record::new(1, 5) };
    // With a rest on the ramp, and dimmed for a while in the middle.
    let row = |[t, light, sync]: [f64; 3]| {
        let x = 0.5 * (light - 0.1);
        let open = (1.5 * x).min(0.45).max(0.45 + 0.55 * (x - 0.7) / 0.3);
        let part = if (0.0135..0.015).contains(&t) { 0.7 } else { 1.0 };
        [t, 0.1 + 2.0 * part * open, sync]
    };
    folder.write("odd.csv", record.rewritten(row));
    let json = folder.json("odd.csv --sync CH2");
    assert_eq!(json["triggers_from"], "trace", "{json}");
    let edge = number(&json, "opens_s") - number(&json, "delay_s");
    assert!((edge - 0.008).abs() < 2e-6, "{edge}");
    // Nor does it count as a spread of files, of which each fit misses the ramp in its own way.
    let all = Record::new(3, 0);
    for (k, delay) in all.delays.iter().enumerate() {
        let shot = Record { delays: vec![*delay], seed: k as u64, ..Record::new(1, 0) };
        folder.write(&format!("{k}.csv"), shot.rewritten(row));
    }
    let json = folder.json("0.csv 1.csv 2.csv --sync CH2 --nominal 5ms,5ms,5ms");
    assert!((number(&json[0], "delay_spread_s") - all.spread()).abs() < 3e-6, "{json}");
}

/// A contact bounces as it closes or as it opens, and the warning says for how long a firmware has to take no other
/// edge.
#[test]
fn a_bounce_is_told_with_its_end() {
    let folder = Folder::new("bounce");
    let plain = || Record { length: 0.012, ..Record::new(3, 11) };
    for (record, last) in [
        (Record { bounces: true, ..plain() }, "some 500 µs after the first"),
        (Record { reopens: true, ..plain() }, "some 12 ms after the first"),
    ] {
        folder.write("three.csv", record.csv());
        folder.run("fit three.csv --sync CH2 --out b.toml").tells(&["at 3 of 3 shots", last]);
        // And so do the scene, and with it the module.
        let settles = folder.text("b.toml").lines().find_map(|line| line.strip_prefix("sync_settles = ")?.parse().ok());
        let ends: f64 = if last.contains("500 µs") { 0.5 } else { 12.0 };
        assert!((1.05..1.2).contains(&(settles.unwrap_or(0.0) / ends)), "{settles:?}");
    }
}

/// In a record of one shot that begins while the contact is still closed, its release looks like an edge that bounces.
#[test]
fn a_contact_that_is_still_closed_is_told() {
    let (folder, record) = (Folder::new("held"), Record { length: 0.006, ..Record::new(1, 11) });
    let on = record.levels[1];
    folder.write("held.csv", record.rewritten(|[t, light, sync]| [t, light, if t < 0.003 { on } else { sync }]));
    folder.run("fit held.csv --sync CH2").tells(&["still closed", "(--from and --to)"]);
    let json = folder.json("held.csv --sync CH2 --from 4ms");
    assert!(codes(&json).is_empty(), "{json}");
    assert!((number(&json, "delay_s") - record.mean()).abs() < 3e-6, "{json}");
    folder.write("bounces.csv", Record { bounces: true, ..record }.csv());
    let bounces = folder.json("bounces.csv --sync CH2");
    assert!(codes(&bounces) == ["sync_bounced"] && !bounces.to_string().contains("still closed"), "{bounces}");
}

/// The level at the beginning need not be the one at rest.
#[test]
fn a_record_may_begin_in_the_middle_of_a_shot() {
    let folder = Folder::new("middle");
    let record = Record { length: 0.01, ..Record::new(5, 5) };
    let text = record.csv();
    let (names, rows) = text.split_once('\n').unwrap();
    // The light of the first shot is over at 17 ms, and its sync at 18 ms.
    let later: Vec<&str> = rows.lines().skip(3_420).collect();
    folder.write("a.csv", format!("{names}\n{}\n", later.join("\n")));
    let json = folder.json("a.csv --sync CH2");
    let four = Record { delays: record.delays[1..].to_vec(), ..record };
    assert!(codes(&json).is_empty(), "{json}");
    four.is(&json, [3e-6; 2]);
}

/// A record of five shots, and one of one, of which session.txt has what is told.
pub fn shots() -> [String; 2] {
    [Record { noise: 0.0, ..Record::new(5, 3) }.csv(), Record::new(1, 4).csv()]
}

/// Shots in files of their own count together if they are of one speed.
#[test]
fn the_shots_of_several_files_count_together() {
    let folder = Folder::new("files");
    // With soft ramps the fits' own starts differ by more than the spread may be off.
    for soft in [true, false] {
        let all = Record { soft, ..Record::new(4, 21) };
        let args = all.apart(&folder, 40);
        if soft {
            let json = folder.json(&format!("{args}--sync CH2 --nominal 5ms,5ms,5ms,5ms"));
            let one = |fit: &Value| all.is(fit, [number(fit, "delay_error_s"), 3e-6]);
            json.as_array().unwrap().iter().for_each(one);
            continue;
        }
        // Of another speed, and far later.
        let slow = Record::new(1, 50).rewritten(|[t, light, sync]| [2.0 * t, light, sync]);
        folder.write("slow.csv", slow);
        // Of the other edge.
        folder.write("rises.csv", Record { levels: [0.1, 3.3], ..Record::new(1, 60) }.csv());
        let json = folder.json(&format!("{args}slow.csv rises.csv --sync CH2"));
        for fit in &json.as_array().unwrap()[..4] {
            all.is(fit, [10e-6, 3e-6]);
        }
        for fit in [&json[4], &json[5]] {
            assert_eq!((&fit["delay_shots"], &fit["delay_spread_s"]), (&1.into(), &Value::Null));
        }
        let run = folder.run(&format!("fit {args}slow.csv --sync CH2"));
        run.prints(&["\ntrace ", "  spread  worst\n"]);
    }
}

/// Files of one setting are as good as one record of all their shots: they make one scene, with one delay.
#[test]
fn shots_in_files_of_their_own_make_one_scene() {
    let folder = Folder::new("shots");
    let all = Record::new(5, 21);
    let names = all.apart(&folder, 40);
    let json = folder.json(&format!("{names}--sync CH2"));
    assert_eq!(json["pulses"], 5);
    all.is(&json, [10e-6, 3e-6]);
    folder
        .run(&format!("fit {names}--sync CH2 --out leaf.toml --nominal 5ms"))
        .prints(&[" of 5; the exposures scatter by "]);
    let scene = folder.text("leaf.toml");
    assert!(scene.contains(", of 5 files\"\n") && scene.contains("\nnominal = 5.0\n"), "{scene}");
    // The edge may have triggered each record: then it is at one time in all.
    let write = |name: &str, delay: f64, seed, channel: &str| {
        let rows = Record { delays: vec![delay], seed, ..Record::new(1, 0) }.rows();
        // A shot's edge comes within the sample after 8 ms.
        let row = |[t, light, _]: [f64; 3]| format!("{:.7},{light:.4}\n", t - 0.0080025);
        let rows: String = rows.into_iter().map(row).collect();
        folder.write(name, format!("Time (s),{channel}\n{rows}"));
    };
    write("a.csv", 0.003, 60, "CH1");
    write("b.csv", 0.0031, 61, "CH1");
    let two = Record { delays: vec![0.003, 0.0031], ..Record::new(2, 0) };
    two.is(&folder.json("a.csv b.csv --sync 0"), [5e-6; 2]);
    // What is not one setting, or read otherwise, is none.
    write("ms.csv", 0.003, 63, "CH7");
    write("copy.csv", 0.003, 60, "CH1");
    folder.refuses(&[
        // One shot, counted twice, would have no spread.
        ("fit a.csv b.csv ./a.csv --sync 0", "a.csv: it is given twice"),
        ("fit a.csv b.csv --sync copy.csv --sync copy.csv", "copy.csv: it is given twice"),
        ("fit a.csv b.csv copy.csv --sync 0", "a.csv once more, and no other shot"),
        ("fit a.csv b.csv --out speeds", "make one scene: name it SCENE.toml, or give each trace its speed"),
        ("fit a.csv ms.csv", "shots of one setting are read alike, and this is column 2 of 2, \"CH7\""),
    ]);
    let out = folder.run("fit a.csv b.csv --nominal 4ms,5ms").well().out;
    assert!(out.starts_with("trace "), "{out}");
}

/// A scope that writes a file a channel: the sync's is as good as a column, and has to be of the same record.
#[test]
fn a_sync_may_have_a_file_of_its_own() {
    let folder = Folder::new("channels");
    let record = Record::new(3, 7);
    let write = |name: &str, channel: &str, column: usize, late: f64, skipped: usize| {
        let row = |row: &[f64; 3]| format!("{:.7},{:.4}\n", row[0] + late, row[column]);
        let rows: String = record.rows()[skipped..].iter().map(row).collect();
        folder.write(name, format!("Time (s),{channel}\n{rows}"));
    };
    folder.write("both.csv", record.csv());
    write("1.csv", "CH1", 1, 0.0, 0);
    write("2.csv", "CH2", 2, 0.0, 0);
    write("fewer.csv", "CH2", 2, 0.0, 1);
    write("later.csv", "CH2", 2, 2.5e-6, 0);
    let two = record.rewritten(|[t, light, _]| [t, light, light]);
    folder.write("two.csv", two.replace("CH1,CH2", "CH1,CH1"));
    let one = folder.json("both.csv --sync CH2");
    let two = folder.json("1.csv --columns CH1 --sync 2.csv");
    for key in ["delay_s", "delay_spread_s", "exposure_s", "sync_threshold"] {
        assert!((number(&one, key) - number(&two, key)).abs() < 1e-3 * number(&one, key), "{key}");
    }
    assert_eq!(two["columns"]["sync_name"], "CH2 of 2.csv");
    // A logic analyser lists the changes alone.
    let mut changes = record.rows();
    changes.dedup_by_key(|row| row[2] > 1.6);
    let changes = changes.iter().map(|row| format!("{:.7},{}\n", row[0], u8::from(row[2] > 1.6)));
    folder.write("changes.csv", format!("Time [s],D0\n{}", changes.collect::<String>()));
    let three = folder.json("1.csv --sync changes.csv");
    assert!((number(&one, "delay_s") - number(&three, "delay_s")).abs() < 5e-6, "{three}");
    assert!(codes(&three).contains(&"changes"), "{three}");
    let other = "fewer.csv: it is no channel of the same record: 14399 samples, and the light has 14400";
    folder.refuses(&[
        ("fit 1.csv --sync fewer.csv", other),
        ("fit 1.csv --sync later.csv", "sample 1 is at 0.0000025 s, the light's at 0 s"),
        ("fit 1.csv --sync two.csv", "two.csv: a sync's file has one signal"),
        ("fit 1.csv --sync 1.csv", "is it the light's?"),
        ("fit 1.csv both.csv --sync 2.csv", "--sync: each trace has a file of its own"),
        ("fit 1.csv --sync none.csv", "no column"),
    ]);
}

/// A sound has its sync on the other channel; with one channel alone it has none.
#[test]
fn a_stereo_sound_has_a_sync() {
    let folder = Folder::new("sound");
    let record = Record { hertz: 48e3, levels: [0.9, 0.0], noise: 0.02, ..Record::new(5, 8) };
    for (name, channels) in [("two.wav", 2), ("one.wav", 1)] {
        let whole = |x: f64| ((0.9 * 32767.0 * x) as i16).to_le_bytes();
        let rows = record.rows();
        let data: Vec<u8> =
            rows.iter().flat_map(|[_, light, sync]| [whole(light / 3.0), whole(*sync)][..channels].concat()).collect();
        let mut bytes = b"RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x01\0".to_vec();
        bytes.extend((channels as u16).to_le_bytes());
        bytes.extend(48_000u32.to_le_bytes());
        bytes.extend((96_000 * channels as u32).to_le_bytes());
        bytes.extend((2 * channels as u16).to_le_bytes());
        bytes.extend(b"\x10\0data");
        bytes.extend((data.len() as u32).to_le_bytes());
        folder.write(name, [bytes, data].concat());
    }
    let json = folder.json("two.wav --sync 2");
    // Each edge is known to a sample by the root of 12, 6 µs.
    assert!((number(&json, "delay_spread_s") - record.spread()).abs() < 9e-6, "{json}");
    assert_eq!((&json["columns"]["signal"], &json["columns"]["sync"]), (&1.into(), &2.into()));
    folder.refuses(&[
        ("fit two.wav --columns 1 --sync 1", "no delay: column 1 is the signal's"),
        ("fit one.wav --sync 1", "no delay: its channel is the signal's"),
        ("fit one.wav --sync 2", "no delay: there is no column '2'"),
    ]);
}

#[test]
fn what_is_no_sync_is_refused() {
    let folder = Folder::new("no_sync");
    let plain = || Record::new(3, 1);
    let refused = |text: String, reason| {
        folder.write("a.csv", text);
        folder.refuses(&[("fit a.csv --sync CH2", reason)]);
    };
    folder.write("a.csv", plain().csv());
    folder.refuses(&[
        ("fit a.csv --sync CH3", "there is no column 'CH3'; there are 3: Time (s), CH1, CH2"),
        ("fit a.csv --sync 1", "column 1, \"Time (s)\" holds times"),
        ("fit a.csv --sync CH1 --columns 1,2", "column 2, \"CH1\" is the signal's"),
        // Then the sync is taken for the light.
        ("fit a.csv --sync CH1 --light down", "as slowly as light does; is it the light's?"),
    ]);
    let lost = || Record { lost: vec![0, 1, 2], ..plain() };
    refused(lost().csv(), "never switches: its levels are 1.");
    refused(Record { noise: 0.0, ..lost() }.csv(), "its column never switches");
    let noisy = Record { noise: 1.0, ..plain() };
    refused(noisy.csv(), "times the noise apart, and 8 are required");
    // A clock, and a slope.
    let clock = |[t, light, _]: [f64; 3]| [t, light, f64::from((t * 500.0).fract() < 0.5)];
    refused(plain().rewritten(clock), "its column switches ");
    let slope = |t: f64| 1e3 * (t * 10.0).fract().min(1.0 - (t * 10.0).fract());
    refused(plain().rewritten(|[t, light, _]| [t, light, slope(t)]), "no two levels");
}

#[test]
fn what_is_doubtful_about_a_sync_is_told() {
    let folder = Folder::new("doubts");
    let fitted = |text: String| {
        folder.write("a.csv", text);
        folder.json("a.csv --sync CH2")
    };
    // One of four shots without an edge; one edge without a shot, since the record ends before that.
    let cut: Vec<_> = Record::new(4, 2).csv().lines().take(16_400).map(String::from).collect();
    for (text, code) in
        [(Record { lost: vec![1], ..Record::new(4, 2) }.csv(), "sync_missing"), (cut.join("\n"), "sync_others")]
    {
        let json = fitted(text);
        assert_eq!((&json["delay_shots"], codes(&json)), (&3.into(), vec![code]));
    }

    // An edge as a contact makes it that closes when the shutter is open.
    let late = Record { delays: vec![-1.1e-3, -1.12e-3, -1.09e-3], ..Record::new(3, 2) };
    let json = fitted(late.csv());
    assert_eq!(codes(&json), ["sync_late"]);
    assert!((number(&json, "delay_s") - late.mean()).abs() < 3e-6);
    folder.run("fit a.csv --sync CH2").tells(&["in 3 of 3 shots, by up to 1.1 ms"]).prints(&["\ndelay = -1.10"]);

    // One threshold would switch many times in an edge as slow as this one.
    let slow = Record { slow: 2e-4, noise: 0.3, ..Record::new(5, 2) };
    let json = fitted(slow.csv());
    let off = (number(&json, "delay_s") - slow.mean()).abs();
    assert!(codes(&json).is_empty() && off < number(&json, "delay_trigger_error_s"), "{json}");

    // Sampled so coarsely that an edge is known to 58 µs.
    let json = fitted(Record { hertz: 5e3, noise: 0.0, ..Record::new(8, 2) }.csv());
    assert!(number(&json, "delay_trigger_error_s") > 2e-4 / 12f64.sqrt(), "{json}");
    folder.run("fit a.csv --sync CH2").prints(&["\n             each is measured to ± 0.0"]);
}
