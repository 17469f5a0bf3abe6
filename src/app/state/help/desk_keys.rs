//! What the keys of the room do at a desk, for the help: each with the pages on which it has an effect.

use crate::app::action::{Action, ClassAction, Step};
use crate::app::keymap::Meaning;
use crate::text::Text;

/// A kind of page of the desk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DeskView {
    Board,
    Screen,
    Tiles,
    Grading,
    Results,
    Replay,
}

use DeskView::{Board, Grading, Replay, Results, Screen, Tiles};

/// The pages on which orders go to seats without naming them.
const ORDERS: &[DeskView] = &[Board, Screen, Tiles];
/// The pages that Esc leaves.
const PAGES: &[DeskView] = &[Screen, Tiles, Grading, Results, Replay];

/// What a key does on some pages, as the id of a message.
type DeskUse = (&'static str, &'static [DeskView]);

/// The keys that give or write a line, by its words.
const LINES: &[(&str, DeskUse)] = &[
    ("class message", ("desk-key-message", ORDERS)),
    ("class hint", ("desk-key-hint", ORDERS)),
    ("class freeze", ("desk-key-freeze", ORDERS)),
    ("class resume", ("desk-key-resume", ORDERS)),
    ("class mark", ("desk-key-bookmark", ORDERS)),
    ("class inject", ("desk-key-inject", ORDERS)),
    ("class injects", ("desk-key-injects", &[Board, Screen])),
    ("class tiles", ("desk-key-tiles", &[Board])),
    ("class state", ("desk-key-state", &[Screen])),
    ("class replay", ("desk-key-replay", &[Board, Grading])),
    ("class exam", ("desk-key-exam", &[Board])),
    ("class capture", ("desk-key-capture", ORDERS)),
    ("class recall", ("desk-key-recall", ORDERS)),
    ("class take", ("desk-key-take", ORDERS)),
    ("class give", ("desk-key-give", ORDERS)),
    ("class end", ("desk-key-end", ORDERS)),
    ("class results", ("desk-key-results", &[Board])),
    ("class results", ("desk-key-next-page", &[Results])),
    ("class grade", ("desk-key-grade", &[Board])),
    ("class rate 1", ("desk-key-rate-1", &[Grading])),
    ("class rate 2", ("desk-key-rate-2", &[Grading])),
    ("class rate 3", ("desk-key-rate-3", &[Grading])),
    ("class rate 4", ("desk-key-rate-4", &[Grading])),
    ("class rate 5", ("desk-key-rate-5", &[Grading])),
    (
        "class rate unobserved",
        ("desk-key-rate-unobserved", &[Grading]),
    ),
    ("class cite", ("desk-key-cite", &[Grading])),
    ("class lesson", ("desk-key-lesson", &[Board])),
    ("class lesson next", ("desk-key-next-step", ORDERS)),
    ("class lesson back", ("desk-key-step-back", ORDERS)),
];

/// The keys with an action.
const ACTIONS: &[(Action, DeskUse)] = &[
    (Action::Submit, ("desk-key-watch", &[Board, Tiles])),
    (Action::Submit, ("desk-key-remark", &[Grading])),
    (Action::Move(Step::Left), ("desk-key-pan-left", &[Screen])),
    (Action::Move(Step::Right), ("desk-key-pan-right", &[Screen])),
    (
        Action::Move(Step::Left),
        ("desk-key-page-before", &[Results]),
    ),
    (
        Action::Move(Step::Right),
        ("desk-key-next-page", &[Results]),
    ),
    (Action::Move(Step::Left), ("desk-key-tile-left", &[Tiles])),
    (Action::Move(Step::Right), ("desk-key-tile-right", &[Tiles])),
    (Action::Move(Step::Left), ("desk-key-older", &[Grading])),
    (Action::Move(Step::Right), ("desk-key-newer", &[Grading])),
    (
        Action::Class(ClassAction::MarkSeat),
        ("action-mark-seat", &[Board]),
    ),
    (
        Action::Class(ClassAction::MarkAllSeats),
        ("action-mark-all-seats", &[Board]),
    ),
    (Action::Escape, ("desk-key-unmark", &[Board])),
    (Action::Escape, ("desk-key-board", PAGES)),
    (
        Action::Quit,
        (
            "desk-key-quit",
            &[Board, Screen, Tiles, Grading, Results, Replay],
        ),
    ),
];

impl DeskView {
    /// Whether a key is one of the desk. Others are the user's, who may have bound them to anything.
    pub(super) fn knows(meaning: &Meaning) -> bool {
        uses(meaning).next().is_some()
    }

    /// What a key of the desk does on this page; `None` if nothing.
    pub(super) fn use_of(self, meaning: &Meaning) -> Option<Text> {
        let (id, _) = uses(meaning).find(|(_, views)| views.contains(&self))?;
        Some(Text::new(*id, Vec::new()))
    }
}

/// What a key does on its pages.
fn uses(meaning: &Meaning) -> impl Iterator<Item = &'static DeskUse> {
    let is_line = |words: &str| match meaning {
        Meaning::Write(line) | Meaning::Give(line) => line.trim_end() == words,
        Meaning::Do(_) | Meaning::Type => false,
    };
    let lines = LINES.iter().filter(move |(words, _)| is_line(words));
    let actions = ACTIONS
        .iter()
        .filter(|(action, _)| *meaning == Meaning::Do(*action));
    lines
        .map(|(_, its_use)| its_use)
        .chain(actions.map(|(_, its_use)| its_use))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::keymap::{Keymap, Place};
    use crate::app::room_list::Room;

    #[test]
    fn every_key_of_the_desk_is_explained_on_a_page_on_which_it_works() {
        let views = [Board, Screen, Tiles, Grading, Results, Replay];
        let keymap = Keymap::default();
        let keys = keymap.bindings().iter();
        for key in keys.filter(|it| it.place == Place::In(Room::Class)) {
            let uses = views.map(|view| view.use_of(&key.meaning));
            assert!(uses.iter().flatten().count() > 0, "{key:?}");
        }
    }
}
