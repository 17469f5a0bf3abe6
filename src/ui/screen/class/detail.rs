//! The seat under the cursor: the orders to it, and what happened there lately.

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::seconds;
use crate::class::{Entry, GivenOrder, Happening, OrderState, Outcome, SeatRecord};
use crate::class_text::{deed_text, outcome_text};
use crate::text;
use crate::text::{Text, clock};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, put};

/// The maximum number of orders shown.
const ORDERS: usize = 3;

pub fn draw(seat: &SeatRecord, panel: Panel<'_>, buffer: &mut Buffer) {
    let trainee = seat.report.as_ref().map(|report| report.trainee.as_str());
    let trainee = trainee.filter(|it| !it.is_empty() && *it != seat.name);
    let title = match trainee {
        Some(trainee) => format!("{} ({trainee})", seat.name),
        None => seat.name.clone(),
    };
    let inner = panel.titled(&title, buffer);
    let orders = seat.orders().rev().take(ORDERS).map(order);
    let missing = seat.journal.missing();
    let missing = (missing > 0).then(|| (text!("class-missing", count = missing), Role::Warning));
    let journal = seat.journal.entries().rev().filter_map(entry);
    let lines = orders.chain(missing).chain(journal);
    let columns = usize::from(inner.width);
    for (row, (text, role)) in (0..inner.height).zip(lines) {
        let line = clip(&panel.text(&text), columns);
        put(
            buffer,
            inner,
            row,
            &Line::from(Span::styled(line, panel.style(role))),
        );
    }
}

/// An order with its state.
fn order(given: &GivenOrder) -> (Text, Role) {
    let (state, role) = match given.state {
        OrderState::Waiting => (text!("class-waiting"), Role::Accent),
        OrderState::Ended(Outcome::Done) => (outcome_text(Outcome::Done), Role::Ok),
        OrderState::Ended(outcome) => (outcome_text(outcome), Role::Warning),
        OrderState::Unanswered => (text!("class-unanswered"), Role::Warning),
    };
    let deed = deed_text(&given.order.deed);
    (text!("class-order", deed = deed, state = state), role)
}

/// An entry of the journal; `None` for the outcome of an order, which is shown with the order.
fn entry(entry: &Entry) -> Option<(Text, Role)> {
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
        Happening::Order { .. } => return None,
    };
    let time = entry
        .clock_s
        .map_or_else(|| "  -  ".to_owned(), |it| clock(seconds(it)));
    Some((Text::joined("  ", vec![time.into(), what]), role))
}
