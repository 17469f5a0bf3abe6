//! Whether every event can occur.

use super::Examined;
use crate::mission::event::{Action, Event, Trigger};
use crate::text;

/// Reports events that wait for one another in a circle, so none can occur.
pub(super) fn check(examined: &mut Examined<'_>) {
    let events = &examined.mission.events;
    let tables = examined.tables("events");
    for (first, written) in tables.iter().enumerate() {
        let Some(circle) = circle(events, first) else {
            continue;
        };
        // A cycle is reported once, for its first event in the file.
        if circle.iter().any(|&index| index < first) || is_begun(events, &circle) {
            continue;
        }
        let place = written.span_of("after");
        let name = |index: &usize| events.get(*index).map(|event| format!("`{}`", event.id));
        let names: Vec<String> = circle.iter().filter_map(name).collect();
        let fault = match names.as_slice() {
            [alone] => text!("check-event-itself", event = alone),
            all => text!("check-events-circle", events = all.join(" after ")),
        };
        examined.add(place, fault);
    }
}

/// The chain of events by which the event `first` waits for itself, beginning with that event;
/// `None` if it does not.
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
        // This event leads into a cycle without being part of it; the cycle's own events report it.
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
