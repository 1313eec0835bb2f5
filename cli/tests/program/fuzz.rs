//! `shutter fit` on files that are broken in many ways: it ends with 0 or 2, says no number that is none, and soon.
//!
//! Each file is a trace in a form that an instrument writes, with some bytes, fields or lines changed. The same files
//! come every time; `SEED=7` before it makes others, and `FILES=10000` more of them.

use std::ffi::OsString;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Instant;

use crate::generator::{Random, asked, each};
use crate::support::Folder;

/// So many files, if no one asks for another number.
const FILES: u32 = 400;
/// No file of this size may take longer, on a busy machine and with all debug checks; in seconds.
const PATIENCE: f64 = 10.0;

fn below(random: &mut Random, n: usize) -> usize {
    (random.within(0.0, n.max(1) as f64) as usize).min(n.saturating_sub(1))
}

/// A ramp, a plateau and a ramp in a trace from 0 to 1.
fn openness(t: f64) -> f64 {
    ((t - 0.25) / 0.1).min((0.75 - t) / 0.15).clamp(0.0, 1.0)
}

/// A whole trace in one of the forms.
fn whole(random: &mut Random) -> Vec<u8> {
    let n = 20 + below(random, 30);
    let noise = [0.0, 0.004, 0.03][below(random, 3)];
    let form = below(random, 13);
    let mut text = String::from(match form {
        0 => "time_s,v\n",
        1 => "X,CH1,Start,Increment,\nSequence,Volt,0.0e+00,1.0e-05\n",
        2 => "Zeit (ms);Spannung (V)\n",
        3 => "# a comment\nTIME,CH1,CH2\nms,V,V\n",
        4 | 8 => "",
        5 => "t (µs)\tCH1\n",
        6 | 12 => "Samplerate: 44100 Hz\n",
        // A few characters of the alphabet of numbers.
        11 => return (0..12 * n).map(|_| b"0123456789.,;\t \n\n\n-+eE\"NaN#t="[below(random, 29)]).collect(),
        9 => "Sample Interval,1e-04\nCH1,CH2\n",
        10 => "Sample Interval;1e-04\nCH1;CH2\n",
        _ => "Sample,Time [s],Light\n",
    });
    let shots = if form == 0 { 1 + below(random, 3) } else { 1 };
    let mut level = 0.0;
    for i in 0..n * shots {
        let (k, shot) = (i % n, i / n);
        let v = 0.1 + 2.0 * openness(k as f64 / n as f64) + 2.0 * noise * random.normal();
        let t = k as f64 * 1e-4;
        text += &match form {
            0 => format!("{:.6},{v:.5}\n", t + 3.0 * shot as f64),
            1 => format!("{k},{v:e},,\n"),
            2 => format!("{:.5};{v:.5}\n", t * 1e3).replace('.', ","),
            3 => format!("{:.5},{v:.5},{:.3}\n", t * 1e3, f64::from(v > 1.0)),
            4 => format!("  {t:.6}   {v:.5}\n"),
            5 => format!("{:.2}\t{:.0}\n", t * 1e6, 100.0 * v),
            6 => format!("{v:.4}\n"),
            // Whatever a signal does.
            12 => {
                level = match below(random, 6) {
                    0 => random.within(-1.0, 1.0),
                    1 => random.scale(1e-9, 1e9),
                    2 => 0.0,
                    _ => level,
                };
                format!("{level:e}\n")
            }
            9 => format!("{:.2},{v:.4},,\n", f64::from(v > 1.0)),
            10 => format!("{v:.4};{v:.4}\n").replace('.', ","),
            8 => format!("\"{t:.6}\",\"{v:.4}\"\n").replace('.', ","),
            _ => format!("{k},{t:.6},{v:.5}\n"),
        };
    }
    text.into_bytes()
}

/// What is put in the place of something else.
#[rustfmt::skip]
const TOKENS: [&str; 20] = [
    "0", "-1", "1e308", "-1e308", "1e-308", "NaN", "inf", "-inf", "10", "", "1,234", "1e30", "0.0000001", ",", ";",
    "\t", "\"", "\n", "s", "1.0.0",
];

/// Changes the file in one way.
fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    let n = bytes.len();
    let at = below(random, n);
    let (from, to) = (at, (at + 1 + below(random, 40)).min(n));
    let token = TOKENS[below(random, TOKENS.len())].as_bytes();
    let is_mark = |b: &u8| matches!(b, b',' | b';' | b'\t' | b'\n' | b' ');
    // The field that begins behind the next mark.
    let start = bytes[at.min(n)..].iter().position(is_mark).map_or(n, |k| at + k + 1);
    let end = bytes[start.min(n)..].iter().position(is_mark).map_or(n, |k| start + k);
    match below(random, 9) {
        0 if n > 0 => bytes[at] ^= 1 << below(random, 8),
        1 if n > 0 => bytes[at] = b"0123456789.,;-+e\n\"\t \0\xff"[below(random, 22)],
        2 => drop(bytes.drain(from..to)),
        3 => drop(bytes.splice(at..at, bytes[from..to].to_vec())),
        4 => bytes.truncate(at),
        5 => drop(bytes.splice(at..at, token.iter().copied())),
        6 => {
            // Lines elsewhere.
            let taken: Vec<u8> = bytes.drain(from..to).collect();
            let at = below(random, bytes.len());
            bytes.splice(at..at, taken);
        }
        // Fields count most.
        _ => drop(bytes.splice(start..end, token.iter().copied())),
    }
}

/// The file of a seed, and what the program is asked of it.
fn file(seed: u64) -> (Vec<u8>, Vec<&'static str>) {
    let mut random = Random::new(seed);
    let mut bytes = whole(&mut random);
    for _ in 0..1 + below(&mut random, 4) {
        mutate(&mut bytes, &mut random);
    }
    #[rustfmt::skip]
    let asked: [&[&str]; 8] = [
        &[], &[], &[], &["--rate", "100000"], &["--unit", "us"], &["--columns", "2"], &["--light", "down"],
        &["--model", "free", "--triggers", "3"],
    ];
    (bytes, asked[below(&mut random, asked.len())].to_vec())
}

/// Fits the file of a seed; what is wrong with that, if anything is.
fn judged(seed: u64, path: &Path) -> Result<u8, String> {
    let (bytes, asked) = file(seed);
    fs::write(path, bytes).map_err(|e| e.to_string())?;
    let args = ["shutter", "fit"].into_iter().map(OsString::from);
    let picture = path.with_extension("svg");
    let args = args.chain([path.into(), "--picture".into(), picture.into()]).chain(asked.iter().map(OsString::from));
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let clock = Instant::now();
    let ended = catch_unwind(AssertUnwindSafe(|| shutter::command::run(args, &mut out, &mut err)));
    let text = String::from_utf8_lossy(&out).into_owned() + &String::from_utf8_lossy(&err);
    let took = clock.elapsed().as_secs_f64();
    let is_no_number = |word: &str| ["inf", "nan"].contains(&word);
    // The file's own words stand in these lines, and in quotes; elsewhere a number stands between these marks.
    let is_quoted = |line: &&str| {
        ["signal ", "times ", "# Read"].iter().any(|start| line.starts_with(start))
            || ["'", "the columns of numbers are", "no finite number"].iter().any(|part| line.contains(part))
    };
    let lines = text.lines().filter(|line| !is_quoted(line));
    let own = lines.flat_map(|line| line.split('"').step_by(2));
    let mut words =
        own.flat_map(|text| text.split([' ', '(', ')', ',', ';', ':', '+', '-', '±'])).map(str::to_lowercase);
    match ended {
        Err(_) => Err("a panic".into()),
        Ok(code) if code != 0 && code != 2 => Err(format!("exit code {code}")),
        Ok(_) if words.any(|word| is_no_number(&word)) => Err(format!("no number:\n{text}")),
        Ok(2) if err.is_empty() => Err("refused without a word".into()),
        Ok(_) if took > PATIENCE => Err(format!("{took:.0} s")),
        Ok(code) => Ok(code),
    }
}

#[test]
fn broken_files_end_with_0_or_2() {
    let (seed, files) = (asked("SEED", 1) << 32, asked("FILES", FILES));
    let folder = Folder::new("fuzz");
    let codes = each(files, |k| {
        let path = folder.path(&format!("{k}.csv"));
        let code = judged(seed + u64::from(k), &path)
            .unwrap_or_else(|wrong| panic!("{:?}: {wrong}; see {}", file(seed + u64::from(k)).1, path.display()));
        let _ = fs::remove_file(path.with_extension("svg"));
        fs::remove_file(path).expect("it was written");
        code
    });
    let fitted = codes.iter().filter(|code| **code == 0).count();
    println!("{fitted} of {files} fitted, the others refused");
    // Else nothing was tried but the reading.
    assert!(fitted > files as usize / 5, "{fitted}");
}
