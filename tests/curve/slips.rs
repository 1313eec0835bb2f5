//! Slips that do not compile, each with what the compiler says about it: it names the remedy.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What each begins with.
const BEFORE: &str = "#![no_std]
    use shutter_curve::*;
    pub static SHUTTER: ShutterCurve = expect!(ShutterCurve::linear(0.0, 0.0025, 0.0075, 0.010));
    pub const FLASH: TimedCurve = expect!(SHUTTER.at(Hz(1_000_000)));";

#[rustfmt::skip]
const WRONG_TYPES: &[(&str, &str, &str)] = &[
    // (the slip, the code, what the compiler says)
    ("count and rate are swapped", "pub fn f() { _ = SHUTTER.at(16); }", "expected `Hz`, found integer"),
    ("rate for a count", "pub fn f() { _ = FLASH.trigger_ticks(Hz(1_000_000)); }", "expected `u32`, found `Hz`"),
    ("rate for a gap", "pub fn f() { _ = FLASH.min_gap(Hz(1_000_000)); }", "expected `u32`, found `Hz`"),
    ("a gap beside the count", "pub fn f() { _ = FLASH.max_triggers(16, 1_000); }", "takes 1 argument but 2"),
    ("a gap beside the rate", "pub fn f() { _ = SHUTTER.at(Hz(1_000_000), 1_000); }", "takes 1 argument but 2"),
    ("a frame without a rate", "pub fn f() { _ = SHUTTER.trigger_ticks(16); }",
     "no method named `trigger_ticks` found"),
    ("a rate in another unit", "pub struct KHz(pub u32); pub fn f() { _ = SHUTTER.at(KHz(1_000)); }",
     "expected `Hz`, found `KHz`"),
    ("count and duty are swapped", "pub fn f() { _ = FLASH.pulse_ticks(0.5, 12); }",
     "arguments to this method are incorrect"),
];

/// What the compiler says once all types are right; first two that are no slips.
#[rustfmt::skip]
const WRONG_VALUES: &[(&str, &str, &str)] = &[
    ("", "pub const TICKS: [u32; 12] = expect!(FLASH.min_gap(400).ticks());", ""),
    ("", "pub const SHARED: [u32; 5] = expect!(expect!(SHUTTER.at(Hz(300))).min_gap(0).ticks());
          pub const TOUCHING: [Pulse; 5] = expect!(FLASH.min_gap(0).pulses(1.0));
          pub fn frame() -> Result<TriggerTicks<'static>, ScheduleError> { FLASH.trigger_ticks(16) }", ""),
    ("kHz for MHz", "const TICKS: [u32; 12] = expect!(expect!(SHUTTER.at(Hz(1_000))).ticks());",
     "the gap before trigger 3 is 0 ticks"),
    ("ms for s",
     "static MS: ShutterCurve = expect!(ShutterCurve::linear(0.0, 2.5, 7.5, 10.0));
      const FLASH_MS: TimedCurve = expect!(MS.at(Hz(250_000_000)));",
     "the curve has more than 2^31 ticks; use a rate of at most 214748364 Hz, and times in seconds"),
    ("ms for s on a timer of 16 bits",
     "static MS: ShutterCurve = expect!(ShutterCurve::linear(0.0, 2.5, 7.5, 10.0));
      const FLASH_MS: TimedCurve = expect!(MS.at(Hz(1_000_000)));
      const _: () = assert!(FLASH_MS.length() <= 1 << 15, \"for a timer of 16 bits\");",
     "for a timer of 16 bits"),
    ("flashes too close", "const TICKS: [u32; 16] = expect!(FLASH.min_gap(1_000).ticks());",
     "the gap before trigger 1 is 792 ticks; the minimum is 1000"),
    ("pulses that touch", "const PULSES: [Pulse; 12] = expect!(FLASH.pulses(1.0));",
     "with min_gap(0) pulses may touch"),
    ("a duty in percent", "const PULSES: [Pulse; 12] = expect!(FLASH.pulses(50.0));",
     "the duty has to be above 0 and at most 1"),
    ("fractions of a ramp, as an easing curve has them",
     "static C: ShutterCurve = expect!(ShutterCurve::shutteropening(
          [0.0, 2.5, 7.5, 10.0], [0.1, 0.0, 0.6, 1.0, 0.85, 1.0, 0.9, 0.0]));",
     "opening ramp: the time of its second inner point has to lie on the ramp, as a fraction of the whole interval"),
    ("more triggers than are direct", "const _: () = assert!(SHUTTER.direct_triggers() >= 4096);", "assertion failed"),
];

/// Compiles a text as a library. `with` are the compiler's further arguments.
fn compiled(folder: &Path, source: &Path, with: &[&str]) -> (bool, String) {
    let output = Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()))
        .args(["--edition=2024", "--crate-type=lib", "--emit=metadata", "--cap-lints=allow", "--error-format=short"])
        .args(with)
        .arg("--out-dir")
        .args([folder, source])
        .output()
        .expect("a compiler");
    (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn slips_do_not_compile_and_the_pages_do() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("slips");
    std::fs::create_dir_all(&folder).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs");
    let (is_built, said) = compiled(&folder, &root, &["--crate-name=shutter_curve"]);
    assert!(is_built, "{said}");
    let library = format!("--extern=shutter_curve={}", folder.join("libshutter_curve.rmeta").display());
    // Firmware, which a doctest cannot be: the first code that names the crate.
    for page in [include_str!("../../README.md"), include_str!("../../docs/firmware.md")] {
        let code = page.split("```").find(|block| block.contains("use shutter_curve::")).unwrap();
        let source = folder.join("page.rs");
        std::fs::write(&source, code.split_once('\n').unwrap().1).unwrap();
        assert_eq!(compiled(&folder, &source, &[&library]), (true, String::new()));
    }
    for (name, slips) in [("types.rs", WRONG_TYPES), ("values.rs", WRONG_VALUES)] {
        // Each on a line, which the compiler names.
        let lines = slips
            .iter()
            .enumerate()
            .map(|(i, (_, code, _))| format!("\npub mod slip_{i} {{ use super::*; {} }}", code.replace('\n', " ")));
        let source = folder.join(name);
        std::fs::write(&source, BEFORE.replace('\n', " ") + &lines.collect::<String>()).unwrap();
        let (_, said) = compiled(&folder, &source, &[&library]);
        for (line, (slip, _, expected)) in (2..).zip(slips) {
            let errors: Vec<&str> = said.lines().filter(|it| it.contains(&format!("{name}:{line}:"))).collect();
            assert_eq!(errors.is_empty(), slip.is_empty(), "{slip}: {said}");
            assert!(slip.is_empty() || errors.iter().any(|it| it.contains(expected)), "{slip}: {errors:#?}");
        }
    }
}
