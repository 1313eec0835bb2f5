//! A measured trace: [`open()`] takes a file to a [`Trace`], and [`pulses`] finds its pulses and its noise.
//! Whatever is wrong with it on the way is a [`Refusal`] or a [`Warning`].
//!
//! A file's way, in `read`: its `bytes` to a text; lines and cells of a `table`, with `numbers`, and above them `heads`
//! and `settings`, of `names` that instruments write; its `layout`, which columns are times and signals, in which unit;
//! their `times`, put in order as `samples`; and of several signals one, which `select` takes. `reading` says what was
//! read. A `wav` has no table.

mod asked;
mod bytes;
mod coupling;
mod edges;
mod heads;
mod layout;
mod names;
mod numbers;
mod pulse;
mod read;
mod reading;
mod samples;
mod select;
mod settings;
mod table;
mod times;
mod told;
mod wav;

pub use asked::Options;
pub(crate) use coupling::{Rates, guessed, start, undone};
pub use edges::Switch;
pub(crate) use edges::{Edge, Edges, Starts, edges};
pub(crate) use pulse::QUARTERS;
pub use pulse::{Crossings, Frame, Light, Pulses, pulses};
pub use read::{columns, open};
pub use reading::{Clock, Reading, Recording, Told};
pub use samples::Trace;
pub(crate) use samples::{least_step, median, sampling_interval};
pub use times::Timing;
pub(crate) use told::from_opening;
pub use told::{Refusal, Remedy, Tell, Warning};
