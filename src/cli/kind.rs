//! The options about SITL's vehicles that `fly` and `hangar command` share.

use clap::ValueEnum;

use crate::sitl::SitlKind;

/// A kind of vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum KindWord {
    Copter,
    Plane,
    /// A rover or a boat: the model decides.
    Rover,
    /// A boat: a rover of the model motorboat.
    Boat,
    Sub,
}

impl KindWord {
    /// The model for this kind; `None` for SITL's usual one.
    pub fn model(self) -> Option<&'static str> {
        match self {
            Self::Boat => Some("motorboat"),
            Self::Copter | Self::Plane | Self::Rover | Self::Sub => None,
        }
    }
}

impl From<KindWord> for SitlKind {
    fn from(word: KindWord) -> Self {
        match word {
            KindWord::Copter => Self::Copter,
            KindWord::Plane => Self::Plane,
            KindWord::Rover | KindWord::Boat => Self::Rover,
            KindWord::Sub => Self::Sub,
        }
    }
}

/// Reads a parameter to start with, written as `NAME=VALUE`.
pub(super) fn parse_parameter(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("expected NAME=VALUE, such as RTL_ALT=3000")?;
    let value = value
        .parse()
        .map_err(|_| format!("`{value}` is not a number"))?;
    Ok((name.to_uppercase(), value))
}
