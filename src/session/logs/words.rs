//! Lists of logs as text.

use super::ListedLog;
use crate::text;
use crate::text::{Text, figure, utc_of};

/// The maximum number of logs in a text. The newest are listed, since they are usually wanted.
const MOST_NAMED: usize = 10;

fn kilobytes(bytes: u64) -> String {
    figure(bytes as f64 / 1000.0, 1)
}

/// The list as text: number, size and time of the newest logs.
pub(super) fn list(logs: &[ListedLog]) -> Text {
    if logs.is_empty() {
        return text!("outcome-logs-none");
    }
    let newest = logs.iter().rev().take(MOST_NAMED).map(|log| {
        let size = kilobytes(u64::from(log.size));
        if log.time_utc_s == 0 {
            text!("outcome-log-listed", number = log.number, size = size)
        } else {
            let time = utc_of(u64::from(log.time_utc_s) * 1_000_000);
            text!(
                "outcome-log-listed-at",
                number = log.number,
                size = size,
                time = time
            )
        }
    });
    let bytes = logs.iter().map(|it| u64::from(it.size)).sum();
    text!(
        "outcome-logs-listed",
        count = logs.len(),
        size = kilobytes(bytes),
        logs = Text::joined("; ", newest.collect())
    )
}

/// A log that has been downloaded completely.
#[derive(Debug, Clone)]
pub(super) struct WholeLog {
    pub log: ListedLog,
    pub file: String,
    /// How it was received; `None` if it was complete before.
    pub way: Option<LogWay>,
}

/// How a log was received, and whether it matches the vehicle's file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct LogWay {
    pub carrier: LogCarrier,
    pub check: FileCheck,
}

/// How the last bytes of a log were received.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LogCarrier {
    Messages,
    File,
}

/// The result of comparing the checksum with that of the vehicle's file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum FileCheck {
    Same,
    /// The checksum differs, although the log was read twice.
    Other,
    /// The vehicle has added to the file since: its checksum does not apply to the listed log.
    Grown,
    /// The vehicle gives no checksum, with the reason; `None` if it offers no files.
    Unknown(Option<Text>),
}

impl LogWay {
    fn words(&self) -> Text {
        let carrier = match self.carrier {
            LogCarrier::Messages => text!("outcome-log-by-messages"),
            LogCarrier::File => text!("outcome-log-by-file"),
        };
        let check = match &self.check {
            FileCheck::Same => Some(text!("outcome-log-sum-same")),
            FileCheck::Other => Some(text!("outcome-log-sum-other")),
            FileCheck::Grown => Some(text!("outcome-log-sum-grown")),
            FileCheck::Unknown(reason) => reason
                .as_ref()
                .map(|reason| text!("outcome-log-sum-none", reason = reason)),
        };
        Text::joined(", ", [Some(carrier), check].into_iter().flatten().collect())
    }
}

/// The stored logs as text, and how they were received.
pub(super) fn kept(logs: &[WholeLog]) -> Text {
    let paths: Vec<&str> = logs.iter().map(|log| log.file.as_str()).collect();
    let bytes = logs.iter().map(|it| u64::from(it.log.size)).sum();
    let mut ways: Vec<&LogWay> = Vec::new();
    for way in logs.iter().filter_map(|it| it.way.as_ref()) {
        if !ways.contains(&way) {
            ways.push(way);
        }
    }
    let (size, files) = (kilobytes(bytes), paths.join(", "));
    if ways.is_empty() {
        return text!("outcome-logs-kept", size = size, files = files);
    }
    let ways = Text::joined("; ", ways.into_iter().map(LogWay::words).collect());
    text!(
        "outcome-logs-kept-by",
        size = size,
        files = files,
        ways = ways
    )
}
