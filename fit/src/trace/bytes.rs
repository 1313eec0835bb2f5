//! A file's bytes as text.

use super::told::Refusal;

/// The text of a file's bytes: UTF-8, UTF-16 with its mark, or a single-byte encoding whose letters do not
/// matter.
///
/// # Errors
/// What is empty or binary.
pub fn decode(bytes: &[u8]) -> Result<String, Refusal> {
    let no_csv = |reason: &str| Err(Refusal::NotCsv { reason: reason.into() });
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
        return no_csv(
            "it holds bytes of 0, so it is binary: unpack an archive, save a workbook's sheet as CSV, and a sound as \
             WAV (MP3, Vorbis and Opus change the curve)",
        );
    }
    // An old Mac's lines end without a line feed.
    Ok(if text.contains('\n') { text.into() } else { text.replace('\r', "\n") })
}

fn wide(bytes: &[u8], pair: fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|unit| pair([unit[0], unit[1]]));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}
