//! The program `shutter`: its commands, its report and its pictures.

pub mod command;
pub mod picture;
pub mod report;
pub mod speeds;
