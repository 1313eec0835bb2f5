//! `shutter design`: serves the curve designer's page to this machine alone, and opens it.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use super::output::print;

/// The same each time, so that links to curves stay good; another if it is taken.
const PORT: u16 = 8417;
/// A browser asks in less.
const LONGEST_REQUEST: u64 = 1 << 14;
const PATIENCE: Duration = Duration::from_secs(5);

/// Serve the curve designer's page on 127.0.0.1, and open it in the browser
///
/// Build the page first: designer/build.sh.
#[derive(clap::Args)]
pub struct Args {
    /// The page's folder
    #[arg(long, value_name = "FOLDER", default_value = "designer/dist")]
    page: PathBuf,
    /// The port; if left out, 8417 or, if that is taken, any free one
    #[arg(long)]
    port: Option<u16>,
    /// Print the address only, without opening a browser
    #[arg(long)]
    no_open: bool,
}

pub fn run(args: &Args, out: &mut dyn Write) -> Result<(), String> {
    let page = Arc::new(Page::read(&args.page)?);
    let bind = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    let listener = match args.port {
        Some(port) => bind(port),
        None => bind(PORT).or_else(|_| bind(0)),
    };
    let listener = listener.map_err(|e| format!("cannot serve: {e}"))?;
    let address = listener.local_addr().map_err(|e| format!("cannot serve: {e}"))?;
    let url = format!("http://{address}/");
    print(out, &format!("The curve designer is at {url} (Ctrl+C ends it)\n"))?;
    // Who has no browser here has the address.
    if !args.no_open {
        let _ = open::that_detached(url);
    }
    for stream in listener.incoming().flatten() {
        let page = Arc::clone(&page);
        // A visitor who breaks off is none of our business.
        thread::spawn(move || _ = page.answer(&stream));
    }
    Ok(())
}

/// Files by the paths that a browser asks for, each with what it is.
type Files = HashMap<String, (&'static str, Vec<u8>)>;

/// All files of the page. Nothing else can be asked for.
struct Page(Files);

impl Page {
    fn read(folder: &Path) -> Result<Self, String> {
        let here = folder.display();
        let missing = |e: io::Error| format!("{here}: {e}; designer/build.sh makes the page");
        let mut files = Files::new();
        add(&mut files, folder, "/", 2).map_err(missing)?;
        let none = || format!("{here}: no page; designer/build.sh makes it");
        let index = files.get("/index.html").cloned().ok_or_else(none)?;
        files.insert("/".into(), index);
        Ok(Self(files))
    }

    fn answer(&self, mut stream: &TcpStream) -> io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let mut lines = BufReader::new(stream.take(LONGEST_REQUEST)).lines();
        let request = lines.next().unwrap_or_else(|| Ok(String::new()))?;
        // All of it is read: a connection that is closed before would be reset.
        let mut host = None;
        while let Some(line) = lines.next().transpose()?.filter(|line| !line.is_empty()) {
            if let Some((name, value)) = line.split_once(':')
                && name.eq_ignore_ascii_case("host")
            {
                host = Some(value.trim().to_string());
            }
        }
        let mut words = request.split(' ');
        let (method, target) = (words.next(), words.next().unwrap_or_default());
        let path = target.split('?').next().unwrap_or_default();
        let is_here = host.is_some_and(|host| is_here(&host));
        let (status, kind, body) = match (method, self.0.get(path)) {
            _ if !is_here => ("403 Forbidden", "text/plain", &b"not for this host\n"[..]),
            (Some("GET" | "HEAD"), Some((kind, body))) => ("200 OK", *kind, body.as_slice()),
            (Some("GET" | "HEAD"), None) => ("404 Not Found", "text/plain", &b"not found\n"[..]),
            _ => ("405 Method Not Allowed", "text/plain", &b"GET alone\n"[..]),
        };
        let head = format!(
            "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\n\
             Cache-Control: no-cache\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes())?;
        if method != Some("HEAD") {
            stream.write_all(body)?;
        }
        stream.flush()
    }
}

/// All files of a folder that are a page's, by their paths behind `at`, and of so many levels of folders in it.
fn add(files: &mut Files, folder: &Path, at: &str, levels: u8) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let Some(name) = path.file_name().and_then(OsStr::to_str) else { continue };
        if path.is_dir() && levels > 1 {
            add(files, &path, &format!("{at}{name}/"), levels - 1)?;
        } else if let Some(kind) = kind(&path) {
            files.insert(format!("{at}{name}"), (kind, fs::read(&path)?));
        }
    }
    Ok(())
}

/// Does the name by which a browser asks mean this machine? Any other may be a page's that is made to point here, which
/// then could read what it is not meant to.
fn is_here(host: &str) -> bool {
    let host = host.to_ascii_lowercase();
    let is_port = |port: &str| port.bytes().all(|c| c.is_ascii_digit());
    let name = host.rsplit_once(':').filter(|(_, port)| is_port(port)).map_or(&*host, |it| it.0);
    ["localhost", "127.0.0.1", "[::1]"].contains(&name)
}

/// What a file of the page is, by its name.
fn kind(path: &Path) -> Option<&'static str> {
    Some(match path.extension()?.to_str()? {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "csv" => "text/csv; charset=utf-8",
        "wasm" => "application/wasm",
        _ => return None,
    })
}
