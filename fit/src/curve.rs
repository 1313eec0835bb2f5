//! A shutter's openness over time in `f64`: a ramp, a plateau and a ramp that mirrors the first kind, with the integral
//! and how it moves with every parameter.

use crate::ramp::{At, Controls, STRAIGHT, UnitRamp};

/// The places of a [`Curve`]'s times among its parameters.
pub const START: usize = 0;
pub const OPENING: usize = 1;
pub const PLATEAU: usize = 2;
pub const CLOSING: usize = 3;
/// Where the control numbers begin among them; the closing ramp's begin four later.
pub const CONTROLS: usize = 4;
/// The parameters of the freest curve; every simpler one holds some of them fixed or together.
pub const PARAMETERS: usize = CONTROLS + 8;

/// A curve by its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// When it starts to open.
    pub start: f64,
    /// How long it opens.
    pub opening: f64,
    /// How long it is fully open.
    pub plateau: f64,
    /// How long it closes.
    pub closing: f64,
    /// The control numbers `x1, y1, x2, y2` of the opening ramp, and of the closing one seen backwards in time, so that
    /// both open.
    pub controls: [Controls; 2],
}

impl Curve {
    /// How the whole length moves with each parameter.
    pub(super) const LENGTH: [f64; PARAMETERS] = [0., 1., 1., 1., 0., 0., 0., 0., 0., 0., 0., 0.];

    pub(super) fn trapezoid(start: f64, opening: f64, plateau: f64, closing: f64) -> Self {
        Self { start, opening, plateau, closing, controls: [STRAIGHT; 2] }
    }

    /// When it is fully open.
    pub fn open_end(&self) -> f64 {
        self.start + self.opening
    }

    /// When it starts to close.
    pub fn close_start(&self) -> f64 {
        self.open_end() + self.plateau
    }

    /// When it is closed.
    pub fn end(&self) -> f64 {
        self.close_start() + self.closing
    }

    /// From the start of opening to the end of closing.
    pub fn length(&self) -> f64 {
        self.opening + self.plateau + self.closing
    }

    /// All four times, in order.
    pub fn times(&self) -> [f64; 4] {
        [self.start, self.open_end(), self.close_start(), self.end()]
    }

    pub(super) fn parameters(&self) -> [f64; PARAMETERS] {
        let times = [self.start, self.opening, self.plateau, self.closing];
        let controls = self.controls.as_flattened();
        std::array::from_fn(|k| if k < CONTROLS { times[k] } else { controls[k - CONTROLS] })
    }

    pub(super) fn from_parameters(p: &[f64; PARAMETERS]) -> Self {
        let [start, opening, plateau, closing, a, b, c, d, e, f, g, h] = *p;
        Self { start, opening, plateau, closing, controls: [[a, b, c, d], [e, f, g, h]] }
    }

    /// The curve with time counted in other units from another zero: `t` becomes `t * scale + shift`.
    pub fn mapped(&self, scale: f64, shift: f64) -> Self {
        let [opening, plateau, closing] = [self.opening, self.plateau, self.closing].map(|time| time * scale);
        Self { start: self.start * scale + shift, opening, plateau, closing, ..*self }
    }
}

/// A quantity of a whole curve, and how it moves with each parameter.
pub type Whole = fn(&Curve) -> (f64, [f64; PARAMETERS]);

/// From the start of opening to the end of closing.
pub const LENGTH: Whole = |curve| (curve.length(), Curve::LENGTH);

/// The exposure.
pub const AREA: Whole = |curve| {
    let Collected { amount, moves } = Exposure::new(curve).whole();
    (amount, moves)
};

/// A curve with its ramps' integrals worked out.
#[derive(Clone, Copy, Debug)]
pub struct Exposure {
    pub curve: Curve,
    ramps: [UnitRamp; 2],
    /// All of each ramp.
    whole: [At; 2],
}

/// What is collected by a time, and how that moves with the parameters.
#[derive(Clone, Copy, Debug)]
pub struct Collected {
    pub amount: f64,
    pub moves: [f64; PARAMETERS],
}

impl Exposure {
    pub fn new(curve: &Curve) -> Self {
        let ramps = curve.controls.map(|controls| UnitRamp::new(&controls));
        Self { curve: *curve, ramps, whole: ramps.map(|ramp| ramp.at(1.0)) }
    }

    /// The exposure `A`.
    pub fn area(&self) -> f64 {
        let Curve { opening, plateau, closing, .. } = self.curve;
        opening * self.whole[0].area + plateau + closing * self.whole[1].area
    }

    /// How long the ramps stay below an openness, each.
    pub fn feet(&self, openness: f64) -> [f64; 2] {
        let Curve { opening, closing, .. } = self.curve;
        [opening * self.ramps[0].reaches(openness), closing * self.ramps[1].reaches(openness)]
    }

    /// Does it come to a point, or nearly, by how much of the time above half it is above 95 % of its peak? A tenth of
    /// a triangle's, three tenths of a half sine's or a parabola's, and more than a quarter of ramps' beside a plateau
    /// of a tenth of the whole.
    pub fn is_peak(&self) -> bool {
        self.is_narrower(3.0)
    }

    /// May it be a bell that never reaches full light?
    pub fn may_be_peak(&self) -> bool {
        self.is_narrower(2.4)
    }

    fn is_narrower(&self, times: f64) -> bool {
        let [top, half] = [0.95, 0.5].map(|openness| self.between(openness)).map(|[from, to]| to - from);
        let curve = self.curve;
        top < 0.25 * half || times * top < half && curve.plateau < 0.1 * curve.length()
    }

    /// When it reaches an openness, and when it leaves it.
    pub fn between(&self, openness: f64) -> [f64; 2] {
        let [opening, closing] = self.feet(openness);
        [self.curve.start + opening, self.curve.end() - closing]
    }

    pub fn mean(&self, from: f64, to: f64) -> f64 {
        (self.amount(to) - self.amount(from)) / (to - from)
    }

    /// All that is collected, and how it moves with each parameter.
    pub fn whole(&self) -> Collected {
        // After the end, wherever that is.
        self.collected(f64::INFINITY)
    }

    pub fn openness(&self, t: f64) -> f64 {
        let [start, open_end, close_start, end] = self.curve.times();
        if t < start || t > end {
            0.0
        } else if t < open_end {
            self.ramps[0].openness((t - start) / self.curve.opening)
        } else if t > close_start {
            self.ramps[1].openness((end - t) / self.curve.closing)
        } else {
            1.0
        }
    }

    /// Does it let all of the light through from one time to another, or none?
    pub fn is_flat(&self, from: f64, to: f64) -> bool {
        let [start, open_end, close_start, end] = self.curve.times();
        to <= start || from > open_end && to <= close_start || from > end
    }

    /// `∫ f dt` up to a time.
    pub fn amount(&self, t: f64) -> f64 {
        self.collected(t).amount
    }

    /// The same, and how it moves with each parameter.
    pub fn collected(&self, t: f64) -> Collected {
        let mut moves = [0.0; PARAMETERS];
        let Curve { opening, plateau, closing, .. } = self.curve;
        let [start, open_end, close_start, end] = self.curve.times();
        let [opened, closed] = &self.whole;
        if t <= start {
            return Collected { amount: 0.0, moves };
        }
        if t < open_end {
            let z = (t - start) / opening;
            let at = self.ramps[0].at(z);
            moves[START] = -at.openness;
            moves[OPENING] = at.area - z * at.openness;
            for k in 0..4 {
                moves[CONTROLS + k] = opening * at.moves[k];
            }
            return Collected { amount: opening * at.area, moves };
        }
        for k in 0..4 {
            moves[CONTROLS + k] = opening * opened.moves[k];
        }
        if t <= close_start {
            moves[START] = -1.0;
            moves[OPENING] = opened.area - 1.0;
            return Collected { amount: opening * opened.area + (t - open_end), moves };
        }
        // Counted back from the end; at the end and after it, `z` is 0.
        let z = if t < end { (end - t) / closing } else { 0.0 };
        let at = self.ramps[1].at(z);
        moves[START] = -at.openness;
        moves[OPENING] = opened.area - at.openness;
        moves[PLATEAU] = 1.0 - at.openness;
        moves[CLOSING] = closed.area - at.area - at.openness * (1.0 - z);
        for k in 0..4 {
            moves[CONTROLS + 4 + k] = closing * (closed.moves[k] - at.moves[k]);
        }
        let amount = opening * opened.area + plateau + closing * (closed.area - at.area);
        Collected { amount, moves }
    }

    /// The time by which the fraction `u` of the exposure is collected, and how it moves with each parameter: `u A =
    /// F(t)` moved with `t`, so `dt = (u dA - dF)/f`.
    pub fn trigger(&self, u: f64) -> (f64, [f64; PARAMETERS]) {
        let target = u * self.area();
        let [mut low, _, _, mut high] = self.curve.times();
        let mut t = 0.5 * (low + high);
        for _ in 0..200 {
            let missing = self.amount(t) - target;
            (low, high) = if missing < 0.0 { (t, high) } else { (low, t) };
            let next = t - missing / self.openness(t);
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if next == t || high - low <= f64::EPSILON * high.abs().max(low.abs()) {
                break;
            }
            t = next;
        }
        let whole = self.whole().moves;
        let here = self.collected(t).moves;
        let f = self.openness(t).max(1e-6);
        (t, std::array::from_fn(|k| (u * whole[k] - here[k]) / f))
    }
}

/// The fractions of the exposure at which `n` triggers come.
pub fn fractions(n: u32) -> impl Iterator<Item = f64> {
    (0..n).map(move |i| (f64::from(i) + 0.5) / f64::from(n))
}
