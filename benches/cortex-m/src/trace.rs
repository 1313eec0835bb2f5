//! Replays QEMU's trace of a run, instruction by instruction, and charges each call for what it executed.
//!
//! QEMU translates a block of instructions, tells which (`-d in_asm`), and tells of each time that it
//! executes one (`-d exec,nochain`).

use std::collections::HashMap;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use firmware::{CELLS, Function, Inputs, baselines, series};

use crate::disassembly::{Disassembly, Places};
use crate::firmware::{Core, output, start_with};
use crate::model::{Cost, refill};

/// What one call took, within the called function and what it calls: from its first instruction to its
/// return, that included.
#[derive(Clone, Copy)]
pub struct Call {
    pub instructions: u32,
    pub cycles: u32,
}

/// A series of calls on one curve; the baselines' have no cells.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Key {
    pub function: Function,
    pub cells: usize,
    pub inputs: Inputs,
    pub curve: usize,
}

#[derive(Default)]
pub struct Trace {
    pub calls: HashMap<Key, Vec<Call>>,
    /// The function's instance that a series called.
    pub instance: HashMap<(Function, usize), u32>,
    /// For each instruction, by its place: how often it ran and its cycles, in the series annotated.
    pub profile: Vec<(u32, u32)>,
}

/// What the firmware is asked to run.
#[derive(Clone)]
pub struct Selection {
    pub cells: Vec<usize>,
    pub functions: Vec<Function>,
    /// The kinds of inputs, as bits of the firmware's.
    pub inputs: u32,
}

impl Selection {
    /// As the firmware reads it.
    fn mask(&self) -> u32 {
        let cells =
            CELLS.iter().enumerate().filter(|(_, c)| self.cells.contains(c)).map(|(i, _)| 1 << i);
        let functions = self.functions.iter().map(|f| f.bit());
        cells.chain(functions).fold(self.inputs, |mask, bit| mask | bit)
    }

    /// The series that then run, in order.
    fn keys(&self) -> Vec<Key> {
        let mut keys = Vec::new();
        let mut add = |cells, (function, inputs): (Function, Inputs)| {
            if firmware::selected(self.mask(), function, inputs) {
                keys.extend(inputs.curves().map(|curve| Key { function, cells, inputs, curve }));
            }
        };
        for cells in CELLS.into_iter().filter(|c| self.cells.contains(c)) {
            series().for_each(|s| add(cells, s));
        }
        baselines().for_each(|s| add(0, s));
        keys
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
struct Replay {
    places: Places,
    steps: Vec<Option<Step>>,
    keys: std::vec::IntoIter<Key>,
    key: Option<Key>,
    annotate: Option<Key>,
    /// The call that runs, and where it returns to.
    call: Option<(Call, u32)>,
    calls: Vec<Call>,
    last: Option<u32>,
    before: Option<u32>,
    trace: Trace,
}

impl Replay {
    fn new(code: &Disassembly, selection: &Selection, annotate: Option<Key>) -> Self {
        let places = code.places();
        let mut steps: Vec<Option<Step>> = Vec::new();
        steps.resize_with(places.count, || None);
        for i in &code.instructions {
            let step =
                Step { cost: Cost::new(i), length: i.length, measured: false, begins: false };
            steps[places.of(i.address)] = Some(step);
        }
        let mut mark = |name: &str, set: fn(&mut Step)| {
            for address in code.named(name) {
                steps[places.of(address)].as_mut().map(set);
            }
        };
        mark("series_begins", |step| step.begins = true);
        for function in Function::ALL {
            mark(function.symbol(), |step| step.measured = true);
        }
        Self {
            places,
            steps,
            keys: selection.keys().into_iter(),
            key: None,
            annotate,
            call: None,
            calls: Vec::new(),
            last: None,
            before: None,
            trace: Trace { profile: vec![(0, 0); places.count], ..Trace::default() },
        }
    }

    fn step(&self, address: u32) -> Result<&Step, String> {
        let step = self.steps.get(self.places.of(address)).and_then(Option::as_ref);
        step.ok_or_else(|| {
            format!("QEMU executes {address:#x}, where the disassembly has no instruction")
        })
    }

    /// The instruction at `address` follows: charges the last one, then sees where a call starts or ends.
    fn execute(&mut self, address: u32) -> Result<(), String> {
        if let (Some(_), Some(last)) = (&self.call, self.last) {
            let step = self.step(last)?;
            let mut cycles = match self.before {
                Some(before) => step.cost.behind(&self.step(before)?.cost),
                None => step.cost.behind(&Cost::default()),
            };
            if address != last + step.length {
                cycles += refill(address, self.step(address)?.length);
            }
            self.before = Some(last);
            if let Some((call, _)) = &mut self.call {
                call.instructions += 1;
                call.cycles += cycles;
            }
            if self.annotate.is_some() && self.annotate == self.key {
                let profile = &mut self.trace.profile[self.places.of(last)];
                profile.0 += 1;
                profile.1 += cycles;
            }
        }
        match self.call {
            Some((done, back)) if address == back => {
                self.calls.push(done);
                self.call = None;
            }
            Some(_) => {}
            None => {
                let step = self.step(address)?;
                if step.measured {
                    let key = self.key.ok_or("a call before its series")?;
                    self.trace.instance.insert((key.function, key.cells), address);
                    let last = self.last.ok_or("a call from nowhere")?;
                    self.call =
                        Some((Call { instructions: 0, cycles: 0 }, last + self.step(last)?.length));
                    self.before = None;
                } else if step.begins {
                    self.end_series();
                    self.key = Some(self.keys.next().ok_or("more series than planned")?);
                }
            }
        }
        self.last = Some(address);
        Ok(())
    }

    fn end_series(&mut self) {
        if let Some(key) = self.key {
            self.trace.calls.insert(key, std::mem::take(&mut self.calls));
        }
    }
}

/// Runs the program twice, first to have it build the curves, and follows the second run.
pub fn trace(
    core: Core,
    elf: &Path,
    code: &Disassembly,
    selection: &Selection,
    annotate: Option<Key>,
) -> Result<Trace, String> {
    let mut memory = vec![0; ::firmware::PAGE as usize];
    memory[..4].copy_from_slice(&selection.mask().to_le_bytes());
    memory.extend(output(core, elf)?);
    let options = ["-d", "in_asm,exec,nochain"].map(str::to_owned);
    let mut child = start_with(core, elf, &memory, &options)?;

    let mut replay = Replay::new(code, selection, annotate);
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
        let read = reader.read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        let text = std::str::from_utf8(&line).unwrap_or("");
        if text.starts_with("Stopped execution") {
            block = None;
            continue;
        }
        let next = block_number(text);
        if read == 0 || next.is_some() {
            if let Some(block) = block {
                for address in &blocks[&block] {
                    replay.execute(*address)?;
                }
            }
            block = next;
        }
        if read == 0 {
            break;
        }
        if let Some(number) = next {
            if !translated.is_empty() {
                blocks.insert(number, std::mem::take(&mut translated));
            }
            if !blocks.contains_key(&number) {
                return Err(format!("QEMU does not tell the instructions of a block: {text}"));
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
    let status = child.wait().map_err(|error| error.to_string())?;
    replay.end_series();
    if !status.success() || replay.keys.next().is_some() {
        return Err(format!("the firmware stopped early\n{}{printed}", other.trim()));
    }
    Ok(replay.trace)
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
