//! The class: at the desk, a row per seat, in the order in which they need help.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, ClassAction, Step};
use crate::app::keymap::{
    ENTER, ESCAPE, KeyHint, KeyRow, Meaning, Press, does, hint, hint_words, key, writes,
};
use crate::app::room::{Answer, RoomModel, RoomRequest, footer_keys};
use crate::class::{Desk, LessonPlan};
use crate::class_results::ClassResults;
use crate::grading::GradedRequest;
use crate::lesson_plan::{Lesson, LessonList};
use crate::text;
use crate::text::Text;

mod grading;

pub use grading::GradingPage;

/// A page of the results of the class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResultsPage {
    /// The objectives, the least known first.
    Objectives,
    /// How the scores of each mission are spread.
    Missions,
    /// How the mastery of each skill is spread.
    Skills,
    /// A row per trainee, with the scores of the missions.
    ByMission,
    /// A row per trainee, with the mastery of the skills.
    BySkill,
}

impl ResultsPage {
    /// All pages in their order.
    pub const ALL: [Self; 5] = [
        Self::Objectives,
        Self::Missions,
        Self::Skills,
        Self::ByMission,
        Self::BySkill,
    ];

    /// What the page shows.
    pub fn title(self) -> Text {
        match self {
            Self::Objectives => text!("class-report-objectives"),
            Self::Missions => text!("class-report-spread"),
            Self::Skills => text!("class-report-skill-spread"),
            Self::ByMission => text!("class-results-by-mission"),
            Self::BySkill => text!("class-report-skills"),
        }
    }

    /// Its number, from 1.
    pub fn number(self) -> usize {
        self as usize + 1
    }

    /// The page that many pages further on; the first one follows the last one.
    fn after(self, pages: usize) -> Self {
        Self::ALL[(self as usize + pages) % Self::ALL.len()]
    }
}

/// The lessons that the desk knows.
#[derive(Debug, Clone, Default)]
pub struct Lessons {
    /// Whether the lessons, or the lesson of the seat under the cursor, are shown instead of what happened there.
    pub(in crate::app) is_shown: bool,
    /// Those that can be read; `None` until they are.
    pub(in crate::app) listed: Option<LessonList>,
    /// Those that have begun.
    pub(in crate::app) begun: Vec<Arc<Lesson>>,
    /// The names of those that journals have, and that were asked for.
    pub(in crate::app) asked: BTreeSet<String>,
}

impl Lessons {
    /// Whether the lessons, or the lesson of the seat under the cursor, are shown.
    pub fn is_shown(&self) -> bool {
        self.is_shown
    }

    /// Those that can be read; `None` until they are.
    pub fn listed(&self) -> Option<&LessonList> {
        self.listed.as_ref()
    }

    /// The texts of a plan that a seat is in.
    pub fn of(&self, plan: &Arc<LessonPlan>) -> Option<&Lesson> {
        let mut begun = self.begun.iter();
        begun
            .find(|it| Arc::ptr_eq(&it.plan, plan))
            .map(Arc::as_ref)
    }
}

/// The number of columns by which the view moves sideways.
const SIDEWAYS: usize = 8;

/// The state of the room. Seats are meant by their index at the desk, which does not change when rows move.
#[derive(Debug, Clone, Default)]
pub struct ClassRoom {
    /// The seat under the cursor.
    pub(in crate::app) cursor: Option<usize>,
    /// The seats that orders to marked ones go to.
    pub(in crate::app) marked: BTreeSet<usize>,
    /// Whether the injects of the seat under the cursor are shown, instead of what happened there.
    pub(in crate::app) shows_injects: bool,
    /// The lessons of the desk.
    pub(in crate::app) lessons: Lessons,
    /// The first column and the first row of the watched screen that are to be shown.
    view: (u16, u16),
    /// The results of the class; `None` until the records are read.
    pub(in crate::app) results: Option<Arc<ClassResults>>,
    /// The page of the results that is shown instead of the board.
    page: Option<ResultsPage>,
    /// The first row of the page that is to be shown.
    results_row: usize,
    /// The flight that is being graded instead of the board being shown.
    pub(in crate::app) grading: Option<GradingPage>,
    /// The flight that was asked for to be graded.
    pub(in crate::app) awaited: Option<GradedRequest>,
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

    /// The first column and the first row of the watched screen that are to be shown.
    pub fn view(&self) -> (u16, u16) {
        self.view
    }

    /// Whether the injects of the seat under the cursor are shown, instead of what happened there.
    pub fn shows_injects(&self) -> bool {
        self.shows_injects
    }

    /// The lessons that the desk knows.
    pub fn lessons(&self) -> &Lessons {
        &self.lessons
    }

    /// The results of the class; `None` until the records are read.
    pub fn results(&self) -> Option<&ClassResults> {
        self.results.as_deref()
    }

    /// The page of the results that is shown instead of the board.
    pub fn page(&self) -> Option<ResultsPage> {
        self.page
    }

    /// The first row of the page that is to be shown.
    pub fn results_row(&self) -> usize {
        self.results_row
    }

    /// Shows the results: their first page, or the next one.
    pub(in crate::app) fn show_results(&mut self) {
        self.close_grading();
        let next = self.page.map(|page| page.after(1));
        self.page = Some(next.unwrap_or(ResultsPage::Objectives));
        self.results_row = 0;
    }

    /// Moves in a page of the results.
    fn move_in_results(&mut self, page: ResultsPage, step: Step) {
        let rows = self.results().map_or(0, |results| match page {
            ResultsPage::Objectives => results.objectives.len(),
            ResultsPage::Missions => results.missions.len(),
            ResultsPage::Skills => results.skills.len(),
            ResultsPage::ByMission | ResultsPage::BySkill => results.trainees.len(),
        });
        match step {
            Step::Right => self.page = Some(page.after(1)),
            Step::Left => self.page = Some(page.after(ResultsPage::ALL.len() - 1)),
            _ => {
                self.results_row = step.apply(self.results_row, rows);
                return;
            }
        }
        self.results_row = 0;
    }

    /// The number of marked seats.
    pub fn marked(&self) -> usize {
        self.marked.len()
    }
}

/// The seats to which an order without seats goes: the watched one, otherwise the marked ones, otherwise the one under
/// the cursor.
pub fn addressed(state: &State) -> Vec<usize> {
    let room = &state.rooms.class;
    let watched = state.class.desk().and_then(Desk::watched);
    if let Some(seat) = watched {
        vec![seat]
    } else if room.marked.is_empty() {
        room.cursor.into_iter().collect()
    } else {
        room.marked.iter().copied().collect()
    }
}

/// Shows the screen of a seat; orders without seats go to it.
pub fn watch(state: &mut State, seat: usize) {
    let room = &mut state.rooms.class;
    room.close_grading();
    room.cursor = Some(seat);
    room.view = (0, 0);
    if let Some(desk) = state.class.desk_mut() {
        desk.watch(Some(seat));
    }
}

/// Moves the view over the watched screen.
fn move_view(state: &mut State, seat: usize, step: Step) {
    let desk = state.class.desk();
    let picture = desk.and_then(|desk| desk.seats().get(seat)?.picture());
    let Some(picture) = picture else {
        return;
    };
    let (columns, rows) = state.display.size();
    // Header, title and footer take one row each.
    let hidden = |all: u16, shown: u16| usize::from(all.saturating_sub(shown));
    let right = hidden(picture.columns(), columns);
    let below = hidden(picture.rows(), rows.saturating_sub(3));
    let view = &mut state.rooms.class.view;
    let (column, row) = (usize::from(view.0), usize::from(view.1));
    *view = match step {
        Step::Left => (column.saturating_sub(SIDEWAYS) as u16, view.1),
        Step::Right => ((column + SIDEWAYS).min(right) as u16, view.1),
        _ => (view.0, step.apply(row, below + 1) as u16),
    };
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

const DESK_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint(&[Action::Submit], "class-key-watch"),
    hint(&[Action::Class(ClassAction::MarkSeat)], "class-key-mark"),
    hint_words("class message ", "class-key-message"),
    hint_words("class hint", "class-key-hint"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class resume", "class-key-resume"),
    hint_words("class mark ", "class-key-bookmark"),
    hint_words("class inject ", "class-key-inject"),
    hint_words("class take ", "class-key-take"),
    hint_words("class give ", "class-key-give"),
    hint_words("class end", "class-key-end"),
    hint_words("class results", "class-key-results"),
    hint_words("class grade", "class-key-grade"),
    hint_words("class lesson", "class-key-lesson"),
    hint_words("class lesson next", "class-key-next-step"),
    hint_words("class exam ", "class-key-exam"),
    hint(&[Action::Quit], "hint-quit"),
];

const RESULTS_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint_words("class results", "class-key-next-page"),
    hint(&[Action::Escape], "class-key-board"),
];

const GRADING_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint_words("class rate 1", "class-key-rate"),
    hint(&[Action::Submit], "class-key-remark"),
    hint_words("class cite ", "class-key-cite"),
    hint(&[Action::Move(Step::Left)], "class-key-older"),
    hint(&[Action::Escape], "class-key-board"),
];

const LESSON_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint_words("class lesson next", "class-key-next-step"),
    hint_words("class lesson back", "class-key-step-back"),
    hint(&[Action::Class(ClassAction::MarkSeat)], "class-key-mark"),
    hint(&[Action::Escape], "class-key-board"),
    hint_words("class message ", "class-key-message"),
    hint_words("class mark ", "class-key-bookmark"),
];

const WATCH_HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    hint(&[Action::Escape], "class-key-board"),
    hint_words("class message ", "class-key-message"),
    hint_words("class freeze", "class-key-freeze"),
    hint_words("class resume", "class-key-resume"),
    hint_words("class take ", "class-key-take"),
    hint_words("class give ", "class-key-give"),
    hint_words("class mark ", "class-key-bookmark"),
    hint_words("class inject ", "class-key-inject"),
];

const SEAT_HINTS: &[KeyHint] = &[footer_keys::COMMAND, footer_keys::HELP, footer_keys::BACK];

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
        match state.class.desk() {
            Some(desk) if desk.watched().is_some() => WATCH_HINTS,
            Some(_) if state.rooms.class.grading.is_some() => GRADING_HINTS,
            Some(_) if state.rooms.class.page.is_some() => RESULTS_HINTS,
            Some(_) if state.rooms.class.lessons.is_shown => LESSON_HINTS,
            Some(_) => DESK_HINTS,
            None => SEAT_HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        if let Some(seat) = state.class.desk().and_then(Desk::watched) {
            move_view(state, seat, step);
            return Some(Vec::new());
        }
        if state.rooms.class.grading.is_some() {
            let asked = state.rooms.class.move_in_grading(step);
            return Some(asked.into_iter().map(RoomRequest::from).collect());
        }
        let board = state.class.desk().map(Desk::board).unwrap_or_default();
        let room = &mut state.rooms.class;
        if let Some(page) = room.page {
            room.move_in_results(page, step);
            return Some(Vec::new());
        }
        let row = board.iter().position(|&seat| Some(seat) == room.cursor);
        let row = step.apply(row.unwrap_or_default(), board.len());
        room.cursor = board.get(row).copied();
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        let desk = state.class.desk()?;
        if let Some(page) = &state.rooms.class.grading {
            if state.rooms.class.awaited.is_some() {
                // The remark would be that of the flight before.
                return Some(Vec::new());
            }
            let line = format!("class remark {}", page.remark());
            return Some(vec![RoomRequest::Write(line)]);
        }
        let seat = state.rooms.class.cursor?;
        let is_board = desk.watched().is_none() && state.rooms.class.page.is_none();
        if is_board && desk.seats().get(seat)?.is_here() {
            watch(state, seat);
        }
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        state.hush();
        let desk = state.class.desk_mut()?;
        if desk.watched().is_some() {
            desk.watch(None);
            return Some(Vec::new());
        }
        let room = &mut state.rooms.class;
        let is_open = room.close_grading()
            || room.page.take().is_some()
            || std::mem::take(&mut room.shows_injects)
            || std::mem::take(&mut room.lessons.is_shown);
        if !is_open {
            room.marked.clear();
        }
        Some(Vec::new())
    }

    fn entered(state: &mut State) {
        keep_cursor(state);
    }

    /// Marks belong to the class, not to a session.
    fn forget_session(&mut self) {}
}
