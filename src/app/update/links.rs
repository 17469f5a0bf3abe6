//! Reports on links: the doctor's findings, and the links' messages.

use std::time::Duration;

use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect, FileKind};
use crate::app::room::messages::LinkTraffic;
use crate::app::state::Room;
use crate::doctor::{Cause, LinkFinding};
use crate::inspector::{CountedLink, StatisticsFormat, statistics_table};
use crate::language::MessagesLine;
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// How long after the start of a session a link without a vehicle is not reported.
const PATIENCE: Duration = Duration::from_secs(5);

/// Stores the doctor's findings, and adds notices of those that need action.
pub fn findings(state: &mut State, findings: Vec<LinkFinding>) {
    if state.session.activity.is_none() {
        return;
    }
    state.rooms.links.note(&state.session.connections.links);
    let is_new = state.session.connections.findings != findings;
    state.session.connections.findings = findings;
    if is_new || state.room == Room::Links {
        state.touch();
    }
    for finding in state.session.connections.findings.clone() {
        tell(state, &finding);
    }
}

/// Stores a count of the messages, and exports it if the user has requested that.
pub fn traffic(state: &mut State, traffic: Vec<LinkTraffic>) -> Effects {
    if state.session.activity.is_none() || state.rooms.messages.paused {
        return Effects::none();
    }
    let is_count = traffic.iter().any(|link| link.census.is_some());
    state.rooms.messages.take(traffic);
    if state.room == Room::Messages {
        state.touch();
    }
    let path = state.session.connections.export_to.take_if(|_| is_count);
    path.map_or_else(Effects::none, |path| export(state, path))
}

/// Carries out a line about the messages on the links.
///
/// # Errors
/// There is no session, the statistics are paused and cannot be reset, or the file's extension is
/// unknown.
pub fn messages_line(state: &mut State, line: MessagesLine) -> Result<Effects, Text> {
    if state.session.activity.is_none() {
        return Err(text!("messages-no-links"));
    }
    let is_paused = state.rooms.messages.paused;
    match line {
        MessagesLine::Reset if is_paused => return Err(text!("messages-reset-paused")),
        MessagesLine::Reset => {
            state.session.connections.statistics_resets += 1;
            state.say(Severity::Info, text!("messages-reset"));
        }
        MessagesLine::Export(path) => {
            StatisticsFormat::of(&path).ok_or_else(|| text!("messages-export-ending"))?;
            // Paused counts are exported as they are shown.
            if is_paused {
                return Ok(export(state, path));
            }
            state.session.connections.export_to = Some(path);
        }
    }
    Ok(Effects::none())
}

/// Writes the statistics of the last count to a file.
fn export(state: &State, path: String) -> Effects {
    let format = StatisticsFormat::of(&path).unwrap_or(StatisticsFormat::Csv);
    let traffic = state.rooms.messages.traffic.iter();
    let names: Vec<String> = traffic
        .clone()
        .map(|link| state.locale.text(&link.name))
        .collect();
    let counted: Vec<CountedLink> = traffic
        .zip(&names)
        .filter_map(|(link, name)| {
            Some(CountedLink {
                name,
                census: link.census.as_ref()?,
                now: link.now,
            })
        })
        .collect();
    Effects::from(Effect::File(FileEffect::Write {
        kind: FileKind::Statistics,
        text: statistics_table(&counted, format),
        path,
        replace: false,
    }))
}

/// Reports a finding, once per link.
fn tell(state: &mut State, finding: &LinkFinding) {
    let waits = state.session.lacks_vehicle(finding)
        && state.now.saturating_sub(state.session.timing.began_at) >= PATIENCE;
    let is_news = match finding.cause {
        // A closed link shows its own error, and the fleet reports a duplicate system id.
        Cause::NotOpen | Cause::DuplicateSystem(_) | Cause::HeardTwice(_) => false,
        Cause::SystemZero
        | Cause::OneWay(_)
        | Cause::OneWayVehicles(_)
        | Cause::Signed(_)
        | Cause::Unsigned(_)
        | Cause::WrongKey(_)
        | Cause::OldStamps(..) => true,
        Cause::Nothing
        | Cause::Text
        | Cause::NoFrame
        | Cause::WrongBaud
        | Cause::UnknownDialect
        | Cause::ForeignMessages(_)
        | Cause::OnlyGroundStations
        | Cause::OwnEcho
        | Cause::NoAutopilot
        | Cause::Missing { .. }
        | Cause::SignedButAnswers(_)
        | Cause::Noise(_)
        | Cause::Version1(_)
        | Cause::OtherStation(..)
        | Cause::Damaged(_)
        | Cause::Lossy(_)
        | Cause::Recording
        | Cause::Listening
        | Cause::Unanswered(_)
        | Cause::Well(_) => waits,
    };
    if !is_news || !state.session.connections.report(finding) {
        return;
    }
    let link = state.session.connections.links.get(finding.link);
    let name = link.map_or_else(Text::default, |link| link.name.clone());
    let notice = Notice::general(
        state.now,
        Severity::Warning,
        text!(
            "doctor-notice",
            link = name,
            finding = finding.says(),
            advice = finding.advice()
        ),
    );
    state.notices.push(notice);
    state.touch();
}
