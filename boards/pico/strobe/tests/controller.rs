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

/// When each pulse has to start and end, in cycles.
fn expected(settings: &Settings) -> Vec<(u64, u64)> {
    let ticks = settings.curve.get().trigger_ticks(settings.pulses, TICK_HZ).unwrap();
    ticks
        .map(|tick| u64::from(tick) + u64::from(OVERHEAD))
        .map(|start| (start, start + u64::from(settings.length)))
        .collect()
}

#[test]
fn a_frame_has_the_ticks_of_its_curve() {
    for settings in [
        after(&[]),
        after(&["n 64", "pulse 16ns", "gap 0ns"]),
        after(&["curve 2", "n 1", "pulse 34s"]),
        after(&["curve 3", "n 40", "gap 20us", "pulse 10us"]),
        after(&["curve 0 0 1e-3 1e-3 0 0.5 0 1 1 1 1 0.5", "n 8", "pulse 124952ns"]),
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

#[test]
fn settings_are_printed_as_they_are_read() {
    let settings = after(&["n 7", "gap 1497ns", "pulse 3ms", "curve 2"]);
    assert_eq!(settings.to_string(), "n 7, gap 1504ns, pulse 3ms, curve 2");
    assert_eq!(after(&["gap 9ns", "pulse 34s"]).to_string(), "n 12, gap 16ns, pulse 34s, curve 1");
    assert_eq!(after(&["gap 0s"]).to_string(), "n 12, gap 0ns, pulse 2us, curve 1");
}

proptest! {
    /// Any bytes: each line is answered, and what is accepted can be planned or refused, without a panic.
    #[test]
    fn any_bytes_are_survived(bytes: Vec<u8>) {
        let mut lines = Lines::default();
        for byte in bytes.into_iter().chain(*b"\n") {
            if let Some(Ok(line)) = lines.push(byte) {
                let _ = Change::read(line).map(|change| Settings::default().with(change));
            }
        }
        // Whatever came before, the next line is read.
        prop_assert!(b"n 7".iter().all(|byte| lines.push(*byte).is_none()));
        prop_assert_eq!(lines.push(b'\n'), Some(Ok("n 7")));
    }

    /// Lines that are nearly right.
    #[test]
    fn lines_that_look_right_are_survived(
        line in "(n|gap|pulse|curve)( (-?[0-9]{1,12}(\\.[0-9]{1,8})?(e-?[0-9]{1,2})?|nan|inf|-inf)(ns|us|ms|s)?){0,13}",
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
