//! Every name that is read, as the instrument writes it; and what the name of a column means.

use shutter_fit::unit::Unit;

use crate::exports::{judge, rows};
use crate::names::Means::{Count, In, Time};
use crate::names::{KNOWN, Means, is_unit, said, words};

#[test]
fn each_name_is_read_as_its_instrument_writes_it() {
    for (name, means, by, line) in KNOWN {
        assert!(words(line).concat().contains(name) && !by.is_empty(), "{name}: {line}");
        let (row, must) = match (means, line.contains('\n')) {
            (Means::In(Unit::Millisecond), _) => ("{ms},{v}", "2 in ms, by its name"),
            (Means::In(Unit::Microsecond), _) => ("{us},{v}", "2 in µs, by its name"),
            (Means::In(Unit::Nanosecond), _) => ("{ns},{v}", "2 in ns, by its name"),
            (Means::In(_), _) => ("{-t},{v}", "2 in s, by its name"),
            (Means::Time | Means::Signal | Means::ScaleUnit, _) => ("{-t},{v}", "2 in s"),
            (Means::Count, _) => ("{i},{v}", "!counts without a unit"),
            (Means::Step | Means::StartBelow, true) if line.starts_with('X') => ("{i},{v},,", "2 , the first at -6 ms"),
            (Means::Start, _) => ("{v}", "1 , the first at -6 ms"),
            (Means::Step | Means::Rate | Means::TimeUnit | Means::StartBelow, _) => {
                ("{v}", "1 100000 samples a second")
            }
            (Means::Names, _) => (",{d},{v}", "3 column 3, \"CH2\" is taken|second_signal"),
        };
        let step = if *means == Means::Names { "Sample Interval,1e-5\n" } else { "" };
        let text = format!("{step}{line}\n{}", rows(row));
        let doubted = |must: &str| judge(text.as_bytes(), "", must);
        doubted(must).or_else(|_| doubted(&format!("{must}, assumed|unit_assumed"))).expect(line);
    }
}

#[test]
fn a_name_tells_a_time_its_unit_or_something_else() {
    for (told, names) in [
        (Some(In(Unit::Second)), "Time (s);Zeit  1 - Standardmessrate [s];t / s;in s;Second;Time_s;Elapsed (s);[s]"),
        (Some(In(Unit::Millisecond)), "TimeMs (ms);millis;Time in ms;Run 1: Time (ms);(ms)"),
        (Some(In(Unit::Microsecond)), "micros();time_µs;t_μs;(us);Temps (µs)"),
        (Some(In(Unit::Nanosecond)), "Time[ns];t_ns"),
        (Some(Time), "Time;TIME;t;X;x-axis"),
        (Some(Count), "Sequence"),
        (None, ""),
        (None, "Time (tenths of ms);Time (s/div);Time (h:m:s);Time (10us);Time x1000 (s);Time*1e6 (s);10us;tms"),
        (None, "Frequency (Hz);nm;deg;mm;Angle [°];λ (nm);Hz;CH1 (V);V/s;ms.A;ms/div;min;Time (min);t_us_x10;Zeit"),
        (None, "shutter 8 ms;/records/s.wav;TrigTime;Exposure time;X1;No.;time since start"),
    ] {
        names.split(';').for_each(|name| assert_eq!(said(name), told, "{name}"));
    }
    assert!(["(mV)", "Second", "V", "Sequence"].iter().all(|unit| is_unit(unit)));
    assert!(["ms/div", "10us", "CH1"].iter().all(|name| !is_unit(name)));
}
