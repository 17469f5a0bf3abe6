//! Converts texts to the words of a language.

use std::fmt;
use std::sync::LazyLock;

use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};
use unic_langid::LanguageIdentifier;

use super::{Language, Text, TextArgument, TextContent, messages};

/// The messages of one language.
#[derive(Clone, Copy)]
pub struct Locale {
    language: Language,
    bundle: &'static Bundle,
}

type Bundle = FluentBundle<FluentResource>;

/// The English messages, parsed only once: parsing a language takes as long as drawing many
/// screens.
static ENGLISH: LazyLock<Bundle> = LazyLock::new(|| bundle(Language::English));
static UKRAINIAN: LazyLock<Bundle> = LazyLock::new(|| bundle(Language::Ukrainian));

fn bundle(language: Language) -> Bundle {
    let id: LanguageIdentifier = language.code().parse().unwrap_or_default();
    let mut bundle = FluentBundle::new_concurrent(vec![id]);
    // Terminals show the marks that would isolate right-to-left arguments as boxes.
    bundle.set_use_isolating(false);
    for (_, source) in messages(language) {
        // A faulty message is left out; a test detects that.
        let resource =
            FluentResource::try_new((*source).to_owned()).unwrap_or_else(|(readable, _)| readable);
        drop(bundle.add_resource(resource));
    }
    bundle
}

impl Locale {
    /// The messages of a language.
    pub fn new(language: Language) -> Self {
        let bundle: &'static Bundle = match language {
            Language::English => &ENGLISH,
            Language::Ukrainian => &UKRAINIAN,
        };
        Self { language, bundle }
    }

    /// The language of the messages.
    pub fn language(&self) -> Language {
        self.language
    }

    /// The words of a text.
    pub fn text(&self, text: &Text) -> String {
        match &text.0 {
            TextContent::Verbatim(words) => words.clone(),
            TextContent::Message { id, arguments } => self.format(id, arguments),
            TextContent::Joined { separator, parts } => {
                let parts: Vec<String> = parts.iter().map(|part| self.text(part)).collect();
                parts.join(separator)
            }
            TextContent::Written(all) => {
                let ours = all.iter().find(|(language, _)| *language == self.language);
                let found = ours.or(all.first());
                found.map_or_else(String::new, |(_, words)| words.clone())
            }
        }
    }

    /// The words of a message without arguments.
    pub fn say(&self, id: &str) -> String {
        self.format(id, &[])
    }

    /// The words of a message without arguments, if the language has it.
    pub fn find(&self, id: &str) -> Option<String> {
        self.bundle.has_message(id).then(|| self.say(id))
    }

    fn format(&self, id: &str, arguments: &[(&'static str, TextArgument)]) -> String {
        #[cfg(test)]
        if super::said::is_wordless() {
            return "x".to_owned();
        }
        let message = self.bundle.get_message(id);
        let Some(pattern) = message.and_then(|message| message.value()) else {
            return id.to_owned();
        };
        let arguments: FluentArgs = arguments
            .iter()
            .map(|(name, argument)| (*name, self.value(argument)))
            .collect();
        let mut errors = Vec::new();
        let words = self
            .bundle
            .format_pattern(pattern, Some(&arguments), &mut errors);
        words.into_owned()
    }

    fn value<'a>(&self, argument: &'a TextArgument) -> FluentValue<'a> {
        match argument {
            TextArgument::Number(number) => FluentValue::from(*number),
            TextArgument::Word(word) => FluentValue::from(word.as_str()),
            TextArgument::Text(text) => FluentValue::from(self.text(text)),
        }
    }
}

impl fmt::Debug for Locale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Locale").field(&self.language).finish()
    }
}

impl Default for Locale {
    fn default() -> Self {
        Self::new(Language::English)
    }
}
