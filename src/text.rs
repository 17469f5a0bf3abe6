//! Texts for people, in their language.
//!
//! A message to the user is a [`Text`]: an id with its arguments. A [`Locale`] converts it to words only when it is
//! shown. The words are Fluent messages in `locales/LANGUAGE/`; a test checks that no message is missing in any
//! language.
//!
//! Text from outside (a vehicle, the operating system, a file of the user) is verbatim text: it cannot be translated,
//! and may be an argument of a message.

use std::borrow::Cow;
use std::fmt;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr, VariantNames};

mod catalogue;
mod figure;
mod layout;
mod locale;
mod stored;
mod system;

pub use catalogue::messages;
pub use figure::{clock, clock_s, figure, lasting, rounded, utc_minute_of, utc_of};
pub use layout::{clip, reflow, wrap};
pub use locale::Locale;
pub use stored::StoredText;
pub use system::OwnFault;

/// A language of the texts. The names are ISO 639 codes.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Default,
    EnumString,
    IntoStaticStr,
    VariantNames,
    Serialize,
    Deserialize,
)]
#[serde(into = "&'static str", try_from = "String")]
pub enum Language {
    #[default]
    #[strum(serialize = "en")]
    English,
    #[strum(serialize = "uk")]
    Ukrainian,
}

impl TryFrom<String> for Language {
    type Error = strum::ParseError;

    fn try_from(code: String) -> Result<Self, Self::Error> {
        code.parse()
    }
}

impl Language {
    pub const ALL: [Self; 2] = [Self::English, Self::Ukrainian];

    /// The codes of all languages.
    pub const CODES: &'static [&'static str] = <Self as VariantNames>::VARIANTS;

    pub fn code(self) -> &'static str {
        self.into()
    }

    /// The language of a code or of a POSIX locale, if it is supported: `uk`, `uk_UA.UTF-8`,
    /// `en_GB`.
    pub fn of(name: &str) -> Option<Self> {
        let code = name.split(['_', '-', '.', '@']).next()?;
        Self::ALL
            .into_iter()
            .find(|language| language.code().eq_ignore_ascii_case(code))
    }
}

/// A text for people. `Display` gives its English words, for logs and for programs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text(TextContent);

#[derive(Debug, Clone, PartialEq, Eq)]
enum TextContent {
    Verbatim(String),
    Message {
        id: Cow<'static, str>,
        arguments: Vec<(&'static str, TextArgument)>,
    },
    Joined {
        separator: &'static str,
        parts: Vec<Text>,
    },
    /// A text given in several languages, English first.
    Written(Vec<(Language, String)>),
}

/// An argument of a message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TextArgument {
    /// A whole number, on which the form of a noun may depend.
    Number(i64),
    /// A word used unchanged: a name, or a figure with its decimals.
    Word(String),
    Text(Text),
}

/// A message by its id, with its arguments: `text!("links-lost", vehicle = id, seconds = 3)`.
#[macro_export]
macro_rules! text {
    ($id:literal $(, $name:ident = $value:expr)* $(,)?) => {
        $crate::text::Text::new($id, vec![
            $((stringify!($name), $crate::text::TextArgument::from($value))),*
        ])
    };
}
pub use crate::text;

impl Text {
    /// A message by its id; [`text!`] is shorter.
    pub fn new(
        id: impl Into<Cow<'static, str>>,
        arguments: Vec<(&'static str, TextArgument)>,
    ) -> Self {
        Self(TextContent::Message {
            id: id.into(),
            arguments,
        })
    }

    /// Text from outside, or a name: the same in every language.
    pub fn verbatim(text: impl Into<String>) -> Self {
        Self(TextContent::Verbatim(text.into()))
    }

    /// A text given in English and possibly in other languages.
    pub fn written(
        english: impl Into<String>,
        others: impl IntoIterator<Item = (Language, String)>,
    ) -> Self {
        let english = (Language::English, english.into());
        Self(TextContent::Written(
            std::iter::once(english).chain(others).collect(),
        ))
    }

    /// The text with `word` in place of each `mark`, in each of its languages; messages and joined
    /// texts are returned unchanged.
    #[must_use]
    pub fn filled(&self, mark: &str, word: &str) -> Self {
        let content = match &self.0 {
            TextContent::Verbatim(words) => TextContent::Verbatim(words.replace(mark, word)),
            TextContent::Written(all) => {
                let fill =
                    |(language, words): &(Language, String)| (*language, words.replace(mark, word));
                TextContent::Written(all.iter().map(fill).collect())
            }
            other @ (TextContent::Message { .. } | TextContent::Joined { .. }) => other.clone(),
        };
        Self(content)
    }

    /// Several texts, joined by a separator.
    pub fn joined(separator: &'static str, parts: Vec<Self>) -> Self {
        Self(TextContent::Joined { separator, parts })
    }

    /// Whether the text is empty.
    pub fn is_empty(&self) -> bool {
        match &self.0 {
            TextContent::Verbatim(text) => text.is_empty(),
            TextContent::Message { .. } => false,
            TextContent::Joined { parts, .. } => parts.iter().all(Self::is_empty),
            TextContent::Written(all) => all.iter().all(|(_, words)| words.is_empty()),
        }
    }

    /// The same text about other vehicles: `vehicles` replaces the argument `vehicle` wherever it
    /// occurs.
    #[must_use]
    pub fn regarding(&self, vehicles: &str) -> Self {
        Self(match &self.0 {
            TextContent::Verbatim(_) | TextContent::Written(_) => self.0.clone(),
            TextContent::Message { id, arguments } => TextContent::Message {
                id: id.clone(),
                arguments: arguments
                    .iter()
                    .map(|(name, argument)| (*name, argument.regarding(name, vehicles)))
                    .collect(),
            },
            TextContent::Joined { separator, parts } => TextContent::Joined {
                separator,
                parts: parts.iter().map(|part| part.regarding(vehicles)).collect(),
            },
        })
    }
}

/// Serialised texts are English, whatever the language of the console.
impl serde::Serialize for Text {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Deserialised texts are verbatim text.
impl<'de> serde::Deserialize<'de> for Text {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(Self::verbatim)
    }
}

impl TextArgument {
    fn regarding(&self, name: &str, vehicles: &str) -> Self {
        match self {
            Self::Text(text) => Self::Text(text.regarding(vehicles)),
            _ if name == "vehicle" => Self::Word(vehicles.to_owned()),
            other @ (Self::Number(_) | Self::Word(_)) => other.clone(),
        }
    }
}

impl Default for Text {
    fn default() -> Self {
        Self::verbatim("")
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        static ENGLISH: LazyLock<Locale> = LazyLock::new(|| Locale::new(Language::English));
        f.pad(&ENGLISH.text(self))
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Self::verbatim(text)
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::verbatim(text)
    }
}

impl From<Text> for TextArgument {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

impl From<&Text> for TextArgument {
    fn from(text: &Text) -> Self {
        Self::Text(text.clone())
    }
}

impl From<String> for TextArgument {
    fn from(word: String) -> Self {
        Self::Word(word)
    }
}

impl From<&String> for TextArgument {
    fn from(word: &String) -> Self {
        Self::Word(word.clone())
    }
}

impl From<&str> for TextArgument {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl From<char> for TextArgument {
    fn from(letter: char) -> Self {
        Self::Word(letter.to_string())
    }
}

macro_rules! numbers {
    ($($kind:ty),*) => {$(
        impl From<$kind> for TextArgument {
            fn from(number: $kind) -> Self {
                Self::Number(i64::try_from(number).unwrap_or(i64::MAX))
            }
        }
    )*};
}
numbers!(u8, u16, u32, u64, usize, i16, i32, i64);

/// Tests may examine the words. The program must not: its decisions depend on types, so rewording
/// changes nothing.
#[cfg(test)]
pub mod said;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_locale_of_the_shell_names_its_language() {
        for (name, language) in [
            ("uk_UA.UTF-8", Some(Language::Ukrainian)),
            ("uk", Some(Language::Ukrainian)),
            ("en_GB", Some(Language::English)),
            ("C", None),
            ("", None),
        ] {
            assert_eq!(Language::of(name), language, "{name}");
        }
    }

    #[test]
    fn a_number_decides_on_the_form_of_a_noun_in_each_language() {
        let ukrainian = Locale::new(Language::Ukrainian);
        let cases = [
            (1, "1 vehicle", "1 апарат"),
            (2, "2 vehicles", "2 апарати"),
            (5, "5 vehicles", "5 апаратів"),
            (21, "21 vehicles", "21 апарат"),
        ];
        for (count, english, translated) in cases {
            let text = text!("count-vehicles", count = count);
            assert_eq!(text.to_string(), english);
            assert_eq!(ukrainian.text(&text), translated);
        }
    }

    #[test]
    fn texts_stand_inside_texts_and_foreign_words_stay() {
        let part = Text::joined(
            ", ",
            vec![text!("count-vehicles", count = 1), "PreArm: x".into()],
        );
        assert_eq!(part.to_string(), "1 vehicle, PreArm: x");
        let ukrainian = Locale::new(Language::Ukrainian);
        assert_eq!(ukrainian.text(&part), "1 апарат, PreArm: x");
    }

    #[test]
    fn what_was_written_in_one_language_only_is_said_in_that() {
        let ukrainian = Locale::new(Language::Ukrainian);
        let both = Text::written("fly to {x}", [(Language::Ukrainian, "до {x}".to_owned())]);
        let both = both.filled("{x}", "A1");
        assert_eq!(both.to_string(), "fly to A1");
        assert_eq!(ukrainian.text(&both), "до A1");
        let english = Text::written("land", []);
        assert_eq!(ukrainian.text(&english), "land");
    }

    #[test]
    fn a_text_about_one_vehicle_can_be_said_of_several() {
        let one = text!("refused-not-armed", verb = "goto", vehicle = 3);
        let both = Text::joined("; ", vec![one.clone(), "x".into()]);
        let told = both.regarding("1-3").to_string();
        assert!(
            told.contains("`1-3 arm`") && told.ends_with("; x"),
            "{told}"
        );
        let other = text!("refused-not-armed", verb = "goto", vehicle = 4);
        assert_eq!(one.regarding(""), other.regarding(""));
    }

    #[test]
    fn a_message_that_is_not_there_shows_its_id() {
        assert_eq!(text!("no-such-message").to_string(), "no-such-message");
    }
}
