//! `shutter fit` of several sensors of each record, as behind a curtain shutter: each one's exposure, and how long the
//! curtains travel between them.

use shutter_fit::Measured;
use shutter_fit::unit::{Unit, stops};

use super::fit_many::Speed;
use crate::speeds;

/// A row for each sensor of each speed, compared with the first.
pub fn table(speeds: &[Vec<Speed>]) -> String {
    let header = ["sensor", "exposure", "ΔEV", "stops", "opens later by", "closes later by", "model"];
    let row = |first: &Speed, k: usize, Speed { name, fit, .. }: &Speed| {
        let first = &first.fit;
        let later = |place: usize| {
            let ends = [0, fit.triggers.len() - 1].map(|k| [first, fit].map(|fit| fit.triggers[k].error));
            let [from, to] = [first, fit].map(|fit| fit.half_light()[place]);
            let error = ends[place][0].hypot(ends[place][1]);
            let unit = Unit::fit((to - from).abs().max(error));
            if k == 0 { "-".into() } else { unit.plus_minus(to - from, error) }
        };
        let (unit, Measured { value, error }) = (fit.unit(), fit.exposure);
        let more = if k == 0 { "-".into() } else { stops((value / first.exposure.value).log2()) };
        let ev = fit.nominal.map_or("-".into(), |nominal| stops((value / nominal).log2()));
        let exposure = unit.plus_minus(value, error);
        [name.clone(), exposure, ev, more, later(0), later(1), fit.chosen.title().into()]
    };
    let rows = speeds.iter().flat_map(|speed| speed.iter().enumerate().map(|(k, sensor)| row(&speed[0], k, sensor)));
    speeds::table(header, rows)
        + "ΔEV: against --nominal; stops: how much more light the sensor gets than the first one; opens, closes later \
           by: the\ntravel of the first and of the second curtain from the first sensor to this one, at half light\n"
}
