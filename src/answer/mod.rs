//! Answers: the time by which a fraction has been collected, and the fraction collected by a time.

mod cdf;
pub(crate) mod plan;
