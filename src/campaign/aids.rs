//! The level of help for a trainee.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantArray};

use crate::text;
use crate::text::Text;

/// The probabilities of mastery from which hints of levels 1 to 3 are no longer shown.
const FADES_AT: [f64; 3] = [0.40, 0.65, 0.85];

/// A level of help. It changes the advice, but never the physics or the score.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Default,
    Serialize,
    Deserialize,
    EnumString,
    IntoStaticStr,
    VariantArray,
)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum Aids {
    Full,
    /// The better a skill is mastered, the less advice.
    #[default]
    Fading,
    None,
}

impl Aids {
    /// All levels, from the most help to the least.
    pub const ALL: &[Self] = <Self as VariantArray>::VARIANTS;

    /// `full`, `fading` or `none`, as in files and on the command line.
    pub fn code(self) -> &'static str {
        self.into()
    }

    /// The level with a code; `None` if the code is unknown.
    pub fn of(code: &str) -> Option<Self> {
        code.parse().ok()
    }

    /// The level after this one; the first follows the last.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Full => Self::Fading,
            Self::Fading => Self::None,
            Self::None => Self::Full,
        }
    }

    /// The level's name on the screen.
    pub fn title(self) -> Text {
        match self {
            Self::Full => text!("aids-full"),
            Self::Fading => text!("aids-fading"),
            Self::None => text!("aids-none"),
        }
    }

    /// A one-line explanation for the trainee.
    pub fn explained(self) -> Text {
        match self {
            Self::Full => text!("aids-full-about"),
            Self::Fading => text!("aids-fading-about"),
            Self::None => text!("aids-none-about"),
        }
    }

    /// Whether a hint is shown automatically. `level` is the hint's level, from 1 (the routine) to
    /// 3 (the steps); `chance` is the probability that its skill is mastered, 0 to 1.
    pub fn shows_hint(self, level: u8, chance: f64) -> bool {
        match self {
            Self::Full => true,
            Self::Fading => {
                let at = usize::from(level.clamp(1, 3)) - 1;
                chance < FADES_AT[at]
            }
            Self::None => false,
        }
    }

    /// Whether the feedback line is shown. It reports results, so it does not fade.
    pub fn shows_feedback(self) -> bool {
        self != Self::None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_fade_with_the_skill_the_plain_ones_first() {
        let shown = |aids: Aids, chance| [1, 2, 3].map(|level| aids.shows_hint(level, chance));
        for (chance, expected) in [
            (0.20, [true, true, true]),
            (0.39, [true, true, true]),
            (0.40, [false, true, true]),
            (0.65, [false, false, true]),
            (0.85, [false, false, false]),
        ] {
            assert_eq!(shown(Aids::Fading, chance), expected, "{chance}");
            assert_eq!(shown(Aids::Full, chance), [true; 3], "{chance}");
            assert_eq!(shown(Aids::None, chance), [false; 3], "{chance}");
        }
    }

    #[test]
    fn every_level_is_found_by_its_code_and_reached_by_the_key() {
        for &aids in Aids::ALL {
            assert_eq!(Aids::of(aids.code()), Some(aids));
            assert_eq!(aids.next().next().next(), aids);
            assert_ne!(aids.next(), aids);
        }
    }
}
