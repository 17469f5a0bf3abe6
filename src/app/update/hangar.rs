//! Reports on the vehicles' processes.

use super::telemetry;
use crate::alert::AlertKind;
use crate::app::State;
use crate::app::action::{Action, HangarAction};
use crate::app::keymap::{Keymap, Place};
use crate::app::room::{Room, hangar};
use crate::app::state::{Instance, SitlStage};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The maximum number of output lines kept for the process on the screen.
const LINES_KEPT: usize = 500;

/// Stores the state of the processes, and adds notices of important changes.
pub fn changed(state: &mut State, instances: &[Instance]) {
    let Some(known) = &mut state.session.hangar else {
        return;
    };
    let before = std::mem::replace(&mut known.instances, instances.to_vec());
    let begins = !known.begun && known.is_ready();
    known.begun |= begins;
    let was = |vehicle| before.iter().find(|one: &&Instance| one.vehicle == vehicle);
    for instance in instances {
        if let Some(notice) = news(was(instance.vehicle), instance, state) {
            telemetry::notice(state, &notice);
        }
    }
    let crashed = instances.iter().filter(|one| one.has_crashed());
    state.session.alerts.down = crashed.map(|one| one.vehicle).collect();
    let reserve_percent = state.session.reserve_percent();
    let session = &mut state.session;
    for vehicle in session.vehicles.values() {
        session.alerts.observe(vehicle, reserve_percent, state.now);
    }
    hangar::keep_cursor(state);
    if begins {
        begin(state, instances.len());
    }
}

/// Reports that the processes could not be started.
pub fn not_launched(state: &mut State, text: Text) {
    if let Some(known) = &mut state.session.hangar {
        known.fault = Some(text.clone());
    }
    telemetry::failed(state, text);
}

/// Stores new output of a process. A scrolled view keeps showing the same lines.
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

/// Begins the flight once all vehicles are ready; a user who waited in the hangar is taken to it.
fn begin(state: &mut State, count: usize) {
    let ready = Notice::general(
        state.now,
        Severity::Info,
        text!("hangar-all-ready", count = count),
    );
    telemetry::notice(state, &ready);
    state.session.begin(state.now);
    if state.room == Room::Hangar {
        state.room = state.session.first_room;
        state.hush();
    }
}

/// The notice for a change to an instance, if any.
fn news(before: Option<&Instance>, instance: &Instance, state: &State) -> Option<Notice> {
    let notice = |severity, kind, text| Notice {
        kind,
        ..Notice::about(instance.vehicle, state.now, severity, text)
    };
    let crashed_before = before.is_some_and(Instance::has_crashed);
    if instance.has_crashed() && !crashed_before {
        let kind = Some(AlertKind::Process);
        return Some(notice(
            Severity::Critical,
            kind,
            crash(instance, &state.keymap),
        ));
    }
    let restarts = before.map_or(0, |before| before.restarts);
    if instance.restarts > restarts {
        let text = text!("hangar-restarted", count = instance.restarts);
        return Some(notice(Severity::Notice, None, text));
    }
    let was_ready = before.is_some_and(|before| before.stage == SitlStage::Ready);
    let is_ready = instance.stage == SitlStage::Ready;
    if instance.restarts > 0 && is_ready && !was_ready && before.is_some() {
        return Some(notice(Severity::Info, None, text!("hangar-ready-again")));
    }
    None
}

/// The line of a process's last output that tells most about its end: the first of its last errors, otherwise the last
/// line.
fn telling_line(output: &[String]) -> Option<&String> {
    const LOOKED_AT: usize = 20;
    let recent = output.iter().skip(output.len().saturating_sub(LOOKED_AT));
    let is_error = |line: &&String| {
        line.contains("ERROR:") || line.to_lowercase().contains("segmentation fault")
    };
    let mut lines = output.iter().rev();
    let last = lines.find(|line| !line.trim().is_empty());
    recent.clone().find(is_error).or(last)
}

/// The text about a process that ended: the reason, its last output, and the next step.
fn crash(instance: &Instance, keymap: &Keymap) -> Text {
    let reason = instance.fault.clone().unwrap_or_default();
    let what = match telling_line(&instance.output) {
        Some(line) => text!("hangar-crash-said", reason = reason, line = line.trim()),
        None => text!("hangar-crash", reason = reason),
    };
    let next = instance.hint.iter().map(|hint| hint.as_str().into());
    let again = text!(
        "hangar-crash-again",
        key = keymap.key(Action::Show(Room::Hangar), Place::Anywhere),
        again = keymap.key(
            Action::Hangar(HangarAction::RestartProcess),
            Place::In(Room::Hangar)
        ),
        vehicle = instance.vehicle
    );
    let parts = std::iter::once(what).chain(next).chain([again]);
    Text::joined("; ", parts.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_about_a_crash_is_its_error() {
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        let crashed = lines("Loaded\nERROR: segmentation fault - aborting\nNo dump\nFailed\n\n");
        let told = telling_line(&crashed).expect("a line");
        assert_eq!(told, "ERROR: segmentation fault - aborting");
        let plain = lines("Loaded\nFailed\n");
        assert_eq!(telling_line(&plain).expect("a line"), "Failed");
        assert_eq!(telling_line(&[]), None);
    }
}
