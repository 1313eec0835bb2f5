//! Counts what each call executes, by QEMU's trace of a run.
//!
//! QEMU disassembles each block of instructions when it translates it (`-d in_asm`), and tells each time that it
//! executes one (`-d exec,nochain`).

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};

use crate::Result;
use crate::firmware::{Core, M4F};
use crate::model::{Cost, Fetch};

/// What one call took, within the called function and what it calls: from its first instruction to its return, that
/// included.
#[derive(Clone, Copy, Default)]
pub struct Call {
    /// The address of what was called.
    pub called: u32,
    pub instructions: u32,
    /// Of a Cortex-M4F.
    pub cycles: u32,
}

/// A run, and its state while it is replayed.
#[derive(Default)]
pub struct Run {
    /// Those of functions `the_call`, in order.
    pub calls: Vec<Call>,
    /// The functions that calls ran, with their sizes; by what was called, and by their first addresses.
    pub ran: HashMap<u32, BTreeMap<u32, u32>>,
    /// What the program printed.
    pub output: Vec<u8>,
    /// The bytes of `.data` and `.bss`.
    pub statics: u64,
    /// The call that runs, and where it returns to.
    call: Option<(Call, u32)>,
    /// The last instruction, and within a call the cost of the one before.
    last: Step,
    before: Cost,
    fetch: Fetch,
}

/// An instruction as the replay needs it.
#[derive(Clone, Copy, Default)]
struct Step {
    address: u32,
    length: u32,
    cost: Cost,
    /// The first address of its function, its size, and whether its calls are counted.
    function: (u32, u32, bool),
}

impl Run {
    /// Runs a program on an input.
    pub fn new(core: Core, elf: &Path, input: File) -> Result<Self> {
        let bytes = std::fs::read(elf)?;
        let file = object::File::parse(&*bytes)?;
        // What no symbol with a size has, as where a program starts.
        let mut functions = BTreeMap::from([(0, (0, false))]);
        for symbol in file.symbols().filter(|s| s.kind() == SymbolKind::Text && s.size() > 0) {
            functions
                .insert(symbol.address() as u32 & !1, (symbol.size() as u32, symbol.name()?.contains("8the_call")));
        }
        let step = |line: &str| {
            let step = Step::new(line, core == M4F)?;
            let (start, (size, is_counted)) = functions.range(..=step.address).next_back()?;
            Some(Step { function: (*start, *size, *is_counted), ..step })
        };

        let mut child = core.start(elf, Some(input), &["-d", "in_asm,exec,nochain"])?;
        let mut run = Self::default();
        // The instructions of each block, by QEMU's number for it; and of the one just translated.
        let mut blocks: HashMap<u64, Vec<Step>> = HashMap::new();
        let mut translated = Vec::new();
        // The block that is about to run, unless the next line says that it was stopped.
        let mut block: Option<u64> = None;
        let mut other = String::new();
        let mut reader = BufReader::with_capacity(1 << 16, child.stderr.take().ok_or("no stderr")?);
        let mut line = Vec::new();
        while reader.read_until(b'\n', &mut line)? > 0 {
            let text = std::str::from_utf8(&line).unwrap_or("").trim_end();
            if text.starts_with("Stopped execution") {
                block = None;
            } else if let Some(number) = block_number(text) {
                run.execute(block.iter().flat_map(|block| &blocks[block]));
                if !translated.is_empty() {
                    blocks.insert(number, std::mem::take(&mut translated));
                }
                if !blocks.contains_key(&number) {
                    return Err(format!("QEMU does not tell a block's instructions: {text}").into());
                }
                block = Some(number);
            } else if text.starts_with("0x") {
                translated.push(step(text).ok_or_else(|| format!("QEMU has no disassembler: {text}"))?);
            } else if text.starts_with("IN:") {
                translated.clear();
            } else if !text.starts_with("---") && !text.is_empty() {
                other = format!("{other}{text}\n");
            }
            line.clear();
        }
        run.execute(block.iter().flat_map(|block| &blocks[block]));
        let output = child.wait_with_output()?;
        if !output.status.success() {
            let printed = String::from_utf8_lossy(&output.stdout);
            return Err(format!("the firmware stopped early\n{other}{printed}").into());
        }
        let size = |name| file.section_by_name(name).map_or(0, |section| section.size());
        Ok(Self { output: output.stdout, statics: size(".data") + size(".bss"), ..run })
    }

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
            } else if step.function != last.function {
                self.ran.entry(call.called).or_default().insert(step.function.0, step.function.1);
            }
        } else if step.function.2 && step.address == step.function.0 {
            let call = Call { called: step.address, ..Call::default() };
            self.call = Some((call, last.address + last.length));
            (self.before, self.fetch) = (Cost::default(), Fetch::default());
            self.ran.entry(call.called).or_default().insert(step.function.0, step.function.1);
        }
    }
}

impl Step {
    /// Of `0x00000404:  480e       ldr      r0, [pc, #0x38]`; in it instructions of 32 bits have a blank, or none.
    fn new(line: &str, has_cost: bool) -> Option<Self> {
        let (address, rest) = line.strip_prefix("0x")?.split_once(':')?;
        let (code, text) = rest.trim_start().split_once("  ")?;
        let (name, operands) = text.trim_start().split_once(' ').unwrap_or((text.trim_start(), ""));
        Some(Self {
            address: u32::from_str_radix(address, 16).ok()?,
            length: code.chars().filter(char::is_ascii_hexdigit).count() as u32 / 2,
            cost: if has_cost { Cost::new(name, operands.trim()) } else { Cost::default() },
            ..Self::default()
        })
    }
}

/// `Trace 0: 0x7f53bc000100 [00800408/00000400/00000110/ff000201] Reset`: 0x7f53bc000100.
fn block_number(line: &str) -> Option<u64> {
    let number = line.strip_prefix("Trace ")?.split(' ').nth(1)?.strip_prefix("0x")?;
    u64::from_str_radix(number, 16).ok()
}
