//! docs/firmware.md shows what is compiled.

const GUIDE: &str = include_str!("../../../../docs/firmware.md");

/// The part of a source that the guide shows, without its indentation.
fn shown(source: &str) -> String {
    let (_, rest) = source.split_once("// docs/firmware.md:\n").unwrap();
    let (part, _) = rest.split_once("// :docs/firmware.md").unwrap();
    let indent = part.len() - part.trim_start().len();
    part.trim_end().lines().map(|line| line.get(indent..).unwrap_or("").to_owned() + "\n").collect()
}

#[test]
fn the_guide_shows_the_task_that_is_linked() {
    let shown = shown(include_str!("../../rtic/src/main.rs"));
    assert!(shown.lines().count() >= 8);
    assert!(GUIDE.contains(&format!("```rust,ignore\n{shown}```")), "the guide lacks:\n{shown}");
}
