//! For tests: the words of a text, and a language in which every message is the same.

use std::cell::Cell;

use super::Text;

thread_local! {
    static WORDLESS: Cell<bool> = const { Cell::new(false) };
}

/// Runs a closure on this thread with every message of every language replaced by `x`.
pub fn without_words<T>(run: impl FnOnce() -> T) -> T {
    WORDLESS.set(true);
    let result = run();
    WORDLESS.set(false);
    result
}

pub(super) fn is_wordless() -> bool {
    WORDLESS.get()
}

impl Text {
    /// Whether the text's English words contain `words`.
    pub fn contains(&self, words: &str) -> bool {
        self.to_string().contains(words)
    }
}

impl PartialEq<str> for Text {
    fn eq(&self, words: &str) -> bool {
        self.to_string().as_str() == words
    }
}

impl PartialEq<&str> for Text {
    fn eq(&self, words: &&str) -> bool {
        self == *words
    }
}
