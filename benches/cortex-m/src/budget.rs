//! The budgets that CI asserts; counts repeat exactly with the same compiler.

use measured::{CURVE_BYTES, DEFAULT, Function, ROWS};

use crate::Result;
use crate::firmware::{M0, M4F, made_with};
use crate::measure::{Measured, On, series};

use Function::{Cdf, Construct, InverseCdf, NearerEnd, Openness, Schedule, Static, TickStep};

/// The places of [`ROWS`].
const SOFT: usize = 0;
const ALL_RAMP: usize = 1;
const BOX: usize = 3;

/// Mean cycles of a Cortex-M4F, by the curve and the octaves. A `static` is as firmware has it: the compiler sees the
/// curve.
const CYCLES: [(Function, usize, usize, f64); 13] = [
    (InverseCdf, SOFT, DEFAULT, 76.0),
    (InverseCdf, ALL_RAMP, DEFAULT, 112.0),
    (Static, SOFT, DEFAULT, 67.0),
    (Static, ALL_RAMP, DEFAULT, 112.0),
    (TickStep, SOFT, DEFAULT, 153.0),
    (TickStep, ALL_RAMP, DEFAULT, 188.0),
    (TickStep, ALL_RAMP, 0, 1963.0),
    (Cdf, ALL_RAMP, DEFAULT, 1360.0),
    (Cdf, BOX, DEFAULT, 285.0),
    (Openness, ALL_RAMP, DEFAULT, 1121.0),
    (Schedule, SOFT, DEFAULT, 9000.0),
    (Schedule, ALL_RAMP, DEFAULT, 11_200.0),
    (Schedule, BOX, DEFAULT, 8200.0),
];

/// Over all curves: the mean cycles on typical ones, the worst, and the worst without a search, on which a deadline
/// stands.
const OVER_CURVES: [(Function, [Option<f64>; 3]); 3] = [
    (InverseCdf, [Some(89.59), Some(2250.0), Some(144.0)]),
    (Static, [Some(0.93 * 87.07), None, Some(144.0)]),
    (TickStep, [None, Some(2556.0), Some(184.0)]),
];

/// Mean instructions of a Cortex-M0+ on all ramp, by the octaves.
const SOFT_FLOAT: [(Function, usize, f64); 4] =
    [(InverseCdf, DEFAULT, 900.0), (InverseCdf, 0, 39_000.0), (Cdf, DEFAULT, 41_500.0), (Schedule, DEFAULT, 50_500.0)];

/// Where no number of octaves is said, it is the default one.
pub fn run() -> Result {
    println!("{}", made_with()?);
    let m4f = [
        series(&[InverseCdf, TickStep, Schedule, Static], &[DEFAULT], On::All),
        series(&[Cdf, Openness, Construct], &[DEFAULT], On::Rows),
        series(&[TickStep], &[0], On::Rows),
    ];
    let m4f = Measured::new(M4F, &m4f.concat())?;
    let m0 =
        [series(&[InverseCdf, Cdf, NearerEnd, Schedule], &[DEFAULT], On::Rows), series(&[InverseCdf], &[0], On::Rows)];
    let m0 = Measured::new(M0, &m0.concat())?;

    let mut broken = 0;
    let mut check = |what: String, value: Option<f64>, target: f64| {
        // What is not measured breaks its budget.
        let value = value.unwrap_or(f64::NAN);
        let verdict = if value <= target { "ok    " } else { "BROKEN" };
        broken += u32::from(verdict == "BROKEN");
        println!("{verdict} {what}: {value:.4}, at most {target:.2}");
    };
    let octaves = |octaves| if octaves == DEFAULT { String::new() } else { format!(", OCTAVES = {octaves}") };
    for (function, row, count, target) in CYCLES {
        let what = format!("mean cycles of {function:?} on {}{}", ROWS[row], octaves(count));
        check(what, m4f.cycles(function, row, count), target);
    }
    for (function, targets) in OVER_CURVES {
        let [worst, direct] = [m4f.worst(function, DEFAULT), m4f.worst_direct(function, DEFAULT)].map(|worst| {
            let (cycles, place) = worst.unzip();
            (cycles.map(f64::from), place.unwrap_or_default())
        });
        let typical = m4f.typical(function, DEFAULT).map(|[cycles, _]| cycles);
        let figures = [
            ("mean cycles over all typical curves", (typical, String::new())),
            ("worst cycles", worst),
            ("worst cycles without a search", direct),
        ];
        for ((what, (value, place)), target) in figures.into_iter().zip(targets) {
            if let Some(target) = target {
                check(format!("{what} of {function:?} {place}"), value, target);
            }
        }
    }
    let searched = m4f.typical(InverseCdf, DEFAULT).map(|[_, searched]| 100.0 * searched);
    check("% of answers on typical curves that are searched for".into(), searched, 0.27);
    for (function, count, target) in SOFT_FLOAT {
        let what = format!("Cortex-M0+: mean instructions of {function:?} on all ramp{}", octaves(count));
        check(what, m0.instructions(function, ALL_RAMP, count), target);
    }
    for row in [SOFT, ALL_RAMP] {
        let [ours, newton] = [InverseCdf, NearerEnd].map(|function| m0.instructions(function, row, DEFAULT));
        let share = ours.zip(newton).map(|(ours, newton)| ours / newton);
        check(format!("Cortex-M0+: InverseCdf's as a share of NearerEnd's on {}", ROWS[row]), share, 0.25);
    }
    for (what, bytes, target) in [
        ("bytes of a curve", Some(CURVE_BYTES[2] as u32), 1150.0),
        ("bytes of a curve, OCTAVES = 0", Some(CURVE_BYTES[0] as u32), 380.0),
        ("bytes of InverseCdf's code", m4f.code_bytes(InverseCdf, DEFAULT), 3400.0),
        ("bytes of Cdf's code", m4f.code_bytes(Cdf, DEFAULT), 6500.0),
        ("bytes of InverseCdf's stack", m4f.stack_bytes(InverseCdf, DEFAULT), 224.0),
        ("bytes of the code that builds a curve", m4f.code_bytes(Construct, DEFAULT), 25_000.0),
        ("bytes of .data and .bss", Some(m4f.code.statics as u32), 0.0),
    ] {
        check(what.into(), bytes.map(f64::from), target);
    }
    check("instructions of building a curve, soft".into(), m4f.instructions(Construct, SOFT, DEFAULT), 2_000_000.0);
    println!("\n{broken} budgets broken");
    if broken > 0 { Err(format!("{broken} budgets broken").into()) } else { Ok(()) }
}
