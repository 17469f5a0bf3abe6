//! One vehicle in detail. A large screen shows all panes at once, a smaller one in pages.
//!
//! # How the parts fit
//! - Is it flying well: `state`, `horizon` and `tape` (attitude and heading), `curves` and `spark` (readings over
//!   time).
//! - Can its position be trusted: `estimate`. Are its parts healthy: `sensors`, `outputs`, `texts` (its own words).
//! - What will it do: `plan`. `row` has what the panes share.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::action::{Action, ViewAction};
use crate::app::keymap::Place;
use crate::app::state::FlightView;
use crate::app::state::Room;
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::telemetry::last_known;
use crate::ui::widget::{below, columns, put, upper};
use crate::vehicle::Vehicle;

mod curves;
mod estimate;
mod horizon;
mod outputs;
mod plan;
mod row;
mod sensors;
mod spark;
mod state;
mod tape;
mod texts;

/// The minimum size to show everything at once.
const WHOLE: (u16, u16) = (110, 34);
/// The number of pages on smaller screens.
const PAGES: usize = 3;
/// The number of rows of the list of sensors over the whole width.
const SENSORS_ROWS: u16 = 9;
/// The number of rows of the outputs below other panes.
const OUTPUTS_ROWS: u16 = 8;
/// The width of the attitude indicator on a small screen, in columns.
const ATTITUDE_COLUMNS: u16 = 33;
/// The number of rows of the heading tape with the line of angles.
const TAPE_ROWS: u16 = 3;

struct VehicleSubject<'a> {
    vehicle: &'a Vehicle,
    state: &'a State,
    look: &'a Look,
}

/// Draws the vehicle under the cursor.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let Some(vehicle) = state.session().under_cursor() else {
        let line = Line::styled(panel.say("vehicle-none"), panel.style(Role::Muted));
        put(buffer, below(panel.area, 1), 0, &line);
        return;
    };
    let subject = VehicleSubject {
        vehicle,
        state,
        look: panel.look,
    };
    let is_whole = panel.area.width >= WHOLE.0 && panel.area.height >= WHOLE.1;
    let page = state.rooms().vehicle().page() % PAGES;
    draw_name(&subject, (!is_whole).then_some(page), panel.area, buffer);
    let mut body = panel.below(1);
    if let Some(line) = last_known(vehicle, state, panel.look) {
        put(buffer, body.area, 0, &line);
        body = body.below(1);
    }
    match page {
        _ if is_whole => draw_whole(&subject, body.area, buffer),
        0 => draw_flight(&subject, body.area, buffer),
        1 => draw_condition(&subject, body.area, buffer),
        _ => draw_reports(&subject, body.area, buffer),
    }
    if vehicle.link.lost {
        buffer.set_style(body.area, panel.style(Role::Muted));
    }
}

/// Draws the vehicle's name and the room's keys.
fn draw_name(subject: &VehicleSubject<'_>, page: Option<usize>, area: Rect, buffer: &mut Buffer) {
    let (session, look) = (subject.state.session(), subject.look);
    let place = look.text(&text!(
        "vehicle-place",
        row = subject.state.rooms().fly().row_of(session.cursor()) + 1,
        count = session.vehicles().len()
    ));
    let mut line = Line::from(vec![
        Span::styled(
            format!(
                " {} {}",
                subject.vehicle.id,
                look.text(&FlightView::name(subject.vehicle))
            ),
            look.style(Role::Title),
        ),
        Span::styled(format!("  {place}"), look.style(Role::Muted)),
    ]);
    let keymap = subject.state.keymap();
    let key = |actions| look.text(&keymap.keys(actions, Place::In(Room::Vehicle)));
    let mut keys = vec![(
        key(&[
            Action::View(ViewAction::PreviousVehicle),
            Action::View(ViewAction::NextVehicle),
        ]),
        look.say("vehicle-key-next"),
    )];
    let window = text!(
        "vehicle-key-window",
        seconds = subject.state.rooms().vehicle().window().seconds()
    );
    keys.push((key(&[Action::View(ViewAction::Window)]), look.text(&window)));
    if let Some(page) = page {
        let page = text!("vehicle-key-page", page = page + 1, count = PAGES);
        keys.push((key(&[Action::View(ViewAction::NextPage)]), look.text(&page)));
    }
    for (key, meaning) in keys {
        line.push_span(Span::styled(format!("   {key} "), look.style(Role::Key)));
        line.push_span(Span::styled(meaning, look.style(Role::Muted)));
    }
    put(buffer, area, 0, &line);
}

/// Draws the panes in three columns and three rows.
fn draw_whole(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let left = area.width * 3 / 10;
    let middle = area.width * 35 / 100;
    let thirds = |area: Rect| {
        [
            columns(area, 0, left - 1),
            columns(area, left, middle - 1),
            columns(area, left + middle, area.width),
        ]
    };
    let top = (area.height * 2 / 5).clamp(14, 20);
    let twofold = curves::height(subject, 2);
    let curves = if area.height >= top + twofold + OUTPUTS_ROWS + 5 {
        twofold
    } else {
        curves::height(subject, 1)
    };
    let [attitude, state, estimate] = thirds(upper(area, top));
    draw_attitude(subject, attitude, buffer);
    state::draw(subject, state, buffer);
    estimate::draw(subject, estimate, buffer);
    let lower = below(area, top);
    let [_, _, right] = thirds(lower);
    let beside = columns(lower, 0, left + middle - 1);
    curves::draw(subject, upper(beside, curves), buffer);
    plan::draw(subject, upper(right, curves), buffer);
    let [outputs, sensors, texts] = thirds(below(lower, curves));
    outputs::draw(subject, outputs, buffer);
    sensors::draw(subject, sensors, buffer);
    texts::draw(subject, texts, buffer);
}

/// Draws the first page: attitude and motion.
fn draw_flight(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let single = curves::height(subject, 1);
    let curves = if area.height >= single + 28 {
        curves::height(subject, 2)
    } else {
        single
    };
    let top = upper(area, area.height.saturating_sub(curves));
    let left = ATTITUDE_COLUMNS.max(area.width * 2 / 5 - 1);
    draw_attitude(subject, columns(top, 0, left), buffer);
    state::draw(subject, columns(top, left + 1, area.width), buffer);
    curves::draw(subject, below(area, top.height), buffer);
}

/// Draws the second page: the quality of the vehicle's sensors, its plan and its outputs.
fn draw_condition(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let top = upper(area, area.height.saturating_sub(OUTPUTS_ROWS));
    let half = area.width / 2;
    estimate::draw(subject, columns(top, 0, half), buffer);
    plan::draw(subject, columns(top, half + 1, area.width), buffer);
    outputs::draw(subject, below(area, top.height), buffer);
}

/// Draws the third page: the vehicle's reports.
fn draw_reports(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    sensors::draw(subject, upper(area, SENSORS_ROWS), buffer);
    texts::draw(subject, below(area, SENSORS_ROWS), buffer);
}

/// Draws the horizon above the heading tape.
fn draw_attitude(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let inner = Panel::new(look, area).titled(&look.say("vehicle-attitude"), buffer);
    let Some(attitude) = &subject.vehicle.attitude else {
        put(
            buffer,
            inner,
            0,
            &Line::styled("-", look.style(Role::Muted)),
        );
        return;
    };
    // An odd number of rows, so that the horizon can be level with the vehicle.
    let rows = inner.height.saturating_sub(TAPE_ROWS + 1);
    let view = upper(inner, rows - u16::from(rows > 0 && rows.is_multiple_of(2)));
    horizon::draw(attitude, Panel::new(look, view), buffer);
    // Adding zero turns a rounded -0 into +0, so that the sign does not flicker.
    let [roll, pitch] = [attitude.roll_deg, attitude.pitch_deg].map(|deg| deg.round() + 0.0);
    let angles = text!(
        "vehicle-angles",
        roll = format!("{roll:+.0}"),
        pitch = format!("{pitch:+.0}")
    );
    let line = Line::styled(look.text(&angles), look.style(Role::Text)).centered();
    let rest = below(inner, view.height);
    row::centred(buffer, rest, &line);
    tape::draw(attitude.yaw_deg, Panel::new(look, below(rest, 1)), buffer);
}
