//! The damaged stretches of a tlog.

use crate::text;
use crate::text::Text;

/// How much of a tlog was skipped as damaged.
#[derive(Debug, Default)]
pub struct TlogDamage {
    /// The offset of the first damaged stretch.
    first: Option<u64>,
    stretches: u64,
    bytes: u64,
}

impl TlogDamage {
    /// Counts a stretch at an offset in the file; both in bytes.
    pub fn note(&mut self, offset: u64, len: u64) {
        self.first.get_or_insert(offset);
        self.stretches += 1;
        self.bytes += len;
    }

    /// Where the tlog is damaged, and how much was skipped; `None` if it is not.
    pub fn reason(&self) -> Option<Text> {
        let (first, bytes) = (self.first?, self.bytes);
        Some(text!(
            "transport-damage",
            count = self.stretches,
            byte = first,
            bytes = bytes
        ))
    }
}
