//! A file's bytes as text.

use super::told::Refusal;

/// The text of a file's bytes: UTF-8, or a single-byte encoding whose letters do not matter.
///
/// # Errors
/// What is empty or binary.
pub fn decode(bytes: &[u8]) -> Result<String, Refusal> {
    let no_csv = |reason: &str| Err(Refusal::NotCsv { reason: reason.into() });
    let text = String::from_utf8_lossy(bytes);
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
            "it holds bytes of 0, so it is binary, or UTF-16: unpack an archive, save a text as UTF-8, a workbook's \
             sheet as CSV, and a sound as WAV (MP3, Vorbis and Opus change the curve)",
        );
    }
    // An old Mac's lines end without a line feed.
    Ok(if text.contains('\n') { text.into() } else { text.replace('\r', "\n") })
}
