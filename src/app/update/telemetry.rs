//! Events from the shell: time, vehicles, notices, the mission's course.

use std::sync::Arc;
use std::time::Duration;

use crate::alert::AlertKind;
use crate::app::State;
use crate::app::effect::{Effect, Effects, TerminalEffect};
use crate::app::lesson;
use crate::app::room::Room;
use crate::app::room::debrief::Debrief;
use crate::app::room::map;
use crate::app::room::mission;
use crate::app::room::{fly, ledger};
use crate::app::state::{
    Activity, BellCall, FlightView, Overlay, TrafficPicture, separation_limits, too_close,
};
use crate::doctor::Cause;
use crate::ledger::RowState;
use crate::mission::Progress;
use crate::notice::Notice;
use crate::scoring::Report;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::GROUND_STATION_SYSTEM;

/// If a notice reported an alert's condition within this time before the alert begins, the alert
/// gets no notice of its own.
const ANNOUNCED_WITHIN: Duration = Duration::from_secs(5);
/// The interval between checks of the distances between vehicles and to other aircraft, in
/// milliseconds.
const SEPARATION_MS: u128 = 500;
/// How long after the last news of this console's own command a new mode counts as its effect.
const MODE_FOLLOWS_WITHIN: Duration = Duration::from_secs(5);

/// Advances wall time and, except in a replay, flight time.
pub fn tick(state: &mut State, now: Duration, wall: Duration) {
    // Messages are shown for whole seconds, and the debrief shows when it accepts keys.
    let before = (state.wall.as_secs(), state.is_deaf());
    (state.wall, state.clock) = (wall, now);
    if before != (wall.as_secs(), state.is_deaf()) {
        state.touch();
    }
    if state.replay.is_none() {
        pass(state, now);
    }
}

pub fn pass(state: &mut State, now: Duration) {
    // The clock shows seconds; nothing else on the screen depends on time.
    let before = state.now.as_secs();
    let before_ms = state.now.as_millis();
    state.now = now;
    map::tick(state);
    if before_ms / SEPARATION_MS != now.as_millis() / SEPARATION_MS {
        watch_separation(state);
        watch_fences(state);
        watch_traffic(state);
    }
    if before != now.as_secs() {
        watch(state);
    }
    let session = &mut state.session;
    let is_sampled = session.histories.sample(&session.vehicles, now);
    let is_curve_longer = is_sampled && state.room == Room::Vehicle;
    if fly::tick(state) | ledger::tick(state) | is_curve_longer {
        state.touch();
    }
    if before != now.as_secs() {
        state.touch();
    }
}

/// Stores a vehicle's snapshot, unless its session has ended.
pub fn vehicle(state: &mut State, vehicle: Arc<Vehicle>) {
    let session = &mut state.session;
    let is_known = |known: &Arc<Vehicle>| Arc::ptr_eq(known, &vehicle);
    if session.activity.is_none() || session.vehicles.get(&vehicle.id).is_some_and(is_known) {
        return;
    }
    let id = vehicle.id;
    let reserve_percent = session.reserve_percent();
    if !session.expects(id) {
        session.alerts.strangers.insert(id);
    }
    session.alerts.observe(&vehicle, reserve_percent, state.now);
    let strange = strange_mode(state, &vehicle);
    let session = &mut state.session;
    let is_new = !session.vehicles.contains_key(&id);
    session.insert(vehicle);
    map::heard(state, id);
    if is_new {
        fly::heard(state, id);
        if !state.session.expects(id) {
            let text = text!("vehicle-unexpected");
            let notice = Notice::about(id, state.now, Severity::Warning, text);
            state.notices.push(notice);
        }
    }
    if let Some(notice) = strange {
        state.notices.push(notice);
    }
    note_begun(state);
    state.touch();
}

/// A notice that a vehicle's mode was not set by this console, while another ground station is on the link: the vehicle
/// answers that station alone, so its command is not heard.
fn strange_mode(state: &State, vehicle: &Vehicle) -> Option<Notice> {
    let session = &state.session;
    let before = session.vehicles.get(&vehicle.id)?.mode()?;
    let mode = vehicle.mode().filter(|mode| *mode != before)?;
    let is_live =
        matches!(session.activity, Some(Activity::Connected { .. })) && state.replay.is_none();
    let is_own = session.latest(vehicle.id).is_some_and(|(_, row)| {
        row.state != RowState::Overtaken
            && state.now.saturating_sub(row.changed_at) < MODE_FOLLOWS_WITHIN
    });
    if !is_live || is_own {
        return None;
    }
    let findings = session.connections.findings.iter();
    let stations = findings.filter_map(|finding| match finding.cause {
        Cause::OtherStation(system, component) => Some((system, component)),
        _ => None,
    });
    // A loop of forwards brings back the console's own heartbeat as well.
    let own = state.config.connect.station;
    let own = own.unwrap_or(GROUND_STATION_SYSTEM);
    let (system, component) = stations.min_by_key(|&(system, _)| system == own)?;
    let text = text!(
        "mode-of-another",
        mode = vehicle.name_of(mode),
        system = system,
        component = component
    );
    Some(Notice::about(vehicle.id, state.now, Severity::Notice, text))
}

/// Adds notices of alerts that have begun and were not reported yet.
fn note_begun(state: &mut State) {
    let since = state.now.saturating_sub(ANNOUNCED_WITHIN);
    for (vehicle, alert) in state.session.alerts.take_begun() {
        if !state.notices.reports(alert.kind, vehicle, since) {
            state.notices.push(Notice {
                kind: Some(alert.kind),
                ..Notice::about(vehicle, state.now, alert.severity, alert.text)
            });
        }
    }
}

/// Finds vehicles that are too close to each other. In a mission, the mission's own rules about
/// distances apply instead.
fn watch_separation(state: &mut State) {
    let session = &mut state.session;
    if matches!(
        session.activity,
        Some(Activity::Free | Activity::Connected { .. })
    ) {
        let limits = separation_limits(&state.config.alerts);
        let close = too_close(&session.vehicles, limits);
        session.alerts.note_close(close);
    }
}

/// Finds vehicles outside the mission's fences. They break a rule as long as they stay there.
fn watch_fences(state: &mut State) {
    let breaches = state.session.breaches();
    state.session.alerts.note_breaches(breaches);
}

fn watch_traffic(state: &mut State) {
    let session = &mut state.session;
    let mission = session.task.progress.as_ref();
    let picture = TrafficPicture::new(&session.vehicles, mission, state.now);
    if picture.is_empty() && session.traffic.is_empty() {
        return;
    }
    session.alerts.note_traffic(picture.conflicts());
    session.traffic = picture;
    state.touch();
}

/// Checks all vehicles again, because some alerts end as time passes.
fn watch(state: &mut State) {
    let session = &mut state.session;
    let reserve_percent = session.reserve_percent();
    for vehicle in session.vehicles.values() {
        session.alerts.observe(vehicle, reserve_percent, state.now);
    }
    note_begun(state);
}

/// The signals that are due.
pub fn signals(state: &mut State) -> Effects {
    let due = state.session.alerts.due(state.now);
    if state.shows_past() {
        // The bell rang during the flight itself.
        return Effects::none();
    }
    let alerts = &state.config.alerts;
    let ring = (due.ring && alerts.bell).then_some(TerminalEffect::Bell);
    let note = due
        .note
        .filter(|_| alerts.notify)
        .map(TerminalEffect::Notify);
    ring.into_iter().chain(note).map(Effect::Terminal).collect()
}

pub fn notice(state: &mut State, notice: &Notice) {
    state.touch();
    state.notices.push(notice.clone());
    // A warning without a vehicle would not show in rooms without notices.
    if notice.vehicle.is_none() && notice.severity <= Severity::Warning && state.room != Room::Fly {
        state.say(notice.severity, notice.text.clone());
    }
    if notice.severity <= Severity::Critical {
        let call = BellCall {
            kind: notice.kind.unwrap_or(AlertKind::Message),
            severity: notice.severity,
            vehicle: notice.vehicle,
            text: notice.text.clone(),
            worse: false,
        };
        state.session.alerts.hear(state.now, call);
    }
}

pub fn progress(state: &mut State, mut progress: Progress) {
    if state.session.activity.is_some() {
        if let (Some(career), Some(mission)) = (&state.training.career, state.flown_mission()) {
            career.fade(&mission.id, &mut progress);
        }
        // In a replay, past advice is not advice now. Hints that the pilot asked for are part of the flight.
        if state.shows_past() {
            (progress.lesson, progress.hint) = (None, None);
        }
        leave_read_brief(state, &progress);
        lesson::name_key(state, &mut progress);
        // The mission's clock runs, so it has begun.
        if !progress.elapsed.is_zero() {
            state.session.leave_brief();
        }
        let clock = &mut state.session.timing.clock;
        clock.note(state.now, progress.elapsed);
        note_height(&mut state.session, progress.elapsed);
        state.rooms.mission.hear(&progress);
        map::measured(state, &progress);
        // New places can be named from now on.
        state.session.places.extend(progress.places.clone());
        // Events add and remove areas.
        state.session.task.areas.clone_from(&progress.areas);
        let given = |progress: &Progress| progress.clues.given.len();
        let is_asked = state.session.task.progress.as_ref().map_or(0, given) < given(&progress);
        state.session.task.progress = Some(progress);
        if is_asked && state.room == Room::Mission {
            mission::show_asked_hint(state);
        }
        watch_traffic(state);
    }
}

/// At a member of a crew, shows the flight once the host's mission has begun.
fn leave_read_brief(state: &mut State, progress: &Progress) {
    let before = state.session.task.progress.as_ref();
    let had_begun = before.is_some_and(|it| !it.elapsed.is_zero());
    let begins = !had_begun && !progress.elapsed.is_zero();
    if state.is_following() && begins && state.room == Room::Mission {
        state.room = Room::Fly;
    }
}

/// Records the height of the highest vehicle in contact.
fn note_height(session: &mut FlightView, elapsed: Duration) {
    let heard = session.vehicles.values().filter(|it| !it.link.lost);
    let heights_m = heard.filter_map(|it| it.altitude_m());
    let highest_m = heights_m.filter(|it| it.is_finite()).reduce(f64::max);
    session.task.heights.note(elapsed, highest_m);
}

/// Stores the debrief and, except in a replay, shows it. An open command line stays on top;
/// otherwise the rest of a line being typed would act on the debrief.
pub fn ended(state: &mut State, mut report: Box<Report>) {
    // That of a replay is from the record.
    if state.replay.is_none() {
        report.instructor = state.session.instructor.clone();
    }
    if !report.tries.is_empty() {
        let tries = report.tries.clone();
        state.training.tries.insert(report.mission.clone(), tries);
    }
    let debrief = Debrief {
        heights: state.session.task.heights.clone(),
        report,
        scroll: 0,
        map: false,
        since: state.wall,
    };
    let is_replay = state.replay.is_some();
    state.rooms.debrief.store(debrief, is_replay);
    state.session.task.over = true;
    if state.shows_past() {
        return;
    }
    state.room = Room::Debrief;
    if !matches!(state.overlay, Some(Overlay::Palette(_))) {
        state.overlay = None;
    }
}

/// Stores the number of dropped notices.
pub fn dropped(state: &mut State, count: u64) {
    state.notices.dropped = count;
    state.touch();
}

/// Shows the shell's answer.
pub fn answer(state: &mut State, text: Text) {
    state.say(Severity::Notice, text);
    state.touch();
}

pub fn failed(state: &mut State, text: Text) {
    state.touch();
    // In a replay, the notices are those of the recorded flight.
    if state.replay.is_none() {
        let notice = Notice::general(state.now, Severity::Error, text.clone());
        state.notices.push(notice);
    }
    // A replay that could not be opened is not expected any more.
    state.rooms.class.replay_asked = None;
    if let Some(Overlay::Prompt(prompt)) = &mut state.overlay {
        prompt.fault = Some(text);
    } else {
        state.say(Severity::Error, text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::Setup;
    use crate::app::state::ReplayView;
    use crate::geo::LatLon;
    use crate::mission::Stake;
    use crate::vehicle::{GlobalPosition, LandedState, VehicleId};

    fn said_in(room: Room, vehicle: Option<VehicleId>, severity: Severity) -> Option<String> {
        let mut state = State::new(Setup::default());
        state.room = room;
        let text = Text::from("not recorded");
        notice(
            &mut state,
            &Notice {
                vehicle,
                ..Notice::general(Duration::ZERO, severity, text)
            },
        );
        assert_eq!(state.notices.lines().count(), 1);
        state.message().map(|message| message.text.to_string())
    }

    #[test]
    fn what_warns_of_no_vehicle_is_said_in_rooms_without_notices() {
        let said = Some("not recorded".to_owned());
        let one = 1;
        assert_eq!(said_in(Room::Mission, None, Severity::Warning), said);
        assert_eq!(said_in(Room::Map, None, Severity::Error), said);
        assert_eq!(said_in(Room::Fly, None, Severity::Warning), None);
        assert_eq!(said_in(Room::Mission, None, Severity::Info), None);
        assert_eq!(said_in(Room::Mission, Some(one), Severity::Warning), None);
    }

    fn flying(id: u8, east_m: f64) -> Arc<Vehicle> {
        let mut flying = Vehicle::new(id, 1);
        flying.landed = LandedState::InAir;
        flying.global = Some(GlobalPosition {
            at_point: LatLon::new(50.45, 30.52).moved(0.0, east_m),
            altitude_amsl_m: 190.0,
            altitude_m: 20.0,
            north_m_s: 0.0,
            east_m_s: 0.0,
            down_m_s: 0.0,
            heading_deg: None,
            at: Duration::ZERO,
        });
        Arc::new(flying)
    }

    /// The alert of the first of two vehicles that fly 3 m apart.
    fn near(activity: Activity, prepare: impl Fn(&mut State)) -> Option<String> {
        let mut state = State::new(Setup::default());
        state.session = FlightView::new(activity, std::collections::BTreeMap::new());
        prepare(&mut state);
        state.session.alerts.mute(&state.config.alerts.mute);
        for (id, east_m) in [(1, 0.0), (2, 3.0)] {
            vehicle(&mut state, flying(id, east_m));
        }
        pass(&mut state, Duration::from_secs(2));
        let alert = state.session.alerts.pressing()?;
        assert_eq!(alert.first.alert.kind, AlertKind::Separation);
        assert_eq!(alert.vehicles, [1, 2]);
        let text = alert.first.alert.text.to_string();
        vehicle(&mut state, flying(2, 30.0));
        pass(&mut state, Duration::from_secs(3));
        assert!(state.session.alerts.pressing().is_none(), "they are apart");
        Some(text)
    }

    #[test]
    fn vehicles_that_come_too_close_outside_of_a_mission_raise_an_alert() {
        let text = near(Activity::Free, |_| {}).expect("an alert");
        assert!(text.contains("2: 3 m"), "{text}");
        let connected = Activity::Connected {
            addresses: Vec::new(),
        };
        assert!(near(connected, |_| {}).is_some());
        let mission = Activity::Mission {
            id: "01".to_owned(),
            title: Text::from("a mission"),
            stake: Stake::Graded,
        };
        assert_eq!(near(mission, |_| {}), None);
        let narrow = |state: &mut State| state.config.alerts.separation = 2;
        assert_eq!(near(Activity::Free, narrow), None);
        let muted = |state: &mut State| state.config.alerts.mute = vec![AlertKind::Separation];
        assert_eq!(near(Activity::Free, muted), None);
    }

    #[test]
    fn a_failure_in_a_replay_is_none_of_the_recorded_notices() {
        let fault = || Text::from("no such moment");
        let mut state = State::new(Setup::default());
        failed(&mut state, fault());
        assert_eq!(state.notices.lines().count(), 1);
        state.replay = Some(ReplayView::new("a".to_owned(), 0, Duration::ZERO));
        failed(&mut state, fault());
        assert_eq!(state.notices.lines().count(), 1);
        assert_eq!(state.message().map(|it| it.text.clone()), Some(fault()));
    }
}
