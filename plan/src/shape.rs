//! The numbers that a shutter's curve is made of, and where they are wrong.

use shutter_curve::{CubicBezier, CurveError, Part, ShutterCurve};

use crate::fault::{Fault, Key, What};
use crate::scene::Shutter;

/// A curve as a scene has it: its times in seconds, and its inner control points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// `open_start`, `open_end`, `close_start` and `close_end`.
    pub times: [f32; 4],
    /// The ramps' inner control points `[t1, y1, t2, y2, t5, y5, t6, y6]`, their times as fractions of the interval;
    /// straight ramps without.
    pub inner: Option<[f32; 8]>,
}

/// The keys of a curve's times.
pub const TIMES: [Key; 4] = ["shutter.open_start", "shutter.open_end", "shutter.close_start", "shutter.close_end"];
const INNER: Key = "shutter.shutteropening";

/// So much of the interval a time may be off by its rounding to `f32`: less than what a good measurement is.
const ROUNDING: f64 = 1e-4;

/// A shutter's curve, and its numbers.
///
/// # Errors
/// Those of [`Shape::new`], and a curve that the crate refuses.
pub fn curve(shutter: &Shutter) -> Result<(Shape, ShutterCurve), Fault> {
    let shape = Shape::new(shutter)?;
    let curve = shape.curve().map_err(|error| shape.fault(shutter, error))?;
    Ok((shape, curve))
}

impl Shape {
    /// Those of a scene's shutter, known to be finite and kept by `f32`; what the crate makes of them is not known yet.
    ///
    /// # Errors
    /// Numbers that are missing, not finite or lost by `f32`, and other than eight of `shutteropening`.
    pub fn new(shutter: &Shutter) -> Result<Self, Fault> {
        let mut seconds = [0.0; 4];
        for (i, time) in given(shutter).into_iter().enumerate() {
            let time = time.ok_or_else(|| Fault::new(TIMES[i], What::Missing))?;
            if !time.is_finite() {
                return Err(Fault::new(TIMES[i], What::Finite));
            }
            seconds[i] = shutter.unit().seconds(time);
        }
        let times = seconds.map(|time| time as f32);
        let length = seconds[3] - seconds[0];
        for i in 0..4 {
            let off = (f64::from(times[i]) - seconds[i]).abs();
            if times[i].is_infinite() {
                return Err(Fault::new(TIMES[i], What::Beyond));
            }
            // Times out of order are told as such.
            if length > 0.0 && off > ROUNDING * length {
                return Err(Fault::new(TIMES[i], What::Lost { percent: 100.0 * off / length }));
            }
        }
        let inner = shutter.shutteropening.as_deref().map(eight).transpose()?;
        Ok(Self { times, inner })
    }

    /// The shutter.
    pub fn curve(&self) -> Result<ShutterCurve, CurveError> {
        let [open_start, open_end, close_start, close_end] = self.times;
        match self.inner {
            Some(inner) => ShutterCurve::shutteropening(self.times, inner),
            None => ShutterCurve::linear(open_start, open_end, close_start, close_end),
        }
    }

    /// The opening and the closing ramp, where they are more than straight lines.
    pub fn ramps(&self) -> Option<[CubicBezier; 2]> {
        let (opening, closing) = CubicBezier::shutteropening(self.times, self.inner?);
        Some([opening, closing])
    }

    /// By how many seconds `f32` moves a time of the curve against `open_start`, at most.
    pub(crate) fn rounding(&self, shutter: &Shutter) -> f64 {
        let given = given(shutter).map(|time| shutter.unit().seconds(time.unwrap_or_default()));
        let moved = |i: usize| f64::from(self.times[i]) - given[i];
        (1..4).map(|i| (moved(i) - moved(0)).abs()).fold(0.0, f64::max)
    }

    /// The value that a curve's error is about, and what may help.
    fn fault(&self, shutter: &Shutter, error: CurveError) -> Fault {
        use CurveError as E;
        let times = self.times;
        // The section that it is about; its end is at fault.
        let (from, to) = match error {
            E::TimesOutOfOrder => {
                let early = (1..3).find(|&i| times[i - 1] > times[i]).unwrap_or(3);
                return Fault::new(TIMES[early], error);
            }
            E::TooShort(Part::Opening) => (0, 1),
            E::TooShort(Part::Plateau) => (1, 2),
            E::TooShort(_) => (2, 3),
            E::IntervalUnresolved | E::IntervalOutOfRange => (0, 3),
            _ => return self.inner_fault(shutter, error),
        };
        let seconds = f64::from(times[to]) - f64::from(times[from]);
        Fault::new(TIMES[to], What::Lasts { error, seconds, unit: shutter.unit() })
    }

    /// The same of the inner control points.
    fn inner_fault(&self, shutter: &Shutter, error: CurveError) -> Fault {
        use CurveError as E;
        let Some(numbers) = &shutter.shutteropening else { return Fault::new(TIMES[3], error) };
        let ramp = |part| if part == Part::Closing { 4 } else { 0 };
        let point = |part, point: u8| ramp(part) + 2 * (usize::from(point) - 1);
        let one = |i: usize| ((i, i + 1), What::Inner { error, number: numbers[i] });
        let (inner, what) = match error {
            E::FractionOutsideRamp { part, point: at } => one(point(part, at)),
            E::OpennessOutOfRange { part, point: at } => one(point(part, at) + 1),
            E::NotFinite(part) | E::TimesCross(part) => ((ramp(part), ramp(part) + 4), error.into()),
            _ => ((0, 8), error.into()),
        };
        let notes = vec!["The numbers are [t1, y1, t2, y2, t5, y5, t6, y6].".into()];
        Fault { inner: Some(inner), notes, ..Fault::new(INNER, what) }
    }
}

fn given(shutter: &Shutter) -> [Option<f64>; 4] {
    [shutter.open_start, shutter.open_end, shutter.close_start, shutter.close_end]
}

fn eight(numbers: &[f64]) -> Result<[f32; 8], Fault> {
    let eight: [f64; 8] = numbers.try_into().map_err(|_| Fault::new(INNER, What::NotEight(numbers.len())))?;
    let eight = eight.map(|x| x as f32);
    match eight.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(Fault { inner: Some((i, i + 1)), ..Fault::new(INNER, What::Finite) }),
        None => Ok(eight),
    }
}
