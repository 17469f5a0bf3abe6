//! The screen of a seat as its trainee sees it, and at a seat what the desk shows.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect, Size};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};

use super::age;
use super::detail::{draw_injects, title};
use super::flight::FlightView;
use crate::app::State;
use crate::app::room::class::{BesideScreen, ScreenPage};
use crate::class::{Desk, Picture, STALE_AFTER, Seat, SeatRecord};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::picture::draw_picture;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, columns, put};

/// The least width of what stands beside a screen, and the greatest.
const BESIDE: (u16, u16) = (36, 90);

pub fn draw(state: &State, desk: &Desk, page: &ScreenPage, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(seat) = desk.seats().get(page.seat()) else {
        return;
    };
    let beside = beside(seat, panel.area);
    let is_instead = beside.is_none() && page.beside() != BesideScreen::IfRoom;
    if !is_instead {
        let width = panel.area.width - beside.map_or(0, |it| it.width + 1);
        draw_screen(state, seat, page, panel.columns(0, width), buffer);
    }
    let place = if is_instead { Some(panel.area) } else { beside };
    let Some(place) = place else {
        return;
    };
    let place = panel.at(place);
    if page.beside() == BesideScreen::Injects {
        draw_injects(seat, place, buffer);
        return;
    }
    let heading = text!("class-flight-title", seat = title(seat));
    let inner = place.titled(&panel.text(&heading), buffer);
    let view = FlightView {
        desk,
        seat,
        now: state.wall(),
    };
    view.draw(panel.at(inner), buffer);
}

/// The place beside the screen, if there is room for both.
fn beside(seat: &SeatRecord, area: Rect) -> Option<Rect> {
    let used = seat.picture()?.columns() + 1;
    let room = area.width.checked_sub(used)?;
    (room >= BESIDE.0).then(|| {
        let width = room.min(BESIDE.1);
        columns(area, area.width - width, width)
    })
}

fn draw_screen(
    state: &State,
    seat: &SeatRecord,
    page: &ScreenPage,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let stale = stale(state, seat);
    let mut remarks: Vec<(Text, Role)> = stale.iter().cloned().collect();
    match seat.picture() {
        None => remarks.push((text!("class-watch-none"), Role::Muted)),
        Some(picture) => {
            let screen = panel.below(1);
            remarks.extend(draw_part(picture, page.view(), screen, buffer));
            if stale.is_some() {
                let dim = panel.style(Role::Muted).add_modifier(Modifier::DIM);
                buffer.set_style(screen.area, dim);
            }
        }
    }
    let name = text!("class-watch-title", seat = title(seat));
    draw_title(&name, remarks, panel, buffer);
}

/// Draws what the desk shows to the class.
pub fn draw_shown(state: &State, seat: &Seat, panel: Panel<'_>, buffer: &mut Buffer) {
    let instructor = seat.instructor().unwrap_or_default().to_owned();
    let name = text!("class-shown-title", instructor = instructor);
    let remark = match seat.shown() {
        None => Some((text!("class-watch-none"), Role::Muted)),
        Some(picture) => {
            let view = state.rooms().class().shown_view();
            draw_part(picture, view, panel.below(1), buffer)
        }
    };
    draw_title(&name, remark, panel, buffer);
}

/// Draws the part of a picture that begins at a column and a row; returns which part it is, if it is cut.
fn draw_part(
    picture: &Picture,
    view: (u16, u16),
    panel: Panel<'_>,
    buffer: &mut Buffer,
) -> Option<(Text, Role)> {
    let shown = panel.area;
    let first = Position::new(
        first(view.0, picture.columns(), shown.width),
        first(view.1, picture.rows(), shown.height),
    );
    draw_picture(picture, first, shown, buffer);
    cut(picture, first, shown.as_size())
}

/// Draws a title and remarks on the first line.
fn draw_title(
    name: &Text,
    remarks: impl IntoIterator<Item = (Text, Role)>,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let mut line = Line::from(Span::styled(panel.text(name), panel.style(Role::Title)));
    for (text, role) in remarks {
        let room = panel.width().saturating_sub(line.width() + 2);
        line.push_span("  ");
        let text = clip(&panel.text(&text), room);
        line.push_span(Span::styled(text, panel.style(role)));
    }
    put(buffer, panel.area, 0, &line);
}

/// The first column or row that is shown, so that the view does not leave the picture.
fn first(wanted: u16, all: u16, shown: u16) -> u16 {
    wanted.min(all.saturating_sub(shown))
}

/// Which part of the picture is shown, if not all of it.
fn cut(picture: &Picture, first: Position, shown: Size) -> Option<(Text, Role)> {
    let (columns, rows) = (picture.columns(), picture.rows());
    if columns <= shown.width && rows <= shown.height {
        return None;
    }
    let last = |first: u16, shown: u16, all: u16| (first + shown).min(all);
    let text = text!(
        "class-watch-cut",
        left = first.x + 1,
        right = last(first.x, shown.width, columns),
        columns = columns,
        top = first.y + 1,
        bottom = last(first.y, shown.height, rows),
        rows = rows
    );
    Some((text, Role::Accent))
}

/// Why the picture may be old.
fn stale(state: &State, seat: &SeatRecord) -> Option<(Text, Role)> {
    if !seat.is_here() {
        return Some((text!("class-watch-gone"), Role::Warning));
    }
    let unseen = seat.unseen_for(state.wall())?;
    let time = age(unseen.as_secs_f64());
    (unseen >= STALE_AFTER).then(|| (text!("class-watch-stale", time = time), Role::Warning))
}
