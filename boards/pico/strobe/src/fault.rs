//! Errors to make on purpose, to see that the check sees them. Here only with the feature `faults`.

use core::sync::atomic::{AtomicUsize, Ordering};

use shutter_curve::Pulse;

use crate::limits::MIN_LOW;

/// One that can be planted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A pulse is lost.
    Lost,
    /// A pulse comes twice.
    Twice,
    /// A pulse comes a cycle early.
    Early,
    /// A pulse comes a cycle late.
    Late,
    /// A pulse comes too soon after the one before.
    Close,
    /// A record that was written in part is taken for a whole one.
    Torn,
    /// Bytes for which there was no room are not missed.
    Full,
    /// While settings are saved, no edge is seen.
    Save,
}

const NAMES: [(&str, Fault); 8] = [
    ("lost", Fault::Lost),
    ("twice", Fault::Twice),
    ("early", Fault::Early),
    ("late", Fault::Late),
    ("close", Fault::Close),
    ("torn", Fault::Torn),
    ("full", Fault::Full),
    ("save", Fault::Save),
];

/// Which of [`NAMES`]; none at first.
static PLANTED: AtomicUsize = AtomicUsize::new(NAMES.len());

/// The pulse that a fault spoils.
const SPOILED: usize = 5;

/// Plants the fault of this name, which zeros fill up. Another name is none of this firmware's, and plants nothing.
pub fn plant(name: [u8; 8]) {
    let is_it = |known: &str| name.iter().copied().eq(known.bytes().chain([0; 8]).take(8));
    let fault = NAMES.iter().position(|(known, _)| is_it(known)).unwrap_or(NAMES.len());
    PLANTED.store(fault, Ordering::Relaxed);
}

/// Is this the planted one?
pub fn is_planted(fault: Fault) -> bool {
    planted() == Some(fault)
}

fn planted() -> Option<Fault> {
    NAMES.get(PLANTED.load(Ordering::Relaxed)).map(|(_, fault)| *fault)
}

/// Spoils the first `n` of the pulses, which have room for one more, and gives their new number.
pub fn spoil(pulses: &mut [Pulse], n: usize) -> usize {
    let (Some(fault), true) = (planted(), n > SPOILED + 1) else { return n };
    let Pulse { on, off } = pulses[SPOILED];
    let moved = |by| Pulse { on: on + by, off: off + by };
    match fault {
        Fault::Lost => {
            pulses.copy_within(SPOILED + 1..n, SPOILED);
            return n - 1;
        }
        Fault::Twice => {
            pulses.copy_within(SPOILED..n, SPOILED + 1);
            pulses[SPOILED + 1] = moved(off - on + MIN_LOW);
            return n + 1;
        }
        Fault::Early => pulses[SPOILED] = Pulse { on: on - 1, off: off - 1 },
        Fault::Late => pulses[SPOILED] = moved(1),
        Fault::Close => {
            let before = pulses[SPOILED - 1].off + MIN_LOW;
            pulses[SPOILED] = Pulse { on: before, off: before + off - on };
        }
        Fault::Torn | Fault::Full | Fault::Save => (),
    }
    n
}
