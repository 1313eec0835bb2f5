//! The settings' log in flash, with the power cut at every byte of every write and every erasure.

use strobe::store::{Flash, NotSaved, PAGE, SECTOR, SECTORS, load, save};
use strobe::{Request, Settings};

/// A flash whose power fails after so many bytes, and that counts what it is asked for.
#[derive(Clone)]
struct Chip {
    bytes: [u8; SECTORS * SECTOR],
    left: usize,
    erased: usize,
    /// How many bits of a byte that was being written are.
    torn: u8,
    /// A bit of this page never goes to 0.
    worn: Option<usize>,
}

impl Chip {
    fn new() -> Self {
        Self { bytes: [0xFF; SECTORS * SECTOR], left: usize::MAX, erased: 0, torn: 0, worn: None }
    }

    /// Changes a byte if there is power; at the last moment, only a part of its bits.
    fn change(&mut self, at: usize, to: u8) {
        let old = self.bytes[at];
        let mask = [0, 0x0F, 0xA5][usize::from(self.torn)];
        match self.left {
            0 => (),
            1 => self.bytes[at] = old & !mask | to & mask,
            _ => self.bytes[at] = to,
        }
        self.left = self.left.saturating_sub(1);
    }
}

impl Flash for Chip {
    fn bytes(&self) -> &[u8; SECTORS * SECTOR] {
        &self.bytes
    }

    fn program(&mut self, page: usize, bytes: &[u8; PAGE]) {
        for (i, byte) in bytes.iter().enumerate() {
            let is_blank = self.bytes[page * PAGE + i] == 0xFF;
            assert!(is_blank || self.left == 0, "page {page} is not blank");
            self.change(page * PAGE + i, *byte);
        }
        if self.worn == Some(page) {
            self.bytes[page * PAGE + 9] |= 0x80;
        }
    }

    fn erase(&mut self, sector: usize) {
        self.erased += 1;
        // Not in the order of the bytes: a sector fades as a whole.
        for i in 0..SECTOR {
            self.change(sector * SECTOR + i * 1021 % SECTOR, 0xFF);
        }
    }
}

fn settings(lines: &[&str]) -> Settings {
    lines.iter().fold(Settings::default(), |settings, line| match Request::read(line) {
        Ok(Request::Change(change)) => settings.with(change).unwrap(),
        other => panic!("{line}: {other:?}"),
    })
}

/// Different ones for each number.
fn numbered(i: u32) -> Settings {
    Settings { pulses: 1 + i % 64, delay: i * 1_000_003, ..Settings::default() }
}

fn loaded(chip: &Chip) -> Option<(Settings, u32)> {
    load(chip)
}

#[test]
fn every_setting_comes_back() {
    for lines in [
        &[][..],
        &[
            "n 7",
            "gap 1ms",
            "pulse 3us",
            "delay 4.247ms",
            "edge falling",
            "frames 3 20ms",
            "curve 2",
        ],
        &["duty 0.3", "curve 0 0.001 0.004 0.0045"],
        &["curve 0 0.002 0.004 0.009 0.05 0.1 0.15 1 0.6 1 0.7 0"],
    ] {
        let (mut chip, settings) = (Chip::new(), settings(lines));
        assert_eq!(save(&mut chip, &settings), Ok(1));
        assert!(loaded(&chip) == Some((settings.clone(), 1)), "{}", settings.in_full());
    }
}

#[test]
fn a_blank_flash_and_any_other_hold_nothing() {
    assert!(loaded(&Chip::new()).is_none());
    for byte in [0, 0x55, 0xAA] {
        assert!(loaded(&Chip { bytes: [byte; SECTORS * SECTOR], ..Chip::new() }).is_none());
    }
}

/// 100 000 erasures of a sector are enough for 3 million saves.
#[test]
fn a_sector_is_erased_once_in_32_saves() {
    let mut chip = Chip::new();
    for i in 1..=1024 {
        assert_eq!(save(&mut chip, &numbered(i)), Ok(i));
        assert!(loaded(&chip) == Some((numbered(i), i)));
    }
    assert_eq!(chip.erased, 1024 / 16);
}

/// Wherever the power is cut, the old settings or the new ones are there, and the next save takes.
#[test]
fn a_cut_at_every_byte_leaves_the_last_good_settings() {
    let mut chip = Chip::new();
    let mut erasures = 0;
    // Around the first, and around each change of sectors.
    for i in [1, 2, 3].into_iter().chain(15..=18).chain(31..=34) {
        while load(&chip).map_or(0, |(_, number)| number) + 1 < i {
            save(&mut chip, &numbered(i)).unwrap();
        }
        let mut whole = chip.clone();
        save(&mut whole, &numbered(i)).unwrap();
        let erases = whole.erased > chip.erased;
        erasures += usize::from(erases);
        for torn in 0..3 {
            let erasure = if erases { (0..SECTOR).step_by(97) } else { (0..0).step_by(97) };
            let before = if erases { SECTOR } else { 0 };
            for left in erasure.chain((before..before + PAGE).step_by(5)) {
                let mut cut = Chip { left, torn, ..chip.clone() };
                let _ = save(&mut cut, &numbered(i));
                let after = loaded(&cut);
                let is_old = after == loaded(&chip);
                assert!(is_old || after == Some((numbered(i), i)), "save {i}, {left} bytes");
                // The power is back.
                cut.left = usize::MAX;
                save(&mut cut, &numbered(1000)).unwrap();
                assert!(loaded(&cut).unwrap().0 == numbered(1000), "save {i}, {left} bytes");
            }
        }
        chip = whole;
    }
    assert_eq!(erasures, 3);
}

#[test]
fn a_page_that_is_worn_out_is_told() {
    let mut chip = Chip::new();
    save(&mut chip, &numbered(1)).unwrap();
    chip.worn = Some(1);
    assert_eq!(save(&mut chip, &numbered(2)), Err(NotSaved));
    assert!(loaded(&chip) == Some((numbered(1), 1)));
    // The next page is good.
    assert_eq!(save(&mut chip, &numbered(2)), Ok(2));
}

#[test]
fn a_record_that_no_line_could_have_made_is_none() {
    for i in 0..22 {
        let mut words = settings(&["duty 0.3"]).to_words();
        assert!(Settings::from_words(&words).is_some());
        words[i] = 0xFFFF_FFFF;
        let may_be_any = [1, 4, 7].contains(&i) || i == 9 || i >= 10 || i == 0 || i == 6;
        assert_eq!(Settings::from_words(&words).is_some(), may_be_any, "word {i}");
    }
}
