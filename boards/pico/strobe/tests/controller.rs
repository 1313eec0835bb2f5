//! What the emulator cannot show quickly: the words of a frame, and any bytes at all.

use proptest::prelude::*;
use shutter_curve::ScheduleError;
use strobe::*;

/// What the state machine makes of the words: when each pulse starts and ends, from an edge at 0, in cycles.
fn pulses(words: &[u32]) -> Vec<(u64, u64)> {
    let mut words = words.iter().map(|word| u64::from(*word));
    let count = words.next().unwrap() + 1;
    // The two words of a pulse are read in four cycles; a count of k takes k + 1.
    let mut now = 0;
    let pulses = (0..count).map(|_| {
        let (length, before) = (words.next().unwrap(), words.next().unwrap());
        let start = now + 4 + before + 1;
        let end = start + 1 + length + 1;
        now = end + 1;
        (start, end)
    });
    let pulses = pulses.collect();
    assert_eq!(words.next(), None);
    pulses
}

fn planned(settings: &Settings) -> Result<Vec<(u64, u64)>, Refused> {
    let mut frame = Frame::EMPTY;
    frame.plan(settings)?;
    Ok(pulses(frame.words()))
}

fn after(lines: &[&str]) -> Settings {
    lines.iter().fold(Settings::default(), |settings, line| {
        settings.with(Change::read(line).unwrap()).unwrap()
    })
}

/// The settings with a curve of these numbers.
fn built(numbers: &[f32]) -> Result<Settings, Refused> {
    let line =
        numbers.iter().fold(String::from("curve"), |line, number| format!("{line} {number}"));
    Settings::default().with(Change::read(&line)?)
}

/// When each pulse has to start and end, in cycles: by the crate's ticks, one frame after the other.
fn expected(settings: &Settings) -> Vec<(u64, u64)> {
    let (curve, n) = (settings.curve.get(), settings.pulses);
    let frame: Vec<(u64, u64)> = match settings.light {
        Light::Equal(length) => {
            let pulse = |tick| (u64::from(tick), u64::from(tick) + u64::from(length));
            curve.trigger_ticks(n, TICK_HZ).unwrap().map(pulse).collect()
        }
        Light::Doses(duty) => {
            let pulses = curve.pulse_ticks(n, duty, TICK_HZ).unwrap();
            pulses.map(|pulse| (pulse.on.into(), pulse.off.into())).collect()
        }
    };
    let Frames { count, period } = settings.frames;
    let bases = (0..u64::from(count))
        .map(|i| u64::from(OVERHEAD) + u64::from(settings.delay) + i * u64::from(period));
    bases.flat_map(|base| frame.iter().map(move |(on, off)| (base + on, base + off))).collect()
}

#[test]
fn a_frame_has_the_ticks_of_its_curve() {
    for settings in [
        after(&[]),
        after(&["n 64", "pulse 16ns", "gap 0ns"]),
        after(&["curve 2", "n 1", "pulse 34s"]),
        after(&["curve 3", "n 40", "gap 20us", "pulse 10us"]),
        after(&["curve 0 0 1e-3 1e-3 0 0.5 0 1 1 1 1 0.5", "n 8", "pulse 124952ns"]),
        after(&["delay 4.247ms", "edge falling"]),
        after(&["duty 0.3"]),
        after(&["duty 1", "n 1", "curve 0 0.001 0.002 0.004"]),
        after(&["n 64", "duty 0.01", "gap 0ns", "frames 16 10.1ms", "delay 1s"]),
        after(&["frames 2 8s", "delay 1s"]),
    ] {
        assert_eq!(planned(&settings).unwrap(), expected(&settings));
    }
}

#[test]
fn a_frame_that_does_not_keep_the_gap_or_the_least_pause_is_refused() {
    let too_many = ScheduleError::CapacityExceeded { capacity: 64 };
    assert_eq!(planned(&after(&["n 65"])), Err(Refused::Schedule(too_many)));
    for lines in [["n 32", "gap 10ms"], ["n 32", "pulse 10ms"]] {
        let Err(Refused::Gap { most, .. }) = planned(&after(&lines)) else { panic!("{lines:?}") };
        assert_eq!(most, 1);
    }
    // Eight pulses 125 us apart leave 48 ns between them, or less.
    let abrupt = "curve 0 0 1e-3 1e-3 0 0.5 0 1 1 1 1 0.5";
    assert!(planned(&after(&[abrupt, "n 8", "pulse 124952ns"])).is_ok());
    assert!(planned(&after(&[abrupt, "n 8", "pulse 124960ns"])).is_err());
}

#[test]
fn a_refused_plan_leaves_an_empty_frame() {
    let mut frame = Frame::EMPTY;
    frame.plan(&after(&[])).unwrap();
    frame.plan(&after(&["n 65"])).unwrap_err();
    assert!(frame.words().is_empty());
}

/// What is refused, by its kind.
fn refusal(lines: &[&str]) -> Refused {
    planned(&after(lines)).unwrap_err()
}

#[test]
fn frames_of_one_edge_keep_the_gap_between_them() {
    let busy = |frame: &[(u64, u64)]| frame.last().unwrap().0 - frame[0].0;
    let one = planned(&after(&[])).unwrap();
    // The last and the first pulse, 100 us apart from start to start.
    let least = busy(&one) + 12_500;
    assert_eq!(refusal(&["frames 2 7ms"]), Refused::Overlap { least });
    let period = format!("frames 2 {}ns", 8 * least);
    let two = planned(&after(&[&period])).unwrap();
    assert_eq!(two, expected(&after(&[&period])));
    assert_eq!(two[12].0 - two[11].0, 12_500);
    assert_eq!(refusal(&[&format!("frames 2 {}ns", 8 * (least - 1))]), Refused::Overlap { least });
    // Pulses that are longer than the gap leave what the state machine takes.
    let long = ["gap 0ns", "pulse 200us"];
    let least = busy(&one) + 25_000 + u64::from(MIN_LOW);
    let period = format!("frames 2 {}ns", 8 * least);
    assert_eq!(planned(&after(&[&long[..], &[&period]].concat())).unwrap().len(), 24);
    // Doses: from the end of one to the start of the next.
    let doses = planned(&after(&["duty 0.3"])).unwrap();
    let least = doses[11].1 - doses[0].0 + 12_500;
    assert_eq!(refusal(&["duty 0.3", "frames 9 1us"]), Refused::Overlap { least });
}

#[test]
fn more_than_the_board_holds_is_refused() {
    assert_eq!(refusal(&["n 64", "gap 0ns", "frames 17 20ms"]), Refused::TooMany);
    assert_eq!(refusal(&["frames 4294967295 20ms"]), Refused::TooMany);
    assert_eq!(refusal(&["delay 17.18s"]), Refused::TooLate);
    assert_eq!(refusal(&["frames 3 8.6s"]), Refused::TooLate);
    assert!(planned(&after(&["delay 17.17s"])).is_ok());
}

/// Equal doses through the shutter, by the crate's own cdf; and what cannot be is refused.
#[test]
fn doses_are_equal() {
    let settings = after(&["duty 0.3", "n 20", "gap 0ns", "curve 2"]);
    let curve = settings.curve.get();
    let time = |cycle: u64| curve.open_start() + (cycle - 5) as f32 / TICK_HZ as f32;
    for (on, off) in planned(&settings).unwrap() {
        let dose = curve.cdf(time(off)) - curve.cdf(time(on));
        assert!((dose - 0.3 / 20.0).abs() < 1e-5, "{dose}");
    }
    let touching = ScheduleError::PulsesTooClose { pulse: 1, gap: 0, min_gap: MIN_LOW };
    assert_eq!(refusal(&["gap 0ns", "duty 1"]), Refused::Schedule(touching));
    assert!(matches!(
        refusal(&["gap 0ns", "duty 1e-6"]),
        Refused::Schedule(ScheduleError::PulseTooShort { .. })
    ));
}

#[test]
fn durations_have_decimals() {
    for (text, ticks) in [
        ("4.247ms", 530_875),
        ("4.2470169ms", 530_877),
        ("0.5ns", 0),
        ("0.000000012s", 2),
        ("34s", 4_250_000_000),
    ] {
        assert_eq!(Change::read(&format!("delay {text}")), Ok(Change::Delay(ticks)), "{text}");
    }
    // A gap is kept at least.
    assert_eq!(Change::read("gap 4.2470161ms"), Ok(Change::Gap(530_878)));
    for text in [
        "1.ms",
        ".5ms",
        "1.5.2ms",
        "1e3ns",
        "-1ns",
        "0.00000000000000000001s",
        "35s",
        ".ms",
        "ms",
        "",
    ] {
        assert_eq!(Change::read(&format!("delay {text}")), Err(Refused::Duration), "{text}");
    }
}

#[test]
fn words_that_stand_alone() {
    assert_eq!(Request::read("?"), Ok(Request::Show));
    assert_eq!(Request::read("save"), Ok(Request::Save));
    assert_eq!(Request::read("save 1"), Err(Refused::Alone));
    assert_eq!(Request::read("n 3"), Ok(Request::Change(Change::Pulses(3))));
}

#[test]
fn settings_are_printed_as_they_are_read() {
    let settings = after(&["n 7", "gap 1497ns", "pulse 3ms", "curve 2"]);
    assert_eq!(
        settings.to_string(),
        "n 7, gap 1504ns, pulse 3ms, delay 0ns, edge rising, frames 1, curve 2"
    );
    assert_eq!(
        after(&["gap 9ns", "pulse 34s"]).to_string(),
        "n 12, gap 16ns, pulse 34s, delay 0ns, edge rising, frames 1, curve 1"
    );
    assert_eq!(
        after(&["gap 0s"]).to_string(),
        "n 12, gap 0ns, pulse 2us, delay 0ns, edge rising, frames 1, curve 1"
    );
    let settings = after(&[
        "duty 0.3",
        "delay 4.247ms",
        "edge falling",
        "frames 3 20ms",
        "curve 0 1e-7 0.1 0.25",
    ]);
    let rest = "n 12, gap 100us, duty 0.3, delay 4247us, edge falling, frames 3, every 20ms, curve";
    assert_eq!(settings.to_string(), format!("{rest} of its own"));
    assert_eq!(settings.in_full().to_string(), format!("{rest} 0.0 1e-7 0.1 0.25"));
}

proptest! {
    /// Any bytes: each line is answered, and what is accepted can be planned or refused, without a panic.
    #[test]
    fn any_bytes_are_survived(bytes: Vec<u8>) {
        let mut lines = Lines::default();
        for byte in bytes.into_iter().chain(*b"\n") {
            if let Some(Ok(line)) = lines.push(byte) {
                let _ = Request::read(line).map(|request| match request {
                    Request::Change(change) => Settings::default().with(change).map(drop),
                    Request::Show | Request::Save => Ok(()),
                });
            }
        }
        // Whatever came before, the next line is read.
        prop_assert!(b"n 7".iter().all(|byte| lines.push(*byte).is_none()));
        prop_assert_eq!(lines.push(b'\n'), Some(Ok("n 7")));
    }

    /// Lines that are nearly right.
    #[test]
    fn lines_that_look_right_are_survived(
        line in "(n|gap|pulse|duty|delay|edge|frames|curve)( (-?[0-9]{1,12}(\\.[0-9]{1,8})?(e-?[0-9]{1,2})?|nan|inf|-inf)(ns|us|ms|s)?){0,13}",
    ) {
        if let Ok(change) = Change::read(&line)
            && let Ok(settings) = Settings::default().with(change)
        {
            let _ = planned(&settings);
            prop_assert!(settings.to_string().is_ascii());
        }
    }

    /// Twelve numbers of any kind.
    #[test]
    fn curves_are_built_or_refused(numbers: [f32; 12]) {
        let _ = built(&numbers);
    }

    /// Twelve numbers that are a curve: every pulse comes at its tick.
    #[test]
    fn curves_are_planned(
        start in 0.0f32..=0.01,
        [opening, plateau, closing] in prop::array::uniform3(5e-4f32..=3e-3),
        mut parts in prop::array::uniform4(0.01f32..=0.99),
        [y1, y2, y5, y6] in prop::array::uniform4(0.0f32..=1.0),
    ) {
        parts.sort_by(f32::total_cmp);
        let whole = opening + plateau + closing;
        let [t1, t2] = [parts[0], parts[2]].map(|part| part * opening / whole);
        let [t5, t6] = [parts[1], parts[3]].map(|part| (opening + plateau + part * closing) / whole);
        let times = [0.0, opening, opening + plateau, whole].map(|time| start + time);
        let settings = built(&[&times[..], &[t1, y1, t2, y2, t5, y5, t6, y6]].concat()).unwrap();
        let settings = settings.with(Change::Gap(0)).unwrap();
        prop_assert_eq!(planned(&settings).unwrap(), expected(&settings));
    }
}
