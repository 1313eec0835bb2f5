//! The budgets that CI asserts; counts repeat exactly with the same compiler. Where a target is not reached yet, what is
//! reached may at least not get worse.

use ::firmware::{Curve, Function, Inputs, ON_HARD, ON_ROWS, ON_TYPICAL, ROWS, TRIGGERS};

use crate::firmware::{M0, M4F, SEEDS, made_with};
use crate::measure::Measured;
use crate::trace::{Key, Selection};

/// For CELLS = 8 unless it says otherwise, with the default seed.
pub fn run() -> Result<(), String> {
    use Function::{Cdf, Construct, InverseCdf, Newton, Opening, Schedule, TickStep};
    println!("{}", made_with()?);
    let some = |cells: usize, functions: &[Function], inputs| Selection {
        cells: vec![cells],
        functions: functions.to_vec(),
        inputs,
    };
    let m4f = [
        some(8, &[InverseCdf, TickStep, Schedule], ON_ROWS | ON_TYPICAL | ON_HARD),
        some(8, &[Cdf, Opening], ON_ROWS),
        some(0, &[InverseCdf, TickStep], ON_ROWS),
        some(8, &[Construct], ON_ROWS),
    ];
    let m4f = Measured::new(M4F, SEEDS[0], &m4f)?;
    let m0 = [some(8, &[InverseCdf, Newton], ON_ROWS), some(0, &[InverseCdf], ON_ROWS)];
    let m0 = Measured::new(M0, SEEDS[0], &m0)?;

    let none = "not measured";
    let key = |function, row: usize, cells| Key {
        function,
        cells,
        inputs: Inputs::Row(row),
        curve: Curve::index(ROWS[row].1),
    };
    let mean = |function, row, cells| {
        m4f.cycles(&key(function, row, cells)).map(|cycles| cycles.mean).ok_or(none)
    };
    let soft_float = |function, row, cells| {
        m0.instructions(&key(function, row, cells)).map(|i| i.mean).ok_or(none)
    };
    let [soft, all_ramp, box_] = [0, 1, 2];

    let (mut broken, mut missed) = (0, 0);
    let mut check = |what: &str, value: f64, target: f64, reached: f64| {
        let verdict = match (value <= target, value <= reached) {
            (true, _) => "ok    ",
            (_, true) => "MISSED",
            _ => "BROKEN",
        };
        missed += u32::from(verdict == "MISSED");
        broken += u32::from(verdict == "BROKEN");
        println!("{verdict} {what}: {value:.2}, target {target:.2}, at most {reached:.2}");
    };
    check("cycles of inverse_cdf on soft, mean", mean(InverseCdf, soft, 8)?, 86.0, 86.0);
    check("cycles of inverse_cdf on all ramp, mean", mean(InverseCdf, all_ramp, 8)?, 116.0, 116.0);
    let typical = m4f.typical_mean(InverseCdf, 8).ok_or(none)?;
    check("cycles of inverse_cdf, mean over all typical curves", typical, 116.0, 116.0);
    let (worst, curve) = m4f.worst(InverseCdf, Inputs::Hard, 8).ok_or(none)?;
    check(&format!("cycles of inverse_cdf, worst ({curve})"), worst.into(), 1600.0, 1600.0);
    let worst = [Inputs::Hard, Inputs::Solved].map(|inputs| m4f.worst(TickStep, inputs, 8));
    let (worst, curve) = worst.into_iter().max().flatten().ok_or(none)?;
    check(&format!("cycles of a tick, worst ({curve})"), worst.into(), 2500.0, 2500.0);
    // What a deadline stands on.
    let (worst, place) = m4f.worst_direct(InverseCdf, 8).ok_or(none)?;
    check(&format!("cycles of a direct inverse_cdf, worst ({place})"), worst.into(), 140.0, 140.0);
    let (worst, place) = m4f.worst_direct(TickStep, 8).ok_or(none)?;
    check(&format!("cycles of a direct tick, worst ({place})"), worst.into(), 160.0, 160.0);
    let what = "cycles of a tick on all ramp, CELLS = 0, mean";
    check(what, mean(TickStep, all_ramp, 0)?, 1870.0, 1870.0);
    check("cycles of cdf on all ramp, mean", mean(Cdf, all_ramp, 8)?, 1150.0, 1150.0);
    check("cycles of opening on all ramp, mean", mean(Opening, all_ramp, 8)?, 1150.0, 1150.0);
    check("cycles of cdf on the plateau, mean", mean(Cdf, box_, 8)?, 220.0, 220.0);
    for (row, (name, _)) in ROWS.iter().enumerate() {
        let target = 1.2 * f64::from(TRIGGERS) * mean(InverseCdf, row, 8)?;
        check(
            &format!("cycles of planning {TRIGGERS} triggers on {name}"),
            mean(Schedule, row, 8)?,
            target,
            1.14 * target,
        );
    }

    check("bytes of a curve", m4f.curve_bytes[&8].into(), 1376.0, 1376.0);
    check("bytes of a curve, CELLS = 0", m4f.curve_bytes[&0].into(), 480.0, 480.0);
    let code = m4f.code_bytes(InverseCdf, 8).ok_or(none)?;
    check("bytes of inverse_cdf's code", code.into(), 3584.0, 3584.0);
    let code = m4f.code_bytes(Construct, 8).ok_or(none)?;
    check("bytes of the code that builds a curve", code.into(), 20480.0, 28500.0);
    let (painted, said) = m4f.stack(InverseCdf, 8).ok_or(none)?;
    check("bytes of stack of inverse_cdf, painted", painted.into(), 160.0, 160.0);
    check("bytes of stack of inverse_cdf, by the compiler", said.into(), 160.0, 160.0);
    check("bytes of .data and .bss", m4f.code.statics as f64, 0.0, 0.0);

    // What version 0.1.0 takes, and what is reached.
    for (cells, most, reached) in [(8, 962.16, 962.16), (0, 38538.95, 38538.95)] {
        let what = format!("Cortex-M0+ instructions on all ramp, CELLS = {cells}, mean");
        check(&what, soft_float(InverseCdf, all_ramp, cells)?, most, reached);
    }
    // On box all of Newton's answers are on the plateau, without a step: there is nothing to be a quarter of.
    for (row, (name, _)) in ROWS.iter().enumerate().take(2) {
        check(
            &format!("Cortex-M0+ instructions of the textbook Newton's on {name}"),
            soft_float(InverseCdf, row, 8)? / soft_float(Newton, row, 0)?,
            0.25,
            0.25,
        );
    }

    println!("\nTypical curves, inverse_cdf: mean cycles, and the share that is searched for");
    for curve in m4f.typical(InverseCdf, 8) {
        println!("{:22} {:6.1} {:5.1} %", curve.name, curve.cycles.mean, 100.0 * curve.searched);
    }
    println!("\n{missed} targets missed, {broken} budgets broken");
    if broken > 0 { Err(format!("{broken} budgets broken")) } else { Ok(()) }
}
