//! What the commands read: files, or standard input where `-` is given.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::output::is_std;

/// A longer file is neither a trace of a shutter nor a scene, and would fill the memory.
const LONGEST: u64 = 1 << 28;

/// All bytes of an input, of which there are so many at most: a device may have no end.
pub fn read(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let read = if is_std(path) {
        io::stdin().lock().take(LONGEST + 1).read_to_end(&mut bytes)
    } else {
        File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes))
    };
    match read {
        Err(e) => Err(e.to_string()),
        Ok(length) if length as u64 > LONGEST => {
            Err(format!("more than {} MB: cut the trace to the pulse", LONGEST >> 20))
        }
        Ok(_) => Ok(bytes),
    }
}

/// What an input or output is called.
pub fn shown(path: &Path) -> String {
    if is_std(path) { "standard input".into() } else { path.display().to_string() }
}

/// Its name without a folder.
pub fn file_name(path: &Path) -> String {
    match path.file_name() {
        Some(name) if !is_std(path) => name.to_string_lossy().into(),
        _ => shown(path),
    }
}

/// What each of several inputs is called: what `name` makes of its path, with the folder where another's is the same.
pub fn names(paths: &[&Path], name: fn(&Path) -> String) -> Vec<String> {
    let own: Vec<String> = paths.iter().map(|path| name(path)).collect();
    let is_shared = |name: &String| own.iter().filter(|other| *other == name).count() > 1;
    let called = |(path, own): (&&Path, &String)| match is_shared(own) {
        true => path.with_file_name(own).display().to_string(),
        false => own.clone(),
    };
    paths.iter().zip(&own).map(called).collect()
}

/// Its name without what tells the form.
pub fn stem(path: &Path) -> String {
    match path.file_stem() {
        Some(stem) if !is_std(path) => stem.to_string_lossy().into(),
        _ => "shutter".into(),
    }
}
