//! All that the commands write. Nothing that a user has is lost:
//!
//! - An output that is an input or another output is refused before anything is read.
//! - A file that holds something else is refused without `--force`; one that is read-only, always.
//! - All files of a run are written beside their places first, and take these when they are whole. What fails leaves the
//!   old ones, and no other.
//! - Links are followed. What is no regular file (a device, a pipe) is written to as it is.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use same_file::Handle;
use tempfile::NamedTempFile;

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
fn is_stream(path: &Path) -> bool {
    is_std(path) || fs::metadata(path).is_ok_and(|it| !it.is_file() && !it.is_dir())
}

/// What a run writes.
#[derive(Default)]
pub struct Outputs {
    force: bool,
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
        for (paths, takes) in
            [(inputs, "standard input: it is read"), (outputs, "standard output: it takes a text")]
        {
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
                return Err(format!(
                    "{name}: it is the input {}, which would be lost",
                    input.display()
                ));
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

    /// What an older file holds that is to be written to, unless it may be replaced whatever that is.
    pub fn old(&mut self, path: &Path) -> Result<Option<Vec<u8>>, String> {
        if self.force || is_stream(path) {
            return Ok(None);
        }
        let old = match fs::read(path) {
            Err(e) if e.kind() == ErrorKind::NotFound => None,
            old => Some(old.map_err(|e| told(path, &e))?),
        };
        self.seen.push((path.into(), old.clone()));
        Ok(old)
    }

    /// Adds a file; an older one has to be empty, or the same.
    pub fn add(&mut self, path: &Path, text: String) -> Result<(), String> {
        match self.old(path)? {
            Some(old) if !old.is_empty() && old != text.as_bytes() => {
                Err(format!("{}: it holds something else; --force replaces it", path.display()))
            }
            _ => self.replace(path, text),
        }
    }

    /// Adds a file, whatever an older one holds.
    pub fn replace(&mut self, path: &Path, text: String) -> Result<(), String> {
        if is_std(path) {
            self.text = Some(text);
        } else if is_stream(path) {
            self.streams.push((path.into(), text));
        } else {
            let (file, place) = beside(path, &text)?;
            self.files.push((file, place, path.into()));
        }
        Ok(())
    }

    /// Writes all, and the report to standard output unless something else is to go there.
    pub fn finish(self, out: &mut dyn Write, report: &str) -> Result<(), String> {
        for (path, text) in &self.streams {
            let mut stream =
                OpenOptions::new().write(true).open(path).map_err(|e| told(path, &e))?;
            stream.write_all(text.as_bytes()).map_err(|e| told(path, &e))?;
        }
        if let Some((path, _)) = self.seen.iter().find(|(path, old)| fs::read(path).ok() != *old) {
            return Err(format!("{}: it has changed meanwhile", path.display()));
        }
        print(out, self.text.as_deref().unwrap_or(report))?;
        for (file, place, path) in self.files {
            let is_new = self.seen.iter().any(|(of, old)| *of == path && old.is_none());
            let placed = if is_new { file.persist_noclobber(&place) } else { file.persist(&place) };
            placed.map_err(|e| told(&path, &e.error))?;
            // It is there; where a folder can be synced, it stays there if the power goes.
            let _ = place.parent().map(File::open).map(|folder| folder?.sync_all());
        }
        Ok(())
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

/// The whole text in a file in the same folder, which is gone when it is dropped.
fn beside(path: &Path, text: &str) -> Result<(NamedTempFile, PathBuf), String> {
    let (failed, name) = (|e: io::Error| told(path, &e), path.display());
    let place = place(path).map_err(|e| match e.kind() {
        ErrorKind::NotFound => format!("{name}: its folder is not there"),
        _ => told(path, &e),
    })?;
    let old = fs::metadata(&place).ok().map(|it| it.permissions());
    if old.as_ref().is_some_and(fs::Permissions::readonly) {
        return Err(format!("{name}: it is read-only"));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".shutter-").suffix(".tmp");
    // As any new file is, not for its owner alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder
        .tempfile_in(place.parent().unwrap_or(&place))
        .map_err(|e| format!("{name}: {} in its folder", e.kind()))?;
    if let Some(old) = old {
        file.as_file().set_permissions(old).map_err(failed)?;
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
        (_, Some(name)) => Ok(fs::canonicalize(folder)?.join(name)),
        _ => Err(ErrorKind::NotFound.into()),
    }
}

fn is_same(a: &Path, b: &Path) -> bool {
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
