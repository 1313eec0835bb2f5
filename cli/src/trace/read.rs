//! tmp
/// a
pub struct Options;
/// a
pub struct Column;
/// a
pub fn read() {}
