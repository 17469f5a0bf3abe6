//! Hashes that have to stay the same: random streams and vehicle identities depend on them.

/// The 64-bit FNV-1a hash of some bytes.
///
/// Source: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm",
/// draft-eastlake-fnv.
pub fn fnv1a<'a>(bytes: impl IntoIterator<Item = &'a u8>) -> u64 {
    let mut hash = RunningHash::default();
    hash.add(bytes);
    hash.value()
}

/// The [`fnv1a`] hash of bytes that arrive one after the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RunningHash(u64);

impl Default for RunningHash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl RunningHash {
    pub fn add<'a>(&mut self, bytes: impl IntoIterator<Item = &'a u8>) {
        const PRIME: u64 = 0x0000_0100_0000_01b3;
        self.0 = bytes.into_iter().fold(self.0, |hash, &byte| {
            (hash ^ u64::from(byte)).wrapping_mul(PRIME)
        });
    }

    /// The hash of all bytes so far.
    pub fn value(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_values_are_met() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8);
    }
}
