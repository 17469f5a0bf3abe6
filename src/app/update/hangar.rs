//! What the hangar says of the vehicles' processes.

use super::telemetry;
use crate::app::room::{Room, hangar};
use crate::app::state::{Instance, Stage, State};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// Lines of output that are kept of the process that is looked at.
const LINES_KEPT: usize = 500;

/// Takes over how the processes are doing, and says what is worth a notice.
pub fn changed(state: &mut State, instances: &[Instance]) {
    let Some(known) = &mut state.session.hangar else {
        return;
    };
    let before = std::mem::replace(&mut known.instances, instances.to_vec());
    let begins = !known.begun && known.is_ready();
    known.begun |= begins;
    let was = |vehicle| before.iter().find(|one: &&Instance| one.vehicle == vehicle);
    for instance in instances {
        if let Some((severity, text)) = news(was(instance.vehicle), instance) {
            say(state, Some(instance.vehicle), severity, text);
        }
    }
    let crashed = instances.iter().filter(|one| one.has_crashed());
    state.session.alarms.down = crashed.map(|one| one.vehicle).collect();
    for vehicle in state.session.vehicles.values() {
        state.session.alarms.observe(vehicle, state.now);
    }
    hangar::keep_cursor(state);
    if begins {
        begin(state, instances.len());
    }
}

/// They could not be started.
pub fn not_launched(state: &mut State, text: Text) {
    if let Some(known) = &mut state.session.hangar {
        known.fault = Some(text.clone());
    }
    telemetry::failed(state, text);
}

/// Takes over what a process has printed. Who has scrolled back goes on seeing the same lines.
pub fn printed(state: &mut State, vehicle: VehicleId, anew: bool, mut lines: Vec<String>) {
    let Some(known) = &mut state.session.hangar else {
        return;
    };
    let room = &mut state.rooms.hangar;
    if room.back > 0 && !anew {
        room.back += lines.len();
    }
    if let Some((_, before)) = known.printed.take_if(|(of, _)| *of == vehicle && !anew) {
        lines.splice(0..0, before);
    }
    lines.drain(..lines.len().saturating_sub(LINES_KEPT));
    known.printed = Some((vehicle, lines));
}

/// All are ready: whoever has waited for that is led to the flight.
fn begin(state: &mut State, count: usize) {
    say(
        state,
        None,
        Severity::Info,
        text!("hangar-all-ready", count = count),
    );
    state.session.began_at = state.now;
    if state.room == Room::Hangar {
        state.room = state.session.first_room;
        state.hush();
    }
}

/// What has become of an instance since it was looked at last.
fn news(before: Option<&Instance>, now: &Instance) -> Option<(Severity, Text)> {
    let crashed_before = before.is_some_and(Instance::has_crashed);
    if now.has_crashed() && !crashed_before {
        return Some((Severity::Critical, crash(now)));
    }
    let restarts = before.map_or(0, |before| before.restarts);
    if now.restarts > restarts {
        let text = text!("hangar-restarted", count = now.restarts);
        return Some((Severity::Notice, text));
    }
    let was_ready = before.is_some_and(|before| before.stage == Stage::Ready);
    if now.restarts > 0 && now.stage == Stage::Ready && !was_ready && before.is_some() {
        return Some((Severity::Info, text!("hangar-ready-again")));
    }
    None
}

/// Why a process has ended, what it said last, and what to do.
fn crash(instance: &Instance) -> Text {
    let reason = instance.fault.clone().unwrap_or_default();
    let last = instance
        .output
        .iter()
        .rev()
        .find(|line| !line.trim().is_empty());
    let what = match last {
        Some(line) => text!("hangar-crash-said", reason = reason, line = line.trim()),
        None => text!("hangar-crash", reason = reason),
    };
    let next = instance.hint.iter().map(|hint| hint.as_str().into());
    let again = text!(
        "hangar-crash-again",
        key = Room::Hangar.key().to_string(),
        vehicle = instance.vehicle
    );
    let parts = std::iter::once(what).chain(next).chain([again]);
    Text::joined("; ", parts.collect())
}

fn say(state: &mut State, vehicle: Option<VehicleId>, severity: Severity, text: Text) {
    let at = state.now;
    let notice = Notice {
        at,
        vehicle,
        severity,
        text,
    };
    telemetry::notice(state, &notice);
}
