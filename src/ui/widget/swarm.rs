//! The swarm table: a line per vehicle. Only the lines that are seen are built.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use crate::app::state::{Alert, LinkSummary, Session, State, alert, ranges};
use crate::ledger::RowState;
use crate::ui::look::Look;
use crate::ui::theme::Role;
use crate::ui::widget::{below, clip, put, row_role, severity_role, titled, wrap};
use crate::vehicle::{FixType, LandedState, Vehicle};

/// Columns of the newest command: `takeoff timed out` fits.
const COMMAND_WIDTH: u16 = 17;

/// A column of the table.
struct Column {
    title: &'static str,
    /// Its width; the last column takes what is left and wants at least this.
    width: u16,
    /// The columns with the smallest ranks are kept on narrow screens.
    rank: u8,
    /// Numbers stand at the right.
    right: bool,
    cell: fn(&Row<'_>) -> (String, Role),
}

/// What a line is made from.
struct Row<'a> {
    vehicle: &'a Vehicle,
    session: &'a Session,
    alert: Option<Alert>,
    selected: bool,
}

/// In the order of display. Ranks say which go first when the screen is narrow.
const COLUMNS: &[Column] = &[
    column("id", 3, 0, true, id),
    column("name", 10, 12, false, name),
    column("mode", 9, 2, false, mode),
    column("armed", 5, 3, false, armed),
    column("state", 7, 6, false, landed),
    column("alt m", 6, 4, true, altitude),
    column("m/s", 4, 8, true, speed),
    column("bat", 4, 5, true, battery),
    column("GPS", 8, 11, false, gps),
    column("link", 5, 9, true, link),
    column("home m", 6, 10, true, home),
    column("command", COMMAND_WIDTH, 7, false, command),
    column("to go m", 7, 13, true, to_go),
    column("hdg", 3, 14, true, heading),
    column("climb", 5, 15, true, climb),
    column("volt", 4, 16, true, voltage),
    column("alert", 14, 1, false, alert_cell),
];
/// Columns from this rank on are an extra: they only come once alerts have this much more room than they need.
const EXTRA_RANK: u8 = 13;
const ALERT_EXTRA: u16 = 26;

const fn column(
    title: &'static str,
    width: u16,
    rank: u8,
    right: bool,
    cell: fn(&Row<'_>) -> (String, Role),
) -> Column {
    Column {
        title,
        width,
        rank,
        right,
        cell,
    }
}

/// Rows that the table would like to have: a rule, the titles, and a row for each vehicle, or what there is to know
/// while there is none.
pub fn height(session: &Session, width: u16) -> usize {
    let rows = match session.vehicles.len() {
        0 => waiting_lines(&session.links, width).len(),
        count => count,
    };
    rows + 2
}

/// What there is to know while nobody has been heard: how the links are doing.
fn waiting_lines(links: &[LinkSummary], width: u16) -> Vec<(String, Role)> {
    let waiting = "  waiting for the first vehicle ...".to_owned();
    let mut lines = vec![(waiting, Role::Muted)];
    for link in links {
        let reason = link.error.as_deref().unwrap_or(&link.state);
        let role = if link.error.is_some() {
            Role::Warning
        } else {
            Role::Muted
        };
        let text = format!("{}: {reason}", link.name);
        let wrapped = wrap(&text, usize::from(width).saturating_sub(2));
        lines.extend(wrapped.into_iter().map(|line| (format!("  {line}"), role)));
    }
    lines
}

fn draw_waiting(links: &[LinkSummary], look: &Look, area: Rect, buffer: &mut Buffer) {
    let lines = waiting_lines(links, area.width).into_iter();
    for (row, (text, role)) in lines.enumerate() {
        put(
            buffer,
            area,
            row as u16,
            &Line::styled(text, look.style(role)),
        );
    }
}

/// Draws the table.
pub fn draw(state: &State, look: &Look, area: Rect, buffer: &mut Buffer) {
    let session = &state.session;
    let rows = usize::from(area.height.saturating_sub(2));
    let count = session.vehicles.len();
    // The cursor stays in the middle while the list scrolls under it.
    let first = session
        .cursor_row()
        .saturating_sub(rows / 2)
        .min(count.saturating_sub(rows));
    let inner = titled(&title(session, first, rows), look, area, buffer);
    let columns = fitting(inner.width);
    draw_titles(&columns, look, inner, buffer);
    let list = below(inner, 1);
    if count == 0 {
        draw_waiting(&session.links, look, list, buffer);
    }
    let seen = session.vehicles.values().skip(first).take(rows);
    for (at, vehicle) in seen.enumerate() {
        let line = Rect {
            y: list.y + at as u16,
            height: 1,
            ..list
        };
        draw_vehicle(vehicle, state, &columns, (look, line), buffer);
    }
}

fn title(session: &Session, first: usize, rows: usize) -> String {
    let count = session.vehicles.len();
    let mut parts = vec!["swarm".to_owned()];
    if count > rows {
        let last = (first + rows).min(count);
        parts.push(format!("{}-{last} of {count}", first + 1));
    }
    if !session.selection.is_empty() {
        let chosen = clip(&ranges(session.selection.iter().copied()), 40);
        parts.push(format!("selected {}: {chosen}", session.selection.len()));
    }
    parts.join("  ")
}

/// The columns that fit, with their widths; the last one takes what is left.
fn fitting(width: u16) -> Vec<(&'static Column, u16)> {
    let mut by_rank: Vec<&Column> = COLUMNS.iter().collect();
    by_rank.sort_by_key(|column| column.rank);
    // Two marks in front: cursor and selection.
    let mut left = width.saturating_sub(2);
    let mut worst = 0;
    for column in by_rank {
        let spared = if column.rank >= EXTRA_RANK {
            ALERT_EXTRA
        } else {
            0
        };
        if column.width + 1 + spared > left {
            break;
        }
        left -= column.width + 1;
        worst = column.rank;
    }
    let kept = COLUMNS.iter().filter(|column| column.rank <= worst);
    let mut columns: Vec<_> = kept.map(|column| (column, column.width)).collect();
    if let Some((_, width)) = columns.last_mut() {
        *width += left;
    }
    columns
}

fn draw_titles(columns: &[(&Column, u16)], look: &Look, area: Rect, buffer: &mut Buffer) {
    let titles = columns
        .iter()
        .map(|(column, width)| aligned(column.title, *width, column.right));
    let line = format!("   {}", titles.collect::<Vec<_>>().join(" "));
    put(
        buffer,
        area,
        0,
        &Line::styled(line, look.style(Role::Muted)),
    );
}

fn draw_vehicle(
    vehicle: &Vehicle,
    state: &State,
    columns: &[(&Column, u16)],
    (look, area): (&Look, Rect),
    buffer: &mut Buffer,
) {
    let session = &state.session;
    let under_cursor = session.cursor == Some(vehicle.id);
    let selected = session.selection.contains(&vehicle.id);
    let row = Row {
        vehicle,
        session,
        alert: alert(vehicle, state.now),
        selected,
    };
    let cursor_mark = if under_cursor { ">" } else { " " };
    let selection_mark = if selected { "*" } else { " " };
    let mut line = Line::from(vec![
        Span::raw(cursor_mark),
        Span::styled(selection_mark, look.style(Role::Selected)),
    ]);
    for (column, width) in columns {
        let (text, role) = (column.cell)(&row);
        let text = format!(" {}", aligned(&text, *width, column.right));
        line.push_span(Span::styled(text, look.style(role)));
    }
    put(buffer, area, 0, &line);
    if under_cursor {
        buffer.set_style(area, look.style(Role::Cursor));
    }
}

/// A text cut or filled up to a width.
fn aligned(text: &str, width: u16, right: bool) -> String {
    let text = clip(text, usize::from(width));
    let missing = usize::from(width).saturating_sub(Span::raw(&text).width());
    let blanks = " ".repeat(missing);
    if right {
        blanks + &text
    } else {
        text + &blanks
    }
}

/// A number that may not be known.
fn number(value: Option<f64>, decimals: usize) -> (String, Role) {
    match value {
        Some(value) => (format!("{value:.decimals$}"), Role::Text),
        None => unknown(),
    }
}

fn unknown() -> (String, Role) {
    ("-".to_owned(), Role::Muted)
}

fn id(row: &Row<'_>) -> (String, Role) {
    let role = if row.selected {
        Role::Selected
    } else {
        Role::Text
    };
    (row.vehicle.id.to_string(), role)
}

fn name(row: &Row<'_>) -> (String, Role) {
    (Session::name(row.vehicle).to_string(), Role::Muted)
}

fn mode(row: &Row<'_>) -> (String, Role) {
    row.vehicle
        .mode()
        .map_or_else(unknown, |mode| (mode.to_string(), Role::Text))
}

fn armed(row: &Row<'_>) -> (String, Role) {
    let vehicle = row.vehicle;
    if vehicle.heartbeat.is_none() {
        unknown()
    } else if vehicle.armed() {
        ("ARMED".to_owned(), Role::Accent)
    } else if vehicle.ready_to_arm() {
        ("ready".to_owned(), Role::Ok)
    } else {
        ("safe".to_owned(), Role::Muted)
    }
}

fn landed(row: &Row<'_>) -> (String, Role) {
    let text = match row.vehicle.landed {
        LandedState::Undefined => return unknown(),
        LandedState::OnGround => return ("ground".to_owned(), Role::Muted),
        LandedState::InAir => "air",
        LandedState::Takeoff => "takeoff",
        LandedState::Landing => "landing",
    };
    (text.to_owned(), Role::Text)
}

fn altitude(row: &Row<'_>) -> (String, Role) {
    number(row.vehicle.altitude_m(), 1)
}

fn speed(row: &Row<'_>) -> (String, Role) {
    number(row.vehicle.ground_speed_m_s().map(f64::from), 1)
}

fn battery(row: &Row<'_>) -> (String, Role) {
    let battery = row.vehicle.battery();
    let Some(left) = battery.and_then(|battery| battery.remaining_percent) else {
        let voltage = battery.and_then(|battery| battery.voltage_v);
        return voltage.map_or_else(unknown, |voltage| (format!("{voltage:.1}"), Role::Text));
    };
    let role = match left {
        0..=10 => Role::Danger,
        11..=25 => Role::Warning,
        _ => Role::Text,
    };
    (format!("{left}%"), role)
}

fn gps(row: &Row<'_>) -> (String, Role) {
    let Some(gps) = row.vehicle.gps else {
        return unknown();
    };
    let role = if gps.fix < FixType::Fix3d {
        Role::Warning
    } else {
        Role::Text
    };
    let satellites = gps
        .satellites
        .map_or(String::new(), |count| format!(" {count}"));
    (format!("{}{satellites}", gps.fix), role)
}

fn link(row: &Row<'_>) -> (String, Role) {
    let link = &row.vehicle.link;
    if link.lost {
        return ("LOST".to_owned(), Role::Danger);
    }
    let role = if link.percent() < 90 {
        Role::Warning
    } else {
        Role::Text
    };
    (format!("{}%", link.percent()), role)
}

fn home(row: &Row<'_>) -> (String, Role) {
    number(row.vehicle.distance_home_m(), 0)
}

/// How far away the target is.
fn to_go(row: &Row<'_>) -> (String, Role) {
    let target = row.vehicle.target.and_then(|target| target.at_point);
    let distance = row.vehicle.global.zip(target);
    number(
        distance.map(|(global, to)| global.at_point.distance_m(to)),
        0,
    )
}

fn heading(row: &Row<'_>) -> (String, Role) {
    number(row.vehicle.heading_deg().map(f64::from), 0)
}

fn climb(row: &Row<'_>) -> (String, Role) {
    // Adding zero turns a rounded -0 into +0, which does not flicker.
    let climb = row
        .vehicle
        .global
        .map(|global| (-global.down_m_s * 10.0).round() / 10.0 + 0.0);
    number(climb.map(f64::from), 1)
}

fn voltage(row: &Row<'_>) -> (String, Role) {
    let voltage = row.vehicle.battery().and_then(|battery| battery.voltage_v);
    number(voltage.map(f64::from), 1)
}

fn command(row: &Row<'_>) -> (String, Role) {
    let Some((entry, line)) = row.session.latest(row.vehicle.id) else {
        return (String::new(), Role::Muted);
    };
    let state = match line.state {
        RowState::Done => "done".to_owned(),
        RowState::InProgress(percent) => format!("{percent} %"),
        RowState::Sent if line.tries > 1 => format!("try {}", line.tries),
        other => other.to_string(),
    };
    // The state is what must not be cut off.
    let width = usize::from(COMMAND_WIDTH).saturating_sub(state.chars().count() + 1);
    (
        format!("{} {state}", clip(&entry.verb, width)),
        row_role(line.state),
    )
}

fn alert_cell(row: &Row<'_>) -> (String, Role) {
    match &row.alert {
        Some(alert) => (alert.text.to_string(), severity_role(alert.severity)),
        None => (String::new(), Role::Text),
    }
}
