//! The class: at the desk, a row per seat, or a page about some of them; at a seat, the trainee's place.
//!
//! # How the parts fit
//! - `board` with its `columns`, and below it `detail`, `lesson`; `exam` is a column. `seat_view` is a seat on the board
//!   and in tiles.
//! - Watching: `watch` (a screen), `tiles` (several seats), `flight` (what is behind a screen, for both).
//! - After flights: `grading`, `results`, `replay`.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use crate::app::State;
use crate::app::room::class::{BoardDetail, DeskPage};
use crate::app::state::SeatPlace;
use crate::class::Desk;
use crate::text::lasting;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{put, wrap};

mod board;
mod columns;
mod detail;
mod exam;
mod flight;
mod grading;
mod lesson;
mod replay;
mod results;
mod seat_view;
mod tiles;
mod watch;

/// The least height of the part about one seat.
const DETAIL: u16 = 6;

pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    match state.class_role().desk() {
        Some(desk) => draw_desk(state, desk, panel, buffer),
        None => draw_seat(state, panel, buffer),
    }
}

/// Draws what the desk shows to the class, otherwise the trainee's place, or that there is no class.
fn draw_seat(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let seat = state.class_role().seat().map(SeatPlace::seat);
    if let Some(seat) = seat.filter(|seat| seat.looks_on()) {
        watch::draw_shown(state, seat, panel, buffer);
        return;
    }
    let inner = panel.titled(&panel.say("room-class"), buffer);
    let text = panel.text(&state.class_role().place_text());
    for (row, line) in (0..).zip(wrap(&text, usize::from(inner.width))) {
        put(
            buffer,
            inner,
            row,
            &Line::styled(line, panel.style(Role::Text)),
        );
    }
}

fn draw_desk(state: &State, desk: &Desk, panel: Panel<'_>, buffer: &mut Buffer) {
    match state.rooms().class().page() {
        DeskPage::Board => draw_board(state, desk, panel, buffer),
        DeskPage::Screen(page) => watch::draw(state, desk, page, panel, buffer),
        DeskPage::Tiles(page) => tiles::draw(state, desk, page, panel, buffer),
        DeskPage::Grading(page) => grading::draw(page, panel, buffer),
        DeskPage::Results(view) => results::draw(state, desk, *view, panel, buffer),
        DeskPage::Replay(flights) => replay::draw(state, flights, panel, buffer),
    }
}

/// Draws the board, and below it the seat under the cursor.
fn draw_board(state: &State, desk: &Desk, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().class();
    let board = desk.board();
    let most = panel.area.height.saturating_sub(DETAIL);
    let rows = match board.len() {
        0 => panel.area.height,
        seats => (seats as u16 + 2).min(most),
    };
    board::draw(state, desk, &board, panel.upper(rows), buffer);
    let Some(seat) = room.cursor().and_then(|seat| desk.seats().get(seat)) else {
        return;
    };
    let below = panel.below(rows);
    match room.detail() {
        BoardDetail::Events => detail::draw(seat, below, buffer),
        BoardDetail::Injects => detail::draw_injects(seat, below, buffer),
        BoardDetail::Lesson => lesson::draw(state, seat, below, buffer),
    }
}

fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or_default()
}

/// An age: `34 s`, or `2:05` from two minutes on.
fn age(age_s: f64) -> String {
    lasting(seconds(age_s))
}
