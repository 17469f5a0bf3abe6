//! The kinds of reports.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantNames};

use crate::text;
use crate::text::Text;

/// A kind of report. Its word is the same in commands, records and reports.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    EnumString,
    IntoStaticStr,
    VariantNames,
)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum FindKind {
    Mine,
    Person,
    /// A source of radiation.
    Source,
    /// A source of gas.
    Leak,
    Fire,
    /// A defect of a line or a structure.
    Defect,
    /// The highest reading of a sensor.
    Peak,
}

impl FindKind {
    /// The words of all kinds.
    pub const NAMES: &'static [&'static str] = <Self as VariantNames>::VARIANTS;

    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The name of the kind on the screen.
    pub fn title(self) -> Text {
        match self {
            Self::Mine => text!("contact-mine"),
            Self::Person => text!("contact-person"),
            Self::Source => text!("contact-source"),
            Self::Leak => text!("contact-leak"),
            Self::Fire => text!("contact-fire"),
            Self::Defect => text!("contact-defect"),
            Self::Peak => text!("contact-peak"),
        }
    }
}

/// The names of contacts without their numbers: `fire` for fires, which are numbered separately,
/// and `c` for all others.
pub const CONTACT_STEMS: [&str; 2] = ["c", "fire"];

/// Whether a word is the name of a contact, such as `c3` or `fire12`.
pub fn is_contact_name(word: &str) -> bool {
    CONTACT_STEMS.iter().any(|stem| {
        let number = word.strip_prefix(stem).unwrap_or_default();
        !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
    })
}

/// The name of the place with a sensor's highest reading of all vehicles; with a vehicle's number
/// after it, of that one.
pub const PEAK_PLACE: &str = "peak";

/// Whether a word names a place with a sensor's highest reading, such as `peak` or `peak2`.
pub fn is_peak_name(word: &str) -> bool {
    let number = word.strip_prefix(PEAK_PLACE);
    number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_has_one_word_in_commands_and_files() {
        for name in FindKind::NAMES {
            let kind: FindKind = name.parse().expect("a kind's own word");
            assert_eq!(serde_json::to_value(kind).expect("a word"), **name);
            assert!(!kind.title().to_string().starts_with("contact-"));
        }
    }
}
