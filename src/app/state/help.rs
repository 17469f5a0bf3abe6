//! The help, generated from the keymap and the verb table.

use unicode_width::UnicodeWidthStr as _;

use crate::app::keymap::{Keymap, Meaning, Place};
use crate::app::room_list::Room;
use crate::language::{Channel, VerbRow, rows};
use crate::text;
use crate::text::{Locale, Text, wrap};

/// The maximum number of columns of a usage with an explanation beside it.
pub const SHORT_USAGE: usize = 22;

/// The maximum number of columns of such an explanation.
const SHORT_SUMMARY: usize = 49;
/// The width of a usage that has a line to itself.
const USAGE_WIDTH: usize = 64;
/// The maximum number of columns of a note.
const NOTE_WIDTH: usize = 66;

/// One line of the help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HelpLine {
    Title(String),
    /// A key or a command, and what it does.
    Entry(String, String),
    /// An explanation below an entry.
    Note(String),
    Blank,
}

/// The state of the help.
#[derive(Debug, Clone, Default)]
pub struct HelpPage {
    /// The first line shown.
    pub(in crate::app) scroll: usize,
    pub(in crate::app) search: String,
    /// Whether the search text is being typed.
    pub(in crate::app) is_searching: bool,
}

impl HelpPage {
    /// The first line shown.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    pub fn search(&self) -> &str {
        &self.search
    }

    /// Whether the search text is being typed.
    pub fn is_searching(&self) -> bool {
        self.is_searching
    }

    /// The lines of the help that match the search.
    pub fn lines(&self, keymap: &Keymap, here: Room, locale: &Locale) -> Vec<HelpLine> {
        let lines = help_lines(keymap, here, locale);
        if self.search.is_empty() {
            return lines;
        }
        found(&lines, &self.search)
    }

    /// The indices of the titles among those lines.
    pub fn titles(&self, keymap: &Keymap, here: Room, locale: &Locale) -> Vec<usize> {
        let lines = self.lines(keymap, here, locale).into_iter().enumerate();
        let titles = lines.filter(|(_, line)| matches!(line, HelpLine::Title(_)));
        titles.map(|(at, _)| at).collect()
    }
}

/// The matching part of each section under its title: an entry keeps the notes below it, and a matching title keeps
/// its whole section.
fn found(lines: &[HelpLine], text: &str) -> Vec<HelpLine> {
    let wanted = text.to_lowercase();
    let holds = |line: &HelpLine| {
        let words = match line {
            HelpLine::Title(words) | HelpLine::Note(words) => words.clone(),
            HelpLine::Entry(what, meaning) => format!("{what} {meaning}"),
            HelpLine::Blank => String::new(),
        };
        words.to_lowercase().contains(&wanted)
    };
    let mut found = Vec::new();
    for section in lines.split(|line| *line == HelpLine::Blank) {
        let Some((title, entries)) = section.split_first() else {
            continue;
        };
        let is_note = |line: &HelpLine| matches!(line, HelpLine::Note(_));
        let parts = entries.chunk_by(|_, next| is_note(next));
        let hits: Vec<HelpLine> = parts
            .filter(|part| holds(title) || part.iter().any(holds))
            .flatten()
            .cloned()
            .collect();
        if !hits.is_empty() {
            found.push(title.clone());
            found.extend(hits);
            found.push(HelpLine::Blank);
        }
    }
    found
}

/// The whole help in a language; the current room comes first, its keys and then the commands.
pub fn help_lines(keymap: &Keymap, here: Room, locale: &Locale) -> Vec<HelpLine> {
    let nearby = [Place::In(here), Place::Anywhere];
    let elsewhere = Place::all().filter(|place| !nearby.contains(place));
    let section = |place: Place| -> Vec<HelpLine> {
        let keys = keys(keymap, place, locale);
        if keys.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![HelpLine::Title(locale.text(&place.title()))];
        lines.extend(keys);
        lines.push(HelpLine::Blank);
        lines
    };
    let mut lines: Vec<HelpLine> = nearby.into_iter().flat_map(section).collect();
    lines.extend(command_help(Channel::Screen, locale));
    lines.push(HelpLine::Blank);
    lines.extend(elsewhere.flat_map(section));
    lines
}

/// The part of the help about commands.
pub fn command_help(channel: Channel, locale: &Locale) -> Vec<HelpLine> {
    let title = |text: Text| HelpLine::Title(locale.text(&text));
    let mut lines = vec![title(text!("help-commands"))];
    lines.extend(notes(&locale.say("help-targets")));
    let explained = |row: &VerbRow| explained(&row.usage(), &locale.text(&row.summary()));
    let sayable = rows().filter(|row| row.scope.includes(channel));
    let (to_vehicles, own): (Vec<&VerbRow>, Vec<&VerbRow>) =
        sayable.partition(|row| row.scope.takes_targets());
    lines.extend(to_vehicles.into_iter().flat_map(explained));
    lines.push(HelpLine::Blank);
    lines.push(title(text!("help-console")));
    lines.extend(own.into_iter().flat_map(explained));
    lines
}

/// A verb with its summary beside its usage, or below if one of them is long.
fn explained(usages: &[String], summary: &str) -> Vec<HelpLine> {
    if let [usage] = usages
        && usage.width() <= SHORT_USAGE
        && summary.width() <= SHORT_SUMMARY
    {
        return vec![HelpLine::Entry(usage.clone(), summary.to_owned())];
    }
    let mut lines: Vec<HelpLine> = usages.iter().flat_map(|usage| alone(usage)).collect();
    lines.extend(notes(summary));
    lines
}

/// A usage on separate lines.
fn alone(usage: &str) -> Vec<HelpLine> {
    let parts = wrap(usage, USAGE_WIDTH);
    let indents = std::iter::once("").chain(std::iter::repeat("    "));
    let lines = indents.zip(parts);
    lines
        .map(|(indent, part)| HelpLine::Entry(format!("{indent}{part}"), String::new()))
        .collect()
}

/// A text wrapped to the width of notes.
fn notes(text: &str) -> Vec<HelpLine> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.width() + word.width() < NOTE_WIDTH => {
                if !line.is_empty() {
                    line.push(' ');
                }
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.into_iter().map(HelpLine::Note).collect()
}

/// The keys of a place; keys with one meaning share a line.
fn keys(keymap: &Keymap, place: Place, locale: &Locale) -> Vec<HelpLine> {
    let mut rows: Vec<(String, &Meaning)> = Vec::new();
    let here = keymap
        .bindings()
        .iter()
        .filter(|binding| binding.place == place);
    for binding in here {
        let same = |(_, known): &&mut (String, &Meaning)| **known == binding.meaning;
        match rows.iter_mut().find(same) {
            Some((labels, _)) => {
                labels.push(' ');
                labels.push_str(&binding.press.label());
            }
            None => rows.push((binding.press.label(), &binding.meaning)),
        }
    }
    let lines = rows.into_iter();
    lines
        .map(|(labels, meaning)| HelpLine::Entry(labels, locale.text(&keymap.description(meaning))))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;

    #[test]
    fn a_search_keeps_entries_with_their_notes_below_the_titles_of_their_sections() {
        let lines = || {
            let entry = |what: &str, meaning: &str| HelpLine::Entry(what.into(), meaning.into());
            vec![
                HelpLine::Title("keys".into()),
                entry("a", "arm"),
                entry("t", "take off"),
                HelpLine::Blank,
                HelpLine::Title("commands".into()),
                entry("takeoff M", ""),
                HelpLine::Note("climb straight up".into()),
                entry("land", "come down"),
                HelpLine::Blank,
            ]
        };
        let places = |text: &str| -> Vec<usize> {
            let lines = lines();
            let kept = found(&lines, text).into_iter();
            let kept = kept.filter(|line| *line != HelpLine::Blank);
            let place = |line| lines.iter().position(|known| *known == line);
            kept.filter_map(place).collect()
        };
        assert_eq!(places("CLIMB"), [4, 5, 6]);
        assert_eq!(places("take"), [0, 2, 4, 5, 6]);
        assert_eq!(places("commands"), [4, 5, 6, 7]);
        assert_eq!(places("hover"), [0; 0]);
    }

    #[test]
    fn commands_come_before_the_keys_of_other_rooms() {
        let locale = Locale::new(Language::English);
        let page = HelpPage::default();
        let lines = page.lines(&Keymap::default(), Room::Fly, &locale);
        let titles = page.titles(&Keymap::default(), Room::Fly, &locale);
        let commands = HelpLine::Title(locale.say("help-commands"));
        let at = titles.iter().position(|&line| lines[line] == commands);
        assert_eq!(
            at,
            Some(2),
            "after the keys of the room and those of all rooms"
        );
    }

    #[test]
    fn the_keys_of_the_room_come_first_and_no_line_is_cut() {
        for language in Language::ALL {
            let locale = Locale::new(language);
            let lines = help_lines(&Keymap::default(), Room::Ledger, &locale);
            let title = locale.text(&Place::In(Room::Ledger).title());
            assert_eq!(lines[0], HelpLine::Title(title));
            for line in lines {
                if let HelpLine::Entry(what, _) = &line {
                    assert!(what.width() <= NOTE_WIDTH + 4, "{line:?}");
                }
                if let HelpLine::Entry(what, meaning) = &line
                    && !meaning.is_empty()
                {
                    let used = what.width().max(SHORT_USAGE) + meaning.width();
                    assert!(used <= SHORT_USAGE + SHORT_SUMMARY, "{line:?}");
                }
            }
        }
    }
}
