//! The messages of the TOML reader in this program's own words, so that every language has them.

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeValue, ValueDeserializer};

use super::Diagnostic;
use crate::text;
use crate::text::Text;

/// Reads a plain value of a TOML file.
///
/// # Errors
/// The value has another type; the fault is at its place.
pub fn toml_value<'i, T: Deserialize<'i>>(value: Spanned<DeValue<'i>>) -> Result<T, Diagnostic> {
    let place = value.span();
    T::deserialize(ValueDeserializer::from(value)).map_err(|error| {
        let place = error.span().unwrap_or(place);
        Diagnostic::new(place, toml_words(error.message()))
    })
}

/// A message of serde about a value that does not fit its type, as a text of this program.
pub fn serde_words(message: &str) -> Text {
    toml_words(message)
}

/// A message of the TOML reader as a text of this program. The reader's own words remain only in
/// messages that are not known here.
pub(super) fn toml_words(message: &str) -> Text {
    let named = |before: &str| message.strip_prefix(before)?.split_once('`');
    if let Some((name, rest)) = named("unknown field `") {
        let known = listed(rest);
        return if known.is_empty() {
            text!("fault-key-none", name = name)
        } else {
            text!("fault-key-unexpected", name = name, known = known)
        };
    }
    if let Some((name, rest)) = named("unknown variant `") {
        return text!("fault-value-unknown", name = name, known = listed(rest));
    }
    if let Some((name, _)) = named("missing field `") {
        return text!("fault-key-missing", name = name);
    }
    if let Some(text) = wrong_type(message) {
        return text;
    }
    if message == "wanted string or table" {
        return text!("fault-text-needed");
    }
    // The reader may add what it expected, which the texts below say themselves.
    let fault = message.split_once(", expected ");
    syntax(fault.map_or(message, |(fault, _)| fault))
        .unwrap_or_else(|| text!("fault-syntax", words = message))
}

/// The names in backticks, separated by commas.
fn listed(text: &str) -> String {
    let names: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    names.join(", ")
}

/// The text of a message about a value's type.
fn wrong_type(message: &str) -> Option<Text> {
    let mut beginnings = ["invalid type: ", "invalid value: ", "invalid length "].into_iter();
    let types = beginnings.find_map(|before| message.strip_prefix(before))?;
    let (found, wanted) = types.rsplit_once(", expected ")?;
    let (found, wanted) = (found_value(found), wanted_type(wanted));
    Some(text!("fault-type", found = found, wanted = wanted))
}

/// A value as serde describes it: its type, and the value itself for plain types.
fn found_value(words: &str) -> Text {
    if let Some(value) = words.strip_prefix("string ") {
        return text!("fault-found-text", value = value);
    }
    let plain = ["integer ", "floating point ", "boolean "];
    if let Some(value) = plain.iter().find_map(|kind| words.strip_prefix(kind)) {
        return Text::verbatim(value);
    }
    match words {
        "sequence" => text!("fault-found-list"),
        "map" => text!("fault-found-table"),
        count if count.bytes().all(|byte| byte.is_ascii_digit()) => {
            text!("fault-found-count", count = count)
        }
        other => Text::verbatim(other),
    }
}

/// A type as serde or Rust names it.
fn wanted_type(words: &str) -> Text {
    let lengths = ["an array of length ", "a tuple of size "];
    if let Some(count) = lengths.iter().find_map(|kind| words.strip_prefix(kind)) {
        return text!("fault-wanted-count", count = count);
    }
    match words.strip_prefix("a ").unwrap_or(words) {
        "string" | "character" => text!("fault-wanted-text"),
        "f32" | "f64" | "number" => text!("fault-wanted-number"),
        "u8" | "u16" | "u32" | "u64" | "usize" => text!("fault-wanted-count-up"),
        "i8" | "i16" | "i32" | "i64" => text!("fault-wanted-whole"),
        "bool" | "boolean" => text!("fault-wanted-flag"),
        "sequence" => text!("fault-wanted-list"),
        name if name == "map" || name.starts_with("struct ") => text!("fault-wanted-table"),
        _ => Text::verbatim(words),
    }
}

/// The messages for the syntax errors of `toml_parser`, by their descriptions there.
const SYNTAX: &[(&str, &[&str])] = &[
    ("fault-key-twice", &["duplicate key"]),
    ("fault-syntax-equals", &["extra `=`"]),
    (
        "fault-syntax-no-equals",
        &[
            "key with no value",
            "missing assignment between key-value pairs",
        ],
    ),
    (
        "fault-syntax-value",
        &[
            "string values must be quoted",
            "missing value for key",
            "missing value",
            "missing opening quote",
            "invalid boolean",
            "invalid string",
        ],
    ),
    (
        "fault-syntax-list",
        &[
            "missing comma between array elements",
            "unexpected `=` in array",
            "unclosed array",
        ],
    ),
    (
        "fault-syntax-inline",
        &[
            "missing comma between key-value pairs",
            "extra assignment between key-value pairs",
            "unclosed inline table",
        ],
    ),
    (
        "fault-syntax-comma",
        &["extra comma in array", "extra comma in inline table"],
    ),
    (
        "fault-syntax-heading",
        &["unclosed table", "unclosed array table"],
    ),
    (
        "fault-syntax-key",
        &[
            "missing key for inline table element",
            "unquoted keys cannot be empty",
            "invalid unquoted key",
            "invalid key-value pair",
            "invalid table",
            "invalid array table",
            "keys cannot be multi-line basic strings",
            "keys cannot be multi-line literal strings",
        ],
    ),
    (
        "fault-syntax-text",
        &[
            "invalid basic string",
            "invalid literal string",
            "invalid multi-line basic string",
            "invalid multi-line literal string",
        ],
    ),
    (
        "fault-syntax-escape",
        &[
            "missing escaped value",
            "too few unicode value digits",
            "invalid value",
        ],
    ),
    (
        "fault-syntax-unexpected",
        &[
            "missing table open",
            "missing array opening",
            "missing inline table opening",
            "invalid inline table element",
            "unexpected key or value",
            "unexpected content",
        ],
    ),
    (
        "fault-syntax-control",
        &[
            "invalid comment character",
            "missing comment start",
            "unexpected content between comment and newline",
            "carriage return must be followed by newline",
        ],
    ),
    (
        "fault-syntax-deep",
        &[
            "recursion limit",
            "cannot recurse further; max recursion depth met",
        ],
    ),
    (
        "fault-syntax-number",
        &[
            "invalid integer number",
            "invalid hexadecimal number",
            "invalid octal number",
            "invalid binary number",
            "invalid float",
            "unexpected leading zero",
            "unexpected sign",
            "redundant numeric sign",
            "redundant integer number prefix",
            "radix must be lowercase",
            "integers with a radix cannot be signed",
            "`_` may only go between digits",
        ],
    ),
    (
        "fault-syntax-date",
        &[
            "invalid date-time",
            "invalid datetime",
            "invalid date",
            "invalid time",
            "invalid offset",
        ],
    ),
];

/// The text for a description of a syntax error; `None` if it is not known here.
fn syntax(fault: &str) -> Option<Text> {
    if fault.starts_with("cannot extend value of type") {
        return Some(text!("fault-syntax-extend"));
    }
    let (id, _) = SYNTAX.iter().find(|(_, known)| known.contains(&fault))?;
    Some(Text::new(*id, Vec::new()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::{Language, Locale};

    /// A table for faults of the TOML reader.
    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only the faults count")]
    struct Table {
        brief: f64,
        state: Option<State>,
        none: Option<Nothing>,
        pair: Option<[u32; 2]>,
        name: Option<String>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum State {
        On,
        Off,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Nothing {}

    fn fault(source: &str) -> Diagnostic {
        let error = toml::from_str::<Table>(source).expect_err(source);
        Diagnostic::from_toml(&error)
    }

    #[test]
    fn messages_of_the_toml_reader_are_texts() {
        let known = "brief, state, none, pair, name";
        for (source, words) in [
            (
                "brief = 1\nblink = 1",
                text!("fault-key-unexpected", name = "blink", known = known),
            ),
            (
                "brief = 1\nnone = { x = 1 }",
                text!("fault-key-none", name = "x"),
            ),
            (
                "brief = 1\nstate = \"up\"",
                text!("fault-value-unknown", name = "up", known = "on, off"),
            ),
            ("", text!("fault-key-missing", name = "brief")),
            ("brief = 1\nbrief = 2", text!("fault-key-twice")),
            ("brief = = 1", text!("fault-syntax-equals")),
        ] {
            assert_eq!(fault(source).message, words, "{source}");
        }
    }

    #[test]
    fn types_are_named_in_plain_words() {
        for (source, words) in [
            (
                "brief = \"8, expected 9\"",
                "expected a number, not the text \"8, expected 9\"",
            ),
            ("brief = true", "expected a number, not `true`"),
            ("brief = []", "expected a number, not a list"),
            ("brief = { x = 1 }", "expected a number, not a table"),
            (
                "brief = 1\npair = [1, -2]",
                "expected a whole number, 0 or more, not `-2`",
            ),
            ("brief = 1\nname = 7", "expected text in quotes, not `7`"),
            (
                "brief = 1\npair = [1]",
                "expected a list of 2 elements, not 1",
            ),
        ] {
            assert_eq!(fault(source).message.to_string(), words, "{source}");
        }
    }

    /// A newer version of the reader may have other words; then they belong in the tables above.
    #[test]
    fn no_words_of_the_toml_reader_are_left_in_ukrainian() {
        let locale = Locale::new(Language::Ukrainian);
        for source in [
            "brief = = 1",
            "brief",
            "brief 1",
            "brief =",
            "brief = 0 0",
            "brief = long",
            "brief = tru",
            "brief = 010",
            "brief = 1.5.2",
            "brief = 1__0",
            "brief = 0xZ",
            "brief = +-1",
            "brief = 1979-13-01",
            "brief = 1979-01-01T25:00:00",
            "name = \"open",
            "name = 'open",
            "name = \"\"\"open",
            "name = \"\\q\"",
            "name = \"\\u12\"",
            "pair = [1",
            "pair = [1 2]",
            "pair = [1,, 2]",
            "pair = [1] ]",
            "none = { x = 1",
            "none = { x = 1 y = 2 }",
            "none = { x = 1,, y = 2 }",
            "none = { x }",
            "none = { = 1 }",
            "= 1",
            "[none",
            "[[none]",
            "[]",
            "none]",
            "[none] x = 1",
            "brief = 1 # \u{1}",
            "brief = 1\nbrief.x = 2",
            "brief = 1\nbrief = 2",
            "[none]\n[none]",
            "pair = [1]\n[[pair]]",
            "naïve = 1",
            "brief = true",
            "pair = 1",
            "brief = 1\npair = 1",
            "brief = 1\npair = [1]",
            "brief = 1\nnone = 1",
            "brief = 1\nstate = 1",
        ] {
            let said = locale.text(&fault(source).message);
            let named = said.split(['`', '"']).step_by(2).collect::<String>();
            let is_english = |word: &str| word.len() > 2 && word.is_ascii();
            let left: Vec<&str> = named
                .split(|c: char| !c.is_alphabetic())
                .filter(|word| is_english(word) && *word != "TOML")
                .collect();
            assert!(left.is_empty(), "{source}: {said}");
        }
    }
}
