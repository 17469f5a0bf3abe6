//! Files of a kind that ship in the program, and that files in the folders of the administrator and the user replace.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::{Folders, Source, StoreError, read, read_found};
use crate::language::mission_meant;

/// All files of a kind.
pub struct LayeredFiles {
    /// The id of the message that names the kind.
    pub kind: &'static str,
    pub folder: &'static str,
    pub ending: &'static str,
    /// The names, without ending, and the texts of the shipped files.
    pub shipped: &'static [(&'static str, &'static str)],
}

impl LayeredFiles {
    /// All files by name: the user's own files replace the administrator's, which replace the embedded ones.
    pub fn all(&self) -> Vec<Source> {
        let mut all = self.embedded();
        if let Some(folders) = Folders::find() {
            let layers = folders.layers();
            let found =
                layers.flat_map(|layer| files(&layer.join(self.folder), self.kind, self.ending));
            all.extend(found.map(|source| (source.stem().to_owned(), source)));
        }
        all.into_values().collect()
    }

    /// The files that ship in the program, by their names without ending.
    pub fn embedded(&self) -> BTreeMap<String, Source> {
        let source = |&(name, text): &(&str, &str)| {
            let source = Source {
                name: format!("{name}.{}", self.ending),
                text: text.to_owned(),
            };
            (name.to_owned(), source)
        };
        self.shipped.iter().map(source).collect()
    }

    /// The files that the administrator's folders add or put in place of embedded ones.
    pub fn of_administrator(&self, folders: &Folders) -> impl Iterator<Item = Source> {
        let layers = folders.system_layers();
        layers.flat_map(|layer| files(&layer.join(self.folder), self.kind, self.ending))
    }

    /// The errors of the unreadable files in the folders.
    pub fn unreadable(&self) -> Vec<StoreError> {
        let folders = Folders::find();
        let layers = folders.iter().flat_map(Folders::layers);
        let all = layers.flat_map(|layer| found(&layer.join(self.folder), self.kind, self.ending));
        all.filter_map(Result::err).collect()
    }

    /// The file at a path, or else the one with a name, a number, or a unique prefix.
    pub fn find(&self, path_or_name: &str) -> Result<Source, StoreError> {
        self.at_path(path_or_name)
            .unwrap_or_else(|| self.named(path_or_name))
    }

    /// The file at that path, if there is one. A folder does not count, since it may have the name of a mission; a link
    /// whose file is missing counts.
    pub fn at_path(&self, path: &str) -> Option<Result<Source, StoreError>> {
        let path = Path::new(path);
        let is_there = path.exists() || path.is_symlink();
        (is_there && !path.is_dir()).then(|| read(path, self.kind))
    }

    /// The file with a name, a number, or a unique prefix.
    pub fn named(&self, name: &str) -> Result<Source, StoreError> {
        self.named_among(&self.all(), name)
    }

    pub(super) fn named_among(&self, all: &[Source], name: &str) -> Result<Source, StoreError> {
        let names: Vec<&str> = all.iter().map(Source::stem).collect();
        let meant = mission_meant(name, &names);
        if let Some(source) = all.iter().find(|it| Some(it.stem()) == meant) {
            return Ok(source.clone());
        }
        let unreadable = self.unreadable();
        let stems: Vec<&str> = unreadable.iter().filter_map(StoreError::stem).collect();
        let meant = mission_meant(name, &stems).map(str::to_owned);
        let mut errors = unreadable.into_iter();
        let unread = errors.find(|it| meant.is_some() && it.stem() == meant.as_deref());
        Err(unread.unwrap_or_else(|| StoreError::Unknown {
            kind: self.kind,
            name: name.to_owned(),
            known: names.join(", "),
        }))
    }
}

/// The files with that ending in a folder, by name; those that cannot be read are left out and
/// logged.
pub fn files(folder: &Path, kind: &'static str, ending: &str) -> Vec<Source> {
    let mut sources = Vec::new();
    for file in found(folder, kind, ending) {
        match file {
            Ok(source) => sources.push(source),
            Err(error) => tracing::warn!(%error, "a file that cannot be read is left out"),
        }
    }
    sources
}

/// The files with that ending in a folder, by name, or why each cannot be read.
fn found(folder: &Path, kind: &'static str, ending: &str) -> Vec<Result<Source, StoreError>> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    paths.sort();
    paths.iter().map(|path| read_found(path, kind)).collect()
}

/// The paths with these endings in a folder and its subfolders, by name. Links to folders are not
/// followed.
pub fn paths_below(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let found = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut entries: Vec<fs::DirEntry> = found.collect();
    entries.sort_by_key(fs::DirEntry::path);
    let mut paths = Vec::new();
    for entry in entries {
        let path = entry.path();
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            paths.extend(paths_below(&path, endings));
        } else if path
            .extension()
            .is_some_and(|found| endings.iter().any(|ending| found == *ending))
        {
            paths.push(path);
        }
    }
    paths
}
