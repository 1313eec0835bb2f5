//! Every name that is read, as the instrument writes it; and what names of columns and numbers mean.

use shutter_fit::Options;
use shutter_fit::trace::{self, Tell, open};
use shutter_fit::unit::Unit;

use crate::exports::rows;
use crate::names::Said::{Count, Nothing, Other, Time, Unit as In};
use crate::names::{KNOWN, Means, is_unit, said, words};
use crate::numbers::{Form, time_of_day};

#[test]
fn each_name_is_read_as_its_instrument_writes_it() {
    for (name, means, by, line) in KNOWN {
        let written = words(line);
        assert!(written.concat().contains(name) && !by.is_empty(), "{name}: {line}");
        let unit = match means {
            Means::In(Unit::Millisecond) => "{ms}",
            Means::In(Unit::Microsecond) => "{us}",
            Means::In(Unit::Nanosecond) => "{ns}",
            _ => "{-t}",
        };
        let row = match (means, line.contains('\n')) {
            (Means::Count, _) => "{i},{v}",
            (Means::Step | Means::StartBelow, true) if line.starts_with('X') => "{i},{v},,",
            (Means::Names, _) => ",{d},{v}",
            (Means::Step | Means::Rate | Means::Start | Means::TimeUnit, _) => "{v}",
            _ => &format!("{unit},{{v}}"),
        };
        let above = if *means == Means::Names { format!("Sample Interval,1e-5\n{line}") } else { line.to_string() };
        let read = open(format!("{above}\n{}", rows(row)).as_bytes(), &trace::Options::default());
        if *means == Means::Count {
            assert!(read.is_err_and(|refusal| refusal.with_option().contains("counts without a unit")), "{line}");
            continue;
        }
        let recording = read.unwrap_or_else(|refusal| panic!("{line}: {refusal}"));
        let fit = shutter_fit::fit(&recording.trace, &Options::default(), &mut |_| ()).expect(line);
        assert!((fit.exposure.value / 0.005 - 1.0).abs() < 5e-3, "{line}: {:?}", fit.exposure);
        let starts = recording.trace.times[0];
        assert!(
            !matches!(means, Means::Start | Means::StartBelow) || (starts + 0.006).abs() < 1e-9,
            "{line}: {starts}"
        );
        assert_eq!(*means == Means::Names, recording.reading.signal.1.as_deref() == Some("CH2"), "{line}");
    }
}

#[test]
fn a_name_tells_a_time_its_unit_or_something_else() {
    for (told, names) in [
        (In(Unit::Second), "Time (s);Zeit  1 - Standardmessrate [s];t / s;in s;Second;Time_s;Elapsed (s);[s]"),
        (In(Unit::Millisecond), "TimeMs (ms);millis;Time in ms;Run 1: Time (ms);(ms)"),
        (In(Unit::Microsecond), "micros();time_µs;t_μs;(us);Temps (µs)"),
        (In(Unit::Nanosecond), "Time[ns];t_ns"),
        (Time, "Time;TIME;t;X;x-axis"),
        (Count, "Sequence"),
        (Nothing, ""),
        (Other, "Time (tenths of ms);Time (s/div);Time (h:m:s);Time (10us);Time x1000 (s);Time*1e6 (s);10us;tms"),
        (Other, "Frequency (Hz);nm;deg;mm;Angle [°];λ (nm);Hz;CH1 (V);V/s;ms.A;ms/div;min;Time (min);t_us_x10;Zeit"),
        (Other, "shutter 8 ms;/records/s.wav;TrigTime;Exposure time;X1;No.;time since start;V per div (s)"),
    ] {
        names.split(';').for_each(|name| assert_eq!(said(name), told, "{name}"));
    }
    assert!(["(mV)", "Second", "V", "Sequence"].iter().all(|unit| is_unit(unit)));
    assert!(["ms/div", "10us", "CH1"].iter().all(|name| !is_unit(name)));
}

#[test]
fn a_number_has_one_decimal_mark() {
    let [point, comma] = [false, true].map(|comma| Form { delimiter: ';', comma });
    for (field, by_point, by_comma) in [
        ("-1.5e-3", Some(-1.5e-3), None),
        ("+2", Some(2.0), Some(2.0)),
        ("0,25", None, Some(0.25)),
        ("1,234,5", None, None),
        ("1.234,5", None, None),
        ("5 ms", None, None),
        ("(5.00)", None, None),
        ("", None, None),
    ] {
        assert_eq!((point.number(field), comma.number(field)), (by_point, by_comma), "{field}");
    }
    for (field, seconds) in [
        ("14:06:09.25", Some(50_769.25)),
        ("2026-01-30T14:06:09.197352000+00:00", Some(50_769.197_352)),
        ("2024-05-01 10:00:00,5", Some(36_000.5)),
        ("5/1/2024 0:00:01Z", Some(1.0)),
        ("[9:00:00.5]", Some(32_400.5)),
        ("24:00:00", None),
        ("10:00:07 PM", None),
        ("10:00", None),
        ("a 10:00:00", None),
    ] {
        assert_eq!(time_of_day(field), seconds, "{field}");
    }
}
