//! A firmware's functions, from its ELF file, and its instructions, as `llvm-objdump` shows them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use object::read::Bytes;
use object::{LittleEndian, Object, ObjectSection, ObjectSymbol, SymbolKind, U32};

use crate::Result;
use crate::firmware::{Core, OBJDUMP, succeeded};

pub struct Instruction {
    pub address: u32,
    pub length: u32,
    pub name: String,
    pub operands: String,
}

struct Function {
    symbol: String,
    size: u32,
    /// What its prologue takes of the stack, as the compiler says.
    stack: Option<u32>,
}

pub struct Disassembly {
    /// In the order of their addresses.
    pub instructions: Vec<Instruction>,
    /// By their first address.
    functions: BTreeMap<u32, Function>,
    /// The bytes of `.data` and `.bss`.
    pub statics: u64,
}

impl Disassembly {
    pub fn of(core: Core, elf: &Path) -> Result<Self> {
        let bytes = std::fs::read(elf)?;
        let file = object::File::parse(&*bytes)?;
        let mut functions = BTreeMap::new();
        for symbol in file.symbols().filter(|s| s.kind() == SymbolKind::Text && s.size() > 0) {
            let function = Function { symbol: symbol.name()?.into(), size: symbol.size() as u32, stack: None };
            functions.insert(symbol.address() as u32 & !1, function);
        }
        // Pairs of an address and a size.
        let mut sizes = Bytes(file.section_by_name(".stack_sizes").map_or(Ok(&[][..]), |s| s.data())?);
        while let (Ok(address), Ok(size)) = (sizes.read::<U32<LittleEndian>>(), sizes.read_uleb128()) {
            if let Some(function) = functions.get_mut(&(address.get(LittleEndian) & !1)) {
                function.stack = Some(size as u32);
            }
        }
        let size = |name| file.section_by_name(name).map_or(0, |section| section.size());
        let statics = size(".data") + size(".bss");

        let mut objdump = Command::new(OBJDUMP);
        // An older one does not take from the file what the processor has.
        let has = match core.target {
            target if target.starts_with("riscv") => "--mattr=+m,+a,+f,+c",
            target if target.starts_with("thumbv8m") => "--mattr=+fp-armv8d16sp,+dsp",
            _ => "--mattr=",
        };
        objdump.args(["-d", "--no-leading-headers", has]).arg(elf);
        let output = succeeded(OBJDUMP, objdump.output())?.stdout;
        let text = String::from_utf8_lossy(&output);
        let mut instructions: Vec<_> = text.lines().filter_map(instruction).collect();
        instructions.sort_by_key(|i: &Instruction| i.address);
        for i in 1..instructions.len() {
            if let Some(target) = far_target(&instructions[i - 1], &instructions[i]) {
                instructions[i].operands = format!("{target:#x}");
            }
        }
        Ok(Self { instructions, functions, statics })
    }

    /// The instances of the firmware's function `name`, one for each number of octaves, in no order.
    pub fn named(&self, name: &str) -> Vec<u32> {
        // As both of Rust's manglings have it.
        let part = format!("{}{name}", name.len());
        self.functions.iter().filter(|(_, f)| f.symbol.contains(&part)).map(|(address, _)| *address).collect()
    }

    fn in_function(&self, start: u32) -> &[Instruction] {
        let end = start + self.functions.get(&start).map_or(0, |function| function.size);
        let from = self.instructions.partition_point(|i| i.address < start);
        let to = self.instructions.partition_point(|i| i.address < end);
        &self.instructions[from..to]
    }

    /// The functions that a function goes to by branches of some kind.
    fn branches(&self, function: u32, kind: impl Fn(&Instruction) -> bool) -> BTreeSet<u32> {
        let branches = self.in_function(function).iter().filter(|i| kind(i));
        let targets = branches.filter_map(Instruction::target);
        let starts = targets.filter_map(|target| self.functions.range(..=target).next_back());
        starts.map(|(start, _)| *start).filter(|start| *start != function).collect()
    }

    /// The code and literals of a function and all that it reaches, in bytes.
    pub fn code_bytes(&self, function: u32) -> u32 {
        let (mut reached, mut open) = (BTreeSet::new(), vec![function]);
        while let Some(function) = open.pop() {
            if reached.insert(function) {
                open.extend(self.branches(function, |_| true));
            }
        }
        reached.iter().map(|start| self.functions[start].size).sum()
    }

    /// The deepest stack of a function and what it calls, by the compiler's figures and, for what came
    /// compiled, by the prologue.
    pub fn stack_bytes(&self, function: u32) -> u32 {
        self.deepest(function, &mut Vec::new())
    }

    /// `above` holds the functions on the way: a loop of jumps between functions takes no stack.
    fn deepest(&self, function: u32, above: &mut Vec<u32>) -> u32 {
        if above.contains(&function) {
            return 0;
        }
        above.push(function);
        let mut below = |kind: fn(&Instruction) -> bool| {
            let next = self.branches(function, kind).into_iter();
            next.map(|called| self.deepest(called, above)).max().unwrap_or(0)
        };
        // A function that jumps to another has given its stack back before.
        let (called, jumped_to) = (below(Instruction::is_call), below(|i| !i.is_call()));
        above.pop();
        let own = self.functions[&function].stack.unwrap_or_else(|| self.prologue(function));
        jumped_to.max(own + called)
    }

    /// What a function pushes and takes off the stack pointer.
    fn prologue(&self, function: u32) -> u32 {
        let taken = self.in_function(function).iter().map(|i| {
            let operands = i.operands.as_str();
            match i.name.trim_end_matches(".w") {
                "push" => 4 * registers(operands),
                "vpush" => 8 * registers(operands),
                "sub" => operands.strip_prefix("sp, #").and_then(number).unwrap_or(0) as u32,
                "addi" => operands.strip_prefix("sp, sp, -").and_then(number).unwrap_or(0) as u32,
                _ => 0,
            }
        });
        taken.sum()
    }
}

impl Instruction {
    /// Does it leave where to return to?
    fn is_call(&self) -> bool {
        matches!(self.name.trim_end_matches(".w"), "bl" | "blx" | "jal" | "jalr")
    }

    /// Where a direct branch goes.
    fn target(&self) -> Option<u32> {
        if !self.name.starts_with(['b', 'c', 'j']) {
            return None;
        }
        let target = self.operands.split("0x").nth(1)?.split([' ', ',']).next()?;
        u32::from_str_radix(target, 16).ok()
    }
}

/// `408: 4c 48`, `ldr` and `r0, [pc, #304]   @ 0x53c`, indented and with tabs between; other lines are none.
fn instruction(line: &str) -> Option<Instruction> {
    let (address, rest) = line.trim_start().split_once(':')?;
    let mut columns = rest.split('\t');
    let digits = columns.next()?.chars().filter(char::is_ascii_hexdigit).count();
    let name = columns.next()?.trim();
    if name.starts_with(['.', '<']) {
        return None;
    }
    let operands = columns.next().unwrap_or("").split(" @").next().unwrap_or("");
    Some(Instruction {
        address: u32::from_str_radix(address, 16).ok()?,
        length: digits as u32 / 2,
        name: name.to_owned(),
        operands: operands.trim_end().to_owned(),
    })
}

/// Where a RISC-V goes by two instructions: `auipc ra, 18` and `jalr -12(ra)`, or `jr`.
fn far_target(upper: &Instruction, jump: &Instruction) -> Option<u32> {
    if upper.name != "auipc" || !matches!(jump.name.as_str(), "jalr" | "jr") {
        return None;
    }
    let (register, pages) = upper.operands.split_once(", ")?;
    let (offset, base) = jump.operands.trim_end_matches(')').split_once('(')?;
    if base != register {
        return None;
    }
    Some(upper.address.wrapping_add_signed((number(pages)? << 12) + number(offset)?))
}

/// Decimal, or hexadecimal behind `0x`, perhaps negative.
fn number(text: &str) -> Option<i32> {
    let (text, sign) = text.strip_prefix('-').map_or((text, 1), |text| (text, -1));
    let digits = text.strip_prefix("0x");
    let number = digits.map_or(text.parse(), |digits| i32::from_str_radix(digits, 16));
    Some(sign * number.ok()?)
}

/// The registers in `{r4, r5, r7, lr}` or `{d8-d10}`.
pub fn registers(operands: &str) -> u32 {
    let list = operands.split('{').nth(1).and_then(|rest| rest.split('}').next()).unwrap_or("");
    let number = |name: &str| name.trim().trim_start_matches(['r', 'd', 's']).parse::<u32>().unwrap_or(0);
    let parts = list.split(',').filter(|part| !part.trim().is_empty());
    parts.map(|part| part.split_once('-').map_or(1, |(a, b)| number(b) - number(a) + 1)).sum()
}
