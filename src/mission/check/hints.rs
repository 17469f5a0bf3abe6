//! Whether hints give away too much.

use super::Examined;
use crate::language::verbs;
use crate::text;
use crate::vehicle_id::parse_ranges;

/// Reports hints of the first level that contain a whole command.
pub(super) fn check(examined: &mut Examined<'_>) {
    let mission = examined.mission;
    let written = examined.tables("hints").iter();
    let asked = written.filter(|hint| hint.get("level").is_some());
    for (clue, written) in mission.advice.clues.iter().zip(asked) {
        if clue.level == 1
            && let Some(line) = command_line(&clue.text.to_string())
        {
            let fault = text!("check-hint-question", line = line);
            examined.add(written.span_of("text"), fault);
        }
    }
}

/// The first text in backticks that begins with a verb, with or without targets.
fn command_line(text: &str) -> Option<String> {
    let quoted = text.split('`').skip(1).step_by(2);
    let is_target =
        |word: &str| word == "all" || word.starts_with('@') || parse_ranges(word).is_ok();
    let is_verb = |word: &str| {
        let mut names = verbs().map(|verb| verb.name);
        names.any(|name| name.split(' ').next() == Some(word))
    };
    let is_line = |part: &&str| {
        let mut words = part.split_whitespace().skip_while(|word| is_target(word));
        let verb = words.next();
        // A single word, such as a mode, is a name; a command has several words.
        verb.is_some_and(is_verb) && part.split_whitespace().count() > 1
    };
    quoted.into_iter().find(is_line).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_told_from_words_and_places() {
        for (text, line) in [
            ("Fly to `peak`, slowly.", None),
            ("It is `accepted`, then look at `gate1`.", None),
            ("Say `goto gate1 up 20` next.", Some("goto gate1 up 20")),
            ("Say `1-3 goto c1`.", Some("1-3 goto c1")),
            ("`all rtl` ends it.", Some("all rtl")),
        ] {
            assert_eq!(command_line(text).as_deref(), line, "{text}");
        }
    }

    #[test]
    fn a_first_hint_that_is_a_command_line_is_a_fault() {
        let source = include_str!("../../../missions/00-first-flight.toml");
        let (before, rest) = source.split_once("level = 1\ntext = \"").expect("a hint");
        let mission = format!("{before}level = 1\ntext = \"`all arm`: {rest}");
        let mission = crate::mission::Mission::parse(&mission).expect("it can be read");
        let found = mission.check();
        assert!(
            found
                .iter()
                .any(|it| it.message.to_string().contains("`all arm`")),
            "{found:?}"
        );
    }
}
