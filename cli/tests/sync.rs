//! `shutter fit --sync CH2`: the delay from the edges of a camera's sync, recorded beside the light, and its spread between shots.

#[allow(dead_code)]
#[path = "../../fit/tests/generator/mod.rs"]
mod generator;

use std::fs;
use std::path::{Path, PathBuf};

use generator::Random;
use serde_json::Value;

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
        let (hertz, bounces, slow, lost, soft) = (2e5, false, 1e-9, Vec::new(), false);
        let reopens = false;
        Self { delays, hertz, levels, noise, length, bounces, reopens, slow, lost, soft, seed }
    }

    fn mean(&self) -> f64 {
        self.delays.iter().sum::<f64>() / self.delays.len() as f64
    }

    fn spread(&self) -> f64 {
        let squares: f64 = self.delays.iter().map(|d| (d - self.mean()).powi(2)).sum();
        (squares / (self.delays.len() as f64 - 1.0)).sqrt()
    }

    /// Time, light and sync. A shot every 24 ms.
    fn rows(&self) -> Vec<[f64; 3]> {
        let mut random = Random::new(self.seed + 1);
        // Where between two samples an edge comes is chance.
        let edges: Vec<f64> = (0..self.delays.len())
            .map(|k| 0.008 + 0.024 * k as f64 + random.within(0.0, 1.0) / self.hertz)
            .collect();
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
        let row = |[t, light, sync]: [f64; 3]| format!("{t:.7},{light:.4},{sync:.3}\n");
        String::from("Time (s),CH1,CH2\n") + &self.rows().into_iter().map(row).collect::<String>()
    }
}

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sync").join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.0.join(name), bytes).unwrap();
    }

    /// The code, and both outputs; what ends like a file's name is a file of the folder.
    fn run(&self, args: &str) -> (i32, String, String) {
        let is_file =
            |arg: &str| [".csv", ".toml", ".wav", ".rs"].iter().any(|end| arg.ends_with(end));
        let path = |arg: &str| self.0.join(arg).to_str().unwrap().to_string();
        let args = args.split(' ').map(|arg| if is_file(arg) { path(arg) } else { arg.into() });
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let args = std::iter::once("shutter".to_string()).chain(args);
        let code = shutter::command::run(args.map(Into::into), &mut out, &mut err);
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (code.into(), text(out), text(err))
    }
}

impl Folder {
    /// The fit of a record as JSON.
    fn json(&self, args: &str) -> Value {
        let (code, out, err) = self.run(&format!("fit {args} --report json"));
        assert_eq!(code, 0, "{err}");
        serde_json::from_str(&out).unwrap()
    }

    fn refuses(&self, args: &str, reason: &str) {
        let (code, out, err) = self.run(&format!("fit {args}"));
        assert!(code == 2 && out.is_empty() && err.contains(reason), "{args}: {err}{out}");
    }
}

fn number(json: &Value, key: &str) -> f64 {
    json[key].as_f64().unwrap_or_else(|| panic!("{key} of {json}"))
}

fn codes(json: &Value) -> Vec<&str> {
    json["warnings"].as_array().unwrap().iter().map(|it| it["code"].as_str().unwrap()).collect()
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
            put_in("delay_s", record.mean());
            put_in("delay_spread_s", record.spread());
            put_in("delay_worst_s", record.delays.iter().map(off).fold(0.0, f64::max));
            // The spread is a part of what is behind ±.
            assert!(number(&json, "delay_error_s") >= number(&json, "delay_spread_s"));
            assert!(number(&json, "delay_trigger_error_s") >= number(&json, "delay_spread_s"));
            assert_eq!((json["delay_shots"].as_u64(), codes(&json)), (Some(5), doubts));
            assert_eq!(json["columns"]["sync_name"], "CH2");
        }
    }
}

/// A contact bounces as it closes or as it opens, and the warning says for how long a firmware has to take no other edge.
#[test]
fn a_bounce_is_told_with_its_end() {
    let folder = Folder::new("bounce");
    let plain = || Record { length: 0.012, ..Record::new(3, 11) };
    for (record, last) in [
        (Record { bounces: true, ..plain() }, "some 500 µs after the first"),
        (Record { reopens: true, ..plain() }, "some 12 ms after the first"),
    ] {
        folder.write("three.csv", record.csv());
        let (code, _, err) = folder.run("fit three.csv --sync CH2");
        assert!(code == 0 && err.contains("at 3 of 3 shots") && err.contains(last), "{err}");
    }
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
    assert_eq!((&json["delay_shots"], codes(&json)), (&4.into(), vec![]));
    assert!((number(&json, "delay_s") - four.mean()).abs() < 3e-6, "{json}");
    assert!((number(&json, "delay_spread_s") - four.spread()).abs() < 3e-6, "{json}");
}

/// What is found is said, in the report as in the scene, which `plan` takes and a new fit keeps.
#[test]
fn the_spread_is_told_and_kept() {
    let folder = Folder::new("told");
    let record = Record { noise: 0.0, ..Record::new(5, 3) };
    folder.write("five.csv", record.csv());
    let (code, out, err) = folder.run("fit five.csv --sync CH2 --out leaf.toml --triggers 4");
    assert_eq!((code, err.contains("warning")), (0, false), "{err}");
    let spread = format!("{:.2}", 1e3 * record.spread());
    for line in [
        "sync         column 3 of 3, \"CH2\"",
        "             falls from 3.3 to 0.1; an edge counts at 1.7",
        &format!("spread       {spread}"),
    ] {
        assert!(out.lines().any(|it| it.starts_with(line)), "{line}\n{out}");
    }
    let is_its = |line: &&str| ["sync ", "delay ", "spread "].iter().any(|it| line.starts_with(it));
    assert!(out.lines().filter(is_its).all(|line| line.chars().count() <= 80), "{out}");
    let json = folder.json("five.csv --sync CH2");
    assert_eq!(json["sync_falls"], true);
    assert!((number(&json, "sync_threshold") - 1.7).abs() < 0.01);
    let scene = || fs::read_to_string(folder.0.join("leaf.toml")).unwrap();
    let first = scene();
    assert!(first.contains(&format!("\ndelay_spread = {spread}")), "{first}");
    assert!(
        first.contains("\n# Sync: it falls from 3.3 to 0.1; an edge counts at 1.7.\n"),
        "{first}"
    );

    let (_, out, _) = folder.run("plan leaf.toml --min-gap 100us");
    let told = out.lines().find(|line| line.starts_with("spread ")).unwrap();
    // The spread is some 20 µs, a share 1.25 ms and the gap 0.1 ms.
    let percent = |of: f64| 100.0 * record.spread() / of;
    let said: Vec<f64> =
        told.split(" %").filter_map(|it| it.rsplit(' ').next()?.parse().ok()).collect();
    assert!(
        (said[0] - percent(1.25e-3)).abs() < 0.3 && (said[1] - percent(1e-4)).abs() < 4.0,
        "{told}"
    );
    let (_, written) = first.split_once("\ndelay_spread = ").unwrap();
    let written: f64 = written.lines().next().unwrap().parse().unwrap();
    let most = (0.01 * 5.0 / written) as u32;
    assert!(told.contains(&format!("up to {most} trigger")), "{told}");
    let (_, json, _) = folder.run("plan leaf.toml --emit json --set-up in_path --timer-hz 1MHz");
    let json: Value = serde_json::from_str(&json).unwrap();
    assert!((number(&json, "delay_spread_s") - record.spread()).abs() < 3e-6);
    assert_eq!((&json["sync_falls"], &json["set_up"]), (&true.into(), &"in_path".into()));

    // A fit by the same leaves all as it is, one without a sync keeps what is known, and one shot replaces the delay alone.
    folder.run("fit five.csv --sync CH2 --out leaf.toml");
    assert_eq!(scene(), first);
    // An edge that its user has changed is measured again, and that is said.
    fs::write(folder.0.join("leaf.toml"), first.replace("sync_falls = true", "sync_falls = false"))
        .unwrap();
    let (_, _, err) = folder.run("fit five.csv --sync CH2 --out leaf.toml");
    assert!(err.contains("leaf.toml: sync_falls was false, and the trace says true\n"), "{err}");
    assert_eq!(scene(), first);
    // So is an option that contradicts what was measured.
    let plan = "plan leaf.toml --timer-hz 1MHz --emit rust";
    let (code, out, err) = folder.run(&format!("{plan} --set-up emulated --sync-falls false"));
    assert!(code == 0 && out.contains("pub const SYNC_FALLS: bool = false;"), "{out}");
    assert!(
        err.contains("leaf.toml has sync_falls = true, and --sync-falls false counts"),
        "{err}"
    );
    for agrees in ["", " --sync-falls true"] {
        assert_eq!(folder.run(&format!("{plan} --set-up emulated{agrees}")).2, "");
    }
    // So is what the shutter leaves of flashes that nothing makes equal.
    let (_, _, err) = folder.run(&format!("{plan} --set-up in_path --triggers 16"));
    assert!(err.contains("warning: leaf: the shutter is in the light's path"), "{err}");
    assert_eq!(folder.run(&format!("{plan} --set-up in_path --fully-open")).2, "");
    // And what a coarse timer does to triggers, and leaves of equal doses. A share of 5 ms / 8 has 6.25 ticks of 10 kHz.
    let flashes =
        "plan leaf.toml --set-up emulated --triggers 8 --min-gap 0 --emit rust --timer-hz";
    let (_, out, err) = folder.run(&format!("{flashes} 10kHz"));
    assert!(err.contains("flashes move by up to 8 % of a share"), "{err}");
    assert!(out.contains("\n// rounding     moves flashes by up to 8 % of a share\n"), "{out}");
    let (_, out, err) = folder.run(&format!("{flashes} 1MHz"));
    assert!(err.is_empty() && !out.contains("rounding"), "{err}{out}");
    let pulses = "plan leaf.toml --set-up in_path --duty 0.5 --triggers 16 --emit rust --timer-hz";
    let (_, out, err) = folder.run(&format!("{pulses} 20kHz"));
    assert!(
        err.contains("warning: leaf: a tick is so long that the doses differ by up to "),
        "{err}"
    );
    assert!(
        !out.contains("of equal doses") && out.contains("of doses that differ by up to "),
        "{out}"
    );
    let (_, out, err) = folder.run(&format!("{pulses} 10MHz"));
    assert!(err.is_empty() && out.contains(", of equal doses\n"), "{err}{out}");
    let (_, _, err) = folder.run("fit five.csv --out leaf.toml");
    assert!(err.contains("kept delay = 3.0") && err.contains("delay_spread = 0.0"), "{err}");
    folder.write("one.csv", Record::new(1, 4).csv());
    let (_, out, err) = folder.run("fit one.csv --sync CH2 --out leaf.toml");
    assert!(
        out.contains("\nspread       unknown: one shot does not tell how shots differ\n"),
        "{out}"
    );
    assert!(
        err.contains("kept delay_spread = 0.0") && scene().contains("one shot tells no spread"),
        "{err}"
    );

    folder.write("wrong.toml", first.replace("\ndelay = ", "\n# "));
    let (code, _, err) = folder.run("plan wrong.toml");
    assert!(code == 2 && err.contains("delay_spread: 0 or more is required, and a delay"), "{err}");
}

/// Shots in files of their own count together if they are of one speed.
#[test]
fn the_shots_of_several_files_count_together() {
    let folder = Folder::new("files");
    let all = Record::new(4, 21);
    // With soft ramps the fits' own starts differ by more than the spread may be off.
    for soft in [false, true] {
        let mut args = String::new();
        for (k, delay) in all.delays.iter().enumerate() {
            let seed = 40 + k as u64;
            let one = Record { delays: vec![*delay], seed, soft, ..Record::new(1, 0) };
            folder.write(&format!("{k}.csv"), one.csv());
            args += &format!("{k}.csv ");
        }
        // Of another speed, and far later.
        let slow =
            Record::new(1, 50).rows().into_iter().map(|[t, light, sync]| [2.0 * t, light, sync]);
        let row = |[t, light, sync]: [f64; 3]| format!("{t:.7},{light:.4},{sync:.3}\n");
        folder.write(
            "slow.csv",
            String::from("Time (s),CH1,CH2\n") + &slow.map(row).collect::<String>(),
        );
        // Of the other edge.
        let rises = Record { levels: [0.1, 3.3], soft, ..Record::new(1, 60) };
        folder.write("rises.csv", rises.csv());
        let json = folder.json(&format!("{args}slow.csv rises.csv --sync CH2"));
        for fit in &json.as_array().unwrap()[..4] {
            assert_eq!(fit["delay_shots"], 4);
            let off = (number(fit, "delay_s") - all.mean()).abs();
            assert!(off < if soft { number(fit, "delay_error_s") } else { 10e-6 }, "{fit}");
            let off = (number(fit, "delay_spread_s") - all.spread()).abs();
            assert!(off < 3e-6, "{fit}");
        }
        for fit in [&json[4], &json[5]] {
            assert_eq!((&fit["delay_shots"], &fit["delay_spread_s"]), (&1.into(), &Value::Null));
        }
        let (_, out, _) = folder.run(&format!("fit {args}slow.csv --sync CH2"));
        assert!(out.contains("\ntrace ") && out.contains("  spread  worst\n"), "{out}");
    }
}

/// Files of one setting are as good as one record of all their shots: they make one scene, with one delay.
#[test]
fn shots_in_files_of_their_own_make_one_scene() {
    let folder = Folder::new("shots");
    let all = Record::new(5, 21);
    let mut names = String::new();
    for (k, delay) in all.delays.iter().enumerate() {
        let one = Record { delays: vec![*delay], seed: 40 + k as u64, ..Record::new(1, 0) };
        folder.write(&format!("{k}.csv"), one.csv());
        names += &format!("{k}.csv ");
    }
    let json = folder.json(&format!("{names}--sync CH2"));
    assert_eq!((&json["delay_shots"], &json["pulses"]), (&5.into(), &5.into()));
    assert!((number(&json, "delay_s") - all.mean()).abs() < 10e-6, "{json}");
    assert!((number(&json, "delay_spread_s") - all.spread()).abs() < 3e-6, "{json}");
    let (code, out, err) =
        folder.run(&format!("fit {names}--sync CH2 --out leaf.toml --nominal 5ms"));
    assert!(code == 0 && out.contains(" of 5; the exposures scatter by "), "{out}{err}");
    let scene = fs::read_to_string(folder.0.join("leaf.toml")).unwrap();
    assert!(scene.contains(", of 5 files: ") && scene.contains("\nnominal = 5\n"), "{scene}");
    // The edge may have triggered each record: then it is at one time in all.
    let record = |delay: f64, seed| {
        let rows = Record { delays: vec![delay], seed, ..Record::new(1, 0) }.rows();
        // A shot's edge comes within the sample after 8 ms.
        let row = |[t, light, _]: [f64; 3]| format!("{:.7},{light:.4}\n", t - 0.0080025);
        String::from("Time (s),CH1\n") + &rows.into_iter().map(row).collect::<String>()
    };
    folder.write("a.csv", record(0.003, 60));
    folder.write("b.csv", record(0.0031, 61));
    let json = folder.json("a.csv b.csv --sync 0");
    assert!((number(&json, "delay_s") - 0.00305).abs() < 5e-6, "{json}");
    assert!((number(&json, "delay_spread_s") - 1e-4 / 2f64.sqrt()).abs() < 5e-6, "{json}");
    // What is not one setting, or read otherwise, is none.
    folder.write("late.csv", record(-0.001, 62));
    folder.write("ms.csv", record(0.003, 63).replace("Time (s),CH1", "Time (s),CH7"));
    folder.write("copy.csv", record(0.003, 60));
    for (args, reason) in [
        // One shot, counted twice, would have no spread.
        ("a.csv b.csv ./a.csv --sync 0", "./a.csv: it is given twice"),
        ("a.csv b.csv --sync copy.csv --sync copy.csv", "copy.csv: it is given twice"),
        ("a.csv b.csv copy.csv --sync 0", "a.csv once more, and no other shot"),
        (
            "a.csv b.csv --out speeds",
            "make one scene: name it SCENE.toml, or give each trace its speed",
        ),
        ("a.csv ms.csv", "shots of one setting are read alike, and this is column 2 of 2, \"CH7\""),
        ("a.csv late.csv --sync 0", "before the edge of the sync"),
    ] {
        let (code, _, err) = folder.run(&format!("fit {args}"));
        assert!(code == 2 && err.contains(reason), "{args}: {err}");
    }
    let (code, out, _) = folder.run("fit a.csv b.csv --nominal 4ms,5ms");
    assert!(code == 0 && out.starts_with("trace "), "{out}");
}

/// A scope that writes a file a channel: the sync's is as good as a column, and has to be of the same record.
#[test]
fn a_sync_may_have_a_file_of_its_own() {
    let folder = Folder::new("channels");
    let record = Record::new(3, 7);
    let channel = |name: &str, column: usize, rows: &[[f64; 3]]| {
        let row = |row: &[f64; 3]| format!("{:.7},{:.4}\n", row[0], row[column]);
        format!("Time (s),{name}\n") + &rows.iter().map(row).collect::<String>()
    };
    let mut rows = record.rows();
    folder.write("both.csv", record.csv());
    folder.write("1.csv", channel("CH1", 1, &rows));
    folder.write("2.csv", channel("CH2", 2, &rows));
    let two = record.csv().replace("CH1,CH2", "CH1,CH1");
    let two = two.lines().map(|row| match row.split(',').collect::<Vec<_>>()[..] {
        [time, light, _] => format!("{time},{light},{light}\n"),
        _ => unreachable!("three columns"),
    });
    folder.write("two.csv", two.collect::<String>());
    folder.write("fewer.csv", channel("CH2", 2, &rows[1..]));
    rows.iter_mut().for_each(|row| row[0] += 2.5e-6);
    folder.write("later.csv", channel("CH2", 2, &rows));
    let other = folder.0.join("2.csv");
    let [one, two] =
        ["both.csv --sync CH2".into(), format!("1.csv --columns CH1 --sync {}", other.display())]
            .map(|args| folder.json(&args));
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
    for (args, reason) in [
        (
            "1.csv --sync fewer.csv",
            "fewer.csv: it is no channel of the same record: 14399 samples, and the light has 14400",
        ),
        ("1.csv --sync later.csv", "sample 1 is at 0.0000025 s, the light's at 0 s"),
        ("1.csv --sync two.csv", "two.csv: a sync's file has one signal"),
        ("1.csv --sync 1.csv", "is it the light's?"),
        ("1.csv both.csv --sync 2.csv", "--sync: each trace has a file of its own"),
        ("1.csv --sync none.csv", "no column"),
    ] {
        let (code, _, err) = folder.run(&format!("fit {args}"));
        assert!(code == 2 && err.contains(reason), "{args}: {err}");
    }
}

/// A sound has its sync on the other channel; with one channel alone it has none.
#[test]
fn a_stereo_sound_has_a_sync() {
    let folder = Folder::new("sound");
    let record = Record { hertz: 48e3, levels: [0.9, 0.0], noise: 0.02, ..Record::new(5, 8) };
    let wav = |channels: u16| {
        let rows = record.rows();
        let whole = |x: f64| ((0.9 * 32767.0 * x) as i16).to_le_bytes();
        let frame = |[_, light, sync]: &[f64; 3]| [whole(light / 3.0), whole(*sync)];
        let frames: Vec<_> = rows.iter().map(frame).collect();
        let data: Vec<u8> = frames.iter().flat_map(|it| it[..channels.into()].concat()).collect();
        let mut bytes = b"RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x01\0".to_vec();
        bytes.extend(channels.to_le_bytes());
        bytes.extend(48_000u32.to_le_bytes());
        bytes.extend((96_000 * u32::from(channels)).to_le_bytes());
        bytes.extend((2 * channels).to_le_bytes());
        bytes.extend(b"\x10\0data");
        bytes.extend((data.len() as u32).to_le_bytes());
        bytes.extend(data);
        bytes
    };
    folder.write("two.wav", wav(2));
    let json = folder.json("two.wav --sync 2");
    // Each edge is known to a sample by the root of 12, 6 µs.
    assert!((number(&json, "delay_spread_s") - record.spread()).abs() < 9e-6, "{json}");
    assert_eq!((&json["columns"]["signal"], &json["columns"]["sync"]), (&1.into(), &2.into()));
    folder.refuses("two.wav --columns 1 --sync 1", "--sync: its channel is the signal's");
    folder.write("one.wav", wav(1));
    folder.refuses("one.wav --sync 1", "--sync: its channel is the signal's");
    folder.refuses("one.wav --sync 2", "--sync: there is no column '2'");
}

#[test]
fn what_is_no_sync_is_refused() {
    let folder = Folder::new("refused");
    let write = |record: &Record| folder.write("a.csv", record.csv());
    write(&Record::new(3, 1));
    folder.refuses("a.csv --sync CH3", "there is no column 'CH3'; there are 3: Time (s), CH1, CH2");
    folder.refuses("a.csv --sync 1", "column 1, \"Time (s)\" holds times");
    folder.refuses("a.csv --sync CH1 --columns 1,2", "column 2, \"CH1\" is the signal's");
    // Then the sync is taken for the light.
    folder.refuses("a.csv --sync CH1 --light down", "as slowly as light does; is it the light's?");
    write(&Record { lost: vec![0, 1, 2], ..Record::new(3, 1) });
    folder.refuses("a.csv --sync CH2", "never switches: its levels are 1.");
    write(&Record { lost: vec![0, 1, 2], noise: 0.0, ..Record::new(3, 1) });
    folder.refuses("a.csv --sync CH2", "its column never switches");
    write(&Record { noise: 1.0, ..Record::new(3, 1) });
    folder.refuses("a.csv --sync CH2", "times the noise apart, and 8 are required");
    // A clock, and a slope.
    let with = |sync: fn(f64) -> f64| {
        let row = |[t, light, _]: [f64; 3]| format!("{t:.7},{light:.4},{:.4}\n", sync(t));
        let rows: String = Record::new(3, 1).rows().into_iter().map(row).collect();
        folder.write("a.csv", String::from("Time (s),CH1,CH2\n") + &rows);
    };
    with(|t| f64::from((t * 500.0).fract() < 0.5));
    folder.refuses("a.csv --sync CH2", "its column switches ");
    with(|t| 1e3 * (t * 10.0).fract().min(1.0 - (t * 10.0).fract()));
    folder.refuses("a.csv --sync CH2", "no two levels");
}

#[test]
fn what_is_doubtful_about_a_sync_is_told() {
    let folder = Folder::new("doubts");
    // One of four shots without an edge; one edge without a shot, since the record ends before that.
    let record = Record { lost: vec![1], ..Record::new(4, 2) };
    folder.write("a.csv", record.csv());
    let json = folder.json("a.csv --sync CH2");
    assert_eq!((&json["delay_shots"], codes(&json)), (&3.into(), vec!["sync_missing"]));
    let text = Record::new(4, 2).csv();
    let cut: Vec<&str> = text.lines().take(16_400).collect();
    folder.write("a.csv", cut.join("\n"));
    let json = folder.json("a.csv --sync CH2");
    assert_eq!((&json["delay_shots"], codes(&json)), (&3.into(), vec!["sync_others"]));

    // An edge as a contact makes it that closes when the shutter is open.
    let late = Record { delays: vec![-1.1e-3, -1.12e-3, -1.09e-3], ..Record::new(3, 2) };
    folder.write("a.csv", late.csv());
    let json = folder.json("a.csv --sync CH2");
    assert_eq!(codes(&json), ["sync_late"]);
    assert!((number(&json, "delay_s") - late.mean()).abs() < 3e-6);
    let (_, out, err) = folder.run("fit a.csv --sync CH2");
    assert!(err.contains("in 3 of 3 shots, by up to 1.1 ms"), "{err}");
    let comment = "# delay = ? # From the edge of the camera's sync to open_start: the edge comes 1.1 too late.\n";
    assert!(out.contains(comment) && !out.contains("\ndelay = "), "{out}");

    // One threshold would switch many times in an edge as slow as this one.
    let slow = Record { slow: 2e-4, noise: 0.3, ..Record::new(5, 2) };
    folder.write("a.csv", slow.csv());
    let json = folder.json("a.csv --sync CH2");
    let off = number(&json, "delay_s") - slow.mean();
    assert!(
        codes(&json).is_empty() && off.abs() < number(&json, "delay_trigger_error_s"),
        "{json}"
    );

    // Sampled so coarsely that an edge is known to 58 µs.
    let coarse = Record { hertz: 5e3, noise: 0.0, ..Record::new(8, 2) };
    folder.write("a.csv", coarse.csv());
    let json = folder.json("a.csv --sync CH2");
    assert!(number(&json, "delay_trigger_error_s") > 2e-4 / 12f64.sqrt(), "{json}");
    let (_, out, _) = folder.run("fit a.csv --sync CH2");
    assert!(out.contains("\n             each is measured to ± 0.0"), "{out}");
}
