//! The exports of instruments: what must be read of each, or which words must refuse or doubt it.
//!
//! All are of one shutter with an exposure of 5 ms, beside a gate of 7 ms where there are two channels. So what is
//! misread shows in the exposure.

use std::sync::LazyLock;

use shutter_fit::trace::{self, Column, Refusal, Tell, Trace, open};
use shutter_fit::unit::Unit;
use shutter_fit::{Options, Record, fit};

use crate::generator::{Random, each};

/// The light opens from 2 to 4 ms and closes from 7 to 9. In a row, `{v}` is the light from 0 to 1, `{e}` the same in
/// exponential notation, `{mv}` in thousands, `{adc}` in whole ones, `{g}` a gate of 5 V, `{d}` one of 0 and 1,
/// `{up}` a rise, `{z}` a channel that is not connected; `{t}` seconds, `{T}` exponential, `{-t}` from before the
/// trigger, `{ms}`, `{us}`, `{k us}` with its thousands apart, `{ns}`; `{i}` counts; `{set}` is a setting in the first
/// rows. A comma before the brace, as in `{,v}`, is a decimal one.
pub fn rows(row: &str) -> String {
    static ALL: LazyLock<Vec<Vec<(String, String)>>> = LazyLock::new(fields);
    let mut text = String::new();
    for fields in ALL.iter() {
        let mut line = row.to_string();
        for (name, value) in fields {
            if row.contains(name) {
                line = line.replace(name, value);
            }
        }
        text += &(line + "\n");
    }
    text
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
        let fields = [
            ("i", i.to_string()),
            ("t", format!("{t:.6}")),
            ("T", format!("{:.6e}", t - 0.006)),
            ("-t", format!("{:.6}", t - 0.006)),
            ("ms", format!("{:.4}", t * 1e3)),
            ("-ms", format!("{:.4}", t * 1e3 - 6.0)),
            ("us", format!("{:.1}", t * 1e6)),
            ("k us", format!("{}\u{202f}{:05.1}", 1 + i / 100, t * 1e6 % 1e3)),
            ("ns", format!("{:.0}", t * 1e9)),
            ("v", format!("{v:.5}")),
            ("e", format!("{v:.5e}")),
            ("mv", format!("{:.2}", v * 1e3)),
            ("adc", format!("{:.0}", v * 1e3)),
            ("g", format!("{:.3}", if gate { 5.0 } else { 0.02 } + 0.01 * random.normal())),
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

/// Name, what stands above the rows, a row, the light's column (0: the file is refused), what is told of the times (or
/// of the refusal), and the codes of what is doubted.
type Export = (&'static str, &'static str, &'static str, usize, &'static str, &'static str);

const GW_INSTEK: &str = "Format,2.0B\nMemory Length,1200\nIntpDistance,0\nTrigger Address,600\nTrigger Level,1.0E-01\n\
    Source,CH1\nVertical Units,V\nVertical Scale,2.0E-01\nHorizontal Units,S\nHorizontal Scale,1.0E-03\n\
    Horizontal Position,0.0E+00\nHorizontal Mode,Main\nSincET Mode,Real Time\nSampling Period,1.0E-05\nFirmware,V1.20\n\
    Time,01-May-24 10:00:00\n";

#[rustfmt::skip]
const EXPORTS: &[Export] = &[
    // Rigol.
    ("DS1054Z", "X,CH1,Start,Increment,\nSequence,VOLT,-6.000000e-03,1.000000e-05\n", "{i},{e},,", 2, "by 'Increment",
        ""),
    ("MSO5074, units in the values", "X,CH1,Start,Increment,\nSequence,Volt,-6.000ms,10.000us,\n", "{i},{e},,", 2,
        "by 'Increment", ""),
    ("DS1052E", "X,CH1,\nSecond,Volt,\n", "{T},{e},", 2, "in s, by its name", ""),
    ("DHO804", "CH1V,t0 =-6.000000e-03, tInc = 1.000000e-05,\n", "{e},,", 1, "by 'tInc", ""),
    ("DHO814, units in the values", "CH1V,t0 = -6.000ms, tInc = 10us\n", "{e}", 1, "by 'tInc", ""),
    ("MSO8204", "Time(s),CH1(V)\n", "{T},{e}", 2, "in s, by its name", ""),
    ("DS6104", "X(S),CH1(V)\n", "{T},{e}", 2, "in s, by its name", ""),
    ("DS2072A", "Time,CH1\n", "{T},{e}", 2, "in s, assumed", "unit_assumed"),
    // Siglent.
    ("SDS1104X-E", "Record Length,Analog:1200\nSample Interval,Analog:0.0000100\nVertical Units,CH1:V\n\
        Vertical Scale,CH1:0.20\nHorizontal Units,S\nHorizontal Scale,0.001\nModel Number,SDS1104X-E\nSource,CH1\n\
        Second,Volt\n", "{T},{v}", 2, "in s, by its name", ""),
    ("SDS1102CML", "Record Length,1200,Points\nSample Interval,0.00001,s\nTrigger Point,600,Samples\nSource,CH1\n",
        "{-t},{v}", 2, "in s, by 'Sample Interval,0.00001,…", ""),
    // Tektronix.
    ("TDS2024B, settings beside the rows", "", "{set},,{-t},  {v},", 5, "in s, by 'Sample Interval,1e-05", ""),
    ("a unit without a rate", "Model,M1\nHorizontal Units,ms\nTIME,CH1\n", "{ms},{v}", 2,
        "in ms, by 'Horizontal Units,ms'", ""),
    ("a unit against the rate", "Sample Interval,1E-5\nHorizontal Units,ms\nTIME,CH1\n", "{us},{v}", 0,
        "different rates", ""),
    ("a path above the numbers", "/data/us/take.ms   1 channel (mono)\nSample Rate: 100000 Hz. Linear.\n\n", "{i}\t{v}",
        2, "100000 samples a second, by", ""),
    ("German thousands", "Abtastrate: 100.000 Hz\n", "{v}", 0, "'Abtastrate: 100.000 Hz'", ""),
    ("TDS3012", "", "{-t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("DPO2014", "Model,DPO2014\nFirmware Version,1.52\n\nPoint Format,Y,\nHorizontal Units,S,\n\
        Horizontal Scale,0.001,\nSample Interval,1e-05,\nFilter Frequency,1.5e+06\nRecord Length,1200,\n\
        Gating,0.0% to 100.0%,\nProbe Attenuation,1,\nVertical Units,V,\nLabel,,\nTIME,CH1\n", "{T},{v}", 2,
        "in s, by 'Sample Interval,1e-05", ""),
    // Keysight.
    ("DSOX3024T", "x-axis,1\nsecond,Volt\n", "{T},{e}", 2, "in s, by its name", ""),
    ("EDUX1052, blanks", "x-axis, 1, 2\nsecond, Volt, Volt\n", "{T}, {e}, {z}", 2, "in s, by its name", ""),
    ("Infiniium", "Revision:,0\nType:,raw\nStart:,0\nPoints:,1200\nCount:,1\nXDispRange:,1.2E-02\nXDispOrg:,-6E-03\n\
        XInc:,1.0E-05\nXOrg:,-6.0E-03\nXUnits:,Second\nYUnits:,Volt\nFrame:,DSO9254A\nData:\n", "{T},{v}", 2,
        "in s, by 'XInc:,1.0E-05'", ""),
    // LeCroy.
    ("WaveRunner 62Xi", "LECROYWR62Xi,1234,Waveform\nSegments,1,SegmentSize,1200\nSegment,TrigTime,TimeSinceSegment1\n\
        #1,18-Mar-2024 10:00:00,0\nTime,Ampl\n", "{T},{v}", 2, "column 1, \"Time\" in s, assumed", "unit_assumed"),
    // Rohde & Schwarz.
    ("RTB2004", "in s,CH1 in V\n", "{T},{e}", 2, "in s, by its name", ""),
    ("HMO1002", "[s],CH1[V]\n", "{T},{e}", 2, "in s, by its name", ""),
    ("RTM2054", "TIME,CH1\ns,V\n", "{T},{e}", 2, "in s, by its name", ""),
    ("RTH1004", "Time (s);C1 (V)\n", "{,-t};{,v}", 2, "in s, by its name", ""),
    // Yokogawa.
    ("DL750, two traces",
        "\"TraceName\",\"CH1\",\"CH2\"\n\"BlockSize\",1200,1200\n\"VUnit\",\"V\",\"V\"\n\"HResolution\",1.0E-05,1.\
        0E-05\n\"HOffset\",-6.0E-03,-6.0E-03\n\"HUnit\",\"s\",\"s\"\n\n", ",{g},{e}", 3, "by 'HResolution",
        "second_signal"),
    // Hantek.
    ("DSO5102P", "#CHANNEL:CH1\n#CLOCK=10.0uS\n#SIZE=1200\n#UNITS:V\n\n", "{v}", 1, "by '#CLOCK=10.0uS'", ""),
    ("6022BE, OpenHantek", "\"t / s\",\"CH1 / V\",\"CH2 / V\"\n", "{t},{g},{v}", 3, "in s, by its name",
        "second_signal"),
    ("DSO2D15", "nr,time,ch1,ch2,ch1s,ch2s\n", "{i},{t},{v},{z},{adc},7", 3, "in s, assumed",
        "unit_assumed second_signal"),
    // Owon.
    ("XDS3064E", "Channel :,CH1\nFrequency :,F=125.0Hz\nPeriod :,T=8.000ms\nPK-PK :,Vp=900mV\n\
        Probe attenuation :,X1\n\nTime interval :,10.000uS\n\nIndex,CH1_Voltage(mV)\n", "{i},{mv}", 2,
        "by 'Time interval", ""),
    // Fluke, GW Instek.
    ("ScopeMeter 199C", "Title;Input A\nDate;01.05.2024\nTime;Input A\ns;V\n", "{T};{e}", 2, "in s, by its name", ""),
    ("GDS-1054B, fast", GW_INSTEK, "{adc},", 1, "by 'Sampling Period,1.0E-05'", ""),
    ("DCS-9700, two, fast", GW_INSTEK, "{d},{adc},", 2, "by 'Sampling Period,1.0E-05'", "second_signal"),
    // PicoScope, Analog Discovery, Red Pitaya, Velleman, BitScope.
    ("PicoScope 6, ms", "Time,Channel A\n(ms),(V)\n\n", "{-ms},{v}", 2, "in ms, by its name", ""),
    ("PicoScope 7, French", "Temps;Voie A\n(µs);(mV)\n\n", "{,us};{,mv}", 2, "in µs, by its name", ""),
    ("WaveForms", "#Digilent WaveForms Oscilloscope Acquisition\n#Device Name: Discovery2\n\
        #Date Time: 2024-05-01 10:00:00.123\n#Sample rate: 100000Hz\n#Samples: 1200\n\
        #Trigger: Source: Channel 1 Type: Edge Level: 0.5 V HoldOff: 0 s\n\
        #Channel 1: Range: 5 V/div Offset: 0 V Attenuation: 1 X\n\nTime (s),Channel 1 (V)\n", "{T},{v}", 2,
        "in s, by its name", ""),
    ("Red Pitaya, values", "", "{v}", 0, "--rate 100000", ""),
    ("Red Pitaya, two channels", "IN1,IN2\n", "{v},{z}", 0, "IN1", ""),
    ("PCSGU250", "TIME STEP:\n\n250 = 5ms\nVOLTAGE STEP:\nCH1: 32 = 0.3V\n\nN\tCH1\tCH2\n", "{i}\t{adc}\t128", 0,
        "\"N\"", ""),
    ("BitScope", "trigger,stamp,channel,index,type,delay,factor,rate,count,data\n",
        "0,10:20:30,0,0,0,0.0,1.0,100000,1200,{v}", 0, "", ""),
    // Logic analysers.
    ("Saleae Logic 1", "Time[s], 0-Light, 1-Gate\n", "{t}, {v}, {g}", 2, "in s, by its name", "second_signal"),
    ("sigrok, analog and logic", "; CSV generated by libsigrok 0.5.2\n; Channels (2/2): A0, D0\n; Samplerate: 100 kHz\n\
        A0,D0\n", "{v},{d}", 1, "by '; Samplerate: 100 kHz'", "second_signal"),
    ("PulseView, times in µs without a unit", "; Channels (1/1): A0\n; Samplerate: 100 kHz\nTime,A0\n", "{us},{v}", 2,
        "in µs, by '; Samplerate: 100 kHz'", ""),
    // National Instruments.
    ("LVM", "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tOne\nTime_Pref\tAbsolute\n***End_of_Header***\t\n\
        Channels\t1\nSamples\t1200\nDate\t2024/05/01\nTime\t10:00:00.0\nX_Dimension\tTime\nX0\t0.0E+0\n\
        Delta_X\t1.0E-5\n***End_of_Header***\t\nX_Value\tVoltage\tComment\n", "{t}\t{v}\t", 2, "in s, by 'Delta_X", ""),
    ("LabVIEW waveform", "waveform\n[0]\nt0\t5/1/2024 10:00:00\ndelta t\t1.0E-5\n\ntime[0]\tY[0]\n",
        "5/1/2024 10:00:00\t{v}", 2, "by 'delta t", ""),
    ("Dewesoft", "Data1\nTime (s)\tAI 1 [V]\n", "{t}\t{v}", 2, "in s, by its name", ""),
    ("LabChart", "Interval=\t1E-05 s\nChannelTitle=\tLight\tSync\nRange=\t2.000 V\t5.000 V\nUnitName=\tV\tV\n",
        "{t}\t{v}\t{g}", 2, "in s, by 'Interval= 1E-05 s'", "second_signal"),
    ("AcqKnowledge", "0.01 msec/sample\n2 channels\nLight\nVolts\nmsec\tCH1\tCH2\t\n\t1200\t1200\t\n",
        "{ms}\t{v}\t{g}\t", 2, "\"msec\" in ms, by its name", "second_signal"),
    ("Graphical Analysis", "Run 1: Time (ms),Run 1: Light (lx)\n", "{ms},{v}", 2, "in ms, by its name", ""),
    ("OpenSignals", "# OpenSignals Text File Format\n# {\"sampling rate\": 1000, \"channels\": [1]}\n# EndOfHeader\n",
        "7\t0\t{adc}", 0, "column", ""),
    // Sound, microcontrollers, numbers, simulators.
    ("Arduino, the time behind", "adc,t_us\n", "{adc},{us}", 1, "in µs, by its name", ""),
    ("Arduino's plotter", "", "Time:{ms},Light:{adc}", 0, "Time:6.0000", ""),
    ("Teensy, bare", "", "{us} {adc}", 0, "counts without a unit", ""),
    ("STM32, ticks", "ticks,adc\n", "{us},{adc}", 0, "\"ticks\"", ""),
    ("Octave", "# Created by Octave 8.4\n# name: A\n# type: matrix\n# rows: 1200\n# columns: 2\n", " {T} {e}", 2,
        "in s, assumed", "unit_assumed"),
    ("numpy", "", "{T} {e}", 2, "in s, assumed", "unit_assumed"),
    ("numpy, a header with blanks", "# time (ms) light (V)\n", "{ms} {e}", 2, "in ms, by its name", ""),
    ("pandas", ",time_s,light\n", "{i},{t},{v}", 3, "column 2, \"time_s\" in s, by its name", ""),
    ("R", "\"\",\"time_ms\",\"v\"\n", "\"{i}\",{ms},{v}", 3, "in ms, by its name", ""),
    ("MATLAB, writetimetable", "Time,v\n", "{t} sec,{v}", 0, "'0.000000 sec'", ""),
    ("ngspice, print", "No. of Data Rows : 1200\nIndex   time            v(out)\n------------------------\n",
        "{i}\t{T}\t{e}\t", 3, "column 2, \"time\" in s, assumed", "unit_assumed"),
    ("ngspice, wrdata", "", " {T}  {g}  {T}  {e} ", 4, "in s, assumed", "unit_assumed second_signal"),
    // By hand, and with what others add.
    ("seconds in prose", "Leica M3, 1/125 s = 8 ms nominal\n\nTime (s),CH1\n", "{t},{v}", 2, "in s, by its name", ""),
    ("a unit in prose alone", "measured in ms at 1/125 s\ntime,v\n", "{t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("an index beside the time", "No.,Elapsed (s),Light\n", "{i},{t},{v}", 3, "column 2, \"Elapsed (s)\" in s", ""),
    ("an index, without names", "", "{i};{t};{v}", 3, "column 2 in s, assumed", "unit_assumed"),
    ("a count with a rate above", "# Sample rate: 100000 Hz\nSample,CH1\n", "{i},{v}", 2, "by '# Sample", ""),
    ("a lone rate", "100000 Hz\n# bits: 12\n", "{v}", 1, "by '100000 Hz'", ""),
    ("a blank between thousands", "sep=;\nTemps (µs);Lumière\n", "{,k us};{,v}", 2, "in µs, by its name", ""),
    ("signs apart", "NO.,Time,ms,V\n", "{i},2026/11/20 10:00:07,+ {ms},+  {v}", 4, "in ms, by its name", ""),
    ("quoted decimal commas", "", "\"{,ms}\",\"{,v}\"", 2, "in s, assumed", "unit_assumed"),
    ("a flat channel beside it", "Time [s],A,B\n", "{t},{z},{v}", 3, "\"Time [s]\" in s", ""),
    // A setting above the names tells no unit.
    ("trigger delay", "Trigger delay (ms),0.5\nTime,CH1\n", "{t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("nominal exposure, no names", "Nominal exposure (ms),8\n", "{t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("an operator, no names", "Operator Ms. Smith,2026\n", "{t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("a scale and its values", "Time,CH1\nms/div,mV/div\n1,200\n", "{t},{v}", 0, "'ms/div'", ""),
    ("a scale's unit", "Time/div (ms),1\n", "{t},{v}", 0, "'Time/div (ms)'", ""),
    ("a remark", "# leaf shutter in ms, lens\n", "{t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("another remark", "# shutter 8 ms, lens 50 mm\n", "{t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("a line below the names", "t_ms  v\n----- ----\n", "{ms}  {v}", 2, "\"t_ms\" in ms, by its name", ""),
    ("an acquisition, no names", "Acquisition,Real Time\n", "{-t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("an exposure time", "Mode,Exposure time\n", "{-t},{v}", 2, "in s, assumed", "unit_assumed"),
    ("an integration time", "Time (s),Integration time (ms),Light\n", "{t},8,{v}", 3,
        "column 1, \"Time (s)\" in s, by its name", ""),
    ("a decimal comma", "Abtastintervall [ms];0,01\nLicht;Gate\n", "{,v};{,g}", 1, "100000 samples a second",
        "second_signal"),
    // Another number is no rate.
    ("mains beside the rate", "Mains frequency: 50 Hz\nSample rate: 100000 Hz\n", "{v}", 1, "by 'Sample rate", ""),
    ("a rate against the unit", "Sample rate: 100 kHz\nTime (ms),v\n", "{t},{v}", 0, "different rates", ""),
    ("two rates", "Sample rate: 44100 Hz\nSampling rate 48 kHz\n", "{v}", 0, "different rates", ""),
    // A name with more than a unit.
    ("tenths", "Time (tenths of ms),v\n", "{us},{v}", 0, "'Time (tenths of ms)'", ""),
    ("a factor in the row of units", "Time,v\n10us,V\n", "{i},{v}", 0, "column 1 counts", ""),
    ("a scale in the name", "Time (s/div),v\n", "{us},{v}", 0, "'Time (s/div)'", ""),
    ("times 10", "t_us_x10,v\n", "{i},{v}", 0, "'t_us_x10'", ""),
    ("a factor below the name", "Time,Light\nx10 us,V\n", "{i},{v}", 0, "'x10 us'", ""),
    // Columns and rows.
    ("nothing rises", "CH1,CH2\n", "{g},{v}", 0, "2: CH1, CH2", ""),
    ("one rises once", "CH1,CH2\n", "{up},{v}", 0, "2: CH1, CH2", ""),
    ("a date in each row", "Date;Time;ms;V\n", "01.05.2024;10:00:00;{,ms};{,v}", 4, "in ms, by its name", ""),
    ("names with other marks", "Time (ms),V\n", "{ms} {v}", 2, "in ms, by its name", ""),
    ("a word in each row", "time_s,state,light\n", "{t},ok,{v}", 3, "in s, by its name", ""),
    ("times of day", "", "2024-05-01T10:00:00.{i},{v}", 0, "2024-05-01T10:00:00.", ""),
    ("accounts, and a typographer's minus", "Time (ms),v\n", "{-ms},{v}", 2, "in ms, by its name", ""),
    ("pairs of one table", "Time (s),CH1 (V),Time (s),CH2 (V)\n", "{t},{g},{t},{v}", 4, "in s, by its name",
        "second_signal"),
    ("decimal commas between commas", "", "{,t},{,v}", 0, "", ""),
];

/// What a file is read as: the light's column, the times, the exposure in seconds and the codes; or the refusal.
type Read = Result<(usize, String, f64, String), String>;

fn read(text: &str, options: &trace::Options) -> Read {
    read_by(text, options, |trace| Ok(fit(trace, &Options::default(), &mut |_| ())?.exposure.value))
}

fn read_by(text: &str, options: &trace::Options, exposure: impl Fn(&Trace) -> Result<f64, Refusal>) -> Read {
    let recording = open(text.as_bytes(), options).map_err(|refusal| refusal.with_option())?;
    let exposure = exposure(&recording.trace);
    let exposure = exposure.map_err(|refusal| format!("{refusal}; read: {}", recording.reading))?;
    let codes: Vec<&str> = recording.warnings.iter().map(|warning| warning.code()).collect();
    Ok((recording.reading.signal.0, recording.reading.times(), exposure, codes.join(" ")))
}

/// What is wrong with the reading of an export, and whether anyone could see that.
fn judged(export: &Export) -> Result<(), (String, bool)> {
    let (name, above, row, column, told, codes) = *export;
    let mut body = rows(row);
    if name.starts_with("accounts") {
        // Every other minus is one or the other.
        let lines = body.lines().enumerate().map(|(k, line)| match line.strip_prefix('-') {
            Some(rest) if k % 2 == 0 => format!("\u{2212}{rest}\n"),
            Some(rest) => format!("({}),{}\n", &rest[..6], &rest[7..]),
            None => format!("{line}\n"),
        });
        body = lines.collect();
    }
    let text = above.to_string() + &body;
    // A misreading shows without a fit.
    let shown = |trace: &Trace| Ok(Record::new(trace, &Options::default())?.exposure());
    match read_by(&text, &trace::Options::default(), shown) {
        Err(refusal) if column > 0 => Err((format!("{name}: refused: {refusal}"), true)),
        Err(refusal) if !refusal.contains(told) => Err((format!("{name}: refused without '{told}': {refusal}"), true)),
        Err(_) => Ok(()),
        Ok((signal, times, exposure, doubted)) => {
            // The unit that is assumed may be another one, and then that is told.
            let is_assumed = doubted.contains("unit_assumed");
            let powers = if is_assumed { &[1.0, 1e3, 1e6][..] } else { &[1.0] };
            let is_right = powers.iter().any(|power| (exposure / power / 0.005 - 1.0).abs() < 5e-3);
            let said = format!("{name}: column {signal}, {times}, {exposure} s, [{doubted}]");
            match is_right {
                false => Err((said, !doubted.is_empty())),
                _ if column == 0 => Err((format!("not refused: {said}"), true)),
                _ if signal != column || !times.contains(told) => Err((said, true)),
                _ if doubted != codes => Err((said, true)),
                _ => Ok(()),
            }
        }
    }
}

#[test]
fn each_export_is_read_right_or_doubted_or_refused() {
    let results = each(EXPORTS.len() as u32, |k| judged(&EXPORTS[k as usize]));
    let wrong: Vec<_> = results.into_iter().filter_map(Result::err).collect();
    let silent = wrong.iter().filter(|(_, is_seen)| !is_seen).count();
    for (said, is_seen) in &wrong {
        println!("{}{said}", if *is_seen { "" } else { "IN SILENCE: " });
    }
    let count = EXPORTS.len();
    assert!(wrong.is_empty(), "of {count} exports {} otherwise, {silent} wrong in silence", wrong.len());
}

/// Settings that give a step of 10 µs, or the first time, or nothing that is sure.
#[test]
fn a_setting_gives_the_times() {
    let light = rows("{v}");
    let times = |above: &str| open(format!("{above}\n{light}").as_bytes(), &trace::Options::default());
    let step = "Sample rate: 100000 Hz|Samplerate: 100 kHz|Sampling rate 100 kHz|Sampling rate (kHz): 100|\
        Sample Rate [kS/s],100|Sampling Rate:100.0KSa/s|sampling_rate_hz=100000|100 kHz|100.000 kHz|\
        Sample Rate: 100000 Hz. Values are linear.|Sample rate: 100000.000|XInc,10\nXUnits,us|\
        HResolution,1E-5\nHUnit,s|Sample Interval,1e-05,s|Sample Interval,Analog:1.0e-05|Sample Interval(uS),10.0|\
        Sample interval in ms = 0.01|XInc:,1.0E-05|CLOCK=10.0uS|Interval=,1E-05 s|0.01 msec/sample|\
        Unit,wf_increment\nV,0.00001|X,Start,Increment\nSequence,-6.0ms,10.0us";
    for above in step.split('|') {
        let times = times(above).expect("a step").trace.times;
        assert!((times[1000] - times[0] - 0.01).abs() < 1e-12, "{above}: {}", times[1000]);
    }
    let unsure = "Interval,2|10 msec|Sample interval: 1e-300 s|Sample rate: 0.00001|Sample interval: 10|\
        Sample interval (ms): 10 us|Sample rate: 100 k|Sample rate: 10 us|Sample rate: 100,000 Hz|Clock: 84 MHz|\
        Sample rate: 50 kHz (actual 100 kHz)|Max. sampling rate: 1 GS/s|CPU clock: 84 MHz|Frequency: 125 Hz|\
        Sample rate: 100.000 Hz|Sample rate: 1.000.000|Exposure period: 8 ms|Mains frequency,50 Hz|\
        Sample rate: 2 x 50 kHz|Sample rate: 100-200 kHz|Sample rate: 1 Hz\nSample period,2|\
        Sample rate: 1 Hz\nDecimation,8|PWM frequency: 25 kHz|Data rate: 115200|Refresh rate: 60 Hz|Decimation rate: 8";
    unsure.split('|').for_each(|above| assert!(times(above).is_err(), "{above}"));
    let first = |above: &str| times(&format!("Sample rate: 100 kHz\n{above}")).expect("a rate").trace.times[0];
    let six_before = "CH1,t0 = -6ms, tInc = 10us|HOffset,-6.0E-03\nHUnit,s|HOffset,-6\nHUnit,ms|XZERO,-0.006|\
        Unit,wf_start_offset\nV,-0.006|XOrg:,-6.0E-03\nStart:,0|Trigger Point,600,Samples|Trigger position: 600|\
        Trigger Address,600|Zero Index,600|X,Start\nSequence,-6.0ms";
    six_before.split('|').for_each(|above| assert!((first(above) + 0.006).abs() < 1e-12, "{above}"));
    let nothing = "Trigger position: 50 %|Trigger position: 6 ms|TriggerOffset,-0.006|Trigger Level,1.0";
    nothing.split('|').for_each(|above| assert_eq!(first(above), 0.0, "{above}"));
}

/// What is asked beside the file: columns, a unit, a rate.
fn asked(columns: &str, unit: Option<Unit>, rate: Option<f64>) -> trace::Options {
    let columns = columns.split(',').filter(|name| !name.is_empty()).map(Column::parse).collect();
    trace::Options { unit, columns, rate, ..Default::default() }
}

#[test]
fn what_is_asked_beside_the_file_is_done() {
    let (kilo, rate) = (Some(Unit::Millisecond), Some(1e5));
    let timed = "Time (s),gate,light\n".to_string() + &rows("{t},{g},{v}");
    let bare = "CH1,CH2\n".to_string() + &rows("{g},{v}");
    let stated = "Sample rate: 1 MHz\nn,CH1,CH2\n".to_string() + &rows("{i},{g},{v}");
    let light = rows("{v}");
    let volts = "Volt\n".to_string() + &rows("{,v}");
    let mixed = rows("7,{v},{us}");
    let named = "# a comment\n\"n\",\"sensor\",\"clock\"\n".to_string() + &mixed;
    let micro = Some(Unit::Microsecond);
    #[rustfmt::skip]
    let cases = [
        (&light, asked("", None, rate), 1, "100000 samples a second, as asked", 0.005, ""),
        (&volts, asked("", None, rate), 1, "100000 samples a second, as asked", 0.005, ""),
        (&named, asked("clock,sensor", micro, None), 2, "column 3, \"clock\" in µs, as asked", 0.005, ""),
        (&mixed, asked("3,2", micro, None), 2, "column 3 in µs, as asked", 0.005, ""),
        (&timed, asked("3", None, None), 3, "column 1, \"Time (s)\" in s, by its name", 0.005, ""),
        (&timed, asked("gate", None, None), 2, "column 1, \"Time (s)\" in s, by its name", 0.007, ""),
        (&timed, asked("1,2,3", None, None), 3, "column 1, \"Time (s)\" in s, by its name", 0.005, "second_signal"),
        (&timed, asked("", kilo, None), 3, "in ms, as asked, where its name says s", 5e-6, "second_signal"),
        (&timed, asked("", None, rate), 3, "100000 samples a second, as asked", 0.005, "second_signal"),
        (&bare, asked("", None, rate), 2, "100000 samples a second, as asked", 0.005, "second_signal"),
        (&bare, asked("1,2", None, rate), 2, "100000 samples a second, as asked", 0.005, "second_signal"),
        (&bare, asked("CH1", None, rate), 1, "100000 samples a second, as asked", 0.007, ""),
        (&stated, asked("", None, rate), 3, "100000 samples a second, as asked", 0.005, "second_signal"),
        (&stated, asked("2", None, None), 2, "1000000 samples a second, by 'Sample rate", 0.0007, ""),
    ];
    for (text, options, column, told, exposure, codes) in cases {
        let (signal, times, found, doubted) = read(text, &options).expect("a fit");
        assert!(signal == column && times.contains(told) && doubted == codes, "{signal} {times} {doubted}");
        assert!((found / exposure - 1.0).abs() < 1e-3, "{told}: {found}");
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
    for (from, field) in [(1, ""), (1, "---"), (1, "saturated"), (30, ""), (1000, "?")] {
        let (signal, _, exposure, doubted) = read(&without(from, field), &asked("", None, None)).expect("a fit");
        assert!(signal == 3 && (exposure / 0.005 - 1.0).abs() < 5e-3, "{from} '{field}': {signal} {exposure}");
        assert!(doubted.contains("broken_rows"), "{from} '{field}': {doubted}");
    }
    let refused = read(&without(1, "").replace(",\n", ",x\n").repeat(3), &asked("2,3", None, None));
    assert!(refused.is_err(), "{refused:?}");
}

#[test]
fn recordings_below_each_other_are_refused() {
    let block = |channel: &str, row: &str| format!("#CHANNEL:{channel}\n#CLOCK=10.0uS\n#SIZE=1200\n\n{}", rows(row));
    let two = block("CH1", "{g}") + &block("CH2", "{v}");
    let refused = read(&two, &asked("", None, None)).unwrap_err();
    assert!(refused.contains("line 1205: '#CHANNEL:CH2' between the rows"), "{refused}");
    // A last remark is none.
    assert!(read(&(block("CH1", "{v}") + "#END\n"), &asked("", None, None)).is_ok());
}

#[test]
fn a_table_of_thousands_of_columns_is_read_soon() {
    let clock = std::time::Instant::now();
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
    assert!(clock.elapsed().as_secs_f64() < 20.0, "{:?}", clock.elapsed());
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
