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
use crate::model::{Cost, refill};

/// What one call took, within the called function and what it calls: from its first instruction to its
/// return, that included.
#[derive(Clone, Copy, Default)]
pub struct Call {
    pub instructions: u32,
    pub cycles: u32,
}

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
        let options = ["-d", "in_asm,exec,nochain"];
        let mut child = start(core, elf, Some(File::open(&input)?), &options)?;
        let mut replay = Replay::new(code, self, selection);
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
        let is_complete = replay.keys.next().is_none();
        let mut printed = String::new();
        child.stdout.take().map(|mut out| out.read_to_string(&mut printed));
        if !child.wait()?.success() || !is_complete {
            return Err(format!("the firmware stopped early\n{}{printed}", other.trim()).into());
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
    keys: std::vec::IntoIter<Series>,
    key: Option<Series>,
    /// The call that runs, and where it returns to.
    call: Option<(Call, u32)>,
    last: Option<u32>,
    before: Option<u32>,
    trace: &'a mut Trace,
}

impl<'a> Replay<'a> {
    fn new(code: &'a Disassembly, trace: &'a mut Trace, selection: u32) -> Self {
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
        let keys = series(selection).collect::<Vec<_>>().into_iter();
        let (key, call, last, before) = (None, None, None, None);
        Self { code, steps, keys, key, call, last, before, trace }
    }

    fn step(&self, address: u32) -> Result<&Step> {
        let step = self.steps.get(self.code.place(address)).and_then(Option::as_ref);
        let known = "QEMU executes what the disassembly does not have, at";
        step.ok_or_else(|| format!("{known} {address:#x}").into())
    }

    /// The instruction at `address` follows: charges the last one, then sees where a call starts or ends.
    fn execute(&mut self, address: u32) -> Result {
        if let (Some((call, back)), Some(last)) = (self.call, self.last) {
            let step = self.step(last)?;
            let mut cycles = match self.before {
                Some(before) => step.cost.behind(&self.step(before)?.cost),
                None => step.cost.behind(&Cost::default()),
            };
            if address != last + step.length {
                cycles += refill(address, self.step(address)?.length);
            }
            self.before = Some(last);
            let (instructions, cycles_so_far) = (call.instructions + 1, call.cycles + cycles);
            self.call = Some((Call { instructions, cycles: cycles_so_far }, back));
        }
        match self.call {
            Some((done, back)) if address == back => {
                let key = self.key.ok_or("a call before its series")?;
                self.trace.calls.entry(key).or_default().push(done);
                self.call = None;
            }
            Some(_) => {}
            None => {
                let step = self.step(address)?;
                if step.measured {
                    let key = self.key.ok_or("a call before its series")?;
                    let last = self.last.ok_or("a call from nowhere")?;
                    self.call = Some((Call::default(), last + self.step(last)?.length));
                    self.before = None;
                    self.trace.instances.insert(key, address);
                } else if step.begins {
                    self.key = Some(self.keys.next().ok_or("more series than planned")?);
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
