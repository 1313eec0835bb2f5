//! From bytes to lines, whatever the bytes are.

use core::{fmt, str};

/// The longest line, its end not counted: twelve numbers of 20 characters each.
const CAPACITY: usize = 256;

/// Collects the bytes of one line at a time.
pub struct Lines {
    bytes: [u8; CAPACITY],
    length: usize,
    broken: Option<Broken>,
}

/// Why a line cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// It is longer than 256 bytes.
    TooLong,
    /// It is not UTF-8.
    NotText,
    /// Some of its bytes did not arrive.
    BytesLost,
}

impl fmt::Display for Broken {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Broken::TooLong => "the line is longer than 256 bytes",
            Broken::NotText => "the line is not UTF-8",
            Broken::BytesLost => {
                "bytes of the line were lost; wait for an answer before the next line"
            }
        })
    }
}

impl Lines {
    /// Takes the next byte; the line, without its end and the blanks around it, where this is its end. Empty lines are
    /// passed over, so that `\r\n` is one end.
    pub fn push(&mut self, byte: u8) -> Option<Result<&str, Broken>> {
        if byte != b'\n' && byte != b'\r' {
            match self.bytes.get_mut(self.length) {
                Some(place) => (*place, self.length) = (byte, self.length + 1),
                None => self.broken = self.broken.or(Some(Broken::TooLong)),
            }
            return None;
        }
        let bytes = &self.bytes[..core::mem::take(&mut self.length)];
        if let Some(broken) = self.broken.take() {
            return Some(Err(broken));
        }
        match str::from_utf8(bytes).map(str::trim) {
            Ok("") => None,
            Ok(line) => Some(Ok(line)),
            Err(_) => Some(Err(Broken::NotText)),
        }
    }

    /// Bytes were lost: what is left of this line is not to be believed.
    pub fn lost(&mut self) {
        self.broken = Some(Broken::BytesLost);
    }
}

impl Default for Lines {
    fn default() -> Self {
        Self { bytes: [0; CAPACITY], length: 0, broken: None }
    }
}
