//! What the commands write: files as a whole, text to standard output.

use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::{fs, process};

/// The name of a picture's file, as an argument.
pub fn svg_path(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    let is_svg = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg"));
    if is_svg { Ok(path) } else { Err("the picture is an SVG: name it FILE.svg".into()) }
}

/// Writes all of `text` to standard output.
pub fn print(out: &mut dyn Write, text: &str) -> Result<(), String> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Who reads this has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| format!("standard output: {e}")),
    }
}

/// Writes a file as a whole or not at all: beside its place first, then renamed into it.
pub fn write_whole(path: &Path, contents: &str) -> Result<(), String> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.tmp", process::id()));
    let written: io::Result<()> =
        fs::write(&beside, contents).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // If this fails as well, the first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    written.map_err(|e| format!("{}: {e}", path.display()))
}
