//! How much a trainee is helped.

use serde::{Deserialize, Serialize};

use crate::text;
use crate::text::Text;

/// A level of difficulty: it changes what helps, never the physics and never the score.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aids {
    /// All advice that comes by itself.
    Full,
    /// Less of it the better a skill is known.
    #[default]
    Fading,
    /// None that was not asked for.
    None,
}

impl Aids {
    /// All levels, from the most help to the least.
    pub const ALL: [Self; 3] = [Self::Full, Self::Fading, Self::None];

    /// `full`, `fading` or `none`, as in files and on the command line.
    pub fn code(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Fading => "fading",
            Self::None => "none",
        }
    }

    /// The level of a code.
    pub fn of(code: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|aids| aids.code() == code)
    }

    /// In a word.
    pub fn title(self) -> Text {
        match self {
            Self::Full => text!("aids-full"),
            Self::Fading => text!("aids-fading"),
            Self::None => text!("aids-none"),
        }
    }
}
