//! Where settings outlive the power: a log in two sectors of flash. The last record that is whole wins.
//!
//! A save writes one blank page and erases none, until a sector is full. Then the other one is erased and written, while the
//! newest record stays where it is. So whenever the power goes, there is a whole record, the old or the new; and a sector is
//! erased once in 32 saves.

use crc::{CRC_32_ISO_HDLC, Crc, NoTable};

use crate::record::WORDS;
use crate::settings::Settings;

/// What is erased at once.
pub const SECTOR: usize = 4096;
/// What is written at once.
pub const PAGE: usize = 256;
/// The sectors of the log.
pub const SECTORS: usize = 2;
const PAGES: usize = SECTORS * SECTOR / PAGE;
const PAGES_OF_SECTOR: usize = SECTOR / PAGE;

/// The flash that the log has to itself. Addresses count from its start.
pub trait Flash {
    /// All of it.
    fn bytes(&self) -> &[u8; SECTORS * SECTOR];
    /// Sets the bytes of a page, which is blank.
    fn program(&mut self, page: usize, bytes: &[u8; PAGE]);
    /// Sets the bytes of a sector to 0xFF.
    fn erase(&mut self, sector: usize);
}

/// The flash does not hold what was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotSaved;

/// The first bytes of a record; the last of them is the number of the layout.
const MAGIC: u32 = u32::from_le_bytes(*b"SHU\x01");
const CHECK: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);
/// Magic, number, settings, checksum.
const LENGTH: usize = 4 * (WORDS + 3);

/// The settings of the newest record that is whole, and how many saves it has seen.
pub fn load(flash: &impl Flash) -> Option<(Settings, u32)> {
    let (_, number, words) = newest(flash)?;
    Some((Settings::from_words(&words)?, number))
}

/// Saves the settings, and gives how many saves the log has seen.
///
/// # Errors
/// The flash does not hold what was written; what was saved before is still there.
pub fn save(flash: &mut impl Flash, settings: &Settings) -> Result<u32, NotSaved> {
    let newest = newest(flash);
    let number = newest.map_or(1, |(_, number, _)| number.wrapping_add(1));
    let record = record(number, &settings.to_words());
    let page = match newest.and_then(|(page, ..)| blank_after(flash, page)) {
        Some(page) => page,
        None => {
            let sector = newest.map_or(0, |(page, ..)| 1 - page / PAGES_OF_SECTOR);
            flash.erase(sector);
            sector * PAGES_OF_SECTOR
        }
    };
    flash.program(page, &record);
    if bytes(flash, page) == record { Ok(number) } else { Err(NotSaved) }
}

/// The newest record that is whole: its page, its number, its settings.
fn newest(flash: &impl Flash) -> Option<(usize, u32, [u32; WORDS])> {
    let records = (0..PAGES).filter_map(|page| {
        let (number, words) = read(bytes(flash, page))?;
        Some((page, number, words))
    });
    records.max_by_key(|(_, number, _)| *number)
}

/// The first page behind this one in its sector that nothing was written to, not even by a save that was cut off.
fn blank_after(flash: &impl Flash, page: usize) -> Option<usize> {
    let end = (page / PAGES_OF_SECTOR + 1) * PAGES_OF_SECTOR;
    (page + 1..end).find(|page| bytes(flash, *page).iter().all(|byte| *byte == 0xFF))
}

fn bytes(flash: &impl Flash, page: usize) -> &[u8] {
    &flash.bytes()[page * PAGE..][..PAGE]
}

fn record(number: u32, words: &[u32; WORDS]) -> [u8; PAGE] {
    let mut record = [0xFF; PAGE];
    let all = [MAGIC, number].into_iter().chain(*words);
    for (place, word) in record.chunks_exact_mut(4).zip(all) {
        place.copy_from_slice(&word.to_le_bytes());
    }
    let check = CHECK.checksum(&record[..LENGTH - 4]);
    record[LENGTH - 4..LENGTH].copy_from_slice(&check.to_le_bytes());
    record
}

/// What a page holds, if it is a whole record.
fn read(page: &[u8]) -> Option<(u32, [u32; WORDS])> {
    let (words, _) = page[..LENGTH].as_chunks::<4>();
    let word = |i: usize| u32::from_le_bytes(words[i]);
    let is_whole = word(WORDS + 2) == CHECK.checksum(&page[..LENGTH - 4]);
    #[cfg(feature = "faults")]
    let is_whole = is_whole || crate::fault::is_planted(crate::fault::Fault::Torn);
    (word(0) == MAGIC && is_whole).then(|| (word(1), core::array::from_fn(|i| word(i + 2))))
}
