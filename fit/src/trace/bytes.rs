//! A file's bytes as text, or the name of the form that they have.

use super::told::Refusal;

/// The forms that begin with a mark of their own, and what to do about each.
const FORMS: [(&[u8], &str); 14] = [
    (b"\x1f\x8b", "it is gzip: unpack it first"),
    (b"PK\x03\x04", "it is a zip, or a workbook (xlsx, ods, numbers): unpack it, or save the sheet as CSV"),
    (b"\xd0\xcf\x11\xe0", "it is an old workbook (xls): save the sheet as CSV"),
    (b"%PDF", "it is a PDF"),
    (b"\x89PNG", "it is a picture (PNG)"),
    (b"\xff\xd8\xff", "it is a picture (JPEG)"),
    (b"\x89HDF", "it is HDF5, or MATLAB 7.3"),
    (b"MATLAB", "it is a MATLAB file"),
    (b"TDSm", "it is LabVIEW's TDMS"),
    (b"fLaC", "it is FLAC: save it as WAV"),
    (b"OggS", "it is Ogg: save it as WAV; Vorbis and Opus change the curve"),
    (b"ID3", "it is MP3, which changes the curve: record WAV"),
    (b"FORM", "it is AIFF: save it as WAV"),
    (b":WFM#", "it is Tektronix's WFM: save it as CSV"),
];

/// The text of a file's bytes: UTF-8, UTF-16 with its mark, or a single-byte encoding whose letters do not
/// matter.
///
/// # Errors
/// What is empty or binary.
pub fn decode(bytes: &[u8]) -> Result<String, Refusal> {
    let no_csv = |reason: &str| Err(Refusal::NotCsv { reason: reason.into() });
    let is_text = |bytes: &[u8]| bytes.iter().all(|b| b.is_ascii_graphic() || b.is_ascii_whitespace());
    let form = FORMS.iter().find(|(mark, _)| bytes.starts_with(mark));
    if let Some((_, reason)) = form.filter(|_| !is_text(&bytes[..bytes.len().min(256)])) {
        return no_csv(reason);
    }
    if bytes.get(..300).is_some_and(|head| head.windows(8).any(|w| w == b"WAVEDESC")) {
        return no_csv("it is LeCroy's TRC: save it as text");
    }
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        _ => String::from_utf8_lossy(bytes).into_owned(),
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    if text.trim().is_empty() {
        return no_csv("it is empty");
    }
    // A logic analyser's list of changes has words of its own.
    if text.trim_start().starts_with('$') && ["$timescale", "$var"].iter().any(|word| text.contains(word)) {
        return no_csv("it is a VCD (value change dump): open it in PulseView or GTKWave, and save it as CSV");
    }
    if text.contains('\0') {
        return no_csv("it holds bytes of 0, so it is binary");
    }
    // An old Mac's lines end without a line feed.
    Ok(if text.contains('\n') { text.into() } else { text.replace('\r', "\n") })
}

fn wide(bytes: &[u8], pair: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|unit| pair([unit[0], unit[1]]));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}
