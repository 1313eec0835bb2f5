//! A short text with numbers, made without `core::fmt`, so that a constant's panic can have them.

/// Text that does not fit is cut off.
pub(crate) struct Text {
    bytes: [u8; 192],
    length: usize,
}

impl Text {
    pub(crate) const fn new(text: &str) -> Self {
        Self { bytes: [0; 192], length: 0 }.then(text)
    }

    pub(crate) const fn then(mut self, text: &str) -> Self {
        let text = text.as_bytes();
        let mut i = 0;
        while i < text.len() && self.length < self.bytes.len() {
            self.bytes[self.length] = text[i];
            (i, self.length) = (i + 1, self.length + 1);
        }
        self
    }

    pub(crate) const fn number(mut self, n: u32) -> Self {
        let mut divisor = 1_000_000_000;
        while divisor > 0 && self.length < self.bytes.len() {
            if n >= divisor || divisor == 1 {
                self.bytes[self.length] = b'0' + (n / divisor % 10) as u8;
                self.length += 1;
            }
            divisor /= 10;
        }
        self
    }

    /// "1 tick", "2 ticks".
    pub(crate) const fn ticks(self, n: u32) -> Self {
        self.number(n).then(if n == 1 { " tick" } else { " ticks" })
    }

    pub(crate) const fn as_str(&self) -> &str {
        // All texts are ASCII, so the cut is between two characters.
        match core::str::from_utf8(self.bytes.split_at(self.length).0) {
            Ok(text) => text,
            Err(_) => "",
        }
    }
}
