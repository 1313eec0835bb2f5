//! The costs that CI asserts; counts repeat exactly with the same compiler.

use measured::{ALL_RAMP, BOX, CURVE_BYTES, DEFAULT, NAMES, SOFT};

use crate::Result;
use crate::firmware::{M0, M4F, made_with};
use crate::measure::Measured;

use measured::Function::{Cdf, Construct, InverseCdf, NearerEnd, Openness, Schedule, Static, Tick};

pub fn run() -> Result {
    println!("{}", made_with()?);
    let functions = [InverseCdf, Static, Cdf, Openness, Tick, Schedule, Construct, NearerEnd].map(|f| (f, DEFAULT));
    let functions = [&functions[..], &[(InverseCdf, 0)]].concat();
    let m4f = Measured::new(M4F, &functions, NAMES.len())?;
    let m0 = Measured::new(M0, &functions, ALL_RAMP + 1)?;

    let mut broken = 0;
    let mut check = |what: &str, value: Option<f64>, at_most: f64| {
        // What is not measured is too much.
        let value = value.unwrap_or(f64::NAN);
        let verdict = if value <= at_most { "ok    " } else { "BROKEN" };
        broken += u32::from(verdict == "BROKEN");
        println!("{verdict} {what}: {value:.1}, at most {at_most}");
    };
    println!("mean cycles of a Cortex-M4F");
    for (function, curve, at_most) in [
        (InverseCdf, SOFT, 76.0),
        (InverseCdf, ALL_RAMP, 112.0),
        (Static, SOFT, 67.0),
        (Static, ALL_RAMP, 112.0),
        (Cdf, ALL_RAMP, 1360.0),
        (Cdf, BOX, 285.0),
        (Openness, ALL_RAMP, 1121.0),
        (Tick, SOFT, 156.0),
        (Tick, ALL_RAMP, 188.0),
        (Schedule, SOFT, 9000.0),
        (Schedule, ALL_RAMP, 11_200.0),
        (Schedule, BOX, 8200.0),
    ] {
        let mean = m4f.mean((function, DEFAULT), curve).map(|[_, cycles]| cycles);
        check(&format!("{function:?} on {}", NAMES[curve]), mean, at_most);
    }
    for (function, is_direct, at_most) in [
        (InverseCdf, false, 2250.0),
        (InverseCdf, true, 144.0),
        (Static, true, 144.0),
        (Tick, false, 2556.0),
        (Tick, true, 184.0),
    ] {
        let (cycles, place) = m4f.worst((function, DEFAULT), is_direct).unzip();
        let without = if is_direct { " without a search" } else { "" };
        let what = format!("at worst{without}, {function:?} on {}", place.unwrap_or_default());
        check(&what, cycles.map(f64::from), at_most);
    }
    println!("mean instructions of a Cortex-M0+, all ramp");
    let mean = |of| m0.mean(of, ALL_RAMP).map(|[instructions, _]| instructions);
    for (function, octaves, at_most) in [
        (InverseCdf, DEFAULT, 900.0),
        (InverseCdf, 0, 39_000.0),
        (Cdf, DEFAULT, 41_500.0),
        (Schedule, DEFAULT, 50_500.0),
    ] {
        check(&format!("{function:?}, OCTAVES = {octaves}"), mean((function, octaves)), at_most);
    }
    let newton = mean((NearerEnd, DEFAULT)).map(|newton| 0.25 * newton);
    check("InverseCdf, beside a quarter of Newton's", mean((InverseCdf, DEFAULT)), newton.unwrap_or_default());
    println!("bytes, and instructions of building a curve, on a Cortex-M4F");
    for (what, value, at_most) in [
        ("a curve", Some(CURVE_BYTES[2] as u32), 1150.0),
        ("a curve, OCTAVES = 0", Some(CURVE_BYTES[0] as u32), 380.0),
        ("code of InverseCdf", m4f.code((InverseCdf, DEFAULT)), 3400.0),
        ("code of Cdf", m4f.code((Cdf, DEFAULT)), 6500.0),
        ("code of Construct", m4f.code((Construct, DEFAULT)), 25_000.0),
        ("stack of InverseCdf", m4f.stack((InverseCdf, DEFAULT)), 224.0),
        (".data and .bss", Some(m4f.statics as u32), 0.0),
        ("instructions", m4f.mean((Construct, DEFAULT), SOFT).map(|[count, _]| count as u32), 2_000_000.0),
    ] {
        check(what, value.map(f64::from), at_most);
    }
    if broken > 0 { Err(format!("{broken} costs are too high").into()) } else { Ok(()) }
}
