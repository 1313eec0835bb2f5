//! What names of columns say, and how numbers may be written.

use crate::names::Said::{Nothing, Unclear, Unit as In};
use crate::names::{is_axis, is_count, is_time, is_unit, unit_in};
use crate::numbers::number;
use crate::unit::Unit;

#[test]
fn a_name_tells_its_unit() {
    for (said, names) in [
        (In(Unit::Second), "Time (s);Zeit  1 - Standardmessrate [s];t / s;in s;Second;Time_s"),
        (In(Unit::Millisecond), "TimeMs;tms;millis;Time in ms;Elapsed msecs"),
        (In(Unit::Microsecond), "micros();time_µs;esp_timer_us;(us)"),
        (In(Unit::Nanosecond), "Time[ns]"),
        (Nothing, "Time;time[0];ts;CH1 (V);V/s;ms.A;leaf shutter in ms;shutter 8 ms;/records/s.wav;C:\\us\\ms.csv"),
        (Unclear, "Time (tenths of ms);timer (half us);Time (s/div);Time (h:m:s);Time (10us);Time (1e-6 s)"),
        (Unclear, "Time (min);time x 10 us;10us;hundreds of us;elapsed hours;Time x1000 (s);Time*1e6 (s);ms/100"),
    ] {
        names.split(';').for_each(|name| assert_eq!(unit_in(name), said, "{name}"));
    }
}

#[test]
fn a_name_tells_what_it_is() {
    let all = |is: fn(&str) -> bool, names: &str| names.split(';').all(is);
    let none = |is: fn(&str) -> bool, names: &str| !names.split(';').any(is);
    assert!(all(
        is_time,
        "Time;TIME (s);t_us;Fractional Seconds;Elapsed time;Zeit;time since start;time hundreds of us"
    ));
    assert!(none(is_time, "Real Time;Exposure time;Rise time (ms);TrigTime;CH1;x-axis"));
    assert!(all(is_axis, "x-axis;X_Value;X") && none(is_axis, "X1;CH1"));
    assert!(all(is_count, "No.;Sample;ticks") && none(is_count, "CH1;"));
    assert!(all(is_unit, "(mV);Second") && none(is_unit, "ms/div;10us"));
}

#[test]
fn a_number_may_be_written_so() {
    for (field, comma, value) in [
        ("-1.5e-3", false, Some(-1.5e-3)),
        ("+2", false, Some(2.0)),
        ("0,25", true, Some(0.25)),
        ("\u{2212}5.0", false, Some(-5.0)),
        ("\u{2013}5,0", true, Some(-5.0)),
        ("(5.00)", false, Some(-5.0)),
        ("+    0.05", false, Some(0.05)),
        ("- 12,5", true, Some(-12.5)),
        ("-12\u{202f}345,5", true, Some(-12345.5)),
        ("1'234.5", false, Some(1234.5)),
        ("1 234.5", false, None),
        ("12'34", false, None),
        ("-OVL", false, Some(f64::NEG_INFINITY)),
        ("(V)", false, None),
        ("(-5)", false, None),
        ("5 ms", false, None),
        ("1,234,5", true, None),
        ("", false, None),
    ] {
        assert_eq!(number(field, comma), value, "{field}");
    }
}
