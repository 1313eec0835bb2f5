//! Replays QEMU's trace of a run, instruction by instruction, and charges each call for what it executed.
//!
//! QEMU translates a block of instructions, tells which (`-d in_asm`), and tells of each time that it
//! executes one (`-d exec,nochain`).

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use measured::{CELLS, Function, Series, series};

use crate::Result;
use crate::disassembly::Disassembly;
use crate::firmware::{Core, start};
use crate::model::{Cost, Fetch, KINDS};

/// What one call took, within the called function and what it calls: from its first instruction to its
/// return, that included.
#[derive(Clone, Copy, Default)]
pub struct Call {
    pub instructions: u32,
    pub cycles: u32,
    /// Those cycles by [`KINDS`] of instructions.
    pub by_kind: [u32; KINDS.len()],
}

/// A call, by how many series have begun before its own, with the address of what was called.
pub type InSeries = (usize, u32, Call);

#[derive(Default)]
pub struct Trace {
    pub calls: BTreeMap<Series, Vec<Call>>,
    /// The function's instance that a series called.
    pub instances: BTreeMap<Series, u32>,
    /// The bytes of a curve, by its cells, and how deep a function's stack got.
    pub curve_bytes: BTreeMap<usize, u32>,
    pub painted: BTreeMap<(Function, usize), u32>,
}

/// What the firmware is asked to run; the kinds of inputs as bits of its own.
pub fn selection(cells: &[usize], functions: &[Function], inputs: u32) -> u32 {
    let places = CELLS.iter().enumerate().filter(|(_, c)| cells.contains(c));
    let bits = places.map(|(place, _)| 1 << place).chain(functions.iter().map(|f| f.bit()));
    bits.fold(inputs, |mask, bit| mask | bit)
}

impl Trace {
    /// Has the program run the series that are selected, and adds them; `built` is what its first run left, all curves.
    pub fn add(
        &mut self,
        core: Core,
        elf: &Path,
        code: &Disassembly,
        built: &[u8],
        selection: u32,
    ) -> Result {
        let input = elf.with_extension("input");
        std::fs::write(&input, [&selection.to_le_bytes(), built].concat())?;
        let keys: Vec<Series> = series(selection).collect();
        let (calls, printed) = replay(core, elf, code, Some(File::open(&input)?))?;
        if calls.last().is_none_or(|(place, ..)| place + 1 != keys.len()) {
            return Err(format!("the firmware ran other series than planned\n{printed}").into());
        }
        for (place, address, call) in calls {
            let key = *keys.get(place).ok_or("more series than planned")?;
            self.calls.entry(key).or_default().push(call);
            self.instances.insert(key, address);
        }
        self.note(&printed)
    }

    /// A line a number of cells, the bytes of a curve and of the functions' stacks: `1376 [160, 320, ...]`.
    fn note(&mut self, printed: &str) -> Result {
        for (cells, line) in CELLS.into_iter().zip(printed.lines()) {
            let numbers = line.split([' ', ',', '[', ']']).filter(|number| !number.is_empty());
            let numbers = numbers.map(str::parse).collect::<Result<Vec<u32>, _>>()?;
            let (bytes, depths) = numbers.split_first().ok_or("the firmware printed nothing")?;
            self.curve_bytes.insert(cells, *bytes);
            for (function, depth) in Function::ALL.into_iter().zip(depths) {
                let deepest = self.painted.entry((function, cells)).or_default();
                *deepest = (*deepest).max(*depth);
            }
        }
        Ok(())
    }
}

/// Runs a program and tells of each call of its `the_call`, in order, and what it printed.
pub fn replay(
    core: Core,
    elf: &Path,
    code: &Disassembly,
    input: Option<File>,
) -> Result<(Vec<InSeries>, String)> {
    let options = ["-d", "in_asm,exec,nochain"];
    let mut child = start(core, elf, input, &options)?;
    let mut replay = Replay::new(code);
    // The instructions of each block, by QEMU's number for it; and of the one just translated.
    let mut blocks: HashMap<u64, Vec<u32>> = HashMap::new();
    let mut translated = Vec::new();
    // The block that is about to run, unless the next line says that it was stopped.
    let mut block: Option<u64> = None;
    let mut other = String::new();
    let mut reader = BufReader::with_capacity(1 << 16, child.stderr.take().ok_or("no stderr")?);
    let mut line = Vec::new();
    loop {
        line.clear();
        let is_over = reader.read_until(b'\n', &mut line)? == 0;
        let text = std::str::from_utf8(&line).unwrap_or("");
        if text.starts_with("Stopped execution") {
            block = None;
            continue;
        }
        let next = block_number(text);
        if is_over || next.is_some() {
            for address in block.iter().flat_map(|block| &blocks[block]) {
                replay.execute(*address)?;
            }
            block = next;
        }
        if is_over {
            break;
        }
        if let Some(number) = next {
            if !translated.is_empty() {
                blocks.insert(number, std::mem::take(&mut translated));
            }
            if !blocks.contains_key(&number) {
                return Err(format!("QEMU does not tell a block's instructions: {text}").into());
            }
        } else if let Some(address) = instruction_address(text) {
            translated.push(address);
        } else if text.starts_with("IN:") {
            translated.clear();
        } else if !text.starts_with("---") {
            other.push_str(text);
        }
    }
    let mut printed = String::new();
    child.stdout.take().map(|mut out| out.read_to_string(&mut printed));
    if !child.wait()?.success() {
        return Err(format!("the firmware stopped early\n{}{printed}", other.trim()).into());
    }
    Ok((replay.calls, printed))
}

/// An instruction as the replay needs it.
struct Step {
    cost: Cost,
    length: u32,
    measured: bool,
    begins: bool,
}

/// The state of a replay.
struct Replay<'a> {
    code: &'a Disassembly,
    /// By the instructions' places.
    steps: Vec<Option<Step>>,
    begun: usize,
    calls: Vec<InSeries>,
    /// The call that runs, what was called, and where it returns to.
    call: Option<(Call, u32, u32)>,
    last: Option<u32>,
    before: Option<u32>,
    fetch: Fetch,
}

impl<'a> Replay<'a> {
    fn new(code: &'a Disassembly) -> Self {
        let mut steps: Vec<Option<Step>> = Vec::new();
        steps.resize_with(code.places(), || None);
        for i in &code.instructions {
            let cost = Cost::new(i);
            let step = Step { cost, length: i.length, measured: false, begins: false };
            steps[code.place(i.address)] = Some(step);
        }
        let mut mark = |name: &str, set: fn(&mut Step)| {
            for address in code.named(name) {
                steps[code.place(address)].as_mut().map(set);
            }
        };
        mark("series_begins", |step| step.begins = true);
        mark("the_call", |step| step.measured = true);
        let (call, last, before) = (None, None, None);
        Self {
            code,
            steps,
            begun: 0,
            calls: Vec::new(),
            call,
            last,
            before,
            fetch: Fetch::default(),
        }
    }

    fn step(&self, address: u32) -> Result<&Step> {
        let step = self.steps.get(self.code.place(address)).and_then(Option::as_ref);
        let known = "QEMU executes what the disassembly does not have, at";
        step.ok_or_else(|| format!("{known} {address:#x}").into())
    }

    /// The instruction at `address` follows: charges the last one, then sees where a call starts or ends.
    fn execute(&mut self, address: u32) -> Result {
        if let (Some((mut call, called, back)), Some(last)) = (self.call, self.last) {
            let step = self.step(last)?;
            let mut cycles = match self.before {
                Some(before) => step.cost.behind(&self.step(before)?.cost),
                None => step.cost.behind(&Cost::default()),
            };
            let (kind, length) = (step.cost.kind, step.length);
            if address != last + length {
                // Where the caller's next instruction lies is not the call's fault.
                let target = if address == back { 0 } else { self.step(address)?.length };
                cycles += step.cost.refill(address, target);
            }
            cycles += self.fetch.stalls(last, length, address);
            self.before = Some(last);
            call.instructions += 1;
            call.cycles += cycles;
            call.by_kind[kind] += cycles;
            self.call = Some((call, called, back));
        }
        match self.call {
            Some((done, called, back)) if address == back => {
                let place = self.begun.checked_sub(1).ok_or("a call before its series")?;
                self.calls.push((place, called, done));
                self.call = None;
            }
            Some(_) => {}
            None => {
                let step = self.step(address)?;
                if step.measured {
                    let last = self.last.ok_or("a call from nowhere")?;
                    self.call = Some((Call::default(), address, last + self.step(last)?.length));
                    self.before = None;
                    self.fetch = Fetch::default();
                } else if step.begins {
                    self.begun += 1;
                }
            }
        }
        self.last = Some(address);
        Ok(())
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
