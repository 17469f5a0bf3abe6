//! The outcomes of orders about files in words.

use crate::session::FtpEntry;
use crate::text;
use crate::text::Text;

/// The maximum number of entries that an outcome names; a room lists all.
const MOST_NAMED: usize = 40;

/// The entries of a folder on one line: folders end with `/`, files have their size.
pub(super) fn entries_text(entries: &[FtpEntry]) -> Text {
    if entries.is_empty() {
        return text!("outcome-folder-empty");
    }
    let named = entries
        .iter()
        .take(MOST_NAMED)
        .map(|entry| match entry.size {
            Some(size) => format!("{} ({size} B)", entry.name),
            None => format!("{}/", entry.name),
        });
    let mut names: Vec<String> = named.collect();
    if entries.len() > MOST_NAMED {
        names.push("..".to_owned());
    }
    text!(
        "outcome-folder",
        count = entries.len(),
        names = names.join(", ")
    )
}

/// A file was copied to this machine.
pub(super) fn got(file: &str, bytes: usize, is_verified: bool) -> Text {
    if is_verified {
        text!("outcome-file-got-verified", file = file, bytes = bytes)
    } else {
        text!("outcome-file-got", file = file, bytes = bytes)
    }
}

/// A file was copied to the vehicle.
pub(super) fn put(bytes: usize, is_verified: bool) -> Text {
    if is_verified {
        text!("outcome-file-put-verified", bytes = bytes)
    } else {
        text!("outcome-file-put", bytes = bytes)
    }
}
