//! The last two sectors of the flash, where settings are saved.
//!
//! While the chip writes its flash, nothing can be read from there, no code either. So what writes is in RAM, and interrupts
//! wait; the state machine goes on, fed by DMA from RAM. The boot ROM has the functions, and the second boot stage, copied to
//! RAM, sets up the fast reading again. The crate `rp2040-flash` does the same for an older `rp2040-hal`, whose float intrinsics
//! would come with it.
#![allow(unsafe_code)]

use core::ptr::{addr_of, read_volatile};

use rp2040_hal::rom_data;
use strobe::store::{Flash, PAGE, SECTOR, SECTORS};

const LENGTH: usize = SECTORS * SECTOR;
/// Where flash is seen in memory.
const XIP: usize = 0x1000_0000;

// memory.x keeps these sectors free.
unsafe extern "C" {
    static _saved: u8;
}

/// The sectors. There is one of it.
pub struct Saved(());

impl Saved {
    /// To be called once.
    ///
    /// # Safety
    /// No other may be there, for both would write to the same flash.
    pub unsafe fn new() -> Self {
        Self(())
    }

    fn start() -> *const u8 {
        addr_of!(_saved)
    }
}

impl Flash for Saved {
    fn bytes(&self) -> &[u8; LENGTH] {
        // SAFETY: flash from there to its end; it changes only through `&mut self`.
        unsafe { &*Self::start().cast() }
    }

    fn program(&mut self, page: usize, bytes: &[u8; PAGE]) {
        assert!(page < LENGTH / PAGE);
        let at = Self::start() as usize - XIP + page * PAGE;
        write(at as u32, Some(bytes));
    }

    fn erase(&mut self, sector: usize) {
        assert!(sector < SECTORS);
        let at = Self::start() as usize - XIP + sector * SECTOR;
        write(at as u32, None);
    }
}

/// What is called while flash cannot be read.
struct Functions {
    connect: unsafe extern "C" fn(),
    exit_xip: unsafe extern "C" fn(),
    erase: unsafe extern "C" fn(u32, usize, u32, u8),
    program: unsafe extern "C" fn(u32, *const u8, usize),
    flush: unsafe extern "C" fn(),
    /// The copy of the second boot stage.
    enter_xip: unsafe extern "C" fn(),
}

/// Writes a page, or erases a sector.
fn write(at: u32, bytes: Option<&[u8; PAGE]>) {
    let mut boot = [0u32; 64];
    for (i, word) in boot.iter_mut().enumerate() {
        // SAFETY: the first 256 bytes of flash. Volatile, lest the compiler make a call of the loop.
        *word = unsafe { read_volatile((XIP as *const u32).add(i)) };
    }
    // A page of RAM: what is written cannot come from flash.
    let page = bytes.copied();
    let page = page.as_ref().map_or(core::ptr::null(), |page| page.as_ptr());
    let functions = Functions {
        connect: rom_data::connect_internal_flash::ptr(),
        exit_xip: rom_data::flash_exit_xip::ptr(),
        erase: rom_data::flash_range_erase::ptr(),
        program: rom_data::flash_range_program::ptr(),
        flush: rom_data::flash_flush_cache::ptr(),
        // SAFETY: the boot stage is a function from its first byte on; odd, as Thumb code is called.
        enter_xip: unsafe {
            core::mem::transmute::<usize, unsafe extern "C" fn()>(boot.as_ptr() as usize + 1)
        },
    };
    critical_section::with(|_| {
        // SAFETY: the second core sleeps in the ROM, DMA reads RAM alone, and interrupts are off. The place is in the sectors.
        unsafe { from_ram(&functions, at, page) }
    });
}

/// # Safety
/// Nothing may read flash meanwhile. `at` counts from its start, and is that of a page to write or of a sector to erase.
#[unsafe(link_section = ".data.from_ram")]
#[inline(never)]
unsafe fn from_ram(functions: &Functions, at: u32, page: *const u8) {
    const SECTOR_ERASE: u8 = 0x20;
    // SAFETY: the caller's; each function is the ROM's, or the boot stage in RAM.
    unsafe {
        (functions.connect)();
        (functions.exit_xip)();
        if page.is_null() {
            (functions.erase)(at, SECTOR, SECTOR as u32, SECTOR_ERASE);
        } else {
            (functions.program)(at, page, PAGE);
        }
        (functions.flush)();
        (functions.enter_xip)();
    }
}
