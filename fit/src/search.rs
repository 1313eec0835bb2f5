//! The best signal of every kind: the solver from each kind's starts, which are shapes of ramps laid through a pulse's
//! crossings.

use crate::curve::Curve;
use crate::ramp::{Controls, STRAIGHT, UnitRamp};
use crate::signal::{Kind, Signal};
use crate::solve::{Problem, Solution};
use crate::trace::{Crossings, QUARTERS};

/// So many of the starts are followed, those that are best as they are.
const FOLLOWED: usize = 6;
/// Shapes that ramps have: straight, smooth at both ends, faster or slower at the end, mildly and strongly.
const SHAPES: [Controls; 6] = [
    STRAIGHT,
    [0.4, 0.0, 0.6, 1.0],
    [1.0 / 3.0, 0.0, 2.0 / 3.0, 1.0 / 3.0],
    [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 1.0],
    [0.6, 0.0, 0.95, 0.4],
    [0.05, 0.6, 0.4, 1.0],
];

/// Every kind's best signal, simplest first, in pulses with these crossings and samples a `step` apart: near each
/// kind's starts, and near the best curve of the next simpler kind. What is not the curve's starts as it is in `like`,
/// for each kind anew: a hum's frequency, say, that the misfit of a simple kind has led astray is not handed on to the
/// next.
pub fn every_kind(
    problem: &Problem,
    crossings: &Crossings,
    step: f64,
    like: &Signal,
    progress: &mut dyn FnMut(f64),
) -> Vec<Solution> {
    let mut found: Vec<Solution> = Vec::new();
    for kind in Kind::ALL {
        progress(found.len() as f64 / Kind::ALL.len() as f64);
        let signal = |curve: Curve| Signal { kind, curve, ..*like };
        let cost = |curve: Curve| (problem.at(&signal(curve)).cost, curve);
        let mut ranked: Vec<_> = through_crossings(kind, crossings, step).into_iter().map(cost).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let nested = found.last().map(|it| from_simpler(kind, &it.signal.curve, step));
        let followed = ranked.iter().map(|(_, curve)| *curve).take(FOLLOWED).chain(nested);
        let all = followed.map(|curve| problem.minimise(&signal(curve)));
        let best = all.reduce(|best, next| if next.cost < best.cost { next } else { best });
        found.push(best.expect("every kind has a start"));
    }
    found
}

/// The curves of a kind that pass the crossings: one with each shape, or with each pair of shapes.
fn through_crossings(kind: Kind, crossings: &Crossings, step: f64) -> Vec<Curve> {
    let shapes: Vec<[Controls; 2]> = match kind {
        Kind::Box => {
            let [_, rise, .., fall, _] = *crossings;
            return vec![Curve::trapezoid(rise, 0.0, fall - rise, 0.0)];
        }
        Kind::Trapezoid => vec![[STRAIGHT; 2]],
        Kind::Symmetric => SHAPES.iter().map(|shape| [*shape; 2]).collect(),
        Kind::Free => SHAPES.iter().flat_map(|a| SHAPES.iter().map(|b| [*a, *b])).collect(),
    };
    shapes.into_iter().map(|controls| through(crossings, step, controls)).collect()
}

/// The curve of the next simpler kind as one of `kind`, so that none comes out worse than a simpler one.
fn from_simpler(kind: Kind, simpler: &Curve, step: f64) -> Curve {
    // A box's edges have no length that could change; a sample's length they may have.
    if kind == Kind::Trapezoid {
        let Curve { start, plateau, .. } = *simpler;
        let ramp = step.min(plateau);
        return Curve::trapezoid(start - 0.5 * ramp, ramp, plateau - ramp, ramp);
    }
    *simpler
}

/// The curve with ramps of these shapes that pass a quarter and three quarters of the light when they should.
fn through(crossings: &Crossings, step: f64, controls: [Controls; 2]) -> Curve {
    let [up25, _, up75, down75, _, down25] = *crossings;
    let ramp = |controls: &Controls, quarter: f64, three_quarters: f64| {
        let shape = UnitRamp::new(controls);
        let (a, b) = (shape.reaches(QUARTERS[0]), shape.reaches(QUARTERS[2]));
        let length = ((three_quarters - quarter) / (b - a)).max(0.5 * step);
        (quarter - a * length, length)
    };
    let (start, mut opening) = ramp(&controls[0], up25, up75);
    // The closing ramp opens, seen backwards.
    let (back, mut closing) = ramp(&controls[1], -down25, -down75);
    let (open, close, end) = (start + opening, -back - closing, -back);
    if open > close {
        // The ramps would cross: they meet in a peak. Of ramps that lie the wrong way round nothing but their middle is
        // left.
        let (earliest, latest) = (start + 0.1 * opening, end - 0.1 * closing);
        let peak = (0.5 * (open + close)).max(earliest).min(latest.max(earliest));
        (opening, closing) = (peak - start, (end - peak).max(0.0));
    }
    let plateau = (close - open).max(0.0);
    Curve { controls, ..Curve::trapezoid(start, opening, plateau, closing) }
}
