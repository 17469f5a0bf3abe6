//! Reports as lines: news, each once, and the state on demand.

use std::collections::{BTreeMap, BTreeSet};

use super::brief;
use crate::alert::AlertKind;
use crate::app::State;
use crate::app::state::{Alert, FlightView, Hangar, HelpLine, NoticeLine, command_help};
use crate::geo::maths;
use crate::language::{Channel, Report, VehicleChoice};
use crate::ledger::{EntryId, LedgerEntry};
use crate::mission::{ObjectiveProgress, ObjectiveState, ShownContact, Trust};
use crate::notice::Notice;
use crate::text::{Text, figure, text};
use crate::vehicle::{Severity, Vehicle, VehicleId};
use crate::vehicle_id::ranges;

/// How long the newest notice may still collect identical ones.
const FOLD_TIME: std::time::Duration = std::time::Duration::from_secs(10);
/// The number of commands and notices listed on demand.
const LISTED: usize = 20;

/// The state of the flight as printed so far.
#[derive(Debug, Default)]
pub struct PlainReport {
    /// The newest printed notice, and its count.
    notice: Option<(Notice, u32)>,
    /// The first command whose outcome is not printed yet.
    next: Option<EntryId>,
    /// Commands that had not ended at the last call.
    open: Vec<EntryId>,
    /// The decided objectives, and the hint.
    objectives: BTreeMap<usize, ObjectiveState>,
    hint: Option<Text>,
    /// The number of contacts printed.
    contacts: usize,
    /// The last printed stages of starting vehicles.
    stages: Option<Text>,
    /// The standing alerts that are printed.
    alerts: BTreeSet<PrintedAlert>,
}

/// A printed alert. It is printed again when it becomes more serious, and when it returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct PrintedAlert {
    vehicle: VehicleId,
    kind: AlertKind,
    severity: Severity,
}

impl PlainReport {
    /// The news since the last call.
    pub fn news(&mut self, state: &State) -> Vec<Text> {
        let mut texts: Vec<Text> = self.new_stages(state).into_iter().collect();
        texts.extend(self.new_notices(state));
        texts.extend(self.new_alerts(state));
        texts.extend(self.ended_commands(state));
        texts.extend(self.decided_objectives(state));
        texts.extend(self.new_contacts(state));
        texts
    }

    /// The stages of the vehicles' processes, while they start.
    fn new_stages(&mut self, state: &State) -> Option<Text> {
        let hangar = state
            .session()
            .hangar()
            .filter(|hangar| !hangar.has_begun())?;
        let stages = stages(hangar);
        let is_new = !hangar.instances().is_empty() && self.stages.as_ref() != Some(&stages);
        is_new.then(|| {
            self.stages = Some(stages.clone());
            text!("hangar-plain-stages", stages = stages)
        })
    }

    fn new_notices(&mut self, state: &State) -> Vec<Text> {
        let mut texts = Vec::new();
        let said = self.notice.as_ref();
        let is_new = |line: &&NoticeLine| said.is_none_or(|(notice, _)| *notice != line.notice);
        let mut lines: Vec<&NoticeLine> =
            state.notices().lines().rev().take_while(is_new).collect();
        lines.reverse();
        if let Some((notice, count)) = &mut self.notice {
            let closed = !lines.is_empty() || state.now().saturating_sub(notice.at) > FOLD_TIME;
            let mut known = state.notices().lines().rev();
            let line = known.find(|line| line.notice == *notice);
            if let Some(line) = line.filter(|line| closed && line.count > *count) {
                texts.push(notice_text(line, state.session()));
                *count = line.count;
            }
        }
        for line in lines {
            texts.push(notice_text(line, state.session()));
            self.notice = Some((line.notice.clone(), line.count));
        }
        texts
    }

    /// The alerts that were raised; vehicles with the same one are merged.
    fn new_alerts(&mut self, state: &State) -> Vec<Text> {
        let session = state.session();
        let mut standing = BTreeSet::new();
        let mut raised: Vec<(&Alert, Vec<VehicleId>)> = Vec::new();
        for (vehicle, one) in session.alarms().open() {
            let printed = PrintedAlert {
                vehicle,
                kind: one.alert.kind,
                severity: one.alert.severity,
            };
            standing.insert(printed);
            if self.alerts.contains(&printed) {
                continue;
            }
            match raised.iter_mut().find(|(alert, _)| **alert == one.alert) {
                Some((_, vehicles)) => vehicles.push(vehicle),
                None => raised.push((&one.alert, vec![vehicle])),
            }
        }
        self.alerts = standing;
        let now = clock(session, state.now());
        let line = |(alert, vehicles): (&Alert, Vec<VehicleId>)| {
            let head = Text::from(format!("{now} {}", ranges(vehicles)));
            let parts = std::iter::once(head).chain(severity_word(alert.severity));
            Text::joined(": ", parts.chain([alert.text.clone()]).collect())
        };
        raised.into_iter().map(line).collect()
    }

    fn ended_commands(&mut self, state: &State) -> Vec<Text> {
        let ledger = state.session().ledger();
        for entry in ledger.entries().rev() {
            if self.next.is_some_and(|next| entry.id < next) {
                break;
            }
            self.open.push(entry.id);
        }
        self.open.sort_unstable();
        if let Some(newest) = ledger.entries().next_back() {
            self.next = Some(EntryId(newest.id.0 + 1));
        }
        let mut texts = Vec::new();
        self.open.retain(|&id| match ledger.entry(id) {
            Some(entry) if !entry.is_final() => true,
            Some(entry) => {
                texts.push(outcome(entry));
                false
            }
            None => false,
        });
        texts
    }

    fn new_contacts(&mut self, state: &State) -> Vec<Text> {
        let contacts = state
            .session()
            .mission()
            .into_iter()
            .flat_map(|it| &it.contacts);
        let texts: Vec<Text> = contacts.skip(self.contacts).map(contact_text).collect();
        self.contacts += texts.len();
        texts
    }

    fn decided_objectives(&mut self, state: &State) -> Vec<Text> {
        let Some(mission) = state.session().mission() else {
            return Vec::new();
        };
        let mut texts = Vec::new();
        for (at, objective) in mission.objectives.iter().enumerate() {
            let before = self.objectives.insert(at, objective.state);
            if before.is_some_and(|before| before != objective.state) {
                texts.push(objective_text(objective));
            }
        }
        if mission.hint != self.hint {
            self.hint.clone_from(&mission.hint);
            let hint = mission.hint.iter();
            texts.extend(hint.map(|hint| text!("plain-hint", hint = hint)));
        }
        texts
    }
}

/// The stages of processes; vehicles at the same stage are merged.
fn stages(hangar: &Hangar) -> Text {
    let mut together: Vec<(Text, Vec<VehicleId>)> = Vec::new();
    for instance in hangar.instances() {
        let says = instance.says();
        match together.iter_mut().find(|(known, _)| *known == says) {
            Some((_, vehicles)) => vehicles.push(instance.vehicle),
            None => together.push((says, vec![instance.vehicle])),
        }
    }
    let stage = |(stage, vehicles): (Text, Vec<VehicleId>)| {
        let vehicles = ranges(vehicles);
        text!("hangar-plain-stage", vehicles = vehicles, stage = stage)
    };
    Text::joined(", ", together.into_iter().map(stage).collect())
}

/// The vehicles' processes, on demand.
fn hangar(state: &State) -> Vec<Text> {
    match state.session().hangar() {
        Some(hangar) => vec![stages(hangar)],
        None => vec![text!("hangar-plain-none")],
    }
}

fn clock(session: &FlightView, at: std::time::Duration) -> String {
    let seconds = session.time(at).as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}

/// The word before a serious text.
fn severity_word(severity: Severity) -> Option<Text> {
    match severity {
        Severity::Emergency | Severity::Alert | Severity::Critical => Some(text!("plain-critical")),
        Severity::Error => Some(text!("plain-error")),
        Severity::Warning => Some(text!("plain-warning")),
        Severity::Notice | Severity::Info | Severity::Debug => None,
    }
}

fn notice_text(line: &NoticeLine, session: &FlightView) -> Text {
    let notice = &line.notice;
    let mut head = clock(session, notice.at);
    let vehicles = ranges(line.vehicles.iter().copied());
    if !vehicles.is_empty() {
        head.push(' ');
        head.push_str(&vehicles);
    }
    let mut parts = vec![Text::from(head)];
    parts.extend(severity_word(notice.severity));
    parts.push(notice.text.clone());
    if line.count as usize > line.vehicles.len().max(1) {
        parts.push(text!("plain-times", count = line.count));
    }
    Text::joined(": ", parts)
}

/// The outcome of a command for a vehicle: its state, and the reason.
type Fate = (Text, Option<Text>);

/// A command and its outcome; vehicles with the same outcome are merged.
fn outcome(entry: &LedgerEntry) -> Text {
    let mut groups: Vec<(Fate, Vec<VehicleId>)> = Vec::new();
    for row in &entry.rows {
        let explanation = row.remark().map(|text| text.regarding(""));
        let fate = (row.state.text(), explanation);
        match groups.iter_mut().find(|(known, _)| *known == fate) {
            Some((_, ids)) => ids.push(row.vehicle),
            None => groups.push((fate, vec![row.vehicle])),
        }
    }
    let parts = groups.into_iter().map(|((state, explanation), ids)| {
        let vehicles = ranges(ids);
        let explanation = explanation.map(|text| text.regarding(&vehicles));
        let state = Text::joined(" ", vec![vehicles.into(), state]);
        Text::joined(", ", std::iter::once(state).chain(explanation).collect())
    });
    let parts = Text::joined("; ", parts.collect());
    Text::joined(": ", vec![entry.line.as_str().into(), parts])
}

fn objective_text(objective: &ObjectiveProgress) -> Text {
    let (title, detail) = (&objective.title, &objective.detail);
    let words = Text::joined(", ", vec![title.clone(), detail.clone()]);
    match objective.state {
        ObjectiveState::Open => text!("plain-objective-open", objective = words),
        ObjectiveState::Met => text!("plain-objective-met", objective = words),
        ObjectiveState::Missed => text!("plain-objective-missed", objective = words),
    }
}

fn objectives(state: &State) -> Vec<Text> {
    let Some(mission) = state.session().mission() else {
        return vec![text!("mission-none")];
    };
    let mut texts: Vec<Text> = mission.objectives.iter().map(objective_text).collect();
    if let Some(score) = mission.score_so_far {
        texts.push(text!("plain-score", score = score));
    }
    let left = mission.limit.saturating_sub(mission.elapsed);
    texts.push(text!("plain-time-left", seconds = left.as_secs()));
    texts
}

fn contact_text(contact: &ShownContact) -> Text {
    let trust = match contact.trust {
        Trust::Seen => text!("map-legend-seen"),
        Trust::Confirmed => text!("map-legend-confirmed"),
        Trust::Reported => text!("map-legend-reported"),
    };
    let (latitude, longitude) = (contact.at.lat_deg, contact.at.lon_deg);
    text!(
        "plain-contact",
        name = &contact.name,
        kind = contact.kind.name(),
        place = format!("{latitude:.6} {longitude:.6}"),
        trust = trust
    )
}

/// The contacts, and the trainee's reports.
fn contacts(state: &State) -> Vec<Text> {
    let Some(mission) = state.session().mission() else {
        return vec![text!("mission-none")];
    };
    let marks = text!("mission-marks-count", count = mission.marks.len());
    let contacts = mission.contacts.iter().map(contact_text);
    contacts.chain([marks]).collect()
}

/// The state of vehicles: the chosen ones, otherwise the targets of a command, otherwise all.
fn status(state: &State, choice: Option<&VehicleChoice>) -> Vec<Text> {
    let vehicles = state.session().vehicles();
    let chosen = match choice {
        Some(choice) => state.chosen(choice),
        None if state.session().selection().is_empty() => state.chosen(&VehicleChoice::All),
        None => Ok(state.addressed()),
    };
    let ids = match chosen {
        Ok(ids) => ids,
        Err(fault) => return vec![fault],
    };
    let known: Vec<Text> = ids
        .iter()
        .filter_map(|id| vehicles.get(id))
        .map(|vehicle| vehicle_text(vehicle, state))
        .collect();
    if known.is_empty() {
        return vec![text!("select-missing", vehicles = ranges(ids))];
    }
    known
}

fn vehicle_text(vehicle: &Vehicle, state: &State) -> Text {
    let mut parts: Vec<Text> = Vec::new();
    if let Some(heartbeat) = vehicle.heartbeat {
        parts.push(heartbeat.mode.to_string().into());
        let armed = if heartbeat.armed {
            text!("plain-armed")
        } else {
            text!("plain-disarmed")
        };
        parts.push(armed);
    }
    if let Some(at) = vehicle.global {
        let height = format!("{:.1}", at.altitude_m);
        let speed = format!("{:.1}", maths::hypot_f32(at.north_m_s, at.east_m_s));
        parts.push(text!("plain-flight", height = height, speed = speed));
        if let Some(home) = vehicle.home {
            let far = format!("{:.0}", home.at_point.distance_m(at.at_point));
            parts.push(text!("plain-home", distance = far));
        }
    }
    if let Some(left) = vehicle
        .battery()
        .and_then(|battery| battery.remaining_percent)
    {
        parts.push(text!("plain-battery", percent = left));
    }
    if let Some(way_home) = vehicle.way_home() {
        let needed = figure(way_home.needed_percent.ceil(), 0);
        parts.push(text!("plain-way-home", needed = needed));
    }
    if let Some(alert) = state.session().alert(vehicle, state.now()) {
        parts.push(alert.text);
    }
    text!(
        "plain-vehicle",
        vehicle = vehicle.id.to_string(),
        state = Text::joined(", ", parts)
    )
}

fn ledger(state: &State) -> Vec<Text> {
    let entries = state.session().ledger().entries();
    let skipped = entries.len().saturating_sub(LISTED);
    entries.skip(skipped).map(outcome).collect()
}

/// The state of the links, and their faults.
fn links(state: &State) -> Vec<Text> {
    let session = state.session();
    let links = session.links().iter().map(|link| {
        text!(
            "plain-link",
            name = &link.name,
            state = link.error.as_ref().unwrap_or(&link.state),
            received = format!("{:.0}", link.messages_in_per_s),
            sent = format!("{:.0}", link.messages_out_per_s),
            lost = link.lost.iter().map(|(_, count)| count).sum::<u64>(),
        )
    });
    let forwards = session.forwards().iter().map(|forward| {
        let state = if forward.up {
            text!("links-up")
        } else {
            forward.error.clone().unwrap_or(text!("links-down"))
        };
        text!(
            "plain-forward",
            name = &forward.name,
            state = state,
            stations = forward.peers,
            received = forward.received_messages,
            bytes_in = forward.received_bytes,
            sent = forward.sent_messages,
            bytes_out = forward.sent_bytes,
            dropped = forward.dropped,
            filtered = forward.filtered,
            held = forward.held_back,
            repeated = forward.repeated,
        )
    });
    let findings = session.findings().iter();
    let ailments = findings.flat_map(|finding| [finding.cause.says(), finding.advice()]);
    links.chain(forwards).chain(ailments).collect()
}

fn notices(state: &State) -> Vec<Text> {
    let lines = state.notices().lines();
    let skipped = lines.len().saturating_sub(LISTED);
    let lines = lines.skip(skipped);
    lines
        .map(|line| notice_text(line, state.session()))
        .collect()
}

/// The lines of a report.
pub fn texts(report: &Report, state: &State) -> Vec<Text> {
    match report {
        Report::Status(vehicles) => status(state, vehicles.as_ref()),
        Report::Objectives => objectives(state),
        Report::Contacts => contacts(state),
        Report::Help => help(state),
        Report::Links => links(state),
        Report::Ledger => ledger(state),
        Report::Notices => notices(state),
        Report::Hangar => hangar(state),
        Report::Brief => brief::lines(state),
    }
}

fn help(state: &State) -> Vec<Text> {
    let general = command_help(Channel::Plain, state.locale())
        .into_iter()
        .map(|line| match line {
            HelpLine::Title(title) => title.into(),
            HelpLine::Entry(what, meaning) if meaning.is_empty() => what.into(),
            HelpLine::Entry(what, meaning) => Text::joined(": ", vec![what.into(), meaning.into()]),
            HelpLine::Note(note) => format!("  {note}").into(),
            HelpLine::Blank => Text::default(),
        });
    general.collect()
}

#[cfg(test)]
mod tests;
