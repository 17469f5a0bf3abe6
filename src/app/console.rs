//! What the command line can do besides commanding vehicles: a small table beside the verbs.

use std::ops::Range;

use crate::diagnostic::Diagnostic;
use crate::language::Completion;
use crate::text;

pub mod swarm;

use swarm::{SwarmLine, SwarmVerb};

/// One thing the console itself can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConsoleVerb {
    /// How it is called.
    pub name: &'static str,
    /// How it is written.
    pub usage: &'static str,
    /// What it does.
    pub summary: &'static str,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Select,
    Group,
    Theme,
    Params,
    Swarm(SwarmVerb),
    Plain(Deed),
}

impl Kind {
    /// How many words may follow.
    fn most_arguments(self) -> usize {
        match self {
            Self::Plain(_) | Self::Params => 0,
            Self::Group => 2,
            Self::Swarm(SwarmVerb::Filter | SwarmVerb::Columns) => usize::MAX,
            Self::Select | Self::Theme | Self::Swarm(_) => 1,
        }
    }
}

/// A line that the console carries out itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ConsoleLine {
    /// Select these vehicles.
    Select(String),
    /// Give vehicles a group's name; no targets means the selection.
    Group {
        /// The name, without `@`.
        name: String,
        /// The targets as they were written.
        targets: String,
    },
    /// Draw with a theme.
    Theme(String),
    /// Something about the parameters of the vehicle under the cursor.
    Params(ParamsDeed),
    /// One about the table or its alerts.
    Swarm(SwarmLine),
    /// One without arguments.
    Plain(Deed),
}

/// What the console does with parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ParamsDeed {
    /// Shows them.
    Show,
    /// Asks the vehicle for all of them again.
    Fetch,
    /// Saves them to a file.
    Save(String),
    /// Loads a file, or compares with one or with another vehicle: first the differences show.
    Compare(String),
}

/// Console lines without arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deed {
    /// Help.
    Help,
    /// The links' counters.
    Links,
    /// All commands.
    Ledger,
    /// All notices.
    Notices,
    /// The mission's brief.
    Brief,
    /// End the mission.
    Abandon,
    /// The same mission again.
    Restart,
    /// Back to the home screen.
    Leave,
    /// Leave the program.
    Quit,
}

/// Everything the console itself can do.
pub const CONSOLE_VERBS: &[ConsoleVerb] = &[
    verb(
        "select",
        "select TARGETS",
        "select vehicles: 1-4,7  @red  all  none  filter  invert",
        Kind::Select,
    ),
    verb(
        "group",
        "group NAME [TARGETS]",
        "call vehicles @NAME from now on",
        Kind::Group,
    ),
    verb(
        "params",
        "params [fetch | save FILE | load FILE | diff FILE|N]",
        "the parameters: ask again, save, load, compare",
        Kind::Params,
    ),
    verb(
        "ungroup",
        "ungroup NAME",
        "forget a group's name",
        Kind::Swarm(SwarmVerb::Ungroup),
    ),
    verb(
        "sort",
        "sort [[-]COLUMN]",
        "order the table; - puts the largest first",
        Kind::Swarm(SwarmVerb::Sort),
    ),
    verb(
        "filter",
        "filter [WORDS]",
        "show only: 1-4  @red  armed  air  alert  bat<30  !land",
        Kind::Swarm(SwarmVerb::Filter),
    ),
    verb(
        "columns",
        "columns [COLUMNS]",
        "the table's columns; none: as many as fit",
        Kind::Swarm(SwarmVerb::Columns),
    ),
    verb(
        "ack",
        "ack [KIND|TARGETS]",
        "take note of the worst alerts, or of these",
        Kind::Swarm(SwarmVerb::Acknowledge),
    ),
    verb(
        "mute",
        "mute [KIND]",
        "alerts of a kind stay silent; none: which are",
        Kind::Swarm(SwarmVerb::Mute),
    ),
    verb(
        "unmute",
        "unmute [KIND]",
        "alerts of a kind ring again; none: all do",
        Kind::Swarm(SwarmVerb::Unmute),
    ),
    verb("theme", "theme NAME", "change the colours", Kind::Theme),
    verb("help", "help", "keys and verbs", Kind::Plain(Deed::Help)),
    verb(
        "links",
        "links",
        "what the links count",
        Kind::Plain(Deed::Links),
    ),
    verb(
        "ledger",
        "ledger",
        "all commands of the session and what became of them",
        Kind::Plain(Deed::Ledger),
    ),
    verb(
        "notices",
        "notices",
        "all that was said in the session",
        Kind::Plain(Deed::Notices),
    ),
    verb(
        "brief",
        "brief",
        "the mission's brief",
        Kind::Plain(Deed::Brief),
    ),
    verb(
        "abandon",
        "abandon",
        "end the mission and see the debrief",
        Kind::Plain(Deed::Abandon),
    ),
    verb(
        "restart",
        "restart",
        "fly the same mission again from its start",
        Kind::Plain(Deed::Restart),
    ),
    verb(
        "leave",
        "leave",
        "end the session, back to the home screen",
        Kind::Plain(Deed::Leave),
    ),
    verb("quit", "quit", "leave the program", Kind::Plain(Deed::Quit)),
];

const fn verb(
    name: &'static str,
    usage: &'static str,
    summary: &'static str,
    kind: Kind,
) -> ConsoleVerb {
    ConsoleVerb {
        name,
        usage,
        summary,
        kind,
    }
}

/// Reads a line that is the console's own; `None` if it is not, so that the grammar of commands may try.
pub fn parse(line: &str, themes: &[String]) -> Option<Result<ConsoleLine, Diagnostic>> {
    let words = words(line);
    let (first, arguments) = words.split_first()?;
    let verb = find(&line[first.clone()])?;
    Some(match verb.kind {
        Kind::Params => params(verb, line, arguments).map(ConsoleLine::Params),
        _ => read(verb, line, arguments, themes),
    })
}

/// The usage of the console's own verb that a line begins with.
pub fn usage(line: &str) -> Option<&'static str> {
    let words = words(line);
    find(&line[words.first()?.clone()]).map(|verb| verb.usage)
}

/// What could stand at the end of the line, if the console itself has something to offer.
pub fn complete(line: &str, cursor: usize, themes: &[String]) -> Vec<Completion> {
    let before = line.get(..cursor).unwrap_or(line);
    let start = last_word(before);
    let (head, word) = before.split_at(start);
    let completion = |text: &str, hint: &str| Completion {
        text: text.to_owned(),
        hint: hint.into(),
        replaces: start..before.len(),
    };
    if head.trim().is_empty() {
        let fitting = CONSOLE_VERBS
            .iter()
            .filter(|verb| verb.name.starts_with(word));
        return fitting
            .map(|verb| completion(verb.name, verb.summary))
            .collect();
    }
    if head.trim() == "params" {
        let deeds = ["fetch", "save", "load", "diff"].into_iter();
        let fitting = deeds.filter(|deed| deed.starts_with(word));
        return fitting.map(|deed| completion(deed, "")).collect();
    }
    let verb = head.split_whitespace().next().and_then(find);
    if let Some(Kind::Swarm(verb)) = verb.map(|verb| verb.kind) {
        let choices = swarm::choices(verb).into_iter();
        let fitting = choices.filter(|choice| choice.starts_with(word));
        return fitting.map(|choice| completion(choice, "")).collect();
    }
    if head.trim() != "theme" {
        return Vec::new();
    }
    let fitting = themes.iter().filter(|theme| theme.starts_with(word));
    fitting.map(|theme| completion(theme, "theme")).collect()
}

/// Where the last word of a text begins. Blanks may be longer than a byte.
pub fn last_word(text: &str) -> usize {
    text.char_indices()
        .rfind(|(_, c)| c.is_whitespace())
        .map_or(0, |(at, blank)| at + blank.len_utf8())
}

fn find(word: &str) -> Option<&'static ConsoleVerb> {
    CONSOLE_VERBS.iter().find(|verb| verb.name == word)
}

/// Where the words of a line lie.
fn words(line: &str) -> Vec<Range<usize>> {
    line.split_whitespace()
        .map(|word| {
            let start = word.as_ptr().addr() - line.as_ptr().addr();
            start..start + word.len()
        })
        .collect()
}

fn read(
    verb: &ConsoleVerb,
    line: &str,
    arguments: &[Range<usize>],
    themes: &[String],
) -> Result<ConsoleLine, Diagnostic> {
    if let Some(extra) = arguments.get(verb.kind.most_arguments()) {
        return Err(
            Diagnostic::new(extra.clone(), "nothing more is expected here")
                .with_help(format!("usage: {}", verb.usage)),
        );
    }
    let text = |at: usize| arguments.get(at).map(|span| line[span.clone()].to_owned());
    let missing = || {
        let end = line.trim_end().len();
        Diagnostic::new(end..end, "something is missing here")
            .with_help(format!("usage: {}", verb.usage))
    };
    match verb.kind {
        Kind::Plain(deed) => Ok(ConsoleLine::Plain(deed)),
        Kind::Params => Ok(ConsoleLine::Params(ParamsDeed::Show)),
        Kind::Swarm(SwarmVerb::Ungroup) if arguments.is_empty() => Err(missing()),
        Kind::Swarm(verb) => {
            let words = arguments.iter();
            let words: Vec<_> = words
                .map(|span| (&line[span.clone()], span.clone()))
                .collect();
            swarm::read(verb, &words).map(ConsoleLine::Swarm)
        }
        Kind::Select => text(0).map(ConsoleLine::Select).ok_or_else(missing),
        Kind::Group => {
            let name = text(0).ok_or_else(missing)?;
            Ok(ConsoleLine::Group {
                name: name.trim_start_matches('@').to_owned(),
                targets: text(1).unwrap_or_default(),
            })
        }
        Kind::Theme => {
            let name = text(0).ok_or_else(missing)?;
            theme(name, arguments[0].clone(), themes)
        }
    }
}

/// The rest of the line after the second word is the file's name, which may have blanks in it.
fn params(
    verb: &ConsoleVerb,
    line: &str,
    arguments: &[Range<usize>],
) -> Result<ParamsDeed, Diagnostic> {
    let [deed, rest @ ..] = arguments else {
        return Ok(ParamsDeed::Show);
    };
    let usage = text!("console-usage", usage = verb.usage);
    let named = || {
        if let (Some(first), Some(last)) = (rest.first(), rest.last()) {
            return Ok(line[first.start..last.end].to_owned());
        }
        let end = line.trim_end().len();
        Err(Diagnostic::new(end..end, text!("parameters-no-path")).with_help(usage.clone()))
    };
    match &line[deed.clone()] {
        "fetch" if rest.is_empty() => Ok(ParamsDeed::Fetch),
        "save" => named().map(ParamsDeed::Save),
        "load" | "diff" => named().map(ParamsDeed::Compare),
        word => {
            let unknown = text!("parameters-no-deed", word = word);
            Err(Diagnostic::new(deed.clone(), unknown).with_help(usage))
        }
    }
}

fn theme(name: String, span: Range<usize>, themes: &[String]) -> Result<ConsoleLine, Diagnostic> {
    if themes.contains(&name) {
        return Ok(ConsoleLine::Theme(name));
    }
    let known = themes.iter().map(String::as_str);
    Err(Diagnostic::new(span, format!("no theme is named `{name}`"))
        .with_help(format!("there are: {}", themes.join(", ")))
        .with_nearest(&name, known))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn themes() -> Vec<String> {
        ["dark", "light"].map(str::to_owned).to_vec()
    }

    #[test]
    fn only_the_consoles_own_lines_are_taken() {
        assert_eq!(parse("1-2 arm", &themes()), None);
        assert_eq!(parse("", &themes()), None);
        assert_eq!(
            parse(" theme  light ", &themes()),
            Some(Ok(ConsoleLine::Theme("light".to_owned())))
        );
        assert_eq!(
            parse("group @red 1-3", &themes()),
            Some(Ok(ConsoleLine::Group {
                name: "red".to_owned(),
                targets: "1-3".to_owned()
            }))
        );
    }

    #[test]
    fn no_verb_of_the_console_hides_one_for_vehicles() {
        for own in CONSOLE_VERBS {
            assert!(crate::language::verb(own.name).is_none(), "{}", own.name);
        }
    }

    #[test]
    fn faults_point_at_the_word() {
        let cases = [("theme drak", 6..10), ("quit now", 5..8), ("select", 6..6)];
        for (line, span) in cases {
            let fault = parse(line, &themes()).expect("its own").expect_err(line);
            assert_eq!(fault.span, span, "{line}");
            assert!(fault.help.is_some(), "{line}");
        }
    }

    #[test]
    fn blanks_longer_than_a_byte_part_words_too() {
        for line in ["arm\u{a0}", "theme\u{3000}l", "\u{2003}"] {
            complete(line, line.len(), &themes());
        }
        assert_eq!(last_word("theme\u{3000}l"), 8);
    }

    #[test]
    fn words_complete_from_their_beginning() {
        let texts = |line: &str| -> Vec<String> {
            let found = complete(line, line.len(), &themes());
            found
                .into_iter()
                .map(|completion| completion.text)
                .collect()
        };
        assert_eq!(texts("th"), ["theme"]);
        assert_eq!(texts("theme l"), ["light"]);
        assert_eq!(texts("1 th"), Vec::<String>::new());
    }
}
