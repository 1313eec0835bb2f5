//! The budgets that CI asserts; counts repeat exactly. Where a target is not reached yet, what is reached may
//! at least not get worse.

use ::firmware::{Curve, Function, Inputs, ROWS, TRIGGERS};

use crate::firmware::{M0, M4F, SEEDS, made_with};
use crate::measure::Measured;
use crate::trace::{Key, Selection};

/// For CELLS = 8 unless it says otherwise, with the default seed.
pub fn run() -> Result<(), String> {
    use Function::{InverseCdf, Newton, Schedule};
    println!("{}", made_with()?);
    let hard = Selection { cells: vec![8], functions: vec![InverseCdf, Schedule], hard: true };
    let soft_float = Selection { cells: vec![8], functions: vec![InverseCdf, Newton], hard: false };
    let compact = Selection { cells: vec![0], functions: vec![InverseCdf], hard: false };
    let m4f = Measured::new(M4F, SEEDS[0], &[hard, compact])?;
    let m0 = Measured::new(M0, SEEDS[0], &[soft_float])?;

    let key = |function, row: usize, cells| Key {
        function,
        cells,
        inputs: Inputs::Row(row),
        curve: Curve::index(ROWS[row].1),
    };
    let none = "not measured";
    let mean = |row| m4f.cycles(&key(InverseCdf, row, 8)).map(|cycles| cycles.mean).ok_or(none);
    let soft_mean = |function, cells, row| {
        m0.instructions(&key(function, row, cells)).map(|i| i.mean).ok_or(none)
    };
    let (worst, curve) = m4f.worst(InverseCdf, Inputs::Hard, 8).ok_or(none)?;
    let (painted, said) = m4f.stack(InverseCdf, 8).ok_or(none)?;

    let (mut broken, mut missed) = (0, 0);
    let mut check = |what: &str, value: f64, target: f64, reached: Option<f64>| {
        let limit = reached.unwrap_or(target);
        let verdict = match (value <= target, value <= limit) {
            (true, _) => "ok    ",
            (_, true) => "MISSED",
            _ => "BROKEN",
        };
        missed += u32::from(verdict == "MISSED");
        broken += u32::from(verdict == "BROKEN");
        println!("{verdict} {what}: {value:.2}, target {target:.2}, at most {limit:.2}");
    };
    check("cycles of inverse_cdf on soft, mean", mean(0)?, 110.0, None);
    check("cycles of inverse_cdf on all ramp, mean", mean(1)?, 145.0, None);
    check(
        &format!("cycles of inverse_cdf, worst ({curve})"),
        f64::from(worst),
        1200.0,
        Some(1650.0),
    );
    for (row, (name, _)) in ROWS.iter().enumerate() {
        check(
            &format!("cycles of planning {TRIGGERS} triggers on {name}"),
            m4f.cycles(&key(Schedule, row, 8)).ok_or(none)?.mean,
            1.2 * f64::from(TRIGGERS) * mean(row)?,
            None,
        );
    }
    check("bytes of a curve", f64::from(m4f.curve_bytes[&8]), 1400.0, None);
    check("bytes of a curve, CELLS = 0", f64::from(m4f.curve_bytes[&0]), 480.0, None);
    check(
        "bytes of inverse_cdf's code",
        f64::from(m4f.code_bytes(InverseCdf, 8).ok_or(none)?),
        3584.0,
        None,
    );
    check("bytes of stack of inverse_cdf, painted", f64::from(painted), 160.0, None);
    check("bytes of stack of inverse_cdf, by the compiler", f64::from(said), 160.0, None);
    check("bytes of .data and .bss", m4f.code.statics as f64, 0.0, None);
    // On box all of Newton's answers are on the plateau, without a step: there is nothing to be a quarter of.
    for (row, (name, _)) in ROWS.iter().enumerate().take(2) {
        let ratio = soft_mean(InverseCdf, 8, row)? / soft_mean(Newton, 0, row)?;
        check(
            &format!("Cortex-M0+ instructions of the textbook Newton's on {name}"),
            ratio,
            0.25,
            None,
        );
    }
    println!("{missed} targets missed, {broken} budgets broken");
    if broken > 0 { Err(format!("{broken} budgets broken")) } else { Ok(()) }
}
