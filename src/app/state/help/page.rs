//! The page that shows the help: where it is scrolled to, and what is searched for.
//!
//! It is apart because it is the only part of the help that changes while it is read.

use super::help_lines;
use super::line::HelpLine;
use super::scene::HelpScene;
use crate::app::keymap::latin_line;
use crate::text::Locale;

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

    /// The lines of the help that match the search; if none does, those that match it as typed in another keyboard
    /// layout.
    pub fn lines(&self, scene: HelpScene<'_>, locale: &Locale) -> Vec<HelpLine> {
        let lines = help_lines(scene, locale);
        if self.search.is_empty() {
            return lines;
        }
        let as_typed = found(&lines, &self.search);
        match latin_line(&self.search) {
            Some(read) if as_typed.is_empty() => found(&lines, &read),
            _ => as_typed,
        }
    }

    /// The indices of the titles among [`lines`](Self::lines).
    pub fn titles(&self, scene: HelpScene<'_>, locale: &Locale) -> Vec<usize> {
        let lines = self.lines(scene, locale).into_iter().enumerate();
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
            HelpLine::Title(words) | HelpLine::Note(words) | HelpLine::Usage(words) => {
                words.clone()
            }
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
        let is_note = |line: &HelpLine| matches!(line, HelpLine::Note(_) | HelpLine::Usage(_));
        // The usages of a verb share the notes below the last of them.
        let is_bare = |line: &HelpLine| match line {
            HelpLine::Entry(_, meaning) => meaning.is_empty(),
            HelpLine::Title(_) | HelpLine::Note(_) | HelpLine::Usage(_) | HelpLine::Blank => false,
        };
        let parts = entries.chunk_by(|line, next| is_note(next) || is_bare(line));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::keymap::Keymap;
    use crate::app::room_list::Room;
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
                entry("up M", ""),
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
        assert_eq!(places("CLIMB"), [4, 5, 6, 7]);
        assert_eq!(places("take"), [0, 2, 4, 5, 6, 7]);
        assert_eq!(places("commands"), [4, 5, 6, 7, 8]);
        assert_eq!(places("hover"), [0; 0]);
    }

    #[test]
    fn a_search_in_the_ukrainian_layout_is_read_by_its_keys() {
        let keymap = Keymap::default();
        let locale = Locale::new(Language::English);
        let lines = |search: &str| {
            let page = HelpPage {
                search: search.to_owned(),
                ..HelpPage::default()
            };
            page.lines(HelpScene::of_flight(&keymap, Room::Fly), &locale)
        };
        assert!(!lines("goto").is_empty());
        assert_eq!(lines("пщещ"), lines("goto"));
        assert!(lines("злетіти").is_empty());
    }

    #[test]
    fn commands_come_before_the_keys_of_other_rooms() {
        let locale = Locale::new(Language::English);
        let page = HelpPage::default();
        let keymap = Keymap::default();
        let scene = HelpScene::of_flight(&keymap, Room::Fly);
        let (lines, titles) = (page.lines(scene, &locale), page.titles(scene, &locale));
        let commands = HelpLine::Title(locale.say("help-commands"));
        let at = titles.iter().position(|&line| lines[line] == commands);
        assert_eq!(
            at,
            Some(2),
            "after the keys of the room and those of all rooms"
        );
    }
}
