//! Where the search for a kind's best curve begins: shapes of ramps laid through a pulse's crossings.

use super::curve::Curve;
use super::ramp::{Controls, STRAIGHT, UnitRamp};
use super::signal::{Kind, Signal};
use super::solve::{Problem, Solution};

/// Shapes that ramps have: straight, smooth at both ends, faster or slower at the end, mildly and strongly.
const SHAPES: [Controls; 6] = [
    STRAIGHT,
    [0.4, 0.0, 0.6, 1.0],
    [1.0 / 3.0, 0.0, 2.0 / 3.0, 1.0 / 3.0],
    [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 1.0],
    [0.6, 0.0, 0.95, 0.4],
    [0.05, 0.6, 0.4, 1.0],
];
/// So many of the starts are followed, those that are best as they are.
const FOLLOWED: usize = 6;

/// When a quarter, half and three quarters of the light are reached, and left again.
pub type Crossings = [f64; 6];

/// The best signal of a kind near its starts, and near the best of the next simpler kind; what is not the curve's
/// starts as it is in `like`.
pub fn search(
    problem: &Problem,
    kind: Kind,
    crossings: &Crossings,
    step: f64,
    simpler: Option<&Solution>,
    like: &Signal,
) -> Solution {
    let signal = |curve: Curve| Signal { kind, curve, ..*like };
    let [_, rise, _, _, fall, _] = *crossings;
    let shapes: Vec<[Controls; 2]> = match kind {
        Kind::Box => Vec::new(),
        Kind::Trapezoid => vec![[STRAIGHT; 2]],
        Kind::Symmetric => SHAPES.iter().map(|shape| [*shape; 2]).collect(),
        Kind::Free => SHAPES.iter().flat_map(|a| SHAPES.iter().map(|b| [*a, *b])).collect(),
    };
    let mut starts: Vec<Curve> =
        shapes.into_iter().map(|controls| through(crossings, step, controls)).collect();
    if kind == Kind::Box {
        starts.push(Curve::trapezoid(rise, 0.0, fall - rise, 0.0));
    }
    let mut ranked: Vec<(f64, Curve)> =
        starts.into_iter().map(|curve| (problem.at(&signal(curve)).cost, curve)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let curves = ranked.into_iter().map(|(_, curve)| curve).take(FOLLOWED);
    // A simpler kind's curve is one of this kind's, too: so none comes out worse than a simpler one.
    let nested = simpler.map(|solution| match kind {
        Kind::Trapezoid => {
            let Curve { start, plateau, .. } = solution.signal.curve;
            let ramp = step.min(plateau);
            Curve::trapezoid(start - 0.5 * ramp, ramp, plateau - ramp, ramp)
        }
        _ => solution.signal.curve,
    });
    let found = curves.chain(nested).map(|curve| problem.minimise(&signal(curve)));
    let best = found.reduce(|best, next| if next.cost < best.cost { next } else { best });
    best.unwrap_or_else(|| problem.at(&signal(through(crossings, step, [STRAIGHT; 2]))))
}

/// The curve with ramps of these shapes that pass a quarter and three quarters of the light when they should.
fn through(crossings: &Crossings, step: f64, controls: [Controls; 2]) -> Curve {
    let [up25, _, up75, down75, _, down25] = *crossings;
    let ramp = |controls: &Controls, quarter: f64, three_quarters: f64| {
        let shape = UnitRamp::new(controls);
        let (a, b) = (shape.reaches(0.25), shape.reaches(0.75));
        let length = ((three_quarters - quarter) / (b - a)).max(0.5 * step);
        (quarter - a * length, length)
    };
    let (start, opening) = ramp(&controls[0], up25, up75);
    // The closing ramp opens, seen backwards.
    let (back, closing) = ramp(&controls[1], -down25, -down75);
    let (open, close, end) = (start + opening, -back - closing, -back);
    if open <= close {
        return Curve { controls, ..Curve::trapezoid(start, opening, close - open, closing) };
    }
    let peak = (0.5 * (open + close)).clamp(start + 0.1 * opening, end - 0.1 * closing);
    Curve { controls, ..Curve::trapezoid(start, peak - start, 0.0, (end - peak).max(0.0)) }
}
