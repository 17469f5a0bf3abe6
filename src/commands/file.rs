//! Commands about the files that a vehicle offers (MAVFTP).

use crate::text;
use crate::text::Text;

/// A command about a vehicle's files. Paths on the vehicle are as its server spells them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FileCommand {
    /// The entries of a folder.
    List {
        folder: String,
    },
    /// Copies a file of the vehicle to this machine.
    Get {
        path: String,
        /// The file to write, as the user wrote it; `None` for a name made from that of the vehicle's file.
        to: Option<String>,
    },
    /// Copies a file of this machine to the vehicle; a file of that name is replaced.
    Put {
        /// The file to read, as the user wrote it.
        file: String,
        path: String,
    },
    /// Removes a file, or an empty folder: its path ends with `/`.
    Remove {
        path: String,
    },
    MakeFolder {
        path: String,
    },
    /// The checksum of a file.
    Checksum {
        path: String,
    },
    /// Reads what the vehicle documents about its parameters and events.
    Documentation,
    /// Ends all commands about files.
    Stop,
}

impl FileCommand {
    /// Whether it changes files on the vehicle.
    pub fn changes_files(&self) -> bool {
        match self {
            Self::Put { .. } | Self::Remove { .. } | Self::MakeFolder { .. } => true,
            Self::List { .. }
            | Self::Get { .. }
            | Self::Checksum { .. }
            | Self::Documentation
            | Self::Stop => false,
        }
    }

    /// Why it needs a confirmation; `None` if it needs none.
    pub(super) fn hazard(&self) -> Option<Text> {
        match self {
            Self::Remove { path } => Some(text!("hazard-remove-file", path = path)),
            Self::Put { path, .. } => Some(text!("hazard-put-file", path = path)),
            Self::List { .. }
            | Self::Get { .. }
            | Self::MakeFolder { .. }
            | Self::Checksum { .. }
            | Self::Documentation
            | Self::Stop => None,
        }
    }
}

/// The path of an entry of a folder. Generated folders, such as `@SYS`, are named without a leading `/`.
pub fn path_in(folder: &str, name: &str) -> String {
    if folder == "/" && name.starts_with('@') {
        return name.to_owned();
    }
    format!("{}/{name}", folder.trim_end_matches('/'))
}

/// The last part of a path, without a query such as `?withdefaults=1`.
pub fn last_part(path: &str) -> &str {
    let whole = path.split('?').next().unwrap_or_default();
    let parts = whole.trim_end_matches('/').rsplit('/');
    parts.into_iter().next().unwrap_or_default()
}

/// The folder that contains a path; the root contains itself.
pub fn folder_of(path: &str) -> String {
    let whole = path.trim_end_matches('/');
    match whole.rsplit_once('/') {
        Some((folder, _)) if !folder.is_empty() => folder.to_owned(),
        _ => "/".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_taken_apart_and_put_together() {
        assert_eq!(path_in("/", "APM"), "/APM");
        assert_eq!(path_in("/", "@SYS"), "@SYS");
        assert_eq!(folder_of("@SYS"), "/");
        assert_eq!(path_in("/APM", "LOGS"), "/APM/LOGS");
        assert_eq!(last_part("@PARAM/param.pck?withdefaults=1"), "param.pck");
        assert_eq!(last_part("/APM/LOGS/"), "LOGS");
        assert_eq!(folder_of("/APM/LOGS/"), "/APM");
        assert_eq!(folder_of("/APM"), "/");
        assert_eq!(folder_of("/"), "/");
    }
}
