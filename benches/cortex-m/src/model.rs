//! The one table of what an instruction costs on a Cortex-M4F, in cycles.
//!
//! Source: Arm, *Cortex-M4 Technical Reference Manual* r0p1, table 3-1 (instruction set), section 3.3.1
//! and following (pairing of loads and stores), table 7-1 (floating point). Flash and RAM answer
//! without wait states. Where the manual gives a range: `P`, the refill of the pipeline, is 2, and 3 for a
//! 32-bit instruction across a word boundary; an integer division takes 7 of its 2 to 12.
//!
//! The float costs have not been checked against a board.

use crate::disassembly::{Instruction, registers};

/// What of an instruction's cost is known before it runs.
#[derive(Clone, Debug, Default)]
pub struct Cost {
    cycles: u32,
    /// A single load or store, of the core registers: a load behind another takes one cycle less.
    memory: bool,
    load: bool,
    /// The float registers that are ready a cycle late, and those read at once, which the addend of a
    /// multiply-and-add is not; one bit a register, `d0` being `s0` and `s1`.
    late: u32,
    reads: u32,
}

impl Cost {
    pub fn new(instruction: &Instruction) -> Self {
        let name = instruction.name.trim_end_matches(".w").trim_end_matches(".n");
        let operands = instruction.operands.as_str();
        if name.starts_with('v') {
            return Self::float(name, operands);
        }

        let is = |names: &[&str]| names.iter().any(|n| name.starts_with(n));
        let cost = |cycles| Self { cycles, ..Self::default() };
        if is(&["push", "pop", "ldm", "stm"]) {
            cost(1 + registers(operands))
        } else if is(&["ldrd", "strd"]) {
            cost(3)
        } else if is(&["ldr"]) {
            Self { cycles: 2, memory: true, load: true, ..Self::default() }
        } else if is(&["str"]) {
            // With an immediate offset the next instruction runs while the data is written.
            let offset = operands.split('[').nth(1).and_then(|address| address.split(", ").nth(1));
            let by_register = offset.is_some_and(|offset| !offset.starts_with('#'));
            Self { cycles: if by_register { 2 } else { 1 }, memory: true, ..Self::default() }
        } else if is(&["sdiv", "udiv"]) {
            cost(7)
        } else if is(&["tbb", "tbh"]) {
            cost(2)
        } else {
            // Data processing, all multiplications, a branch before it is taken.
            cost(1)
        }
    }

    fn float(name: &str, operands: &str) -> Self {
        let registers: Vec<u32> =
            operands.split([',', '{', '}', ' ', '[', ']']).filter_map(float_bits).collect();
        let is = |names: &[&str]| names.iter().any(|n| name.starts_with(n));
        let first = registers.first().copied().unwrap_or(0);
        let rest = registers.iter().skip(1).fold(0, |all, one| all | one);
        let words = registers.iter().map(|r| r.count_ones()).sum::<u32>();
        if is(&["vldm", "vstm", "vpush", "vpop"]) {
            let width = if operands.contains("{d") { 2 } else { 1 };
            return Self { cycles: 1 + width * self::registers(operands), ..Self::default() };
        }
        if is(&["vldr"]) {
            return Self { cycles: 1 + words, ..Self::default() };
        }
        if is(&["vstr"]) {
            return Self { cycles: 1 + words, reads: first, ..Self::default() };
        }
        if is(&["vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnma", "vfnms"]) {
            return Self { cycles: 3, late: first, reads: rest, ..Self::default() };
        }
        if is(&["vdiv", "vsqrt"]) {
            return Self { cycles: 14, late: first, reads: rest, ..Self::default() };
        }
        if is(&["vcmp"]) {
            return Self { cycles: 1, reads: first | rest, ..Self::default() };
        }
        if is(&["vmrs", "vmsr"]) {
            return Self { cycles: 1, ..Self::default() };
        }
        if is(&["vmov"]) {
            // Two words to or from core registers take two cycles; a result in a core register is on time.
            let to_core = operands.starts_with('r');
            let cores = operands.split(", ").filter(|o| o.starts_with('r') || *o == "lr").count();
            let reads = if to_core { first | rest } else { rest };
            return Self { cycles: if cores > 1 { 2 } else { 1 }, reads, ..Self::default() };
        }
        // VADD, VSUB, VMUL, VNMUL, VABS, VNEG, VCVT, VSEL.
        let late = if is(&["vabs", "vneg"]) { 0 } else { first };
        let reads = if registers.len() == 1 { first } else { rest };
        Self { cycles: 1, late, reads, ..Self::default() }
    }

    /// The cycles that this takes behind `before`.
    pub fn behind(&self, before: &Cost) -> u32 {
        let paired = self.load && before.memory;
        let stalled = before.late & self.reads != 0;
        self.cycles - paired as u32 + stalled as u32
    }
}

/// What a taken branch adds: the refill of the pipeline from `target`.
pub fn refill(target: u32, length: u32) -> u32 {
    if length == 4 && target % 4 == 2 { 3 } else { 2 }
}

/// The bits of `s7` or `d3`.
fn float_bits(operand: &str) -> Option<u32> {
    let number = |n: &str| n.parse::<u32>().ok().filter(|n| *n < 32);
    if let Some(n) = operand.strip_prefix('s') {
        return Some(1 << number(n)?);
    }
    operand.strip_prefix('d').and_then(|n| 3u32.checked_shl(2 * number(n)?))
}
