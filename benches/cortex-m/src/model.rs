//! The one table of what an instruction costs on a Cortex-M4F, in cycles.
//!
//! Sources: Arm, *Cortex-M4 Technical Reference Manual* r0p1, table 3-1 (instruction set), section 3.3.1 and following
//! (pairing of loads and stores), table 7-1 (floating point). Where it gives a range: an integer division takes 7 of
//! its 2 to 12, and for `P`, the refill of the pipeline, holds a note of the *Cortex-M3 Technical Reference Manual*
//! r1p1, table 18-1: 1 behind a branch to an address in the instruction, 2 behind one to an address in a register, and
//! one more where the target is a 32-bit instruction across two words. Boards bear that out, and show what no manual
//! tells of the fetch: <https://compendium.i-0.nl/docs/instruction-alignment/rules> has one cycle for three or more
//! such instructions in a row; that it is one for every three is what longer programs show. Flash and RAM answer
//! without wait states.
//!
//! `docs/internals/tried.md` holds this against cycles that others have measured.

/// What of an instruction's cost is known before it runs.
#[derive(Clone, Copy, Default)]
pub struct Cost {
    cycles: u32,
    /// A single load of a core register: one behind another takes a cycle less, unless the first is a literal and the
    /// second is not, for these come over different buses.
    load: bool,
    literal: bool,
    /// The float registers that are ready a cycle late, and those read at once, which the addend of a
    /// multiply-and-add is not; one bit a register, `d0` being `s0` and `s1`.
    late: u32,
    reads: u32,
    /// What it takes to refill the pipeline from where this branches to.
    refill: u32,
}

impl Cost {
    /// Of an instruction as QEMU disassembles it.
    pub fn new(name: &str, operands: &str) -> Self {
        let name = name.trim_end_matches(".w").trim_end_matches(".n");
        let is = |names: &[&str]| names.iter().any(|n| name.starts_with(n));
        if name.starts_with('v') {
            return Self::float(name, operands);
        }

        // With an immediate offset the next instruction runs while the data is written.
        let offset = operands.split('[').nth(1).and_then(|address| address.split(", ").nth(1));
        let by_register = offset.is_some_and(|offset| !offset.starts_with('#'));
        let cycles = match () {
            _ if is(&["push", "pop", "ldm", "stm"]) => 1 + registers(operands),
            _ if is(&["ldrd", "strd"]) => 3,
            _ if is(&["ldr", "tbb", "tbh"]) || is(&["str"]) && by_register => 2,
            _ if is(&["sdiv", "udiv"]) => 7,
            // Data processing, all multiplications, a branch before it is taken.
            _ => 1,
        };
        let refill = match () {
            _ if is(&["ldr", "tbb", "tbh"]) => 3,
            _ if is(&["bx", "blx", "mov", "add", "pop", "ldm"]) => 2,
            _ => 1,
        };
        let load = is(&["ldr"]) && !is(&["ldrd"]);
        let literal = load && operands.contains("[pc");
        Self { cycles, load, literal, refill, ..Self::default() }
    }

    fn float(name: &str, operands: &str) -> Self {
        let floats = operands.split([',', '{', '}', ' ', '[', ']']).filter_map(float_bits);
        let floats: Vec<u32> = floats.collect();
        let is = |names: &[&str]| names.iter().any(|n| name.starts_with(n));
        let first = floats.first().copied().unwrap_or(0);
        let rest = floats.iter().skip(1).fold(0, |all, one| all | one);
        let words = floats.iter().map(|r| r.count_ones()).sum::<u32>();
        let width = if operands.contains("{d") { 2 } else { 1 };
        let cores = operands.split(", ").filter(|o| o.starts_with('r') || *o == "lr").count();
        let (cycles, late, reads) = match () {
            _ if is(&["vldm", "vstm", "vpush", "vpop"]) => (1 + width * registers(operands), 0, 0),
            _ if is(&["vldr"]) => (1 + words, 0, 0),
            _ if is(&["vstr"]) => (1 + words, 0, first),
            _ if is(&["vml", "vnml", "vfm", "vfnm"]) => (3, first, rest),
            _ if is(&["vdiv", "vsqrt"]) => (14, first, rest),
            _ if is(&["vcmp"]) => (1, 0, first | rest),
            _ if is(&["vmrs", "vmsr"]) => (1, 0, 0),
            // Two words to or from core registers take two cycles; a result in a core register is on time.
            _ if is(&["vmov"]) && operands.starts_with('r') => (1, 0, first | rest),
            _ if is(&["vmov"]) => (1, 0, rest),
            _ if is(&["vabs", "vneg"]) => (1, 0, rest),
            // VADD, VSUB, VMUL, VNMUL, VCVT, VSEL.
            _ => (1, first, rest),
        };
        // A register that alone is named is read and written.
        let reads = if floats.len() == 1 && late != 0 { first } else { reads };
        let both = is(&["vmov"]) && cores > 1;
        Self { cycles: cycles + u32::from(both), late, reads, ..Self::default() }
    }

    /// The cycles that this takes behind `before`.
    pub fn behind(&self, before: &Cost) -> u32 {
        let paired = self.load && before.load && (self.literal || !before.literal);
        let stalled = before.late & self.reads != 0;
        self.cycles - paired as u32 + stalled as u32
    }

    /// What this branch, taken, adds: the refill of the pipeline from `target`.
    pub fn refill(&self, target: u32, length: u32) -> u32 {
        self.refill + u32::from(is_split(target, length))
    }
}

/// Of the fetch of instructions: how many 32-bit ones in a row lay across two words.
#[derive(Default)]
pub struct Fetch(u32);

impl Fetch {
    /// The cycles for which the instruction at `address` waits to be fetched: one, where it is every third such. Behind
    /// a branch, to `next`, the count begins anew.
    pub fn stalls(&mut self, address: u32, length: u32, next: u32) -> u32 {
        self.0 = if is_split(address, length) { self.0 + 1 } else { 0 };
        let stalls = u32::from(self.0 > 0 && self.0.is_multiple_of(3));
        if next != address + length {
            self.0 = 0;
        }
        stalls
    }
}

/// Does an instruction lie across two words?
fn is_split(address: u32, length: u32) -> bool {
    length == 4 && address % 4 == 2
}

/// The bits of `s7` or `d3`.
fn float_bits(operand: &str) -> Option<u32> {
    let number = |n: &str| n.parse::<u32>().ok().filter(|n| *n < 32);
    if let Some(n) = operand.strip_prefix('s') {
        return Some(1 << number(n)?);
    }
    operand.strip_prefix('d').and_then(|n| 3u32.checked_shl(2 * number(n)?))
}

/// The registers in `{r4, r5, r7, lr}` or `{d8-d10}`.
fn registers(operands: &str) -> u32 {
    let list = operands.split('{').nth(1).and_then(|rest| rest.split('}').next()).unwrap_or("");
    let number = |name: &str| name.trim().trim_start_matches(['r', 'd', 's']).parse::<u32>().unwrap_or(0);
    let parts = list.split(',').filter(|part| !part.trim().is_empty());
    parts.map(|part| part.split_once('-').map_or(1, |(a, b)| number(b) - number(a) + 1)).sum()
}
