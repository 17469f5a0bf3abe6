//! The messages and reports of a session, until they are taken.

use mavlink::dialects::ardupilotmega::MavMessage;

use super::Report;
use crate::ledger::RowUpdate;
use crate::notice::Notice;
use crate::wire::Outgoing;

/// A session's messages and reports.
#[derive(Debug, Clone, Default)]
pub(super) struct Output {
    pub messages: Vec<Outgoing>,
    /// Acknowledgements of `DO_CHANGE_SPEED` that no order waits for.
    pub speed_acks: u8,
    /// The commands whose acknowledgements no order waits for, each as often as it was sent.
    pub unawaited: Vec<u16>,
    pub reports: Vec<Report>,
}

impl Output {
    /// Sends messages to the vehicle.
    pub fn send(&mut self, messages: Vec<MavMessage>) {
        let messages = messages.into_iter().map(Outgoing::from);
        self.messages.extend(messages);
    }

    /// Repeats speeds that were set before.
    pub fn say_speeds(&mut self, speeds: Vec<Outgoing>) {
        let count = u8::try_from(speeds.len()).unwrap_or(u8::MAX);
        self.speed_acks = self.speed_acks.saturating_add(count);
        self.messages.extend(speeds);
    }

    /// Reports notices to the user.
    pub fn say(&mut self, notices: impl IntoIterator<Item = Notice>) {
        let reports = notices.into_iter().map(Report::Notice);
        self.reports.extend(reports);
    }

    /// Reports the progress of a command.
    pub fn row(&mut self, update: RowUpdate) {
        self.reports.push(Report::Row(update));
    }
}
