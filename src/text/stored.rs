//! Texts in files: a message by its id, so that it can be shown in another language later.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::{Language, Text, TextArgument, TextContent, messages};

/// The separators of joined texts that can be read.
const SEPARATORS: [&str; 7] = [", ", "; ", ": ", " ", "", "\n", "  "];

/// The names of all arguments of messages.
static NAMES: LazyLock<BTreeSet<&'static str>> = LazyLock::new(|| {
    let sources = messages(Language::English).iter();
    let marked = sources.flat_map(|(_, source)| source.split('$').skip(1));
    let name = |rest: &'static str| {
        let is_other = |c: char| !(c.is_ascii_alphanumeric() || c == '-' || c == '_');
        let end = rest.find(is_other).unwrap_or(rest.len());
        &rest[..end]
    };
    marked.map(name).collect()
});

/// A text as a file contains it. Ids of messages belong to a version of the program, so the file also needs the English
/// words.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum StoredText {
    Number(i64),
    /// Words that are the same in every language.
    Words(String),
    /// A message by its id, with its arguments.
    Message {
        id: String,
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        with: BTreeMap<String, StoredText>,
    },
    /// Several texts and their separator.
    Joined {
        parts: Vec<StoredText>,
        by: String,
    },
    /// A text given in several languages, English first.
    Written(Vec<(Language, String)>),
}

impl Text {
    /// The text for a file; `None` if it is the same in every language.
    pub fn stored(&self) -> Option<StoredText> {
        match &self.0 {
            TextContent::Verbatim(_) => None,
            TextContent::Message { .. } | TextContent::Joined { .. } | TextContent::Written(_) => {
                Some(StoredText::of(self))
            }
        }
    }
}

impl StoredText {
    fn of(text: &Text) -> Self {
        match &text.0 {
            TextContent::Verbatim(words) => Self::Words(words.clone()),
            TextContent::Message { id, arguments } => {
                let with = arguments.iter();
                let with = with.map(|(name, it)| ((*name).to_owned(), Self::of_argument(it)));
                Self::Message {
                    id: id.to_string(),
                    with: with.collect(),
                }
            }
            TextContent::Joined { separator, parts } => Self::Joined {
                parts: parts.iter().map(Self::of).collect(),
                by: (*separator).to_owned(),
            },
            TextContent::Written(all) => Self::Written(all.clone()),
        }
    }

    fn of_argument(argument: &TextArgument) -> Self {
        match argument {
            TextArgument::Number(number) => Self::Number(*number),
            TextArgument::Word(word) => Self::Words(word.clone()),
            TextArgument::Text(text) => Self::of(text),
        }
    }

    /// The text whose English words the file contains; those words if this version of the program has other ones for it.
    pub fn text(&self, english: &str) -> Text {
        let known = self.known().filter(|text| {
            let words = text.to_string();
            words == english
        });
        known.unwrap_or_else(|| Text::verbatim(english))
    }

    /// The text; `None` if this version of the program cannot have written it.
    fn known(&self) -> Option<Text> {
        Some(match self {
            Self::Number(number) => Text::verbatim(number.to_string()),
            Self::Words(words) => Text::verbatim(words.clone()),
            Self::Message { id, with } => {
                let with = with.iter();
                let with =
                    with.map(|(name, it)| Some((*NAMES.get(name.as_str())?, it.argument()?)));
                Text::new(id.clone(), with.collect::<Option<Vec<_>>>()?)
            }
            Self::Joined { parts, by } => {
                let separator = SEPARATORS.into_iter().find(|it| *it == by.as_str())?;
                let parts = parts.iter().map(Self::known);
                Text::joined(separator, parts.collect::<Option<Vec<_>>>()?)
            }
            Self::Written(all) => Text(TextContent::Written(all.clone())),
        })
    }

    fn argument(&self) -> Option<TextArgument> {
        Some(match self {
            Self::Number(number) => TextArgument::Number(*number),
            Self::Words(words) => TextArgument::Word(words.clone()),
            Self::Message { .. } | Self::Joined { .. } | Self::Written(_) => {
                TextArgument::Text(self.known()?)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text;
    use crate::text::Locale;

    /// A text after a file.
    fn read_again(text: &Text, english: &str) -> Text {
        let written = serde_json::to_string(&text.stored()).expect("plain data");
        let read: Option<StoredText> = serde_json::from_str(&written).expect("as written");
        read.map_or_else(|| Text::verbatim(english), |it| it.text(english))
    }

    #[test]
    fn a_text_is_read_in_every_language() {
        let mode = text!("reason-takeoff-mode-arm", mode = "STABILIZE");
        let parts = vec![mode, text!("count-vehicles", count = 2), "PreArm: x".into()];
        let reason = Text::joined("; ", parts);
        let written = [(Language::Ukrainian, "до A1".to_owned())];
        let refused = text!("outcome-verb-refused", verb = "takeoff", reason = reason);
        let ukrainian = Locale::new(Language::Ukrainian);
        for text in [refused, Text::written("to A1", written), "x".into()] {
            let again = read_again(&text, &text.to_string());
            assert_eq!(again.to_string(), text.to_string());
            assert_eq!(ukrainian.text(&again), ukrainian.text(&text));
        }
    }

    #[test]
    fn a_message_that_this_version_words_otherwise_is_shown_in_english() {
        let text = text!("count-vehicles", count = 2);
        let words = "2 machines";
        assert_eq!(read_again(&text, words), Text::verbatim(words));
        let unknown = Text::new("no-such-message", Vec::new());
        assert_eq!(read_again(&unknown, words), Text::verbatim(words));
    }
}
