//! Reports on links: the doctor's findings, and their messages.

use std::time::Duration;

use crate::app::State;
use crate::app::room::messages::LinkTraffic;
use crate::app::state::Room;
use crate::doctor::{Cause, LinkFinding, Weight};
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// How long after the start of a session the absence of vehicles is not reported.
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

/// Stores a count of the messages.
pub fn traffic(state: &mut State, traffic: Vec<LinkTraffic>) {
    if state.session.activity.is_none() || state.rooms.messages.paused {
        return;
    }
    state.rooms.messages.take(traffic);
    if state.room == Room::Messages {
        state.touch();
    }
}

/// Reports each finding once per link.
fn tell(state: &mut State, finding: &LinkFinding) {
    let waits = state.session.vehicles.is_empty()
        && state.now.saturating_sub(state.session.timing.began_at) >= PATIENCE;
    let is_news = match finding.cause {
        // A closed link shows its own error, and the fleet reports a duplicate system id.
        Cause::NotOpen | Cause::DuplicateSystem(_) => false,
        Cause::OneWay(_)
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
        | Cause::SignedButAnswers(_)
        | Cause::Noise(_)
        | Cause::Version1(_)
        | Cause::OtherStation(..)
        | Cause::Damaged(_)
        | Cause::Lossy(_)
        | Cause::Recording
        | Cause::Listening
        | Cause::Unanswered(_)
        | Cause::Well(_) => waits && finding.cause.weight() == Weight::Fatal,
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
            finding = finding.cause.says(),
            advice = finding.advice()
        ),
    );
    state.notices.push(notice);
    state.touch();
}
