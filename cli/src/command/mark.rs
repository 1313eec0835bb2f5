//! The first line of a file that the program wrote: a checksum of the lines below, which tells whether anyone has changed them.

use crate::emit::fnv;

/// How a text has a comment on a line of its own: what begins it, and what ends it.
pub type Comment = [&'static str; 2];

pub const TOML: Comment = ["# ", ""];
pub const RUST: Comment = ["// ", ""];
pub const C: Comment = ["/* ", " */"];
pub const SVG: Comment = ["<!-- ", " -->"];

const BEFORE: &str = "Checksum ";
const BEHIND: &str = " of the lines below: `shutter` replaces them while it holds";

/// The text below its mark.
pub fn marked([begin, end]: Comment, text: &str) -> String {
    format!("{begin}{BEFORE}{:08x}{BEHIND}{end}\n{text}", checksum(text))
}

/// What is below the mark, and does it still have that checksum? None where there is no mark.
pub fn below(text: &str) -> Option<(&str, bool)> {
    let (line, text) = text.split_once('\n')?;
    let (_, sum) = line.split_once(BEFORE)?;
    let (sum, _) = sum.split_once(BEHIND)?;
    Some((text, u32::from_str_radix(sum, 16) == Ok(checksum(text))))
}

/// Whatever ends the lines.
fn checksum(text: &str) -> u32 {
    fnv(text.bytes().filter(|byte| *byte != b'\r'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_holds_until_a_line_is_changed() {
        // As published with the algorithm.
        assert_eq!(checksum("foobar"), 0xBF9C_F968);
        for comment in [TOML, RUST, C, SVG] {
            let text = marked(comment, "one\ntwo\n");
            assert!(text.starts_with(comment[0]), "{text}");
            assert_eq!(below(&text), Some(("one\ntwo\n", true)));
            assert_eq!(below(&text.replace('\n', "\r\n")), Some(("one\r\ntwo\r\n", true)));
            assert_eq!(below(&text.replace("two", "too")), Some(("one\ntoo\n", false)));
            assert_eq!(below(&(text + "\n")), Some(("one\ntwo\n\n", false)));
        }
        assert_eq!(below("one\ntwo\n"), None);
    }
}
