//! What a user wrote in a scene, which outlives a new fit: the keys that no fit measures, the unit, and all comments.

use std::mem::take;

use shutter_fit::unit::{Unit, count};
use toml_edit::{Decor, DocumentMut, Item, Key};

use super::quantity;
use crate::scene::{KEYS, TRIGGER_TIMES};

/// How a fit's comments begin: the first one, those that follow it, and those above a key.
const FIRST: [&str; 2] = ["# Fitted to ", "# Measured in "];
const NEXT: [&str; 6] = ["# This curve does not", "# `--model ", "# Read: ", "# Sync: ", "# Exposure ", "# Warning: "];
const ABOVE: [&str; 2] = ["# The ramps' inner control points ", NO_DELAY];
/// The lines of what no fit measures, which stand there until their user writes the key.
const ASKED: [(&str, &str); 4] = [
    ("set_up", "# set_up = \"emulated\" # the "),
    ("set_up", "# set_up = \"in_path\" # this "),
    ("timer_hz", "# timer_hz = ... # "),
    ("sync_falls", "# sync_falls = ... # "),
];
const NO_DELAY: &str = "# delay = ? # ";
/// Above a delay, which may outlive a fit that measures none.
const ABOVE_DELAY: &str = "# From the edge of the camera's sync ";

/// A scene that is there.
pub struct Old(DocumentMut);

impl Old {
    /// The scene that a text is, whether it can be planned or not.
    pub fn parse(text: &[u8]) -> Option<Self> {
        let scene: DocumentMut = std::str::from_utf8(text).ok()?.parse().ok()?;
        scene.contains_key("open_start").then_some(Self(scene))
    }

    /// How many triggers it has.
    pub fn triggers(&self) -> Option<u32> {
        let times = self.0.get("trigger_times").and_then(Item::as_array).map(|it| it.len() as i64);
        let whole = |x: f64| (x.fract() == 0.0).then_some(x as i64);
        let count = |it: &Item| it.as_integer().or_else(|| whole(it.as_float()?));
        let count = self.0.get("triggers").and_then(count).or(times);
        count.and_then(|count| count.try_into().ok())
    }

    /// Which edge of the sync counts in it.
    pub fn sync_falls(&self) -> Option<bool> {
        self.0.get("sync_falls").and_then(Item::as_bool)
    }

    /// The unit of its times.
    pub fn unit(&self) -> Unit {
        let name = self.0.get("unit").and_then(Item::as_str);
        name.and_then(quantity::unit).unwrap_or(Unit::Second)
    }

    /// The new scene, which is in the same unit, with all that is the user's, and what that is.
    pub fn kept_in(&self, text: &str) -> (String, Vec<String>) {
        let mut new: DocumentMut = text.parse().expect("a fit writes TOML");
        let keeps_delay = !new.contains_key("delay") && self.0.contains_key("delay");
        let (mut scene, mut kept) = (DocumentMut::new(), Vec::new());
        // What comes before the next key.
        let mut above = String::new();
        for (name, old) in self.0.iter() {
            let Some(key) = self.0.key(name) else { continue };
            above += &of_user(prefix(key.leaf_decor()), keeps_delay);
            let fresh = new.remove_entry(name);
            // Above the unit is the head.
            if let Some((key, _)) = fresh.as_ref().filter(|_| name != "unit") {
                let lines = prefix(key.leaf_decor()).split_inclusive('\n');
                let is_answered = |line: &&str| {
                    keeps_delay && line.starts_with(NO_DELAY)
                        || ASKED.iter().any(|(key, start)| line.starts_with(start) && self.0.contains_key(key))
                };
                above.extend(lines.filter(|line| !is_answered(line)));
            }
            let behind = old.as_value().map_or("", |value| suffix(value.decor()));
            let is_asked = ["delay", "delay_spread", "sync_falls", "nominal"].contains(&name) && fresh.is_some();
            let is_measured = is_measured(name) || is_asked;
            if is_measured {
                above += &inside(old);
            }
            let item = match fresh {
                Some((_, mut fresh)) if is_measured => {
                    if let Some(value) = fresh.as_value_mut() {
                        value.decor_mut().set_suffix(behind);
                    }
                    fresh
                }
                None if is_measured => {
                    if behind.contains('#') {
                        above += &format!("{}\n", behind.trim());
                    }
                    continue;
                }
                fresh => {
                    if fresh.map(|(_, fresh)| value(&fresh)) != Some(value(old)) {
                        kept.push(format!("{name} = {}", value(old)));
                    }
                    old.clone()
                }
            };
            let mut key = key.clone();
            key.leaf_decor_mut().set_prefix(take(&mut above));
            scene.insert_formatted(&key, item);
        }
        for (name, item) in new.iter().filter(|(name, _)| *name != "unit") {
            scene.insert_formatted(new.key(name).unwrap_or(&Key::new(name)), item.clone());
        }
        let last = self.0.trailing().as_str().unwrap_or_default();
        scene.set_trailing(above + &of_user(last, keeps_delay));
        let head = text.split_inclusive('\n').take_while(|line| line.starts_with('#'));
        let scene = head.collect::<String>() + &scene.to_string();
        let comments = scene.lines().filter_map(|line| line.split_once('#'));
        match comments.filter(|(_, comment)| !text.contains(comment)).count() as u64 {
            0 => (),
            n => kept.push(count(n, "comment")),
        }
        (scene, kept)
    }
}

/// Does every fit write this key anew, or leave it out?
fn is_measured(key: &str) -> bool {
    // Those of the curve, and their number.
    KEYS[..6].contains(&key) || key == TRIGGER_TIMES
}

/// The lines above a key that no fit has written.
fn of_user(lines: &str, keeps_delay: bool) -> String {
    let begins = |line: &str, starts: &[&str]| starts.iter().any(|start| line.starts_with(start));
    let mut is_head = false;
    let is_own = |line: &&str| {
        let is_first = begins(line, &FIRST);
        is_head |= is_first;
        let is_asked = ASKED.iter().any(|(_, start)| line.starts_with(start));
        !(is_first
            || is_head && begins(line, &NEXT)
            || is_asked
            || begins(line, &ABOVE)
            || !keeps_delay && line.starts_with(ABOVE_DELAY))
    };
    lines.split_inclusive('\n').filter(is_own).collect()
}

/// The comments in an array, a line each.
fn inside(item: &Item) -> String {
    let Some(array) = item.as_array() else { return String::new() };
    let around = array.iter().flat_map(|it| [prefix(it.decor()), suffix(it.decor())]);
    let lines = around.chain(array.trailing().as_str()).flat_map(str::lines);
    lines.filter_map(|line| Some(format!("{}\n", line.get(line.find('#')?..)?))).collect()
}

/// A value as it is written, without a comment.
fn value(item: &Item) -> String {
    let text = item.to_string();
    let text = text.split('#').next().unwrap_or_default().trim();
    if item.is_str() { text.into() } else { text.replace('_', "") }
}

fn prefix(decor: &Decor) -> &str {
    decor.prefix().and_then(|text| text.as_str()).unwrap_or_default()
}

fn suffix(decor: &Decor) -> &str {
    decor.suffix().and_then(|text| text.as_str()).unwrap_or_default()
}
