//! The first line of a file that the program wrote: a checksum of the lines below, which tells whether anyone has
//! changed them.

use shutter_plan::scene::fnv;

/// How a text has a comment on a line of its own: what begins it, and what ends it.
pub type Comment = [&'static str; 2];

pub const RUST: Comment = ["// ", ""];
pub const C: Comment = ["/* ", " */"];
pub const SVG: Comment = ["<!-- ", " -->"];

const BEFORE: &str = "Checksum ";
const BEHIND: &str = " of the lines below: `shutter` replaces them while it holds";

/// The text below its mark.
pub fn marked([begin, end]: Comment, text: &str) -> String {
    format!("{begin}{BEFORE}{:08x}{BEHIND}{end}\n{text}", checksum(text))
}

/// What is below the mark, and does it still have that checksum? None where the first line is not such a mark alone.
pub fn below([begin, end]: Comment, text: &str) -> Option<(&str, bool)> {
    let (line, text) = text.split_once('\n')?;
    // Editors may put a byte order mark before it.
    let line = line.strip_prefix('\u{feff}').unwrap_or(line).trim_end_matches('\r');
    let sum = line.strip_prefix(begin)?.strip_prefix(BEFORE)?;
    let sum = sum.strip_suffix(end)?.strip_suffix(BEHIND)?;
    Some((text, u32::from_str_radix(sum, 16) == Ok(checksum(text))))
}

/// Whatever ends the lines.
fn checksum(text: &str) -> u32 {
    fnv(text.bytes().filter(|byte| *byte != b'\r'))
}
