//! The default keys: those of single rooms, and those shared by several.

use crossterm::event::KeyCode;

use super::{Room, keys};
use crate::app::action::{
    Action, DebriefAction, LineAction, ReplayAction, SelectAction, Step, ViewAction,
};
use crate::app::keymap::{
    Binding, ENTER, ESCAPE, KeyRow, Keymap, Meaning, Place, Press, does, key, writes,
};

impl Default for Keymap {
    fn default() -> Self {
        let mut bindings = Vec::new();
        let mut add = |place: Place, rows: &[KeyRow]| {
            bindings.extend(rows.iter().map(|(press, meaning)| Binding {
                press: *press,
                place,
                meaning: meaning.clone(),
            }));
        };
        add(Place::Anywhere, GENERAL);
        add(Place::Anywhere, MOVES);
        for room in Room::ALL {
            let show = (key(room.key()), Meaning::Do(Action::Show(room)));
            add(Place::Anywhere, &[show]);
            let own = keys(room);
            add(Place::In(room), own);
            if room.shows_vehicles() {
                let free = |row: &&KeyRow| own.iter().all(|(press, _)| *press != row.0);
                let rows: Vec<KeyRow> = VEHICLES.iter().filter(free).cloned().collect();
                add(Place::In(room), &rows);
            }
        }
        add(Place::Replay, REPLAY);
        add(Place::Prompt, PROMPT);
        add(Place::Reader, READER);
        add(Place::Reader, MOVES);
        add(Place::List, LIST);
        add(Place::List, MOVES);
        Self::new(bindings)
    }
}

const GENERAL: &[KeyRow] = &[
    does(key(':'), Action::CommandLine),
    does(Press::Control('p'), Action::CommandLine),
    does(key('?'), Action::Help),
    does(Press::Plain(KeyCode::F(1)), Action::Help),
    does(key('n'), Action::Notices),
    does(key('c'), Action::Show(Room::Ledger)),
    does(key('b'), Action::Brief),
    does(key('p'), Action::PauseMission),
    does(key('>'), Action::Faster),
    does(key('<'), Action::UsualPace),
    writes('\'', "bookmark "),
    does(Press::Control('c'), Action::Quit),
];

const MOVES: &[KeyRow] = &[
    does(key('j'), Action::Move(Step::Down)),
    does(Press::Plain(KeyCode::Down), Action::Move(Step::Down)),
    does(key('k'), Action::Move(Step::Up)),
    does(Press::Plain(KeyCode::Up), Action::Move(Step::Up)),
    does(
        Press::Plain(KeyCode::PageDown),
        Action::Move(Step::PageDown),
    ),
    does(Press::Plain(KeyCode::PageUp), Action::Move(Step::PageUp)),
    does(Press::Plain(KeyCode::Home), Action::Move(Step::First)),
    does(Press::Plain(KeyCode::End), Action::Move(Step::Last)),
];

const REPLAY: &[KeyRow] = &[
    does(key(' '), Action::Replay(ReplayAction::PlayReplay)),
    does(
        Press::Plain(KeyCode::Backspace),
        Action::Replay(ReplayAction::Rewind),
    ),
    does(key('('), Action::Replay(ReplayAction::ReplayBack)),
    does(key(')'), Action::Replay(ReplayAction::ReplayForward)),
    does(key(','), Action::Replay(ReplayAction::FrameBack)),
    does(key('.'), Action::Replay(ReplayAction::FrameForward)),
    does(key('{'), Action::Replay(ReplayAction::PreviousMoment)),
    does(key('}'), Action::Replay(ReplayAction::NextMoment)),
    does(key('m'), Action::Replay(ReplayAction::ShowMoments)),
    does(key('Q'), Action::Leave),
];

const READER: &[KeyRow] = &[
    does(ESCAPE, Action::Escape),
    does(key('q'), Action::Escape),
    does(key('?'), Action::Escape),
    does(ENTER, Action::Escape),
    does(key('/'), Action::View(ViewAction::Filter)),
    does(
        Press::Plain(KeyCode::Tab),
        Action::Debrief(DebriefAction::NextSection),
    ),
    does(
        Press::Plain(KeyCode::BackTab),
        Action::Debrief(DebriefAction::PreviousSection),
    ),
    does(Press::Control('c'), Action::Escape),
];

const LIST: &[KeyRow] = &[
    does(ENTER, Action::Submit),
    does(ESCAPE, Action::Escape),
    does(key('q'), Action::Escape),
    does(Press::Control('c'), Action::Escape),
];

const PROMPT: &[KeyRow] = &[
    does(ENTER, Action::Submit),
    does(ESCAPE, Action::Escape),
    does(Press::Control('c'), Action::Escape),
    does(
        Press::Plain(KeyCode::Tab),
        Action::Line(LineAction::Complete),
    ),
    does(
        Press::Plain(KeyCode::BackTab),
        Action::Line(LineAction::CompleteBack),
    ),
    does(Press::Plain(KeyCode::Up), Action::Line(LineAction::Older)),
    does(Press::Plain(KeyCode::Down), Action::Line(LineAction::Newer)),
];

/// The keys that select and command vehicles, in rooms with vehicles; a room's own keys come first.
const VEHICLES: &[KeyRow] = &[
    (Press::Number, Meaning::Type),
    does(ENTER, Action::Submit),
    does(
        Press::Plain(KeyCode::Backspace),
        Action::Select(SelectAction::Erase),
    ),
    does(key(' '), Action::Select(SelectAction::Toggle)),
    does(key('*'), Action::Select(SelectAction::SelectAll)),
    does(key('!'), Action::Select(SelectAction::Invert)),
    does(ESCAPE, Action::Escape),
    writes('a', "arm"),
    writes('d', "disarm"),
    writes('t', "takeoff "),
    writes('g', "goto "),
    writes('m', "mode "),
    writes('l', "land"),
    writes('r', "rtl"),
    writes('q', "leave"),
];

#[cfg(test)]
mod tests {
    use crossterm::event::{KeyEvent, KeyModifiers};

    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers, place: Place) -> Option<Meaning> {
        Keymap::default()
            .resolve(KeyEvent::new(code, modifiers), place)
            .cloned()
    }

    #[test]
    fn a_key_means_what_the_place_says() {
        let plain = KeyModifiers::NONE;
        let r = KeyCode::Char('r');
        assert_eq!(
            press(r, plain, Place::In(Room::Fly)),
            Some(Meaning::Write("rtl".into()))
        );
        assert_eq!(
            press(r, plain, Place::In(Room::Debrief)),
            Some(Meaning::Do(Action::Again))
        );
        assert_eq!(
            press(r, plain, Place::Prompt),
            None,
            "a prompt takes letters as text"
        );
        assert_eq!(press(r, KeyModifiers::CONTROL, Place::In(Room::Fly)), None);
        assert_eq!(
            press(
                KeyCode::Char('p'),
                KeyModifiers::CONTROL,
                Place::In(Room::Home)
            ),
            Some(Meaning::Do(Action::CommandLine))
        );
        assert_eq!(
            press(KeyCode::Char('7'), plain, Place::In(Room::Fly)),
            Some(Meaning::Type)
        );
    }

    #[test]
    fn no_key_has_two_meanings_at_one_place() {
        let keymap = Keymap::default();
        for (at, a) in keymap.bindings().iter().enumerate() {
            for b in &keymap.bindings()[at + 1..] {
                assert!(a.press != b.press || a.place != b.place, "{a:?} and {b:?}");
            }
        }
    }

    #[test]
    fn every_action_of_the_table_has_a_name() {
        for binding in Keymap::default().bindings() {
            if let Meaning::Do(action) = binding.meaning {
                assert_eq!(Action::named(action.name()), Some(action), "{binding:?}");
            }
        }
    }
}
