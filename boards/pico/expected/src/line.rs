//! What is sent, and the answer that has to come.

use serde_json::{Value, json};

/// What is sent, and the answer that is to come before the next step, if one is.
pub type Line = (Vec<u8>, Option<String>);

/// A line that is answered so, but for what a plan costs.
pub fn told(line: &str, answer: impl Into<String>) -> Line {
    (format!("{line}\n").into(), Some(answer.into()))
}

/// A line that is accepted.
pub fn ok(line: &str, settings: &str) -> Line {
    told(line, format!("ok {settings}"))
}

/// A line that changes nothing.
pub fn refused(line: impl AsRef<[u8]>, reason: impl ToString) -> Line {
    ([line.as_ref(), b"\n"].concat(), Some(format!("refused: {}", reason.to_string())))
}

/// Lines that are sent at once, with their answers.
pub fn lines(lines: &[Line]) -> Value {
    let bytes: Vec<u8> = lines.iter().flat_map(|(bytes, _)| bytes).copied().collect();
    let answers: Vec<&String> = lines.iter().filter_map(|(_, answer)| answer.as_ref()).collect();
    json!({ "send": bytes, "answers": answers })
}
