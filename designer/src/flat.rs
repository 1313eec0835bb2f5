//! A scene as the page has it: all keys of both tables side by side, as numbers in this order.

use shutter_fit::unit::Unit;
use shutter_plan::lamp::SetUp;
use shutter_plan::scene::{Flashes, Scene, Shutter};

/// The keys, as the page numbers them and as a fault's place does.
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
/// So many numbers: one for each of [`KEYS`], and eight for `shutteropening`.
pub const NUMBERS: usize = KEYS.len() + 7;

/// The place of a key's number.
pub fn place(key: &str) -> usize {
    let place = KEYS.iter().position(|known| *known == key).unwrap_or_default();
    if place > EIGHT { place + 7 } else { place }
}

/// The scene of numbers. One that may be left out is NaN where it is; a number of pieces or ticks need not be whole
/// yet. Of a choice it is the place: emulated before in the path, false before true.
pub fn of_numbers(unit: Unit, numbers: &[f64; NUMBERS]) -> Scene {
    let number = |key| Some(numbers[place(key)]).filter(|x| !x.is_nan());
    let choice = |key| number(key).map(|x| x == 1.0);
    let eight = &numbers[EIGHT..EIGHT + 8];
    let shutter = Shutter {
        unit: Some(unit),
        open_start: Some(numbers[0]),
        open_end: Some(numbers[1]),
        close_start: Some(numbers[2]),
        close_end: Some(numbers[3]),
        shutteropening: (!eight[0].is_nan()).then(|| eight.to_vec()),
        nominal: number("nominal"),
        ..Shutter::default()
    };
    let flashes = Flashes {
        triggers: Some(numbers[place("triggers")]),
        timer_hz: number("timer_hz"),
        timer_bits: number("timer_bits"),
        min_gap: Some(numbers[place("min_gap")]),
        pulse: number("pulse"),
        duty: number("duty"),
        min_pulse: number("min_pulse"),
        delay: number("delay"),
        delay_spread: number("delay_spread"),
        lamp_lag: number("lamp_lag"),
        set_up: choice("set_up").map(|is_in_path| if is_in_path { SetUp::InPath } else { SetUp::Emulated }),
        sync_falls: choice("sync_falls"),
        fully_open: choice("fully_open"),
        ..Flashes::default()
    };
    Scene { shutter, flashes, is_edited: false }
}

/// Both tables as one; what only a fit writes, and the flashes' own unit, are left out.
pub fn object(scene: &Scene) -> serde_json::Value {
    let (of, unit) = (scene.unit(), scene.shutter.unit.or(scene.flashes.unit));
    let convert = |time: Option<f64>| time.map(|time| unit.unwrap_or(Unit::Second).of(of.seconds(time)));
    let Flashes { min_gap, pulse, min_pulse, lamp_lag, delay, delay_spread, sync_falls, .. } = scene.flashes;
    let own = Flashes {
        unit,
        min_gap: Some(convert(min_gap).unwrap_or_default()),
        pulse: convert(pulse),
        min_pulse: convert(min_pulse),
        lamp_lag: convert(lamp_lag),
        delay: convert(delay).or(scene.shutter.delay),
        delay_spread: convert(delay_spread).or(scene.shutter.delay_spread.filter(|_| delay.is_none())),
        sync_falls: sync_falls.or(scene.shutter.sync_falls.filter(|_| delay.is_none())),
        ..scene.flashes.clone()
    };
    let shutter = Shutter { measured: None, ..scene.shutter.clone() };
    let [mut all, own] = [serde_json::to_value(shutter), serde_json::to_value(own)].map(Result::unwrap_or_default);
    if let (Some(all), serde_json::Value::Object(mut own)) = (all.as_object_mut(), own) {
        all.append(&mut own);
    }
    all
}
