//! A plan's facts, in the words of those who test shutters: the report, JSON, a page and a module's head render these.

use serde::Serialize;
use serde_json::json;
use shutter_curve::ShutterCurve;
use shutter_fit::fact::{Fact, Message};
use shutter_fit::unit::{Unit, count, plus_minus, short, stops};

use crate::lamp::{FullyOpen, Lamp, SetUp};
use crate::plan::{Curve, MOST_TRIGGERS, Plan, digits};
use crate::scene::Scene;
use crate::sync::Delay;

/// What is known of a plan, and what is doubtful about it.
#[derive(Clone, Debug, Serialize)]
pub struct Facts {
    /// In the order in which they are told.
    pub facts: Vec<Fact>,
    /// What may be wrong.
    pub doubts: Vec<Message>,
}

/// A trigger that is off by this part of its share matters.
const MATTERS: f64 = 0.01;
/// What is further off may be at another tick.
const HALF_TICK: f64 = 0.5;
/// A curve whose exposure differs by more than this from the one that was measured is another: a scene's digits make
/// less.
const ROUNDED: f64 = 2e-5;

impl Facts {
    /// Those of a plan.
    pub fn new(plan: &Plan) -> Self {
        let mut facts = match &plan.curve {
            Some(curve) => of_curve(plan, curve),
            None => of_times(plan),
        };
        if let Some(it) = &plan.scene.shutter.measured {
            let exposure = plus_minus(it.exposure, it.exposure_error, it.unit.name());
            let found = format!("exposure {exposure}, efficiency {}", it.efficiency);
            facts.push(Fact::words("trace", it.trace.clone()));
            facts.push(Fact::words("measured", found));
        }
        facts.extend(nominal(plan));
        facts.push(Fact::new("timer", "timer_hz", plan.timer.hz, plan.timer.told(plan.edge_to_end())));
        facts.extend(delay(plan));
        facts.push(gap(plan));
        facts.extend(pulses(plan).map(|told| Fact::words("pulses", told)));
        facts.push(Fact::new("set-up", "set_up", json!(plan.scene.flashes.set_up), set_up(plan)));
        let keep = match plan.curve.as_ref().map(|curve| curve.most) {
            None => " as measured".into(),
            Some(1) => "; 1 keeps the gap, 2 do not".into(),
            Some(MOST_TRIGGERS) => format!("; {MOST_TRIGGERS} keep the gap"),
            Some(most) => format!("; {most} keep the gap, {} do not", most + 1),
        };
        facts.push(Fact::words("triggers", format!("{}{keep}", plan.triggers.len())));
        if let Some(Curve { shutter, .. }) = &plan.curve {
            let n = shutter.direct_triggers();
            let told = match n {
                0 => "a frame of any size may need searches".into(),
                n => format!("no frame of up to {} needs a search", count(n, "trigger")),
            };
            facts.push(Fact::new("direct", "direct_triggers", n, told));
        }
        facts.extend(spread(plan).map(|told| Fact::words("spread", told)));
        facts.extend(drift(plan).map(|frames| {
            let frames = short(frames, 2);
            Fact::words("drift", format!("a tick a second moves the delay by 1 % of a share in {frames} frames"))
        }));
        Self { facts, doubts: doubts(plan) }
    }

    /// As lines, each a label and its words, the doubts behind.
    pub fn lines(&self, name: &str) -> Vec<(&'static str, String)> {
        let scene = [("scene", name.to_string())];
        let doubts = self.doubts.iter().map(|doubt| ("doubt", doubt.text.clone()));
        scene.into_iter().chain(shutter_fit::fact::lines(&self.facts)).chain(doubts).collect()
    }

    /// A number by its key.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.facts.iter().find(|fact| fact.key == key)?.value.as_f64()
    }
}

fn of_curve(plan: &Plan, curve: &Curve) -> Vec<Fact> {
    let shutter = &curve.shutter;
    let unit = plan.unit;
    let times = [shutter.open_start(), shutter.open_end(), shutter.close_start(), shutter.close_end()].map(f64::from);
    let [from, open, close, to] = times.map(|time| short(unit.of(time - plan.origin()), 5));
    let [open_start, open_end, close_start, close_end] = times;
    let seconds = |key, label, name, seconds: f64, what| {
        Fact::new(label, key, digits(seconds as f32), format!("{name} {} {what}", unit.show(seconds)))
    };
    let half_open = f64::from(half(shutter, shutter.close_end(), shutter.close_start()))
        - f64::from(half(shutter, shutter.open_start(), shutter.open_end()));
    let (exposure, efficiency) = (curve.exposure(), curve.efficiency());
    let percent = short(100.0 * f64::from(efficiency), 4);
    let after = if plan.sync.delay.is_some() { " after the sync" } else { "" };
    vec![
        Fact::words("shutter", format!("opens {from} to {open}, closes {close} to {to} {}{after}", unit.name())),
        seconds("opening_s", "times", "T1", open_end - open_start, "opening"),
        seconds("open_s", "times", "T2", close_start - open_end, "fully open"),
        seconds("closing_s", "times", "T3", close_end - close_start, "closing"),
        Fact::new(
            "half open",
            "half_open_s",
            digits(half_open as f32),
            format!("TE {}, between the half openings", unit.show(half_open)),
        ),
        Fact::new(
            "exposure",
            "exposure_s",
            digits(exposure),
            format!("TV {}, fully open for as much light", unit.show(exposure)),
        ),
        Fact::new("efficiency", "efficiency", digits(efficiency), format!("{percent} %")),
    ]
}

/// Without a curve there is less to say.
fn of_times(plan: &Plan) -> Vec<Fact> {
    let opens = plan.unit.show(plan.start - plan.origin());
    let told = match plan.sync.delay {
        Some(_) => format!("{opens} after the sync"),
        None => format!("at {opens}, from where ticks count"),
    };
    vec![Fact::words("shutter", "no curve: trigger times as measured"), Fact::words("opens", told)]
}

/// A time between `dark` and `open` at which the shutter is half open, as near as f32 are.
fn half(curve: &ShutterCurve, dark: f32, open: f32) -> f32 {
    let (mut below, mut above) = (dark, open);
    loop {
        let middle = below + 0.5 * (above - below);
        if middle == below || middle == above {
            return above;
        }
        *(if curve.openness(middle) >= 0.5 { &mut above } else { &mut below }) = middle;
    }
}

/// What the exposure is called, and by how many stops it is longer; negative if it is shorter.
fn nominal(plan: &Plan) -> Vec<Fact> {
    let Some(nominal) = plan.scene.shutter.nominal else { return Vec::new() };
    let told = Fact::new("nominal", "nominal_s", nominal, plan.unit.show(nominal));
    let delta = plan.curve.as_ref().map(|curve| (f64::from(curve.exposure()) / nominal).log2());
    let delta = delta.map(|ev| Fact::new("nominal", "delta_ev", digits(ev as f32), format!("ΔEV {}", stops(ev))));
    [told].into_iter().chain(delta).collect()
}

/// From where the ticks count, and what is taken off each trigger.
fn delay(plan: &Plan) -> Vec<Fact> {
    let (unit, sync) = (plan.unit, &plan.sync);
    let Some(Delay { seconds, error, falls, spread, .. }) = sync.delay else {
        let none = Fact::words("delay", "none known: ticks count from the start of opening, not from a sync");
        return [none].into_iter().chain(lag(plan)).collect();
    };
    let edge = match falls {
        Some(true) => "falling edge",
        Some(false) => "rising edge",
        None => "edge (`sync_falls`: which?)",
    };
    let told = format!("{} from the sync's {edge} to the start of opening", unit.show(seconds));
    let known = error.zip(plan.scene.shutter.measured.as_ref().and_then(|it| Some(it.unit.seconds(it.trigger_error?))));
    let known = known.map(|(error, to_any)| {
        let [opening, any] = [error, to_any].map(|error| short(unit.of(error), 2));
        Fact::words("known to", format!("± {opening} {0} to the opening, ± {any} {0} to any trigger", unit.name()))
    });
    let delay = Fact::new("delay", "delay_s", seconds, told);
    let ticks = Fact::new("delay", "delay_ticks", sync.ticks, "");
    let spread = spread.map(|spread| Fact::new("delay", "delay_spread_s", spread, ""));
    let falls = Fact::new("delay", "sync_falls", falls, "");
    [delay.error(error), ticks, falls].into_iter().chain(spread).chain(known).chain(lag(plan)).collect()
}

fn lag(plan: &Plan) -> Option<Fact> {
    let told = |lag| format!("{}: the lamp is triggered so much earlier", plan.unit.show(lag));
    plan.sync.lag.map(|lag| Fact::new("lamp lag", "lamp_lag_s", lag, told(lag)))
}

/// What the gap is to be, and what it is.
fn gap(plan: &Plan) -> Fact {
    let unit = plan.unit;
    let has_pulses = plan.lamp.has_pulses();
    let dark = if has_pulses { " of darkness between pulses" } else { "" };
    let asked = match plan.scene.flashes.min_gap {
        Some(gap) => format!("at least {}{dark}", unit.show(gap)),
        None => format!("none asked for{dark}"),
    };
    let told = match closest(plan) {
        Some(least) if has_pulses => format!("{asked}; the least is {}", unit.show(least)),
        Some(least) => format!("{asked}; the closest two come {} apart", unit.show(least)),
        None => asked,
    };
    Fact::new("gap", "min_gap_s", plan.scene.flashes.min_gap, told)
}

/// The least time between two triggers, or between the end of a pulse and the next.
pub fn closest(plan: &Plan) -> Option<f64> {
    let dark = plan.pulses().zip(plan.pulses().skip(1)).map(|((_, off), (on, _))| on - off);
    let least = if plan.lamp.has_pulses() { dark.min() } else { plan.gaps().min() };
    least.map(|ticks| plan.seconds(ticks))
}

/// A trigger's share of the exposure, in seconds of the open shutter; without a curve, the least gap.
fn share(plan: &Plan) -> Option<f64> {
    let Some(Curve { shutter, .. }) = &plan.curve else { return closest(plan) };
    let all = match plan.lamp {
        Lamp::FullyOpen => FullyOpen::new(shutter).length(),
        _ => shutter.exposure().into(),
    };
    Some(all / plan.triggers.len() as f64)
}

/// What the delay's spread between shots does to a frame, if the scene tells it.
fn spread(plan: &Plan) -> Option<String> {
    let (spread, share, unit) = (plan.sync.delay?.spread?, share(plan)?, plan.unit);
    let percent = |of: f64| format!("{} %", short(100.0 * spread / of, 2));
    let gap = plan.scene.flashes.min_gap.filter(|gap| *gap > 0.0);
    let gap = gap.map_or(String::new(), |gap| format!(" and {} of the gap", percent(gap)));
    let most = MATTERS * share * plan.triggers.len() as f64 / spread;
    let helps = match &plan.curve {
        _ if spread <= MATTERS * share => "that hardly matters".into(),
        Some(_) if most >= 1.0 => format!("up to {} keep it to 1 % of a share", count(most as u64, "trigger")),
        _ => "only a steadier sync keeps it to 1 % of a share".into(),
    };
    let (spread, of_share) = (unit.show(spread), percent(share));
    Some(format!(
        "{spread} from shot to shot, {of_share} of a share{gap}: a frame moves as one, so its gap holds; {helps}"
    ))
}

/// In how many frames a delay that moves by a tick a second moves by 1 % of a share, if there is a delay and a share.
fn drift(plan: &Plan) -> Option<f64> {
    plan.sync.delay.filter(|_| plan.timer.is_given)?;
    // A tick a second is so many ticks after as many seconds, in frames one right after the other.
    let ticks = share(plan)? * f64::from(plan.timer.hz);
    Some(MATTERS * ticks / plan.edge_to_end().max(plan.length))
}

/// How long the lamp's pulses are, if it has any.
fn pulses(plan: &Plan) -> Option<String> {
    let unit = plan.unit;
    match plan.lamp {
        Lamp::Triggered | Lamp::FullyOpen => None,
        Lamp::Equal { ticks } => Some(format!("{} each, around the triggers", unit.show(plan.seconds(ticks)))),
        Lamp::Doses { duty } => {
            let lengths = plan.pulses().map(|(on, off)| off - on);
            let (least, most) = (lengths.clone().min(), lengths.max());
            let [least, most] = [least, most].map(|ticks| plan.seconds(ticks.unwrap_or_default()));
            let least = short(unit.of(least), 5);
            let duty = short(duty.into(), 6);
            let doses = match unequal(plan) {
                Some(percent) => format!("of doses that differ by up to {percent} %, as a tick is so long"),
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
    let dimmed = || few(&plan.doses(SetUp::InPath));
    match (plan.scene.flashes.set_up, plan.lamp) {
        (Some(SetUp::InPath), Doses { .. }) => "in the light's path; a lamp steady while it is on".into(),
        (Some(SetUp::InPath), FullyOpen) => "in the light's path; one dose each, while it is fully open".into(),
        (Some(SetUp::InPath), _) => format!("in the light's path, which dims the flashes to {}", dimmed()),
        (Some(SetUp::Emulated), Equal { .. }) => {
            "emulated: equal pulses while the camera's own shutter stays open".into()
        }
        (Some(SetUp::Emulated), _) => FLASHES.into(),
        (None, Doses { .. }) => "not said: `duty` is for one in the light's path".into(),
        (None, FullyOpen) => "not said: `fully_open` is for one in the light's path".into(),
        (None, Triggered | Equal { .. }) if plan.curve.is_some() => {
            format!("not said: emulated, or in the light's path, which dims the flashes to {}", dimmed())
        }
        (None, _) => "not said".into(),
    }
}

/// All that may be wrong with a plan that is none the less made.
fn doubts(plan: &Plan) -> Vec<Message> {
    let Scene { shutter, is_edited, .. } = &plan.scene;
    let traced = shutter.measured.iter().flat_map(|it| &it.warnings).map(|text| ("trace", Some(text.clone()), None));
    let edited = is_edited.then(|| {
        "what a fit wrote below [shutter] was changed by hand since; a hand's own delay and edge belong below [flashes]"
            .into()
    });
    let told = shutter.sync_falls.zip(plan.sync.delay.and_then(|it| it.falls));
    let inverted = told.filter(|(told, said)| told != said).map(|(told, said)| {
        let edge = if said { "falling" } else { "rising" };
        format!(
            "the trace has `sync_falls` = {told}, and the flashes count from the {edge} edge: that is right if \
             something between the camera and the timer inverts the sync"
        )
    });
    let curve = plan.curve.as_ref().filter(|it| plan.timer.is_given && it.moved >= HALF_TICK);
    let moved = curve.map(|curve| {
        let ticks = count(curve.moved.ceil() as u64, "tick");
        format!("f32 moves the curve's times by up to {ticks}; they are nearest where `open_start` is 0")
    });
    let length = plan.edge_to_end();
    let is_off = plan.timer.off(length) >= HALF_TICK;
    let rate = is_off.then(|| format!("the timer has {}", plan.timer.told(length)));
    let dimmed = dimmed(plan).map(|doses| {
        format!(
            "the shutter is in the light's path, and dims the flashes to {doses}; `duty` = 0.5 (for pulses) or \
             `fully_open` (for xenon) makes doses equal"
        )
    });
    let unequal = unequal(plan)
        .map(|by| format!("a tick is so long that the doses differ by up to {by} %; a faster timer makes them equal"));
    let coarse = coarse(plan).map(|by| {
        let by = short(by, 2);
        format!("a tick is so long that flashes move by up to {by} % of a share; a faster timer moves them less")
    });
    let own = [
        ("edited", edited, None),
        ("exposure_differs", exposure_differs(plan), None),
        ("delay_differs", delay_differs(plan), None),
        ("sync_inverted", inverted, Some("sync_falls")),
        ("times_rounded", moved, None),
        ("rate_rounded", rate, Some("timer_hz")),
        ("dimmed", dimmed, Some("duty")),
        ("unequal", unequal, Some("timer_hz")),
        ("coarse", coarse, Some("timer_hz")),
    ];
    traced.chain(own).filter_map(|(code, text, remedy)| Some(Message { code, text: text?, remedy })).collect()
}

/// Is the curve's exposure another than the one that was measured beside it?
fn exposure_differs(plan: &Plan) -> Option<String> {
    let (it, curve) = (plan.scene.shutter.measured.as_ref()?, plan.curve.as_ref()?);
    let measured = it.unit.seconds(it.exposure);
    let here = f64::from(curve.exposure());
    let differs = (here - measured).abs() > ROUNDED * measured.max(here) || !measured.is_finite();
    let unit = Unit::fit(here);
    differs.then(|| {
        format!(
            "the curve's exposure is {}, and the trace's {}: one of them was changed by hand (a time, the unit), or \
             this model does not explain the trace",
            unit.show(here),
            plus_minus(it.exposure, it.exposure_error, it.unit.name())
        )
    })
}

/// Is the delay that counts another than that of the trace?
fn delay_differs(plan: &Plan) -> Option<String> {
    let (delay, traced) = (plan.sync.delay?, plan.scene.shutter.delay?);
    let it = plan.scene.shutter.measured.as_ref()?;
    let error = it.unit.seconds(it.delay_error.unwrap_or_default());
    let differs = delay.key == "flashes.delay" && (delay.seconds - traced).abs() > 2.0 * error;
    differs.then(|| {
        let unit = plan.unit;
        let (own, traced) = (unit.show(delay.seconds), unit.plus_minus(traced, error));
        format!("the flashes' own delay of {own} counts, and the trace has {traced}")
    })
}

/// By how much the doses of a duty differ, in percent of the greatest, if it is more than one: the timer's ticks round
/// its pulses.
fn unequal(plan: &Plan) -> Option<String> {
    matches!(plan.lamp, Lamp::Doses { .. }).then_some(())?;
    let least = plan.doses(SetUp::InPath).into_iter().fold(1.0, f64::min);
    (least < 0.99).then(|| short(100.0 * (1.0 - least), 2))
}

/// By how much the timer's ticks move a flash without a dose of its own, in percent of a share, if it is more than one.
pub fn coarse(plan: &Plan) -> Option<f64> {
    let has_doses = matches!(plan.lamp, Lamp::Doses { .. });
    let percent = 50.0 / (share(plan)? * f64::from(plan.timer.hz));
    let is_told = plan.timer.is_given && !has_doses && percent > 100.0 * MATTERS;
    is_told.then_some(percent)
}

/// The doses of equal flashes that a shutter in the light's path dims by more than a hundredth.
fn dimmed(plan: &Plan) -> Option<String> {
    let is_equal = matches!(plan.lamp, Lamp::Triggered | Lamp::Equal { .. });
    let doses = (is_equal && plan.scene.flashes.set_up == Some(SetUp::InPath)).then(|| plan.doses(SetUp::InPath))?;
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
fn ends(doses: &[f64]) -> Vec<f64> {
    let mut places = vec![0, doses.len() / 2, doses.len() - 1];
    places.dedup();
    places.into_iter().map(|i| doses[i]).collect()
}
