//! The budgets that CI asserts; counts repeat exactly with the same compiler.

use measured::{CURVE_BYTES, DEFAULT, Function, Inputs, ROWS};

use crate::Result;
use crate::firmware::{M0, M4F, OPT_LEVEL, made_with};
use crate::measure::{Measured, On, Ran, series};

use Function::{Cdf, Construct, InverseCdf, Newton, Openness, Schedule, Static, TickStep};

/// The places of [`ROWS`].
const SOFT: usize = 0;
const ALL_RAMP: usize = 1;
const BOX: usize = 3;

/// Mean cycles of a Cortex-M4F, by the curve and the octaves. A `static` is as firmware has it: the compiler sees the
/// curve.
const CYCLES: [(Function, usize, usize, f64); 14] = [
    (InverseCdf, SOFT, DEFAULT, 76.0),
    (InverseCdf, ALL_RAMP, DEFAULT, 112.0),
    (Static, SOFT, DEFAULT, 67.0),
    (Static, ALL_RAMP, DEFAULT, 112.0),
    (TickStep, SOFT, DEFAULT, 153.0),
    (TickStep, ALL_RAMP, DEFAULT, 188.0),
    (TickStep, ALL_RAMP, 0, 1963.0),
    (Cdf, ALL_RAMP, 0, 1360.0),
    (Cdf, ALL_RAMP, DEFAULT, 1360.0),
    (Cdf, BOX, DEFAULT, 285.0),
    (Openness, ALL_RAMP, DEFAULT, 1121.0),
    (Schedule, SOFT, DEFAULT, 9000.0),
    (Schedule, ALL_RAMP, DEFAULT, 11_200.0),
    (Schedule, BOX, DEFAULT, 8200.0),
];

/// Mean instructions of a Cortex-M0+ on all ramp, by the octaves.
const SOFT_FLOAT: [(Function, usize, f64); 5] = [
    (InverseCdf, DEFAULT, 900.0),
    (InverseCdf, 0, 39_000.0),
    (Cdf, DEFAULT, 41_500.0),
    (Cdf, 0, 41_500.0),
    (Schedule, DEFAULT, 50_500.0),
];

/// Where no number of octaves is said, it is the default one.
pub fn run() -> Result {
    println!("{}", made_with()?);
    let m4f = [
        series(&[InverseCdf, TickStep, Schedule, Static], &[DEFAULT], On::All),
        series(&[Cdf, Openness, Construct], &[DEFAULT], On::Rows),
        series(&[Cdf, TickStep], &[0], On::Rows),
    ];
    let m4f = Measured::new(M4F, OPT_LEVEL, &m4f.concat())?;
    let building = series(&[Construct], &[DEFAULT], On::All);
    let for_size = Measured::new(M4F, "z", &building)?.code_bytes(Construct, DEFAULT);
    let m0 = [
        series(&[InverseCdf, Cdf, Newton, Schedule], &[DEFAULT], On::Rows),
        series(&[InverseCdf, Cdf], &[0], On::Rows),
    ];
    let m0 = Measured::new(M0, OPT_LEVEL, &m0.concat())?;

    let mut budgets = Vec::new();
    let mut check = |what: String, value, target: f64| budgets.push((what, value, target));
    let octaves = |octaves| if octaves == DEFAULT { String::new() } else { format!(", OCTAVES = {octaves}") };
    for (function, row, count, target) in CYCLES {
        let what = format!("mean cycles of {function:?} on {}{}", ROWS[row], octaves(count));
        check(what, m4f.on(function, row, count).map(|ran| ran.cycles().mean), target);
    }
    for (function, target) in [(InverseCdf, 89.59), (Static, 0.93 * 87.07)] {
        let what = format!("mean cycles of {function:?} over all typical curves");
        check(what, m4f.typical(function, DEFAULT, Ran::cycles), target);
    }
    for (function, target) in [(InverseCdf, 2250.0), (TickStep, 2556.0)] {
        let (worst, curve) = m4f.worst(function, DEFAULT).unzip();
        let what = format!("worst cycles of {function:?} ({})", curve.unwrap_or_default());
        check(what, worst.map(f64::from), target);
    }
    // What a deadline stands on.
    for (function, target) in [(InverseCdf, 144.0), (Static, 144.0), (TickStep, 184.0)] {
        let (worst, place) = m4f.worst_direct(function, DEFAULT).unzip();
        let what = format!("worst cycles of a direct {function:?} ({})", place.unwrap_or_default());
        check(what, worst.map(f64::from), target);
    }
    let instructions = |function, row, octaves| Some(m0.on(function, row, octaves)?.instructions().mean);
    for (function, count, target) in SOFT_FLOAT {
        let what = format!("mean instructions of {function:?} on all ramp{}", octaves(count));
        check(format!("Cortex-M0+: {what}"), instructions(function, ALL_RAMP, count), target);
    }
    // On box all of Newton's answers are on the plateau, without a step: there is nothing to be a quarter of.
    for row in [SOFT, ALL_RAMP] {
        let [ours, newton] = [InverseCdf, Newton].map(|f| instructions(f, row, DEFAULT));
        let share = ours.zip(newton).map(|(ours, newton)| ours / newton);
        check(format!("Cortex-M0+: the same as a share of Newton's on {}", ROWS[row]), share, 0.25);
    }

    let bytes = [
        ("bytes of a curve", Some(CURVE_BYTES[2] as u32), 1150.0),
        ("bytes of a curve, OCTAVES = 0", Some(CURVE_BYTES[0] as u32), 380.0),
        ("bytes of InverseCdf's code", m4f.code_bytes(InverseCdf, DEFAULT), 3400.0),
        ("bytes of Cdf's code", m4f.code_bytes(Cdf, DEFAULT), 6500.0),
        ("bytes of InverseCdf's stack", m4f.stack_bytes(InverseCdf, DEFAULT), 224.0),
        ("bytes of the code that builds a curve", m4f.code_bytes(Construct, DEFAULT), 25_000.0),
        ("bytes of the same, for size", for_size, 18_000.0),
        ("bytes of .data and .bss", Some(m4f.code.statics as u32), 0.0),
    ];
    for (what, bytes, target) in bytes {
        check(what.into(), bytes.map(f64::from), target);
    }
    let built = m4f.on(Construct, SOFT, DEFAULT).map(|ran| ran.instructions().mean);
    check("instructions of building a curve, soft".into(), built, 2_000_000.0);

    let mut broken = 0;
    for (what, value, target) in budgets {
        // What is not measured breaks its budget.
        let value = value.unwrap_or(f64::NAN);
        let verdict = if value <= target { "ok    " } else { "BROKEN" };
        broken += u32::from(verdict == "BROKEN");
        println!("{verdict} {what}: {value:.2}, at most {target:.2}");
    }
    println!("\nTypical curves, InverseCdf: mean cycles, and the share that is searched for");
    for ran in m4f.over(InverseCdf, Inputs::Uniform, DEFAULT) {
        let (name, mean) = (ran.name(), ran.cycles().mean);
        println!("{name:22} {mean:6.1} {:5.1} %", 100.0 * ran.searched());
    }
    println!("\n{broken} budgets broken");
    if broken > 0 { Err(format!("{broken} budgets broken").into()) } else { Ok(()) }
}
