//! The exports of instruments, a table: what must be read of each, or which words must refuse or doubt it.
//!
//! All are of one shutter with an exposure of 5 ms, beside a gate of 7 ms where there are two channels. So what is
//! misread shows in the exposure.

use std::sync::LazyLock;

use shutter_fit::trace::{self, Column, Tell, open};
use shutter_fit::unit::Unit;
use shutter_fit::{Options, Record, fit};

use crate::generator::{Random, each};

/// The light opens from 2 to 4 ms and closes from 7 to 9. In a row, `{v}` is the light from 0 to 1, `{e}` the same in
/// exponential notation, `{mv}` in thousands, `{adc}` in whole ones, `{late}` and `{early}` for a part of the rows,
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
        let part = |is: bool| if is { format!("{v:.5}") } else { String::new() };
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
            ("late", part(i >= 180)),
            ("early", part(i < 930)),
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

/// Name, what stands above the rows, a row, and what is told: the light's column and how its times are known, and the
/// codes behind a `|`; or the words of the refusal behind an `!`.
type Export = (&'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const EXPORTS: &[Export] = &[
    // Oscilloscopes.
    ("Rigol DS1054Z", "X,CH1,Start,Increment,\nSequence,VOLT,-6.000000e-03,1.000000e-05\n", "{i},{e},,",
        "2 100000 samples a second, by 'Increment 1.000000e-05', the first at -6 ms"),
    ("Rigol MSO5074", "X,CH1,Start,Increment,\nSequence,Volt,-6.000ms,10.000us,\n", "{i},{e},,",
        "2 the first at -6 ms"),
    ("Rigol DS1052E", "X,CH1,\nSecond,Volt,\n", "{T},{e},", "2 in s, by its name"),
    ("Rigol DS2072A", "Time,CH1\n", "{T},{e}", "2 in s, assumed|unit_assumed"),
    ("Rigol DHO804", "CH1V,t0 =-6.000000e-03, tInc = 1.000000e-05,\n", "{e},,", "!'CH1V,t0 =-6"),
    ("Siglent SDS1104X-E", "Record Length,Analog:1200\nSample Interval,Analog:0.0000100\nVertical Units,CH1:V\n\
        Horizontal Units,S\nHorizontal Scale,0.001\nModel Number,SDS1104X-E\nSource,CH1\nSecond,Volt\n", "{T},{v}",
        "2 in s, by its name"),
    ("Siglent, a scale in µs", "Sample Interval,0.0000100\nHorizontal Units,us\nHorizontal Scale,500\nSecond,Volt\n",
        "{T},{v}", "2 in s, by its name"),
    ("Siglent, values", "Sample Interval,0.0000100\nHorizontal Units,us\nHorizontal Scale,500\nSource,CH1\n", "{v}",
        "1 100000 samples a second, by 'Sample Interval"),
    ("Siglent SDS1102CML", "Record Length,1200,Points\nSample Interval,0.00001,s\nTrigger Point,600,Samples\n\
        Source,CH1\n", "{-t},{v}", "2 in s, by 'Sample Interval,0.00001,"),
    ("its step in µs", "Sample Interval,10,us\nSource,CH1\n", "{v}", "1 100000 samples a second"),
    ("Tektronix TDS2024B, settings beside the rows", "", "{set},,{-t},  {v},", "5 in s, by 'Sample Interval,1e-05"),
    ("Tektronix TDS3012", "", "{-t},{v}", "2 in s, assumed|unit_assumed"),
    ("Tektronix DPO2014", "Model,DPO2014\nPoint Format,Y,\nHorizontal Units,S,\nHorizontal Scale,0.001,\n\
        Sample Interval,1e-05,\nFilter Frequency,1.5e+06\nVertical Units,V,\nLabel,,\nTIME,CH1\n", "{T},{v}",
        "2 in s, by 'Sample Interval,1e-05"),
    ("a unit against a rate", "Sample Interval,1e-05\n", "{ms},{v}", "2 in ms, by 'Sample Interval"),
    ("Keysight, two", "x-axis, 1, 2\nsecond, Volt, Volt\n", "{T}, {e}, {z}", "2 in s, by its name"),
    ("Keysight, one was recorded for a part", "x-axis,1,2\nsecond,Volt,Volt\n", "{T},{early},{z}",
        "2 in s, by its name"),
    ("Keysight, its start is missing", "x-axis,1\nsecond,Volt\n", "{T},{late}", "2 in s, by its name"),
    ("Infiniium", "Revision:,0\nStart:,0\nPoints:,1200\nXInc:,1.0E-05\nXOrg:,-6.0E-03\nXUnits:,Second\nYUnits:,Volt\n\
        Data:\n", "{T},{v}", "2 in s, by 'XUnits:,Second'"),
    ("LeCroy", "LECROYWR62Xi,1234,Waveform\nSegments,1,SegmentSize,1200\nSegment,TrigTime,TimeSinceSegment1\n\
        #1,18-Mar-2024 10:00:00,0\nTime,Ampl\n", "{T},{v}", "2 column 1, \"Time\" in s, assumed|unit_assumed"),
    ("R&S RTB2004", "in s,CH1 in V\n", "{T},{e}", "2 in s, by its name"),
    ("R&S RTM2054", "TIME,CH1\ns,V\n", "{T},{e}", "2 in s, by its name"),
    ("Yokogawa, two", "\"TraceName\",\"CH1\",\"CH2\"\n\"BlockSize\",1200,1200\n\"HResolution\",1.0E-05,1.0E-05\n\
        \"HOffset\",-6.0E-03,-6.0E-03\n\"HUnit\",\"s\",\"s\"\n\n", ",{g},{e}", "3 by 'HResolution|second_signal"),
    ("Yokogawa in ms", "\"HResolution\",1.0E-02\n\"HUnit\",\"ms\"\n\n", ",{e}", "!'HUnit,ms'"),
    ("GW Instek, fast", "Memory Length,1200\nSource,CH1\nHorizontal Units,S\nHorizontal Scale,1.0E-03\n\
        Sampling Period,1.0E-05\nFirmware,V1.20\nTime,01-May-24 10:00:00\n", "{d},{adc},",
        "2 by 'Sampling Period,1.0E-05'|second_signal"),
    ("GW Instek, detail", "Memory Length,1200,\nHorizontal Units,S,\nSampling Period,1.0E-05,\nMode,Detail,\n\
        Waveform Data,,\n", "{T},{v},", "2 column 1 in s, by 'Sampling Period"),
    ("Fluke", "Title;Input A\nDate;01.05.2024\nTime;Input A\ns;V\n", "{T};{e}", "2 in s, by its name"),
    ("OpenHantek", "\"t / s\",\"CH1 / V\",\"CH2 / V\"\n", "{t},{g},{v}", "3 in s, by its name|second_signal"),
    ("Hantek DSO5102P", "#CHANNEL:CH1\n#CLOCK=10.0uS\n#SIZE=1200\n#UNITS:V\n\n", "{v}", "!'#CLOCK=10.0uS'"),
    ("PicoScope 6", "Time,Channel A\n(ms),(V)\n\n", "{ms},{v}", "2 in ms, by its name"),
    ("PicoScope 7, French", "Temps;Voie A\n(µs);(mV)\n\n", "{,us};{,mv}", "2 in µs, by its name"),
    ("WaveForms", "#Digilent WaveForms Oscilloscope Acquisition\n#Date Time: 2024-05-01 10:00:00.123\n\
        #Sample rate: 100000Hz\n#Trigger: Source: Channel 1 Type: Edge Level: 0.5 V HoldOff: 0 s\n\n\
        Time (s),Channel 1 (V)\n", "{T},{v}", "2 in s, by its name"),
    ("Red Pitaya", "", "{v}", "!--rate 100000"),
    ("BitScope", "trigger,stamp,channel,index,type,delay,factor,rate,count,data\n",
        "0,10:20:30,0,0,0,0.0,1.0,100000,1200,{v}", "!"),
    // Logic analysers, data loggers, sound.
    ("Saleae", "Time[s], 0-Light, 1-Gate\n", "{t}, {v}, {g}", "2 in s, by its name|second_signal"),
    ("sigrok", "; CSV generated by libsigrok 0.5.2\n; Channels (2/2): A0, D0\n; Samplerate: 100 kHz\nA0,D0\n",
        "{v},{d}", "1 by '; Samplerate: 100 kHz'|second_signal"),
    ("PulseView, µs without a unit", "; Samplerate: 100 kHz\nTime,A0\n", "{us},{v}", "2 in µs, by '; Samplerate"),
    ("Audacity", "/data/us/take.ms   1 channel (mono)\nSample Rate: 100000 Hz. Linear.\n\n", "{i}\t{v}",
        "2 100000 samples a second, by"),
    ("LabVIEW", "Date\t2024/05/01\nTime\t10:00:00.0\nX0\t0.0E+0\nDelta_X\t1.0E-5\n***End_of_Header***\t\n\
        X_Value\tVoltage\tComment\n", "{t}\t{v}\t", "2 in s, by 'Delta_X"),
    ("LabChart", "Interval=\t1E-05 s\nRange=\t2.000 V\nUnitName=\tV\n", "{t}\t{v}", "!--unit"),
    ("AcqKnowledge", "2 channels\nLight\nVolts\nmsec\tCH1\tCH2\t\n\t1200\t1200\t\n", "{ms}\t{v}\t{g}\t",
        "2 \"msec\" in ms, by its name|second_signal"),
    ("Graphical Analysis", "Run 1: Time (ms),Run 1: Light (lx)\n", "{ms},{v}", "2 in ms, by its name"),
    ("catman", "Zeit  1 - Standardmessrate [s];Licht\n", "{,t};{,v}", "2 in s, by its name"),
    // Sketches, numbers, simulators.
    ("Arduino", "micros,adc\n", "{us},{adc}", "2 in µs, by its name"),
    ("Arduino, the time behind", "adc,t_us\n", "{adc},{us}", "1 in µs, by its name"),
    ("Arduino's plotter", "", "micros:{us},light:{adc}", "!a label before each number"),
    ("Arduino's monitor", "", "{day} -> {adc}", "3 column 1 in s, by the file"),
    ("a terminal's stamps", "", "[{day}] {adc}", "2 column 1 in s, by the file"),
    ("whole seconds beside", "Time,ms,V\n", "2024/05/01 10:00:07,{ms},{v}", "3 \"ms\" in ms, by its name"),
    ("minutes and seconds", "", "10:07.5,{v}", "!'10:07.5' is no time that is read"),
    ("dates and times", "Time,Light\n", "2024-12-31T{day}+01:00,{v}", "2 in s, by the file"),
    ("with decimal commas", "Date;Light\n", "31.12.2024 {,day};{,v}", "2 in s, by the file"),
    ("with halves of days", "", "10:00:00 AM,{v}", "!'10:00:00 AM' is no time that is read"),
    ("a date in each row", "Date;Time;ms;V\n", "01.05.2024;10:00:00;{,ms};{,v}", "4 in ms, by its name"),
    ("Teensy, bare", "", "{us} {adc}", "!counts without a unit"),
    ("STM32", "ticks,adc\n", "{us},{adc}", "!\"ticks\""),
    ("numpy, with blanks", "# time (ms) light (V)\n", "{ms} {e}", "2 in ms, by its name"),
    ("numpy, with commas", "# time (ms),light (V)\n", "{ms} {e}", "2 in ms, by its name"),
    ("names between other marks", "Time (ms);light (V)\n", "{ms},{e}", "2 in ms, by its name"),
    ("pandas", ",time_s,light\n", "{i},{t},{v}", "3 column 2, \"time_s\" in s, by its name"),
    ("R", "\"\",\"time_ms\",\"v\"\n", "\"{i}\",{ms},{v}", "3 in ms, by its name"),
    ("MATLAB, a timetable", "Time,v\n", "{t} sec,{v}", "!'0.000000 sec'"),
    ("ngspice", "", " {T}  {g}  {T}  {e} ", "4 in s, assumed|unit_assumed second_signal"),
    // An axis that is no time.
    ("a spectrum", "Frequency (kHz),Magnitude (dB)\n", "{ms},{v}", "!'Frequency (kHz)'"),
    ("a spectrum's header", "Horizontal Units,Hz\nSample Interval,1e-05\nTIME,MATH\n", "{t},{v}",
        "!'Horizontal Units,Hz'"),
    ("a spectrometer", "nm;counts\n", "{,ms};{,v}", "!'nm'"),
    ("an encoder", "Angle [°]\tV\n", "{us}\t{v}", "!'Angle [°]'"),
    ("a stage", "Position/mm V\n", "{us} {v}", "!\"Position/mm\" counts"),
    ("an axis's unit alone", "X Unit,mm\nX,CH1\n", "{ms},{v}", "!'X Unit,mm'"),
    ("a sweep", "Volt,Ampere\n", "{ms},{v}", "!'Volt'"),
    // A name with more than a unit, settings that are no names, other numbers that are no rate.
    ("tenths", "Time (tenths of ms),v\n", "{us},{v}", "!'Time (tenths of ms)'"),
    ("a scale in the name", "Time (s/div),v\n", "{us},{v}", "!'Time (s/div)'"),
    ("times 10", "t_us_x10,v\n", "{ms},{v}", "!'t_us_x10'"),
    ("trigger delay", "Trigger delay (ms),0.5\nTime,CH1\n", "{t},{v}", "2 in s, assumed|unit_assumed"),
    ("nominal exposure", "Nominal exposure (ms),8\n", "{t},{v}", "2 in s, assumed|unit_assumed"),
    ("an integration time", "Time (s),Integration time (ms),Light\n", "{t},8,{v}", "3 column 1, \"Time (s)\" in s"),
    ("mains beside the rate", "Mains frequency: 50 Hz\nSample rate: 100000 Hz\n", "{v}", "1 by 'Sample rate"),
    ("a rate against the unit", "Sample rate: 100 kHz\nTime (ms),v\n", "{t},{v}", "!different rates"),
    ("two rates", "Sample rate: 44100 Hz\nSample rate 48 kHz\nSample Interval,1e-5\n", "{v}", "!different rates"),
    ("German thousands", "Samplerate: 100.000 Hz\n", "{v}", "!'Samplerate: 100.000 Hz'"),
    // Columns and rows.
    ("nothing rises", "CH1,CH2\n", "{g},{v}", "!2: CH1, CH2"),
    ("one rises once", "CH1,CH2\n", "{up},{v}", "!2: CH1, CH2"),
    ("an index beside the time", "", "{i};{t};{v}", "3 column 2 in s, assumed|unit_assumed"),
    ("a count with a rate above", "# Sample rate: 100000 Hz\nSample,CH1\n", "{i},{v}", "2 by '# Sample rate"),
    ("numbers with zeros before them", "t_us,adc\n", "00{us},0{adc}", "2 in µs, by its name"),
    ("quoted decimal commas", "", "\"{,ms}\",\"{,v}\"", "2 in s, assumed|unit_assumed"),
    ("a flat channel beside it", "Time [s],A,B\n", "{t},{z},{v}", "3 \"Time [s]\" in s"),
    ("cross-talk beside a steep pulse", "Time [s],A,B\n", "{t},{talk},{g}", "3 in s|second_signal"),
    ("a word in each row", "time_s,state,light\n", "{t},ok,{v}", "3 in s, by its name"),
    ("pairs of one table", "Time (s),CH1 (V),Time (s),CH2 (V)\n", "{t},{g},{t},{v}", "4 in s|second_signal"),
    ("pairs of two", "Time (s),CH1 (V),Time (s),CH2 (V)\n", "{t},{g},{-t},{v}", "!hold different times"),
    ("decimal commas between commas", "", "{,t},{,v}", "!"),
    ("a decimal comma alone", "", "{,v}", "!--rate 100000"),
];

/// What a file is read as: the light's column and the times, the exposure in seconds, and the codes; or the refusal.
fn read(text: &str, options: &trace::Options) -> Result<(String, f64, String), String> {
    let recording = open(text.as_bytes(), options).map_err(|refusal| refusal.with_option())?;
    // A misreading shows without a fit.
    let record = Record::new(&recording.trace, &Options::default());
    let record = record.map_err(|refusal| format!("{refusal}; read: {}", recording.reading))?;
    let codes: Vec<&str> = recording.warnings.iter().map(|warning| warning.code()).collect();
    let told = format!("{} {}", recording.reading.signal.0, recording.reading.times());
    Ok((told, record.exposure(), codes.join(" ")))
}

#[test]
fn each_export_is_read_right_or_doubted_or_refused() {
    let judged = |k: u32| {
        let (name, above, row, told) = EXPORTS[k as usize];
        let said = read(&format!("{above}{}", rows(row)), &trace::Options::default());
        let (told, codes) = told.split_once('|').unwrap_or((told, ""));
        let (column, words) = told.split_once(' ').unwrap_or(("", told));
        let exposure = if name.starts_with("cross-talk") { 0.007 } else { 0.005 };
        let is_right = match (&said, told.strip_prefix('!')) {
            (Err(refusal), Some(words)) => refusal.contains(words),
            (Ok((read, found, doubted)), None) => {
                // The unit that is assumed may be another one, and then that is told.
                let powers = if codes.contains("unit_assumed") { &[1.0, 1e3][..] } else { &[1.0] };
                let is_right = powers.iter().any(|power| (found / power / exposure - 1.0).abs() < 5e-3);
                is_right && read.starts_with(&format!("{column} ")) && read.contains(words) && doubted == codes
            }
            _ => false,
        };
        (!is_right).then(|| format!("{name}: {said:?}"))
    };
    let wrong: Vec<String> = each(EXPORTS.len() as u32, judged).into_iter().flatten().collect();
    assert!(wrong.is_empty(), "of {} exports otherwise:\n{}", EXPORTS.len(), wrong.join("\n"));
}

/// Settings that give a step of 10 µs, or the first time, or nothing that is sure.
#[test]
fn a_setting_gives_the_times() {
    let light = rows("{v}");
    let times = |above: &str| open(format!("{above}\n{light}").as_bytes(), &trace::Options::default());
    let step = "Sample rate: 100000 Hz|Samplerate: 100 kHz|sample_rate=100 kHz|Sample Rate: 0.1 MHz. All is linear.|\
        Sample Rate: 100000.000 Hz|Sample Interval,1e-05,s|Sample Interval,CH1:1.0e-05|Sample interval: 0.01 ms|\
        HResolution,1E-5\nHUnit,s|Sample Interval,10,us\nHorizontal Units,ms|X,Start,Increment\nSequence,-6.0ms,10.0us";
    for above in step.split('|') {
        let times = times(above).expect("a step").trace.times;
        assert!((times[1000] - times[0] - 0.01).abs() < 1e-12, "{above}: {}", times[1000]);
    }
    let unsure = "Interval,2|Sample interval: 1e-300 s|Sample interval: 10|Sample rate: 100|\
        Sample interval (ms): 10 us|Sample rate: 100 k|Sample rate: 10 us|Sample rate: 100,000 Hz|Clock: 84 MHz|\
        Sample rate: 50 kHz (actual 100 kHz)|Max. sample rate: 1 GHz|Sample rate: 100.000 Hz|Sample rate: 1.000.000 Hz|\
        Mains frequency,50 Hz|Sample rate: 2 x 50 kHz|Sample rate: 100-200 kHz|Sample rate: 10 kHz/ch|\
        Sample rate: 1 kHz\nDecimation,8|Sample Interval,1e-5,2e-5|Sample Interval,1e-5\nXUnits,Hz|\
        Sample rate: 1 kHz\nSampling period,2 ms";
    unsure.split('|').for_each(|above| assert!(times(above).is_err(), "{above}"));
    let first = |above: &str| times(&format!("Sample rate: 100 kHz\n{above}")).expect("a rate").trace.times[0];
    let six_before = "HOffset,-6.0E-03\nHUnit,s|X,Start\nSequence,-6.0ms";
    six_before.split('|').for_each(|above| assert!((first(above) + 0.006).abs() < 1e-12, "{above}"));
    let nothing = "Trigger position: 600|TriggerOffset,-0.006|Start:,5|Start Time,10:00:00";
    nothing.split('|').for_each(|above| assert_eq!(first(above), 0.0, "{above}"));
}

/// What is asked beside the file: columns, a unit, a rate.
pub fn asked(columns: &str, unit: Option<Unit>, rate: Option<f64>) -> trace::Options {
    let columns = columns.split(',').filter(|name| !name.is_empty()).map(Column::parse).collect();
    trace::Options { unit, columns, rate, ..Default::default() }
}

#[test]
fn what_is_asked_beside_the_file_is_done() {
    let (kilo, micro, rate) = (Some(Unit::Millisecond), Some(Unit::Microsecond), Some(1e5));
    let timed = "Time (s),gate,light\n".to_string() + &rows("{t},{g},{v}");
    let bare = "CH1,CH2\n".to_string() + &rows("{g},{v}");
    let stated = "Sample rate: 1 MHz\nn,CH1,CH2\n".to_string() + &rows("{i},{g},{v}");
    let volts = "Volt\n".to_string() + &rows("{,v}");
    let named = "# a comment\n\"n\",\"sensor\",\"clock\"\n".to_string() + &rows("7,{v},{us}");
    let foreign = "Zeit,Licht\n".to_string() + &rows("{ms},{v}");
    let count = "Sample,CH1\n".to_string() + &rows("{i},{v}");
    #[rustfmt::skip]
    let cases = [
        (&rows("{v}"), asked("", None, rate), "1 100000 samples a second, as asked", 0.005, ""),
        (&volts, asked("", None, rate), "1 100000 samples a second, as asked", 0.005, ""),
        (&named, asked("clock,sensor", micro, None), "2 column 3, \"clock\" in µs, as asked", 0.005, ""),
        (&rows("7,{v},{us}"), asked("3,2", micro, None), "2 column 3 in µs, as asked", 0.005, ""),
        (&foreign, asked("", kilo, None), "2 column 1, \"Zeit\" in ms, as asked", 0.005, ""),
        (&count, asked("", None, rate), "2 100000 samples a second, as asked", 0.005, ""),
        (&count, asked("", kilo, None), "2 in ms, as asked", 0.5, ""),
        (&timed, asked("3", None, None), "3 column 1, \"Time (s)\" in s, by its name", 0.005, ""),
        (&timed, asked("gate", None, None), "2 column 1, \"Time (s)\" in s, by its name", 0.007, ""),
        (&timed, asked("1,2,3", None, None), "3 column 1, \"Time (s)\" in s", 0.005, "second_signal"),
        (&timed, asked("", kilo, None), "3 in ms, as asked, where its name says s", 5e-6, "second_signal"),
        (&timed, asked("", None, rate), "3 100000 samples a second, as asked", 0.005, "second_signal"),
        (&timed, asked("3", None, Some(1e3)), "3 as asked, where column 1, \"Time (s)\" has steps of 10 µs", 0.5, ""),
        (&bare, asked("", None, rate), "2 100000 samples a second, as asked", 0.005, "second_signal"),
        (&bare, asked("CH1", None, rate), "1 100000 samples a second, as asked", 0.007, ""),
        (&stated, asked("", None, rate), "3 100000 samples a second, as asked", 0.005, "second_signal"),
        (&stated, asked("2", None, None), "2 1000000 samples a second, by 'Sample rate", 0.0007, ""),
    ];
    for (text, options, told, exposure, codes) in cases {
        let (said, found, doubted) = read(text, &options).expect(told);
        let (column, words) = told.split_once(' ').unwrap();
        assert!(said.starts_with(column) && said.contains(words) && doubted == codes, "{told}: {said} {doubted}");
        assert!((found / exposure - 1.0).abs() < 5e-3, "{told}: {found}");
    }
    let twice = read(&timed, &asked("2,gate", None, None)).unwrap_err();
    assert!(twice.contains("2, \"gate\" is asked for twice"), "{twice}");
}

#[test]
fn rows_that_are_left_out_are_told_wherever_they_are() {
    let whole = "Time (s),gate,light\n".to_string() + &rows("{t},{g},{v}");
    let lines: Vec<&str> = whole.lines().collect();
    let without = |from: usize, field: &str| {
        let broken = |(k, line): (usize, &&str)| match line.rsplit_once(',') {
            Some((rest, _)) if (from..from + 150).contains(&k) => format!("{rest},{field}\n"),
            _ => format!("{line}\n"),
        };
        lines.iter().enumerate().map(broken).collect::<String>()
    };
    for (from, field) in [(1, "---"), (1, "saturated"), (30, ""), (1000, "?"), (50, "inf")] {
        let (told, exposure, doubted) = read(&without(from, field), &asked("", None, None)).expect("a trace");
        assert!(told.starts_with('3') && (exposure / 0.005 - 1.0).abs() < 5e-3, "{from} '{field}': {told} {exposure}");
        assert!(doubted.contains("broken_rows"), "{from} '{field}': {doubted}");
    }
    let refused = read(&without(1, "").replace(",\n", ",x\n").repeat(3), &asked("2,3", None, None));
    assert!(refused.is_err(), "{refused:?}");
}

#[test]
fn recordings_below_each_other_are_refused() {
    let block =
        |channel: &str, row: &str| format!("#CHANNEL:{channel}\n#Sample Interval=10.0uS\n#SIZE=1200\n\n{}", rows(row));
    let two = block("CH1", "{g}") + &block("CH2", "{v}");
    let refused = read(&two, &asked("", None, None)).unwrap_err();
    assert!(refused.contains("line 1205: '#CHANNEL:CH2' between the rows"), "{refused}");
    // A last remark is none.
    assert!(read(&(block("CH1", "{v}") + "#END\n"), &asked("", None, None)).is_ok());
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
    let recording = open(text.as_bytes(), &asked("", None, None)).expect("a trace");
    assert_eq!(recording.reading.signal, (2502, Some("S2500".into())));
}

/// Traces without any noise: a logic analyser's, a gate's, a simulation's.
#[test]
fn without_noise_the_error_is_that_of_a_sample() {
    let between = |t: f64, end: f64| (0.001..end).contains(&t);
    let ramps = |t: f64| (t - 0.001).min(0.009 - t).clamp(0.0, 0.001) / 0.001;
    let step = 4e-6;
    type Level<'a> = &'a dyn Fn(f64) -> f64;
    let cases: [(Level, f64, usize); 6] = [
        (&|t| f64::from(u8::from(between(t, 0.009))), 0.008, 2500),
        (&|t| if between(t, 0.009) { 3.3 } else { 0.0 }, 0.008, 2500),
        (&|t| if between(t, 0.004) { -5.0 } else { 1e-3 }, 0.003, 2500),
        (&|t| f64::from(u8::from(between(t, 0.00104))), 40e-6, 500),
        (&|t| 3.3 * ramps(t) + 0.1, 0.007, 2500),
        (&|t| 3.3 * ramps(t) - 1e-21, 0.007, 2500),
    ];
    for (k, (level, exposure, n)) in cases.into_iter().enumerate() {
        let times = (0..n).map(|i| step * i as f64);
        let text: String = times.map(|t| format!("{t:.6},{}\n", level(t))).collect();
        let recording = open(format!("time_s,v\n{text}").as_bytes(), &asked("", None, None)).expect("a trace");
        let fit = fit(&recording.trace, &Options::default(), &mut |_| ()).expect("a fit");
        let found = fit.exposure;
        let off = (found.value - exposure).abs();
        // Two edges, each known to a sample by the root of 12; of ramps the foot leaves more of the length unknown.
        assert!(off < 3.0 * found.error.max(1e-5 * exposure), "{k}: {found:?}");
        let is_box = k < 4;
        let efficiency = fit.efficiency.error / if is_box { step / exposure } else { 1e-3 };
        assert!(found.error < step && efficiency < 1.0, "{k}: {found:?} {:?}", fit.efficiency);
        assert!(!is_box || found.error > 0.3 * step, "{k}: {found:?}");
        let report = shutter_fit::text("logic", &fit);
        let words = || report.split([' ', '\n', ',', ';', '(', ')']);
        let is_dust = |word: &&str| word.parse::<f64>().is_ok_and(|x| word.contains("e-") && x.abs() < 1e-8);
        let is_minus_zero = |word: &&str| word.starts_with("-0") && word.parse::<f64>() == Ok(0.0);
        assert!(!words().any(|word| is_dust(&word) || is_minus_zero(&word)), "{k}: {report}");
    }
}
