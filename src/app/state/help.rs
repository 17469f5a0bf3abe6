//! The help, generated from the keymap and the verb table.

use unicode_width::UnicodeWidthStr as _;

use crate::app::State;
use crate::app::keymap::{Binding, Keymap, Place, Press, latin_line};
use crate::app::room_list::Room;
use crate::language::{Channel, VerbRow, rows};
use crate::text::{Locale, Text, wrap};

mod replayed;

use replayed::{ReplayUse, is_carried_out, replayed};

/// The maximum number of columns of a usage with an explanation beside it.
pub const SHORT_USAGE: usize = 22;

/// The maximum number of columns of an explanation beside a usage.
const SHORT_SUMMARY: usize = 49;
/// The width of a usage that has a line to itself.
const USAGE_WIDTH: usize = 64;
/// The maximum number of columns of a note.
const NOTE_WIDTH: usize = 66;

/// One line of the help.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HelpLine {
    Title(String),
    /// A key or a command, and its effect.
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

/// The context of the help: keymap, room and kind of session.
#[derive(Debug, Clone, Copy)]
pub struct HelpScene<'a> {
    pub keymap: &'a Keymap,
    pub here: Room,
    /// Whether a recorded flight is shown; it takes no commands.
    pub is_replay: bool,
}

impl State {
    /// The current context of the help.
    pub fn help_scene(&self) -> HelpScene<'_> {
        HelpScene {
            keymap: &self.keymap,
            here: self.room,
            is_replay: self.replay.is_some(),
        }
    }
}

/// The whole help in a language; the keys of the current room come first, and the commands after the general keys. In a
/// replay, the keys that control it come first, and everything without an effect there is left out.
pub fn help_lines(scene: HelpScene<'_>, locale: &Locale) -> Vec<HelpLine> {
    let mut nearby = vec![Place::In(scene.here), Place::Anywhere];
    if scene.is_replay {
        nearby.insert(0, Place::Replay);
    }
    let elsewhere = Place::all().filter(|place| !nearby.contains(place));
    let section = |place: Place| -> Vec<HelpLine> {
        let keys = keys(scene, place, locale);
        if keys.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![HelpLine::Title(locale.text(&place.title()))];
        lines.extend(keys);
        lines.push(HelpLine::Blank);
        lines
    };
    let mut lines: Vec<HelpLine> = nearby.iter().copied().flat_map(section).collect();
    lines.extend(if scene.is_replay {
        console_help(Channel::Screen, is_carried_out, locale)
    } else {
        command_help(Channel::Screen, locale)
    });
    lines.push(HelpLine::Blank);
    lines.extend(elsewhere.flat_map(section));
    lines
}

/// The part of the help about commands.
pub fn command_help(channel: Channel, locale: &Locale) -> Vec<HelpLine> {
    let mut lines = vec![HelpLine::Title(locale.say("help-commands"))];
    lines.extend(notes(&locale.say("help-targets")));
    let to_vehicles = rows().filter(|row| row.scope.includes(channel) && row.scope.takes_targets());
    lines.extend(to_vehicles.flat_map(|row| summarised(row, locale)));
    lines.push(HelpLine::Blank);
    lines.extend(console_help(channel, |_| true, locale));
    lines
}

/// The part of the help about commands to the console itself, for the verbs that `is_wanted`
/// selects.
fn console_help(
    channel: Channel,
    is_wanted: impl Fn(&VerbRow) -> bool,
    locale: &Locale,
) -> Vec<HelpLine> {
    let mut lines = vec![HelpLine::Title(locale.say("help-console"))];
    let own = rows().filter(|row| row.scope.includes(channel) && !row.scope.takes_targets());
    let wanted = own.filter(|row| is_wanted(row));
    lines.extend(wanted.flat_map(|row| summarised(row, locale)));
    lines
}

fn summarised(row: &VerbRow, locale: &Locale) -> Vec<HelpLine> {
    explained(&row.usage(), &locale.text(&row.summary()))
}

/// A verb with its summary beside its usage; the summary is below if either is long.
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

/// A usage without a summary, wrapped to several lines if needed.
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

/// The keys of a place; keys with the same meaning share a line.
fn keys(scene: HelpScene<'_>, place: Place, locale: &Locale) -> Vec<HelpLine> {
    let mut rows: Vec<(String, Text)> = Vec::new();
    for binding in scene.keymap.bindings() {
        let Some(about) = scene.description(binding, place) else {
            continue;
        };
        let label = binding.press.label();
        match rows.iter_mut().find(|(_, known)| *known == about) {
            Some((labels, _)) => {
                labels.push(' ');
                labels.push_str(&label);
            }
            None => rows.push((label, about)),
        }
    }
    let lines = rows.into_iter();
    lines
        .map(|(labels, about)| HelpLine::Entry(labels, locale.text(&about)))
        .collect()
}

impl HelpScene<'_> {
    /// The description of a key in the section of a place; `None` if the key belongs to another
    /// section, or has no effect.
    fn description(&self, binding: &Binding, place: Place) -> Option<Text> {
        let usual = || self.keymap.description(&binding.meaning);
        // The section of general keys lists only those that the current room leaves as they are.
        let is_changed_here = binding.place == Place::Anywhere
            && !self.keymap.is_general(binding.press, Place::In(self.here));
        if is_changed_here {
            return None;
        }
        if !self.is_replay {
            return (binding.place == place).then(usual);
        }
        let is_replaced = binding.place != Place::Replay && self.is_of_replay(binding.press);
        match replayed(&binding.meaning) {
            ReplayUse::Same => (binding.place == place && !is_replaced).then(usual),
            // Such a key controls the replay wherever it is bound.
            ReplayUse::Control(id) => {
                (place == Place::Replay && !is_replaced).then(|| Text::new(id, Vec::new()))
            }
            ReplayUse::None => None,
        }
    }

    /// Whether a replay handles a key before the rooms do.
    fn is_of_replay(&self, press: Press) -> bool {
        let mut bindings = self.keymap.bindings().iter();
        bindings.any(|it| it.place == Place::Replay && it.press == press)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;

    fn flight(keymap: &Keymap, here: Room) -> HelpScene<'_> {
        HelpScene {
            keymap,
            here,
            is_replay: false,
        }
    }

    #[test]
    fn the_help_of_a_replay_begins_with_its_keys_and_leaves_out_what_it_refuses() {
        let locale = Locale::new(Language::English);
        let keymap = Keymap::default();
        let replay = HelpScene {
            is_replay: true,
            ..flight(&keymap, Room::Fly)
        };
        let lines = help_lines(replay, &locale);
        assert_eq!(
            lines[0],
            HelpLine::Title(locale.text(&Place::Replay.title()))
        );
        let end = lines.iter().position(|line| *line == HelpLine::Blank);
        let entries = |lines: &[HelpLine]| -> Vec<(String, String)> {
            let entries = lines.iter().filter_map(|line| match line {
                HelpLine::Entry(what, meaning) => Some((what.clone(), meaning.clone())),
                HelpLine::Title(_) | HelpLine::Note(_) | HelpLine::Blank => None,
            });
            entries.collect()
        };
        let first = entries(&lines[..end.expect("a section")]);
        for (keys, id) in [
            ("p Space", "action-play-replay"),
            (">", "action-replay-faster"),
            ("<", "action-replay-slower"),
            ("m", "action-show-moments"),
        ] {
            let entry = (keys.to_owned(), locale.say(id));
            assert!(first.contains(&entry), "{entry:?}: {first:#?}");
        }
        let all = entries(&lines);
        let verb = |verb: &str| {
            let mut all = all.iter();
            all.any(|(what, meaning)| {
                what.starts_with(&format!("{verb} ")) || meaning.contains(&format!("`{verb}"))
            })
        };
        for carried_out in ["seek", "bookmark", "leave", "macro"] {
            assert!(
                all.iter().any(|(what, _)| what.starts_with(carried_out)),
                "{carried_out}: {all:#?}"
            );
        }
        for refused in ["arm", "takeoff", "rtl", "mode", "inject", "abandon"] {
            assert!(!verb(refused), "{refused}: {all:#?}");
        }
        let pause = locale.say("action-pause-mission");
        assert!(all.iter().all(|(_, meaning)| *meaning != pause), "{all:#?}");
    }

    /// On the home screen, `p` starts practice; in the other rooms it pauses.
    #[test]
    fn each_key_is_listed_once_with_the_meaning_that_it_has_in_the_room() {
        let locale = Locale::new(Language::English);
        let keymap = Keymap::default();
        for room in Room::ALL {
            let scene = flight(&keymap, room);
            let here = [Place::In(room), Place::Anywhere];
            let listed = keymap.bindings().iter().filter(|binding| {
                let mut places = here.iter();
                places.any(|&place| scene.description(binding, place).is_some())
            });
            let presses: Vec<Press> = listed.map(|binding| binding.press).collect();
            for (at, press) in presses.iter().enumerate() {
                assert!(!presses[..at].contains(press), "{room:?}: {press:?}");
            }
        }
        let home = help_lines(flight(&keymap, Room::Home), &locale);
        let pause = locale.say("action-pause-mission");
        let end = home
            .iter()
            .position(|line| *line == HelpLine::Title(locale.say("help-commands")));
        let is_pause =
            |line: &HelpLine| matches!(line, HelpLine::Entry(_, meaning) if *meaning == pause);
        assert!(!home[..end.expect("the commands")].iter().any(is_pause));
    }

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
    fn a_search_in_the_ukrainian_layout_is_read_by_its_keys() {
        let keymap = Keymap::default();
        let locale = Locale::new(Language::English);
        let lines = |search: &str| {
            let page = HelpPage {
                search: search.to_owned(),
                ..HelpPage::default()
            };
            page.lines(flight(&keymap, Room::Fly), &locale)
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
        let scene = flight(&keymap, Room::Fly);
        let (lines, titles) = (page.lines(scene, &locale), page.titles(scene, &locale));
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
            let keymap = Keymap::default();
            let lines = help_lines(flight(&keymap, Room::Ledger), &locale);
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
