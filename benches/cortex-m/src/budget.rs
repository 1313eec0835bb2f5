//! The costs that CI asserts; counts repeat exactly with the same compiler.

use measured::Function::{Cdf, Construct, InverseCdf, InverseCdf0, NearerEnd, Openness, Schedule, Static, Tick};
use measured::{ALL_RAMP, SOFT};

use crate::Result;
use crate::firmware::{M0, M4F, made_with};
use crate::measure::{Measured, searched};

pub fn run() -> Result {
    println!("{}", made_with()?);
    let functions = [InverseCdf, InverseCdf0, Static, Cdf, Openness, Tick, Schedule, Construct, NearerEnd];
    let m4f = Measured::new(M4F, &functions, ALL_RAMP + 1, &[InverseCdf, Static, Tick])?;
    let m0 = Measured::new(M0, &functions, ALL_RAMP + 1, &[])?;

    let cycles = |function, curve| m4f.mean(function, curve).map(|[_, cycles]| cycles);
    let worst = |function, is_direct| m4f.worst(function, is_direct).map(f64::from);
    let on_m0 = |function| m0.mean(function, ALL_RAMP).map(|[count, _]| count);
    let code = |function| m4f.code(function).map(f64::from);
    let mut broken = 0;
    for (what, value, at_most) in [
        ("cycles of a Cortex-M4F: inverse, soft", cycles(InverseCdf, SOFT), 76.0),
        ("inverse, all ramp", cycles(InverseCdf, ALL_RAMP), 112.0),
        ("inverse of a static, soft", cycles(Static, SOFT), 67.0),
        ("inverse of a static, all ramp", cycles(Static, ALL_RAMP), 109.0),
        ("cdf, all ramp", cycles(Cdf, ALL_RAMP), 950.0),
        ("openness, all ramp", cycles(Openness, ALL_RAMP), 970.0),
        ("tick, soft", cycles(Tick, SOFT), 156.0),
        ("tick, all ramp", cycles(Tick, ALL_RAMP), 188.0),
        ("schedule, soft", cycles(Schedule, SOFT), 9000.0),
        ("schedule, all ramp", cycles(Schedule, ALL_RAMP), 11_200.0),
        ("building a curve, soft", cycles(Construct, SOFT), 2.85e6),
        ("inverse, worst", worst(InverseCdf, false), 2090.0),
        ("inverse, worst without a search", worst(InverseCdf, true), 131.0),
        ("inverse of a static, worst", worst(Static, false), 1400.0),
        ("inverse of a static, worst without a search", worst(Static, true), 143.0),
        ("tick, worst", worst(Tick, false), 2240.0),
        ("tick, worst without a search", worst(Tick, true), 184.0),
        ("instructions of a Cortex-M0+, all ramp: inverse", on_m0(InverseCdf), 690.0),
        ("inverse, a share of Newton's", on_m0(InverseCdf).zip(on_m0(NearerEnd)).map(|(a, b)| a / b), 0.25),
        ("inverse, OCTAVES = 0", on_m0(InverseCdf0), 18_600.0),
        ("cdf", on_m0(Cdf), 11_400.0),
        ("openness", on_m0(Openness), 13_200.0),
        ("schedule", on_m0(Schedule), 50_500.0),
        ("% of answers on typical curves that take a search", Some(searched()), 0.27),
        ("bytes: a curve", Some(InverseCdf.data_bytes() as f64), 1136.0),
        ("a curve, OCTAVES = 0", Some(InverseCdf0.data_bytes() as f64), 368.0),
        ("code of the inverse", code(InverseCdf), 3130.0),
        ("code of cdf", code(Cdf), 2560.0),
        ("code that builds a curve", code(Construct), 22_528.0),
        ("stack of the inverse", m4f.stack(InverseCdf).map(f64::from), 224.0),
        (".data and .bss", Some(m4f.run.statics as f64), 0.0),
        ("instructions of building a curve, soft", m4f.mean(Construct, SOFT).map(|[count, _]| count), 1.95e6),
    ] {
        // What is not measured is too much.
        let value = value.unwrap_or(f64::NAN);
        let keeps = value <= at_most;
        broken += u32::from(!keeps);
        println!("{} {what}: {value:.1}, at most {at_most}", if keeps { "ok    " } else { "BROKEN" });
    }
    if broken > 0 { Err(format!("{broken} costs are too high").into()) } else { Ok(()) }
}
