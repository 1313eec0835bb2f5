//! What is read of the files of instruments: of each what must be told, or which words must refuse or doubt it.
//!
//! All are of one shutter with an exposure of 5 ms, beside a gate of 7 ms where there are two channels. So what is
//! misread shows in the exposure.

use std::sync::LazyLock;

use shutter_fit::trace::{self, Light, Tell, open, pulses};
use shutter_fit::unit::Unit;

use crate::generator::{Random, each};

/// The light opens from 2 to 4 ms and closes from 7 to 9. In a row, `{v}` is the light from 0 to 1, `{e}` the same in
/// exponential notation, `{mv}` in thousands, `{adc}` in whole ones, `{early}` for a part of the rows,
/// `{g}` a gate of 5 V, `{d}` one of 0 and 1, `{talk}` its cross-talk, `{up}` a rise, `{z}` a channel that is not
/// connected; `{t}` seconds, `{T}` exponential, `{-t}` from before the trigger, `{ms}`, `{us}`, `{ns}`, `{day}` a time
/// of day with midnight in the pulse; `{i}` counts; `{set}` is a setting in the first rows. A comma before the brace,
/// as in `{,v}`, is a decimal one.
pub fn rows(row: &str) -> String {
    static ALL: LazyLock<Vec<Vec<(String, String)>>> = LazyLock::new(fields);
    let line = |fields: &Vec<(String, String)>| {
        let used = fields.iter().filter(|(name, _)| row.contains(name));
        used.fold(row.to_string(), |line, (name, value)| line.replace(name, value)) + "\n"
    };
    ALL.iter().map(line).collect()
}

/// What stands in each row for each name in braces.
fn fields() -> Vec<Vec<(String, String)>> {
    let settings = ["Record Length,1200", "Sample Interval,1e-05", "Trigger Point,600", "Source,CH1"];
    let mut random = Random::new(11);
    let openness = |t: f64| (t - 0.002).min(0.009 - t).clamp(0.0, 0.002) / 0.002;
    let of_row = |i: i32| {
        let t = 1e-5 * f64::from(i);
        let v = 0.05 + 0.9 * openness(t) + 0.004 * random.normal();
        let gate = (0.0015..0.0085).contains(&t);
        let [volts, talk] =
            [5.0, 0.02].map(|size: f64| if gate { size } else { 0.004 * size } + 0.001 * random.normal());
        let second = 59.995 + t;
        let clock = if second < 60.0 { format!("23:59:{second:.6}") } else { format!("00:00:{:09.6}", second - 60.0) };
        let fields = [
            ("i", i.to_string()),
            ("t", format!("{t:.6}")),
            ("T", format!("{:.6e}", t - 0.006)),
            ("-t", format!("{:.6}", t - 0.006)),
            ("ms", format!("{:.4}", t * 1e3)),
            ("us", format!("{:.1}", t * 1e6)),
            ("ns", format!("{:.0}", t * 1e9)),
            ("day", clock),
            ("v", format!("{v:.5}")),
            ("e", format!("{v:.5e}")),
            ("mv", format!("{:.2}", v * 1e3)),
            ("adc", format!("{:.0}", v * 1e3)),
            ("early", if i < 930 { format!("{v:.5}") } else { String::new() }),
            ("g", format!("{volts:.3}")),
            ("talk", format!("{talk:.4}")),
            ("d", u8::from(gate).to_string()),
            ("up", u8::from(t > 0.006).to_string()),
            ("z", format!("{:.4}", 0.3 + 0.001 * random.normal())),
            ("set", settings.get(i as usize).unwrap_or(&",").to_string()),
        ];
        let both = fields
            .map(|(name, value)| [(format!("{{,{name}}}"), value.replace('.', ",")), (format!("{{{name}}}"), value)]);
        both.into_iter().flatten().collect()
    };
    (0..1200).map(of_row).collect()
}

/// What stands above the rows, a row, what is asked for, and what must be told.
type Export = (&'static str, &'static str, &'static str, &'static str);

/// By its instrument, each name that is read is in `names.rs`, and read in `words.rs`: here is what else differs.
#[rustfmt::skip]
const EXPORTS: &[Export] = &[
    // Oscilloscopes: Rigol DS1000Z, MSO5000.
    ("X,CH1,Start,Increment,\nSequence,Volt,-6.000ms,10.000us,\n", "{i},{e},,", "", "2 the first at -6 ms"),
    // Siglent: the unit of a scale is none of a step's.
    ("Record Length,Analog:1200\nSample Interval,Analog:0.0000100\nVertical Units,CH1:V\nHorizontal Units,us\n\
        Horizontal Scale,0.001\nModel Number,SDS1104X-E\nSource,CH1\nSecond,Volt\n", "{T},{v}", "",
        "2 in s, by its name"),
    // Tektronix: settings beside the rows, none, and a step without a unit of the times.
    ("", "{set},,{-t},  {v},", "", "5 in s, by 'Sample Interval,1e-05"),
    ("Sample Interval,1e-05\n", "{ms},{v}", "", "2 in ms, by 'Sample Interval"),
    // Keysight: a channel that was recorded for a part.
    ("x-axis, 1, 2\nsecond, Volt, Volt\n", "{T}, {early}, {z}", "", "2 in s, by its name"),
    // LeCroy, Yokogawa, GW Instek, OpenHantek, Hantek, PicoScope.
    ("LECROYWR62Xi,1234,Waveform\nSegments,1,SegmentSize,1200\nSegment,TrigTime,TimeSinceSegment1\n\
        #1,18-Mar-2024 10:00:00,0\nTime,Ampl\n", "{T},{v}", "", "2 column 1, \"Time\" in s, assumed|unit_assumed"),
    ("\"TraceName\",\"CH1\",\"CH2\"\n\"BlockSize\",1200,1200\n\"HResolution\",1.0E-05,1.0E-05\n\
        \"HOffset\",-6.0E-03,-6.0E-03\n\"HUnit\",\"s\",\"s\"\n\n", ",{g},{e}", "", "3 by 'HResolution|second_signal"),
    ("\"HResolution\",1.0E-02\n\"HUnit\",\"ms\"\n\n", ",{e}", "", "!'HUnit,ms'"),
    ("Memory Length,1200\nHorizontal Units,S\nHorizontal Scale,1.0E-03\nSampling Period,1.0E-05\nFirmware,V1.20\n\
        Time,01-May-24 10:00:00\n", "{d},{adc},", "", "2 by 'Sampling Period,1.0E-05'|second_signal"),
    ("\"t / s\",\"CH1 / V\",\"CH2 / V\"\n", "{t},{g},{v}", "",
        "3 in s, by its name~: column 3, \"CH2 / V\" is taken~column 2, \"CH1 / V\" is not (--columns 1,2)|\
         second_signal"),
    ("#CHANNEL:CH1\n#CLOCK=10.0uS\n#SIZE=1200\n#UNITS:V\n\n", "{v}", "", "!'#CLOCK=10.0uS'"),
    ("Temps;Voie A\n(µs);(mV)\n\n", "{,us};{,mv}", "", "2 in µs, by its name"),
    // Logic analysers, data loggers, sound: sigrok, PulseView, Audacity, LabVIEW, LabChart, AcqKnowledge, others.
    ("; CSV generated by libsigrok 0.5.2\n; Channels (2/2): A0, D0\n; Samplerate: 100 kHz\nA0,D0\n", "{v},{d}", "",
        "1 by '; Samplerate: 100 kHz'|second_signal"),
    ("; Samplerate: 100 kHz\nTime,A0\n", "{us},{v}", "", "2 in µs, by '; Samplerate"),
    ("/data/us/take.ms   1 channel (mono)\nSample Rate: 100000 Hz. Linear.\n\n", "{i}\t{v}", "",
        "2 100000 samples a second, by"),
    ("Date\t2024/05/01\nTime\t10:00:00.0\nX0\t0.0E+0\nDelta_X\t1.0E-5\n***End_of_Header***\t\n\
        X_Value\tVoltage\tComment\n", "{t}\t{v}\t", "", "2 in s, by 'Delta_X"),
    ("Interval=\t1E-05 s\nRange=\t2.000 V\nUnitName=\tV\n", "{t}\t{v}", "", "!--unit"),
    ("2 channels\nLight\nVolts\nmsec\tCH1\tCH2\t\n\t1200\t1200\t\n", "{ms}\t{v}\t{g}\t", "",
        "2 \"msec\" in ms, by its name|second_signal"),
    ("Zeit  1 - Standardmessrate [s];Licht\n", "{,t};{,v}", "", "2 in s, by its name"),
    // Sketches, monitors, simulators; times of day.
    ("adc,t_us\n", "{adc},{us}", "", "1 in µs, by its name"),
    ("", "micros:{us},light:{adc}", "", "!without a label or a unit beside each; its middle line is 'micros:6000"),
    ("", "{day} -> {adc}", "", "3 column 1 in s, by the file"),
    ("", "[{day}] {adc}", "", "2 column 1 in s, by the file"),
    ("", "2024-12-31 {,day} -> {,v}", "", "!'2024-12-31 23:59:59,9950"),
    ("Time,V\n", "2024-12-31 {,day},{v}", "", "!a whole number from its fraction"),
    ("Time,ms,V\n", "2024/05/01 10:00:07,{ms},{v}", "", "3 \"ms\" in ms, by its name"),
    ("", "10:07.5,{v}", "", "!'10:07.5' is no time that is read"),
    ("Time,Light\n", "2024-12-31T{day}+01:00,{v}", "", "2 in s, by the file"),
    ("Zeit\tLicht\n", "2024-12-31T{,day}Z\t{,v}", "", "2 in s, by the file"),
    ("Date;Light\n", "31.12.2024 {,day};{,v}", "", "2 in s, by the file"),
    ("", "10:00:00 AM,{v}", "", "!'10:00:00 AM' is no time that is read"),
    ("", "{us} {adc}", "", "!counts without a unit"),
    ("time,adc\n", "{i}00,{v}", "", "!\"time\" counts without a unit"),
    ("# time (ms) light (V)\n", "{ms} {e}", "", "2 in ms, by its name"),
    ("# time (ms),light (V)\n", "{ms} {e}", "", "2 in ms, by its name"),
    ("Time (ms);light (V)\n", "{ms},{e}", "", "2 in s, assumed=5000|unit_assumed"),
    ("\"\",\"time_ms\",\"v\"\n", "\"{i}\",{ms},{v}", "", "3 in ms, by its name"),
    ("Time,v\n", "{t} sec,{v}", "", "!'0.000000 sec'"),
    ("", "{ms} ms; {v} V", "", "!'0.0000 ms; 0.05641 V' is no time"),
    ("", " {T}  {g}  {T}  {e} ", "", "4 in s, assumed|unit_assumed second_signal"),
    // An axis that is no time: spectra, a spectrometer, an encoder, a stage, a sweep.
    ("Frequency (kHz),Magnitude (dB)\n", "{ms},{v}", "", "!'Frequency (kHz)'"),
    ("Horizontal Units,Hz\nSample Interval,1e-05\nTIME,MATH\n", "{t},{v}", "", "!'Horizontal Units,Hz'"),
    ("nm;counts\n", "{,ms};{,v}", "", "!'nm'"),
    ("Position/mm V\n", "{us} {v}", "", "!\"Position/mm\" counts"),
    ("X Unit,mm\nX,CH1\n", "{ms},{v}", "", "!'X Unit,mm'"),
    // Settings that are no names, other numbers that are no rate.
    ("Trigger delay (ms),0.5\nTime,CH1\n", "{t},{v}", "", "2 in s, assumed|unit_assumed"),
    ("Time (s),Integration time (ms),Light\n", "{t},8,{v}", "", "3 column 1, \"Time (s)\" in s"),
    ("Mains frequency: 50 Hz\nSample rate: 100000 Hz\n", "{v}", "", "1 by 'Sample rate"),
    ("Sample rate: 100 kHz\nTime (ms),v\n", "{t},{v}", "", "!different rates"),
    ("Sample rate: 1 MHz\nn,v\n", "{i}0,{v}", "", "!different rates; give that of the rows (--rate"),
    ("Sample rate: 100 kHz\nSequence,v\n", "{i}0,{v}", "", "!different rates"),
    // Columns and rows.
    ("CH1,CH2\n", "{up},{v}", "", "!2: CH1, CH2"),
    ("", "{i};{t};{v}", "", "3 column 2 in s, assumed|unit_assumed"),
    ("# Sample rate: 100000 Hz\nSample,CH1\n", "{i},{v}", "", "2 by '# Sample rate"),
    ("t_us,adc\n", "00{us},0{adc}", "", "2 in µs, by its name"),
    ("", "\"{,ms}\",\"{,v}\"", "", "2 in s, assumed=5000|unit_assumed"),
    ("Time [s],A,B\n", "{t},{z},{v}", "", "3 \"Time [s]\" in s"),
    ("Time [s],A,B\n", "{t},{talk},{g}", "", "3 in s=7|second_signal"),
    ("time_s,state,light\n", "{t},ok,{v}", "", "3 in s, by its name"),
    ("Time (s),CH1 (V),Time (s),CH2 (V)\n", "{t},{g},{t},{v}", "", "4 in s|second_signal"),
    ("Time (s),CH1 (V),Time (s),CH2 (V)\n", "{t},{g},{-t},{v}", "", "!hold different times"),
    ("", "{,t},{,v}", "", "!"),
    ("", "{,v}", "", "!(--rate HERTZ)"),
    ("", "{d},{adc}", "", "!a whole number from its fraction"),
    // What is asked for beside the file.
    ("Volt\n", "{,v}", "--rate 1e5", "1 100000 samples a second, as asked"),
    ("# a comment\n\"n\",\"sensor\",\"clock\"\n", "7,{v},{us}", "--columns clock,sensor --unit µs",
        "2 column 3, \"clock\" in µs, as asked"),
    ("Zeit,Licht\n", "{ms},{v}", "--unit ms", "2 column 1, \"Zeit\" in ms, as asked"),
    ("Sample,CH1\n", "{i},{v}", "--rate 1e5", "2 100000 samples a second, as asked"),
    ("Sample,CH1\n", "{i},{v}", "--unit ms", "2 in ms, as asked=500"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--columns 3", "3 column 1, \"Time (s)\" in s, by its name"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--columns gate", "2 column 1, \"Time (s)\" in s, by its name=7"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--columns 1,2,3", "3 column 1, \"Time (s)\" in s|second_signal"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--columns 3 --sync gate", "3 in s, by its name"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--unit ms",
        "3 in ms, as asked, where its name says s=0.005|second_signal"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--rate 1e5", "3 100000 samples a second, as asked|second_signal"),
    ("Time (s),gate,light\n", "{t},{g},{v}", "--columns 3 --rate 1e3",
        "3 as asked, where column 1, \"Time (s)\" has steps of 10 µs=500"),
    ("CH1,CH2\n", "{g},{v}", "--columns CH1 --rate 1e5", "1 100000 samples a second, as asked=7"),
    ("Sample rate: 1 MHz\nn,CH1,CH2\n", "{i},{g},{v}", "--rate 1e5",
        "3 100000 samples a second, as asked|second_signal"),
    ("Sample rate: 1 MHz\nn,CH1,CH2\n", "{i},{g},{v}", "--columns 2",
        "2 1000000 samples a second, by 'Sample rate=0.7"),
    ("x-axis,1,2\nsecond,Volt,Volt\n", "{t},{v},{g}", "--sync 2", "!and the name of column 3"),
    ("x-axis,1,2\nsecond,Volt,Volt\n", "{t},{v},{g}", "--sync 2 Volt", "2 in s, by its name"),
    ("x-axis,1,2\nsecond,Volt,Volt\n", "{t},{v},{g}", "--sync 3", "2 in s, by its name"),
    ("x-axis,1,2\nsecond,Volt,Volt\n", "{t},{v},{g}", "--sync 1 Volt --columns 2", "!is the signal's"),
    ("t_s,v\n", "{t},{v}", "--sync t_s", "!holds times"),
    ("t_s,v\n", "{t},{v}", "--sync v", "!no other holds a signal"),
    ("t_s,v\n", "{t},{v}", "--from 0.001 --to 0.0105", "2 in s, by its name, from 1 ms, to 10.5 ms"),
];

/// Options as the program has them.
fn options(asked: &str) -> trace::Options {
    let mut options = trace::Options::default();
    for (option, value) in asked.split("--").filter_map(|option| option.trim().split_once(' ')) {
        let number = || Some(value.parse().expect("a number"));
        match option {
            "columns" => options.columns = value.split(',').map(String::from).collect(),
            "unit" => options.unit = Unit::ALL.into_iter().find(|unit| unit.name() == value),
            "rate" => options.rate = number(),
            "from" => options.from = number(),
            "to" => options.to = number(),
            _ => options.sync = Some(value.into()),
        }
    }
    options
}

/// A file's column of light, its times and doubts in words, its exposure in ms, and the doubts' codes.
fn read(bytes: &[u8], asked: &str) -> Result<(String, f64, String), String> {
    let recording = open(bytes, &options(asked)).map_err(|refusal| refusal.with_option())?;
    let found = pulses(&recording.trace, Light::Auto);
    let found = found.map_err(|refusal| format!("{refusal}; read: {}", recording.reading))?;
    let doubts = || recording.warnings.iter().chain(&found.warnings);
    let words: String = doubts().map(|doubt| format!("; {}", doubt.with_option())).collect();
    let codes: Vec<&str> = doubts().map(|doubt| doubt.code()).collect();
    let reading = &recording.reading;
    let told = format!("{} {}{words}", reading.signal.0, reading.times());
    Ok((told, 1e3 * found.frames[0].exposure, codes.join(" ")))
}

/// Is a file read as it must be? The light's column and, parted by `~`, words that are told of its times and its
/// doubts; behind a `=` the exposure in ms, if it is not 5, and behind a `|` the codes. Or the words of the refusal
/// behind an `!`.
pub fn judge(bytes: &[u8], asked: &str, must: &str) -> Result<(), String> {
    let said = read(bytes, asked);
    let (words, codes) = must.split_once('|').unwrap_or((must, ""));
    let is_right = match (&said, must.strip_prefix('!')) {
        (Err(refusal), Some(words)) => refusal.contains(words),
        (Ok((told, found, doubted)), None) => {
            let (words, exposure) = words.rsplit_once('=').unwrap_or((words, "5"));
            let exposure: f64 = exposure.parse().expect("a number");
            let (column, words) = words.split_once(' ').unwrap_or((words, ""));
            let has_words = words.split('~').all(|words| told.contains(words));
            let is_exposure = (found / exposure - 1.0).abs() < 0.015;
            told.starts_with(&format!("{column} ")) && has_words && is_exposure && doubted == codes
        }
        _ => false,
    };
    if is_right { Ok(()) } else { Err(format!("{must}: {said:?}")) }
}

#[test]
fn each_export_is_read_right_or_doubted_or_refused() {
    let judged = |k: u32| {
        let (above, row, asked, must) = EXPORTS[k as usize];
        judge(format!("{above}{}", rows(row)).as_bytes(), asked, must).err()
    };
    let wrong: Vec<String> = each(EXPORTS.len() as u32, judged).into_iter().flatten().collect();
    assert!(wrong.is_empty(), "of {} exports otherwise:\n{}", EXPORTS.len(), wrong.join("\n"));
}

/// Settings that give a step of 10 µs, or the first time, or nothing that is sure.
#[test]
fn a_setting_gives_the_times() {
    let light = rows("{v}");
    let judge = |above: &str, must: &str| judge(format!("{above}\n{light}").as_bytes(), "", must).expect(above);
    let step = "Sample rate: 100000 Hz|Samplerate: 100 kHz|sample_rate=100 kHz|Sample Rate: 0.1 MHz. All is linear.|\
        Sample Rate: 100000.000 Hz|Sample Interval,1e-05,s|Sample Interval,CH1:1.0e-05|Sample interval: 0.01 ms|\
        HResolution,1E-5\nHUnit,s|Sample Interval,10,us\nHorizontal Units,ms|Sample rate: 100 kHz\nStart:,5|\
        Sample rate: 100 kHz\nTrigger position: 600|Sample rate: 100 kHz\nStart Time,10:00:00";
    step.split('|').for_each(|above| judge(above, "1 100000 samples a second, by '"));
    let unsure = "Interval,2|Sample interval: 1e-300 s|Sample interval: 10|Sample rate: 100|\
        Sample interval (ms): 10 us|Sample rate: 100 k|Sample rate: 10 us|Sample rate: 100,000 Hz|Clock: 84 MHz|\
        Sample rate: 50 kHz (actual 100 kHz)|Max. sample rate: 1 GHz|Sample rate: 100.000 Hz|Sample rate: 1.000.000 Hz|\
        Mains frequency,50 Hz|Sample rate: 2 x 50 kHz|Sample rate: 100-200 kHz|Sample rate: 10 kHz/ch|\
        Sample rate: 1 kHz\nDecimation,8|Sample Interval,1e-5,2e-5|Sample Interval,1e-5\nXUnits,Hz|\
        Sample rate: 1 kHz\nSampling period,2 ms";
    unsure.split('|').for_each(|above| judge(above, "!"));
    for first in ["HResolution,1e-5\nHOffset,-6.0E-03\nHUnit,s", "X,Start,Increment\nSequence,-6.0ms,10.0us"] {
        judge(first, "1 100000 samples a second~, the first at -6 ms");
    }
}

/// Rows that are broken at any place are told, and so is a second recording below the first.
#[test]
fn what_stands_between_the_rows_is_told() {
    let whole = "Time (s),gate,light\n".to_string() + &rows("{t},{g},{v}");
    let without = |from: usize, field: &str| {
        let broken = |(k, line): (usize, &str)| match line.rsplit_once(',') {
            Some((rest, _)) if (from..from + 150).contains(&k) => format!("{rest},{field}\n"),
            _ => format!("{line}\n"),
        };
        whole.lines().enumerate().map(broken).collect::<String>()
    };
    for (from, field) in [(1, "---"), (1, "saturated"), (1000, "?"), (50, "inf")] {
        judge(without(from, field).as_bytes(), "", "3 150 such rows|second_signal broken_rows").expect(field);
    }
    let often = without(1, "").replace(",\n", ",x\n").repeat(3);
    judge(often.as_bytes(), "--columns 2,3", "!").expect("a refusal");

    let block =
        |channel: &str, row: &str| format!("#CHANNEL:{channel}\n#Sample Interval=10.0uS\n#SIZE=1200\n\n{}", rows(row));
    let two = block("CH1", "{g}") + &block("CH2", "{v}");
    judge(two.as_bytes(), "", "!line 1205: '#CHANNEL:CH2' between the rows").expect("a refusal");
    // A last remark is none.
    judge((block("CH1", "{v}") + "#END\n").as_bytes(), "", "1 ").expect("a trace");
    let timed = |names: &str| format!("{names}\n{}", rows("{t},{v}"));
    judge((timed("Time (s),A") + &timed("Time (s),B")).as_bytes(), "", "!'Time (s),B' between").expect("a refusal");
    judge((timed("Time (s),A") + &timed("Time (s),A")).as_bytes(), "", "2 in 2 segments, each|broken_rows")
        .expect("segments");
    // Other units, a mark or a quote before them, an empty line as between two frames.
    let between = |above: &str, line: &str, row: &str| format!("{above}\n{}{line}\n{}", rows(row), rows(row));
    for line in ["Time,A\n(ms),(V)", "\"Time (ms)\",\"A\"", "; Time (ms),A"] {
        judge(between("Time,A\n(s),(V)", line, "{t},{v}").as_bytes(), "", "!between the rows").expect(line);
    }
    judge(between("Sample rate: 100 kHz", "", "{v}").as_bytes(), "", "!line 1202: '' between").expect("a refusal");
    judge(rows("{v}\n").as_bytes(), "--rate 1e5", "1 as asked").expect("a trace");
    // A count that soon begins anew.
    let counted = rows("{i},{v}");
    let (dark, _) = counted.split_once("150,").expect("a row");
    judge(format!("Sample rate: 100 kHz\nn,A\n{dark}{counted}").as_bytes(), "", "2 by 'Sample rate~in 2 segments")
        .expect("segments");
}

#[test]
fn a_table_of_thousands_of_columns_is_read() {
    let mut text = String::from("t_us");
    (0..3000).for_each(|k| text += &format!(",S{k}"));
    for i in 0..300 {
        text += &format!("\n{}", 40 * i);
        (0..3000).for_each(|k| {
            text += &format!(",{}", (i * 7 + k * 3) % 10 + if k == 2500 && (100..200).contains(&i) { 400 } else { 0 })
        });
    }
    judge(text.as_bytes(), "", "2502 \"t_us\" in µs=4").expect("a trace");
}
