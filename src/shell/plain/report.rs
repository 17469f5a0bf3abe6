//! Reports as lines: news, each once, and the state on demand.

use std::time::Duration;

use super::brief;
use crate::app::State;
use crate::app::state::{FlightView, HelpLine, command_help};
use crate::language::{Channel, Report};
use crate::text::{Text, text};
use crate::vehicle::Severity;

mod alerts;
mod commands;
mod links;
mod mission;
mod notices;
mod processes;
#[cfg(test)]
mod tests;
mod traffic;
mod vehicles;

use alerts::PrintedAlerts;
use commands::PrintedCommands;
use mission::PrintedMission;
use notices::PrintedNotices;
use processes::PrintedStages;

/// The number of commands and notices listed on demand.
const LISTED: usize = 20;

/// The state of the flight as printed so far.
#[derive(Debug, Default)]
pub struct PlainReport {
    stages: PrintedStages,
    notices: PrintedNotices,
    alerts: PrintedAlerts,
    commands: PrintedCommands,
    mission: PrintedMission,
}

impl PlainReport {
    /// Whether there is news that should not wait: what the desk of a class has said.
    pub fn is_urgent(&self, state: &State) -> bool {
        self.notices.has_word_of_class(state)
    }

    /// Another flight begins, of which nothing has been printed.
    pub fn begin_flight(&mut self) {
        *self = Self {
            notices: std::mem::take(&mut self.notices),
            ..Self::default()
        };
    }

    /// The news since the last call.
    pub fn news(&mut self, state: &State) -> Vec<Text> {
        let mut texts: Vec<Text> = self.stages.news(state).into_iter().collect();
        texts.extend(self.notices.news(state));
        texts.extend(self.alerts.news(state));
        texts.extend(self.commands.news(state));
        texts.extend(self.mission.news(state));
        texts
    }
}

/// The lines of a report.
pub fn texts(report: &Report, state: &State) -> Vec<Text> {
    match report {
        Report::Status(vehicles) => vehicles::status(state, vehicles.as_ref()),
        Report::Objectives => mission::objectives(state),
        Report::Contacts => mission::contacts(state),
        Report::Help => help(state),
        Report::Links => links::now(state),
        Report::Ledger => commands::newest(state),
        Report::Notices => notices::newest(state),
        Report::Traffic => traffic::now(state),
        Report::Hangar => processes::now(state),
        Report::Class => vec![state.class_role().place_text()],
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
            HelpLine::Note(text) | HelpLine::Usage(text) => format!("  {text}").into(),
            HelpLine::Blank => Text::default(),
        });
    general.collect()
}

fn clock(session: &FlightView, at: Duration) -> String {
    let seconds = session.time(at).as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}

/// The word before a serious text; `None` before other texts.
fn severity_word(severity: Severity) -> Option<Text> {
    match severity {
        Severity::Emergency | Severity::Alert | Severity::Critical => Some(text!("plain-critical")),
        Severity::Error => Some(text!("plain-error")),
        Severity::Warning => Some(text!("plain-warning")),
        Severity::Notice | Severity::Info | Severity::Debug => None,
    }
}
