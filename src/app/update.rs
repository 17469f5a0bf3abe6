//! The one function that changes the state.

use super::effect::Effect;
use super::event::Event;
use super::state::State;

pub(super) mod act;
mod keys;
mod offer;
mod order;
mod palette;
mod telemetry;

/// Takes in what happened and says what the shell has to do.
pub fn update(state: &mut State, event: Event) -> Vec<Effect> {
    match event {
        Event::Tick { now } => {
            telemetry::tick(state, now);
            return Vec::new();
        }
        Event::Vehicle(vehicle) => {
            telemetry::vehicle(state, *vehicle);
            return Vec::new();
        }
        _ => state.touch(),
    }
    match event {
        Event::Key(key) => return keys::press(state, key),
        Event::Paste(text) => keys::paste(state, &text),
        Event::Started(started) => telemetry::started(state, *started),
        Event::Notice(notice) => return telemetry::notice(state, &notice),
        Event::NoticesDropped(count) => state.notices.dropped = count,
        Event::Row(row) => state.session.ledger.apply(&row),
        Event::Links(links) => state.session.links = links,
        Event::Mission(progress) => telemetry::progress(state, *progress),
        Event::MissionEnded(report) => telemetry::ended(state, report),
        Event::Failed(text) => telemetry::failed(state, text),
        Event::Resize { columns, rows } => keys::resize(state, columns, rows),
        Event::Tick { .. } | Event::Vehicle(_) => {}
    }
    Vec::new()
}
