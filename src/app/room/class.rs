//! The class: at the desk, a row per seat, in the order in which they need help, or a page about some of them.
//!
//! # How the parts fit
//! - `page`: what is shown instead of the board, and which seats are watched for it.
//! - `results`, `grading`, `lessons`: the data of single pages. `hints`: the keys on the last line.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, ClassAction, Step};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Meaning, Press, does, key, writes};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest};
use crate::app::state::DeskView;
use crate::class::Desk;
use crate::class_results::{ClassResults, FoundFlights};
use crate::grading::GradedRequest;
use crate::language::Named;

mod grading;
mod hints;
mod lessons;
mod page;
mod results;

pub use grading::GradingPage;
pub use lessons::Lessons;
pub use page::{
    BesideScreen, DeskPage, ReplayedFlights, ScreenPage, TILE_COLUMNS, TilesPage, leave_page,
    show_page, show_screen, show_tiles,
};
pub use results::{ResultsPage, ResultsView};

/// What stands below the rows of the board, about the seat under the cursor.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum BoardDetail {
    /// The last orders, and what happened.
    #[default]
    Events,
    /// The injects that the mission permits.
    Injects,
    /// The lesson of the seat, or all lessons.
    Lesson,
}

/// The state of the room. Seats are meant by their index at the desk, which does not change when rows move.
#[derive(Debug, Clone, Default)]
pub struct ClassRoom {
    /// The seat under the cursor.
    pub(in crate::app) cursor: Option<usize>,
    /// The seats that orders to marked ones go to.
    pub(in crate::app) marked: BTreeSet<usize>,
    page: DeskPage,
    pub(in crate::app) detail: BoardDetail,
    /// The lessons of the desk.
    pub(in crate::app) lessons: Lessons,
    /// The exams that the desk can hold; `None` until they are read.
    pub(in crate::app) exams: Option<Vec<Named>>,
    /// The results of the class; `None` until the records are read.
    pub(in crate::app) results: Option<Arc<ClassResults>>,
    /// The flight that was asked for to be graded.
    pub(in crate::app) awaited: Option<GradedRequest>,
    /// The flights that were found to be replayed, until the replay has begun.
    pub(in crate::app) replay_asked: Option<FoundFlights>,
    /// Whether a replay was opened for the class, after which the desk is shown again.
    pub(in crate::app) replays: bool,
    /// The number of flights whose grades could not be written yet.
    pub(in crate::app) unwritten_grades: usize,
    /// At a seat: the first column and the first row of what the desk shows that are to be shown here.
    shown_view: (u16, u16),
    /// The name of the last rubric; `None` for the standard one.
    pub(in crate::app) rubric: Option<String>,
}

impl ClassRoom {
    /// The seat under the cursor.
    pub fn cursor(&self) -> Option<usize> {
        self.cursor
    }

    /// Whether a seat is marked.
    pub fn is_marked(&self, seat: usize) -> bool {
        self.marked.contains(&seat)
    }

    /// The number of marked seats.
    pub fn marked(&self) -> usize {
        self.marked.len()
    }

    /// What the desk shows.
    pub fn page(&self) -> &DeskPage {
        &self.page
    }

    /// The kind of that page.
    pub fn view(&self) -> DeskView {
        match self.page {
            DeskPage::Board => DeskView::Board,
            DeskPage::Screen(_) => DeskView::Screen,
            DeskPage::Tiles(_) => DeskView::Tiles,
            DeskPage::Grading(_) => DeskView::Grading,
            DeskPage::Results(_) => DeskView::Results,
            DeskPage::Replay(_) => DeskView::Replay,
        }
    }

    /// What stands below the rows of the board.
    pub fn detail(&self) -> BoardDetail {
        self.detail
    }

    /// The lessons that the desk knows.
    pub fn lessons(&self) -> &Lessons {
        &self.lessons
    }

    /// The results of the class; `None` until the records are read.
    pub fn results(&self) -> Option<&ClassResults> {
        self.results.as_deref()
    }

    /// At a seat: the first column and the first row of what the desk shows that are to be shown here.
    pub fn shown_view(&self) -> (u16, u16) {
        self.shown_view
    }

    /// The page of the watched screen, for changing what is shown beside it.
    pub(in crate::app) fn screen_mut(&mut self) -> Option<&mut ScreenPage> {
        match &mut self.page {
            DeskPage::Screen(page) => Some(page),
            _ => None,
        }
    }
}

/// The seats to which an order without seats goes: the watched one or the selected tile, otherwise the marked ones,
/// otherwise the one under the cursor.
pub fn addressed(state: &State) -> Vec<usize> {
    let room = &state.rooms.class;
    if let Some(seat) = room.page.seat() {
        vec![seat]
    } else if room.marked.is_empty() {
        room.cursor.into_iter().collect()
    } else {
        room.marked.iter().copied().collect()
    }
}

/// Whether the room on the screen is about the replayed flight: the board and the grades are for the instructor only.
pub fn is_for_class(state: &State) -> bool {
    match state.room {
        Room::Class => matches!(state.rooms.class.page, DeskPage::Replay(_)),
        Room::Home | Room::Standing | Room::Workshop => false,
        _ => true,
    }
}

/// Puts the cursor on the first row if it is on none.
pub fn keep_cursor(state: &mut State) {
    let first = state
        .class
        .desk()
        .and_then(|desk| desk.board().first().copied());
    let cursor = &mut state.rooms.class.cursor;
    *cursor = cursor.or(first);
}

const fn gives(c: char, line: &'static str) -> KeyRow {
    (key(c), Meaning::Give(Cow::Borrowed(line)))
}

/// Marks seats, or removes their marks.
pub(super) fn act(state: &mut State, action: ClassAction) -> Vec<RoomRequest> {
    let count = state.class.desk().map_or(0, |desk| desk.seats().len());
    let room = &mut state.rooms.class;
    match action {
        ClassAction::MarkSeat => {
            if let Some(seat) = room.cursor
                && !room.marked.remove(&seat)
            {
                room.marked.insert(seat);
            }
        }
        ClassAction::MarkAllSeats => room.marked = (0..count).collect(),
    }
    Vec::new()
}

/// Moves the cursor of the board.
fn move_on_board(state: &mut State, step: Step) {
    let board = state.class.desk().map(Desk::board).unwrap_or_default();
    let room = &mut state.rooms.class;
    let row = board.iter().position(|&seat| Some(seat) == room.cursor);
    let row = step.apply(row.unwrap_or_default(), board.len());
    room.cursor = board.get(row).copied();
}

impl RoomModel for ClassRoom {
    const KEYS: &'static [KeyRow] = &[
        does(key(' '), Action::Class(ClassAction::MarkSeat)),
        does(ENTER, Action::Submit),
        does(Press::Plain(KeyCode::Left), Action::Move(Step::Left)),
        does(Press::Plain(KeyCode::Right), Action::Move(Step::Right)),
        does(key('*'), Action::Class(ClassAction::MarkAllSeats)),
        writes('m', "class message "),
        gives('h', "class hint"),
        gives('f', "class freeze"),
        gives('r', "class resume"),
        writes('\'', "class mark "),
        writes('e', "class inject "),
        gives('i', "class injects"),
        gives('w', "class tiles"),
        gives('s', "class state"),
        gives('v', "class replay"),
        writes('E', "class exam "),
        writes('C', "class capture "),
        writes('R', "class recall "),
        writes('T', "class take "),
        writes('G', "class give "),
        gives('x', "class end"),
        gives('t', "class results"),
        gives('g', "class grade"),
        gives('1', "class rate 1"),
        gives('2', "class rate 2"),
        gives('3', "class rate 3"),
        gives('4', "class rate 4"),
        gives('5', "class rate 5"),
        gives('0', "class rate unobserved"),
        writes('c', "class cite "),
        gives('l', "class lesson"),
        gives('n', "class lesson next"),
        gives('b', "class lesson back"),
        does(ESCAPE, Action::Escape),
        does(key('q'), Action::Quit),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        hints::of(state)
    }

    fn step(state: &mut State, step: Step) -> Answer {
        if state.class.seat().is_some() {
            page::move_shown(state, step);
            return Some(Vec::new());
        }
        let room = &mut state.rooms.class;
        match &mut room.page {
            DeskPage::Screen(_) => page::move_view(state, step),
            DeskPage::Tiles(_) => page::move_in_tiles(state, step),
            DeskPage::Grading(_) => {
                let asked = room.move_in_grading(step);
                return Some(asked.into_iter().map(RoomRequest::from).collect());
            }
            DeskPage::Results(view) => view.step(step, room.results.as_deref()),
            DeskPage::Replay(_) => {}
            DeskPage::Board => move_on_board(state, step),
        }
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        let desk = state.class.desk()?;
        let room = &state.rooms.class;
        let seat = match &room.page {
            DeskPage::Grading(_) if room.awaited.is_some() => {
                // The remark would be that of the flight before.
                return Some(Vec::new());
            }
            DeskPage::Grading(page) => {
                let line = format!("class remark {}", page.remark());
                return Some(vec![RoomRequest::Write(line)]);
            }
            DeskPage::Board => room.cursor?,
            DeskPage::Tiles(page) => page.seat()?,
            DeskPage::Screen(_) | DeskPage::Results(_) | DeskPage::Replay(_) => {
                return Some(Vec::new());
            }
        };
        if desk.seats().get(seat)?.is_here() {
            show_screen(state, seat);
        }
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        state.hush();
        if state
            .class
            .seat()
            .is_some_and(|place| place.seat.looks_on())
        {
            return Some(vec![RoomRequest::LookAway]);
        }
        state.class.desk()?;
        if leave_page(state) {
            return Some(Vec::new());
        }
        let room = &mut state.rooms.class;
        room.awaited = None;
        if std::mem::take(&mut room.detail) == BoardDetail::Events {
            room.marked.clear();
        }
        Some(Vec::new())
    }

    fn entered(state: &mut State) {
        keep_cursor(state);
    }

    /// Pages and marks belong to the class, not to a session.
    fn forget_session(&mut self) {}
}
