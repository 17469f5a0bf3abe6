//! Every text in every language.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use fluent_syntax::ast::{Entry, Expression, InlineExpression, Pattern, PatternElement};
use sortie::app::action::Action;
use sortie::app::state::Room;
use sortie::language::rows;
use sortie::moment::{Alignment, MomentKind};
use sortie::text::{Language, Locale, messages};

/// The variables of each message of a language, by id.
fn catalogue(language: Language) -> BTreeMap<String, BTreeSet<String>> {
    let mut found = BTreeMap::new();
    for (area, source) in messages(language) {
        let resource = fluent_syntax::parser::parse(*source)
            .unwrap_or_else(|(_, errors)| panic!("{area} ({language:?}): {errors:?}"));
        for entry in &resource.body {
            let Entry::Message(message) = entry else {
                continue;
            };
            let mut variables = BTreeSet::new();
            let value = message.value.as_ref().expect("a value");
            pattern(value, &mut variables);
            let id = message.id.name.to_owned();
            assert!(
                found.insert(id.clone(), variables).is_none(),
                "{id} is there twice ({language:?})"
            );
        }
    }
    found
}

fn pattern(pattern: &Pattern<&str>, variables: &mut BTreeSet<String>) {
    for element in &pattern.elements {
        if let PatternElement::Placeable { expression } = element {
            expressed(expression, variables);
        }
    }
}

fn expressed(expression: &Expression<&str>, variables: &mut BTreeSet<String>) {
    match expression {
        Expression::Inline(inline) => inlined(inline, variables),
        Expression::Select { selector, variants } => {
            inlined(selector, variables);
            for variant in variants {
                pattern(&variant.value, variables);
            }
        }
    }
}

fn inlined(inline: &InlineExpression<&str>, variables: &mut BTreeSet<String>) {
    match inline {
        InlineExpression::VariableReference { id } => {
            variables.insert(id.name.to_owned());
        }
        InlineExpression::Placeable { expression } => expressed(expression, variables),
        _ => {}
    }
}

/// All sources of the program, without tests.
fn sources() -> String {
    fn collect(folder: &Path, text: &mut String) {
        for entry in fs::read_dir(folder).expect("readable").flatten() {
            let path = entry.path();
            if path.is_dir() {
                collect(&path, text);
            } else if path.extension().is_some_and(|ending| ending == "rs")
                && path.file_stem().is_some_and(|stem| stem != "tests")
            {
                let source = fs::read_to_string(&path).expect("readable");
                let is_code = |line: &&str| !line.trim_start().starts_with("//");
                let lines: Vec<&str> = source.lines().filter(is_code).collect();
                let source = lines.join("\n");
                text.push_str(
                    source
                        .split("#[cfg(test)]\nmod tests {")
                        .next()
                        .unwrap_or_default(),
                );
            }
        }
    }
    let mut text = String::new();
    collect(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("src"),
        &mut text,
    );
    text
}

/// The ids of the messages that the sources name with `text!` or `say`, with the variables that they pass.
fn named(sources: &str) -> Vec<(String, Option<BTreeSet<String>>)> {
    let mut found = Vec::new();
    for (opening, has_variables) in [
        ("text!(", true),
        ("look.say(", false),
        ("panel.say(", false),
        ("locale.say(", false),
    ] {
        for (at, _) in sources.match_indices(opening) {
            let rest = sources[at + opening.len()..].trim_start();
            let Some(rest) = rest.strip_prefix('"') else {
                continue;
            };
            let (id, rest) = rest.split_once('"').expect("a closed string");
            let variables = has_variables.then(|| handed_over(rest));
            found.push((id.to_owned(), variables));
        }
    }
    found
}

/// The names before `=` at the outermost level of a macro's arguments.
fn handed_over(arguments: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let (mut depth, mut quoted, mut part) = (0, false, String::new());
    for c in arguments.chars() {
        match c {
            '"' => quoted = !quoted,
            '(' | '[' | '{' if !quoted => depth += 1,
            ')' if !quoted && depth == 0 => break,
            ')' | ']' | '}' if !quoted => depth -= 1,
            _ => {}
        }
        if c == ',' && depth == 0 && !quoted {
            names.extend(name(&part));
            part.clear();
        } else {
            part.push(c);
        }
    }
    names.extend(name(&part));
    names
}

fn name(part: &str) -> Option<String> {
    let (name, _) = part.split_once('=')?;
    Some(name.trim().to_owned())
}

/// Ids that are built from the names in tables.
fn from_tables() -> BTreeSet<String> {
    let actions = Action::all().map(|action| format!("action-{}", action.name()));
    let rooms = Room::ALL.iter().map(|room| format!("room-{}", room.name()));
    let reasons = rows().flat_map(|row| row.verb.unsuited);
    let reasons = reasons.map(|unsuited| unsuited.reason.to_owned());
    let summaries = rows().map(|row| format!("verb-{}", row.name()));
    let forms = rows().flat_map(|row| row.forms);
    let arguments = forms.flat_map(|form| form.arguments);
    let meanings = arguments.map(|argument| argument.help.to_owned());
    actions
        .chain(rooms)
        .chain(reasons)
        .chain(summaries)
        .chain(
            MomentKind::NAMES
                .iter()
                .map(|name| format!("moment-kind-{name}")),
        )
        .chain(
            Alignment::NAMES
                .iter()
                .map(|name| format!("alignment-{name}")),
        )
        .chain(meanings.filter(|id| !id.is_empty()))
        .collect()
}

/// Text on the line of a heading becomes a part of the heading.
#[test]
fn headings_of_comments_stand_alone() {
    let sources = sources();
    let lines = sources.lines().map(str::trim_start);
    let joined =
        lines.filter(|line| line.starts_with("/// # Errors ") || line.starts_with("/// # Panics "));
    assert_eq!(joined.collect::<Vec<_>>(), [""; 0]);
}

#[test]
fn no_message_is_missing_in_any_language() {
    let english = catalogue(Language::English);
    for language in Language::ALL {
        let translated = catalogue(language);
        let ids = |all: &BTreeMap<String, _>| all.keys().cloned().collect::<BTreeSet<String>>();
        let (known, there) = (ids(&english), ids(&translated));
        let missing: Vec<_> = known.symmetric_difference(&there).collect();
        assert!(missing.is_empty(), "in one language only: {missing:?}");
        for (id, variables) in &english {
            assert_eq!(
                variables, &translated[id],
                "variables of {id} in {language:?}"
            );
        }
    }
}

#[test]
fn every_message_that_the_program_names_is_there_with_its_variables() {
    let english = catalogue(Language::English);
    let named = named(&sources());
    assert!(named.len() > 20, "the scan works: {}", named.len());
    for (id, variables) in named {
        let Some(known) = english.get(&id) else {
            panic!("the message {id} is named, but in no catalogue");
        };
        if let Some(variables) = variables {
            assert_eq!(known, &variables, "variables of {id}");
        }
    }
    for id in from_tables() {
        assert!(english.contains_key(&id), "{id} is in no catalogue");
    }
}

#[test]
fn the_reasons_why_a_verb_does_not_suit_use_their_own_variables_only() {
    let catalogue = catalogue(Language::English);
    let given = ["kind", "vehicle", "verb"];
    for unsuited in rows().flat_map(|row| row.verb.unsuited) {
        let variables = &catalogue[unsuited.reason];
        let is_given = |it: &String| given.contains(&it.as_str());
        assert!(variables.iter().all(is_given), "{}", unsuited.reason);
    }
}

#[test]
fn no_message_is_left_that_nobody_says() {
    let sources = sources();
    // A verb may have synonyms.
    let synonyms: BTreeSet<String> = rows().map(|row| format!("words-{}", row.name())).collect();
    // The text between two quotation marks.
    let quoted: BTreeSet<&str> = sources.split('"').collect();
    let tables = from_tables();
    for id in catalogue(Language::English).keys() {
        let said = quoted.contains(id.as_str()) || tables.contains(id) || synonyms.contains(id);
        assert!(said, "nobody says {id}");
    }
}

#[test]
fn no_word_of_a_message_breaks_a_line_of_the_screen() {
    for language in Language::ALL {
        let locale = Locale::new(language);
        for id in catalogue(language).keys() {
            let words = locale.say(id);
            let fault = words.contains(|c: char| c.is_control() && c != '\n');
            assert!(
                !fault && words == words.trim(),
                "{id} in {language:?}: {words:?}"
            );
        }
    }
}

/// Messages that name a key which no keymap changes: the answer to a question, and the plain console, which has no
/// keymap.
const FIXED_KEYS: &[&str] = &["ask-taken-back", "plain-asks"];
/// Messages whose words and signs are not keys: articles, and the signs of legends and of the
/// grammar.
const SIGN_LEGENDS: &[&str] = &["debrief-timeline", "standing-chart", "verb-int", "grammar-"];

/// The keys that a message names literally, without the keymap.
fn literal_keys(text: &str) -> Vec<&str> {
    let is_named = |word: &str| {
        let names = ["Enter", "Esc", "Tab", "Space", "Backspace", "PgUp", "PgDn"];
        names.contains(&word) || word.starts_with("Ctrl-")
    };
    // A letter at the beginning of a clause, before a verb: `x acknowledges`, `no name fits: o shows all`.
    let clauses = text.split([':', ';', '(', '.']);
    let letters = clauses.filter_map(|clause| {
        let (word, rest) = clause.trim_start().split_once(' ')?;
        let is_letter = word.len() == 1 && word.chars().all(|c| c.is_ascii_alphabetic());
        let is_verb = rest.starts_with(char::is_lowercase);
        (is_letter && is_verb && !["a", "A", "I"].contains(&word)).then_some(word)
    });
    let words = text.split(|c: char| c.is_whitespace() || ",.:;()".contains(c));
    words.filter(|word| is_named(word)).chain(letters).collect()
}

#[test]
fn no_message_names_a_key_that_a_keymap_could_change() {
    for language in Language::ALL {
        for (_, source) in messages(language) {
            for line in source.lines().filter(|line| !line.starts_with('#')) {
                let (id, text) = line.split_once('=').unwrap_or(("", line));
                let id = id.trim();
                let is_legend = SIGN_LEGENDS.iter().any(|known| id.starts_with(known));
                if FIXED_KEYS.contains(&id) || is_legend {
                    continue;
                }
                let keys = literal_keys(text);
                assert!(keys.is_empty(), "{keys:?} in {language:?}: {line}");
            }
        }
    }
    assert_eq!(literal_keys("x acknowledges"), ["x"]);
    assert_eq!(literal_keys("none fits: Esc shows all"), ["Esc"]);
    assert_eq!(literal_keys("{ $key } shows a list"), [""; 0]);
}

/// Phrases that docs/style.md forbids, except those that are wrong only in some uses.
const FORBIDDEN: [&str; 13] = [
    "nobody",
    "somebody",
    "it is told",
    "there are not",
    "there is none that",
    "in vain",
    "for nothing",
    "stands at",
    "turns it round",
    "takes it back",
    "goes calm",
    "would break off",
    "because nothing else was said",
];

#[test]
fn no_message_contains_a_forbidden_phrase() {
    let style = include_str!("../../docs/style.md");
    for phrase in FORBIDDEN {
        assert!(style.contains(phrase), "{phrase}");
    }
    for (area, source) in messages(Language::English) {
        for line in source.lines().filter(|line| !line.starts_with('#')) {
            let said = line.split_once(" = ").map_or(line, |(_, value)| value);
            let said = said.to_lowercase();
            let found = FORBIDDEN.iter().find(|phrase| said.contains(*phrase));
            assert_eq!(found, None, "{area}: {line}");
        }
    }
}
