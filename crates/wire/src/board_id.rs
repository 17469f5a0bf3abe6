//! The unique id of an autopilot's board.

use std::fmt;

/// The id of a board: `uid2` of `AUTOPILOT_VERSION`, or `uid` if the autopilot has no longer id.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BoardId([u8; BoardId::LEN]);

impl BoardId {
    const LEN: usize = 18;

    /// The id in the fields of `AUTOPILOT_VERSION`; `None` if both are zero.
    pub fn of(uid: u64, uid2: &[u8; Self::LEN]) -> Option<Self> {
        let mut bytes = *uid2;
        if uid2.iter().all(|&byte| byte == 0) {
            bytes[..8].copy_from_slice(&uid.to_le_bytes());
        }
        bytes.iter().any(|&byte| byte != 0).then_some(Self(bytes))
    }
}

impl fmt::Display for BoardId {
    /// The bytes in hexadecimal, without zeros at the end.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let len = self.0.iter().rposition(|&byte| byte != 0).unwrap_or(0) + 1;
        self.0
            .iter()
            .take(len)
            .try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longer_id_counts_and_zeros_are_none() {
        assert_eq!(BoardId::of(0, &[0; 18]), None);
        let short = BoardId::of(0x0102, &[0; 18]).expect("an id");
        assert_eq!(short.to_string(), "0201");
        let mut uid2 = [0; 18];
        uid2[..3].copy_from_slice(&[0xAB, 0, 0x10]);
        let long = BoardId::of(0x0102, &uid2).expect("an id");
        assert_eq!(long.to_string(), "ab0010");
        assert_ne!(short, long);
    }
}
