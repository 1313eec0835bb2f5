//! Every curve for every number of cells and on every scale of time, in a region of RAM.
//!
//! Building them takes a thousand times the instructions of what is measured, too many to trace. So the
//! firmware runs twice: where the region is empty it builds the curves and writes the region to stdout; for the second run
//! QEMU's loader puts it in place, or as a bare Linux program it reads it from stdin.

use firmware::{CELLS, CURVES, SCALES};
use shutter_curve::ShutterCurve;

const REGION: usize = firmware::REGION as usize;
const MAGIC: u64 = 0x0073_7265_7474_7568;

const COUNT: usize = CURVES.len();

/// The offset of the curves with so many cells, behind those with fewer.
const fn offset(cells: usize) -> usize {
    let mut offset = size_of::<u64>();
    let sizes = [
        size_of::<ShutterCurve<0>>(),
        size_of::<ShutterCurve<4>>(),
        size_of::<ShutterCurve<8>>(),
        size_of::<ShutterCurve<16>>(),
    ];
    let mut i = 0;
    while i < CELLS.len() && CELLS[i] < cells {
        offset += sizes[i] * COUNT * SCALES.len();
        i += 1;
    }
    offset
}

fn at<const C: usize>() -> *mut [[ShutterCurve<C>; COUNT]; SCALES.len()] {
    (REGION + offset(C)) as *mut _
}

pub fn loaded() -> bool {
    #[cfg(target_arch = "riscv32")]
    crate::machine::map(
        firmware::SELECTED as usize,
        REGION - firmware::SELECTED as usize + offset(usize::MAX),
    );
    // SAFETY: the region is aligned RAM that nothing else uses.
    unsafe { (REGION as *const u64).read_volatile() == MAGIC }
}

/// The host's selection.
pub fn selection() -> u32 {
    // SAFETY: aligned RAM that nothing else uses.
    unsafe { (firmware::SELECTED as *const u32).read_volatile() }
}

/// The curves in place, on a scale of [`SCALES`]; `loaded` must have been true.
pub fn prebuilt<const C: usize>(scale: usize) -> &'static [ShutterCurve<C>; COUNT] {
    // SAFETY: written by `build` of this very program; never changed afterwards.
    unsafe { &(&*at::<C>())[scale] }
}

/// Builds all curves and writes the region to stdout.
pub fn build() {
    fn fill<const C: usize>() {
        let curves = SCALES.iter().flat_map(|scale| CURVES.iter().map(|c| c.scaled(*scale)));
        for (i, (opening, closing)) in curves.enumerate() {
            let built = ShutterCurve::<C>::with_cells(opening, closing).unwrap();
            // SAFETY: inside the region, which has no readers yet.
            unsafe { at::<C>().cast::<ShutterCurve<C>>().add(i).write(built) }
        }
    }
    // SAFETY: as in `loaded`.
    unsafe { (REGION as *mut u64).write_volatile(MAGIC) };
    fill::<0>();
    fill::<4>();
    fill::<8>();
    fill::<16>();
    // SAFETY: QEMU clears RAM, so that padding is initialised too.
    let region = unsafe { core::slice::from_raw_parts(REGION as *const u8, offset(usize::MAX)) };
    crate::machine::write(region);
}
