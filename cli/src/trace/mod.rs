//! A measured trace: [`decode`] and [`read`] take a file to a [`Trace`], and [`pulses`] finds its pulses and its noise.
//! Whatever is wrong with it on the way is a [`Refusal`] or a [`Warning`].

mod pulse;
mod read;
mod samples;
mod told;

pub(crate) use pulse::QUARTERS;
pub use pulse::{Crossings, Frame, Light, Pulses, pulses};
pub use read::{Column, Options, decode, read};
pub use samples::Trace;
pub(crate) use samples::sampling_interval;
pub use told::{Refusal, Warning};
