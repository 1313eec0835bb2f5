//! From the edge of the camera's sync to the start of opening, as a trace shows it.

use crate::errors::Measured;
use crate::outcome::Fit;
use crate::trace::{Frame, Refusal};
use crate::unit::{Unit, plus_minus, short, trimmed};

/// The delay of a frame that starts to open at `start`, where the time of the `sync`'s edge is known. `before` are the frames
/// that come before it.
///
/// # Errors
/// An edge after the start of opening, and one that another frame follows first.
pub fn delay(
    sync: Option<f64>,
    start: Measured,
    before: &[Frame],
) -> Result<Option<Measured>, Refusal> {
    let Some(sync) = sync else { return Ok(None) };
    let refused = |reason: String| Err(Refusal::NoDelay { reason });
    if let Some(i) = before.iter().position(|frame| frame.crossings[1] > sync) {
        return refused(format!(
            "the edge of the sync is followed by pulse {0} first: --frame {0}",
            i + 1
        ));
    }
    let value = start.value - sync;
    if value < 0.0 {
        let late = Unit::fit(-value).show(-value);
        return refused(format!("the shutter opens {late} before the edge of the sync"));
    }
    Ok(Some(Measured { value, error: start.error }))
}

/// The delay, and how well a trigger's time from the edge is known, which a ramp's hidden start does not touch.
struct Told {
    value: f64,
    error: f64,
    of_triggers: f64,
}

impl Told {
    fn new(fit: &Fit, unit: Unit) -> Option<Self> {
        let Measured { value, error } = fit.delay?;
        let of_triggers = fit.triggers.iter().map(|trigger| trigger.error).fold(0.0, f64::max);
        Some(Self {
            value: unit.of(value),
            error: unit.of(error),
            of_triggers: unit.of(of_triggers),
        })
    }
}

/// The delay with its standard errors, for a report.
pub fn told(fit: &Fit) -> String {
    let unit = fit.unit();
    let Some(Told { value, error, of_triggers }) = Told::new(fit, unit) else {
        return "unknown: --sync TIME says when the edge of the camera's sync comes".into();
    };
    let delay = plus_minus(value, error, unit.name());
    format!("{delay} to the opening, ± {} to any trigger", digits(of_triggers))
}

/// The delay as a line of a scene in this unit, with so many decimals.
pub fn line(fit: &Fit, unit: Unit, places: usize) -> String {
    const WHAT: &str = "From the edge of the camera's sync to open_start";
    match Told::new(fit, unit) {
        Some(Told { value, error, of_triggers }) => format!(
            "# {WHAT}, ± {}; from the edge to any trigger, ± {}\ndelay = {}\n",
            digits(error),
            digits(of_triggers),
            trimmed(value, places),
        ),
        None => format!("# delay = ? # {WHAT}, which fit --sync TIME measures.\n"),
    }
}

/// The two digits that an error has.
fn digits(error: f64) -> String {
    short(error, 2)
}
