//! Lists of logs in words.

use super::ListedLog;
use crate::text;
use crate::text::{Text, figure, utc_of};

/// Logs that a list names; the newest are the ones that are wanted.
const MOST_NAMED: usize = 10;

fn kilobytes(bytes: u64) -> String {
    figure(bytes as f64 / 1000.0, 1)
}

/// The list in words: number, size and time of the newest.
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

/// What was kept, in words.
pub(super) fn kept(files: &[(ListedLog, String)]) -> Text {
    let paths: Vec<&str> = files.iter().map(|(_, path)| path.as_str()).collect();
    let bytes = files.iter().map(|(log, _)| u64::from(log.size)).sum();
    text!(
        "outcome-logs-kept",
        size = kilobytes(bytes),
        files = paths.join(", ")
    )
}
