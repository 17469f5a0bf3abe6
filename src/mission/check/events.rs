//! Whether every event can come to happen.

use super::Examined;
use crate::mission::event::{Action, Event, Trigger};

/// Events that wait for one another in a circle, so that none is ever the first.
pub(super) fn check(examined: &mut Examined<'_>) {
    let events = &examined.mission.events;
    let tables = examined.tables("events");
    for (first, written) in tables.iter().enumerate() {
        let Some(circle) = circle(events, first) else {
            continue;
        };
        // Told once, with the one that stands first in the file.
        if circle.iter().any(|&index| index < first) || is_begun(events, &circle) {
            continue;
        }
        let place = written.span_of("after");
        let name = |index: &usize| events.get(*index).map(|event| format!("`{}`", event.id));
        let names: Vec<String> = circle.iter().filter_map(name).collect();
        let fault = match names.as_slice() {
            [alone] => format!("{alone} waits for itself and never happens"),
            all => format!(
                "these events wait for one another and never happen: {}",
                all.join(" after ")
            ),
        };
        examined.add(place, fault);
    }
}

/// The events that one waits for, itself first, if it waits for itself in the end.
fn circle(events: &[Event], first: usize) -> Option<Vec<usize>> {
    let mut chain = vec![first];
    loop {
        let last = events.get(*chain.last()?)?;
        let Trigger::After(before, _) = last.trigger else {
            return None;
        };
        if before == first {
            return Some(chain);
        }
        // A circle that it only waits for is that of the others.
        if chain.contains(&before) {
            return None;
        }
        chain.push(before);
    }
}

/// Whether an event outside the circle triggers one inside it.
fn is_begun(events: &[Event], circle: &[usize]) -> bool {
    let others = events
        .iter()
        .enumerate()
        .filter(|(index, _)| !circle.contains(index));
    let mut actions = others.flat_map(|(_, event)| &event.actions);
    actions.any(|action| matches!(action, Action::Event(index) if circle.contains(index)))
}
