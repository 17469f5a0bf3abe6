//! The seat under the cursor: the orders to it, and what happened there lately.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::seconds;
use crate::class::{Deed, Entry, GivenOrder, Happening, OrderState, Outcome, SeatRecord};
use crate::class_text::{deed_text, order_ended_text};
use crate::text;
use crate::text::{Text, clock};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put};
use crate::vehicle_id::ranges;

/// The number of orders that are shown however much happened at the seat.
const ORDERS: usize = 3;

pub fn draw(seat: &SeatRecord, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.titled(&title(seat), buffer);
    let standing = taken(seat)
        .into_iter()
        .chain(situations(seat))
        .chain(armed(seat));
    let standing: Vec<(Text, Role)> = standing.collect();
    let rows = usize::from(inner.height).saturating_sub(standing.len());
    // Older orders have the rows that would stay empty.
    let orders = rows.saturating_sub(happened(seat).count()).max(ORDERS);
    let lines = standing.into_iter().chain(events(seat, orders));
    draw_lines(lines, panel.at(inner), buffer);
}

/// The newest orders, at most so many, and what happened at the seat, the newest first.
pub(super) fn events(seat: &SeatRecord, orders: usize) -> impl Iterator<Item = (Text, Role)> {
    let orders = seat.orders().rev().take(orders).map(order);
    orders.chain(happened(seat))
}

/// What happened at the seat, the newest first.
fn happened(seat: &SeatRecord) -> impl Iterator<Item = (Text, Role)> {
    let missing = seat.journal.missing();
    let missing = (missing > 0).then(|| (text!("class-missing", count = missing), Role::Warning));
    let journal = seat.journal.entries().rev();
    let journal = journal.filter_map(|it| entry(it, seat));
    missing.into_iter().chain(journal)
}

/// The injects that the seat's mission permits, after those that are armed.
pub fn draw_injects(seat: &SeatRecord, panel: Panel<'_>, buffer: &mut Buffer) {
    let title = text!("class-injects-title", seat = title(seat));
    let inner = panel.titled(&panel.text(&title), buffer);
    let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
    let offered = flight.map_or(&[][..], |it| &it.injects);
    let none = offered.is_empty();
    let in_mission = flight.is_some_and(|it| it.mission.is_some());
    let why = || {
        if in_mission {
            text!("class-no-injects")
        } else {
            text!("class-no-mission")
        }
    };
    let none = none.then(|| (why(), Role::Muted));
    let offered = offered.iter().map(|inject| {
        let (name, title) = (inject.name.as_str(), inject.title.as_str());
        (
            text!("class-inject", name = name, title = title),
            Role::Text,
        )
    });
    let lines = armed(seat).chain(none).chain(offered);
    draw_lines(lines, panel.at(inner), buffer);
}

/// The name of the seat, and that of the trainee.
pub(super) fn title(seat: &SeatRecord) -> String {
    let trainee = seat.report.as_ref().map(|report| report.trainee.as_str());
    let trainee = trainee.filter(|it| !it.is_empty() && *it != seat.name);
    match trainee {
        Some(trainee) => format!("{} ({trainee})", seat.name),
        None => seat.name.clone(),
    }
}

pub(super) fn draw_lines(
    lines: impl Iterator<Item = (Text, Role)>,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let columns = usize::from(panel.area.width);
    for (row, (text, role)) in (0..panel.area.height).zip(lines) {
        let line = clip(&panel.text(&text), columns);
        put(
            buffer,
            panel.area,
            row,
            &Line::from(Span::styled(line, panel.style(role))),
        );
    }
}

/// The vehicles that the instructor flies.
pub(super) fn taken(seat: &SeatRecord) -> Option<(Text, Role)> {
    let taken = &seat.report.as_ref()?.flight.as_ref()?.taken;
    let vehicles = ranges(taken.iter().copied());
    (!taken.is_empty()).then(|| (text!("class-taken", vehicles = vehicles), Role::Warning))
}

/// The situations that were captured, with their numbers.
fn situations(seat: &SeatRecord) -> Option<(Text, Role)> {
    let situations = &seat.report.as_ref()?.flight.as_ref()?.situations;
    let numbered = (1..).zip(situations).map(|(number, it)| {
        let clock = clock(seconds(it.clock_s));
        if it.is_named {
            format!("{number} {} {clock}", it.name)
        } else {
            format!("{number} {clock}")
        }
    });
    let all = numbered.collect::<Vec<_>>().join(", ");
    (!situations.is_empty()).then(|| (text!("class-situations", all = all), Role::Accent))
}

/// The injects that wait for their conditions.
pub(super) fn armed(seat: &SeatRecord) -> impl Iterator<Item = (Text, Role)> {
    let flight = seat.report.as_ref().and_then(|it| it.flight.as_ref());
    let armed = flight.map_or(&[][..], |it| &it.armed).iter();
    armed.map(|it| {
        let (name, when) = (it.name.as_str(), it.when.as_str());
        (
            text!("class-armed-inject", name = name, when = when),
            Role::Accent,
        )
    })
}

/// An order with its state.
fn order(given: &GivenOrder) -> (Text, Role) {
    let (state, role) = match given.state {
        OrderState::Waiting => (text!("class-waiting"), Role::Accent),
        OrderState::Ended(outcome) => {
            let role = match outcome {
                Outcome::Done => Role::Ok,
                Outcome::Armed | Outcome::UnderWay => Role::Accent,
                Outcome::NoEffect | Outcome::Disarmed | Outcome::Refused(_) => Role::Warning,
            };
            let deed = &given.order.deed;
            (order_ended_text(deed, outcome, given.why.as_ref()), role)
        }
        OrderState::Unanswered => (text!("class-unanswered"), Role::Warning),
    };
    let deed = deed_text(&given.order.deed);
    (text!("class-order", deed = deed, state = state), role)
}

/// An entry of the journal; `None` for the outcome of an order that is shown with the order. An armed inject comes long
/// after its order, so it is shown here, too. Orders of a desk that was open before are known from their outcomes only.
fn entry(entry: &Entry, seat: &SeatRecord) -> Option<(Text, Role)> {
    let (what, role) = match &entry.what {
        Happening::Started {
            mission: Some(mission),
        } => (
            text!("class-started", mission = mission.as_str()),
            Role::Text,
        ),
        Happening::Started { mission: None } => (text!("class-started-free"), Role::Text),
        Happening::Command { line } => (Text::verbatim(line.as_str()), Role::Text),
        Happening::Failed { line, vehicle } => (
            text!("class-failed", line = line.as_str(), vehicle = *vehicle),
            Role::Warning,
        ),
        Happening::Objective { title } => {
            (text!("class-objective", title = title.as_str()), Role::Ok)
        }
        Happening::Ended {
            score,
            passed: true,
        } => (text!("class-passed", score = *score), Role::Ok),
        Happening::Ended {
            score,
            passed: false,
        } => (text!("class-not-passed", score = *score), Role::Warning),
        Happening::Order {
            deed: deed @ Deed::Inject { when: Some(_), .. },
            outcome: outcome @ Outcome::Done,
            why,
            ..
        } => {
            let state = order_ended_text(deed, *outcome, why.as_ref());
            let deed = deed_text(deed);
            (
                text!("class-order", deed = deed, state = state),
                Role::Accent,
            )
        }
        Happening::Order { id, .. } if seat.orders().any(|it| it.order.id == *id) => return None,
        Happening::Order {
            deed, outcome, why, ..
        } => {
            let state = order_ended_text(deed, *outcome, why.as_ref());
            let deed = deed_text(deed);
            (
                text!("class-order", deed = deed, state = state),
                Role::Muted,
            )
        }
    };
    let time = entry
        .clock_s
        .map_or_else(|| "  -  ".to_owned(), |it| clock(seconds(it)));
    Some((Text::joined("  ", vec![time.into(), what]), role))
}
