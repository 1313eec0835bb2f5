//! A plan's facts, in the words of those who test shutters.

use shutter_curve::ShutterCurve;
use shutter_fit::unit::{Unit, count, short, stops};

use crate::delay::{Delay, Lag};
use crate::lamp::{FullyOpen, Lamp, SetUp};
use crate::plan::{MOST_TRIGGERS, Plan};
use crate::planned::Planned;
use crate::set_up::doses;
use crate::times::Times;

/// What a shutter tester prints, times in seconds. ISO 516 defines such terms; these are no measurement by it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// T1: how long it opens.
    pub opening: f64,
    /// T2: how long it is fully open.
    pub open: f64,
    /// T3: how long it closes.
    pub closing: f64,
    /// TE: from half open to half closed.
    pub half_open: f64,
    /// By how many stops the exposure is longer than the nominal one, where that is known; negative if it is shorter.
    pub delta_ev: Option<f64>,
}

impl Facts {
    /// The facts of a plan.
    pub fn new(plan: &Plan) -> Self {
        let curve = &plan.curve;
        let [open_start, open_end, close_start, close_end] =
            [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()].map(f64::from);
        Self {
            opening: open_end - open_start,
            open: close_start - open_end,
            closing: close_end - close_start,
            half_open: f64::from(half(curve, curve.close_end(), curve.close_start()))
                - f64::from(half(curve, curve.open_start(), curve.open_end())),
            delta_ev: plan.nominal.map(|nominal| (f64::from(curve.exposure()) / nominal).log2()),
        }
    }
}

/// The first time on the way from `dark` to `open` at which the shutter is half open.
fn half(curve: &ShutterCurve, dark: f32, open: f32) -> f32 {
    const STEPS: u16 = 1024;
    let is_half = |t: f32| curve.openness(t) >= 0.5;
    let step = |i: u16| dark + (open - dark) * (f32::from(i) / f32::from(STEPS));
    let Some(i) = (0..STEPS).find(|&i| is_half(step(i))) else { return open };
    if i == 0 {
        return dark;
    }
    // Between a step that is not and one that is: as near as f32 are.
    let (mut below, mut above) = (step(i - 1), step(i));
    loop {
        let middle = below + 0.5 * (above - below);
        if middle == below || middle == above {
            return above;
        }
        *(if is_half(middle) { &mut above } else { &mut below }) = middle;
    }
}

/// The facts as lines, each a name and what is to be said.
pub fn lines(name: &str, plan: &Planned) -> Vec<(&'static str, String)> {
    let mut lines = match plan {
        Planned::Curve(plan) => of_curve(name, plan),
        Planned::Times(times) => of_times(name, times),
    };
    let told = |by| format!("moves flashes by up to {} % of a share", short(by, 2));
    lines.extend(coarse(plan).map(|by| ("rounding", told(by))));
    lines
}

fn of_curve(name: &str, plan: &Plan) -> Vec<(&'static str, String)> {
    let (facts, curve, unit) = (Facts::new(plan), &plan.curve, plan.unit);
    let [from, open, close, to] = [curve.open_start(), curve.open_end(), curve.close_start(), curve.close_end()]
        .map(|time| short(unit.of(time), 5));
    let [t1, t2, t3] = [facts.opening, facts.open, facts.closing].map(|time| unit.show(time));
    let mut lines = vec![
        ("scene", name.to_string()),
        ("shutter", format!("opens from {from} to {open}, closes from {close} to {to} {}", unit.name())),
        ("times", format!("T1 {t1} opening, T2 {t2} fully open, T3 {t3} closing")),
        ("half open", format!("TE {}, between the half openings", unit.show(facts.half_open))),
        ("exposure", format!("TV {}, fully open for as much light", unit.show(curve.exposure()))),
        ("efficiency", format!("{} %", short(100.0 * f64::from(curve.efficiency()), 4))),
    ];
    lines.extend(plan.fitted.iter().cloned());
    if let (Some(nominal), Some(delta)) = (plan.nominal, facts.delta_ev) {
        lines.push(("nominal", format!("{}, ΔEV {}", unit.show(nominal), stops(delta))));
    }
    lines.push(("timer", plan.timer.told(plan.edge_to_end())));
    lines.push(("delay", delay(plan.delay, unit)));
    lines.extend(lag(plan.lag, unit));
    lines.push(("gap", gap(plan)));
    lines.extend(pulses(plan).map(|pulses| ("pulses", pulses)));
    lines.push(("set-up", set_up(plan)));
    let keep = match plan.most {
        1 => "1 keeps the gap, 2 do not".into(),
        MOST_TRIGGERS => format!("{MOST_TRIGGERS} keep the gap"),
        most => format!("{most} keep the gap, {} do not", most + 1),
    };
    lines.push(("triggers", format!("{}; {keep}", plan.triggers.len())));
    let direct = match curve.direct_triggers() {
        0 => "a frame of any size may need searches".into(),
        n => format!("no frame of up to {} needs a search", count(n, "trigger")),
    };
    lines.push(("direct", direct));
    lines
}

/// Without a curve there is less to say.
fn of_times(name: &str, times: &Times) -> Vec<(&'static str, String)> {
    let (unit, triggers) = (times.unit, &times.triggers);
    let mut lines = vec![
        ("scene", name.to_string()),
        ("shutter", "no curve: trigger times as measured".into()),
        ("opens", format!("at {}, from where ticks count", unit.show(times.open_start))),
    ];
    lines.extend(times.fitted.iter().cloned());
    lines.extend(times.nominal.map(|nominal| ("nominal", unit.show(nominal))));
    let gap = times.gaps().min().map(|ticks| times.seconds(ticks));
    lines.extend([
        ("timer", times.timer.told(times.edge_to_end())),
        ("delay", delay(times.delay, unit)),
        ("gap", format!("at least {}{}", unit.show(times.min_gap), closest(gap, unit))),
        ("set-up", if times.set_up.is_some() { FLASHES } else { "not said" }.into()),
        ("triggers", triggers.len().to_string()),
    ]);
    lines.extend(lag(times.lag, unit));
    lines
}

/// What the gap is to be, and what it is.
fn gap(plan: &Plan) -> String {
    let unit = plan.unit;
    let mut gap = format!("at least {}", unit.show(plan.min_gap));
    if plan.lamp.has_pulses() {
        gap += " of darkness between pulses";
        let edges = plan.triggers.iter().filter_map(|trigger| trigger.pulse);
        let dark = edges.clone().zip(edges.skip(1)).map(|((_, off), (on, _))| on - off);
        if let Some(ticks) = dark.min() {
            gap += &format!("; the least is {}", unit.show(plan.seconds(ticks)));
        }
    } else {
        gap += &closest(plan.gaps().min().map(|ticks| plan.seconds(ticks)), unit);
    }
    gap
}

fn closest(gap: Option<f64>, unit: Unit) -> String {
    let told = |gap| format!("; the closest two come {} apart", unit.show(gap));
    gap.map_or(String::new(), told)
}

/// A trigger that is off by this part of its share matters.
const MATTERS: f64 = 0.01;

/// A trigger's share of the exposure, in seconds of the open shutter; without a curve, the least gap.
fn share(plan: &Planned) -> Option<f64> {
    match plan {
        Planned::Curve(plan) => {
            let all = match plan.lamp {
                Lamp::FullyOpen => FullyOpen::new(&plan.curve).length(),
                _ => plan.curve.exposure().into(),
            };
            Some(all / plan.triggers.len() as f64)
        }
        Planned::Times(times) => times.gaps().min().map(|ticks| times.seconds(ticks)),
    }
}

/// What the delay's spread between shots does to a frame, if the scene tells it.
pub fn spread(plan: &Planned) -> Option<String> {
    let (spread, share, unit) = (plan.delay?.spread?, share(plan)?, plan.unit);
    let gap = plan.min_gap;
    let percent = |of: f64| format!("{} %", short(100.0 * spread / of, 2));
    let gap = if gap > 0.0 { format!(" and {} of the gap", percent(gap)) } else { String::new() };
    let most = MATTERS * share * plan.rows().len() as f64 / spread;
    let helps = match plan {
        _ if spread <= MATTERS * share => "that hardly matters".into(),
        Planned::Curve(_) if most >= 1.0 => {
            format!("up to {} keep it to 1 % of a share", count(most as u64, "trigger"))
        }
        _ => "only a steadier sync keeps it to 1 % of a share".into(),
    };
    let (spread, of_share) = (unit.show(spread), percent(share));
    Some(format!(
        "{spread} from shot to shot, {of_share} of a share{gap}: a frame moves as one, so its gap holds; {helps}"
    ))
}

/// In how many frames a delay that moves by a tick a second moves by 1 % of a share, if there is a delay and a share.
pub fn drift(plan: &Planned) -> Option<f64> {
    if !plan.timer.is_given || plan.delay.is_none() {
        return None;
    }
    // A tick a second is so many ticks after as many seconds, in frames one right after the other.
    let ticks = share(plan)? * f64::from(plan.timer.hz);
    Some(MATTERS * ticks / plan.edge_to_end())
}

/// From where the ticks count.
fn delay(delay: Option<Delay>, unit: Unit) -> String {
    let Some(delay) = delay else {
        return "none known: ticks count from the start of opening, not from a sync".into();
    };
    let edge = match delay.falls {
        Some(true) => "falling edge",
        Some(false) => "rising edge",
        None => "edge (sync_falls: which?)",
    };
    format!("{} from the sync's {edge} to the start of opening", unit.show(delay.seconds))
}

/// What is taken off each trigger.
fn lag(lag: Option<Lag>, unit: Unit) -> Option<(&'static str, String)> {
    let told = |lag: Lag| format!("{}: the lamp is triggered so much earlier", unit.show(lag.seconds));
    lag.map(|lag| ("lamp lag", told(lag)))
}

/// How long the lamp's pulses are, if it has any.
fn pulses(plan: &Plan) -> Option<String> {
    let unit = plan.unit;
    match plan.lamp {
        Lamp::Triggered | Lamp::FullyOpen => None,
        Lamp::Equal { ticks } => Some(format!("{} each, around the triggers", unit.show(plan.seconds(ticks)))),
        Lamp::Doses { duty } => {
            let lengths = plan.triggers.iter().filter_map(|trigger| trigger.pulse);
            let lengths = lengths.map(|(on, off)| off - on);
            let (least, most) = (lengths.clone().min(), lengths.max());
            let [least, most] = [least, most].map(|ticks| plan.seconds(ticks.unwrap_or_default()));
            let least = short(unit.of(least), 5);
            let duty = short(duty.into(), 6);
            let doses = match unequal(plan) {
                Some(percent) => {
                    format!("of doses that differ by up to {percent} %, as a tick is so long")
                }
                None => "of equal doses".into(),
            };
            Some(format!("{least} to {}, duty {duty}, {doses}", unit.show(most)))
        }
    }
}

/// The set-up of flashes without a length.
const FLASHES: &str = "emulated: equal flashes while the camera's own shutter stays open";

/// How the flashes meet the shutter.
fn set_up(plan: &Plan) -> String {
    use Lamp::{Doses, Equal, FullyOpen, Triggered};
    let dimmed = || few(&doses(SetUp::InPath, plan));
    match (plan.set_up, plan.lamp) {
        (Some(SetUp::InPath), Doses { .. }) => "in the light's path; a lamp steady while it is on".into(),
        (Some(SetUp::InPath), FullyOpen) => "in the light's path; one dose each, while it is fully open".into(),
        (Some(SetUp::InPath), _) => {
            format!("in the light's path, which dims the flashes to {}", dimmed())
        }
        (Some(SetUp::Emulated), Equal { .. }) => {
            "emulated: equal pulses while the camera's own shutter stays open".into()
        }
        (Some(SetUp::Emulated), _) => FLASHES.into(),
        (None, Doses { .. }) => "not said: duty is for one in the light's path".into(),
        (None, FullyOpen) => "not said: fully_open is for one in the light's path".into(),
        (None, Triggered | Equal { .. }) => {
            format!("not said: emulated, or in the light's path, with {}", dimmed())
        }
    }
}

/// By how much the doses of a duty differ, in percent of the greatest, if it is more than one: the timer's ticks round
/// its pulses.
pub fn unequal(plan: &Plan) -> Option<String> {
    matches!(plan.lamp, Lamp::Doses { .. }).then_some(())?;
    let least = doses(SetUp::InPath, plan).into_iter().fold(1.0, f64::min);
    (least < 0.99).then(|| short(100.0 * (1.0 - least), 2))
}

/// By how much the timer's ticks move a flash without a dose of its own, in percent of a share, if it is more than one.
pub fn coarse(plan: &Planned) -> Option<f64> {
    let has_doses = plan.plan().is_some_and(|plan| matches!(plan.lamp, Lamp::Doses { .. }));
    let percent = 50.0 / (share(plan)? * f64::from(plan.timer.hz));
    let is_told = plan.timer.is_given && !has_doses && percent > 100.0 * MATTERS;
    is_told.then_some(percent)
}

/// The doses of equal flashes that a shutter in the light's path dims by more than a hundredth.
#[cfg(feature = "terminal")]
pub fn dimmed(plan: &Plan) -> Option<String> {
    let is_equal = matches!(plan.lamp, Lamp::Triggered | Lamp::Equal { .. });
    let doses = (is_equal && plan.set_up == Some(SetUp::InPath)).then(|| doses(SetUp::InPath, plan))?;
    doses.iter().any(|dose| *dose < 0.99).then(|| few(&doses))
}

/// Those doses in words.
pub fn few(doses: &[f64]) -> String {
    let percent: Vec<_> = ends(doses).into_iter().map(|dose| short(100.0 * dose, 3)).collect();
    match percent.split_last() {
        Some((last, others @ [_, ..])) => format!("{} and {last} %", others.join(", ")),
        _ => percent.join("") + " %",
    }
}

/// The first dose, the middle one and the last, as far as these are several.
pub fn ends(doses: &[f64]) -> Vec<f64> {
    let mut places = vec![0, doses.len() / 2, doses.len() - 1];
    places.dedup();
    places.into_iter().map(|i| doses[i]).collect()
}
