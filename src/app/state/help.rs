//! The help, generated from the keymap and the verb table: its sections, and their order.

use crate::app::keymap::Place;
use crate::app::state::member_rights::is_row_of_member;
use crate::language::{Channel, VerbRow, rows};
use crate::text::Locale;

mod desk_keys;
mod line;
mod page;
mod replayed;
mod scene;

use line::{explained, notes};
use replayed::is_carried_out;

pub use desk_keys::DeskView;
pub use line::{HelpLine, SHORT_USAGE};
pub use page::HelpPage;
pub use scene::HelpScene;

/// The whole help in a language; the keys of the current room come first, and the commands after the general keys. In a
/// replay, the keys that control it come first, and everything without an effect there is left out.
pub fn help_lines(scene: HelpScene<'_>, locale: &Locale) -> Vec<HelpLine> {
    let mut nearby = vec![Place::In(scene.here), Place::Anywhere];
    if scene.is_replay {
        nearby.insert(0, Place::Replay);
    }
    let elsewhere = Place::all().filter(|place| !nearby.contains(place) && scene.has(*place));
    let section = |place: Place| -> Vec<HelpLine> {
        let keys = scene.keys(place, locale);
        if keys.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![HelpLine::Title(locale.text(&place.title()))];
        lines.extend(keys);
        lines.push(HelpLine::Blank);
        lines
    };
    let mut lines: Vec<HelpLine> = nearby.iter().copied().flat_map(section).collect();
    lines.extend(if let Some(role) = scene.member {
        commands(Channel::Screen, |row| is_row_of_member(row, role), locale)
    } else if scene.is_replay {
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
    commands(channel, |_| true, locale)
}

/// The part of the help about the commands that `is_wanted` selects.
fn commands(
    channel: Channel,
    is_wanted: impl Fn(&VerbRow) -> bool,
    locale: &Locale,
) -> Vec<HelpLine> {
    let mut lines = vec![HelpLine::Title(locale.say("help-commands"))];
    lines.extend(notes(&locale.say("help-targets")));
    let to_vehicles = rows().filter(|row| row.scope.includes(channel) && row.scope.takes_targets());
    let to_vehicles = to_vehicles.filter(|row| is_wanted(row));
    lines.extend(to_vehicles.flat_map(|row| explained(row, locale)));
    lines.push(HelpLine::Blank);
    lines.extend(console_help(channel, is_wanted, locale));
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
    lines.extend(wanted.flat_map(|row| explained(row, locale)));
    lines
}

#[cfg(test)]
mod tests {
    use unicode_width::UnicodeWidthStr as _;

    use super::line::{NOTE_WIDTH, SHORT_SUMMARY};
    use super::*;
    use crate::app::keymap::Keymap;
    use crate::app::room_list::Room;
    use crate::crew::Role;
    use crate::text::Language;

    #[test]
    fn the_help_of_a_replay_begins_with_its_keys_and_leaves_out_what_it_refuses() {
        let locale = Locale::new(Language::English);
        let keymap = Keymap::default();
        let replay = HelpScene {
            is_replay: true,
            ..HelpScene::of_flight(&keymap, Room::Fly)
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
                HelpLine::Title(_) | HelpLine::Note(_) | HelpLine::Usage(_) | HelpLine::Blank => {
                    None
                }
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

    #[test]
    fn the_help_of_a_desk_has_the_rooms_that_are_there() {
        let locale = Locale::new(Language::English);
        let keymap = Keymap::default();
        let of_flight = HelpScene::of_flight(&keymap, Room::Class);
        let has = |scene: HelpScene<'_>, room: Room| {
            let title = HelpLine::Title(locale.text(&Place::In(room).title()));
            help_lines(scene, &locale).contains(&title)
        };
        let desk = HelpScene {
            is_desk: true,
            ..of_flight
        };
        let replay = HelpScene {
            is_replay: true,
            ..desk
        };
        for room in [Room::Fly, Room::Map, Room::Mission, Room::Parameters] {
            assert!(has(of_flight, room), "{room:?}");
            assert!(!has(desk, room), "{room:?}");
        }
        assert!(has(desk, Room::Class));
        assert!(has(desk, Room::Workshop));
        assert!(has(replay, Room::Map), "a replay has all rooms");
    }

    /// It once listed what the keys write, and those for grades on every page.
    #[test]
    fn the_help_of_a_desk_says_what_the_keys_of_its_page_do() {
        let keymap = Keymap::default();
        for language in Language::ALL {
            let locale = Locale::new(language);
            let help = |view| {
                let scene = HelpScene {
                    is_desk: true,
                    desk_view: Some(view),
                    ..HelpScene::of_flight(&keymap, Room::Class)
                };
                let lines = help_lines(scene, &locale);
                let end = lines.iter().position(|line| *line == HelpLine::Blank);
                lines[..end.expect("a section")].to_vec()
            };
            let says = |view, keys: &str, id| {
                let entry = HelpLine::Entry(keys.to_owned(), locale.say(id));
                help(view).contains(&entry)
            };
            assert!(says(DeskView::Board, "Enter", "desk-key-watch"));
            assert!(says(DeskView::Grading, "Enter", "desk-key-remark"));
            assert!(says(DeskView::Screen, "s", "desk-key-state"));
            assert!(!says(DeskView::Board, "s", "desk-key-state"));
            assert!(says(DeskView::Grading, "1", "desk-key-rate-1"));
            for view in [DeskView::Board, DeskView::Screen] {
                assert!(!says(view, "1", "desk-key-rate-1"), "{view:?}");
            }
            for line in help(DeskView::Board) {
                if let HelpLine::Entry(what, meaning) = line {
                    let used = what.width().max(SHORT_USAGE) + meaning.width();
                    assert!(used <= SHORT_USAGE + SHORT_SUMMARY, "{what}: {meaning}");
                }
            }
        }
    }

    #[test]
    fn the_help_of_a_member_has_what_its_role_may_do() {
        let locale = Locale::new(Language::English);
        let keymap = Keymap::default();
        let help = |role| {
            let scene = HelpScene {
                member: Some(role),
                ..HelpScene::of_flight(&keymap, Room::Fly)
            };
            let text = format!("{:?}", help_lines(scene, &locale));
            move |words: &str| text.contains(words)
        };
        let [pilot, safety] = [Role::Pilot, Role::Safety].map(help);
        let replay = locale.text(&Place::Replay.title());
        let home = locale.text(&Place::In(Room::Home).title());
        let [pause, again] = ["action-pause-mission", "action-again"].map(|id| locale.say(id));
        for absent in [&replay, &home, &pause, &again] {
            assert!(!pilot(absent) && !safety(absent), "{absent}");
        }
        assert!(pilot("takeoff ") && !safety("takeoff "));
        let observer = help(Role::Observer);
        assert!(pilot("draft upload") && !observer("draft upload") && observer("crew offer"));
        for verb in ["rtl", "crew offer", "leave"] {
            assert!(pilot(verb) && safety(verb), "{verb}");
        }
    }

    #[test]
    fn the_keys_of_the_room_come_first_and_no_line_is_cut() {
        for language in Language::ALL {
            let locale = Locale::new(language);
            let keymap = Keymap::default();
            let lines = help_lines(HelpScene::of_flight(&keymap, Room::Ledger), &locale);
            let title = locale.text(&Place::In(Room::Ledger).title());
            assert_eq!(lines[0], HelpLine::Title(title));
            for line in lines {
                if let HelpLine::Entry(what, _) | HelpLine::Usage(what) = &line {
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
