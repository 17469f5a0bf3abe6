//! The key hints of the desk: first the keys that are of most use on the page.

use super::{BoardDetail, DeskPage};
use crate::app::State;
use crate::app::action::{Action, ClassAction, Step};
use crate::app::keymap::{KeyHint, hint, hint_words};
use crate::app::room::footer_keys;
use crate::app::state::Room;

const BOARD: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Submit], "class-key-watch"),
    hint_words("class tiles", "class-key-tiles"),
    hint_words("class message ", "class-key-message"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class inject ", "class-key-inject"),
    hint_words("class results", "class-key-results"),
    hint_words("class grade", "class-key-grade"),
    hint(&[Action::Class(ClassAction::MarkSeat)], "class-key-mark"),
    hint_words("class replay", "class-key-replay"),
    hint_words("class lesson", "class-key-lesson"),
    hint_words("class exam ", "class-key-exam"),
    hint_words("class end", "class-key-end"),
    hint_words("class resume", "class-key-resume"),
    hint_words("class take ", "class-key-take"),
    hint_words("class give ", "class-key-give"),
    hint_words("class hint", "class-key-hint"),
    hint_words("class mark ", "class-key-bookmark"),
    hint(&[Action::Quit], "hint-quit"),
];

const MARKED: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Escape], "class-key-unmark"),
    hint_words("class tiles", "class-key-tiles"),
    hint_words("class message ", "class-key-message"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class resume", "class-key-resume"),
    hint_words("class inject ", "class-key-inject"),
    hint_words("class exam ", "class-key-exam"),
    hint_words("class end", "class-key-end"),
    hint_words("class mark ", "class-key-bookmark"),
    hint(&[Action::Class(ClassAction::MarkSeat)], "class-key-mark"),
    hint(&[Action::Submit], "class-key-watch"),
];

const RESULTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint_words("class results", "class-key-next-page"),
    hint(&[Action::Escape], "class-key-board"),
];

const GRADING: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Escape], "class-key-board"),
    hint_words("class rate 1", "class-key-rate"),
    hint(&[Action::Submit], "class-key-remark"),
    hint_words("class cite ", "class-key-cite"),
    hint(
        &[Action::Move(Step::Left), Action::Move(Step::Right)],
        "class-key-other-flight",
    ),
    hint_words("class replay", "class-key-replay"),
    footer_keys::MOVE,
];

const LESSON: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint_words("class lesson next", "class-key-next-step"),
    hint_words("class lesson back", "class-key-step-back"),
    hint(&[Action::Escape], "class-key-board"),
    footer_keys::MOVE,
    hint(&[Action::Class(ClassAction::MarkSeat)], "class-key-mark"),
    hint_words("class message ", "class-key-message"),
    hint_words("class mark ", "class-key-bookmark"),
];

const SCREEN: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Escape], "class-key-back"),
    hint_words("class state", "class-key-state"),
    hint_words("class message ", "class-key-message"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class resume", "class-key-resume"),
    hint_words("class take ", "class-key-take"),
    hint_words("class inject ", "class-key-inject"),
    hint_words("class mark ", "class-key-bookmark"),
    hint_words("class give ", "class-key-give"),
    hint_words("class injects", "class-key-injects"),
];

const TILES: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Submit], "class-key-watch"),
    hint(&[Action::Escape], "class-key-board"),
    hint(
        &[Action::Move(Step::Left), Action::Move(Step::Right)],
        "class-key-select",
    ),
    hint_words("class message ", "class-key-message"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class inject ", "class-key-inject"),
    hint_words("class mark ", "class-key-bookmark"),
    hint_words("class resume", "class-key-resume"),
];

const REPLAY: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Escape], "class-key-board"),
    hint(&[Action::Show(Room::Map)], "action-map"),
    hint(&[Action::Leave], "action-leave"),
];

const SEAT: &[KeyHint] = &[footer_keys::COMMAND, footer_keys::HELP, footer_keys::BACK];

const LOOKING_ON: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Escape], "class-key-look-away"),
];

pub(super) fn of(state: &State) -> &'static [KeyHint] {
    if state.class.desk().is_none() {
        let place = state.class.seat();
        let looks_on = place.is_some_and(|place| place.seat().looks_on());
        return if looks_on { LOOKING_ON } else { SEAT };
    }
    let room = &state.rooms.class;
    match &room.page {
        DeskPage::Screen(_) => SCREEN,
        DeskPage::Tiles(_) => TILES,
        DeskPage::Grading(_) => GRADING,
        DeskPage::Results(_) => RESULTS,
        DeskPage::Replay(_) => REPLAY,
        DeskPage::Board if room.detail == BoardDetail::Lesson => LESSON,
        DeskPage::Board if room.marked() > 0 => MARKED,
        DeskPage::Board => BOARD,
    }
}
