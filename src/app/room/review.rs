//! The review of a recorded flight: the plan, the course, the reasons and the next steps. The score
//! is explained only after the pilot has written the reasons and the next steps.

use std::time::Duration;

use crossterm::event::KeyCode;

use super::mission::positions;
use super::page::PageLine;
use super::{Answer, Room, RoomModel, RoomRequest, State, footer_keys};
use crate::app::action::{Action, Step, ViewAction};
use crate::app::effect::{Effect, ReplayEffect};
use crate::app::keymap::{
    ENTER, ESCAPE, KeyHint, KeyRow, Meaning, Place, Press, does, hint, hint_words, key, writes,
};
use crate::moment::Moment;
use crate::text::{Locale, Text};

mod compared;
mod page;

/// Rows of the screen outside a page: header, tabs, keys, footer.
const OTHER_ROWS: u16 = 4;
/// The rows for the curves of two flights are a page's rows divided by this.
const CURVE_SHARE: u16 = 3;
const WIDEST: u16 = 100;

/// The pages of a review, in order.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ReviewPage {
    /// The plan: objectives, prediction, goal.
    #[default]
    Planned,
    /// The moments of the flight, and the map at each.
    Happened,
    /// The pilot's answer on the reasons for the result.
    Why,
    /// The pilot's answer on what to do next time, and the points.
    Next,
    /// The largest changes of the score.
    Explained,
    /// The differences from another flight, and the points that they cost.
    Compared,
}

impl ReviewPage {
    pub const ALL: [Self; 6] = [
        Self::Planned,
        Self::Happened,
        Self::Why,
        Self::Next,
        Self::Explained,
        Self::Compared,
    ];

    /// The id of the message with the page's title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Planned => "review-planned",
            Self::Happened => "review-happened",
            Self::Why => "review-why",
            Self::Next => "review-next",
            Self::Explained => "review-explained",
            Self::Compared => "review-compared",
        }
    }

    /// The page `by` steps further; this page if there is none.
    fn moved(self, by: isize) -> Self {
        let at = Self::ALL.iter().position(|&it| it == self);
        let to = at.and_then(|at| at.checked_add_signed(by));
        to.and_then(|to| Self::ALL.get(to)).copied().unwrap_or(self)
    }

    /// The next page, or the first after the last.
    fn next(self) -> Self {
        match self.moved(1) {
            same if same == self => Self::default(),
            next => next,
        }
    }
}

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Review {
    pub(in crate::app) page: ReviewPage,
    /// The index of the moment under the cursor among the reviewed ones.
    pub(in crate::app) cursor: usize,
    /// The first line shown of a page.
    pub(in crate::app) scroll: usize,
    /// Whether the room was entered from the debrief.
    pub(in crate::app) is_from_debrief: bool,
}

impl Review {
    pub fn page(&self) -> ReviewPage {
        self.page
    }

    /// The index of the moment under the cursor among the reviewed ones.
    pub fn cursor(&self) -> usize {
        self.cursor
    }

    /// The first line shown of a page.
    pub fn scroll(&self) -> usize {
        self.scroll
    }
}

/// The moments that the review lists, earliest first.
pub fn moments(state: &State) -> Vec<&Moment> {
    let all = state.replay.iter().flat_map(|it| it.moments.iter());
    all.filter(|it| it.kind.is_reviewed()).collect()
}

/// The room's key that opens the command line with a text.
pub fn key_of(state: &State, words: &'static str) -> Text {
    let meaning = Meaning::words(words);
    state.keymap.key(meaning, Place::In(Room::Review))
}

/// The rows for both flights' curves on a page of this height; 0 if the current page does not show
/// them.
pub fn curve_rows(state: &State, rows: u16) -> u16 {
    let has_both = state.ghost.as_ref().is_some_and(|it| it.own.is_some());
    let is_shown = has_both && state.rooms.review.page == ReviewPage::Compared;
    if is_shown { rows / CURVE_SHARE } else { 0 }
}

/// The lines of the current page, for a screen of this width; empty for the page with the map.
pub fn lines(state: &State, locale: &Locale, width: u16) -> Vec<PageLine> {
    page::lines(state, locale, width.min(WIDEST).saturating_sub(2))
}

const PAGE_HINTS: &[KeyHint] = &[
    hint(&[Action::View(ViewAction::NextPage)], "hint-page"),
    footer_keys::SCROLL,
    footer_keys::EXPORT,
    footer_keys::GHOST,
    footer_keys::BACK,
    footer_keys::HELP,
    footer_keys::COMMAND,
];

const HAPPENED_HINTS: &[KeyHint] = &[
    hint(&[Action::View(ViewAction::NextPage)], "hint-page"),
    footer_keys::MOVE,
    hint_words("review sustain", "hint-sustain"),
    hint_words("review improve", "hint-improve"),
    footer_keys::EXPORT,
    footer_keys::GHOST,
    footer_keys::BACK,
    footer_keys::HELP,
];

const ANSWER_HINTS: &[KeyHint] = &[
    hint(&[Action::View(ViewAction::NextPage)], "hint-page"),
    hint(&[Action::Submit], "hint-answer"),
    footer_keys::EXPORT,
    footer_keys::GHOST,
    footer_keys::BACK,
    footer_keys::HELP,
    footer_keys::COMMAND,
];

impl RoomModel for Review {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(
            Press::Plain(KeyCode::Tab),
            Action::View(ViewAction::NextPage),
        ),
        does(Press::Plain(KeyCode::BackTab), Action::Move(Step::Left)),
        does(Press::Plain(KeyCode::Left), Action::Move(Step::Left)),
        does(Press::Plain(KeyCode::Right), Action::Move(Step::Right)),
        writes('+', "review sustain "),
        writes('-', "review improve "),
        writes('x', "review remove "),
        writes('e', "review export "),
        writes('g', "ghost "),
        does(key('q'), Action::Leave),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.review.page {
            ReviewPage::Happened => HAPPENED_HINTS,
            ReviewPage::Why | ReviewPage::Next => ANSWER_HINTS,
            ReviewPage::Planned | ReviewPage::Explained | ReviewPage::Compared => PAGE_HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        Some(match step {
            Step::Left => turn(state, state.rooms.review.page.moved(-1)),
            Step::Right => turn(state, state.rooms.review.page.moved(1)),
            Step::Up
            | Step::Down
            | Step::PageUp
            | Step::PageDown
            | Step::First
            | Step::Last
            | Step::Row(_) => walk(state, step),
        })
    }

    /// Opens the command line with the page's answer, or shows the moment under the cursor again.
    fn submit(state: &mut State) -> Answer {
        let review = state.replay.as_ref().map(|it| &it.review)?;
        let line = match state.rooms.review.page {
            ReviewPage::Why => format!("review why {}", review.why),
            ReviewPage::Next => format!("review next {}", review.next),
            ReviewPage::Happened => return Some(show_moment(state)),
            ReviewPage::Planned | ReviewPage::Explained | ReviewPage::Compared => {
                return Some(Vec::new());
            }
        };
        Some(vec![RoomRequest::Write(line)])
    }

    fn escape(state: &mut State) -> Answer {
        let has_debrief = state.rooms.debrief.shown().is_some();
        let room = match state.replay {
            _ if state.rooms.review.is_from_debrief && has_debrief => Room::Debrief,
            Some(_) => Room::Fly,
            None => Room::Home,
        };
        Some(vec![RoomRequest::Show(room)])
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        match action {
            ViewAction::NextPage => {
                let next = state.rooms.review.page.next();
                Some(turn(state, next))
            }
            ViewAction::Filter
            | ViewAction::Sort
            | ViewAction::SortReverse
            | ViewAction::NextVehicle
            | ViewAction::PreviousVehicle
            | ViewAction::Window => None,
        }
    }
}

/// Shows another page. The replay stays where it is; on the page of the moments, the cursor starts
/// on the moment shown.
fn turn(state: &mut State, page: ReviewPage) -> Vec<RoomRequest> {
    let room = &mut state.rooms.review;
    if room.page == page {
        return Vec::new();
    }
    (room.page, room.scroll) = (page, 0);
    if page == ReviewPage::Happened {
        state.rooms.review.cursor = moment_shown(state);
    }
    Vec::new()
}

/// The index, among the reviewed moments, of the last one that has passed; the first index if none
/// has.
fn moment_shown(state: &State) -> usize {
    let now = state
        .replay
        .as_ref()
        .map_or(Duration::ZERO, |it| it.position.at);
    let passed = moments(state).partition_point(|it| it.at <= now);
    passed.saturating_sub(1)
}

fn walk(state: &mut State, step: Step) -> Vec<RoomRequest> {
    let room = &state.rooms.review;
    if room.page == ReviewPage::Happened {
        let cursor = step.apply(room.cursor, moments(state).len());
        state.rooms.review.cursor = cursor;
        return show_moment(state);
    }
    let (width, height) = state.display.size;
    let count = lines(state, &state.locale, width).len();
    let rows = height.saturating_sub(OTHER_ROWS);
    let positions = positions(count, rows - curve_rows(state, rows));
    state.rooms.review.scroll = step.apply(room.scroll.min(positions - 1), positions);
    Vec::new()
}

/// Sends the replay to the moment under the cursor, so that the map shows it.
fn show_moment(state: &State) -> Vec<RoomRequest> {
    let moments = moments(state);
    let cursor = state.rooms.review.cursor;
    let Some(moment) = moments.get(cursor).or(moments.last()) else {
        return Vec::new();
    };
    [ReplayEffect::Play(false), ReplayEffect::Show(moment.at)]
        .map(|effect| Effect::Replay(effect).into())
        .into()
}
