//! Text from the other side.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The maximum length, in characters.
const LONGEST: usize = 200;

/// A short text on one line. Control characters are replaced and the rest of a long text is cut, whoever made it, so
/// that a screen can show what another console has sent.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(from = "String")]
pub struct Words(String);

impl From<String> for Words {
    fn from(text: String) -> Self {
        let plain = |c: char| if c.is_control() { ' ' } else { c };
        let cleaned: String = text.trim().chars().take(LONGEST).map(plain).collect();
        Self(cleaned.trim_end().to_owned())
    }
}

impl From<&str> for Words {
    fn from(text: &str) -> Self {
        Self::from(text.to_owned())
    }
}

impl Words {
    /// The text, if it is short enough to stay whole.
    pub fn whole(text: &str) -> Option<Self> {
        (text.trim().chars().count() <= LONGEST).then(|| text.into())
    }

    /// The text, without control characters.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether there is no text.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl fmt::Display for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_others_cannot_command_the_terminal_and_has_a_limit() {
        assert_eq!(Words::from(" a\x1b[2Jb\nc ").as_str(), "a [2Jb c");
        assert_eq!(
            Words::from("я".repeat(500)).as_str().chars().count(),
            LONGEST
        );
        let read: Words = serde_json::from_str(r#""a\u0007b""#).expect("it is a text");
        assert_eq!(read.as_str(), "a b");
    }
}
