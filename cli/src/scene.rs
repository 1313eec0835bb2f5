//! A scene: what stands in its text, and where it is wrong.

use serde::{Deserialize, Serialize};
use shutter_curve::{CurveError, Part, ShutterCurve};
use shutter_fit::unit::{Unit, rounded, short};
use toml::Spanned;
use toml::de::{DeTable, Deserializer};

use crate::fault::{DIGITS, Fault, What};
use crate::lamp::SetUp;
use crate::shape::Shape;

/// A scene as it is written; each value knows its place in the text.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Of all times; seconds without.
    pub(crate) unit: Option<Unit>,
    pub(crate) open_start: Spanned<Number>,
    open_end: Spanned<Number>,
    close_start: Spanned<Number>,
    close_end: Spanned<Number>,
    shutteropening: Option<Spanned<Vec<Number>>>,
    pub(crate) triggers: Spanned<Number>,
    pub(crate) timer_hz: Option<Spanned<Number>>,
    pub(crate) timer_bits: Option<Spanned<Number>>,
    pub(crate) min_gap: Spanned<Number>,
    pub(crate) nominal: Option<Spanned<Number>>,
    pub(crate) pulse: Option<Spanned<Number>>,
    pub(crate) duty: Option<Spanned<Number>>,
    pub(crate) min_pulse: Option<Spanned<Number>>,
    pub(crate) delay: Option<Spanned<Number>>,
    pub(crate) delay_spread: Option<Spanned<Number>>,
    pub(crate) sync_falls: Option<Spanned<bool>>,
    pub(crate) lamp_lag: Option<Spanned<Number>>,
    pub(crate) set_up: Option<Spanned<SetUp>>,
    pub(crate) fully_open: Option<Spanned<bool>>,
    /// In place of a curve, whose keys are of no account then.
    #[serde(skip_serializing)]
    pub(crate) trigger_times: Option<TriggerTimes>,
}

pub(crate) type TriggerTimes = Spanned<Vec<Spanned<Number>>>;

#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(untagged, expecting = "a number is required")]
pub(crate) enum Number {
    Any(f64),
}

impl Number {
    pub(crate) fn get(self) -> f64 {
        let Self::Any(x) = self;
        x
    }
}

/// The number of a key that may be left out.
pub(crate) type Optional<'a> = Option<&'a Spanned<Number>>;

/// The keys of a scene without a text, as a page in a browser numbers them and as a fault's place does.
pub const KEYS: [&str; 19] = [
    "open_start",
    "open_end",
    "close_start",
    "close_end",
    "shutteropening",
    "triggers",
    "timer_hz",
    "timer_bits",
    "min_gap",
    "nominal",
    "pulse",
    "duty",
    "min_pulse",
    "delay",
    "delay_spread",
    "lamp_lag",
    "set_up",
    "sync_falls",
    "fully_open",
];

/// The place of the only key that takes more than one number.
const EIGHT: usize = 4;

impl Scene {
    /// So many numbers: one for each of [`KEYS`], and eight for `shutteropening`.
    pub const NUMBERS: usize = KEYS.len() + 7;

    /// The scene of numbers in the order of [`KEYS`]. One that may be left out is NaN where it is; a number of pieces
    /// or ticks need not be whole yet. Of a choice it is the place: emulated before in the path, false before true. A
    /// fault's place is that of its key.
    pub fn of_numbers(unit: Unit, numbers: &[f64; Self::NUMBERS]) -> Self {
        let number = |key: &str| {
            let place = KEYS.iter().position(|known| *known == key).expect("a key of the list");
            let x = numbers[if place > EIGHT { place + 7 } else { place }];
            Spanned::new(place..place, Number::Any(x))
        };
        let optional = |key| Some(number(key)).filter(|x| !x.get_ref().get().is_nan());
        let choice = |key| optional(key).map(|x| Spanned::new(x.span(), x.get_ref().get() == 1.0));
        let set_up = |is_in_path| if is_in_path { SetUp::InPath } else { SetUp::Emulated };
        let eight = || numbers[EIGHT..EIGHT + 8].iter().copied().map(Number::Any).collect();
        Self {
            unit: Some(unit),
            open_start: number("open_start"),
            open_end: number("open_end"),
            close_start: number("close_start"),
            close_end: number("close_end"),
            shutteropening: optional(KEYS[EIGHT]).map(|first| Spanned::new(first.span(), eight())),
            triggers: number("triggers"),
            timer_hz: optional("timer_hz"),
            timer_bits: optional("timer_bits"),
            min_gap: number("min_gap"),
            nominal: optional("nominal"),
            pulse: optional("pulse"),
            duty: optional("duty"),
            min_pulse: optional("min_pulse"),
            delay: optional("delay"),
            delay_spread: optional("delay_spread"),
            lamp_lag: optional("lamp_lag"),
            set_up: choice("set_up").map(|it| Spanned::new(it.span(), set_up(*it.get_ref()))),
            sync_falls: choice("sync_falls"),
            fully_open: choice("fully_open"),
            trigger_times: None,
        }
    }
}

/// The key that tells a scene of trigger times from one with a curve.
pub(crate) const TRIGGER_TIMES: &str = "trigger_times";

/// Where a text has this key, if it has it.
pub(crate) fn trigger_times_at(text: &str) -> Option<usize> {
    let table = DeTable::parse(text).ok()?.into_inner();
    table.keys().find(|key| key.get_ref() == TRIGGER_TIMES).map(|key| key.span().start)
}

/// What the head of a text keeps of a fit: what was measured, and what is doubtful about it.
pub(crate) fn fitted(text: &str) -> Vec<(&'static str, String)> {
    let kept = |line: &str| {
        let measured = line.strip_prefix("# Exposure ").map(|it| {
            let it = it.trim_end_matches(", standard errors behind ±.");
            ("measured", format!("exposure {it}"))
        });
        measured.or(line.strip_prefix("# Warning: ").map(|it| ("doubt", it.into())))
    };
    text.lines().take_while(|line| line.starts_with('#')).filter_map(kept).collect()
}

/// The scene that `text` describes.
///
/// # Errors
/// What is no TOML, keys that are missing or unknown or have the wrong type, and a scene without a curve.
pub fn parse(text: &str) -> Result<Scene, Fault> {
    if let Some(at) = trigger_times_at(text) {
        let reason = "trigger_times: this scene has times as they were measured, and a curve is required here; \
                      `shutter plan` takes it";
        return Err(Fault::of(Some(at), What::Text(reason.into())));
    }
    read(text)
}

/// What a text has by its keys.
pub(crate) fn read(text: &str) -> Result<Scene, Fault> {
    let told = |error: toml::de::Error| {
        let mut reason = error.message().to_string();
        // What is missing is on no line; its span is the whole table.
        let missing = reason.starts_with("missing field");
        let at = error.span().filter(|_| !missing).map(|span| span.start);
        let table = DeTable::parse(text).map(Spanned::into_inner).unwrap_or_default();
        let is_there = |value: &Spanned<_>| at.is_some_and(|at| value.span().contains(&at));
        if let Some((key, _)) = table.iter().find(|(_, value)| is_there(value)) {
            let key = key.get_ref();
            reason = match key.as_ref() {
                "unit" => "unit: \"s\", \"ms\", \"us\" or \"ns\" is required".into(),
                "set_up" => "set_up: \"emulated\" or \"in_path\" is required".into(),
                key @ ("sync_falls" | "fully_open") => format!("{key}: true or false is required"),
                _ if reason.contains("a sequence") => {
                    format!("{key}: numbers in brackets are required")
                }
                _ => format!("{key}: {reason}"),
            };
        }
        Fault::of(at, What::Text(reason))
    };
    let mut table = DeTable::parse(text).map_err(told)?;
    let keys = table.get_mut();
    if let (true, Some(start)) = (keys.contains_key(TRIGGER_TIMES), keys.get("open_start").cloned()) {
        for key in ["open_end", "close_start", "close_end", "triggers"] {
            keys.insert(Spanned::new(0..0, key.into()), start.clone());
        }
    }
    Scene::deserialize(Deserializer::from(table)).map_err(told)
}

/// So much of the interval a time may be off by its rounding to `f32`: less than what a good measurement is.
const ROUNDING: f64 = 1e-4;

impl Scene {
    /// How many triggers it asks for, as near as a count can be; not all can be planned.
    pub fn triggers(&self) -> u32 {
        self.triggers.get_ref().get() as u32
    }

    /// The unit of its times.
    pub fn unit(&self) -> Unit {
        self.unit.unwrap_or(Unit::Second)
    }

    /// The curve, and its numbers.
    ///
    /// # Errors
    /// What [`shape`](Self::shape) refuses, and a curve that the crate refuses.
    pub fn curve(&self) -> Result<(Shape, ShutterCurve), Fault> {
        let shape = self.shape()?;
        let curve = shape.curve().map_err(|error| self.fault(&shape, error))?;
        Ok((shape, curve))
    }

    /// The curve's numbers, known to be finite and kept by `f32`; what the crate makes of them is not known yet.
    ///
    /// # Errors
    /// Numbers that are not finite or that `f32` loses, and other than eight of `shutteropening`.
    pub fn shape(&self) -> Result<Shape, Fault> {
        let mut seconds = [0.0; 4];
        for ((key, value), seconds) in KEYS.into_iter().zip(self.times()).zip(&mut seconds) {
            *seconds = self::seconds(self.unit(), key, value)?;
        }
        let times = seconds.map(|time| time as f32);
        let length = seconds[3] - seconds[0];
        for (i, value) in self.times().into_iter().enumerate() {
            let (key, off) = (KEYS[i], (f64::from(times[i]) - seconds[i]).abs());
            if times[i].is_infinite() {
                return Err(Fault::at(value, What::Beyond { key }));
            }
            // Times out of order are told as such.
            if length > 0.0 && off > ROUNDING * length {
                return Err(Fault::at(value, What::Lost { key, percent: 100.0 * off / length }));
            }
        }
        let inner = self.shutteropening.as_ref().map(eight).transpose()?;
        Ok(Shape { times, inner })
    }

    /// By how many seconds `f32` moves a time of the curve against `open_start`, at most.
    pub(crate) fn rounding(&self, shape: &Shape) -> f64 {
        let given = self.times().map(|place| self.unit().seconds(place.get_ref().get()));
        let moved = |i: usize| f64::from(shape.times[i]) - given[i];
        (1..4).map(|i| (moved(i) - moved(0)).abs()).fold(0.0, f64::max)
    }

    fn times(&self) -> [&Spanned<Number>; 4] {
        [&self.open_start, &self.open_end, &self.close_start, &self.close_end]
    }

    /// Where the value stands that a curve's error is about, that value, and what may help.
    fn fault(&self, shape: &Shape, error: CurveError) -> Fault {
        use CurveError as E;
        let times = shape.times;
        // The section that it is about; its end is at fault.
        let (from, to) = match error {
            E::TimesOutOfOrder => {
                let early = (1..3).find(|&i| times[i - 1] > times[i]).unwrap_or(3);
                return Fault::at(self.times()[early], error);
            }
            E::TooShort(Part::Opening) => (0, 1),
            E::TooShort(Part::Plateau) => (1, 2),
            E::TooShort(_) => (2, 3),
            E::IntervalUnresolved | E::IntervalOutOfRange => (0, 3),
            _ => return self.inner_fault(error),
        };
        let seconds = f64::from(times[to]) - f64::from(times[from]);
        Fault::at(self.times()[to], What::Lasts { error, seconds, unit: self.unit() })
    }

    /// The same of the inner control points.
    fn inner_fault(&self, error: CurveError) -> Fault {
        use CurveError as E;
        let Some(place) = &self.shutteropening else { return Fault::at(&self.close_end, error) };
        let ramp = |part| if part == Part::Closing { 4 } else { 0 };
        let point = |part, point: u8| ramp(part) + 2 * (usize::from(point) - 1);
        let one = |i: usize| ((i, i + 1), What::Inner { error, number: place.get_ref()[i].get() });
        let (inner, what) = match error {
            E::FractionOutsideRamp { part, point: at } => one(point(part, at)),
            E::OpennessOutOfRange { part, point: at } => one(point(part, at) + 1),
            E::NotFinite(part) | E::TimesCross(part) => ((ramp(part), ramp(part) + 4), error.into()),
            _ => ((0, 8), error.into()),
        };
        Fault { inner: Some(inner), ..Fault::at(place, what) }
    }

    /// What is wrong with the curve of a text, with what may help.
    pub(crate) fn noted(&self, mut fault: Fault) -> Fault {
        let of_inner = matches!(*fault.what, What::Curve(_) | What::Inner { .. });
        let Some(place) = self.shutteropening.as_ref().filter(|_| of_inner) else { return fault };
        if fault.inner.is_none() {
            return fault;
        }
        fault.notes.push("The numbers are [t1, y1, t2, y2, t5, y5, t6, y6].".into());
        let is_time = matches!(*fault.what, What::Inner { error: CurveError::FractionOutsideRamp { .. }, .. });
        let shape = self.shape().ok().filter(|_| is_time);
        if let Some((convention, inner)) = shape.and_then(|it| self.misread(&it, place.get_ref())) {
            let inner = inner.join(", ");
            fault.notes.push(format!("As {convention} they would fit; that is"));
            fault.notes.push(format!("shutteropening = [{inner}]"));
        }
        fault
    }

    /// Another convention by which the inner control points fit, if there is one: its name, and the same points as the
    /// crate takes them.
    ///
    /// Times go first, as they fit only where the control points lie on their own ramps; small fractions of each ramp
    /// fit easily.
    fn misread(&self, shape: &Shape, inner: &[Number]) -> Option<(String, [String; 8])> {
        let times = self.times().map(|time| time.get_ref().get());
        let [open_start, open_end, close_start, close_end] = times;
        let fraction = |time: f64| (time - open_start) / (close_end - open_start);
        let of_ramp = |ramp: usize, x: f64| match ramp {
            0 => open_start + x * (open_end - open_start),
            _ => close_start + x * (close_end - close_start),
        };
        let as_times = |_, x| fraction(x);
        let as_ramps = |ramp, x| fraction(of_ramp(ramp, x));
        let conventions: [(_, &dyn Fn(usize, f64) -> f64); 2] =
            [(format!("times in {}", self.unit().name()), &as_times), ("fractions of each ramp".into(), &as_ramps)];
        conventions.into_iter().find_map(|(name, convert)| {
            let inner: [f64; 8] = std::array::from_fn(|i| {
                let x = inner[i].get();
                rounded(if i % 2 == 0 { convert(i / 4, x) } else { x }, DIGITS)
            });
            // What is written is what has to fit.
            let shape = Shape { inner: Some(inner.map(|x| x as f32)), ..*shape };
            shape.curve().is_ok().then(|| (name, inner.map(|x| short(x, DIGITS))))
        })
    }
}

/// A time in seconds, known to be finite.
pub(crate) fn seconds(unit: Unit, key: &'static str, time: &Spanned<Number>) -> Result<f64, Fault> {
    let x = time.get_ref().get();
    if x.is_finite() {
        return Ok(unit.seconds(x));
    }
    Err(Fault::at(time, What::Finite { key }))
}

/// A time in seconds that has to be more than 0, if there is one.
pub(crate) fn positive(unit: Unit, key: &'static str, time: Optional) -> Result<Option<f64>, Fault> {
    let Some(place) = time else { return Ok(None) };
    let seconds = seconds(unit, key, place)?;
    if seconds > 0.0 { Ok(Some(seconds)) } else { Err(Fault::at(place, What::Positive { key })) }
}

/// A time in seconds that has to be 0 or more.
pub(crate) fn not_negative(unit: Unit, key: &'static str, time: &Spanned<Number>) -> Result<f64, Fault> {
    let seconds = seconds(unit, key, time)?;
    if seconds < 0.0 {
        return Err(Fault::at(time, What::NotNegative { key }));
    }
    Ok(seconds)
}

/// A whole number from 1 to `most`.
pub(crate) fn whole(key: &'static str, place: &Spanned<Number>, most: u32) -> Result<u32, Fault> {
    let x = place.get_ref().get();
    if x.fract() == 0.0 && (1.0..=most.into()).contains(&x) {
        return Ok(x as u32);
    }
    Err(Fault::at(place, What::Whole { key, most }))
}

fn eight(numbers: &Spanned<Vec<Number>>) -> Result<[f32; 8], Fault> {
    let many = numbers.get_ref();
    let mut eight = [0.0; 8];
    if many.len() != eight.len() {
        return Err(Fault::at(numbers, What::NotEight(many.len())));
    }
    for (i, number) in many.iter().enumerate() {
        eight[i] = number.get() as f32;
        if !eight[i].is_finite() {
            let fault = Fault::at(numbers, What::Finite { key: KEYS[EIGHT] });
            return Err(Fault { inner: Some((i, i + 1)), ..fault });
        }
    }
    Ok(eight)
}
