//! Replays QEMU's trace of a run, instruction by instruction, and charges each call for what it executed.
//!
//! QEMU translates a block of instructions, tells which (`-d in_asm`), and tells of each time that it
//! executes one (`-d exec,nochain`).

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use crate::Result;
use crate::disassembly::{Disassembly, Instruction};
use crate::firmware::{Core, start};
use crate::model::{Cost, Fetch};

/// What one call took, within the called function and what it calls: from its first instruction to its
/// return, that included.
#[derive(Clone, Copy, Default)]
pub struct Call {
    /// The address of what was called.
    pub called: u32,
    pub instructions: u32,
    pub cycles: u32,
}

/// Runs a program and tells of each call of its functions `the_call`, in order.
pub fn replay(core: Core, elf: &Path, code: &Disassembly, input: File) -> Result<Vec<Call>> {
    let mut child = start(core, elf, Some(input), &["-d", "in_asm,exec,nochain"])?;
    let steps = steps(code);
    let mut replay = Replay::default();
    // The instructions of each block, by QEMU's number for it; and of the one just translated.
    let mut blocks: HashMap<u64, Vec<Step>> = HashMap::new();
    let mut translated = Vec::new();
    // The block that is about to run, unless the next line says that it was stopped.
    let mut block: Option<u64> = None;
    let mut other = String::new();
    let mut reader = BufReader::with_capacity(1 << 16, child.stderr.take().ok_or("no stderr")?);
    let mut line = Vec::new();
    while reader.read_until(b'\n', &mut line)? > 0 {
        let text = std::str::from_utf8(&line).unwrap_or("");
        if text.starts_with("Stopped execution") {
            block = None;
        } else if let Some(number) = block_number(text) {
            replay.execute(block.iter().flat_map(|block| &blocks[block]));
            if !translated.is_empty() {
                blocks.insert(number, std::mem::take(&mut translated));
            }
            if !blocks.contains_key(&number) {
                return Err(format!("QEMU does not tell a block's instructions: {text}").into());
            }
            block = Some(number);
        } else if let Some(address) = instruction_address(text) {
            let unknown = || format!("QEMU executes what the disassembly does not have: {text}");
            translated.push(*steps.get(&address).ok_or_else(unknown)?);
        } else if text.starts_with("IN:") {
            translated.clear();
        } else if !text.starts_with("---") {
            other.push_str(text);
        }
        line.clear();
    }
    replay.execute(block.iter().flat_map(|block| &blocks[block]));
    let output = child.wait_with_output()?;
    if !output.status.success() {
        let printed = String::from_utf8_lossy(&output.stdout);
        return Err(format!("the firmware stopped early\n{}{printed}", other.trim()).into());
    }
    Ok(replay.calls)
}

/// An instruction as the replay needs it.
#[derive(Clone, Copy, Default)]
struct Step {
    address: u32,
    length: u32,
    cost: Cost,
    /// Does it begin what is measured?
    begins: bool,
}

/// The instructions by their addresses.
fn steps(code: &Disassembly) -> HashMap<u32, Step> {
    let begin = code.named("the_call");
    let step = |i: &Instruction| {
        let begins = begin.contains(&i.address);
        (i.address, Step { address: i.address, length: i.length, cost: Cost::new(i), begins })
    };
    code.instructions.iter().map(step).collect()
}

/// The state of a replay.
#[derive(Default)]
struct Replay {
    calls: Vec<Call>,
    /// The call that runs, and where it returns to.
    call: Option<(Call, u32)>,
    /// The last instruction, and within a call the cost of the one before.
    last: Step,
    before: Cost,
    fetch: Fetch,
}

impl Replay {
    fn execute<'a>(&mut self, steps: impl Iterator<Item = &'a Step>) {
        steps.for_each(|step| self.step(*step));
    }

    /// The instruction follows: charges the last one, then sees whether a call ends or starts.
    fn step(&mut self, step: Step) {
        let last = std::mem::replace(&mut self.last, step);
        if let Some((call, back)) = &mut self.call {
            let mut cycles = last.cost.behind(&self.before);
            if step.address != last.address + last.length {
                // Where the caller's next instruction lies is not the call's fault.
                let target = if step.address == *back { 0 } else { step.length };
                cycles += last.cost.refill(step.address, target);
            }
            cycles += self.fetch.stalls(last.address, last.length, step.address);
            self.before = last.cost;
            call.instructions += 1;
            call.cycles += cycles;
            if step.address == *back {
                self.calls.push(*call);
                self.call = None;
            }
        } else if step.begins {
            let call = Call { called: step.address, ..Call::default() };
            self.call = Some((call, last.address + last.length));
            (self.before, self.fetch) = (Cost::default(), Fetch::default());
        }
    }
}

/// `Trace 0: 0x7f53bc000100 [00800408/00000400/00000110/ff000201] Reset`: 0x7f53bc000100.
fn block_number(line: &str) -> Option<u64> {
    let number = line.strip_prefix("Trace ")?.split(' ').nth(1)?.strip_prefix("0x")?;
    u64::from_str_radix(number, 16).ok()
}

/// `0x00000400:  f019 f93e  bl       #0x19680`: 0x400.
fn instruction_address(line: &str) -> Option<u32> {
    let (address, _) = line.strip_prefix("0x")?.split_once(':')?;
    u32::from_str_radix(address, 16).ok()
}
