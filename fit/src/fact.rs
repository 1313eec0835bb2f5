//! Facts: each number once, with its error, its unit and its words, for a reader, a program and a page alike.

use serde::Serialize;
use serde_json::{Map, Value, json};

/// What is found about a trace or a plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Fact {
    /// What it is about; neighbours of one label are one line.
    pub label: &'static str,
    /// Its name for a program, which stays as it is: a time in seconds ends with `_s`. Empty where words are all.
    pub key: &'static str,
    /// The number, or what else it is; null if it is not known.
    pub value: Value,
    /// Its standard error.
    pub error: Option<f64>,
    /// As a reader is told, with its unit and the digits that the error leaves; empty where only a program is.
    pub text: String,
}

/// Something that is wrong or doubtful.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Message {
    /// A name that a program can ask for: it stays as it is.
    pub code: &'static str,
    /// What it is, and what to do.
    pub text: String,
    /// The option, or the field of a page, that mends it.
    pub remedy: Option<&'static str>,
}

impl Fact {
    /// Words without a number.
    pub fn words(label: &'static str, text: impl Into<String>) -> Self {
        Self { label, text: text.into(), ..Self::default() }
    }

    /// A number and its words.
    pub fn new(label: &'static str, key: &'static str, value: impl Into<Value>, text: impl Into<String>) -> Self {
        Self { label, key, value: value.into(), error: None, text: text.into() }
    }

    /// With its standard error.
    pub fn error(self, error: Option<f64>) -> Self {
        Self { error, ..self }
    }
}

/// The facts as lines, each a label and its words.
pub fn lines(facts: &[Fact]) -> impl Iterator<Item = (&'static str, String)> {
    let told = facts.iter().filter(|fact| !fact.text.is_empty()).collect::<Vec<_>>();
    let line = |facts: &[&Fact]| {
        let words: Vec<_> = facts.iter().map(|fact| fact.text.as_str()).collect();
        (facts[0].label, words.join(", "))
    };
    told.chunk_by(|a, b| a.label == b.label).map(line).collect::<Vec<_>>().into_iter()
}

/// The numbers by their keys, an error behind its number: null where one is not known.
pub fn numbers(facts: &[Fact]) -> Map<String, Value> {
    let mut all = Map::new();
    for Fact { key, value, error, .. } in facts.iter().filter(|fact| !fact.key.is_empty()) {
        all.insert((*key).into(), value.clone());
        if error.is_some() {
            let stem = key.strip_suffix("_s");
            let name = stem.map_or(format!("{key}_error"), |stem| format!("{stem}_error_s"));
            all.insert(name, json!(error));
        }
    }
    all
}
