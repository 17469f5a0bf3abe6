//! Files that the console reads and writes for its user: parameters, designs, and the history of the command line.

use super::Console;
use crate::app::effect::{FileEffect, FileKind};
use crate::app::event::{Event, FileEvent};
use crate::geo::{Square, Terrain};
use crate::store::{self, Source, StoreError, UnsavedDrafts};
use crate::text;
use crate::text::Text;

impl Console {
    /// Carries out an effect on the user's files, such as reading parameters or listing a folder.
    pub(super) fn handle_file(&mut self, effect: FileEffect) {
        let event = match effect {
            FileEffect::List { folder } => {
                let names = store::names_in(&store::user_path(&folder));
                FileEvent::Listed { folder, names }.into()
            }
            FileEffect::Ground { folder, squares } => match ground(&folder, &squares) {
                Ok(terrain) => FileEvent::Ground { folder, terrain }.into(),
                Err(reason) => Event::Failed(reason),
            },
            FileEffect::KeepDrafts(text) => return self.keep_drafts(text.as_deref()),
            FileEffect::Read { kind, path } => {
                let file = store::user_path(&path);
                let content = match kind {
                    FileKind::Plan => store::read_plan_text(&file),
                    FileKind::Parameters
                    | FileKind::Design
                    | FileKind::Review
                    | FileKind::Statistics => store::read(&file, subject(kind)),
                };
                match content {
                    Ok(Source { text, .. }) => FileEvent::Read { kind, path, text }.into(),
                    Err(error) => Event::Failed(Text::from(&error)),
                }
            }
            FileEffect::Write {
                kind,
                path,
                text,
                replace,
            } => match store::write(&store::user_path(&path), &text, replace) {
                Ok(()) => FileEvent::Written { path }.into(),
                Err(StoreError::Exists { .. }) => FileEvent::Exists { kind, path, text }.into(),
                Err(error) => Event::Failed(Text::from(&error)),
            },
        };
        self.post(event);
    }

    fn keep_drafts(&mut self, text: Option<&str>) {
        let Some(drafts) = &mut self.drafts else {
            return;
        };
        if let Err(error) = drafts.keep(text) {
            tracing::warn!(%error, "the unsaved drafts were not written");
        }
    }

    /// Opens the drafts that earlier consoles have not saved.
    pub(super) fn restore_drafts(&mut self) {
        let drafts = self.drafts.as_mut();
        for text in drafts.map(UnsavedDrafts::adopt).unwrap_or_default() {
            self.post(FileEvent::Kept { text });
        }
    }

    /// Appends a new history line to its file, without waiting for a slow disk.
    pub(super) fn keep_line(&mut self) {
        let newest = self.app.state().typing().last_line();
        let Some(history) = self.options.preferences.history.clone() else {
            return;
        };
        if let Some(line) = newest.filter(|line| self.kept.as_deref() != Some(*line)) {
            let line = line.to_owned();
            self.kept = Some(line.clone());
            tokio::task::spawn_blocking(move || {
                if let Err(error) = history.add(&line) {
                    tracing::warn!(%error, "the history of the command line was not written");
                }
            });
        }
    }
}

/// The ground of the squares that have files in a folder.
fn ground(folder: &str, squares: &[Square]) -> Result<Terrain, Text> {
    let path = store::user_path(folder);
    if !path.is_dir() {
        return Err(text!("plan-terrain-no-folder", path = folder));
    }
    let mut terrain = Terrain::default();
    for square in squares {
        store::add_square(&mut terrain, &path, *square)?;
    }
    Ok(terrain)
}

/// The id of the message that names a file of this kind in an error.
fn subject(kind: FileKind) -> &'static str {
    match kind {
        FileKind::Parameters => "file-parameters",
        FileKind::Design => "file-design",
        FileKind::Plan => "file-plan",
        FileKind::Review => "file-review",
        FileKind::Statistics => "file-statistics",
    }
}
