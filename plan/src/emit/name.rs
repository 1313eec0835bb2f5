//! Names that a scene's name, which may be of any characters, becomes in a program.

/// The name as an identifier in lower case: a letter first, then letters, digits, and single underscores between them.
pub fn identifier(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("_").to_ascii_lowercase();
    match name.chars().next() {
        Some('a'..='z') => name,
        Some(_) => format!("shutter_{name}"),
        None => "shutter".into(),
    }
}

/// The words that no module can be called, of every edition; with an underscore behind them they can.
const KEYWORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// The name as that of a module of Rust.
pub fn module(name: &str) -> String {
    let name = identifier(name);
    // A crate's own name would hide it.
    let is_taken = KEYWORDS.contains(&name.as_str()) || name == "shutter_curve";
    if is_taken { name + "_" } else { name }
}

/// A text of any characters, so that it neither ends a comment nor turns the line around.
pub fn shown(text: &str) -> String {
    let is_shown = |c: char| c.is_alphanumeric() || matches!(c, ' ' | '±') || c.is_ascii_graphic() && c != '/';
    text.chars().map(|c| if is_shown(c) { c } else { '_' }).collect()
}
