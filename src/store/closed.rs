//! Folders that this user has no permission to read, so that their files are left out.

use std::path::Path;
use std::{fs, io};

use super::{DESIGN_FILES, Folders, MISSION_FILES, PILOT_FILES, StoreError, THEME_FILES, folders};

/// The folders of missions, pilots, designs, themes and settings that this user has no permission to read. Within a
/// closed folder, no other is named.
pub fn closed_folders(folders: &Folders) -> Vec<StoreError> {
    let kinds = [MISSION_FILES, PILOT_FILES, DESIGN_FILES, THEME_FILES];
    let mut closed: Vec<StoreError> = Vec::new();
    for layer in folders.layers() {
        let names = kinds.iter().map(|kind| kind.folder);
        // A folder that only cannot be listed does not hide what is in it.
        if let Some(error) = refusal(fs::metadata(layer.join(folders::THEMES))) {
            closed.push(error(layer));
            continue;
        }
        let inside = names.map(|name| layer.join(name));
        for folder in inside {
            if let Some(error) = refusal(fs::read_dir(&folder)) {
                let is_told = |it: &StoreError| matches!(it, StoreError::Unreadable { path, .. } if folder.starts_with(path));
                if !closed.iter().any(is_told) {
                    closed.push(error(&folder));
                }
            }
        }
    }
    closed
}

/// The folders from this one down that cannot be read.
pub fn unreadable_below(folder: &Path) -> Vec<StoreError> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) => {
            let path = folder.to_owned();
            return vec![StoreError::Unreadable { path, error }];
        }
    };
    let is_folder = |entry: &fs::DirEntry| entry.file_type().is_ok_and(|kind| kind.is_dir());
    let below = entries.flatten().filter(is_folder);
    below
        .flat_map(|entry| unreadable_below(&entry.path()))
        .collect()
}

/// The error of a path that may not be read, to be completed with the path; `None` if it was, or is missing.
fn refusal<T>(outcome: io::Result<T>) -> Option<impl FnOnce(&Path) -> StoreError> {
    let error = outcome.err()?;
    let is_refused = error.kind() == io::ErrorKind::PermissionDenied;
    is_refused.then_some(|path: &Path| StoreError::Unreadable {
        path: path.to_owned(),
        error,
    })
}
