//! What the desk shows: the board, or a page instead of it.

use super::{GradingPage, ResultsView};
use crate::app::State;
use crate::app::action::Step;
use crate::class::{Desk, Picture, WATCHED, Watching};

/// The number of columns by which the view of a screen moves sideways.
const SIDEWAYS: usize = 8;

/// A page of the desk.
#[derive(Debug, Clone, Default)]
pub enum DeskPage {
    /// A row per seat, and one seat in detail.
    #[default]
    Board,
    /// The screen of a seat, and what is behind it.
    Screen(ScreenPage),
    /// What is behind the screens of several seats.
    Tiles(TilesPage),
    /// A flight that is being graded.
    Grading(Box<GradingPage>),
    /// The results of the class.
    Results(ResultsView),
    /// Two flights that are replayed beside each other.
    Replay(ReplayedFlights),
}

/// The trainees whose flights are replayed beside each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReplayedFlights {
    /// The trainee of the flight that the replay is of.
    pub own: String,
    /// The trainee of the other one.
    pub other: String,
}

/// What stands beside a watched screen, or instead of it where there is no room.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum BesideScreen {
    /// The state of the flight, where there is room beside the screen.
    #[default]
    IfRoom,
    /// The state of the flight.
    Flight,
    /// The injects that the mission permits.
    Injects,
}

/// The page with the screen of one seat, and the state of its flight beside it.
#[derive(Debug, Clone)]
pub struct ScreenPage {
    seat: usize,
    pub(in crate::app) beside: BesideScreen,
    /// The first column and the first row that are to be shown.
    view: (u16, u16),
    /// The tiles from which it was opened, to go back to.
    from: Option<TilesPage>,
}

/// Several seats, a tile for each.
#[derive(Debug, Clone)]
pub struct TilesPage {
    seats: Vec<usize>,
    selected: usize,
}

impl ScreenPage {
    /// The seat, by its index at the desk.
    pub fn seat(&self) -> usize {
        self.seat
    }

    /// What stands beside the screen.
    pub fn beside(&self) -> BesideScreen {
        self.beside
    }

    /// The first column and the first row of the screen that are to be shown.
    pub fn view(&self) -> (u16, u16) {
        self.view
    }
}

impl TilesPage {
    /// The seats, at most four, by their indices at the desk.
    pub fn seats(&self) -> &[usize] {
        &self.seats
    }

    /// The number of the selected tile, from 0.
    pub fn selected(&self) -> usize {
        self.selected
    }

    /// The seat of the selected tile.
    pub fn seat(&self) -> Option<usize> {
        self.seats.get(self.selected).copied()
    }

    /// Selects the next tile in reading order, or the one in the next row.
    fn step(&mut self, step: Step) {
        let last = self.seats.len().saturating_sub(1);
        let row = TILE_COLUMNS;
        self.selected = match step {
            Step::Left => self.selected.saturating_sub(1),
            Step::Right => (self.selected + 1).min(last),
            Step::Up => self.selected.checked_sub(row).unwrap_or(self.selected),
            Step::Down if self.selected + row <= last => self.selected + row,
            Step::Down => self.selected,
            other => other.apply(self.selected, self.seats.len()),
        };
    }
}

/// The number of tiles in a row; with two tiles, they may also stand below each other.
pub const TILE_COLUMNS: usize = 2;

impl DeskPage {
    /// The seats that the page watches.
    fn watching(&self) -> Watching {
        match self {
            Self::Screen(page) => Watching::Screen(page.seat),
            Self::Tiles(page) => Watching::Tiles(page.seats.clone()),
            Self::Board | Self::Grading(_) | Self::Results(_) | Self::Replay(_) => {
                Watching::Nothing
            }
        }
    }

    /// Whether seats can be seen, to which an order without seats can go.
    pub fn is_about_seats(&self) -> bool {
        matches!(self, Self::Board | Self::Screen(_) | Self::Tiles(_))
    }

    /// The seat that orders without seats go to, and lines about one seat are about; `None` on pages that are not about
    /// a seat.
    pub fn seat(&self) -> Option<usize> {
        match self {
            Self::Screen(page) => Some(page.seat),
            Self::Tiles(page) => page.seat(),
            Self::Board | Self::Grading(_) | Self::Results(_) | Self::Replay(_) => None,
        }
    }
}

/// Shows a page. This is the only way to another one, so the desk watches what the page shows.
pub fn show_page(state: &mut State, page: DeskPage) {
    let room = &mut state.rooms.class;
    if let Some(seat) = page.seat() {
        room.cursor = Some(seat);
    }
    if !matches!(page, DeskPage::Grading(_)) {
        // A flight that was asked for would show itself later.
        room.awaited = None;
    }
    let watching = page.watching();
    room.page = page;
    if let Some(desk) = state.class.desk_mut() {
        desk.watch(watching);
    }
}

/// Shows the screen of a seat; from the tiles, Esc leads back to them.
pub fn show_screen(state: &mut State, seat: usize) {
    let from = match &state.rooms.class.page {
        DeskPage::Tiles(tiles) => Some(tiles.clone()),
        DeskPage::Screen(page) => page.from.clone(),
        _ => None,
    };
    let page = ScreenPage {
        seat,
        beside: BesideScreen::IfRoom,
        view: (0, 0),
        from,
    };
    show_page(state, DeskPage::Screen(page));
}

/// Shows tiles of the marked seats; without marks, of the first seats of the board. Returns whether there is a seat.
pub fn show_tiles(state: &mut State) -> bool {
    let Some(desk) = state.class.desk() else {
        return false;
    };
    let room = &state.rooms.class;
    let is_meant = |seat: &usize| {
        if room.marked.is_empty() {
            desk.seats()[*seat].is_here()
        } else {
            room.marked.contains(seat)
        }
    };
    let seats: Vec<usize> = desk.board().into_iter().filter(is_meant).collect();
    let seats: Vec<usize> = seats.into_iter().take(WATCHED).collect();
    if seats.is_empty() {
        return false;
    }
    let at_cursor = seats.iter().position(|&seat| Some(seat) == room.cursor);
    let page = TilesPage {
        selected: at_cursor.unwrap_or_default(),
        seats,
    };
    show_page(state, DeskPage::Tiles(page));
    true
}

/// Leaves the page; returns whether it was another one than the board.
pub fn leave_page(state: &mut State) -> bool {
    let next = match &mut state.rooms.class.page {
        DeskPage::Board => return false,
        DeskPage::Screen(page) if page.beside != BesideScreen::IfRoom => {
            page.beside = BesideScreen::IfRoom;
            return true;
        }
        DeskPage::Screen(page) => page.from.take().map_or(DeskPage::Board, DeskPage::Tiles),
        _ => DeskPage::Board,
    };
    show_page(state, next);
    true
}

/// Moves the view over the watched screen.
pub(super) fn move_view(state: &mut State, step: Step) {
    let (columns, rows) = state.display.size();
    let DeskPage::Screen(page) = &mut state.rooms.class.page else {
        return;
    };
    let seats = state.class.desk().map_or(&[][..], Desk::seats);
    let Some(picture) = seats.get(page.seat).and_then(|seat| seat.picture()) else {
        return;
    };
    page.view = moved(page.view, picture, (columns, rows), step);
}

/// Moves the view over what the desk shows, at a seat.
pub(super) fn move_shown(state: &mut State, step: Step) {
    let size = state.display.size();
    let place = state.class.seat();
    if let Some(picture) = place.and_then(|place| place.seat().shown()) {
        let view = &mut state.rooms.class.shown_view;
        *view = moved(*view, picture, size, step);
    }
}

/// The view over a picture after a step, on a terminal of this size.
fn moved(view: (u16, u16), picture: &Picture, size: (u16, u16), step: Step) -> (u16, u16) {
    // Header, title and footer take one row each.
    let hidden = |all: u16, shown: u16| usize::from(all.saturating_sub(shown));
    let right = hidden(picture.columns(), size.0);
    let below = hidden(picture.rows(), size.1.saturating_sub(3));
    let (column, row) = (usize::from(view.0), usize::from(view.1));
    match step {
        Step::Left => (column.saturating_sub(SIDEWAYS) as u16, view.1),
        Step::Right => ((column + SIDEWAYS).min(right) as u16, view.1),
        _ => (view.0, step.apply(row, below + 1) as u16),
    }
}

/// Moves in the tiles; the cursor of the board follows.
pub(super) fn move_in_tiles(state: &mut State, step: Step) {
    let room = &mut state.rooms.class;
    if let DeskPage::Tiles(page) = &mut room.page {
        page.step(step);
        room.cursor = page.seat();
    }
}
