//! All that the commands write. Nothing that a user has is lost:
//!
//! - An output that is an input or another output is refused before anything is read.
//! - A file is replaced without `--force` only where it is empty, or as a run wrote it: by its [`mark`], or by the same
//!   bytes where it can have none. One that is read-only is always refused.
//! - All files of a run are written beside their places first, and take these when they are whole. What fails leaves
//!   the old ones, and no other.
//! - Links are followed. What is no regular file (a device, a pipe) is written to as it is.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf, absolute};

use same_file::Handle;
use tempfile::NamedTempFile;

use super::mark::{self, Comment};

/// The name of a picture's file, as an argument.
pub fn svg_path(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    let is_svg = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg"));
    if is_svg || is_stream(&path) {
        return Ok(path);
    }
    Err("the picture is an SVG: name it FILE.svg".into())
}

/// Does the path stand for standard input or output?
pub fn is_std(path: &Path) -> bool {
    path == "-"
}

/// Is it written to directly, as nothing in it can be lost?
pub fn is_stream(path: &Path) -> bool {
    is_std(path) || fs::metadata(path).is_ok_and(|it| !it.is_file() && !it.is_dir())
}

/// What a run writes.
#[derive(Default)]
pub struct Outputs {
    force: bool,
    /// A folder that is made if files are to be in it.
    pub folder: Option<PathBuf>,
    /// What was where a file is to be, when that was looked at; nothing where it may be replaced whatever it is.
    seen: Vec<(PathBuf, Option<Vec<u8>>)>,
    /// Whole, and not in their places yet: these, and the names by which they were asked for.
    files: Vec<(NamedTempFile, PathBuf, PathBuf)>,
    streams: Vec<(PathBuf, String)>,
    /// What standard output is to hold in place of a report.
    text: Option<String>,
}

impl Outputs {
    /// Those of a run, of which none is an input or another one.
    pub fn new(inputs: &[&Path], outputs: &[&Path], force: bool) -> Result<Self, String> {
        for (paths, takes) in [(inputs, "standard input: it is read"), (outputs, "standard output: it takes a text")] {
            if paths.iter().filter(|path| is_std(path)).count() > 1 {
                return Err(format!("{takes} once"));
            }
        }
        for (i, output) in outputs.iter().enumerate() {
            let name = output.display();
            if fs::metadata(output).is_ok_and(|it| it.is_dir()) {
                return Err(format!("{name}: it is a folder"));
            }
            if let Some(input) = inputs.iter().find(|input| is_same(input, output)) {
                return Err(format!("{name}: it is the input {}, which would be lost", input.display()));
            }
            if outputs[..i].iter().any(|other| is_same(other, output)) {
                return Err(format!("{name}: two outputs would be written to it"));
            }
        }
        for (std, paths) in [("output", [inputs, outputs].concat()), ("input", outputs.to_vec())] {
            let handle = || if std == "input" { Handle::stdin() } else { Handle::stdout() };
            let is_used = std == "output" || inputs.iter().any(|input| is_std(input));
            if let Some(path) = paths.iter().find(|path| is_used && is_handle(path, handle())) {
                return Err(format!("{}: standard {std} is the same file", path.display()));
            }
        }
        Ok(Self { force, ..Self::default() })
    }

    /// What an older file holds that is to be written to; nothing where that counts for nothing. What cannot be written
    /// is refused.
    pub fn old(&mut self, path: &Path) -> Result<Option<Vec<u8>>, String> {
        if is_stream(path) {
            return Ok(None);
        }
        let place = writable(path)?;
        let folder = place.parent().unwrap_or(&place);
        if !folder.is_dir() && self.makes(path).is_none() {
            return Err(format!("{}: its folder is not there", path.display()));
        }
        if let Some((_, old)) = self.seen.iter().find(|(seen, _)| seen == path) {
            return Ok(old.clone().filter(|old| !old.is_empty()));
        }
        let old = match fs::read(path) {
            Err(e) if e.kind() == ErrorKind::NotFound => None,
            old => Some(old.map_err(|e| told(path, &e))?),
        };
        self.seen.push((path.into(), old.clone()));
        Ok(old.filter(|old| !old.is_empty()))
    }

    /// The folder that is made for this file.
    fn makes(&self, path: &Path) -> Option<&Path> {
        self.folder.as_deref().filter(|folder| path.parent() == Some(folder))
    }

    /// Refuses a file that no run wrote with such comments, or that was changed since.
    pub fn check(&mut self, path: &Path, comment: Comment) -> Result<(), String> {
        let Some(old) = self.old(path)?.filter(|_| !self.force) else { return Ok(()) };
        let reason = match std::str::from_utf8(&old).ok().and_then(|it| mark::below(comment, it)) {
            Some((_, true)) => return Ok(()),
            Some(_) => "you have changed it since it was written",
            None => "it holds something else",
        };
        Err(format!("{}: {reason}; --force replaces it", path.display()))
    }

    /// Adds a file in place of its own older one, by its comments; without any, an older one has to be the same.
    pub fn add(&mut self, path: &Path, comment: Option<Comment>, text: String) -> Result<(), String> {
        let Some(comment) = comment else {
            return match self.old(path)? {
                Some(old) if old != text.as_bytes() && !self.force => Err(format!(
                    "{}: it holds something else, and a table does not tell whose; --force replaces it",
                    path.display()
                )),
                _ => self.replace(path, text),
            };
        };
        self.check(path, comment)?;
        self.replace(path, mark::marked(comment, &text))
    }

    /// Adds a file, whatever an older one holds.
    pub fn replace(&mut self, path: &Path, text: String) -> Result<(), String> {
        if is_std(path) {
            self.text = Some(text);
        } else if is_stream(path) {
            self.streams.push((path.into(), text));
        } else {
            if let Some(folder) = self.makes(path) {
                fs::create_dir_all(folder).map_err(|e| told(folder, &e))?;
            }
            let (file, place) = beside(path, &text)?;
            self.files.push((file, place, path.into()));
        }
        Ok(())
    }

    /// Writes to what is no file. The files can be placed then, unless one has changed since it was looked at.
    pub fn ready(self) -> Result<Ready, String> {
        for (path, text) in &self.streams {
            let mut stream = OpenOptions::new().write(true).open(path).map_err(|e| told(path, &e))?;
            stream.write_all(text.as_bytes()).map_err(|e| told(path, &e))?;
        }
        if let Some((path, _)) = self.seen.iter().find(|(path, old)| fs::read(path).ok() != *old) {
            return Err(format!("{}: it has changed meanwhile", path.display()));
        }
        Ok(Ready(self))
    }
}

/// What needs no more than to be put in its place.
pub struct Ready(Outputs);

impl Ready {
    /// Prints the report, unless something else is to go to standard output, then puts all files in their places; tells
    /// which.
    pub fn finish(self, out: &mut dyn Write, report: &str) -> Result<String, String> {
        let Self(Outputs { seen, files, text, .. }) = self;
        print(out, text.as_deref().unwrap_or(report))?;
        let mut wrote = String::new();
        for (file, place, path) in files {
            let is_new = seen.iter().any(|(of, old)| *of == path && old.is_none());
            let placed = if is_new { file.persist_noclobber(&place) } else { file.persist(&place) };
            placed.map_err(|e| told(&path, &e.error))?;
            // It is there; where a folder can be synced, it stays there if the power goes.
            let _ = place.parent().map(File::open).map(|folder| folder?.sync_all());
            wrote += &format!("wrote {}\n", path.display());
        }
        Ok(wrote)
    }
}

/// Writes all of `text` to standard output.
pub fn print(out: &mut dyn Write, text: &str) -> Result<(), String> {
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Who reads this has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| format!("standard output: {e}")),
    }
}

/// Where a file is, or would be, behind all links, unless it is not to be written.
fn writable(path: &Path) -> Result<PathBuf, String> {
    let place = place(path).map_err(|e| told(path, &e))?;
    match fs::metadata(&place) {
        Ok(it) if it.permissions().readonly() => Err(format!("{}: it is read-only", path.display())),
        _ => Ok(place),
    }
}

/// The whole text in a file in the same folder, which is gone when it is dropped.
fn beside(path: &Path, text: &str) -> Result<(NamedTempFile, PathBuf), String> {
    let (failed, name) = (|e: io::Error| told(path, &e), path.display());
    let place = writable(path)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".shutter-").suffix(".tmp");
    // As any new file is, not for its owner alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder
        .tempfile_in(place.parent().unwrap_or(&place))
        .map_err(|e| format!("{name}: {} in its folder", e.kind()))?;
    if let Ok(old) = fs::metadata(&place) {
        file.as_file().set_permissions(old.permissions()).map_err(failed)?;
    }
    file.as_file_mut().write_all(text.as_bytes()).map_err(failed)?;
    file.as_file().sync_all().map_err(failed)?;
    Ok((file, place))
}

fn told(path: &Path, error: &io::Error) -> String {
    format!("{}: {error}", path.display())
}

/// Where a file is, or would be, behind all links.
fn place(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Err(e) if e.kind() == ErrorKind::NotFound => (),
        place => return place,
    }
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    match (fs::read_link(path), path.file_name()) {
        (Ok(target), _) => place(&folder.join(target)),
        // A folder that is not there has one name.
        (_, Some(name)) => Ok(fs::canonicalize(folder).or_else(|_| absolute(folder))?.join(name)),
        _ => Err(ErrorKind::NotFound.into()),
    }
}

/// Are both the same file?
pub fn is_same(a: &Path, b: &Path) -> bool {
    // Nothing is lost in a stream.
    if is_stream(a) || is_stream(b) {
        return false;
    }
    let (Ok(a), Ok(b)) = (place(a), place(b)) else { return false };
    a == b || same_file::is_same_file(a, b).unwrap_or(false)
}

fn is_handle(path: &Path, of: io::Result<Handle>) -> bool {
    !is_stream(path) && of.is_ok_and(|of| Handle::from_path(path).is_ok_and(|it| it == of))
}
